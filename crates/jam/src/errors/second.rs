//! A second run, and the error estimate from the difference between both runs. Its force is too strong, by more than
//! constants may be off: else both runs would have the rounding of constants in common.

use super::of_std::{UNSURE, std_error};
use super::recent::{Compared, Instant, Recent, Sort};
use super::{
    CAUTION, Errors, ROUNDINGS, confirmed, largest, largest_speed, largest_std, loses_shift, of_constants, of_headway,
    run_propagated, walked,
};
use crate::events::{Event, EventKind};
use crate::run::{Outcome, Run, RunObserver, has_deviations, run_off};
use crate::states::StateVariables;
use ode::{Control, Method};

/// The ratio of the second run's tolerance to that of the run. It is small enough that errors of both rarely agree by
/// chance; with a method of order 8 this costs little.
const TIGHTER: f64 = 0.1;

/// The same if the run's own method has such an order: `verner87` at 5.8e-11 and `dop853` at a fiftieth of that have
/// the same error (seed 600874 of the hunt).
const TIGHTER_IF_HIGH: f64 = 0.005;
const HIGH: usize = 8;

/// The ratio of the tolerance of a third run to that of the second. A loose one might pass by a blow-up as the run did.
const DECISIVE: f64 = 0.01;

/// The tolerance that the second run of fixed steps starts from: it is made more exact than any of them, since fading
/// motion may leave errors far below those of its beginning.
const ACCURATE: f64 = 1e-12;

/// The tolerance of a run that tells the growth of a small difference alone.
const LOOSE: f64 = 1e-6;

/// Least tolerance of a second run; a smaller one may be unattainable because of rounding.
const TIGHTEST: f64 = 3e-15;

/// Ends of both runs closer than this, relative to the time, count as the same.
pub(super) const SAME_TIME: f64 = 1e-9;

/// In so many steps two runs differ: by Taylor's method at two tolerances, or by two other methods.
const MANY: u64 = 50;

/// Below this the force on a perturbation has all but underflowed: a series from where it is 0 shows nothing of what it
/// is later.
const FAINT: f64 = 1e-200;

/// Below this doubles lose digits to underflow.
const UNDERFLOWN: f64 = 1e-290;

/// Factor on the difference, since errors of two methods may have the same sign: it is right where that of the second
/// run is a third as large, and too cautious by this factor where it is none.
const AGREEMENT: f64 = 1.5;

/// The ratio of what makes the force of the second run too strong to what constants may: of twice that at least as much
/// remains in the difference, whatever the sign of theirs.
const STRONGER: f64 = 2.0;

/// Steps of a run that decides, however short the run is that it decides about.
const MANY_STEPS: u64 = 20_000;

/// The order that is seen in the error of fixed steps where an accurate run costs more than they do: they pass over
/// kinks, or over bends as sharp.
const ORDER_SEEN: usize = 2;

/// The second run, and its result.
pub(super) struct Second {
    form: StateVariables,
    /// The ratio of the run's error to the difference between both runs.
    pub factor: f64,
    /// The part of a number by which roundings that both runs may have in common have gathered.
    gathered: f64,
    pub outcome: Outcome,
    /// The run's states at some instants, and its own.
    instants: [Vec<Instant>; 2],
    /// How fast what falls through 0 does so in each of the run's events, where known.
    rates: Vec<Option<f64>>,
    /// What becomes of the shift, if both runs lose it.
    lost: Option<Errors>,
    /// The evaluations of this run, and of an earlier one that gave no estimate.
    evaluations: u64,
}

impl Second {
    /// Makes the second run. That of fixed steps is an accurate one, which tells their error whatever their order;
    /// where it costs too much, one by steps of half the length. The run can be observed.
    pub fn new(run: &Run, outcome: &Outcome, seen: Option<&Recent>, onlooker: &mut dyn RunObserver) -> Second {
        let instants = seen.map_or(Vec::new(), |seen| seen.instants(run));
        let rates = outcome.events.iter().map(|event| seen.and_then(|seen| seen.rate(event))).collect();
        let made = Second::compared(run, outcome, &instants, onlooker);
        let lost = if made.loses_shift(run) { of_lost_shift(run, outcome, onlooker) } else { None };
        Second { rates, lost, ..made }
    }

