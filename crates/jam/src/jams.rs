//! Jams in a snapshot: their number and lengths, and their speed from one snapshot to the next.

/// A jam: consecutive pedestrians that are all slower than a threshold.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Jam {
    /// The last of its pedestrians, counted from 0; the others have the next numbers.
    pub first: usize,
    /// How many are in it, 1 to `N - 1`.
    pub pedestrians: usize,
    /// Distance between its two ends, in units of `a_0`: where the speed, linear between neighbours, crosses the
    /// threshold.
    pub extent: f64,
    /// The middle between its ends, in units of `a_0`, unwrapped like the positions.
    pub centre: f64,
}

/// Speeds that differ by no more than this fraction of the desired speed are no jam.
const CONTRAST: f64 = 0.1;

/// The threshold between jam and free flow in a snapshot: half way between the lowest and the highest speed. `None`
/// while they differ by no more than a tenth of the desired speed. Speeds and threshold have one unit.
pub fn threshold(speeds: &[f64], desired_speed: f64) -> Option<f64> {
    let low = speeds.iter().copied().fold(f64::INFINITY, |a, b| if b < a { b } else { a });
    let high = speeds.iter().copied().fold(f64::NEG_INFINITY, |a, b| if b > a { b } else { a });
    (high - low > CONTRAST * desired_speed).then_some(0.5 * (low + high))
}

/// The jams of a snapshot on a ring of the given length; positions unwrapped, growing with the number of the
/// pedestrian, as many as speeds. Empty if all pedestrians are slower than the threshold, or none is.
pub fn find(positions: &[f64], speeds: &[f64], length: f64, threshold: f64) -> Vec<Jam> {
    let count = speeds.len();
    let speed = |n: usize| speeds[n % count];
    let slow = |n: usize| speed(n) < threshold;
    let position = |n: usize| positions[n % count] + length * (n / count) as f64;
    // where the speed crosses the threshold between n and n + 1
    let crossing = |n: usize| {
        let share = (threshold - speed(n)) / (speed(n + 1) - speed(n));
        position(n) + share * (position(n + 1) - position(n))
    };
    let Some(free) = (0..count).find(|&n| !slow(n)) else { return Vec::new() };
    let mut jams = Vec::new();
    let mut n = free;
    while n < free + count {
        let first = n;
        while slow(n) {
            n += 1;
        }
        if n > first {
            let (back, front) = (crossing(first - 1), crossing(n - 1));
            let (extent, centre) = (front - back, 0.5 * (back + front));
            jams.push(Jam { first: first % count, pedestrians: n - first, extent, centre });
        }
        n += 1;
    }
    jams
}

/// How far jams travel on the average, followed from snapshot to snapshot as long as their number stays the same.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Drift {
    /// The jams of the last snapshot.
    pub before: Vec<Jam>,
    /// How far they have travelled since their number changed, on the average, in units of `a_0`; negative backwards.
    pub distance: f64,
    /// The time this took, in units of `tau`.
    pub time: f64,
}

impl Drift {
    /// Takes the jams of the next snapshot, `interval` after the one before, on a ring of the given length. A jam that
    /// moves by half the ring or more in that time cannot be distinguished from one that moves the other way.
    pub fn follow(&mut self, jams: &[Jam], length: f64, interval: f64) {
        let around = |distance: f64| distance - length * (distance / length).round();
        if jams.len() != self.before.len() || jams.is_empty() {
            (self.distance, self.time) = (0.0, 0.0);
        } else {
            // each jam against the nearest one of the snapshot before
            let nearest = |jam: &Jam| {
                let moves = self.before.iter().map(|before| around(jam.centre - before.centre));
                moves.fold(f64::INFINITY, |best, next| if next.abs() < best.abs() { next } else { best })
            };
            self.distance += jams.iter().map(nearest).sum::<f64>() / jams.len() as f64;
            self.time += interval;
        }
        self.before = jams.to_vec();
    }

    /// The jams of the last snapshot.
    pub fn jams(&self) -> &[Jam] {
        &self.before
    }

    /// The mean speed of the jams on the ground, in units of `a_0 / tau`, negative when they travel backwards, and the
    /// time over which it was measured. `None` while there are no jams, or just after their number has changed.
    pub fn speed(&self) -> Option<(f64, f64)> {
        (self.time > 0.0).then(|| (self.distance / self.time, self.time))
    }

    /// The error of that speed on a ring of this headway, in units of `a_0`: the ends of a jam lie between pedestrians,
    /// so that where its way begins and ends is known to about a headway. `None` where there is no speed.
    pub fn speed_error(&self, headway: f64) -> Option<f64> {
        (self.time > 0.0).then(|| headway / self.time)
    }
}
