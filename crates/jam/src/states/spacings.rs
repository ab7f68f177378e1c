//! Spacings and speeds, `[s_0 - s_c .. s_{N-1} - s_c, v_0 .. v_{N-1}, x_0]`, with the spacing `s_c` at contact (2, or 0
//! for the logarithmic law). A gap that closes keeps all its digits.

use super::{LEAST_SIZE, RingSystem, closing_rates, displace, relaxation_rate, strengthen, tangent};
use crate::force::{Flow, Force, Motion, Rows};
use crate::ring::{Ring, Start};
use ode::{Group, MeanTangent, Measure, System, Tangent, TangentEnds};
use std::ops::Range;

/// The ring as gaps and speeds.
#[derive(Debug)]
pub struct Spacings {
    force: Box<dyn Force>,
    pedestrians: usize,
    clearance: f64,
    /// The part by which the force is too strong.
    off: f64,
}

impl Spacings {
    /// The ring under this force.
    pub fn new(force: Box<dyn Force>, ring: Ring) -> Spacings {
        let clearance = ring.headway() - force.contact();
        Spacings { force, pedestrians: ring.pedestrians, clearance, off: 0.0 }
    }

    /// The same with a force that its rates have too strong by this part of itself.
    pub(super) fn off_by(self, off: f64) -> Spacings {
        Spacings { off, ..self }
    }
}

/// About how large the drive and the force are where they balance each other.
const DRIVE: f64 = 1.0;

/// Nothing to be added to net gaps and speeds.
const AT_REST: Flow = Flow { net_gap: 0.0, speed: 0.0 };

impl System for Spacings {
    fn dimension(&self) -> usize {
        2 * self.pedestrians + 1
    }

    fn kinematics(&self, state: &[f64], rates: &mut [f64]) {
        let n = self.pedestrians;
        closing_rates(&state[n..2 * n], &mut rates[..n]);
        rates[2 * n] = state[n];
    }

    fn dynamics(&self, state: &[f64], rates: &mut [f64]) {
        let n = self.pedestrians;
        let (clearances, speeds) = (&state[..n], &state[n..2 * n]);
        self.force.accelerations(clearances, speeds, &mut rates[n..2 * n]);
        if self.off != 0.0 {
            strengthen(self.off, self.relaxation_rate(), speeds, &mut rates[n..2 * n]);
        }
    }

    fn has_series(&self) -> bool {
        true
    }

    fn series(&self, order: usize, unit: f64, coefficients: &mut [f64]) {
        let (n, dimension) = (self.pedestrians, self.dimension());
        self.force.series(Motion { flow: AT_REST, along: None, pedestrians: n, order, unit, dimension, coefficients });
        for k in 1..order {
            let (done, next) = coefficients[k * dimension..].split_at_mut(dimension);
            next[2 * n] = done[n] * (unit / (k + 1) as f64);
        }
    }

    fn tangent_size(&self) -> usize {
        tangent::size(&*self.force, self.pedestrians)
    }

    fn tangent(&self, state: &[f64], tangent: &mut [f64]) -> f64 {
        let n = self.pedestrians;
        tangent::write(&*self.force, AT_REST, Rows { spacings: &state[..n], speeds: &state[n..2 * n] }, tangent)
    }

    fn mean_tangent(&self, ends: TangentEnds<'_>, earlier: &[f64], tangent: &mut [f64]) -> Option<MeanTangent> {
        tangent::write_mean(&*self.force, self.pedestrians, ends, DRIVE, earlier, tangent)
    }

    fn carry(&self, tangent: Tangent<'_>, difference: &mut [f64]) {
        let (ring, first) = difference.split_at_mut(2 * self.pedestrians);
        first[0] += tangent::carry(tangent, self.pedestrians, ring);
    }

    fn relaxation_rate(&self) -> f64 {
        relaxation_rate(&*self.force, self.clearance)
    }

    fn positions(&self) -> Vec<Range<usize>> {
        let n = self.pedestrians;
        vec![0..n, 2 * n..2 * n + 1]
    }

    fn groups(&self) -> Vec<Group> {
        let n = self.pedestrians;
        // at a wall the smallest clearance decides, and the force on it needs its digits
        let clearances = if self.force.is_singular() {
            Group { range: 0..n, measure: Measure::Smallest, floor: LEAST_SIZE }
        } else {
            Group { range: 0..n, measure: Measure::Largest, floor: 1.0 }
        };
        vec![
            clearances,
            Group { range: n..2 * n, measure: Measure::Largest, floor: 1.0 },
            Group { range: 2 * n..2 * n + 1, measure: Measure::Largest, floor: 1.0 },
        ]
    }

    fn bends(&self) -> usize {
        self.force.bend().map_or(0, |_| self.pedestrians)
    }

    fn bend_arguments(&self, state: &[f64], rates: &[f64], arguments: &mut [f64], slopes: &mut [f64]) {
        let Some(bend) = self.force.bend() else { return };
        let n = self.pedestrians;
        bend.arguments(bend.offset, &state[..n], &state[n..2 * n], arguments);
        bend.arguments(0.0, &rates[..n], &rates[n..2 * n], slopes);
    }

    fn kinks(&self) -> usize {
        self.force.kinks() * self.pedestrians
    }

    fn kink_arguments(&self, order: usize, arguments: &mut [f64]) {
        self.force.kink_arguments(self.pedestrians, order, arguments);
    }

    fn in_domain(&self, state: &[f64]) -> bool {
        let n = self.pedestrians;
        let (gaps, speeds) = (&state[..n], &state[n..2 * n]);
        self.force.is_open(AT_REST, gaps, speeds)
    }
}

impl RingSystem for Spacings {
    fn start(&self, start: Start) -> Vec<f64> {
        let n = self.pedestrians;
        let mut state = vec![0.0; self.dimension()];
        state[..n].fill(self.clearance);
        state[0] -= start.shift;
        state[n - 1] += start.shift;
        state[2 * n] = start.shift;
        state
    }

    fn start_displaced(&self, displacements: &[f64]) -> Vec<f64> {
        displace(self.start(Start { shift: 0.0 }), displacements)
    }

    fn read(&self, state: &[f64], gaps: &mut [f64], speeds: &mut [f64]) {
        let n = self.pedestrians;
        for (gap, clearance) in gaps.iter_mut().zip(&state[..n]) {
            *gap = clearance + self.force.contact();
        }
        speeds.copy_from_slice(&state[n..2 * n]);
    }

    fn read_rates(&self, rates: &[f64], gaps: &mut [f64], speeds: &mut [f64]) {
        let n = self.pedestrians;
        gaps.copy_from_slice(&rates[..n]);
        speeds.copy_from_slice(&rates[n..2 * n]);
    }

    fn write_positions(&self, state: &[f64], positions: &mut [f64]) {
        // the distance walked, which grows and grows coarse, is added once: rounding does not gather along the ring
        let (first, mut ahead) = (state[2 * self.pedestrians], 0.0);
        for (gap, own) in state.iter().zip(positions) {
            *own = first + ahead;
            ahead += gap + self.force.contact();
        }
    }

    fn speeds(&self) -> Range<usize> {
        let n = self.pedestrians;
        n..2 * n
    }
}
