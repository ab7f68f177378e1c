//! Runge-Kutta methods as data. Weights are dimensionless; a stage is a rate, and the change of a step is `h` times the
//! sum of weights times stages.

/// Weights of the stages that count, as pairs (stage, weight); stage 0 is the rate at the start of the step.
pub type Row = &'static [(usize, f64)];

/// An explicit Runge-Kutta method with optional error estimate and interpolant.
#[derive(Debug)]
pub struct Tableau {
    /// The name in scene files.
    pub name: &'static str,
    /// Order of the solution.
    pub order: usize,
    /// Row `i - 1` gives the state at which stage `i` is evaluated; the method has `rows.len() + 1` stages.
    pub rows: &'static [Row],
    /// Weights of the solution.
    pub weights: Row,
    /// Solution minus an embedded one, as weights: none (no step control), one, or the two of DOP853. The rate at the
    /// end of the step may count as the stage after the last one ("first same as last").
    pub errors: &'static [Row],
    /// How the solution is continued inside the step.
    pub interpolant: Interpolant,
}

/// How a solution is continued inside a step, `theta` in [0, 1].
#[derive(Debug)]
pub enum Interpolant {
    /// Cubic Hermite polynomial from states and rates at both ends.
    Cubic,
    /// The cubic, and further terms `theta^2 (1 - theta)^2 (r_0 + theta (r_1 + (1 - theta) (r_2 + theta r_3)))`.
    Nested {
        /// States of further stages; the rate at the end of the step counts as the stage before them.
        stages: &'static [Row],
        /// Weights that give `r_0, r_1, ...` from all stages.
        rows: &'static [Row],
    },
}

impl Tableau {
    /// The number of stages of a step, without those of the interpolant.
    pub fn stages(&self) -> usize {
        self.rows.len() + 1
    }

    /// Whether the error estimate counts the rate at the end of the step.
    pub fn estimates_with_end(&self) -> bool {
        self.errors.iter().any(|row| row.iter().any(|&(stage, _)| stage == self.stages()))
    }
}
