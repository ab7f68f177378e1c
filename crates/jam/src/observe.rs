//! Numbers that the figures draw.

/// The standard deviation over the pedestrians, divided by `N` (not `N - 1`): sums in order, mean first.
pub fn spread(values: &[f64]) -> f64 {
    let count = values.len() as f64;
    let mean = values.iter().sum::<f64>() / count;
    let squares: f64 = values.iter().map(|value| (value - mean) * (value - mean)).sum();
    (squares / count).sqrt()
}
