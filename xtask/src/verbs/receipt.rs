//! `verify --receipt`: compares what a reader's browser computed with the committed sums.

use checkout::disk;
use checkout::failure::Failure;
use checkout::paths::Paths;
use checkout::print;
use checkout::sums::{Committed, Sums};
use serde_json::Value;
use std::collections::BTreeMap;
use std::path::Path;

/// The form of receipts that this program reads.
const SCHEMA_VERSION: u64 = 1;
/// The verdict of a receipt whose tables all have the committed sums.
const SAME: &str = "same bits";

/// Judges a receipt.
///
/// # Errors
/// Usage: it is not a receipt, or lists an unknown table. Differs: a sum is not the committed one, or the verdict of
/// the receipt contradicts its sums.
pub fn check(paths: &Paths, file: &Path) -> Result<(), Failure> {
    let text = disk::read_text(file)?.ok_or_else(|| Failure::Usage(format!("{}: no such file", file.display())))?;
    let name = file.display().to_string();
    let receipt = Receipt::parse(&name, &text)?;
    let committed = Committed::read(paths)?;
    let known = committed.list(false).ok_or_else(|| {
        Failure::Differs("data/SHA256SUMS does not exist: nothing to compare a receipt with".to_owned())
    })?;
    print::out(&format!("{}\n", receipt.judge(&name, known)?))
}

/// What a browser computed.
#[derive(Debug, PartialEq)]
struct Receipt {
    browser: String,
    verdict: String,
    /// SHA-256 by the name of the table.
    sums: BTreeMap<String, String>,
}

impl Receipt {
    fn parse(file: &str, text: &str) -> Result<Receipt, Failure> {
        let bad = |problem: &str| Failure::Usage(format!("{file}: {problem}"));
        let value: Value = serde_json::from_str(text).map_err(|error| bad(&format!("not JSON: {error}")))?;
        let version = value["schema_version"].as_u64();
        if version != Some(SCHEMA_VERSION) {
            return Err(bad(&format!("schema_version must be {SCHEMA_VERSION}, found {}", value["schema_version"])));
        }
        let word = |key: &str| {
            let found = value[key].as_str().map(str::to_owned);
            found.ok_or_else(|| bad(&format!("{key} must be a text, found {}", value[key])))
        };
        let sums = value["sums"].as_object().ok_or_else(|| bad("sums must be a table of SHA-256 by name"))?;
        let is_sum = |sum: &str| sum.len() == 64 && sum.bytes().all(|byte| byte.is_ascii_hexdigit());
        let sum = |(name, sum): (&String, &Value)| match sum.as_str().filter(|sum| is_sum(sum)) {
            Some(sum) => Ok((name.clone(), sum.to_ascii_lowercase())),
            None => Err(bad(&format!("{name}: must be a SHA-256 of 64 hexadecimal digits, found {sum}"))),
        };
        let sums = sums.iter().map(sum).collect::<Result<BTreeMap<String, String>, Failure>>()?;
        if sums.is_empty() {
            return Err(bad("sums is empty: nothing was computed"));
        }
        Ok(Receipt { browser: word("browser")?, verdict: word("verdict")?, sums })
    }

    /// What is found, in words.
    fn judge(&self, file: &str, known: &Sums) -> Result<String, Failure> {
        let tables = known.by_name.keys().filter(|name| name.ends_with(".csv")).count();
        if let Some(name) = self.sums.keys().find(|name| !name.ends_with(".csv") || !known.by_name.contains_key(*name))
        {
            return Err(Failure::Usage(format!("{file}: {name} is not a table of data/SHA256SUMS")));
        }
        let other = |(name, sum): (&String, &String)| {
            let expected = &known.by_name[name];
            (expected != sum).then(|| format!("  {name}: {sum}, committed {expected}"))
        };
        let others: Vec<String> = self.sums.iter().filter_map(other).collect();
        let count = self.sums.len();
        if !others.is_empty() {
            let (differ, list) = (others.len(), others.join("\n"));
            return Err(Failure::Differs(format!("{file}: {differ} of {count} tables differ:\n{list}")));
        }
        if self.verdict != SAME {
            let verdict = &self.verdict;
            let problem = format!("{file}: its verdict is {verdict:?}, but all its sums are the committed ones");
            return Err(Failure::Differs(problem));
        }
        let left = match tables - count {
            0 => String::new(),
            left => format!("; {left} of {tables} tables were not computed"),
        };
        Ok(format!("{count} tables with the committed sums, computed by {}{left}", self.browser))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn known() -> Sums {
        let names = ["data/fig02/a.csv", "data/fig03/b.csv", "figures/fig02/fig02.png"];
        Sums { by_name: names.iter().map(|name| ((*name).to_owned(), "ab".repeat(32))).collect() }
    }

    fn judge(verdict: &str, sums: &[(&str, &str)]) -> Result<String, Failure> {
        let sums: serde_json::Map<String, Value> =
            sums.iter().map(|(name, sum)| ((*name).to_owned(), Value::from(sum.repeat(32)))).collect();
        let text = serde_json::json!({ "schema_version": 1, "browser": "B", "verdict": verdict, "sums": sums });
        Receipt::parse("r.json", &text.to_string())?.judge("r.json", &known())
    }

    #[test]
    fn the_committed_sums_are_said_to_be_so() {
        let all = judge("same bits", &[("data/fig02/a.csv", "ab"), ("data/fig03/b.csv", "AB")]).expect("good");
        assert!(all.starts_with("2 tables") && all.contains("by B") && !all.contains("not computed"), "{all}");
        let part = judge("same bits", &[("data/fig02/a.csv", "ab")]).expect("good");
        assert!(part.contains("1 of 2 tables were not computed"), "{part}");
    }

    #[test]
    fn another_sum_and_a_false_verdict_differ() {
        let other =
            judge("same bits", &[("data/fig02/a.csv", "cd"), ("data/fig03/b.csv", "ab")]).expect_err("another sum");
        assert_eq!(other.code(), 1);
        assert!(other.text().contains("1 of 2 tables") && other.text().contains("data/fig02/a.csv"), "{other:?}");
        assert_eq!(judge("differs", &[("data/fig02/a.csv", "ab")]).expect_err("a false verdict").code(), 1);
    }

    #[test]
    fn what_is_no_receipt_is_refused() {
        for bad in ["", "[]", "{\"schema_version\": 2}", "{\"schema_version\": 1, \"sums\": {}}"] {
            assert_eq!(Receipt::parse("r.json", bad).expect_err(bad).code(), 2, "{bad}");
        }
        assert_eq!(judge("same bits", &[("data/fig99/a.csv", "ab")]).expect_err("no such table").code(), 2);
        assert_eq!(judge("same bits", &[("figures/fig02/fig02.png", "ab")]).expect_err("a picture").code(), 2);
        assert_eq!(judge("same bits", &[("data/fig02/a.csv", "xy")]).expect_err("no sum").code(), 2);
        assert_eq!(judge("same bits", &[]).expect_err("nothing").code(), 2);
    }
}
