//! Times, counts and sums of the two drivers.

use crate::problems::{general_methods, kepler, oscillator, planet, solve, watched};
use math::double_double::DoubleDouble;
use ode::{Control, Group, Measure, Method, Problem, Step, System, integrate};
use std::ops::{ControlFlow, Range};

/// Start, end and length of every step.
fn steps(end: f64, control: Control, method: Method) -> Vec<(f64, f64, f64)> {
    let mut steps = Vec::new();
    watched(&oscillator(), &[1.0, 0.0], end, method, control, &mut |step| {
        steps.push((step.start, step.end, step.length()));
    })
    .expect("nothing stands in the way");
    steps
}

#[test]
fn times_of_fixed_steps_are_multiples() {
    for (h, end, count) in [(0.1, 1.0, 10), (1e-3, 3.0, 3000), (0.1, 0.3, 3), (0.7, 2.1, 3), (1e-5, 1.0, 100_000)] {
        let steps = steps(end, Control::Fixed { step: h }, Method::Euler);
        assert_eq!(steps.len(), count, "step {h}");
        for (k, (start, stop, length)) in steps.iter().enumerate() {
            let last = k + 1 == count;
            let expected = (k as f64 * h, if last { end } else { (k + 1) as f64 * h }, h);
            assert_eq!((*start, *stop, *length), expected, "step {k} of {h}");
        }
    }
}

#[test]
fn the_last_fixed_step_is_shorter_where_the_end_is_no_multiple() {
    let steps = steps(1.05, Control::Fixed { step: 0.1 }, Method::Rk4);
    assert_eq!(steps.len(), 11);
    assert_eq!(steps[10], (1.0, 1.05, 1.05 - 1.0));
    let one = self::steps(0.25, Control::Fixed { step: 1.0 }, Method::Rk4);
    assert_eq!(one, [(0.0, 0.25, 0.25)]);
    // 5e-324 / 2 is 0
    assert_eq!(self::steps(5e-324, Control::Fixed { step: 2.0 }, Method::Rk4), [(0.0, 5e-324, 5e-324)]);
}

#[test]
fn adaptive_steps_follow_each_other_and_end_at_the_end() {
    let steps = steps(50.0, Control::Adaptive { tolerance: 1e-9 }, Method::Dop853);
    assert_eq!(steps[0].0, 0.0);
    assert_eq!(steps[steps.len() - 1].1, 50.0);
    assert!(steps.windows(2).all(|pair| pair[0].1 == pair[1].0));
}

#[test]
fn the_time_gathers_no_rounding() {
    let steps = steps(5000.0, Control::Adaptive { tolerance: 1e-13 }, Method::Dop853);
    assert!(steps.len() > 10_000, "{} steps", steps.len());
    let mut exact = DoubleDouble::ZERO;
    for (_, end, length) in &steps {
        exact = exact + *length;
        let unit = end.next_up() - end;
        // Kahan's sum is within a unit of the exact one; the last time is the end, which its length was chosen to meet
        assert!((exact - *end).abs().hi <= unit, "t = {end}: {:e} units", (exact - *end).hi / unit);
    }
}

#[test]
fn the_last_step_meets_the_end_for_any_end() {
    for end in (1..200).map(|i| 0.37 * f64::from(i)) {
        let steps = steps(end, Control::Adaptive { tolerance: 1e-8 }, Method::Dop853);
        let sum = steps.iter().fold(DoubleDouble::ZERO, |sum, (_, _, length)| sum + *length);
        // the last length is what the sum and its carry leave, far below the rounding of the larger ends, 7e-15; the
        // carry lacks what is lost where the first steps grow
        assert!((sum - end).abs().hi <= 1e-16, "{end}: {:e}", (sum - end).hi);
    }
}

