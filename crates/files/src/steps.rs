//! A print of every accepted step of a run: eight characters, from which the first step that differs in two runs can be
//! told, and who differs in it.
//!
//! The components of a state at the end of a step are dealt to parts. Of a ring of `N` pedestrians, in all its forms,
//! components `i` and `N + i` are those of pedestrian `i`, which is part `i`; the rest, part `N`, they share. The bits of part
//! `i` are hashed to a number `h_i` below the prime `P` = 262139. A print holds
//!
//! - 12 bits of a hash of the length of the step,
//! - the sum of all `h_i` modulo `P`,
//! - the sum of all `i h_i` modulo `P`.
//!
//! Where one part alone differs, the first sum differs by some `d` and the second by `i d`, which tells `i`. Chances to be
//! wrong, with hashes as good as random ones: a part that differs alone is not seen with a chance of 1/P (3.8e-6; the next
//! step is named then); several that differ are taken for one with (N + 1)/P (5.1e-4 for 133 pedestrians); another
//! length of a step is taken for several pedestrians that differ with 1/4096, and the same steps are never told apart.
//! Rings of `P - 1` pedestrians and more have several `i` for one `d`; the first is named.

use std::fmt::Write as _;

/// A prime: products with the differences of sums are then different for all parts.
const PRIME: u64 = 262_139;
/// What a hash begins with; any odd number.
const SEED: u64 = 0x9e37_79b9_7f4a_7c15;
/// Six bits each, in this order; none needs quotes in a CSV.
const DIGITS: &[u8; 64] = b"0123456789ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz+-";
/// Characters for the length and for each sum.
const WIDTHS: [usize; 3] = [2, 3, 3];
/// Characters of a print.
const WIDTH: usize = 8;
/// Prints in a line of a file.
const IN_LINE: usize = 24;
/// The first line of a file.
const HEADER: &str = "step,prints";

/// The print of a step.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Print {
    /// Of its length.
    length: u64,
    /// Of all parts of the state at its end, plain and weighted by their number.
    sums: [u64; 2],
}

/// What differs in a step of two runs of which all steps before are the same.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Change {
    /// One of the runs has no such step.
    Ended,
    /// The length of the step, hence the whole state at its end.
    Length,
    /// One pedestrian alone, from 0.
    Pedestrian(usize),
    /// Of the state only what belongs to no pedestrian.
    Shared,
    /// Several pedestrians.
    Several,
}

impl Print {
    /// The print of a step of this length that ends in this state of so many pedestrians; for the state at the start of a
    /// run the length is 0.
    ///
    /// # Panics
    /// The state has fewer than two components a pedestrian.
    pub fn new(length: f64, state: &[f64], pedestrians: usize) -> Print {
        let (one, rest) = state.split_at(pedestrians);
        let (other, shared) = rest.split_at(pedestrians);
        let mut sums = [0; 2];
        let parts = one.iter().zip(other).map(|(one, other)| hash(&[*one, *other]));
        for (i, part) in (0..).zip(parts.chain([hash(shared)])) {
            let residue = part % PRIME;
            // no overflow up to ten million parts
            sums = [sums[0] + residue, sums[1] + i * residue];
        }
        Print { length: hash(&[length]) % (1 << 12), sums: sums.map(|sum| sum % PRIME) }
    }

    /// The inverse of its text; nothing for any other text.
    pub fn parse(text: &str) -> Option<Print> {
        let mut rest = text.as_bytes();
        let mut take = |width: usize| {
            let (digits, left) = rest.split_at_checked(width)?;
            rest = left;
            digits.iter().try_fold(0, |value, digit| {
                let place = DIGITS.iter().position(|one| one == digit)?;
                Some(64 * value + place as u64)
            })
        };
        let [length, plain, weighted] = WIDTHS.map(&mut take);
        let print = Print { length: length?, sums: [plain?, weighted?] };
        (rest.is_empty() && print.sums.iter().all(|&sum| sum < PRIME)).then_some(print)
    }

    /// How it came to another print at the same place.
    fn change(self, other: Print, pedestrians: usize) -> Change {
        if self.length != other.length {
            return Change::Length;
        }
        let [plain, weighted] = [0, 1].map(|which| (other.sums[which] + PRIME - self.sums[which]) % PRIME);
        let fits = |&part: &usize| plain != 0 && part as u64 % PRIME * plain % PRIME == weighted;
        match (0..=pedestrians).find(fits) {
            Some(part) if part == pedestrians => Change::Shared,
            Some(part) => Change::Pedestrian(part),
            None => Change::Several,
        }
    }
}

impl std::fmt::Display for Print {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        for (value, width) in [self.length, self.sums[0], self.sums[1]].into_iter().zip(WIDTHS) {
            for place in (0..width).rev() {
                f.write_char(char::from(DIGITS[(value >> (6 * place)) as usize % 64]))?;
            }
        }
        Ok(())
    }
}

/// A hash of all bits of the numbers (the last steps of splitmix64, once for each).
fn hash(numbers: &[f64]) -> u64 {
    numbers.iter().fold(SEED, |before, number| {
        let mut mixed = before.rotate_left(29).wrapping_add(SEED) ^ number.to_bits();
        mixed = (mixed ^ (mixed >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        mixed = (mixed ^ (mixed >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        mixed ^ (mixed >> 31)
    })
}

/// The first step in which two runs of so many pedestrians differ, and what differs in it; nothing when every step is
/// the same. Step 0 is the state at the start.
pub fn first_change(one: &[Print], other: &[Print], pedestrians: usize) -> Option<(usize, Change)> {
    let step = (0..one.len().max(other.len())).find(|&step| one.get(step) != other.get(step))?;
    let both = one.get(step).zip(other.get(step));
    Some((step, both.map_or(Change::Ended, |(one, other)| one.change(*other, pedestrians))))
}

/// The prints of a run as text: lines of 24, each with the number of its first step.
pub fn to_csv(prints: &[Print]) -> String {
    let mut text = format!("{HEADER}\n");
    for (line, prints) in prints.chunks(IN_LINE).enumerate() {
        let prints: String = prints.iter().map(Print::to_string).collect();
        // writing to a String cannot fail
        let _ = writeln!(text, "{},{prints}", line * IN_LINE);
    }
    text
}

/// The inverse of [`to_csv`].
///
/// # Errors
/// The number, from 1, of the first line of another form.
pub fn parse(text: &str) -> Result<Vec<Print>, usize> {
    let mut prints = Vec::new();
    for (index, line) in text.lines().enumerate() {
        let known = match index {
            0 => (line == HEADER).then(Vec::new),
            _ => line.strip_prefix(&format!("{},", prints.len())).and_then(of_line),
        };
        prints.extend(known.ok_or(index + 1)?);
    }
    if text.is_empty() { Err(1) } else { Ok(prints) }
}

fn of_line(text: &str) -> Option<Vec<Print>> {
    text.as_bytes().chunks(WIDTH).map(|print| Print::parse(std::str::from_utf8(print).ok()?)).collect()
}
