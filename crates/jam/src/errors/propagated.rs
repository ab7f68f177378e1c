//! Error estimates for Taylor's method: each step estimates its own error, and the linearised equations propagate these
//! errors along the run ([`ode::Shadow`]).
//!
//! Some runs by this method need a second run like those by other methods ([`super::errors`]): those with fixed steps,
//! whose rounding errors are not estimated; those of laws with kinks, which a step may cross unnoticed; those whose
//! errors change much faster than the solution, if the law does not provide its linearised equations; and those resumed
//! from a checkpoint, which does not store the errors before it.

use super::confirmed::last_before;
use super::of_std::{UNSURE, std_error};
use super::recent::Recent;
use super::{
    Errors, ROUNDINGS, THROWN, largest, largest_speed, largest_std, loses_shift, of_constants, of_headway, of_spacings,
    unseen, walked,
};
use crate::events::{Event, EventKind};
use crate::run::{Outcome, Run, RunObserver, Sight};
use crate::states::StateVariables;
use ode::{Shadow, Step};

/// Observes a run from its start, and returns the errors at its end if the steps estimate theirs.
#[derive(Clone, Debug)]
pub struct Propagated {
    pedestrians: usize,
    /// Everybody's clearance in the uniform flow, and what the start adds to it.
    clearance: f64,
    added: Vec<f64>,
    headway: f64,
    /// The size of the desired speed.
    desired: f64,
    /// The part of its size by which what falls through 0 in an event is rounded.
    rounding: f64,
    /// The part by which rounded constants change the force.
    constants: f64,
    /// Whether the force has walls.
    is_singular: bool,
    /// Whether spacings lose the shift.
    loses_shift: bool,
    shadow: Option<Shadow>,
    /// The growth of a shift that is lost in the rounding of the spacings. All pedestrians then move alike, as are the
    /// errors of steps, in which so small a difference would be lost again.
    lost: Option<Shadow>,
    /// Whether a step gave no error estimate.
    is_blind: bool,
    /// The largest error of the standard deviation so far.
    std: f64,
    /// How large the errors of speeds were when that was looked at last, and how many steps ago.
    looked_at: f64,
    since: u32,
    /// How large they are at both ends of the step, and when that was. Where they fade, samples within the step have
    /// larger ones than its end.
    sizes: [f64; 2],
    sized_at: f64,
    /// Whether they are larger at the start of the step than at its end and when that was looked at last.
    fades: bool,
    /// The moment that determines the time of a blow-up best.
    last_known: Option<LastKnown>,
    /// The time at which the run ends.
    t_end: f64,
    /// Of the times of events within steps.
    events: Vec<f64>,
    /// The time at which a shift that spacings lose would have become a visible part of them.
    shows: Option<f64>,
    /// The last steps without error estimates.
    recent: Recent,
}

/// A moment before a blow-up at which the error was a small part of the state.
#[derive(Clone, Copy, Debug)]
struct LastKnown {
    time: f64,
    /// How late the run was, and the part of speeds that their errors were.
    late: f64,
    part: f64,
    /// How late the blow-up may be, about.
    guess: f64,
}

/// A shift that has grown to this part of the clearance is no small difference any more.
const VISIBLE: f64 = 0.1;

/// Larger parts of the state do not follow linearised equations.
const SMALL: f64 = 1e-3;

/// Interval, in steps, at which the error of the standard deviation is examined, while the errors of speeds have not
/// grown by more than this factor since.
const EVERY: u32 = 4;
const GROWN: f64 = 1.1;

/// The first order left out is not all that a step leaves out.
const CAUTION: f64 = 2.0;

/// What a difference of two forces does not show, as a part of them and of the difference of their states.
const UNSEEN: f64 = 1e-6;

/// The larger one of an error of the standard deviation and that of these speeds, of which `most` is the largest error.
fn larger_std(so_far: f64, speeds: &[f64], errors: &[f64], most: f64) -> f64 {
    // no standard deviation is off by more than all of its numbers
    let may_be_larger = (1.0 + UNSURE) * most > so_far;
    if !may_be_larger {
        return so_far;
    }
    // what they differ by is carried in single precision
    let digits = f64::from(f32::EPSILON) * most;
    math::larger(so_far, std_error(speeds, errors, most) + digits)
}

