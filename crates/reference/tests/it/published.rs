//! The committed digits are reproduced with another tableau and another tolerance.

use math::double_double::decimal;
use reference::run::{Precision, Run};
use reference::scenes::{NAMES, Parameters, scene};
use reference::table::spread;

fn committed(name: &str) -> String {
    let path = format!("{}/../../data/reference/solutions/{name}.csv", env!("CARGO_MANIFEST_DIR"));
    std::fs::read_to_string(&path).unwrap_or_else(|error| panic!("{path}: {error}"))
}

#[test]
fn short_runs_reproduce_the_committed_digits() {
    for name in NAMES {
        let scene = scene(name, Parameters::Doubles).expect("a scene");
        let (ring, count) = (scene.ring, scene.ring.pedestrians);
        let (states, std) = (committed(name), committed(&format!("{name}_std")));
        let mut run = Run::new(&scene, Precision { tolerance: 3e-26, rows: 11 });
        for time in [1, 10] {
            run.advance_to(f64::from(time)).expect("no wall");
            let mut expected = format!("{time},{}\n", decimal::format(spread(&ring, &run.state), 20));
            assert!(std.contains(&format!("\n{expected}")), "{name}_std has no row {expected}");
            expected.clear();
            for n in 0..count {
                let gap = decimal::format(run.state[n] + ring.law.contact(), 20);
                let speed = decimal::format(run.state[count + n], 20);
                expected += &format!("{time},{n},{gap},{speed}\n");
            }
            assert!(
                states.contains(&format!("\n{expected}")),
                "{name} at t = {time} has other digits than\n{expected}"
            );
        }
    }
}

#[test]
fn tables_have_all_their_rows() {
    for name in NAMES {
        let scene = scene(name, Parameters::Doubles).expect("a scene");
        assert_eq!(committed(name).lines().count(), 1 + scene.times.len() * scene.ring.pedestrians, "{name}");
        let end = scene.times[scene.times.len() - 1] as usize;
        assert_eq!(committed(&format!("{name}_std")).lines().count(), 2 + end, "{name}_std");
    }
}
