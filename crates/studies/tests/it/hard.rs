//! The hard cases: each statement of the numerical supplement, on the tables of a quick run of the program.

use crate::succeed;
use files::table::Table;
use std::sync::OnceLock;
use studies::hard::rows::Rows;

/// The tables of a quick run, made once for all tests.
fn table(name: &str) -> Rows {
    static MADE: OnceLock<tempfile::TempDir> = OnceLock::new();
    let folder = MADE.get_or_init(|| {
        let folder = tempfile::tempdir().expect("a scratch folder");
        succeed("hard", &["--quick", "--out", folder.path().to_str().expect("UTF-8")]);
        folder
    });
    Rows::read(&folder.path().join(format!("{name}.csv"))).expect("a table of the quick run")
}

/// The numbers of these columns in the rows with these words.
fn numbers(name: &str, words: &[(&str, &str)], columns: &[&str]) -> Vec<Vec<f64>> {
    let table: Table = table(name).select(words, columns).expect("the columns");
    assert!(!table.is_empty(), "{name} {words:?}");
    table.rows().map(<[f64]>::to_vec).collect()
}

#[test]
fn in_the_blow_up_speeds_double_and_the_gap_closes_as_the_square_of_the_time() {
    let throws = numbers("blow_up_cascade", &[], &["n", "remaining", "room", "speed", "speed_ratio", "uncertainty"]);
    assert!(throws.len() > 30);
    for (k, pair) in throws.windows(2).enumerate() {
        // the next is the pedestrian behind
        assert_eq!(pair[1][0], (pair[0][0] + 66.0) % 67.0);
        // what the drive adds in the time between two throws, against a speed that doubles: at most 3 / speed + 1 /
        // speed
        assert!((pair[1][4] - 2.0).abs() < 10.0 / pair[0][3], "throw {k}: {pair:?}");
    }
    // energy in the frame of the one ahead: room = 2 mu^2 / (speed / 2)^2, so room speed^2 = 8 mu^2 = 2.42
    let last = throws.last().expect("a throw");
    assert!((last[2] * last[3] * last[3] / 2.42 - 1.0).abs() < 1e-8, "{last:?}");
    // speed (T* - t) stays the way of about one headway, while both change by 1e9
    for throw in throws.iter().skip(4) {
        assert!((0.5..3.0).contains(&(throw[3] * throw[1])), "{throw:?}");
        assert!(throw[5] < 1e-9, "two methods differ: {throw:?}");
    }
}

#[test]
fn two_methods_bracket_the_blow_up_to_1e_6() {
    let times: Vec<f64> = numbers("blow_up_time", &[], &["t_star"]).concat();
    let (low, high) =
        (times.iter().copied().fold(f64::INFINITY, math::smaller), times.iter().copied().fold(0.0, math::larger));
    println!("T* from {low} to {high}");
    assert!(times.len() > 1 && high - low < 1e-6 && low < 960.872_846_9 + 1e-6 && high > 960.872_846_9 - 1e-6);
}

#[test]
fn every_fixed_step_reports_an_overlap_before_the_blow_up() {
    for method in ode::Method::ALL.into_iter().filter(|m| !m.needs_series()).map(ode::Method::name) {
        let words = [("method", method), ("state", "gaps")];
        let rows = numbers("blow_up_fixed_steps", &words, &["dt", "early", "t", "n", "gap"]);
        let with_event = numbers("blow_up_fixed_steps", &[words[0], words[1], ("event", "overlap")], &["early"]);
        assert_eq!(rows.len(), with_event.len(), "{method}: another event");
        assert_eq!(rows.len(), 4, "{method}: a run without an event");
        assert!(rows.iter().all(|row| row[1] > 0.0 && row[3] < 67.0), "{method}: {rows:?}");
        // finer steps follow the cascade further; not every single time, since a step may just meet a wall or miss it
        assert!(rows[3][1] < 0.6 * rows[0][1], "{method}: {rows:?}");
    }
}

#[test]
fn rooms_that_go_to_zero_are_resolved_or_reported() {
    for method in ode::Method::ALL {
        let words = [("method", method.name()), ("rule", "tolerance")];
        if method.is_adaptive() {
            for row in numbers("near_contact", &words, &["size", "error", "speed"]) {
                // a local error of the tolerance in each of at most some hundred steps, magnified by the wall by the
                // ratio of the time scales, speed / room
                assert!(row[1] < row[0] * 1e5, "{}: {row:?}", method.name());
            }
        }
    }
    // steps of 0.01 at a speed of 8 and a room of 0.012: the first orders go through the wall, and say so
    for method in ["euler", "ballistic", "heun"] {
        let words = [("method", method), ("rule", "dt"), ("event", "overlap")];
        let reports = numbers("near_contact", &words, &["speed", "size", "t", "n", "gap"]);
        assert!(reports.iter().any(|row| row[0] == 8.0 && row[1] == 0.01 && row[3] == 0.0), "{method}: {reports:?}");
    }
}

#[test]
fn orders_fall_to_two_at_the_kink() {
    for (method, wide) in [("euler", 1.0), ("ballistic", 1.0), ("heun", 2.0), ("rk4", 4.0)] {
        let rows = numbers("kink_orders", &[("method", method)], &["epsilon", "order", "uncertainty"]);
        let order = |epsilon: f64| rows.iter().find(|row| row[0] == epsilon).expect("a row")[1];
        assert!((order(1e-1) - wide).abs() < 0.2, "{method}: {rows:?}");
        // a kink inside a step leaves an error of the square of the step, whatever the formal order
        let sharp = math::smaller(wide, 2.0);
        assert!((order(1e-6) - sharp).abs() < 0.5, "{method}: {rows:?}");
    }
}

