//! Error messages about scene files: file, line, key, value, and what would be valid.

use files::scene_file::{self, Kind};
use ode::Method;

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

const MAP: &str = r#"[law]
kind = "algebraic"
q = 2.0
v0 = 3.0
[uniform]
headway = 3.0
[map]
value = "growth_rate"
x = { parameter = "mu", from = 0.1, to = 1.5, cells = 20 }
y = { parameter = "k", from = 0.0, to = 3.0, cells = 20 }
"#;

const CURVE: &str = r#"[curve]
value = "ramp"
from = -1.0
to = 1.0
points = 5
epsilon = 0.1
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

#[test]
fn complaints_about_the_ring_and_its_start() {
    let count = "must be a whole number from 2 to 10000000";
    assert_complaints(
        RUN,
        &[
            ("= 133", "= 0", &format!(":6: ring.pedestrians = 0: {count}")),
            ("= 133", "= 1", &format!(":6: ring.pedestrians = 1: {count}")),
            ("= 133", "= 2.5", &format!(":6: ring.pedestrians = 2.5: {count}")),
            ("= 133", "= -3", &format!(":6: ring.pedestrians = -3: {count}")),
            ("= 133", "= nan", &format!(":6: ring.pedestrians = NaN: {count}")),
            ("= 133", "= 10000001", &format!(":6: ring.pedestrians = 10000001: {count}")),
            ("= 133", "= 99999999999999999999", ":6: 99999999999999999999 is not a number that fits"),
            ("length = 200.0", "length = -200.0", ":7: ring.length = -200: must be a number > 0.0"),
            ("length = 200.0", "length = inf", ":7: ring.length = inf: must be a number > 0.0"),
            (
                "length = 200.0",
                "radius = 200.0",
                ":5: ring.length is missing; it must be a number > 0.0; found here: pedestrians, radius",
            ),
            (
                "length = 200.0",
                "length = 200.0\nwidth = 1",
                ":8: ring.width: unknown key; known here: length, pedestrians",
            ),
            (
                "shift = 0.1",
                "shift = 1.6",
                ":9: start.shift = 1.6: closes a gap at the start; must be between -1.5037593984962405 and 1.5037593984962405",
            ),
            ("shift = 0.1", "shift = \"little\"", ":9: start.shift = \"little\": must be a finite number"),
            ("shift = 0.1", "shift = nan", ":9: start.shift = NaN: must be a finite number"),
            ("shift = 0.1", "", ":8: start.shift is missing; it must be a finite number"),
            ("shift = 0.1", "shift = 0.1\nspeed = 1.0", ":10: start.speed: unknown key; known here: shift"),
        ],
    );
}

#[test]
fn complaints_about_closed_gaps_and_flows_that_do_not_exist() {
    let algebraic = RUN.replacen("kind = \"logarithmic\"\nv0 = 1.0", ALGEBRAIC, 1).replacen("133", "64", 1);
    assert_complaints(
        &algebraic,
        &[
            (
                "= 64",
                "= 100",
                ":9: ring.length = 200: the effective gaps are closed at the start: L/N = 2.0 leaves 0.0; the length must be above 200.0",
            ),
            (
                "= 64",
                "= 128",
                ":9: ring.length = 200: the effective gaps are closed at the start: L/N = 1.5625 leaves -0.4375; the length must be above 256.0",
            ),
            (
                "shift = 0.1",
                "shift = -1.25",
                ":11: start.shift = -1.25: closes a gap at the start; must be between -1.125 and 1.125",
            ),
        ],
    );
    // a soft force that lets fast, wide pedestrians overlap: there is room only at lower speeds
    let exponential = RUN
        .replacen("kind = \"logarithmic\"\nv0 = 1.0", "kind = \"exponential\"\na = 0.1\nb = 1\nv0 = 3.0\na_v = 0.0", 1)
        .replacen("133", "64", 1);
    assert_complaints(
        &exponential,
        &[(
            "a_v = 0.0",
            "a_v = 0.5",
            ":10: ring.length = 200: no uniform flow at headway L/N = 3.125: at no speed from -1e12 v_0 to v_0 does the drive balance the force at a positive gap; a longer ring, fewer pedestrians or a weaker force has a uniform flow",
        )],
    );
}

