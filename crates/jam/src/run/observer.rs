//! Observers of a run in progress.

use super::{PartialRun, Sample};
use crate::events::{Event, Watch};
use ode::Step;

/// Looks on while a run is made; its numbers do not depend on it.
pub trait RunObserver {
    /// Sees every accepted step of adaptive length; of fixed ones, those that the run needs to see.
    fn after(&mut self, _step: &Step<'_>) {}

    /// Sees the same with what was found in it.
    fn seen(&mut self, _step: &mut Step<'_>, _sight: &mut Sight<'_, '_>) {}

    /// Sees every sample.
    fn sampled(&mut self, _sample: &Sample<'_>) {}

    /// Sees the run every few thousand steps.
    fn between(&mut self, _underway: &PartialRun<'_>) {}

    /// The next time that it has to see the step of, fixed or not. By default there is none.
    fn next_instant(&self) -> f64 {
        f64::INFINITY
    }

    /// Whether the run should end after the last step seen. By default it continues.
    fn is_done(&self) -> bool {
        false
    }

    /// Whether the outcome of the run is judged. Methods that interpolate by evaluations then make some more of them.
    fn judging(&self) -> Judging {
        Judging::No
    }
}

/// Whether the outcome of a run is judged.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Judging {
    /// It is not.
    No,
    /// It is, and the run goes to its end.
    Along,
    /// It is, and the run ends where it is certain.
    UntilCertain,
}

/// A judge is also an observer: it requests the outcome.
impl RunObserver for Judging {
    fn judging(&self) -> Judging {
        *self
    }
}

/// What was found in a step.
#[allow(missing_debug_implementations)]
pub struct Sight<'a, 'w> {
    /// The events in it.
    pub new: &'a [Event],
    /// The watch that found them.
    pub watch: &'a mut Watch<'w>,
    /// The times of the first and the last sample that is taken in it.
    pub samples: Option<[f64; 2]>,
}

/// No observer.
impl RunObserver for () {}

/// Two observers.
impl<A: RunObserver, B: RunObserver> RunObserver for (A, B) {
    fn after(&mut self, step: &Step<'_>) {
        self.0.after(step);
        self.1.after(step);
    }

    fn seen(&mut self, step: &mut Step<'_>, sight: &mut Sight<'_, '_>) {
        self.0.seen(step, sight);
        self.1.seen(step, sight);
    }

    fn sampled(&mut self, sample: &Sample<'_>) {
        self.0.sampled(sample);
        self.1.sampled(sample);
    }

    fn between(&mut self, underway: &PartialRun<'_>) {
        self.0.between(underway);
        self.1.between(underway);
    }

    fn next_instant(&self) -> f64 {
        math::smaller(self.0.next_instant(), self.1.next_instant())
    }

    /// As soon as one of them wants it.
    fn is_done(&self) -> bool {
        self.0.is_done() || self.1.is_done()
    }

    /// As the first of them wants it.
    fn judging(&self) -> Judging {
        self.0.judging()
    }
}

/// Somebody else's looks.
impl<A: RunObserver + ?Sized> RunObserver for &mut A {
    fn after(&mut self, step: &Step<'_>) {
        (**self).after(step);
    }

    fn seen(&mut self, step: &mut Step<'_>, sight: &mut Sight<'_, '_>) {
        (**self).seen(step, sight);
    }

    fn sampled(&mut self, sample: &Sample<'_>) {
        (**self).sampled(sample);
    }

    fn between(&mut self, underway: &PartialRun<'_>) {
        (**self).between(underway);
    }

    fn next_instant(&self) -> f64 {
        (**self).next_instant()
    }

    fn is_done(&self) -> bool {
        (**self).is_done()
    }

    fn judging(&self) -> Judging {
        (**self).judging()
    }
}
