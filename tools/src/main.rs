//! The binary `steradian-tools`.
fn main() {}
