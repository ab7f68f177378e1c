//! Titles, legends and labels: the paper's symbols with the numbers of the scene.

use files::reader::{Section, Value};
use files::scene_file::Panel;
use files::symbols;

/// The paper's symbol of a parameter, in the markup of labels without its dollars.
pub fn symbol(parameter: &str) -> &str {
    match parameter {
        "k" => "\\text{wave number }k",
        other => symbols::latex(other),
    }
}

/// A number of a scene as one reads it: six digits at most, powers of ten where plain digits are long.
pub fn number(value: f64) -> String {
    let short: f64 = format!("{value:.5e}").parse().unwrap_or(value);
    let scientific = format!("{short:e}");
    let (digits, exponent) = scientific.split_once('e').unwrap_or((&scientific, "0"));
    match exponent.parse() {
        Ok(-3..=5) | Err(_) => short.to_string(),
        Ok(_) if digits == "1" => format!("10^{{{exponent}}}"),
        Ok::<i32, _>(_) => format!("{digits}\\times 10^{{{exponent}}}"),
    }
}

/// `$\mu = 0.45$` for `["law.mu"]`: parameters that the panel sets, with their numbers; those it does not set are 0.
pub fn title(panel: &Panel, keys: &[&str]) -> String {
    let equation = |key: &&str| {
        let name = key.rsplit('.').next().unwrap_or(key);
        format!("{} = {}", symbol(name), number(value(&panel.tables, key).unwrap_or(0.0)))
    };
    format!("${}$", keys.iter().map(equation).collect::<Vec<_>>().join(",\\; "))
}

/// The law as the paper names it: `$\langle \mu, 0, 2, 0\rangle$`, with the symbol of a parameter that is an axis.
pub fn law(panel: &Panel) -> String {
    let section = |key| panel.tables.section(key);
    let axes = section("map").map(|map| ["x", "y"].map(|axis| text(map.section(axis)?, "parameter")));
    let parameters = match section("law").and_then(|law| text(law, "kind")) {
        Some("algebraic") => ["mu", "delta", "q", "a_v"],
        Some("exponential") => ["a", "b", "c", "a_v"],
        _ => return title(panel, &["law.v0", "law.a_v"]),
    };
    let entry = |parameter: &str| match axes {
        Some(axes) if axes.contains(&Some(parameter)) => symbol(parameter).to_owned(),
        _ => number(value(&panel.tables, &format!("law.{parameter}")).unwrap_or(0.0)),
    };
    format!("$\\langle {}\\rangle$", parameters.map(entry).join(", "))
}

/// The number at a dotted key of a scene's tables.
pub fn value(tables: &Section, key: &str) -> Option<f64> {
    match key.split_once('.') {
        Some((section, rest)) => value(tables.section(section)?, rest),
        None => match tables.entries.get(key)?.value {
            Value::Number(number) => Some(number),
            _ => None,
        },
    }
}

fn text<'a>(section: &'a Section, key: &str) -> Option<&'a str> {
    match &section.entries.get(key)?.value {
        Value::Text(text) => Some(text),
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use files::scene_file;

    fn panel(law: &str, rest: &str) -> Panel {
        let text = format!("title = \"\"\nsource = \"\"\n[law]\n{law}\n{rest}");
        scene_file::parse("scene.toml", &text).expect("a scene").panels.remove(0)
    }

    #[test]
    fn titles_have_the_numbers_of_the_scene() {
        for mu in ["0.45", "0.6"] {
            let panel = panel(&format!("kind = \"algebraic\"\nmu = {mu}"), "");
            assert_eq!(title(&panel, &["law.mu"]), format!("$\\mu = {mu}$"));
        }
        let panel = panel("kind = \"exponential\"\na = 3.0\nb = 1.5", "");
        assert_eq!(title(&panel, &["law.a", "law.b", "law.a_v"]), "$a = 3,\\; b = 1.5,\\; \\tilde a_v = 0$");
    }

    #[test]
    fn a_law_names_its_axes_by_symbols_and_the_rest_by_numbers() {
        let map = "[map]\nx = { parameter = \"mu\" }\ny = { parameter = \"d_gap\" }";
        let panel = panel("kind = \"algebraic\"\nq = 2.0\na_v = 0.2", map);
        assert_eq!(law(&panel), "$\\langle \\mu, 0, 2, 0.2\\rangle$");
    }

    #[test]
    fn numbers_are_as_short_as_one_reads_them() {
        let written = [0.1, 12.0, 0.799_999_999_999_999_9, 1e-4, 2.5e-7, 3e6].map(number);
        assert_eq!(written, ["0.1", "12", "0.8", "10^{-4}", "2.5\\times 10^{-7}", "3\\times 10^{6}"]);
    }
}
