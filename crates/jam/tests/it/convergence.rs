//! Every fixed-step method has its order on every law.

use jam::laws::{Algebraic, Exponential, Logarithmic, Model};
use jam::ring::{Ring, Start};
use jam::states::{Form, FormKind};
use ode::{Control, Method, Problem, Step, integrate};
use std::ops::ControlFlow;

const RING: Ring = Ring { pedestrians: 8, length: 24.0 };

/// Laws with all their terms, smooth over the steps taken here (eps well above the way of a step).
fn smooth_laws() -> [Model; 3] {
    [
        Model::Algebraic(Algebraic {
            strength: 0.5,
            relative: 0.5,
            power: 2.0,
            widening: 0.05,
            epsilon: 0.5,
            desired_speed: 1.0,
        }),
        Model::Exponential(Exponential {
            strength: 2.0,
            range: 1.5,
            contact: 0.5,
            widening: 0.1,
            epsilon: 0.5,
            desired_speed: 1.0,
        }),
        Model::Logarithmic(Logarithmic { desired_speed: 1.0, widening: 0.5, epsilon: 0.3 }),
    ]
}

fn end(form: &dyn Form, method: Method, control: Control) -> Vec<f64> {
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
    // with DOP853 the steps (0.2, 0.33) are short enough for the leading term and long enough to stay above rounding
    for (model, dop853_steps) in smooth_laws().into_iter().zip([20, 12, 12]) {
        let form = FormKind::Deviations.build(&model, RING);
        let truth = end(&*form, Method::Extrapolation, Control::Adaptive { tolerance: 1e-15 });
        for (method, steps) in cases.into_iter().chain([(Method::Dop853, dop853_steps)]) {
            let error =
                |steps: u32| distance(&end(&*form, method, Control::Fixed { step: 4.0 / f64::from(steps) }), &truth);
            let (coarse, fine) = (error(steps), error(steps + steps / 2));
            let order = math::ln(coarse / fine) / math::ln(1.5);
            println!("{} {}: {coarse:e}, {fine:e}: order {order:.3}", model.name(), method.name());
            let off = (order - method.order() as f64).abs();
            assert!(off < 0.2, "{} {}: {coarse:e}, {fine:e}: order {order}", model.name(), method.name());
        }
    }
}
