//! The program `measure`: the benchmarks of `cargo xtask bench`.

fn main() {
    std::process::exit(measure::bench::main());
}
