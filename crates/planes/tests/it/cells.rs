//! Cells: the same bytes however the plane is divided, and the outcomes of the corresponding runs.

use super::*;

#[test]
fn every_split_order_and_number_of_threads_gives_the_same_bytes() {
    let place = SceneFolder::new(PLANE);
    place.succeed("one", &["--jobs", "1"]);
    let expected = place.results("one");
    let classes = place.read("one/summary.json");
    let classes: Value = serde_json::from_str(&classes).expect("JSON");
    assert_eq!(classes["cells"], 1800);
    // a plane on which nothing happens would prove nothing
    for class in ["contact", "decays", "undecided"] {
        assert!(classes["outcomes"][class].as_u64().is_some_and(|cells| cells > 20), "{classes}");
    }
    assert!(classes["run"].as_u64().is_some_and(|run| run > 500 && run < 1700), "{classes}");
    place.succeed("two", &["--jobs", "2"]);
    assert_eq!(place.results("two"), expected);
    for (count, order) in [(2, vec![2, 1]), (3, vec![3, 1, 2]), (6, vec![4, 6, 5, 1, 3, 2])] {
        let out = format!("split-{count}");
        for (index, shard) in order.iter().enumerate() {
            let jobs = if index % 2 == 0 { "2" } else { "1" };
            place.succeed(&out, &["--shard", &format!("{shard}/{count}"), "--jobs", jobs]);
        }
        place.succeed(&out, &["--gather"]);
        assert_eq!(place.results(&out), expected, "{count} shards");
    }
}

#[test]
fn filled_cells_have_the_outcome_that_their_run_has() {
    let place = SceneFolder::new(&replace(PLANE, "cells = 60", "cells = 30"));
    place.succeed("refined", &[]);
    place.edit("scene.toml", |text| format!("{text}refine = false\n"));
    place.succeed("every", &[]);
    let [refined, every] = ["refined", "every"].map(|out| place.read(&format!("{out}/cells.csv")));
    let fields = |line: &str| line.split(',').map(str::to_owned).collect::<Vec<String>>();
    let (mut filled, mut differ) = (0, Vec::new());
    for (one, all) in refined.lines().zip(every.lines()).skip(1) {
        let (one_fields, all_fields) = (fields(one), fields(all));
        if one_fields[4] == "neighbours" {
            filled += 1;
            if one_fields[..4] != all_fields[..4] {
                differ.push(all.to_owned());
            }
        } else {
            assert_eq!(one, all, "a cell that was run");
        }
    }
    assert_eq!(refined.lines().count(), every.lines().count());
    assert!(filled > 100, "{filled}");
    assert!(differ.is_empty(), "{} of {filled}: {differ:#?}", differ.len());
}

#[test]
fn a_dry_run_computes_nothing_and_names_the_commands() {
    let place = SceneFolder::new(&small());
    let said = place.succeed("out", &["--dry-run"]);
    for word in ["900 cells", "4 tiles", "--shard", "--gather"] {
        assert!(said.contains(word), "{said}");
    }
    let said: Value = serde_json::from_str(&place.succeed("out", &["--dry-run", "--json"])).expect("JSON");
    assert_eq!((&said["cells"], &said["tiles"]), (&900.into(), &4.into()));
    assert!(!place.path("out").exists());
    // as many are computed as it says at least
    place.succeed("out", &[]);
    let summary: Value = serde_json::from_str(&place.read("out/summary.json")).expect("JSON");
    assert!(said["computed_at_least"].as_u64() <= summary["run"].as_u64(), "{said} {summary}");
}
