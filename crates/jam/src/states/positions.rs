//! Unwrapped positions and speeds, as the paper writes its equations: `[x_0 .. x_{N-1}, v_0 .. v_{N-1}]`.

use super::RingSystem;
use crate::force::{Cut, Flow, Force, Steps};
use crate::ring::{Ring, Start};
use math::simd::{Kernel, Width, dispatch};
use ode::{Batch, Group, Measure, System};
use std::cell::RefCell;
use std::ops::Range;

/// The ring as positions and speeds.
#[derive(Debug)]
pub struct Positions {
    force: Box<dyn Force>,
    ring: Ring,
    /// Scratch for the gaps of one evaluation, so that a step allocates nothing.
    gaps: RefCell<Vec<f64>>,
}

impl Positions {
    /// The ring under this force.
    pub fn new(force: Box<dyn Force>, ring: Ring) -> Positions {
        Positions { force, ring, gaps: RefCell::new(vec![0.0; ring.pedestrians]) }
    }

    /// Writes `x_{n+1} - x_n` less a distance; the last pedestrian follows the first, one length ahead.
    fn write_gaps(&self, positions: &[f64], less: f64, gaps: &mut [f64]) {
        dispatch(Gaps { positions, closing: positions[0] + self.ring.length, less, gaps });
    }

    fn write_net_gaps(&self, positions: &[f64], gaps: &mut [f64]) {
        self.write_gaps(positions, self.force.contact(), gaps);
    }
}

struct Gaps<'a> {
    positions: &'a [f64],
    /// Whom the last one follows.
    closing: f64,
    less: f64,
    gaps: &'a mut [f64],
}

impl Kernel for Gaps<'_> {
    type Output = ();

    #[inline(always)]
    fn run(self) {
        let Gaps { positions, closing, less, gaps } = self;
        let last = positions.len() - 1;
        for ((gap, own), ahead) in gaps.iter_mut().zip(positions).zip(&positions[1..]) {
            *gap = ahead - own - less;
        }
        gaps[last] = closing - positions[last] - less;
    }
}

impl System for Positions {
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
        self.write_net_gaps(&state[..n], &mut gaps);
        self.force.accelerations(&gaps, &state[n..], &mut rates[n..]);
    }

    fn positions(&self) -> Vec<Range<usize>> {
        std::iter::once(0..self.ring.pedestrians).collect()
    }

    fn groups(&self) -> Vec<Group> {
        vec![Group { range: 0..self.dimension(), measure: Measure::Largest, floor: 1.0 }]
    }

    fn heun(&self, state: &mut [f64], h: f64, count: u64) -> Batch {
        let steps = Steps { length: self.ring.length, h, count, limit: Width::Eight };
        self.force.heun(steps, Cut::of(self.ring.pedestrians), state)
    }

    fn bends(&self) -> usize {
        self.force.bend().map_or(0, |_| self.ring.pedestrians)
    }

    fn bend_arguments(&self, state: &[f64], rates: &[f64], arguments: &mut [f64], slopes: &mut [f64]) {
        let Some(bend) = self.force.bend() else { return };
        let n = self.ring.pedestrians;
        let mut gaps = self.gaps.borrow_mut();
        self.write_gaps(&state[..n], 0.0, &mut gaps);
        bend.arguments(bend.offset - bend.clearance * self.force.contact(), &gaps, &state[n..], arguments);
        super::closing_rates(&rates[..n], &mut gaps);
        bend.arguments(0.0, &gaps, &rates[n..], slopes);
    }

    fn in_domain(&self, state: &[f64]) -> bool {
        let n = self.ring.pedestrians;
        if !self.force.is_singular() {
            return true;
        }
        let mut gaps = self.gaps.borrow_mut();
        self.write_net_gaps(&state[..n], &mut gaps);
        self.force.is_open(Flow { net_gap: 0.0, speed: 0.0 }, &gaps, &state[n..])
    }
}

impl RingSystem for Positions {
    fn start(&self, start: Start) -> Vec<f64> {
        let n = self.ring.pedestrians;
        let mut state = vec![0.0; 2 * n];
        for (index, position) in state[..n].iter_mut().enumerate() {
            *position = index as f64 * self.ring.headway();
        }
        state[0] += start.shift;
        state
    }

    fn start_displaced(&self, displacements: &[f64]) -> Vec<f64> {
        let mut state = self.start(Start { shift: 0.0 });
        state.iter_mut().zip(displacements).for_each(|(position, by)| *position += by);
        state
    }

    fn read(&self, state: &[f64], gaps: &mut [f64], speeds: &mut [f64]) {
        let n = self.ring.pedestrians;
        self.write_gaps(&state[..n], 0.0, gaps);
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

    fn speeds(&self) -> Range<usize> {
        let n = self.ring.pedestrians;
        n..2 * n
    }
}
