//! The published curves of the logarithmic law.

use crate::project::{jams, root};
use files::table::Table;
use scene::tables;

fn reference(name: &str) -> Table {
    Table::read(&root("data/reference").join(name)).unwrap_or_else(|error| panic!("{error}"))
}

#[test]
fn speeds_at_t_300_are_the_published_ones() {
    let [run, _] = jams();
    let speeds: Vec<f64> =
        tables::trajectories(&run.samples).rows().filter(|row| row[0] == 300.0).map(|row| row[3]).collect();
    assert_eq!(speeds.len(), 133);
    let mut worst: f64 = 0.0;
    for row in reference("published_speed_t300.csv").rows() {
        let n = row[0].round();
        assert!((row[0] - n).abs() < 0.1, "{}", row[0]);
        worst = math::larger(worst, (speeds[n as usize] - row[1]).abs());
    }
    println!("largest difference from the published speeds {worst:e}");
    // read off with 3e-5, six decimals, and the authors' own error
    assert!(worst < 5e-5, "{worst:e}");
}

#[test]
fn the_standard_deviation_is_the_published_one() {
    let [run, _] = jams();
    let std = run.samples.std.clone();
    let mut differences: Vec<f64> =
        reference("published_std_log.csv").rows().map(|row| (std[row[0] as usize] - row[1]).abs()).collect();
    differences.sort_by(f64::total_cmp);
    let (median, largest) = (differences[differences.len() / 2], differences[differences.len() - 1]);
    println!("published std: median difference {median:e}, largest {largest:e}");
    // read off with a median of 4e-4, 2e-3 at the steep parts
    assert!(median <= 5e-4 && largest <= 2e-3, "median {median:e}, largest {largest:e}");
}
