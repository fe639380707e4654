//! Whether polygons in doubles are valid, exactly and without any code of
//! the engine: every pair of edges is looked at.

use glam::DVec2;
use robust::{Coord, orient2d};
use umriss::polygon::clipping::Rounded;

fn side(a: DVec2, b: DVec2, c: DVec2) -> i32 {
    // `robust` has a range, beyond which rational numbers are slow but right.
    let in_range = |x: f64| x == 0.0 || (1e-60..1e60).contains(&x.abs());
    if ![a, b, c].iter().all(|p| in_range(p.x) && in_range(p.y)) {
        let [a, b, c] = [a, b, c].map(super::naive::exact);
        let minus = |p: &super::naive::Exact, i: usize| p[i].clone() - a[i].clone();
        let area = minus(&b, 0) * minus(&c, 1) - minus(&b, 1) * minus(&c, 0);
        return area.sign().to_i32();
    }
    let coord = |p: DVec2| Coord { x: p.x, y: p.y };
    let value = orient2d(coord(a), coord(b), coord(c));
    i32::from(value > 0.0) - i32::from(value < 0.0)
}

/// Whether a point lies on an edge but is none of its ends.
fn inside_edge(p: DVec2, [a, b]: [DVec2; 2]) -> bool {
    p != a && p != b && side(a, b, p) == 0 && p == p.clamp(a.min(b), a.max(b))
}

fn edges(ring: &[DVec2]) -> impl Iterator<Item = [DVec2; 2]> + '_ {
    (0..ring.len()).map(|i| [ring[i], ring[(i + 1) % ring.len()]])
}

/// Twice the area of a ring, rounded; good enough for its sign where the
/// ring is simple and no sliver.
fn turn(ring: &[DVec2]) -> i32 {
    let lowest = (0..ring.len())
        .min_by(|&i, &j| ring[i].x.total_cmp(&ring[j].x).then(ring[i].y.total_cmp(&ring[j].y)));
    let i = lowest.unwrap();
    let last = ring.len() - 1;
    side(ring[(i + last) % ring.len()], ring[i], ring[(i + 1) % ring.len()])
}

/// What is wrong with a set of polygons, if anything.
pub(crate) fn fault(rounded: &Rounded) -> Option<String> {
    let rings: Vec<(usize, bool, &Vec<DVec2>)> = rounded
        .polygons
        .iter()
        .enumerate()
        .flat_map(|(p, rings)| rings.iter().enumerate().map(move |(r, ring)| (p, r == 0, ring)))
        .collect();
    let mut all = Vec::new();
    for (number, (polygon, is_outline, ring)) in rings.iter().enumerate() {
        if ring.len() < 3 {
            return Some(format!("a ring of polygon {polygon} has {} corners", ring.len()));
        }
        if turn(ring) != if *is_outline { 1 } else { -1 } {
            return Some(format!("a ring of polygon {polygon} turns the wrong way"));
        }
        let mut sorted = ring.to_vec();
        sorted.sort_by(|a, b| a.x.total_cmp(&b.x).then(a.y.total_cmp(&b.y)));
        if sorted.windows(2).any(|pair| pair[0] == pair[1]) {
            return Some(format!("a ring of polygon {polygon} comes to a corner twice"));
        }
        all.extend(edges(ring).map(|edge| (number, edge)));
    }
    for (i, &(ring, [a, b])) in all.iter().enumerate() {
        for &(other, [c, d]) in &all[i + 1..] {
            let apart = a.max(b).cmplt(c.min(d)).any() || c.max(d).cmplt(a.min(b)).any();
            if apart {
                continue;
            }
            let crosses = side(a, b, c) * side(a, b, d) < 0 && side(c, d, a) * side(c, d, b) < 0;
            if crosses {
                return Some(format!("edges {a}-{b} and {c}-{d} cross"));
            }
            let along = side(a, b, c) == 0 && side(a, b, d) == 0;
            let overlap = [a, b] == [c, d]
                || [a, b] == [d, c]
                || (along && [a, b].iter().any(|&p| inside_edge(p, [c, d])))
                || (along && [c, d].iter().any(|&p| inside_edge(p, [a, b])));
            if overlap {
                return Some(format!("edges {a}-{b} and {c}-{d} overlap"));
            }
            let touches = [a, b].iter().any(|&p| inside_edge(p, [c, d]))
                || [c, d].iter().any(|&p| inside_edge(p, [a, b]));
            if touches && ring == other {
                return Some(format!("a ring touches itself at {a}-{b} and {c}-{d}"));
            }
        }
    }
    nesting_fault(&rings)
}

