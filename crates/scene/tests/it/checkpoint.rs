//! Checkpoints: a run resumed from any of them has the bits of an uninterrupted run.

use crate::project::figure;
use files::scene_file;
use jam::run::{Checkpoint, PartialRun};
use jam::run::{Outcome, RunObserver, run, run_from};
use scene::Overrides;
use scene::run::{Scene, read};

/// Thirty pedestrians that overlap, turn back and change places; by the time between samples and lines of `[run]`.
fn scene(sample: f64, lines: &str) -> Scene {
    let text = format!(
        "[law]\nkind = \"exponential\"\na = 8.0\nb = 1.5\nv0 = 3.0\n[ring]\npedestrians = 30\nlength = 100.0\n\
         [start]\nshift = 0.1\n[run]\nt_end = 60.0\nsample = {sample:?}\n{lines}"
    );
    let parsed = scene_file::parse("my.toml", &text).expect("a scene");
    read("my.toml", &parsed.panels[0].tables).expect("a run")
}

/// Everything a run gives, in text that tells all doubles apart.
fn words(outcome: &Outcome) -> String {
    format!("{outcome:?}")
}

/// Keeps every checkpoint, and the part of the run that was done.
#[derive(Default)]
struct Kept {
    checkpoints: Vec<Vec<u8>>,
    fractions: Vec<f64>,
}

impl RunObserver for Kept {
    fn between(&mut self, underway: &PartialRun<'_>) {
        self.checkpoints.push(underway.to_bytes());
        self.fractions.push(underway.fraction());
    }
}

fn checkpoints(scene: &Scene) -> (Outcome, Vec<Vec<u8>>) {
    let mut kept = Kept::default();
    let outcome = run_from(scene, None, &mut kept).expect("it runs");
    (outcome, kept.checkpoints)
}

#[test]
fn checkpoints_tell_how_far_they_are() {
    let scene = scene(1.0, "method = \"rk4\"\ndt = 0.00048828125\n");
    let mut kept = Kept::default();
    run_from(&scene, None, &mut kept).expect("it runs");
    assert!(kept.fractions.len() > 5, "{}", kept.fractions.len());
    for (i, (bytes, fraction)) in kept.checkpoints.iter().zip(kept.fractions).enumerate() {
        let checkpoint = Checkpoint::parse(bytes, &scene).expect("a checkpoint");
        // 4096 steps of 1/2048 are 2 of the 60
        let done = 2.0 * (i + 1) as f64;
        assert_eq!((checkpoint.steps(), checkpoint.fraction(&scene)), (4096 * (i as u64 + 1), done / 60.0));
        assert_eq!(fraction, done / 60.0);
    }
}

#[test]
fn a_run_resumed_from_any_checkpoint_has_the_same_bits() {
    for (sample, lines) in [
        (1.0, "method = \"heun\"\ndt = 1e-4\nstate = \"positions\"\n"),
        (7.0, "method = \"heun\"\ndt = 1e-4\nstate = \"positions\"\nrecord = \"std\"\n"),
        (0.3, "method = \"rk4\"\ndt = 2e-4\n"),
        (1.0, "method = \"dop853\"\ndt = 5e-4\nstate = \"gaps\"\n"),
    ] {
        let scene = scene(sample, lines);
        let (whole, kept) = checkpoints(&scene);
        assert_eq!(words(&whole), words(&run(&scene).expect("it runs")), "keeping changes nothing");
        let stop = whole.stop().expect("this scene stops, and goes on").time;
        let mut after_stop = [0, 0];
        for bytes in kept.iter().step_by(5).chain(kept.last()) {
            let checkpoint = Checkpoint::parse(bytes, &scene).expect("a checkpoint");
            assert!(checkpoint.steps() > 0 && checkpoint.fraction(&scene) < 1.0);
            after_stop[usize::from(checkpoint.fraction(&scene) * scene.t_end > stop)] += 1;
            let resumed = run_from(&scene, Some(checkpoint), &mut ()).expect("it runs");
            assert_eq!(words(&resumed), words(&whole), "{lines}");
        }
        println!("{after_stop:?} checkpoints before and after the stop at {stop}, end at {}", whole.statistics.time);
        assert!(after_stop.iter().all(|&count| count > 0), "{after_stop:?}: {:?}", whole.events);
    }
}

