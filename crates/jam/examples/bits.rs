//! Prints fingerprints of the bits of every law, compiled and as a formula: `checks/other-machines.sh` compares them
//! with `crates/jam/tests/bits.csv`.

#[path = "../tests/it/fingerprints.rs"]
mod fingerprints;
#[path = "../tests/it/sample.rs"]
#[allow(dead_code)]
mod sample;
#[path = "../tests/it/written.rs"]
mod written;

fn main() {
    print!("{}", fingerprints::table());
}
