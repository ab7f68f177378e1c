//! HTML building blocks: escaped text, numbers, symbols, tables.

use super::formula::{GREEK, prose};
use base64::Engine as _;
use base64::prelude::BASE64_STANDARD;
use checkout::failure::Failure;
use files::symbols;
use minijinja::Value;
pub use verify::html::escape;

/// A piece of code: a path, a command.
pub fn code(text: &str) -> String {
    format!("<code>{}</code>", escape(text))
}

/// A number with the given number of significant digits, without trailing zeros, and with powers of ten written out.
pub fn number(value: f64, digits: usize) -> String {
    if value == 0.0 {
        return "0".to_owned();
    }
    let scientific = format!("{value:.*e}", digits.max(1) - 1);
    let Some((mantissa, exponent)) = scientific.split_once('e') else { return escape(&scientific) };
    let exponent: i32 = exponent.parse().unwrap_or(0);
    if (-4..9).contains(&exponent) {
        let decimals = (digits as i32 - 1 - exponent).max(0) as usize;
        return minus(trim(&format!("{value:.decimals$}")));
    }
    let (mantissa, exponent) = (minus(trim(mantissa)), minus(&exponent.to_string()));
    let power = format!("10<sup>{exponent}</sup>");
    if mantissa == "1" { power } else { format!("{mantissa} × {power}") }
}

/// A measured number, with as many digits as its error leaves; all of them where there is no error.
pub fn measured(value: f64, error: Option<f64>) -> String {
    match error.filter(|error| *error > 0.0 && error.is_finite()) {
        Some(error) => number(value, (power(value) - power(error) + 1).clamp(2, 15) as usize),
        None => number(value, 15),
    }
}

/// The power of ten of a number.
fn power(value: f64) -> i32 {
    let text = format!("{value:e}");
    text.split_once('e').and_then(|(_, power)| power.parse().ok()).unwrap_or(0)
}

fn trim(digits: &str) -> &str {
    if digits.contains('.') { digits.trim_end_matches('0').trim_end_matches('.') } else { digits }
}

/// A typographic minus in place of the hyphen.
fn minus(digits: &str) -> String {
    digits.replace('-', "\u{2212}")
}

/// The paper's symbol of a parameter or of a column; for some columns a word, the name itself where there is none.
pub fn symbol(name: &str) -> String {
    match name {
        "std" => "std of v".to_owned(),
        "smooth" => "smooth ramp".to_owned(),
        "gap" => "distance".to_owned(),
        _ => match symbols::latex(name) {
            symbol if symbol == name => name.to_owned(),
            symbol => latex(symbol),
        },
    }
}

/// The few symbols of the paper that LaTeX writes by commands, as text.
pub fn latex(symbol: &str) -> String {
    const WORDS: [(&str, &str); 18] = [
        ("Δ ", "Δ"),
        ("^+", "⁺"),
        ("\\tildeΦ", "Φ̃"),
        ("\\hatΦ", "Φ̂"),
        ("\\tilde a", "ã"),
        ("\\tilde{a}", "ã"),
        ("\\mathrm", ""),
        ("\\text", ""),
        ("\\,", " "),
        ("_0", "₀"),
        ("_1", "₁"),
        ("_v", "\u{1d65}"),
        ("_{\\mathrm{end}}", " end"),
        ("'", "′"),
        ("$", ""),
        ("{", ""),
        ("}", ""),
        ("\\", ""),
    ];
    let letters = GREEK.iter().fold(symbol.to_owned(), |text, (name, to)| text.replace(&format!("\\{name}"), to));
    WORDS.iter().fold(letters, |text, (from, to)| text.replace(from, to))
}

/// The same as HTML, with subscripts.
pub fn latex_html(symbol: &str) -> String {
    let mut parts = symbol.split('_');
    let mut html = escape(&latex(parts.next().unwrap_or("")));
    for part in parts {
        let braced = part.strip_prefix('{').and_then(|part| part.split_once('}'));
        let (below, rest) = braced.unwrap_or_else(|| part.split_at(part.chars().next().map_or(0, char::len_utf8)));
        html.push_str(&format!("<sub>{}</sub>{}", escape(&latex(below)), escape(&latex(rest))));
    }
    html
}

/// A picture or a file as an address that holds it.
pub fn data_uri(kind: &str, bytes: &[u8]) -> String {
    format!("data:{kind};base64,{}", BASE64_STANDARD.encode(bytes))
}

/// A row of a table, of cells that are HTML.
pub fn row(cells: impl IntoIterator<Item = String>) -> Vec<Value> {
    cells.into_iter().map(Value::from_safe_string).collect()
}

/// The page from its templates and what stands in them.
///
/// # Errors
/// A template is malformed, or names what is not given.
pub fn render(templates: [(&'static str, &'static str); 2], context: Value) -> Result<String, Failure> {
    let mut environment = verify::html::environment();
    environment.add_filter("code", |text: &str| Value::from_safe_string(code(text)));
    environment.add_filter("prose", |text: &str| Value::from_safe_string(prose(text)));
    environment.add_filter("latex", |text: &str| Value::from_safe_string(latex_html(text)));
    environment.add_filter("number", |value: f64, digits: usize| Value::from_safe_string(number(value, digits)));
    environment.add_filter("measured", |value: f64, error: f64| {
        Value::from_safe_string(if value.is_finite() { measured(value, Some(error)) } else { "none".to_owned() })
    });
    environment.add_filter("stated", |error: f64| match error {
        0.0 => Value::from("exact"),
        error if error.is_finite() => Value::from_safe_string(number(error, 2)),
        _ => Value::from("unknown"),
    });
    for (name, text) in templates {
        environment.add_template(name, text).map_err(wrong)?;
    }
    environment.get_template(templates[0].0).and_then(|page| page.render(context)).map_err(wrong)
}

fn wrong(error: minijinja::Error) -> Failure {
    Failure::failed(format!("{error:#}"))
}
