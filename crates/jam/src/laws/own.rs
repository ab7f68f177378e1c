//! A law that is a user-defined Rust type, stored beside the built-in laws.

use super::{Law, Parameter, Range};
use crate::force::{Compiled, Force};
use crate::stability::Response;
use math::affine::Affine;
use math::double_double::DoubleDouble;
use std::fmt::Debug;
use std::sync::Arc;

/// A law that is a Rust type (see [`Law`]), whichever it is. Made by [`Model::own`](super::Model::own). Clones of one
/// value are equal, others are not.
#[derive(Clone, Debug)]
pub struct Own(Arc<dyn AnyLaw>);

// a law is Copy and Sync: a panic leaves nothing half changed in it
impl std::panic::UnwindSafe for Own {}
impl std::panic::RefUnwindSafe for Own {}

impl PartialEq for Own {
    fn eq(&self, other: &Own) -> bool {
        Arc::ptr_eq(&self.0, &other.0)
    }
}

impl Own {
    pub(super) fn new<L: Law>(law: L) -> Result<Own, String> {
        check(&law)?;
        Ok(Own(Arc::new(law)))
    }

    /// The law with another value of a parameter; `None` if it has no such parameter.
    pub(super) fn with(&self, name: &str, value: f64) -> Option<Result<Own, String>> {
        self.0.with_value(name, value)
    }

    pub(super) fn names(&self) -> Vec<String> {
        self.0.names()
    }

    /// The value of a parameter; `None` if the law has no such parameter.
    pub fn parameter(&self, name: &str) -> Option<f64> {
        self.0.parameter(name)
    }

    /// The size of its parameter `v0`, else `scale`.
    pub(super) fn speed_scale(&self) -> Option<f64> {
        super::size_of_speeds(|name| self.parameter(name))
    }

    pub(super) fn force(&self) -> Box<dyn Force> {
        self.0.force_on_ring()
    }

    /// Whether its formula has kinks.
    pub(super) fn has_kinks(&self) -> bool {
        self.force().kinks() > 0
    }

    pub(super) fn contact(&self) -> f64 {
        self.0.contact_spacing()
    }

    pub(super) fn is_singular(&self) -> bool {
        self.0.is_infinite_at_contact()
    }

    pub(super) fn acceleration(&self, net_gap: f64, speed: f64, ahead: f64) -> f64 {
        self.0.value(net_gap, speed, ahead)
    }

    pub(super) fn effective_gap(&self, net_gap: f64, speed: f64, ahead: f64) -> f64 {
        self.0.gap(net_gap, speed, ahead)
    }

    /// Whether the effective gap is the net gap.
    pub(super) fn has_plain_gap(&self) -> bool {
        self.0.has_plain_gap()
    }

    /// As [`Law::response`]; `None` where a derivative is not finite.
    pub(super) fn response(&self, headway: f64, speed: f64) -> Option<Response> {
        let response = self.0.response_of(headway, speed);
        let is_finite = response.spacings.iter().chain(&response.speeds).all(|(_, slope)| slope.is_finite());
        is_finite.then_some(response)
    }

    pub(crate) fn precise(&self, net_gap: DoubleDouble, speed: DoubleDouble, ahead: DoubleDouble) -> DoubleDouble {
        self.0.precise(net_gap, speed, ahead)
    }
}

/// What is asked of a law whose type is not known.
trait AnyLaw: Debug + Send + Sync {
    fn with_value(&self, name: &str, value: f64) -> Option<Result<Own, String>>;
    fn names(&self) -> Vec<String>;
    fn parameter(&self, name: &str) -> Option<f64>;
    fn force_on_ring(&self) -> Box<dyn Force>;
    fn contact_spacing(&self) -> f64;
    fn is_infinite_at_contact(&self) -> bool;
    fn value(&self, net_gap: f64, speed: f64, ahead: f64) -> f64;
    fn gap(&self, net_gap: f64, speed: f64, ahead: f64) -> f64;
    fn has_plain_gap(&self) -> bool;
    fn response_of(&self, headway: f64, speed: f64) -> Response;
    fn precise(&self, net_gap: DoubleDouble, speed: DoubleDouble, ahead: DoubleDouble) -> DoubleDouble;
}

impl<L: Law> AnyLaw for L {
    fn with_value(&self, name: &str, value: f64) -> Option<Result<Own, String>> {
        let mut law = *self;
        super::set(&mut law, name, value).then(|| Own::new(law))
    }

    fn names(&self) -> Vec<String> {
        super::names(self)
    }

    fn parameter(&self, name: &str) -> Option<f64> {
        let parameter = L::PARAMETERS.iter().find(|parameter| parameter.name == name)?;
        Some(value_of(self, parameter))
    }

    fn force_on_ring(&self) -> Box<dyn Force> {
        Box::new(Compiled::new(*self))
    }

    fn contact_spacing(&self) -> f64 {
        L::CONTACT
    }

    fn is_infinite_at_contact(&self) -> bool {
        L::SINGULAR
    }

    fn value(&self, net_gap: f64, speed: f64, ahead: f64) -> f64 {
        self.acceleration(net_gap, speed, ahead)
    }

    fn gap(&self, net_gap: f64, speed: f64, ahead: f64) -> f64 {
        self.effective_gap(net_gap, speed, ahead)
    }

    fn has_plain_gap(&self) -> bool {
        gap_slopes(self) == Some([1.0, 0.0, 0.0])
    }

    fn response_of(&self, headway: f64, speed: f64) -> Response {
        self.response(headway, speed)
    }

    fn precise(&self, net_gap: DoubleDouble, speed: DoubleDouble, ahead: DoubleDouble) -> DoubleDouble {
        self.acceleration(net_gap, speed, ahead)
    }
}

fn value_of<L: Law>(law: &L, parameter: &Parameter<L>) -> f64 {
    *(parameter.place)(&mut law.clone())
}

/// The slopes of the effective gap in net gap, speed and speed ahead, where they are the same everywhere.
fn gap_slopes<L: Law>(law: &L) -> Option<[f64; 3]> {
    law.effective_gap(Affine::variable(0), Affine::variable(1), Affine::variable(2)).slopes
}

/// What the rest of the crate relies on, so that a law that breaks it is refused instead of giving wrong numbers.
fn check<L: Law>(law: &L) -> Result<(), String> {
    for parameter in L::PARAMETERS {
        let value = value_of(law, parameter);
        let (is_valid, valid) = match parameter.range {
            Range::Positive => (value > 0.0, "above 0"),
            Range::NotNegative => (value >= 0.0, "0 or above"),
        };
        if !(is_valid && value.is_finite()) {
            return Err(format!("{law:?}: {} = {value:?}; must be finite and {valid}", parameter.name));
        }
    }
    let at_contact = law.effective_gap(0.0, 0.0, 0.0);
    if gap_slopes(law).is_none() || at_contact != 0.0 {
        return Err(format!(
            "{law:?}: the effective gap is {at_contact:?} where two touch at rest; it must be linear in net gap and speeds, with constant slopes, and 0 there"
        ));
    }
    let force = law.acceleration(0.0, 0.0, 0.0);
    if force.is_finite() == L::SINGULAR {
        let valid = if L::SINGULAR { "infinite, or SINGULAR = false" } else { "finite, or SINGULAR = true" };
        return Err(format!(
            "{law:?}: the acceleration is {force:?} where two touch at rest, and SINGULAR = {}; it must be {valid}",
            L::SINGULAR
        ));
    }
    Ok(())
}
