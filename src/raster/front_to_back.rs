//! An order of triangles in which each comes before all those of which it
//! hides anything, if there is one.
//!
//! Where the images of two triangles overlap, they do so in a convex polygon.
//! Its corners are corners of one triangle in the image of the other, and
//! crossings of their edges; at each of them an exact sign says which one is
//! nearer. If all agree, that is the order of the pair: depths differ by a
//! linear function over the overlap, which has its extremes there. If not,
//! the triangles pass through one another. Images that meet along a border
//! only are compared too, since a sample may lie on it. The pairs make a graph, and its
//! topological order (Kahn 1962) is the answer; a cycle has none (Newell,
//! Newell and Sancha 1972 would split a triangle of it).

use crate::kernel::numbers::Sign;
use crate::kernel::predicates::{Carrier, Policy, Predicates};
use crate::run::{Cancelled, Growing, Run};
use crate::spatial::{Bounds, Hierarchy};
use crate::view::LineQuestion;
use std::cmp::Reverse;
use std::collections::BinaryHeap;

/// Why triangles cannot be put in an order.
#[derive(Debug, Clone, Copy, PartialEq, Eq, thiserror::Error)]
pub enum OrderError {
    /// Each of two triangles is in front of the other somewhere: most often
    /// they pass through one another.
    #[error("triangles {0} and {1} are each in front of the other somewhere")]
    Crossing(u32, u32),
    /// Triangles hide parts of one another in a ring.
    #[error("triangle {0} is one of several that hide parts of one another in a ring")]
    Cycle(u32),
    /// The run was cancelled.
    #[error(transparent)]
    Cancelled(#[from] Cancelled),
}

/// All triangles that have an image, from front to back. Of several orders
/// the one that takes low numbers first. Of triangles that lie in one another
/// the lowest number comes first. O(n log n) after the pairs whose images
/// overlap.
///
/// # Errors
///
/// If there is no such order, or the run is cancelled.
pub fn front_to_back<P: Policy>(
    question: &LineQuestion<'_>,
    run: &Run<'_>,
) -> Result<Vec<u32>, OrderError> {
    let count = question.mesh.triangles().len();
    let [in_front, behind] = pairs::<P>(question, run)?;
    run.check()?;
    let mut waiting_for = vec![0_u32; count];
    behind.iter().for_each(|&triangle| waiting_for[triangle as usize] += 1);
    // Who is freed by whom, sorted by the one in front.
    let mut freed: Vec<[u32; 2]> = in_front.into_iter().zip(behind).map(<[u32; 2]>::from).collect();
    freed.sort_unstable();
    let has_image = |triangle: &u32| !question.facing[*triangle as usize].is_zero();
    let all = || (0..count as u32).filter(has_image);
    let is_free = |triangle: &u32| waiting_for[*triangle as usize] == 0;
    let mut next: BinaryHeap<Reverse<u32>> = all().filter(is_free).map(Reverse).collect();
    let mut order = Vec::with_capacity(count);
    while let Some(Reverse(triangle)) = next.pop() {
        order.push(triangle);
        let start = freed.partition_point(|pair| pair[0] < triangle);
        for [_, other] in freed[start..].iter().take_while(|pair| pair[0] == triangle) {
            let waiting = &mut waiting_for[*other as usize];
            *waiting -= 1;
            if *waiting == 0 {
                next.push(Reverse(*other));
            }
        }
    }
    match all().find(|triangle| waiting_for[*triangle as usize] > 0) {
        None => Ok(order),
        Some(stuck) => Err(OrderError::Cycle(stuck)),
    }
}

/// All pairs of which one hides something of the other: those in front, and
/// those behind.
fn pairs<P: Policy>(
    question: &LineQuestion<'_>,
    run: &Run<'_>,
) -> Result<[Vec<u32>; 2], OrderError> {
    let triangles = question.mesh.triangles();
    // Images only: all depths are one.
    let flat = |i: usize| {
        let bounds = question.coordinates.bounds(triangles[i]);
        let (mut low, mut high) = (bounds.low, bounds.high);
        if !bounds.is_empty() {
            (low.z, high.z) = (0.0, 0.0);
        }
        Bounds { low, high }
    };
    let place = |i: usize| question.coordinates.place(triangles[i][0]);
    // A pair is held in three lists, one after the other.
    let growing = || Growing::new(run, 3 * size_of::<[u32; 2]>());
    let found = Hierarchy::of(triangles.len(), place, flat).overlapping_pairs(
        run,
        || (Predicates::<P>::new(question.points), Vec::new(), None, growing()),
        |(predicates, list, wrong, growing), a, b| {
            // One pair that has no order is enough.
            if wrong.is_some() || !growing.goes_on(list.len()) {
                return;
            }
            let pair = [a.min(b), a.max(b)];
            match nearer(question, predicates, pair) {
                Some(Nearer::First) => list.push(pair),
                Some(Nearer::Second) => list.push([pair[1], pair[0]]),
                Some(Nearer::Both) => *wrong = Some(pair),
                None => {}
            }
        },
    );
    let mut sorted = [Vec::new(), Vec::new()];
    for (predicates, list, wrong, mut growing) in found {
        growing.finish(list.len())?;
        run.merge(&predicates.counters());
        if let Some([a, b]) = wrong {
            return Err(OrderError::Crossing(a, b));
        }
        for (i, all) in sorted.iter_mut().enumerate() {
            all.extend(list.iter().map(|pair| pair[i]));
        }
    }
    Ok(sorted)
}

/// Which of two triangles is nearer where their images overlap.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Nearer {
    First,
    Second,
    /// Each of them somewhere.
    Both,
}

