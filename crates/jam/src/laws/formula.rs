//! A law given as formulas in a scene file.

use super::size_of_speeds;
use crate::force::{Force, Interpreted, Prepared, Source};
use crate::stability::Response;
use formula::{Definition, Error, Given, Graph, Location};
use math::dual::Dual;
use math::number::Number;
use std::sync::Arc;

/// A law as formulas, with values for its parameters.
#[derive(Clone, Debug)]
pub struct Formula {
    graph: Arc<Graph>,
    values: Vec<f64>,
    contact: f64,
    acceleration: Arc<Prepared>,
    /// The effective gap, where it is not the net gap.
    gap: Option<Arc<Prepared>>,
    /// Whether abs, min, max or a sharp ramp occur.
    has_kinks: bool,
    /// Whether the acceleration has no value where two touch.
    is_singular: bool,
}

impl PartialEq for Formula {
    fn eq(&self, other: &Formula) -> bool {
        Arc::ptr_eq(&self.graph, &other.graph) && self.values == other.values
    }
}

impl Formula {
    /// The law with the values of its file.
    ///
    /// # Errors
    /// A part without variables that has no finite value.
    pub fn new(graph: Graph) -> Result<Formula, Error> {
        let values = graph.values();
        Formula::with_values(Arc::new(graph), values)
    }

