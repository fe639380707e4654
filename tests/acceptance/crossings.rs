//! Proposals lose nothing.
//!
//! Which edges may cross a line is proposed by a hierarchy of rounded boxes.
//! Here every edge that does cross, by the exact predicates, must be among
//! the proposals, in parallel and central views, a million units away, at
//! tiny and huge scales, and for vertices next to the plane of the eye.
//!
//! On flat sets of segments three other ways to propose are tried beside it:
//! all pairs, a plane sweep over u, and a uniform grid. After the exact test
//! all four must name the same crossings. Among the sets are the classical
//! bad ones: all on one line, a star through one point, a comb that has a
//! quarter of n squared crossings.

use super::scenes::{Random, orthographic, perspective, polygons, rounds};
use glam::{DVec3, dvec3};
use std::cmp::Ordering;
use umriss::kernel::numbers::Sign;
use umriss::kernel::predicates::{Carrier, Cut, Exact, Points, Predicates};
use umriss::model::{Mesh, View, ViewCoordinates};
use umriss::spatial::{Bounds, Crossings};

/// Segments as a method sees them.
struct Segments {
    mesh: Mesh,
    points: Points,
    coordinates: ViewCoordinates,
    boxes: Vec<Bounds>,
}

impl Segments {
    fn new(lines: &[[DVec3; 2]], view: &View) -> Self {
        let none: [Vec<DVec3>; 0] = [];
        let mesh = Mesh::new(vec![polygons(&none, lines)], None).expect("a mesh");
        let points = Points::new(mesh.vertices(), view.eye, view.near);
        let coordinates = ViewCoordinates::new(&view.frame, mesh.vertices());
        let boxes = mesh.loose_lines().iter().map(|&ends| coordinates.bounds(ends)).collect();
        Segments { mesh, points, coordinates, boxes }
    }

    fn ends(&self, index: u32) -> [u32; 2] {
        self.mesh.loose_lines()[index as usize]
    }

    fn all(&self) -> std::ops::Range<u32> {
        0..self.boxes.len() as u32
    }

    /// Whether the image of `edge` crosses that of `line` strictly between
    /// the line's ends, in front of the eye, and not behind the line.
    fn crosses(&self, predicates: &Predicates<'_, Exact>, line: u32, edge: u32) -> bool {
        let ([p, q], [a, b]) = (self.ends(line), self.ends(edge));
        let carrier = Carrier::edge(p, q);
        let cut = Cut::Silhouette([a, b]);
        let values = carrier.ends.map(|end| predicates.value(cut, end));
        let [first, last] = values.map(|value| value.sign);
        if !first.is_opposite(last) {
            return false;
        }
        let sides = [a, b].map(|vertex| predicates.side(p, q, vertex));
        if sides[0] == sides[1] || predicates.skew(carrier, [a, b]) == last {
            return false;
        }
        if !self.points.has_near_plane() {
            return true;
        }
        let near = carrier.ends.map(|end| predicates.value(Cut::Near, end));
        let order = || predicates.order(carrier, (cut, &values), (Cut::Near, &near));
        match near.map(|value| value.sign) {
            [Sign::Positive, Sign::Positive] => true,
            [Sign::Positive, _] => order() == Ordering::Less,
            [_, Sign::Positive] => order() == Ordering::Greater,
            _ => false,
        }
    }

    /// Those of the proposed pairs (line, edge) that do cross, sorted.
    fn crossings(&self, proposed: impl IntoIterator<Item = [u32; 2]>) -> Vec<[u32; 2]> {
        let predicates = Predicates::<Exact>::new(&self.points);
        let mut found: Vec<[u32; 2]> = proposed
            .into_iter()
            .filter(|&[line, edge]| self.crosses(&predicates, line, edge))
            .collect();
        found.sort_unstable();
        found.dedup();
        found
    }

    fn brute_force(&self) -> Vec<[u32; 2]> {
        self.all().flat_map(|line| self.all().map(move |edge| [line, edge])).collect()
    }

    fn hierarchy(&self) -> Vec<[u32; 2]> {
        let crossings = Crossings::new(&self.boxes);
        let mut pairs = Vec::new();
        for line in self.all() {
            let probe = self.coordinates.probe(self.ends(line));
            crossings.candidates(&probe, |edge| pairs.push([line, edge]));
        }
        pairs
    }

