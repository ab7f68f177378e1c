//! Taylor's method on a system that provides its series.

use crate::problems::oscillator;
use ode::{Control, Failure, Group, Measure, Method, Problem, Sampler, Statistics, Step, System, integrate};
use std::cell::RefCell;
use std::ops::{ControlFlow, Range};

/// `dy/dt = y (1 - y)` for every component: `1 / (1 + exp(-t))` from 1/2; nearest singularities at `t = +- i pi`.
struct Logistic {
    dimension: usize,
}

impl System for Logistic {
    fn dimension(&self) -> usize {
        self.dimension
    }

    fn kinematics(&self, _state: &[f64], _rates: &mut [f64]) {}

    fn dynamics(&self, state: &[f64], rates: &mut [f64]) {
        for (rate, y) in rates.iter_mut().zip(state) {
            *rate = y * (1.0 - y);
        }
    }

    fn positions(&self) -> Vec<Range<usize>> {
        Vec::new()
    }

    fn groups(&self) -> Vec<Group> {
        vec![Group { range: 0..self.dimension, measure: Measure::Largest, floor: 1.0 }]
    }

    fn has_series(&self) -> bool {
        true
    }

    /// `(k + 1) c_{k+1} = c_k - (sum c_j c_{k-j})`
    fn series(&self, order: usize, unit: f64, c: &mut [f64]) {
        let n = self.dimension;
        for k in 1..order {
            for i in 0..n {
                let square: f64 = (0..=k).map(|j| c[j * n + i] * c[(k - j) * n + i]).sum();
                c[(k + 1) * n + i] = unit * (c[k * n + i] - square) / (k + 1) as f64;
            }
        }
    }
}

fn truth(t: f64) -> f64 {
    1.0 / (1.0 + math::exp(-t))
}

/// Integrates `dimension` components from `value` to 8, calling `look` for every step.
fn run(dimension: usize, value: f64, control: Control, look: &mut dyn FnMut(&mut Step<'_>)) -> Statistics {
    let system = Logistic { dimension };
    let start = vec![value; dimension];
    let problem = Problem { system: &system, start: &start, begin: 0.0, end: 8.0, method: Method::Taylor, control };
    let mut observer = |step: &mut Step<'_>| {
        look(step);
        ControlFlow::Continue(())
    };
    integrate(&problem, &mut observer).expect("nothing stands in the way")
}

/// The largest error at the ends of steps and at three fractions inside each, and the number of steps.
fn largest_error(dimension: usize, control: Control) -> (f64, u64) {
    let mut worst = 0.0;
    let mut state = vec![0.0; dimension];
    let statistics = run(dimension, 0.5, control, &mut |step| {
        for theta in [0.25, 0.5, 0.9, 1.0] {
            step.at_fraction(theta, &mut state);
            let exact = truth(step.start + theta * step.length());
            for value in &state {
                worst = math::larger(worst, (value - exact).abs());
            }
        }
    });
    (worst, statistics.steps)
}

#[test]
fn errors_follow_the_tolerance_inside_steps_too() {
    for dimension in [1, 16, 37] {
        for exponent in 4..=15 {
            let tolerance = math::pow(10.0, -f64::from(exponent));
            let (error, steps) = largest_error(dimension, Control::Adaptive { tolerance });
            // each step adds an error of the size of its last term, which is the tolerance, times a factor of the
            // series; and a rounding
            let bound = 5.0 * steps as f64 * (tolerance + f64::EPSILON);
            assert!(error < bound, "tolerance {tolerance:e}: {error:e} above {bound:e}");
        }
    }
}

/// Far below the radius of convergence pi a step is exact to rounding.
#[test]
fn short_fixed_steps_are_exact_to_rounding() {
    let (error, steps) = largest_error(5, Control::Fixed { step: 0.25 });
    assert!(steps == 32 && error < 32.0 * f64::EPSILON, "{error:e}");
}

#[test]
fn no_step_is_rejected() {
    let statistics = run(3, 0.5, Control::Adaptive { tolerance: 1e-10 }, &mut |_| {});
    assert_eq!(statistics.rejected, 0);
}

/// An order of the series counts as an evaluation, the first of which is that of the rates: one more at the very start.
#[test]
fn orders_follow_the_tolerance_and_are_counted() {
    let counted = |control: Control| {
        let run = run(3, 0.5, control, &mut |_| {});
        assert_eq!((run.evaluations - 1) % run.steps, 0, "{run:?}");
        (run.evaluations - 1) / run.steps
    };
    let adaptive = [1e-2, 1e-4, 1e-7, 1e-10, 1e-15].map(|tolerance| counted(Control::Adaptive { tolerance }));
    // 6 - 0.45 ln(tolerance): 8.07, 10.14, 13.25, 16.36, 21.54
    assert_eq!((adaptive, counted(Control::Fixed { step: 0.25 })), ([8, 10, 13, 16, 22], 24));
}