    /// The law defined by these lines, each a name and its value, as in `[law]` of a scene file: `acceleration` and
    /// `body`, the spacing at which two touch; `gap` and `scale` where wanted; parameters (numbers) and named
    /// expressions (texts). The language is that of [`formula`].
    ///
    /// ```
    /// let law = jam::laws::Formula::written(&[
    ///     ("acceleration", "v0*(1 - exp(-(s - body)/length)) - v".into()),
    ///     ("v0", 1.2.into()),
    ///     ("length", 0.8.into()),
    ///     ("body", 0.0.into()),
    /// ])?;
    /// assert_eq!(law.parameter("length"), Some(0.8));
    /// let wrong = jam::laws::Formula::written(&[("acceleration", "1 - speed".into()), ("body", 0.0.into())]);
    /// assert!(wrong.unwrap_err().to_string().starts_with("law:1"));
    /// # Ok::<(), formula::Error>(())
    /// ```
    ///
    /// # Errors
    /// As [`formula::law`] and [`Formula::new`]; the number of a line counts from 1.
    pub fn written(lines: &[(&str, Given<'_>)]) -> Result<Formula, Error> {
        let place = |index: usize| Location { line: index as u32 + 1, column: 1 };
        let definition = |(index, &(name, given))| Definition { name, key: place(index), value: place(index), given };
        let definitions: Vec<Definition<'_>> = lines.iter().enumerate().map(definition).collect();
        Formula::new(formula::law("law", place(0), &definitions)?)
    }

    fn with_values(graph: Arc<Graph>, values: Vec<f64>) -> Result<Formula, Error> {
        let bound = graph.bind(&values)?;
        let contact = graph.parameter("body").map_or(0.0, |index| values[index]);
        let acceleration = Arc::new(Prepared::new(&bound, bound.acceleration(), contact));
        let gap = bound.gap().map(|root| Arc::new(Prepared::new(&bound, root, contact)));
        let has_kinks = !bound.kinks(bound.acceleration()).is_empty();
        let mut law = Formula { graph, values, contact, acceleration, gap, has_kinks, is_singular: false };
        law.is_singular = !law.uniform(contact, 0.0).is_finite();
        Ok(law)
    }

    /// The law with another value of a parameter; `None` if it has no such parameter.
    ///
    /// # Errors
    /// As [`Formula::new`].
    pub fn with(&self, parameter: &str, value: f64) -> Option<Result<Formula, Error>> {
        self.graph.parameter(parameter)?;
        Some(self.with_all(&[(parameter, value)]))
    }

    /// The law with other values of some parameters, those that it has.
    ///
    /// # Errors
    /// As [`Formula::new`].
    pub(crate) fn with_all(&self, changes: &[(&str, f64)]) -> Result<Formula, Error> {
        let mut values = self.values.clone();
        for (parameter, value) in changes {
            if let Some(index) = self.graph.parameter(parameter) {
                values[index] = *value;
            }
        }
        Formula::with_values(Arc::clone(&self.graph), values)
    }

    /// The names of its parameters and their values, in the order of the file.
    pub fn parameters(&self) -> impl Iterator<Item = (&str, f64)> {
        self.graph.parameters().iter().zip(&self.values).map(|(parameter, value)| (parameter.name.as_str(), *value))
    }

    /// The value of a parameter.
    pub fn parameter(&self, name: &str) -> Option<f64> {
        self.graph.parameter(name).map(|index| self.values[index])
    }

    /// The size of speeds, in the law's unit of them: that of the parameter `v0` if there is one, else `scale`. A `v0`
    /// of 0 is none.
    pub fn speed_scale(&self) -> Option<f64> {
        size_of_speeds(|name| self.parameter(name))
    }

    /// The spacing at which two touch, its parameter `body`.
    pub fn contact(&self) -> f64 {
        self.contact
    }

    /// Whether the acceleration has kinks, at which its derivatives jump.
    pub fn has_kinks(&self) -> bool {
        self.has_kinks
    }

    /// Whether the acceleration has no value where two touch.
    pub fn is_singular(&self) -> bool {
        self.is_singular
    }

    /// How far the formulas look behind and ahead, in pedestrians.
    pub fn reach(&self) -> (usize, usize) {
        let own = self.acceleration.reach();
        let gap = self.gap.as_ref().map_or((0, 0), |gap| gap.reach());
        (own.0.max(gap.0), own.1.max(gap.1))
    }

    /// The force on a ring.
    pub fn force(&self) -> Box<dyn Force> {
        Box::new(Interpreted::new(Arc::clone(&self.acceleration), self.gap.clone(), self.is_singular))
    }

    /// The acceleration in the uniform flow; NaN where the formula has no value.
    pub fn uniform(&self, headway: f64, speed: f64) -> f64 {
        self.acceleration.program().carry_out(|source| self.variable(source, headway, speed))
    }

    /// The acceleration with any numbers for the variables.
    pub fn carry_out<X: Number>(&self, variable: impl Fn(Source) -> X) -> X {
        self.acceleration.program().carry_out(variable)
    }

    /// The acceleration in the uniform flow for many speeds at once, one for each; NaN where the formula has no value.
    pub fn uniform_at(&self, headway: f64, speeds: &[f64]) -> Vec<f64> {
        let mut accelerations = vec![0.0; speeds.len()];
        self.acceleration.in_uniform_flows(headway - self.contact, speeds, &mut accelerations);
        accelerations
    }

    /// The effective gap in the uniform flow: the formula `gap`, else the net gap; NaN where it has no value.
    pub fn uniform_gap(&self, headway: f64, speed: f64) -> f64 {
        match &self.gap {
            Some(gap) => gap.program().carry_out(|source| self.variable(source, headway, speed)),
            None => headway - self.contact,
        }
    }

    fn variable(&self, source: Source, headway: f64, speed: f64) -> f64 {
        match source {
            Source::Spacing { net: true, .. } => headway - self.contact,
            Source::Spacing { net: false, .. } => headway,
            Source::Speed(_) | Source::Register(_) => speed,
        }
    }

    /// The response of the acceleration to spacings and speeds in the uniform flow. `None` where the flow lies on a
    /// kink, or the formula has no derivative.
    pub fn response(&self, headway: f64, speed: f64) -> Option<Response> {
        let program = self.acceleration.program();
        if self.has_kinks && program.is_on_kink(|source| self.variable(source, headway, speed)) {
            return None;
        }
        let mut response = Response::default();
        let variables = program.variables();
        // a spacing and its net gap are one variable
        let key = |source: Source| match source {
            Source::Spacing { j, .. } => (true, j),
            Source::Speed(j) => (false, j),
            Source::Register(_) => (false, 0),
        };
        let mut keys: Vec<(bool, i32)> = variables.iter().map(|source| key(*source)).collect();
        keys.sort_unstable();
        keys.dedup();
        for (is_spacing, j) in keys {
            let slope = program
                .carry_out(|source| Dual {
                    value: self.variable(source, headway, speed),
                    slope: if key(source) == (is_spacing, j) { 1.0 } else { 0.0 },
                })
                .slope;
            if !slope.is_finite() {
                return None;
            }
            if is_spacing { &mut response.spacings } else { &mut response.speeds }.push((j, slope));
        }
        Some(response)
    }
}
