//! Bytes as `experiment` files; see `sr_tests::fuzz`.
#![no_main]

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| {
    let _ = (sr_tests::fuzz::target("experiment").run)(bytes);
});
