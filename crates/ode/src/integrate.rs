//! The two drivers: fixed steps, and steps adapted to the error.

use crate::ballistic::Ballistic;
use crate::bends::Bends;
use crate::control::{Control, Controller, Norm};
use crate::dense::{Ends, Step, Stepper, Trial};
use crate::extrapolation::Extrapolation;
use crate::failure::Failure;
use crate::methods::Method;
use crate::observe::{Observer, Pace, ResumePoint, StepPosition};
use crate::runge_kutta::RungeKutta;
use crate::system::{Batch, System};
use crate::taylor::Taylor;
use crate::vector::{add, add_compensated};

/// What shall be integrated, and how.
pub struct Problem<'a> {
    /// The equations.
    pub system: &'a dyn System,
    /// The state at the start: [`System::dimension`] components.
    pub start: &'a [f64],
    /// The time at the start.
    pub begin: f64,
    /// The time at which the integration ends, in the same unit; infinite if the observer ends it. Time does not run
    /// backwards: an end that is not after `begin` gives the start.
    pub end: f64,
    /// The method.
    pub method: Method,
    /// The rule for the steps.
    pub control: Control,
}

/// What an integration took, and where it ended.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Statistics {
    /// Accepted steps.
    pub steps: u64,
    /// Steps that were tried and made again smaller.
    pub rejected: u64,
    /// Evaluations of the right-hand side, those for output included.
    pub evaluations: u64,
    /// The time reached.
    pub time: f64,
    /// The state at that time: [`System::dimension`] components.
    pub state: Vec<f64>,
}

/// Integrates from the start, showing every accepted step to the observer, until the end or the observer's `Break`.
///
/// # Errors
/// See [`Failure`]. What the observer saw before remains valid. A start that is not finite is [`Failure::NotFinite`] or
/// [`Failure::StepTooSmall`] in the first step.
///
/// # Panics
/// The state at the start has another number of components than the system; a step or a tolerance that is not above 0
/// and finite; a time that is NaN.
pub fn integrate(problem: &Problem<'_>, observer: &mut dyn Observer) -> Result<Statistics, Failure> {
    if !problem.method.suits(problem.system) {
        return Err(Failure::NoSeries);
    }
    let mut run = Run::new(problem);
    let made = match problem.control {
        Control::Fixed { step } => run.fixed(problem, step, StepPosition::default(), observer),
        Control::Adaptive { .. } if !problem.method.is_adaptive() => {
            return Err(Failure::NoErrorEstimate(problem.method));
        }
        Control::Adaptive { tolerance } => run.adaptive(problem, tolerance, None, observer),
    };
    run.end(made, observer)
}

/// Continues from a mark of the same problem, with the same bits and counts as the run that produced the mark. The
/// observer must be as it was then.
///
/// # Errors
/// [`Failure::NotResumable`] for a mark of a run with another rule for its steps; else as [`integrate`].
///
/// # Panics
/// As [`integrate`].
pub fn resume(
    problem: &Problem<'_>,
    mark: &ResumePoint<'_>,
    observer: &mut dyn Observer,
) -> Result<Statistics, Failure> {
    let mut run = Run::new(&Problem { start: mark.state, ..*problem });
    run.statistics = mark.statistics.clone();
    let made = match (problem.control, mark.pace) {
        (Control::Fixed { step }, None) => run.fixed(problem, step, mark.position, observer),
        (Control::Adaptive { tolerance }, Some(pace)) => run.adaptive(problem, tolerance, Some(pace), observer),
        _ => return Err(Failure::NotResumable),
    };
    run.end(made, observer)
}

/// An integration under way.
struct Run<'a> {
    system: &'a dyn System,
    stepper: Box<dyn Stepper>,
    state: Vec<f64>,
    rates: Vec<f64>,
    next: Vec<f64>,
    next_rates: Vec<f64>,
    change: Vec<f64>,
    is_beyond: bool,
    statistics: Statistics,
}

