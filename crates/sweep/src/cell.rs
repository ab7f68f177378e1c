//! A cell of a sweep: its scene and its outcome.

use super::Sweep;
use jam::outcome::{Class, Verdict};
use jam::ring::{Ring, Start};
use jam::run::{Judging, fitting, flow, run_from, too_wide, without_value};
use jam::stability::Waves;
use jam::uniform;
use ode::Control;
use scene::run::Scene;

/// What is known of a cell without a run.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Precheck {
    /// The outcome, where the start itself decides.
    pub class: Option<Class>,
    /// Whether the uniform flow walks backwards.
    pub backward_flow: bool,
    /// Whether the uniform flow is unstable: against waves of all lengths, and against those of the ring. `None` where
    /// it has no linearised law.
    pub unstable: Option<[bool; 2]>,
}

/// What is known exactly of a point of the plane; NaN where there is no uniform flow, or where it has no linearised
/// law.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Exact {
    /// The margin against waves of all lengths: negative where the uniform flow is stable.
    pub margin: f64,
    /// The steady speed.
    pub speed: f64,
}

/// What decided a cell.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum DecidedBy {
    /// The start, or that there is no uniform flow.
    Criterion,
    /// A run.
    Run,
    /// A run that came close to the uniform flow, and the linearised law, by which it stays there.
    Both,
    /// The cells around, which all have this outcome.
    Neighbours,
}

impl DecidedBy {
    /// All.
    pub const ALL: [DecidedBy; 4] = [DecidedBy::Criterion, DecidedBy::Run, DecidedBy::Both, DecidedBy::Neighbours];

    /// The name in tables.
    pub fn name(self) -> &'static str {
        match self {
            DecidedBy::Criterion => "criterion",
            DecidedBy::Run => "run",
            DecidedBy::Both => "both",
            DecidedBy::Neighbours => "neighbours",
        }
    }
}

/// The outcome of a cell.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CellOutcome {
    /// The outcome.
    pub class: Class,
    /// Whether the uniform flow walks backwards.
    pub backward_flow: bool,
    /// What decided.
    pub decided_by: DecidedBy,
    /// `t_decided, least_gap, least_speed, std, wave_speed, error`, NaN where there is none (see [`Verdict`]); `error`
    /// is that of the least gap and the least speed.
    pub numbers: [f64; 6],
}

/// The columns of [`CellOutcome::numbers`].
pub const NUMBERS: [&str; 6] = ["t_decided", "least_gap", "least_speed", "std", "wave_speed", "error"];

/// The second run of a cell has so much larger a tolerance, or steps so much longer: its error is far above that of the
/// first, and the difference of both is that of the second.
const LOOSER: f64 = 32.0;

/// The largest tolerance of a second run.
const LOOSEST: f64 = 1e-3;

impl Sweep {
    /// The values of the axes at a cell, horizontal first.
    pub fn at(&self, cell: [usize; 2]) -> [f64; 2] {
        [self.x.centre(cell[0]), self.y.centre(cell[1])]
    }

    /// The scene of a cell; or the outcome that its start decides.
    ///
    /// # Errors
    /// As [`Sweep::place`].
    fn scene(&self, cell: [usize; 2]) -> Result<Result<Scene, Class>, String> {
        self.scene_at(self.at(cell))
    }

    /// The same at any values of the axes.
    fn scene_at(&self, at: [f64; 2]) -> Result<Result<Scene, Class>, String> {
        self.scene_of(at).map_err(|problem| {
            let ([x, y], [across, up]) = (at, [&self.x.parameter, &self.y.parameter]);
            format!("at {across} = {x:?}, {up} = {y:?}: {problem}")
        })
    }

    fn scene_of(&self, [x, y]: [f64; 2]) -> Result<Result<Scene, Class>, String> {
        let axes = [(self.x.parameter.as_str(), x), (self.y.parameter.as_str(), y)];
        let value = |name: &str| axes.iter().find(|(parameter, _)| *parameter == name).map(|(_, value)| *value);
        let of_law: Vec<(&str, f64)> =
            axes.into_iter().filter(|(name, _)| !super::read::OF_THE_RUN.contains(name)).collect();
        let model = match self.model.with_all(&of_law) {
            Ok(model) => model,
            Err(problem) => {
                let own = self.model.parameters();
                let are_known = of_law.iter().all(|(name, _)| own.iter().any(|known| known == name));
                // a formula that has no value with these
                return if are_known { Ok(Err(Class::Undefined)) } else { Err(problem) };
            }
        };
        let mut ring = self.ring;
        if let Some(count) = value("pedestrians") {
            ring = Ring { pedestrians: count as usize, length: ring.headway() * count };
        }
        if let Some(headway) = value("headway") {
            ring.length = headway * ring.pedestrians as f64;
        }
        if let Some(gap) = value("d_gap").or(self.gap) {
            let Ok(headway) = uniform::headway_of_gap(&model, gap) else { return Ok(Err(Class::NoUniformFlow)) };
            ring.length = headway * ring.pedestrians as f64;
        }
        let start = Start { shift: value("shift").unwrap_or(self.start.shift) };
        let room = model.effective_gap(ring.headway(), 0.0, 0.0);
        if room <= 0.0 || start.shift.abs() >= room {
            return Ok(Err(Class::Closed));
        }
        if let Some(problem) = too_wide(&model, ring) {
            return Err(problem);
        }
        let steady_speed = match flow(&model, ring, self.speed) {
            Ok(Some(speed)) => speed,
            Err(several) if !several.speeds.is_empty() => return Err(several.to_string()),
            Ok(None) | Err(_) => return Ok(Err(Class::NoUniformFlow)),
        };
        let settings = &self.settings;
        let form = fitting(settings.form, &model, ring, Some(steady_speed));
        if without_value(&*form.build(&model, ring), start, ring).is_some() {
            return Ok(Err(Class::Undefined));
        }
        Ok(Ok(Scene {
            model,
            ring,
            start,
            displacements: Vec::new(),
            t_end: settings.t_end,
            sample: settings.t_end,
            method: settings.method,
            control: settings.control,
            most_steps: settings.most_steps,
            form,
            keeps_trajectories: false,
            steady_speed: Some(steady_speed),
            at_overlap: settings.at_overlap,
        }))
    }

