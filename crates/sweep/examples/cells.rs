//! Many short runs in one process, for `bench/cells.py`: `cells HOW METHOD TOLERANCE COUNT`. The ring is that of figure
//! 4, stable (67 pedestrians, t = 500); run `i` has the shift `1e-4 (1 + i / COUNT)`. Prints seconds of CPU for all
//! runs, and how many right-hand sides the last one took.
//!
//! | `HOW` | a run is |
//! |---|---|
//! | `run` | to the end, with events and the standard deviation of the speeds at t = 0, 1, 2, ... |
//! | `judged` | to the end with its events, judged, without samples |
//! | `cell` | a cell of a sweep: judged until its outcome is certain, a second time for the error |

use files::reader::Section;
use jam::run::{Judging, run, run_from};
use scene::run::Scene;
use std::time::Instant;
use sweep::Sweep;

fn main() -> Result<(), String> {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let [how, method, tolerance, count] = &arguments[..] else {
        return Err("usage: cells run|judged|cell METHOD TOLERANCE COUNT".to_owned());
    };
    let count: usize = count.parse().map_err(|_| format!("{count}: must be a number of runs"))?;
    let (law, run) = scene_text(method, tolerance);
    let mut evaluations = 0;
    let (start, clock) = (cpu_seconds(), Instant::now());
    match how.as_str() {
        "run" | "judged" => {
            let first = read_run(&format!("{law}[start]\nshift = 1e-4\n{run}"))?;
            for i in 0..count {
                evaluations = one(&first, how, 1e-4 * (1.0 + i as f64 / count as f64))?;
            }
        }
        "cell" => {
            let sweep = read_sweep(&format!(
                "{law}{run}[sweep]\nx = {{ parameter = \"shift\", from = 1e-4, to = 2e-4, cells = {count} }}\n\
                 y = {{ parameter = \"mu\", from = 0.4499, to = 0.4501, cells = 1 }}\n"
            ))?;
            for i in 0..count {
                sweep.compute([i, 0])?;
            }
        }
        _ => return Err(format!("{how}: must be run, judged or cell")),
    }
    let seconds = start.zip(cpu_seconds()).map_or(clock.elapsed().as_secs_f64(), |(start, end)| end - start);
    println!("{{\"seconds\": {seconds:e}, \"evaluations\": {evaluations}}}");
    Ok(())
}

/// The tables of the scene, before and behind `[start]`.
fn scene_text(method: &str, tolerance: &str) -> (String, String) {
    let law = "[law]\nkind = \"algebraic\"\nmu = 0.45\nq = 2.0\nv0 = 3.0\n[ring]\npedestrians = 67\nlength = 200.0\n";
    let run = format!(
        "[run]\nt_end = 500.0\nsample = 1.0\nmethod = \"{method}\"\ntolerance = {tolerance}\nrecord = \"std\"\n"
    );
    (law.to_owned(), run)
}

fn read_run(text: &str) -> Result<Scene, String> {
    let tables = Section::parse("cells", text).map_err(|error| error.to_string())?;
    scene::run::read("cells", &tables).map_err(|error| error.to_string())
}

/// A sweep takes no samples, and its axes stand in for `mu` and the start.
fn read_sweep(text: &str) -> Result<Sweep, String> {
    let text = text.replace("sample = 1.0\n", "").replace("record = \"std\"\n", "").replace("mu = 0.45\n", "");
    let tables = Section::parse("cells", &text).map_err(|error| error.to_string())?;
    sweep::read("cells", &tables).map_err(|error| error.to_string())
}

/// One run; its right-hand sides.
fn one(scene: &Scene, how: &str, shift: f64) -> Result<u64, String> {
    let mut scene = scene.clone();
    scene.start.shift = shift;
    let outcome = if how == "run" {
        run(&scene)
    } else {
        scene.sample = scene.t_end;
        run_from(&scene, None, &mut Judging::Along)
    };
    outcome.map(|outcome| outcome.statistics.evaluations).map_err(|broken| broken.to_string())
}

/// Seconds that this thread has been on a processor (Linux).
fn cpu_seconds() -> Option<f64> {
    // the kernel brings the count up to date when the thread is scheduled
    std::thread::yield_now();
    let text = std::fs::read_to_string("/proc/thread-self/schedstat").ok()?;
    Some(1e-9 * text.split(' ').next()?.parse::<f64>().ok()?)
}
