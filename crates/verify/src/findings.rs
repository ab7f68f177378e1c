//! The findings of a verification, as text and as JSON.

use crate::judgement::Judgement;
use crate::verdict::Verdict;
use crate::{json, words};
use checkout::print;
use checkout::print::duration;
use claims::Verdicts;
use serde_json::{Value, json};

/// Everything that a verification found.
#[derive(Clone, Debug, Default)]
pub struct Findings {
    /// The figures.
    pub figures: Vec<Judgement>,
    /// The claims.
    pub claims: Verdicts,
    /// Lines of what is committed that belong to no figure.
    pub strays: Vec<String>,
    /// Figures that did not fit into the budget, each with the seconds that it takes alone, where they are known.
    pub left_out: Vec<(String, Option<f64>)>,
    /// Hash over the list of sums of the paper's figures that were made.
    pub sums: String,
}

impl Findings {
    /// Whether everything is as committed.
    pub fn are_same(&self) -> bool {
        self.figures.iter().all(Judgement::is_same) && self.claims.is_same() && self.strays.is_empty()
    }

    /// Whether everything is as committed but the bytes of the ledger, whose verdicts are the recorded ones.
    pub fn are_all_but_the_ledger(&self) -> bool {
        let figures = self.figures.iter().all(Judgement::is_same) && self.strays.is_empty();
        figures && self.claims.committed.is_some() && self.claims.differences().is_empty()
    }

    /// Whether numbers are within tolerance and claims as recorded, wherever bytes and pixels are.
    pub fn are_within(&self) -> bool {
        let within = |figure: &Judgement| figure.verdict().is_within();
        // a ledger whose numbers differ in the last digits has the same verdicts
        self.figures.iter().all(within) && self.claims.differences().is_empty() && self.strays.is_empty()
    }

    /// The gravest verdict on a figure.
    pub fn verdict(&self) -> Verdict {
        self.figures.iter().map(Judgement::verdict).max().unwrap_or(Verdict::Same)
    }

    /// All of it.
    pub fn to_json(&self) -> Value {
        let figures: Vec<Value> = self.figures.iter().map(json::of).collect();
        let left_out = |(figure, seconds): &(String, Option<f64>)| json!({ "figure": figure, "seconds": seconds });
        let left_out: Vec<Value> = self.left_out.iter().map(left_out).collect();
        json!({
            "figures": figures, "claims": self.claims.to_json(), "strays": self.strays, "left_out": left_out, "sums": self.sums,
            "verdict": self.verdict().word(), "ok": self.are_same(), "within_tolerance": self.are_within(),
        })
    }

    /// A table of the figures by level, then everything that differs.
    pub fn to_text(&self) -> String {
        let details = self.figures.iter().flat_map(words::details);
        let lines = details.chain([self.claims.line()]).chain(self.claims.details()).chain(self.strays.iter().cloned());
        let lines = lines.chain(self.left_out_line()).map(|line| format!("{line}\n"));
        format!("{}{}", print::table(&self.rows()), lines.collect::<String>())
    }

    /// A header and a row for each figure: the result of each level, and the verdict.
    pub fn rows(&self) -> Vec<Vec<String>> {
        let mut rows = vec![print::row(&["figure", "label", "bytes", "numbers", "pixels", "verdict"])];
        for figure in &self.figures {
            let numbers = json::word(figure.numbers_are_same());
            let numbers = if figure.tables.is_empty() { "no tables" } else { numbers };
            let (bytes, pixels) = (json::word(figure.bytes_are_same()), json::word(figure.pixels_are_same()));
            rows.push(print::row(&[&figure.id, &figure.label, bytes, numbers, pixels, figure.verdict().meaning()]));
        }
        rows
    }

    /// What did not fit into the budget.
    pub fn left_out_line(&self) -> Option<String> {
        let word = |(figure, seconds): &(String, Option<f64>)| match seconds {
            Some(seconds) => format!("{figure} ({})", duration(*seconds)),
            None => format!("{figure} (not known)"),
        };
        let words: Vec<String> = self.left_out.iter().map(word).collect();
        (!words.is_empty()).then(|| format!("left out by the budget: {}", words.join(", ")))
    }
}