    fn compared(run: &Run, outcome: &Outcome, instants: &[Instant], onlooker: &mut dyn RunObserver) -> Second {
        let few = most_steps(run, outcome);
        let step = match run.control {
            Control::Adaptive { tolerance } => return by_tolerance(run, outcome, (tolerance, few), instants, onlooker),
            Control::Fixed { step } => step,
        };
        let tells = |accurate: &Second| {
            let is_refuted = confirmed::refuted_at(run, outcome, &accurate.outcome).is_some();
            is_refuted || is_sure(outcome, &accurate.outcome, end(run, outcome))
        };
        let accurate = by_tolerance(run, outcome, (ACCURATE, few), instants, onlooker);
        if tells(&accurate) {
            return accurate;
        }
        let shorter = by_half_steps(run, outcome, step, instants, onlooker);
        let mut spent = accurate.evaluations + shorter.evaluations;
        // the error of motion that fades too fast or too slowly is no multiple of a difference that leaves no digit
        let is_confirmed = confirmed::until(run, outcome, &shorter).is_none();
        if few < MANY_STEPS && is_confirmed && !leaves_digits(outcome, &shorter.outcome) {
            let patient = by_tolerance(run, outcome, (ACCURATE, MANY_STEPS), instants, onlooker);
            spent += patient.evaluations;
            if tells(&patient) {
                return Second { evaluations: spent, ..patient };
            }
        }
        Second { evaluations: spent, ..shorter }
    }

    /// The errors of the run.
    pub fn errors(&self, run: &Run, outcome: &Outcome) -> Errors {
        let (factor, gathered, other) = (self.factor, self.gathered, &self.outcome);
        let difference = |numbers: &[f64], others: &[f64]| factor * difference(numbers, others);
        let ends_alike = outcome.stop().map(|stop| stop.kind) == other.stop().map(|stop| stop.kind);
        let times = [outcome, other].map(|outcome| outcome.statistics.time);
        let is_at_event = outcome.ends_at_event() && other.ends_at_event();
        let is_same_time = is_at_event || (times[0] - times[1]).abs() <= SAME_TIME * times[0];
        let is_through_wall = is_through_wall(run, outcome);
        let lost = self.lost.as_ref();
        let has_std = ends_alike && confirmed::reaches(outcome, other) && (!self.loses_shift(run) || lost.is_some());
        let of_lost = |number: fn(&Errors) -> Option<f64>| lost.and_then(number);
        let is_known = ends_alike && is_same_time && !is_through_wall && !is_not_finite(run, outcome);
        let late = if is_at_event { factor * (times[0] - times[1]).abs() } else { 0.0 };
        let state = |numbers: fn(&Outcome) -> &[f64], before: fn(&Instant) -> &[f64], rate: f64| {
            let last = self.instants().filter(|(one, _)| one.sort == Sort::Last);
            let at_last = last.map(|(one, other)| difference(before(one), before(other)));
            let at_end = match self.at_event(times[0]).filter(|_| is_at_event) {
                Some((one, other)) => difference(before(one), before(other)),
                // the second run has ended at its event before
                None => rate * late,
            };
            let all = at_last.fold(larger(at_end, difference(numbers(outcome), numbers(other))), larger);
            is_known.then(|| all + gathered * largest(numbers(outcome)))
        };
        let at_event = self.instants[0].iter().find(|one| one.sort == Sort::Event && one.time == times[0]);
        let acceleration = at_event.map_or(0.0, |one| one.acceleration);
        // the drive and the force may cancel
        let desired = ROUNDINGS * run.model.desired_speed().abs();
        // an error of that size may be hidden by the stronger force, which makes as much of a motion that all have in
        // common
        let constants = of_constants(run);
        Errors {
            cost: self.evaluations as f64 / outcome.statistics.evaluations as f64 + lost.map_or(0.0, |lost| lost.cost),
            std: has_std.then(|| {
                let last = outcome.samples.times.last().copied().unwrap_or(0.0);
                let instants = self.instants().filter(|(one, _)| one.time <= last).map(|(one, other)| {
                    let (speeds, others) = (&one.relative_speeds, &other.relative_speeds);
                    let off: Vec<f64> = speeds.iter().zip(others).map(|(speed, other)| speed - other).collect();
                    factor * std_error(speeds, &off, ode::largest(&off))
                });
                let all = instants.fold(difference(&outcome.samples.std, &other.samples.std), larger);
                let rounding = gathered * largest(&outcome.samples.std) + self.rounding(run, outcome);
                all + rounding + of_lost(|lost| lost.std).unwrap_or(0.0) + f64::MIN_POSITIVE
            }),
            positions: state(|outcome| &outcome.positions, |instant| &instant.positions, largest(&outcome.speeds))
                .map(|error| error + ROUNDINGS * largest(&outcome.positions) + constants * walked(run, outcome)),
            speeds: state(|outcome| &outcome.speeds, |instant| &instant.speeds, acceleration)
                .map(|error| error + desired + constants * largest(&outcome.speeds)),
            events: (0..outcome.events.len())
                .map(|index| self.time_error(run, outcome, index).filter(|_| !is_through_wall))
                .collect(),
            confirmed_until: [confirmed::until(run, outcome, self), of_lost(|lost| lost.confirmed_until)]
                .into_iter()
                .flatten()
                .reduce(math::smaller),
        }
    }

