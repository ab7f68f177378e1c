//! Reads a second time, from the text of a scene, what it asks for.

use formula::{Definition, Given, Location};
use reference::formula::Formula;
use reference::graph::Graph;
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
    let (a_v, v0, epsilon) = (or("a_v", 0.0), or("v0", f64::NAN), or("epsilon", 0.1));
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
        Some("formula") => Formula::Graph(graph(&document, over)?),
        kind => return Err(format!("the second reader knows no law {kind:?}")),
    };
    Ok(Question {
        formula,
        pedestrians: number("ring", "pedestrians")? as usize,
        length: number("ring", "length")?,
        shift: number("start", "shift")?,
        displacements: displacements(text),
        times: Vec::new(),
    })
}

/// The displacements that a scene of the hunt gives in a comment: scene files have none, the library has.
pub fn displacements(text: &str) -> Vec<f64> {
    let given = text.lines().find_map(|line| line.strip_prefix("# displacements = [")?.strip_suffix(']'));
    given.map_or(Vec::new(), |given| given.split(", ").filter_map(|number| number.parse().ok()).collect())
}

/// The law of a text that has no more than that.
///
/// # Errors
/// In words.
pub fn law(text: &str) -> Result<Graph, String> {
    graph(&text.parse().map_err(|error: toml::de::Error| error.to_string())?, None)
}

/// The formulas of a scene, in which those of a panel take the place of others.
fn graph(document: &Table, over: Option<&Value>) -> Result<Graph, String> {
    let section = |value: Option<&Value>| value.and_then(Value::as_table).cloned().unwrap_or_default();
    let mut law = section(document.get("law"));
    law.extend(section(over.and_then(|panel| panel.get("law"))));
    law.remove("kind");
    let place = Location { line: 1, column: 1 };
    let given = |value: &'_ Value| match value {
        Value::Float(number) => Ok(Given::Number(*number)),
        Value::Integer(number) => Ok(Given::Number(*number as f64)),
        _ => Err(format!("neither a number nor a formula: {value}")),
    };
    let definitions = law.iter().map(|(name, value)| {
        let given = value.as_str().map_or_else(|| given(value), |text| Ok(Given::Text(text)))?;
        Ok(Definition { name, key: place, value: place, given })
    });
    let definitions: Vec<Definition<'_>> = definitions.collect::<Result<_, String>>()?;
    let graph = formula::law("scene", place, &definitions).map_err(|error| error.to_string())?;
    let values = graph.values();
    let bound = graph.bind(&values).map_err(|error| error.to_string())?;
    let value = |name: &str| graph.parameter(name).map(|index| values[index]);
    Ok(Graph::new(bound, value("body").unwrap_or(0.0), value("v0").or(value("scale")).unwrap_or(1.0)))
}
