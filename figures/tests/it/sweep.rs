//! Sweeps: the same sums for any split, order, number of threads and kill; what does not belong together is refused.

use crate::{binary, root};
use serde_json::Value;
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};
use std::time::{Duration, Instant};
use tempfile::TempDir;

/// A plane with contact, decay, waves and undecided cells, of six tiles; some seconds of one processor.
const PLANE: &str = r#"
[law]
kind    = "logarithmic"
epsilon = 0.01
[ring]
pedestrians = 10
length      = 15.0
[start]
shift = 0.1
[run]
t_end     = 300.0
method    = "dop853"
tolerance = 1e-6
[sweep]
x = { parameter = "a_v", from = 0.0, to = 0.6, cells = 60 }
y = { parameter = "v0", from = 0.5, to = 3.0, cells = 30 }
"#;

/// A smaller one, for what needs no more.
fn small() -> String {
    replace(&replace(PLANE, "cells = 60", "cells = 30"), "t_end     = 300.0", "t_end     = 60.0")
}

fn replace(text: &str, from: &str, to: &str) -> String {
    assert!(text.contains(from), "{from}");
    text.replace(from, to)
}

/// A scene in a folder of its own, in which all its sweeps are.
struct Place {
    folder: TempDir,
}

/// What a sweep has said, and its exit code.
struct Ended {
    code: Option<i32>,
    out: String,
    err: String,
}

impl Place {
    fn new(scene: &str) -> Place {
        let place = Place { folder: tempfile::tempdir().expect("a scratch folder") };
        place.write("scene.toml", scene);
        place
    }

    fn path(&self, name: &str) -> PathBuf {
        self.folder.path().join(name)
    }

    fn write(&self, name: &str, text: &str) {
        std::fs::write(self.path(name), text).expect("a file");
    }

    fn read(&self, name: &str) -> String {
        std::fs::read_to_string(self.path(name)).unwrap_or_else(|error| panic!("{name}: {error}"))
    }

    /// Changes a file; the change must be one.
    fn edit(&self, name: &str, change: impl Fn(&str) -> String) {
        let text = self.read(name);
        let changed = change(&text);
        assert_ne!(text, changed, "{name}");
        self.write(name, &changed);
    }

    /// A sweep of the scene into a folder.
    fn command(&self, out: &str, words: &[&str]) -> Command {
        let mut command = Command::new(binary("sweep"));
        command.arg(self.path("scene.toml")).arg("--out").arg(self.path(out)).arg("--tables-only").args(words);
        if !words.iter().any(|word| word.starts_with("--program")) {
            command.arg("--program=tests");
        }
        command.current_dir(root()).stdin(Stdio::null());
        command
    }

    fn sweep(&self, out: &str, words: &[&str]) -> Ended {
        let output = self.command(out, words).output().expect("the program starts");
        let text = |bytes: &[u8]| String::from_utf8_lossy(bytes).into_owned();
        Ended { code: output.status.code(), out: text(&output.stdout), err: text(&output.stderr) }
    }

    /// A sweep that must end well; what it has printed.
    fn succeed(&self, out: &str, words: &[&str]) -> String {
        let ended = self.sweep(out, words);
        assert_eq!(ended.code, Some(0), "{out} {words:?}: {}", ended.err);
        ended.out
    }

    /// A sweep that must fail with this code, with these words in one message.
    fn fail(&self, out: &str, words: &[&str], code: i32, told: &[&str]) {
        let ended = self.sweep(out, words);
        assert_eq!(ended.code, Some(code), "{out} {words:?}: {}", ended.err);
        assert_eq!(ended.err.lines().filter(|line| line.starts_with("error: ")).count(), 1, "{}", ended.err);
        for word in told {
            assert!(ended.err.contains(word), "{words:?}: {word:?} is not in {}", ended.err);
        }
    }

