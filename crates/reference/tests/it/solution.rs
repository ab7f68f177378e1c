//! Collocation against the committed digits of extrapolation, and against a solution in closed form.

use math::double_double::DoubleDouble;
use reference::flow::Form;
use reference::formula::Formula;
use reference::number::Real;
use reference::solution::{End, Kind, Question, Solution, solve};
use reference::solver::Care;

const CARE: Care = Care { nodes: 12, tolerance: 1e-13, most_work: 100_000_000 };

/// The scenes of `data/reference/solutions`.
fn scenes() -> [(&'static str, Question); 4] {
    let question = |formula, pedestrians, shift| Question {
        formula,
        pedestrians,
        length: 200.0,
        shift,
        displacements: Vec::new(),
        times: vec![1.0, 10.0, 50.0, 100.0],
    };
    let algebraic = |mu| Formula::Algebraic { mu, delta: 0.0, q: 2.0, a_v: 0.0, epsilon: 0.1, v0: 3.0 };
    [
        ("algebraic_stable", question(algebraic(0.45), 67, 1e-4)),
        ("algebraic_unstable", question(algebraic(0.55), 67, 1e-4)),
        (
            "exponential_unstable",
            question(Formula::Exponential { a: 3.0, b: 1.5, c: 0.0, a_v: 0.0, epsilon: 0.1, v0: 3.0 }, 57, 1e-4),
        ),
        ("logarithmic", question(Formula::Logarithmic { a_v: 0.0, epsilon: 0.01, v0: 1.0 }, 133, 0.1)),
    ]
}

fn committed(name: &str, time: f64) -> f64 {
    let path = format!("{}/../../data/reference/solutions/{name}_std.csv", env!("CARGO_MANIFEST_DIR"));
    let text = std::fs::read_to_string(&path).unwrap_or_else(|error| panic!("{path}: {error}"));
    let row = text.lines().find_map(|line| line.strip_prefix(&format!("{time},"))).expect("a row");
    row.parse().expect("a number")
}

fn worst<T: Real>(name: &str, question: &Question, form: Form) -> f64 {
    let solution: Solution = solve::<T>(question, form, CARE, 1e6);
    assert_eq!(solution.end, End::Reached, "{name}");
    let errors = solution.samples.iter().map(|sample| {
        let expected = committed(name, sample.time);
        ((sample.std - expected) / expected).abs()
    });
    errors.fold(0.0, math::larger)
}

#[test]
fn doubles_as_differences_have_twelve_of_the_committed_digits() {
    for (name, question) in scenes() {
        let error = worst::<f64>(name, &question, Form::Differences);
        assert!(error < 3e-12, "{name}: {error:e}");
    }
}

#[test]
fn clearances_have_the_digits_that_the_perturbation_leaves_them() {
    for (name, question) in scenes() {
        let error = worst::<f64>(name, &question, Form::Clearances);
        // spacings of 3 hold a perturbation of 1e-4 and less to 1e-11 and worse
        assert!(error < 1e-8, "{name}: {error:e}");
    }
}

#[test]
fn a_lone_pedestrian_relaxes_exponentially() {
    // without a force: v = v_0 (1 - e^-t), x = v_0 (t - 1 + e^-t)
    let formula = Formula::Exponential { a: 0.0, b: 1.0, c: 0.0, a_v: 0.0, epsilon: 0.1, v0: 2.0 };
    let question = Question {
        formula,
        pedestrians: 2,
        length: 20.0,
        shift: 0.5,
        displacements: Vec::new(),
        times: vec![0.3, 1.0, 7.0],
    };
    for form in [Form::Differences, Form::Clearances] {
        for sample in solve::<DoubleDouble>(&question, form, Care { nodes: 20, tolerance: 1e-20, ..CARE }, 1e6).samples
        {
            let decay = math::exp(-sample.time);
            let (v, x) = (2.0 * (1.0 - decay), 0.5 + 2.0 * (sample.time - 1.0 + decay));
            assert!((sample.speeds[0] - v).abs() < 1e-15 && (sample.positions[0] - x).abs() < 4e-15, "{sample:?}");
        }
    }
}

#[test]
fn a_perturbation_of_any_size_grows_alike() {
    let (_, question) = scenes()[1].clone();
    let of = |shift: f64| {
        let solution = solve::<f64>(&Question { shift, ..question.clone() }, Form::Differences, CARE, 1e6);
        solution.samples.iter().map(|sample| sample.std / shift).collect::<Vec<f64>>()
    };
    for (tiny, small) in of(1e-200).iter().zip(of(1e-12)) {
        assert!((tiny / small - 1.0).abs() < 1e-9, "{tiny:e} {small:e}");
    }
}

#[test]
fn kinks_are_never_passed_unseen() {
    // right values by SciPy, split at the kink: the scene of `kink-eps-*.toml`
    for (epsilon, at_5, at_20) in [
        (0.01, 0.03842704172829, 0.02997076510222),
        (0.002, 0.03851597522984, 0.03004969279945),
        (1e-4, 0.03851960341790, 0.03005289493299),
        (1e-6, 0.03851961252292, 0.03005290296743),
    ] {
        let formula = Formula::Logarithmic { a_v: 0.0, epsilon, v0: 1.0 };
        let question = Question {
            formula,
            pedestrians: 20,
            length: 30.0,
            shift: 0.6,
            displacements: Vec::new(),
            times: vec![5.0, 20.0],
        };
        let solution = solve::<f64>(&question, Form::Differences, CARE, 1e6);
        for (sample, expected) in solution.samples.iter().zip([at_5, at_20]) {
            assert!((sample.std - expected).abs() < 2e-12, "eps = {epsilon}: {} for {expected}", sample.std);
        }
    }
}

#[test]
fn whoever_is_pushed_back_at_the_start_has_a_negative_speed_from_the_start() {
    let formula = Formula::Exponential { a: 30.0, b: 0.5, c: 0.0, a_v: 0.0, epsilon: 0.1, v0: 1.0 };
    let question =
        Question { formula, pedestrians: 20, length: 60.0, shift: 0.8, displacements: Vec::new(), times: vec![0.1] };
    let solution = solve::<f64>(&question, Form::Differences, CARE, 1e6);
    let first = solution.events.iter().find(|first| first.kind == Kind::NegativeSpeed).expect("an event");
    assert!(first.crossings[0].time < 1e-17, "{first:?}");
    assert_eq!(first.crossings.iter().filter(|crossing| crossing.time < 1e-17).count(), 19, "{first:?}");
}
