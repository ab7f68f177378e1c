//! Unwrapped positions and speeds, as the paper writes its equations: `[x_0 .. x_{N-1}, v_0 .. v_{N-1}]`.

use super::Form;
use super::gaps::Accelerations;
use super::heun::{Cut, Steps, burst};
use crate::laws::Law;
use crate::observe::spread;
use crate::ring::{Ring, Start};
use math::simd::{Width, dispatch};
use ode::{Burst, Group, Measure, System};
use std::cell::RefCell;
use std::ops::Range;

/// The ring as positions and speeds.
#[derive(Clone, Debug)]
pub struct Positions<L> {
    law: L,
    ring: Ring,
    /// Room for the gaps of one evaluation, so that a step allocates nothing.
    gaps: RefCell<Vec<f64>>,
}

impl<L: Law> Positions<L> {
    /// The ring under this law.
    pub fn new(law: L, ring: Ring) -> Positions<L> {
        Positions { law, ring, gaps: RefCell::new(vec![0.0; ring.pedestrians]) }
    }

    /// Writes `x_{n+1} - x_n`; the last pedestrian follows the first, one length ahead.
    fn write_gaps(&self, positions: &[f64], gaps: &mut [f64]) {
        let last = positions.len() - 1;
        for (gap, pair) in gaps.iter_mut().zip(positions.windows(2)) {
            *gap = pair[1] - pair[0];
        }
        gaps[last] = positions[0] + self.ring.length - positions[last];
    }
}

impl<L: Law> System for Positions<L> {
    fn dimension(&self) -> usize {
        2 * self.ring.pedestrians
    }

    fn kinematics(&self, state: &[f64], rates: &mut [f64]) {
        let n = self.ring.pedestrians;
        rates[..n].copy_from_slice(&state[n..]);
    }

    fn dynamics(&self, state: &[f64], rates: &mut [f64]) {
        let n = self.ring.pedestrians;
        let mut gaps = self.gaps.borrow_mut();
        self.write_gaps(&state[..n], &mut gaps);
        for gap in gaps.iter_mut() {
            *gap -= L::CONTACT;
        }
        dispatch(Accelerations { law: self.law, clearances: &gaps, speeds: &state[n..], rates: &mut rates[n..] });
    }

    fn positions(&self) -> Vec<Range<usize>> {
        std::iter::once(0..self.ring.pedestrians).collect()
    }

    fn groups(&self) -> Vec<Group> {
        vec![Group { range: 0..self.dimension(), measure: Measure::Largest, floor: 1.0 }]
    }

    fn heun(&self, state: &mut [f64], h: f64, count: u64) -> Burst {
        let steps = Steps { law: self.law, length: self.ring.length, h, count, limit: Width::Eight };
        burst(steps, Cut::of(self.ring.pedestrians), state)
    }

    fn bends(&self) -> usize {
        self.law.bend().map_or(0, |_| self.ring.pedestrians)
    }

    fn bend_arguments(&self, state: &[f64], rates: &[f64], arguments: &mut [f64], slopes: &mut [f64]) {
        let Some(bend) = self.law.bend() else { return };
        let n = self.ring.pedestrians;
        let mut gaps = self.gaps.borrow_mut();
        self.write_gaps(&state[..n], &mut gaps);
        bend.arguments(bend.offset - bend.clearance * L::CONTACT, &gaps, &state[n..], arguments);
        super::closing_rates(&rates[..n], &mut gaps);
        bend.arguments(0.0, &gaps, &rates[n..], slopes);
    }

    fn in_domain(&self, state: &[f64]) -> bool {
        let n = self.ring.pedestrians;
        let mut gaps = self.gaps.borrow_mut();
        self.write_gaps(&state[..n], &mut gaps);
        !L::SINGULAR || (0..n).all(|i| self.law.room(gaps[i] - L::CONTACT, state[n + i], state[n + (i + 1) % n]) > 0.0)
    }
}

impl<L: Law> Form for Positions<L> {
    fn start(&self, start: Start) -> Vec<f64> {
        let n = self.ring.pedestrians;
        let mut state = vec![0.0; 2 * n];
        for (index, position) in state[..n].iter_mut().enumerate() {
            *position = index as f64 * self.ring.headway();
        }
        state[0] += start.shift;
        state
    }

    fn read(&self, state: &[f64], gaps: &mut [f64], speeds: &mut [f64]) {
        let n = self.ring.pedestrians;
        self.write_gaps(&state[..n], gaps);
        speeds.copy_from_slice(&state[n..]);
    }

    fn read_rates(&self, rates: &[f64], gaps: &mut [f64], speeds: &mut [f64]) {
        let n = self.ring.pedestrians;
        super::closing_rates(&rates[..n], gaps);
        speeds.copy_from_slice(&rates[n..]);
    }

    fn write_positions(&self, state: &[f64], positions: &mut [f64]) {
        positions.copy_from_slice(&state[..self.ring.pedestrians]);
    }

    fn speed_deviation(&self, state: &[f64]) -> f64 {
        spread(&state[self.ring.pedestrians..])
    }
}
