//! Every tableau, error estimate and interpolant against every order condition up to its order.

use crate::trees::{Tree, dot, stage_weights, trees};
use ode::Method;
use ode::tableau::{Interpolant, Row, Tableau};

const METHODS: [Method; 4] = [Method::Euler, Method::Heun, Method::Rk4, Method::Dop853];

fn tableau(method: Method) -> &'static Tableau {
    method.tableau().expect("a Runge-Kutta method")
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
    /// multiplied with rounding, in sums of at most 16 terms: `18 order 2^-53` of the sum of sizes, and as much again
    /// for the weights, which are sums themselves.
    fn residual(&self, weights: &[f64], theta: f64, order: usize) -> f64 {
        let sizes: Vec<f64> = weights.iter().map(|weight| weight.abs()).collect();
        let mut worst = 0.0;
        for (index, tree) in self.trees.iter().enumerate().filter(|(_, tree)| tree.order == order) {
            let wanted = (0..order).fold(1.0, |power, _| power * theta) / tree.density;
            let rounding = 36.0 * order as f64 * 0.5 * f64::EPSILON * dot(&sizes, &self.sizes[index]);
            let ratio = (dot(weights, &self.of_stages[index]) - wanted).abs() / rounding;
            worst = if ratio > worst { ratio } else { worst };
        }
        worst
    }

    /// All conditions up to `order` hold, and one of the next order does not, so the order is not understated either.
    fn assert_order(&self, weights: &[f64], theta: f64, order: usize, what: &str) {
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
    for method in METHODS {
        let tableau = tableau(method);
        let weights = Weights::new(tableau, tableau.order + 1);
        weights.assert_order(&full(tableau.weights, tableau.stages()), 1.0, tableau.order, tableau.name);
    }
}

#[test]
fn stages_of_dop853_are_of_order_3() {
    // sum_j a_ij c_j^(k - 1) = c_i^k / k holds for k = 2 from the third stage on, for k = 3 from the fourth on: sharper for
    // a single coefficient than the conditions above, where it is one factor of many
    let rows = coefficients(tableau(Method::Dop853));
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
fn embedded_solutions_of_dop853_have_orders_5_and_3() {
    let tableau = tableau(Method::Dop853);
    let weights = Weights::new(tableau, 6);
    assert_eq!(tableau.errors.len(), 2);
    for (errors, order) in tableau.errors.iter().zip([5, 3]) {
        let solution = full(tableau.weights, tableau.stages());
        let errors = full(errors, tableau.stages());
        let embedded: Vec<f64> = solution.iter().zip(&errors).map(|(solution, error)| solution - error).collect();
        weights.assert_order(&embedded, 1.0, order, "embedded solution");
    }
}

#[test]
fn interpolants_have_their_orders() {
    for (method, order) in [(Method::Euler, 1), (Method::Heun, 2), (Method::Rk4, 3), (Method::Dop853, 7)] {
        let tableau = tableau(method);
        let weights = Weights::new(tableau, order + 1);
        for theta in [0.0625, 0.25, 0.4, 0.5, 0.7, 0.75, 0.9375] {
            weights.assert_order(&continuous_weights(tableau, theta), theta, order, tableau.name);
        }
    }
}

#[test]
fn interpolants_meet_the_step_at_its_ends() {
    for method in METHODS {
        let tableau = tableau(method);
        let start = continuous_weights(tableau, 0.0);
        assert!(start.iter().all(|&weight| weight == 0.0), "{}", tableau.name);
        let end = continuous_weights(tableau, 1.0);
        assert_eq!(end, full(tableau.weights, end.len()), "{}", tableau.name);
    }
}

/// The weights of all stages in the solution at the fraction `theta`, as the interpolant composes it.
fn continuous_weights(tableau: &Tableau, theta: f64) -> Vec<f64> {
    let stages = coefficients(tableau).len();
    let solution = full(tableau.weights, stages);
    let end = tableau.stages();
    let there = theta * (1.0 - theta);
    let mut weights: Vec<f64> = (0..stages)
        .map(|i| {
            let (before, after) = (f64::from(u8::from(i == 0)), f64::from(u8::from(i == end)));
            let bends = (1.0 - theta) * (before - solution[i]) + theta * (solution[i] - after);
            theta * solution[i] + there * bends
        })
        .collect();
    if let Interpolant::Nested { rows, .. } = tableau.interpolant {
        let factors = [1.0, theta, theta * (1.0 - theta), theta * theta * (1.0 - theta)];
        for (row, factor) in rows.iter().zip(factors) {
            for &(stage, weight) in *row {
                weights[stage] += there * there * factor * weight;
            }
        }
    }
    weights
}
