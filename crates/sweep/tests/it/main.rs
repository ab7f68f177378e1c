//! Parallel tiles: each cell is computed once, the cells are the same for any number of threads, and a request to stop
//! is obeyed.

use files::scene_file;
use std::sync::Mutex;
use sweep::tiles::{Found, tiles};
use sweep::{Pool, Sweep, read};

/// 30 x 28 cells in four tiles, each cell a run of a moment.
fn sweep() -> Sweep {
    let text = "[law]\nkind = \"logarithmic\"\nepsilon = 0.01\n[ring]\npedestrians = 6\nlength = 9.0\n[start]\nshift = 0.1\n[run]\nt_end = 20.0\nmethod = \"dop853\"\ntolerance = 1e-4\n[sweep]\nx = { parameter = \"a_v\", from = 0.0, to = 0.6, cells = 30 }\ny = { parameter = \"v0\", from = 0.5, to = 3.0, cells = 28 }\n";
    let parsed = scene_file::parse("own.toml", text).expect("TOML");
    read("own.toml", &parsed.panels[0].tables).expect("a sweep")
}

/// All cells as text, which shows a NaN equal to another; and those that were heard of.
fn computed(sweep: &Sweep, known: Vec<Found>, jobs: usize) -> (Vec<String>, Vec<Found>) {
    let heard = Mutex::new(Vec::new());
    let pool = Pool::new(sweep, tiles(sweep), known);
    let found = pool.compute(jobs, &|found| {
        heard.lock().expect("no panic").push(*found);
        Ok::<(), String>(())
    });
    assert_eq!(pool.done(), pool.tiles());
    let text = found.expect("no error").expect("not stopped").iter().map(|found| format!("{found:?}")).collect();
    (text, heard.into_inner().expect("no panic"))
}

#[test]
fn any_number_of_threads_finds_the_same_and_runs_each_cell_once() {
    let sweep = sweep();
    let (one, heard) = computed(&sweep, Vec::new(), 1);
    let (three, again) = computed(&sweep, Vec::new(), 3);
    assert_eq!(one, three);
    let places = |mut heard: Vec<Found>| {
        heard.sort_by_key(|(cell, _)| *cell);
        heard.into_iter().map(|(cell, _)| cell).collect::<Vec<_>>()
    };
    let (first, second) = (places(heard.clone()), places(again));
    assert_eq!(first, second);
    assert!(first.windows(2).all(|pair| pair[0] != pair[1]), "a cell was run twice");
    let (known, none) = computed(&sweep, heard, 2);
    assert_eq!((known, none.len()), (one, 0));
}

#[test]
fn it_ends_when_it_is_stopped_and_when_who_hears_of_a_cell_cannot_go_on() {
    let sweep = sweep();
    let pool = Pool::new(&sweep, tiles(&sweep), Vec::new());
    let stopped = pool.compute(2, &|_| {
        pool.stop();
        Ok::<(), String>(())
    });
    assert!(stopped.expect("no error").is_none());
    assert!(pool.done() < pool.tiles());
    let pool = Pool::new(&sweep, tiles(&sweep), Vec::new());
    let failed = pool.compute(2, &|([i, j], _)| Err(format!("no room for {i}, {j}")));
    assert!(failed.expect_err("it cannot go on").starts_with("no room for "));
}

/// A plane of the algebraic law with widening; `uniform` gives the flow, or an axis does.
fn widened(uniform: &str, y: &str) -> Result<Sweep, String> {
    let text = format!(
        "[law]\nkind = \"algebraic\"\nq = 2.0\nv0 = 3.0\nepsilon = 0.1\nmu = 0.4\n{uniform}\n[start]\nshift = 0.1\n[run]\nt_end = 20.0\nmethod = \"dop853\"\ntolerance = 1e-6\n[sweep]\nx = {{ parameter = \"a_v\", from = 0.0, to = 0.3, cells = 3 }}\ny = {y}\n"
    );
    let parsed = scene_file::parse("own.toml", &text).expect("TOML");
    read("own.toml", &parsed.panels[0].tables).map_err(|error| error.to_string())
}

#[test]
fn a_gap_of_the_uniform_flow_gives_each_cell_the_ring_that_an_axis_of_gaps_gives_it() {
    let delta = "{ parameter = \"delta\", from = 0.0, to = 0.5, cells = 2 }";
    let given = widened("[uniform]\nd_gap = 1.5\n[ring]\npedestrians = 6", delta).expect("a sweep").compute([2, 0]);
    let gaps = "{ parameter = \"d_gap\", from = 1.0, to = 2.0, cells = 1 }";
    let axis = widened("delta = 0.125\n[ring]\npedestrians = 6", gaps).expect("a sweep").compute([2, 0]);
    assert_eq!(format!("{given:?}"), format!("{axis:?}"));
    let length = widened("[ring]\npedestrians = 6\nlength = 30.0", delta).expect("a sweep").compute([2, 0]);
    assert_ne!(format!("{given:?}"), format!("{length:?}"));
    for (uniform, y, told) in [
        ("[uniform]\nd_gap = 1.5\n[ring]\npedestrians = 6\nlength = 30.0", delta, "own.toml:11: ring.length"),
        ("[uniform]\nd_gap = 1.5\n[ring]\npedestrians = 6", gaps, "own.toml:8: uniform.d_gap = 1.5"),
        ("[uniform]\nd_gap = -1.5\n[ring]\npedestrians = 6", delta, "own.toml:8: uniform.d_gap = -1.5"),
        ("[uniform]\nheadway = 1.5\n[ring]\npedestrians = 6", delta, "uniform.d_gap"),
    ] {
        let complaint = widened(uniform, y).expect_err("a complaint");
        assert!(complaint.contains(told), "{told}: {complaint}");
    }
}

#[test]
fn only_a_formula_without_a_value_is_undefined() {
    let mut foreign = sweep();
    foreign.x.parameter = "mu".to_owned();
    for problem in [foreign.place([0, 0]).err(), foreign.compute([0, 0]).err()] {
        let problem = problem.expect("the logarithmic law has no mu");
        assert!(problem.starts_with("at mu = 0.01, v0 = ") && problem.contains("no parameter mu"), "{problem}");
    }
    let text = "[law]\nkind = \"formula\"\nbody = 0.4\nv0 = 1.0\nacceleration = \"v0*tanh(s - body) - v + ln(a)*v\"\n\
                [ring]\npedestrians = 6\n[start]\nshift = 0.1\n[run]\nt_end = 20.0\n[sweep]\n\
                x = { parameter = \"a\", from = -1.0, to = 1.0, cells = 2 }\n\
                y = { parameter = \"headway\", from = 1.0, to = 2.0, cells = 2 }\n";
    let parsed = scene_file::parse("own.toml", text).expect("TOML");
    let sweep = read("own.toml", &parsed.panels[0].tables).expect("a sweep");
    let classes = [0, 1].map(|i| sweep.place([i, 0]).expect("a place").class);
    assert_eq!(classes, [Some(jam::outcome::Class::Undefined), None]);
}