impl RunObserver for Propagated {
    fn seen(&mut self, step: &mut Step<'_>, sight: &mut Sight<'_, '_>) {
        self.recent.push_events(step, sight);
        if self.is_blind || !self.follow(step) {
            self.is_blind = true;
            self.recent.push(step);
            return;
        }
        self.remember(step);
        let samples = sight.samples.filter(|_| self.is_worth_looking(step, sight));
        if samples.is_none() && sight.new.is_empty() {
            return;
        }
        if let Some([first, last]) = samples {
            if self.fades && self.lost.is_none() {
                self.look_at(step, first);
            }
            self.look(step, last, sight.new.is_empty());
        }
        if sight.new.is_empty() {
            return;
        }
        let dimension = step.after().len();
        let (mut state, mut rates) = (vec![0.0; dimension], vec![0.0; dimension]);
        for event in sight.new {
            let place = step.fraction(event.time);
            let known = self.last_known.filter(|_| event.kind == EventKind::BlowUp);
            if let Some(known) = known {
                self.events.push(known.late + known.part * (event.time - known.time));
                continue;
            }
            let error = self.error_at(Some((step, place)));
            step.at_fraction(place, &mut state);
            step.rates_of(&state, &mut rates);
            let mut change =
                |direction: &[f64]| sight.watch.change(event.kind, event.pedestrian, &state, direction).abs();
            let (by_error, rate) = (change(&error), change(&rates));
            // what falls through 0 is a difference of larger numbers
            let n = self.pedestrians;
            let (size, errors) = match event.kind {
                EventKind::NegativeSpeed => (self.desired, &error[n..2 * n]),
                _ => (self.headway, &error[..n]),
            };
            self.events.push((by_error + UNSURE * ode::largest(errors) + self.rounding * size) / rate);
        }
    }
}

impl Propagated {
    /// Looks at the error of the standard deviation at a time within a step.
    fn look_at(&mut self, step: &mut Step<'_>, time: f64) {
        let (n, place) = (self.pedestrians, step.fraction(time));
        let Some((shadow, before)) = self.shadow.as_ref().and_then(|shadow| Some((shadow, shadow.before()?))) else {
            return;
        };
        let (mut state, mut error) = (step.before().to_vec(), before.to_vec());
        if place > 0.0 {
            step.at_fraction(place, &mut state);
            shadow.at(step, place, &mut error);
        }
        let errors = &error[n..2 * n];
        let most = ode::largest(errors);
        self.looked_at = math::larger(self.looked_at, most);
        self.std = larger_std(self.std, &state[n..2 * n], errors, most);
    }

    /// Looks at the error of the standard deviation in a step with samples: at its end, where the state and the error
    /// are known, or at the last sample of one that an event ends.
    fn look(&mut self, step: &mut Step<'_>, last: f64, is_whole: bool) {
        let n = self.pedestrians;
        let (mut state, mut error);
        // where the perturbation is lost all errors but its own are alike
        let Some(shadow) = self.lost.as_ref().or(self.shadow.as_ref()) else { return };
        let known = shadow.after().filter(|_| is_whole && self.lost.is_none());
        let (speeds, errors, most) = match known {
            Some(errors) => (&step.after()[n..2 * n], &errors[n..2 * n], self.sizes[1]),
            None => {
                let place = if is_whole { 1.0 } else { step.fraction(last) };
                (state, error) = (vec![0.0; shadow.dimension()], vec![0.0; shadow.dimension()]);
                shadow.at(step, place, &mut error);
                if self.lost.is_none() {
                    step.at_fraction(place, &mut state);
                }
                (&state[n..2 * n], &error[n..2 * n], ode::largest(&error[n..2 * n]))
            }
        };
        self.std = larger_std(self.std, speeds, errors, most);
    }

    /// Before the first step. A step over a kink does not see what it leaves out.
    pub fn new(run: &Run) -> Propagated {
        let clearance = run.ring.headway() - run.model.contact();
        Propagated {
            pedestrians: run.ring.pedestrians,
            clearance,
            added: of_spacings(run),
            headway: run.ring.headway(),
            rounding: f64::EPSILON + of_headway(run),
            constants: of_constants(run),
            is_singular: run.model.is_singular(),
            desired: run.model.desired_speed().abs(),
            loses_shift: loses_shift(run),
            shadow: None,
            lost: None,
            is_blind: !run.method.needs_series() || run.model.has_kinks(),
            std: 0.0,
            looked_at: 0.0,
            since: 0,
            sizes: [0.0; 2],
            sized_at: 0.0,
            fades: false,
            last_known: None,
            t_end: run.t_end,
            events: Vec::new(),
            shows: None,
            recent: Recent::default(),
        }
    }

