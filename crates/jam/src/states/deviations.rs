//! Gaps and speeds as deviations from the uniform flow that is integrated along.
//!
//! State: `[u_0 .. u_{N-1}, w_0 .. w_{N-1}, x_0 - X, X, V]` with gaps `Delta y + u_n`, speeds `V + w_n`, and the
//! distance `X` and speed `V` of the uniform flow, `dX/dt = V`, `dV/dt = f(V, V, Delta y)`. A perturbation of any size
//! keeps all its digits, and an error is one of the perturbation, not of the state.

use super::{Form, LEAST_SIZE, closing_rates};
use crate::laws::{Law, Work};
use crate::observe::spread;
use crate::ring::{Ring, Start};
use crate::series::{Motion, Workspace};
use math::row::{LANES, LENGTH};
use math::simd::{Kernel, dispatch};
use ode::{Group, Measure, System};
use std::cell::{Cell, RefCell};
use std::ops::Range;

/// The ring as deviations from its uniform flow.
#[derive(Clone, Debug)]
pub struct Deviations<L: Law> {
    law: L,
    pedestrians: usize,
    clearance: f64,
    /// The uniform flow asked for last: once it is steady it is asked for again and again.
    uniform: Cell<Uniform<L::Base>>,
    workspace: RefCell<Workspace<L::Terms>>,
    rows: RefCell<Rows>,
}

/// The uniform flow at one speed.
#[derive(Clone, Copy, Debug)]
struct Uniform<B> {
    speed: f64,
    base: B,
    acceleration: f64,
}

impl<L: Law> Deviations<L> {
    /// The ring under this law.
    pub fn new(law: L, ring: Ring) -> Deviations<L> {
        let rows = RefCell::new(Rows { gaps: [0.0; LENGTH], speeds: [0.0; LENGTH + 1], work: Work::default() });
        let clearance = ring.headway() - L::CONTACT;
        let uniform = Cell::new(Uniform::new(&law, clearance, 0.0));
        Deviations { law, pedestrians: ring.pedestrians, clearance, uniform, workspace: RefCell::default(), rows }
    }

    fn uniform(&self, speed: f64) -> Uniform<L::Base> {
        if self.uniform.get().speed != speed {
            self.uniform.set(Uniform::new(&self.law, self.clearance, speed));
        }
        self.uniform.get()
    }

    /// Indices of `x_0 - X`, `X` and `V`.
    fn extras(&self) -> (usize, usize, usize) {
        let n = self.pedestrians;
        (2 * n, 2 * n + 1, 2 * n + 2)
    }
}

impl<B> Uniform<B> {
    fn new<L: Law<Base = B>>(law: &L, clearance: f64, speed: f64) -> Uniform<B> {
        let acceleration = law.acceleration(clearance, speed, speed);
        Uniform { speed, base: law.base(clearance, speed), acceleration }
    }
}

impl<L: Law> System for Deviations<L> {
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
        let Uniform { base, acceleration, .. } = self.uniform(state[speed]);
        let (gaps, speeds) = (&state[..n], &state[n..2 * n]);
        let (accelerations, rows) = (&mut rates[n..2 * n], &mut *self.rows.borrow_mut());
        dispatch(Accelerations { law: self.law, base, gaps, speeds, rates: accelerations, rows });
        rates[speed] = acceleration;
    }

    fn has_series(&self) -> bool {
        L::HAS_SERIES
    }

    /// Where the force depends on the gap alone, the uniform flow only relaxes: `dV/dt = f(Delta y) - V` with a constant.
    fn series(&self, order: usize, unit: f64, coefficients: &mut [f64]) {
        let (n, dimension) = (self.pedestrians, self.dimension());
        let (first, distance, speed) = self.extras();
        dispatch(Motion {
            law: self.law,
            pedestrians: n,
            clearance: self.clearance,
            order,
            unit,
            dimension,
            coefficients,
            workspace: &mut self.workspace.borrow_mut(),
        });
        for k in 1..order {
            let (done, next) = coefficients[k * dimension..].split_at_mut(dimension);
            let share = unit / (k + 1) as f64;
            next[first] = done[n] * share;
            next[distance] = done[speed] * share;
            next[speed] = -done[speed] * share;
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
        self.law.bend().map_or(0, |_| self.pedestrians)
    }

    fn bend_arguments(&self, state: &[f64], rates: &[f64], arguments: &mut [f64], slopes: &mut [f64]) {
        let Some(bend) = self.law.bend() else { return };
        let n = self.pedestrians;
        let (_, _, speed) = self.extras();
        let sum = bend.speed + bend.ahead;
        let offset = bend.offset + (bend.clearance * self.clearance + sum * state[speed]);
        bend.arguments(offset, &state[..n], &state[n..2 * n], arguments);
        bend.arguments(sum * rates[speed], &rates[..n], &rates[n..2 * n], slopes);
    }

    fn in_domain(&self, state: &[f64]) -> bool {
        if !L::SINGULAR {
            return true;
        }
        let n = self.pedestrians;
        let (gaps, speeds) = (&state[..n], &state[n..2 * n]);
        let (_, _, speed) = self.extras();
        // how much room is left for deviations of gap and speeds
        let room = self.law.room(self.clearance, state[speed], state[speed]);
        let a_v = self.law.room_per_speed();
        dispatch(IsOpen { room, a_v, gaps, speeds })
    }
}

