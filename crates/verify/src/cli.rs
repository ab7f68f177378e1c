//! The command line. The runner starts this program; it can also be started by hand.

use crate::findings::Findings;
use crate::reference::Reference;
use crate::{accuracy, attest, bless, costs, distance, judgement, page};
use checkout::disk;
use checkout::failure::Failure;
use checkout::figure;
use checkout::hashing;
use checkout::outputs::Hashes;
use checkout::paths::{ATTESTATIONS, LEDGER, Paths, TOLERANCES};
use checkout::print;
use checkout::request::{MadeFigure, Request};
use clap::{Args, Parser, Subcommand};
use std::collections::BTreeSet;
use std::ffi::OsString;
use std::path::PathBuf;

/// Compares what was made with what is committed.
#[derive(Debug, Parser)]
#[command(name = "verify")]
struct Cli {
    /// The checkout
    #[arg(long, global = true)]
    root: Option<PathBuf>,
    #[command(subcommand)]
    verb: Verb,
}

#[derive(Debug, Subcommand)]
enum Verb {
    /// Judge figures that were made
    Judge(JudgeArgs),
    /// Show what changes against the last commit, then accept it
    Bless(BlessArgs),
    /// Compare tables of accuracy that were made
    Accuracy(accuracy::Options),
    /// How far the paper's scheme is from the accurate runs and from the published curves
    Distances(JsonArgs),
    /// The figures whose tables the ledger reads
    Figures,
    /// All claims with their verdicts
    Claims(JsonArgs),
    /// A claim, an erratum or a parameter with its tests
    Explain(ExplainArgs),
    /// What each figure and each claim costs; written to data/COSTS.md too
    Costs,
}

#[derive(Debug, Args)]
struct JsonArgs {
    #[arg(long)]
    json: bool,
}

#[derive(Debug, Args)]
struct ExplainArgs {
    id: String,
    /// Why it is no figure either, for the message
    #[arg(long, default_value = "")]
    no_figure: String,
    #[arg(long)]
    json: bool,
}

#[derive(Debug, Args)]
struct JudgeArgs {
    /// What was made, and from what
    #[arg(long)]
    request: PathBuf,
    /// Code 0 when all that differs is within the tolerances
    #[arg(long)]
    tolerant: bool,
    /// A page that shows what differs
    #[arg(long)]
    report: Option<PathBuf>,
    /// Append machine, toolchain and sums to the attestations
    #[arg(long)]
    attest: bool,
    #[arg(long)]
    json: bool,
}

#[derive(Debug, Args)]
struct BlessArgs {
    /// What is to be accepted
    #[arg(long)]
    request: PathBuf,
    /// Accept figures whose numbers moved
    #[arg(long)]
    numbers: bool,
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
        Verb::Judge(arguments) => judge(paths, &arguments),
        Verb::Bless(arguments) => bless::run(paths, &Request::read(&arguments.request)?, arguments.numbers),
        Verb::Accuracy(options) => accuracy::run(paths, &options),
        Verb::Distances(arguments) => distance::tell(paths, arguments.json),
        Verb::Figures => {
            let ids: Vec<String> = claims::figures(paths)?.into_iter().map(|id| id + "\n").collect();
            print::out(&ids.concat())
        }
        Verb::Claims(arguments) => {
            let (text, value) = claims::list(paths)?;
            if arguments.json { print::json(value) } else { print::out(&text) }
        }
        Verb::Explain(arguments) => match claims::explain(paths, &arguments.id)? {
            Some((_, value)) if arguments.json => print::json(value),
            Some((text, _)) => print::out(&text),
            None => {
                let ExplainArgs { id, no_figure, .. } = arguments;
                let text = format!("{id}: no claim, erratum or parameter has this id\n{no_figure}");
                Err(Failure::Usage(text.trim_end().to_owned()))
            }
        },
        Verb::Costs => costs::tell(paths),
    }
}

fn judge(paths: &Paths, arguments: &JudgeArgs) -> Result<(), Failure> {
    let request = Request::read(&arguments.request)?;
    let all = figure::discover(paths)?;
    let figures = request.figures(&all)?;
    let reference = Reference::read(paths, &request)?;
    let findings = findings(paths, &request, &figures, &reference, &all)?;
    match arguments.json {
        true => print::json(findings.to_json())?,
        false => print::out(&findings.to_text())?,
    }
    if arguments.attest {
        let line = attest::Attestation::here(request.jobs, &findings.sums, findings.verdict().word());
        let done = if attest::append(paths, &line)? { "one line added" } else { "the line is already there" };
        eprintln!("{ATTESTATIONS}: {done}");
    }
    if let Some(file) = &arguments.report {
        disk::write(file, page::html(&findings, &attest::read(paths)?)?.as_bytes())?;
    }
    if findings.are_all_but_the_ledger() && !findings.are_same() {
        claims::write(paths, &findings.claims.ledger)?;
        eprintln!("{LEDGER} now holds the verdicts found: commit it");
    }
    conclude(&findings, arguments, &request)
}

fn findings(
    paths: &Paths,
    request: &Request,
    figures: &[MadeFigure<'_>],
    reference: &Reference,
    all: &[figure::Figure],
) -> Result<Findings, Failure> {
    let (made, differences) = (request.made(paths), paths.differences());
    disk::remove(&differences)?;
    let judge = |one: &MadeFigure<'_>| judgement::judge(paths, &made, one, reference, Some(&differences));
    let ids: BTreeSet<&str> = figures.iter().map(|one| &*one.figure.id).collect();
    let papers = figures.iter().filter(|one| !one.figure.is_supplement());
    let sums: Hashes = papers.flat_map(|one| one.outputs.clone()).collect();
    let listed = figure::select(all, &[], request.all)?;
    Ok(Findings {
        figures: figures.iter().map(judge).collect::<Result<_, _>>()?,
        claims: claims::judge(paths, &made, (!request.whole).then_some(&ids))?,
        strays: if request.whole { reference.strays(paths, &listed) } else { Vec::new() },
        left_out: request.left_out.clone(),
        sums: hashing::digest(&sums),
    })
}

fn conclude(findings: &Findings, arguments: &JudgeArgs, request: &Request) -> Result<(), Failure> {
    if findings.are_same() {
        return Ok(());
    }
    let mut wrong: Vec<&str> = findings.figures.iter().filter(|one| !one.is_same()).map(|one| &*one.id).collect();
    wrong.extend((!findings.claims.is_same()).then_some("claims"));
    wrong.extend((!findings.strays.is_empty()).then_some("lines that belong to no figure"));
    let words = format!("not as committed: {}", wrong.join(" "));
    if arguments.tolerant && findings.are_within() {
        eprintln!("{words}\nwithin the tolerances of {TOLERANCES}");
        return Ok(());
    }
    Err(Failure::Differs(format!("{words}; the outputs are in {}", request.base.display())))
}
