//! Which line passes in front of which.
//!
//! Wires on a grid of integers, seen along a diagonal of space or from
//! above, are compared with integer arithmetic by hand: no crossing is lost,
//! none is invented, and each has the right line in front. The grid is
//! coarse, so ends lie on other lines and lines meet in space all the time.

use super::scenes::{Random, orthographic, perspective, polygons, rounds};
use glam::{DVec3, dvec3};
use std::collections::BTreeSet;
use umriss::kernel::predicates::Exact;
use umriss::model::{FeatureOptions, Mesh, View};
use umriss::run::Run;
use umriss::view::{LineSource, PreparedView};
use umriss::visibility::{AppelOptions, appel, reduce_with_crossings};

/// Pairs (near, far) of lines by their number.
fn found(lines: &[[DVec3; 2]], view: &View) -> BTreeSet<[usize; 2]> {
    let none: [Vec<DVec3>; 0] = [];
    let mesh = Mesh::new(vec![polygons(&none, lines)], None).expect("a mesh");
    let run = Run::default();
    let prepared = PreparedView::new::<Exact>(&mesh, view, &FeatureOptions::default(), &run);
    let prepared = prepared.expect("not cancelled");
    let question = prepared.question(false);
    let answer = appel::<Exact>(&question, &AppelOptions::default(), &run).expect("not cancelled");
    let (drawn, crossings) =
        reduce_with_crossings::<Exact>(&question, &answer, &run).expect("not cancelled");
    assert!(crossings.is_sorted());
    let line = |piece: u32| match drawn.pieces[piece as usize].source {
        // Equal vertices are one, with the number of the first of them.
        LineSource::Edge(ends) => {
            let ends = ends.map(|end| lines[(end / 2) as usize][(end % 2) as usize]);
            lines.iter().position(|line| *line == ends).expect("a line")
        }
        LineSource::Faces(_) => panic!("a line of faces among wires"),
    };
    crossings.iter().map(|crossing| [line(crossing.near), line(crossing.far)]).collect()
}

/// The same from above, in integers; nothing if two images overlap.
fn expected(lines: &[[DVec3; 2]]) -> Option<BTreeSet<[usize; 2]>> {
    let grid = |p: DVec3| p.to_array().map(|x| x as i64);
    let cross = |a: [i64; 3], b: [i64; 3]| a[0] * b[1] - a[1] * b[0];
    let minus = |a: [i64; 3], b: [i64; 3]| std::array::from_fn(|i| a[i] - b[i]);
    let mut pairs = BTreeSet::new();
    for (i, first) in lines.iter().enumerate() {
        for (j, second) in lines.iter().enumerate().skip(i + 1) {
            let ([a, b], [c, d]) = (first.map(grid), second.map(grid));
            let (along, other, offset) = (minus(b, a), minus(d, c), minus(c, a));
            let turn = cross(along, other);
            if turn == 0 {
                if cross(along, offset) == 0 {
                    return None;
                }
                continue;
            }
            let (sign, turn) = (turn.signum(), turn.abs());
            let t = sign * cross(offset, other);
            let s = sign * cross(offset, along);
            if 0 <= t && t <= turn && 0 <= s && s <= turn {
                let higher = (a[2] - c[2]) * turn + along[2] * t - other[2] * s;
                match higher.signum() {
                    1 => drop(pairs.insert([i, j])),
                    -1 => drop(pairs.insert([j, i])),
                    _ => {}
                }
            }
        }
    }
    Some(pairs)
}

fn wires(random: &mut Random, side: u64) -> Vec<[DVec3; 2]> {
    let mut lines = Vec::new();
    while lines.len() < 12 {
        let ends = [random.grid_point(side), random.grid_point(side)];
        // A line that is a point in the image is none.
        if ends[0].truncate() != ends[1].truncate() {
            lines.push(ends);
        }
    }
    lines
}

#[test]
fn wires_pass_one_another_as_integers_say() {
    let mut compared = 0;
    for seed in 0..rounds(300) {
        let mut random = Random(seed);
        let side = 6 + 7 * (seed % 5);
        let lines = wires(&mut random, side);
        let Some(pairs) = expected(&lines) else { continue };
        assert_eq!(found(&lines, &orthographic(DVec3::NEG_Z)), pairs, "seed {seed}");
        // A shear along the view and a scale are no change.
        let moved: Vec<_> = lines
            .iter()
            .map(|ends| ends.map(|p| dvec3(4.0 * p.x, 4.0 * p.y, p.z + 3.0 * p.x - p.y) * 0.125))
            .collect();
        assert_eq!(found(&moved, &orthographic(DVec3::NEG_Z)), pairs, "seed {seed}");
        compared += pairs.len();
    }
    assert!(500 < compared, "{compared}");
}

/// From a point, the nearer line is the one the eye meets first.
#[test]
fn wires_pass_one_another_in_perspective() {
    let mut compared = 0;
    for seed in 0..rounds(100) {
        let mut random = Random(1000 + seed);
        let lines: Vec<_> = (0..12).map(|_| [random.point(), random.point()]).collect();
        let view = perspective(dvec3(0.1, -0.2, 4.0), DVec3::NEG_Z, 0.01);
        let eye = dvec3(0.1, -0.2, 4.0);
        let mut pairs = BTreeSet::new();
        for (i, [a, b]) in lines.iter().enumerate() {
            for (j, [c, d]) in lines.iter().enumerate().skip(i + 1) {
                // Where ab meets the plane of cd and the eye, and conversely.
                let hit = |p: DVec3, q: DVec3, r: DVec3, s: DVec3| {
                    let normal = (r - eye).cross(s - eye);
                    let (f, g) = (normal.dot(p - eye), normal.dot(q - eye));
                    (f * g < 0.0).then(|| p + (q - p) * (f / (f - g)))
                };
                if let (Some(one), Some(other)) = (hit(*a, *b, *c, *d), hit(*c, *d, *a, *b)) {
                    let nearer = one.distance(eye) < other.distance(eye);
                    pairs.insert(if nearer { [i, j] } else { [j, i] });
                }
            }
        }
        assert_eq!(found(&lines, &view), pairs, "seed {seed}");
        compared += pairs.len();
    }
    assert!(500 < compared, "{compared}");
}
