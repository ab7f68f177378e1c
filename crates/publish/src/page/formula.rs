//! Formulas in plain text, such as `mu_cr = sqrt(d'^3 / 4)`, as HTML: Greek letters, subscripts, powers, primes.

use super::html::escape;

/// Names of Greek letters, in plain text and, behind a backslash, in LaTeX.
pub const GREEK: [(&str, &str); 14] = [
    ("mu", "μ"),
    ("varepsilon", "ε"),
    ("epsilon", "ε"),
    ("eps", "ε"),
    ("delta", "δ"),
    ("Delta", "Δ"),
    ("Phi", "Φ"),
    ("phi", "φ"),
    ("tau", "τ"),
    ("pi", "π"),
    ("sigma", "σ"),
    ("theta", "θ"),
    ("kappa", "κ"),
    ("gamma", "γ"),
];
/// Longest name that may have a subscript without being Greek, and longest subscript: what is longer is a column.
const SHORT: usize = 2;

/// Text in which words between backquotes are code, and formulas are set.
pub fn prose(text: &str) -> String {
    let mut html = String::new();
    for (index, part) in text.split('`').enumerate() {
        match index % 2 {
            1 => html.push_str(&format!("<code>{}</code>", escape(part))),
            _ => html.push_str(&part.split_inclusive(' ').map(word).collect::<String>()),
        }
    }
    html
}

/// A word with the blank after it; labels and paths stay as they are.
fn word(text: &str) -> String {
    let inner = text.trim_end_matches([' ', ',', ';', ':', '.', ')']);
    if inner.contains(':') || inner.contains(".csv") || inner.contains(".toml") { escape(text) } else { set(text) }
}

fn set(text: &str) -> String {
    let mut html = String::new();
    let mut rest = text;
    while let Some(first) = rest.chars().next() {
        let (piece, used) = match first {
            _ if first.is_ascii_alphabetic() => name(rest),
            '^' => power(&rest[1..]).map_or((first.to_string(), 1), |(html, used)| (html, used + 1)),
            // after a name or a number; `name` takes those of names
            '-' if html.is_empty() && rest[1..].starts_with(|next: char| next.is_ascii_digit()) => ("−".to_owned(), 1),
            _ => (escape(&first.to_string()), first.len_utf8()),
        };
        html.push_str(&piece);
        rest = &rest[used..];
    }
    html
}

/// Letters, their subscript and prime at the start of a text: as HTML, and how much of the text they are.
fn name(text: &str) -> (String, usize) {
    let letters = text.find(|letter: char| !letter.is_ascii_alphabetic()).unwrap_or(text.len());
    let base = &text[..letters];
    let greek = GREEK.iter().find(|(name, _)| *name == base).map(|(_, letter)| *letter);
    let mut html = greek.unwrap_or(base).to_owned();
    let mut used = letters;
    if let Some(below) = text[used..].strip_prefix('_') {
        let length = below.find(|letter: char| !letter.is_ascii_alphanumeric()).unwrap_or(below.len());
        let is_column = below[length..].starts_with('_') || (greek.is_none() && base.len() > SHORT);
        let is_short = (1..=SHORT).contains(&length) || GREEK.iter().any(|(name, _)| *name == &below[..length]);
        if is_column || !is_short {
            let whole =
                text.find(|letter: char| !(letter.is_ascii_alphanumeric() || letter == '_')).unwrap_or(text.len());
            return (text[..whole].to_owned(), whole);
        }
        let subscript =
            GREEK.iter().find(|(name, _)| *name == &below[..length]).map_or(&below[..length], |(_, letter)| letter);
        html.push_str(&format!("<sub>{subscript}</sub>"));
        used += 1 + length;
    }
    // a prime stands after one letter; after a word it is an apostrophe
    if text[used..].starts_with('\'') && (base.len() == 1 || greek.is_some() || used > letters) {
        html.push('′');
        used += 1;
    }
    (html, used)
}

/// An exponent at the start of a text.
fn power(text: &str) -> Option<(String, usize)> {
    let sign = usize::from(text.starts_with('-'));
    let length = text[sign..].find(|letter: char| !letter.is_ascii_alphanumeric()).unwrap_or(text.len() - sign);
    let minus = if sign == 1 { "−" } else { "" };
    (length > 0).then(|| (format!("<sup>{minus}{}</sup>", &text[sign..sign + length]), sign + length))
}

#[cfg(test)]
mod tests {
    use super::prose;

    #[test]
    fn formulas_are_set() {
        let pairs = [
            ("mu_cr = sqrt(d'^3 / 4)", "μ<sub>cr</sub> = sqrt(d′<sup>3</sup> / 4)"),
            ("10^-5, -0.152", "10<sup>−5</sup>, −0.152"),
            ("v_0' = v_0 tau / a_0", "v<sub>0</sub>′ = v<sub>0</sub> τ / a<sub>0</sub>"),
            ("r_eps (eps = 0.1)", "r<sub>ε</sub> (ε = 0.1)"),
            ("(2 pi / 67)", "(2 π / 67)"),
        ];
        for (plain, html) in pairs {
            assert_eq!(prose(plain), html);
        }
    }

    #[test]
    fn what_is_no_formula_stays() {
        for plain in
            ["data/fig02/eps_01.csv", "fig:stdv_rec", "the columns error_gap and long_wave_margin", "others' 5e-8"]
        {
            assert_eq!(prose(plain), plain);
        }
        assert_eq!(prose("`mu_cr` < 1"), "<code>mu_cr</code> &lt; 1");
    }
}
