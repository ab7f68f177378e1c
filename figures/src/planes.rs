//! Pictures of planes of outcomes.

use crate::failure::Failure;
use plot::Picture;
use plot::style::COLUMN_WIDTH;
use scene::sweep::{Cell, Sweep};

/// The picture of one plane.
///
/// # Errors
/// The cells are not those of the plane.
pub fn picture(_sweep: Sweep, _cells: &[Cell]) -> Result<Picture, Failure> {
    Ok(Picture::new(COLUMN_WIDTH, 90.0))
}
