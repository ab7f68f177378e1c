//! What `figures`, `verify` and `clean` report and leave behind when something goes wrong.

use crate::shop::{blessed, temporary};

#[test]
fn a_figure_that_fails_is_neither_the_same_nor_cached() {
    let shop = blessed("troubles-figure");
    shop.write("full", "fig05-exponential-map");
    let json = shop.xtask(&["figures", "5", "--force", "--json"]).expect(4).json();
    let figure = &json["figures"][0];
    assert_eq!((&json["ok"], &figure["state"], &figure["cached"]), (&false.into(), &"failed".into(), &false.into()));
    assert_eq!(json["failed"][0], "fig05-exponential-map");
    let ended = shop.xtask(&["figures", "5", "--force"]).expect(4);
    assert!(ended.out.contains("failed") && !ended.out.contains("cached"), "{}", ended.out);
    assert!(temporary(&shop.root).is_empty(), "{:?}", temporary(&shop.root));
    std::fs::remove_file(shop.root.join("full")).expect("a file");
    assert_eq!(shop.xtask(&["figures", "5", "--force", "--json"]).expect(0).json()["ok"], true);
}

#[test]
fn a_figure_whose_run_fails_is_skipped() {
    let shop = blessed("troubles-run");
    shop.write("full", "simulate");
    let json = shop.xtask(&["figures", "11", "5", "--force", "--keep-going", "--json"]).expect(4).json();
    let states: Vec<&str> = (0..2).filter_map(|index| json["figures"][index]["state"].as_str()).collect();
    assert_eq!(states, ["same", "skipped"]);
    assert_eq!((&json["ok"], &json["skipped"][0]), (&false.into(), &"fig11-trajectories".into()));
    assert!(temporary(&shop.root).is_empty(), "{:?}", temporary(&shop.root));
}

#[test]
fn a_check_that_fails_is_told() {
    let shop = blessed("troubles-check");
    shop.write("full", "check");
    let json = shop.xtask(&["figures", "11", "--force", "--keep-going", "--json"]).expect(4).json();
    assert_eq!((&json["ok"], &json["failed"][0]), (&false.into(), &"fig11 check main".into()));
}

#[test]
fn leftovers_are_swept_by_the_next_run_and_by_clean() {
    let shop = blessed("troubles-sweep");
    for arguments in [&["figures"][..], &["clean"]] {
        for name in [
            "data/fig04.tmp-1/half.csv",
            "data/paper-scheme/fig04.tmp-1/half.csv",
            "target/store/0123.tmp-1/half.csv",
            "target/xtask/report/fig05.json.tmp-1",
            "figures/fig05-exponential-map/fig05.png.tmp-1",
        ] {
            shop.write(name, "half");
        }
        shop.xtask(arguments).expect(0);
        assert!(temporary(&shop.root).is_empty(), "{arguments:?}: {:?}", temporary(&shop.root));
    }
}

#[test]
fn a_verify_that_fails_leaves_no_scratch() {
    let shop = blessed("troubles-verify");
    shop.write("full", "fig05-exponential-map");
    shop.xtask(&["verify", "5"]).expect(4);
    let mut names = std::fs::read_dir(shop.root.join("target")).expect("target").flatten();
    assert!(!names.any(|entry| entry.file_name().to_string_lossy().starts_with("verify-")));
}

