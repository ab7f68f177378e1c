//! Tests whether a state repeats itself, shifted along the ring. If so, it will do so for ever.

use crate::events::Watch;
use ode::Step;

/// A state is compared with one at least so much earlier, in units of `tau`: what changes at a rate of 1e-4 differs by
/// 1 %.
const APART: f64 = 100.0;

/// Repetitions in a row.
const TIMES: u32 = 2;

/// States that differ by no more than this part of the desired speed are the same.
const SAME: f64 = 1e-6;

/// And by no more than this part of the contrast of speeds, so that weak waves that still change are not taken for
/// lasting.
const SAME_OF_CONTRAST: f64 = 1e-4;

/// A shifted state whose speeds differ by more than this part of the contrast, on the average, is not looked at
/// closely.
const ALIKE: f64 = 0.05;

/// Looks for repetitions.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Repeats {
    pub(super) reference: Option<Reference>,
    /// How often the state has repeated itself in a row.
    pub(super) times: u32,
}

/// A state to compare with: at one instant, and where one of them goes through a speed.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Reference {
    pub(super) time: f64,
    pub(super) gaps: Vec<f64>,
    pub(super) speeds: Vec<f64>,
    /// Who speeds up most.
    pub(super) pedestrian: usize,
}

/// A repetition: after a time `period` the pattern is shifted by `shift` pedestrians, up to whole rounds.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Repetition {
    pub(super) period: f64,
    pub(super) shift: f64,
}

impl Repeats {
    /// Looks at a step; returns the last repetition once there were enough in a row.
    pub(super) fn look(
        &mut self,
        watch: &mut Watch<'_>,
        step: &mut Step<'_>,
        contrast: f64,
        scale: f64,
    ) -> Option<Repetition> {
        let Some(reference) = &self.reference else {
            self.reference = Some(Reference::at_end(watch, step.end));
            return None;
        };
        let since = step.end - reference.time;
        if since < APART {
            return None;
        }
        if since > 2.0 * APART {
            self.times = 0;
            self.reference = Some(Reference::at_end(watch, step.end));
            return None;
        }
        let bound = math::smaller(SAME * scale, SAME_OF_CONTRAST * contrast);
        let repetition = reference.again(watch, step, contrast, bound)?;
        self.times += 1;
        self.reference = Some(Reference::at_end(watch, step.end));
        (self.times >= TIMES).then_some(repetition)
    }
}

impl Reference {
    fn at_end(watch: &Watch<'_>, time: f64) -> Reference {
        let now = watch.after();
        let steepest = now.speed_rates.iter().enumerate();
        let (pedestrian, _) =
            steepest.fold((0, f64::NEG_INFINITY), |most, (n, &rate)| if rate > most.1 { (n, rate) } else { most });
        Reference { time, gaps: now.gaps.clone(), speeds: now.speeds.clone(), pedestrian }
    }

    /// Whether the state recurs within the step: when a pedestrian passes through the speed of the reference
    /// pedestrian.
    fn again(&self, watch: &mut Watch<'_>, step: &mut Step<'_>, contrast: f64, bound: f64) -> Option<Repetition> {
        let (level, count) = (self.speeds[self.pedestrian], self.speeds.len());
        for other in 0..count {
            let (before, after) = (watch.before().speeds[other], watch.after().speeds[other]);
            if !(before < level && level <= after) {
                continue;
            }
            let shift = (other + count - self.pedestrian) % count;
            if mean_difference(&self.speeds, &watch.after().speeds, shift) > ALIKE * contrast {
                continue;
            }
            let theta = crossing(watch, step, other, level);
            let now = watch.within(step, theta);
            let differs = largest_difference(&self.speeds, &now.speeds, shift) > bound
                || largest_difference(&self.gaps, &now.gaps, shift) > bound;
            if !differs {
                let period = (step.start + theta * step.length()) - self.time;
                return Some(Repetition { period, shift: shift as f64 });
            }
        }
        None
    }
}

/// The fraction of the step at which a pedestrian's rising speed goes through a level: regula falsi, the stale end
/// halved (Illinois).
fn crossing(watch: &mut Watch<'_>, step: &mut Step<'_>, pedestrian: usize, level: f64) -> f64 {
    const ROUNDS: u32 = 12;
    let (mut low, mut high) = (0.0, 1.0);
    let mut below = watch.before().speeds[pedestrian] - level;
    let mut above = watch.after().speeds[pedestrian] - level;
    let mut theta = 1.0;
    let mut last = 0;
    for _ in 0..ROUNDS {
        if above - below <= 0.0 {
            break;
        }
        theta = (low * above - high * below) / (above - below);
        let value = watch.within(step, theta).speeds[pedestrian] - level;
        if value.abs() < 1e-14 * (1.0 + level.abs()) {
            break;
        }
        if value < 0.0 {
            (low, below) = (theta, value);
            above = if last == -1 { 0.5 * above } else { above };
            last = -1;
        } else {
            (high, above) = (theta, value);
            below = if last == 1 { 0.5 * below } else { below };
            last = 1;
        }
    }
    theta
}

fn mean_difference(earlier: &[f64], now: &[f64], shift: usize) -> f64 {
    pairs(earlier, now, shift).map(|(a, b)| (a - b).abs()).sum::<f64>() / earlier.len() as f64
}

fn largest_difference(earlier: &[f64], now: &[f64], shift: usize) -> f64 {
    pairs(earlier, now, shift)
        .fold(0.0, |largest, (a, b)| if (a - b).abs() <= largest { largest } else { (a - b).abs() })
}

/// The numbers of an earlier state, each beside that of the pedestrian `shift` further on now.
fn pairs<'a>(earlier: &'a [f64], now: &'a [f64], shift: usize) -> impl Iterator<Item = (f64, f64)> + 'a {
    let count = earlier.len();
    let shifted = now[shift..].iter().chain(&now[..shift]);
    earlier.iter().copied().zip(shifted.copied()).take(count)
}
