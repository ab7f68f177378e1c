//! An axis of a sweep.

use files::reader::{FINITE, Reader, SceneError, Section};

/// An axis: cells of equal width, or of equal ratio, with the values at their centres.
#[derive(Clone, Debug, PartialEq)]
pub struct Axis {
    /// The parameter it runs over: of the law, or one of the run.
    pub parameter: String,
    /// Its lower end.
    pub from: f64,
    /// Its upper end.
    pub to: f64,
    /// The number of cells.
    pub cells: usize,
    /// Whether the cells have equal ratios.
    pub is_log: bool,
}

/// Axes that are no parameters of a law: the shift of pedestrian 0; headway and effective gap of the uniform flow, with the
/// number of pedestrians kept; that number, with the headway kept.
pub const OF_THE_RUN: [&str; 4] = ["shift", "headway", "d_gap", "pedestrians"];

impl Axis {
    /// Reads an axis.
    ///
    /// # Errors
    /// What is missing, unknown or out of range.
    pub(super) fn read(file: &str, name: &'static str, section: &Section) -> Result<Axis, SceneError> {
        let mut reader = Reader::new(file, name, section);
        let axis = Axis {
            parameter: reader
                .text("parameter", "a parameter of the law, shift, headway, d_gap or pedestrians")?
                .to_owned(),
            from: reader.number("from", FINITE)?,
            to: reader.number("to", FINITE)?,
            cells: reader.count("cells", 1, 20_000)?,
            is_log: reader.has("scale") && reader.one_of("scale", &[("linear", false), ("log", true)])?,
        };
        if axis.to <= axis.from {
            return Err(reader.complaint("to", &format!("must be above from = {:?}", axis.from)));
        }
        if axis.is_log && axis.from <= 0.0 {
            return Err(reader.complaint("from", "must be a number > 0.0 where scale = \"log\""));
        }
        if axis.parameter == "pedestrians" && axis.from < 2.0 {
            return Err(reader.complaint("from", "must be a number >= 2.0"));
        }
        reader.finish()?;
        Ok(axis)
    }

    /// The value at the centre of cell `i`; a number of pedestrians is the nearest whole one.
    pub fn centre(&self, i: usize) -> f64 {
        self.at(i as f64 + 0.5)
    }

    /// The value at a place counted in cells from the lower end: cell `i` reaches from `i` to `i + 1`. A number of
    /// pedestrians is the nearest whole one.
    pub fn at(&self, place: f64) -> f64 {
        let share = place / self.cells as f64;
        let value = if self.is_log {
            let (low, high) = (math::ln(self.from), math::ln(self.to));
            math::exp(low + (high - low) * share)
        } else {
            self.from + (self.to - self.from) * share
        };
        if self.parameter == "pedestrians" { value.round() } else { value }
    }
}
