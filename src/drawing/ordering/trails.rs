//! As few strokes as cover the layer once.
//!
//! `chaining` leaves half as many open strokes as there are joints with an
//! odd number of ends, which is the least there can be (Euler 1736), and
//! closed strokes beside them, because it prefers to go straight on. A closed
//! stroke that touches another is drawn by that one in passing (Hierholzer
//! 1873): the pen comes to the common point, goes around the closed stroke,
//! and continues. What is left is one trail for each two odd joints of a
//! connected part, or a single closed one where there are none.

use super::super::smoothing::Node;
use super::{Strokes, is_closed};
use glam::DVec2;
use rustc_hash::FxHashMap;

/// No closed stroke.
const NONE: u32 = u32::MAX;

/// A closed stroke that begins at a point of its host.
#[derive(Clone, Copy)]
struct Guest {
    stroke: u32,
    /// The point of the host after which it is drawn.
    host_point: u32,
    /// The point of its own where it begins.
    own_point: u32,
    /// The next guest of the same host.
    next: u32,
}

/// The closed strokes that pass through a point, each with the number of the
/// point in it.
type Touching = FxHashMap<[u64; 2], Vec<(u32, u32)>>;

/// The same lines in the fewest strokes. O(p) for p points, expected.
pub(super) fn fewest(strokes: &Strokes) -> Strokes {
    let (rings, touching) = touching_rings(strokes);
    if touching.is_empty() {
        return strokes.clone();
    }
    let mut guests: Vec<Guest> = Vec::new();
    let mut first_guest = vec![NONE; strokes.len()];
    let mut taken = vec![false; strokes.len()];
    let mut hosts = Vec::new();
    let open = (0..strokes.len()).filter(|stroke| !rings[*stroke]);
    let closed = (0..strokes.len()).filter(|stroke| rings[*stroke]);
    for root in open.chain(closed) {
        if std::mem::replace(&mut taken[root], true) {
            continue;
        }
        hosts.push(root);
        let mut waiting = vec![root as u32];
        while let Some(host) = waiting.pop() {
            for (host_point, point) in strokes.get(host as usize).iter().enumerate() {
                let here = touching.get(&key(*point)).map_or(&[][..], Vec::as_slice);
                for (ring, own_point) in here {
                    if !std::mem::replace(&mut taken[*ring as usize], true) {
                        guests.push(Guest {
                            stroke: *ring,
                            host_point: host_point as u32,
                            own_point: *own_point,
                            next: first_guest[host as usize],
                        });
                        first_guest[host as usize] = guests.len() as u32 - 1;
                        waiting.push(*ring);
                    }
                }
            }
        }
    }
    let mut trails = Strokes::default();
    let mut points = Vec::new();
    for host in hosts {
        points.clear();
        walk(strokes, &guests, &first_guest, host as u32, &mut points);
        trails.push_curved(points.iter().copied());
    }
    trails
}

/// Which strokes are closed; and for each point at which a closed stroke
/// touches another stroke, the closed ones with the number of the point.
fn touching_rings(strokes: &Strokes) -> (Vec<bool>, Touching) {
    let rings: Vec<bool> = strokes.iter().map(is_closed).collect();
    let mut touching = Touching::default();
    for (stroke, points) in strokes.iter().enumerate().filter(|(stroke, _)| rings[*stroke]) {
        for (number, point) in points[1..].iter().enumerate() {
            touching.entry(key(*point)).or_default().push((stroke as u32, number as u32 + 1));
        }
    }
    // A point that no other stroke has is of no use.
    let mut shared = Touching::default();
    shared.reserve(touching.len() / 4);
    for (stroke, points) in strokes.iter().enumerate() {
        for point in points {
            let key = key(*point);
            if let Some(here) = touching.get(&key)
                && here.iter().any(|(ring, _)| *ring as usize != stroke)
            {
                shared.entry(key).or_insert_with(|| here.clone());
            }
        }
    }
    (rings, shared)
}

fn key(point: DVec2) -> [u64; 2] {
    // Page coordinates are never -0, so equal points have equal bits.
    [point.x.to_bits(), point.y.to_bits()]
}

/// A stroke that is being drawn: its points from `start` around, and which of
/// its guests come next.
struct Walk {
    stroke: u32,
    start: u32,
    step: u32,
    /// By the steps at which they come, last first.
    guests: Vec<(u32, u32)>,
}

/// Appends the points of a stroke with all its guests, and theirs.
fn walk(
    strokes: &Strokes,
    guests: &[Guest],
    first_guest: &[u32],
    root: u32,
    points: &mut Vec<Node>,
) {
    let begin = |stroke: u32, start: u32| {
        let ring = strokes.get(stroke as usize).len() as u32 - 1;
        let mut own = Vec::new();
        let mut guest = first_guest[stroke as usize];
        while guest != NONE {
            let Guest { host_point, next, .. } = guests[guest as usize];
            own.push((
                if host_point < start { host_point + ring } else { host_point } - start,
                guest,
            ));
            guest = next;
        }
        own.sort_unstable_by(|a, b| b.cmp(a));
        Walk { stroke, start, step: 0, guests: own }
    };
    points.push((strokes.get(root as usize)[0], None));
    let mut stack = vec![begin(root, 0)];
    while let Some(walk) = stack.last_mut() {
        let own = strokes.get(walk.stroke as usize);
        let ring = own.len() as u32 - 1;
        if let Some((at, guest)) = walk.guests.last().copied()
            && at == walk.step
        {
            walk.guests.pop();
            let guest = guests[guest as usize];
            stack.push(begin(guest.stroke, guest.own_point));
            continue;
        }
        if walk.step == ring {
            stack.pop();
            continue;
        }
        walk.step += 1;
        let place = walk.start + walk.step;
        let node = if ring < place { place - ring } else { place } as usize;
        points.push((own[node], strokes.bend(walk.stroke as usize, node)));
    }
}
