//! Outcomes of the runs in a plane: `[sweep]` with two axes, beside `[law]`, `[ring]`, `[start]` and `[run]`.
//!
//! Each cell is a separate scene. Its result depends only on the scene file and the cell, so cells can be computed in
//! any order and on any machine. [`tiles`] decides which cells are computed.

mod cell;
mod pool;
mod read;
pub mod table;
pub mod tiles;

pub use cell::{CellOutcome, DecidedBy, Exact, NUMBERS, Precheck};
pub use pool::Pool;
pub use read::read;
pub use scene::axis::Axis;

use jam::laws::Model;
use jam::ring::{Ring, Start};
use jam::states::StateVariables;
use ode::{Control, Method};
use scene::run::AtOverlap;

/// A plane of runs.
#[derive(Clone, Debug, PartialEq)]
pub struct Sweep {
    /// The horizontal axis.
    pub x: Axis,
    /// The vertical axis.
    pub y: Axis,
    /// Whether cells between others of one outcome are filled in without a run.
    pub refine: bool,
    /// The law; parameters that are an axis are replaced cell by cell.
    pub model: Model,
    /// The ring; as the law.
    pub ring: Ring,
    /// The effective gap of the uniform flow, where it is given in place of the length: the ring of each cell is as
    /// long as this gap asks for.
    pub gap: Option<f64>,
    /// The start; as the law.
    pub start: Start,
    /// The steady speed that is meant where a formula has several.
    pub speed: Option<f64>,
    /// How each cell is run.
    pub settings: Settings,
}

/// How the cells of a sweep are run.
#[derive(Clone, Debug, PartialEq)]
pub struct Settings {
    /// When waves are judged.
    pub t_end: f64,
    /// The method of integration.
    pub method: Method,
    /// The rule for the steps.
    pub control: Control,
    /// As many steps as a run may take.
    pub most_steps: u64,
    /// The form of the state, if the scene names one.
    pub form: Option<StateVariables>,
    /// Whether an overlap ends a run: for outcomes it always does.
    pub at_overlap: AtOverlap,
}

impl Sweep {
    /// The number of cells.
    pub fn cells(&self) -> usize {
        self.x.cells * self.y.cells
    }
}
