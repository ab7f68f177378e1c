//! `cargo xtask VERB`: reads the command line, runs the verb, and turns its result into an exit code.

use checkout::failure::Failure;
use checkout::paths::Paths;
use clap::Parser;
use std::process::exit;
use xtask::cli::{Cli, Verb};
use xtask::verbs;

fn main() {
    if let Err(failure) = run(Cli::parse()) {
        exit(failure.tell());
    }
}

fn run(cli: Cli) -> Result<(), Failure> {
    let paths = &Paths::find(cli.root)?;
    match cli.verb {
        Verb::Figures(arguments) => verbs::figures::run(paths, &arguments),
        Verb::Verify(arguments) => match &arguments.receipt {
            Some(file) => verbs::receipt::check(paths, file),
            None => verbs::verify::run(paths, &arguments),
        },
        Verb::Status(arguments) => verbs::status::run(paths, &arguments),
        Verb::Explain(arguments) => verbs::explain::run(paths, &arguments),
        Verb::List(arguments) => verbs::list::run(paths, &arguments),
        Verb::Bless(arguments) => verbs::bless::run(paths, &arguments),
        Verb::Accuracy(arguments) => verbs::accuracy::run(paths, &arguments),
        Verb::Bench(arguments) => verbs::forward::bench(paths, &arguments),
        Verb::Report(arguments) => verbs::publish::report(paths, &arguments),
        Verb::Paper(arguments) => verbs::publish::paper(paths, &arguments),
        Verb::Bundle(arguments) => verbs::publish::bundle(paths, &arguments),
        Verb::Simulate(arguments) => verbs::forward::scene(paths, "simulate", &arguments),
        Verb::Map(arguments) => verbs::forward::scene(paths, "map", &arguments),
        Verb::Sweep(arguments) => verbs::forward::sweep(paths, &arguments),
        Verb::Export(arguments) => verbs::forward::export(paths, &arguments),
        Verb::Describe(arguments) => verbs::describe::run(paths, &arguments),
        Verb::Doctor(arguments) => verbs::doctor::run(paths, &arguments),
        Verb::Test => verbs::checks::test(paths),
        Verb::Ci(arguments) => verbs::checks::ci(paths, &arguments),
        Verb::Clean => verbs::clean::run(paths),
    }
}
