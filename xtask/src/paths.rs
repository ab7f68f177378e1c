//! Where everything lies. The only module that spells a path.

use crate::failure::Failure;
use clap::ValueEnum;
use std::env;
use std::path::{Path, PathBuf};

/// How runs are integrated.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, ValueEnum)]
pub enum Scheme {
    /// The method and tolerance that the scene names.
    #[default]
    Adaptive,
    /// Word for word as the paper says; tables and pictures go to a folder of their own.
    Paper,
}

/// Places of the checkout. Names with `/` are relative to the root, as they stand in SHA256SUMS.
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
/// Single files that determine what the binaries do.
pub const SINGLE_SOURCES: [&str; 4] = ["Cargo.toml", LOCK_FILE, TOOLCHAIN, ".cargo/config.toml"];
/// Crates that determine the numbers of a run.
pub const NUMERIC_SOURCES: [&str; 7] = [
    "crates/math/",
    "crates/ode/",
    "crates/jam/",
    "crates/files/",
    "crates/scene/",
    "figures/src/",
    "figures/Cargo.toml",
];
/// Sources that every figure shares.
pub const SHARED_SOURCES: [&str; 4] = ["crates/", "figures/src/", "figures/Cargo.toml", "data/reference/"];
/// Sources that supplements share: no figure of the paper reads them.
pub const SUPPLEMENT_SOURCES: [&str; 2] = ["data/accuracy/", "data/timing/"];
/// Folders that are searched for sources.
pub const SOURCE_FOLDERS: [&str; 5] = ["crates", "figures", "data/accuracy", "data/reference", "data/timing"];
/// Below the folders searched, what reaches no figure: the page for browsers, files for other programs, solutions to
/// compare with, archived benchmarks.
pub const NO_SOURCES: [&str; 4] =
    ["crates/browser/", "crates/interchange/", "data/reference/solutions/", "data/timing/bench/"];
