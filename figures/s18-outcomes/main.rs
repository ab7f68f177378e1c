//! Supplement 18: what an unstable uniform flow becomes, over planes of parameters. The paper asks for it and looks at three
//! points. A plane takes minutes, so its table is committed (`data/outcomes`); `checks/outcomes.sh` computes it again.

use figures::planes::grid;
use figures::{Failure, Job, figure};
use files::table::{Cell, Sheet};
use jam::outcome::Class;
use plot::Picture;
use plot::style::FULL_WIDTH;
use scene::sweep::Sweep;
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
    let mut shares = Sheet::new(&["plane", "flow", "outcome", "cells", "share", "error"]);
    for (panel, _) in PLANES {
        job.take_outcomes(panel)?;
        let (sweep, cells) = job.plane(panel)?;
        let is_unstable = unstable(&sweep)?;
        for flow in ["unstable", "stable"] {
            let of_flow = cells.iter().zip(&is_unstable).filter(|(_, unstable)| **unstable == (flow == "unstable"));
            let classes: Vec<Class> = of_flow.map(|(cell, _)| cell.class).collect();
            let count = |class: Class| classes.iter().filter(|found| **found == class).count() as f64;
            let all = classes.len() as f64;
            // what is undecided may be anything
            let error = count(Class::Undecided) / all;
            for class in Class::ALL.into_iter().filter(|class| all > 0.0 && count(*class) > 0.0) {
                let number = Cell::Number;
                let row = [
                    Cell::from(panel),
                    Cell::from(flow),
                    Cell::from(class.name()),
                    number(count(class)),
                    number(count(class) / all),
                    number(error),
                ];
                shares.push(&row[..]);
            }
        }
    }
    job.write_rows("shares", &shares)
}

/// Whether the uniform flow of each cell is unstable against waves of any length, column by column; false where there is none.
fn unstable(sweep: &Sweep) -> Result<Vec<bool>, Failure> {
    let at = |index: usize| [(index / sweep.y.cells) as f64 + 0.5, (index % sweep.y.cells) as f64 + 0.5];
    let exact = (0..sweep.cells()).map(|index| sweep.exact(at(index)).map(|exact| exact.margin > 0.0));
    Ok(exact.collect::<Result<Vec<bool>, String>>()?)
}

fn picture(job: &Job) -> Result<Picture, Failure> {
    let planes = PLANES.iter().map(|(panel, _)| job.plane(panel)).collect::<Result<Vec<_>, Failure>>()?;
    let named = PLANES.iter().zip(&planes).map(|((_, title), (sweep, cells))| (*title, sweep, &cells[..]));
    grid(&named.collect::<Vec<_>>(), 2, [FULL_WIDTH, 150.0])
}
