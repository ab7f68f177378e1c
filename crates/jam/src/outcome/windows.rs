//! Statistics of a run over blocks of time, and over windows composed of blocks.

use super::least::lowest;

/// What happened in a stretch of time.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Stretch {
    /// How long it is.
    pub(super) duration: f64,
    /// The least contrast of speeds at a step's end.
    pub(super) contrast: f64,
    /// The least effective gap.
    pub(super) least_gap: f64,
    /// The least speed.
    pub(super) least_speed: f64,
    /// Integral of the standard deviation of the speeds.
    std: f64,
    /// Integral of the mean speed.
    speed: f64,
    /// Integrals of `-dv_n/dt` times the slope of `v` along the ring, and of the square of that slope.
    drift: (f64, f64),
}

impl Stretch {
    pub(super) const EMPTY: Stretch = Stretch {
        duration: 0.0,
        contrast: f64::INFINITY,
        least_gap: f64::INFINITY,
        least_speed: f64::INFINITY,
        std: 0.0,
        speed: 0.0,
        drift: (0.0, 0.0),
    };

    /// For checkpoints.
    pub(super) fn to_numbers(&self) -> [f64; 8] {
        let (product, square) = self.drift;
        [self.duration, self.contrast, self.least_gap, self.least_speed, self.std, self.speed, product, square]
    }

    /// What [`Stretch::to_numbers`] gave.
    pub(super) fn parse(numbers: &[f64]) -> Option<Stretch> {
        let [duration, contrast, least_gap, least_speed, std, speed, product, square] = *numbers else { return None };
        Some(Stretch { duration, contrast, least_gap, least_speed, std, speed, drift: (product, square) })
    }

    /// Adds what holds over a time `h`.
    pub(super) fn add(&mut self, h: f64, std: f64, speed: f64, drift: (f64, f64)) {
        self.duration += h;
        self.std += h * std;
        self.speed += h * speed;
        self.drift.0 += h * drift.0;
        self.drift.1 += h * drift.1;
    }

    /// Adds the next stretch.
    fn join(&mut self, next: &Stretch) {
        self.duration += next.duration;
        self.contrast = lowest(&[self.contrast, next.contrast]);
        self.least_gap = lowest(&[self.least_gap, next.least_gap]);
        self.least_speed = lowest(&[self.least_speed, next.least_speed]);
        self.std += next.std;
        self.speed += next.speed;
        self.drift = (self.drift.0 + next.drift.0, self.drift.1 + next.drift.1);
    }

    /// The mean standard deviation of the speeds.
    pub(super) fn mean_std(&self) -> f64 {
        self.std / self.duration
    }

    /// The mean speed of all.
    pub(super) fn mean_speed(&self) -> f64 {
        self.speed / self.duration
    }

    /// How many pedestrians a pattern of speeds passes in a unit of time, negative towards those behind: of a pattern
    /// `V(n - c t)` the `c` that fits best.
    pub(super) fn label_speed(&self) -> f64 {
        self.drift.0 / self.drift.1
    }
}

/// The sums for [`Stretch::label_speed`] at one instant: slopes along the ring by differences of fourth order.
pub(super) fn drift(speeds: &[f64], accelerations: &[f64]) -> (f64, f64) {
    let count = speeds.len();
    let (mut product, mut square) = (0.0, 0.0);
    for (n, acceleration) in accelerations.iter().enumerate() {
        let slope = match speeds.get(n.wrapping_sub(2)..n + 3) {
            Some([behind, close_behind, _, ahead, far_ahead]) => {
                (8.0 * (ahead - close_behind) - (far_ahead - behind)) / 12.0
            }
            _ => {
                // the neighbours around the ring
                let at = |n: usize| speeds[n % count];
                let (near, far) = (at(n + 1) - at(n + count - 1), at(n + 2) - at(n + 2 * count - 2));
                (8.0 * near - far) / 12.0
            }
        };
        product -= acceleration * slope;
        square += slope * slope;
    }
    (product, square)
}

/// The last stretch of at least this duration, skipping as much as `skip` before the end; `None` if the run was
/// shorter.
pub(super) fn last(blocks: &[Stretch], skip: f64, duration: f64) -> Option<(Stretch, f64)> {
    let mut skipped = 0.0;
    let mut rest = blocks.iter().rev();
    while skipped < skip {
        skipped += rest.next()?.duration;
    }
    let mut window = Stretch::EMPTY;
    while window.duration < duration {
        window.join(rest.next()?);
    }
    let until = skipped + window.duration;
    Some((window, until))
}

#[cfg(test)]
mod tests {
    use super::{Stretch, drift, last};

    #[test]
    fn a_travelling_pattern_passes_pedestrians_at_its_speed() {
        // v_n = cos(k (n - c t)) at t = 0, with dv/dt = k c sin(k n)
        let (count, c) = (200, -0.7);
        let k = 3.0 * std::f64::consts::TAU / count as f64;
        let speeds: Vec<f64> = (0..count).map(|n| math::cos(k * n as f64)).collect();
        let accelerations: Vec<f64> = (0..count).map(|n| k * c * math::sin(k * n as f64)).collect();
        let mut stretch = Stretch::EMPTY;
        stretch.add(2.0, 0.5, 1.0, drift(&speeds, &accelerations));
        // a difference of fourth order is off by k^4 / 30
        assert!((stretch.label_speed() - c).abs() < 1e-5, "{}", stretch.label_speed());
    }

    #[test]
    fn windows_are_the_last_blocks() {
        let block = |std: f64| {
            let mut block = Stretch::EMPTY;
            block.add(50.0, std, 0.0, (0.0, 1.0));
            block
        };
        let blocks: Vec<Stretch> = (0..10).map(|i| block(f64::from(i))).collect();
        let (window, until) = last(&blocks, 0.0, 120.0).expect("long enough");
        assert_eq!((window.duration, window.mean_std(), until), (150.0, 8.0, 150.0));
        let (earlier, _) = last(&blocks, until, 120.0).expect("long enough");
        assert_eq!(earlier.mean_std(), 5.0);
        assert!(last(&blocks, 400.0, 120.0).is_none());
    }
}
