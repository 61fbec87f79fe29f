//! The binary `steradian`; everything is in the library.

use std::process::ExitCode;

fn main() -> ExitCode {
    sr_cli::run(std::env::args_os(), &[])
}
