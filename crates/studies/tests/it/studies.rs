//! Studies of errors: a quick run reproduces rows of the committed tables, and the tables support the numerical
//! supplement.

use crate::{root, succeed};
use files::table::Table;
use std::path::Path;
use studies::hard::rows::Rows;

/// The committed table.
fn table(name: &str) -> Rows {
    Rows::read(&root().join(format!("data/accuracy/{name}.csv"))).expect("a committed table")
}

/// The numbers of these columns in the rows with these words.
fn numbers(name: &str, words: &[(&str, &str)], columns: &[&str]) -> Vec<Vec<f64>> {
    let table: Table = table(name).select(words, columns).expect("the columns");
    assert!(!table.is_empty(), "{name} {words:?}");
    table.rows().map(<[f64]>::to_vec).collect()
}

fn lines(file: &Path) -> Vec<String> {
    std::fs::read_to_string(file).expect("a table").lines().map(str::to_owned).collect()
}

#[test]
fn rows_of_a_quick_run_are_rows_of_the_committed_tables() {
    let folder = tempfile::tempdir().expect("a scratch folder");
    succeed("studies", &["--quick", "--out", folder.path().to_str().expect("UTF-8")]);
    let mut compared = 0;
    for entry in std::fs::read_dir(folder.path()).expect("the tables") {
        let file = entry.expect("a table").path();
        let committed = lines(&root().join("data/accuracy").join(file.file_name().expect("a name")));
        for line in lines(&file) {
            assert!(committed.contains(&line), "{}: {line}", file.display());
            compared += 1;
        }
    }
    assert!(compared > 100, "{compared} rows");
}

#[test]
fn every_wave_of_the_rings_grows_as_computed() {
    for (law, waves) in [("algebraic", 33), ("exponential", 28), ("logarithmic", 66)] {
        for flow in ["stable", "unstable"] {
            let rows = numbers(&format!("mode_growth_{law}"), &[("flow", flow)], &["l", "exact", "residual"]);
            assert_eq!(rows.len(), waves);
            for row in &rows {
                // 1e-14 of the wave in each step, and steps of half a unit of time or longer
                assert!(row[2].abs() < 2e-14, "{law} {flow}: {row:?}");
            }
            assert_eq!(rows.iter().any(|row| row[1] > 0.0), flow == "unstable", "{law}");
        }
    }
}

/// Errors and parts of them at `t = 1000`, by rising number of steps.
fn rounding(state: &str, sum: &str) -> Vec<Vec<f64>> {
    let columns = ["t", "dt", "error_gap", "truncation_gap", "rounding_gap", "rounding_std"];
    let rows = numbers("rounding", &[("state", state), ("sum", sum)], &columns);
    rows.into_iter().filter(|row| row[0] == 1000.0).collect()
}

#[test]
fn truncation_falls_as_the_square_of_the_step() {
    for pair in rounding("deviations", "plain").windows(2) {
        let order = math::ln(pair[0][3] / pair[1][3]) / math::ln(pair[0][1] / pair[1][1]);
        // the next term is of the relative size of the step, with a factor of the size of 1
        assert!((order - 2.0).abs() < pair[0][1], "{order} at {:?}", pair[0]);
    }
}

#[test]
fn rounding_in_positions_grows_as_steps_shrink_and_deviations_have_none_to_see() {
    let (positions, gaps) = (rounding("positions", "plain"), rounding("gaps", "plain"));
    let (deviations, compensated) = (rounding("deviations", "plain"), rounding("deviations", "compensated"));
    assert_eq!(positions.len(), 13);
    for (((x, s), u), c) in positions.iter().zip(&gaps).zip(&deviations).zip(&compensated) {
        assert!(x[4] > 10.0 * s[4] && s[4] > 1e3 * u[4] && s[4] > 1e3 * c[4], "{x:?} {s:?} {u:?} {c:?}");
    }
    // half a unit of places between 2048 and 4096, dropped or added in every step of 1e-5, is a speed of 2.3e-8, which
    // a gap answers by as much and more: its speed changes by phi = 0.4 of it
    let (first, last) = (&positions[0], &positions[12]);
    assert!(first[4] < 1e-11 && last[4] > 2.3e-8, "{first:?} {last:?}");
}

#[test]
fn compensated_sums_take_the_rounding_out_of_positions_and_gaps() {
    for state in ["positions", "gaps"] {
        let (plain, compensated) = (rounding(state, "plain"), rounding(state, "compensated"));
        for (plain, compensated) in plain.iter().zip(&compensated).skip(2) {
            assert!(compensated[4] < 0.1 * plain[4], "{state}: {plain:?} {compensated:?}");
        }
    }
}

#[test]
fn the_best_steps_are_those_of_the_table_and_near_the_predicted_ones() {
    let made = studies::studies::optimum::table(&table("rounding")).expect("the columns");
    let file = root().join("data/accuracy/rounding_optimum.csv");
    assert_eq!(made.to_csv(), std::fs::read(&file).expect("the table"));
    // rounding that grows as 1 / h, with a factor of its own in each run: within a step of the table or two
    for state in ["positions", "gaps"] {
        let columns = ["t", "dt_best", "dt_predicted"];
        for row in numbers("rounding_optimum", &[("state", state), ("sum", "plain")], &columns) {
            assert!((0.2..5.0).contains(&(row[1] / row[2])), "{state}: {row:?}");
        }
    }
}

#[test]
fn the_verbatim_curve_leaves_the_true_one_unless_positions_are_wrapped() {
    let rows = numbers("verbatim_fig04_stable", &[], &["t", "std", "wrapped", "exact"]);
    let off = |time: f64, column: usize| {
        let row = rows.iter().find(|row| row[0] == time).expect("a row");
        (row[column] / row[3] - 1.0).abs()
    };
    let (unwrapped, wrapped) = (|time| off(time, 1), |time| off(time, 2));
    assert_eq!(rows.len(), 401);
    assert!(unwrapped(20.0) < 1e-4 && unwrapped(500.0) < 0.05 && unwrapped(1000.0) > 0.4 && unwrapped(1200.0) > 0.8);
    assert!(wrapped(500.0) < 2e-3 && wrapped(1000.0) < 6e-3 && wrapped(2000.0) < 0.03);
}

#[test]
fn errors_decay_in_stable_runs_and_grow_in_the_others() {
    for scene in ["algebraic_stable", "exponential_stable"] {
        let rows = numbers("error_growth", &[("scene", scene)], &["t", "exponent"]);
        assert!(rows.iter().all(|row| row[0] < 10.0 || row[1] < 0.0), "{scene}");
    }
    for scene in ["algebraic_unstable", "exponential_unstable", "logarithmic", "logarithmic_small_shift"] {
        let rows = numbers("error_growth", &[("scene", scene)], &["t", "exponent"]);
        assert!(rows.last().is_some_and(|row| row[1] > 0.0), "{scene}");
    }
}
