//! Spacings and speeds as deviations from the uniform flow that is integrated along.
//!
//! State: `[u_0 .. u_{N-1}, w_0 .. w_{N-1}, x_0 - X, X, V]` with gaps `Delta y + u_n`, speeds `V + w_n`, and the
//! distance `X` and speed `V` of the uniform flow, `dX/dt = V`, `dV/dt = f(V, V, Delta y)`. A perturbation of any size
//! keeps all its digits, and an error is one of the perturbation, not of the state.

use super::tangent::{FADING, fastest, series};
use super::{FlowAlong, LEAST_SIZE, RingSystem, closing_rates, displace};
use crate::force::{Flow, Force, Motion};
use crate::ring::{Ring, Start};
use ode::{Group, Measure, System, Tangent};
use std::ops::Range;

/// The ring as deviations from its uniform flow.
#[derive(Debug)]
pub struct Deviations {
    force: Box<dyn Force>,
    pedestrians: usize,
    /// Net gap of the uniform flow.
    net_gap: f64,
}

impl Deviations {
    /// The ring under this force.
    pub fn new(force: Box<dyn Force>, ring: Ring) -> Deviations {
        let net_gap = ring.headway() - force.contact();
        Deviations { force, pedestrians: ring.pedestrians, net_gap }
    }

    /// The uniform flow of a state.
    fn flow(&self, state: &[f64]) -> Flow {
        let (_, _, speed) = self.extras();
        Flow { net_gap: self.net_gap, speed: state[speed] }
    }

    /// Whether the flow changes so little in a unit of time that it counts for less than rounding: beside a gap or a speed.
    fn is_steady(&self, flow: Flow, change: f64) -> bool {
        change.abs() <= f64::EPSILON * math::larger(flow.net_gap, flow.speed.abs())
    }

    fn headway(&self) -> f64 {
        self.net_gap + self.force.contact()
    }

    /// Indices of `x_0 - X`, `X` and `V`.
    fn extras(&self) -> (usize, usize, usize) {
        let n = self.pedestrians;
        (2 * n, 2 * n + 1, 2 * n + 2)
    }
}

impl System for Deviations {
    fn dimension(&self) -> usize {
        2 * self.pedestrians + 3
    }

    fn kinematics(&self, state: &[f64], rates: &mut [f64]) {
        let n = self.pedestrians;
        let (first, distance, speed) = self.extras();
        closing_rates(&state[n..2 * n], &mut rates[..n]);
        rates[first] = state[n];
        rates[distance] = state[speed];
    }

    fn dynamics(&self, state: &[f64], rates: &mut [f64]) {
        let n = self.pedestrians;
        let (_, _, speed) = self.extras();
        let (spacings, speeds) = (&state[..n], &state[n..2 * n]);
        rates[speed] = self.force.deviations(self.flow(state), spacings, speeds, &mut rates[n..2 * n]);
    }

    fn has_series(&self) -> bool {
        true
    }

    /// If the force depends on speeds, the uniform flow has a series like that of a pedestrian until it is steady.
    /// Otherwise it only relaxes: `dV/dt = f(Delta y) - V` with a constant, for other laws with another factor of `V`.
    fn series(&self, order: usize, unit: f64, coefficients: &mut [f64]) {
        let (n, dimension) = (self.pedestrians, coefficients.len() / (order + 1));
        let (first, distance, speed) = self.extras();
        let flow = self.flow(coefficients);
        let relaxation = if self.force.uses_speeds() { 0.0 } else { self.force.relaxation(flow) };
        let is_along = self.force.uses_speeds() && !self.is_steady(flow, coefficients[dimension + speed]);
        let along = is_along.then_some(speed);
        self.force.series(Motion { flow, along, pedestrians: n, order, unit, dimension, coefficients });
        let mut rows = coefficients.chunks_exact_mut(dimension).skip(1);
        let Some(row) = rows.next() else { return };
        let [mut own, mut flow] = [row[n], row[speed]];
        for (k, row) in (1..order).zip(rows) {
            let share = unit / (k + 1) as f64;
            row[first] = own * share;
            row[distance] = flow * share;
            if !is_along {
                row[speed] = relaxation * flow * share;
            }
            [own, flow] = [row[n], row[speed]];
        }
    }

    /// Whole lines of the cache, of 64 bytes each.
    fn row_length(&self) -> usize {
        self.dimension().next_multiple_of(8)
    }

    fn tangent_size(&self) -> usize {
        if self.force.has_slopes() { self.pedestrians } else { 0 }
    }

    fn fading(&self) -> f64 {
        FADING
    }

    /// Deviations of the spacings add up to nothing: the ring has one length.
    fn constrain(&self, difference: &mut [f64]) {
        let spacings = &mut difference[..self.pedestrians];
        let mean = spacings.iter().fold(0.0, |sum, spacing| sum + spacing) / self.pedestrians as f64;
        spacings.iter_mut().for_each(|spacing| *spacing -= mean);
    }

