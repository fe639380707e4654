//! How many edges have come to be shared.

use super::net::{FaceName, Net, Rings};
use super::splits::Side;
use crate::run::sort_by;

/// A side of a face as it is now, and as it was in the file: two sides that
/// were one edge there have the same. New parts of a side have none of any
/// other face's.
type Joined = (Side, [u32; 2]);

/// Edges of more faces than one that were not one edge in the file.
pub(super) fn closed_seams(net: &Net<'_>) -> usize {
    let touched = touched(net);
    if touched.is_empty() {
        return 0;
    }
    let parts = net.map_faces(Vec::new, |found: &mut Vec<Joined>, name, rings| {
        let is_touched = |side: &[u32; 2]| side.iter().all(|&end| touched[end as usize]);
        if !rings.sides().any(|side| is_touched(&side)) {
            return;
        }
        let before = before(net, name);
        for [a, b] in rings.sides().filter(is_touched).filter(|[a, b]| a != b) {
            let side = Side::new(name.object, [a, b]);
            let old = before.iter().find(|(old, _)| *old == side.ends).map(|(_, first)| *first);
            // No two places of a file are one, and no face is so numbered.
            found.push((side, old.unwrap_or([u32::MAX - name.object, name.face])));
        }
    });
    let mut sides = parts.concat();
    sort_by(&mut sides, Ord::cmp);
    let together = sides.chunk_by(|a, b| a.0 == b.0);
    together.filter(|same| same.iter().any(|(_, old)| *old != same[0].1)).count()
}

/// Places to which others came, and those of faces that are changed; empty if
/// there are none.
fn touched(net: &Net<'_>) -> Vec<bool> {
    let is_merged = |vertex: &usize| net.now[*vertex] != net.first[*vertex];
    let mut merged = (0..net.now.len()).filter(is_merged).peekable();
    if merged.peek().is_none() && net.changed.is_empty() {
        return Vec::new();
    }
    let mut touched = vec![false; net.now.len()];
    merged.for_each(|vertex| touched[net.now[vertex] as usize] = true);
    let corners = net.changed.values().flat_map(|rings: &Rings| &rings.corners);
    corners.for_each(|&corner| touched[corner as usize] = true);
    touched
}

/// The sides of a face in its file: by places of now, and of then.
fn before(net: &Net<'_>, name: FaceName) -> Vec<([u32; 2], [u32; 2])> {
    let start = net.starts[name.object as usize];
    let mut sides = Vec::with_capacity(3);
    for ring in net.soups[name.object as usize].faces.rings(name.face as usize) {
        for (i, &a) in ring.iter().enumerate() {
            let ends = [a, ring[(i + 1) % ring.len()]].map(|corner| (start + corner) as usize);
            let sorted = |[a, b]: [u32; 2]| [a.min(b), a.max(b)];
            let [now, first] = [&net.now, &net.first].map(|names| ends.map(|end| names[end]));
            sides.push((sorted(now), sorted(first)));
        }
    }
    sides
}