/// Whether everybody's `room + gap - a_v (speed + ahead)` is positive.
struct IsOpen<'a> {
    room: f64,
    a_v: f64,
    gaps: &'a [f64],
    speeds: &'a [f64],
}

impl Kernel for IsOpen<'_> {
    type Output = bool;

    #[inline(always)]
    fn run(self) -> bool {
        let IsOpen { room, a_v, gaps, speeds } = self;
        let last = gaps.len() - 1;
        let closed = |gap: f64, speed: f64, ahead: f64| u64::from(room + (gap - a_v * (speed + ahead)) <= 0.0);
        let mut count = closed(gaps[last], speeds[last], speeds[0]);
        for ((gap, speed), ahead) in gaps.iter().zip(speeds).zip(&speeds[1..]) {
            count += closed(*gap, *speed, *ahead);
        }
        count == 0
    }
}

/// The accelerations of all pedestrians minus that of the uniform flow.
struct Accelerations<'a, L: Law> {
    law: L,
    base: L::Base,
    gaps: &'a [f64],
    speeds: &'a [f64],
    rates: &'a mut [f64],
    rows: &'a mut Rows,
}

impl<L: Law> Kernel for Accelerations<'_, L> {
    type Output = ();

    #[inline(always)]
    fn run(self) {
        if L::IN_ROWS { self.in_rows() } else { self.one_by_one() }
    }
}

impl<L: Law> Accelerations<'_, L> {
    #[inline(always)]
    fn one_by_one(self) {
        let last = self.gaps.len() - 1;
        let ahead = &self.speeds[1..];
        for (((rate, gap), speed), ahead) in self.rates.iter_mut().zip(self.gaps).zip(self.speeds).zip(ahead) {
            *rate = self.law.deviation(&self.base, *gap, *speed, *ahead);
        }
        self.rates[last] = self.law.deviation(&self.base, self.gaps[last], self.speeds[last], self.speeds[0]);
    }

    #[inline(always)]
    fn in_rows(self) {
        let Accelerations { law, base, gaps, speeds, rates, rows } = self;
        let blocks = gaps.chunks(LENGTH).zip(rates.chunks_mut(LENGTH));
        for ((gaps, rates), begin) in blocks.zip((0..).step_by(LENGTH)) {
            let (n, after) = (gaps.len(), begin + gaps.len());
            let size = n.next_multiple_of(LANES);
            rows.gaps[..n].copy_from_slice(gaps);
            rows.speeds[..n].copy_from_slice(&speeds[begin..after]);
            // the uniform flow fills the last register
            rows.gaps[n..size].fill(0.0);
            rows.speeds[n..=size].fill(0.0);
            rows.speeds[n] = speeds[after % speeds.len()];
            let (row, own, ahead) = (&mut rows.gaps[..size], &rows.speeds[..size], &rows.speeds[1..=size]);
            law.deviations(&base, row, own, ahead, &mut rows.work);
            rates.copy_from_slice(&rows.gaps[..n]);
        }
    }
}

/// Room for a row of pedestrians, so that a step allocates nothing.
#[derive(Clone, Debug)]
struct Rows {
    gaps: [f64; LENGTH],
    speeds: [f64; LENGTH + 1],
    work: Work,
}

impl<L: Law> Form for Deviations<L> {
    fn start(&self, start: Start) -> Vec<f64> {
        let mut state = vec![0.0; self.dimension()];
        state[0] -= start.shift;
        state[self.pedestrians - 1] += start.shift;
        state[2 * self.pedestrians] = start.shift;
        state
    }

    fn read(&self, state: &[f64], gaps: &mut [f64], speeds: &mut [f64]) {
        let n = self.pedestrians;
        let (_, _, speed) = self.extras();
        let headway = self.clearance + L::CONTACT;
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
        let headway = self.clearance + L::CONTACT;
        // the distance walked, which grows and grows coarse, is added once: rounding does not gather along the ring
        let (moved, mut ahead) = (state[distance] + state[first], 0.0);
        for (n, position) in positions.iter_mut().enumerate() {
            *position = moved + (n as f64 * headway + ahead);
            ahead += state[n];
        }
    }

    fn speed_deviation(&self, state: &[f64]) -> f64 {
        spread(&state[self.pedestrians..2 * self.pedestrians])
    }
}
