//! Reads a sweep from the tables of a scene.

use super::{Settings, Sweep};
use files::reader::{Entry, FINITE, POSITIVE, Reader, SceneError, Section, Value};
use jam::laws::Model;
use jam::ring::{Ring, Start};
use ode::{Control, Method};
use scene::axis::{Axis, law_of_plane};
use scene::law;
use scene::run::{self, AtOverlap, FORMS};

/// As many cells as a sweep may have: 100 bytes each.
const MOST_CELLS: usize = 400_000_000;

/// As many pedestrians as a run may have.
const MOST_PEDESTRIANS: usize = 10_000_000;

/// Reads a sweep from the tables of a panel.
///
/// # Errors
/// What is missing, unknown or out of range, with file and line; an axis that is no parameter.
pub fn read(file: &str, tables: &Section) -> Result<Sweep, SceneError> {
    let mut top = Reader::new(file, "scene", tables);
    let section = top.section("sweep")?;
    let mut sweep = Reader::new(file, "sweep", section);
    if sweep.has("value") {
        sweep.one_of("value", &[("outcome", ())])?;
    }
    let [x_section, y_section] = [sweep.section("x")?, sweep.section("y")?];
    let (x, y) = (axis(file, "sweep.x", x_section)?, axis(file, "sweep.y", y_section)?);
    let refine = !sweep.has("refine") || sweep.flag("refine")?;
    sweep.finish()?;
    if x.cells.saturating_mul(y.cells) > MOST_CELLS {
        let problem = format!("{} x {} cells; there must be at most {MOST_CELLS}", x.cells, y.cells);
        return Err(Reader::new(file, "sweep.x", x_section).complaint("cells", &problem));
    }
    let mut tables = tables.clone();
    for (name, section, axis) in [("sweep.x", x_section, &x), ("sweep.y", y_section, &y)] {
        let place = Reader::new(file, name, section);
        if name == "sweep.y" && axis.parameter == x.parameter {
            return Err(place.complaint("parameter", "is the other axis as well"));
        }
        if [&x, &y].iter().filter(|axis| ["headway", "d_gap"].contains(&axis.parameter.as_str())).count() == 2 {
            return Err(
                place.complaint("parameter", "headway and d_gap determine each other: one of them must be an axis")
            );
        }
        if let Some(law) = tables.section("law").and_then(law::built_in) {
            fits(&law, axis).map_err(|problem| place.complaint("parameter", &problem))?;
            if let (false, Some(problem)) = (OF_THE_RUN.contains(&axis.parameter.as_str()), axis.negative()) {
                return Err(place.complaint("from", &problem));
            }
        }
        hold_place(file, &mut tables, axis, section)?;
    }
    let gap = gap(file, &mut tables, [&x, &y])?;
    let mut held = Reader::new(file, "scene", &tables);
    let law_tables = held.section("law")?;
    let model = law_of_plane(law_tables, [&x, &y], |at| {
        let mut law = law_tables.clone();
        for (axis, value) in [&x, &y].into_iter().zip(at) {
            if !OF_THE_RUN.contains(&axis.parameter.as_str())
                && let Some(entry) = law.entries.get_mut(&axis.parameter)
            {
                entry.value = Value::Number(value);
            }
        }
        law::read(file, &law)
    })?;
    if matches!(model, Model::Formula(_)) {
        for (name, section, axis) in [("sweep.x", x_section, &x), ("sweep.y", y_section, &y)] {
            fits(&model, axis).map_err(|problem| Reader::new(file, name, section).complaint("parameter", &problem))?;
        }
    }
    if let Model::Formula(formula) = &model
        && formula.speed_scale().is_none()
    {
        let problem = "an outcome needs the size of speeds: a parameter v0, or scale = x; there must be one of them";
        return Err(Reader::new(file, "law", held.section("law")?).complaint("scale", problem));
    }
    let mut reader = Reader::new(file, "ring", held.section("ring")?);
    let pedestrians = reader.count("pedestrians", 2, MOST_PEDESTRIANS)?;
    let ring = Ring { pedestrians, length: reader.number("length", POSITIVE)? };
    reader.finish()?;
    let mut reader = Reader::new(file, "start", held.section("start")?);
    let start = Start { shift: reader.number("shift", FINITE)? };
    reader.finish()?;
    let speed = match (&model, held.has("uniform")) {
        (_, false) => None,
        (Model::Formula(_), _) => run::uniform_speed(file, held.section("uniform")?)?,
        // read above
        (_, true) => held.section("uniform").map(|_| None)?,
    };
    let settings = settings(file, held.section("run")?, &model)?;
    held.section("sweep")?;
    held.finish()?;
    Ok(Sweep { x, y, refine, model, ring, gap, start, speed, settings })
}

/// Axes that are no parameters of a law: the shift of pedestrian 0; headway and effective gap of the uniform flow, with
/// the number of pedestrians kept; that number, with the headway kept.
pub(super) const OF_THE_RUN: [&str; 4] = ["shift", "headway", "d_gap", "pedestrians"];

fn axis(file: &str, name: &'static str, section: &Section) -> Result<Axis, SceneError> {
    let mut reader = Reader::new(file, name, section);
    let parameters = "a parameter of the law, shift, headway, d_gap or pedestrians";
    let mut axis = Axis::read(&mut reader, parameters, 20_000)?;
    axis.is_log = reader.has("scale") && reader.one_of("scale", &[("linear", false), ("log", true)])?;
    axis.is_whole = axis.parameter == "pedestrians";
    if axis.is_log && axis.from <= 0.0 {
        return Err(reader.complaint("from", "must be a number > 0.0 where scale = \"log\""));
    }
    if axis.is_whole && axis.from < 2.0 {
        return Err(reader.complaint("from", "must be a number >= 2.0"));
    }
    if axis.is_whole && axis.to > MOST_PEDESTRIANS as f64 {
        return Err(reader.complaint("to", &format!("must be a number <= {MOST_PEDESTRIANS}")));
    }
    reader.finish()?;
    Ok(axis)
}

