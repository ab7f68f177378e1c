//! Reproducible random arguments, errors in units in the last place, and a loop over a lane function.

#[path = "../../src/random.rs"]
mod random;

use math::double_double::DoubleDouble;
use math::simd::Kernel;

pub use random::Random;

/// How many random arguments a function is judged by.
pub const COUNT: usize = if cfg!(debug_assertions) { 50_000 } else { 1_000_000 };

impl Random {
    /// A number between the two, all equally likely.
    pub fn uniform(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * ((self.bits() >> 11) as f64 / (1u64 << 53) as f64)
    }

    /// A number between two positive ones, all doubles equally likely: so each power of
    /// 2 has the same chance.
    pub fn spread(&mut self, low: f64, high: f64) -> f64 {
        let (low, high) = (low.to_bits(), high.to_bits());
        f64::from_bits(low + self.bits() % (high - low + 1))
    }

    /// As [`Random::spread`], with either sign.
    pub fn signed_spread(&mut self, low: f64, high: f64) -> f64 {
        let size = self.spread(low, high);
        if self.bits() & 1 == 0 { size } else { -size }
    }
}

/// [`COUNT`] arguments.
pub fn arguments(seed: u64, mut next: impl FnMut(&mut Random) -> f64) -> Vec<f64> {
    let mut random = Random(seed);
    (0..COUNT).map(|_| next(&mut random)).collect()
}

/// The distance of two neighbouring doubles at this size.
pub fn unit(value: f64) -> f64 {
    let size = value.abs();
    size.next_up() - size
}

/// The error in units in the last place of the true value.
pub fn error_in_units(computed: f64, exact: DoubleDouble) -> f64 {
    ((computed - exact.hi) - exact.lo).abs() / unit(exact.hi)
}

/// The largest error over the arguments, in units in the last place of the true value,
/// and the argument where it occurs.
pub fn largest_error(
    arguments: &[f64],
    computed: impl Fn(f64) -> f64,
    truth: impl Fn(f64) -> DoubleDouble,
) -> (f64, f64) {
    let mut worst = (0.0, f64::NAN);
    for &x in arguments {
        let exact = truth(x);
        let error = error_in_units(computed(x), exact);
        assert!(!error.is_nan(), "not a number at {x:e}: {} for {exact:?}", computed(x));
        if error > worst.0 {
            worst = (error, x);
        }
    }
    worst
}

/// Asserts that the largest error keeps within the bound (units in the last place).
#[track_caller]
pub fn assert_error(
    name: &str,
    bound: f64,
    arguments: &[f64],
    computed: impl Fn(f64) -> f64,
    truth: impl Fn(f64) -> DoubleDouble,
) {
    let (error, x) = largest_error(arguments, computed, truth);
    println!("{name}: at most {error:.3} units, at {x:e}");
    assert!(error <= bound, "{name}: {error} units in the last place at {x:e}, allowed are {bound}");
}

/// out\[i\] = f(x\[i\]).
pub struct Map<'a, F> {
    /// A lane function.
    pub f: F,
    /// Its arguments.
    pub x: &'a [f64],
    /// Its results.
    pub out: &'a mut [f64],
}

impl<F: Fn(f64) -> f64> Kernel for Map<'_, F> {
    type Output = ();

    #[inline(always)]
    fn run(self) {
        for (out, &x) in self.out.iter_mut().zip(self.x) {
            *out = (self.f)(x);
        }
    }
}
