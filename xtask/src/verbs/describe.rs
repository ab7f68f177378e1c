//! `describe`: the machine and the toolchain, for a report of a difference.

use crate::cli::JsonArgs;
use crate::pins::{self, CRATE};
use checkout::failure::Failure;
use checkout::machine::{facts, features, memory};
use checkout::paths::Paths;
use checkout::print;
use serde_json::json;
use std::collections::BTreeMap;
use std::env::consts;

/// Dependencies whose version may show in an output.
const KEY_CRATES: [&str; 7] = ["base64", "csv", "plotters", "png", "tiny-skia", "toml", "ttf-parser"];

/// Runs the verb.
///
/// # Errors
/// The lock file cannot be read.
pub fn run(paths: &Paths, arguments: &JsonArgs) -> Result<(), Failure> {
    let (facts, features, pins) = (facts(), features(), pins::read(paths)?);
    let version = |text: &str| text.split(' ').next().unwrap_or("").to_owned();
    let named = pins.iter().filter_map(|(name, text)| Some((name.strip_prefix(CRATE)?, version(text))));
    let crates: BTreeMap<&str, String> = named.filter(|(name, _)| KEY_CRATES.contains(name)).collect();
    let processors = std::thread::available_parallelism().map_or(1, std::num::NonZero::get);
    if arguments.json {
        let facts: BTreeMap<&str, String> = facts.into_iter().collect();
        return print::json(json!({
            "machine": facts, "processors": processors, "memory_kib": memory(), "features": features,
            "architecture": consts::ARCH, "profile": "release", "crates": crates,
        }));
    }
    let mut rows: Vec<Vec<String>> = facts.iter().map(|(name, value)| print::row(&[name, value])).collect();
    let flags: Vec<String> =
        features.iter().map(|(name, has)| format!("{name}: {}", if *has { "yes" } else { "no" })).collect();
    rows.push(print::row(&["architecture", consts::ARCH]));
    rows.push(print::row(&["processors", &processors.to_string()]));
    rows.push(print::row(&["features", &flags.join(", ")]));
    rows.push(print::row(&["memory", &memory().map_or("unknown".to_owned(), |kib| format!("{kib} KiB"))]));
    rows.push(print::row(&["profile", "release"]));
    rows.extend(crates.iter().map(|(name, version)| print::row(&[name, version])));
    print::out(&print::table(&rows))
}