/// How to get the fonts back.
pub const FONTS_REMEDY: &str = "part of the checkout: git restore crates/plot/fonts";
/// The fonts that the pictures embed, each with its SHA-256: a damaged one would be compiled in, and every picture would fail or differ.
pub const FONT_SUMS: [(&str, &str); 2] = [
    ("LibertinusSerif-Italic.otf", "9a393d63d6e05f620d3dc0190dfd35a8ede58c0808cf0fc9de7fcb9c723e4c24"),
    ("LibertinusSerif-Regular.otf", "fcf06307a77367394fcb0ccb241e59eea70dba3d732be309647611224679c733"),
];
/// The folder of the tables of accuracy, by name.
pub const ACCURACY: &str = "data/accuracy";
/// The sums of those tables, by name.
pub const ACCURACY_SUMS: &str = "data/accuracy/SHA256SUMS";
/// How far the paper's scheme is from the accurate and the published curves, by name.
pub const PAPER_DISTANCES: &str = "data/paper-scheme/distance.csv";
/// Events of the reference solutions, by name.
pub const REFERENCE_EVENTS: &str = "data/reference/solutions/events.csv";
/// The document's main file, by name.
pub const DOCUMENT: &str = "paper/main.typ";
/// The document, by name.
pub const DOCUMENT_PDF: &str = "paper/jamming-reproduction.pdf";
/// The folder of the pictures as PDF, by name.
pub const PICTURE_PDFS: &str = "paper/pictures";
/// The file that sets one picture, by name.
pub const PICTURE_SOURCE: &str = "paper/picture.typ";
/// The numbers of the document, by name.
pub const NUMBERS_JSON: &str = "paper/numbers.json";
/// The same as LaTeX macros, by name.
pub const NUMBERS_TEX: &str = "paper/numbers.tex";
/// The typesetter's pinned wheel, by name.
pub const TYPST_PIN: &str = "paper/requirements.txt";
/// What makes the wheel behave as the program, by name.
pub const TYPST_STAND_IN: &str = "paper/typeset.py";
/// The check of the PDF, by name.
pub const PDF_CHECK: &str = "checks/pdf.py";
/// What that check needs, by name.
pub const PDF_CHECK_PIN: &str = "checks/requirements-pdf.txt";
/// The events of all runs, by name.
pub const EVENTS: &str = "data/events.csv";
/// How far numbers may be from the committed ones on a machine whose bits differ, by name.
pub const TOLERANCES: &str = "data/tolerances.toml";
/// What each program costs, by name.
pub const COSTS: &str = "data/costs.csv";
/// The document that shows the costs, by name.
pub const REPRODUCING: &str = "REPRODUCING.md";
/// Who got which bits, by name.
pub const ATTESTATIONS: &str = "data/attestations.jsonl";
/// What the ledger is written by hand from: claims, errata, parameters.
pub const LEDGER_SOURCES: [&str; 3] = ["paper/claims.toml", "paper/errata.toml", "paper/parameters.toml"];
/// What is found of each entry of the ledger, by name.
pub const LEDGER: &str = "data/ledger.json";
/// The page, by name.
pub const PAGE: &str = "paper/report.html";
/// The sums of what is made from the figures, by name.
pub const PAPER_SUMS: &str = "paper/SHA256SUMS";
/// The tests of the page in a browser.
pub const BROWSER_CHECK: &str = "checks/browser";
/// What to look at when every figure is as committed.
pub const OPEN_ALL: &str = "open README.md for the table of figures, figures/*/fig*.png for the pictures";
/// Checks that need more than Rust: spot values by NumPy.
pub const SPOT_CHECK: &str = "checks/spot.py";
/// Checks that need more than Rust: exported trajectories read by PedPy.
pub const PEDPY_CHECK: &str = "checks/pedpy/check.py";
/// What that check needs, by hash.
pub const PEDPY_REQUIREMENTS: &str = "checks/pedpy/requirements.txt";
/// Checks that need more than Rust: other processors.
pub const OTHER_MACHINES: &str = "checks/other-machines.sh";
/// What is measured by `bench`.
pub const COST_SOURCE: &str = "crates/jam/examples/cost.rs";
/// Checks that need more than Rust: counts of instructions.
pub const COST: &str = "checks/cost.sh";
/// The top folder of the archive that `bundle` writes.
pub const BUNDLE_TOP: &str = "jamming-transitions-reproduction";
/// In the archive, the folder of the crates that the lock file names.
pub const VENDOR: &str = "vendor";
/// In the archive, what tells cargo of that folder; `.cargo/config.toml` includes it where it exists.
pub const VENDORED_CONFIG: &str = ".cargo/vendored.toml";
/// Documents that belong into the archive when they have been made.
pub const DOCUMENTS: [&str; 2] = [DOCUMENT_PDF, PAGE];
/// The source that stands for the whole run in the description of the archive.
pub const MAIN_WORKFLOW: &str = "xtask/src/verbs/figures.rs";
/// The validators of the archive's descriptions.
pub const BUNDLE_REQUIREMENTS: &str = "checks/bundle/requirements.txt";
/// The one that needs help to do without a network.
pub const RUN_CRATE_CHECK: &str = "checks/bundle/run_crate.py";
/// Checks that need more than Rust: inputs by the million for every reader.
pub const FUZZ: &str = "checks/fuzz.sh";
/// So many inputs for each reader where there is little time: about a minute.
pub const FUZZ_INPUTS: &str = "20000";
/// The list of sums inside a stored run.
pub const STORE_SUMS: &str = "SHA256SUMS";
/// The events of a stored run.
pub const RUN_EVENTS: &str = "events.csv";
/// Method, counts and lengths of a stored run.
pub const RUN_SUMMARY: &str = "summary.json";
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

    /// The name under which something is made before it is put in its place; files are written under such names too.
    pub fn temporary(name: &str) -> String {
        files::write::draft_name(name)
    }

    /// Whether a name is one of [`Paths::temporary`], of any process.
    pub fn is_temporary(name: &str) -> bool {
        files::write::is_draft_name(name)
    }

    /// The folder of the figures' sources.
    pub fn figures(&self) -> PathBuf {
        self.root.join("figures")
    }

    /// The scene file of a figure, by name.
    pub fn scene(slug: &str) -> String {
        format!("figures/{slug}/scene.toml")
    }

    /// The source of a figure's program, by name.
    pub fn program(slug: &str) -> String {
        format!("figures/{slug}/main.rs")
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

    /// The folder a figure's tables are written to before they take the place of the old ones, by name.
    pub fn fresh_tables(&self, id: &str) -> String {
        Paths::temporary(&self.tables(id))
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

    /// The folder of generated data; temporary folders of a run that was broken off lie here.
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

    /// How far the paper's scheme is from the accurate runs and from the published curves.
    pub fn distances(&self) -> PathBuf {
        self.with_scheme(Scheme::Paper).scheme_data().join("distance.csv")
    }

    /// A table of values from outside.
    pub fn reference(&self, name: &str) -> PathBuf {
        self.root.join("data/reference").join(format!("{name}.csv"))
    }

    /// A table of the report of accuracy.
    pub fn accuracy(&self, name: &str) -> PathBuf {
        self.root.join(ACCURACY).join(format!("{name}.csv"))
    }

    /// The description of every table and column.
    pub fn data_package(&self) -> PathBuf {
        self.root.join("data/datapackage.json")
    }

    /// What each picture shows, in words.
    pub fn alternatives(&self) -> PathBuf {
        self.root.join("paper/alternatives.toml")
    }

    /// The committed samples of a figure's tables, by name.
    pub fn golden(id: &str) -> String {
        format!("data/golden/{id}")
    }

    /// The hashes of the state of a run, by name.
    pub fn states(scene: &str) -> String {
        format!("data/states/{scene}.csv")
    }

    /// Where a run is made once more with its trajectories.
    pub fn states_scratch(&self) -> PathBuf {
        let folder = if self.base == self.root { self.xtask() } else { self.base.clone() };
        folder.join("states")
    }

    /// What is known of each output.
    pub fn manifest(&self) -> PathBuf {
        self.root.join("data/manifest.json")
    }

    /// Events of all runs.
    pub fn events(&self) -> PathBuf {
        self.root.join(EVENTS)
    }

    /// A table by the name under which the ledger reads it, `fig11/trajectories`, as a name.
    pub fn table(name: &str) -> String {
        format!("data/{name}.csv")
    }

    /// What is found of each entry of the ledger.
    pub fn ledger(&self) -> PathBuf {
        self.root.join(LEDGER)
    }

    /// From what the ledger was written the last time.
    pub fn ledger_record(&self) -> PathBuf {
        self.xtask().join("ledger")
    }

    /// The folder of the fonts that the pictures need.
    pub fn fonts(&self) -> PathBuf {
        self.root.join("crates/plot/fonts")
    }

    /// The folder of stored runs.
    pub fn store(&self) -> PathBuf {
        if self.base == self.root { self.target.join("store") } else { self.base.join("store") }
    }

    /// Where the tables of accuracy are made before they are compared.
    pub fn made_accuracy(&self) -> PathBuf {
        self.xtask().join("accuracy")
    }

    /// A table of archived timings.
    pub fn timing(&self, name: &str) -> PathBuf {
        self.root.join("data/timing").join(format!("{name}.csv"))
    }

    /// From where a run that was killed goes on.
    pub fn checkpoint(&self, key: &str) -> PathBuf {
        self.store().join(format!("{key}.checkpoint"))
    }

    /// Where programs for checks are installed.
    pub fn tools(&self) -> PathBuf {
        self.target.join("tools")
    }

    /// The archive, unless it is asked for elsewhere.
    pub fn archive(&self) -> PathBuf {
        self.bundle().join(format!("{BUNDLE_TOP}.tar"))
    }

    /// Where the crates for the archive are unpacked.
    pub fn vendored(&self) -> PathBuf {
        self.bundle().join(VENDOR)
    }

    /// Where the archive is unpacked to be checked.
    pub fn unpacked(&self) -> PathBuf {
        self.bundle().join("unpacked")
    }

    fn bundle(&self) -> PathBuf {
        self.target.join("bundle")
    }

    /// Where programs to be measured are built and lie.
    pub fn bench(&self) -> PathBuf {
        self.target.join("bench")
    }

    /// What was measured of a commit, alone or against another one.
    pub fn bench_archive(&self, commit: &str, against: Option<&str>) -> PathBuf {
        let against = against.map_or(String::new(), |against| format!("-against-{against}"));
        self.root.join("data/timing/bench").join(format!("{commit}{against}.json"))
    }

    /// Where the tests of the page lie with the packages that they need.
    pub fn browser(&self) -> PathBuf {
        self.target.join("browser")
    }

    /// The folder of the document's sources.
    pub fn document(&self) -> PathBuf {
        self.root.join("paper")
    }

    /// A picture as PDF, by name.
    pub fn picture_pdf(id: &str) -> String {
        format!("{PICTURE_PDFS}/{id}.pdf")
    }

    /// The runner's own folder.
    pub fn xtask(&self) -> PathBuf {
        self.target.join("xtask")
    }

    /// The folder of an environment of Python.
    pub fn python(&self, name: &str) -> PathBuf {
        self.target.join("python").join(name)
    }

    /// Where a run lies while it is written for other programs; a folder of this process.
    pub fn exported(&self) -> PathBuf {
        self.xtask().join(Paths::temporary("export"))
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

    /// A file that is written to see whether one can be.
    pub fn probe(&self) -> PathBuf {
        self.xtask().join("probe")
    }

    /// What the binaries were built from.
    pub fn build_record(&self) -> PathBuf {
        self.xtask().join("build.json")
    }

    /// The file that keeps two runs apart.
    pub fn lock(&self) -> PathBuf {
        self.xtask().join("lock")
    }

    /// What a node printed.
    pub fn log(&self, node: &str) -> PathBuf {
        let folder = if self.base == self.root { self.xtask() } else { self.base.clone() };
        folder.join("log").join(format!("{}.txt", node.replace([' ', '/'], "-")))
    }

    /// What a figure's binary says of its tables.
    pub fn report(&self, id: &str) -> PathBuf {
        let name = match self.scheme {
            Scheme::Adaptive => format!("{id}.json"),
            Scheme::Paper => format!("{id}-paper.json"),
        };
        self.reports().join(name)
    }

    /// The folder of what figures' binaries say of their tables.
    pub fn reports(&self) -> PathBuf {
        let folder = if self.base == self.root { self.xtask() } else { self.base.clone() };
        folder.join("report")
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