    /// Boxes in the order of their left ends; each meets those that are
    /// still open.
    fn sweep(&self) -> Vec<[u32; 2]> {
        let mut order: Vec<u32> = self.all().collect();
        order.sort_by(|&a, &b| self.left(a).total_cmp(&self.left(b)));
        let mut open: Vec<u32> = Vec::new();
        let mut pairs = Vec::new();
        for one in order {
            open.retain(|&other| self.boxes[other as usize].high[0] >= self.left(one));
            for &other in &open {
                let [a, b] = [one, other].map(|i| &self.boxes[i as usize]);
                if a.low[1] <= b.high[1] && b.low[1] <= a.high[1] {
                    pairs.extend([[one, other], [other, one]]);
                }
            }
            open.push(one);
        }
        pairs
    }

    fn left(&self, index: u32) -> f32 {
        self.boxes[index as usize].low[0]
    }

    /// Cells of a fixed size over [-1, 1] squared; a segment is in all cells
    /// that its box meets.
    fn grid(&self, side: usize) -> Vec<[u32; 2]> {
        let cell = |x: f32| (((x + 1.0) * 0.5 * side as f32) as usize).min(side.saturating_sub(1));
        let mut cells: Vec<Vec<u32>> = vec![Vec::new(); side * side];
        for index in self.all() {
            let bounds = &self.boxes[index as usize];
            for u in cell(bounds.low[0])..=cell(bounds.high[0]) {
                for v in cell(bounds.low[1])..=cell(bounds.high[1]) {
                    cells[u * side + v].push(index);
                }
            }
        }
        let pairs = |cell: &Vec<u32>| -> Vec<[u32; 2]> {
            cell.iter().flat_map(|&a| cell.iter().map(move |&b| [a, b])).collect()
        };
        cells.iter().flat_map(pairs).collect()
    }
}

/// Asserts that all ways to propose name the same crossings; their number.
fn compare(lines: &[[DVec3; 2]], view: &View, what: &str) -> usize {
    let segments = Segments::new(lines, view);
    let expected = segments.crossings(segments.brute_force());
    assert_eq!(segments.crossings(segments.hierarchy()), expected, "hierarchy: {what}");
    assert_eq!(segments.crossings(segments.sweep()), expected, "sweep: {what}");
    for side in [1, 4, 13] {
        assert_eq!(segments.crossings(segments.grid(side)), expected, "grid {side}: {what}");
    }
    expected.len()
}

fn random_segment(random: &mut Random, grid: bool) -> [DVec3; 2] {
    loop {
        let ends = [0; 2].map(|_| if grid { random.grid_point(5) } else { random.point() });
        if ends[0] != ends[1] {
            return ends;
        }
    }
}

#[test]
fn random_sets_agree_with_brute_force() {
    let mut crossings = 0;
    for seed in 0..rounds(10_000) {
        let mut random = Random(seed);
        let grid = random.one_in(2);
        let count = 2 + random.below(11);
        let mut lines: Vec<[DVec3; 2]> =
            (0..count).map(|_| random_segment(&mut random, grid)).collect();
        if random.one_in(2) {
            // All in one plane: every crossing is a meeting.
            lines.iter_mut().flatten().for_each(|point| point.z = 0.0);
            lines.retain(|[a, b]| a != b);
        }
        if lines.is_empty() {
            continue;
        }
        let forward = if random.one_in(2) { -DVec3::Z } else { random.point() };
        crossings += compare(&lines, &orthographic(forward), &format!("seed {seed}"));
    }
    assert!(crossings > 20_000, "{crossings}");
}

#[test]
fn segments_of_one_line_never_cross() {
    for direction in [dvec3(1.0, 0.0, 0.0), dvec3(3.0, 7.0, 0.0), dvec3(0.1, 0.3, 0.0)] {
        let lines: Vec<[DVec3; 2]> = (0..40)
            .map(|i| [f64::from(i * 7 % 40), f64::from(i * 11 % 40) + 0.5].map(|t| direction * t))
            .collect();
        // Tenths are rounded: those need not lie on one line exactly.
        let found = compare(&lines, &orthographic(-DVec3::Z), "one line");
        assert!(found == 0 || direction.x == 0.1);
    }
}

