//! A look at all faces once their vertices are merged.

use super::borders::SideSums;
use super::net::{FaceName, Net, Rings};
use super::{Tolerance, slivers};

/// What is found.
pub(super) struct Survey {
    /// The sums of all sides as they are.
    pub(super) sums: SideSums,
    /// The same for the places of the file, if any of them were merged.
    pub(super) before: Option<SideSums>,
    /// Faces that may be no wider than the tolerance.
    pub(super) thin: Vec<FaceName>,
    /// Faces of three different places in the file that now have fewer.
    pub(super) collapsed: usize,
}

#[derive(Default)]
struct Part {
    thin: Vec<FaceName>,
    collapsed: usize,
    old: Rings,
}

impl Survey {
    pub(super) fn of(net: &Net<'_>, tolerance: Tolerance) -> Self {
        let sums = SideSums::zero(net.now.len());
        let before = net.is_merged().then(|| SideSums::zero(net.now.len()));
        let parts = net.map_faces(Part::default, |part, name, rings| {
            sums.add(name.object, rings);
            if let Some(before) = &before {
                net.old_rings(name, &mut part.old);
                before.add(name.object, &part.old);
            }
            let outer = rings.iter().next().unwrap_or(&[]);
            if has_fewer_than_three(outer) {
                net.old_rings(name, &mut part.old);
                let old = part.old.iter().next().unwrap_or(&[]);
                part.collapsed += usize::from(!has_fewer_than_three(old));
                return;
            }
            let may_be_thin = match *rings.corners {
                [a, b, c] => tolerance.is_width_of([a, b, c].map(|place| net.at(place))),
                _ => rings.corners.len() <= slivers::MOST_CORNERS,
            };
            if may_be_thin {
                part.thin.push(name);
            }
        });
        let (mut thin, mut collapsed) = (Vec::new(), 0);
        for part in parts {
            thin.extend(part.thin);
            collapsed += part.collapsed;
        }
        Survey { sums, before, thin, collapsed }
    }
}

/// The sums of all sides as they are.
pub(super) fn sums(net: &Net<'_>) -> SideSums {
    let sums = SideSums::zero(net.now.len());
    net.map_faces(|| (), |(), name, rings| sums.add(name.object, rings));
    sums
}

/// The same for the places of the file.
pub(super) fn old_sums(net: &Net<'_>) -> SideSums {
    let sums = SideSums::zero(net.now.len());
    net.map_faces(Rings::default, |old, name, _| {
        net.old_rings(name, old);
        sums.add(name.object, old);
    });
    sums
}

fn has_fewer_than_three(ring: &[u32]) -> bool {
    if let [a, b, c] = *ring {
        return a == b || b == c || c == a;
    }
    let Some(&first) = ring.first() else { return true };
    let Some(&second) = ring.iter().find(|&&corner| corner != first) else { return true };
    ring.iter().all(|&corner| corner == first || corner == second)
}