    /// Whether the shift is lost in this run as in the run.
    fn loses_shift(&self, run: &Run) -> bool {
        loses_shift(run) && self.form != StateVariables::Deviations
    }

    /// Both runs at each instant.
    fn instants(&self) -> impl Iterator<Item = (&Instant, &Instant)> {
        let [first, second] = &self.instants;
        first.iter().zip(second)
    }

    /// Both runs at the time of an event of the first, if the second comes so far.
    fn at_event(&self, time: f64) -> Option<(&Instant, &Instant)> {
        self.instants().find(|(one, _)| one.sort == Sort::Event && one.time == time)
    }

    /// The error of the time of an event: the difference between both runs; what is not sure of it, since the errors of
    /// both may agree by chance in the one pedestrian at the one time, but not in all; and what the roundings of the
    /// quantity that falls through 0 make of the time. `None` if the other run has no such event, or if the state at
    /// the event is off by a visible part of itself: no estimate follows from such differences.
    fn time_error(&self, run: &Run, outcome: &Outcome, index: usize) -> Option<f64> {
        let event = &outcome.events[index];
        let difference = self.factor * time_difference(event, &self.outcome.events)?;
        let (Some((one, other)), Some(rate)) = (self.at_event(event.time), self.rates[index]) else {
            return Some(difference);
        };
        let off = |numbers: &[f64], others: &[f64]| {
            let all = numbers.iter().zip(others).map(|(number, other)| (number - other).abs());
            self.factor * all.fold(0.0, larger)
        };
        let (spacings, speeds) = (off(&one.spacings, &other.spacings), off(&one.speeds, &other.speeds));
        let desired = run.model.desired_speed().abs();
        let (error, size) = match event.kind {
            EventKind::NegativeSpeed => (speeds, desired),
            EventKind::Overlap => (spacings + slope(run) * speeds, run.ring.headway()),
            _ => (spacings, run.ring.headway()),
        };
        // roundings of fixed steps gather as if drawn by lot
        let steps = match run.control {
            Control::Fixed { .. } => outcome.statistics.steps as f64,
            Control::Adaptive { .. } => 1.0,
        };
        let rounding = (f64::EPSILON * steps.sqrt() + of_headway(run)) * size;
        let is_sure = error <= LARGE * size;
        is_sure.then(|| difference + (UNSURE * error + rounding) / rate.abs())
    }