    /// All results of a folder by name, which must have the sums in its list.
    fn results(&self, out: &str) -> BTreeMap<String, String> {
        let list = self.read(&format!("{out}/SHA256SUMS"));
        let mut results = BTreeMap::from([("SHA256SUMS".to_owned(), list.clone())]);
        for (sum, name) in list.lines().filter_map(|line| line.split_once("  ")) {
            assert_eq!(files::write::sha256_file(&self.path(out).join(name)).expect("a file"), sum, "{out}/{name}");
            results.insert(name.to_owned(), self.read(&format!("{out}/{name}")));
        }
        assert_eq!(results.len(), 3, "{list}");
        results
    }

    fn has_results(&self, out: &str) -> bool {
        ["cells.csv", "summary.json", "SHA256SUMS"].iter().any(|name| self.path(out).join(name).exists())
    }

    /// Starts a shard and kills it (SIGKILL) once so many cells are in its journal.
    fn kill(&self, out: &str, words: &[&str], part: &str, cells: usize) {
        let mut command = self.command(out, words);
        let mut child = command.stdout(Stdio::null()).stderr(Stdio::null()).spawn().expect("it starts");
        let start = Instant::now();
        let lines = || std::fs::read_to_string(self.path(part)).map_or(0, |text| text.lines().count());
        while lines() < cells + 2 {
            assert!(start.elapsed() < Duration::from_secs(60), "no {cells} cells in a minute");
            assert!(child.try_wait().expect("a child").is_none(), "it ended before it was killed");
            std::thread::sleep(Duration::from_millis(1));
        }
        child.kill().expect("it can be killed");
        child.wait().expect("it ends");
    }
}

