//! What is stored of a run while it is integrated: samples, and the positions of the jams.

use super::{Run, Sample, Samples};
use crate::jams;
use crate::states::RingSystem;
use ode::Step;

/// The jams are followed at the first step that ends no sooner than this after the one before, in units of `tau`: they
/// go a small part of a headway in that time. The times do not depend on the samples.
pub(super) const FOLLOWED_EVERY: f64 = 1.0;

/// The samples under way.
pub(super) struct Record<'a> {
    pub run: &'a Run,
    pub form: &'a dyn RingSystem,
    pub samples: Samples,
    pub positions: Vec<f64>,
    pub spacings: Vec<f64>,
    pub speeds: Vec<f64>,
    pub drift: jams::Drift,
    /// When the jams were looked at last.
    pub followed: f64,
    /// The time at which the leg begins.
    pub begin: f64,
}

impl<'a> Record<'a> {
    pub fn new(run: &'a Run, form: &'a dyn RingSystem) -> Record<'a> {
        let zeros = || vec![0.0; run.ring.pedestrians];
        Record {
            run,
            form,
            samples: Samples::new(if run.keeps_trajectories { run.ring.pedestrians } else { 0 }),
            positions: zeros(),
            spacings: zeros(),
            speeds: zeros(),
            drift: jams::Drift::default(),
            followed: 0.0,
            begin: 0.0,
        }
    }

    /// Takes a sample and returns it.
    pub fn take(&mut self, time: f64, state: &[f64]) -> Sample<'_> {
        let std = self.form.speed_std(state);
        let sample = if self.run.keeps_trajectories {
            self.read(state);
            Sample { time, std, positions: &self.positions, speeds: &self.speeds, spacings: &self.spacings }
        } else {
            Sample { time, std, positions: &[], speeds: &[], spacings: &[] }
        };
        self.samples.push(sample);
        sample
    }

    /// Reads positions, spacings and speeds.
    pub fn read(&mut self, state: &[f64]) {
        self.form.write_positions(state, &mut self.positions);
        self.form.read(state, &mut self.spacings, &mut self.speeds);
    }

    /// Looks where the jams are at time `t`.
    pub fn follow(&mut self, t: f64, state: &[f64]) {
        if !self.run.keeps_trajectories {
            return;
        }
        self.read(state);
        let (desired, length) = (self.run.model.desired_speed(), self.run.ring.length);
        let found = jams::threshold(&self.speeds, desired)
            .map_or(Vec::new(), |threshold| jams::find(&self.positions, &self.speeds, length, threshold));
        self.drift.follow(&found, length, t - self.followed);
        self.followed = t;
    }

    /// Looks where the jams are at a time within a step.
    pub fn follow_to(&mut self, t: f64, step: &mut Step<'_>) {
        let mut state = vec![0.0; step.before().len()];
        step.at(t, &mut state);
        self.follow(t, &state);
    }
}