#[test]
fn all_rays_of_a_star_cross_all_others() {
    let rays: Vec<[DVec3; 2]> = (0..31)
        .map(|i| dvec3(f64::from(i) - 15.0, f64::from(i * i % 17) + 1.0, 0.0))
        .map(|tip| [tip, -tip])
        .collect();
    let centre = dvec3(1024.0, -512.0, 0.0);
    for shift in [DVec3::ZERO, centre] {
        let star: Vec<_> = rays.iter().map(|ray| ray.map(|point| point + shift)).collect();
        let found = compare(&star, &orthographic(-DVec3::Z), "star");
        let parallel = |a: DVec3, b: DVec3| a.cross(b) == DVec3::ZERO;
        let expected = rays
            .iter()
            .flat_map(|a| rays.iter().map(move |b| !parallel(a[0], b[0])))
            .filter(|&cross| cross)
            .count();
        assert_eq!(found, expected);
    }
}

#[test]
fn a_comb_has_a_quarter_of_n_squared_crossings() {
    let teeth = 40;
    let mut comb = Vec::new();
    for i in 0..teeth {
        let x = f64::from(i);
        comb.push([dvec3(x, -1.0, 0.0), dvec3(x, f64::from(teeth), 0.0)]);
        comb.push([dvec3(-1.0, x, 0.0), dvec3(f64::from(teeth), x, 0.0)]);
    }
    let found = compare(&comb, &orthographic(-DVec3::Z), "comb");
    // Each crossing is one of the line with the edge and one the other way.
    assert_eq!(found, 2 * (comb.len() / 2).pow(2));
}

/// Asserts that the hierarchy proposes every crossing; their number.
fn nothing_is_lost(lines: &[[DVec3; 2]], view: &View, what: &str) -> usize {
    let segments = Segments::new(lines, view);
    let expected = segments.crossings(segments.brute_force());
    let mut proposed = segments.hierarchy();
    proposed.sort_unstable();
    for pair in &expected {
        assert!(proposed.binary_search(pair).is_ok(), "{what}: lost {pair:?} of {lines:?}");
    }
    expected.len()
}

#[test]
fn boxes_err_outward_only_in_parallel_views() {
    let mut crossings = 0;
    for seed in 0..rounds(1500) {
        let mut random = Random(seed);
        let scale = random.choose(&[1e-9, 1.0, 1e9]);
        let far = random.choose(&[0.0, 1.0, 1e6]);
        let offset = dvec3(far, -far, 0.7 * far) * scale;
        let grid = random.one_in(2);
        let lines: Vec<[DVec3; 2]> = (0..16)
            .map(|_| random_segment(&mut random, grid).map(|point| point * scale + offset))
            .collect();
        let forward = random.choose(&[random.clone().point(), DVec3::Y, -DVec3::ONE]);
        crossings += nothing_is_lost(
            &lines,
            &orthographic(forward),
            &format!("seed {seed}, {scale}, {far}"),
        );
    }
    assert!(crossings > 10_000, "{crossings}");
}

#[test]
fn boxes_err_outward_only_in_central_views() {
    let mut crossings = 0;
    for seed in 0..rounds(2000) {
        let mut random = Random(seed);
        let scale = random.choose(&[1e-9, 1.0, 1e9]);
        let far = random.choose(&[0.0, 1.0, 1e6]);
        let offset = dvec3(far, -far, 0.7 * far) * scale;
        let eye = offset + random.choose(&[DVec3::ZERO, dvec3(0.1, -0.2, 0.05)]) * scale;
        let mut lines: Vec<[DVec3; 2]> = (0..16)
            .map(|_| random_segment(&mut random, false).map(|point| point * scale + offset))
            .collect();
        // Vertices next to the plane of the eye, on both sides of it.
        for line in &mut lines {
            if random.one_in(3) {
                let depth = random.choose(&[0.0, 1e-300, 1e-15, -1e-15, 1e-8, -1e-8, 1e-3]);
                line[0].y = eye.y + depth * scale;
            }
        }
        let view = perspective(eye, DVec3::Y, 1e-12 * scale);
        crossings += nothing_is_lost(&lines, &view, &format!("seed {seed}, {scale}, {far}"));
    }
    assert!(crossings > 10_000, "{crossings}");
}
