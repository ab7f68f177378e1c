//! Complaints about maps and curves.

use super::{ALGEBRAIC, assert_complaints, complaint};

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
            // v0 must be above 0: the first centres round to 0, the last do not
            (
                "v0 = 3.0\n[uniform]\nheadway = 3.0\n[map]\nvalue = \"growth_rate\"\nx = { parameter = \"mu\", from = 0.1, to = 1.5,",
                "mu = 0.1\n[uniform]\nheadway = 3.0\n[map]\nvalue = \"growth_rate\"\nx = { parameter = \"v0\", from = 0, to = 2e-323,",
                ":9: law.v0 = 0: must be a number > 0.0",
            ),
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
