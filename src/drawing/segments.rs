//! Pieces of one exact straight line, made one again where nothing but a
//! change of invisibility or class has cut it.
//!
//! A method cuts a line wherever the number of sheets in front of it changes.
//! In a layer many of these cuts are of no interest: between one sheet and
//! two, a hidden line is hidden. Pieces know their line by `run`; two of
//! them are joined when they stand one after the other in their layer and
//! the end of the first is bit for bit the beginning of the second.

use super::placement::Placement;
use crate::view::VisibleLines;
use glam::DVec2;

/// The segments of the pieces `indices`, on the page, and their runs. What has no length on
/// the page is left out: it cannot be drawn and would tear polylines apart.
pub(super) fn segments(
    lines: &VisibleLines,
    indices: &[u32],
    placement: &Placement,
) -> (Vec<[DVec2; 2]>, Vec<u32>) {
    let mut segments = Vec::with_capacity(indices.len());
    let mut runs = Vec::with_capacity(indices.len());
    let mut rest = indices;
    while let Some((first, mut tail)) = rest.split_first() {
        let first = &lines.pieces[*first as usize];
        let mut end = first.points[1];
        while let Some((next, others)) = tail.split_first() {
            let next = &lines.pieces[*next as usize];
            if next.run != first.run || next.points[0] != end {
                break;
            }
            end = next.points[1];
            tail = others;
        }
        let segment = [placement.apply(first.points[0]), placement.apply(end)];
        if segment[0] != segment[1] {
            segments.push(segment);
            runs.push(first.run);
        }
        rest = tail;
    }
    (segments, runs)
}
