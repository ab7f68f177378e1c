//! Runs some cells of a committed plane again, under a scene with other numerics: cells that were filled in without a
//! run, or cells that were run. It prints a row of `data/outcomes/how_sure.csv`: the number of cells, the number with
//! another outcome, and of these the number in which both outcomes are decided.

use clap::{Parser, ValueEnum};
use figures::failure::{Failure, exit, print};
use files::scene_file;
use jam::outcome::Class;
use planes::picture::cells_of;
use std::path::PathBuf;
use std::process::ExitCode;
use sweep::DecidedBy;

/// What the command line asks for.
#[derive(Debug, Parser)]
struct Arguments {
    /// The scene file
    scene: PathBuf,
    /// Its panel
    panel: String,
    /// The table of its plane
    table: PathBuf,
    /// So many cells, evenly over the list of those of this kind
    count: usize,
    /// Which cells
    #[arg(value_enum)]
    kind: Kind,
    /// What was changed, for the row
    change: String,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
enum Kind {
    /// Those within a border of one outcome, without a run of their own
    Filled,
    /// Those that were run
    Run,
}

fn main() -> ExitCode {
    exit(again(&Arguments::parse()))
}

fn again(arguments: &Arguments) -> Result<(), Failure> {
    let scene_file = scene_file::read(&arguments.scene)?;
    let sweep = sweep::read(&scene_file.file, &scene_file.panel(&arguments.panel)?.tables)?;
    let name = arguments.table.display().to_string();
    let text = std::fs::read_to_string(&arguments.table).map_err(|error| Failure::input(format!("{name}: {error}")))?;
    let cells = cells_of(&name, &text, &sweep)?;
    let is_meant = |by: DecidedBy| match arguments.kind {
        Kind::Filled => by == DecidedBy::Neighbours,
        Kind::Run => matches!(by, DecidedBy::Run | DecidedBy::Both),
    };
    let all: Vec<usize> = (0..cells.len()).filter(|index| is_meant(cells[*index].decided_by)).collect();
    let count = arguments.count.min(all.len());
    // the middles of equal parts of the list, which goes up the columns of the plane
    let chosen = (0..count).map(|i| all[(2 * i + 1) * all.len() / (2 * count)]);
    let (mut differ, mut decided) = (0, 0);
    for index in chosen {
        let place = [index / sweep.y.cells, index % sweep.y.cells];
        let (before, now) = (cells[index].class, sweep.compute(place).map_err(Failure::input)?.class);
        differ += usize::from(before != now);
        decided += usize::from(before != now && ![before, now].contains(&Class::Undecided));
    }
    print(&format!("{},{},{count},{differ},{decided}", arguments.panel, arguments.change))
}
