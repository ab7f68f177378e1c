//! The series in time by which a small difference from a solution is carried ([`super::tangent`]), in single precision:
//! two digits are asked for.
//!
//! Two terms of the series are made in one pass along the ring. A pass costs about as much as its loads and stores, and
//! those of one term wait for those of the term before.

use super::tangent::FADING;
use math::lane;
use math::simd::Kernel;
use ode::Tangent;
use std::cell::Cell;

/// A series reaches at most so far, in units of the time in which differences move: terms of a longer one would cancel.
const LONGEST: f64 = 10.0;

/// A term that is smaller than this part of the sum ends a series over a unit of that time and more: an error is asked
/// to a factor of 3.
const REST: f32 = 1e-2;

/// The same where slopes change: who is thrown back by a wall goes on with a small difference of what came.
const REST_IF_GROWS: f32 = 1e-3;

/// Smaller differences are carried in this unit.
const LEAST: f64 = 1e-290;

/// Terms grow up to the order that `turns` is, and are looked at from this multiple of it on.
const FIRST_LOOK: f32 = 2.0;

/// More terms than any finite series over a piece needs.
const MOST_TERMS: f32 = 100.0;

/// Numbers per iteration.
const LANES: usize = 16;

/// Bytes of a line of the cache, where rows begin: what lies across two lines is read and written in two goes.
const LINE: usize = 64;

/// One number for each pedestrian, the first two of the ring once more behind the last, and zeros. Cells, since what is
/// behind a block is read while the blocks before are written.
type Row<'a> = &'a [Cell<f32>];

/// How many of the first are there again behind the last.
const WRAPPED: usize = 2;

