//! Spacings and speeds as deviations from the uniform flow that is integrated along.
//!
//! State: `[u_0 .. u_{N-1}, w_0 .. w_{N-1}, x_0 - X, X, V]` with gaps `Delta y + u_n`, speeds `V + w_n`, and the
//! distance `X` and speed `V` of the uniform flow, `dX/dt = V`, `dV/dt = f(V, V, Delta y)`. A perturbation of any size
//! keeps all its digits, and an error is one of the perturbation, not of the state.

use super::tangent::Centred;
use super::{FlowAlong, LEAST_SIZE, RingSystem, closing_rates, displace, relaxation_rate, strengthen, tangent};
use crate::force::{Dependence, Flow, Force, Motion, Rows};
use crate::ring::{Ring, Start};
use math::lane;
use math::simd::dispatch;
use ode::{Group, MeanTangent, Measure, System, Tangent, TangentEnds};
use std::ops::Range;

/// The ring as deviations from its uniform flow.
#[derive(Debug)]
pub struct Deviations {
    force: Box<dyn Force>,
    pedestrians: usize,
    /// Net gap of the uniform flow.
    net_gap: f64,
    /// The part by which the force is too strong.
    off: f64,
}

impl Deviations {
    /// The ring under this force.
    pub fn new(force: Box<dyn Force>, ring: Ring) -> Deviations {
        let net_gap = ring.headway() - force.contact();
        Deviations { force, pedestrians: ring.pedestrians, net_gap, off: 0.0 }
    }

    /// The same with a force that its rates have too strong by this part of itself.
    pub(super) fn off_by(self, off: f64) -> Deviations {
        Deviations { off, ..self }
    }

    /// The uniform flow of a state.
    fn flow(&self, state: &[f64]) -> Flow {
        let (_, _, speed) = self.extras();
        Flow { net_gap: self.net_gap, speed: state[speed] }
    }

    /// Whether the flow changes so little in a unit of time that it counts for less than rounding: beside a gap or a
    /// speed.
    fn is_steady(&self, flow: Flow, change: f64) -> bool {
        change.abs() <= f64::EPSILON * math::larger(flow.net_gap, flow.speed.abs())
    }

    /// How the acceleration of the uniform flow answers to its speed, where the force depends on speeds.
    fn flow_rate(&self, flow: Flow) -> f64 {
        let mut slopes = [0.0; 3];
        self.force.slopes(flow, Rows { spacings: &[0.0], speeds: &[0.0] }, &mut slopes);
        slopes[1] + slopes[2]
    }

