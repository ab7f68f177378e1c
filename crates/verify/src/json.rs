//! A judgement as JSON.

use crate::judgement::Judgement;
use crate::pictures::Picture;
use crate::pixels::THRESHOLDS;
use crate::tables::Compared;
use checkout::sums::State;
use serde_json::{Value, json};
use std::collections::BTreeMap;

/// Everything that was found of a figure.
pub fn of(judgement: &Judgement) -> Value {
    let files: BTreeMap<&str, &str> = judgement.files.iter().map(|(name, state)| (&**name, state.word())).collect();
    let tables: BTreeMap<&str, Value> =
        judgement.tables.iter().map(|(name, one)| (name.as_str(), table(one))).collect();
    let pictures: BTreeMap<&str, Value> =
        judgement.pictures.iter().map(|(name, one)| (name.as_str(), picture(one))).collect();
    let verdict = judgement.verdict();
    json!({
        "figure": judgement.id, "label": judgement.label,
        "verdict": verdict.word(), "meaning": verdict.meaning(), "within_tolerance": verdict.is_within(),
        "bytes": { "verdict": word(judgement.bytes_are_same()), "files": files },
        "numbers": { "verdict": word(judgement.numbers_are_same()), "tables": tables, "events": judgement.events, "parted": judgement.parted },
        "pixels": { "verdict": word(judgement.pixels_are_same()), "pictures": pictures },
    })
}

/// `same` or `differs`.
pub fn word(same: bool) -> &'static str {
    if same { State::Same.word() } else { State::Differs.word() }
}

fn table(table: &Result<Compared, String>) -> Value {
    match table {
        Ok(Compared { against, distance }) => {
            let mut value = json!(distance);
            value["against"] = against.word().into();
            value
        }
        Err(problem) => json!({ "problem": problem }),
    }
}

fn picture(picture: &Picture) -> Value {
    match picture {
        Picture::Pixels(pixels, shown) => {
            let mut value = json!(pixels);
            value["thresholds"] = json!(THRESHOLDS);
            value["files"] = json!(shown.files);
            value
        }
        Picture::Text { first, committed, made } => {
            json!({ "first_byte": first, "committed_bytes": committed, "made_bytes": made })
        }
        Picture::Problem(problem) => json!({ "problem": problem }),
    }
}
