//! What a caller provides about its equations.

use std::ops::Range;

/// An autonomous system `dy/dt = f(y)` whose state splits into position-like components, the rates of which depend on
/// the speed-like components alone, and the rest. A system without such a split has no position-like components.
///
/// States and rates are slices of [`System::dimension`] numbers; a rate has the unit of its component over that of
/// time. The first five functions have to be written; the others serve methods and checks that not every system has. A
/// rate that does not exist is NaN: the step that asks for it is not accepted.
pub trait System {
    /// The number of components.
    fn dimension(&self) -> usize;

    /// Writes the rates of the position-like components, from the others; leaves the rates of those alone.
    fn kinematics(&self, state: &[f64], rates: &mut [f64]);

    /// Writes the rates of all other components; leaves those of the position-like ones alone.
    fn dynamics(&self, state: &[f64], rates: &mut [f64]);

    /// The position-like components, in ranges of the state; empty if there are none.
    fn positions(&self) -> Vec<Range<usize>>;

    /// The components whose errors are measured together; together they cover the state.
    fn groups(&self) -> Vec<Group>;

    /// Whether the equations are defined at this state. An adaptive step with a stage outside is repeated smaller.
    fn in_domain(&self, _state: &[f64]) -> bool {
        true
    }

    /// Makes `count` steps of length `h` (above 0, in the unit of time) of Heun's scheme in place, with the same bits
    /// as one by one, if the system has a faster way to do so.
    fn heun(&self, _state: &mut [f64], _h: f64, _count: u64) -> Batch {
        Batch::Unsupported
    }

    /// Whether [`System::series`] gives the Taylor series of a solution.
    fn has_series(&self) -> bool {
        false
    }

    /// Writes the coefficients of the Taylor series of the solution through a state, in powers of the time divided by
    /// `unit`: `order + 1` rows of `dimension()` numbers, of which the first two, the state and `unit` times its rates,
    /// are given. Rows may also have [`System::row_length`] places each; what lies behind the numbers has no meaning.
    fn series(&self, _order: usize, _unit: f64, _coefficients: &mut [f64]) {}

    /// The length of the rows of a series that suits the system best, at least `dimension()`.
    fn row_length(&self) -> usize {
        self.dimension()
    }

    /// The number of coefficients of the linearised equations at a state; 0 for a system that does not provide them.
    fn tangent_size(&self) -> usize {
        0
    }

    /// Takes out of a difference of two states what no two of them differ by. Roundings put it in, and where all else
    /// fades it would stay.
    fn constrain(&self, _difference: &mut [f64]) {}

    /// Writes them, and returns about how fast the fastest difference moves besides fading: the largest distance of an
    /// eigenvalue from their middle.
    fn tangent(&self, _state: &[f64], _tangent: &mut [f64]) -> f64 {
        0.0
    }

    /// Writes coefficients that hold on average over a step; `earlier` are those of the step before, or of its start.
    /// `None` where they do not follow from the ends of the step.
    fn mean_tangent(&self, _ends: TangentEnds<'_>, _earlier: &[f64], _tangent: &mut [f64]) -> Option<MeanTangent> {
        None
    }

    /// Carries a small difference over a time in which the coefficients change linearly, to two digits of its largest
    /// component.
    fn carry(&self, _tangent: Tangent<'_>, _difference: &mut [f64]) {}

    /// How fast speed-like components relax if no force acts: the force on one is its rate plus this times it. A
    /// rounded constant of the equations makes all forces too strong or too weak by about the same part, at all times.
    fn relaxation_rate(&self) -> f64 {
        0.0
    }

    /// In how many places the rates can bend sharply, as a smooth ramp does.
    fn bends(&self) -> usize {
        0
    }

    /// Writes how far a state is from each bend, in units of its width, 0 in its middle; and how fast that changes.
    /// Steps of adaptive length are short on this scale where they touch a bend, since their error estimates may not
    /// see what they step over.
    fn bend_arguments(&self, _state: &[f64], _rates: &[f64], _arguments: &mut [f64], _slopes: &mut [f64]) {}

    /// How many arguments with kinks at 0 the rates have, as those of `abs`, and what `min` and `max` compare.
    fn kinks(&self) -> usize {
        0
    }

    /// Writes the coefficients of these arguments in the series that [`System::series`] wrote last: `order` rows of
    /// [`System::kinks`] numbers. The steps of Taylor's method end where one of them passes through 0.
    fn kink_arguments(&self, _order: usize, _arguments: &mut [f64]) {}

    /// All rates: [`System::kinematics`] and [`System::dynamics`].
    fn rates(&self, state: &[f64], rates: &mut [f64]) {
        self.kinematics(state, rates);
        self.dynamics(state, rates);
    }
}

/// States and rates at the start of a step and at its end.
#[derive(Clone, Copy, Debug)]
pub struct TangentEnds<'a> {
    /// The states.
    pub states: [&'a [f64]; 2],
    /// Their rates.
    pub rates: [&'a [f64]; 2],
}

/// What is known of linearised equations that hold on average over a step.
#[derive(Clone, Copy, Debug)]
pub struct MeanTangent {
    /// How fast differences move at most, as [`System::tangent`] says, per unit of time.
    pub fastest: f64,
    /// The largest change of a coefficient from the earlier ones, as a part of the largest coefficient; at least 0.
    pub change: f64,
}

/// Linearised equations over a time.
#[derive(Debug)]
pub struct Tangent<'a> {
    /// The coefficients at the start of it.
    pub start: &'a [f64],
    /// Those at its end; empty: they do not change.
    pub end: &'a [f64],
    /// The time.
    pub length: f64,
    /// How fast differences move at most, as [`System::tangent`] says.
    pub fastest: f64,
    /// Scratch, which the caller keeps.
    pub room: &'a mut Vec<f32>,
}

/// The result of a batch of steps (see [`System::heun`]).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Batch {
    /// The steps were made and nothing happened in them.
    Done,
    /// Something happened in one of them: they must be made again one by one, to be looked at.
    NeedsInspection,
    /// There is no faster way; the state is untouched.
    Unsupported,
}

/// Components of one kind, whose errors are compared with one size.
#[derive(Clone, Debug, PartialEq)]
pub struct Group {
    /// The components, all of one unit.
    pub range: Range<usize>,
    /// What an error is compared with.
    pub measure: Measure,
    /// The size below which errors need not shrink any further, in the unit of the components; at least 0.
    pub floor: f64,
}

/// What the error of a component is compared with, besides the floor.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Measure {
    /// The largest component of the group: the tolerance is relative to the group.
    Largest,
    /// The smallest component of the group: every one keeps its relative precision.
    Smallest,
}
