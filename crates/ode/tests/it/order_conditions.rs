//! Every tableau, error estimate and interpolant against every order condition up to its order.

use crate::trees::{Tree, dot, stage_weights, trees};
use ode::Method;
use ode::methods::DOP853;
use ode::tableau::{Interpolant, Row, Tableau};

/// All Runge-Kutta methods.
fn tableaux() -> impl Iterator<Item = &'static Tableau> {
    Method::ALL.into_iter().filter_map(Method::tableau)
}

/// The orders of the embedded solutions and of the interpolant.
fn inner_orders(tableau: &Tableau) -> (&'static [usize], usize) {
    match tableau.name {
        "euler" => (&[], 1),
        "heun" => (&[], 2),
        "rk4" => (&[], 3),
        "bs32" => (&[2], 3),
        "dopri54" | "tsit54" => (&[4], 4),
        "verner65" => (&[5], 5),
        "verner76" => (&[6], 6),
        "verner87" => (&[7], 7),
        "verner98" => (&[8], 8),
        "dop853" => (&[5, 3], 7),
        name => panic!("{name} is new"),
    }
}

/// A row with its zeros, `stages` long.
fn full(row: Row, stages: usize) -> Vec<f64> {
    let mut weights = vec![0.0; stages];
    for &(stage, weight) in row {
        weights[stage] += weight;
    }
    weights
}

/// The coefficients of all stages: those of the step, the rate at its end, those of the interpolant.
fn coefficients(tableau: &Tableau) -> Vec<Vec<f64>> {
    let further: &[Row] = match tableau.interpolant {
        Interpolant::Cubic => &[],
        Interpolant::Nested { stages, .. } => stages,
    };
    let stages = tableau.stages() + 1 + further.len();
    let first: Row = &[];
    let rows = std::iter::once(first).chain(tableau.rows.iter().copied());
    let rows = rows.chain(std::iter::once(tableau.weights)).chain(further.iter().copied());
    rows.map(|row| full(row, stages)).collect()
}

/// Weights that are sums, and the sums of the sizes of their terms, which bound the rounding.
struct Sum {
    values: Vec<f64>,
    sizes: Vec<f64>,
}

impl Sum {
    fn of(terms: &[&[f64]]) -> Sum {
        let add =
            |size: fn(f64) -> f64| (0..terms[0].len()).map(|i| terms.iter().map(|term| size(term[i])).sum()).collect();
        Sum { values: add(|term| term), sizes: add(f64::abs) }
    }
}

/// The trees up to an order with the weights of a method's stages, and the same with all coefficients positive.
struct Weights {
    trees: Vec<Tree>,
    of_stages: Vec<Vec<f64>>,
    sizes: Vec<Vec<f64>>,
}

impl Weights {
    fn new(tableau: &Tableau, order: usize) -> Weights {
        let trees = trees(order);
        let rows = coefficients(tableau);
        let positive: Vec<Vec<f64>> = rows.iter().map(|row| row.iter().map(|a| a.abs()).collect()).collect();
        let (of_stages, sizes) = (stage_weights(&trees, &rows), stage_weights(&trees, &positive));
        Weights { trees, of_stages, sizes }
    }

    /// The largest ratio of a condition's residual to its rounding, over the trees with `order` vertices.
    ///
    /// A term of the sum is a product of at most `order` coefficients, each rounded to half a unit (2^-53) and
    /// multiplied with rounding, in sums of a term a stage: `(stages + 2) order 2^-53` of the sum of sizes, and as much
    /// again for the weights, which are sums themselves.
    fn residual(&self, weights: &Sum, theta: f64, order: usize) -> f64 {
        let mut worst = 0.0;
        for (index, tree) in self.trees.iter().enumerate().filter(|(_, tree)| tree.order == order) {
            let wanted = (0..order).fold(1.0, |power, _| power * theta) / tree.density;
            let terms = 2.0 * (self.sizes[index].len() + 2) as f64 * order as f64;
            let rounding = terms * 0.5 * f64::EPSILON * dot(&weights.sizes, &self.sizes[index]);
            let ratio = (dot(&weights.values, &self.of_stages[index]) - wanted).abs() / rounding;
            worst = if ratio > worst { ratio } else { worst };
        }
        worst
    }

    /// All conditions up to `order` hold, and one of the next order does not, so the order is not understated either.
    fn assert_order(&self, weights: &Sum, theta: f64, order: usize, what: &str) {
        for p in 1..=order {
            let residual = self.residual(weights, theta, p);
            assert!(residual < 1.0, "{what}, theta = {theta}: order {p} is missed by {residual:e} times the rounding");
        }
        let beyond = self.residual(weights, theta, order + 1);
        assert!(beyond > 1e3, "{what}, theta = {theta}: order {} holds as well", order + 1);
    }
}

