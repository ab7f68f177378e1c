//! What a program uses while it runs: seconds of a processor and memory. From Linux's `/proc`; elsewhere unknown.

use checkout::disk;
use std::path::PathBuf;

/// What was seen of a program at the last look before its end: the last two per cent may be missing, and a program of a
/// millisecond is not seen at all.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Usage {
    /// Seconds on a processor.
    pub cpu: Option<f64>,
    /// Largest resident memory, in bytes.
    pub memory: Option<u64>,
}

impl Usage {
    /// Looks at a running program; what cannot be seen any more stays as it was.
    pub fn look(&mut self, process: u32) {
        let read = |name: &str| {
            let path = PathBuf::from(format!("/proc/{process}/{name}"));
            disk::read_text(&path).ok().flatten().unwrap_or_default()
        };
        // nanoseconds on a processor come first
        let nanoseconds = read("schedstat").split_whitespace().next().and_then(|number| number.parse::<f64>().ok());
        self.cpu = nanoseconds.map(|number| number * 1e-9).or(self.cpu);
        let status = read("status");
        let peak = status.lines().find_map(|line| line.strip_prefix("VmHWM:")?.split_whitespace().next());
        self.memory = peak.and_then(|kib| kib.parse::<u64>().ok()).map(|kib| kib * 1024).or(self.memory);
    }
}