    /// Follows a step; false if the step gives no error estimate, or its error cannot be propagated.
    fn follow(&mut self, step: &mut Step<'_>) -> bool {
        let (n, dimension) = (self.pedestrians, step.after().len());
        if self.shadow.is_none() {
            let error = self.of_start(step.before());
            self.lost = self.loses_shift.then(|| Shadow::new(error.clone()));
            self.shadow = Some(Shadow::new(if self.loses_shift { vec![0.0; dimension] } else { error }));
        }
        if self.shadow.as_ref().is_some_and(|shadow| shadow.dimension() != dimension) {
            self.shadow = Some(Shadow::new(in_gaps(&self.error_at(None), n)));
        }
        if self.lost.is_some() && !is_uniform(step.before(), n) {
            (self.shadow, self.lost) = (Some(Shadow::new(self.error_at(None))), None);
        }
        if let Some(lost) = &mut self.lost {
            lost.carry(step);
            let limit = VISIBLE * self.clearance;
            let is_seen = lost.after().is_some_and(|lost| largest(&lost[..n]) > limit);
            if is_seen && self.shows.is_none() {
                self.shows = Some(time_of(lost, step, n, limit));
            }
        }
        // deviations are rounded as parts of themselves, equal motion alike; else drive, speed and force each are
        let is_in_gaps = dimension == 2 * n + 1;
        let rounding = if is_in_gaps && self.lost.is_none() { f64::EPSILON * self.desired } else { 0.0 };
        let is_sure = self.lost.as_ref().is_none_or(Shadow::is_sure);
        is_sure
            && self
                .shadow
                .as_mut()
                .is_some_and(|shadow| shadow.follow(step, rounding, self.constants) && shadow.is_sure())
    }

    /// Whether the error of the standard deviation may be larger in this step than it was.
    fn is_worth_looking(&mut self, step: &Step<'_>, sight: &Sight<'_, '_>) -> bool {
        let n = self.pedestrians;
        let shadow = self.lost.as_ref().or(self.shadow.as_ref());
        let (before, after) = (shadow.and_then(Shadow::before), shadow.and_then(Shadow::after));
        let Some((before, after)) = before.zip(after) else { return true };
        let is_known = self.sized_at == step.start;
        let start = if is_known { self.sizes[1] } else { ode::largest(&before[n..2 * n]) };
        let end = ode::largest(&after[n..2 * n]);
        (self.sizes, self.sized_at) = ([start, end], step.end);
        let most = math::larger(start, end);
        self.since += 1;
        let is_worth =
            most > GROWN * self.looked_at || self.since >= EVERY || step.end >= self.t_end || !sight.new.is_empty();
        if is_worth {
            self.fades = start > GROWN * math::larger(end, self.looked_at);
            (self.since, self.looked_at) = (0, end);
        }
        is_worth
    }

    /// Stores the error of the time of an approaching blow-up, once a pedestrian has been thrown back, from the moment
    /// that determines it best. Later the error is as large as the state, but then there is hardly any time left for it
    /// to matter.
    fn remember(&mut self, step: &Step<'_>) {
        let (n, state) = (self.pedestrians, step.after());
        let Some(shadow) = self.shadow.as_ref().filter(|_| self.is_singular && state.len() == 2 * n + 1) else {
            return;
        };
        let fastest = ode::largest(&state[n..2 * n]);
        if fastest < THROWN * self.desired {
            return;
        }
        let (Some(error), rates) = (shadow.after(), step.rates_after()) else { return };
        let part = ode::largest(&error[n..2 * n]) / fastest;
        let late = ode::largest(&error[..n]) / ode::largest(&rates[..n]);
        // speeds double at every throw: the end is about as near as the ring is long over the largest
        let guess = late + part * (self.headway * n as f64 / fastest);
        if part < SMALL && self.last_known.is_none_or(|known| guess <= known.guess) {
            self.last_known = Some(LastKnown { time: step.end, late, part, guess });
        }
    }

