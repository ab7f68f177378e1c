//! Runs, maps and stability as Python calls them.

use crate::given::{Given, choose, replaced, scene_error, section};
use crate::watch::{Watch, detached};
use cpu_time::ThreadTime;
use files::reader::{Reader, SceneError, Section, Value};
use files::scene_file::{self, Kind};
use jam::errors::run_propagated;
use jam::precise::Precise;
use jam::run::{Judging, run_from};
use jam::stability::Waves;
use jam::uniform;
use numpy::{PyArray1, PyReadonlyArray1};
use pyo3::prelude::*;
use pyo3::types::PyDict;
use scene::summary::{self, FinishedRun};
use scene::{tables, uniform::stability};

/// Runs a scene: `std` (t, std), `trajectories` (t, n, x, v) or None, `x` and `v` of the final state, all flat, and the
/// rest. `wanted`: whether to estimate the errors, and whether to determine the outcome.
#[pyfunction]
pub fn simulate<'py>(
    py: Python<'py>,
    given: Given<'py>,
    panel: Option<&str>,
    values: &Bound<'py, PyDict>,
    wanted: (bool, bool),
    progress: Option<Py<PyAny>>,
) -> PyResult<Bound<'py, PyDict>> {
    let (check, outcome) = wanted;
    let chosen = choose(&given, panel, Kind::Run, values)?;
    let scene = scene::run::read(&chosen.file, &chosen.panel.tables).map_err(|error| scene_error(py, &error))?;
    let (ended, flow, errors) = detached(py, || {
        let mut watch = Watch::new(progress.as_ref(), scene.ring.pedestrians);
        let share = if check { 0.5 } else { 1.0 };
        watch.turn_to(scene.t_end, 0.0, share);
        watch.judging = if outcome { Judging::Along } else { Judging::No };
        let clock = ThreadTime::now();
        let (made, propagated) = if check {
            let (made, propagated) = run_propagated(&scene, &mut watch);
            (made, Some(propagated))
        } else {
            (run_from(&scene, None, &mut watch), None)
        };
        let (outcome, broken) = match made {
            Ok(outcome) => (outcome, None),
            Err(broken) => (*broken.outcome.clone(), Some(broken)),
        };
        let mut ended = FinishedRun { outcome, broken, seconds: clock.elapsed().as_secs_f64(), resumed_steps: 0, propagated };
        let mut again = watch.judging;
        watch.judging = Judging::No;
        watch.turn_to(ended.outcome.statistics.time, share, 1.0 - share);
        let errors = check.then(|| ended.checked(&scene, &mut watch, &mut again));
        watch.tell(1.0);
        (ended, stability(&scene), errors)
    })?;
    let summary = summary::of_run(&scene, &ended, flow.as_ref(), errors.as_ref()).to_string();
    let FinishedRun { outcome, broken, .. } = ended;
    let made = PyDict::new(py);
    made.set_item("title", chosen.title)?;
    made.set_item("summary", summary)?;
    made.set_item("broken", broken.map(|broken| broken.to_string()))?;
    made.set_item("sample", scene.sample)?;
    made.set_item("desired_speed", scene.model.speed_scale())?;
    made.set_item("std", PyArray1::from_vec(py, tables::std(&outcome.samples).into_cells()))?;
    let kept =
        scene.keeps_trajectories.then(|| PyArray1::from_vec(py, tables::trajectories(&outcome.samples).into_cells()));
    made.set_item("trajectories", kept)?;
    made.set_item("x", PyArray1::from_vec(py, outcome.positions))?;
    made.set_item("v", PyArray1::from_vec(py, outcome.speeds))?;
    Ok(made)
}

/// Computes a map: centres of the cells along `x` and `y`, `values` cell by cell (NaN: blank), `y` running faster.
#[pyfunction]
pub fn map<'py>(
    py: Python<'py>,
    given: Given<'py>,
    panel: Option<&str>,
    values: &Bound<'py, PyDict>,
    progress: Option<Py<PyAny>>,
) -> PyResult<Bound<'py, PyDict>> {
    let chosen = choose(&given, panel, Kind::Map, values)?;
    let map = scene::map::read(&chosen.file, &chosen.panel.tables).map_err(|error| scene_error(py, &error))?;
    let computed = detached(py, || {
        let mut watch = Watch::new(progress.as_ref(), 10);
        let computed = map.compute_seen(&mut |fraction| watch.look(fraction));
        watch.tell(1.0);
        computed
    })?;
    let computed = computed.map_err(|problem| scene_error(py, &SceneError::new(&chosen.file, 0, problem)))?;
    let made = PyDict::new(py);
    made.set_item("title", chosen.title)?;
    made.set_item("summary", summary::of_map(&chosen.panel.name, &map, &computed).to_string())?;
    made.set_item("columns", map.columns())?;
    for (name, axis) in [("x", &map.x), ("y", &map.y)] {
        made.set_item(name, PyArray1::from_iter(py, (0..axis.cells).map(|i| axis.centre(i))))?;
        made.set_item(format!("{name}_range"), (axis.from, axis.to))?;
    }
    made.set_item("values", PyArray1::from_vec(py, computed.values()))?;
    Ok(made)
}

