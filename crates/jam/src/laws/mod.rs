//! The laws of motion, `dv_n/dt = f(s_n, v_n, v_{n+1})`. Each has a file with its parameters and the formula as the
//! paper prints it. Everything else follows from evaluating that formula with different kinds of numbers
//! ([`math::number`]).
//!
//! A parameter that is zero names no term: the formula leaves it out.

mod algebraic;
mod exponential;
mod formula;
mod logarithmic;
mod own;
pub mod presets;

pub use algebraic::Algebraic;
pub use exponential::Exponential;
pub use formula::Formula;
pub use logarithmic::{C, Logarithmic};
pub use own::Own;

use crate::force::{Compiled, Force};
use crate::ramp::Bend;
use crate::stability::{Linear, Response};
use math::dual::Dual;
use math::number::Number;

/// What a parameter may be.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Range {
    /// Greater than 0.
    Positive,
    /// 0 or greater.
    NotNegative,
}

/// A parameter of a law: its name in scenes and on axes, and its range.
#[derive(Debug)]
pub struct Parameter<L> {
    /// The name.
    pub name: &'static str,
    /// What it may be.
    pub range: Range,
    /// Its value where a scene does not name it; `None`: a scene must.
    pub default: Option<f64>,
    /// Where it is kept.
    pub place: fn(&mut L) -> &mut f64,
}

/// Width of the smooth ramp of the algebraic and exponential laws, where a scene names none (text after eq:aTheta).
const RAMP_WIDTH: f64 = 0.1;

/// A law of motion as a formula in Rust: `dv_n/dt` from the net gap to the pedestrian ahead, the own speed and that of
/// the pedestrian ahead. [`Model::own`] makes a [`Model`] of it. Only [`Law::CONTACT`] and [`Law::acceleration`] have
/// to be written.
///
/// ```
/// use jam::laws::{Law, Model, Parameter, Range};
/// use jam::stability::Waves;
/// use jam::uniform::steady_speed;
/// use math::number::Number;
///
/// /// `dv_n/dt = v_0 (1 - exp(-(s_n - 2) / l)) - v_n`.
/// #[derive(Clone, Copy, Debug, Default)]
/// struct Relaxing {
///     v0: f64,
///     length: f64,
/// }
///
/// impl Law for Relaxing {
///     const PARAMETERS: &'static [Parameter<Relaxing>] = &[
///         Parameter { name: "v0", range: Range::Positive, default: None, place: |law| &mut law.v0 },
///         Parameter { name: "l", range: Range::Positive, default: None, place: |law| &mut law.length },
///     ];
///     const CONTACT: f64 = 2.0;
///
///     #[inline(always)]
///     fn acceleration<X: Number>(&self, net_gap: X, speed: X, _ahead: X) -> X {
///         -(net_gap * (-1.0 / self.length)).exp_m1() * self.v0 - speed
///     }
/// }
///
/// let law = Model::own(Relaxing { v0: 1.0, length: 3.0 })?;
/// // stable where the slope V'(s) of the steady speed is below 1/2: V' = exp(-(s - 2)/l) v0/l
/// let speed = steady_speed(&law, 4.0)?;
/// assert!((speed - (1.0 - math::exp(-2.0 / 3.0))).abs() < 1e-15);
/// assert!(law.response(4.0, speed).expect("derivatives").margin(Waves::All).0 < 0.0);
/// // the parameters are known by their names
/// let short = law.with("l", 0.2)?;
/// assert!(short.response(2.1, steady_speed(&short, 2.1)?).expect("derivatives").margin(Waves::All).0 > 0.0);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub trait Law: Copy + Default + Send + Sync + std::fmt::Debug + 'static {
    /// Its parameters. `v0`, else `scale`, is the size of speeds, which tolerances and thresholds refer to; 1 if
    /// neither is there.
    const PARAMETERS: &'static [Parameter<Self>] = &[];

    /// The spacing at which two standing pedestrians touch; the *net gap* is the spacing less this.
    const CONTACT: f64;

    /// Whether the force is infinite where the effective gap closes.
    const SINGULAR: bool = false;

    /// `dv/dt` of a pedestrian with this net gap and speed, and the speed ahead. Branches may depend on parameters
    /// only. To be marked `#[inline(always)]`, or it runs without vector registers.
    fn acceleration<X: Number>(&self, net_gap: X, speed: X, ahead: X) -> X;

    /// The quantity that must stay positive for the run to continue: `d_n` of eq:effDistn, for the logarithmic law the
    /// spacing. It has to be linear in all three with constant slopes, and 0 at contact and rest. By default the net
    /// gap.
    #[inline(always)]
    fn effective_gap<X: Number>(&self, net_gap: X, _speed: X, _ahead: X) -> X {
        net_gap
    }

    /// Whether the formula is so long, with several functions or a logarithm in it, that the operations of many
    /// pedestrians have to overlap; the bits do not depend on it. By default it is.
    #[inline(always)]
    fn is_long(&self) -> bool {
        true
    }

    /// The law with the terms of the paper's runs and no others, if these are all that it has: the same law, with the
    /// parameters that leave a term out as constants, so that the compiler leaves it out as well. By default there is
    /// none.
    #[inline(always)]
    fn plain(&self) -> Option<Self> {
        None
    }

    /// Goes on with the law, in which parameters that choose terms or powers are constants where a loop is compiled for
    /// these: those of [`Law::plain`], and more where the loop is short.
    #[inline(always)]
    fn choose<C: Chosen<Self>>(self, chosen: C) -> C::Output {
        match self.plain() {
            Some(law) => chosen.plain(law),
            None => chosen.any(self),
        }
    }

    /// Where the smooth ramp bends, if the law has one; where its argument is a quotient, its numerator. Steps of
    /// adaptive length are short there. By default there is none.
    fn bend(&self) -> Option<Bend> {
        None
    }

    /// The derivatives of the acceleration in the uniform flow of this headway and speed, from the formula.
    fn response(&self, headway: f64, speed: f64) -> Response {
        let net_gap = headway - Self::CONTACT;
        let slope = |which: usize| {
            let variable = |index: usize, value: f64| Dual { value, slope: if index == which { 1.0 } else { 0.0 } };
            self.acceleration(variable(0, net_gap), variable(1, speed), variable(2, speed)).slope
        };
        Response { spacings: vec![(0, slope(0))], speeds: vec![(0, slope(1)), (1, slope(2))] }
    }
}