    /// The error at a fraction of the step looked at last, or at its end.
    fn error_at(&self, mut place: Option<(&mut Step<'_>, f64)>) -> Vec<f64> {
        let mut at = |shadow: &Shadow| {
            let mut error = vec![0.0; shadow.dimension()];
            match &mut place {
                Some((step, place)) => shadow.at(step, *place, &mut error),
                None => shadow.at_end(&mut error),
            }
            error
        };
        let mut all = self.shadow.as_ref().map_or(Vec::new(), &mut at);
        if let Some(lost) = &self.lost {
            all.iter_mut().zip(at(lost)).for_each(|(all, lost)| *all += lost);
        }
        all
    }

    /// The rounding error of the start: none for deviations; for spacings their exact difference.
    fn of_start(&self, state: &[f64]) -> Vec<f64> {
        let (n, mut error) = (self.pedestrians, vec![0.0; state.len()]);
        if state.len() == 2 * n + 1 {
            for ((error, spacing), added) in error.iter_mut().zip(&state[..n]).zip(&self.added) {
                // exact if the larger of the two is subtracted first
                let [large, small] =
                    if added.abs() > self.clearance { [*added, self.clearance] } else { [self.clearance, *added] };
                *error = (spacing - large) - small;
            }
        }
        error
    }

    /// The run at the instants at which a second one is compared with it.
    pub(super) fn recent(&self) -> &Recent {
        &self.recent
    }

    /// The errors of the run that it has seen; `None` where the steps gave no estimate, or none for an event.
    pub fn errors(&self, run: &Run, outcome: &Outcome) -> Option<Errors> {
        // next to a blow-up the error leaves the doubles before the speeds do: a second run tells the time
        let is_told = self.events.iter().all(|error| error.is_finite());
        let error = (!self.is_blind && is_told && self.shadow.is_some()).then(|| self.error_at(None))?;
        let n = self.pedestrians;
        // deviations have the speed of the uniform flow, too
        let (spacings, flow) = (&error[..n], error.get(2 * n + 2).copied().unwrap_or(0.0));
        let speeds: Vec<f64> = error[n..2 * n].iter().map(|error| error + flow).collect();
        let first: f64 = error[2 * n..].iter().take(2).sum();
        let positions: Vec<f64> = std::iter::once(&first)
            .chain(spacings)
            .scan(0.0, |position, more| {
                *position += more;
                Some(*position)
            })
            .take(n)
            .collect();
        let rounding = |numbers: &[f64]| ROUNDINGS * largest(numbers);
        let unseen = unseen(run, outcome);
        let is_unseen = self.lost.is_none() && unseen.is_some();
        let of_std = match run.form {
            StateVariables::Deviations => (ROUNDINGS + of_headway(run)) * largest_std(outcome),
            // where all motion is one, no rounding lies between speeds; but a weak force goes unseen beside the drive
            _ if self.lost.is_some() && largest_std(outcome) == 0.0 => {
                UNSEEN * run.model.desired_speed().abs() * largest(&self.added) / self.clearance.abs()
            }
            // roundings of earlier steps are carried along
            _ => unseen.unwrap_or_else(|| f64::EPSILON * largest_speed(outcome)),
        };
        // the steps take forces for too strong by this part; if they are too weak, that may have hidden as much of an
        // error
        let hidden = CAUTION * self.constants;
        // at a blow-up a rounding of the time is a large part of the state
        let is_blow_up = outcome.events.iter().any(|event| event.kind == EventKind::BlowUp);
        let end =
            |errors: &[f64], numbers: &[f64]| (!is_blow_up).then(|| CAUTION * largest(errors) + rounding(numbers));
        Some(Errors {
            std: Some(if is_unseen { of_std } else { CAUTION * self.std + of_std } + f64::MIN_POSITIVE),
            positions: end(&positions, &outcome.positions)
                .map(|error| error + 2.0 * rounding(&outcome.positions) + RELAXATION * UNSURE * largest(&speeds))
                .map(|error| error + hidden * walked(run, outcome)),
            speeds: end(&speeds, &outcome.speeds)
                .map(|error| error + ROUNDINGS * run.model.desired_speed().abs() + hidden * largest(&outcome.speeds)),
            events: self.of_events(&outcome.events),
            cost: 0.0,
            confirmed_until: self.shows.map(|time| last_before(outcome, time)),
        })
    }

    /// Events at the start are exact; that a run has come to a wall is no event of a step.
    fn of_events(&self, events: &[Event]) -> Vec<Option<f64>> {
        let mut of_steps = self.events.iter();
        let error = |event: &Event| match event.time {
            0.0 => Some(0.0),
            time => of_steps.next().map(|error| CAUTION * error + ROUNDINGS * time),
        };
        events.iter().map(error).collect()
    }
}

/// The time in a step at which a difference in spacings grows beyond this.
fn time_of(shadow: &Shadow, step: &mut Step<'_>, n: usize, limit: f64) -> f64 {
    let (mut before, mut past, mut error) = (0.0, 1.0, vec![0.0; shadow.dimension()]);
    while past - before > FINE {
        let middle = 0.5 * (before + past);
        shadow.at(step, middle, &mut error);
        if largest(&error[..n]) > limit { past = middle } else { before = middle }
    }
    step.start + before * step.length()
}

/// The part of a step to which that is sought.
const FINE: f64 = 1e-3;

/// Whether all pedestrians have the same spacing and the same speed, to the last bit, in a state of spacings.
fn is_uniform(state: &[f64], n: usize) -> bool {
    let (spacings, speeds) = (&state[..n], &state[n..2 * n]);
    state.len() == 2 * n + 1 && spacings.iter().all(|s| *s == spacings[0]) && speeds.iter().all(|v| *v == speeds[0])
}

/// An error in deviations as one in spacings and speeds.
fn in_gaps(error: &[f64], n: usize) -> Vec<f64> {
    let mut gaps = error[..2 * n + 1].to_vec();
    gaps[n..2 * n].iter_mut().for_each(|speed| *speed += error[2 * n + 2]);
    gaps[2 * n] += error[2 * n + 1];
    gaps
}

/// What is not sure of speeds becomes an error of positions within a relaxation time.
const RELAXATION: f64 = 1.0;
