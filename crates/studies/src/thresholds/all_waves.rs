//! Random laws: whether the criterion for long waves decides the stability of all of them, and the two roots.

use super::critical::{algebraic, wave_numbers};
use crate::draw::Draw;
use crate::hard::rows::{Rows, row};
use jam::criteria;
use jam::laws::{Exponential, Logarithmic, Model};
use jam::stability::Linear;
use jam::uniform::steady_speed;
use std::f64::consts::PI;

/// How many laws of each kind.
const CASES: usize = 20_000;
/// A margin below this is neither: the first waves to grow are longer than those looked at.
const EDGE: f64 = 1e-7;

/// A random law in its uniform flow: linearised, and the paper's criterion.
struct Case {
    linear: Linear,
    criterion: f64,
}

type Make = fn(&mut Draw) -> Option<Case>;

const KINDS: [(&str, Make); 4] = [
    ("algebraic", random_algebraic),
    ("exponential", |draw| random_exponential(draw, false)),
    ("exponential_contact", |draw| random_exponential(draw, true)),
    ("logarithmic", random_logarithmic),
];

fn random_algebraic(draw: &mut Draw) -> Option<Case> {
    let law =
        algebraic(draw.between(0.0, 2.0), (draw.between(0.0, 1.0), draw.between(0.5, 4.0), draw.between(0.0, 1.5)));
    let gap = draw.between(0.05, 3.0);
    Some(Case { linear: law.linearise(gap), criterion: criteria::algebraic(&law, gap) })
}

fn random_exponential(draw: &mut Draw, has_contact: bool) -> Option<Case> {
    let (strength, range) = (draw.between(0.0, 10.0), draw.between(0.1, 3.0));
    let (contact, widening) = (draw.between(0.0, 5.0), draw.between(0.0, 1.5));
    let contact = if has_contact { contact } else { 0.0 };
    let law = Exponential { a: strength, b: range, c: contact, a_v: widening, epsilon: 0.1, v0: 3.0 };
    let gap = draw.between(0.05, 3.0);
    Some(Case { linear: law.linearise(gap), criterion: criteria::exponential(&law, gap) })
}

fn random_logarithmic(draw: &mut Draw) -> Option<Case> {
    let law = Logarithmic { v0: draw.between(0.1, 6.0), a_v: draw.between(0.0, 1.0), epsilon: 0.01 };
    let headway = draw.between(0.5, 2.5);
    let speed = steady_speed(&Model::Logarithmic(law), headway).ok()?;
    // the paper supposes a headway below the critical distance; with eps > 0 this means well below it
    let is_dense = headway < 0.9 * law.critical_distance(speed);
    is_dense
        .then(|| Case { linear: law.linearise(headway, speed), criterion: criteria::logarithmic(&law, headway, speed) })
}

/// Counts the laws whose largest growth rate over all waves has another sign than the margin for long waves (`wrong`),
/// or than the paper's criterion (`paper_wrong`).
pub fn all_waves() -> Rows {
    let mut rows =
        Rows::new(&["law", "cases", "waves", "unstable", "wrong", "paper_wrong", "at_the_edge", "worst_is_long"]);
    for (name, make) in KINDS {
        let mut draw = Draw::default();
        let [mut cases, mut unstable, mut wrong, mut paper_wrong, mut edge, mut long] = [0_usize; 6];
        while cases < CASES {
            let Some(Case { linear, criterion }) = make(&mut draw) else { continue };
            cases += 1;
            let margin = linear.long_wave_margin();
            if margin.abs() < EDGE {
                edge += 1;
                continue;
            }
            let grows = wave_numbers().any(|k| linear.growth_rate(k) > 0.0);
            unstable += usize::from(grows);
            wrong += usize::from(grows != (margin > 0.0));
            paper_wrong += usize::from(grows != (criterion > 0.0));
            long += usize::from(wave_numbers().all(|k| linear.margin(k) <= margin));
        }
        rows.push(row![name, cases, wave_numbers().count(), unstable, wrong, paper_wrong, edge, long]);
    }
    rows
}

/// The two roots of the same laws at 64 wave numbers, and at `k = 0`.
pub fn roots() -> Rows {
    let mut rows = Rows::new(&[
        "law",
        "cases",
        "complex",
        "plus_below_minus",
        "minus_grows",
        "zero_at_k_0",
        "largest_other_at_k_0",
        "sign_of_k",
    ]);
    for (name, make) in KINDS {
        let mut draw = Draw::default();
        let [mut cases, mut complex, mut below, mut grows, mut zeros] = [0_usize; 5];
        let (mut other, mut sign): (f64, f64) = (f64::NEG_INFINITY, 0.0);
        for _ in 0..CASES / 10 {
            let Some(Case { linear, .. }) = make(&mut draw) else { continue };
            zeros += usize::from(linear.root(0.0) == (0.0, 0.0));
            other = math::larger(other, -linear.polynomial(0.0).0.0);
            for k in (1..=64).map(|i| PI * f64::from(i) / 64.0) {
                let (plus, b) = (linear.root(k), linear.polynomial(k).0);
                let minus = -b.0 - plus.0;
                cases += 1;
                // at k = pi the equation is real
                complex += usize::from(plus.1.abs() > 1e-12);
                // conjugate roots have equal real parts, up to rounding
                below += usize::from(plus.0 < minus - 1e-12);
                grows += usize::from(minus >= 0.0);
                sign = math::larger(sign, (plus.0 - linear.growth_rate(-k)).abs());
            }
        }
        rows.push(row![name, cases, complex, below, grows, zeros, other, sign]);
    }
    rows
}
