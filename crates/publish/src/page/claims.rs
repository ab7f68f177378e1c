//! Claims, errata and parameters as HTML.

use super::formula::prose;
use super::html::{code, escape, latex_html, measured, number, table};
use claims::entry::Verdict;
use claims::report::{JudgedClaim, JudgedErratum, JudgedParameter, Ledger, Tested};
use claims::uncertain::Outcome;

/// The verdicts at a glance: a bar and a list of counts.
pub fn glance(ledger: &Ledger) -> String {
    let shown = Verdict::ALL.into_iter().filter(|&verdict| ledger.count(verdict) > 0);
    let part = |verdict: Verdict| {
        format!("<span class=\"{}\" style=\"flex-grow:{}\"></span>", class(verdict), ledger.count(verdict))
    };
    let bar: String = shown.map(part).collect();
    let item = |verdict: Verdict| {
        let (count, class, verdict) = (ledger.count(verdict), class(verdict), verdict.words());
        format!(
            "<li class=\"{class}\"><a href=\"#claims\" data-verdict=\"{verdict}\"><b>{count}</b> {verdict}</a></li>\n"
        )
    };
    let list: String = Verdict::ALL.into_iter().map(item).collect();
    format!("<div class=\"bar\" aria-hidden=\"true\">{bar}</div>\n<ul class=\"verdicts\">{list}</ul>\n")
}

/// A name for style sheets.
fn class(verdict: Verdict) -> String {
    verdict.words().replace(' ', "-")
}

/// The boxes that choose verdicts, with their counts.
pub fn verdict_boxes(ledger: &Ledger) -> String {
    let one = |verdict: Verdict| {
        let (class, count, verdict) = (class(verdict), ledger.count(verdict), verdict.words());
        format!(
            "<label class=\"{class}\"><input type=\"checkbox\" name=\"verdict\" value=\"{verdict}\" checked> {verdict} \
             <span class=\"count\">{count}</span></label>\n"
        )
    };
    Verdict::ALL.into_iter().map(one).collect()
}

/// The labels that claims stand at, as options.
pub fn label_options(ledger: &Ledger) -> String {
    let labels: std::collections::BTreeSet<&str> = ledger.claims.iter().map(|claim| claim.label.as_str()).collect();
    labels.iter().map(|label| format!("<option>{}</option>", escape(label))).collect()
}

/// All claims.
pub fn claims(ledger: &Ledger) -> String {
    ledger.claims.iter().map(claim).collect()
}

fn claim(claim: &JudgedClaim) -> String {
    let id = escape(&claim.id);
    let noted = |name: &str, words: &Option<String>| {
        let words = words.as_deref().filter(|words| !words.is_empty());
        words.map_or(String::new(), |words| format!("<p><b>{name}:</b> {}</p>\n", prose(words)))
    };
    let changed =
        Some(claim.verdict_found).filter(|found| *found != claim.verdict).map(|found| found.words().to_owned());
    let notes =
        noted("The tables now say", &changed) + &noted("Condition", &claim.condition) + &noted("Why", &claim.why);
    format!(
        "<article class=\"claim\" id=\"claim-{id}\" data-verdict=\"{verdict}\" data-label=\"{label}\" data-words=\"{words}\">\n\
         <h3>{says}</h3>\n<p class=\"meta\"><span class=\"verdict {class}\">{verdict}</span> {label_code}</p>\n\
         <p>{finding}</p>\n{notes}{tests}</article>\n",
        verdict = claim.verdict.words(),
        class = class(claim.verdict),
        label = escape(&claim.label),
        label_code = code(&claim.label),
        words = escape(&format!("{} {}", claim.says, claim.finding)),
        says = prose(&claim.says),
        finding = prose(&claim.finding),
        tests = tests(&claim.id, &claim.tests),
    )
}

/// The numbers behind a statement, folded.
fn tests(id: &str, tests: &[Tested]) -> String {
    if tests.is_empty() {
        return String::new();
    }
    let rows: Vec<Vec<String>> = tests.iter().map(test).collect();
    let head = ["measure", "value", "error", "must be", "outcome"];
    let name = format!("Numbers behind {id}");
    let commands: std::collections::BTreeSet<&str> = tests.iter().map(|test| test.command.as_str()).collect();
    let commands: Vec<String> = commands.into_iter().filter(|text| !text.is_empty()).map(code).collect();
    let count = if tests.len() == 1 { "1 number".to_owned() } else { format!("{} numbers", tests.len()) };
    format!(
        "<details><summary>{count} behind it</summary>\n{}<p class=\"commands\">{}</p></details>\n",
        table(&name, &head, &rows),
        commands.join("<br>")
    )
}

fn test(test: &Tested) -> Vec<String> {
    let known = Some(test.error).filter(|error| error.is_finite());
    let value = if test.value.is_finite() { measured(test.value, known) } else { "none".to_owned() };
    let error = match known {
        None => "unknown".to_owned(),
        Some(0.0) => "exact".to_owned(),
        Some(error) => number(error, 2),
    };
    let outcome = test.outcome.map_or("", Outcome::word);
    let is = test.is.as_deref().unwrap_or("");
    let under = if test.under { "under the condition: " } else { "" };
    vec![format!("{under}{}", escape(&test.words)), value, error, escape(is), escape(outcome)]
}

/// All errata.
pub fn errata(ledger: &Ledger) -> String {
    if ledger.errata.is_empty() {
        return "<p>None are recorded.</p>\n".to_owned();
    }
    ledger.errata.iter().map(erratum).collect()
}

fn erratum(erratum: &JudgedErratum) -> String {
    let touches = match erratum.touches.as_slice() {
        [] => "No figure changes.".to_owned(),
        figures => format!("Touches {}.", links(figures)),
    };
    format!(
        "<article class=\"erratum\" id=\"erratum-{id}\">\n<h3>{label}</h3>\n<dl><dt>The paper</dt><dd>{says}</dd>\n\
         <dt>Should read</dt><dd>{should}</dd>\n<dt>Why</dt><dd>{why}</dd></dl>\n<p class=\"note\">{touches}</p>\n\
         {tests}</article>\n",
        id = escape(&erratum.id),
        label = escape(&erratum.label),
        says = prose(&erratum.says),
        should = prose(&erratum.should),
        why = prose(&erratum.why),
        tests = tests(&erratum.id, &erratum.tests),
    )
}

/// All parameters as a table.
pub fn parameters(ledger: &Ledger) -> String {
    if ledger.parameters.is_empty() {
        return "<p>None are recorded.</p>\n".to_owned();
    }
    let rows: Vec<Vec<String>> = ledger.parameters.iter().map(parameter).collect();
    table("Parameters", &["symbol", "what", "figures", "source", "how much depends on it"], &rows)
}

fn parameter(parameter: &JudgedParameter) -> Vec<String> {
    let scenes: Vec<String> = parameter.scenes.iter().map(|key| code(key)).collect();
    vec![
        latex_html(&parameter.symbol),
        format!("{}<br>{}", prose(&parameter.name), scenes.join("<br>")),
        links(&parameter.figures),
        prose(&parameter.source),
        format!("{}{}", prose(&parameter.influence), tests(&parameter.id, &parameter.tests)),
    ]
}

/// Figures by their names, each a link to its place on the page.
fn links(figures: &[String]) -> String {
    let link = |id: &String| match id.strip_prefix("fig").map(|digits| digits.trim_start_matches('0')) {
        Some(number) => format!("<a href=\"#{id}\">figure {number}</a>", id = escape(id)),
        None => escape(id),
    };
    figures.iter().map(link).collect::<Vec<_>>().join(", ")
}
