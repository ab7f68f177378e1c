//! Lossless packing of the page's numbers. Each number is replaced by its difference from a prediction (the plane
//! through three preceding neighbours), bytes of equal significance are stored together, and the result is compressed.

use base64::Engine as _;
use base64::prelude::BASE64_STANDARD;
use checkout::failure::Failure;
use flate2::Compression;
use flate2::write::GzEncoder;
use serde_json::{Value, json};
use std::io::Write as _;

/// Arrays under one name each.
#[derive(Debug, Default)]
pub struct Numbers {
    arrays: Vec<Value>,
    bytes: Vec<u8>,
}

impl Numbers {
    /// Numbers as four bytes each, seven digits; `row` of them make a row.
    pub fn singles(&mut self, id: &str, row: usize, values: impl Iterator<Item = f64>) {
        let ordered = |bits: u32| if bits >> 31 == 1 { !bits } else { bits | 1 << 31 };
        self.add(id, "single", row, &values.map(|value| ordered((value as f32).to_bits())).collect::<Vec<u32>>());
    }

    /// Whole numbers of two bytes.
    ///
    /// # Errors
    /// One does not fit.
    pub fn shorts(&mut self, id: &str, row: usize, values: impl Iterator<Item = i64>) -> Result<(), Failure> {
        let bad = |value| move |_| Failure::failed(format!("{id}: {value} does not fit into two bytes"));
        let short = |value: i64| i16::try_from(value).map(|short| i32::from(short) as u32).map_err(bad(value));
        let words = values.map(short).collect::<Result<Vec<u32>, Failure>>()?;
        self.add(id, "short", row, &words);
        Ok(())
    }

    fn add(&mut self, id: &str, kind: &str, row: usize, words: &[u32]) {
        let folded = differences(words, row);
        let largest = folded.iter().copied().max().unwrap_or(0);
        let planes = 4 - largest.leading_zeros() as usize / 8;
        for plane in 0..planes {
            self.bytes.extend(folded.iter().map(|word| (word >> (8 * plane)) as u8));
        }
        self.arrays.push(json!({ "id": id, "kind": kind, "count": words.len(), "row": row, "planes": planes }));
    }

    /// What there is, in the order in which it lies there.
    pub fn index(&self) -> Value {
        Value::Array(self.arrays.clone())
    }

    /// The element that holds all of it.
    ///
    /// # Errors
    /// It cannot be compressed.
    pub fn element(&self) -> Result<String, Failure> {
        Ok(format!("<script type=\"text/plain\" id=\"numbers\">{}</script>\n", packed(&self.bytes)?))
    }
}

/// Compressed, as base64.
///
/// # Errors
/// The library fails.
pub fn packed(bytes: &[u8]) -> Result<String, Failure> {
    let mut packer = GzEncoder::new(Vec::new(), Compression::best());
    let packed = packer.write_all(bytes).and_then(|()| packer.finish()).map_err(Failure::failed)?;
    Ok(BASE64_STANDARD.encode(packed))
}

/// Differences from what is expected, the sign in the lowest bit.
fn differences(words: &[u32], row: usize) -> Vec<u32> {
    let folded = |i: usize| {
        let difference = words[i].wrapping_sub(expected(words, i, row));
        (difference << 1) ^ 0u32.wrapping_sub(difference >> 31)
    };
    (0..words.len()).map(folded).collect()
}

/// What the neighbours before a number let expect: the one before in its row, the one of the row before, and the
/// corner.
fn expected(words: &[u32], i: usize, row: usize) -> u32 {
    match (!i.is_multiple_of(row), i >= row) {
        (true, true) => words[i - 1].wrapping_add(words[i - row]).wrapping_sub(words[i - row - 1]),
        (true, false) => words[i - 1],
        (false, true) => words[i - row],
        (false, false) => 0,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_come_back() {
        let words: Vec<u32> = (0..60u32).map(|i| (i * i).wrapping_mul(2_654_435_761)).collect();
        for row in [1, 7, 60] {
            let mut back: Vec<u32> = Vec::new();
            for (i, folded) in differences(&words, row).into_iter().enumerate() {
                let difference = (folded >> 1) ^ 0u32.wrapping_sub(folded & 1);
                back.push(expected(&back, i, row).wrapping_add(difference));
            }
            assert_eq!(back, words);
        }
    }

    #[test]
    fn planes_are_as_many_as_the_differences_need() {
        let mut numbers = Numbers::default();
        numbers.shorts("a", 3, [1, 2, 3, 4, 5, 6].into_iter()).expect("small");
        numbers.singles("b", 1, [0.1, -0.1].into_iter());
        assert_eq!((&numbers.index()[0]["planes"], &numbers.index()[1]["planes"]), (&json!(1), &json!(4)));
        assert_eq!(numbers.bytes.len(), 6 + 8);
        assert!(numbers.shorts("c", 1, [40_000].into_iter()).is_err_and(|error| error.text().contains("40000")));
    }
}
