//! Complaints about the ring, its start and the run.

use super::{ALGEBRAIC, RUN, assert_complaints, complaint};
use ode::Method;

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