#[test]
fn the_smooth_ramp_is_right_up_to_1e5_widths() {
    for row in numbers("ramp_range", &[], &["relative_error", "allowed", "from", "to"]) {
        assert!(row[0] <= row[1], "{row:?}");
    }
}

#[test]
fn collisions_from_inertia_are_located_to_1e_9() {
    let collisions = numbers("stiffness", &[], &["v0", "overlap_t", "uncertainty"]);
    assert!(collisions.iter().any(|row| row[0] == 10.0), "{collisions:?}");
    assert!(collisions.iter().all(|row| row[2] < 1e-9), "{collisions:?}");
    // at v0 = 1 nobody collides
    assert!(collisions.iter().all(|row| row[0] > 1.0), "{collisions:?}");
}

#[test]
fn waves_at_the_edge_grow_as_computed() {
    for row in numbers("marginal", &[], &["factor", "exact", "measured", "other_method"]) {
        // the tolerance of 1e-15 in each of some hundred steps, over a time of 200
        assert!((row[2] - row[1]).abs() < 1e-14 && (row[3] - row[1]).abs() < 1e-14, "{row:?}");
        // at the edge itself the rate is rounding
        let is_right = if row[0] == 1.0 { row[1].abs() < 1e-16 } else { (row[1] > 0.0) == (row[0] > 1.0) };
        assert!(is_right, "{row:?}");
    }
    for row in numbers("marginal_threshold", &[], &["n", "mu_cr", "found"]) {
        assert!((row[2] - row[1]).abs() < 1e-12, "{row:?}");
        // 0.5 / cos(pi / N) = 0.5 + (pi / N)^2 / 4 + ...
        let off = (row[1] - 0.5) * row[0] * row[0];
        assert!((off / 2.467_401_1 - 1.0).abs() < 10.0 / (row[0] * row[0]), "{row:?}");
    }
}

#[test]
fn long_runs_keep_the_length_and_the_mean_speed() {
    for row in numbers("long_run", &[], &["steps", "sum_minus_length", "mean_speed_minus_other", "size"]) {
        // ten gaps, each rounded in every step to half a unit of 4
        assert!(row[1].abs() < row[0] * 10.0 * 4.0 * f64::EPSILON, "{row:?}");
        assert!(row[2].abs() < 1e-3, "{row:?}");
    }
}

#[test]
fn nobody_knows_the_size_of_the_ring_in_a_short_time() {
    let rows = numbers("sizes", &[], &["n", "difference_from_1000", "sum_minus_length"]);
    for row in &rows {
        // rounding of gaps of 3 in some ten steps, and what the force makes of it in one unit of time
        assert!(row[0] < 20.0 || row[1] < 1e-13, "{row:?}");
        assert!(row[2].abs() < 1e-12 * row[0], "{row:?}");
    }
    assert!(rows.iter().any(|row| row[0] == 2.0) && rows.iter().any(|row| row[0] == 10_000.0));
}

#[test]
fn widening_of_one_or_more_is_stable_whatever_the_force() {
    let rows = numbers("widening", &[], &["a_v", "strength", "long_wave_margin", "growth_rate"]);
    assert!(rows.iter().all(|row| row[0] < 1.0 || row[2] <= -1.0 + 1e-12 && row[3] < 0.0), "{rows:?}");
    // below 1 there is a strength that makes waves grow
    for a_v in [0.0, 0.5, 0.9] {
        assert!(rows.iter().any(|row| row[0] == a_v && row[3] > 0.0), "{a_v}");
    }
    // walking backwards makes room, where the law is a function of the room
    let backwards = numbers("widening_run", &[], &["start_speed", "least_speed_at_10"]);
    assert_eq!(backwards.len(), 6);
}

#[test]
fn cfm_loses_its_force_with_the_width_of_the_ramp() {
    for row in numbers("cfm", &[("event", "none")], &["epsilon", "deficit", "deficit_expected", "uncertainty"]) {
        // speeds of 3 are rounded to half a unit
        assert!((row[1] - row[2]).abs() < 4.0 * f64::EPSILON, "{row:?}");
        assert!(row[3] < 1e-8, "{row:?}");
    }
}

#[test]
fn the_smallest_perturbations_keep_their_digits_and_none_stays_none() {
    for state in ["deviations", "gaps"] {
        for row in numbers("tiny", &[("state", state)], &["shift", "gap_range", "speed_range"]) {
            assert!(row[0] > 0.0 || row[1] == 0.0 && row[2] == 0.0, "{state}: {row:?}");
        }
    }
    for law in ["algebraic", "exponential", "logarithmic"] {
        for method in ode::Method::ALL.map(ode::Method::name) {
            let words = [("law", law), ("method", method), ("state", "deviations")];
            let rows = numbers("tiny", &words, &["shift", "deviation_per_shift"]);
            let [one, other] = [1e-300, 1e-160].map(|s| rows.iter().find(|row| row[0] == s).expect("a row")[1]);
            // linear: only the rounding of the least of 1e-300 times 1e-8 and smaller is another
            assert!((one / other - 1.0).abs() < 1e-6, "{law} {method}: {one} {other}");
        }
    }
}
