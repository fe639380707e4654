//! The program `umriss`: reads flags, runs the library, writes files.

fn main() {}
