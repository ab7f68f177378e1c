//! Sweeps: the same sums for any division, order, number of threads and kill; shards that do not belong together are
//! refused.

mod axes;
mod cells;
mod kills;
mod shards;

use serde_json::Value;
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};
use std::time::{Duration, Instant};
use tempfile::TempDir;

/// The root of the repository.
fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../..")
}

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
method    = "taylor"
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
struct SceneFolder {
    folder: TempDir,
}

/// What a sweep has said, and its exit code.
struct CommandOutput {
    code: Option<i32>,
    out: String,
    err: String,
}

impl SceneFolder {
    fn new(scene: &str) -> SceneFolder {
        let place = SceneFolder { folder: tempfile::tempdir().expect("a scratch folder") };
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
        let mut command = Command::new(env!("CARGO_BIN_EXE_sweep"));
        command.arg(self.path("scene.toml")).arg("--out").arg(self.path(out)).arg("--tables-only").args(words);
        if !words.iter().any(|word| word.starts_with("--program")) {
            command.arg("--program=tests");
        }
        command.current_dir(root()).stdin(Stdio::null());
        command
    }

    fn sweep(&self, out: &str, words: &[&str]) -> CommandOutput {
        let output = self.command(out, words).output().expect("the program starts");
        let text = |bytes: &[u8]| String::from_utf8_lossy(bytes).into_owned();
        CommandOutput { code: output.status.code(), out: text(&output.stdout), err: text(&output.stderr) }
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

/// The line of a shard with another error, under its own sum.
fn with_error(line: &str, error: f64) -> String {
    let (cell, mut found) = sweep::table::parse(line).expect("a cell");
    found.numbers[5] = error;
    sweep::table::shard_line(cell, &found)
}
