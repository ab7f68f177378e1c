//! Command-line values override those of a scene.

use crate::project::{figure, scene};
use jam::states::StateVariables;
use ode::{Control, Method};
use scene::Overrides;

#[test]
fn nothing_given_changes_nothing() {
    let tables = &figure("fig11").panels[0].tables;
    assert_eq!(&Overrides::default().apply(tables), tables);
}

#[test]
fn the_scheme_of_the_paper() {
    let plain = scene(&figure("fig04"), "stable", &Overrides::default());
    let paper = scene(&figure("fig04"), "stable", &Overrides::paper());
    assert_eq!((plain.form, plain.method), (StateVariables::Deviations, Method::Taylor));
    assert_eq!((paper.form, paper.method), (StateVariables::Positions, Method::Heun));
    assert_eq!(paper.control, Control::Fixed { step: 1e-5 });
    assert_eq!((paper.model, paper.ring, paper.t_end), (plain.model, plain.ring, plain.t_end));
}

#[test]
fn the_check_is_another_method_ten_times_tighter() {
    let check = scene(&figure("fig11"), "main", &Overrides::check(1e-11));
    assert_eq!((check.method, check.control), (Method::Extrapolation, Control::Adaptive { tolerance: 0.1 * 1e-11 }));
    assert_eq!(Overrides::check(1e-15).tolerance, Some(1e-15));
}

#[test]
fn step_and_tolerance_replace_each_other() {
    let parsed = figure("fig11");
    let fixed = Overrides { method: Some("rk4".to_owned()), dt: Some(0.01), ..Overrides::default() };
    let fixed_scene = scene(&parsed, "main", &fixed);
    assert_eq!((fixed_scene.method, fixed_scene.control), (Method::Rk4, Control::Fixed { step: 0.01 }));
    let back = Overrides { method: Some("dop853".to_owned()), tolerance: Some(1e-6), ..Overrides::default() };
    let tables = back.apply(&fixed.apply(&parsed.panels[0].tables));
    let adaptive = scene::run::read("my.toml", &tables).expect("a scene");
    assert_eq!(adaptive.control, Control::Adaptive { tolerance: 1e-6 });
    let times = Overrides { t_end: Some(7.0), sample: Some(0.5), ..Overrides::default() };
    let short = scene(&parsed, "main", &times);
    assert_eq!((short.t_end, short.sample), (7.0, 0.5));
}

#[test]
fn every_state_has_its_form() {
    let parsed = figure("fig11");
    let form = |state: Option<&str>| {
        scene(&parsed, "main", &Overrides { state: state.map(str::to_owned), ..Overrides::default() }).form
    };
    assert_eq!(form(None), StateVariables::Deviations);
    assert_eq!([form(Some("deviations")), form(Some("gaps"))], [StateVariables::Deviations, StateVariables::Spacings]);
    // the series of the method ask for gaps or deviations
    let positions =
        Overrides { method: Some("dop853".to_owned()), state: Some("positions".to_owned()), ..Overrides::default() };
    assert_eq!(scene(&parsed, "main", &positions).form, StateVariables::Positions);
}

#[test]
fn complaints_about_given_values_name_no_line() {
    let tables = Overrides { t_end: Some(-1.0), ..Overrides::default() }.apply(&figure("fig11").panels[0].tables);
    let error = scene::run::read("my.toml", &tables).expect_err("a negative time");
    assert_eq!(error.to_string(), "my.toml: run.t_end = -1: must be a number > 0.0");
}

#[test]
fn any_value_can_be_set_and_a_step_takes_the_place_of_a_tolerance() {
    use files::reader::{Section, Value};
    let text = "[law]\nv0 = 1.0\n[run]\ntolerance = 1e-9\nsample = 1.0";
    let tables = Section::parse("my.toml", text).expect("TOML");
    let values = [("law.v0", Value::Number(2.0)), ("run.dt", Value::Number(0.5)), ("map.x.cells", Value::Number(9.0))];
    let mut lines = Vec::new();
    scene::overrides::set(&tables, values).canonical("", &mut lines);
    assert_eq!(lines, ["law.v0 = 2.0", "map.x.cells = 9.0", "run.dt = 0.5", "run.sample = 1.0"]);
}

#[test]
fn a_scene_without_a_method_takes_taylors() {
    let text = |law: &str, run: &str| {
        format!(
            "[law]\nkind = \"algebraic\"\nmu = 0.45\nq = 2\nv0 = 3.0\n{law}\n[ring]\npedestrians = 10\nlength = 30.0\n[start]\nshift = 0.1\n[run]\nt_end = 5.0\nsample = 1.0\n{run}"
        )
    };
    let read = |law: &str, run: &str| {
        let file = files::scene_file::parse("own.toml", &text(law, run)).expect("TOML");
        scene::run::read("own.toml", &file.panels[0].tables)
    };
    let chosen = |law: &str, run: &str| {
        let scene = read(law, run).expect("a scene");
        (scene.method, scene.control)
    };
    let usual = Control::Adaptive { tolerance: 1e-10 };
    assert_eq!(chosen("", ""), (Method::Taylor, usual));
    assert_eq!(chosen("", "tolerance = 1e-7"), (Method::Taylor, Control::Adaptive { tolerance: 1e-7 }));
    assert_eq!(chosen("", "method = \"verner76\""), (Method::Verner76, usual));
    let missing = read("", "dt = 0.01").expect_err("steps of fixed length by no method").to_string();
    assert!(missing.contains("method"), "{missing}");
    let fixed = read("", "method = \"heun\"").expect_err("heun without dt").to_string();
    assert!(fixed.contains("heun") && fixed.contains("dt"), "{fixed}");
}
