//! The program `publish`: article, page and archive.

fn main() {
    std::process::exit(publish::cli::run(std::env::args_os()));
}