    /// The rounding error of the standard deviation: that of the speeds if they are not stored as deviations; none if
    /// all pedestrians move alike to the last bit and those of the second run do not.
    fn rounding(&self, run: &Run, outcome: &Outcome) -> f64 {
        let shows_all = self.form == StateVariables::Deviations;
        match run.form {
            StateVariables::Deviations => of_headway(run) * largest_std(outcome),
            _ if shows_all && largest_std(outcome) == 0.0 => 0.0,
            _ => ROUNDINGS * largest_speed(outcome),
        }
    }
}

/// What becomes of a shift that the second run loses as the run does: the steps of Taylor's method carry it along,
/// however small. `None` where they do not, as over kinks, or where the onlooker ends them.
fn of_lost_shift(run: &Run, outcome: &Outcome, onlooker: &mut dyn RunObserver) -> Option<Errors> {
    if run.model.has_kinks() {
        return None;
    }
    let control = Control::Adaptive { tolerance: LOOSE };
    let series = Run { method: Method::Taylor, control, most_steps: most_steps(run, outcome), ..again(run, outcome) };
    // without a judgement, which the onlooker may ask for
    let mut watched = Compared { run: &series, first: &[], second: Vec::new(), onlooker };
    let (made, propagated) = run_propagated(&series, &mut watched);
    let made = made.ok().filter(|made| confirmed::reaches(outcome, made))?;
    let cost = made.statistics.evaluations as f64 / outcome.statistics.evaluations as f64;
    propagated.errors(&series, &made).map(|errors| Errors { cost, ..errors })
}

/// Fixed steps may cross the wall of a singular force, which no solution does. The time they report is then that at
/// which the steps became too long, and their last state is meaningless.
fn is_through_wall(run: &Run, outcome: &Outcome) -> bool {
    let is_fixed = matches!(run.control, Control::Fixed { .. });
    is_fixed && run.model.is_singular() && outcome.stop().is_some_and(|stop| stop.kind != EventKind::Undefined)
}

/// A run by another method at a smaller tolerance, of at most so many steps.
fn by_tolerance(
    run: &Run,
    outcome: &Outcome,
    (tolerance, most_steps): (f64, u64),
    instants: &[Instant],
    onlooker: &mut dyn RunObserver,
) -> Second {
    let mut spent = 0;
    let mut by = |(method, tolerance): (Method, f64)| {
        let control = Control::Adaptive { tolerance: if tolerance > TIGHTEST { tolerance } else { TIGHTEST } };
        let second = Run { method, control, most_steps, ..again(run, outcome) };
        let made = made(&second, AGREEMENT, instants, onlooker);
        spent += made.evaluations;
        Second { evaluations: spent, ..made }
    };
    let (first, last) = methods(run, outcome, tolerance);
    let first = first.map(&mut by).filter(|first| confirmed::reaches(outcome, &first.outcome));
    let second = first.unwrap_or_else(|| by(last));
    let is_broken = second.outcome.stop().is_none() && second.outcome.statistics.time < end(run, outcome);
    match run.control {
        // near the roundings of a steep law the tolerance of the run may be met where a smaller one is not
        Control::Adaptive { .. } if is_broken => by((last.0, tolerance)),
        Control::Adaptive { .. } if is_doubtful(outcome, &second.outcome) => {
            let third = by((third_method(run.method), DECISIVE * last.1));
            let goes_on = third.outcome.stop().is_none() && confirmed::reaches(outcome, &third.outcome);
            if goes_on { third } else { Second { evaluations: third.evaluations, ..second } }
        }
        _ => second,
    }
}

/// Whether the second run ends where the run goes on to its end: in a blow-up, or where the formula has no value. A
/// single step of either may land by chance where the force exceeds all bounds; a third run decides which.
fn is_doubtful(outcome: &Outcome, second: &Outcome) -> bool {
    let ends = |outcome: &Outcome| {
        outcome.stop().is_some_and(|stop| matches!(stop.kind, EventKind::BlowUp | EventKind::Undefined))
    };
    outcome.stop().is_none() && ends(second)
}

/// A method that neither the run has nor, by [`methods`], the second one.
fn third_method(method: Method) -> Method {
    if matches!(method, Method::Dop853 | Method::Verner87) { Method::Verner98 } else { Method::Verner87 }
}

