//! Power series of a formula along a motion, computed order by order.
//!
//! Each operation has a recurrence for its next coefficient ([`recurrences`]). A formula is carried out once for each
//! order, with [`Jet`]s that hold the coefficients of this order: linear operations act on these, the others read and
//! write the earlier ones in a [`Place`].

pub mod recurrences;

use crate::lanes::Lanes;
use crate::number::Number;
use recurrences as next;
use std::cell::Cell;
use std::ops::{Add, Div, Mul, Neg, Sub};

/// The coefficients of one order, of `W` pedestrians. Aligned as the widest registers are: a load across two cache lines
/// costs two of them.
#[derive(Clone, Debug)]
#[repr(align(64))]
pub struct Block<const W: usize>(Cell<[f64; W]>);

impl<const W: usize> Default for Block<W> {
    fn default() -> Block<W> {
        Block(Cell::new([0.0; W]))
    }
}

impl<const W: usize> Block<W> {
    #[inline(always)]
    fn get(&self) -> Lanes<W> {
        Lanes(self.0.get())
    }

    #[inline(always)]
    fn set(&self, coefficients: Lanes<W>) {
        self.0.set(coefficients.0);
    }
}

/// The memory of an operation that is not linear: a number of rows of a block for each order.
pub const ROWS: usize = recurrences::ROWS;

/// Where the operations of a formula keep earlier coefficients, for `W` pedestrians: [`ROWS`] rows for each operation that
/// is not linear, each as long as the series.
#[derive(Debug)]
pub struct Place<'t, const W: usize> {
    memory: &'t [Block<W>],
    /// Coefficients of a series.
    length: usize,
    /// The order that is computed.
    order: usize,
    next: Cell<usize>,
}

impl<'t, const W: usize> Place<'t, W> {
    /// For the coefficients of this order of series of `length`.
    #[inline(always)]
    pub fn new(memory: &'t [Block<W>], length: usize, order: usize) -> Place<'t, W> {
        Place { memory, length, order, next: Cell::new(0) }
    }

    /// A variable: its coefficient of this order.
    #[inline(always)]
    pub fn variable<const START: bool>(&self, coefficient: Lanes<W>) -> Jet<'_, W, START> {
        Jet { place: self, coefficient }
    }

    /// The memory of the next operation.
    #[inline(always)]
    fn history(&self) -> next::History<'t, W> {
        let from = self.next.get();
        self.next.set(from + ROWS * self.length);
        next::History::new(&self.memory[from..from + ROWS * self.length], self.length, self.order)
    }
}

/// A coefficient of a series. `START` at order 0, where functions are evaluated; from order 1 on there are recurrences.
#[derive(Clone, Copy, Debug)]
pub struct Jet<'t, const W: usize, const START: bool> {
    place: &'t Place<'t, W>,
    coefficient: Lanes<W>,
}

impl<const W: usize, const START: bool> Jet<'_, W, START> {
    /// The coefficients of this order.
    #[inline(always)]
    pub fn coefficient(self) -> Lanes<W> {
        self.coefficient
    }

    #[inline(always)]
    fn with(self, coefficient: Lanes<W>) -> Self {
        Jet { coefficient, ..self }
    }
}

impl<const W: usize, const START: bool> Neg for Jet<'_, W, START> {
    type Output = Self;
    #[inline(always)]
    fn neg(self) -> Self {
        self.with(-self.coefficient)
    }
}

impl<const W: usize, const START: bool> Add for Jet<'_, W, START> {
    type Output = Self;
    #[inline(always)]
    fn add(self, other: Self) -> Self {
        self.with(self.coefficient + other.coefficient)
    }
}

impl<const W: usize, const START: bool> Sub for Jet<'_, W, START> {
    type Output = Self;
    #[inline(always)]
    fn sub(self, other: Self) -> Self {
        self.with(self.coefficient - other.coefficient)
    }
}

impl<const W: usize, const START: bool> Add<f64> for Jet<'_, W, START> {
    type Output = Self;
    #[inline(always)]
    fn add(self, other: f64) -> Self {
        if START { self.with(self.coefficient + other) } else { self }
    }
}

impl<const W: usize, const START: bool> Sub<f64> for Jet<'_, W, START> {
    type Output = Self;
    #[inline(always)]
    fn sub(self, other: f64) -> Self {
        if START { self.with(self.coefficient - other) } else { self }
    }
}

impl<const W: usize, const START: bool> Mul<f64> for Jet<'_, W, START> {
    type Output = Self;
    #[inline(always)]
    fn mul(self, other: f64) -> Self {
        self.with(self.coefficient * other)
    }
}

impl<const W: usize, const START: bool> Div<f64> for Jet<'_, W, START> {
    type Output = Self;
    #[inline(always)]
    fn div(self, other: f64) -> Self {
        self.with(self.coefficient / other)
    }
}

impl<const W: usize, const START: bool> Mul for Jet<'_, W, START> {
    type Output = Self;
    #[inline(always)]
    fn mul(self, other: Self) -> Self {
        self.with(next::product::<W, START>(self.place.history(), self.coefficient, other.coefficient))
    }
}

impl<const W: usize, const START: bool> Div for Jet<'_, W, START> {
    type Output = Self;
    #[inline(always)]
    fn div(self, other: Self) -> Self {
        self.with(next::quotient::<W, START>(self.place.history(), self.coefficient, other.coefficient))
    }
}

/// Functions of one number.
macro_rules! functions {
    ($($name:ident)*) => {
        $(#[inline(always)]
        fn $name(self) -> Self {
            self.with(next::$name::<W, START>(self.place.history(), self.coefficient))
        })*
    };
}

impl<const W: usize, const START: bool> Number for Jet<'_, W, START> {
    functions!(recip exp exp_m1 ln ln_1p sqrt tanh softplus abs);

    #[inline(always)]
    fn powi(self, n: i32) -> Self {
        match n {
            0 => self.with(if START { Lanes::splat(1.0) } else { Lanes::default() }),
            1 => self,
            -1 => self.recip(),
            // products, because the number may pass through 0
            2.. => (1..n).fold(self, |product, _| product * self),
            _ => self.with(next::whole_power::<W, START>(self.place.history(), self.coefficient, n)),
        }
    }

    #[inline(always)]
    fn powf(self, q: f64) -> Self {
        self.with(next::power::<W, START>(self.place.history(), self.coefficient, q))
    }

    #[inline(always)]
    fn min(self, other: Self) -> Self {
        self.with(next::min::<W, START>(self.place.history(), self.coefficient, other.coefficient))
    }

    #[inline(always)]
    fn max(self, other: Self) -> Self {
        self.with(next::max::<W, START>(self.place.history(), self.coefficient, other.coefficient))
    }
}
