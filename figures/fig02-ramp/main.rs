//! Figure 2 (fig:theta): the ramp and its smooth approximations.

use figures::panels::points;
use figures::{Failure, Job, figure};
use plot::style::COLUMN_WIDTH;
use plot::{Axis, Lines, Picture, Series};
use std::process::ExitCode;

fn main() -> ExitCode {
    figure(env!("CARGO_BIN_NAME"), Job::compute_panels, picture)
}

/// Tables and names of the approximations, the one of the simulations first.
const CURVES: [(&str, &str); 3] =
    [("eps_01", "$\\varepsilon = 0.1$"), ("eps_03", "$\\varepsilon = 0.3$"), ("eps_05", "$\\varepsilon = 0.5$")];

fn picture(job: &Job) -> Result<Picture, Failure> {
    let mut panel =
        Lines::new(Axis::linear("$x$", -1.0, 1.0).steps(4), Axis::linear("$r_\\varepsilon(x)$", 0.0, 1.2).steps(4));
    let ramp = points(&job.read(CURVES[0].0)?, "x", "ramp")?;
    panel = panel.series(Series::line("ramp $r(x)$", ramp).look(2).solid().thick(2.0));
    for (look, (table, name)) in [0, 1, 3].into_iter().zip(CURVES) {
        panel = panel.series(Series::line(name, points(&job.read(table)?, "x", "smooth")?).look(look));
    }
    Ok(Picture::new(COLUMN_WIDTH, 60.0).panel(panel))
}
