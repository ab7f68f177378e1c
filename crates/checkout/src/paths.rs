//! The paths that several crates use.

use crate::failure::Failure;
use clap::ValueEnum;
use serde::{Deserialize, Serialize};
use std::env;
use std::path::{Path, PathBuf};

/// How runs are integrated.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, ValueEnum, Serialize, Deserialize)]
pub enum Scheme {
    /// The method and tolerance that the scene names.
    #[default]
    Adaptive,
    /// Literally that of the paper; tables and pictures go to a folder of their own.
    Paper,
}

/// Paths of the checkout. Names with `/` are relative to the root, as in SHA256SUMS.
#[derive(Clone, Debug, PartialEq)]
pub struct Paths {
    /// The folder of the checkout.
    pub root: PathBuf,
    /// Cargo's target folder.
    pub target: PathBuf,
    /// What the names of outputs are relative to: the root, or the scratch folder of `verify`.
    pub base: PathBuf,
    /// Whose outputs are meant.
    pub scheme: Scheme,
}

/// Lock file of the dependencies, by name.
pub const LOCK_FILE: &str = "Cargo.lock";
/// The file that pins the toolchain, by name.
pub const TOOLCHAIN: &str = "rust-toolchain.toml";
/// The folder of the tables of accuracy, by name.
pub const ACCURACY: &str = "data/accuracy";
/// The document, by name.
pub const DOCUMENT_PDF: &str = "paper/jamming-reproduction.pdf";
/// The folder of the pictures as PDF, by name.
pub const PICTURE_PDFS: &str = "paper/pictures";
/// The numbers of the document, by name.
pub const NUMBERS_JSON: &str = "paper/numbers.json";
/// The same as LaTeX macros, by name.
pub const NUMBERS_TEX: &str = "paper/numbers.tex";
/// The events of all runs, by name.
pub const EVENTS: &str = "data/events.csv";
/// How far numbers may be from the committed ones on a machine whose bits differ, by name.
pub const TOLERANCES: &str = "data/tolerances.toml";
/// What each program costs, by name.
pub const COSTS: &str = "data/costs.csv";
/// Machines and their bits, by name.
pub const ATTESTATIONS: &str = "data/attestations.jsonl";
/// What the ledger is written by hand from: claims, errata, parameters.
pub const LEDGER_SOURCES: [&str; 3] = ["paper/claims.toml", "paper/errata.toml", "paper/parameters.toml"];
/// What is found of each entry of the ledger, by name.
pub const LEDGER: &str = "data/ledger.json";
/// The page, by name.
pub const PAGE: &str = "paper/report.html";
/// The sums of what is made from the figures, by name.
pub const PAPER_SUMS: &str = "paper/SHA256SUMS";
/// The top folder of the archive that `bundle` writes.
pub const BUNDLE_TOP: &str = "jamming-transitions-reproduction";
/// The tables of a stored run.
pub const RUN_TABLES: [&str; 2] = ["std.csv", "trajectories.csv"];

/// How the names of scratch folders begin.
const SCRATCH: &str = "verify-";

impl Paths {
    /// The checkout around `root`, or, without it, around the manifest that cargo names or the current folder.
    ///
    /// # Errors
    /// No folder upwards holds both `figures` and `Cargo.toml`.
    pub fn find(root: Option<PathBuf>) -> Result<Paths, Failure> {
        let here = env::current_dir().map_err(|error| Failure::Unsupported(format!("current folder: {error}")))?;
        let root = match root {
            Some(root) => here.join(root),
            None => {
                let start = env::var_os("CARGO_MANIFEST_DIR").map_or_else(|| here.clone(), PathBuf::from);
                start.ancestors().find(|folder| is_root(folder)).map(Path::to_path_buf).ok_or_else(|| {
                    Failure::Usage(format!("{}: no folder upwards holds Cargo.toml and figures", start.display()))
                })?
            }
        };
        let target = env::var_os("CARGO_TARGET_DIR").map_or_else(|| root.join("target"), |target| here.join(target));
        Ok(Paths { base: root.clone(), root, target, scheme: Scheme::Adaptive })
    }

    /// The same checkout for another scheme.
    pub fn with_scheme(&self, scheme: Scheme) -> Paths {
        Paths { scheme, ..self.clone() }
    }

    /// The same checkout with every output, the store and the reports in a folder of their own below target.
    pub fn scratch(&self) -> Paths {
        Paths { base: self.target.join(format!("{SCRATCH}{}", std::process::id())), ..self.clone() }
    }

    /// Where pictures of differences go.
    pub fn differences(&self) -> PathBuf {
        self.xtask().join("differences")
    }

    /// Whether a name in the target folder is that of a scratch folder.
    pub fn is_scratch(name: &str) -> bool {
        name.starts_with(SCRATCH)
    }

    /// The folder of the figures' sources.
    pub fn figures(&self) -> PathBuf {
        self.root.join("figures")
    }

    /// The scene file of a figure, by name.
    pub fn scene(slug: &str) -> String {
        format!("figures/{slug}/scene.toml")
    }

    /// The folder of a figure's source and pictures, by name, with the final `/`.
    pub fn figure_folder(slug: &str) -> String {
        format!("figures/{slug}/")
    }

    /// A release binary.
    pub fn binary(&self, name: &str) -> PathBuf {
        self.target.join("release").join(format!("{name}{}", env::consts::EXE_SUFFIX))
    }

