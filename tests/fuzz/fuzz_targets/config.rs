#![no_main]

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| {
    let target = sr_tests::fuzz::target("config");
    (target.run)(bytes);
});
