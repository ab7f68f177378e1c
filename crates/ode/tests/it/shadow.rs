//! Error estimates propagated along solutions by Taylor's method, against exact errors.

use ode::{Control, Group, Measure, Method, Problem, Shadow, Step, System, Tangent, integrate};
use std::ops::{ControlFlow, Range};

/// `dx/dt = v`, `dv/dt = -x - 2 a v`, without or with friction, or driven if `a < 0`; the tolerance is relative to the
/// state.
struct Pendulum {
    friction: f64,
    /// Whether it tells its linearised equations.
    is_linear: bool,
}

impl System for Pendulum {
    fn dimension(&self) -> usize {
        2
    }

    fn kinematics(&self, state: &[f64], rates: &mut [f64]) {
        rates[0] = state[1];
    }

    fn dynamics(&self, state: &[f64], rates: &mut [f64]) {
        rates[1] = -state[0] - 2.0 * self.friction * state[1];
    }

    fn positions(&self) -> Vec<Range<usize>> {
        std::iter::once(0..1).collect()
    }

    fn groups(&self) -> Vec<Group> {
        vec![Group { range: 0..2, measure: Measure::Largest, floor: 1e-300 }]
    }

    fn has_series(&self) -> bool {
        true
    }

    fn series(&self, order: usize, unit: f64, c: &mut [f64]) {
        for k in 1..order {
            let share = unit / (k + 1) as f64;
            c[2 * k + 2] = share * c[2 * k + 1];
            c[2 * k + 3] = share * (-c[2 * k] - 2.0 * self.friction * c[2 * k + 1]);
        }
    }

    fn relaxation_rate(&self) -> f64 {
        2.0 * self.friction
    }

    fn tangent_size(&self) -> usize {
        usize::from(self.is_linear)
    }

    fn tangent(&self, _state: &[f64], tangent: &mut [f64]) -> f64 {
        tangent[0] = -1.0;
        1.0
    }

    fn carry(&self, tangent: Tangent<'_>, difference: &mut [f64]) {
        let [mut x, mut v] = [difference[0], difference[1]];
        for k in 1..30 {
            let share = tangent.length / f64::from(k);
            (x, v) = (share * v, share * (tangent.start[0] * x - 2.0 * self.friction * v));
            difference[0] += x;
            difference[1] += v;
        }
    }
}

impl Pendulum {
    /// The exact solution from a start; what a small error at the start becomes, too.
    fn exact(&self, start: [f64; 2], t: f64) -> [f64; 2] {
        self.exact_by_force(1.0, start, t)
    }

    /// The same with a force that is larger by this factor.
    fn exact_by_force(&self, factor: f64, [x, v]: [f64; 2], t: f64) -> [f64; 2] {
        let a = self.friction;
        let w = (factor - a * a).sqrt();
        let (sin, cos) = (math::sin(w * t), math::cos(w * t));
        let damping = math::exp(-a * t);
        let more = (v + a * x) / w;
        [damping * (x * cos + more * sin), damping * (v * cos - (a * more + w * x) * sin)]
    }
}