#[test]
fn every_split_order_and_number_of_threads_gives_the_same_bytes() {
    let place = Place::new(PLANE);
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
fn a_shard_is_the_same_wherever_and_however_often_it_is_computed() {
    let place = Place::new(&small());
    for out in ["here", "there"] {
        place.succeed(out, &["--shard", "1/2"]);
    }
    let shard = place.read("here/shards/1-of-2.csv");
    assert_eq!(shard, place.read("there/shards/1-of-2.csv"));
    let before = std::fs::metadata(place.path("here/shards/1-of-2.csv")).and_then(|data| data.modified());
    let said = place.succeed("here", &["--shard", "1/2", "--json"]);
    let after = std::fs::metadata(place.path("here/shards/1-of-2.csv")).and_then(|data| data.modified());
    assert_eq!((before.expect("a date"), &shard), (after.expect("a date"), &place.read("here/shards/1-of-2.csv")));
    let said: Value = serde_json::from_str(&said).expect("JSON");
    let run = shard.lines().skip(2).filter(|line| !line.contains(",neighbours,")).count();
    assert_eq!((&said["shard"], &said["of"], &said["cells"]), (&1.into(), &2.into(), &run.into()), "{said}");
    // both at once into one folder: whoever ends last has written the same
    let mut children: Vec<_> =
        (0..2).map(|_| place.command("both", &["--shard", "1/2"]).spawn().expect("it starts")).collect();
    let codes: Vec<_> = children.iter_mut().map(|child| child.wait().expect("it ends").code()).collect();
    assert_eq!(codes, [Some(0); 2]);
    assert!(place.read("both/shards/1-of-2.csv") == shard);
    assert!(!place.path("both/shards/1-of-2.part").exists());
}

#[test]
fn a_killed_sweep_goes_on_where_it_was() {
    let place = Place::new(PLANE);
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
    let place = Place::new(&small());
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
    let place = Place::new(&small());
    place.kill("known", &["--jobs", "1"], "known/shards/1-of-1.part", 20);
    // a number that no run gives shows that the journal was read
    let line = |text: &str| text.lines().find(|line| line.contains(",run,")).expect("a run").to_owned();
    place.edit("known/shards/1-of-1.part", |text| {
        let line = line(text);
        let (start, _) = line.rsplit_once(',').expect("a number");
        text.replacen(&line, &format!("{start},0.125"), 1)
    });
    place.succeed("known", &[]);
    assert!(place.read("known/cells.csv").lines().any(|line| line.ends_with(",0.125")));
}

#[test]
fn a_damaged_shard_is_named_with_its_line() {
    let place = Place::new(&small());
    place.succeed("out", &["--shard", "1/1"]);
    let shard = "out/shards/1-of-1.csv";
    let sound = place.read(shard);
    let lines: Vec<&str> = sound.lines().collect();
    let with = |at: usize, line: &str| {
        let mut lines = lines.clone();
        lines[at] = line;
        lines.join("\n") + "\n"
    };
    let flipped = lines[7].replacen(',', ";", 1);
    let outside = format!("99,{}", lines[9].split_once(',').expect("indices").1);
    let doubled = lines[9];
    let cases = [
        (with(7, &flipped), "1-of-1.csv:8: "),
        (with(4, "1,2,nonsense,0,run,,,,,,"), "1-of-1.csv:5: "),
        (with(10, &lines[10].replace(",0,", ",7,")), "1-of-1.csv:11: "),
        (with(1, "i,j,outcome"), "1-of-1.csv:2: "),
        (with(9, &outside), "1-of-1.csv:10: "),
        (with(10, doubled), "1-of-1.csv:11: "),
        // the last line but its end, and the last line whole
        (sound[..sound.len() - 1].to_owned(), "1-of-1.csv"),
        (lines[..lines.len() - 1].join("\n") + "\n", "1-of-1.csv"),
        (String::new(), "1-of-1.csv:1: "),
        (lines[0][..20].to_owned(), "1-of-1.csv:1: "),
    ];
    for (damaged, told) in cases {
        place.write(shard, &damaged);
        place.fail("out", &["--gather"], 2, &[told]);
        assert!(!place.has_results("out"), "{told}");
        // computing it again does not take it for whole either, and leaves it for its owner to look at
        place.fail("out", &["--shard", "1/1"], 2, &["1-of-1.csv"]);
        assert_eq!(place.read(shard), damaged);
    }
    let mut bytes = sound.clone().into_bytes();
    let at = sound.len() / 2;
    bytes[at] = 0xff;
    std::fs::write(place.path(shard), bytes).expect("a file");
    place.fail("out", &["--gather"], 2, &["1-of-1.csv:"]);
    place.write(shard, &sound);
    place.succeed("out", &["--gather"]);
}

#[test]
fn missing_shards_are_named() {
    let place = Place::new(&small());
    place.fail("out", &["--gather"], 3, &["out", "no shard"]);
    place.succeed("out", &["--shard", "2/4"]);
    place.fail("out", &["--gather"], 3, &["1/4, 3/4, 4/4", "--shard"]);
    place.kill("out", &["--shard", "3/4", "--jobs", "1"], "out/shards/3-of-4.part", 5);
    place.fail("out", &["--gather"], 3, &["1/4, 3/4, 4/4"]);
    assert!(!place.has_results("out"));
    for shard in ["4/4", "3/4", "1/4"] {
        place.succeed("out", &["--shard", shard]);
    }
    place.succeed("out", &["--gather"]);
    place.succeed("whole", &[]);
    assert_eq!(place.results("out"), place.results("whole"));
}

#[test]
fn shards_of_another_scene_program_or_split_are_refused() {
    let place = Place::new(&small());
    place.succeed("out", &["--shard", "1/2"]);
    let scene = place.read("scene.toml");
    let other = replace(&scene, "shift = 0.1", "shift = 0.2");
    // another scene
    place.write("scene.toml", &other);
    place.fail("out", &["--shard", "1/2"], 2, &["1-of-2.csv:1: ", "another scene"]);
    place.succeed("out", &["--shard", "2/2"]);
    place.fail("out", &["--gather"], 2, &["1-of-2.csv:1: ", "another scene"]);
    place.write("scene.toml", &scene);
    place.fail("out", &["--gather"], 2, &["2-of-2.csv:1: ", "another scene"]);
    // another program
    std::fs::remove_file(place.path("out/shards/2-of-2.csv")).expect("a shard");
    place.succeed("out", &["--shard", "2/2", "--program=another"]);
    place.fail("out", &["--gather"], 2, &["2-of-2.csv:1: ", "program"]);
    // a foreign shard before one that is missing: it says more
    std::fs::remove_file(place.path("out/shards/1-of-2.csv")).expect("a shard");
    place.fail("out", &["--gather"], 2, &["2-of-2.csv:1: "]);
    // several splits
    std::fs::remove_file(place.path("out/shards/2-of-2.csv")).expect("a shard");
    for shard in ["1/2", "2/2", "1/3"] {
        place.succeed("out", &["--shard", shard]);
    }
    place.fail("out", &["--gather"], 2, &["several splits", "2", "3"]);
    // a shard under the name of another, and what is none
    std::fs::rename(place.path("out/shards/1-of-3.csv"), place.path("out/shards/2-of-2.csv")).expect("a shard");
    place.fail("out", &["--gather"], 2, &["2-of-2.csv:1: ", "shard 2 of 2"]);
    place.write("out/shards/2-of-2.csv", "a,b\n1,2\n");
    place.fail("out", &["--gather"], 2, &["2-of-2.csv:1: ", "not a shard"]);
    place.write("out/shards/notes.csv", "");
    place.fail("out", &["--gather"], 2, &["notes.csv", "I-of-N.csv"]);
    assert!(!place.has_results("out"));
    // words, colours and spaces of a scene do not count
    for name in ["notes.csv", "2-of-2.csv"] {
        std::fs::remove_file(place.path("out/shards").join(name)).expect("a file");
    }
    place.write("scene.toml", &format!("# the same\n{}", replace(&scene, "shift = 0.1", "shift  =  1e-1")));
    place.succeed("out", &["--shard", "2/2"]);
    place.succeed("out", &["--gather"]);
}

#[test]
fn shards_beyond_the_split_are_refused() {
    let place = Place::new(&small());
    for shard in ["0/3", "3/2", "1/0", "-1/3", "1", "a/b", "1/3/5", "1.5/3", "", "1/1000001"] {
        let ended = place.sweep("out", &[&format!("--shard={shard}")]);
        assert_eq!(ended.code, Some(2), "{shard}: {}", ended.err);
        assert!(ended.err.contains("I/N") && ended.err.contains("--shard"), "{}", ended.err);
    }
    place.fail("out", &["--shard", "1/5"], 2, &["--shard 1/5", "4 tiles"]);
    assert!(!place.path("out").exists());
    let ended = place.sweep("out", &["--shard", "1/2", "--gather"]);
    assert_eq!(ended.code, Some(2), "{}", ended.err);
}

#[test]
fn shards_that_disagree_are_not_merged() {
    let place = Place::new(&small());
    for shard in ["1/2", "2/2"] {
        place.succeed("out", &["--shard", shard]);
    }
    // cell (3, 25) lies on the border of two tiles
    let line = |text: &str| text.lines().find(|line| line.starts_with("3,25,")).expect("a cell").to_owned();
    place.edit("out/shards/2-of-2.csv", |text| {
        let line = line(text);
        let (start, _) = line.rsplit_once(',').expect("a number");
        text.replacen(&line, &format!("{start},0.125"), 1)
    });
    place.fail("out", &["--gather"], 1, &["[3, 25]", ".csv"]);
    assert!(!place.has_results("out"));
}

#[test]
fn axes_that_are_no_parameters_are_named_with_what_is_valid() {
    let scene = small();
    let x = "x = { parameter = \"a_v\", from = 0.0, to = 0.6, cells = 30 }";
    let axis = |text: &str| replace(&scene, x, text);
    let cases = [
        (
            axis("x = { parameter = \"av\", from = 0.0, to = 0.6, cells = 30 }"),
            vec!["sweep.x.parameter", "av", "a_v", "v0", "epsilon", "headway"],
        ),
        (
            axis("x = { parameter = \"mu\", from = 0.0, to = 0.6, cells = 30 }"),
            vec!["sweep.x.parameter", "mu", "logarithmic", "a_v"],
        ),
        (axis("x = { parameter = \"k\", from = 0.0, to = 0.6, cells = 30 }"), vec!["sweep.x.parameter", "shift"]),
        (axis("x = { parameter = \"kind\", from = 0.0, to = 0.6, cells = 30 }"), vec!["sweep.x.parameter", "a_v"]),
        (axis("x = { parameter = \"d_gap\", from = 0.1, to = 0.6, cells = 30 }"), vec!["sweep.x.parameter", "headway"]),
        (axis("x = { parameter = \"v0\", from = 0.1, to = 0.6, cells = 30 }"), vec!["sweep.y.parameter"]),
        (axis("x = { parameter = \"a_v\", from = 0.6, to = 0.6, cells = 30 }"), vec!["sweep.x.to", "0.6"]),
        (axis("x = { parameter = \"a_v\", from = 0.0, to = nan, cells = 30 }"), vec!["sweep.x.to"]),
        (axis("x = { parameter = \"a_v\", from = 0.0, to = 0.6, cells = 0 }"), vec!["sweep.x.cells", "1"]),
        (
            axis("x = { parameter = \"a_v\", from = 0.0, to = 0.6, cells = 30, scale = \"log\" }"),
            vec!["sweep.x.from", "> 0"],
        ),
        (
            axis("x = { parameter = \"a_v\", from = 0.0, to = 0.6, cells = 30, step = 1 }"),
            vec!["sweep.x.step", "unknown"],
        ),
        (axis("x = { parameter = \"pedestrians\", from = 1.0, to = 9.0, cells = 30 }"), vec!["sweep.x.from", "2"]),
        (
            axis("value = \"margin\"\nx = { parameter = \"a_v\", from = 0.0, to = 0.6, cells = 30 }"),
            vec!["sweep.value", "outcome"],
        ),
        (replace(&scene, "epsilon = 0.01", "epsilon = 0.01\na_v = 0.1"), vec!["law.a_v", "axis"]),
        (axis("x = { parameter = \"shift\", from = 0.0, to = 0.6, cells = 30 }"), vec!["start.shift", "axis"]),
        (axis("x = { parameter = \"headway\", from = 1.0, to = 2.0, cells = 30 }"), vec!["ring.length", "axis"]),
        (replace(&scene, "t_end     = 60.0", "t_end     = 60.0\nsample = 1.0"), vec!["run.sample"]),
        (replace(&scene, "t_end     = 60.0", "t_end     = 60.0\nat_overlap = \"continue\""), vec!["run.at_overlap"]),
        (replace(&scene, "[sweep]", "[uniform]\nd_gap = 1.0\n[sweep]"), vec!["uniform.d_gap", "headway"]),
        (replace(&scene, "[sweep]", "[swept]"), vec!["swept"]),
    ];
    for (scene, told) in cases {
        let place = Place::new(&scene);
        let told: Vec<&str> = ["scene.toml:"].into_iter().chain(told).collect();
        place.fail("out", &[], 2, &told);
        assert!(!place.path("out").exists(), "{told:?}");
    }
}

#[test]
fn filled_cells_have_the_outcome_that_their_run_has() {
    let place = Place::new(&replace(PLANE, "cells = 60", "cells = 30"));
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

/// A file that cannot grow: what a full disk does.
#[cfg(target_os = "linux")]
#[test]
fn a_full_disk_is_named_and_loses_nothing() {
    let place = Place::new(&small());
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

#[test]
fn a_dry_run_computes_nothing_and_names_the_commands() {
    let place = Place::new(&small());
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

/// The folder of the results is made, with those above it.
#[test]
fn a_folder_that_cannot_be_made_is_named() {
    let place = Place::new(&small());
    place.write("file", "in the way");
    place.fail("file", &[], 4, &["file"]);
    assert_eq!(place.read("file"), "in the way");
    assert!(Path::new(&place.path("file")).is_file());
}
