//! The zero contours of the figures' maps in closed form, derived from the paper's equations independently of the code:
//! every cell of a row has the sign that its side of the contour asks for, and on the contour the value vanishes.

use crate::project::figure;
use files::table::Table;
use jam::criteria;
use jam::laws::{Algebraic, C, Exponential, Logarithmic, Model};
use jam::stability::Linear;
use jam::uniform::steady_speed;
use scene::map::Map;
use std::f64::consts::LN_2;

/// The headway of figures 9 and 10.
const HEADWAY: f64 = 1.5;

/// The map of a panel and its table, which [`scene::map`] fills column of cells by column of cells.
fn panel(id: &str, name: &str) -> (Map, Table) {
    let parsed = figure(id);
    let panel = parsed.panel(name).unwrap_or_else(|error| panic!("{error}"));
    let map = scene::map::read(&parsed.file, &panel.tables).unwrap_or_else(|error| panic!("{error}"));
    let computed = map.compute().unwrap_or_else(|error| panic!("{error}"));
    (map, computed.table)
}

/// Which side of its zero a row is positive on.
#[derive(Clone, Copy, PartialEq)]
enum Positive {
    Below,
    Above,
}

/// Compares each cell with the contour `zero(y)` and returns the rows that the contour crosses between two cells, as
/// `(x, y)` on the contour.
fn crossings(id: &str, name: &str, side: Positive, zero: &dyn Fn(&Map, f64) -> f64) -> (Map, Vec<(f64, f64)>) {
    let (map, table) = panel(id, name);
    for row in table.rows() {
        let at = zero(&map, row[1]);
        let is_positive = (row[0] < at) == (side == Positive::Below);
        assert_eq!(row[2] > 0.0, is_positive, "{id} {name}: {row:?}, contour at {at}");
        assert!(row[2] != 0.0, "{id} {name}: {row:?} is on neither side");
    }
    assert_eq!(table.len(), map.x.cells * map.y.cells);
    let (first, last) = (map.x.centre(0), map.x.centre(map.x.cells - 1));
    let points = (0..map.y.cells).map(|j| (zero(&map, map.y.centre(j)), map.y.centre(j)));
    let crossed: Vec<(f64, f64)> = points.filter(|(at, _)| (first..last).contains(at)).collect();
    println!("{id} {name}: the contour crosses {} of {} rows", crossed.len(), map.y.cells);
    (map, crossed)
}

/// The zero of `f`, which falls from positive to negative between the two.
fn falling_zero(mut low: f64, mut high: f64, f: impl Fn(f64) -> f64) -> f64 {
    loop {
        let middle = 0.5 * (low + high);
        if middle <= low || middle >= high {
            return low;
        }
        if f(middle) > 0.0 { low = middle } else { high = middle }
    }
}

fn algebraic(map: &Map) -> Algebraic {
    let Model::Algebraic(law) = map.model else { panic!("{:?}", map.model) };
    law
}

fn exponential(map: &Map) -> Exponential {
    let Model::Exponential(law) = map.model else { panic!("{:?}", map.model) };
    law
}

fn logarithmic(map: &Map) -> Logarithmic {
    let Model::Logarithmic(law) = map.model else { panic!("{:?}", map.model) };
    law
}

/// `1 + cos k` without cancellation near `k = pi`.
fn one_plus_cos(k: f64) -> f64 {
    let half = math::cos(0.5 * k);
    2.0 * half * half
}

/// On the contour the root is imaginary. The contour is rounded and so is the root: with `z^2 + b z + c = 0`, a
/// relative change `e` of `c` or `b` moves the root by at most `e |z| (|z| + 2 |b|) / |2 z + b|`, and `|2 z + b| >= Re
/// b >= 1` where the root is imaginary. `e` is some ten roundings, or more where the contour itself is known no better.
fn assert_imaginary(linear: &Linear, k: f64, e: f64, what: &str) {
    let (re, im) = linear.root(k);
    let (b, _) = linear.polynomial(k);
    let hypotenuse = |x: f64, y: f64| (x * x + y * y).sqrt();
    let condition = (im.abs() + 2.0 * hypotenuse(b.0, b.1)) / hypotenuse(b.0, 2.0 * im + b.1);
    assert!(re.abs() <= e * im.abs() * condition, "{what}, k = {k}: z = {re:e} + {im:e} i");
}

/// Ten roundings of half a unit in the last place each.
const ROUNDING: f64 = 5.0 * f64::EPSILON;

