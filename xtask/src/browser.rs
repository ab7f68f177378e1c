//! Tests of the page in a browser without a window. They need more than Rust: Chromium, Node, and two packages that are
//! pinned by hash and put into a folder below target.

use crate::child;
use crate::disk;
use crate::failure::Failure;
use crate::figure;
use crate::gate;
use crate::page;
use crate::paths::{BROWSER_CHECK, PAGE, PAPER_SUMS, Paths};
use crate::print;
use crate::sums::Sums;
use crate::verbs::test::step;
use std::path::Path;
use std::process::Command;

/// Names of the browser.
const BROWSERS: [&str; 2] = ["chromium", "chromium-browser"];
/// Oldest Node that the driver of the browser runs on.
const NODE: u32 = 18;
/// The list of packages and their hashes, by name.
const PACKAGE_LOCK: &str = "package-lock.json";
/// The list as npm keeps it beside what it has installed.
const INSTALLED: &str = "node_modules/.package-lock.json";

/// Installs what is missing: Chromium and Node where `apt-get` may be used, then the packages. A machine without either
/// is told about by [`test()`].
///
/// # Errors
/// Differs: an installation fails.
pub fn install(paths: &Paths) -> Result<(), Failure> {
    let missing = [(browser().is_none(), "chromium"), (node().is_none(), "nodejs"), (npm().is_none(), "npm")];
    let missing: Vec<&str> = missing.iter().filter(|(is_missing, _)| *is_missing).map(|(_, name)| *name).collect();
    if !missing.is_empty() && is_root() && child::first_line("apt-get", &["--version"]).is_some() {
        eprintln!("ci: apt-get install {}", missing.join(" "));
        step("apt-get update", Command::new("apt-get").args(["update", "-qq"]))?;
        let mut install = Command::new("apt-get");
        install.args(["install", "-y", "-qq", "--no-install-recommends"]).args(&missing);
        step("apt-get install", install.env("DEBIAN_FRONTEND", "noninteractive"))?;
    }
    if node().is_none() || npm().is_none() || is_installed(paths)? {
        return Ok(());
    }
    copy(paths)?;
    let mut npm = Command::new("npm");
    npm.args(["ci", "--no-audit", "--no-fund", "--ignore-scripts"]).current_dir(paths.browser());
    step("npm ci", &mut npm)
}

/// Writes the page and tests it; what is missing for that is said aloud.
///
/// # Errors
/// Differs: a check fails, or the page is not the one whose sum is committed.
pub fn test(paths: &Paths) -> Result<(), Failure> {
    if let Some(why) = obstacle(paths)? {
        return print::out(&format!("skipped: the page in a browser ({BROWSER_CHECK}): {why}\n"));
    }
    copy(paths)?;
    let (page, html) = (paths.browser().join("report.html"), page::render(paths)?);
    disk::write(&page, html.as_bytes())?;
    check_sum(paths, &html)?;
    let mut node = Command::new("node");
    step(BROWSER_CHECK, node.arg(paths.browser().join("test.mjs")).arg(page).arg(&paths.root))
}

/// Whether the page has its committed sum, if there is one.
fn check_sum(paths: &Paths, html: &str) -> Result<(), Failure> {
    let committed = Sums::read(&paths.root.join(PAPER_SUMS), PAPER_SUMS)?.unwrap_or_default();
    let hash = files::write::sha256(html.as_bytes());
    match committed.by_name.get(PAGE) {
        Some(expected) if *expected != hash => Err(Failure::Differs(format!(
            "{PAGE} has the sum {hash}, {PAPER_SUMS} {expected}; cargo xtask report writes the new one"
        ))),
        _ => Ok(()),
    }
}

/// Why the tests cannot run here.
fn obstacle(paths: &Paths) -> Result<Option<String>, Failure> {
    let missing = |what: &str| Some(format!("no {what}; cargo xtask ci installs it where apt-get may be used"));
    if !paths.root.join(BROWSER_CHECK).is_dir() {
        return Ok(Some(format!("there is no {BROWSER_CHECK}")));
    }
    if browser().is_none() {
        return Ok(missing("chromium"));
    }
    if node().is_none() {
        return Ok(missing(&format!("node {NODE} or later")));
    }
    if !is_installed(paths)? {
        return Ok(Some("its packages are not installed; cargo xtask ci installs them".to_owned()));
    }
    let refused = gate::figures_verify(paths, &figure::discover(paths)?).err();
    Ok(refused.map(|failure| failure.text().lines().next().unwrap_or("").to_owned()))
}

/// The version of the browser.
pub fn browser() -> Option<String> {
    BROWSERS.iter().find_map(|name| child::first_line(name, &["--version"]))
}

/// The version of Node, when it is new enough.
pub fn node() -> Option<String> {
    child::first_line("node", &["--version"]).filter(|version| {
        let major = version.trim_start_matches('v').split('.').next().and_then(|major| major.parse::<u32>().ok());
        major.is_some_and(|major| major >= NODE)
    })
}

fn npm() -> Option<String> {
    child::first_line("npm", &["--version"])
}

fn is_root() -> bool {
    child::first_line("id", &["-u"]).as_deref() == Some("0")
}

/// Whether the packages are those of the committed list.
fn is_installed(paths: &Paths) -> Result<bool, Failure> {
    let committed = disk::read_text(&paths.root.join(BROWSER_CHECK).join(PACKAGE_LOCK))?;
    let copied = disk::read_text(&paths.browser().join(PACKAGE_LOCK))?;
    Ok(committed.is_some() && committed == copied && paths.browser().join(INSTALLED).is_file())
}

/// Copies the tests to where their packages are, so that no package lies in the checkout.
fn copy(paths: &Paths) -> Result<(), Failure> {
    let from = paths.root.join(BROWSER_CHECK);
    for name in disk::names(&from)?.iter().filter(|name| is_source(name)) {
        let text = disk::read_text(&from.join(name))?.unwrap_or_default();
        disk::write_if_changed(&paths.browser().join(name), text.as_bytes())?;
    }
    Ok(())
}

fn is_source(name: &str) -> bool {
    Path::new(name).extension().is_some_and(|ending| ending == "mjs" || ending == "json")
}
