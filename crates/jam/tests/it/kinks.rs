//! Laws with kinks: Taylor's method ends its steps on them.

use jam::laws::{Formula, Model};
use jam::ring::{Ring, Start};
use jam::run::{Outcome, Run, run};
use ode::{Control, Method};

/// A law, its ring, and what SciPy finds at the end: the standard deviation of speeds, position and speed of pedestrian 0.
struct Case {
    law: &'static [&'static str],
    pedestrians: usize,
    length: f64,
    shift: f64,
    t_end: f64,
    right: [f64; 3],
}

/// By `solve_ivp` (DOP853, steps of at most 0.007, tolerance 3e-14), from the laws written anew; three integrations
/// agree to 3e-12.
const CASES: [Case; 5] = [
    // a largest acceleration
    Case {
        law: &["min(0.5, (tanh(s - 2) + tanh(2) - v)/0.6)"],
        pedestrians: 20,
        length: 40.0,
        shift: 0.6,
        t_end: 40.0,
        right: [0.015_809_136_879_748_6, 37.553_737_427_747_59, 0.972_345_655_713_700],
    },
    // a largest braking, too, and a speed that is linear in the spacing between two limits
    Case {
        law: &["max(-0.9, min(0.6, (min(1.2, max(0, s - 1)) - v)/0.7))"],
        pedestrians: 16,
        length: 30.4,
        shift: 0.4,
        t_end: 50.0,
        right: [0.048_406_790_276_058_4, 44.217_933_999_157_41, 0.839_671_051_776_448],
    },
    // the size of the relative speed
    Case {
        law: &["(1.2*(1 - exp(-(s - 1)/0.8)) - v)/0.8 - 0.3*abs(v[1] - v)*v"],
        pedestrians: 24,
        length: 52.8,
        shift: 0.5,
        t_end: 40.0,
        right: [0.000_611_286_220_917_0, 36.543_938_555_349_98, 0.932_238_859_357_982],
    },
    // a force that begins at contact
    Case {
        law: &["1.5 - v - exp(-(s - 1)/0.5) - 4*ramp(s - 1.4, 0)"],
        pedestrians: 20,
        length: 29.0,
        shift: 0.3,
        t_end: 30.0,
        right: [0.0, 0.0, 0.0],
    },
    // braking behind slower ones, a kink of the second derivative
    Case {
        law: &["1.5*(1 - exp(-(s - 1)/0.7)) - v - 0.8*max(0, v - v[1])^2/s + 0.2*(v[2] - v)"],
        pedestrians: 30,
        length: 57.0,
        shift: 0.4,
        t_end: 40.0,
        right: [0.0, 0.0, 0.0],
    },
];

fn model(case: &Case) -> Model {
    let law = [("acceleration", case.law[0].into()), ("body", 0.0.into())];
    Model::Formula(Formula::written(&law).expect("a law"))
}

fn made(case: &Case, model: Model, method: Method, tolerance: f64) -> Outcome {
    let ring = Ring { pedestrians: case.pedestrians, length: case.length };
    let set = Run::new(model, ring, Start { shift: case.shift }, case.t_end).expect("a run");
    let control = Control::Adaptive { tolerance };
    run(&Run { method, control, keeps_trajectories: false, ..set }).expect("it runs")
}

/// The largest difference from the right values.
fn off(case: &Case, outcome: &Outcome) -> f64 {
    let std = outcome.samples.std.last().copied().expect("samples");
    let found = [std, outcome.positions[0], outcome.speeds[0]];
    found.into_iter().zip(case.right).fold(0.0, |most, (a, b)| math::larger(most, (a - b).abs()))
}

#[test]
fn steps_end_on_kinks_and_meet_independent_values() {
    for (index, case) in CASES.iter().enumerate() {
        for tolerance in [1e-8, 1e-10, 1e-12] {
            let [taylor, other] =
                [Method::Taylor, Method::Dop853].map(|method| made(case, model(case), method, tolerance));
            let [error, others] = [&taylor, &other].map(|outcome| off(case, outcome));
            let [counts, of_other] = [&taylor, &other].map(|outcome| outcome.statistics);
            println!(
                "law {}, {tolerance:e}: off by {error:.1e} ({others:.1e}), right-hand sides {} ({}), steps {} + {} ({} + {})",
                index + 1,
                counts.evaluations,
                of_other.evaluations,
                counts.steps,
                counts.rejected,
                of_other.steps,
                of_other.rejected,
            );
            assert!(error < 10.0 * tolerance + 5e-12, "law {}: {error:e}", index + 1);
            // every kink was met by halving a step some 30 times
            assert!(counts.rejected * 10 < counts.steps, "law {}: {counts:?}", index + 1);
        }
    }
}
