//! The tables that the page recomputes, with their committed sums.

use super::figures::name;
use super::source::Source;
use checkout::costs;
use checkout::failure::Failure;
use checkout::figure::Figure;
use checkout::sums::Committed;
use serde_json::{Value, json};

/// For each figure of the paper that has tables its id, its name and the committed `sums` of its tables; the cheapest
/// first.
///
/// # Errors
/// The committed sums or costs are malformed, or there are none.
pub fn recomputed(source: &Source<'_>) -> Result<Value, Failure> {
    let committed = Committed::read(source.paths)?;
    let sums =
        committed.list(false).ok_or_else(|| Failure::failed("data/SHA256SUMS does not exist: no sums to show"))?;
    let costs = costs::read(source.paths)?;
    let cost = |figure: &Figure| {
        let nodes = costs.iter().filter(|(node, _)| node.starts_with(&figure.id));
        nodes.map(|(_, cost)| cost.cpu).sum::<f64>()
    };
    let mut figures: Vec<&Figure> = source.figures.iter().filter(|figure| !figure.is_supplement()).collect();
    figures.sort_by(|a, b| cost(a).total_cmp(&cost(b)));
    let one = |figure: &Figure| {
        let tables = sums.below(&[format!("data/{}/", figure.id)]).by_name;
        (!tables.is_empty()).then(|| json!({ "figure": figure.id, "name": name(figure), "sums": tables }))
    };
    Ok(figures.into_iter().filter_map(one).collect())
}
