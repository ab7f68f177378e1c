//! Does one thing again and again, for `checks/cost.sh`, which counts the instructions, and for `cargo xtask bench`, which
//! measures the time as well: `cost NAME COUNT`. Without arguments it lists the names. Prints seconds of CPU.
//!
//! | name | once is |
//! |---|---|
//! | `LAW` | an evaluation of the right-hand side for all pedestrians, as deviations |
//! | `gaps/LAW`, `positions/LAW` | the same in another form |
//! | `heun/LAW` | a step of Heun's scheme in positions, of a burst |
//! | `lane/FUNCTION` | as many values of an elementary function as there are pedestrians |

use jam::laws::{Algebraic, Exponential, Logarithmic, Model};
use jam::ring::{Ring, Start};
use jam::states::FormKind;
use std::hint::black_box;
use std::time::Instant;

/// Pedestrians of the ring: those of figures 11-13.
const PEDESTRIANS: usize = 133;
/// The ring.
const RING: Ring = Ring { pedestrians: PEDESTRIANS, length: 3.0 * PEDESTRIANS as f64 };

/// Does its work so many times.
type Work = Box<dyn FnMut(u64)>;

fn main() {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let mut works = works();
    let known = arguments.first().and_then(|name| works.iter_mut().find(|work| work.0 == *name));
    let (Some((_, work)), Some(Ok(count))) = (known, arguments.get(1).map(|text| text.parse())) else {
        works.iter().for_each(|(name, _)| println!("{name}"));
        return;
    };
    let (start, clock) = (cpu_seconds(), Instant::now());
    work(count);
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

fn works() -> Vec<(String, Work)> {
    let mut works: Vec<(String, Work)> = Vec::new();
    for (name, model) in variants() {
        works.push((name.to_owned(), rates(FormKind::Deviations, model)));
    }
    for (name, model) in variants().into_iter().filter(|(name, _)| PLAIN.contains(name)) {
        works.push((format!("gaps/{name}"), rates(FormKind::Gaps, model)));
        works.push((format!("positions/{name}"), rates(FormKind::Positions, model)));
        works.push((format!("heun/{name}"), heun(model)));
    }
    works.push(("lane/softplus".to_owned(), lane(math::slice::softplus)));
    works.push(("lane/ln_1p".to_owned(), lane(|x, out| math::slice::ln_1p_scaled(0.5, x, out))));
    works
}

/// The laws of the paper's runs.
const PLAIN: [&str; 3] = ["algebraic-q2", "exponential", "logarithmic"];

fn rates(kind: FormKind, model: Model) -> Work {
    let form = kind.build(&model, RING);
    let state = form.start(Start { shift: 0.1 });
    let mut rates = vec![0.0; form.dimension()];
    Box::new(move |count| {
        for _ in 0..count {
            form.rates(black_box(&state), &mut rates);
            black_box(&mut rates);
        }
    })
}

fn heun(model: Model) -> Work {
    let form = FormKind::Positions.build(&model, RING);
    let mut state = form.start(Start { shift: 0.1 });
    Box::new(move |count| {
        // steps too short to come anywhere: no event breaks the burst off
        black_box(form.heun(&mut state, 1e-9, count));
    })
}

fn lane(function: fn(&[f64], &mut [f64])) -> Work {
    let x: Vec<f64> = (0..PEDESTRIANS).map(|n| n as f64 / PEDESTRIANS as f64).collect();
    let mut out = vec![0.0; PEDESTRIANS];
    Box::new(move |count| {
        for _ in 0..count {
            function(black_box(&x), &mut out);
            black_box(&mut out);
        }
    })
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
