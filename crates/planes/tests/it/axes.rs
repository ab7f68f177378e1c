//! Axes that a plane cannot have are refused.

use super::*;

#[test]
fn axes_that_are_no_parameters_are_named_with_what_is_valid() {
    let scene = small();
    let x = "x = { parameter = \"a_v\", from = 0.0, to = 0.6, cells = 30 }";
    let axis = |text: &str| replace(&scene, x, text);
    let cases = [
        (
            axis("x = { parameter = \"av\", from = 0.0, to = 0.6, cells = 30 }"),
            vec!["sweep.x.parameter", "av", "a_v", "v0", "epsilon", "headway"],
        ),
        (
            axis("x = { parameter = \"mu\", from = 0.0, to = 0.6, cells = 30 }"),
            vec!["sweep.x.parameter", "mu", "logarithmic", "a_v"],
        ),
        (axis("x = { parameter = \"k\", from = 0.0, to = 0.6, cells = 30 }"), vec!["sweep.x.parameter", "shift"]),
        (axis("x = { parameter = \"kind\", from = 0.0, to = 0.6, cells = 30 }"), vec!["sweep.x.parameter", "a_v"]),
        (axis("x = { parameter = \"d_gap\", from = 0.1, to = 0.6, cells = 30 }"), vec!["sweep.x.parameter", "headway"]),
        (axis("x = { parameter = \"v0\", from = 0.1, to = 0.6, cells = 30 }"), vec!["sweep.y.parameter"]),
        (
            replace(
                &axis("x = { parameter = \"epsilon\", from = -1.0, to = 0.5, cells = 3 }"),
                "epsilon = 0.01",
                "a_v = 0.1",
            ),
            vec![":15:", "sweep.x.from = -1:", "epsilon", ">= 0"],
        ),
        // v0 must be above 0: the first centres round to 0, the last do not
        (
            replace(&scene, "from = 0.5, to = 3.0, cells = 30", "from = 0.0, to = 2e-323, cells = 30"),
            vec![":16:", "law.v0 = 0", "> 0.0"],
        ),
        (axis("x = { parameter = \"a_v\", from = 0.6, to = 0.6, cells = 30 }"), vec!["sweep.x.to", "0.6"]),
        (axis("x = { parameter = \"a_v\", from = 0.0, to = nan, cells = 30 }"), vec!["sweep.x.to"]),
        (axis("x = { parameter = \"a_v\", from = 0.0, to = 0.6, cells = 0 }"), vec!["sweep.x.cells", "1"]),
        (
            axis("x = { parameter = \"a_v\", from = 0.0, to = 0.6, cells = 30, scale = \"log\" }"),
            vec!["sweep.x.from", "> 0"],
        ),
        (
            axis("x = { parameter = \"a_v\", from = 0.0, to = 0.6, cells = 30, step = 1 }"),
            vec!["sweep.x.step", "unknown"],
        ),
        (axis("x = { parameter = \"pedestrians\", from = 1.0, to = 9.0, cells = 30 }"), vec!["sweep.x.from", "2"]),
        (
            axis("x = { parameter = \"pedestrians\", from = 2.0, to = 1e300, cells = 30 }"),
            vec!["sweep.x.to", "<= 10000000"],
        ),
        (
            axis("value = \"margin\"\nx = { parameter = \"a_v\", from = 0.0, to = 0.6, cells = 30 }"),
            vec!["sweep.value", "outcome"],
        ),
        (replace(&scene, "epsilon = 0.01", "epsilon = 0.01\na_v = 0.1"), vec!["law.a_v", "axis"]),
        (axis("x = { parameter = \"shift\", from = 0.0, to = 0.6, cells = 30 }"), vec!["start.shift", "axis"]),
        (axis("x = { parameter = \"headway\", from = 1.0, to = 2.0, cells = 30 }"), vec!["ring.length", "axis"]),
        (replace(&scene, "t_end     = 60.0", "t_end     = 60.0\nsample = 1.0"), vec!["run.sample"]),
        (replace(&scene, "t_end     = 60.0", "t_end     = 60.0\nat_overlap = \"continue\""), vec!["run.at_overlap"]),
        (replace(&scene, "[sweep]", "[uniform]\nd_gap = 1.0\n[sweep]"), vec!["uniform.d_gap", "headway"]),
        (replace(&scene, "[sweep]", "[swept]"), vec!["swept"]),
    ];
    for (scene, told) in cases {
        let place = SceneFolder::new(&scene);
        let told: Vec<&str> = ["scene.toml:"].into_iter().chain(told).collect();
        place.fail("out", &[], 2, &told);
        assert!(!place.path("out").exists(), "{told:?}");
    }
}
