//! Why an integration could not go on.

use crate::methods::Method;

/// Why an integration could not go on.
#[derive(Clone, Debug, PartialEq)]
pub enum Failure {
    /// The error asks for a step that no longer moves the time.
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
    /// The system gives no Taylor series.
    NoSeries,
    /// The method has no error estimate and cannot choose its steps.
    NoErrorEstimate(Method),
    /// Only steps of fixed length are resumed from a mark.
    NotResumable,
}

impl std::fmt::Display for Failure {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Failure::StepTooSmall { time, step } => {
                write!(
                    f,
                    "at t = {time:?} the tolerance asks for a step of {step:e}, too small to go on; raise the tolerance"
                )
            }
            Failure::TooManySteps { time, steps } => {
                write!(f, "{steps} steps, as many as are allowed, reach t = {time:?} only; raise the tolerance")
            }
            Failure::NotFinite { time, step } => {
                write!(
                    f,
                    "in the step of {step:e} from t = {time:?} the state is no longer finite; a smaller step may help"
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
            Failure::NotResumable => write!(f, "only steps of fixed length can be resumed"),
        }
    }
}

impl std::error::Error for Failure {}
