//! Nanoseconds per pedestrian and step of Heun's scheme against the number of pedestrians: the columns of
//! `data/timing/scale.csv`. For each law: in one piece with AVX2 (`four`) and AVX-512 (`eight`), and in blocks with
//! AVX2 (`blocks`; small rings are never divided). `scale [LARGEST]`.
//!
//! Time is that of the thread on its processor, each number the lowest of several, so that what else the machine does
//! counts little.

use cpu_time::ThreadTime;
use jam::laws::{Algebraic, Logarithmic, Model};
use jam::ring::{Ring, Start};
use jam::states::{Cut, StateVariables, heun_steps};
use math::simd::Width;

/// Pedestrians times steps of one measurement.
const WORK: usize = 1 << 18;
/// Measurements, of which the lowest counts.
const REPEATS: usize = 15;
/// The same for large rings.
const FEW_REPEATS: usize = 5;
/// Rings smaller than this are not cut.
const CUT_FROM: usize = 3000;

fn main() {
    let largest = std::env::args().nth(1).and_then(|text| text.parse().ok()).unwrap_or(10_000_000);
    let (mu, q, epsilon) = (0.45, 2.0, 0.1);
    let algebraic = Algebraic { mu, delta: 0.0, q, a_v: 0.0, epsilon, v0: 3.0 };
    let logarithmic = Logarithmic { v0: 1.0, a_v: 0.0, epsilon: 0.01 };
    let laws = [(Model::Algebraic(algebraic), 200.0 / 67.0), (Model::Logarithmic(logarithmic), 200.0 / 133.0)];
    let columns =
        laws.each_ref().map(|(model, _)| VARIANTS.map(|(name, _, _)| format!(",{}_{name}", model.name())).concat());
    println!("n{}", columns.concat());
    let sizes = (1..).flat_map(|power| [10_usize.pow(power), 3 * 10_usize.pow(power)]);
    for n in sizes.take_while(|&n| n <= largest) {
        print!("{n}");
        for (model, headway) in &laws {
            let ring = Ring { pedestrians: n, length: n as f64 * headway };
            for (_, cut, width) in VARIANTS {
                print!(",{:.3}", lowest(model, ring, cut.filter(|_| n >= CUT_FROM), width));
            }
        }
        println!();
    }
}

/// The variants: name, cut, widest registers.
const VARIANTS: [(&str, Option<Cut>, Width); 3] = [
    ("four", None, Width::Four),
    ("eight", None, Width::Eight),
    ("blocks", Some(Cut { block: 1024, steps: 16, threads: 1 }), Width::Four),
];

fn lowest(model: &Model, ring: Ring, cut: Option<Cut>, width: Width) -> f64 {
    let n = ring.pedestrians;
    let mut state = StateVariables::Positions.build(model, ring).start(Start { shift: 0.01 });
    let steps = (WORK / n).clamp(16, 4096) as u64;
    let times = (0..if n > 100_000 { FEW_REPEATS } else { REPEATS }).map(|_| {
        let begin = ThreadTime::now();
        heun_steps(model, ring, (1e-5, steps), &mut state, cut, width);
        begin.elapsed()
    });
    let lowest = times.min().unwrap_or_default();
    lowest.as_secs_f64() * 1e9 / (steps as f64 * n as f64)
}
