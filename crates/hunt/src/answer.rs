//! The second integration, twice, so that it tells its own error.

use math::twofold::Twofold;
use reference::flow::Form;
use reference::solution::{End, Kind, Question, Sample, Solution, solve};
use reference::solver::Care;

/// Speeds beyond so many desired speeds are a blow-up.
const FASTEST: f64 = 1e6;

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
    Twofold,
}

impl Answer {
    /// Answers the question.
    pub fn new(question: &Question, numbers: Numbers) -> Answer {
        let care = |nodes, tolerance, most_work| Care { nodes, tolerance, most_work };
        let form = Form::Differences;
        match numbers {
            Numbers::Doubles => Answer {
                solution: solve::<f64>(question, form, care(12, 1e-13, 10_000_000), FASTEST),
                second: solve::<f64>(question, form, care(9, 1e-13, 15_000_000), FASTEST),
            },
            Numbers::Twofold => Answer {
                solution: solve::<Twofold>(question, form, care(20, 1e-20, 1_000_000), FASTEST),
                second: solve::<Twofold>(question, form, care(16, 1e-19, 1_000_000), FASTEST),
            },
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
}