/// Goes along with a solution from `[1, 0]` to 20 and shows every step with the shadow.
fn follow(system: &Pendulum, tolerance: f64, error: [f64; 2], look: &mut dyn FnMut(&mut Step<'_>, &Shadow)) {
    follow_off(system, tolerance, (error, 0.0), look);
}

/// The same if the force is off by a part of itself.
fn follow_off(
    system: &Pendulum,
    tolerance: f64,
    (error, part): ([f64; 2], f64),
    look: &mut dyn FnMut(&mut Step<'_>, &Shadow),
) {
    let control = Control::Adaptive { tolerance };
    let problem = Problem { system, start: &[1.0, 0.0], begin: 0.0, end: 20.0, method: Method::Taylor, control };
    let mut shadow = Shadow::new(error.to_vec());
    let mut observer = |step: &mut Step<'_>| {
        assert!(shadow.follow(step, 0.0, part), "Taylor's method tells its errors");
        look(step, &shadow);
        ControlFlow::Continue(())
    };
    integrate(&problem, &mut observer).expect("nothing stands in the way");
}

/// Frictions, and whether the linearised equations are told.
const SYSTEMS: [(f64, bool); 6] = [(0.0, false), (0.3, false), (-0.1, false), (0.0, true), (0.3, true), (-0.1, true)];

#[test]
fn a_force_off_by_a_part_gives_the_error_that_it_makes() {
    let part = 1e-6;
    for (friction, is_linear) in SYSTEMS {
        let system = Pendulum { friction, is_linear };
        let mut worst = 0.0;
        follow_off(&system, 1e-10, ([0.0; 2], part), &mut |step, shadow| {
            let mut error = [0.0; 2];
            shadow.at_end(&mut error);
            let [right, off] = [1.0, 1.0 + part].map(|factor| system.exact_by_force(factor, [1.0, 0.0], step.end));
            let made = [off[0] - right[0], off[1] - right[1]];
            let apart = math::larger((made[0] - error[0]).abs(), (made[1] - error[1]).abs());
            let size = math::larger(made[0].abs(), made[1].abs());
            // at first each step is a large part of the way
            if step.start > 5.0 {
                worst = math::larger(worst, apart / size);
            }
        });
        println!("{friction} {is_linear}: worst {worst}");
        assert!(worst > 0.0 && worst < 0.5, "{friction} {is_linear}: off by {worst} of the error");
    }
}

#[test]
fn errors_of_steps_are_those_against_the_exact_solution() {
    for (friction, is_linear) in SYSTEMS {
        for tolerance in [1e-4, 1e-7, 1e-10] {
            let system = Pendulum { friction, is_linear };
            let (mut steps, mut worst) = (0, 0.0);
            follow(&system, tolerance, [0.0; 2], &mut |step, shadow| {
                let (mut error, mut state) = ([0.0; 2], [0.0; 2]);
                for place in [0.5, 0.9, 1.0] {
                    shadow.at(step, place, &mut error);
                    step.at_fraction(place, &mut state);
                    let exact = system.exact([1.0, 0.0], step.start + place * step.length());
                    let off = [state[0] - exact[0], state[1] - exact[1]];
                    let apart = math::larger((off[0] - error[0]).abs(), (off[1] - error[1]).abs());
                    let size = math::larger(off[0].abs(), off[1].abs());
                    // below this the exact solution has roundings of its own
                    if size > 1e-13 {
                        worst = math::larger(worst, apart / size);
                        steps += 1;
                    }
                }
            });
            println!("{friction} {tolerance:e}: {steps} places, worst {worst}");
            assert!(steps > 20, "{friction} {tolerance:e}: {steps} places");
            assert!(worst < 0.25, "{friction} {tolerance:e}: a shadow off by {worst} of the error");
        }
    }
}

#[test]
fn an_error_at_the_start_becomes_what_the_exact_solution_makes_of_it() {
    for (friction, is_linear) in SYSTEMS {
        let system = Pendulum { friction, is_linear };
        let start = [1e-7, -2e-7];
        let mut steps = 0;
        follow(&system, 1e-13, start, &mut |step, shadow| {
            let mut error = [0.0; 2];
            shadow.at_end(&mut error);
            let right = system.exact(start, step.end);
            let size = math::larger(right[0].abs(), right[1].abs());
            let apart = math::larger((right[0] - error[0]).abs(), (right[1] - error[1]).abs());
            // each expansion may lose a twentieth
            assert!(apart < 0.05 * size, "{friction}, t = {}: {error:?}, right {right:?}", step.end);
            steps += 1;
        });
        assert!(steps > 5, "{steps}");
    }
}

#[test]
fn other_methods_and_fixed_steps_tell_nothing() {
    let system = Pendulum { friction: 0.0, is_linear: true };
    for (method, control) in
        [(Method::Dop853, Control::Adaptive { tolerance: 1e-8 }), (Method::Heun, Control::Fixed { step: 0.1 })]
    {
        let problem = Problem { system: &system, start: &[1.0, 0.0], begin: 0.0, end: 1.0, method, control };
        let mut shadow = Shadow::new(vec![0.0; 2]);
        let mut observer = |step: &mut Step<'_>| {
            assert!(!shadow.follow(step, 0.0, 0.0), "{method:?}");
            ControlFlow::Continue(())
        };
        integrate(&problem, &mut observer).expect("nothing stands in the way");
    }
}

/// A speed that relaxes to 1, with nothing else: `dx/dt = v`, `dv/dt = 1 - v`.
struct Relaxing;

impl System for Relaxing {
    fn dimension(&self) -> usize {
        2
    }

    fn kinematics(&self, state: &[f64], rates: &mut [f64]) {
        rates[0] = state[1];
    }

    fn dynamics(&self, state: &[f64], rates: &mut [f64]) {
        rates[1] = 1.0 - state[1];
    }

    fn positions(&self) -> Vec<Range<usize>> {
        std::iter::once(0..1).collect()
    }

    fn groups(&self) -> Vec<Group> {
        vec![Group { range: 0..2, measure: Measure::Largest, floor: 1.0 }]
    }

    fn has_series(&self) -> bool {
        true
    }

    fn series(&self, order: usize, unit: f64, c: &mut [f64]) {
        for k in 1..order {
            let share = unit / (k + 1) as f64;
            (c[2 * k + 2], c[2 * k + 3]) = (share * c[2 * k + 1], -share * c[2 * k + 1]);
        }
    }

    fn relaxation_rate(&self) -> f64 {
        1.0
    }
}

/// `x + v - t` is constant for every series, so that the errors of `x` and `v` are opposite. Those of early steps fade
/// in `v`, and must not stay in `x`.
#[test]
fn what_fades_in_speeds_fades_in_positions() {
    let control = Control::Adaptive { tolerance: 1e-8 };
    let problem =
        Problem { system: &Relaxing, start: &[0.0, 0.0], begin: 0.0, end: 15.0, method: Method::Taylor, control };
    let (mut shadow, mut steps) = (Shadow::new(vec![0.0; 2]), 0);
    let mut observer = |step: &mut Step<'_>| {
        assert!(shadow.follow(step, 0.0, 0.0));
        let mut error = [0.0; 2];
        shadow.at_end(&mut error);
        let exact = step.end - 1.0 + math::exp(-step.end);
        let off = step.after()[0] - exact;
        assert!((error[0] - off).abs() < 0.25 * off.abs(), "t = {}: {error:?}, right {off:e}", step.end);
        steps += 1;
        ControlFlow::Continue(())
    };
    integrate(&problem, &mut observer).expect("nothing stands in the way");
    assert!(steps > 3, "{steps}");
}
