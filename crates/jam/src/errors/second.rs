//! A second run, and the error estimate from the difference between both runs.

use super::recent::{Compared, Instant};
use super::{CAUTION, Errors, ROUNDINGS, confirmed, has_kinks, largest, largest_std, loses_shift, of_headway};
use crate::events::{Event, EventKind};
use crate::run::{Outcome, Run, RunObserver, has_deviations, run_from};
use crate::states::StateVariables;
use ode::{Control, Method};

/// The ratio of the second run's tolerance to that of the run. It is small enough that errors of both rarely agree by
/// chance; with a method of order 8 this costs little.
const TIGHTER: f64 = 0.1;

/// The same if the run's own method has such an order.
const TIGHTER_IF_HIGH: f64 = 0.02;
const HIGH: usize = 8;

/// Least tolerance of a second run; a smaller one may be unattainable because of rounding.
const TIGHTEST: f64 = 3e-15;

/// Ends of both runs closer than this, relative to the time, count as the same.
pub(super) const SAME_TIME: f64 = 1e-9;

/// Factor on the difference, since errors of two methods may have the same sign and agree in part.
const AGREEMENT: f64 = 1.5;

/// Highest order that is visible in an error; beyond it kinks and rounding dominate.
const HIGHEST_SEEN: usize = 8;

/// The order of steps across a kink.
const ACROSS_KINKS: usize = 2;

/// Ratio of shorter fixed steps, used if longer ones fail.
const SHORTER: f64 = 0.5;

/// The second run, and its result.
pub(super) struct Second {
    form: StateVariables,
    /// The ratio of the run's error to the difference between both runs.
    pub factor: f64,
    pub outcome: Outcome,
    /// Its states at the ends of the run's last steps.
    instants: Vec<Instant>,
    /// The evaluations of this run, and of an earlier one that gave no estimate.
    evaluations: u64,
}

impl Second {
    /// Makes the second run. For fixed steps it uses longer ones, which cost less, or shorter ones if the longer do not
    /// confirm the run. The run can be observed.
    pub fn new(run: &Run, outcome: &Outcome, instants: &[Instant], onlooker: &mut dyn RunObserver) -> Second {
        let step = match run.control {
            Control::Adaptive { tolerance } => return by_tolerance(run, outcome, tolerance, instants, onlooker),
            Control::Fixed { step } => step,
        };
        let made = if step < run.t_end { step } else { run.t_end };
        let ratio = match order_seen(run) {
            // a longer step would be cut to the same one
            _ if made > 0.5 * end(run, outcome) => SHORTER,
            1 | 2 => 2.0,
            _ => 1.25,
        };
        let first = by_steps(run, outcome, [made, ratio], onlooker);
        let is_enough = confirmed::reaches(outcome, &first.outcome) && confirmed::until(run, outcome, &first).is_none();
        if is_enough || ratio < 1.0 {
            return first;
        }
        let second = by_steps(run, outcome, [made, SHORTER], onlooker);
        Second { evaluations: first.evaluations + second.evaluations, ..second }
    }

    /// The errors of the run.
    pub fn errors(&self, run: &Run, outcome: &Outcome, instants: &[Instant]) -> Errors {
        let (factor, other) = (self.factor, &self.outcome);
        let difference = |numbers: &[f64], others: &[f64]| factor * difference(numbers, others);
        let gathered = gathered(run, outcome);
        let ends_alike = outcome.stop().map(|stop| stop.kind) == other.stop().map(|stop| stop.kind);
        let times = [outcome, other].map(|outcome| outcome.statistics.time);
        let is_at_event = outcome.ends_at_event() && other.ends_at_event();
        let is_same_time = is_at_event || (times[0] - times[1]).abs() <= SAME_TIME * times[0];
        let is_through_wall = is_through_wall(run, outcome);
        let is_shift_lost = loses_shift(run) && self.form != StateVariables::Deviations;
        let has_std = ends_alike && confirmed::reaches(outcome, other) && !is_shift_lost;
        let is_known = ends_alike && is_same_time && !is_through_wall;
        let state = |numbers: fn(&Outcome) -> &[f64], before: fn(&Instant) -> &[f64]| {
            let last = instants.iter().zip(&self.instants);
            let at_last = last.map(|(one, other)| difference(before(one), before(other)));
            let all = at_last.fold(difference(numbers(outcome), numbers(other)), larger);
            is_known.then(|| all + gathered * largest(numbers(outcome)))
        };
        // the drive and the force may cancel
        let desired = ROUNDINGS * run.model.desired_speed().abs();
        Errors {
            cost: self.evaluations as f64 / outcome.statistics.evaluations as f64,
            std: has_std.then(|| {
                let last = outcome.samples.times.last().copied().unwrap_or(0.0);
                let at_instants = instants.iter().zip(&self.instants).filter(|(one, _)| one.time <= last);
                let instants = at_instants.map(|(one, other)| difference(&[one.std], &[other.std]));
                let all = instants.fold(difference(&outcome.samples.std, &other.samples.std), larger);
                all + gathered * largest(&outcome.samples.std) + self.rounding(run, outcome) + f64::MIN_POSITIVE
            }),
            positions: state(|outcome| &outcome.positions, |instant| &instant.positions)
                .map(|error| error + ROUNDINGS * largest(&outcome.positions)),
            speeds: state(|outcome| &outcome.speeds, |instant| &instant.speeds).map(|error| error + desired),
            events: outcome
                .events
                .iter()
                .map(|event| time_error(event, &other.events).map(|error| factor * error))
                .map(|error| error.filter(|_| !is_through_wall))
                .collect(),
            confirmed_until: confirmed::until(run, outcome, self),
        }
    }