#[test]
fn solutions_have_their_orders() {
    for tableau in tableaux() {
        let weights = Weights::new(tableau, tableau.order + 1);
        weights.assert_order(&Sum::of(&[&full(tableau.weights, tableau.stages())]), 1.0, tableau.order, tableau.name);
    }
}

#[test]
fn stages_of_dop853_are_of_order_3() {
    // sum_j a_ij c_j^(k - 1) = c_i^k / k holds for k = 2 from the third stage on, for k = 3 from the fourth on: sharper
    // for a single coefficient than the conditions above, where it is one factor of many
    let rows = coefficients(&DOP853);
    let nodes: Vec<f64> = rows.iter().map(|row| row.iter().sum()).collect();
    for (k, from) in [(2, 2), (3, 3)] {
        let powers: Vec<f64> = nodes.iter().map(|&c| if k == 2 { c } else { c * c }).collect();
        for (i, row) in rows.iter().enumerate().skip(from) {
            let wanted = powers[i] * nodes[i] / f64::from(k);
            let size: f64 = row.iter().zip(&powers).map(|(a, power)| (a * power).abs()).sum::<f64>()
                + row.iter().map(|a| a.abs()).sum::<f64>();
            // each coefficient and product to half a unit, in sums of at most 16 terms, nodes included
            let residual = (dot(row, &powers) - wanted).abs() / (16.0 * 0.5 * f64::EPSILON * size);
            assert!(residual < 1.0, "stage {i}, k = {k}: {residual} times the rounding");
        }
    }
}

#[test]
fn embedded_solutions_have_their_orders() {
    for tableau in tableaux() {
        let (orders, _) = inner_orders(tableau);
        assert_eq!(tableau.errors.len(), orders.len(), "{}", tableau.name);
        let weights = Weights::new(tableau, tableau.order);
        let stages = tableau.stages() + 1;
        for (errors, &order) in tableau.errors.iter().zip(orders) {
            let (solution, errors) = (full(tableau.weights, stages), full(errors, stages));
            let negative: Vec<f64> = errors.iter().map(|error| -error).collect();
            weights.assert_order(&Sum::of(&[&solution, &negative]), 1.0, order, &format!("{}: embedded", tableau.name));
        }
    }
}

#[test]
fn estimates_fall_with_the_power_that_controls_the_steps() {
    // the step control takes the order for the power of the step in the estimate's local error, that of an embedded
    // solution one order lower
    for tableau in tableaux().filter(|tableau| tableau.name != "dop853") {
        assert!(inner_orders(tableau).0.iter().all(|order| order + 1 == tableau.order), "{}", tableau.name);
    }
}

#[test]
fn interpolants_have_their_orders() {
    for tableau in tableaux() {
        let (_, order) = inner_orders(tableau);
        let weights = Weights::new(tableau, order + 1);
        for theta in [0.0625, 0.25, 0.4, 0.5, 0.7, 0.75, 0.9375] {
            weights.assert_order(&continuous_weights(tableau, theta), theta, order, tableau.name);
        }
    }
}

#[test]
fn interpolants_meet_the_step_at_its_ends() {
    for tableau in tableaux() {
        let start = continuous_weights(tableau, 0.0);
        assert!(start.values.iter().all(|&weight| weight == 0.0), "{}", tableau.name);
        let end = continuous_weights(tableau, 1.0).values;
        assert_eq!(end, full(tableau.weights, end.len()), "{}", tableau.name);
    }
}

/// The weights of all stages in the solution at the fraction `theta`, as the interpolant composes it.
fn continuous_weights(tableau: &Tableau, theta: f64) -> Sum {
    let stages = coefficients(tableau).len();
    let solution = full(tableau.weights, stages);
    let end = tableau.stages();
    let there = theta * (1.0 - theta);
    let chord: Vec<f64> = (0..stages)
        .map(|i| {
            let (before, after) = (f64::from(u8::from(i == 0)), f64::from(u8::from(i == end)));
            let bends = (1.0 - theta) * (before - solution[i]) + theta * (solution[i] - after);
            theta * solution[i] + there * bends
        })
        .collect();
    let mut terms = vec![chord];
    if let Interpolant::Nested { rows, .. } = tableau.interpolant {
        let mut factor = there * there;
        for (r, row) in rows.iter().enumerate() {
            terms.push(full(row, stages).iter().map(|weight| factor * weight).collect());
            factor *= if r % 2 == 0 { theta } else { 1.0 - theta };
        }
    }
    Sum::of(&terms.iter().map(Vec::as_slice).collect::<Vec<_>>())
}