/// Nothing if the images have no point in common, or no area and no point
/// where depths differ.
fn nearer<P: Policy>(
    question: &LineQuestion<'_>,
    predicates: &Predicates<'_, P>,
    pair: [u32; 2],
) -> Option<Nearer> {
    let facing = pair.map(|triangle| question.facing[triangle as usize]);
    let [first, second] = pair.map(|triangle| question.mesh.triangles()[triangle as usize]);
    if facing.contains(&Sign::Zero) {
        return None;
    }
    let gaps =
        [gap(predicates, first, facing[0], second), gap(predicates, second, facing[1], first)];
    if gaps.contains(&Gap::Wide) {
        return None;
    }
    let mut seen = [false; 2];
    for &corner in &second {
        // Behind the first triangle means that the first one is nearer.
        match depth_at(predicates, first, facing[0], corner) {
            Sign::Positive => seen[0] = true,
            Sign::Negative => seen[1] = true,
            Sign::Zero => {}
        }
    }
    for &corner in &first {
        match depth_at(predicates, second, facing[1], corner) {
            Sign::Positive => seen[1] = true,
            Sign::Negative => seen[0] = true,
            Sign::Zero => {}
        }
    }
    for own in edges(first) {
        for other in edges(second) {
            match at_crossing(predicates, own, other) {
                Sign::Positive => seen[0] = true,
                Sign::Negative => seen[1] = true,
                Sign::Zero => {}
            }
        }
    }
    Some(match seen {
        [true, true] => Nearer::Both,
        [false, true] => Nearer::Second,
        [true, false] => Nearer::First,
        // Side by side, with a border in common.
        [false, false] if gaps.contains(&Gap::Border) => return None,
        // In one another: the lower number is in front.
        [false, false] => Nearer::First,
    })
}

fn edges([a, b, c]: [u32; 3]) -> [[u32; 2]; 3] {
    [[a, b], [b, c], [c, a]]
}

/// What an edge of a triangle leaves between its image and another.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Gap {
    /// No edge parts them.
    None,
    /// They meet on the line of an edge.
    Border,
    /// They have no point in common.
    Wide,
}

/// The widest gap that an edge of `triangle` leaves to `other`.
fn gap<P: Policy>(
    predicates: &Predicates<'_, P>,
    triangle: [u32; 3],
    facing: Sign,
    other: [u32; 3],
) -> Gap {
    let side = |[x, y]: [u32; 2], vertex: u32| match vertex == x || vertex == y {
        true => Sign::Zero,
        false => predicates.side(x, y, vertex),
    };
    let mut widest = Gap::None;
    for edge in edges(triangle) {
        let signs = other.map(|vertex| side(edge, vertex));
        if signs.iter().all(|sign| sign.is_opposite(facing)) {
            return Gap::Wide;
        }
        if !signs.contains(&facing) {
            widest = Gap::Border;
        }
    }
    widest
}

/// Positive if `vertex` is seen in the image of `triangle` and lies behind
/// it, negative if it lies in front.
fn depth_at<P: Policy>(
    predicates: &Predicates<'_, P>,
    triangle: [u32; 3],
    facing: Sign,
    vertex: u32,
) -> Sign {
    let is_outside = |[x, y]: [u32; 2]| predicates.side(x, y, vertex).is_opposite(facing);
    if triangle.contains(&vertex) || edges(triangle).into_iter().any(is_outside) {
        return Sign::Zero;
    }
    match predicates.plane(triangle, vertex) {
        Sign::Zero => Sign::Zero,
        sign if sign == facing => Sign::Positive,
        _ => Sign::Negative,
    }
}

/// Where the images of two edges cross properly: positive if the first one
/// is nearer, negative if the other is.
fn at_crossing<P: Policy>(
    predicates: &Predicates<'_, P>,
    [p, q]: [u32; 2],
    [a, b]: [u32; 2],
) -> Sign {
    if [a, b].contains(&p) || [a, b].contains(&q) {
        return Sign::Zero;
    }
    let ends = [predicates.side(p, q, a), predicates.side(p, q, b)];
    let own_ends = [predicates.side(a, b, p), predicates.side(a, b, q)];
    if !ends[0].is_opposite(ends[1]) || !own_ends[0].is_opposite(own_ends[1]) {
        return Sign::Zero;
    }
    match predicates.skew(Carrier::edge(a, b), [p, q]) {
        Sign::Zero => Sign::Zero,
        // As for crossings of Appel's method: pq in front of the carrier ab.
        sign if sign.is_opposite(ends[1]) => Sign::Positive,
        _ => Sign::Negative,
    }
}