/// The effective gap of the uniform flow, where `[uniform]` gives it instead of the ring's length, which is arbitrary
/// until the cells set it. For a formula, `[uniform]` selects the steady speed.
fn gap(file: &str, tables: &mut Section, axes: [&Axis; 2]) -> Result<Option<f64>, SceneError> {
    let (Some(law), Some(uniform)) = (tables.section("law").and_then(law::built_in), tables.section("uniform")) else {
        return Ok(None);
    };
    let mut reader = Reader::new(file, "uniform", uniform);
    let (gap, line) = (reader.number("d_gap", POSITIVE)?, uniform.line);
    if !law.has_effective_gap() {
        let problem = format!("the {} law needs the headway, not d_gap: give ring.length", law.name());
        return Err(reader.complaint("d_gap", &problem));
    }
    if let Some(axis) = axes.into_iter().find(|axis| ["headway", "d_gap"].contains(&axis.parameter.as_str())) {
        let problem = format!("is set by the axis {} of the sweep: leave it out here", axis.parameter);
        return Err(reader.complaint("d_gap", &problem));
    }
    reader.finish()?;
    let ring = tables.entries.entry("ring".to_owned());
    let ring = ring.or_insert_with(|| Entry::new(line, Value::Section(Section::default())));
    if let Value::Section(ring) = &mut ring.value {
        if ring.entries.contains_key("length") {
            let problem = "is set by uniform.d_gap: leave it out here";
            return Err(Reader::new(file, "ring", ring).complaint("length", problem));
        }
        ring.entries.insert("length".to_owned(), Entry::new(line, Value::Number(gap)));
    }
    Ok(Some(gap))
}

/// The tolerance of a cell's run where the scene names neither `tolerance` nor `dt`.
const TOLERANCE: f64 = 1e-6;

/// `[run]` of a sweep: nothing is sampled and nothing recorded.
fn settings(file: &str, section: &Section, model: &Model) -> Result<Settings, SceneError> {
    let mut run = Reader::new(file, "run", section);
    let t_end = run.number("t_end", POSITIVE)?;
    let method = run::method(&mut run)?.unwrap_or(Method::Taylor);
    let control = run::control(&mut run, method, TOLERANCE)?;
    let form = if run.has("state") { Some(run.one_of("state", &FORMS)?) } else { None };
    let most_steps = run.optional_number("most_steps", 1.0..=1e11)?.map_or(MOST_STEPS, |most| most as u64);
    if run::at_overlap(&mut run, model)? == AtOverlap::Continue {
        return Err(run.complaint("at_overlap", "contact is an outcome and ends a run; must be \"stop\""));
    }
    for key in ["sample", "record"] {
        if run.has(key) {
            return Err(run.complaint(key, "a sweep keeps no samples: leave it out"));
        }
    }
    if let Control::Fixed { step } = control
        && t_end / step > MOST_STEPS as f64
    {
        return Err(run.complaint("dt", &format!("gives {:e} steps; must be at most {MOST_STEPS:e}", t_end / step)));
    }
    run.finish()?;
    Ok(Settings { t_end, method, control, most_steps, form, at_overlap: AtOverlap::Stop })
}

/// More steps than any cell has a use for.
const MOST_STEPS: u64 = 1_000_000_000;

/// A parameter that is an axis is omitted from its table; it has an arbitrary value until the cells set it.
fn hold_place(file: &str, tables: &mut Section, axis: &Axis, section: &Section) -> Result<(), SceneError> {
    let (table, key): (&'static str, &str) = match axis.parameter.as_str() {
        "shift" => ("start", "shift"),
        // the headway takes the place of the length
        "headway" | "d_gap" => ("ring", "length"),
        // the file's number gives the headway that is kept
        "pedestrians" => return Ok(()),
        name => ("law", name),
    };
    let line = section.entries.get("parameter").map_or(section.line, |entry| entry.line);
    let table_entry = tables.entries.entry(table.to_owned());
    let below = table_entry.or_insert_with(|| Entry::new(line, Value::Section(Section::default())));
    let Value::Section(below) = &mut below.value else { return Ok(()) };
    if below.entries.contains_key(key) {
        let problem = format!("is set by the axis {} of the sweep: leave it out here", axis.parameter);
        return Err(Reader::new(file, table, below).complaint(key, &problem));
    }
    below.entries.insert(key.to_owned(), Entry::new(line, Value::Number(axis.centre(0))));
    Ok(())
}

/// Whether an axis is a parameter of this law.
fn fits(model: &Model, axis: &Axis) -> Result<(), String> {
    let own = model.parameters();
    let name = axis.parameter.as_str();
    if name == "d_gap" && !model.has_effective_gap() {
        return Err(format!("the {} law needs the headway, not d_gap: must be headway", model.name()));
    }
    if OF_THE_RUN.contains(&name) || own.iter().any(|parameter| parameter == name) {
        return Ok(());
    }
    Err(format!(
        "the {} law has no parameter {name}; must be one of {}, {}",
        model.name(),
        own.join(", "),
        OF_THE_RUN.join(", ")
    ))
}
