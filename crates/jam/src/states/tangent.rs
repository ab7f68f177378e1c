//! The linearised equations of a ring: `du_n/dt = w_{n+1} - w_n`, `dw_n/dt = phi_n u_n - a_n w_n + c_n w_{n+1}`, with
//! the slopes of the acceleration by the own spacing, the own speed and that ahead, along the solution. Where the force
//! depends on the own spacing alone, `a_n = 1` and `c_n = 0`, and only the first ones are kept.

use super::series::Carry;
use crate::force::{Dependence, Flow, Force, Rows};
use math::simd::{Kernel, dispatch};
use ode::{MeanTangent, Tangent, TangentEnds};

/// The middle of the eigenvalues where the force depends on the spacing alone: for equal slopes, those of a wave add up
/// to -1. Without the fading that all have in common series need fewer orders.
pub(super) const FADING: f64 = -0.5;

/// About how far from their middle eigenvalues `z` lie at most: that of the relaxation, or, for the steepest slope
/// `phi`, those of its shortest waves, for which `(z + 1/2)^2 = 1/4 - 2 phi`. Slopes are not equal; a tenth is added
/// for that.
fn fastest(steepest: f64) -> f64 {
    let shortest = 2.0 * steepest - FADING * FADING;
    1.1 * math::larger(shortest, FADING * FADING).sqrt()
}

/// How many coefficients the linearised equations of so many pedestrians have: the rows of slopes, and behind three
/// rows the middle of the eigenvalues.
pub(super) fn size(force: &dyn Force, pedestrians: usize) -> usize {
    match force.dependence() {
        Dependence::Spacing => pedestrians,
        Dependence::Speeds => 3 * pedestrians + 1,
        Dependence::Unknown => 0,
    }
}

/// Writes them, and returns how fast the fastest difference moves: the largest distance of an eigenvalue from the
/// middle, and NaN where a slope has no value.
pub(super) fn write(force: &dyn Force, flow: Flow, now: Rows<'_>, tangent: &mut [f64]) -> f64 {
    let n = now.spacings.len();
    if tangent.len() == n {
        force.slopes(flow, now, tangent);
        return fastest(ode::largest(tangent));
    }
    let (slopes, middle) = tangent.split_at_mut(3 * n);
    force.slopes(flow, now, slopes);
    let (by_spacing, by_speeds) = slopes.split_at(n);
    let (own, ahead) = by_speeds.split_at(n);
    let fading = dispatch(Middle { own });
    middle[0] = fading;
    dispatch(Farthest { by_spacing, own, ahead, fading })
}

/// As [`write`], of means over a step: where the force depends on the spacing alone, what it changes by over what the
/// spacing changes by. Of a slope that changes within the step, this is the mean along the way, without a function of
/// the law. `least` is a size of which forces are rounded parts.
pub(super) fn write_mean(
    force: &dyn Force,
    n: usize,
    ends: TangentEnds<'_>,
    least: f64,
    earlier: &[f64],
    tangent: &mut [f64],
) -> Option<MeanTangent> {
    (force.dependence() == Dependence::Spacing).then(|| {
        let [steepest, change] = dispatch(Means { n, ends, least, earlier, tangent });
        MeanTangent { fastest: fastest(steepest), change: if change == 0.0 { 0.0 } else { change / steepest } }
    })
}

/// A change of a force has two digits and more where it is this part of the force: else the slope is that of an earlier
/// step, in which the spacing was about the same.
const VISIBLE: f64 = 1e-10;

/// Writes the slopes; returns the steepest and by how much one differs most from the earlier one, NaN where one is.
struct Means<'a> {
    n: usize,
    ends: TangentEnds<'a>,
    least: f64,
    earlier: &'a [f64],
    tangent: &'a mut [f64],
}

impl Kernel for Means<'_> {
    type Output = [f64; 2];

    /// Sizes are compared as whole numbers: see [`ode::largest`].
    #[inline(always)]
    fn run(self) -> [f64; 2] {
        let Means { n, ends: TangentEnds { states, rates }, least, earlier, tangent } = self;
        let larger = |most: i64, value: f64| {
            let size = value.abs().to_bits() as i64;
            if size > most { size } else { most }
        };
        let steepest = f64::from_bits(earlier.iter().fold(0, |most, slope| larger(most, *slope)) as u64);
        let spacings = states[0][..n].iter().zip(&states[1][..n]);
        let speeds = states[0][n..2 * n].iter().zip(&states[1][n..2 * n]);
        let rates = rates[0][n..2 * n].iter().zip(&rates[1][n..2 * n]);
        let known = spacings.zip(speeds).zip(rates).zip(earlier);
        let mut most = [0; 2];
        for (slope, ((((from, to), (speed, later_speed)), (rate, later_rate)), earlier)) in
            tangent.iter_mut().zip(known)
        {
            let (way, change) = (to - from, (later_rate + later_speed) - (rate + speed));
            let size = (rate.abs() + speed.abs()) + (later_rate.abs() + later_speed.abs()) + least;
            let is_visible = way.abs() * steepest > VISIBLE * size;
            let mean = change / way;
            *slope = if is_visible { mean } else { *earlier };
            most = [larger(most[0], *slope), larger(most[1], *slope - *earlier)];
        }
        most.map(|most| f64::from_bits(most as u64))
    }
}

