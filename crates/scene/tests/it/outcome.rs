//! Outcomes: every class, from a scene that is known to end in it.

use files::scene_file;
use jam::outcome::{Class, Decision, Verdict};
use jam::run::{Checkpoint, PartialRun};
use jam::run::{Judging, Outcome, RunObserver, run_from};
use scene::run::Scene;

struct Along(Judging);

impl RunObserver for Along {
    fn judging(&self) -> Judging {
        self.0
    }
}

fn scene(law: &str, ring: (usize, f64), shift: f64, run: &str) -> Scene {
    let (pedestrians, length) = ring;
    let text = format!(
        "[law]\n{law}\n[ring]\npedestrians = {pedestrians}\nlength = {length:?}\n[start]\nshift = {shift:?}\n[run]\nsample = 1000.0\nrecord = \"std\"\n{run}\n"
    );
    let parsed = scene_file::parse("own.toml", &text).expect("TOML");
    scene::run::read("own.toml", &parsed.panels[0].tables).expect("a scene")
}

fn run(scene: &Scene, judging: Judging) -> Outcome {
    run_from(scene, None, &mut Along(judging)).expect("a run")
}

fn verdict(scene: &Scene) -> Verdict {
    run(scene, Judging::UntilCertain).verdict.expect("judged")
}

/// Keeps the last checkpoint.
#[derive(Default)]
struct Kept(Vec<u8>);

impl RunObserver for Kept {
    fn judging(&self) -> Judging {
        Judging::Along
    }

    fn between(&mut self, underway: &PartialRun<'_>) {
        self.0 = underway.to_bytes();
    }
}

const TAYLOR: &str = "t_end = 900.0\nmethod = \"taylor\"\ntolerance = 1e-7";
const LOGARITHMIC: &str = "kind = \"logarithmic\"\nepsilon = 0.01\n";
const ALGEBRAIC: &str = "kind = \"algebraic\"\nq = 2.0\nv0 = 3.0\nepsilon = 0.1\n";

/// Waves on a small ring: the algebraic law with relative speed.
fn waves(v0: f64) -> String {
    format!("kind = \"algebraic\"\nq = 2.0\nv0 = {v0:?}\nepsilon = 0.1\nmu = 0.36\ndelta = 1.0")
}

const SMALL: (usize, f64) = (16, 40.0);

#[test]
fn every_class_comes_from_a_scene_that_ends_in_it() {
    let logarithmic = |v0: f64| format!("{LOGARITHMIC}v0 = {v0:?}");
    let algebraic = |rest: &str| format!("{ALGEBRAIC}{rest}");
    let exponential = "kind = \"exponential\"\na = 3.0\nb = 1.0\nv0 = 3.0".to_owned();
    let cases = [
        (logarithmic(0.7), (20, 30.0), Class::Decays),
        (logarithmic(2.0), (20, 30.0), Class::Contact),
        (exponential, (12, 42.0), Class::Contact),
        (algebraic("mu = 0.8"), (12, 36.0), Class::BlowUp),
        (waves(3.0), SMALL, Class::Waves),
        (waves(1.0), SMALL, Class::WavesBackwards),
        (algebraic("mu = 0.32\ndelta = 1.0"), (10, 25.0), Class::Decays),
    ];
    for (law, ring, class) in cases {
        let verdict = verdict(&scene(&law, ring, 0.1, TAYLOR));
        assert_eq!(verdict.class, class, "{law}: {verdict:?}");
        let decided = match class {
            Class::Decays => Decision::Return,
            Class::Waves | Class::WavesBackwards => Decision::Repetition,
            _ => Decision::EventKind,
        };
        assert_eq!(verdict.decision, decided, "{law}");
        assert!(verdict.time > 0.0 && verdict.time < 900.0, "{law}: {verdict:?}");
        assert!(verdict.least_gap > 0.0 || [Class::Contact, Class::BlowUp].contains(&class), "{law}: {verdict:?}");
    }
}

#[test]
fn a_desired_speed_of_0_or_below_turns_no_threshold_around() {
    for v0 in ["1.0", "0.0", "-0.5"] {
        let law = format!(
            "kind = \"formula\"\nacceleration = \"v0 - v + 0.4*(s - 1.9) + 0.3*tanh(v[1] - v)\"\nv0 = {v0}\nbody = 0.5"
        );
        let found = verdict(&scene(&law, (10, 20.0), 0.3, TAYLOR));
        assert_eq!(found.class, Class::Decays, "{v0}: {found:?}");
    }
}

#[test]
fn what_is_not_certain_says_what_would_decide_it() {
    let law = format!("{LOGARITHMIC}v0 = 1.0");
    let growing = verdict(&scene(&law, (20, 30.0), 1e-7, TAYLOR));
    let changing = verdict(&scene(&law, (20, 30.0), 0.1, TAYLOR));
    let short = verdict(&scene(&law, (20, 30.0), 0.1, &TAYLOR.replace("900", "90")));
    let cases = [(growing, "growing at a rate of"), (changing, "between the last two windows"), (short, "t_end")];
    for (found, words) in cases {
        assert_eq!((found.class, found.distance), (Class::Undecided, 0.0), "{found:?}");
        let Decision::Missing(missing) = &found.decision else { panic!("{found:?}") };
        assert!(missing.contains(words), "{missing}");
    }
}

