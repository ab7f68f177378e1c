//! Killed runs are resumed; progress and estimated times.

use crate::shop::Shop;
use checkout::print::duration;
use xtask::child::Message;
use xtask::plan::{Node, Task};
use xtask::pool::Job;
use xtask::progress::Track;
use xtask::verbs::figures::{Forecast, forecast};

/// The checkpoints in the store.
fn checkpoints(shop: &Shop) -> usize {
    let names = std::fs::read_dir(shop.root.join("target/store")).into_iter().flatten().flatten();
    names.filter(|entry| entry.file_name().to_string_lossy().ends_with(".checkpoint")).count()
}

/// A checkout in which the run of figure 11 by the paper's scheme was killed.
fn killed(name: &str) -> Shop {
    let shop = Shop::new(name);
    shop.write("full", "killed");
    shop.xtask(&["figures", "--scheme", "paper", "11"]).expect(4);
    std::fs::remove_file(shop.root.join("full")).expect("a file");
    assert_eq!(checkpoints(&shop), 1);
    shop.calls();
    shop
}

#[test]
fn a_run_that_was_killed_goes_on_from_its_checkpoint() {
    let shop = killed("progress-killed");
    let ended = shop.xtask(&["figures", "--scheme", "paper", "11"]).expect(1);
    assert_eq!(shop.calls(), ["fig11-trajectories", "simulate main scheme resumed"]);
    assert!(ended.err.contains("the rest of a run that was killed"), "{}", ended.err);
    assert_eq!(checkpoints(&shop), 0);
    // the seconds of the rest are not those of the run
    let times: serde_json::Value = serde_json::from_str(&shop.read("target/xtask/times.json")).expect("JSON");
    assert!(times["fig11-trajectories (scheme paper)"].is_number());
    assert!(times["fig11 run main (scheme paper)"].is_null(), "{times}");
}

#[test]
fn a_forced_run_begins_anew() {
    let shop = killed("progress-forced");
    shop.xtask(&["figures", "--scheme", "paper", "11", "--force"]).expect(1);
    assert_eq!(shop.calls(), ["fig11-trajectories", "simulate main scheme"]);
}

#[test]
fn clean_removes_checkpoints() {
    let shop = killed("progress-clean");
    shop.xtask(&["clean"]).expect(0);
    assert_eq!(checkpoints(&shop), 0);
}

#[test]
fn words_about_progress_reach_no_log() {
    let shop = Shop::new("progress-log");
    shop.xtask(&["figures", "11"]).expect(1);
    assert_eq!(shop.read("target/xtask/log/fig11-run-main.txt"), "");
    assert_eq!(Message::parse("progress 0.42"), Some(Message::Progress(0.42)));
    assert_eq!(Message::parse("resumed 0.4"), Some(Message::Resumed(0.4)));
    for other in ["progress", "progress far", "no space left on device", ""] {
        assert_eq!(Message::parse(other), None, "{other}");
    }
}

#[test]
fn what_is_left_follows_from_the_pace_since_the_start() {
    let track = |from, done, seconds| Track { from, done, seconds };
    assert_eq!(track(0.0, 0.25, 30.0).left(), Some(90.0));
    // a quarter in 30 s, after half of it had been done before
    assert_eq!(track(0.5, 0.75, 30.0).left(), Some(30.0));
    assert_eq!(track(0.5, 0.5, 3.0).left(), None);
    assert_eq!(track(0.0, 0.25, 100.0).words(), "25 %, about 5 min left");
    assert_eq!([48.2, 90.0, 5400.0].map(duration), ["48 s", "2 min", "1.5 h"]);
}

#[test]
fn a_forecast_is_the_longest_chain_or_an_even_share() {
    let node = |name: &str, after: &[usize]| Node {
        name: name.to_owned(),
        task: Task::Draw { figure: 0 },
        job: Job { after: after.to_vec(), weight: 1.0 },
    };
    let nodes = [node("10", &[]), node("4", &[0]), node("5", &[]), node("new", &[2])];
    let last = |node: &Node| node.name.parse().ok();
    let seconds = |threads| forecast(&nodes, threads, &last);
    assert_eq!(seconds(1), Forecast { seconds: 19.0, unknown: 1 });
    assert_eq!(seconds(2), Forecast { seconds: 14.0, unknown: 1 });
    assert_eq!(forecast(&[], 2, &last), Forecast { seconds: 0.0, unknown: 0 });
}

#[test]
fn a_dry_run_says_how_long_it_takes() {
    let shop = Shop::new("progress-dry");
    let dry = || shop.xtask(&["figures", "11", "--dry-run"]).expect(0).out;
    assert!(dry().contains("about 0 s judging by the last run; 3 nodes not counted"), "{}", dry());
    std::fs::create_dir_all(shop.root.join("target/xtask")).expect("a folder");
    shop.write("target/xtask/times.json", "{\"fig11 run main\": 200.0, \"fig11 check main\": 20.0}");
    assert!(dry().contains("about 3 min judging by the last run; 1 nodes not counted"), "{}", dry());
    let json = shop.xtask(&["figures", "11", "--dry-run", "--json"]).expect(0).json();
    assert_eq!((json["seconds"].as_f64(), json["nodes_without_time"].as_u64()), (Some(200.0), Some(1)));
}
