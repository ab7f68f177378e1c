//! The run of figure 11 to t = 1000 under the compiled law and under the same formula, in turn: seconds of CPU and steps of
//! each. By Taylor's method, with any argument by DOP853. Both must end in the same bits.

use cpu_time::ThreadTime;
use formula::{Definition, Given, Place};
use jam::laws::{Formula, Logarithmic, Model};
use jam::ring::{Ring, Start};
use jam::states::StateVariables;
use ode::{Control, Method, Problem, Step, integrate};
use std::ops::ControlFlow;

/// Times of both.
const ROUNDS: usize = 5;

fn main() {
    let p = Place { line: 1, column: 1 };
    let d = |name, given| Definition { name, key: p, value: p, given };
    let graph = formula::law(
        "x",
        p,
        &[
            d("acceleration", Given::Text("v0*(1 - ln_1p((e - 1)*ramp(s/2 - 1, epsilon))) - v")),
            d("epsilon", Given::Number(0.01)),
            d("v0", Given::Number(1.0)),
            d("body", Given::Number(0.0)),
        ],
    )
    .expect("law");
    let formula = Model::Formula(Formula::new(graph).expect("formula"));
    let compiled = Model::Logarithmic(Logarithmic { desired_speed: 1.0, widening: 0.0, epsilon: 0.01 });
    let method = std::env::args().nth(1).map_or(Method::Taylor, |_| Method::Dop853);
    for _ in 0..ROUNDS {
        let mut last = Vec::new();
        for model in [&compiled, &formula] {
            let form = StateVariables::Deviations.build(model, Ring { pedestrians: 133, length: 200.0 });
            let start = form.start(Start { shift: 0.1 });
            let problem = Problem {
                system: &*form,
                start: &start,
                begin: 0.0,
                end: 1000.0,
                method,
                control: Control::Adaptive { tolerance: 1e-12 },
            };
            let t = ThreadTime::now();
            let result = integrate(&problem, &mut |_: &mut Step<'_>| ControlFlow::Continue(())).expect("run");
            println!("{:.4} {}", t.elapsed().as_secs_f64(), result.steps);
            last.push(result.state);
        }
        assert_eq!(last[0], last[1]);
    }
}