#[test]
fn evaluations_are_counted() {
    for method in general_methods() {
        let system = oscillator();
        let statistics = solve(&system, &[1.0, 0.0], 1.0, method, Control::Fixed { step: 0.125 });
        assert_eq!(statistics.steps, 8);
        let stages = match method {
            Method::Extrapolation => 1 + 64,
            Method::Ballistic => 1,
            _ => method.tableau().map_or(0, |tableau| tableau.stages() as u64),
        };
        // the rate at a step's end is the one at the next one's start
        assert_eq!(statistics.evaluations, 1 + 8 * stages, "{}", method.name());
        assert_eq!(statistics.evaluations, system.evaluations.get(), "{}", method.name());
    }
    for method in general_methods().filter(|method| method.is_adaptive()) {
        let system = oscillator();
        let mut state = [0.0; 2];
        let control = Control::Adaptive { tolerance: 1e-7 };
        let statistics = watched(&system, &[1.0, 0.0], 10.0, method, control, &mut |step| {
            step.at_fraction(0.3, &mut state);
        })
        .expect("nothing stands in the way");
        assert_eq!(statistics.evaluations, system.evaluations.get(), "{}", method.name());
    }
}

#[test]
fn first_same_as_last_evaluates_no_stage_twice() {
    // with the rate at the end in the estimate, a step costs its stages, the first known from the step before
    for (method, stages) in [(Method::Bs32, 3), (Method::Dopri54, 6), (Method::Tsit54, 6), (Method::Verner65, 8)] {
        let control = Control::Adaptive { tolerance: 1e-7 };
        let statistics = solve(&oscillator(), &[1.0, 0.0], 10.0, method, control);
        let tried = statistics.steps + statistics.rejected;
        assert_eq!(statistics.evaluations, 1 + stages * tried, "{}", method.name());
    }
}

#[test]
fn a_break_ends_after_the_step() {
    for control in [Control::Fixed { step: 0.1 }, Control::Adaptive { tolerance: 1e-9 }] {
        let system = oscillator();
        let problem =
            Problem { system: &system, start: &[1.0, 0.0], begin: 0.0, end: 10.0, method: Method::Dop853, control };
        let mut seen = (0, 0.0, Vec::new());
        let statistics = integrate(&problem, &mut |step: &mut Step<'_>| {
            seen = (seen.0 + 1, step.end, step.after().to_vec());
            if seen.0 == 3 { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
        })
        .expect("nothing stands in the way");
        assert_eq!((statistics.steps, statistics.time, statistics.state), seen);
    }
}

#[test]
fn names_and_orders() {
    let known: Vec<(&str, usize, bool)> =
        Method::ALL.iter().map(|method| (method.name(), method.order(), method.is_adaptive())).collect();
    let expected = [
        ("euler", 1, false),
        ("ballistic", 1, false),
        ("heun", 2, false),
        ("rk4", 4, false),
        ("bs32", 3, true),
        ("dopri54", 5, true),
        ("tsit54", 5, true),
        ("verner65", 6, true),
        ("verner76", 7, true),
        ("verner87", 8, true),
        ("verner98", 9, true),
        ("dop853", 8, true),
        ("extrapolation", 16, true),
        ("taylor", 24, true),
    ];
    assert_eq!(known, expected);
}

#[test]
fn the_ballistic_scheme_moves_with_the_mean_speed() {
    // x'' = -x from (1, 0.5): v_1 = v_0 - h x_0, x_1 = x_0 + h (v_0 + v_1) / 2
    let statistics = solve(&oscillator(), &[1.0, 0.5], 0.25, Method::Ballistic, Control::Fixed { step: 0.25 });
    assert_eq!(statistics.state, [1.0 + 0.25 * 0.5 * (0.5 + 0.25), 0.25]);
}

