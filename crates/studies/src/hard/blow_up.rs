//! Case 1: the blow-up of the unstable algebraic run of figure 4. Each pedestrian that is thrown back hits the next one
//! twice as fast.

use super::Tables;
use super::rows::{Rows, row};
use super::run::{Case, Leg, figure_4, two_methods};
use figures::failure::Failure;
use jam::events::BLOW_UP;
use jam::ring::Ring;
use jam::states::{RingSystem, StateVariables, gaps_state};
use ode::{Control, Method, Problem, Step, integrate};
use std::ops::ControlFlow;

/// The run of figure 4, unstable, in this form.
pub fn case(kind: StateVariables) -> Case {
    let model = figure_4(0.55);
    Case { model, ring: Ring { pedestrians: 67, length: 200.0 }, kind }
}

/// The shift of pedestrian 0 in that run.
pub const SHIFT: f64 = 1e-4;

/// The time from which the run is followed in gaps: before the first pedestrian turns back at 960.37.
pub const NEAR: f64 = 960.0;

/// Gaps and speeds at [`NEAR`], as a state of the form of gaps.
///
/// # Errors
/// The run does not get there.
pub fn near(method: Method, control: Control) -> Result<Vec<f64>, Failure> {
    let deviations = case(StateVariables::Deviations);
    let run = deviations.run(SHIFT, Leg { method, control, begin: 0.0, end: NEAR }).whole()?;
    let mut positions = vec![0.0; run.gaps.len()];
    deviations.form().write_positions(&run.state, &mut positions);
    Ok(gaps_state(&deviations.model, &run.gaps, &run.speeds, positions[0]))
}

/// A pedestrian at the smallest gap, from where it is thrown back.
#[derive(Clone, Copy, Debug)]
struct Throw {
    pedestrian: usize,
    /// Time since [`NEAR`].
    time: f64,
    room: f64,
    /// The largest speed backwards afterwards.
    backward: f64,
    /// Time until the blow-up.
    remaining: f64,
}

/// The end of the run: the throws, and the smallest room against the time that is left, at every step.
struct Descent {
    throws: Vec<Throw>,
    /// `(T* - t, smallest room)`.
    rooms: Vec<(f64, f64)>,
    /// `T*`.
    end: f64,
    steps: u64,
}

/// Follows the run from [`NEAR`] until the speeds exceed [`BLOW_UP`] desired speeds.
fn descend(method: Method, control: Control) -> Result<Descent, Failure> {
    let case = case(StateVariables::Spacings);
    let form = case.form();
    let start = near(method, control)?;
    let count = case.ring.pedestrians;
    let (mut throws, mut steps): (Vec<Throw>, Vec<(f64, f64)>) = (Vec::new(), Vec::new());
    let mut observer = |step: &mut Step<'_>| {
        throws.extend((0..count).filter_map(|n| thrown(&*form, step, n)));
        let (clearances, speeds) = step.after().split_at(count);
        for throw in &mut throws {
            throw.backward = math::larger(throw.backward, -speeds[throw.pedestrian]);
        }
        steps.push((step.length(), clearances.iter().copied().fold(f64::INFINITY, math::smaller)));
        let fastest = speeds[..count].iter().copied().fold(0.0, |most, v| math::larger(most, v.abs()));
        if fastest > 3.0 * BLOW_UP { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
    };
    let problem = Problem { system: &*form, start: &start, begin: 0.0, end: 2.0, method, control };
    integrate(&problem, &mut observer).map_err(Failure::work)?;
    Ok(measured(throws, &steps))
}

/// The throw of pedestrian `n`, if its gap is smallest within this step.
fn thrown(form: &dyn RingSystem, step: &mut Step<'_>, n: usize) -> Option<Throw> {
    let count = (step.before().len() - 1) / 2;
    let closing = |state: &[f64]| state[count + (n + 1) % count] - state[count + n];
    if !(closing(step.before()) < 0.0 && closing(step.after()) >= 0.0 && step.before()[n] < 0.1) {
        return None;
    }
    let mut state = vec![0.0; form.dimension()];
    let (mut low, mut high) = (0.0, 1.0);
    // the room is at its minimum: an error of 2^-30 of the step leaves it exact
    for _ in 0..30 {
        let middle = 0.5 * (low + high);
        step.at_fraction(middle, &mut state);
        if closing(&state) < 0.0 { low = middle } else { high = middle }
    }
    step.at_fraction(high, &mut state);
    let time = step.start + high * step.length();
    Some(Throw { pedestrian: n, time, room: state[n], backward: 0.0, remaining: 0.0 })
}

