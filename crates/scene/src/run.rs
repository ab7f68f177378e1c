//! A scene in time, validated: `[law]`, `[ring]`, `[start]`, `[run]`.

use crate::law;
use files::reader::{FINITE, POSITIVE, Reader, SceneError, Section};
use jam::laws::{Formula, Model};
use jam::ring::{Ring, Start};
use jam::states::{RingSystem, StateVariables};
use jam::uniform::{self, NoUniformFlow, steady_speed};
use ode::{Control, Method};

/// A simulation that can be run.
#[derive(Clone, Debug, PartialEq)]
pub struct Scene {
    /// The law of motion.
    pub model: Model,
    /// The ring.
    pub ring: Ring,
    /// The initial state.
    pub start: Start,
    /// The time at which it ends.
    pub t_end: f64,
    /// The time between samples; the first is taken at 0.
    pub sample: f64,
    /// The method of integration.
    pub method: Method,
    /// The rule for the steps.
    pub control: Control,
    /// As many steps as it may take.
    pub most_steps: u64,
    /// The form of the state.
    pub form: StateVariables,
    /// Whether positions and speeds of all pedestrians are kept at every sample.
    pub keeps_trajectories: bool,
    /// The speed `v'` of the uniform flow; `None` if a formula has none.
    pub steady_speed: Option<f64>,
    /// Whether an overlap ends the tables.
    pub at_overlap: AtOverlap,
}

/// What becomes of a run in which two overlap.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum AtOverlap {
    /// Its tables end there.
    Stop,
    /// It goes on, under a law that does: one whose force acts in contact, for instance.
    Continue,
}