impl<'a> Run<'a> {
    fn new(problem: &Problem<'a>) -> Run<'a> {
        let system = problem.system;
        let n = system.dimension();
        assert_eq!(problem.start.len(), n, "the state has as many components as the system");
        let (name, size) = match problem.control {
            Control::Fixed { step } => ("step", step),
            Control::Adaptive { tolerance } => ("tolerance", tolerance),
        };
        assert!(size > 0.0 && size.is_finite(), "the {name} is {size:?}; it must be above 0 and finite");
        assert!(!problem.begin.is_nan() && !problem.end.is_nan(), "from {:?} to {:?}", problem.begin, problem.end);
        let stepper: Box<dyn Stepper> = match (problem.method, problem.method.tableau()) {
            (_, Some(tableau)) => Box::new(RungeKutta::new(tableau, n)),
            (Method::Ballistic, None) => Box::new(Ballistic::new(system)),
            (Method::Taylor, None) => Box::new(Taylor::new(system, problem.control)),
            (_, None) => Box::new(Extrapolation::new(n)),
        };
        let mut rates = vec![0.0; n];
        system.rates(problem.start, &mut rates);
        Run {
            system,
            stepper,
            state: problem.start.to_vec(),
            rates,
            next: vec![0.0; n],
            next_rates: vec![0.0; n],
            change: vec![0.0; n],
            is_beyond: false,
            statistics: Statistics { evaluations: 1, time: problem.begin, ..Statistics::default() },
        }
    }

    /// What it took; or why it ended early, after the observer has seen the last state.
    fn end(mut self, made: Result<(), Failure>, observer: &mut dyn Observer) -> Result<Statistics, Failure> {
        self.statistics.state = self.state;
        if made.is_err() {
            observer.stuck(&self.statistics);
        }
        made.map(|()| self.statistics)
    }

    /// Step `k` runs from `begin + k h` to `begin + (k + 1) h`: the time is a product, so that it gathers no rounding.
    fn fixed(
        &mut self,
        problem: &Problem<'_>,
        h: f64,
        from: StepPosition,
        observer: &mut dyn Observer,
    ) -> Result<(), Failure> {
        let (whole, is_multiple) = whole_steps(problem.end - problem.begin, h);
        let StepPosition { step: mut k, mut slow_until } = from;
        let mut next_mark = k + LONGEST_BURST;
        while k < whole {
            if k >= next_mark {
                let position = StepPosition { step: k, slow_until };
                observer.between(&ResumePoint {
                    position,
                    statistics: &self.statistics,
                    state: &self.state,
                    pace: None,
                });
                next_mark = k + LONGEST_BURST;
            }
            if problem.method == Method::Heun && k >= slow_until {
                let sample = ((observer.next_sample() - problem.begin) / h) as u64;
                let count = sample.min(whole).saturating_sub(k + 1).min(LONGEST_BURST);
                match self.batch(h, count) {
                    Batch::Done => {
                        k += count;
                        continue;
                    }
                    Batch::NeedsInspection => slow_until = k + count,
                    Batch::Unsupported => slow_until = whole,
                }
            }
            let start = problem.begin + k as f64 * h;
            let end = if k + 1 == whole { problem.end } else { problem.begin + (k + 1) as f64 * h };
            let length = if k + 1 == whole && !is_multiple { end - start } else { h };
            self.is_beyond = self.try_step(length, None).is_infinite();
            add(&self.state, &self.change, &mut self.next);
            if !self.next.iter().all(|component| component.is_finite()) {
                return Err(Failure::NotFinite { time: start, step: length });
            }
            self.arrive();
            if self.accept(start, end, length, observer).is_break() {
                break;
            }
            k += 1;
        }
        Ok(())
    }

    /// Makes `count` Heun steps that no observer needs to see, if the system can do so and no event occurs.
    fn batch(&mut self, h: f64, count: u64) -> Batch {
        if count == 0 {
            return Batch::NeedsInspection;
        }
        self.next.copy_from_slice(&self.state);
        let batch = self.system.heun(&mut self.next, h, count);
        if batch == Batch::Done {
            std::mem::swap(&mut self.state, &mut self.next);
            self.system.rates(&self.state, &mut self.rates);
            self.statistics.steps += count;
            self.statistics.evaluations += 2 * count;
        }
        batch
    }

    fn adaptive(
        &mut self,
        problem: &Problem<'_>,
        tolerance: f64,
        from: Option<Pace<'_>>,
        observer: &mut dyn Observer,
    ) -> Result<(), Failure> {
        let mut norm = Norm::new(self.system, tolerance);
        let mut controller = Controller::new(self.stepper.error_power());
        let (mut compensation, mut next_compensation) = (vec![0.0; self.state.len()], vec![0.0; self.state.len()]);
        let (mut time, mut time_carry) = ([problem.begin], [0.0]);
        let mut h = match from {
            None => {
                let guess = self.first_step(problem, &mut norm);
                self.propose(&norm).unwrap_or(guess)
            }
            Some(pace) => {
                compensation.copy_from_slice(pace.compensation);
                self.rates.copy_from_slice(pace.rates);
                ([time[0], time_carry[0]], controller.previous) = (pace.time, pace.error);
                norm.start(&self.state);
                self.stepper.resume(pace.unit);
                self.propose(&norm);
                pace.step
            }
        };
        let most_steps = observer.most_steps();
        let mut bends = Bends::new(self.system, &self.state, &self.rates);
        let between_marks = (WORK_BETWEEN_MARKS / self.state.len() as u64).max(1);
        let (mut rejected, mut in_place) = (self.statistics.rejected, 0);
        while time[0] < problem.end {
            if self.statistics.steps + self.statistics.rejected >= most_steps {
                return Err(Failure::TooManySteps { time: time[0], steps: most_steps });
            }
            let left = (problem.end - time[0]) - time_carry[0];
            let is_last = h >= left;
            let length = if is_last { left } else { h };
            if length < SHORTEST {
                return Err(Failure::StepTooSmall { time: time[0], step: h });
            }
            let mut error = self.try_step(length, Some(&norm));
            if self.stepper.rates_at_end().is_none() {
                // without the compensation: with it a step of no length could come ever nearer to the end of the domain
                add(&self.state, &self.change, &mut self.next);
                if !self.system.in_domain(&self.next) {
                    error = f64::INFINITY;
                }
            }
            if error.is_nan() || error > 1.0 {
                self.statistics.rejected += 1;
                h = length * controller.reject(error);
                continue;
            }
            add_compensated(&self.state, &self.change, &compensation, &mut self.next, &mut next_compensation);
            self.arrive();
            if let Some(factor) = self.too_long(length, &norm, bends.as_mut()) {
                self.statistics.rejected += 1;
                h = length * factor;
                continue;
            }
            std::mem::swap(&mut compensation, &mut next_compensation);
            let (start, start_carry) = (time, time_carry);
            add_compensated(&start, &[length], &start_carry, &mut time, &mut time_carry);
            let end = if is_last { problem.end } else { time[0] };
            if self.accept(start[0], end, length, observer).is_break() {
                break;
            }
            if is_last {
                break;
            }
            // before the step the state was what `next` is now
            let is_in_place = self.statistics.rejected > rejected && self.state == self.next;
            (rejected, in_place) = (self.statistics.rejected, if is_in_place { in_place + 1 } else { 0 });
            if in_place == MOST_IN_PLACE {
                return Err(Failure::StepTooSmall { time: time[0], step: length });
            }
            if let Some(bends) = &mut bends {
                bends.advance();
            }
            norm.start(&self.state);
            h = self.propose(&norm).unwrap_or_else(|| length * controller.accept(error));
            // a mark does not tell how many steps in a row were made in place
            if in_place == 0 && self.statistics.steps.is_multiple_of(between_marks) {
                let (error, unit) = (controller.previous, self.stepper.unit());
                let time = [time[0], time_carry[0]];
                let pace = Pace { rates: &self.rates, compensation: &compensation, time, step: h, error, unit };
                let position = StepPosition { step: self.statistics.steps, slow_until: 0 };
                let (statistics, state) = (&self.statistics, &self.state[..]);
                observer.between(&ResumePoint { position, statistics, state, pace: Some(pace) });
            }
        }
        Ok(())
    }

    /// The part of a step that its error allows after which it has to end all the same, less than 1: for a bend that it
    /// may not have seen, or since the law says otherwise at its end than its solution.
    fn too_long(&mut self, h: f64, norm: &Norm, bends: Option<&mut Bends>) -> Option<f64> {
        let shortened = bends.and_then(|bends| bends.shortened(self.system, &self.next, &self.next_rates, h));
        if shortened.is_some_and(|part| part > LEAST_PART) {
            return shortened;
        }
        let ends = Ends {
            before: &self.state,
            after: &self.next,
            rates_before: &self.rates,
            rates_after: &self.next_rates,
            h,
        };
        let defect = self.stepper.defect(&ends, norm);
        // from an end where the law says otherwise, with a rate beyond all bounds perhaps, no path to a bend follows
        (defect.is_nan() || defect > LARGEST_DEFECT).then_some(0.5).or(shortened)
    }

    fn propose(&mut self, norm: &Norm) -> Option<f64> {
        self.stepper.propose(self.system, &self.state, &self.rates, norm)
    }

    fn try_step(&mut self, h: f64, norm: Option<&Norm>) -> f64 {
        let from = Trial { state: &self.state, rates: &self.rates, h };
        let error = self.stepper.try_step(self.system, from, &mut self.change, norm);
        self.statistics.evaluations += self.stepper.evaluations();
        error
    }

    /// Finds the rates at the end of a step.
    fn arrive(&mut self) {
        // known rates are those at a state that lacks the compensation of its sum, half a unit at most
        match self.stepper.rates_at_end() {
            Some(rates) => self.next_rates.copy_from_slice(rates),
            None => {
                self.system.rates(&self.next, &mut self.next_rates);
                self.statistics.evaluations += 1;
            }
        }
    }

    /// Takes `self.next`, whose rates are known, for the new state and shows the step to the observer.
    fn accept(&mut self, start: f64, end: f64, h: f64, observer: &mut dyn Observer) -> std::ops::ControlFlow<()> {
        let ends = Ends {
            before: &self.state,
            after: &self.next,
            rates_before: &self.rates,
            rates_after: &self.next_rates,
            h,
        };
        let (system, stepper, is_beyond) = (self.system, &mut *self.stepper, self.is_beyond);
        let mut step = Step { system, stepper, ends, evaluations: 0, is_beyond, start, end };
        let flow = observer.after(&mut step);
        self.statistics.evaluations += step.evaluations;
        self.statistics.steps += 1;
        self.statistics.time = end;
        std::mem::swap(&mut self.state, &mut self.next);
        std::mem::swap(&mut self.rates, &mut self.next_rates);
        flow
    }

    /// A first step over which the state changes by about a hundredth of its size.
    fn first_step(&self, problem: &Problem<'_>, norm: &mut Norm) -> f64 {
        norm.start(&self.state);
        let (size, rate) = (norm.of(&self.state), norm.of(&self.rates));
        let guess = if size > 0.0 && rate > 0.0 { 0.01 * (size / rate) } else { 1e-3 };
        math::smaller(guess, problem.end - problem.begin)
    }
}

/// Steps of a batch: enough to make its start cheap, few enough to make again one by one. Marks are no closer.
const LONGEST_BURST: u64 = 4096;

/// As many components are brought on by adaptive steps between two marks.
const WORK_BETWEEN_MARKS: u64 = 1 << 18;

/// Lower limit of adaptive steps. The equations are autonomous and the time is summed with compensation, so a step may
/// be far below the rounding of the time: near a wall of the force it is as short as the gap is small. In the unit of
/// time.
pub const SHORTEST: f64 = 1e-290;

/// So many steps in a row that had to be shortened and changed no component end a run: at the end of the domain the
/// compensation of the sums takes in ever shorter ones.
const MOST_IN_PLACE: u32 = 256;

/// A path that touches a bend in an earlier part of a step than this is doubted: it may be that of an end that means
/// nothing.
const LEAST_PART: f64 = 1e-4;

/// A larger defect is taken for a sign that the law is another one at the end of the step than at its start.
const LARGEST_DEFECT: f64 = 32.0;

/// The number of steps of length `h` over this time, and whether all of them are whole; else the last one is shorter.
fn whole_steps(time: f64, h: f64) -> (u64, bool) {
    let count = time / h;
    // the quotient is off by a rounding or two of itself
    let is_multiple = count > 0.5 && (count - count.round()).abs() < 1e-9 + 4.0 * f64::EPSILON * count;
    // of a step much longer than the whole time the number may vanish
    let least = u64::from(time > 0.0);
    let whole = if is_multiple { count.round() } else { count.ceil() } as u64;
    (if whole > least { whole } else { least }, is_multiple)
}

#[cfg(test)]
mod tests {
    use super::whole_steps;

    #[test]
    fn many_steps_are_counted_as_few_are() {
        for (time, h, whole, is_multiple) in [
            (1.0, 0.1, 10, true),
            (1.05, 0.1, 11, false),
            (3000.0, 1e-5, 300_000_000, true),
            (3_000.000_004, 1e-5, 300_000_001, false),
            // beyond 5e8 steps a part of a step is as much as before
            (10_000.000_005, 1e-5, 1_000_000_001, false),
            (1e5, 1e-6, 100_000_000_000, true),
            (5e-324, 2.0, 1, false),
            (0.25, 1.0, 1, false),
        ] {
            assert_eq!(whole_steps(time, h), (whole, is_multiple), "{time} by {h}");
        }
    }
}
