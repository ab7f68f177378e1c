//! Functions of one variable: `[curve]`, for the figures that show a function and no run.

use crate::law;
use files::reader::{FINITE, POSITIVE, Reader, SceneError, Section};
use files::table::Table;
use jam::laws::Model;
use jam::ramp::{ramp, smooth_ramp};

/// The table of a curve: `x, ramp, smooth` for the value `ramp` (fig:theta), `gap, force` for the value `force`: the
/// force on a pedestrian in a uniform flow at rest, in units of `v_0 / tau` (fig:log_f).
///
/// # Errors
/// What is missing, unknown or out of range, with file and line; a point where the function has no finite value.
pub fn table(file: &str, tables: &Section) -> Result<Table, SceneError> {
    let mut top = Reader::new(file, "scene", tables);
    let mut curve = Reader::new(file, "curve", top.section("curve")?);
    let value = curve.choice("value", &["ramp", "force"])?;
    let from = curve.number("from", FINITE)?;
    let to = curve.number("to", FINITE)?;
    if to <= from {
        return Err(curve.complaint("to", &format!("must be above from = {from:?}")));
    }
    let points = curve.count("points", 2, 1_000_000)?;
    let arguments = (0..points).map(|i| from + (to - from) * (i as f64 / (points - 1) as f64));
    let table = if value == "ramp" {
        let epsilon = curve.number("epsilon", POSITIVE)?;
        let mut table = Table::new(&["x", "ramp", "smooth"]);
        arguments.for_each(|x| table.push(&[x, ramp(x), smooth_ramp(x, epsilon)]));
        table
    } else {
        let model = law::read(file, top.section("law")?)?;
        let mut table = Table::new(&["gap", "force"]);
        arguments.for_each(|gap| table.push(&[gap, force(&model, gap)]));
        table
    };
    if let Some(row) = table.rows().find(|row| !row.iter().all(|number| number.is_finite())) {
        let problem = format!("there is no finite {value} at {:?}; leave it out, between from and to", row[0]);
        return Err(curve.complaint("value", &problem));
    }
    curve.finish()?;
    top.finish()?;
    Ok(table)
}

/// `|f| tau / v_0` at rest: what the drive of 1 is lessened by.
fn force(model: &Model, gap: f64) -> f64 {
    let v0 = model.desired_speed();
    (v0 - model.acceleration(gap, 0.0, 0.0)) / v0
}