/// A state at rest has a series of one term: the step reaches the end.
#[test]
fn a_state_at_rest_takes_one_step() {
    let statistics = run(3, 1.0, Control::Adaptive { tolerance: 1e-10 }, &mut |_| {});
    assert_eq!((statistics.steps, statistics.state), (1, vec![1.0; 3]));
}

#[test]
fn a_system_without_series_is_refused() {
    let system = oscillator();
    let control = Control::Adaptive { tolerance: 1e-10 };
    let problem =
        Problem { system: &system, start: &[1.0, 0.0], begin: 0.0, end: 1.0, method: Method::Taylor, control };
    let outcome = integrate(&problem, &mut |_: &mut Step<'_>| ControlFlow::Continue(()));
    assert_eq!(outcome, Err(Failure::NoSeries));
}

/// `x'' = -x` and `z' = |x|` from `(1, 0, 0)`: kinks where `x` is 0.
#[derive(Default)]
struct Rectified {
    series: RefCell<Vec<f64>>,
    /// Whether it tells where its kinks are.
    tells: bool,
}

impl System for Rectified {
    fn dimension(&self) -> usize {
        3
    }

    fn kinematics(&self, _state: &[f64], _rates: &mut [f64]) {}

    fn dynamics(&self, state: &[f64], rates: &mut [f64]) {
        rates.copy_from_slice(&[state[1], -state[0], state[0].abs()]);
    }

    fn positions(&self) -> Vec<Range<usize>> {
        Vec::new()
    }

    fn groups(&self) -> Vec<Group> {
        vec![Group { range: 0..3, measure: Measure::Largest, floor: 1.0 }]
    }

    fn has_series(&self) -> bool {
        true
    }

    fn series(&self, order: usize, unit: f64, c: &mut [f64]) {
        let mut side = 0.0;
        for k in 0..order {
            let (x, v) = (c[3 * k], c[3 * k + 1]);
            side = if side == 0.0 && x != 0.0 { x.signum() } else { side };
            if k > 0 {
                let share = unit / (k + 1) as f64;
                c[3 * k + 3..3 * k + 6].copy_from_slice(&[share * v, -share * x, share * side * x]);
            }
        }
        *self.series.borrow_mut() = c.to_vec();
    }

    fn kinks(&self) -> usize {
        usize::from(self.tells)
    }

    fn kink_arguments(&self, order: usize, arguments: &mut [f64]) {
        for (argument, row) in arguments[..order].iter_mut().zip(self.series.borrow().chunks(3)) {
            *argument = row[0];
        }
    }
}

#[test]
fn steps_end_on_kinks() {
    let made = |tells| {
        let system = Rectified { tells, ..Rectified::default() };
        let control = Control::Adaptive { tolerance: 1e-12 };
        let start = [1.0, 0.0, 0.0];
        let problem =
            Problem { system: &system, start: &start, begin: 0.0, end: 20.0, method: Method::Taylor, control };
        let mut ends = Vec::new();
        let mut look = |step: &mut Step<'_>| {
            ends.push(step.end);
            ControlFlow::Continue(())
        };
        (integrate(&problem, &mut look).expect("nothing stands in the way"), ends)
    };
    let ((located, ends), (halved, _)) = (made(true), made(false));
    // 1 up to the first zero, 2 for each of five arcs, and 1 + sin(20) since the last zero
    let exact = 12.0 + math::sin(20.0);
    assert!((located.state[2] - exact).abs() < 1e-10, "{} {exact}", located.state[2]);
    for zero in 0..6 {
        let time = (f64::from(zero) + 0.5) * std::f64::consts::PI;
        assert!(ends.iter().any(|end| (end - time).abs() < 1e-9), "{time}: {ends:?}");
    }
    assert_eq!(located.rejected, 0);
    assert!(halved.rejected > 100 && halved.evaluations > 3 * located.evaluations, "{halved:?} {located:?}");
}

#[test]
fn samples_of_one_step_have_the_bits_of_each_alone() {
    for dimension in [1, 7, 24, 30, 67, 137] {
        let (mut sampler, mut count) = (Sampler::new(0.05, dimension), 0);
        run(dimension, 0.3, Control::Adaptive { tolerance: 1e-9 }, &mut |step| {
            let mut samples = Vec::new();
            sampler.components_within(step, 8.0, dimension / 3..dimension, &mut |t, state| {
                samples.push((t, state[dimension / 3..].to_vec()));
            });
            for (t, sample) in &samples {
                let mut alone = vec![0.0; dimension];
                step.at(*t, &mut alone);
                assert_eq!(*sample, alone[dimension / 3..], "{dimension} components, t = {t}");
            }
            count += samples.len();
        });
        assert_eq!(count, 160);
    }
}