#[test]
fn bytes_of_another_form_are_no_checkpoint() {
    let scene = scene(1.0, "method = \"heun\"\ndt = 1e-4\nstate = \"positions\"\n");
    let (_, kept) = checkpoints(&scene);
    let bytes = &kept[2];
    assert!(Checkpoint::parse(bytes, &scene).is_some());
    for length in [0, 8, 40, bytes.len() / 2, bytes.len() - 8, bytes.len() - 1] {
        assert!(Checkpoint::parse(&bytes[..length], &scene).is_none(), "{length} of {} bytes", bytes.len());
    }
    assert!(Checkpoint::parse(&[bytes.as_slice(), &[0; 8]].concat(), &scene).is_none(), "something behind it");
    let other = Scene { keeps_trajectories: false, ..scene.clone() };
    assert!(Checkpoint::parse(bytes, &other).is_none(), "a scene without trajectories");
    let mut other = scene.clone();
    other.ring.pedestrians = 31;
    assert!(Checkpoint::parse(bytes, &other).is_none(), "another ring");
}

#[test]
fn adaptive_runs_resumed_from_any_checkpoint_have_the_same_bits() {
    let smooth = "kind = \"algebraic\"\nmu = 0.45\nq = 2.0\nv0 = 3.0\n[ring]\npedestrians = 2000\nlength = 5970.0\n\
                  [start]\nshift = 0.4\n[run]\nt_end = 150.0\nsample = 0.7\n";
    // a largest acceleration, and a force that begins at the spacing of the uniform flow: steps end on kinks at all
    // times
    let clipped = "kind = \"formula\"\nacceleration = \"min(0.5, (tanh(s - 2) + tanh(2) - ramp(s - 2, 0) - v)/0.6)\"\n\
                   body = 0.0\n[ring]\npedestrians = 2000\nlength = 4000.0\n\
                   [start]\nshift = 1.0\n[run]\nt_end = 30.0\nsample = 0.7\n";
    let read_scene = |text: &str, lines: &str| {
        let parsed = scene_file::parse("my.toml", &format!("[law]\n{text}{lines}")).expect("a scene");
        read("my.toml", &parsed.panels[0].tables).expect("a run")
    };
    let own = |lines: &str| read_scene(smooth, lines);
    let kinks = |lines: &str| read_scene(clipped, lines);
    // the last one changes its state near a wall
    let figure = crate::project::scene(&figure("fig04"), "unstable", &Overrides::default());
    for scene in [
        own("method = \"taylor\"\ntolerance = 1e-12\n"),
        own("method = \"dop853\"\ntolerance = 1e-11\n"),
        own("method = \"bs32\"\ntolerance = 1e-5\nstate = \"gaps\"\nrecord = \"std\"\n"),
        kinks("method = \"taylor\"\ntolerance = 1e-12\n"),
        kinks("method = \"taylor\"\ntolerance = 1e-8\nstate = \"gaps\"\n"),
        kinks("method = \"dop853\"\ntolerance = 1e-10\nstate = \"positions\"\n"),
        figure,
    ] {
        let lines = format!("{} {:?}", scene.method.name(), scene.form);
        let (whole, kept) = checkpoints(&scene);
        assert_eq!(words(&whole), words(&run(&scene).expect("it runs")), "keeping changes nothing");
        assert!(!kept.is_empty(), "{lines}: {} checkpoints", kept.len());
        let (mut parts, every) = (Vec::new(), kept.len().div_ceil(3));
        for bytes in kept.iter().step_by(every).chain(kept.last()) {
            let checkpoint = Checkpoint::parse(bytes, &scene).expect("a checkpoint");
            parts.push(checkpoint.fraction(&scene));
            let resumed = run_from(&scene, Some(checkpoint), &mut ()).expect("it runs");
            assert_eq!(words(&resumed), words(&whole), "{lines}");
        }
        println!("{lines}: {} checkpoints, {:?}", kept.len(), whole.statistics);
        assert!(parts.is_sorted() && parts[0] > 0.0 && parts.iter().all(|&part| part <= 1.0), "{parts:?}");
    }
}
