//! Supplement 18: what an unstable uniform flow becomes, over planes of parameters. The paper asks for it and looks at three
//! points. A plane takes minutes, so its table is committed (`data/outcomes`); `checks/outcomes.sh` computes it again.

use figures::planes::grid;
use figures::{Failure, Job, figure};
use plot::Picture;
use plot::style::FULL_WIDTH;
use std::process::ExitCode;

fn main() -> ExitCode {
    figure(env!("CARGO_BIN_NAME"), tables, picture)
}

/// The panels with their titles.
const PLANES: [(&str, &str); 4] = [
    ("logarithmic", "logarithmic"),
    ("exponential", "exponential"),
    ("relative", "algebraic, $\\langle\\mu, 1, 2, 0\\rangle$"),
    ("plain", "algebraic, $\\langle\\mu, 0, 2, 0\\rangle$"),
];

fn tables(job: &mut Job) -> Result<(), Failure> {
    PLANES.iter().try_for_each(|(panel, _)| job.take_outcomes(panel))
}

fn picture(job: &Job) -> Result<Picture, Failure> {
    let planes = PLANES.iter().map(|(panel, _)| job.plane(panel)).collect::<Result<Vec<_>, Failure>>()?;
    let named = PLANES.iter().zip(&planes).map(|((_, title), (sweep, cells))| (*title, sweep, &cells[..]));
    grid(&named.collect::<Vec<_>>(), 2, [FULL_WIDTH, 150.0])
}
