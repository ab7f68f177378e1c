//! HTML building blocks: escaped text, numbers, symbols, tables.

use super::formula::GREEK;
use base64::Engine as _;
use base64::prelude::BASE64_STANDARD;
use checkout::failure::Failure;
use std::collections::BTreeMap;

/// Text that may stand between tags and in quoted attributes.
pub fn escape(text: &str) -> String {
    text.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;").replace('"', "&quot;")
}

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

/// The paper's symbol of a parameter or of a column; the name itself where there is none.
pub fn symbol(name: &str) -> &str {
    match name {
        "mu" => "μ",
        "delta" => "δ",
        "epsilon" => "ε",
        "a_v" => "ã\u{1d65}",
        "v0" => "v₀′",
        "d_gap" => "d′",
        "headway" => "Δy",
        "pedestrians" => "N",
        "length" => "L′",
        "shift" => "ε₁",
        "phi" => "Φ",
        "re_z" => "Re z⁺",
        "std" => "std of v",
        "smooth" => "smooth ramp",
        "gap" => "distance",
        other => other,
    }
}

/// The few symbols of the paper that LaTeX writes by commands, as text.
pub fn latex(symbol: &str) -> String {
    const WORDS: [(&str, &str); 16] = [
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

/// A row of a table; the first cell is its header.
pub fn row(cells: &[String]) -> String {
    let mut html = String::from("<tr>");
    for (index, cell) in cells.iter().enumerate() {
        let tag = if index == 0 { "th scope=\"row\"" } else { "td" };
        html.push_str(&format!("<{tag}>{cell}</{}>", &tag[..2]));
    }
    html + "</tr>\n"
}

/// A table in a frame that scrolls by itself where it is too wide; `name` is read to those who cannot see it.
pub fn table(name: &str, head: &[&str], rows: &[Vec<String>]) -> String {
    let name = escape(name);
    let head: String = head.iter().map(|cell| format!("<th scope=\"col\">{cell}</th>")).collect();
    let body: String = rows.iter().map(|cells| row(cells)).collect();
    format!(
        "<div class=\"wide\" role=\"group\" tabindex=\"0\" aria-label=\"{name}\"><table><thead><tr>{head}</tr></thead>\n\
         <tbody>{body}</tbody></table></div>\n"
    )
}

/// A picture or a file as an address that holds it.
pub fn data_uri(kind: &str, bytes: &[u8]) -> String {
    format!("data:{kind};base64,{}", BASE64_STANDARD.encode(bytes))
}

/// Puts what the slots `{{name}}` of a template name in their place.
///
/// # Errors
/// A slot that nothing fills, or a text that has no slot.
pub fn fill(template: &str, slots: &BTreeMap<&str, String>) -> Result<String, Failure> {
    let mut parts = template.split("{{");
    let mut html = parts.next().unwrap_or("").to_owned();
    let mut left: Vec<&str> = slots.keys().copied().collect();
    for part in parts {
        let (name, rest) = part.split_once("}}").ok_or_else(|| Failure::failed("the template has {{ without }}"))?;
        let text = slots.get(name).ok_or_else(|| Failure::failed(format!("nothing fills {{{{{name}}}}}")))?;
        left.retain(|other| *other != name);
        html.push_str(text);
        html.push_str(rest);
    }
    match left.first() {
        Some(name) => Err(Failure::failed(format!("the template has no {{{{{name}}}}}"))),
        None => Ok(html),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_have_the_digits_they_are_worth() {
        assert_eq!(number(0.000_123_456, 3), "0.000123");
        assert_eq!(number(-1.5e-12, 2), "\u{2212}1.5 × 10<sup>\u{2212}12</sup>");
        assert_eq!(number(1e-12, 2), "10<sup>\u{2212}12</sup>");
        assert_eq!(number(1500.0, 2), "1500");
        assert_eq!(measured(960.872_846_880_509_1, Some(2.8e-12)), "960.872846880509");
        assert_eq!(measured(41.0, Some(0.0)), "41");
        assert_eq!(measured(0.3, None), "0.3");
    }

    #[test]
    fn symbols_of_the_paper_read_without_latex() {
        let symbols = ["\\tilde a_v", "\\varepsilon_1", "v_0'", "$\\mu$", "\\Delta t"];
        assert_eq!(latex_html("c_{max}, \\Delta t_s"), "c<sub>max</sub>, Δ t<sub>s</sub>");
        assert_eq!(latex_html("v_n(0)"), "v<sub>n</sub>(0)");
        assert_eq!(symbols.map(latex), ["ã\u{1d65}", "ε₁", "v₀′", "μ", "Δ t"]);
    }

    #[test]
    fn nothing_gets_out_of_a_text() {
        assert_eq!(escape("<a b=\"c\">&"), "&lt;a b=&quot;c&quot;&gt;&amp;");
    }

    #[test]
    fn every_slot_is_filled_and_every_text_used() {
        let slots = BTreeMap::from([("a", "1".to_owned())]);
        assert_eq!(fill("x{{a}}y", &slots), Ok("x1y".to_owned()));
        assert!(fill("{{b}}", &slots).is_err() && fill("none", &slots).is_err() && fill("{{a", &slots).is_err());
    }
}
