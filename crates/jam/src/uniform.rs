//! The uniform flow: equal spacings, equal and constant speeds.

use crate::laws::{Formula, Model};

/// Why there is no uniform flow with open gaps.
#[derive(Clone, Debug, PartialEq)]
pub struct NoUniformFlow {
    /// The headway `Delta y` asked for, in units of `a_0`.
    pub headway: f64,
    /// All steady speeds from 0 on, where a law has several; empty where it has none.
    pub speeds: Vec<f64>,
}

impl std::fmt::Display for NoUniformFlow {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        if !self.speeds.is_empty() {
            let speeds: Vec<String> = self.speeds.iter().map(|speed| format!("{speed:?}")).collect();
            let (headway, speeds) = (self.headway, speeds.join(", "));
            return write!(
                f,
                "several steady speeds at headway L/N = {headway:?}: {speeds}; [uniform] speed = x takes the nearest"
            );
        }
        write!(
            f,
            "no uniform flow at headway L/N = {:?}: at no speed from -1e12 v_0 to v_0 does the drive balance the force at a positive gap; a longer ring, fewer pedestrians or a weaker force has a uniform flow",
            self.headway
        )
    }
}

impl std::error::Error for NoUniformFlow {}

/// The steady speed `v'` at which the acceleration vanishes when all gaps are `headway` and all speeds equal. It is
/// implicit (eq2) because the room depends on the speed; found by bisection to the last bit, the acceleration falling
/// with the speed.
///
/// # Errors
/// [`NoUniformFlow`] when at no speed from -1e12 times the desired one up to it the drive balances the force with room
/// left.
pub fn steady_speed(model: &Model, headway: f64) -> Result<f64, NoUniformFlow> {
    if !model.is_of_paper() {
        return nearest(model, headway, None);
    }
    let pushes = |speed: f64| {
        let has_room = !model.is_singular() || model.effective_gap(headway, speed, speed) > 0.0;
        has_room && model.acceleration(headway, speed, speed) > 0.0
    };
    let has_room = |speed: f64| model.effective_gap(headway, speed, speed) > 0.0;
    let desired = model.desired_speed();
    let mut slow = -desired;
    // a strong force asks for a negative speed: go down until it is found, or the doubling runs away
    while has_room(slow) && !pushes(slow) && slow > -1e12 * desired {
        slow *= 2.0;
    }
    if !has_room(slow) || !pushes(slow) {
        return Err(none(headway));
    }
    let mut fast = desired;
    loop {
        let middle = 0.5 * (slow + fast);
        if middle <= slow || middle >= fast {
            return if has_room(slow) { Ok(slow) } else { Err(none(headway)) };
        }
        if pushes(middle) { slow = middle } else { fast = middle }
    }
}

fn none(headway: f64) -> NoUniformFlow {
    NoUniformFlow { headway, speeds: Vec::new() }
}

/// The steady speed of a formula (see [`nearest`]).
///
/// # Errors
/// As [`nearest`].
pub fn of_formula(formula: &Formula, headway: f64, wanted: Option<f64>) -> Result<f64, NoUniformFlow> {
    fallen(&|speeds| formula.uniform_at(headway, speeds), formula.speed_scale(), headway, wanted)
}

/// The steady speed of any law: where the acceleration of the uniform flow falls through 0, from 0 to the largest speed
/// at which it has a value; if there is none, the nearest one below 0; if `wanted` is given, the one closest to it.
///
/// # Errors
/// [`NoUniformFlow`]: none, or several from 0 on and none is `wanted`.
pub fn nearest(model: &Model, headway: f64, wanted: Option<f64>) -> Result<f64, NoUniformFlow> {
    if let Model::Formula(formula) = model {
        return of_formula(formula, headway, wanted);
    }
    let value = |&speed: &f64| {
        let is_open = !model.is_singular() || model.effective_gap(headway, speed, speed) > 0.0;
        if is_open { model.acceleration(headway, speed, speed) } else { f64::NAN }
    };
    fallen(&|speeds| speeds.iter().map(value).collect(), model.speed_scale(), headway, wanted)
}

/// Where the accelerations fall through 0, found on a grid of speeds.
fn fallen(
    accelerations: &dyn Fn(&[f64]) -> Vec<f64>,
    scale: Option<f64>,
    headway: f64,
    wanted: Option<f64>,
) -> Result<f64, NoUniformFlow> {
    let scale = scale.map_or(1.0, f64::abs);
    let scale = if scale > 0.0 { scale } else { 1.0 };
    let falls = |speeds: &[f64]| -> Vec<f64> {
        let acceleration = |speed: f64| accelerations(&[speed])[0];
        let values = accelerations(speeds);
        let pairs = speeds.windows(2).zip(values.windows(2));
        pairs
            .filter(|(_, value)| value[0] > 0.0 && value[1] <= 0.0)
            .map(|(at, _)| bisected(at[0], at[1], acceleration))
            .collect()
    };
    let mut speeds = grid(scale);
    let backwards = || falls(&grid(scale).into_iter().rev().map(|speed| -speed).collect::<Vec<_>>());
    // a flow that stands still: the acceleration falls through 0 at 0
    speeds.insert(0, -speeds[1] * 1e-9);
    let forwards = falls(&speeds);
    if let Some(wanted) = wanted {
        let all = forwards.into_iter().chain(backwards());
        return all.min_by(|a, b| (a - wanted).abs().total_cmp(&(b - wanted).abs())).ok_or_else(|| none(headway));
    }
    match forwards[..] {
        [] => backwards().last().copied().ok_or_else(|| none(headway)),
        [speed] => Ok(speed),
        _ => Err(NoUniformFlow { headway, speeds: forwards }),
    }
}

/// Speeds from 0 to a million times the size of speeds: a fine grid near that size, ever coarser above.
fn grid(scale: f64) -> Vec<f64> {
    let fine = (0..=4000).map(|i| scale * f64::from(i) * 1e-3);
    let mut all: Vec<f64> = fine.collect();
    let mut speed = 4.0 * scale;
    while speed < 1e6 * scale {
        speed *= 1.01;
        all.push(speed);
    }
    all
}

/// Where a function falls through 0, to the last bit.
fn bisected(mut low: f64, mut high: f64, value: impl Fn(f64) -> f64) -> f64 {
    loop {
        let middle = 0.5 * (low + high);
        if middle <= low || middle >= high {
            return if value(high) == 0.0 { high } else { low };
        }
        if value(middle) > 0.0 { low = middle } else { high = middle }
    }
}

/// The headway at which the uniform flow has this effective gap `d'` (above 0), both in units of `a_0`: the gap grows
/// with the headway, as the steady speed's share of it does not outrun it; found by bisection to the last bit.
///
/// # Errors
/// [`NoUniformFlow`] where no headway up to a million gaps has one.
pub fn headway_of_gap(model: &Model, gap: f64) -> Result<f64, NoUniformFlow> {
    let room = |headway: f64| steady_speed(model, headway).map(|speed| model.effective_gap(headway, speed, speed));
    let (mut low, mut high) = (model.contact(), model.contact() + gap);
    let is_enough = |headway: f64| room(headway).is_ok_and(|room| room >= gap);
    while !is_enough(high) {
        high = model.contact() + 2.0 * (high - model.contact());
        if high > 1e6 * (gap + model.contact()) {
            return Err(none(high));
        }
    }
    loop {
        let middle = 0.5 * (low + high);
        if middle <= low || middle >= high {
            return Ok(high);
        }
        if is_enough(middle) { high = middle } else { low = middle }
    }
}
