//! Recognises steps near a uniform flow in which no event can occur, from the size of the deviations alone.

use super::Watch;
use crate::states::FlowAlong;
use math::simd::{Kernel, dispatch};
use ode::Step;

/// A flow, and how large the deviations from it are.
#[derive(Clone, Copy, Debug)]
pub(super) struct Near {
    time: f64,
    flow: FlowAlong,
    /// The largest deviation of a gap, of a speed, and of their rates.
    gap: f64,
    speed: f64,
    gap_rate: f64,
    speed_rate: f64,
}

impl Watch<'_> {
    /// Whether no pedestrian can have an event, judged by the largest deviations from a uniform flow.
    pub(super) fn nothing_can_happen(&mut self, step: &Step<'_>) -> bool {
        let before = match self.near {
            Some(near) if near.time == step.start => Some(near),
            _ => self.near(step.start, step.before(), step.rates_before()),
        };
        self.near = self.near(step.end, step.after(), step.rates_after());
        let (Some(before), Some(after)) = (before, self.near) else { return false };
        !step.is_beyond() && are_clear(&before, &after, step.length(), self.bound())
    }

    fn near(&self, time: f64, state: &[f64], rates: &[f64]) -> Option<Near> {
        // effective gaps that are gaps less a constant
        if !self.has_plain_gaps {
            return None;
        }
        let flow = self.form.flow_along(state, rates)?;
        let [state, rates] = [state, rates].map(|row| row.split_at(self.before.gaps.len()));
        let [gap, speed, gap_rate, speed_rate] = dispatch(Sizes([state.0, state.1, rates.0, rates.1]));
        Some(Near { time, flow, gap, speed, gap_rate, speed_rate })
    }
}

/// The largest size in each of four rows, of as many numbers as the first has; not finite where one of these is not.
struct Sizes<'a>([&'a [f64]; 4]);

impl Kernel for Sizes<'_> {
    type Output = [f64; 4];

    /// Sizes are compared as whole numbers: see [`ode::largest`].
    #[inline(always)]
    fn run(self) -> [f64; 4] {
        let [a, b, c, d] = self.0;
        let mut most = [0; 4];
        for (((a, b), c), d) in a.iter().zip(b).zip(c).zip(d) {
            let sizes = [a, b, c, d].map(|value| value.abs().to_bits() as i64);
            for (most, size) in most.iter_mut().zip(sizes) {
                *most = if size > *most { size } else { *most };
            }
        }
        most.map(|size| f64::from_bits(size as u64))
    }
}

/// What rounding may add to a bound.
const ROUNDING: f64 = 1e-9;

/// The bounds of [`super::may_be_negative`], for the largest deviations; false where one is NaN.
fn are_clear(before: &Near, after: &Near, h: f64, blow_up: f64) -> bool {
    let third = h / 3.0;
    let [start, end] = [before.flow, after.flow];
    let gap = third * math::larger(before.gap_rate, after.gap_rate) + math::larger(before.gap, after.gap);
    let speed = third * math::larger(before.speed_rate, after.speed_rate) + math::larger(before.speed, after.speed);
    let speeds =
        [start.speed, start.speed + third * start.acceleration, end.speed - third * end.acceleration, end.speed];
    let [low, high] = [math::smaller, math::larger].map(|choose| speeds.into_iter().fold(start.speed, choose));
    let is_clear = |low: f64, high: f64| low - (high - low) > ROUNDING * high.abs();
    let net_gap = start.net_gap;
    is_clear(net_gap - gap, net_gap + gap) && is_clear(low - speed, high + speed) && high + speed < blow_up
}
