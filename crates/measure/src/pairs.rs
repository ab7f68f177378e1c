//! Paired measurements: the ratio of the times of two programs, with a confidence interval.

/// The median of ratios with an interval that holds the true median at least 95 times of 100, whatever their
/// distribution is: only that the pairs are independent is taken for granted.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ratio {
    /// The median.
    pub median: f64,
    /// Lower end of the interval.
    pub low: f64,
    /// Upper end.
    pub high: f64,
}

/// The fewest pairs that give an interval: of five, the least and the largest hold the median between them only 15
/// times of 16.
pub const FEWEST: usize = 6;

/// The ratios `after / before` of pairs of seconds; `None` for fewer pairs than [`FEWEST`].
pub fn ratio(pairs: &[(f64, f64)]) -> Option<Ratio> {
    if pairs.len() < FEWEST {
        return None;
    }
    let mut ratios: Vec<f64> = pairs.iter().map(|(before, after)| after / before).collect();
    ratios.sort_by(f64::total_cmp);
    let outside = outside(ratios.len());
    Some(Ratio { median: middle(&ratios), low: ratios[outside], high: ratios[ratios.len() - 1 - outside] })
}

/// The median of numbers; NaN of none.
pub fn median(values: &[f64]) -> f64 {
    let mut sorted = values.to_vec();
    sorted.sort_by(f64::total_cmp);
    if sorted.is_empty() { f64::NAN } else { middle(&sorted) }
}

fn middle(sorted: &[f64]) -> f64 {
    let half = sorted.len() / 2;
    if sorted.len() % 2 == 1 { sorted[half] } else { 0.5 * (sorted[half - 1] + sorted[half]) }
}

/// How many numbers at each end of `count` sorted ones may be left out, so that the median lies between the others at
/// least 95 times of 100. It lies below the `k`-th when fewer than `k` of them are: a binomial sum.
fn outside(count: usize) -> usize {
    let (mut probability, mut sum, mut left_out) = (0.5_f64, 0.0, 0);
    for _ in 1..count {
        probability *= 0.5;
    }
    for k in 0..count / 2 {
        sum += probability;
        if sum > 0.025 {
            break;
        }
        left_out = k;
        probability *= (count - k) as f64 / (k + 1) as f64;
    }
    left_out
}
