//! A law that is a user-defined Rust type: it gives what the same formula gives, and invalid ones are refused.

use jam::events::EventKind;
use jam::laws::{Formula, Law, Model, Parameter, Range};
use jam::precise::Precise;
use jam::ring::{Ring, Start};
use jam::stability::Waves;
use jam::states::StateVariables;
use jam::uniform::steady_speed;
use math::number::Number;
use ode::{Control, Method, Problem, Step, integrate};
use std::ops::ControlFlow;

/// The optimal-velocity law of Bando et al. (1995) with a rate of relaxation, `kappa (tanh(s - 2) + tanh 2 - v)`, and
/// faults that can be switched on.
#[derive(Clone, Copy, Debug, Default)]
pub struct OptimalVelocity {
    pub kappa: f64,
    /// 1: an effective gap that is not linear; 2: one that is not 0 at contact; 3: an infinite force at contact.
    pub fault: u8,
}

impl Law for OptimalVelocity {
    const PARAMETERS: &'static [Parameter<OptimalVelocity>] =
        &[Parameter { name: "kappa", range: Range::Positive, default: None, place: |law| &mut law.kappa }];
    const CONTACT: f64 = 0.0;

    #[inline(always)]
    fn acceleration<X: Number>(&self, s: X, v: X, _ahead: X) -> X {
        let law = ((s - 2.0).tanh() + 0.964_027_580_075_816_9 - v) * self.kappa;
        if self.fault == 3 { law + s.ln() } else { law }
    }
    #[inline(always)]
    fn effective_gap<X: Number>(&self, s: X, v: X, _ahead: X) -> X {
        match self.fault {
            1 => s - v.powi(2),
            2 => s - 0.25,
            _ => s,
        }
    }
}

/// The law, and the same as a formula.
pub fn pair(kappa: f64) -> [Model; 2] {
    let formula = Formula::written(&[
        ("acceleration", "(tanh(s - 2) + 0.9640275800758169 - v)*kappa".into()),
        ("kappa", kappa.into()),
        ("body", 0.0.into()),
    ]);
    [Model::own(OptimalVelocity { kappa, fault: 0 }).expect("a law"), Model::Formula(formula.expect("a formula"))]
}

const RING: Ring = Ring { pedestrians: 50, length: 100.0 };

