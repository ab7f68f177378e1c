//! Figure 2 (fig:theta): the ramp and its smooth approximations.

use figures::panels::points;
use figures::titles::{title, value};
use figures::{Failure, Job, figure};
use plot::style::COLUMN_WIDTH;
use plot::{Axis, Lines, Picture, Series};
use std::process::ExitCode;

fn main() -> ExitCode {
    figure(env!("CARGO_BIN_NAME"), Job::compute_panels, picture)
}

/// Places in the cycle of looks: the ramp's, and those of the approximations in the order of the scene's panels.
const RAMP: usize = 2;
const LOOKS: [usize; 3] = [0, 1, 3];

fn picture(job: &Job) -> Result<Picture, Failure> {
    let mut curves = Vec::new();
    let mut ramp = Vec::new();
    for panel in &job.scene_file.panels {
        let table = job.read(&panel.name)?;
        ramp = points(&table, "x", "ramp")?;
        curves.push((title(panel, &["curve.epsilon"]), points(&table, "x", "smooth")?));
    }
    let range = |key| job.scene_file.panels.first().and_then(|panel| value(&panel.tables, key)).unwrap_or(0.0);
    let heights = curves.iter().flat_map(|(_, curve)| curve).map(|point| point.1);
    let x = Axis::linear("$x$", range("curve.from"), range("curve.to")).steps(4);
    let mut panel = Lines::new(x, Axis::from_zero("$r_\\varepsilon(x)$", heights))
        .series(Series::line("ramp $r(x)$", ramp).look(RAMP).solid().thick(2.0));
    for (look, (name, curve)) in LOOKS.into_iter().cycle().zip(curves) {
        panel = panel.series(Series::line(&name, curve).look(look));
    }
    Ok(Picture::new(COLUMN_WIDTH, 60.0).panel(panel))
}
