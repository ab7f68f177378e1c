//! Jams in a snapshot: how many, how long, and how fast they travel.

/// A jam: consecutive pedestrians that are all slower than a threshold.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Jam {
    /// The last one in it, counted from 0: the one that everybody of the jam walks behind has the highest number.
    pub first: usize,
    /// How many stand in it.
    pub pedestrians: usize,
    /// Distance from its last to its first pedestrian.
    pub extent: f64,
    /// The middle of that stretch, unwrapped like the positions.
    pub centre: f64,
}

/// Speeds that differ by less than this fraction of the desired speed are no jam.
const CONTRAST: f64 = 0.1;

/// The threshold that tells a jam from free flow in a snapshot: half way between the lowest and the highest speed.
/// `None` while they differ by less than a tenth of the desired speed.
pub fn threshold(speeds: &[f64], desired_speed: f64) -> Option<f64> {
    let low = speeds.iter().copied().fold(f64::INFINITY, |a, b| if b < a { b } else { a });
    let high = speeds.iter().copied().fold(f64::NEG_INFINITY, |a, b| if b > a { b } else { a });
    (high - low > CONTRAST * desired_speed).then_some(0.5 * (low + high))
}

/// The jams of a snapshot on a ring of the given length; positions unwrapped, growing with the number of the
/// pedestrian.
pub fn find(positions: &[f64], speeds: &[f64], length: f64, threshold: f64) -> Vec<Jam> {
    let count = speeds.len();
    let slow = |n: usize| speeds[n % count] < threshold;
    let position = |n: usize| positions[n % count] + if n >= count { length } else { 0.0 };
    let Some(free) = (0..count).find(|&n| !slow(n)) else { return Vec::new() };
    let mut jams = Vec::new();
    let mut n = free;
    while n < free + count {
        let first = n;
        while slow(n) {
            n += 1;
        }
        if n > first {
            let (back, front) = (position(first), position(n - 1));
            jams.push(Jam {
                first: first % count,
                pedestrians: n - first,
                extent: front - back,
                centre: 0.5 * (back + front),
            });
        }
        n += 1;
    }
    jams
}

/// The mean speed at which jams travel between two snapshots: each jam is compared with the nearest one of the earlier
/// snapshot, on a ring of the given length. `None` if one of them has no jam.
pub fn drift(earlier: &[Jam], later: &[Jam], length: f64, time: f64) -> Option<f64> {
    if earlier.is_empty() || later.is_empty() {
        return None;
    }
    let around = |distance: f64| distance - length * (distance / length).round();
    let nearest = |jam: &Jam| {
        let moves = earlier.iter().map(|before| around(jam.centre - before.centre));
        moves.fold(f64::INFINITY, |best, next| if next.abs() < best.abs() { next } else { best })
    };
    Some(later.iter().map(nearest).sum::<f64>() / (later.len() as f64 * time))
}
