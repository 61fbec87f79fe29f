//! Panics without their dump: stages catch them and turn them into errors, and what the panic said
//! is kept here for the error's text.

use std::panic::PanicHookInfo;
use std::sync::{Mutex, Once, PoisonError};

/// What the last panic said and where; of several at once on several threads, the last.
static LAST: Mutex<Option<String>> = Mutex::new(None);

/// Replaces the default hook, once; with `RUST_BACKTRACE` set, the default one runs as well.
pub fn silence() {
    static ONCE: Once = Once::new();
    ONCE.call_once(|| {
        let default = std::panic::take_hook();
        let loud = std::env::var_os("RUST_BACKTRACE").is_some_and(|v| v != "0");
        std::panic::set_hook(Box::new(move |info| {
            *LAST.lock().unwrap_or_else(PoisonError::into_inner) = Some(describe(info));
            if loud {
                default(info);
            }
        }));
    });
}

/// What was panicked last; forgotten by the call.
pub fn take() -> Option<String> {
    LAST.lock().unwrap_or_else(PoisonError::into_inner).take()
}

fn describe(info: &PanicHookInfo<'_>) -> String {
    let message = info.payload_as_str().unwrap_or("a value that is no text");
    match info.location() {
        Some(place) => format!("{message} ({}:{})", place.file(), place.line()),
        None => message.to_owned(),
    }
}
