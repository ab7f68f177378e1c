//! The six scenes whose solutions are known to 20 digits, and those solutions.

use figures::failure::Failure;
use files::scene_file;
use math::double_double::{DoubleDouble, decimal};
use scene::run::Scene;
use std::path::Path;

/// A scene with a reference solution.
#[derive(Clone, Copy, Debug)]
pub struct Known {
    /// As its solution and its table are named.
    pub name: &'static str,
    /// The folder of the scene file.
    figure: &'static str,
    /// The panel of the scene file.
    panel: &'static str,
}

/// The scenes.
pub const SCENES: [Known; 6] = [
    Known { name: "algebraic_stable", figure: "fig04-algebraic-std", panel: "stable" },
    Known { name: "algebraic_unstable", figure: "fig04-algebraic-std", panel: "unstable" },
    Known { name: "exponential_stable", figure: "fig07-exponential-std", panel: "stable" },
    Known { name: "exponential_unstable", figure: "fig07-exponential-std", panel: "unstable" },
    Known { name: "logarithmic", figure: "fig13-logarithmic-std", panel: "std" },
    Known { name: "logarithmic_small_shift", figure: "fig13-logarithmic-std", panel: "std_small_shift" },
];

/// The solution at one time.
#[derive(Clone, Debug, Default)]
pub struct Instant {
    /// The time, a whole number.
    pub time: f64,
    /// `s_n - L / N`, rounded from 106 bits.
    pub gaps: Vec<f64>,
    /// `v_n`.
    pub speeds: Vec<DoubleDouble>,
}

impl Known {
    /// The scene up to the last time of its solution, standard deviations only.
    ///
    /// # Errors
    /// The scene file cannot be read or is invalid.
    pub fn scene(&self, figures: &Path, solution: &[Instant]) -> Result<Scene, Failure> {
        let scene_file = scene_file::read(&figures.join(self.figure).join("scene.toml"))?;
        let scene = scene::run::read(&scene_file.file, &scene_file.panel(self.panel)?.tables)?;
        let t_end = solution.last().map_or(0.0, |instant| instant.time);
        Ok(Scene { t_end, keeps_trajectories: false, ..scene })
    }

    /// The solution, earliest time first; `headway` is `L / N`.
    ///
    /// # Errors
    /// The table is missing or damaged.
    pub fn solution(&self, folder: &Path, headway: DoubleDouble) -> Result<Vec<Instant>, Failure> {
        let file = folder.join(format!("{}.csv", self.name));
        let text = std::fs::read_to_string(&file).map_err(|error| files::write::with_path(error, &file))?;
        let mut instants: Vec<Instant> = Vec::new();
        for (index, line) in text.lines().enumerate().skip(1) {
            let row = row(line).ok_or_else(|| {
                Failure::work(format!("{}:{}: {line:?} is not t,n,gap,speed", file.display(), index + 1))
            })?;
            let [time, _, gap, speed] = row;
            if instants.last().is_none_or(|instant| instant.time < time.hi) {
                instants.push(Instant { time: time.hi, ..Instant::default() });
            }
            if let Some(instant) = instants.last_mut() {
                instant.gaps.push((gap - headway).hi);
                instant.speeds.push(speed);
            }
        }
        Ok(instants)
    }
}

/// The four numbers of a line.
fn row(line: &str) -> Option<[DoubleDouble; 4]> {
    let cells: Option<Vec<DoubleDouble>> = line.split(',').map(decimal::parse).collect();
    cells?.try_into().ok()
}
