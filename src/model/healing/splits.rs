//! Sides that are led through places beside them.
//!
//! Where a place lies beside an edge, the edge becomes two that meet there, in
//! all faces that have it: what was a corner in the middle of a side is a
//! corner of both faces, and they have their edges in common. No place moves
//! for it, and an edge leaves its old line by less than the tolerance.

use super::net::{FaceName, Net, Rings};
use super::{Tolerance, compare};
use rustc_hash::FxHashMap;

/// A side of faces of one object, in either direction.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub(super) struct Side {
    pub(super) object: u32,
    /// The smaller name first.
    pub(super) ends: [u32; 2],
}

impl Side {
    pub(super) fn new(object: u32, [a, b]: [u32; 2]) -> Self {
        Side { object, ends: [a.min(b), a.max(b)] }
    }
}

/// What became of faces.
#[derive(Default)]
pub(super) struct Applied {
    /// Those that are changed.
    pub(super) left: Vec<FaceName>,
    /// How many are none any more.
    pub(super) collapsed: usize,
}

/// Places to be led through, by side.
#[derive(Default)]
pub(super) struct Splits(FxHashMap<Side, Vec<u32>>);

impl Splits {
    pub(super) fn is_empty(&self) -> bool {
        self.0.is_empty()
    }

    pub(super) fn add(&mut self, side: Side, place: u32) {
        self.0.entry(side).or_default().push(place);
    }

    /// The places inside a side, in its direction.
    fn inside(&self, net: &Net<'_>, object: u32, ends: [u32; 2]) -> impl Iterator<Item = u32> {
        let places = self.0.get(&Side::new(object, ends)).map_or(&[][..], |places| places);
        let [from, to] = ends.map(|end| net.at(end));
        let backwards = compare(from, to).is_gt();
        (0..places.len()).map(move |i| places[if backwards { places.len() - 1 - i } else { i }])
    }

    /// Puts the places of each side in order from its lesser end, each once.
    fn sort(&mut self, net: &Net<'_>, tolerance: Tolerance) {
        for (side, places) in &mut self.0 {
            let mut ends = side.ends.map(|end| net.at(end));
            ends.sort_by(|&p, &q| compare(p, q));
            let along = |place: u32| {
                let beside = tolerance.beside(net.at(place), ends);
                beside.map_or(0.5, |beside| beside.along)
            };
            places.sort_by(|&a, &b| {
                along(a).total_cmp(&along(b)).then(compare(net.at(a), net.at(b)))
            });
            places.dedup();
        }
    }

    /// Leads all faces through the places. A face of which nothing is left
    /// has no rings then.
    pub(super) fn apply(mut self, net: &mut Net<'_>, tolerance: Tolerance) -> Applied {
        if self.0.is_empty() {
            return Applied::default();
        }
        self.sort(net, tolerance);
        let mut is_end = vec![false; net.first.len()];
        self.0.keys().flat_map(|side| side.ends).for_each(|end| is_end[end as usize] = true);
        let parts = net.map_faces(Vec::new, |changed: &mut Vec<_>, name, rings| {
            let is_split = |side: [u32; 2]| {
                side.into_iter().all(|end| is_end[end as usize])
                    && self.0.contains_key(&Side::new(name.object, side))
            };
            if rings.sides().any(is_split) {
                changed.push((name, self.led_through(net, name, rings)));
            }
        });
        let changed: Vec<(FaceName, Rings)> = parts.into_iter().flatten().collect();
        let is_left = |(_, rings): &&(FaceName, Rings)| !rings.ends.is_empty();
        let left: Vec<FaceName> = changed.iter().filter(is_left).map(|(name, _)| *name).collect();
        let collapsed = changed.len() - left.len();
        net.changed.extend(changed);
        Applied { left, collapsed }
    }

    fn led_through(&self, net: &Net<'_>, name: FaceName, rings: &Rings) -> Rings {
        let mut changed = Rings::default();
        for (number, ring) in rings.iter().enumerate() {
            let next = ring.iter().cycle().skip(1);
            let sides = ring.iter().zip(next).map(|(&a, &b)| [a, b]);
            let led = sides.flat_map(|side| {
                std::iter::once(side[0]).chain(self.inside(net, name.object, side))
            });
            let led = without_ways_back(led);
            match led.len() {
                0..3 if number == 0 => return Rings::default(),
                0..3 => {}
                _ => changed.push(led),
            }
        }
        changed
    }
}

/// A ring without the corners at which it turns back on the side that it
/// came, and without repeated ones.
pub(super) fn without_ways_back(ring: impl IntoIterator<Item = u32>) -> Vec<u32> {
    let mut kept: Vec<u32> = Vec::new();
    for corner in ring {
        match *kept {
            [.., last] if last == corner => {}
            [.., before, _] if before == corner => {
                kept.pop();
            }
            _ => kept.push(corner),
        }
    }
    // The same across the place where the ring begins.
    loop {
        match *kept {
            [first, .., last] if first == last => {
                kept.pop();
            }
            [first, .., before, _] if first == before => {
                kept.truncate(kept.len() - 2);
            }
            [_, second, .., last] if kept.len() > 2 && second == last => {
                kept.pop();
                kept.remove(0);
            }
            _ => return kept,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ways_back_are_cut_off_wherever_a_ring_begins() {
        for (ring, left) in [
            (&[1, 2, 3][..], &[1, 2, 3][..]),
            (&[1, 2, 2, 3, 1], &[1, 2, 3]),
            (&[1, 2, 9, 2, 3], &[1, 2, 3]),
            (&[9, 1, 2, 3, 1], &[1, 2, 3]),
            (&[1, 2, 3, 1, 9], &[1, 2, 3]),
            (&[1, 2, 9, 8, 9, 2, 3], &[1, 2, 3]),
        ] {
            assert_eq!(without_ways_back(ring.iter().copied()), left, "{ring:?}");
        }
        // A triangle whose long side goes through its third corner, and a
        // strip of two such.
        for ring in [&[1, 3, 2, 3][..], &[3, 1, 3, 2], &[1, 2, 3, 4, 3, 2], &[1, 1]] {
            assert!(without_ways_back(ring.iter().copied()).len() < 3, "{ring:?}");
        }
    }
}
