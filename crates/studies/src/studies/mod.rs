//! Studies of errors: the effect of rounding on Heun's scheme, growth rates of waves against the linear theory, and the
//! growth of errors (discussed in the numerical supplement of the article).

mod error_growth;
mod heun;
mod mode_growth;
pub mod optimum;
mod rounding;
mod solution;
mod verbatim;

use crate::hard::Tables;
use crate::hard::run::figure_4;
use figures::failure::{Failure, print};
use figures::job::finite_csv;
use files::write::{atomic, make_folder};
use heun::{Adding, Sum};
use jam::laws::Model;
use jam::ring::{Ring, Start};
use jam::states::{RingSystem, StateVariables};
use std::path::PathBuf;

/// What the command line asks for.
#[derive(Debug, clap::Parser)]
#[command(name = "studies", about = "Computes the tables of rounding, growth rates and growth of errors")]
pub struct Arguments {
    /// Folder for the tables; made if missing
    #[arg(long, value_name = "DIR")]
    out: PathBuf,
    /// Only the studies whose name starts so
    #[arg(long, value_name = "NAME")]
    only: Option<String>,
    /// Long steps, short runs, few waves: some seconds
    #[arg(long)]
    quick: bool,
    /// Steps down to 1e-5 and runs to t = 2000: some minutes
    #[arg(long, conflicts_with = "quick")]
    full: bool,
    /// Folder of the reference solutions
    #[arg(long, value_name = "DIR", default_value = "data/reference/solutions")]
    solutions: PathBuf,
}

/// How much of a study is wanted. The rows of a smaller extent are rows of the larger ones.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Extent {
    Quick,
    Usual,
    Full,
}

/// Computes the tables of a study from the reference solutions in a folder.
type Compute = fn(Extent, &std::path::Path) -> Result<Tables, Failure>;

/// The studies by name.
const STUDIES: [(&str, Compute); 4] = [
    ("rounding", rounding::tables),
    ("verbatim", verbatim::tables),
    ("mode_growth", mode_growth::tables),
    ("error_growth", error_growth::tables),
];

/// Computes the studies asked for and writes each table as soon as its study is done.
///
/// # Errors
/// A reference solution cannot be read, a run failed, a table holds a number that is not finite, or a file cannot be
/// written.
pub fn main(arguments: &Arguments) -> Result<(), Failure> {
    let extent = match (arguments.quick, arguments.full) {
        (true, _) => Extent::Quick,
        (_, true) => Extent::Full,
        _ => Extent::Usual,
    };
    let wanted = |name: &str| arguments.only.as_ref().is_none_or(|only| name.starts_with(only.as_str()));
    make_folder(&arguments.out)?;
    for (_, compute) in STUDIES.into_iter().filter(|(name, _)| wanted(name)) {
        for (name, rows) in compute(extent, &arguments.solutions)? {
            atomic(&arguments.out.join(format!("{name}.csv")), &finite_csv(name, &rows)?)?;
            print(&format!("{name}.csv: {} rows", rows.len()))?;
        }
    }
    Ok(())
}

/// The law and the ring of figure 4, stable panel.
fn figure_4_stable() -> (Model, Ring) {
    (figure_4(0.45), Ring { pedestrians: 67, length: 200.0 })
}

/// Its shift of the first pedestrian.
const SHIFT: f64 = 1e-4;

/// A state in which rounding is studied.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum State {
    /// One of the forms that every run can have.
    RingSystem(StateVariables),
    /// Positions in `[0, L)` ([`heun::Wrapped`]).
    Wrapped,
}

/// The states, with their names.
const STATES: [(State, &str); 4] = [
    (State::RingSystem(StateVariables::Positions), "positions"),
    (State::Wrapped, "wrapped"),
    (State::RingSystem(StateVariables::Spacings), "gaps"),
    (State::RingSystem(StateVariables::Deviations), "deviations"),
];

/// A run of figure 4's stable scene by Heun's scheme, in one of these states.
struct Run {
    state: State,
    form: Box<dyn RingSystem>,
    /// What the form is built from.
    model: Model,
    ring: Ring,
    sum: Sum,
}

impl Run {
    /// At the start. Wrapped positions start as unwrapped ones do.
    fn new(state: State) -> Run {
        let (model, ring) = figure_4_stable();
        let start = |kind: StateVariables| kind.build(&model, ring).start(Start { shift: SHIFT });
        let (kind, begin) = match state {
            State::RingSystem(kind) => (kind, start(kind)),
            State::Wrapped => (StateVariables::Spacings, start(StateVariables::Positions)),
        };
        Run { state, form: kind.build(&model, ring), model, ring, sum: Sum::new(begin) }
    }

    /// Goes on for a time that is a multiple of the step `h`.
    fn advance(&mut self, h: f64, time: f64, adding: Adding) -> Result<(), Failure> {
        match self.state {
            State::RingSystem(_) => self.sum.advance(&*self.form, h, time, adding),
            State::Wrapped => {
                let (contact, length) = (self.model.contact(), self.ring.length);
                heun::Wrapped { gaps: &*self.form, contact, length }.advance(&mut self.sum, h, time, adding);
                Ok(())
            }
        }
    }

    /// The standard deviation of the speeds.
    fn speed_std(&self) -> f64 {
        match self.state {
            State::RingSystem(_) => self.form.speed_std(&self.sum.state),
            State::Wrapped => {
                let positions = StateVariables::Positions.build(&self.model, self.ring);
                positions.speed_std(&self.sum.state)
            }
        }
    }
}
