//! Jams in constructed snapshots, their speed, and the standard deviation.

use jam::jams::{Drift, Jam, find, threshold};
use jam::observe::speed_std;

const LENGTH: f64 = 20.0;

/// Ten pedestrians, two apart, of which these are slow.
fn snapshot(slow: &[usize]) -> (Vec<f64>, Vec<f64>) {
    let positions = (0..10).map(|n| 2.0 * n as f64).collect();
    let speeds = (0..10).map(|n| if slow.contains(&n) { 0.25 } else { 1.0 }).collect();
    (positions, speeds)
}

fn jams(slow: &[usize]) -> Vec<Jam> {
    let (positions, speeds) = snapshot(slow);
    find(&positions, &speeds, LENGTH, 0.625)
}

#[test]
fn jams_are_runs_of_slow_pedestrians() {
    // the threshold is crossed half way between a slow pedestrian and a free one
    let expected = [
        Jam { first: 2, pedestrians: 3, extent: 6.0, centre: 6.0 },
        Jam { first: 7, pedestrians: 1, extent: 2.0, centre: 14.0 },
    ];
    assert_eq!(jams(&[2, 3, 4, 7]), expected);
}

#[test]
fn a_jam_may_lie_across_the_seam() {
    assert_eq!(jams(&[8, 9, 0]), [Jam { first: 8, pedestrians: 3, extent: 6.0, centre: 18.0 }]);
    assert_eq!(jams(&[0, 1]), [Jam { first: 0, pedestrians: 2, extent: 4.0, centre: 21.0 }]);
    assert_eq!(jams(&[9]), [Jam { first: 9, pedestrians: 1, extent: 2.0, centre: 18.0 }]);
}

#[test]
fn who_walks_at_the_threshold_is_free() {
    let (positions, speeds) = snapshot(&[2, 3]);
    assert!(find(&positions, &speeds, LENGTH, 0.25).is_empty());
    let (positions, mut speeds) = snapshot(&[2, 3, 4]);
    speeds[3] = 0.625;
    // the crossing lies on the pedestrian at the threshold
    let expected = [
        Jam { first: 2, pedestrians: 1, extent: 3.0, centre: 4.5 },
        Jam { first: 4, pedestrians: 1, extent: 3.0, centre: 7.5 },
    ];
    assert_eq!(find(&positions, &speeds, LENGTH, 0.625), expected);
}

#[test]
fn no_jam_without_both_slow_and_free() {
    assert!(jams(&[]).is_empty());
    assert!(jams(&[0, 1, 2, 3, 4, 5, 6, 7, 8, 9]).is_empty());
    assert_eq!(jams(&[1, 2, 3, 4, 5, 6, 7, 8, 9])[0].pedestrians, 9);
}

#[test]
fn a_threshold_needs_contrast() {
    assert_eq!(threshold(&[0.25, 1.0, 0.75], 1.0), Some(0.625));
    assert_eq!(threshold(&[0.95, 1.0, 0.98], 1.0), None);
    // a tenth of the desired speed, not of the speeds
    assert_eq!(threshold(&[0.25, 0.5], 4.0), None);
    // at exactly a tenth there is none yet
    assert_eq!(threshold(&[0.0, 0.5], 5.0), None);
    assert_eq!(threshold(&[0.0, 0.5], 4.999), Some(0.25));
    assert_eq!(threshold(&[], 1.0), None);
}

/// The jams of a snapshot, all moved.
fn shifted(by: f64) -> Vec<Jam> {
    jams(&[2, 3, 4, 7]).into_iter().map(|jam| Jam { centre: jam.centre + by, ..jam }).collect()
}

/// Speed and time of jams that were seen at these shifts, two time units apart.
fn speed(shifts: &[f64]) -> Option<(f64, f64)> {
    let mut drift = Drift::default();
    for &by in shifts {
        drift.follow(&shifted(by), LENGTH, 2.0);
    }
    drift.speed()
}

#[test]
fn jams_drift() {
    assert_eq!(speed(&[0.0, -0.5]), Some((-0.25, 2.0)));
    assert_eq!(speed(&[0.0, 0.5, 0.75]), Some((0.1875, 4.0)));
    // positions are unwrapped: whole rounds do not count
    assert_eq!(speed(&[0.0, 3.0 * LENGTH - 0.5]), Some((-0.25, 2.0)));
    // no speed before there are two snapshots
    assert_eq!(speed(&[]), None);
    assert_eq!(speed(&[0.0]), None);
}

#[test]
fn a_jam_that_comes_or_goes_starts_the_measurement_again() {
    let mut drift = Drift::default();
    drift.follow(&shifted(0.0), LENGTH, 1.0);
    drift.follow(&shifted(-0.5), LENGTH, 1.0);
    drift.follow(&shifted(-1.0)[..1], LENGTH, 1.0);
    assert_eq!((drift.speed(), drift.jams().len()), (None, 1));
    drift.follow(&shifted(-1.25)[..1], LENGTH, 1.0);
    assert_eq!(drift.speed(), Some((-0.25, 1.0)));
    drift.follow(&[], LENGTH, 1.0);
    assert_eq!((drift.speed(), drift.jams().len()), (None, 0));
}

#[test]
fn spread_is_the_population_deviation() {
    // squares of distances from the mean 5: 9 + 1 + 1 + 1 + 0 + 0 + 4 + 16 = 32, over 8 = 4
    assert_eq!(speed_std(&[2.0, 4.0, 4.0, 4.0, 5.0, 5.0, 7.0, 9.0]), 2.0);
    // the mean of equal numbers is theirs up to the rounding of its sum
    assert_eq!([speed_std(&[0.7; 64]), speed_std(&[0.7; 7]), speed_std(&[1.1; 133])], [0.0; 3], "equal numbers");
    assert_eq!(speed_std(&[0.0; 64]), 0.0);
    assert_eq!(speed_std(&[-1.0, 1.0]), 1.0);
    // no digits are lost to a common offset that the numbers can hold
    assert_eq!(speed_std(&[1e6 - 0.5, 1e6 + 0.5]), 0.5);
    assert!((speed_std(&[-1e-300, 1e-300]) / 1e-300 - 1.0).abs() < 1e-15, "squares below the smallest number");
}