/// Whether around the middle of each edge there is inside on one side only
/// and no inside twice: winding numbers next to an edge, by a ray upward
/// from its left end, moved by nothing.
fn nesting_fault(rings: &[(usize, bool, &Vec<DVec2>)]) -> Option<String> {
    for (number, (polygon, is_outline, ring)) in rings.iter().enumerate() {
        // A corner of this ring that is on no other ring.
        let free = ring.iter().find(|&&corner| {
            rings.iter().enumerate().all(|(other, (_, _, edges_of))| {
                other == number
                    || edges(edges_of).all(|edge| corner != edge[0] && !inside_edge(corner, edge))
            })
        });
        let Some(&corner) = free else {
            continue;
        };
        let around = |only: Option<usize>| -> i32 {
            let counted = rings.iter().enumerate().filter(|(other, (polygon, _, _))| {
                *other != number && only.is_none_or(|wanted| *polygon == wanted)
            });
            counted.map(|(_, (_, _, ring))| winding(ring, corner)).sum()
        };
        if around(None) != i32::from(!is_outline) {
            return Some(format!("a ring of polygon {polygon} lies where it should not"));
        }
        if !is_outline && around(Some(*polygon)) != 1 {
            return Some(format!("a hole of polygon {polygon} lies outside of it"));
        }
    }
    None
}

fn winding(ring: &[DVec2], p: DVec2) -> i32 {
    let step = |[a, b]: [DVec2; 2]| match (a.y <= p.y, b.y <= p.y) {
        (true, false) if side(a, b, p) > 0 => 1,
        (false, true) if side(a, b, p) < 0 => -1,
        _ => 0,
    };
    edges(ring).map(step).sum()
}

#[test]
fn a_bow_tie_and_a_ring_inside_out_are_found() {
    let rounded = |rings: &[&[(f64, f64)]]| Rounded {
        polygons: vec![
            rings
                .iter()
                .map(|ring| ring.iter().map(|&(x, y)| DVec2::new(x, y)).collect())
                .collect(),
        ],
        rounds: 0,
    };
    let square: &[(f64, f64)] = &[(0.0, 0.0), (4.0, 0.0), (4.0, 4.0), (0.0, 4.0)];
    assert_eq!(fault(&rounded(&[square])), None);
    let hole: &[(f64, f64)] = &[(1.0, 1.0), (1.0, 2.0), (2.0, 2.0), (2.0, 1.0)];
    assert_eq!(fault(&rounded(&[square, hole])), None);
    let beside: &[(f64, f64)] = &[(5.0, 1.0), (5.0, 2.0), (6.0, 2.0), (6.0, 1.0)];
    assert!(fault(&rounded(&[square, beside])).is_some());
    let bow: &[(f64, f64)] = &[(0.0, 0.0), (4.0, 4.0), (4.0, 0.0), (0.0, 4.0)];
    assert!(fault(&rounded(&[bow])).is_some());
    let inside_out: &[(f64, f64)] = &[(0.0, 0.0), (0.0, 4.0), (4.0, 4.0), (4.0, 0.0)];
    assert!(fault(&rounded(&[inside_out])).is_some());
    let through: &[(f64, f64)] = &[(1.0, 1.0), (1.0, 5.0), (2.0, 5.0), (2.0, 1.0)];
    assert!(fault(&rounded(&[square, through])).is_some());
}
