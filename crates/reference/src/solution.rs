//! The solution of a scene: samples, the first event of each kind, and how the run ends.

use crate::flow::{Flow, Form};
use crate::formula::Formula;
use crate::number::Real;
use crate::solver::{Care, Solver, Stuck};
use math::double_double::DoubleDouble;
use math::{larger, smaller};

/// A ring, its start, and what is wanted of it.
#[derive(Clone, Debug, PartialEq)]
pub struct Question {
    /// The law.
    pub formula: Formula,
    /// `N`.
    pub pedestrians: usize,
    /// `L`.
    pub length: f64,
    /// How far pedestrian 0 is moved forward at the start.
    pub shift: f64,
    /// How far everybody is, besides; nobody if empty.
    pub displacements: Vec<f64>,
    /// The times at which the solution is wanted, ascending, the first after 0.
    pub times: Vec<f64>,
}

/// The solution at one time.
#[derive(Clone, Debug, PartialEq)]
pub struct Sample {
    /// When.
    pub time: f64,
    /// Standard deviation of the speeds, divided by `N`.
    pub std: f64,
    /// The size of the perturbation.
    pub perturbation: f64,
    /// The largest acceleration, in size: what a rounding of the time does to speeds.
    pub acceleration: f64,
    /// Unwrapped positions.
    pub positions: Vec<f64>,
    /// Speeds.
    pub speeds: Vec<f64>,
}

/// What becomes negative in an event.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    /// The room.
    Overlap,
    /// A speed.
    NegativeSpeed,
    /// A spacing.
    Exchange,
}

impl Kind {
    /// All of them.
    pub const ALL: [Kind; 3] = [Kind::Overlap, Kind::NegativeSpeed, Kind::Exchange];

    /// As tables name it.
    pub fn name(self) -> &'static str {
        match self {
            Kind::Overlap => "overlap",
            Kind::NegativeSpeed => "negative_speed",
            Kind::Exchange => "exchange",
        }
    }

    fn value<T: Real>(self, flow: &Flow<T>, state: &[T], n: usize) -> f64 {
        match self {
            Kind::Overlap => flow.room(state, n).value(),
            Kind::NegativeSpeed => flow.speed(state, n).value(),
            Kind::Exchange => flow.spacing(state, n).value(),
        }
    }
}

/// A first crossing of 0.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Crossing {
    /// When.
    pub time: f64,
    /// Whose.
    pub pedestrian: usize,
    /// How fast the value falls then.
    pub rate: f64,
    /// The spacing then.
    pub spacing: f64,
    /// How fast that grows then.
    pub opening: f64,
}

/// The first event of a kind for all pedestrians to whom it happens, in order of time.
#[derive(Clone, Debug, PartialEq)]
pub struct First {
    /// Of what.
    pub kind: Kind,
    /// Who and when.
    pub crossings: Vec<Crossing>,
}

/// How a solution ends.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum End {
    /// At the last time that was asked for.
    Reached,
    /// Speeds grow beyond all bounds.
    BlownUp,
    /// The solution ends here: steps tend to 0, or a gap does under a singular force.
    Singular,
    /// The work allowed was not enough.
    Unfinished,
}

/// The answer to a [`Question`].
#[derive(Clone, Debug, PartialEq)]
pub struct Solution {
    /// At the times asked for, up to the end.
    pub samples: Vec<Sample>,
    /// First events, a kind each, in the order of [`Kind::ALL`].
    pub events: Vec<First>,
    /// The least value of each [`Kind`] after the first step, and when.
    pub least: [(f64, f64); 3],
    /// How it ends.
    pub end: End,
    /// When.
    pub time: f64,
    /// The speed reached then.
    pub fastest: f64,
    /// The work done.
    pub work: u64,
}

/// A room is near a singular force below this part of that in the uniform flow: differences have lost three digits of
/// it. Where the flow itself is near, they have not.
const NEAR: f64 = 1e-3;
/// Where the room is smaller, products underflow.
const LEAST_ROOM: f64 = 1e-280;

/// Solves in numbers of type `T`, beginning in this form. When a pedestrian comes close to a singularity of the force,
/// clearances become the state. Speeds above `fastest` times the desired one, or 1, are a blow-up.
pub fn solve<T: Real>(question: &Question, form: Form, care: Care, fastest: f64) -> Solution {
    let flow: Flow<T> = Flow::new(question.formula.clone(), question.pedestrians, question.length, form);
    let start = flow.start(question.shift, &question.displacements);
    let mut solver = Solver::new(flow, start, care);
    let bound = fastest * larger(question.formula.desired_speed(), 1.0);
    let mut solution = Solution {
        samples: Vec::new(),
        events: Kind::ALL.map(|kind| First { kind, crossings: Vec::new() }).to_vec(),
        least: [(f64::INFINITY, 0.0); 3],
        end: End::Reached,
        time: 0.0,
        fastest: 0.0,
        work: 0,
    };
    let last = question.times.last().copied().unwrap_or(0.0);
    let mut wanted = question.times.iter().peekable();
    while solution.end == End::Reached && f64::from(solver.time) < last {
        if let Err(stuck) = solver.advance(last) {
            solution.end = if stuck == Stuck::Work { End::Unfinished } else { End::Singular };
            break;
        }
        watch(&solver, &mut solution);
        while let Some(&time) = wanted.next_if(|time| **time <= f64::from(solver.time)) {
            let since = f64::from(DoubleDouble::from(time) - solver.start);
            let theta = if time == last { 1.0 } else { since / solver.length };
            solution.samples.push(sample(&solver.flow, time, &solver.at(theta)));
        }
        solution.fastest = speeds(&solver.flow, &solver.state).into_iter().fold(0.0, |most, v| larger(v.abs(), most));
        if solution.fastest > bound {
            solution.end = End::BlownUp;
        } else if question.formula.is_singular() {
            let room = solver.flow.least_room(&solver.state);
            if room < LEAST_ROOM {
                solution.end = End::Singular;
            } else if solver.flow.form == Form::Differences && room < NEAR * solver.flow.uniform_room(&solver.state) {
                solver.change_form();
            }
        }
    }
    solution.time = solver.time.into();
    solution.work = solver.work;
    solution
}