/// The middle of the eigenvalues of all pedestrians by themselves, which are 0 and the slopes by their own speeds.
struct Middle<'a> {
    own: &'a [f64],
}

impl Kernel for Middle<'_> {
    type Output = f64;

    #[inline(always)]
    fn run(self) -> f64 {
        let mut least = [0.0; LANES];
        let (eights, rest) = self.own.as_chunks::<LANES>();
        for eight in eights {
            for lane in 0..LANES {
                least[lane] = if eight[lane] < least[lane] { eight[lane] } else { least[lane] };
            }
        }
        let all = least.iter().chain(rest);
        0.5 * all.fold(0.0, |least, own| if *own < least { *own } else { least })
    }
}

/// A bound on the distances of the eigenvalues from their middle `-m`. These are the eigenvalues of
///
/// ```text
/// B = | m    D |    D: w_{n+1} - w_n    P: phi_n u_n    G: (m - a_n) w_n + c_n w_{n+1}
///     | P    G |
/// ```
///
/// and their squares those of `B^2`. In the norm of the largest component, speeds in units of any `1/sigma`, the rows
/// of `B^2` are at most `m^2 + 2 p + 2 sigma g` and `q^2 + 2 p + p g / sigma`, with the largest `p` of `|phi_n|`, `q`
/// of `|m - a_n| +
/// |c_n|` and `g` of `|2 m - a_n| + |c_n|`. The bound is least for the `sigma` that makes both equal.
struct Farthest<'a> {
    by_spacing: &'a [f64],
    own: &'a [f64],
    ahead: &'a [f64],
    fading: f64,
}

impl Kernel for Farthest<'_> {
    type Output = f64;

    #[inline(always)]
    fn run(self) -> f64 {
        let Farthest { by_spacing, own, ahead, fading } = self;
        // largest values pass over NaN, this sum does not
        let (mut most, mut nothing) = ([[0.0; LANES]; 3], [0.0; LANES]);
        let mut take = |lane: usize, by_spacing: f64, own: f64, ahead: f64| {
            let aside = ahead.abs();
            let sizes = [by_spacing.abs(), (own - fading).abs() + aside, (own - 2.0 * fading).abs() + aside];
            for (most, size) in most.iter_mut().zip(sizes) {
                most[lane] = if size > most[lane] { size } else { most[lane] };
            }
            nothing[lane] += 0.0 * (by_spacing + own + ahead);
        };
        let (by_spacings, rest) = by_spacing.as_chunks::<LANES>();
        let (owns, own_rest) = own.as_chunks::<LANES>();
        let (aheads, ahead_rest) = ahead.as_chunks::<LANES>();
        for ((by_spacing, own), ahead) in by_spacings.iter().zip(owns).zip(aheads) {
            for lane in 0..LANES {
                take(lane, by_spacing[lane], own[lane], ahead[lane]);
            }
        }
        for ((by_spacing, own), ahead) in rest.iter().zip(own_rest).zip(ahead_rest) {
            take(0, *by_spacing, *own, *ahead);
        }
        let [p, q, g] = most.map(|most| most.into_iter().fold(0.0, |most, one| if one > most { one } else { most }));
        let (m, q) = (fading * fading, q * q);
        let (middle, half) = (0.5 * (m + q), 0.5 * (m - q));
        (2.0 * p + middle + (half * half + 2.0 * p * g * g).sqrt()).sqrt() + nothing.iter().sum::<f64>()
    }
}

/// Carries a difference of spacings and speeds of so many pedestrians; returns the way that the first one's speed adds.
pub(super) fn carry(tangent: Tangent<'_>, n: usize, difference: &mut [f64]) -> f64 {
    dispatch(Carry { tangent, n, difference })
}

/// Numbers per iteration.
const LANES: usize = 8;

/// Takes their mean from numbers.
pub(super) struct Centred<'a>(pub(super) &'a mut [f64]);

impl Kernel for Centred<'_> {
    type Output = ();

    #[inline(always)]
    fn run(self) {
        let mut sums = [0.0; LANES];
        let (blocks, rest) = self.0.as_chunks::<LANES>();
        for block in blocks {
            for (sum, number) in sums.iter_mut().zip(block) {
                *sum += number;
            }
        }
        for (sum, number) in sums.iter_mut().zip(rest) {
            *sum += number;
        }
        let mean = sums.iter().sum::<f64>() / self.0.len() as f64;
        self.0.iter_mut().for_each(|number| *number -= mean);
    }
}