/// A function of a concrete law (see [`Law::choose`]).
pub trait Chosen<L> {
    /// What comes of it.
    type Output;

    /// With any.
    fn any(self, law: L) -> Self::Output;

    /// With one in its plain form.
    fn plain(self, law: L) -> Self::Output;

    /// With one whose formula, its constants known, has no choice to be made and one function at most.
    fn straight(self, law: L) -> Self::Output;
}

/// A law with its parameters, as data.
#[derive(Clone, Debug, PartialEq)]
pub enum Model {
    /// eq:invd.
    Algebraic(Algebraic),
    /// eq:sfm.
    Exponential(Exponential),
    /// eq:modlog.
    Logarithmic(Logarithmic),
    /// Any other, as formulas.
    Formula(Formula),
    /// Any other, as a Rust type (see [`Model::own`]).
    Own(Own),
}

/// Calls a function with the concrete law.
macro_rules! each {
    ($model:expr, $law:ident => $action:expr, $formula:ident => $other:expr, $own:ident => $own_action:expr) => {
        match $model {
            Model::Algebraic($law) => $action,
            Model::Exponential($law) => $action,
            Model::Logarithmic($law) => $action,
            Model::Formula($formula) => $other,
            Model::Own($own) => $own_action,
        }
    };
}

/// The spacing at which two touch.
fn contact_of<L: Law>(_law: &L) -> f64 {
    L::CONTACT
}

/// Replaces a parameter; false if there is none of this name.
fn set<L: Law>(law: &mut L, name: &str, value: f64) -> bool {
    match L::PARAMETERS.iter().find(|parameter| parameter.name == name) {
        Some(parameter) => {
            *(parameter.place)(law) = value;
            true
        }
        None => false,
    }
}

/// The names of the parameters.
fn names<L: Law>(_law: &L) -> Vec<String> {
    L::PARAMETERS.iter().map(|parameter| parameter.name.to_owned()).collect()
}

