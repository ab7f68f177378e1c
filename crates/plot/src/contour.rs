//! Contour lines of a matrix by marching squares, joined into long polylines.

use crate::geometry::Point;
use std::collections::BTreeMap;

/// An edge of the grid between neighbouring cell centres: its lower or left end, and whether it runs upwards.
type Edge = (usize, usize, bool);

/// Lines where the bilinear surface through the cells' values crosses zero.
///
/// `values[row * columns + column]`; points are (column, row) with the first cell's centre at (0.5, 0.5), so that cells
/// are unit squares. The outermost half cells take the value of their cell, so that lines reach the border. Squares
/// with a NaN corner are left out.
pub(crate) fn zero_lines(columns: usize, rows: usize, values: &[f64]) -> Vec<Vec<Point>> {
    let padded = Padded { columns, rows, values };
    let mut segments: Vec<[Edge; 2]> = Vec::new();
    for row in 0..=rows {
        for column in 0..=columns {
            padded.square(column, row, &mut segments);
        }
    }
    let chains = join(&segments);
    chains.iter().map(|chain| chain.iter().map(|edge| padded.crossing(*edge)).collect()).collect()
}

/// The matrix with a rim of repeated values; node (i, j) stands for cell (i - 1, j - 1).
struct Padded<'a> {
    columns: usize,
    rows: usize,
    values: &'a [f64],
}

impl Padded<'_> {
    fn value(&self, column: usize, row: usize) -> f64 {
        let column = column.saturating_sub(1).min(self.columns - 1);
        let row = row.saturating_sub(1).min(self.rows - 1);
        self.values[row * self.columns + column]
    }

    /// Adds the segments of the square whose lower left node is given.
    fn square(&self, column: usize, row: usize, segments: &mut Vec<[Edge; 2]>) {
        let nodes = [(column, row), (column + 1, row), (column + 1, row + 1), (column, row + 1)];
        let values = nodes.map(|(i, j)| self.value(i, j));
        if values.iter().any(|value| value.is_nan()) {
            return;
        }
        let above = values.map(|value| value >= 0.0);
        let sides: [Edge; 4] =
            [(column, row, false), (column + 1, row, true), (column, row + 1, false), (column, row, true)];
        let crossed: Vec<Edge> =
            (0..4).filter(|&side| above[side] != above[(side + 1) % 4]).map(|side| sides[side]).collect();
        match *crossed.as_slice() {
            [a, b] => segments.push([a, b]),
            [bottom, right, top, left] => {
                // A saddle: the mean in the middle decides which corners hang together.
                let middle = values.iter().sum::<f64>() >= 0.0;
                if middle == above[0] {
                    segments.extend([[bottom, right], [top, left]]);
                } else {
                    segments.extend([[left, bottom], [right, top]]);
                }
            }
            _ => {}
        }
    }

    /// Where the surface crosses zero on an edge.
    fn crossing(&self, (column, row, upwards): Edge) -> Point {
        let (next_column, next_row) = if upwards { (column, row + 1) } else { (column + 1, row) };
        let (start, end) = (self.value(column, row), self.value(next_column, next_row));
        let share = start / (start - end);
        // beside an infinite value it lies in the middle
        let share = if share.is_finite() && start.is_finite() && end.is_finite() { share } else { 0.5 };
        let (x, y) = self.position(column, row);
        let (next_x, next_y) = self.position(next_column, next_row);
        (x + share * (next_x - x), y + share * (next_y - y))
    }

    /// A node's place; nodes of the rim lie on the border.
    fn position(&self, column: usize, row: usize) -> Point {
        let place = |node: usize, count: usize| (node as f64 - 0.5).clamp(0.0, count as f64);
        (place(column, self.columns), place(row, self.rows))
    }
}

/// Joins segments that share an edge into chains; a ring ends at the edge where it starts.
fn join(segments: &[[Edge; 2]]) -> Vec<Vec<Edge>> {
    let mut at: BTreeMap<Edge, Vec<usize>> = BTreeMap::new();
    for (index, segment) in segments.iter().enumerate() {
        for edge in segment {
            at.entry(*edge).or_default().push(index);
        }
    }
    let mut used = vec![false; segments.len()];
    // Open chains first, from their ends; what remains are rings.
    let ends = at.iter().filter(|(_, list)| list.len() == 1).map(|(edge, _)| *edge);
    let mut chains: Vec<Vec<Edge>> = ends.chain(at.keys().copied()).map(|start| vec![start]).collect();
    for chain in &mut chains {
        let mut edge = chain[0];
        while let Some(&index) = at[&edge].iter().find(|&&index| !used[index]) {
            used[index] = true;
            let [a, b] = segments[index];
            edge = if a == edge { b } else { a };
            chain.push(edge);
        }
    }
    chains.retain(|chain| chain.len() > 1);
    chains
}

#[cfg(test)]
mod tests {
    use super::*;

    fn matrix(columns: usize, rows: usize, value: impl Fn(f64, f64) -> f64) -> Vec<f64> {
        let cells = (0..rows).flat_map(|row| (0..columns).map(move |column| (column, row)));
        cells.map(|(column, row)| value(column as f64 + 0.5, row as f64 + 0.5)).collect()
    }

    fn square(x: f64) -> f64 {
        x * x
    }

    #[test]
    fn a_plane_gives_one_straight_line_from_border_to_border() {
        let lines = zero_lines(20, 10, &matrix(20, 10, |x, _| x - 7.3));
        assert_eq!(lines.len(), 1);
        assert!(lines[0].iter().all(|point| (point.0 - 7.3).abs() < 1e-12));
        let ys: Vec<f64> = lines[0].iter().map(|point| point.1).collect();
        assert_eq!((math::smaller(ys[0], ys[ys.len() - 1]), math::larger(ys[0], ys[ys.len() - 1])), (0.0, 10.0));
    }

    #[test]
    fn a_circle_gives_one_closed_ring_near_the_radius() {
        let lines = zero_lines(40, 40, &matrix(40, 40, |x, y| square(x - 20.0) + square(y - 20.0) - 144.0));
        assert_eq!(lines.len(), 1);
        assert_eq!(lines[0].first(), lines[0].last());
        for &(x, y) in &lines[0] {
            let radius = (square(x - 20.0) + square(y - 20.0)).sqrt();
            // Linear interpolation of x^2 over a unit step errs by at most 1/4: 1/4 / (2 r) = 0.0104.
            assert!((radius - 12.0).abs() < 0.0105, "{radius}");
        }
    }

    #[test]
    fn cells_without_value_hide_the_line() {
        assert!(zero_lines(3, 3, &[f64::NAN; 9]).is_empty());
    }
}
