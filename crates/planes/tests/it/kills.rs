//! Sweeps cut short by a kill, a full disk, or a folder that cannot be created.

use super::*;

#[test]
fn a_killed_sweep_goes_on_where_it_was() {
    let place = SceneFolder::new(PLANE);
    place.succeed("whole", &[]);
    let part = "killed/shards/1-of-1.part";
    for cells in [1, 200, 400] {
        place.kill("killed", &["--jobs", "2"], part, cells);
    }
    assert!(!place.has_results("killed") && !place.path("killed/shards/1-of-1.csv").exists());
    // nothing that the journal had is computed again: every one of its lines is kept
    let kept = place.read(part);
    let kept: Vec<&str> = kept[..=kept.rfind('\n').expect("a line")].lines().skip(2).collect();
    let ended = place.sweep("killed", &["--json"]);
    assert_eq!(ended.code, Some(0), "{}", ended.err);
    let shard = place.read("killed/shards/1-of-1.csv");
    assert!(kept.len() >= 400 && kept.iter().all(|line| shard.lines().any(|other| other == *line)));
    assert_eq!(place.results("killed"), place.results("whole"));
    assert!(!place.path(part).exists(), "a journal is removed at the end");
}

#[test]
fn a_journal_cut_off_anywhere_is_read_as_far_as_it_is_whole() {
    let place = SceneFolder::new(&small());
    place.succeed("whole", &[]);
    let expected = place.results("whole");
    place.kill("cut", &["--jobs", "1"], "cut/shards/1-of-1.part", 20);
    let journal = place.read("cut/shards/1-of-1.part");
    let lines: Vec<usize> = journal.match_indices('\n').map(|(at, _)| at + 1).collect();
    // within the first line, at its end, within the header, at its end, within a cell, after its first digits
    for end in [0, 10, lines[0], lines[0] + 5, lines[1], lines[9] - 1, lines[9] - 30, lines[9] + 1] {
        std::fs::create_dir_all(place.path("again/shards")).expect("a folder");
        place.write("again/shards/1-of-1.part", &journal[..end]);
        place.succeed("again", &[]);
        assert_eq!(place.results("again"), expected, "cut off after {end} bytes");
        std::fs::remove_dir_all(place.path("again")).expect("a folder");
    }
}

#[test]
fn cells_of_a_journal_are_believed_not_computed_again() {
    let place = SceneFolder::new(&small());
    place.kill("known", &["--jobs", "1"], "known/shards/1-of-1.part", 20);
    // a number that no run gives shows that the journal was read
    let line = |text: &str| text.lines().find(|line| line.contains(",run,")).expect("a run").to_owned();
    place.edit("known/shards/1-of-1.part", |text| {
        let line = line(text);
        text.replacen(&line, &with_error(&line, 0.125), 1)
    });
    place.succeed("known", &[]);
    assert!(place.read("known/cells.csv").lines().any(|line| line.ends_with(",0.125")));
}

/// A file that cannot grow: what a full disk does.
#[cfg(target_os = "linux")]
#[test]
fn a_full_disk_is_named_and_loses_nothing() {
    let place = SceneFolder::new(&small());
    place.succeed("whole", &[]);
    // /dev/full takes no byte
    std::fs::create_dir_all(place.path("full/shards")).expect("a folder");
    let limited = |blocks: u32| {
        let mut shell = Command::new("sh");
        let sweep = place.command("full", &[]);
        shell.arg("-c").arg(format!("trap '' XFSZ; ulimit -f {blocks}; exec \"$0\" \"$@\""));
        shell.arg(sweep.get_program()).args(sweep.get_args()).current_dir(root()).stdin(Stdio::null());
        shell.output().expect("a shell")
    };
    for blocks in [0, 1, 8, 20] {
        let output = limited(blocks);
        let told = String::from_utf8_lossy(&output.stderr).into_owned();
        assert_eq!(output.status.code(), Some(4), "{blocks}: {told}");
        assert!(told.contains("full/shards/1-of-1.") || told.contains("full/cells.csv"), "{told}");
        assert!(!place.has_results("full"), "{blocks}");
    }
    place.succeed("full", &[]);
    assert_eq!(place.results("full"), place.results("whole"));
}

/// The folder of the results is made, with those above it.
#[test]
fn a_folder_that_cannot_be_made_is_named() {
    let place = SceneFolder::new(&small());
    place.write("file", "in the way");
    place.fail("file", &[], 2, &["file: is no folder"]);
    assert_eq!(place.read("file"), "in the way");
    assert!(Path::new(&place.path("file")).is_file());
}