/// Counts the time backwards from the end, where it keeps all its digits.
///
/// The times between throws halve, so those that are not made any more take as long as the last one.
fn measured(mut throws: Vec<Throw>, steps: &[(f64, f64)]) -> Descent {
    let total: f64 = steps.iter().map(|step| step.0).sum();
    let mut rest = match throws[..] {
        [.., before, last] => (last.time - before.time) - (total - last.time),
        _ => 0.0,
    };
    let end = NEAR + total + rest;
    let mut rooms = Vec::new();
    let mut next = throws.len();
    let mut time = total;
    for &(length, room) in steps.iter().rev() {
        rooms.push((rest, room));
        time -= length;
        while next > 0 && throws[next - 1].time >= time {
            next -= 1;
            let within = (time + length) - throws[next].time;
            throws[next].remaining = rest + within;
        }
        rest += length;
    }
    Descent { throws, rooms, end, steps: steps.len() as u64 }
}

/// The cascade, the scaling of the smallest room, and `T*` by several methods and tolerances.
pub fn tables(quick: bool) -> Result<Tables, Failure> {
    let [plain, check] = two_methods(1e-13).map(|(method, control)| descend(method, control));
    let (plain, check) = (plain?, check?);
    Ok(vec![
        ("blow_up_cascade", cascade(&plain, &check)),
        ("blow_up_scaling", scaling(&plain)),
        ("blow_up_time", times(quick)?),
    ])
}

/// Throws with less time left than this are not tabulated: the time itself has no digits for them.
const SHORTEST: f64 = 1e-11;

fn cascade(plain: &Descent, check: &Descent) -> Rows {
    let mut rows =
        Rows::new(&["k", "n", "t", "remaining", "room", "speed", "speed_ratio", "room_speed_squared", "uncertainty"]);
    let mut before = None;
    for (k, (throw, other)) in plain.throws.iter().zip(&check.throws).enumerate() {
        if throw.remaining < SHORTEST || throw.pedestrian != other.pedestrian {
            break;
        }
        let uncertainty = (throw.room / other.room - 1.0).abs();
        let ratio = before.map(|speed| throw.backward / speed);
        let square = throw.room * throw.backward * throw.backward;
        let Throw { pedestrian, time, room, backward, remaining } = *throw;
        rows.push(row![k, pedestrian, NEAR + time, remaining, room, backward, ratio, square, uncertainty]);
        before = Some(throw.backward);
    }
    rows
}

/// The smallest room now and so far, at most eight times in a factor of 2 of the time that is left.
fn scaling(plain: &Descent) -> Rows {
    let mut rows = Rows::new(&["remaining", "room", "smallest_so_far"]);
    let (mut next, mut smallest) = (0.8, f64::INFINITY);
    for &(remaining, room) in plain.rooms.iter().rev().filter(|(remaining, _)| *remaining >= SHORTEST) {
        smallest = math::smaller(smallest, room);
        if remaining <= next {
            rows.push(row![remaining, room, smallest]);
            next = remaining / 1.09;
        }
    }
    rows
}

fn times(quick: bool) -> Result<Rows, Failure> {
    let mut rows = Rows::new(&["method", "tolerance", "t_star", "steps_from_960"]);
    let tolerances: &[f64] = if quick { &[1e-12] } else { &[1e-8, 1e-10, 1e-12, 1e-13, 1e-14] };
    for &tolerance in tolerances {
        for method in Method::ALL.into_iter().filter(|method| method.is_adaptive()) {
            let descent = descend(method, Control::Adaptive { tolerance })?;
            rows.push(row![method.name(), tolerance, descent.end, descent.steps]);
        }
    }
    Ok(rows)
}
