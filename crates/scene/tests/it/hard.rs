//! Runs that fail and runs at the edge: their messages, and that no table contains a NaN or an infinity.

use files::table::Table;
use jam::run::{Broken, Narrowest, Outcome, run};
use ode::Method;
use scene::tables;

/// An algebraic run like that of figure 4, of ten pedestrians, with other lines in `[law]` and `[run]`.
fn attempt(law: &str, shift: &str, steps: &str) -> Result<Outcome, Broken> {
    let text = format!(
        "[law]\n{law}\n[ring]\npedestrians = 10\nlength = 29.85\n[start]\nshift = {shift}\n[run]\nt_end = 100.0\n\
         sample = 0.37\n{steps}\n"
    );
    let parsed = files::scene_file::parse("my.toml", &text).expect("a scene");
    run(&scene::run::read("my.toml", &parsed.panels[0].tables).expect("a run"))
}

fn is_finite(table: &Table) -> bool {
    table.rows().flatten().all(|number| number.is_finite())
}

/// Fixed steps, from fine to far too long.
const STEPS: [&str; 5] = ["0.025", "0.05", "0.1", "0.5", "2.0"];

#[test]
fn runs_through_a_wall_fill_tables_with_finite_numbers_or_say_where_they_broke() {
    let (mut stopped, mut broken) = (0, 0);
    let algebraic =
        ["1.0", "1.5", "2.0", "3.0"].map(|q| format!("kind = \"algebraic\"\nmu = 0.8\nq = {q}\nv0 = 3.0\na_v = 0.02"));
    let exponential = ["kind = \"exponential\"\na = 3.0\nb = 0.5\nv0 = 3.0".to_owned()];
    let strong = ["kind = \"exponential\"\na = 200.0\nb = 0.05\nc = 50.0\nv0 = 30.0".to_owned()];
    for law in algebraic.iter().chain(&exponential).chain(&strong) {
        for method in Method::ALL.into_iter().filter(|method| !method.needs_series()).map(Method::name) {
            for step in STEPS {
                for state in ["deviations", "gaps", "positions"] {
                    let run = attempt(law, "0.3", &format!("method = \"{method}\"\ndt = {step}\nstate = \"{state}\""));
                    let label = format!("{law} {method} {step} {state}");
                    match run {
                        Ok(run) => {
                            assert!(
                                is_finite(&tables::std(&run.samples)) && is_finite(&tables::trajectories(&run.samples)),
                                "{label}: {:?}",
                                run.events
                            );
                            assert!(run.events.iter().all(|event| event.time.is_finite()), "{label}: {:?}", run.events);
                            stopped += u32::from(run.stop().is_some());
                        }
                        Err(failure) => {
                            assert_named(&failure, &label);
                            broken += 1;
                        }
                    }
                }
            }
        }
    }
    println!("{stopped} runs stopped by an event, {broken} broken");
    assert!(stopped > 100 && broken > 10, "{stopped} {broken}");
}

/// The message of a broken run: time, step, smallest effective gap and its pedestrian, in the order of the words.
fn assert_named(broken: &Broken, label: &str) {
    let ode::Failure::NotFinite { time, step } = broken.failure else { panic!("{label}: {broken:?}") };
    let Some(Narrowest { pedestrian, spacing: gap, effective_gap: room, speed }) = broken.narrowest else {
        panic!("{label}: {broken:?}")
    };
    assert!(pedestrian < 10 && [time, gap, room, speed].iter().all(|x| x.is_finite()), "{label}: {broken:?}");
    let words = "the state is no longer finite; a smaller step may help";
    let place =
        format!("smallest effective gap then: {room:?}, of pedestrian {pedestrian}, spacing {gap:?}, speed {speed:?}");
    assert_eq!(broken.to_string(), format!("in the step of {step:e} from t = {time:?} {words}; {place}"), "{label}");
}

#[test]
fn a_run_of_too_many_steps_says_how_far_it_came() {
    let law = "kind = \"algebraic\"\nmu = 0.45\nq = 2.0\nv0 = 3.0";
    for (method, most) in [("dop853", 9), ("bs32", 10), ("extrapolation", 4), ("taylor", 11)] {
        let steps = format!("method = \"{method}\"\ntolerance = 1e-9\nmost_steps = {most}");
        let broken = attempt(law, "0.3", &steps).expect_err("too many steps");
        let ode::Failure::TooManySteps { time, steps } = broken.failure else { panic!("{method}: {broken}") };
        assert!(steps == most && time > 0.0 && time < 100.0 && broken.narrowest.is_some(), "{broken}");
        let words =
            format!("{most} steps, the limit, reach only t = {time:?}; raise most_steps or the tolerance; smallest");
        assert!(broken.to_string().starts_with(&words), "{broken}");
    }
}

#[test]
fn positions_lose_the_digits_that_deviations_keep() {
    // the scheme of the paper in small: Heun with 1e-5 on a decaying wave, the same steps in two forms of the state
    let law = "kind = \"algebraic\"\nmu = 0.3\nq = 2.0\nv0 = 3.0";
    let end = |steps: &str| {
        let text = format!(
            "[law]\n{law}\n[ring]\npedestrians = 6\nlength = 18.0\n[start]\nshift = 1e-6\n[run]\nt_end = 10.0\nsample = \
             1.0\n{steps}\n"
        );
        let parsed = files::scene_file::parse("my.toml", &text).expect("a scene");
        let outcome = run(&scene::run::read("my.toml", &parsed.panels[0].tables).expect("a run")).expect("it runs");
        outcome.samples.std.last().copied().expect("a last sample")
    };
    let exact = end("method = \"extrapolation\"\ntolerance = 1e-14");
    let heun = |state: &str| end(&format!("method = \"heun\"\ndt = 1e-5\nstate = \"{state}\"")) / exact - 1.0;
    let (deviations, positions) = (heun("deviations"), heun("positions"));
    println!("relative errors of the standard deviation: deviations {deviations:e}, positions {positions:e}");
    // Heun's own error is some 1e-10; positions of 30 are rounded to 4e-15 in each of 1e6 steps of a wave of 1e-7
    assert!(deviations.abs() < 1e-8 && positions.abs() > 20.0 * deviations.abs());
}
