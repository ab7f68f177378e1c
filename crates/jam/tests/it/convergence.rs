//! Every method attains its order on every law.

use jam::laws::{Algebraic, Exponential, Logarithmic, Model};
use jam::ring::{Ring, Start};
use jam::states::{RingSystem, StateVariables};
use ode::{Control, Method, Problem, Step, integrate};
use std::ops::ControlFlow;

const RING: Ring = Ring { pedestrians: 8, length: 24.0 };

/// Laws with all their terms, smooth over the steps taken here (eps well above the way of a step).
fn smooth_laws() -> [Model; 3] {
    [
        Model::Algebraic(Algebraic { mu: 0.5, delta: 0.5, q: 2.0, a_v: 0.05, epsilon: 0.5, v0: 1.0 }),
        Model::Exponential(Exponential { a: 2.0, b: 1.5, c: 0.5, a_v: 0.1, epsilon: 0.5, v0: 1.0 }),
        Model::Logarithmic(Logarithmic { v0: 1.0, a_v: 0.5, epsilon: 0.3 }),
    ]
}

fn end(form: &dyn RingSystem, method: Method, control: Control) -> Vec<f64> {
    let start = form.start(Start { shift: 0.4 });
    let problem = Problem { system: form, start: &start, begin: 0.0, end: 4.0, method, control };
    integrate(&problem, &mut |_: &mut Step<'_>| ControlFlow::Continue(())).expect("it runs").state
}

/// Root of the sum of the squares over gaps and speeds.
fn distance(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| (a - b) * (a - b)).sum::<f64>().sqrt()
}

#[test]
fn orders_on_every_law() {
    // ballistic: positions alone would be of order 2, but the forces depend on the speeds, which are Euler's
    let cases = [(Method::Euler, 4000), (Method::Ballistic, 4000), (Method::Heun, 1000), (Method::Rk4, 100)];
    // steps short enough for the leading term and long enough to stay above rounding, on each of the laws; some
    // pairs have so small a leading term that the next one exceeds it almost down to there
    let pairs = [
        (Method::Bs32, [100, 100, 100], 0.2),
        (Method::Dopri54, [200, 80, 160], 1.2),
        (Method::Tsit54, [100, 100, 100], 1.2),
        (Method::Verner65, [30, 20, 20], 1.2),
        (Method::Verner76, [24, 16, 16], 1.2),
        (Method::Verner87, [16, 10, 12], 1.2),
        (Method::Verner98, [12, 8, 12], 1.2),
        (Method::Dop853, [20, 12, 12], 0.2),
    ];
    for (law, model) in smooth_laws().into_iter().enumerate() {
        let form = StateVariables::Deviations.build(&model, RING);
        let truth = end(&*form, Method::Extrapolation, Control::Adaptive { tolerance: 1e-15 });
        let fixed = cases.into_iter().map(|(method, steps)| (method, steps, 0.2));
        for (method, steps, above) in fixed.chain(pairs.map(|(method, steps, above)| (method, steps[law], above))) {
            let error =
                |steps: u32| distance(&end(&*form, method, Control::Fixed { step: 4.0 / f64::from(steps) }), &truth);
            let (coarse, fine) = (error(steps), error(steps + steps / 2));
            let order = math::ln(coarse / fine) / math::ln(1.5);
            println!("{} {}: {coarse:e}, {fine:e}: order {order:.3}", model.name(), method.name());
            let off = order - method.order() as f64;
            assert!(
                -0.2 < off && off < above,
                "{} {}: {coarse:e}, {fine:e}: order {order}",
                model.name(),
                method.name()
            );
        }
    }
}
