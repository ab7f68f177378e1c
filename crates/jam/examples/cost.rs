//! Evaluates the right-hand side of a law, or makes steps of Heun's scheme, again and again, for `checks/cost.sh`, which
//! counts the instructions: `cost VARIANT TIMES`. Without arguments it lists the variants, each with its pedestrians.

use jam::laws::{Algebraic, Exponential, Logarithmic, Model};
use jam::ring::{Ring, Start};
use jam::states::{Form, FormKind};
use std::hint::black_box;

fn main() {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let variants = variants();
    let known = arguments.first().and_then(|name| variants.iter().find(|variant| variant.name == name));
    let (Some(variant), Some(Ok(times))) = (known, arguments.get(1).map(|text| text.parse::<u64>())) else {
        variants.iter().for_each(|variant| println!("{} {}", variant.name, variant.pedestrians));
        return;
    };
    let ring = Ring { pedestrians: variant.pedestrians, length: 3.0 * variant.pedestrians as f64 };
    let form = variant.form.build(&variant.model, ring);
    let mut state = form.start(Start { shift: 0.1 });
    match variant.form {
        FormKind::Positions => make_steps(&*form, &mut state, times),
        _ => evaluate(&*form, &state, times),
    }
}

fn evaluate(form: &dyn Form, state: &[f64], times: u64) {
    let mut rates = vec![0.0; form.dimension()];
    for _ in 0..times {
        form.rates(black_box(state), &mut rates);
        black_box(&mut rates);
    }
}

fn make_steps(form: &dyn Form, state: &mut [f64], count: u64) {
    black_box(form.heun(black_box(state), 1e-5, count));
}

/// What is counted: a law, in the form of the default runs or (steps) of the paper's.
struct Variant {
    name: &'static str,
    model: Model,
    form: FormKind,
    pedestrians: usize,
}

/// Each law with all its terms, and with fewer; then steps of the three laws of the paper's runs.
fn variants() -> Vec<Variant> {
    let algebraic = |relative, power, widening| {
        let (strength, epsilon, desired_speed) = (0.45, 0.1, 3.0);
        Model::Algebraic(Algebraic { strength, relative, power, widening, epsilon, desired_speed })
    };
    let exponential = |contact, widening| {
        let (strength, range, epsilon, desired_speed) = (1.5, 1.5, 0.1, 3.0);
        Model::Exponential(Exponential { strength, range, contact, widening, epsilon, desired_speed })
    };
    let logarithmic = |widening| Model::Logarithmic(Logarithmic { desired_speed: 1.0, widening, epsilon: 0.01 });
    let evaluation = |name, model| Variant { name, model, form: FormKind::Deviations, pedestrians: 133 };
    let steps = |name, model, pedestrians| Variant { name, model, form: FormKind::Positions, pedestrians };
    vec![
        evaluation("algebraic-all", algebraic(1.0, 1.5, 0.1)),
        evaluation("algebraic-relative-q2", algebraic(1.0, 2.0, 0.0)),
        evaluation("algebraic-widening-q2", algebraic(0.0, 2.0, 0.1)),
        evaluation("algebraic-q1.5", algebraic(0.0, 1.5, 0.0)),
        evaluation("algebraic-q3", algebraic(0.0, 3.0, 0.0)),
        evaluation("algebraic-q2", algebraic(0.0, 2.0, 0.0)),
        evaluation("algebraic-q1", algebraic(0.0, 1.0, 0.0)),
        evaluation("exponential-all", exponential(1.0, 0.1)),
        evaluation("exponential-contact", exponential(1.0, 0.0)),
        evaluation("exponential-widening", exponential(0.0, 0.1)),
        evaluation("exponential", exponential(0.0, 0.0)),
        evaluation("logarithmic-widening", logarithmic(0.1)),
        evaluation("logarithmic", logarithmic(0.0)),
        steps("step-algebraic-all", algebraic(1.0, 1.5, 0.1), 67),
        steps("step-algebraic-q2", algebraic(0.0, 2.0, 0.0), 67),
        steps("step-exponential-all", exponential(1.0, 0.1), 57),
        steps("step-exponential", exponential(0.0, 0.0), 57),
        steps("step-logarithmic-widening", logarithmic(0.1), 133),
        steps("step-logarithmic", logarithmic(0.0), 133),
    ]
}
