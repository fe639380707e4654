//! Fills against formulas, against each other and against counting.

#![allow(clippy::unwrap_used, clippy::print_stdout)]

mod floods;
mod polygons;
#[cfg(feature = "text")]
mod text;
#[cfg(feature = "text")]
mod tiny_font;

/// Whole numbers below a limit.
pub(crate) fn random(seed: u64) -> impl FnMut(i64) -> i64 {
    let mut state = seed;
    move |limit| {
        state =
            state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        ((state >> 33) as i64) % limit
    }
}
