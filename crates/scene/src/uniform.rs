//! Linear stability of a scene's uniform flow: stable or not, and which waves grow.

use crate::run::Scene;
use jam::stability::Waves;

/// The uniform flow of a scene, and small waves on it.
#[derive(Clone, Debug, PartialEq)]
pub struct Stability {
    /// Its speed.
    pub speed: f64,
    /// The largest margin over all waves (see [`jam::stability::Response::margin`]): negative where all decay.
    pub margin: f64,
    /// The same over the waves of the ring.
    pub margin_on_ring: f64,
    /// The bands of wave numbers that grow, in ascending order, each from its least to its largest; 0 is the limit of
    /// long waves.
    pub growing: Vec<(f64, f64)>,
    /// The growth rate of the fastest wave of the ring.
    pub growth_rate: f64,
    /// How often this wave goes into the ring.
    pub waves: usize,
}

/// The stability of the uniform flow; `None` where there is none, or where its response has no derivative (a kink).
pub fn stability(scene: &Scene) -> Option<Stability> {
    let (headway, count) = (scene.ring.headway(), scene.ring.pedestrians);
    let speed = scene.steady_speed?;
    let response = scene.model.response(headway, speed)?;
    let (growth_rate, waves) = response.fastest(count);
    Some(Stability {
        speed,
        margin: response.margin(Waves::All).0,
        margin_on_ring: response.margin(Waves::Ring(count)).0,
        growing: response.growing_bands(),
        growth_rate,
        waves,
    })
}