#[test]
fn complaints_about_the_run() {
    let methods = Method::ALL.map(Method::name).join(", ");
    assert_complaints(
        RUN,
        &[
            ("t_end = 3000.0", "t_end = 0", ":11: run.t_end = 0: must be a number > 0.0"),
            (
                "t_end = 3000.0\n",
                "",
                ":10: run.t_end is missing; it must be a number > 0.0; found here: method, sample, tolerance",
            ),
            ("sample = 1.0", "sample = -1.0", ":12: run.sample = -1: must be a number > 0.0"),
            (
                "sample = 1.0",
                "sample = 1e-4",
                ":12: run.sample = 0.0001: gives a table of 3.99e9 rows, more than 2e7; sample less often, or record = \"std\"",
            ),
            ("\"dop853\"", "\"verlet\"", &format!(":13: run.method = \"verlet\": must be one of {methods}")),
            (
                "tolerance = 1e-11",
                "tolerance = 1e-16",
                ":14: run.tolerance = 1e-16: must be a number >= 1e-15 and <= 0.01",
            ),
            ("tolerance = 1e-11", "tolerance = 0.1", ":14: run.tolerance = 0.1: must be a number >= 1e-15 and <= 0.01"),
            ("tolerance = 1e-11", "dt = 0.0", ":14: run.dt = 0: must be a number > 0.0"),
            ("tolerance = 1e-11", "dt = 1.0\nmost_steps = 2999", ":14: run.dt = 1: gives 3e3 steps; at most 2.999e3"),
            (
                "tolerance = 1e-11",
                "tolerance = 1e-11\nmost_steps = 0",
                ":15: run.most_steps = 0: must be a number >= 1.0 and <= 100000000000.0",
            ),
            ("tolerance = 1e-11", "dt = 1e-300", ":14: run.dt = 1e-300: gives 3e303 steps; at most 1e11"),
            (
                "tolerance = 1e-11",
                "tolerance = 1e-11\ndt = 0.1",
                ":15: run.dt = 0.1: give either dt or tolerance, not both",
            ),
            (
                "\"dop853\"",
                "\"heun\"",
                ":14: run.tolerance = 1e-11: heun has no error estimate and needs dt, the length of its steps",
            ),
            (
                "tolerance = 1e-11",
                "tolerance = 1e-11\nstate = \"angles\"",
                ":15: run.state = \"angles\": must be one of deviations, gaps, positions",
            ),
            (
                "tolerance = 1e-11",
                "tolerance = 1e-11\nrecord = \"all\"",
                ":15: run.record = \"all\": must be one of std, trajectories",
            ),
            (
                "tolerance = 1e-11",
                "tolerance = 1e-11\nthreads = 2",
                ":15: run.threads: unknown key; known here: at_overlap, dt, method, most_steps, record, sample, state, t_end, tolerance",
            ),
        ],
    );
}

#[test]
fn what_is_just_allowed_is_allowed() {
    // as many steps as may be
    let steps = RUN.replacen("tolerance = 1e-11", "dt = 1.0\nmost_steps = 3000", 1);
    assert_eq!(complaint(&steps), None);
    // exactly 20 million rows
    let rows = RUN.replacen("133", "100", 1).replacen("3000.0", "200000.0", 1);
    assert_eq!(complaint(&rows), None);
    let more = rows.replacen("200000.0", "200001.0", 1);
    assert!(complaint(&more).is_some_and(|words| words.contains("2.00001e7 rows, more than 2e7")), "{more}");
}

