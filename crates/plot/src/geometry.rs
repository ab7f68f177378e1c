//! Plane geometry of polylines: clipping to a box, and removal of invisible points.

use crate::page::units;
use plotters_backend::BackendCoord;

/// A point (x, y); on the page from the upper left corner, y downwards.
pub type Point = (f64, f64);

/// The larger of two numbers; the first if they compare equal or not at all.
pub(crate) fn larger(one: f64, other: f64) -> f64 {
    if other > one { other } else { one }
}

/// The largest of numbers that are not negative; 0 if there is none.
pub(crate) fn largest(numbers: impl IntoIterator<Item = f64>) -> f64 {
    numbers.into_iter().fold(0.0, larger)
}

/// A box on the page.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Rect {
    pub left: f64,
    pub top: f64,
    pub width: f64,
    pub height: f64,
}

impl Rect {
    pub fn right(&self) -> f64 {
        self.left + self.width
    }

    pub fn bottom(&self) -> f64 {
        self.top + self.height
    }

    pub fn contains(&self, (x, y): Point) -> bool {
        x >= self.left && x <= self.right() && y >= self.top && y <= self.bottom()
    }

    /// The upper left and the lower right corner of a box in millimetres, on the page.
    pub fn corners(&self) -> [BackendCoord; 2] {
        [(units(self.left), units(self.top)), (units(self.right()), units(self.bottom()))]
    }

    /// A part given by fractions of width (from the left) and height (from the bottom): `[x from, y from, x to, y to]`.
    pub fn part(&self, [x0, y0, x1, y1]: [f64; 4]) -> Self {
        Self {
            left: self.left + x0 * self.width,
            top: self.bottom() - y1 * self.height,
            width: (x1 - x0) * self.width,
            height: (y1 - y0) * self.height,
        }
    }
}

/// The pieces of a polyline inside a box; a point with a NaN breaks the line.
pub(crate) fn clip(points: &[Point], rect: &Rect) -> Vec<Vec<Point>> {
    let mut pieces: Vec<Vec<Point>> = Vec::new();
    let mut joined = false;
    for pair in points.windows(2) {
        let Some((start, end)) = clip_segment(pair[0], pair[1], rect) else {
            joined = false;
            continue;
        };
        match pieces.last_mut() {
            Some(piece) if joined && start == pair[0] => piece.push(end),
            _ => pieces.push(vec![start, end]),
        }
        joined = end == pair[1];
    }
    pieces
}

/// The part of a segment inside a box (Liang and Barsky), if there is any.
fn clip_segment(a: Point, b: Point, rect: &Rect) -> Option<(Point, Point)> {
    if ![a.0, a.1, b.0, b.1].iter().all(|value| value.is_finite()) {
        return None;
    }
    let (dx, dy) = (b.0 - a.0, b.1 - a.1);
    let sides = [(-dx, a.0 - rect.left), (dx, rect.right() - a.0), (-dy, a.1 - rect.top), (dy, rect.bottom() - a.1)];
    let (mut enter, mut leave) = (0.0, 1.0);
    for (step, room) in sides {
        if step == 0.0 {
            if room < 0.0 {
                return None;
            }
        } else if step < 0.0 {
            enter = larger(enter, room / step);
        } else {
            leave = -larger(-leave, -room / step);
        }
    }
    if enter > leave {
        return None;
    }
    let at = |share: f64| (a.0 + share * dx, a.1 + share * dy);
    let start = if enter > 0.0 { at(enter) } else { a };
    let end = if leave < 1.0 { at(leave) } else { b };
    Some((start, end))
}

/// Leaves out points so that no left-out point is further than `tolerance` from the line (Douglas and Peucker). First
/// and last point stay.
pub(crate) fn simplify(points: &[Point], tolerance: f64) -> Vec<Point> {
    if points.len() < 3 {
        return points.to_vec();
    }
    let mut kept = vec![false; points.len()];
    kept[0] = true;
    kept[points.len() - 1] = true;
    let mut open = vec![(0, points.len() - 1)];
    while let Some((first, last)) = open.pop() {
        let (index, distance) = farthest(points, first, last);
        if distance > tolerance * tolerance {
            kept[index] = true;
            open.push((first, index));
            open.push((index, last));
        }
    }
    points.iter().zip(kept).filter(|(_, keep)| *keep).map(|(point, _)| *point).collect()
}

/// The point between `first` and `last` that is farthest from their segment, and its distance squared.
fn farthest(points: &[Point], first: usize, last: usize) -> (usize, f64) {
    let mut best = (first, 0.0);
    for (index, &point) in points.iter().enumerate().take(last).skip(first + 1) {
        let distance = distance_squared(point, points[first], points[last]);
        if distance > best.1 {
            best = (index, distance);
        }
    }
    best
}

fn distance_squared(p: Point, a: Point, b: Point) -> f64 {
    let (dx, dy) = (b.0 - a.0, b.1 - a.1);
    let length = dx * dx + dy * dy;
    let along = (p.0 - a.0) * dx + (p.1 - a.1) * dy;
    let share = if length > 0.0 { (along / length).clamp(0.0, 1.0) } else { 0.0 };
    let (x, y) = (p.0 - a.0 - share * dx, p.1 - a.1 - share * dy);
    x * x + y * y
}

#[cfg(test)]
mod tests {
    use super::*;

    const BOX: Rect = Rect { left: 0.0, top: 0.0, width: 10.0, height: 10.0 };

    #[test]
    fn a_line_that_leaves_and_returns_becomes_two_pieces() {
        let pieces = clip(&[(1.0, 1.0), (5.0, -3.0), (9.0, 1.0)], &BOX);
        assert_eq!(pieces, [vec![(1.0, 1.0), (2.0, 0.0)], vec![(8.0, 0.0), (9.0, 1.0)]]);
    }

    #[test]
    fn a_missing_point_breaks_the_line() {
        let pieces = clip(&[(1.0, 1.0), (2.0, 1.0), (3.0, f64::NAN), (4.0, 1.0), (5.0, 1.0)], &BOX);
        assert_eq!(pieces.len(), 2);
    }

    #[test]
    fn simplifying_keeps_corners_and_drops_the_straight() {
        let points: Vec<Point> = (0..=20).map(|i: i32| (f64::from(i), f64::from((i - 10).abs()))).collect();
        assert_eq!(simplify(&points, 1e-9), [(0.0, 10.0), (10.0, 0.0), (20.0, 10.0)]);
    }
}