/// How a uniform flow answers to small waves.
#[pyclass(frozen, module = "jamming._native")]
pub struct Response {
    /// The steady speed.
    #[pyo3(get)]
    speed: f64,
    /// How the law answers, and the same with twice the digits. None where it has no derivatives: on a kink.
    answer: Option<(jam::stability::Response, Precise)>,
}

#[pymethods]
impl Response {
    /// The margin over all waves, and the same with twice the digits by a finer grid of waves.
    fn margin(&self) -> Option<[f64; 2]> {
        let (response, precise) = self.answer.as_ref()?;
        Some([response.margin(Waves::All).0, precise.margin()])
    }

    /// The least and the largest wave number that grows.
    fn growing(&self) -> Option<(f64, f64)> {
        self.answer.as_ref()?.0.growing()
    }

    /// Of the waves of a ring: the margin, the largest growth rate, and how often that wave goes into the ring.
    fn on_ring(&self, pedestrians: usize) -> Option<(f64, f64, usize)> {
        let (response, _) = self.answer.as_ref()?;
        let (rate, waves) = response.fastest(pedestrians);
        Some((response.margin(Waves::Ring(pedestrians)).0, rate, waves))
    }

    /// `Re z^+` of each wave number, and the same with twice the digits, after a step of Newton's method.
    fn growth_rates<'py>(
        &self,
        py: Python<'py>,
        k: PyReadonlyArray1<'py, f64>,
    ) -> Option<[Bound<'py, PyArray1<f64>>; 2]> {
        let (response, precise) = self.answer.as_ref()?;
        let (k, rounded) = (k.as_array(), precise.rounded());
        let rates = |rate: &dyn Fn(f64) -> f64| PyArray1::from_iter(py, k.iter().map(|k| rate(*k)));
        Some([rates(&|k| response.growth_rate(k)), rates(&|k| rounded.refined_growth_rate(k))])
    }
}

/// The response of the uniform flow with this headway. The law: a scene that has one, or its table alone.
#[pyfunction]
pub fn response(
    py: Python<'_>,
    given: Given<'_>,
    headway: f64,
    speed: Option<f64>,
    values: &Bound<'_, PyDict>,
) -> PyResult<Response> {
    let (file, tables) = law_of(&given).map_err(|error| scene_error(py, &error))?;
    let tables = replaced(&tables, values)?;
    let read = || {
        let section = Reader::new(&file, "scene", &tables).section("law")?;
        scene::law::read(&file, section)
    };
    let model = read().map_err(|error| scene_error(py, &error))?;
    let found = match model.is_of_paper() {
        true => uniform::steady_speed(&model, headway),
        false => uniform::nearest(&model, headway, speed),
    };
    let speed = found.map_err(|error| scene_error(py, &SceneError::new(&file, 0, error.to_string())))?;
    let response = model.response(headway, speed);
    Ok(Response { speed, answer: response.map(|response| (response, Precise::new(&model, headway, speed))) })
}

/// The tables that hold `[law]`, of a whole scene or of a law alone.
fn law_of(given: &Given<'_>) -> Result<(String, Section), SceneError> {
    let (file, tables) = match given {
        Given::Tables(tables) => ("<dict>".to_owned(), section(tables)?),
        Given::Text(text) => ("<text>".to_owned(), Section::parse("<text>", text)?),
        Given::File(path) => {
            let parsed = scene_file::read(path)?;
            let tables = parsed.panels.first().map_or_else(Section::default, |panel| panel.tables.clone());
            (parsed.file, tables)
        }
    };
    if tables.entries.contains_key("law") {
        return Ok((file, tables));
    }
    let mut whole = Section::default();
    whole.entries.insert("law".to_owned(), files::reader::Entry::new(tables.line, Value::Section(tables)));
    Ok((file, whole))
}