    /// What is known of a cell without a run.
    ///
    /// # Errors
    /// Where, and: formulas that look further than the ring is long; several steady speeds, of which the scene has to
    /// name one; an axis that is no parameter of the law.
    pub fn place(&self, cell: [usize; 2]) -> Result<Precheck, String> {
        let scene = match self.scene(cell)? {
            Ok(scene) => scene,
            Err(class) => return Ok(Precheck { class: Some(class), backward_flow: false, unstable: None }),
        };
        let speed = scene.steady_speed.unwrap_or(f64::NAN);
        let response = scene.model.response(scene.ring.headway(), speed);
        let unstable = response.map(|response| {
            [Waves::All, Waves::Ring(scene.ring.pedestrians)].map(|waves| response.margin(waves).0 > 0.0)
        });
        Ok(Precheck { class: None, backward_flow: speed < 0.0, unstable })
    }

    /// What is known exactly of a point of the plane, counted in cells from the lower left corner: cell `[i, j]` has
    /// its centre at `[i + 0.5, j + 0.5]`.
    ///
    /// # Errors
    /// As [`Sweep::place`].
    pub fn exact(&self, [x, y]: [f64; 2]) -> Result<Exact, String> {
        let Ok(scene) = self.scene_at([self.x.at(x), self.y.at(y)])? else {
            return Ok(Exact { margin: f64::NAN, speed: f64::NAN });
        };
        let speed = scene.steady_speed.unwrap_or(f64::NAN);
        let response = scene.model.response(scene.ring.headway(), speed);
        Ok(Exact { margin: response.map_or(f64::NAN, |response| response.margin(Waves::All).0), speed })
    }

    /// Runs a cell: twice, the second time with a larger tolerance. Where both do not agree, it is undecided.
    ///
    /// # Errors
    /// As [`Sweep::place`].
    pub fn compute(&self, cell: [usize; 2]) -> Result<CellOutcome, String> {
        let scene = match self.scene(cell)? {
            Ok(scene) => scene,
            Err(class) => {
                let numbers = [f64::NAN; 6];
                return Ok(CellOutcome { class, backward_flow: false, decided_by: DecidedBy::Criterion, numbers });
            }
        };
        let verdict = judged(&scene);
        let other = judged(&Scene { control: looser(scene.control), ..scene });
        let difference = |number: fn(&Verdict) -> f64| (number(&verdict) - number(&other)).abs();
        let errors = [difference(|verdict| verdict.least_gap), difference(|verdict| verdict.least_speed)];
        let error = math::larger(errors[0], errors[1]);
        let class = if verdict.class == other.class { verdict.class } else { Class::Undecided };
        let numbers = [
            verdict.time,
            verdict.least_gap,
            verdict.least_speed,
            verdict.std,
            verdict.wave_speed.unwrap_or(f64::NAN),
            error,
        ];
        let decided_by = if class == Class::Decays { DecidedBy::Both } else { DecidedBy::Run };
        let numbers = numbers.map(|number| if number.is_finite() { number } else { f64::NAN });
        Ok(CellOutcome { class, backward_flow: verdict.backward_flow, decided_by, numbers })
    }
}

/// The outcome of a scene. A run that broke has none.
fn judged(scene: &Scene) -> Verdict {
    let outcome = run_from(scene, None, &mut Judging::UntilCertain).unwrap_or_else(|broken| {
        let mut outcome = *broken.outcome;
        if let Some(verdict) = &mut outcome.verdict {
            verdict.class = Class::Undecided;
        }
        outcome
    });
    outcome.verdict.unwrap_or_else(Verdict::none)
}

fn looser(control: Control) -> Control {
    match control {
        Control::Fixed { step } => Control::Fixed { step: 2.0 * step },
        Control::Adaptive { tolerance } => {
            let most = if tolerance > LOOSEST { 2.0 * tolerance } else { LOOSEST };
            Control::Adaptive { tolerance: math::smaller(LOOSER * tolerance, most) }
        }
    }
}
