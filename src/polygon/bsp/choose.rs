//! Which plane parts a set of polygons.

use super::Fragment;
use crate::kernel::numbers::Sign;
use crate::kernel::predicates::{InputPlane, PlanePoint, Policy, Predicates};

/// Planes that are tried.
const CANDIDATES: usize = 8;

/// Polygons on which a plane is tried.
const TRIALS: usize = 96;

/// Sets up to this size are parted by planes of their own only.
const SMALL: usize = 256;

/// The planes that promise most.
pub(super) struct Choice {
    /// That of a polygon of the set.
    pub(super) face: InputPlane,
    /// One across an axis, where the other is not good enough.
    pub(super) across: Option<InputPlane>,
}

/// What a plane does to the polygons it was tried on.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
struct Trial {
    cuts: usize,
    imbalance: usize,
}

/// Chooses planes for a set, which is not empty. O(1) but for the median.
pub(super) fn choose<P: Policy>(predicates: &Predicates<'_, P>, set: &[Fragment]) -> Choice {
    let trials: Vec<&Fragment> = evenly(set, TRIALS).collect();
    let candidates = evenly(set, CANDIDATES).map(|fragment| fragment.polygon.plane());
    let tried = candidates.map(|plane| (attempt(predicates, plane, &trials), plane));
    let best = tried.min_by_key(|(trial, _)| *trial);
    let (trial, face) = match best {
        Some(best) => best,
        None => return Choice { face: InputPlane::Near, across: None },
    };
    let is_uneven = trial.imbalance > trials.len() - trials.len() / 4;
    let across = (set.len() > SMALL && is_uneven).then(|| across(predicates, set, &trials));
    Choice { face, across: across.flatten() }
}

/// At most `most` items, the first among them, at equal distances.
fn evenly<T>(list: &[T], most: usize) -> impl Iterator<Item = &T> {
    let count = list.len().min(most);
    (0..count).map(move |i| &list[i * list.len() / count])
}

fn attempt<P: Policy>(
    predicates: &Predicates<'_, P>,
    plane: InputPlane,
    trials: &[&Fragment],
) -> Trial {
    let (mut cuts, mut below, mut above) = (0, 0_usize, 0_usize);
    for fragment in trials {
        match fragment.polygon.sides_of(predicates, plane.into()) {
            [true, true] => cuts += 1,
            [true, false] => below += 1,
            [false, true] => above += 1,
            [false, false] => {}
        }
    }
    Trial { cuts, imbalance: below.abs_diff(above) }
}

/// The best plane across an axis, through the median of the vertices by which
/// the tried polygons know their planes.
fn across<P: Policy>(
    predicates: &Predicates<'_, P>,
    set: &[Fragment],
    trials: &[&Fragment],
) -> Option<InputPlane> {
    let planes = [0, 1, 2].map(|axis| {
        let mut vertices: Vec<u32> = set.iter().map(|fragment| fragment.polygon.face[0]).collect();
        let middle = vertices.len() / 2;
        let compare = |a: &u32, b: &u32| {
            let higher = InputPlane::Across(*b, axis).into();
            let sign: Sign = predicates.above(higher, PlanePoint::Vertex(*a));
            std::cmp::Ordering::from(sign).then(a.cmp(b))
        };
        let (_, median, _) = vertices.select_nth_unstable_by(middle, compare);
        InputPlane::Across(*median, axis)
    });
    let tried = planes.map(|plane| {
        let Trial { cuts, imbalance } = attempt(predicates, plane, trials);
        (cuts + imbalance, plane)
    });
    tried.into_iter().min_by_key(|(harm, _)| *harm).map(|(_, plane)| plane)
}
