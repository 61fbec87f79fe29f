//! Bytes as `picture` files; see `sr_tests::fuzz`.
#![no_main]

use std::panic::{set_hook, take_hook};

libfuzzer_sys::fuzz_target!(
    // A panic inside of a decoder becomes an error, as its reader promises; one that gets out of the target still
    // ends the program.
    init: {
        drop(take_hook());
        set_hook(Box::new(|_| {}));
    },
    |bytes: &[u8]| {
        let _ = (sr_tests::fuzz::target("picture").run)(bytes);
    }
);