/// Steps, those rejected, evaluations, and where the planet is in the end: what the control of the step has chosen. No
/// law of nature, but any change of it is one that somebody should have meant.
#[test]
fn so_many_steps_are_taken() {
    let mut taken = Vec::new();
    for method in general_methods().filter(|method| method.is_adaptive()) {
        for tolerance in [1e-5, 1e-10] {
            let run = solve(&kepler(), &planet(0.0), 20.0, method, Control::Adaptive { tolerance });
            taken.push((method.name(), tolerance, run.steps, run.rejected, run.evaluations, run.state[0]));
        }
    }
    let expected = [
        ("bs32", 1e-5, 403, 0, 1210, -0.5763103543422898),
        ("bs32", 1e-10, 18583, 2, 55756, -0.5780432778455195),
        ("dopri54", 1e-5, 76, 17, 559, -0.5806805894632194),
        ("dopri54", 1e-10, 665, 0, 3991, -0.5780432844083161),
        ("tsit54", 1e-5, 83, 21, 625, -0.5780613364422139),
        ("tsit54", 1e-10, 718, 0, 4309, -0.5780432855173442),
        ("verner65", 1e-5, 76, 20, 769, -0.5781179161771217),
        ("verner65", 1e-10, 451, 0, 3609, -0.5780432951300863),
        ("verner76", 1e-5, 61, 17, 764, -0.5753962059162524),
        ("verner76", 1e-10, 266, 0, 2661, -0.5780432947101173),
        ("verner87", 1e-5, 42, 14, 715, -0.5780588959638311),
        ("verner87", 1e-10, 133, 33, 2126, -0.5780432951235807),
        ("verner98", 1e-5, 41, 12, 837, -0.578058121650376),
        ("verner98", 1e-10, 106, 26, 2087, -0.5780432958175197),
        ("dop853", 1e-5, 42, 13, 648, -0.578452566465136),
        ("dop853", 1e-10, 134, 33, 1972, -0.578043295033798),
        ("extrapolation", 1e-5, 20, 8, 1813, -0.5761116822008909),
        ("extrapolation", 1e-10, 37, 12, 3174, -0.5780432757529971),
    ];
    assert_eq!(taken, expected);
}

/// Two that grow and one that rests, in one group.
struct Growing {
    measure: Measure,
}

impl System for Growing {
    fn dimension(&self) -> usize {
        3
    }
    fn kinematics(&self, _state: &[f64], _rates: &mut [f64]) {}
    fn dynamics(&self, state: &[f64], rates: &mut [f64]) {
        (rates[0], rates[1], rates[2]) = (state[0], 0.5 * state[1], 0.0);
    }
    fn positions(&self) -> Vec<Range<usize>> {
        Vec::new()
    }
    fn groups(&self) -> Vec<Group> {
        vec![Group { range: 0..3, measure: self.measure, floor: f64::MIN_POSITIVE }]
    }
}

#[test]
fn errors_are_measured_by_the_largest_or_the_smallest_of_a_group() {
    let steps = |measure: Measure, resting: f64, tolerance: f64| {
        let system = Growing { measure };
        let start = [1.0, -2.0, resting];
        let control = Control::Adaptive { tolerance };
        let problem =
            Problem { system: &system, start: &start, begin: 0.0, end: 5.0, method: Method::Dopri54, control };
        integrate(&problem, &mut |_: &mut Step<'_>| ControlFlow::Continue(())).expect("it runs").steps
    };
    // the one that rests is the smallest: tolerance and size are one product
    let reference = steps(Measure::Smallest, 1e-3, 1e-6);
    assert_eq!([steps(Measure::Smallest, -1e-3, 1e-6), steps(Measure::Smallest, 0.1, 1e-8)], [reference; 2]);
    assert!(steps(Measure::Smallest, 1e-5, 1e-6) > 2 * reference);
    // the largest it is not, as long as the others are larger
    let reference = steps(Measure::Largest, 1e-3, 1e-6);
    assert_eq!([steps(Measure::Largest, -1e-3, 1e-6), steps(Measure::Largest, 0.1, 1e-6)], [reference; 2]);
    assert!(steps(Measure::Largest, 1e6, 1e-6) < reference);
}
