//! What need not be looked at.

/// Shortcuts on the way to visible lines. None changes the answer; they can be
/// turned off to measure what they buy.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Skips {
    /// Lines behind what is certainly covered.
    pub culling: Culling,
    /// Whether a line is left as soon as it is known to be hidden all along.
    pub early: bool,
    /// Whether counts are carried from line to line where that can be done.
    pub carry: bool,
    /// Whether convex parts are looked for: they do not pass through
    /// themselves, and hide their edges at the back.
    pub convex: bool,
}

impl Default for Skips {
    fn default() -> Self {
        Skips { culling: Culling::default(), early: true, carry: true, convex: true }
    }
}

/// When lines are culled that lie behind covered tiles.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub enum Culling {
    /// Where it is likely to pay.
    #[default]
    WhereItPays,
    /// Always, for tests: the answer is the same.
    Always,
    /// Never, to measure what it buys.
    Never,
}
