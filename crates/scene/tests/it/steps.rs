//! Prints of the steps of real runs: one flipped bit of one pedestrian, and a step of another length, are found where
//! they are.

use files::recipe;
use files::steps::{Change, Print, first_change};
use ode::{Control, Problem, Step, integrate};
use scene::run::{Scene, read};
use scene::simulation::{Onlooker, run_from};
use std::ops::ControlFlow;

const PEDESTRIANS: usize = 30;

/// Thirty pedestrians under a law, for sixty time units.
fn scene(law: &str, run: &str) -> Scene {
    let text = format!(
        "[law]\n{law}\n[ring]\npedestrians = {PEDESTRIANS}\nlength = 100.0\n[start]\nshift = 0.1\n\
         [run]\nt_end = 60.0\nsample = 1.0\n{run}\n"
    );
    let recipe = recipe::parse("my.toml", &text).expect("a scene");
    read("my.toml", &recipe.panels[0].tables).expect("a run")
}

fn scenes() -> [Scene; 4] {
    [
        scene("kind = \"algebraic\"\nmu = 0.45\nv0 = 3.0\nq = 2.0", "method = \"taylor\"\ntolerance = 1e-12"),
        scene("kind = \"exponential\"\na = 3.0\nb = 1.0\nv0 = 3.0", "method = \"taylor\"\ntolerance = 1e-12"),
        scene("kind = \"logarithmic\"\nv0 = 1.0\nepsilon = 0.01", "method = \"dop853\"\ntolerance = 1e-10"),
        scene(
            "kind = \"logarithmic\"\nv0 = 1.0\nepsilon = 0.01",
            "method = \"taylor\"\ntolerance = 1e-9\nstate = \"gaps\"",
        ),
    ]
}

/// The prints of all steps seen.
#[derive(Default)]
struct Prints(Vec<Print>);

impl Onlooker for Prints {
    fn after(&mut self, step: &Step<'_>) {
        if self.0.is_empty() {
            self.0.push(Print::new(0.0, step.before(), PEDESTRIANS));
        }
        self.0.push(Print::new(step.length(), step.after(), PEDESTRIANS));
    }
}

fn prints(scene: &Scene) -> Vec<Print> {
    let mut prints = Prints::default();
    run_from(scene, None, &mut prints).expect("it runs");
    prints.0
}

/// The prints of a run whose state at the end of step `at` is changed, and which goes on from there under `control`.
fn changed(scene: &Scene, at: usize, change: &dyn Fn(&mut [f64]), control: Control) -> Vec<Print> {
    let form = scene.form.build(&scene.model, scene.ring);
    let start = form.start(scene.start);
    let mut prints = Prints::default();
    let whole = Problem {
        system: &*form,
        start: &start,
        begin: 0.0,
        end: scene.t_end,
        method: scene.method,
        control: scene.control,
    };
    let (mut state, mut length) = (Vec::new(), 0.0);
    let mut until = |step: &mut Step<'_>| {
        prints.after(step);
        (state, length) = (step.after().to_vec(), step.length());
        if prints.0.len() > at { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
    };
    let begin = integrate(&whole, &mut until).expect("it runs").time;
    change(&mut state);
    prints.0[at] = Print::new(length, &state, PEDESTRIANS);
    let mut on = |step: &mut Step<'_>| {
        prints.after(step);
        ControlFlow::Continue(())
    };
    integrate(&Problem { start: &state, begin, control, ..whole }, &mut on).expect("it runs");
    prints.0
}

#[test]
fn a_flipped_bit_is_found_at_its_step_and_pedestrian() {
    for scene in scenes() {
        let whole = prints(&scene);
        assert_eq!(first_change(&whole, &prints(&scene), PEDESTRIANS), None);
        assert!(whole.len() > 15, "{} steps", whole.len());
        for (at, n, bit) in [(1, 0, 0), (7, 29, 0), (12, 17, 1), (whole.len() - 2, 4, 51)] {
            for component in [n, PEDESTRIANS + n] {
                let flip = |state: &mut [f64]| {
                    state[component] = f64::from_bits(state[component].to_bits() ^ (1 << bit));
                };
                let other = changed(&scene, at, &flip, scene.control);
                assert_eq!(
                    first_change(&whole, &other, PEDESTRIANS),
                    Some((at, Change::Pedestrian(n))),
                    "{} law, component {component}",
                    scene.model.name()
                );
            }
        }
    }
}

#[test]
fn bits_of_two_pedestrians_are_several_and_those_of_nobody_shared() {
    for scene in scenes() {
        let whole = prints(&scene);
        let flip = |state: &mut [f64], components: &[usize]| {
            for &component in components {
                state[component] = state[component].next_up();
            }
        };
        for (components, expected) in
            [(&[3, PEDESTRIANS + 4][..], Change::Several), (&[2 * PEDESTRIANS][..], Change::Shared)]
        {
            let other = changed(&scene, 9, &|state| flip(state, components), scene.control);
            assert_eq!(first_change(&whole, &other, PEDESTRIANS), Some((9, expected)), "{components:?}");
        }
    }
}

#[test]
fn a_step_of_another_length_is_told_from_another_state() {
    for scene in scenes() {
        let whole = prints(&scene);
        let Control::Adaptive { tolerance } = scene.control else { panic!("steps of adaptive length") };
        let looser = Control::Adaptive { tolerance: 1.5 * tolerance };
        let other = changed(&scene, 10, &|_| {}, looser);
        assert_eq!(first_change(&whole, &other, PEDESTRIANS), Some((11, Change::Length)));
        let from_start = prints(&Scene { control: looser, ..scene });
        assert_eq!(first_change(&whole, &from_start, PEDESTRIANS).map(|(_, change)| change), Some(Change::Length));
    }
}
