//! Which of the pieces over one place of an image line is drawn: the nearest
//! of those that are equally visible and of one class.
//!
//! Pieces come and go along the line. Those of one tier are kept in their
//! order of depth, which stays what it is while none of them passes through
//! another; for that it is enough that no two neighbours do (Shamos and Hoey
//! 1976). Where two do, neither hides the other and there is no such order:
//! then all pieces of the tier are held against one another, best first.

use crate::model::LineClass;
use std::cmp::Ordering;
use std::collections::{BTreeMap, BTreeSet};

/// How visible a piece is, and its class: the least is drawn.
pub(super) type Tier = (u32, LineClass);

/// Two pieces pass through one another.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
struct Crossing;

/// What a question about two pieces must tell: which of them is nearer, or,
/// where both are the same, comes first by rank; nothing if they pass through
/// one another.
pub(super) trait Depths {
    /// The tier of a piece.
    fn tier(&self, piece: u32) -> Tier;
    /// The order of two pieces of one tier.
    fn compare(&self, one: u32, other: u32) -> Option<Ordering>;
    /// Whether one piece is nearer than another wherever they lie on one
    /// another.
    fn hides(&self, one: u32, other: u32) -> bool;
    /// The rank of a piece, in the order of tiers.
    fn rank(&self, piece: u32) -> u32;
}

/// The pieces over a place.
#[derive(Debug, Default)]
pub(super) struct Rivals {
    /// By rank.
    all: BTreeSet<(u32, u32)>,
    /// By depth, unless some pass through others.
    tiers: BTreeMap<Tier, NearestFirst>,
    are_crossing: bool,
}

impl Rivals {
    /// A piece begins.
    pub(super) fn add(&mut self, piece: u32, depths: &impl Depths) {
        self.all.insert((depths.rank(piece), piece));
        if !self.are_crossing {
            let tier = self.tiers.entry(depths.tier(piece)).or_default();
            self.are_crossing = tier.insert(piece, depths).is_err();
        }
    }

    /// A piece ends, if it is there.
    pub(super) fn remove(&mut self, piece: u32, depths: &impl Depths) {
        if self.all.remove(&(depths.rank(piece), piece)) && !self.are_crossing {
            let tier = depths.tier(piece);
            let list = self.tiers.entry(tier).or_default();
            self.are_crossing = list.remove(piece, depths).is_err();
            if list.chunks.is_empty() {
                self.tiers.remove(&tier);
            }
        }
    }

    /// The piece that is drawn.
    pub(super) fn best(&self, depths: &impl Depths) -> Option<u32> {
        if !self.are_crossing {
            return self.tiers.values().next()?.first();
        }
        let mut pieces = self.all.iter().map(|&(_, piece)| piece);
        let first = pieces.next()?;
        let rivals = pieces.take_while(|&piece| depths.tier(piece) == depths.tier(first));
        Some(rivals.fold(first, |best, piece| if depths.hides(piece, best) { piece } else { best }))
    }
}

/// Pieces in their order of depth, in chunks, none of them empty.
#[derive(Debug, Default)]
struct NearestFirst {
    chunks: Vec<Vec<u32>>,
}

/// A chunk of more pieces is cut in two.
const CHUNK: usize = 512;

impl NearestFirst {
    fn first(&self) -> Option<u32> {
        Some(self.chunks.first()?[0])
    }

    /// The chunk in which a piece has its place, and the place.
    fn find(&self, piece: u32, depths: &impl Depths) -> Result<(usize, usize), Crossing> {
        let chunk = place_in(self.chunks.len(), piece, |chunk| self.chunks[chunk][0], depths)?;
        // What is equal to the first of a chunk is in it.
        let is_first = self.chunks.get(chunk).is_some_and(|chunk| chunk[0] == piece);
        let chunk = if is_first { chunk } else { chunk.saturating_sub(1) };
        let own = self.chunks.get(chunk).map_or(&[][..], |own| &own[..]);
        Ok((chunk, place_in(own.len(), piece, |place| own[place], depths)?))
    }

    fn insert(&mut self, piece: u32, depths: &impl Depths) -> Result<(), Crossing> {
        let (chunk, place) = self.find(piece, depths)?;
        if self.chunks.is_empty() {
            self.chunks.push(Vec::new());
        }
        self.chunks[chunk].insert(place, piece);
        let (before, after) = self.neighbours(chunk, place);
        for neighbour in [before, after].into_iter().flatten() {
            depths.compare(piece, neighbour).ok_or(Crossing)?;
        }
        if self.chunks[chunk].len() > CHUNK {
            let rest = self.chunks[chunk].split_off(CHUNK / 2);
            self.chunks.insert(chunk + 1, rest);
        }
        Ok(())
    }