#[test]
fn verify_compares_events() {
    let shop = blessed("troubles-events");
    let verdicts = || {
        let json = shop.xtask(&["verify", "4", "--json"]).expect(1).json();
        let figure = json["figures"][0].clone();
        (figure["bytes"]["verdict"].clone(), figure["numbers"]["verdict"].clone(), figure["numbers"]["events"].clone())
    };
    // another text for the same time: other bytes, the same number
    shop.edit("data/events.csv", "fig04-stable,overlap,12.5,7", "fig04-stable,overlap,12.50,7");
    let (bytes, numbers, _) = verdicts();
    assert_eq!((bytes, numbers), ("differs".into(), "same".into()));
    // the double after 12.5
    shop.edit("data/events.csv", "fig04-stable,overlap,12.50,7", "fig04-stable,overlap,12.500000000000002,7");
    let (bytes, numbers, events) = verdicts();
    assert_eq!((bytes, numbers, events[0]["ulp"].as_u64()), ("differs".into(), "differs".into(), Some(1)));
    assert!(events[0]["absolute"].as_f64().is_some_and(|distance| distance > 0.0 && distance < 2e-15));
    let ended = shop.xtask(&["verify", "4"]).expect(1);
    assert!(ended.out.contains("fig04-stable, overlap at pedestrian 7: expected t = "), "{}", ended.out);
    // an event of another pedestrian
    shop.edit("data/events.csv", "fig04-stable,overlap,12.500000000000002,7", "fig04-stable,overlap,12.5,8");
    let ended = shop.xtask(&["verify", "4"]).expect(1);
    assert!(ended.out.contains("overlap at pedestrian 8: did not occur"), "{}", ended.out);
    assert!(ended.out.contains("overlap at pedestrian 7: new, at t = 12.5"), "{}", ended.out);
    shop.xtask(&["verify", "12"]).expect(0);
}

#[test]
fn verify_tells_stray_and_missing_lines() {
    let shop = blessed("troubles-lines");
    let (sums, events) = (shop.read("data/SHA256SUMS"), shop.read("data/events.csv"));
    shop.write("data/SHA256SUMS", &format!("{sums}{}  data/fig99/left.csv\n", "0".repeat(64)));
    shop.write("data/events.csv", &format!("{events}fig99-main,overlap,1,0,1e-15\n"));
    let ended = shop.xtask(&["verify"]).expect(1);
    assert!(ended.out.contains("belongs to no figure: data/fig99/left.csv"), "{}", ended.out);
    assert!(ended.out.contains("belongs to no figure: data/events.csv, scene fig99-main"), "{}", ended.out);
    shop.xtask(&["verify", "5"]).expect(0);
    let shorter: String = sums.lines().filter(|line| !line.contains("fig05/left")).map(|l| format!("{l}\n")).collect();
    shop.write("data/SHA256SUMS", &shorter);
    shop.write("data/events.csv", &events);
    let ended = shop.xtask(&["verify"]).expect(1);
    assert!(ended.out.contains("new: data/fig05/left.csv"), "{}", ended.out);
    shop.write("data/events.csv", "scene,event\n");
    let ended = shop.xtask(&["verify"]).expect(2);
    assert!(ended.err.contains("data/events.csv:1:"), "{}", ended.err);
}

#[test]
fn an_error_above_the_bound_is_told_with_table_and_column() {
    let shop = blessed("troubles-bound");
    for (error, words) in [("2e-8", "2.0e-8 of the data range"), ("null", "unknown"), ("1e-8", "")] {
        shop.write("report.json", &format!("{{\"tables\": {{\"left\": {{\"error\": {{\"phi\": {error}}}}}}}}}"));
        let ended = shop.xtask(&["figures", "5", "--force"]).expect(i32::from(!words.is_empty()));
        assert!(ended.out.contains("fig05"), "{}", ended.out);
        let told = ended.err.contains(&format!("error of data/fig05/left.csv, column phi: {words}"));
        assert_eq!(told, !words.is_empty(), "{}", ended.err);
        // and again when nothing is left to do
        let json = shop.xtask(&["figures", "5", "--json"]).expect(i32::from(!words.is_empty())).json();
        assert_eq!(json["ok"], words.is_empty());
    }
}

#[test]
fn seconds_of_the_two_schemes_are_kept_apart() {
    let shop = blessed("troubles-times");
    let times = || serde_json::from_str::<serde_json::Value>(&shop.read("target/xtask/times.json")).expect("JSON");
    let before = times();
    shop.xtask(&["figures", "--scheme", "paper", "4"]).expect(1);
    assert_eq!(times()["fig04-growth"], before["fig04-growth"]);
    assert!(times()["fig04-growth (scheme paper)"].is_number());
}