/// As many rows as the table of a run may have, so that a slip in `sample` does not fill the memory (32 bytes a row).
const MOST_ROWS: f64 = 2e7;
/// As many steps of fixed length as a run may take, unless it says otherwise: two orders more than the longest of the
/// paper.
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
        Model::Formula(law) => {
            stencil_fits(&ring_reader, law, ring)?;
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
    let control = control(&mut run, method)?;
    let wanted = if run.has("state") { Some(run.one_of("state", &FORMS)?) } else { None };
    let form = fitting(wanted, &model, ring, steady_speed, method);
    if let Some((pedestrian, value)) = without_value(&*form.build(&model, ring), start, ring) {
        let problem = format!(
            "the formula has no value at the start: the acceleration of pedestrian {pedestrian} is {value:?}; it must be finite for every pedestrian"
        );
        return Err(Reader::new(file, "start", top_start).complaint("shift", &problem));
    }
    if !method.suits(&*form.build(&model, ring)) {
        let problem = format!(
            "{} needs a force that depends on the gap alone (neither a_v nor delta is named) and the state \"deviations\", or the state \"gaps\"",
            method.name()
        );
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
        let problem = format!("too short for steps of adaptive length; must be at least {SHORTEST_RUN:e}");
        return Err(run.complaint("t_end", &problem));
    }
    let at_overlap = at_overlap(&mut run, &model)?;
    run.finish()?;
    Ok(Scene {
        model,
        ring,
        start,
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

/// The speed of the uniform flow; of a formula the one next to `wanted`, `None` if it has none.
///
/// # Errors
/// A built-in law has none, or a formula several and none is wanted.
pub(crate) fn flow(model: &Model, ring: Ring, wanted: Option<f64>) -> Result<Option<f64>, NoUniformFlow> {
    match model {
        Model::Formula(law) => match uniform::of_formula(law, ring.headway(), wanted) {
            Err(error) if error.speeds.is_empty() => Ok(None),
            found => found.map(Some),
        },
        _ => steady_speed(model, ring.headway()).map(Some),
    }
}

/// The form of the state: deviations from the uniform flow if the scene names none and they can hold the run, else gaps.
pub(crate) fn fitting(
    wanted: Option<StateVariables>,
    model: &Model,
    ring: Ring,
    speed: Option<f64>,
    method: Method,
) -> StateVariables {
    let form = wanted.unwrap_or(StateVariables::Deviations);
    let has_no_series = wanted.is_none() && !method.suits(&*form.build(model, ring));
    if form == StateVariables::Deviations && (!has_deviations(model, ring, speed) || has_no_series) {
        StateVariables::Spacings
    } else {
        form
    }
}

/// Whether a ring has a uniform flow that its state can deviate from.
pub(crate) fn has_deviations(model: &Model, ring: Ring, steady_speed: Option<f64>) -> bool {
    match (model, steady_speed) {
        (_, None) => false,
        // on a kink there is no uniform flow to be near to
        (Model::Formula(law), Some(speed)) => law.response(ring.headway(), speed).is_some(),
        // what the uniform flow itself cannot hold in a number is lost in deviations from it
        (model, Some(speed)) => model.linearise(ring.headway(), speed).phi >= LEAST_RESPONSE,
    }
}

/// Names of the forms of the state.
pub(crate) const FORMS: [(&str, StateVariables); 3] = [
    ("deviations", StateVariables::Deviations),
    ("gaps", StateVariables::Spacings),
    ("positions", StateVariables::Positions),
];

/// Below this response of the uniform flow to a gap, its force has lost digits to underflow.
const LEAST_RESPONSE: f64 = 1e-280;

/// A run by adaptive steps is at least as long: far longer than the shortest of them.
const SHORTEST_RUN: f64 = 1e-250;

pub(crate) fn at_overlap(run: &mut Reader<'_>, model: &Model) -> Result<AtOverlap, SceneError> {
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

/// The first pedestrian whose acceleration is not finite at the start, and that.
pub(crate) fn without_value(form: &dyn RingSystem, start: Start, ring: Ring) -> Option<(usize, f64)> {
    let state = form.start(start);
    let mut rates = vec![0.0; state.len()];
    form.rates(&state, &mut rates);
    let (mut gaps, mut accelerations) = (vec![0.0; ring.pedestrians], vec![0.0; ring.pedestrians]);
    form.read_rates(&rates, &mut gaps, &mut accelerations);
    accelerations.iter().position(|a| !a.is_finite()).map(|n| (n, accelerations[n]))
}

/// The steady speed that is meant, where a formula has several.
pub(crate) fn uniform_speed(file: &str, section: &Section) -> Result<Option<f64>, SceneError> {
    let mut reader = Reader::new(file, "uniform", section);
    let speed = reader.optional_number("speed", FINITE)?;
    reader.finish()?;
    Ok(speed)
}

/// A formula looks no further than once around the ring.
fn stencil_fits(ring_reader: &Reader<'_>, law: &Formula, ring: Ring) -> Result<(), SceneError> {
    too_wide(law, ring).map_or(Ok(()), |problem| Err(ring_reader.complaint("pedestrians", &problem)))
}

/// The complaint that a formula looks further than once around the ring.
pub(crate) fn too_wide(law: &Formula, ring: Ring) -> Option<String> {
    let (behind, ahead) = law.reach();
    let reach = behind.max(ahead);
    let problem = || format!("the formulas look {reach} pedestrians away; there must be at least {}", reach + 1);
    (reach >= ring.pedestrians).then(problem)
}

fn ring(file: &str, ring: &Section, start: &Section, model: &Model) -> Result<(Ring, Start), SceneError> {
    let mut reader = Reader::new(file, "ring", ring);
    let ring =
        Ring { pedestrians: reader.count("pedestrians", 2, 10_000_000)?, length: reader.number("length", POSITIVE)? };
    let room = model.room(ring.headway(), 0.0, 0.0);
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

pub(crate) fn method(run: &mut Reader<'_>) -> Result<Method, SceneError> {
    run.one_of("method", &Method::ALL.map(|method| (method.name(), method)))
}

/// `tolerance` for methods that choose their steps, `dt` for any.
pub(crate) fn control(run: &mut Reader<'_>, method: Method) -> Result<Control, SceneError> {
    let tolerance = run.optional_number("tolerance", 1e-15..=1e-2)?;
    let step = run.optional_number("dt", POSITIVE)?;
    match (tolerance, step) {
        (None, Some(step)) => Ok(Control::Fixed { step }),
        (Some(tolerance), None) if method.is_adaptive() => Ok(Control::Adaptive { tolerance }),
        (Some(_), None) => {
            let problem = format!("{} has no error estimate and needs dt, the length of its steps", method.name());
            Err(run.complaint("tolerance", &problem))
        }
        (Some(_), Some(_)) => Err(run.complaint("dt", "give either dt or tolerance, not both")),
        (None, None) => Err(run.complaint("method", "needs tolerance (adaptive methods) or dt (fixed steps)")),
    }
}
