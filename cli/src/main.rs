//! The `whirl` command.
fn main() {}
