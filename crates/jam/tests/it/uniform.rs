//! The uniform flow: its speed, and that it persists to the last bit.

use crate::sample::{HEADWAYS, Random, laws, paper_laws};
use jam::laws::{Algebraic, Exponential, Logarithmic, Model};
use jam::ring::{Ring, Start};
use jam::states::StateVariables;
use jam::uniform::steady_speed;
use ode::{Control, Method, Problem, Step, integrate};
use std::ops::ControlFlow;

#[test]
fn steady_speed_balances_drive_and_force() {
    let mut random = Random(4);
    let (mut found, mut without) = (0, 0);
    for _ in 0..2000 {
        for model in laws(&mut random) {
            let headway = model.contact() + random.uniform(0.3, 3.0);
            let acceleration = |v: f64| model.acceleration(headway, v, v);
            let Ok(speed) = steady_speed(&model, headway) else {
                // the force of the exponential law is finite: it need not stop pedestrians whose room is used up
                assert!(matches!(model, Model::Exponential(_)));
                assert!(acceleration((headway - 2.0) / (2.0 * model.gap_per_speed())) > 0.0);
                without += 1;
                continue;
            };
            // the last speed that is still pushed forward
            assert!(acceleration(speed) > 0.0, "{model:?} at {headway}");
            let next = speed.next_up();
            let closed = matches!(model, Model::Algebraic(_)) && model.effective_gap(headway, next, next) <= 0.0;
            assert!(closed || acceleration(next) <= 0.0, "{model:?} at {headway}");
            assert!(speed < model.desired_speed() && model.effective_gap(headway, speed, speed) > 0.0);
            found += 1;
        }
    }
    assert!(found > 5000 && without >= 5, "{found} {without}");
}

#[test]
fn known_steady_speeds() {
    let Model::Algebraic(algebraic) = paper_laws()[0] else { panic!("the first law is algebraic") };
    // v' = v_0 - mu^2 / d'^2, d' = 1 / 2, mu = 1 / 2: v' = 3 - 1
    let model = Model::Algebraic(jam::laws::Algebraic { mu: 0.5, ..algebraic });
    let speed = steady_speed(&model, 2.5).expect("there is room");
    assert!((speed - 2.0).abs() < 4.0 * f64::EPSILON, "{speed:?}");
    // logarithmic, far beyond the critical distance: the desired speed, but for c eps ln(1 + exp(-50))
    let model = Model::Logarithmic(Logarithmic { v0: 1.0, a_v: 0.0, epsilon: 0.01 });
    let speed = steady_speed(&model, 3.0).expect("there is room");
    assert!((speed - 1.0).abs() < 4.0 * f64::EPSILON, "{speed:?}");
}

#[test]
fn no_uniform_flow_where_there_is_no_room() {
    let [algebraic, exponential, logarithmic] = paper_laws();
    for (model, headway) in
        [(&algebraic, 2.0), (&algebraic, 1.5), (&exponential, 2.0), (&exponential, 0.1), (&logarithmic, 0.0)]
    {
        let error = steady_speed(model, headway).expect_err("no room");
        let words = "at no speed from -1e12 v_0 to v_0 does the drive balance the force at a positive gap; a longer ring, fewer pedestrians or a weaker force has a uniform flow";
        assert_eq!(error.to_string(), format!("no uniform flow at headway L/N = {headway:?}: {words}"));
    }
    // a contact force so stiff that only backwards motion, in an ever narrower room, would balance it
    let stiff = Model::Exponential(Exponential { a: 1e15, b: 1.0, c: 0.0, a_v: 0.0, epsilon: 0.1, v0: 1.0 });
    assert!(steady_speed(&stiff, 2.5).is_err());
}

#[test]
fn the_search_for_a_steady_speed_ends_at_so_many_desired_ones() {
    let law = |strength: f64, desired_speed: f64| {
        let (relative, power, widening, epsilon) = (0.0, 2.0, 0.0, 0.1);
        Model::Algebraic(Algebraic {
            mu: strength,
            delta: relative,
            q: power,
            a_v: widening,
            epsilon,
            v0: desired_speed,
        })
    };
    // at a room of 1 the steady speed is v_0 - mu^2: 1e11 backwards is within 1e12 v_0 of v_0 = 1, not of 1/100
    let speed = steady_speed(&law(1e11_f64.sqrt(), 1.0), 3.0).expect("it is within");
    assert!((speed / -1e11 - 1.0).abs() < 1e-10, "{speed}");
    assert!(steady_speed(&law(1e11_f64.sqrt(), 0.01), 3.0).is_err());
    assert!(steady_speed(&law(1e11_f64.sqrt(), 100.0), 3.0).is_ok());
}