    /// Writes how the accelerations of the deviations answer to the speed of the uniform flow, from the `slopes` by
    /// speeds here and the `rate` of the flow. They do not to one that is steady, or where the force is linear in
    /// speeds.
    fn write_answers(&self, flow: Flow, now: Rows<'_>, [slopes, rate]: [&[f64]; 2], answers: &mut [f64]) {
        let mut acceleration = [0.0];
        self.force.accelerations(&[flow.net_gap], &[flow.speed], &mut acceleration);
        if !self.force.uses_speeds() || self.is_steady(flow, acceleration[0]) {
            return answers.fill(0.0);
        }
        answers.fill(-rate[0]);
        for slopes in slopes.chunks_exact(self.pedestrians) {
            answers.iter_mut().zip(slopes).for_each(|(answer, slope)| *answer += slope);
        }
        if ode::largest(answers) >= DIGITS * ode::largest(slopes) {
            return;
        }
        // of small deviations that difference has no digits: that of their accelerations does
        let change = NEAR * math::larger(flow.speed.abs(), acceleration[0].abs());
        let (faster, mut here) = (Flow { speed: flow.speed + change, ..flow }, vec![0.0; self.pedestrians]);
        self.force.deviations(flow, now.spacings, now.speeds, &mut here);
        self.force.deviations(faster, now.spacings, now.speeds, answers);
        let share = 1.0 / (faster.speed - flow.speed);
        answers.iter_mut().zip(here).for_each(|(answer, here)| *answer = share * (*answer - here));
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

/// A change of the speed of the uniform flow that is small, as a part of it or of what it gains in a unit of time.
const NEAR: f64 = 1e-6;

/// A difference of slopes has digits if it is this part of them.
const DIGITS: f64 = 1e-9;

/// Adds what a change of the speed of the uniform flow makes of deviations of speeds.
fn push(answers: &[f64], change: f64, speeds: &mut [f64]) {
    speeds.iter_mut().zip(answers).for_each(|(speed, answer)| *speed += change * answer);
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
        if self.off != 0.0 {
            let relaxation = self.relaxation_rate();
            strengthen(self.off, relaxation, speeds, &mut rates[n..2 * n]);
            strengthen(self.off, relaxation, &state[speed..], &mut rates[speed..]);
        }
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

    /// If the force depends on speeds, those of the ring, how the deviations from the uniform flow answer to its speed,
    /// and how that flow itself does.
    fn tangent_size(&self) -> usize {
        let (n, size) = (self.pedestrians, tangent::size(&*self.force, self.pedestrians));
        if self.force.dependence() == Dependence::Speeds { size + n + 1 } else { size }
    }

    /// Deviations of the spacings add up to nothing: the ring has one length.
    fn constrain(&self, difference: &mut [f64]) {
        dispatch(Centred(&mut difference[..self.pedestrians]));
    }

    fn tangent(&self, state: &[f64], tangent: &mut [f64]) -> f64 {
        let (n, flow) = (self.pedestrians, self.flow(state));
        let now = Rows { spacings: &state[..n], speeds: &state[n..2 * n] };
        let (of_ring, of_flow) = tangent.split_at_mut(tangent::size(&*self.force, n));
        let fastest = tangent::write(&*self.force, flow, now, of_ring);
        let (answers, rate) = of_flow.split_at_mut(if of_flow.is_empty() { 0 } else { n });
        if let [rate] = rate {
            *rate = self.flow_rate(flow);
            self.write_answers(flow, now, [&of_ring[n..3 * n], &[*rate]], answers);
        }
        if answers.iter().chain(&*rate).all(|answer| answer.is_finite()) { fastest } else { f64::NAN }
    }

    fn mean_tangent(&self, ends: TangentEnds<'_>, earlier: &[f64], tangent: &mut [f64]) -> Option<MeanTangent> {
        // rates of deviations have the digits of these
        tangent::write_mean(&*self.force, self.pedestrians, ends, 0.0, earlier, tangent)
    }

    fn carry(&self, tangent: Tangent<'_>, difference: &mut [f64]) {
        let (n, (first, distance, speed)) = (self.pedestrians, self.extras());
        let (time, of_ring) = (tangent.length, tangent::size(&*self.force, n));
        let (start, start_of_flow) = tangent.start.split_at(of_ring);
        let (end, end_of_flow) = tangent.end.split_at(of_ring.min(tangent.end.len()));
        let of_flow = [start_of_flow, if end.is_empty() { start_of_flow } else { end_of_flow }];
        // the uniform flow relaxes, at rate 1 where the force does not depend on speeds in another way
        let rate = of_flow.map(|row| row.last().copied().unwrap_or(-1.0)).iter().sum::<f64>() * 0.5;
        let (ring, extras) = difference.split_at_mut(first);
        push(of_flow[0], 0.5 * time * extras[speed - first], &mut ring[n..]);
        extras[0] += tangent::carry(Tangent { start, end, ..tangent }, n, ring);
        let left = lane::exp(rate * time);
        let way = if rate == 0.0 { time } else { (left - 1.0) / rate };
        extras[distance - first] += way * extras[speed - first];
        extras[speed - first] *= left;
        push(of_flow[1], 0.5 * time * extras[speed - first], &mut ring[n..]);
    }

    fn relaxation_rate(&self) -> f64 {
        relaxation_rate(&*self.force, self.net_gap)
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
