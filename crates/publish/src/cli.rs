//! The command line. The runner starts this program, because the runner knows whether the figures are up to date.

use crate::{article, bundle, page};
use checkout::disk;
use checkout::failure::Failure;
use checkout::paths::{PAGE, PAPER_SUMS, Paths};
use checkout::print;
use checkout::sums::{self, Sums};
use clap::{Args, Parser, Subcommand};
use std::ffi::OsString;
use std::path::PathBuf;

/// Writes what is made from the figures for readers.
#[derive(Debug, Parser)]
#[command(name = "publish")]
struct Cli {
    /// The checkout
    #[arg(long, global = true)]
    root: Option<PathBuf>,
    #[command(subcommand)]
    verb: Verb,
}

#[derive(Debug, Subcommand)]
enum Verb {
    /// Set the article as PDF, with its pictures and its numbers
    Article {
        /// Accept the numbers and the sums of the article and of its pictures
        #[arg(long)]
        bless: bool,
    },
    /// Write one HTML file with everything in it
    Page(PageArgs),
    /// Write one deterministic archive
    Bundle {
        /// Where to
        #[arg(long)]
        out: Option<PathBuf>,
    },
}

#[derive(Debug, Args)]
struct PageArgs {
    /// Where to, in place of paper/report.html
    #[arg(long)]
    out: Option<PathBuf>,
    /// Compare with the committed sum
    #[arg(long)]
    check: bool,
    /// A WebAssembly module that the page carries and computes with; the sum is that of the page without it
    #[arg(long, value_name = "FILE")]
    module: Option<PathBuf>,
}

/// Runs a command line; the exit code.
pub fn run(arguments: impl IntoIterator<Item = OsString>) -> i32 {
    match carry_out(Cli::parse_from(arguments)) {
        Ok(()) => 0,
        Err(failure) => failure.tell(),
    }
}

fn carry_out(cli: Cli) -> Result<(), Failure> {
    let paths = &Paths::find(cli.root)?;
    match cli.verb {
        Verb::Article { bless } => article::run(paths, bless),
        Verb::Page(arguments) => write_page(paths, &arguments),
        Verb::Bundle { out } => bundle::run(paths, out),
    }
}

fn write_page(paths: &Paths, arguments: &PageArgs) -> Result<(), Failure> {
    let html = page::render(paths)?;
    let hash = files::write::sha256(html.as_bytes());
    let html = match &arguments.module {
        Some(file) => page::module::embed(&html, &std::fs::read(file).map_err(Failure::at(file))?)?,
        None => html,
    };
    let list = paths.root.join(PAPER_SUMS);
    let shown = match &arguments.out {
        Some(file) => {
            disk::write(file, html.as_bytes())?;
            file.display().to_string()
        }
        None => {
            disk::write_if_changed(&paths.root.join(PAGE), html.as_bytes())?;
            PAGE.to_owned()
        }
    };
    let committed = Sums::read(&list, PAPER_SUMS)?.unwrap_or_default();
    match committed.by_name.get(PAGE) {
        Some(expected) if arguments.check && *expected != hash => {
            let remedy = "cargo xtask report writes the new one";
            return Err(Failure::Differs(format!("{PAGE} has the sum {hash}, {PAPER_SUMS} {expected}; {remedy}")));
        }
        _ if arguments.check || arguments.out.is_some() => {}
        _ => sums::record(&list, PAGE, &hash)?,
    }
    print::out(&format!("{shown}\n"))
}