#[test]
fn the_page_for_browsers_is_no_source() {
    let shop = blessed("troubles-browser");
    shop.write("crates/browser/src/lib.rs", "//! A page.\n");
    shop.xtask(&["status", "--exit-code"]).expect(0);
    shop.xtask(&["figures"]).expect(0);
    assert!(shop.calls().is_empty());
}

#[test]
fn a_thread_that_panics_is_a_failure_and_no_missing_file() {
    let paths = vec![std::path::PathBuf::from("a"), "b".into()];
    let hash = |path: &std::path::Path| if path.ends_with("b") { panic!("on purpose") } else { Ok(None) };
    let failure = checkout::hashing::hash_by(&paths, &hash).expect_err("a failure");
    assert_eq!(failure.code(), 4);
}

#[test]
fn records_that_are_not_as_written_count_as_none() {
    let shop = blessed("troubles-records");
    let events = shop.read("data/events.csv");
    // a digit of an event, which would go into the table of events
    shop.edit("target/xtask/state.json", "fig04-stable,overlap,12.5,7", "fig04-stable,overlap,12.6,7");
    shop.xtask(&["figures"]).expect(0);
    assert_eq!(shop.read("data/events.csv"), events);
    assert!(shop.calls().contains(&"fig04-growth".to_owned()));
    // no text at all
    std::fs::write(shop.root.join("target/xtask/state.json"), [0xff, 0xfe]).expect("a file");
    std::fs::write(shop.root.join("target/xtask/times.json"), [0xff, 0xfe]).expect("a file");
    shop.xtask(&["figures"]).expect(0);
}

#[test]
fn whatever_has_the_name_of_an_output_gives_way() {
    let shop = blessed("troubles-names");
    for name in ["figures/fig05-exponential-map/fig05.png", "data/fig06/left.csv", "target/xtask/report/fig06.json"] {
        std::fs::remove_file(shop.root.join(name)).expect("a file");
        std::fs::create_dir_all(shop.root.join(name).join("inside")).expect("a folder");
    }
    let tables = shop.root.join("data/fig12");
    std::fs::remove_dir_all(&tables).expect("a folder");
    shop.write("data/fig12", "a file");
    let ended = shop.xtask(&["status"]).expect(0);
    assert_eq!(ended.out.matches("stale").count(), 3, "{}", ended.out);
    shop.xtask(&["figures"]).expect(0);
    shop.xtask(&["status", "--exit-code"]).expect(0);
}

#[test]
fn a_folder_that_two_threads_want_at_once_loses_nothing() {
    let folder = std::path::Path::new(env!("CARGO_TARGET_TMPDIR")).join("troubles-at-once");
    for round in 0..300 {
        let _ = std::fs::remove_dir_all(&folder);
        // every second time a file is in the way
        if round % 2 == 1 {
            std::fs::write(&folder, "a file").expect("a file");
        }
        let start = std::sync::Barrier::new(3);
        let write = &|name: &str| {
            start.wait();
            checkout::disk::own_folder(&folder).expect("a folder");
            std::fs::write(folder.join(name), "kept").expect("the folder stays");
        };
        std::thread::scope(|scope| ["a", "b", "c"].map(|name| scope.spawn(move || write(name))).map(|_| ()));
        assert_eq!(checkout::disk::names(&folder).expect("names"), ["a", "b", "c"]);
    }
}

#[test]
fn a_stored_run_whose_list_has_lost_a_line_is_made_again() {
    let shop = blessed("troubles-list");
    for entry in std::fs::read_dir(shop.root.join("target/store")).expect("a store") {
        let list = entry.expect("a run").path().join("SHA256SUMS");
        let text = std::fs::read_to_string(&list).expect("sums");
        let kept: String =
            text.lines().filter(|line| !line.ends_with("std.csv")).map(|line| format!("{line}\n")).collect();
        std::fs::write(&list, kept).expect("sums");
        std::fs::write(list.with_file_name("std.csv"), "t,std\n0,1\n").expect("a table");
    }
    shop.edit("crates/plot/src/lib.rs", "Pictures", "Better pictures");
    shop.xtask(&["figures", "12"]).expect(0);
    assert_eq!(shop.calls(), ["cargo", "fig12-speeds", "simulate main", "simulate main check"]);
}

