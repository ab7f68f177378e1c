//! Reasons why an integration cannot continue.

use crate::methods::Method;

/// The reason why an integration could not continue. Times and steps are in the unit of time of the equations.
#[derive(Clone, Debug, PartialEq)]
pub enum Failure {
    /// The error, or the end of the domain, asks for a step shorter than [`SHORTEST`](crate::SHORTEST).
    StepTooSmall {
        /// The time reached.
        time: f64,
        /// The step that was asked for.
        step: f64,
    },
    /// The steps are so short that more of them than are allowed do not reach the end.
    TooManySteps {
        /// The time reached.
        time: f64,
        /// Steps tried.
        steps: u64,
    },
    /// A component is no longer a finite number after a step of fixed length.
    NotFinite {
        /// The time at the start of that step.
        time: f64,
        /// Its length.
        step: f64,
    },
    /// A second solution, by other steps, ends early or differs by as much as the numbers are large. No integration
    /// finds that by itself: it is for those who make the second one.
    NotConfirmed {
        /// The time up to which both agree.
        time: f64,
    },
    /// The system gives no Taylor series.
    NoSeries,
    /// The method has no error estimate and cannot choose its steps.
    NoErrorEstimate(Method),
    /// The mark is that of a run with another rule for its steps.
    NotResumable,
}

impl Failure {
    /// The name in tables and summaries.
    pub fn name(&self) -> &'static str {
        match self {
            Failure::StepTooSmall { .. } => "step_too_small",
            Failure::TooManySteps { .. } => "too_many_steps",
            Failure::NotFinite { .. } => "not_finite",
            Failure::NotConfirmed { .. } => "not_confirmed",
            Failure::NoSeries => "no_series",
            Failure::NoErrorEstimate(_) => "no_error_estimate",
            Failure::NotResumable => "not_resumable",
        }
    }
}

impl std::fmt::Display for Failure {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Failure::StepTooSmall { time, step } => {
                write!(f, "at t = {time:?} the tolerance asks for a step of {step:e}, too small to continue")
            }
            Failure::TooManySteps { time, steps } => {
                write!(f, "{steps} steps, the limit, reach only t = {time:?}")
            }
            Failure::NotFinite { time, step } => {
                write!(f, "in the step of {step:e} from t = {time:?} the state is no longer finite")
            }
            Failure::NotConfirmed { time } => {
                write!(
                    f,
                    "a second run by other steps confirms the numbers up to t = {time:?} only; later ones are left out"
                )
            }
            Failure::NoSeries => {
                write!(
                    f,
                    "taylor needs a system that gives its Taylor series; this one gives none: choose another method"
                )
            }
            Failure::NoErrorEstimate(method) => {
                let names: Vec<&str> = Method::ALL.iter().filter(|m| m.is_adaptive()).map(|m| m.name()).collect();
                let name = method.name();
                write!(f, "{name} has no error estimate: give it a step, or choose one of {}", names.join(", "))
            }
            Failure::NotResumable => write!(
                f,
                "fixed steps are resumed from a mark of fixed steps, adaptive ones from one of adaptive steps"
            ),
        }
    }
}

impl std::error::Error for Failure {}
