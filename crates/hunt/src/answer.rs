//! The second integration. It is done twice, so that it estimates its own error.

use math::double_double::DoubleDouble;
use reference::flow::Form;
use reference::number::Real;
use reference::solution::{Crossing, End, Kind, Question, Sample, Solution, solve};
use reference::solver::Care;

/// Speeds above this multiple of the desired speed are a blow-up: they double with every throw by a wall.
const FASTEST: f64 = 1e6;
/// Where there is no wall, they may grow as long as the ring has time: above what a run calls a blow-up.
const FASTEST_WITHOUT_WALL: f64 = jam::events::BLOW_UP;

/// Two solutions that differ in the nodes of their steps.
#[derive(Clone, Debug)]
pub struct Answer {
    /// The one that counts.
    pub solution: Solution,
    /// The other.
    pub second: Solution,
}

/// The numbers of the second integration.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Numbers {
    /// Doubles.
    Doubles,
    /// Unevaluated sums of two doubles.
    DoubleDouble,
}

impl Answer {
    /// Answers the question.
    pub fn new(question: &Question, numbers: Numbers) -> Answer {
        match numbers {
            Numbers::Doubles => pair::<f64>(question, [(12, 1e-13), (9, 1e-13)], 20_000_000),
            Numbers::DoubleDouble => pair::<DoubleDouble>(question, [(20, 1e-20), (16, 1e-19)], 1_000_000),
        }
    }

    /// The sample at this time, and its twin.
    pub fn at(&self, time: f64) -> Option<(&Sample, &Sample)> {
        let find = |solution: &Solution| solution.samples.iter().position(|sample| sample.time == time);
        Some((&self.solution.samples[find(&self.solution)?], &self.second.samples[find(&self.second)?]))
    }

    /// Whether both reach this time, or end alike.
    pub fn is_settled(&self, time: f64) -> bool {
        let (first, second) = (&self.solution, &self.second);
        first.time >= time && second.time >= time || first.end == second.end && first.end != End::Unfinished
    }

    /// The first crossings of a kind: for each pedestrian the time, its uncertainty, and the rate.
    pub fn crossings(&self, kind: Kind) -> Vec<(usize, f64, f64, f64)> {
        let of = |solution: &Solution| {
            let first = solution.events.iter().find(|first| first.kind == kind);
            first.map_or(Vec::new(), |first| first.crossings.clone())
        };
        let others = of(&self.second);
        of(&self.solution)
            .iter()
            .map(|crossing| {
                let other = others.iter().find(|other| other.pedestrian == crossing.pedestrian);
                let uncertainty = other.map_or(f64::INFINITY, |other| (other.time - crossing.time).abs());
                (crossing.pedestrian, crossing.time, uncertainty, crossing.rate)
            })
            .collect()
    }

    /// The least value of what falls through 0 in events of this kind, and when that was.
    pub fn least(&self, kind: Kind) -> (f64, f64) {
        let index = Kind::ALL.iter().position(|other| *other == kind).unwrap_or(0);
        self.solution.least[index]
    }

    /// The first crossing of a kind by this pedestrian, and its twin.
    pub fn crossing(&self, kind: Kind, pedestrian: usize) -> Option<(&Crossing, &Crossing)> {
        fn find(solution: &Solution, kind: Kind, pedestrian: usize) -> Option<&Crossing> {
            let first = solution.events.iter().find(|first| first.kind == kind)?;
            first.crossings.iter().find(|crossing| crossing.pedestrian == pedestrian)
        }
        Some((find(&self.solution, kind, pedestrian)?, find(&self.second, kind, pedestrian)?))
    }
}

/// Solutions with the given numbers of nodes and tolerances. The second is not tried if the first does not finish.
fn pair<T: Real>(question: &Question, cares: [(usize, f64); 2], most_work: u64) -> Answer {
    let fastest = if question.formula.is_singular() { FASTEST } else { FASTEST_WITHOUT_WALL };
    let solved = |(nodes, tolerance), most_work| {
        solve::<T>(question, Form::Differences, Care { nodes, tolerance, most_work }, fastest)
    };
    let solution = solved(cares[0], most_work);
    // fewer nodes take more steps
    let second = if solution.end == End::Unfinished { solution.clone() } else { solved(cares[1], 3 * most_work / 2) };
    Answer { solution, second }
}