/// The method and the tolerance of a second run; the second of them where the first does not come to the end.
fn methods(run: &Run, outcome: &Outcome, tolerance: f64) -> (Option<(Method, f64)>, (Method, f64)) {
    let tighter = tolerance * if run.method.order() < HIGH { TIGHTER } else { TIGHTER_IF_HIGH };
    let is_short = outcome.statistics.steps < MANY;
    if run.method == Method::Taylor && run.model.has_kinks() {
        // a few steps may be the same for both tolerances; where there are more, dop853 stumbles over each kink
        return (is_short.then_some((Method::Dop853, tighter)), (Method::Taylor, tighter));
    }
    let usual = if run.method == Method::Dop853 { Method::Verner87 } else { Method::Dop853 };
    let has_series = run.method != Method::Taylor;
    let is_faint = outcome.samples.len() > 1 && largest_std(outcome) < FAINT;
    // the error of a few steps by Taylor's method is near the tolerance, where that of others is far below it
    let of_series = match run.control {
        Control::Adaptive { .. } => TIGHTEST,
        Control::Fixed { .. } => tighter,
    };
    let series = match run.model.has_kinks() {
        _ if !has_series => None,
        // methods whose steps pass over kinks may err alike there
        true => Some((Method::Taylor, tighter)),
        // and so may a few steps over a bend, or within them
        false if is_short && !is_faint => Some((Method::Taylor, of_series)),
        false => None,
    };
    (series, (usual, tighter))
}

/// Whether the deviations of a perturbed ring are too small for doubles: a series from where the force underflows is 0,
/// and so is all that it leaves out.
pub(super) fn is_underflown(run: &Run, outcome: &Outcome) -> bool {
    let is_perturbed = run.start.shift != 0.0 || run.displacements.iter().any(|by| *by != 0.0);
    let is_moving = outcome.samples.len() > 1 && is_perturbed;
    is_moving && run.form == StateVariables::Deviations && largest_std(outcome) < UNDERFLOWN
}

/// Whether an accurate run tells the errors of fixed steps: it has come to its end, and to the same one if those
/// stopped.
fn is_sure(outcome: &Outcome, accurate: &Outcome, end: f64) -> bool {
    let [stop, other] = [outcome, accurate].map(|outcome| outcome.stop().map(|stop| stop.kind));
    let is_whole = other.is_some() || accurate.statistics.time >= end;
    is_whole && (stop.is_none() || stop == other && confirmed::reaches(outcome, accurate))
}

/// Whether two standard deviations differ by a part of themselves at all samples of both.
fn leaves_digits(outcome: &Outcome, other: &Outcome) -> bool {
    let mut pairs = outcome.samples.std.iter().zip(&other.samples.std);
    pairs.all(|(one, other)| (one - other).abs() <= LARGE * math::larger(*one, *other))
}

/// A run by the same method with steps of half the length.
fn by_half_steps(
    run: &Run,
    outcome: &Outcome,
    step: f64,
    instants: &[Instant],
    onlooker: &mut dyn RunObserver,
) -> Second {
    let remaining = (0..run.method.order().min(ORDER_SEEN)).fold(1.0, |remaining, _| 0.5 * remaining);
    // a step longer than the run is cut to it
    let step = 0.5 * if step < run.t_end { step } else { run.t_end };
    let second = Run { control: Control::Fixed { step }, ..again(run, outcome) };
    // within its steps a method of low order is less exact than at their ends
    let at_events: Vec<Instant> = instants.iter().filter(|instant| instant.sort != Sort::Last).cloned().collect();
    // without compensated sums; once the motion is steady all roundings have the same sign
    let gathered = 0.5 * f64::EPSILON * outcome.statistics.steps as f64;
    Second { gathered, ..made(&second, CAUTION / (1.0 - remaining), &at_events, onlooker) }
}

fn made(second: &Run, factor: f64, instants: &[Instant], onlooker: &mut dyn RunObserver) -> Second {
    let mut compared = Compared { run: second, first: instants, second: Vec::new(), onlooker };
    let off = STRONGER * of_constants(second);
    let outcome = run_off(second, off, None, &mut compared).unwrap_or_else(|broken| *broken.outcome);
    let instants = [instants.to_vec(), compared.second];
    let (form, evaluations) = (second.form, outcome.statistics.evaluations);
    Second { form, factor, gathered: 0.0, instants, rates: Vec::new(), lost: None, evaluations, outcome }
}

