//! Sheets by their farthest points, exactly.

use super::sheets::Sheet;
use crate::kernel::numbers::Sign;
use crate::kernel::predicates::{Policy, Predicates};
use std::cmp::Ordering;

/// Compares two sheets: the one with the deeper farthest point comes first,
/// of equally deep ones the one with the greater number, then the later piece.
pub(super) fn farthest_first<P: Policy>(
    predicates: &Predicates<'_, P>,
    sheets: &[Sheet],
    first: u32,
    second: u32,
) -> Ordering {
    let [a, b] = [first, second].map(|i| &sheets[i as usize]);
    match predicates.deeper(a.farthest, b.farthest) {
        Sign::Positive => Ordering::Less,
        Sign::Negative => Ordering::Greater,
        Sign::Zero => b.face.cmp(&a.face).then(second.cmp(&first)),
    }
}
