//! Ctrl-C: once asks for an end after the pass, twice aborts.

use std::io::Write;
use std::process::exit;
use std::sync::Once;
use std::sync::atomic::{AtomicBool, Ordering};

static ASKED: AtomicBool = AtomicBool::new(false);

/// What shells report for a program that Ctrl-C ended.
const ABORTED: i32 = 130;

/// From now on Ctrl-C is noted instead of ending the program.
pub fn watch(quiet: bool) {
    static ONCE: Once = Once::new();
    ASKED.store(false, Ordering::Relaxed);
    ONCE.call_once(|| {
        let handler = move || {
            if ASKED.swap(true, Ordering::Relaxed) {
                exit(ABORTED);
            }
            if !quiet {
                let text = "\nstopping after this pass; Ctrl-C again aborts";
                let _ = writeln!(std::io::stderr().lock(), "{text}");
            }
        };
        // Refused where a stranger's binary has its own handler, which then decides.
        let _ = ctrlc::set_handler(handler);
    });
}

/// Whether an end was asked for.
pub fn asked() -> bool {
    ASKED.load(Ordering::Relaxed)
}