    /// The rounding error of the standard deviation: that of the speeds if they are not stored as deviations; none if
    /// all pedestrians move alike to the last bit and those of the second run do not.
    fn rounding(&self, run: &Run, outcome: &Outcome) -> f64 {
        let shows_all = self.form == StateVariables::Deviations;
        match run.form {
            StateVariables::Deviations => of_headway(run) * largest_std(outcome),
            _ if shows_all && largest_std(outcome) == 0.0 => 0.0,
            _ => ROUNDINGS * largest(&outcome.speeds),
        }
    }
}

/// Fixed steps may cross the wall of a singular force, which no solution does. The time they report is then that at
/// which the steps became too long, and their last state is meaningless.
fn is_through_wall(run: &Run, outcome: &Outcome) -> bool {
    let is_fixed = matches!(run.control, Control::Fixed { .. });
    is_fixed && run.model.is_singular() && outcome.stop().is_some_and(|stop| stop.kind != EventKind::Undefined)
}

/// A run by another method at a smaller tolerance.
fn by_tolerance(
    run: &Run,
    outcome: &Outcome,
    tolerance: f64,
    instants: &[Instant],
    onlooker: &mut dyn RunObserver,
) -> Second {
    let method = if run.method == Method::Dop853 { Method::Verner87 } else { Method::Dop853 };
    let tighter = tolerance * if run.method.order() < HIGH { TIGHTER } else { TIGHTER_IF_HIGH };
    let control = Control::Adaptive { tolerance: if tighter > TIGHTEST { tighter } else { TIGHTEST } };
    let second = Run { method, control, most_steps: most_steps(run, outcome), ..again(run, outcome) };
    made(&second, AGREEMENT, instants, onlooker)
}

/// A run by the same method with steps of `ratio` times the length.
fn by_steps(run: &Run, outcome: &Outcome, [step, ratio]: [f64; 2], onlooker: &mut dyn RunObserver) -> Second {
    let growth = (0..order_seen(run)).fold(1.0, |power: f64, _| power * ratio);
    let second = Run { control: Control::Fixed { step: ratio * step }, ..again(run, outcome) };
    made(&second, CAUTION / (growth - 1.0).abs(), &[], onlooker)
}

fn made(second: &Run, factor: f64, instants: &[Instant], onlooker: &mut dyn RunObserver) -> Second {
    let mut compared = Compared { run: second, first: instants, second: Vec::new(), onlooker };
    let outcome = run_from(second, None, &mut compared).unwrap_or_else(|broken| *broken.outcome);
    let instants = compared.second;
    Second { form: second.form, factor, instants, evaluations: outcome.statistics.evaluations, outcome }
}

/// The same run up to the time that it reached, in deviations if possible.
fn again(run: &Run, outcome: &Outcome) -> Run {
    let is_fixed_series = run.method.needs_series() && matches!(run.control, Control::Fixed { .. });
    let can_deviate = has_deviations(&run.model, run.ring, run.steady_speed) && !is_fixed_series;
    // the same form would not show what becomes of the rounding of the start
    let form = if can_deviate { StateVariables::Deviations } else { run.form };
    Run { t_end: end(run, outcome), form, ..run.clone() }
}

/// A run ends at its last event, which the second one has to find as well; a blow-up is not a suitable end.
fn end(run: &Run, outcome: &Outcome) -> f64 {
    let is_blow_up = outcome.events.iter().any(|happening| happening.kind == EventKind::BlowUp);
    if is_blow_up { run.t_end } else { outcome.last_step }
}

/// The order that the errors of fixed steps show.
fn order_seen(run: &Run) -> usize {
    let seen = if has_kinks(&run.model) { ACROSS_KINKS } else { HIGHEST_SEEN };
    run.method.order().min(seen)
}

/// The second run may take a few times the work of the run, with a minimum for short runs, and much more if the run has
/// lost its shift, and with it all motion.
fn most_steps(run: &Run, outcome: &Outcome) -> u64 {
    const STAGES: u64 = 12;
    const FEW_TIMES: u64 = 4;
    let more = if loses_shift(run) { 30_000 } else { 1000 };
    FEW_TIMES * outcome.statistics.evaluations / STAGES + more
}

/// The rounding error that fixed steps without compensated sums may accumulate: once the motion is steady all roundings
/// have the same sign.
fn gathered(run: &Run, outcome: &Outcome) -> f64 {
    match run.control {
        Control::Fixed { .. } => 0.5 * f64::EPSILON * outcome.statistics.steps as f64,
        Control::Adaptive { .. } => 0.0,
    }
}

/// The largest difference, plus the uncertainty from rounding.
fn difference(numbers: &[f64], others: &[f64]) -> f64 {
    let differences = numbers.iter().zip(others).map(|(number, other)| (number - other).abs());
    differences.fold(ROUNDINGS * largest(numbers), larger)
}

/// The difference between the times of an event in both runs: of the same kind and, if possible, the same pedestrian.
fn time_error(event: &Event, others: &[Event]) -> Option<f64> {
    let same_kind = || others.iter().filter(|other| other.kind == event.kind);
    let same = same_kind().find(|other| other.pedestrian == event.pedestrian).or_else(|| same_kind().next());
    same.map(|other| difference(&[event.time], &[other.time]))
}

/// The larger of two; NaN if there is one.
fn larger(a: f64, b: f64) -> f64 {
    if a >= b || a.is_nan() { a } else { b }
}
