//! The program `verify`: judges what the runner made, accepts it, and answers for the ledger.

fn main() {
    std::process::exit(verify::cli::run(std::env::args_os()));
}
