//! Which piece goes on as which, before anything is on a page.
//!
//! Ends meet where image and depth are the same, bit for bit: pieces of one
//! line do, and lines that share a vertex. Where three ends or more meet
//! they are paired as strokes are, the straightest first.

use crate::drawing::chaining::{SINGLE, pair_ends};
use crate::run::map_indexed;
use crate::view::LinePiece;

/// The end that goes on from each end; 2 i and 2 i + 1 are those of piece i.
pub(super) struct Chains {
    partners: Vec<u32>,
}

impl Chains {
    /// Pairs the ends of the pieces that are `drawn`. O(n).
    pub(super) fn new(pieces: &[LinePiece], drawn: &[bool]) -> Self {
        let segments = map_indexed(pieces.len(), |piece| pieces[piece].points);
        let place = |number: u32| {
            let (piece, end) = ((number / 2) as usize, (number % 2) as usize);
            let (point, depth) = (pieces[piece].points[end], pieces[piece].depth[end]);
            // A sum with zero is never a negative zero.
            drawn[piece].then(|| [point.x, point.y, depth].map(|x| (x + 0.0).to_bits()))
        };
        let (partners, _) = pair_ends(&segments, place);
        Chains { partners }
    }

    /// The end that lies where `end` lies and goes on from it.
    pub(super) fn partner(&self, end: u32) -> Option<u32> {
        Some(self.partners[end as usize]).filter(|partner| *partner != SINGLE)
    }
}
