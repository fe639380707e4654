//! Which piece goes on as which, before anything is on a page.
//!
//! Ends meet where image and depth are the same, bit for bit: pieces of one
//! line do, and lines that share a vertex. Where three ends or more meet
//! they are paired as strokes are, the straightest first.

use crate::drawing::joints::Joints;
use crate::view::LinePiece;
use glam::DVec2;
use rustc_hash::FxHashMap;

/// The end that goes on from each end; 2 i and 2 i + 1 are those of piece i.
pub(super) struct Chains {
    partners: Vec<u32>,
}

/// No partner.
const SINGLE: u32 = u32::MAX;

impl Chains {
    /// Pairs the ends of the pieces that are `drawn`. O(n).
    pub(super) fn new(pieces: &[LinePiece], drawn: &[bool]) -> Self {
        let segments: Vec<[DVec2; 2]> = pieces.iter().map(|piece| piece.points).collect();
        let mut joints: FxHashMap<[u64; 3], Vec<u32>> = FxHashMap::default();
        for (index, piece) in pieces.iter().enumerate().filter(|(index, _)| drawn[*index]) {
            for end in 0..2 {
                let (point, depth) = (piece.points[end], piece.depth[end]);
                // A sum with zero is never a negative zero.
                let key = [point.x, point.y, depth].map(|x| (x + 0.0).to_bits());
                joints.entry(key).or_default().push((2 * index + end) as u32);
            }
        }
        let mut pairs = Vec::with_capacity(pieces.len());
        let mut crowd = Joints::default();
        for ends in joints.values() {
            match ends[..] {
                [_] => {}
                [one, other] => pairs.push([one, other]),
                _ => crowd.pair(&segments, ends, &mut pairs),
            }
        }
        let mut partners = vec![SINGLE; 2 * pieces.len()];
        for [one, other] in pairs {
            partners[one as usize] = other;
            partners[other as usize] = one;
        }
        Chains { partners }
    }

    /// The end that lies where `end` lies and goes on from it.
    pub(super) fn partner(&self, end: u32) -> Option<u32> {
        Some(self.partners[end as usize]).filter(|partner| *partner != SINGLE)
    }
}
