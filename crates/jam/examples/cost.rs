//! Evaluates the right-hand side of a law again and again, for `checks/cost.sh`, which counts the instructions:
//! `cost VARIANT EVALUATIONS`. Without arguments it lists the variants.

use jam::laws::{Algebraic, Exponential, Logarithmic, Model};
use jam::ring::{Ring, Start};
use jam::states::FormKind;

/// Pedestrians of the ring: those of figures 11-13.
const PEDESTRIANS: usize = 133;

fn main() {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let variants = variants();
    let known = arguments.first().and_then(|name| variants.iter().find(|variant| variant.0 == name));
    let (Some(&(_, model)), Some(Ok(evaluations))) = (known, arguments.get(1).map(|text| text.parse::<u32>())) else {
        variants.iter().for_each(|(name, _)| println!("{name}"));
        return;
    };
    let ring = Ring { pedestrians: PEDESTRIANS, length: 3.0 * PEDESTRIANS as f64 };
    let form = FormKind::Deviations.build(&model, ring);
    let state = form.start(Start { shift: 0.1 });
    let mut rates = vec![0.0; form.dimension()];
    for _ in 0..evaluations {
        form.rates(std::hint::black_box(&state), &mut rates);
        std::hint::black_box(&mut rates);
    }
}

/// Each law with all its terms, and with fewer.
fn variants() -> Vec<(&'static str, Model)> {
    let algebraic = |relative, power, widening| {
        let (strength, epsilon, desired_speed) = (0.5, 0.1, 3.0);
        Model::Algebraic(Algebraic { strength, relative, power, widening, epsilon, desired_speed })
    };
    let exponential = |contact, widening| {
        let (strength, range, epsilon, desired_speed) = (1.5, 1.5, 0.1, 3.0);
        Model::Exponential(Exponential { strength, range, contact, widening, epsilon, desired_speed })
    };
    let logarithmic = |widening| Model::Logarithmic(Logarithmic { desired_speed: 1.0, widening, epsilon: 0.01 });
    vec![
        ("algebraic-all", algebraic(1.0, 1.5, 0.1)),
        ("algebraic-relative-q2", algebraic(1.0, 2.0, 0.0)),
        ("algebraic-widening-q2", algebraic(0.0, 2.0, 0.1)),
        ("algebraic-q1.5", algebraic(0.0, 1.5, 0.0)),
        ("algebraic-q3", algebraic(0.0, 3.0, 0.0)),
        ("algebraic-q2", algebraic(0.0, 2.0, 0.0)),
        ("algebraic-q1", algebraic(0.0, 1.0, 0.0)),
        ("exponential-all", exponential(1.0, 0.1)),
        ("exponential-contact", exponential(1.0, 0.0)),
        ("exponential-widening", exponential(0.0, 0.1)),
        ("exponential", exponential(0.0, 0.0)),
        ("logarithmic-widening", logarithmic(0.1)),
        ("logarithmic", logarithmic(0.0)),
    ]
}
