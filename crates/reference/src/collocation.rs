//! Gauss's collocation methods, in any kind of number, with any number of nodes.
//!
//! Within a step the rates are the polynomial that agrees with the equations at the nodes, found by iteration; so
//! nothing is tabulated, and the solution is known everywhere in the step (Hairer, Norsett & Wanner, *Solving ODEs I*,
//! II.7). The residual of the polynomial at both ends, which are not nodes, estimates its error.

use crate::number::Real;

/// The nodes of a method and what follows from them.
#[derive(Clone, Debug)]
pub struct Collocation<T> {
    /// Fractions of the step.
    nodes: Vec<T>,
    /// Row by row: the integral up to a node, as weights of the rates at all nodes.
    integral: Vec<T>,
    /// Row by row, for each Legendre polynomial: its coefficient in the rates, as weights of those at all nodes.
    transform: Vec<T>,
}

impl<T: Real> Collocation<T> {
    /// The method with this many nodes.
    pub fn new(count: usize) -> Collocation<T> {
        let one = T::from(1.0);
        let roots: Vec<T> = (0..count).map(|i| root(count, i)).collect();
        let nodes = roots.iter().map(|x| (*x + one) / T::from(2.0)).collect();
        let transform: Vec<T> = (0..count)
            .flat_map(|k| roots.iter().map(move |x| (k, *x)))
            .map(|(k, x)| {
                let slope = derivative(count, x);
                let weight = one / ((one - x * x) * slope * slope);
                T::from((2 * k + 1) as f64) * weight * legendre(count, x)[k]
            })
            .collect();
        let mut integral = Vec::new();
        for x in &roots {
            let integrals = integrals(count, *x);
            for j in 0..count {
                let terms = (0..count).map(|k| integrals[k] * transform[k * count + j]);
                integral.push(terms.fold(T::from(0.0), |sum, term| sum + term));
            }
        }
        Collocation { nodes, integral, transform }
    }

    /// How many nodes.
    pub fn count(&self) -> usize {
        self.nodes.len()
    }

    /// Where node `i` lies in the step, 0 to 1.
    pub fn node(&self, i: usize) -> f64 {
        self.nodes[i].value()
    }

    /// Writes what the state at node `i` differs by from that at the start of a step of length `h`, from the rates at
    /// all nodes.
    pub fn change_at_node(&self, i: usize, h: T, rates: &[Vec<T>], change: &mut [T]) {
        combine(h, &self.integral[i * self.count()..][..self.count()], rates, change);
    }

    /// The Legendre coefficients of the rates.
    pub fn coefficients(&self, rates: &[Vec<T>], coefficients: &mut [Vec<T>]) {
        for (row, coefficient) in self.transform.chunks(self.count()).zip(coefficients) {
            combine(T::from(1.0), row, rates, coefficient);
        }
    }
}

/// The weights of Legendre coefficients in the integral of the rates from the start to the fraction `theta` of a step.
pub fn weights_at<T: Real>(count: usize, theta: T) -> Vec<T> {
    integrals(count, theta * T::from(2.0) - T::from(1.0))
}

/// The weights of Legendre coefficients in the rates at the fraction `theta` of a step, which may lie beyond its end.
pub fn rates_at<T: Real>(count: usize, theta: T) -> Vec<T> {
    legendre(count, theta * T::from(2.0) - T::from(1.0))
}

/// Writes the sum of the rows, weighted, times `factor`.
pub fn combine<T: Real>(factor: T, weights: &[T], rows: &[Vec<T>], sums: &mut [T]) {
    sums.fill(T::from(0.0));
    for (weight, row) in weights.iter().zip(rows) {
        let weight = factor * *weight;
        for (sum, value) in sums.iter_mut().zip(row) {
            *sum = *sum + weight * *value;
        }
    }
}

/// `P_0(x) .. P_count(x)`.
fn legendre<T: Real>(count: usize, x: T) -> Vec<T> {
    let mut values = vec![T::from(1.0), x];
    for k in 1..count {
        let (twice, less) = (T::from((2 * k + 1) as f64), T::from(k as f64));
        values.push((twice * x * values[k] - less * values[k - 1]) / T::from((k + 1) as f64));
    }
    values
}

/// The integrals of `P_0 .. P_{count - 1}` over the step, from -1 to `x` in the variable of which a unit is half the
/// step.
fn integrals<T: Real>(count: usize, x: T) -> Vec<T> {
    let values = legendre(count, x);
    let half = T::from(0.5);
    (0..count)
        .map(|k| match k {
            0 => (x + T::from(1.0)) * half,
            _ => half * (values[k + 1] - values[k - 1]) / T::from((2 * k + 1) as f64),
        })
        .collect()
}

/// The derivative of `P_count`, within (-1, 1).
fn derivative<T: Real>(count: usize, x: T) -> T {
    let values = legendre(count, x);
    T::from(count as f64) * (values[count - 1] - x * values[count]) / (T::from(1.0) - x * x)
}

/// Root `i` of `P_count`, ascending, by Newton's method from the usual guess.
// the guess may have any last bits
#[allow(clippy::disallowed_methods)]
fn root<T: Real>(count: usize, i: usize) -> T {
    let guess = -(std::f64::consts::PI * (i as f64 + 0.75) / (count as f64 + 0.5)).cos();
    let mut x = T::from(guess);
    for _ in 0..8 {
        x = x - legendre(count, x)[count] / derivative(count, x);
    }
    x
}
