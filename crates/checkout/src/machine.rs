//! The machine and the toolchain.

use crate::disk;
use crate::process;
use std::collections::BTreeMap;
use std::env::consts;
use std::path::Path;
use std::process::Command;

/// The properties that distinguish machines and toolchains.
pub fn facts() -> [(&'static str, String); 3] {
    [("processor", processor()), ("system", system()), ("rustc", rustc())]
}

/// The model of the processor.
pub fn processor() -> String {
    field("/proc/cpuinfo", "model name")
        .or_else(|| process::first_line("sysctl", &["-n", "machdep.cpu.brand_string"]))
        .unwrap_or_else(|| "unknown".to_owned())
}

/// KiB of memory.
pub fn memory() -> Option<u64> {
    field("/proc/meminfo", "MemTotal")?.split_whitespace().next()?.parse().ok()
}

/// The operating system and its version, without the kernel's.
pub fn system_name() -> String {
    let text = disk::read_text(Path::new("/etc/os-release")).ok().flatten().unwrap_or_default();
    let name = text.lines().find_map(|line| line.strip_prefix("PRETTY_NAME=")).map(|name| name.trim_matches('"'));
    name.unwrap_or(consts::OS).to_owned()
}

fn system() -> String {
    let kernel = process::first_line("uname", &["-sr"]).unwrap_or_default();
    format!("{} {kernel}", system_name()).trim_end().to_owned()
}

/// The compiler's first line and its target.
pub fn rustc_brief() -> String {
    let all = rustc();
    let target = all.split("; ").find_map(|part| part.strip_prefix("host: ")).unwrap_or("unknown target");
    format!("{}, {target}", all.split("; ").next().unwrap_or("unknown"))
}

fn rustc() -> String {
    let output = Command::new("rustc").arg("-vV").output();
    let text = output.map_or_else(|error| error.to_string(), |out| String::from_utf8_lossy(&out.stdout).into_owned());
    text.lines().map(str::trim).collect::<Vec<_>>().join("; ")
}

/// Instructions on which a choice at run time depends, and whether the processor has them.
#[cfg(target_arch = "x86_64")]
pub fn features() -> BTreeMap<&'static str, bool> {
    let (avx2, fma) = (std::is_x86_feature_detected!("avx2"), std::is_x86_feature_detected!("fma"));
    [("avx2", avx2), ("fma", fma), ("avx512f", std::is_x86_feature_detected!("avx512f"))].into()
}

/// No choice depends on the processor here.
#[cfg(not(target_arch = "x86_64"))]
pub fn features() -> BTreeMap<&'static str, bool> {
    BTreeMap::new()
}

/// The first value of a `key : value` file of the kernel.
fn field(file: &str, key: &str) -> Option<String> {
    let text = disk::read_text(Path::new(file)).ok()??;
    let mut values = text.lines().filter_map(|line| line.split_once(':'));
    values.find(|(name, _)| name.trim() == key).map(|(_, value)| value.trim().to_owned())
}
