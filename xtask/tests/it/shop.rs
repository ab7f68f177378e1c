//! A small checkout in a temporary folder, with stand-ins for cargo, `simulate` and the figures.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};

/// A checkout of five figures and a supplement: 04 with two runs, 05 and 06 without, 11 and 12 sharing one, s01 with
/// its own.
pub struct Shop {
    pub root: PathBuf,
}

impl Shop {
    pub fn new(name: &str) -> Shop {
        let root = Path::new(env!("CARGO_TARGET_TMPDIR")).join(name);
        let _ = fs::remove_dir_all(&root);
        let shop = Shop { root };
        shop.write("Cargo.toml", "[workspace]\n");
        shop.write("Cargo.lock", "[[package]]\nname = \"png\"\nversion = \"0.18.1\"\n");
        shop.write("rust-toolchain.toml", "[toolchain]\nchannel = \"1.95.0\"\n");
        shop.write("crates/math/src/lib.rs", "//! Numbers.\n");
        shop.write("crates/plot/src/lib.rs", "//! Pictures.\n");
        shop.copy_fonts();
        shop.write("figures/src/lib.rs", "//! Glue.\n");
        let run = "[ring]\npedestrians = 3\n[run]\nt_end = 10\n";
        shop.figure(
            "fig04-growth",
            "fig:stdv_rec",
            &format!("{run}[panel.stable.law]\nmu = 0.4\n[panel.unstable.law]\nmu = 0.5\n"),
        );
        shop.figure("fig05-exponential-map", "fig:sfm", "[map]\nvalue = \"criterion\"\n");
        shop.figure("fig06-exponential-sway", "fig:avsfm", "[map]\nvalue = \"other\"\n");
        shop.figure("fig11-trajectories", "fig:jams", run);
        shop.figure("fig12-speeds", "fig:jams_vel", run);
        shop.figure("s01-variant", "", "reads = \"accuracy/named\"\n[ring]\npedestrians = 4\n[run]\nt_end = 10\n");
        fs::hard_link(fake(), shop.root.join("cargo")).expect("a link to the stand-in");
        shop
    }

    /// The runner knows the fonts by their sums, so they are the real ones.
    fn copy_fonts(&self) {
        let folder = self.root.join("crates/plot/fonts");
        fs::create_dir_all(&folder).expect("a folder");
        for (name, _) in xtask::compile::FONT_SUMS {
            let real = Path::new(env!("CARGO_MANIFEST_DIR")).join("../crates/plot/fonts").join(name);
            fs::copy(real, folder.join(name)).expect("a font");
        }
    }

    fn figure(&self, slug: &str, label: &str, body: &str) {
        self.write(&format!("figures/{slug}/main.rs"), "//! A figure.\n");
        self.write(&format!("figures/{slug}/scene.toml"), &format!("title = \"{slug}\"\nsource = \"{label}\"\n{body}"));
    }

    pub fn write(&self, name: &str, text: &str) {
        let path = self.root.join(name);
        fs::create_dir_all(path.parent().expect("a folder")).expect("a folder");
        fs::write(path, text).expect("a file");
    }

    pub fn read(&self, name: &str) -> String {
        fs::read_to_string(self.root.join(name)).unwrap_or_else(|error| panic!("{name}: {error}"))
    }

    pub fn bytes(&self, name: &str) -> Vec<u8> {
        fs::read(self.root.join(name)).unwrap_or_else(|error| panic!("{name}: {error}"))
    }

    pub fn has(&self, name: &str) -> bool {
        self.root.join(name).exists()
    }

    /// Replaces a text in a file.
    pub fn edit(&self, name: &str, from: &str, to: &str) {
        let old = self.read(name);
        assert!(old.contains(from), "{name} has no {from}");
        self.write(name, &old.replace(from, to));
    }

    /// Runs the runner.
    pub fn xtask(&self, arguments: &[&str]) -> CommandOutput {
        self.xtask_as(arguments, false)
    }

    /// Runs the runner, as on a machine for continuous integration or not.
    pub fn xtask_as(&self, arguments: &[&str], is_ci: bool) -> CommandOutput {
        let mut command = Command::new(env!("CARGO_BIN_EXE_xtask"));
        command.env_remove("CI").envs(is_ci.then_some(("CI", "true")));
        command.arg("--root").arg(&self.root).args(arguments).current_dir(&self.root);
        command.env("CARGO_TARGET_DIR", self.root.join("target")).env("CARGO", self.root.join("cargo"));
        // the temporary folder may lie inside a repository, which is not the one under test
        command.env("GIT_CEILING_DIRECTORIES", &self.root).env("GIT_DIR", self.root.join(".git"));
        CommandOutput::of(&command.output().expect("the runner starts"))
    }

    /// Runs git; whether it went well.
    pub fn git(&self, arguments: &[&str]) -> bool {
        let mut command = Command::new("git");
        command.args(["-c", "user.name=test", "-c", "user.email=test@example.org", "-c", "commit.gpgsign=false"]);
        command.args(arguments).current_dir(&self.root).env("GIT_DIR", self.root.join(".git"));
        command.status().is_ok_and(|status| status.success())
    }

    /// The programs that were started since the last question, sorted.
    pub fn calls(&self) -> Vec<String> {
        let text = fs::read_to_string(self.root.join("calls.log")).unwrap_or_default();
        let _ = fs::remove_file(self.root.join("calls.log"));
        let mut calls: Vec<String> = text.lines().map(|line| line.trim().to_owned()).collect();
        calls.sort();
        calls
    }
}

/// How the runner ended.
pub struct CommandOutput {
    pub code: i32,
    pub out: String,
    pub err: String,
}

impl CommandOutput {
    pub fn of(output: &Output) -> CommandOutput {
        let text = |bytes: &[u8]| String::from_utf8_lossy(bytes).into_owned();
        CommandOutput { code: output.status.code().unwrap_or(-1), out: text(&output.stdout), err: text(&output.stderr) }
    }

    pub fn json(&self) -> serde_json::Value {
        serde_json::from_str(&self.out).unwrap_or_else(|error| panic!("{error}: {}", self.out))
    }

    /// Asserts the exit code; shows what was printed when it is another one.
    #[track_caller]
    pub fn expect(self, code: i32) -> CommandOutput {
        assert_eq!(self.code, code, "stdout:\n{}\nstderr:\n{}", self.out, self.err);
        self
    }
}

/// The example `fake` beside the runner's binary.
fn fake() -> PathBuf {
    let name = format!("fake{}", std::env::consts::EXE_SUFFIX);
    Path::new(env!("CARGO_BIN_EXE_xtask")).with_file_name("examples").join(name)
}

/// Temporary files and folders anywhere below a folder.
pub fn temporary(folder: &Path) -> Vec<PathBuf> {
    let mut found = Vec::new();
    for path in fs::read_dir(folder).into_iter().flatten().flatten().map(|entry| entry.path()) {
        if path.to_string_lossy().contains(".tmp-") {
            found.push(path);
        } else if path.is_dir() {
            found.extend(temporary(&path));
        }
    }
    found
}

/// A checkout whose figures are made and accepted.
pub fn blessed(name: &str) -> Shop {
    let shop = Shop::new(name);
    shop.xtask(&["figures"]).expect(1);
    shop.xtask(&["bless"]).expect(0);
    shop.xtask(&["figures"]).expect(0);
    shop.calls();
    shop
}
