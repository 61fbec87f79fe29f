//! The binary `steradian-tools`; see [`sr_tools::cli`].

use std::process::ExitCode;

fn main() -> ExitCode {
    sr_tools::cli::main()
}