/// With `a_v = 0` the algebraic law depends on spacings and differences of speeds alone: another desired speed adds to
/// all speeds and changes nothing else.
#[test]
fn waves_seen_from_a_moving_frame_are_the_same_waves() {
    let [here, there] = [3.0, 1.0].map(|v0| verdict(&scene(&waves(v0), SMALL, 0.1, TAYLOR)));
    assert_eq!((here.class, there.class), (Class::Waves, Class::WavesBackwards));
    let close = |a: f64, b: f64, by: f64| assert!((a - b).abs() < by, "{a} {b}");
    close(here.least_gap, there.least_gap, 1e-5);
    close(here.least_speed, there.least_speed + 2.0, 1e-4);
    close(here.std, there.std, 1e-4);
    let speeds = [here, there].map(|verdict| verdict.wave_speed.expect("waves travel"));
    close(speeds[0], speeds[1] + 2.0, 1e-3);
}

/// The speed of the waves by their repetition, against that of the slowest in two snapshots.
#[test]
fn waves_travel_as_fast_as_is_said() {
    let (count, length) = SMALL;
    let at = |t_end: f64| {
        let adaptive = format!("t_end = {t_end:?}\nmethod = \"dop853\"\ntolerance = 1e-9");
        run(&scene(&waves(3.0), SMALL, 0.1, &adaptive), Judging::No)
    };
    let slowest = |outcome: &Outcome| {
        let speeds = &outcome.speeds;
        let n = (0..count).min_by(|a, b| speeds[*a].total_cmp(&speeds[*b])).expect("somebody");
        // the vertex of the parabola through three neighbours, as a place along the ring
        let [behind, here, ahead] = [count - 1, 0, 1].map(|step| speeds[(n + step) % count]);
        let share = 0.5 * (behind - ahead) / (behind - 2.0 * here + ahead);
        outcome.positions[n] + share * (outcome.positions[(n + 1) % count] - outcome.positions[n]).rem_euclid(length)
    };
    let moved = slowest(&at(450.0)) - slowest(&at(400.0));
    let speed = verdict(&scene(&waves(3.0), SMALL, 0.1, TAYLOR)).wave_speed.expect("waves travel");
    let rest = moved - 50.0 * speed;
    let off = rest - length * (rest / length).round();
    // a parabola through three of a crest that is some pedestrians wide finds it to a fraction of a headway of 2.5
    assert!(off.abs() < 0.5, "{moved} in 50 at {speed}: off by {off}");
}

/// The slowest of lasting waves, against the slowest of snapshots; in the whole run somebody is slower.
#[test]
fn the_least_speed_of_lasting_waves_is_not_that_of_their_growth() {
    let own = scene(&waves(3.0), SMALL, 0.1, TAYLOR);
    let found = verdict(&own);
    let lasting = found.lasting_least_speed.expect("waves");
    let slowest = (0..20).map(|index| {
        let adaptive = format!("t_end = {:?}\nmethod = \"dop853\"\ntolerance = 1e-9", 450.0 + 0.13 * f64::from(index));
        let outcome = run(&scene(&waves(3.0), SMALL, 0.1, &adaptive), Judging::No);
        outcome.speeds.iter().copied().fold(f64::INFINITY, math::smaller)
    });
    let snapshots = slowest.fold(f64::INFINITY, math::smaller);
    assert!(found.least_speed <= lasting && (-1e-5..2e-3).contains(&(snapshots - lasting)), "{found:?} {snapshots}");
    let decayed = verdict(&scene(&waves(3.0).replace("0.36", "0.1"), SMALL, 0.1, TAYLOR));
    assert_eq!((decayed.class, decayed.lasting_least_speed), (Class::Decays, None));
}

#[test]
fn an_outcome_is_the_same_along_the_run_and_at_any_sampling() {
    let own = scene(&waves(3.0), SMALL, 0.1, TAYLOR);
    let until = verdict(&own);
    let along = run(&own, Judging::Along).verdict.expect("judged");
    let often = run(&Scene { sample: 0.37, ..own.clone() }, Judging::Along).verdict.expect("judged");
    assert_eq!((&until, &until), (&along, &often));
    assert!(run(&own, Judging::No).verdict.is_none());
}

#[test]
fn a_run_that_goes_on_from_a_checkpoint_has_the_same_outcome() {
    // enough steps for a checkpoint, which comes every 2^18 components
    for (law, ring) in [(waves(3.0), SMALL), (format!("{LOGARITHMIC}v0 = 1.2"), (60, 90.0))] {
        let own = scene(&law, ring, 0.1, TAYLOR);
        let mut kept = Kept::default();
        let whole = run_from(&own, None, &mut kept).expect("a run").verdict;
        let checkpoint = Checkpoint::parse(&kept.0, &own).filter(|_| !kept.0.is_empty());
        if let Some(checkpoint) = checkpoint {
            let resumed = run_from(&own, Some(checkpoint), &mut Along(Judging::Along)).expect("a run").verdict;
            assert_eq!(whole, resumed, "{law}");
        } else {
            assert_eq!(ring, SMALL, "no checkpoint of the long run");
        }
    }
}
