//! What a scene asks, read a second time from its text.

use reference::formula::Formula;
use reference::solution::Question;
use toml::Value;
use toml::value::Table;

/// The question that a panel of a scene asks, with no times yet; `main` where there are no panels.
///
/// # Errors
/// In words: what is missing.
pub fn read(text: &str, panel: &str) -> Result<Question, String> {
    let document: Table = text.parse().map_err(|error: toml::de::Error| error.to_string())?;
    let over = document.get("panel").and_then(|panels| panels.get(panel));
    let find = |table: &str, key: &str| {
        let inside = |value: &Value| value.get(key).cloned();
        over.and_then(|panel| panel.get(table)).and_then(inside).or_else(|| document.get(table).and_then(inside))
    };
    let number = |table: &str, key: &str| match find(table, key) {
        Some(Value::Float(value)) => Ok(value),
        Some(Value::Integer(value)) => Ok(value as f64),
        _ => Err(format!("no number {table}.{key}")),
    };
    let or = |key: &str, usual: f64| number("law", key).unwrap_or(usual);
    let (a_v, v0, epsilon) = (or("a_v", 0.0), number("law", "v0")?, or("epsilon", 0.1));
    let formula = match find("law", "kind").as_ref().and_then(Value::as_str) {
        Some("algebraic") => {
            let (mu, delta, q, a_v) = match find("law", "preset").as_ref().and_then(Value::as_str) {
                None => (number("law", "mu")?, or("delta", 0.0), number("law", "q")?, a_v),
                // tab:model
                Some("CFM") => (0.0, 1.0, 1.0, 0.0),
                Some("GCFM") => (number("law", "mu")?, 1.0, 1.0, number("law", "a_v")?),
                Some("HFV") => (number("law", "mu")?, 0.0, 2.0, 0.0),
                Some("SEY") => (number("law", "mu")?, 0.0, 2.0, number("law", "a_v")?),
                Some("GUO") => (number("law", "mu")?, 0.0, 1.0, 0.0),
                Some(name) => return Err(format!("the second reader knows no preset {name}")),
            };
            Formula::Algebraic { mu, delta, q, a_v, epsilon, v0 }
        }
        Some("exponential") => {
            let (a, b, c) = (number("law", "a")?, number("law", "b")?, or("c", 0.0));
            Formula::Exponential { a, b, c, a_v, epsilon, v0 }
        }
        Some("logarithmic") => Formula::Logarithmic { a_v, epsilon, v0 },
        kind => return Err(format!("the second reader knows no law {kind:?}")),
    };
    Ok(Question {
        formula,
        pedestrians: number("ring", "pedestrians")? as usize,
        length: number("ring", "length")?,
        shift: number("start", "shift")?,
        times: Vec::new(),
    })
}