/// Whether the force is infinite at a wall.
fn is_singular<L: Law>(_law: &L) -> bool {
    L::SINGULAR
}

impl Model {
    /// A law that is a Rust type of your own (see [`Law`]). Everything that takes a `Model` accepts it: runs, events,
    /// outcome, stability, maps and jams.
    ///
    /// # Errors
    /// A parameter out of its range; an effective gap that is not linear with constant slopes, or not 0 where two touch
    /// at rest; an acceleration there that is finite though [`Law::SINGULAR`] says otherwise, or the other way round.
    pub fn own<L: Law>(law: L) -> Result<Model, String> {
        Own::new(law).map(Model::Own)
    }

    /// The name of the law in scene files.
    pub fn name(&self) -> &'static str {
        match self {
            Model::Algebraic(_) => "algebraic",
            Model::Exponential(_) => "exponential",
            Model::Logarithmic(_) => "logarithmic",
            Model::Formula(_) => "formula",
            Model::Own(_) => "own",
        }
    }

    /// The desired speed `v_0'`; of a formula or a law of your own its parameter `v0`, else `scale`, else 1.
    pub fn desired_speed(&self) -> f64 {
        self.speed_scale().unwrap_or(1.0)
    }

    /// The size of speeds, if the law has one.
    pub fn speed_scale(&self) -> Option<f64> {
        each!(self, law => Some(law.v0), formula => formula.speed_scale(), own => own.speed_scale())
    }

    /// The names of the parameters.
    pub fn parameters(&self) -> Vec<String> {
        each!(
            self,
            law => names(law),
            formula => formula.parameters().map(|(name, _)| name.to_owned()).collect(),
            own => own.names()
        )
    }

    /// The law with another value of a parameter.
    ///
    /// # Errors
    /// No parameter of this name; or a formula without a value.
    pub fn with(&self, name: &str, value: f64) -> Result<Model, String> {
        self.with_all(&[(name, value)])
    }

    /// The law with other values of some parameters. A formula needs a value only when all of them are set; a law of
    /// your own is set one by one.
    ///
    /// # Errors
    /// As [`Model::with`].
    pub fn with_all(&self, values: &[(&str, f64)]) -> Result<Model, String> {
        let mut model = self.clone();
        let unknown = each!(
            &mut model,
            law => values.iter().find(|(name, value)| !set(law, name, *value)),
            formula => {
                let unknown = values.iter().find(|(name, _)| formula.parameter(name).is_none());
                if unknown.is_none() {
                    *formula = formula.with_all(values).map_err(|error| error.to_string())?;
                }
                unknown
            },
            own => {
                let mut unknown = None;
                for value in values {
                    match own.with(value.0, value.1).transpose()? {
                        Some(changed) => *own = changed,
                        None => unknown = Some(value),
                    }
                }
                unknown
            }
        );
        match unknown {
            None => Ok(model),
            Some((name, _)) => {
                let known = self.parameters().join(", ");
                Err(format!("the {} law has no parameter {name}; it has {known}", self.name()))
            }
        }
    }

    /// Whether the spacing is what the law measures contact by, so that there is no effective gap `d'` of the uniform
    /// flow to start from.
    pub fn has_effective_gap(&self) -> bool {
        matches!(self, Model::Algebraic(_) | Model::Exponential(_))
    }

    /// The force on all pedestrians of a ring.
    pub fn force(&self) -> Box<dyn Force> {
        each!(self, law => Box::new(Compiled::new(*law)), formula => formula.force(), own => own.force())
    }

    /// The acceleration as the paper prints it, in units of `a_0 / tau^2`, at this spacing (not net gap), own speed and
    /// speed ahead; of a formula, that of the uniform flow with this own speed.
    pub fn acceleration(&self, spacing: f64, speed: f64, ahead: f64) -> f64 {
        let net_gap = spacing - self.contact();
        each!(
            self,
            law => law.acceleration(net_gap, speed, ahead),
            formula => formula.uniform(spacing, speed),
            own => own.acceleration(net_gap, speed, ahead)
        )
    }

    /// The spacing at which two standing pedestrians touch, in units of `a_0` (see [`Law::CONTACT`]).
    pub fn contact(&self) -> f64 {
        each!(self, law => contact_of(law), formula => formula.contact(), own => own.contact())
    }

    /// Whether the force is infinite at contact (see [`Law::SINGULAR`]).
    pub fn is_singular(&self) -> bool {
        each!(self, law => is_singular(law), formula => formula.is_singular(), own => own.is_singular())
    }

    /// The effective gap of a pedestrian, in units of `a_0`, at this spacing, own speed and speed ahead (see
    /// [`Law::effective_gap`]).
    pub fn effective_gap(&self, spacing: f64, speed: f64, ahead: f64) -> f64 {
        let net_gap = spacing - self.contact();
        each!(
            self,
            law => law.effective_gap(net_gap, speed, ahead),
            formula => formula.uniform_gap(spacing, speed),
            own => own.effective_gap(net_gap, speed, ahead)
        )
    }

    /// How much of the effective gap a unit of speed, own or ahead, takes away: `a_v` of the paper, in units of `tau`;
    /// 0 for a formula.
    pub fn gap_per_speed(&self) -> f64 {
        -each!(self, law => law.effective_gap(0.0, 1.0, 0.0), _formula => 0.0, own => own.effective_gap(0.0, 1.0, 0.0))
    }

    /// Whether effective gaps are spacings less a constant.
    pub(crate) fn has_plain_gaps(&self) -> bool {
        each!(self, law => law.effective_gap(0.0, 1.0, 0.0) == 0.0, _formula => false, own => own.has_plain_gap())
    }

    /// Whether the acceleration has kinks, at which its derivatives jump: those of `abs`, `min` and `max`.
    pub fn has_kinks(&self) -> bool {
        match self {
            Model::Algebraic(_) | Model::Exponential(_) | Model::Logarithmic(_) => false,
            Model::Formula(formula) => formula.has_kinks(),
            Model::Own(own) => own.has_kinks(),
        }
    }

    /// Whether Taylor's method does not suit some of its kinks: soft ones, of higher derivatives only, as that of
    /// `max(0, x)^2`, which other methods pass at less cost; and those behind which a root is drawn, as that of
    /// `sqrt(max(0, x))`, where its series do not exist.
    pub fn has_unsuited_kinks(&self) -> bool {
        self.has_kinks() && self.force().has_unsuited_kinks()
    }

    /// Whether the law is one of the three of the paper. They have the paper's stability criteria, an acceleration with
    /// derivatives wherever gaps are open, and a single uniform flow; nothing of this is known of another law.
    pub fn is_of_paper(&self) -> bool {
        matches!(self, Model::Algebraic(_) | Model::Exponential(_) | Model::Logarithmic(_))
    }

    /// Whether the acceleration may have no value at some places with open gaps.
    pub fn may_be_undefined(&self) -> bool {
        !self.is_of_paper()
    }

    /// The response of the acceleration to spacings and speeds in this uniform flow. `None` where it has no derivative.
    pub fn response(&self, headway: f64, speed: f64) -> Option<Response> {
        each!(self, law => Some(law.response(headway, speed)), formula => formula.response(headway, speed), own => own.response(headway, speed))
    }

    /// The coefficients of the linearised law about the uniform flow with this headway and speed; of a formula too, if
    /// it looks at one predecessor and has derivatives there, else NaN ([`Model::response`] is for all).
    pub fn linearise(&self, headway: f64, speed: f64) -> Linear {
        match self {
            Model::Algebraic(law) => law.linearise(law.gap(headway, speed)),
            Model::Exponential(law) => law.linearise(law.gap(headway, speed)),
            Model::Logarithmic(law) => law.linearise(headway, speed),
            Model::Formula(_) | Model::Own(_) => {
                self.response(headway, speed).as_ref().map_or(Linear::NONE, Linear::of)
            }
        }
    }
}

/// The size of speeds of a law with these parameters: thresholds refer to it, which a speed of 0 or below would turn
/// around.
fn size_of_speeds(parameter: impl Fn(&str) -> Option<f64>) -> Option<f64> {
    let size = |name: &str| parameter(name).map(f64::abs).filter(|size| *size > 0.0);
    size("v0").or_else(|| size("scale"))
}
