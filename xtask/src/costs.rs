//! Chooses the figures that fit into a time budget.

use crate::child::Usage;
use crate::plan::{self, Needs, Node};
use crate::record::FigureState;
use crate::verbs::figures::{Times, forecast};
use checkout::costs::{Cost, Costs};
use checkout::failure::Failure;
use checkout::figure::Figure;
use checkout::paths::Paths;

/// The cost of a program that has ended, and the bytes that it left.
pub fn of(usage: Usage, bytes: u64) -> Cost {
    Cost { cpu: usage.cpu, memory: usage.memory as f64 / 1_048_576.0, disk: bytes as f64 / 1024.0 }
}

/// Figures that fit into a time, and those that do not, each with the seconds that it takes alone.
#[derive(Clone, Debug, Default)]
pub struct Choice<'a> {
    /// In the order of the figures.
    pub fits: Vec<&'a Figure>,
    /// In the order of the figures.
    pub left_out: Vec<(&'a Figure, f64)>,
    /// Seconds that all that fit take together.
    pub seconds: f64,
}

/// The figures that fit into `budget` seconds on the given number of threads, the cheapest first. Seconds are those of
/// the last runs on this machine, or else the committed ones. A program for which neither is known does not fit.
///
/// # Errors
/// A stored run cannot be read.
pub fn choose<'a>(
    scratch: &Paths,
    surveys: &[FigureState<'a>],
    (times, costs): (&Times, &Costs),
    threads: usize,
    budget: f64,
) -> Result<Choice<'a>, Failure> {
    let last = |node: &Node| times.get(&node.name).copied().or_else(|| costs.get(&node.name).map(|cost| cost.cpu));
    let seconds = |chosen: &[bool]| {
        let needs: Vec<Needs> = chosen.iter().map(|&draw| Needs { draw, measure: false }).collect();
        let nodes = plan::make(scratch, surveys, &needs, true)?;
        let forecast = forecast(&nodes, threads, &last);
        Ok(if forecast.unknown > 0 { f64::INFINITY } else { forecast.seconds })
    };
    let only = |index: usize| (0..surveys.len()).map(|other| other == index).collect::<Vec<bool>>();
    let alone = (0..surveys.len()).map(|index| seconds(&only(index))).collect::<Result<Vec<f64>, Failure>>()?;
    let mut order: Vec<usize> = (0..surveys.len()).collect();
    order.sort_by(|&one, &other| alone[one].total_cmp(&alone[other]));
    let (mut chosen, mut taken) = (vec![false; surveys.len()], 0.0);
    for index in order {
        let mut more = chosen.clone();
        more[index] = true;
        let needed = seconds(&more)?;
        if needed <= budget {
            (chosen, taken) = (more, needed);
        }
    }
    let figures = || surveys.iter().map(|survey| survey.figure).zip(&chosen);
    Ok(Choice {
        fits: figures().filter(|(_, chosen)| **chosen).map(|(figure, _)| figure).collect(),
        left_out: figures().zip(alone).filter(|((_, fits), _)| !**fits).map(|((figure, _), s)| (figure, s)).collect(),
        seconds: taken,
    })
}
