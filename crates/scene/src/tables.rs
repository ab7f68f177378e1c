//! Tables of the samples of a run.

use files::table::Table;
use jam::run::Samples;

/// `t, std`.
pub fn std(samples: &Samples) -> Table {
    let mut table = Table::new(&["t", "std"]);
    samples.iter().for_each(|sample| table.push(&[sample.time, sample.std]));
    table
}

/// `t, n, x, v`: empty where trajectories are not kept.
pub fn trajectories(samples: &Samples) -> Table {
    let mut table = Table::new(&["t", "n", "x", "v"]);
    for sample in samples.iter() {
        for (n, (x, v)) in sample.positions.iter().zip(sample.speeds).enumerate() {
            table.push(&[sample.time, n as f64, *x, *v]);
        }
    }
    table
}