/// The same run up to the time that it reached: in deviations if possible, and not in positions, whose roundings at the
/// start both would have in common.
fn again(run: &Run, outcome: &Outcome) -> Run {
    let is_fixed_series = run.method.needs_series() && matches!(run.control, Control::Fixed { .. });
    let can_deviate = has_deviations(&run.model, run.ring, run.steady_speed) && !is_fixed_series;
    let form = match run.form {
        _ if can_deviate => StateVariables::Deviations,
        StateVariables::Positions => StateVariables::Spacings,
        form => form,
    };
    Run { t_end: end(run, outcome), form, ..run.clone() }
}

/// A run ends with the step in which it finds its last event, which the second one has to find as well: up to a little
/// later, where its overlap may be. A blow-up is not a suitable end, and whether the formula has no value there only a
/// run that goes on can tell.
fn end(run: &Run, outcome: &Outcome) -> f64 {
    if is_singular_end(outcome) {
        return run.t_end;
    }
    let late = outcome.stop().map_or(0.0, |stop| (1.0 + LARGE) * stop.time);
    math::smaller(run.t_end, math::larger(outcome.last_step, late))
}

/// Whether it ends in a blow-up, or where the formula has no value.
fn is_singular_end(outcome: &Outcome) -> bool {
    outcome.events.iter().any(|event| matches!(event.kind, EventKind::BlowUp | EventKind::Undefined))
}

/// The second run may take a few times the work of the run, with a minimum for short runs, and much more if the run has
/// lost its shift, and with it all motion. For fixed steps there is another way if it takes more than they do.
fn most_steps(run: &Run, outcome: &Outcome) -> u64 {
    const STAGES: u64 = 12;
    const FEW_TIMES: u64 = 4;
    let like_run = outcome.statistics.evaluations / STAGES;
    match run.control {
        _ if loses_shift(run) => FEW_TIMES * like_run + 30_000,
        // steps over a bend that is too sharp for them blow up, and so do those of half the length
        Control::Fixed { .. } if !is_singular_end(outcome) => like_run + 50,
        _ => FEW_TIMES * like_run + MANY_STEPS,
    }
}

/// The largest difference, plus the uncertainty from rounding.
fn difference(numbers: &[f64], others: &[f64]) -> f64 {
    let differences = numbers.iter().zip(others).map(|(number, other)| (number - other).abs());
    differences.fold(ROUNDINGS * largest(numbers), larger)
}

/// The difference between the times of an event in both runs: of the same kind and, if possible, the same pedestrian.
fn time_difference(event: &Event, others: &[Event]) -> Option<f64> {
    let same_kind = || others.iter().filter(|other| other.kind == event.kind);
    let same = same_kind().find(|other| other.pedestrian == event.pedestrian).or_else(|| same_kind().next());
    same.map(|other| difference(&[event.time], &[other.time]))
}

/// How fast the room taken by a pedestrian grows with the speeds.
fn slope(run: &Run) -> f64 {
    let headway = run.ring.headway();
    (run.model.effective_gap(headway, 0.0, 0.0) - run.model.effective_gap(headway, 1.0, 1.0)).abs()
}

/// Whether fixed steps broke off where the state ceased to be finite: the steps before were too long for it, too.
fn is_not_finite(run: &Run, outcome: &Outcome) -> bool {
    let is_fixed = matches!(run.control, Control::Fixed { .. });
    is_fixed && outcome.stop().is_none() && outcome.statistics.time < (1.0 - SAME_TIME) * run.t_end
}

/// A part of the headway, of the desired speed, or of the time of an event, that is no small error.
pub(super) const LARGE: f64 = 0.1;

/// The larger of two; NaN if there is one.
fn larger(a: f64, b: f64) -> f64 {
    if a >= b || a.is_nan() { a } else { b }
}
