//! Which machines got the same bits: the lines added by `verify --attest`, compared with the committed sums.

use super::html::{escape, table};
use super::source::Source;
use checkout::failure::Failure;
use verify::attest::{self, Attestation};

/// A row for each machine; a sentence where none is recorded.
///
/// # Errors
/// A line of the log is malformed, or the committed sums cannot be read.
pub fn rows(source: &Source<'_>) -> Result<String, Failure> {
    Ok(render(&attest::compared(source.paths)?))
}

fn render(machines: &[(Attestation, bool)]) -> String {
    if machines.is_empty() {
        return "<p>No machine is recorded.</p>\n".to_owned();
    }
    let row = |(machine, is_same): &(Attestation, bool)| {
        let got = if *is_same { "the committed bits" } else { "other bits" };
        let texts = [&machine.processor, &machine.architecture, &machine.features.join(", "), &machine.system];
        let mut row: Vec<String> = texts.into_iter().chain([&machine.rustc]).map(|text| escape(text)).collect();
        row.push(got.to_owned());
        row
    };
    let rows: Vec<Vec<String>> = machines.iter().map(row).collect();
    table("Machines", &["processor", "architecture", "instructions", "system", "compiler", "what it got"], &rows)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn other_sums_are_other_bits() {
        let one = |is_same| render(&[(Attestation { system: "a & b".to_owned(), ..Attestation::default() }, is_same)]);
        assert!(one(true).contains("the committed bits") && one(true).contains("a &amp; b"));
        assert!(one(false).contains("other bits"));
        assert!(render(&[]).contains("No machine"));
    }
}
