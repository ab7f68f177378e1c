//! Error against work: a quick run against the committed tables, and relations that both must satisfy.

use crate::{root, succeed};
use math::double_double::DoubleDouble;
use std::path::PathBuf;
use studies::hard::rows::Rows;
use studies::precision::scenes::SCENES;

fn committed(scene: &str) -> PathBuf {
    root().join(format!("data/accuracy/precision_{scene}.csv"))
}

#[test]
fn quick_rows_are_those_of_the_committed_tables() {
    let folder = tempfile::tempdir().expect("a scratch folder");
    succeed("precision", &["--quick", "--out", folder.path().to_str().expect("UTF-8")]);
    for scene in SCENES.map(|known| known.name) {
        let quick = std::fs::read_to_string(folder.path().join(format!("precision_{scene}.csv"))).expect("a table");
        let all = std::fs::read_to_string(committed(scene)).expect("a committed table");
        assert!(quick.lines().count() > 10, "{scene}");
        for line in quick.lines() {
            assert!(all.lines().any(|other| other == line), "{scene}: {line}");
        }
    }
}

#[test]
fn an_error_stays_the_share_of_the_perturbation_that_it_was_made_as() {
    // the error of a step is at most the tolerance times the perturbation then (of the uniform flow's speed, times that
    // speed), and grows as the perturbation does; where jams form and dissolve a neighbour of the solution may grow
    // faster than the solution itself for a while
    const FASTER: f64 = 30.0;
    for known in SCENES {
        let figures = root().join("figures");
        let ring = known.scene(&figures, &[]).expect("a scene").ring;
        let headway = DoubleDouble::from(ring.length) / DoubleDouble::from(ring.pedestrians as f64);
        let solution = known.solution(&root().join("data/reference/solutions"), headway).expect("a solution");
        let largest = |numbers: &[f64]| numbers.iter().fold(0.0, |most, number| math::larger(most, number.abs()));
        let gaps = solution.iter().map(|instant| largest(&instant.gaps)).fold(0.0, math::larger);
        let speed =
            solution.iter().flat_map(|instant| &instant.speeds).map(|speed| speed.hi.abs()).fold(0.0, math::larger);
        let rows = Rows::read(&committed(known.name)).expect("a committed table");
        let columns = ["control", "steps", "error_gap", "error_speed"];
        let runs = rows.select(&[("method", "dop853")], &columns).expect("the columns");
        let run = runs.rows().find(|run| run[0] == 1e-12).expect("a run at 1e-12");
        let share = FASTER * 1e-12 * run[1];
        assert!(run[2] <= share * gaps, "{}: gaps up to {gaps}: {run:?}", known.name);
        assert!(run[3] <= share * (gaps + speed), "{}: speeds up to {speed}: {run:?}", known.name);
    }
}

#[test]
fn errors_of_fixed_steps_fall_as_their_order_says() {
    for (method, order) in [("euler", 1.0), ("ballistic", 1.0), ("heun", 2.0), ("rk4", 4.0)] {
        let rows = Rows::read(&committed("algebraic_stable")).expect("a committed table");
        let runs = rows.select(&[("method", method)], &["control", "error_gap"]).expect("the columns");
        let fine: Vec<&[f64]> = runs.rows().filter(|run| run[0] < 0.05 && run[0] > 0.005).collect();
        assert_eq!(fine.len(), 3, "{method}");
        // halved steps: the next term of the expansion is smaller by the step, 1/32, times a constant of order one
        for pair in fine.windows(2) {
            let measured = math::ln(pair[0][1] / pair[1][1]) / std::f64::consts::LN_2;
            assert!((measured - order).abs() < 0.1, "{method}: {measured} at {pair:?}");
        }
    }
}