/// `phi (1 + cos k) = 1 + beta (1 + cos k)` with `beta = a_v phi`.
fn marginal_phi(widening: f64, k: f64) -> f64 {
    1.0 / ((1.0 - widening) * one_plus_cos(k))
}

#[test]
fn figure_14_changes_sign_where_the_closed_form_says() {
    // phi = q mu^2 / d'^(q + 1)
    let zero = |map: &Map, k: f64| {
        let law = algebraic(map);
        assert_eq!(law.delta, 0.0);
        let power = law.q * law.mu * law.mu / marginal_phi(law.a_v, k);
        math::pow(power, 1.0 / (law.q + 1.0))
    };
    for name in ["top_left", "top_right", "bottom_left"] {
        let (map, crossed) = crossings("fig14", name, Positive::Below, &zero);
        assert!(crossed.len() > 100, "{name}: {}", crossed.len());
        for (gap, k) in crossed {
            assert_imaginary(&algebraic(&map).linearise(gap), k, ROUNDING, name);
        }
    }
}

#[test]
fn figure_14_is_stable_all_over_its_last_panel() {
    let (map, table) = panel("fig14", "bottom_right");
    let law = algebraic(&map);
    assert_eq!((law.mu, law.delta, law.q, law.a_v), (0.5, 1.0, 1.0, 0.1));
    assert_eq!(table.len(), 200 * 200);
    for row in table.rows() {
        let (gap, k, rate) = (row[0], row[1], row[2]);
        // phi (1 + cos k) < (1 + 2 kappa) ((1 + 2 kappa) + (beta - kappa) (1 + cos k))
        let gamma = 0.5 + 0.1 * LN_2;
        let (phi, kappa, waves) = (gamma * gamma / (gap * gap), gamma / gap, one_plus_cos(k));
        let a = 1.0 + 2.0 * kappa;
        assert!(phi * waves < a * (a + (0.1 * phi - kappa) * waves), "{row:?}");
        assert!(rate < 0.0, "{row:?}");
    }
}

#[test]
fn figure_15_changes_sign_where_the_closed_form_says() {
    // phi = a / b exp(-d' / b)
    let zero = |map: &Map, k: f64| {
        let law = exponential(map);
        law.b * math::ln(law.a / law.b / marginal_phi(law.a_v, k))
    };
    for name in ["top_left", "top_right", "bottom_left", "bottom_right"] {
        let (map, crossed) = crossings("fig15", name, Positive::Below, &zero);
        assert!(crossed.len() > 100, "{name}: {}", crossed.len());
        for (gap, k) in crossed {
            let law = exponential(&map);
            // a rounding of d' is one of phi, d' / b times as large
            assert_imaginary(&law.linearise(gap), k, ROUNDING * (1.0 + gap / law.b), name);
        }
    }
}

#[test]
fn figure_3_changes_sign_where_the_closed_form_says() {
    let zero = |map: &Map, gap: f64| {
        let Algebraic { delta, q: power, a_v, epsilon, .. } = algebraic(map);
        assert_eq!(power, 2.0);
        let cube = gap * gap * gap;
        if delta == 0.0 {
            // phi / (1 + 2 a_v phi) = 1/2 with phi = 2 mu^2 / d'^3
            return (cube / (4.0 * (1.0 - a_v))).sqrt();
        }
        // 2 g^2 / d'^3 - g / d'^2 = 1/2, g = mu + eps ln 2: the positive root
        assert_eq!((delta, a_v), (1.0, 0.0));
        0.25 * (gap + (gap * gap + 4.0 * cube).sqrt()) - epsilon * LN_2
    };
    for name in ["left", "middle", "right"] {
        let (map, crossed) = crossings("fig03", name, Positive::Above, &zero);
        assert!(crossed.len() > 100, "{name}: {}", crossed.len());
        for (strength, gap) in crossed {
            let law = Algebraic { mu: strength, ..algebraic(&map) };
            let linear = law.linearise(gap);
            let value = criteria::algebraic(&law, gap);
            assert!(value.abs() < ROUNDING * (0.5 + linear.phi + linear.kappa), "{name}: {value:e} at {gap}");
        }
    }
}

