//! Object-space methods: what is visible of which line, exactly.

mod roberts;

pub use roberts::roberts;
