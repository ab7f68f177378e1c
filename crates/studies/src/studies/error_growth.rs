//! How far an initial error has grown by a given time, from reference runs in double-double arithmetic.

use super::Extent;
use crate::hard::Tables;
use crate::hard::rows::{Rows, row};
use figures::failure::Failure;
use reference::scenes::NAMES;
use std::path::Path;

/// For each scene and time: the growth of two small perturbations (that of the scene's own shift and a random one) and
/// the finite-time Lyapunov exponent of the larger, `ln(growth) / t`.
pub fn tables(_extent: Extent, solutions: &Path) -> Result<Tables, Failure> {
    let growth = Rows::read(&solutions.join("growth.csv"))?;
    let mut rows = Rows::new(&["scene", "t", "shift", "random", "exponent"]);
    for scene in NAMES {
        let of = |direction| growth.select(&[("scene", scene), ("direction", direction)], &["t", "growth"]);
        for (shift, random) in of("shift")?.rows().zip(of("random")?.rows()) {
            let exponent = math::ln(math::larger(shift[1], random[1])) / shift[0];
            rows.push(row![scene, shift[0], shift[1], random[1], exponent]);
        }
    }
    Ok(vec![("error_growth", rows)])
}
