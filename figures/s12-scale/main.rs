//! Supplement 12: the cost per pedestrian and step of Heun's scheme on rings of 10 to 10^7, from archived timings.

use figures::panels::points;
use figures::{Failure, Job, figure};
use plot::style::COLUMN_WIDTH;
use plot::{Axis, Corner, Lines, Picture, Series};
use std::process::ExitCode;

fn main() -> ExitCode {
    figure(env!("CARGO_BIN_NAME"), tables, picture)
}

fn tables(job: &mut Job) -> Result<(), Failure> {
    job.write("scale", &job.timing("scale")?)
}

/// Bytes that a pedestrian takes in one piece: positions and speeds now and guessed, and the acceleration.
const BYTES: f64 = 40.0;
/// Caches of the processor of data/timing/README.md, in bytes.
const CACHES: [(&str, f64); 3] = [("L1", 49_152.0), ("L2", 1_048_576.0), ("L3", 33_554_432.0)];

fn picture(job: &Job) -> Result<Picture, Failure> {
    Ok(Picture::new(COLUMN_WIDTH, 110.0)
        .columns(1)
        .titled("algebraic law", panel(job, "algebraic", (0.3, 20.0), Corner::TopRight)?)
        .titled("logarithmic law", panel(job, "logarithmic", (3.0, 60.0), Corner::TopRight)?))
}

/// The variants of one law, with the caches marked.
fn panel(job: &Job, law: &str, (low, high): (f64, f64), corner: Corner) -> Result<Lines, Failure> {
    let table = job.read("scale")?;
    let axis = Axis::log10("pedestrians $N$", 10.0, 1e7);
    let mut lines = Lines::new(axis, Axis::log10("ns for a pedestrian and step", low, high)).legend(corner);
    for (variant, name) in
        [("four", "in one piece, AVX2"), ("eight", "in one piece, AVX-512"), ("blocks", "in blocks, AVX2")]
    {
        lines = lines.series(Series::line(name, points(&table, "n", &format!("{law}_{variant}"))?));
    }
    for (name, bytes) in CACHES {
        lines = lines.vertical(bytes / BYTES).note(name, (1.1 * bytes / BYTES, 1.1 * low));
    }
    Ok(lines)
}
