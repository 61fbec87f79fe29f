//! The binary `steradian`.
fn main() {}
