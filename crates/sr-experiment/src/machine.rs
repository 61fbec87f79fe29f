//! What experiments were made with, so that somebody else can judge their seconds.

use crate::units::counted;
use serde::{Deserialize, Serialize};
use std::fmt;

/// The machine and the program on it.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Machine {
    /// Name of the processor, where the system tells it.
    pub cpu: Option<String>,
    /// Logical processors that the program may use.
    pub cores: usize,
    /// Threads that rendered.
    pub threads: usize,
    /// Operating system and instruction set: `linux, x86_64`.
    pub system: String,
}

impl Machine {
    /// This one; 0 threads means one for each core.
    pub fn here(threads: usize) -> Self {
        let cores = std::thread::available_parallelism().map_or(1, usize::from);
        Self {
            cpu: std::fs::read_to_string("/proc/cpuinfo")
                .ok()
                .and_then(|t| cpu(&t)),
            cores,
            threads: if threads == 0 { cores } else { threads },
            system: format!("{}, {}", std::env::consts::OS, std::env::consts::ARCH),
        }
    }
}

impl fmt::Display for Machine {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let cpu = self.cpu.as_deref().unwrap_or("unknown processor");
        let (cores, threads) = (self.cores as u64, self.threads as u64);
        let (cores, threads) = (counted(cores, "core"), counted(threads, "thread"));
        write!(f, "{cpu}, {cores}, {threads}; {}", self.system)
    }
}

/// The first name in Linux's list of processors.
fn cpu(text: &str) -> Option<String> {
    let (_, rest) = text.split_once("model name")?;
    let name = rest.lines().next()?.split_once(':')?.1.trim();
    (!name.is_empty()).then(|| name.to_owned())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_name_of_a_processor_is_found_where_there_is_one() {
        let text =
            "processor\t: 0\nmodel name\t: Some CPU @ 2 GHz\nflags\t: fpu\nmodel name\t: Other\n";
        assert_eq!(cpu(text).as_deref(), Some("Some CPU @ 2 GHz"));
        assert_eq!(cpu("processor\t: 0\n"), None);
        assert!(Machine::here(0).threads >= 1);
        assert_eq!(Machine::here(3).threads, 3);
    }
}
