//! Segments that meet become polylines.
//!
//! Every point where ends of segments coincide, bit for bit, is a joint. At
//! each joint the ends are paired, as many as can be (`joints` says which
//! with which), and a polyline follows the pairs from segment to segment. An
//! end stays single only where the number of ends at its joint is odd, so the
//! number of open polylines is half the number of odd joints, and no set of
//! strokes that covers the drawing once has fewer open ones (Euler, 1736).
//!
//! Pairing first and walking afterwards makes the set of polylines a matter
//! of geometry: the order of the segments decides only the order of the
//! strokes, their sense, and where a closed one begins. Hashing finds the
//! joints; everything but the sorting at crowded joints is linear.

use super::joints::Joints;
use super::{Strokes, is_closed};
use glam::DVec2;
use rustc_hash::FxHashMap;

/// No partner: the polyline ends here.
pub(super) const SINGLE: u32 = u32::MAX;

/// Joins `segments`, none of which may be a point, into polylines. Each
/// segment is part of exactly one stroke. Segments with the same number in
/// `runs`, which may be empty, lie on one straight line.
///
/// A joint of two segments on one straight line is no point of the polyline:
/// they are of one run, or the three points are collinear as they stand.
pub(super) fn chain(segments: &[[DVec2; 2]], runs: &[u32]) -> Strokes {
    let (partners, busy) = pair_ends(segments);
    let mut drawn = vec![false; segments.len()];
    let mut strokes = Strokes::default();
    let mut points = Vec::new();
    for segment in 0..segments.len() {
        if drawn[segment] {
            continue;
        }
        let mut end = first_end(&partners, segment);
        points.clear();
        points.push(point(segments, end));
        let first = end;
        loop {
            drawn[(end / 2) as usize] = true;
            points.push(point(segments, end ^ 1));
            let next = partners[(end ^ 1) as usize];
            if next != SINGLE && next != first && !busy[next as usize] {
                let far = point(segments, next ^ 1);
                if goes_straight_on(segments, runs, [end, next], &points, far) {
                    points.pop();
                }
            }
            match partners[(end ^ 1) as usize] {
                SINGLE => break,
                next if drawn[(next / 2) as usize] => break,
                next => end = next,
            }
        }
        if is_closed(&points) && !busy[first as usize] {
            // The same where a closed polyline happens to begin.
            let second = points[1];
            if 4 < points.len() && goes_straight_on(segments, runs, [end, first], &points, second) {
                points.remove(0);
                points.pop();
                points.push(second);
            }
        }
        strokes.push(points.iter().copied());
    }
    strokes
}

/// Whether the last of `points`, between the segments of two ends, is no
/// corner.
fn goes_straight_on(
    segments: &[[DVec2; 2]],
    runs: &[u32],
    [end, next]: [u32; 2],
    points: &[DVec2],
    far: DVec2,
) -> bool {
    let [.., before, joint] = points else { return false };
    let onward = 0.0 < (*joint - *before).dot(far - *joint);
    let run = |end: u32| runs.get((end / 2) as usize);
    debug_assert!(point(segments, next) == *joint);
    let same_run = run(end).is_some() && run(end) == run(next);
    let coord = |p: DVec2| robust::Coord { x: p.x, y: p.y };
    onward && (same_run || robust::orient2d(coord(*before), coord(*joint), coord(far)) == 0.0)
}

/// The end at which the polyline through `segment` begins, found by walking
/// backwards; that of the segment itself if the polyline is closed.
fn first_end(partners: &[u32], segment: usize) -> u32 {
    let own = 2 * segment as u32;
    let mut end = own;
    loop {
        match partners[end as usize] {
            SINGLE => return end,
            before if before ^ 1 == own => return own,
            before => end = before ^ 1,
        }
    }
}

/// For each end (2 i and 2 i + 1 are those of segment i) the end with which
/// its polyline goes on.
/// Beside it, whether three ends or more meet where that end is.
fn pair_ends(segments: &[[DVec2; 2]]) -> (Vec<u32>, Vec<bool>) {
    let (joint_of, starts) = find_joints(segments);
    // Counting sort of all ends by joint: `fill` runs ahead of `starts`.
    let mut fill = starts.clone();
    let mut ends = vec![0; joint_of.len()];
    for (end, joint) in joint_of.iter().enumerate() {
        let slot = &mut fill[*joint as usize];
        ends[*slot as usize] = end as u32;
        *slot += 1;
    }
    let mut partners = vec![SINGLE; joint_of.len()];
    let mut busy = vec![false; joint_of.len()];
    let mut joints = Joints::default();
    for bounds in starts.windows(2) {
        match &ends[bounds[0] as usize..bounds[1] as usize] {
            [_] => {}
            [one, other] => {
                partners[*one as usize] = *other;
                partners[*other as usize] = *one;
            }
            crowd => {
                crowd.iter().for_each(|end| busy[*end as usize] = true);
                joints.pair(segments, crowd, &mut partners);
            }
        }
    }
    (partners, busy)
}

/// The joint of every end, and where each joint's ends start if the ends are
/// sorted by joint. Joints are numbered as they first appear.
fn find_joints(segments: &[[DVec2; 2]]) -> (Vec<u32>, Vec<u32>) {
    let mut known: FxHashMap<[u64; 2], u32> = FxHashMap::default();
    known.reserve(segments.len());
    let mut joint_of = Vec::with_capacity(2 * segments.len());
    let mut degrees: Vec<u32> = Vec::new();
    for end in segments.iter().flatten() {
        // Page coordinates are never -0, so equal points have equal bits.
        let key = [end.x.to_bits(), end.y.to_bits()];
        let joint = *known.entry(key).or_insert(degrees.len() as u32);
        if joint as usize == degrees.len() {
            degrees.push(0);
        }
        degrees[joint as usize] += 1;
        joint_of.push(joint);
    }
    let mut starts = Vec::with_capacity(degrees.len() + 1);
    let mut start = 0;
    for degree in &degrees {
        starts.push(start);
        start += degree;
    }
    starts.push(start);
    (joint_of, starts)
}

/// Where an end lies.
pub(super) fn point(segments: &[[DVec2; 2]], end: u32) -> DVec2 {
    segments[(end / 2) as usize][(end % 2) as usize]
}

#[cfg(test)]
mod tests;
