//! A validated time-dependent scene: `[law]`, `[ring]`, `[start]`, `[run]`.

use crate::law;
use files::reader::{FINITE, POSITIVE, Reader, SceneError, Section};
use jam::laws::Model;
use jam::ring::{Ring, Start};
pub use jam::run::{AtOverlap, Run as Scene};
use jam::run::{TOLERANCE, fitting, flow, too_wide, usual_method, without_value};
use jam::states::StateVariables;
use ode::{Control, Method};

/// As many rows as the table of a run may have, so that a slip in `sample` does not fill the memory (32 bytes a row).
const MOST_ROWS: f64 = 2e7;
/// Default limit on the number of fixed steps of a run: two orders of magnitude more than the longest run of the paper.
const MOST_FIXED_STEPS: u64 = 100_000_000_000;

/// Reads a scene from the tables of a panel.
///
/// # Errors
/// What is missing, unknown or out of range, with file and line; gaps that are closed at the start; no uniform flow.
pub fn read(file: &str, tables: &Section) -> Result<Scene, SceneError> {
    read_for(file, tables, Purpose::Run)
}

/// As [`read`], of a scene that is not to be run: it may have tables and steps beyond all bounds.
///
/// # Errors
/// As [`read`].
pub fn read_unrun(file: &str, tables: &Section) -> Result<Scene, SceneError> {
    read_for(file, tables, Purpose::Flow)
}

/// What a scene is read for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Purpose {
    /// To be run.
    Run,
    /// For its uniform flow.
    Flow,
}

fn read_for(file: &str, tables: &Section, purpose: Purpose) -> Result<Scene, SceneError> {
    let mut top = Reader::new(file, "scene", tables);
    let model = law::read(file, top.section("law")?)?;
    let top_start = top.section("start")?;
    let (ring, start) = ring(file, top.section("ring")?, top_start, &model)?;
    let mut ring_reader = Reader::new(file, "ring", top.section("ring")?);
    ring_reader.number("length", POSITIVE)?;
    let wanted = match &model {
        Model::Formula(_) => {
            if let Some(problem) = too_wide(&model, ring) {
                return Err(ring_reader.complaint("pedestrians", &problem));
            }
            if top.has("uniform") { uniform_speed(file, top.section("uniform")?)? } else { None }
        }
        _ => None,
    };
    let steady_speed =
        flow(&model, ring, wanted).map_err(|error| ring_reader.complaint("length", &error.to_string()))?;
    let mut run = Reader::new(file, "run", top.section("run")?);
    top.finish()?;

    let t_end = run.number("t_end", POSITIVE)?;
    let sample = run.number("sample", POSITIVE)?;
    let method = method(&mut run)?;
    let wanted = if run.has("state") { Some(run.one_of("state", &FORMS)?) } else { None };
    let form = fitting(wanted, &model, ring, steady_speed);
    let method = method.unwrap_or_else(|| usual_method(form, &model));
    let control = control(&mut run, method, TOLERANCE)?;
    if let Some((pedestrian, value)) = without_value(&*form.build(&model, ring), start, ring) {
        let problem = format!(
            "the formula has no value at the start: the acceleration of pedestrian {pedestrian} is {value:?}; it must be finite for every pedestrian"
        );
        return Err(Reader::new(file, "start", top_start).complaint("shift", &problem));
    }
    if !method.suits(&*form.build(&model, ring)) {
        let problem = format!("{} needs the state \"deviations\" or \"gaps\": positions have no series", method.name());
        return Err(run.complaint("method", &problem));
    }
    let keeps_trajectories = !run.has("record") || run.one_of("record", &[("std", false), ("trajectories", true)])?;
    let rows = (t_end / sample).floor() * if keeps_trajectories { ring.pedestrians as f64 } else { 1.0 };
    if rows > MOST_ROWS && purpose == Purpose::Run {
        let problem =
            format!("gives a table of {rows:e} rows, more than {MOST_ROWS:e}; sample less often, or record = \"std\"");
        return Err(run.complaint("sample", &problem));
    }
    let most_steps = most_steps(&mut run, control, t_end, purpose)?;
    if matches!(control, Control::Adaptive { .. }) && t_end < SHORTEST_RUN {
        let problem = format!("too short for adaptive steps; must be at least {SHORTEST_RUN:e}");
        return Err(run.complaint("t_end", &problem));
    }
    let at_overlap = at_overlap(&mut run, &model)?;
    run.finish()?;
    Ok(Scene {
        model,
        ring,
        start,
        displacements: Vec::new(),
        t_end,
        sample,
        method,
        control,
        most_steps,
        form,
        keeps_trajectories,
        steady_speed,
        at_overlap,
    })
}

/// Names of the forms of the state.
pub const FORMS: [(&str, StateVariables); 3] = [
    ("deviations", StateVariables::Deviations),
    ("gaps", StateVariables::Spacings),
    ("positions", StateVariables::Positions),
];