    fn remove(&mut self, piece: u32, depths: &impl Depths) -> Result<(), Crossing> {
        let (chunk, place) = self.find(piece, depths)?;
        // Only an inexact policy loses a piece.
        if self.chunks.get(chunk).and_then(|own| own.get(place)) != Some(&piece) {
            return Err(Crossing);
        }
        let (before, after) = self.neighbours(chunk, place);
        self.chunks[chunk].remove(place);
        if self.chunks[chunk].is_empty() {
            self.chunks.remove(chunk);
        }
        match (before, after) {
            (Some(before), Some(after)) => {
                depths.compare(before, after).map(|_| ()).ok_or(Crossing)
            }
            _ => Ok(()),
        }
    }

    fn neighbours(&self, chunk: usize, place: usize) -> (Option<u32>, Option<u32>) {
        let own = &self.chunks[chunk];
        let before = match place {
            0 => chunk.checked_sub(1).and_then(|chunk| self.chunks[chunk].last()),
            _ => own.get(place - 1),
        };
        let after =
            own.get(place + 1).or_else(|| self.chunks.get(chunk + 1).and_then(|next| next.first()));
        (before.copied(), after.copied())
    }
}

/// The first of some places in their order whose piece does not come before
/// `piece`.
fn place_in(
    count: usize,
    piece: u32,
    at: impl Fn(usize) -> u32,
    depths: &impl Depths,
) -> Result<usize, Crossing> {
    let (mut low, mut high) = (0, count);
    while low < high {
        let middle = (low + high) / 2;
        let other = at(middle);
        let order = if other == piece {
            Ordering::Equal
        } else {
            depths.compare(other, piece).ok_or(Crossing)?
        };
        if order == Ordering::Less { low = middle + 1 } else { high = middle }
    }
    Ok(low)
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    /// Segments over a line, each with its depths at both ends.
    struct Segments(Vec<([i32; 2], [i32; 2])>);

    impl Segments {
        /// The difference of depths at a place, up to a positive factor.
        fn apart(&self, one: u32, other: u32, at: i32) -> i64 {
            let depth = |piece: u32| {
                let ([from, to], [first, last]) = self.0[piece as usize];
                let length = i64::from(to - from);
                let share = i64::from(last - first) * i64::from(at - from);
                (i64::from(first) * length + share, length)
            };
            let ((a, x), (b, y)) = (depth(one), depth(other));
            a * y - b * x
        }

        fn signs(&self, one: u32, other: u32) -> [i64; 2] {
            let [([a, b], _), ([c, d], _)] = [one, other].map(|it| self.0[it as usize]);
            [a.max(c), b.min(d)].map(|at| self.apart(one, other, at).signum())
        }
    }

    impl Depths for Segments {
        fn tier(&self, piece: u32) -> Tier {
            (piece % 2, LineClass::Contour)
        }

        fn compare(&self, one: u32, other: u32) -> Option<Ordering> {
            match self.signs(one, other) {
                [-1, 1] | [1, -1] => None,
                [first, last] => Some((first + last).cmp(&0).then(one.cmp(&other))),
            }
        }

        fn hides(&self, one: u32, other: u32) -> bool {
            let [first, last] = self.signs(one, other);
            first <= 0 && last <= 0 && first + last < 0
        }

        fn rank(&self, piece: u32) -> u32 {
            piece + 1000 * (piece % 2)
        }
    }

    proptest! {
        #[test]
        fn the_best_is_that_of_all_pairs(
            segments in prop::collection::vec(
                (0..12_i32, 1..9_i32, prop::array::uniform2(0..5_i32), any::<bool>()),
                1..40,
            ),
            is_flat in any::<bool>(),
        ) {
            let own = |&(from, length, [first, last], flat): &(i32, i32, [i32; 2], bool)| {
                ([from, from + length], [first, if flat || is_flat { first } else { last }])
            };
            let depths = Segments(segments.iter().map(own).collect());
            let (mut ordered, mut listed) = (Rivals::default(), Rivals::default());
            listed.are_crossing = true;
            for at in 0..22 {
                for rivals in [&mut ordered, &mut listed] {
                    let pieces = || (0..).zip(&depths.0);
                    pieces()
                        .filter(|(_, ([_, to], _))| *to == at)
                        .for_each(|(piece, _)| rivals.remove(piece, &depths));
                    pieces()
                        .filter(|(_, ([from, _], _))| *from == at)
                        .for_each(|(piece, _)| rivals.add(piece, &depths));
                }
                prop_assert_eq!(ordered.best(&depths), listed.best(&depths));
            }
            prop_assert!(!is_flat || !ordered.are_crossing);
        }
    }

    #[test]
    fn many_pieces_stay_in_order() {
        let count = 5000_u32;
        let depths = Segments(
            (0..count as i32).map(|i| ([0, 1 + i], [i * 7919 % count as i32; 2])).collect(),
        );
        let mut rivals = Rivals::default();
        (0..count).for_each(|piece| rivals.add(piece, &depths));
        for ended in 0..count {
            let left = (ended..count).min_by_key(|&piece| (piece % 2, depths.0[piece as usize].1));
            assert_eq!(rivals.best(&depths), left);
            rivals.remove(ended, &depths);
        }
        assert!(!rivals.are_crossing);
        assert_eq!(rivals.best(&depths), None);
    }
}
