//! Complaints about laws and formulas.

use super::{ALGEBRAIC, RUN, assert_complaints};

#[test]
fn complaints_about_laws() {
    assert_complaints(
        RUN,
        &[
            (
                "\"logarithmic\"",
                "\"loud\"",
                ":2: law.kind = \"loud\": must be one of algebraic, exponential, logarithmic, formula",
            ),
            ("\"logarithmic\"", "3", ":2: law.kind = 3: must be one of algebraic, exponential, logarithmic, formula"),
            (
                "kind = \"logarithmic\"\n",
                "",
                ":1: law.kind is missing; it must be one of algebraic, exponential, logarithmic, formula; found here: epsilon, v0",
            ),
            ("v0 = 1.0", "v0 = \"fast\"", ":3: law.v0 = \"fast\": must be a number > 0.0"),
            ("v0 = 1.0", "v0 = true", ":3: law.v0 = a value of type boolean: must be a number > 0.0"),
            ("v0 = 1.0", "v0 = [1.0]", ":3: law.v0 = a value of type array: must be a number > 0.0"),
            ("v0 = 1.0", "v0 = { is = 1.0 }", ":3: law.v0 = a table: must be a number > 0.0"),
            ("v0 = 1.0", "v0 = 0.0", ":3: law.v0 = 0: must be a number > 0.0"),
            ("v0 = 1.0", "v0 = nan", ":3: law.v0 = NaN: must be a number > 0.0"),
            ("v0 = 1.0", "v0 = inf", ":3: law.v0 = inf: must be a number > 0.0"),
            ("v0 = 1.0", "v0 = -1e400", ":3: law.v0 = -inf: must be a number > 0.0"),
            ("v0 = 1.0\n", "", ":1: law.v0 is missing; it must be a number > 0.0; found here: epsilon, kind"),
            ("epsilon = 0.01", "epsilon = -0.01", ":4: law.epsilon = -0.01: must be a number > 0.0"),
            ("epsilon = 0.01", "epsilon = 0.01\na_v = -1", ":5: law.a_v = -1: must be a number >= 0.0"),
            ("epsilon = 0.01", "epsilon = 0.01\nmu = 1", ":5: law.mu: unknown key; known here: a_v, epsilon, kind, v0"),
        ],
    );
}

#[test]
fn complaints_about_algebraic_laws_and_presets() {
    let text = RUN.replacen("kind = \"logarithmic\"\nv0 = 1.0", ALGEBRAIC, 1).replacen("133", "67", 1);
    let all = "a_v, delta, epsilon, kind, mu, preset, q, v0";
    assert_complaints(
        &text,
        &[
            ("mu = 0.5", "mu = -0.5", ":3: law.mu = -0.5: must be a number >= 0.0"),
            ("q = 2.0", "q = 0", ":4: law.q = 0: must be a number > 0.0"),
            ("q = 2.0\n", "", ":1: law.q is missing; it must be a number > 0.0; found here: epsilon, kind, mu, v0"),
            (
                "mu = 0.5",
                "m = 0.5",
                ":1: law.mu is missing; it must be a number >= 0.0; found here: epsilon, kind, m, q, v0",
            ),
            ("mu = 0.5", "mu = 0.5\nb = 1", &format!(":4: law.b: unknown key; known here: {all}")),
            (
                "mu = 0.5\nq = 2.0",
                "preset = \"XYZ\"",
                ":3: law.preset = \"XYZ\": must be one of CFM, GCFM, HFV, SEY, GUO",
            ),
            (
                "mu = 0.5\nq = 2.0",
                "preset = \"SEY\"\nmu = 0.5",
                ":1: law.a_v is missing; it must be a number >= 0.0; found here: epsilon, kind, mu, preset, v0",
            ),
            (
                "mu = 0.5\nq = 2.0",
                "preset = \"HFV\"\nmu = 0.5\na_v = 0.1",
                ":5: law.a_v: unknown key; known here: epsilon, kind, mu, preset, v0",
            ),
            (
                "mu = 0.5\nq = 2.0",
                "preset = \"HFV\"\nmu = 0.5\nq = 2.0",
                ":5: law.q: unknown key; known here: epsilon, kind, mu, preset, v0",
            ),
        ],
    );
}

#[test]
fn complaints_about_exponential_laws() {
    let law = "kind = \"exponential\"\na = 1.5\nb = 1.5\nv0 = 3.0";
    let text = RUN.replacen("kind = \"logarithmic\"\nv0 = 1.0", law, 1).replacen("133", "57", 1);
    assert_complaints(
        &text,
        &[
            ("a = 1.5", "a = -1.5", ":3: law.a = -1.5: must be a number >= 0.0"),
            ("\nb = 1.5", "\nb = 0.0", ":4: law.b = 0: must be a number > 0.0"),
            ("\nb = 1.5", "\nb = 1.5\nc = -1", ":5: law.c = -1: must be a number >= 0.0"),
            ("a = 1.5", "q = 1.5\na = 1.5", ":3: law.q: unknown key; known here: a, a_v, b, c, epsilon, kind, v0"),
        ],
    );
}

/// Of a formula the complaint names the expression, in a file by its line, of values that a program gives by their key
/// alone.
#[test]
fn complaints_about_formulas_name_the_expression() {
    use files::reader::{Entry, Section, Value};
    let text = "[law]\nkind = \"formula\"\nacceleration = \"V - v\"\nV = \"tanh(s - c)\"\nbody = 0.0\n";
    let mut section = Section::parse("my.toml", text).expect("TOML");
    let law = |section: &Section| {
        let error = scene::law::read("my.toml", section.section("law").expect("[law]")).expect_err("c has no value");
        (error.line, error.about.expect("about a key").key)
    };
    assert_eq!(law(&section), (4, "law.V".to_owned()));
    let mut given = Section::default();
    let words = |text: &str| Value::Text(text.to_owned());
    let values = [words("formula"), words("V - v"), words("tanh(s - c)"), Value::Number(0.0)];
    for (index, (key, value)) in ["kind", "acceleration", "V", "body"].iter().zip(values).enumerate() {
        given.entries.insert((*key).to_owned(), Entry::given(index, value));
    }
    section.entries.insert("law".to_owned(), Entry::given(9, Value::Section(given)));
    assert_eq!(law(&section), (0, "law.V".to_owned()));
}