#[test]
fn complaints_about_the_whole_file() {
    let known = "title, source, origin, reads, panel, law, ring, start, run, uniform, map, curve, sweep";
    let tables = "law, ring, start, run, uniform, map, curve, sweep";
    assert_complaints(
        RUN,
        &[
            ("[law]", "size = 3\n[law]", &format!(":1: size: unknown key; known here: {known}")),
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
fn complaints_about_maps() {
    let parameters = "mu, delta, q, a_v, epsilon, v0, d_gap, headway, k";
    assert_complaints(
        MAP,
        &[
            (
                "\"growth_rate\"",
                "\"speed\"",
                ":8: map.value = \"speed\": must be one of margin, criterion, growth_rate",
            ),
            (
                "\"mu\"",
                "\"nu\"",
                &format!(
                    ":9: map.x.parameter = \"nu\": the algebraic law has no parameter nu; an axis can be {parameters}"
                ),
            ),
            ("from = 0.1", "from = -0.1", ":9: map.x.from = -0.1: mu cannot be negative; must be a number >= 0.0"),
            ("to = 1.5", "to = 0.1", ":9: map.x.to = 0.1: must be above from = 0.1"),
            ("cells = 20", "cells = 0", ":9: map.x.cells = 0: must be a whole number from 1 to 2000"),
            (
                "to = 1.5, cells = 20",
                "to = 1.5",
                ":9: map.x.cells is missing; it must be a whole number from 1 to 2000; found here: from, parameter, to",
            ),
            (
                "cells = 20",
                "cells = 20, steps = 3",
                ":9: map.x.steps: unknown key; known here: cells, from, parameter, to",
            ),
            ("[map]", "[map]\ncolour = 1", ":8: map.colour: unknown key; known here: value, x, y"),
            ("\"k\"", "\"mu\"", ":10: map.y.parameter = \"mu\": is the other axis as well"),
            ("q = 2.0", "q = 2.0\nmu = 1.0", ":4: law.mu = 1: is an axis of the map (map.x): leave it out here"),
            (
                "\"growth_rate\"",
                "\"criterion\"",
                ":7: scene.map = a table: the criterion is one for all waves: leave out k, or choose growth_rate",
            ),
            ("\"k\"", "\"delta\"", ":7: scene.map = a table: growth_rate needs a wave number: an axis k, or uniform.k"),
            (
                "headway = 3.0",
                "",
                ":7: scene.map = a table: needs the uniform flow: uniform.headway or uniform.d_gap, or an axis of it",
            ),
            (
                "headway = 3.0",
                "headway = 3.0\nd_gap = 1.0",
                ":8: scene.map = a table: headway and d_gap determine each other: give one of them",
            ),
            ("headway = 3.0", "headway = -3.0", ":6: uniform.headway = -3: must be a number > 0.0"),
            ("headway = 3.0", "headway = 3.0\nk = 0", ":7: uniform.k = 0: must be a number > 0.0"),
            (
                "headway = 3.0",
                "distance = 3.0",
                ":6: uniform.distance: unknown key; known here: d_gap, headway, k, speed",
            ),
            (
                "\"mu\"",
                "\"a\"",
                ":9: map.x.parameter = \"a\": the algebraic law has no parameter a; an axis can be mu, delta, q, a_v, epsilon, v0, d_gap, headway, k",
            ),
            (
                "kind = \"algebraic\"\nq = 2.0",
                "kind = \"logarithmic\"\nepsilon = 0.01",
                ":9: map.x.parameter = \"mu\": the logarithmic law has no parameter mu; an axis can be a_v, epsilon, v0, d_gap, headway, k",
            ),
            (
                "kind = \"algebraic\"\nq = 2.0",
                "kind = \"exponential\"\na = 3.0\nb = 1.5",
                ":10: map.x.parameter = \"mu\": the exponential law has no parameter mu; an axis can be a, b, c, a_v, epsilon, v0, d_gap, headway, k",
            ),
        ],
    );
    let logarithmic = MAP
        .replacen("kind = \"algebraic\"\nq = 2.0", "kind = \"logarithmic\"\nepsilon = 0.01", 1)
        .replacen("\"mu\"", "\"a_v\"", 1);
    assert_complaints(
        &logarithmic,
        &[(
            "headway = 3.0",
            "d_gap = 3.0",
            ":7: scene.map = a table: the logarithmic law needs the headway, not d_gap",
        )],
    );
}

#[test]
fn complaints_about_curves() {
    assert_complaints(
        CURVE,
        &[
            ("\"ramp\"", "\"line\"", ":2: curve.value = \"line\": must be one of ramp, force"),
            ("points = 5", "points = 1", ":5: curve.points = 1: must be a whole number from 2 to 1000000"),
            ("to = 1.0", "to = -1.0", ":4: curve.to = -1: must be above from = -1.0"),
            ("from = -1.0", "from = -inf", ":3: curve.from = -inf: must be a finite number"),
            ("epsilon = 0.1", "epsilon = 0", ":6: curve.epsilon = 0: must be a number > 0.0"),
            (
                "epsilon = 0.1",
                "",
                ":1: curve.epsilon is missing; it must be a number > 0.0; found here: from, points, to, value",
            ),
            ("\"ramp\"", "\"force\"", ":1: scene.law is missing; it must be a table; found here: curve"),
            (
                "epsilon = 0.1",
                "epsilon = 0.1\nstep = 1",
                ":7: curve.step: unknown key; known here: epsilon, from, points, to, value",
            ),
        ],
    );
    let force = CURVE.replace("ramp", "force").replace("epsilon = 0.1\n", "");
    let law = format!("[law]\n{}\n", ALGEBRAIC.replace("q = 2.0", "q = 2.5"));
    assert_eq!(
        complaint(&format!("{force}{law}")).expect("no force behind the wall"),
        "my.toml:2: curve.value = \"force\": there is no finite force at -1.0; leave it out, between from and to"
    );
    assert_eq!(complaint(&format!("{}{law}", force.replace("-1.0", "2.5").replace("to = 1.0", "to = 9.0"))), None);
}

#[test]
fn a_file_that_is_not_there() {
    let error = scene_file::read(std::path::Path::new("no/such/scene.toml")).expect_err("there is no such file");
    assert!(error.to_string().starts_with("no/such/scene.toml: "), "{error}");
}

/// Of a formula the complaint names the expression, in a file by its line, of values that a program gives by their key alone.
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