/// Calls `look` with gaps and speeds after every step of a run that starts uniform.
fn run(
    model: &Model,
    ring: Ring,
    kind: StateVariables,
    method: Method,
    control: Control,
    look: &mut dyn FnMut(&[f64], &[f64]),
) {
    let form = kind.build(model, ring);
    if !method.suits(&*form) {
        return;
    }
    let start = form.start(Start { shift: 0.0 });
    let (mut gaps, mut speeds) = (vec![0.0; ring.pedestrians], vec![0.0; ring.pedestrians]);
    let problem = Problem { system: &*form, start: &start, begin: 0.0, end: 30.0, method, control };
    integrate(&problem, &mut |step: &mut Step<'_>| {
        form.read(step.after(), &mut gaps, &mut speeds);
        look(&gaps, &speeds);
        ControlFlow::Continue(())
    })
    .expect("the uniform flow goes on");
}

fn controls(method: Method) -> Vec<Control> {
    let fixed = vec![Control::Fixed { step: 0.05 }];
    if method.is_adaptive() { [fixed, vec![Control::Adaptive { tolerance: 1e-12 }]].concat() } else { fixed }
}

#[test]
fn uniform_flow_is_stationary() {
    let mut random = Random(5);
    for _ in 0..3 {
        for (model, headway) in paper_laws().into_iter().zip(HEADWAYS).chain(laws(&mut random).map(|law| (law, 3.1))) {
            // a number of pedestrians that leaves a remainder in every width of vector registers
            let ring = Ring { pedestrians: 23, length: 23.0 * headway };
            for kind in [StateVariables::Deviations, StateVariables::Spacings] {
                for method in Method::ALL {
                    for control in controls(method) {
                        run(&model, ring, kind, method, control, &mut |gaps, speeds| {
                            let equal =
                                |values: &[f64]| values.iter().all(|value| value.to_bits() == values[0].to_bits());
                            assert!(equal(gaps) && equal(speeds), "{model:?} {kind:?} {}: {gaps:?}", method.name());
                            assert!((gaps[0] - headway).abs() <= 4.0 * f64::EPSILON * headway);
                        });
                    }
                }
            }
        }
    }
}

#[test]
fn uniform_flow_in_positions_is_stationary_to_their_rounding() {
    // positions of up to 23 * 3.1 + 3 * 30 < 256 have units of 2^-45; a gap is the difference of two that each of 600
    // steps rounds by half a unit; the laws here answer to a gap with a slope below 1, so over 30 time units an
    // instability (growth below 0.1) makes less than e^3 of it
    let allowed = 600.0 * 3.6e-15 * 8.0 * 20.0;
    for (model, headway) in paper_laws().into_iter().zip(HEADWAYS) {
        let ring = Ring { pedestrians: 23, length: 23.0 * headway };
        for method in Method::ALL {
            let mut worst: f64 = 0.0;
            run(&model, ring, StateVariables::Positions, method, Control::Fixed { step: 0.05 }, &mut |gaps, _| {
                worst = gaps.iter().map(|gap| (gap - headway).abs()).fold(worst, math::larger);
            });
            assert!(worst < allowed, "{} {}: {worst:e}, allowed {allowed:e}", model.name(), method.name());
        }
    }
}

#[test]
fn a_flow_from_rest_reaches_the_steady_speed() {
    for (model, headway) in paper_laws().into_iter().zip(HEADWAYS) {
        let ring = Ring { pedestrians: 5, length: 5.0 * headway };
        let mut last = 0.0;
        let control = Control::Adaptive { tolerance: 1e-13 };
        run(&model, ring, StateVariables::Deviations, Method::Dop853, control, &mut |_, speeds| last = speeds[0]);
        let steady = steady_speed(&model, headway).expect("there is room");
        // what is left of the start, v' exp(-30), and some tolerances
        assert!((last - steady).abs() < steady * math::exp(-30.0) + 1e-11, "{}: {last} not {steady}", model.name());
    }
}