    /// The folder of a figure's tables, by name.
    pub fn tables(&self, id: &str) -> String {
        match self.scheme {
            Scheme::Adaptive => format!("data/{id}"),
            Scheme::Paper => format!("data/paper-scheme/{id}"),
        }
    }

    /// The folder of a figure's pictures, by name.
    pub fn pictures(&self, slug: &str, id: &str) -> String {
        match self.scheme {
            Scheme::Adaptive => format!("figures/{slug}"),
            Scheme::Paper => self.tables(id),
        }
    }

    /// An output, by name, as a path.
    pub fn output(&self, name: &str) -> PathBuf {
        self.base.join(name)
    }

    /// The folder of generated data, which also holds temporary folders of interrupted runs.
    pub fn data(&self) -> PathBuf {
        self.base.join("data")
    }

    /// The folder of the scheme's tables.
    pub fn scheme_data(&self) -> PathBuf {
        match self.scheme {
            Scheme::Adaptive => self.data(),
            Scheme::Paper => self.data().join("paper-scheme"),
        }
    }

    /// The committed sums, by name.
    pub fn sums(&self, supplement: bool) -> &'static str {
        match (self.scheme, supplement) {
            (Scheme::Adaptive, false) => "data/SHA256SUMS",
            (Scheme::Adaptive, true) => "data/SHA256SUMS-supplements",
            (Scheme::Paper, false) => "data/paper-scheme/SHA256SUMS",
            (Scheme::Paper, true) => "data/paper-scheme/SHA256SUMS-supplements",
        }
    }

    /// The committed samples of a figure's tables, by name.
    pub fn golden(id: &str) -> String {
        format!("data/golden/{id}")
    }

    /// The hashes of the state of a run, by name.
    pub fn states(scene: &str) -> String {
        format!("data/states/{scene}.csv")
    }

    /// What is known of each output.
    pub fn manifest(&self) -> PathBuf {
        self.root.join("data/manifest.json")
    }

    /// A table by the name under which the ledger reads it, `fig11/trajectories`, as a name.
    pub fn table(name: &str) -> String {
        format!("data/{name}.csv")
    }

    /// What is found of each entry of the ledger.
    pub fn ledger(&self) -> PathBuf {
        self.root.join(LEDGER)
    }

    /// The folder of the fonts that the pictures need.
    pub fn fonts(&self) -> PathBuf {
        self.root.join("crates/plot/fonts")
    }

    /// The folder of stored runs.
    pub fn store(&self) -> PathBuf {
        if self.base == self.root { self.target.join("store") } else { self.base.join("store") }
    }

    /// The checkpoint from which a killed run is resumed.
    pub fn checkpoint(&self, key: &str) -> PathBuf {
        self.store().join(format!("{key}.checkpoint"))
    }

    /// The archive, unless it is asked for elsewhere.
    pub fn archive(&self) -> PathBuf {
        self.target.join("bundle").join(format!("{BUNDLE_TOP}.tar"))
    }

    /// The runner's own folder.
    pub fn xtask(&self) -> PathBuf {
        self.target.join("xtask")
    }

    /// Where programs leave what is no output: the runner's own folder, or the scratch folder of `verify`.
    pub fn own(&self) -> PathBuf {
        if self.base == self.root { self.xtask() } else { self.base.clone() }
    }

    /// What each figure was made from.
    pub fn state(&self) -> PathBuf {
        self.xtask().join("state.json")
    }

    /// Seconds of the last time each node ran.
    pub fn times(&self) -> PathBuf {
        self.xtask().join("times.json")
    }

    /// The name of a node among those seconds: the two schemes take very different times.
    pub fn times_name(&self, node: &str) -> String {
        match self.scheme {
            Scheme::Adaptive => node.to_owned(),
            Scheme::Paper => format!("{node} (scheme paper)"),
        }
    }

    /// What the binaries were built from.
    pub fn build_record(&self, package: &str) -> PathBuf {
        self.xtask().join(format!("build-{package}.json"))
    }

    /// The file that keeps two runs apart.
    pub fn lock(&self) -> PathBuf {
        self.xtask().join("lock")
    }

    /// What a node printed.
    pub fn log(&self, node: &str) -> PathBuf {
        self.own().join("log").join(format!("{}.txt", node.replace([' ', '/'], "-")))
    }

    /// The report of a figure's program on its tables.
    pub fn report(&self, id: &str) -> PathBuf {
        let name = match self.scheme {
            Scheme::Adaptive => format!("{id}.json"),
            Scheme::Paper => format!("{id}-paper.json"),
        };
        self.own().join("report").join(name)
    }

    /// Whether a tracked file of this name is written by the runner, so that a change of it is no change of a source.
    pub fn is_output(name: &str) -> bool {
        let picture = name.starts_with("figures/") && (name.ends_with(".png") || name.ends_with(".svg"));
        let data = [
            "data/SHA256SUMS",
            "data/golden/",
            "data/states/",
            "data/paper-scheme/",
            "data/manifest.json",
            EVENTS,
            COSTS,
            ATTESTATIONS,
            LEDGER,
            NUMBERS_JSON,
            NUMBERS_TEX,
            PAPER_SUMS,
        ];
        picture || data.iter().any(|start| name.starts_with(start))
    }
}

fn is_root(folder: &Path) -> bool {
    folder.join("Cargo.toml").is_file() && folder.join("figures").is_dir()
}