    fn tangent(&self, state: &[f64], tangent: &mut [f64]) -> f64 {
        self.force.slopes(self.net_gap, &state[..self.pedestrians], tangent);
        fastest(tangent)
    }

    fn difference(&self, tangent: Tangent<'_>, order: usize, unit: f64, coefficients: &mut [f64]) {
        let (n, dimension) = (self.pedestrians, self.dimension());
        series(tangent, order, unit, coefficients);
        let (first, distance, speed) = self.extras();
        let mut rows = coefficients.chunks_exact_mut(dimension);
        let Some(start) = rows.next() else { return };
        let mut before = [n, first, distance, speed].map(|i| start[i]);
        for (k, row) in rows.take(order).enumerate() {
            let share = unit / (k + 1) as f64;
            let [own, moved, walked, flow] = before;
            row[first] = (own - FADING * moved) * share;
            row[distance] = (flow - FADING * walked) * share;
            row[speed] = (-1.0 - FADING) * flow * share;
            before = [n, first, distance, speed].map(|i| row[i]);
        }
    }

    fn positions(&self) -> Vec<Range<usize>> {
        let n = self.pedestrians;
        vec![0..n, 2 * n..2 * n + 2]
    }

    /// The perturbation is measured by itself, however small; the uniform flow and the place of the first against 1.
    fn groups(&self) -> Vec<Group> {
        let n = self.pedestrians;
        vec![
            Group { range: 0..2 * n, measure: Measure::Largest, floor: LEAST_SIZE },
            Group { range: 2 * n..2 * n + 3, measure: Measure::Largest, floor: 1.0 },
        ]
    }

    fn bends(&self) -> usize {
        self.force.bend().map_or(0, |_| self.pedestrians)
    }

    fn bend_arguments(&self, state: &[f64], rates: &[f64], arguments: &mut [f64], slopes: &mut [f64]) {
        let Some(bend) = self.force.bend() else { return };
        let n = self.pedestrians;
        let (_, _, speed) = self.extras();
        let sum = bend.speed + bend.ahead;
        let offset = bend.offset + (bend.clearance * self.net_gap + sum * state[speed]);
        bend.arguments(offset, &state[..n], &state[n..2 * n], arguments);
        bend.arguments(sum * rates[speed], &rates[..n], &rates[n..2 * n], slopes);
    }

    fn kinks(&self) -> usize {
        self.force.kinks() * self.pedestrians
    }

    fn kink_arguments(&self, order: usize, arguments: &mut [f64]) {
        self.force.kink_arguments(self.pedestrians, order, arguments);
    }

    fn in_domain(&self, state: &[f64]) -> bool {
        let n = self.pedestrians;
        self.force.is_open(self.flow(state), &state[..n], &state[n..2 * n])
    }
}

impl RingSystem for Deviations {
    fn start(&self, start: Start) -> Vec<f64> {
        let mut state = vec![0.0; self.dimension()];
        state[0] -= start.shift;
        state[self.pedestrians - 1] += start.shift;
        state[2 * self.pedestrians] = start.shift;
        state
    }

    fn start_displaced(&self, displacements: &[f64]) -> Vec<f64> {
        displace(self.start(Start { shift: 0.0 }), displacements)
    }

    fn read(&self, state: &[f64], gaps: &mut [f64], speeds: &mut [f64]) {
        let n = self.pedestrians;
        let (_, _, speed) = self.extras();
        let headway = self.headway();
        for (gap, deviation) in gaps.iter_mut().zip(&state[..n]) {
            *gap = headway + deviation;
        }
        for (own, deviation) in speeds.iter_mut().zip(&state[n..2 * n]) {
            *own = state[speed] + deviation;
        }
    }

    fn read_rates(&self, rates: &[f64], gaps: &mut [f64], speeds: &mut [f64]) {
        let n = self.pedestrians;
        let (_, _, speed) = self.extras();
        gaps.copy_from_slice(&rates[..n]);
        for (own, deviation) in speeds.iter_mut().zip(&rates[n..2 * n]) {
            *own = rates[speed] + deviation;
        }
    }

    fn write_positions(&self, state: &[f64], positions: &mut [f64]) {
        let (first, distance, _) = self.extras();
        let headway = self.headway();
        // the distance walked, which grows and grows coarse, is added once: rounding does not gather along the ring
        let (moved, mut ahead) = (state[distance] + state[first], 0.0);
        for (n, position) in positions.iter_mut().enumerate() {
            *position = moved + (n as f64 * headway + ahead);
            ahead += state[n];
        }
    }

    fn speeds(&self) -> Range<usize> {
        let n = self.pedestrians;
        n..2 * n
    }

    fn flow_along(&self, state: &[f64], rates: &[f64]) -> Option<FlowAlong> {
        let (_, _, speed) = self.extras();
        Some(FlowAlong { net_gap: self.net_gap, speed: state[speed], acceleration: rates[speed] })
    }
}