/// What is known of all pedestrians.
struct Rows<'a> {
    n: usize,
    /// The slopes by the spacing, by the own speed, less the middle of the eigenvalues, and by the speed ahead.
    slopes: [Row<'a>; 3],
    /// How these grow in a piece.
    growths: [Row<'a>; 3],
    /// The term of the series made last, of spacings and of speeds.
    term: [Row<'a>; 2],
    /// That before it.
    earlier: [Row<'a>; 2],
    /// The sums of all terms.
    sums: [Row<'a>; 2],
}

impl<'a> Rows<'a> {
    #[inline(always)]
    fn new(room: &'a mut Vec<f32>, n: usize) -> Rows<'a> {
        const ROWS: usize = 12;
        let stride = n.next_multiple_of(LANES) + LANES;
        room.resize(ROWS * stride + LANES, 0.0);
        // where that is not known, anywhere will do
        let begin = room.as_ptr().align_offset(LINE).min(LANES);
        let all = Cell::from_mut(&mut room[begin..][..ROWS * stride]).as_slice_of_cells();
        let (slopes, rest) = all.split_at(3 * stride);
        let (growths, rest) = rest.split_at(3 * stride);
        let (term, rest) = rest.split_at(2 * stride);
        let (earlier, sums) = rest.split_at(2 * stride);
        let (growths, slopes) = (three(growths, stride), three(slopes, stride));
        Rows { n, slopes, growths, term: two(term, stride), earlier: two(earlier, stride), sums: two(sums, stride) }
    }
}

#[inline(always)]
fn two(cells: &[Cell<f32>], stride: usize) -> [Row<'_>; 2] {
    [&cells[..stride], &cells[stride..][..stride]]
}

#[inline(always)]
fn three(cells: &[Cell<f32>], stride: usize) -> [Row<'_>; 3] {
    [&cells[..stride], &cells[stride..][..stride], &cells[2 * stride..][..stride]]
}

/// Carries a difference of spacings and speeds of so many pedestrians; returns the way that the first one's speed adds.
pub(super) struct Carry<'a> {
    pub(super) tangent: Tangent<'a>,
    pub(super) n: usize,
    pub(super) difference: &'a mut [f64],
}

impl Kernel for Carry<'_> {
    type Output = f64;

    #[inline(always)]
    fn run(self) -> f64 {
        let has_speeds = self.tangent.start.len() > self.n;
        match (has_speeds, self.tangent.end.is_empty()) {
            (false, true) => self.along::<false, false>(),
            (false, false) => self.along::<false, true>(),
            (true, true) => self.along::<true, false>(),
            (true, false) => self.along::<true, true>(),
        }
    }
}

impl Carry<'_> {
    /// Carries piece by piece, by slopes by speeds, too, if the force `LOOKS` at these, along which slopes change if it
    /// `GROWS`.
    #[inline(always)]
    fn along<const LOOKS: bool, const GROWS: bool>(self) -> f64 {
        let Carry { tangent: Tangent { start, end, length, fastest, room }, n, difference } = self;
        let (fading, fastest) = match (LOOKS, GROWS) {
            (false, _) => (FADING, fastest),
            (true, false) => (start[3 * n], fastest),
            // the middle moves
            (true, true) => (0.5 * (start[3 * n] + end[3 * n]), fastest + 0.5 * (end[3 * n] - start[3 * n]).abs()),
        };
        let pieces = math::larger((fastest * length / LONGEST).ceil(), 1.0);
        let unit = length / pieces;
        let (turns, left) = ((fastest * unit) as f32, lane::exp(fading * unit));
        let half = (-fading * unit) as f32;
        let rows = Rows::new(room, n);
        fill([rows.slopes[0]], &start[..n], unit * unit);
        if GROWS {
            fill_growth(rows.growths[0], [&start[..n], &end[..n]], unit * unit / pieces);
        }
        if LOOKS {
            let (own, ahead) = (n..2 * n, 2 * n..3 * n);
            fill([rows.slopes[1]], &start[own.clone()], unit);
            fill([rows.slopes[2]], &start[ahead.clone()], unit);
            for own in &rows.slopes[1][..n + WRAPPED] {
                own.set(own.get() + half);
            }
            if GROWS {
                fill_growth(rows.growths[1], [&start[own.clone()], &end[own]], unit / pieces);
                fill_growth(rows.growths[2], [&start[ahead.clone()], &end[ahead]], unit / pieces);
            }
        }
        let (spacings, speeds) = difference.split_at_mut(n);
        let mut way = 0.0;
        for piece in 0..pieces as usize {
            let size = largest(spacings, speeds, unit);
            if size == 0.0 {
                break;
            }
            if GROWS && piece > 0 {
                grow(rows.slopes[0], rows.growths[0]);
                if LOOKS {
                    grow(rows.slopes[1], rows.growths[1]);
                    grow(rows.slopes[2], rows.growths[2]);
                }
            }
            // in units of the largest; the least doubles have no inverse
            let size = math::larger(size, LEAST);
            fill([rows.term[0], rows.sums[0]], spacings, 1.0 / size);
            fill([rows.term[1], rows.sums[1]], speeds, unit / size);
            let moved = sum::<LOOKS, GROWS>(&rows, half, turns);
            let size = left * size;
            spill(rows.sums[0], spacings, size);
            spill(rows.sums[1], speeds, size / unit);
            way += f64::from(moved) * size;
        }
        way
    }
}

/// Lets slopes grow by what they do in a piece.
#[inline(always)]
fn grow(row: Row<'_>, growths: Row<'_>) {
    for (slope, growth) in row.iter().zip(growths) {
        slope.set(slope.get() + growth.get());
    }
}

/// Sums the series, in units of a piece for time; returns that of the way of the first one.
#[inline(always)]
fn sum<const LOOKS: bool, const GROWS: bool>(rows: &Rows<'_>, half: f32, turns: f32) -> f32 {
    if GROWS {
        clear(rows.earlier[0]);
        clear(rows.earlier[1]);
    }
    // the shorter steps are, the more of them there are
    let part = if turns < 1.0 { turns } else { 1.0 };
    let rest = if GROWS { REST_IF_GROWS } else { REST * part };
    let (mut moved, mut way, mut order) = (0.0, 0.0, 0.0);
    while order < MOST_TERMS {
        let shares = [1.0 / (order + 1.0), 1.0 / (order + 2.0)];
        let first = rows.term[1][0].get();
        let second = two_terms::<LOOKS, GROWS>(rows, half, shares);
        let moved_before = (first + half * moved) * shares[0];
        moved = (second + half * moved_before) * shares[1];
        way += moved_before + moved;
        order += 2.0;
        if order >= FIRST_LOOK * turns {
            let [sum, term] = sizes(rows);
            if term <= rest * sum {
                break;
            }
        }
    }
    way
}

/// Makes the next two terms of the series and adds them to the sums; returns the speed of the first one in the first of
/// them. The second one needs the first one of the pedestrian ahead, and that the speed ahead of it: [`WRAPPED`].
#[inline(always)]
fn two_terms<const LOOKS: bool, const GROWS: bool>(rows: &Rows<'_>, half: f32, shares: [f32; 2]) -> f32 {
    let count = rows.n.div_ceil(LANES);
    let slopes = [blocks3(rows.slopes, 0, count), blocks3(rows.slopes, 1, count)];
    let growths = [blocks3(rows.growths, 0, count), blocks3(rows.growths, 1, count)];
    let [spacing, speed] = rows.term;
    let term = [blocks3([spacing, speed, &speed[1..]], 0, count), blocks3([spacing, speed, &speed[1..]], 1, count)];
    let [spacing, speed] = rows.earlier;
    let earlier = [blocks3([spacing, speed, &speed[1..]], 0, count), blocks3([spacing, speed, &speed[1..]], 1, count)];
    let sums = [blocks(rows.sums[0], 0, count), blocks(rows.sums[1], 0, count)];
    let at = Place { block: 0, i: 0 };
    let of_first =
        at.rate::<LOOKS, GROWS>(&slopes[0], &growths[0], half, at.of(&term[0]), at.of(&earlier[0])) * shares[0];
    for block in 0..count {
        let [mut closing, mut pushed, mut closed, mut gained, mut closing_before, mut pushed_before] =
            [[0.0; LANES]; 6];
        for i in 0..LANES {
            let at = Place { block, i };
            let (own, next) = (at.of(&term[0]), at.of(&term[1]));
            let (own_before, next_before) = (at.of(&earlier[0]), at.of(&earlier[1]));
            let first = [
                close(own, half) * shares[0],
                at.rate::<LOOKS, GROWS>(&slopes[0], &growths[0], half, own, own_before) * shares[0],
                at.rate::<LOOKS, GROWS>(&slopes[1], &growths[1], half, next, next_before) * shares[0],
            ];
            closing[i] = close(first, half) * shares[1];
            pushed[i] = at.rate::<LOOKS, GROWS>(&slopes[0], &growths[0], half, first, own) * shares[1];
            (closing_before[i], pushed_before[i]) = (first[0], first[1]);
            closed[i] = sums[0][block][i].get() + (first[0] + closing[i]);
            gained[i] = sums[1][block][i].get() + (first[1] + pushed[i]);
        }
        write(&term[0][0][block], &closing);
        write(&term[0][1][block], &pushed);
        write(&sums[0][block], &closed);
        write(&sums[1][block], &gained);
        if GROWS {
            write(&earlier[0][0][block], &closing_before);
        }
        if GROWS && LOOKS {
            write(&earlier[0][1][block], &pushed_before);
        }
    }
    wrap(rows.term[0], rows.n);
    wrap(rows.term[1], rows.n);
    if GROWS {
        wrap(rows.earlier[0], rows.n);
    }
    if GROWS && LOOKS {
        wrap(rows.earlier[1], rows.n);
    }
    of_first
}

/// Sixteen pedestrians.
type Block = [Cell<f32>; LANES];

/// So many blocks from a place on.
#[inline(always)]
fn blocks(row: Row<'_>, place: usize, count: usize) -> &[Block] {
    &row[place..].as_chunks::<LANES>().0[..count]
}

#[inline(always)]
fn blocks3(rows: [Row<'_>; 3], place: usize, count: usize) -> [&[Block]; 3] {
    [blocks(rows[0], place, count), blocks(rows[1], place, count), blocks(rows[2], place, count)]
}

/// Where a pedestrian is in blocks.
#[derive(Clone, Copy)]
struct Place {
    block: usize,
    i: usize,
}

impl Place {
    #[inline(always)]
    fn of(self, rows: &[&[Block]; 3]) -> [f32; 3] {
        let Place { block, i } = self;
        [rows[0][block][i].get(), rows[1][block][i].get(), rows[2][block][i].get()]
    }

    /// How a speed moves, besides fading, by a term (spacing, speed and speed ahead) and, where slopes grow, by the one
    /// before.
    #[inline(always)]
    fn rate<const LOOKS: bool, const GROWS: bool>(
        self,
        slopes: &[&[Block]; 3],
        growths: &[&[Block]; 3],
        half: f32,
        term: [f32; 3],
        earlier: [f32; 3],
    ) -> f32 {
        let (slopes, growths) = (self.of(slopes), self.of(growths));
        let mut rate = slopes[0] * term[0];
        if LOOKS {
            rate += slopes[1] * term[1] + slopes[2] * term[2];
        } else {
            rate -= half * term[1];
        }
        if GROWS {
            rate += growths[0] * earlier[0];
        }
        if GROWS && LOOKS {
            rate += growths[1] * earlier[1] + growths[2] * earlier[2];
        }
        rate
    }
}

/// How a spacing moves, besides fading.
#[inline(always)]
fn close([spacing, speed, ahead]: [f32; 3], half: f32) -> f32 {
    (ahead - speed) + half * spacing
}

#[inline(always)]
fn write(block: &[Cell<f32>], values: &[f32; LANES]) {
    for i in 0..LANES {
        block[i].set(values[i]);
    }
}

#[inline(always)]
fn wrap(row: Row<'_>, n: usize) {
    row[n].set(row[0].get());
    row[n + 1].set(row[1 % n].get());
}

#[inline(always)]
fn clear(row: Row<'_>) {
    for cell in row {
        cell.set(0.0);
    }
}

/// Stores numbers, multiplied by a factor, in single precision, in each of these rows.
#[inline(always)]
fn fill<const K: usize>(rows: [Row<'_>; K], numbers: &[f64], factor: f64) {
    let n = numbers.len();
    if n < LANES {
        for row in rows {
            for i in 0..n {
                row[i].set((numbers[i] * factor) as f32);
            }
        }
    } else {
        for from in (0..n).step_by(LANES) {
            // the last block begins earlier rather than be cut: what is written twice is the same
            let from = from.min(n - LANES);
            let (numbers, mut values) = (&numbers[from..][..LANES], [0.0; LANES]);
            for i in 0..LANES {
                values[i] = (numbers[i] * factor) as f32;
            }
            for row in rows {
                write(&row[from..][..LANES], &values);
            }
        }
    }
    for row in rows {
        close_row(row, n);
    }
}

/// Terms of zeros are zeros.
#[inline(always)]
fn close_row(row: Row<'_>, n: usize) {
    write(&row[n..][..LANES], &[0.0; LANES]);
    wrap(row, n);
}

/// Stores by how much slopes grow in a piece.
#[inline(always)]
fn fill_growth(row: Row<'_>, [start, end]: [&[f64]; 2], factor: f64) {
    let n = start.len();
    if n < LANES {
        for i in 0..n {
            row[i].set(((end[i] - start[i]) * factor) as f32);
        }
    } else {
        for from in (0..n).step_by(LANES) {
            let from = from.min(n - LANES);
            let (start, end, mut values) = (&start[from..][..LANES], &end[from..][..LANES], [0.0; LANES]);
            for i in 0..LANES {
                values[i] = ((end[i] - start[i]) * factor) as f32;
            }
            write(&row[from..][..LANES], &values);
        }
    }
    close_row(row, n);
}

/// Does the opposite of [`fill`].
#[inline(always)]
fn spill(row: Row<'_>, numbers: &mut [f64], factor: f64) {
    let n = numbers.len();
    if n < LANES {
        for i in 0..n {
            numbers[i] = f64::from(row[i].get()) * factor;
        }
        return;
    }
    for from in (0..n).step_by(LANES) {
        let from = from.min(n - LANES);
        let (values, mut wide) = (&row[from..][..LANES], [0.0; LANES]);
        for i in 0..LANES {
            wide[i] = f64::from(values[i].get()) * factor;
        }
        numbers[from..][..LANES].copy_from_slice(&wide);
    }
}

/// The largest spacing and speed together, by absolute value, of the sums and of the term made last. In the end half
/// against half: one after the other each comparison would wait for the last.
#[inline(always)]
fn sizes(rows: &Rows<'_>) -> [f32; 2] {
    let count = rows.n.div_ceil(LANES);
    let sums = [blocks(rows.sums[0], 0, count), blocks(rows.sums[1], 0, count)];
    let term = [blocks(rows.term[0], 0, count), blocks(rows.term[1], 0, count)];
    let (mut of_sums, mut of_term) = ([0.0; LANES], [0.0; LANES]);
    for block in 0..count {
        for i in 0..LANES {
            of_sums[i] = larger(of_sums[i], sums[0][block][i].get().abs() + sums[1][block][i].get().abs());
            of_term[i] = larger(of_term[i], term[0][block][i].get().abs() + term[1][block][i].get().abs());
        }
    }
    let mut half = LANES / 2;
    while half > 0 {
        for i in 0..half {
            of_sums[i] = larger(of_sums[i], of_sums[i + half]);
            of_term[i] = larger(of_term[i], of_term[i + half]);
        }
        half /= 2;
    }
    [of_sums[0], of_term[0]]
}

#[inline(always)]
fn larger(one: f32, other: f32) -> f32 {
    if other > one { other } else { one }
}

/// The largest absolute value of spacings and speeds together, these multiplied by a time; NaN counts for nothing.
#[inline(always)]
fn largest(spacings: &[f64], speeds: &[f64], unit: f64) -> f64 {
    const LANES: usize = 8;
    let mut most = [0.0; LANES];
    let (spacing_eights, spacing_rest) = spacings.as_chunks::<LANES>();
    let (speed_eights, speed_rest) = speeds.as_chunks::<LANES>();
    for (spacings, speeds) in spacing_eights.iter().zip(speed_eights) {
        for i in 0..LANES {
            let size = spacings[i].abs() + unit * speeds[i].abs();
            most[i] = if size > most[i] { size } else { most[i] };
        }
    }
    for (spacing, speed) in spacing_rest.iter().zip(speed_rest) {
        let size = spacing.abs() + unit * speed.abs();
        most[0] = if size > most[0] { size } else { most[0] };
    }
    let mut half = LANES / 2;
    while half > 0 {
        for i in 0..half {
            most[i] = if most[i + half] > most[i] { most[i + half] } else { most[i] };
        }
        half /= 2;
    }
    most[0]
}