#[test]
fn a_folder_is_replaced_whole_or_left_as_it_was() {
    let folder = tempfile::tempdir().expect("a folder");
    let at = |name: &str| folder.path().join(name);
    let make = |name: &str, file: &str| {
        std::fs::create_dir_all(at(name)).expect("a folder");
        std::fs::write(at(name).join(file), file).expect("a file");
    };
    make("new", "b.csv");
    checkout::disk::replace_folder(&at("new"), &at("data")).expect("nothing is in the way");
    make("new", "c.csv");
    checkout::disk::replace_folder(&at("new"), &at("data")).expect("the old one goes");
    let left =
        || (checkout::disk::names(folder.path()).expect("names"), checkout::disk::names(&at("data")).expect("names"));
    assert_eq!(left(), (vec!["data".to_owned()], vec!["c.csv".to_owned()]));
    // nothing to put there: the old one is back
    assert!(checkout::disk::replace_folder(&at("new"), &at("data")).is_err());
    assert_eq!(left(), (vec!["data".to_owned()], vec!["c.csv".to_owned()]));
}

#[test]
fn the_lock_is_shared_within_a_process_and_kept_from_others() {
    let shop = crate::shop::Shop::new("troubles-lock");
    let paths = checkout::paths::Paths::find(Some(shop.root.clone())).expect("the checkout");
    let lock = xtask::lock::Lock::take(&paths).expect("free");
    drop(xtask::lock::Lock::take(&paths).expect("ours already"));
    let is_held = || {
        let file = std::fs::File::open(paths.lock()).expect("the lock file");
        matches!(file.try_lock(), Err(std::fs::TryLockError::WouldBlock))
    };
    assert!(is_held());
    drop(lock);
    assert!(!is_held());
}

#[test]
fn a_plan_of_nothing_known_takes_no_negative_time() {
    let nothing = xtask::verbs::figures::forecast(&[], 2, &|_| None);
    assert!(nothing.seconds == 0.0 && nothing.seconds.is_sign_positive(), "{nothing:?}");
    assert!(nothing.to_string().starts_with("about 0 s"), "{nothing}");
}

#[test]
fn a_changed_source_that_is_older_than_the_programs_is_compiled_all_the_same() {
    let shop = blessed("troubles-older");
    shop.edit("crates/math/src/lib.rs", "Numbers", "Better numbers");
    let file = std::fs::File::options().append(true).open(shop.root.join("crates/math/src/lib.rs")).expect("a source");
    file.set_modified(std::time::UNIX_EPOCH).expect("a date");
    shop.xtask(&["figures", "5"]).expect(0);
    assert_eq!(shop.calls()[..2], ["cargo", "cargo clean"]);
    let kept = file.metadata().and_then(|data| data.modified()).expect("a date");
    assert_eq!(kept, std::time::UNIX_EPOCH, "the date of a source is its owner's");
}

#[test]
fn what_is_cleared_is_built_again_for_figures_and_supplements() {
    let shop = blessed("troubles-cleared");
    shop.xtask(&["figures", "--all"]).expect(1);
    shop.edit("crates/math/src/lib.rs", "Numbers", "Better numbers");
    let file = std::fs::File::options().append(true).open(shop.root.join("crates/math/src/lib.rs")).expect("a source");
    file.set_modified(std::time::UNIX_EPOCH).expect("a date");
    shop.calls();
    shop.xtask(&["figures", "--all"]).expect(1);
    assert!(shop.calls().starts_with(&["cargo".to_owned(), "cargo".to_owned(), "cargo clean".to_owned()]));
    shop.xtask(&["status", "--all", "--exit-code"]).expect(0);
}
