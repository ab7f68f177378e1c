//! Repeats one operation, for `checks/cost.sh` (which counts instructions) and `cargo xtask bench` (which also measures
//! time): `cost NAME COUNT`. Without arguments it lists the names and the number of pedestrians of each. It prints CPU
//! seconds.
//!
//! | name | once is |
//! |---|---|
//! | `LAW` | an evaluation of the right-hand side for all pedestrians, as deviations |
//! | `gaps/LAW`, `positions/LAW` | the same in another form |
//! | `step-LAW` | a step of Heun's scheme in positions, of a batch |
//! | `series-LAW` | the Taylor series to order 16, in deviations |
//! | `lane/FUNCTION` | as many values of an elementary function as there are pedestrians |

use jam::laws::{Algebraic, Exponential, Logarithmic, Model};
use jam::ring::{Ring, Start};
use jam::states::StateVariables;
use math::row::{self, Scratch};
use math::simd::{Kernel, dispatch};
use std::hint::black_box;
use std::time::Instant;

/// Repeats its work the given number of times.
type Work = Box<dyn FnMut(u64)>;

/// What is measured, and for how many pedestrians.
struct Variant {
    name: String,
    pedestrians: usize,
    work: Work,
}

fn main() {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let mut variants = variants();
    let known = arguments.first().and_then(|name| variants.iter_mut().find(|variant| variant.name == *name));
    let (Some(variant), Some(Ok(count))) = (known, arguments.get(1).map(|text| text.parse())) else {
        variants.iter().for_each(|variant| println!("{} {}", variant.name, variant.pedestrians));
        return;
    };
    let (start, clock) = (cpu_seconds(), Instant::now());
    (variant.work)(count);
    // where the system does not say how long the thread was at work, the clock has to do
    let seconds = start.zip(cpu_seconds()).map_or(clock.elapsed().as_secs_f64(), |(start, end)| end - start);
    println!("{seconds:e}");
}

/// Seconds that this thread has been on a processor (Linux).
fn cpu_seconds() -> Option<f64> {
    // the kernel brings the count up to date when the thread is scheduled
    std::thread::yield_now();
    let text = std::fs::read_to_string("/proc/thread-self/schedstat").ok()?;
    text.split_whitespace().next()?.parse().ok().map(|nanoseconds: f64| 1e-9 * nanoseconds)
}

/// Each law with all its terms, and with fewer; then the laws of the paper's runs in other forms and other work on
/// them.
fn variants() -> Vec<Variant> {
    let named = |name: &str, pedestrians, work| Variant { name: name.to_owned(), pedestrians, work };
    let mut variants: Vec<Variant> = laws()
        .into_iter()
        .map(|(name, model)| named(name, 133, rates(StateVariables::Deviations, model, 133)))
        .collect();
    let law = |name: &str| laws().into_iter().find(|law| law.0 == name).map(|law| law.1);
    for (name, pedestrians) in STEPS {
        let Some(model) = law(name) else { continue };
        variants.push(named(&format!("step-{name}"), pedestrians, heun(model, pedestrians)));
    }
    for (name, pedestrians) in STEPS {
        let Some(model) = law(name) else { continue };
        if !PLAIN.contains(&name) {
            variants.push(named(&format!("series-{name}"), pedestrians, series(model, pedestrians)));
            continue;
        }
        variants.push(named(
            &format!("gaps/{name}"),
            pedestrians,
            rates(StateVariables::Spacings, model.clone(), pedestrians),
        ));
        variants.push(named(
            &format!("positions/{name}"),
            pedestrians,
            rates(StateVariables::Positions, model.clone(), pedestrians),
        ));
        variants.push(named(&format!("series-{name}"), pedestrians, series(model, pedestrians)));
    }
    variants.push(named("lane/softplus", 133, lane(row::softplus)));
    variants.push(named("lane/ln_1p", 133, lane(row::ln_1p)));
    variants
}

/// Laws of which steps are measured, with the pedestrians of the paper's runs.
const STEPS: [(&str, usize); 6] = [
    ("algebraic-all", 67),
    ("algebraic-q2", 67),
    ("exponential-all", 57),
    ("exponential", 57),
    ("logarithmic-widening", 133),
    ("logarithmic", 133),
];

/// The laws of the paper's runs.
const PLAIN: [&str; 3] = ["algebraic-q2", "exponential", "logarithmic"];

fn laws() -> Vec<(&'static str, Model)> {
    let algebraic = |delta, q, a_v| Model::Algebraic(Algebraic { mu: 0.45, delta, q, a_v, epsilon: 0.1, v0: 3.0 });
    let exponential = |c, a_v| Model::Exponential(Exponential { a: 1.5, b: 1.5, c, a_v, epsilon: 0.1, v0: 3.0 });
    let logarithmic = |a_v| Model::Logarithmic(Logarithmic { v0: 1.0, a_v, epsilon: 0.01 });
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

fn ring(pedestrians: usize) -> Ring {
    Ring { pedestrians, length: 3.0 * pedestrians as f64 }
}

fn rates(kind: StateVariables, model: Model, pedestrians: usize) -> Work {
    let form = kind.build(&model, ring(pedestrians));
    let state = form.start(Start { shift: 0.1 });
    let mut rates = vec![0.0; form.dimension()];
    Box::new(move |count| {
        for _ in 0..count {
            form.rates(black_box(&state), &mut rates);
            black_box(&mut rates);
        }
    })
}

fn heun(model: Model, pedestrians: usize) -> Work {
    let form = StateVariables::Positions.build(&model, ring(pedestrians));
    let mut state = form.start(Start { shift: 0.1 });
    Box::new(move |count| {
        // steps too short to come anywhere: no event breaks the batch off
        black_box(form.heun(&mut state, 1e-9, count));
    })
}

fn series(model: Model, pedestrians: usize) -> Work {
    const ORDER: usize = 16;
    let form = StateVariables::Deviations.build(&model, ring(pedestrians));
    let n = form.dimension();
    let mut coefficients = vec![0.0; (ORDER + 1) * n];
    coefficients[..n].copy_from_slice(&form.start(Start { shift: 0.1 }));
    let (states, rates) = coefficients.split_at_mut(n);
    form.rates(states, &mut rates[..n]);
    Box::new(move |count| {
        for _ in 0..count {
            form.series(ORDER, 1.0, black_box(&mut coefficients));
        }
    })
}

/// A function of rows, on a copy of a row. Its type is its own: through a pointer it would be that of the narrow
/// registers.
struct Row<'a, F> {
    function: F,
    x: &'a [f64],
    out: &'a mut [f64],
    room: &'a mut Scratch,
}

impl<F: Fn(&mut [f64], &mut Scratch)> Kernel for Row<'_, F> {
    type Output = ();

    #[inline(always)]
    fn run(self) {
        self.out.copy_from_slice(self.x);
        (self.function)(self.out, self.room);
    }
}

fn lane(function: impl Fn(&mut [f64], &mut Scratch) + Copy + 'static) -> Work {
    let x: Vec<f64> = (0..133).map(|n| f64::from(n) / 133.0).collect();
    let (mut out, mut room) = (vec![0.0; x.len()], Scratch::default());
    Box::new(move |count| {
        for _ in 0..count {
            dispatch(Row { function, x: black_box(&x), out: &mut out, room: &mut room });
            black_box(&mut out);
        }
    })
}
