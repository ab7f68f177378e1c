//! Error messages about scene files: file, line, key, value, and what would be valid.

mod laws;
mod maps;
mod runs;

use files::scene_file::{self, Kind};

/// A run whose lines the messages name.
const RUN: &str = r#"[law]
kind = "logarithmic"
v0 = 1.0
epsilon = 0.01
[ring]
pedestrians = 133
length = 200.0
[start]
shift = 0.1
[run]
t_end = 3000.0
sample = 1.0
method = "dop853"
tolerance = 1e-11
"#;

const ALGEBRAIC: &str = "kind = \"algebraic\"\nmu = 0.5\nq = 2.0\nv0 = 3.0";

/// Reads all panels as the programs do; the first complaint.
fn complaint(text: &str) -> Option<String> {
    let parsed = match scene_file::parse("my.toml", text) {
        Ok(parsed) => parsed,
        Err(error) => return Some(error.to_string()),
    };
    parsed.panels.iter().find_map(|panel| {
        let read = match panel.kind {
            Kind::Run => scene::run::read(&parsed.file, &panel.tables).map(|_| ()),
            Kind::Map => scene::map::read(&parsed.file, &panel.tables).map(|_| ()),
            Kind::Sweep => sweep::read(&parsed.file, &panel.tables).map(|_| ()),
            Kind::Curve => scene::curve::table(&parsed.file, &panel.tables).map(|_| ()),
            Kind::Drawing => Ok(()),
        };
        read.err().map(|error| error.to_string())
    })
}

/// For each case the text with `from` replaced by `to` must bring this message.
fn assert_complaints(text: &str, cases: &[(&str, &str, &str)]) {
    assert_eq!(complaint(text), None);
    for (from, to, message) in cases {
        assert!(text.contains(from), "the test replaces {from}, which is not there");
        let changed = text.replacen(from, to, 1);
        let found = complaint(&changed).unwrap_or_else(|| panic!("no complaint about {to}"));
        assert_eq!(&found, &format!("my.toml{message}"), "for {from} -> {to}");
    }
}

#[test]
fn complaints_about_the_whole_file() {
    let known = "title, source, origin, reads, panel, law, ring, start, run, uniform, map, curve, sweep";
    let tables = "law, ring, start, run, uniform, map, curve, sweep";
    assert_complaints(
        RUN,
        &[
            ("[law]", "size = 3\n[law]", &format!(":1: size: unknown key; known here: {known}")),
            ("[run]", "[ring]\n[run]", ":10: duplicate key: [ring]; each key must occur once"),
            ("[law]", "[laws]", &format!(":1: laws: unknown key; known here: {known}")),
            ("[law]", "title = 3\n[law]", ":1: title: must be a text"),
            ("[law]", "source = 3\n[law]", ":1: source: must be a text"),
            ("[law]", "law = 3\n[rest]", &format!(":2: rest: unknown key; known here: {known}")),
            ("[run]", "[origin]\n\"law.v0\" = 1\n[run]", ":11: origin.law.v0: must be a text"),
            ("[run]", "[panel]\nleft = 1\n[run]", ":11: panel.left: must be a table"),
            (
                "[run]",
                "[panel.left.lay]\nv0 = 1\n[run]",
                &format!(":10: panel.left.lay: unknown key; known here: {tables}"),
            ),
            ("[run]", "[panel.left.law]\nv0 = -1\n[run]", ":11: law.v0 = -1: must be a number > 0.0"),
            (
                "[start]\nshift = 0.1\n",
                "",
                ":1: scene.start is missing; it must be a table; found here: law, ring, run",
            ),
            (
                "[ring]\npedestrians = 133\nlength = 200.0\n",
                "",
                ":1: scene.ring is missing; it must be a table; found here: law, run, start",
            ),
            ("[run]", "[uniform]\nk = 1\n[run]", ":10: scene.uniform: unknown key; known here: law, ring, run, start"),
            (
                "[law]\nkind = \"logarithmic\"\nv0 = 1.0\nepsilon = 0.01",
                "law = 3",
                ":1: scene.law = 3: must be a table",
            ),
        ],
    );
    // the parser's own words follow file and line
    for (from, to, line) in [("v0 = 1.0", "v0 = ", 3), ("v0 = 1.0", "v0 = 1.0\nv0 = 2.0", 4), ("[ring]", "[ring", 5)] {
        let found = complaint(&RUN.replacen(from, to, 1)).expect("not TOML");
        assert!(found.starts_with(&format!("my.toml:{line}: ")) && found.len() > 20, "{found}");
    }
    let parsed = scene_file::parse("my.toml", RUN).expect("a scene");
    let error = parsed.panel("left").expect_err("it has no panels");
    assert_eq!(error.to_string(), "my.toml: no panel left; the scene has main");
}

#[test]
fn a_file_that_is_not_there() {
    let error = scene_file::read(std::path::Path::new("no/such/scene.toml")).expect_err("there is no such file");
    assert!(error.to_string().starts_with("no/such/scene.toml: "), "{error}");
}

#[test]
fn keys_nested_too_deep_are_told_with_their_line() {
    let nested = ".a".repeat(200);
    for text in [format!("title = \"a\"\n\nb{nested} = 1\n{RUN}"), format!("\n\n[b{nested}]\nx = 1\n{RUN}")] {
        let found = complaint(&text).expect("a complaint");
        assert!(found.starts_with("my.toml:3: "), "{found}");
    }
}