/// Gaps and speeds at the end of a run.
fn end(model: &Model, form: StateVariables, method: Method, tolerance: f64) -> [Vec<f64>; 2] {
    let form = form.build(model, RING);
    let start = form.start(Start { shift: 0.1 });
    let control = Control::Adaptive { tolerance };
    let problem = Problem { system: &*form, start: &start, begin: 0.0, end: 60.0, method, control };
    let state = integrate(&problem, &mut |_: &mut Step<'_>| ControlFlow::Continue(())).expect("it runs").state;
    let (mut gaps, mut speeds) = (vec![0.0; 50], vec![0.0; 50]);
    form.read(&state, &mut gaps, &mut speeds);
    [gaps, speeds]
}

#[test]
fn a_private_law_has_the_bits_of_its_formula() {
    let [own, formula] = pair(0.6);
    for form in [StateVariables::Deviations, StateVariables::Spacings, StateVariables::Positions] {
        let ends = [&own, &formula].map(|model| end(model, form, Method::Dop853, 1e-9));
        assert!(ends[0] == ends[1], "{form:?}");
    }
    let [speed, other] = [&own, &formula].map(|model| steady_speed(model, 2.0).expect("a uniform flow"));
    assert_eq!(speed, other);
    let [one, two] = [&own, &formula].map(|model| model.response(2.0, speed).expect("derivatives").margin(Waves::All));
    assert!((one.0 - two.0).abs() < 1e-14 && one.0 > 0.0, "{one:?} {two:?}");
    let precise = Precise::new(&own, 2.0, speed).margin();
    assert!((precise - one.0).abs() < 1e-12, "{precise} {one:?}");
}

/// It was told to depend on no speed but by `-v`, and lost half of its digits in silence.
#[test]
fn a_relaxation_at_another_rate_keeps_the_digits_of_taylors_method() {
    for kappa in [0.3, 0.6, 1.7] {
        let [own, _] = pair(kappa);
        let [taylor, other] = [(Method::Taylor, 1e-11), (Method::Dop853, 1e-12)]
            .map(|(method, tolerance)| end(&own, StateVariables::Deviations, method, tolerance));
        for (a, b) in taylor.iter().flatten().zip(other.iter().flatten()) {
            assert!((a - b).abs() < 1e-9, "kappa = {kappa}: {a} {b}");
        }
    }
}

#[test]
fn parameters_are_known_by_name() {
    let [own, _] = pair(0.6);
    assert_eq!((own.name(), own.parameters()), ("own", vec!["kappa".to_owned()]));
    let other = own.with("kappa", 2.0).expect("a parameter");
    assert_eq!(other.acceleration(2.0, 0.0, 0.0), 2.0 * 0.964_027_580_075_816_9);
    assert!(own == own.clone() && own != other);
    assert!(own.with("mu", 1.0).unwrap_err().contains("kappa"));
    let error = own.with("kappa", -1.0).unwrap_err();
    assert!(error.contains("kappa = -1.0") && error.contains("above 0"), "{error}");
}

#[test]
fn what_would_give_wrong_numbers_is_refused() {
    for (fault, words) in [(1, "effective gap"), (2, "-0.25"), (3, "SINGULAR = false")] {
        let error = Model::own(OptimalVelocity { kappa: 1.0, fault }).unwrap_err();
        assert!(error.contains(words) && error.contains("OptimalVelocity"), "{error}");
    }
}

/// The ring is closed so tightly that a shifted pedestrian touches the next.
#[test]
fn events_of_a_private_law_are_those_of_its_formula() {
    let found = pair(0.6).map(|model| {
        let form = StateVariables::Spacings.build(&model, RING);
        let start = form.start(Start { shift: 1.9 });
        let mut rates = vec![0.0; start.len()];
        form.rates(&start, &mut rates);
        let mut watch = jam::events::Watch::new(model.clone(), &*form, 50);
        watch.start(0.0, &start, &rates);
        let (method, control) = (Method::Dop853, Control::Adaptive { tolerance: 1e-10 });
        let problem = Problem { system: &*form, start: &start, begin: 0.0, end: 100.0, method, control };
        integrate(&problem, &mut |step: &mut Step<'_>| {
            watch.look(step);
            ControlFlow::Continue(())
        })
        .expect("it runs");
        watch.found().to_vec()
    });
    assert!(found[0] == found[1] && found[0].iter().any(|event| event.kind == EventKind::NegativeSpeed), "{found:?}");
}

/// A law of more operations than any of the paper has.
#[derive(Clone, Copy, Debug, Default)]
struct Long;

impl Law for Long {
    const CONTACT: f64 = 0.0;

    #[inline(always)]
    fn acceleration<X: Number>(&self, s: X, v: X, ahead: X) -> X {
        let near = (s + 1.0).powf(1.5).recip() + (-s).exp() + (s + 1.0).ln() * (s + 1.0).sqrt();
        let seen = ((ahead - v) * s).tanh() + (v - ahead).softplus();
        (s - 2.0).tanh() + 1.0 - v + (near + seen) * 0.01
    }
}

#[test]
fn a_law_of_many_operations_runs_by_taylors_method() {
    let long = Model::own(Long).expect("a law");
    let taylor = end(&long, StateVariables::Spacings, Method::Taylor, 1e-11);
    let other = end(&long, StateVariables::Spacings, Method::Dop853, 1e-12);
    for (a, b) in taylor.iter().flatten().zip(other.iter().flatten()) {
        assert!((a - b).abs() < 1e-9, "{a} {b}");
    }
}
