//! Figure 1 (fig1): the quantities of single-file motion.

use figures::{Failure, Job, figure};
use plot::style::COLUMN_WIDTH;
use plot::{Color, Drawing, Picture, Point};
use std::process::ExitCode;

fn main() -> ExitCode {
    figure(env!("CARGO_BIN_NAME"), no_tables, picture)
}

fn no_tables(_job: &mut Job) -> Result<(), Failure> {
    Ok(())
}

/// A pedestrian: centre and half length `a_n` on the page, in millimetres.
struct Pedestrian {
    centre: f64,
    half: f64,
    index: &'static str,
}

const BEHIND: Pedestrian = Pedestrian { centre: 20.0, half: 11.0, index: "n" };
const AHEAD: Pedestrian = Pedestrian { centre: 61.0, half: 8.0, index: "n+1" };
/// Heights on the page: the lane, the top of the pedestrians, the rows of dimensions above and below.
const LANE: f64 = 14.0;
const TOP: f64 = 22.0;
const ABOVE: f64 = 30.0;
const BELOW: f64 = 8.5;
const AXIS: f64 = 3.0;
const FILL: Color = Color(0xdc, 0xe6, 0xf0);

fn picture(_job: &Job) -> Result<Picture, Failure> {
    let (behind, ahead) = (BEHIND, AHEAD);
    let (gap_from, gap_to) = (behind.centre + behind.half, ahead.centre - ahead.half);
    let drawing = Drawing::new().line((2.0, LANE), (81.0, LANE), 0.8);
    let drawing = pedestrian(pedestrian(drawing, &behind), &ahead)
        .dimension((behind.centre, ABOVE), (ahead.centre, ABOVE))
        .label("$\\Delta x_n$", middle(behind.centre, ahead.centre, ABOVE + 2.6))
        .dimension((gap_from, 18.0), (gap_to, 18.0))
        .label("$d_n$", middle(gap_from, gap_to, 20.6))
        .arrow((66.0, AXIS), (80.0, AXIS), 0.8)
        .label("$x$", (82.5, AXIS));
    Ok(Picture::new(COLUMN_WIDTH, 36.0).panel(drawing))
}

/// A pedestrian on the lane: box, centre with its position, half length, velocity.
fn pedestrian(drawing: Drawing, pedestrian: &Pedestrian) -> Drawing {
    let Pedestrian { centre, half, index } = *pedestrian;
    let middle_height = 0.5 * (LANE + TOP);
    drawing
        .rectangle((centre - half, LANE), (centre + half, TOP), FILL)
        .dashed((centre, AXIS + 2.5), (centre, ABOVE + 1.0))
        .dot((centre, middle_height), 0.7)
        .label(&format!("$x_{{{index}}}$"), (centre, AXIS))
        .dimension((centre - half, BELOW), (centre, BELOW))
        .dashed((centre - half, BELOW - 1.0), (centre - half, LANE))
        .label(&format!("$a_{{{index}}}$"), (centre - 0.5 * half, BELOW + 2.4))
        .arrow((centre + 1.5, middle_height), (centre + 7.0, middle_height), 1.0)
}

fn middle(from: f64, to: f64, height: f64) -> Point {
    (0.5 * (from + to), height)
}
