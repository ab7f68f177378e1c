//! Places the name of a map region: at the widest spot among the cells of one sign.

use crate::geometry::Point;

/// The middle, counted in cells from the lower left corner, of the place for a name of `width` x `height` cells that is
/// farthest from all other cells and from the edges of the map; `None` where the name does not fit. `margin` is the
/// size in cells, across and up, of the steps in which distances are tried. `values[row * columns + column]`; cells
/// without a value belong to neither sign.
pub(crate) fn widest_spot(
    (columns, rows): (usize, usize),
    values: &[f64],
    positive: bool,
    (width, height): (f64, f64),
    margin: (f64, f64),
) -> Option<Point> {
    let belongs = |value: f64| if positive { value > 0.0 } else { value < 0.0 };
    let sums = Sums::new(columns, rows, |column, row| !belongs(values[row * columns + column]));
    let (mut steps, mut best) = (0, None);
    for row in 0..rows {
        for column in 0..columns {
            let middle = (column as f64 + 0.5, row as f64 + 0.5);
            let fits = |steps: u32| {
                let around = f64::from(steps);
                sums.is_free(middle, (width / 2.0 + around * margin.0, height / 2.0 + around * margin.1))
            };
            // a place no better than the best so far needs one look
            while fits(steps) {
                (steps, best) = (steps + 1, Some(middle));
            }
        }
    }
    best
}

/// Numbers of foreign cells below and left of each corner of the grid.
struct Sums {
    columns: usize,
    rows: usize,
    below: Vec<u32>,
}

impl Sums {
    fn new(columns: usize, rows: usize, is_foreign: impl Fn(usize, usize) -> bool) -> Self {
        let stride = columns + 1;
        let mut below = vec![0; stride * (rows + 1)];
        for row in 0..rows {
            for column in 0..columns {
                let here = (row + 1) * stride + column + 1;
                below[here] = below[here - 1] + below[here - stride] - below[here - stride - 1]
                    + u32::from(is_foreign(column, row));
            }
        }
        Self { columns, rows, below }
    }

    /// Whether the box with this middle and these half sides lies inside the map and holds no foreign cell.
    fn is_free(&self, (x, y): Point, (half_width, half_height): Point) -> bool {
        let (left, right) = (x - half_width, x + half_width);
        let (bottom, top) = (y - half_height, y + half_height);
        if left < 0.0 || bottom < 0.0 || right > self.columns as f64 || top > self.rows as f64 {
            return false;
        }
        let corner = |column: f64, row: f64| self.below[row as usize * (self.columns + 1) + column as usize];
        let (left, right, bottom, top) = (left.floor(), right.ceil(), bottom.floor(), top.ceil());
        corner(right, top) + corner(left, bottom) == corner(left, top) + corner(right, bottom)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn values(value: impl Fn(usize, usize) -> f64) -> Vec<f64> {
        let value = &value;
        (0..20).flat_map(|row| (0..30).map(move |column| value(column, row))).collect()
    }

    #[test]
    fn the_spot_lies_in_the_middle_of_its_region() {
        let split = values(|column, _| if column < 10 { -1.0 } else { 1.0 });
        let spot = |positive| widest_spot((30, 20), &split, positive, (4.0, 2.0), (0.5, 0.5));
        let (Some(negative), Some(positive)) = (spot(false), spot(true)) else { panic!("both regions have room") };
        assert!((negative.0 - 5.0).abs() <= 1.0, "{negative:?}");
        assert!((positive.0 - 20.0).abs() <= 1.5 && (positive.1 - 10.0).abs() <= 2.0, "{positive:?}");
    }

    #[test]
    fn a_region_without_room_has_no_name() {
        let sliver = values(|column, _| if column < 3 { -1.0 } else { 1.0 });
        assert_eq!(widest_spot((30, 20), &sliver, false, (4.0, 2.0), (0.5, 0.5)), None);
        assert_eq!(widest_spot((30, 20), &values(|_, _| f64::NAN), true, (4.0, 2.0), (0.5, 0.5)), None);
    }
}
