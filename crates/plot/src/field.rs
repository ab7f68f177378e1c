//! The speed field between trajectories: at each time, linear in space from one pedestrian to the next.

use crate::space_time::Trajectory;

/// Speeds along the ring at one time, ready to be asked for.
pub(crate) struct Snapshot {
    length: f64,
    /// (position on the ring, speed), rising in position.
    samples: Vec<(f64, f64)>,
}

impl Snapshot {
    /// Positions and speeds of all trajectories that have begun and not ended at `time`.
    pub fn new(trajectories: &[Trajectory], length: f64, time: f64) -> Self {
        let at_time = |walk: &Trajectory| {
            let next = walk.partition_point(|sample| sample[0] <= time).clamp(1, walk.len().max(2) - 1);
            let (start, end) = (walk.get(next - 1)?, walk.get(next)?);
            if !(start[0]..=end[0]).contains(&time) {
                return None;
            }
            let share = (time - start[0]) / (end[0] - start[0]);
            let [position, speed] = [1, 2].map(|of| start[of] + share * (end[of] - start[of]));
            Some((position - (position / length).floor() * length, speed))
        };
        let mut samples: Vec<(f64, f64)> = trajectories.iter().filter_map(at_time).collect();
        samples.sort_by(|a, b| a.0.total_cmp(&b.0));
        Self { length, samples }
    }

    /// The speed at a place from 0 to the ring's length; NaN if there is no trajectory.
    pub fn speed(&self, place: f64) -> f64 {
        let (Some(first), Some(last)) = (self.samples.first(), self.samples.last()) else {
            return f64::NAN;
        };
        let next = self.samples.partition_point(|sample| sample.0 <= place);
        let behind = if next == 0 { (last.0 - self.length, last.1) } else { self.samples[next - 1] };
        let ahead = self.samples.get(next).copied().unwrap_or((first.0 + self.length, first.1));
        let gap = ahead.0 - behind.0;
        if gap > 0.0 { behind.1 + (place - behind.0) / gap * (ahead.1 - behind.1) } else { behind.1 }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn speed_is_linear_between_neighbours_and_across_the_seam() {
        let walk = |start: f64, speed: f64| vec![[0.0, start, speed], [1.0, start + 10.0, speed]];
        let now = Snapshot::new(&[walk(2.0, 1.0), walk(8.0, 3.0)], 10.0, 1.0);
        assert_eq!(now.speed(2.0), 1.0);
        assert_eq!(now.speed(5.0), 2.0);
        assert_eq!((now.speed(0.0), now.speed(10.0)), (2.0, 2.0));
        assert!(Snapshot::new(&[walk(2.0, 1.0)], 10.0, 2.0).speed(0.0).is_nan());
    }
}
