//! `cargo xtask VERB`: reads the command line, runs the verb, turns its end into an exit code.

use clap::Parser;
use std::process::exit;
use xtask::cli::{Cli, Verb};
use xtask::failure::Failure;
use xtask::paths::Paths;
use xtask::verbs;

fn main() {
    if let Err(failure) = run(Cli::parse()) {
        if !failure.text().is_empty() {
            eprintln!("{}", failure.text());
        }
        exit(failure.code());
    }
}

fn run(cli: Cli) -> Result<(), Failure> {
    let paths = Paths::find(cli.root)?;
    match cli.verb {
        Verb::Figures(arguments) => verbs::figures::run(&paths, &arguments),
        Verb::Verify(arguments) => verbs::verify::run(&paths, &arguments),
        Verb::Status(arguments) => verbs::status::run(&paths, &arguments),
        Verb::Explain(arguments) => verbs::explain::run(&paths, &arguments),
        Verb::List(arguments) => verbs::list::run(&paths, &arguments),
        Verb::Bless(arguments) => verbs::bless::run(&paths, &arguments),
        Verb::Accuracy(arguments) => verbs::accuracy::run(&paths, &arguments),
        Verb::Bench(arguments) => verbs::bench::run(&paths, &arguments),
        Verb::Report(arguments) => verbs::report::run(&paths, &arguments),
        Verb::Paper(arguments) => verbs::paper::run(&paths, &arguments),
        Verb::Bundle(arguments) => verbs::bundle::run(&paths, &arguments),
        Verb::Simulate(arguments) => verbs::forward::run(&paths, "simulate", &arguments),
        Verb::Map(arguments) => verbs::forward::run(&paths, "map", &arguments),
        Verb::Export(arguments) => verbs::export::run(&paths, &arguments),
        Verb::Describe(arguments) => verbs::describe::run(&paths, &arguments),
        Verb::Doctor(arguments) => verbs::doctor::run(&paths, &arguments),
        Verb::Test => verbs::test::run(&paths),
        Verb::Ci(arguments) => verbs::ci::run(&paths, &arguments),
        Verb::Clean => verbs::clean::run(&paths),
    }
}