#[test]
fn figures_5_and_6_change_sign_where_the_closed_form_says() {
    for (id, widening) in [("fig05", 0.0), ("fig06", 0.15)] {
        for (name, gap) in [("left", 2.5), ("middle", 1.5), ("right", 0.5)] {
            // a / b exp(-d' / b) = 1 / (2 (1 - a_v))
            let zero = |_: &Map, range: f64| range * math::exp(gap / range) / (2.0 * (1.0 - widening));
            let (map, crossed) = crossings(id, name, Positive::Above, &zero);
            assert_eq!(exponential(&map).a_v, widening);
            assert!(crossed.len() > 100, "{id} {name}: {}", crossed.len());
            for (strength, range) in crossed {
                let law = Exponential { a: strength, b: range, ..exponential(&map) };
                let value = criteria::exponential(&law, gap);
                assert!(value.abs() < ROUNDING * (1.0 + gap / range), "{id} {name}: {value:e} at b = {range}");
            }
        }
    }
}

/// `xi` and `beta` over `xi` in the limit `eps -> 0`, and `a_v`, of the flow with the critical distance `a' >= 2`: with
/// it all else is explicit, `v' = v_0' (1 - ln d_0)` and `a_v = (a' - 2) / (2 v')`.
fn flow(desired: f64, distance: f64) -> (f64, f64, f64) {
    let d0 = 1.0 + C * (1.0 - HEADWAY / distance);
    let speed = desired * (1.0 - math::ln(d0));
    let widening = (distance - 2.0) / (2.0 * speed);
    (C * desired / (distance * d0), widening * HEADWAY / distance, widening)
}

/// The `a_v` from which on the wave with this `1 + cos k` decays: `(xi - beta) (1 + cos k) = 1`. Both factors of
/// `xi (1 - beta / xi)` fall with `a'`. Zero where it always decays.
fn stabilising_widening(desired: f64, waves: f64) -> f64 {
    let margin = |distance: f64| {
        let (xi, share, _) = flow(desired, distance);
        xi * (1.0 - share) * waves - 1.0
    };
    if margin(2.0) <= 0.0 { 0.0 } else { flow(desired, falling_zero(2.0, 1e3, margin)).2 }
}

/// What the limit `eps -> 0` leaves out: `exp(-(1 - Delta y / a') / eps)` with `a' >= 2`, `eps = 0.01`, in a few terms.
const SHARP: f64 = 1e-10;

#[test]
fn figure_9_changes_sign_where_the_closed_form_says() {
    let left = |map: &Map, k: f64| stabilising_widening(logarithmic(map).v0, one_plus_cos(k));
    let (map, crossed) = crossings("fig09", "left", Positive::Below, &left);
    assert!(crossed.len() > 50, "{}", crossed.len());
    for (widening, k) in crossed {
        assert_imaginary(&about(&Logarithmic { a_v: widening, ..logarithmic(&map) }), k, SHARP, "left");
    }
    // c v_0' / (2 d_0) (1 + cos k) = 1
    let right = |_: &Map, k: f64| 2.0 * (1.0 + C * (1.0 - 0.5 * HEADWAY)) / (C * one_plus_cos(k));
    let (map, crossed) = crossings("fig09", "right", Positive::Above, &right);
    assert!(crossed.len() > 100, "{}", crossed.len());
    for (desired_speed, k) in crossed {
        assert_imaginary(&about(&Logarithmic { v0: desired_speed, ..logarithmic(&map) }), k, SHARP, "right");
    }
}

#[test]
fn figure_10_changes_sign_where_the_closed_form_says() {
    // xi = 1/2 (1 + 2 beta)
    let zero = |_: &Map, desired: f64| stabilising_widening(desired, 2.0);
    let (map, crossed) = crossings("fig10", "map", Positive::Below, &zero);
    assert!(crossed.len() > 100, "{}", crossed.len());
    for (widening, desired_speed) in crossed {
        let linear = about(&Logarithmic { a_v: widening, v0: desired_speed, ..logarithmic(&map) });
        let size = 1.0 + 2.0 * linear.phi + 2.0 * linear.beta;
        let margin = linear.long_wave_margin();
        assert!(margin.abs() < SHARP * size, "a_v = {widening}, v_0' = {desired_speed}: {margin:e}");
    }
    // and cell by cell
    let (map, table) = panel("fig10", "map");
    for row in table.rows() {
        let linear = about(&Logarithmic { a_v: row[0], v0: row[1], ..logarithmic(&map) });
        assert_eq!(row[2] > 0.0, linear.long_wave_margin() > 0.0, "{row:?}");
    }
}

/// The linearised law about the uniform flow of figures 9 and 10.
fn about(law: &Logarithmic) -> Linear {
    let speed = steady_speed(&Model::Logarithmic(*law), HEADWAY).expect("the force is finite");
    law.linearise(HEADWAY, speed)
}
