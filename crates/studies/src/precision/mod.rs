//! Work and precision: the error of every method against what it costs, on the six scenes with a solution to 20 digits.
//!
//! Adaptive methods go through tolerances, steps of fixed length through halves, each until a run took as many
//! right-hand sides as are allowed. Errors and right-hand sides are the same on every machine; seconds are not, and go
//! to files of their own.

mod run;
pub mod scenes;

use crate::hard::rows::{Rows, row};
use figures::failure::{Failure, print};
use figures::job::finite_csv;
use files::write::{atomic, make_folder};
use math::double_double::DoubleDouble;
use ode::{Control, Method};
use run::{Measured, measure};
use scene::run::Scene;
use scenes::{Instant, Known, SCENES};
use std::path::{Path, PathBuf};

/// What the command line asks for.
#[derive(Debug, clap::Parser)]
#[command(name = "precision", about = "Measures error against work: every method, six scenes")]
pub struct Arguments {
    /// Folder for the tables; made if missing
    #[arg(long, value_name = "DIR")]
    out: PathBuf,
    /// Only this scene
    #[arg(long, value_name = "NAME", value_parser = SCENES.map(|known| known.name))]
    only: Option<String>,
    /// Only rows of few right-hand sides
    #[arg(long, conflicts_with = "full")]
    quick: bool,
    /// Rows of more right-hand sides as well
    #[arg(long)]
    full: bool,
    /// Measure seconds too, into this folder
    #[arg(long, value_name = "DIR", num_args = 0..=1, default_missing_value = "data/timing")]
    seconds: Option<PathBuf>,
    /// Folder of the scenes
    #[arg(long, value_name = "DIR", default_value = "figures")]
    scenes: PathBuf,
    /// Folder of the solutions
    #[arg(long, value_name = "DIR", default_value = "data/reference/solutions")]
    solutions: PathBuf,
}

impl Arguments {
    /// A method continues to finer steps while its last run took less than half of these right-hand sides.
    fn most(&self) -> u64 {
        match (self.quick, self.full) {
            (true, _) => 20_000,
            (_, true) => 60_000_000,
            _ => 4_000_000,
        }
    }
}

/// Measures the scenes asked for and writes each table as soon as its scene is done.
///
/// # Errors
/// A scene or a solution cannot be read, or a file cannot be written.
pub fn main(arguments: &Arguments) -> Result<(), Failure> {
    let wanted = |known: &&Known| arguments.only.as_ref().is_none_or(|only| known.name == only);
    for folder in [Some(&arguments.out), arguments.seconds.as_ref()].into_iter().flatten() {
        make_folder(folder)?;
    }
    for known in SCENES.iter().filter(wanted) {
        let problem = Problem::read(known, &arguments.scenes, &arguments.solutions)?;
        let tables = problem.tables(arguments.most(), arguments.seconds.is_some());
        let name = format!("precision_{}", known.name);
        atomic(&arguments.out.join(format!("{name}.csv")), &finite_csv(&name, &tables.work)?)?;
        if let Some(folder) = &arguments.seconds {
            atomic(&folder.join(format!("{name}.csv")), &finite_csv(&name, &tables.seconds)?)?;
        }
        print(&format!("{name}.csv: {} rows", tables.work.len()))?;
    }
    Ok(())
}

/// A scene and its solution.
struct Problem {
    scene: Scene,
    solution: Vec<Instant>,
}

/// What is measured of a scene.
struct Tables {
    work: Rows,
    seconds: Rows,
}

impl Problem {
    fn read(known: &Known, scenes: &Path, solutions: &Path) -> Result<Problem, Failure> {
        let ring = known.scene(scenes, &[])?.ring;
        let headway = DoubleDouble::from(ring.length) / DoubleDouble::from(ring.pedestrians as f64);
        let solution = known.solution(solutions, headway)?;
        Ok(Problem { scene: known.scene(scenes, &solution)?, solution })
    }

    /// Rows of all methods; `most`: see [`Arguments::most`].
    fn tables(&self, most: u64, is_timed: bool) -> Tables {
        let columns =
            ["method", "order", "control", "right_hand_sides", "steps", "rejected", "error_gap", "error_speed", "stop"];
        let mut tables = Tables { work: Rows::new(&columns), seconds: Rows::new(&["method", "control", "seconds"]) };
        for method in Method::ALL {
            for (control, size) in ladder(method) {
                let measured = measure(&self.scene, method, control, &self.solution);
                let Measured { evaluations, steps, rejected, errors, stop, .. } = measured;
                let (gap, speed) = errors.unzip();
                let stop = stop.unwrap_or("none");
                tables.work.push(row![
                    method.name(),
                    method.order(),
                    size,
                    evaluations,
                    steps,
                    rejected,
                    gap,
                    speed,
                    stop
                ]);
                if is_timed && errors.is_some() {
                    let seconds = self.least_seconds(method, control, measured.seconds);
                    tables.seconds.push(row![method.name(), size, seconds]);
                }
                if 2 * evaluations.unwrap_or(steps) >= most {
                    break;
                }
            }
        }
        tables
    }

    /// The least seconds of some runs of the same, so that a short one is not measured by chance.
    fn least_seconds(&self, method: Method, control: Control, first: f64) -> f64 {
        let again = |_| measure(&self.scene, method, control, &self.solution).seconds;
        (0..repeats(first)).map(again).fold(first, math::smaller)
    }
}

/// The number of repetitions of a run that takes the given number of seconds.
fn repeats(seconds: f64) -> u32 {
    match seconds {
        s if s < 0.02 => 9,
        s if s < 0.2 => 4,
        _ => 0,
    }
}

/// The rules for the steps, coarse to fine, each with the number that stands for it in tables: tolerances in decades,
/// or steps that are powers of two, which meet the times of the solution without rounding.
fn ladder(method: Method) -> Vec<(Control, f64)> {
    if method.is_adaptive() {
        TOLERANCES.map(|tolerance| (Control::Adaptive { tolerance }, tolerance)).to_vec()
    } else {
        let steps = (0..=FINEST).map(|power| 1.0 / (1_u64 << power) as f64);
        steps.map(|step| (Control::Fixed { step }, step)).collect()
    }
}

const TOLERANCES: [f64; 13] = [1e-3, 1e-4, 1e-5, 1e-6, 1e-7, 1e-8, 1e-9, 1e-10, 1e-11, 1e-12, 1e-13, 1e-14, 1e-15];
/// The finest step is 2 to the minus this.
const FINEST: u32 = 20;
