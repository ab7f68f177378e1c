//! `hunt`: judges random scenes, or a scene of yours, by a second integration.

use clap::Parser;
use hunt::{case, draw, judge, report};
use std::path::PathBuf;
use std::process::ExitCode;

/// Judges random scenes, or those given, by a second integration; exit code 1 if anything is wrong.
#[derive(Parser)]
struct Arguments {
    /// Scene files to judge instead of random ones
    scenes: Vec<PathBuf>,
    /// The first seed; from 1000000 on the laws are formulas; from 2000000 on the scenes of seeds lower by that, all by
    /// Taylor's method; from 10000000 on they have what the others never have: two or three hundred pedestrians, dense
    /// samples, runs shorter than a step, long runs, panels that differ in everything, everybody displaced
    #[arg(long, default_value_t = 0)]
    from: u64,
    /// How many scenes
    #[arg(long, default_value_t = 300)]
    count: u64,
    /// Print the scenes of these seeds instead of judging them
    #[arg(long)]
    print: bool,
    /// Print runs of these seeds with their right values as JSON, a line each, those alone that doubles can follow
    #[arg(long)]
    json: bool,
    /// Print all findings of each scene, not the first alone
    #[arg(long)]
    verbose: bool,
}

fn main() -> ExitCode {
    let arguments = Arguments::parse();
    if arguments.print {
        for seed in arguments.from..arguments.from + arguments.count {
            println!("{}", draw::scene(seed));
        }
        return ExitCode::SUCCESS;
    }
    if arguments.json {
        for seed in arguments.from..arguments.from + arguments.count {
            case::of(seed).iter().for_each(|case| println!("{case}"));
        }
        return ExitCode::SUCCESS;
    }
    let all = if arguments.scenes.is_empty() {
        let threads = std::thread::available_parallelism().map_or(1, usize::from);
        report::hunt(arguments.from, arguments.count, threads)
    } else {
        let mut all = Vec::new();
        for (seed, path) in (0..).zip(&arguments.scenes) {
            match std::fs::read_to_string(path) {
                Ok(text) => all.push(report::Hunted { seed, verdicts: judge::scene(&text) }),
                Err(error) => {
                    eprintln!("{}: {error}", path.display());
                    return ExitCode::from(2);
                }
            }
        }
        all
    };
    if arguments.verbose {
        for verdict in all.iter().flat_map(|hunted| &hunted.verdicts) {
            println!("{verdict:#?}");
        }
    }
    print!("{}", report::table(&all));
    let is_clean = all.iter().flat_map(|hunted| &hunted.verdicts).all(|verdict| verdict.findings.is_empty());
    if is_clean { ExitCode::SUCCESS } else { ExitCode::FAILURE }
}
