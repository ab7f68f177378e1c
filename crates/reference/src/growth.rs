//! Growth of a small perturbation of the initial state.

use crate::run::{Precision, Run, Stuck};
use crate::scenes::{LENGTH, Scene};
use crate::table::distances;
use math::larger;

/// Which perturbation: its largest component is 1.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Direction {
    /// Pedestrian 0 moved forward: the direction of the scene's own shift.
    Shift,
    /// All pedestrians moved and all speeds changed at random.
    Random,
}

/// The size of the perturbation: so small that the growth is linear, so large that it keeps four digits.
const SIZE: f64 = 1e-18;

/// For each time of the scene and each direction: the largest component of the perturbation, over that at the start.
///
/// # Errors
/// [`Stuck`].
pub fn growth(
    scene: &Scene,
    precision: Precision,
    directions: &[Direction],
) -> Result<Vec<(u32, Direction, f64)>, Stuck> {
    let ring = scene.ring;
    let start = ring.start(LENGTH, scene.shift);
    let mut perturbed: Vec<(Direction, Run)> = directions
        .iter()
        .map(|&direction| {
            let changes = direction.components(ring.pedestrians);
            let largest = changes.iter().fold(0.0_f64, |largest, value| larger(largest, value.abs()));
            let moved = start.iter().zip(&changes).map(|(state, change)| *state + change / largest * SIZE).collect();
            (direction, Run::from_state(ring, moved, precision))
        })
        .collect();
    let mut plain = Run::from_state(ring, start.clone(), precision);
    let mut rows = Vec::new();
    for &time in scene.times {
        plain.advance_to(f64::from(time))?;
        for (direction, run) in &mut perturbed {
            run.advance_to(f64::from(time))?;
            let (gaps, speeds) = distances(&ring, &plain.state, &run.state);
            rows.push((time, *direction, larger(gaps, speeds) / SIZE));
        }
    }
    Ok(rows)
}

impl Direction {
    /// As `growth.csv` names it.
    pub fn name(self) -> &'static str {
        match self {
            Direction::Shift => "shift",
            Direction::Random => "random",
        }
    }

    /// Changes of clearances, of speeds and of `x_0`; those of clearances sum to 0.
    fn components(self, pedestrians: usize) -> Vec<f64> {
        let n = pedestrians;
        let mut random = Random(1);
        let positions: Vec<f64> = (0..n)
            .map(|i| match self {
                Direction::Shift => f64::from(u8::from(i == 0)),
                Direction::Random => random.signed(),
            })
            .collect();
        let mut components: Vec<f64> = (0..n).map(|i| positions[(i + 1) % n] - positions[i]).collect();
        components.extend((0..n).map(|_| if self == Direction::Random { random.signed() } else { 0.0 }));
        components.push(positions[0]);
        components
    }
}

/// The generator splitmix64 (Steele, Lea, Flood 2014).
struct Random(u64);

impl Random {
    /// A number between -1 and 1.
    fn signed(&mut self) -> f64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let z = (self.0 ^ (self.0 >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        let z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        ((z ^ (z >> 31)) >> 11) as f64 / (1u64 << 52) as f64 - 1.0
    }
}