fn speeds<T: Real>(flow: &Flow<T>, state: &[T]) -> Vec<f64> {
    (0..flow.pedestrians).map(|n| flow.speed(state, n).value()).collect()
}

fn sample<T: Real>(flow: &Flow<T>, time: f64, state: &[T]) -> Sample {
    Sample {
        time,
        std: flow.std(state).value(),
        perturbation: flow.perturbation(state),
        acceleration: flow.acceleration(state),
        positions: flow.positions(state).into_iter().map(T::value).collect(),
        speeds: speeds(flow, state),
    }
}

/// Looks for first events in the last step.
fn watch<T: Real>(solver: &Solver<T>, solution: &mut Solution) {
    let (flow, places, states) = (&solver.flow, solver.places(), solver.states());
    let is_first = solver.start == DoubleDouble::ZERO;
    for (index, kind) in Kind::ALL.into_iter().enumerate() {
        for n in 0..flow.pedestrians {
            let known = &solution.events[index].crossings;
            if known.iter().any(|crossing| crossing.pedestrian == n) {
                continue;
            }
            let values: Vec<f64> = states.iter().map(|state| kind.value(flow, state, n)).collect();
            let is_quiet = known.is_empty() && !is_first;
            for (value, place) in values.iter().zip(&places).filter(|_| is_quiet) {
                if *value < solution.least[index].0 {
                    solution.least[index] = (*value, f64::from(solver.start + place * solver.length));
                }
            }
            let found = crossing(solver, kind, n, &places, &values);
            solution.events[index].crossings.extend(found);
        }
        solution.events[index].crossings.sort_by(|a, b| a.time.total_cmp(&b.time));
    }
}

/// Where the value of pedestrian `n`, known at these places of the step, first falls below 0.
fn crossing<T: Real>(solver: &Solver<T>, kind: Kind, n: usize, places: &[f64], values: &[f64]) -> Option<Crossing> {
    let components = solver.flow.components(n);
    let mut state = solver.state.clone();
    let mut of = |kind: Kind, theta: f64| {
        solver.write_at(theta, &components, &mut state);
        kind.value(&solver.flow, &state, n)
    };
    let mut at = |theta: f64| of(kind, theta);
    let (mut before, past) = (1..places.len()).find_map(|i| {
        if values[i] < 0.0 {
            return Some((places[i - 1], places[i]));
        }
        // a dip between places, were it a parabola; then looked at closely
        let (left, right) = (values[i - 1], *values.get(i + 1)?);
        let is_low = values[i] <= left && values[i] <= right;
        let is_near = values[i] < 0.5 * (larger(left, right) - values[i]);
        let dip = if is_low && is_near { lowest(&mut at, places[i - 1], places[i + 1]) } else { None };
        dip.map(|dip| (places[i - 1], dip))
    })?;
    let mut past = past;
    loop {
        let middle = 0.5 * (before + past);
        if middle <= before || middle >= past || past - before < 1e-17 {
            break;
        }
        if at(middle) < 0.0 { past = middle } else { before = middle }
    }
    let close = 1e-4;
    let (from, to) = (larger(past - close, 0.0), smaller(past + close, 1.0));
    let rate = (at(from) - at(to)) / ((to - from) * solver.length);
    let [before, spacing, after] = [from, past, to].map(|theta| of(Kind::Exchange, theta));
    let opening = (after - before) / ((to - from) * solver.length);
    let time = f64::from(solver.start + past * solver.length);
    Some(Crossing { time, pedestrian: n, rate, spacing, opening })
}

/// A place where the value is negative, between two where it is not, if its minimum there is.
fn lowest(at: &mut impl FnMut(f64) -> f64, from: f64, to: f64) -> Option<f64> {
    let (mut low, mut high) = (from, to);
    for _ in 0..60 {
        let (left, right) = (low + (high - low) / 3.0, high - (high - low) / 3.0);
        let (at_left, at_right) = (at(left), at(right));
        if at_left < 0.0 || at_right < 0.0 {
            return Some(if at_left < 0.0 { left } else { right });
        }
        if at_left < at_right { high = right } else { low = left }
    }
    None
}
