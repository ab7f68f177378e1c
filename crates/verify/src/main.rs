//! The program `verify`: judges what the runner made, accepts it, and shows entries of the ledger.

fn main() {
    std::process::exit(verify::cli::run(std::env::args_os()));
}