/// A run by adaptive steps is at least as long: far longer than the shortest of them.
const SHORTEST_RUN: f64 = 1e-250;

/// What happens at an overlap: `stop`, or `continue`, which a force that is infinite at contact does not allow.
///
/// # Errors
/// Another word, or a law that cannot continue.
pub fn at_overlap(run: &mut Reader<'_>, model: &Model) -> Result<AtOverlap, SceneError> {
    if !run.has("at_overlap") {
        return Ok(AtOverlap::Stop);
    }
    let choice = run.one_of("at_overlap", &[("stop", AtOverlap::Stop), ("continue", AtOverlap::Continue)])?;
    if choice == AtOverlap::Continue && model.is_singular() {
        let problem = format!(
            "the force of the {} law is infinite at contact, where a run cannot continue; must be \"stop\"",
            model.name()
        );
        return Err(run.complaint("at_overlap", &problem));
    }
    Ok(choice)
}

/// The steady speed that is meant, where a formula has several.
///
/// # Errors
/// Not a finite number, or an unknown key.
pub fn uniform_speed(file: &str, section: &Section) -> Result<Option<f64>, SceneError> {
    let mut reader = Reader::new(file, "uniform", section);
    let speed = reader.optional_number("speed", FINITE)?;
    reader.finish()?;
    Ok(speed)
}

fn ring(file: &str, ring: &Section, start: &Section, model: &Model) -> Result<(Ring, Start), SceneError> {
    let mut reader = Reader::new(file, "ring", ring);
    let ring =
        Ring { pedestrians: reader.count("pedestrians", 2, 10_000_000)?, length: reader.number("length", POSITIVE)? };
    let room = model.effective_gap(ring.headway(), 0.0, 0.0);
    if room <= 0.0 {
        let problem = format!(
            "the effective gaps are closed at the start: L/N = {:?} leaves {room:?}; the length must be above {:?}",
            ring.headway(),
            (ring.headway() - room) * ring.pedestrians as f64
        );
        return Err(reader.complaint("length", &problem));
    }
    reader.finish()?;
    let mut reader = Reader::new(file, "start", start);
    let shift = reader.number("shift", FINITE)?;
    if shift.abs() >= room {
        return Err(
            reader.complaint("shift", &format!("closes a gap at the start; must be between {:?} and {room:?}", -room))
        );
    }
    reader.finish()?;
    Ok((ring, Start { shift }))
}

/// `most_steps`, or what is usual. Of fixed steps the number is known before the first.
fn most_steps(run: &mut Reader<'_>, control: Control, t_end: f64, purpose: Purpose) -> Result<u64, SceneError> {
    let named = run.optional_number("most_steps", 1.0..=MOST_FIXED_STEPS as f64)?.map(|most| most as u64);
    match control {
        Control::Adaptive { .. } => Ok(named.unwrap_or(ode::MOST_STEPS)),
        Control::Fixed { step } => {
            let most = named.unwrap_or(MOST_FIXED_STEPS);
            if t_end / step > most as f64 && purpose == Purpose::Run {
                let problem = format!("gives {:e} steps; at most {:e}", t_end / step, most as f64);
                return Err(run.complaint("dt", &problem));
            }
            Ok(most)
        }
    }
}

/// The method that a scene names. One with steps of fixed length must name it.
///
/// # Errors
/// An unknown method, or `dt` without one.
pub fn method(run: &mut Reader<'_>) -> Result<Option<Method>, SceneError> {
    if run.has("method") || run.has("dt") {
        return run.one_of("method", &Method::ALL.map(|method| (method.name(), method))).map(Some);
    }
    Ok(None)
}

/// `tolerance` for methods that choose their steps, `usual` if nothing is named; `dt` for any.
///
/// # Errors
/// Out of range, both, or one that the method does not have.
pub fn control(run: &mut Reader<'_>, method: Method, usual: f64) -> Result<Control, SceneError> {
    let tolerance = run.optional_number("tolerance", 1e-15..=1e-2)?;
    let step = run.optional_number("dt", POSITIVE)?;
    match (tolerance, step) {
        (None, Some(step)) => Ok(Control::Fixed { step }),
        (Some(tolerance), None) if method.is_adaptive() => Ok(Control::Adaptive { tolerance }),
        (None, None) if method.is_adaptive() => Ok(Control::Adaptive { tolerance: usual }),
        (Some(_), None) => {
            let problem = format!("{} has no error estimate and needs dt, the length of its steps", method.name());
            Err(run.complaint("tolerance", &problem))
        }
        (Some(_), Some(_)) => Err(run.complaint("dt", "give either dt or tolerance, not both")),
        (None, None) => Err(run.complaint("method", "has no error estimate and needs dt, the length of its steps")),
    }
}
