//! A coarse picture of what is certainly covered, and from which depth on.
//!
//! The image is cut into square tiles. A triangle whose image has a tile in
//! its inside covers it; a tile remembers the nearest depth at which it is
//! wholly covered. A segment that lies behind that depth in every tile which
//! it may touch is hidden all along, without a look at what else is in front
//! of it. In scenes of many layers most lines are settled so.
//!
//! All coordinates are taken with a bound of their error, triangles are made
//! smaller by it and segments larger. So there may be a false "perhaps" and
//! never a false "hidden".
//!
//! Source: the z-pyramid of N. Greene, M. Kass and G. Miller, "Hierarchical
//! Z-buffer visibility", 1993; here one level, with tiles instead of samples.

use glam::{DVec2, DVec3};
use std::ops::Range;

/// A vertex as the image has it, and by how much that may be off.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Placed {
    /// Image coordinates, and a depth that grows away from the eye and is
    /// linear in the image along every line and plane.
    pub at: DVec3,
    /// Bound of the error of the image coordinates.
    pub image_slack: f64,
    /// Bound of the error of the depth.
    pub depth_slack: f64,
}

/// Depths from which on tiles of the image are covered.
#[derive(Debug, Clone)]
pub struct OcclusionMap {
    grid: Grid,
    /// Row by row; infinite where nothing covers the tile.
    depths: Vec<f64>,
}

/// Square tiles over a rectangle of the image.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Grid {
    low: DVec2,
    side: f64,
    columns: usize,
    rows: usize,
    /// More than all roundings of coordinates of this size.
    rounding: f64,
}

/// Far more than what a handful of operations in doubles may err, relative to
/// the largest number among them.
const ROUNDING: f64 = 1e-13;

impl Grid {
    /// Tiles of about `side` over the rectangle from `low` to `high`, at most
    /// `most` of them; nothing, if that is no rectangle.
    pub fn new(low: DVec2, high: DVec2, side: f64, most: usize) -> Option<Self> {
        let extent = high - low;
        let area = extent.x * extent.y;
        let side = side.max((area / most as f64).sqrt());
        if !(area.is_finite() && area > 0.0 && side.is_finite() && side > 0.0) {
            return None;
        }
        // Both factors of a product of at most `most` fit into its type.
        let [columns, rows] = [extent.x, extent.y].map(|length| ((length / side) as usize).max(1));
        let largest = low.abs().max(high.abs()).max_element();
        let rounding = ROUNDING * (largest + side);
        (columns <= most / rows).then_some(Grid { low, side, columns, rows, rounding })
    }

    /// The number of rows.
    pub fn rows(&self) -> usize {
        self.rows
    }

    /// The number of tiles.
    pub fn tiles(&self) -> usize {
        self.rows * self.columns
    }

    /// The depths of a number of rows before anything covers them.
    pub fn uncovered(&self, rows: usize) -> Vec<f64> {
        vec![f64::INFINITY; rows * self.columns]
    }

    /// The rows of which a triangle may cover a tile.
    #[inline]
    pub fn rows_inside(&self, corners: &[Placed; 3]) -> Range<u16> {
        let [a, b, c] = corners.map(|corner| corner.at.truncate());
        let (low, high) = (a.min(b).min(c), a.max(b).max(c));
        let (low, high) = ((low - self.low) / self.side, (high - self.low) / self.side);
        let meets = low.x < self.columns as f64 && 0.0 < high.x;
        if !meets || high.x - low.x < 1.0 {
            return 0..0;
        }
        // Too many rows are no harm; `as` saturates.
        let most = self.rows.min(usize::from(u16::MAX)) as u16;
        (low.y.ceil() as u16).min(most)..(high.y.floor() as u16).min(most)
    }

    /// A bound of the error of the image coordinates of points and of all that
    /// is made of them and of borders of tiles.
    #[inline(always)]
    fn slack(&self, points: &[Placed]) -> f64 {
        let of =
            |point: &Placed| point.image_slack + ROUNDING * point.at.truncate().abs().max_element();
        points.iter().map(of).fold(0.0, f64::max) + self.rounding
    }

    /// A box around what lies between points; nothing if there is none, or if
    /// one of them is nowhere.
    fn around(&self, points: impl Iterator<Item = Placed>) -> Option<[DVec3; 2]> {
        let (mut low, mut high) = (DVec3::INFINITY, DVec3::NEG_INFINITY);
        let (mut slack, mut depth_slack) = (0.0_f64, 0.0_f64);
        for point in points {
            // A least number of several would pass over what is none.
            if !point.at.is_finite() {
                return None;
            }
            (low, high) = (low.min(point.at), high.max(point.at));
            slack = slack.max(self.slack(&[point]));
            depth_slack = depth_slack.max(point.depth_slack);
        }
        let depth_slack = depth_slack + ROUNDING * low.z.abs().max(high.z.abs());
        let slack = DVec3::new(slack, slack, depth_slack);
        low.is_finite().then_some([low - slack, high + slack])
    }

    /// Where a row or column begins.
    #[inline(always)]
    fn border(&self, axis: usize, number: usize) -> f64 {
        self.low[axis] + number as f64 * self.side
    }

    /// The tiles along an axis that may touch what lies between `low` and
    /// `high`; nothing, if some of it lies outside of the grid.
    #[inline(always)]
    fn touching(&self, axis: usize, low: f64, high: f64) -> Option<Range<usize>> {
        let count = if axis == 0 { self.columns } else { self.rows };
        let first = (low - self.rounding - self.low[axis]) / self.side;
        let last = (high + self.rounding - self.low[axis]) / self.side;
        (0.0 <= first && last < count as f64).then(|| first as usize..last as usize + 1)
    }
}

impl OcclusionMap {
    /// The map of triangles, found by bands of rows: `bands` are what
    /// [`cover`] made of the grid's rows, in their order.
    pub fn of_bands(grid: Grid, bands: Vec<Vec<f64>>) -> Self {
        OcclusionMap { grid, depths: bands.concat() }
    }

    /// Whether the segment between two points is hidden all along by some of
    /// the triangles.
    #[inline]
    pub fn hides_segment(&self, ends: [Placed; 2]) -> bool {
        let grid = &self.grid;
        let slack = grid.slack(&ends);
        let [a, b] = ends.map(|end| end.at);
        let depth_slack =
            ends[0].depth_slack.max(ends[1].depth_slack) + ROUNDING * a.z.abs().max(b.z.abs());
        let Some(rows) = grid.touching(1, a.y.min(b.y) - slack, a.y.max(b.y) + slack) else {
            return false;
        };
        let along = b - a;
        let one_row = rows.len() == 1;
        for row in rows {
            // The part of the segment in the row, and a little more.
            let [from, to] = if one_row || along.y == 0.0 {
                [0.0, 1.0]
            } else {
                let [low, high] = [grid.border(1, row) - slack, grid.border(1, row + 1) + slack];
                let [s, t] = [(low - a.y) / along.y, (high - a.y) / along.y];
                [s.min(t).clamp(0.0, 1.0), s.max(t).clamp(0.0, 1.0)]
            };
            let (first, last) = (a + along * from, a + along * to);
            let depth = first.z.min(last.z) - depth_slack;
            let (low, high) = (first.x.min(last.x) - slack, first.x.max(last.x) + slack);
            let Some(columns) = grid.touching(0, low, high) else {
                return false;
            };
            if !self.row(row)[columns].iter().all(|&covered| covered < depth) {
                return false;
            }
        }
        true
    }

    /// Whether everything that is in the boxes of both of two triangles is
    /// hidden.
    pub fn hides_common(&self, s: &[Placed; 3], t: &[Placed; 3]) -> bool {
        match [s, t].map(|corners| self.grid.around(corners.iter().copied())) {
            [Some([low_s, high_s]), Some([low_t, high_t])] => {
                self.hides_box(low_s.max(low_t), high_s.min(high_t))
            }
            _ => false,
        }
    }

    /// Whether everything between some points is hidden.
    pub fn hides_between(&self, points: impl Iterator<Item = Placed>) -> bool {
        self.grid.around(points).is_some_and(|[low, high]| self.hides_box(low, high))
    }

    fn hides_box(&self, low: DVec3, high: DVec3) -> bool {
        let columns = self.grid.touching(0, low.x, high.x);
        let (Some(columns), Some(rows)) = (columns, self.grid.touching(1, low.y, high.y)) else {
            return false;
        };
        let hidden =
            |row: usize| self.row(row)[columns.clone()].iter().all(|&covered| covered < low.z);
        rows.into_iter().all(hidden)
    }

    fn row(&self, row: usize) -> &[f64] {
        &self.depths[row * self.grid.columns..(row + 1) * self.grid.columns]
    }
}

/// The plane of a triangle over the image.
#[derive(Debug, Clone, Copy)]
struct Depth {
    base: DVec3,
    slope: DVec2,
    /// More than what it may be off at any point of the triangle.
    error: f64,
    /// The depth of the farthest corner.
    most: f64,
}

impl Depth {
    fn of([a, b, c]: [DVec3; 3], slack: f64, depth_slack: f64) -> Self {
        let (p, q) = (b - a, c - a);
        let area = p.x * q.y - p.y * q.x;
        let slope = DVec2::new(p.z * q.y - p.y * q.z, p.x * q.z - p.z * q.x) / area;
        let steepness = slope.x.abs() + slope.y.abs();
        let reach = p.abs().max(q.abs());
        // The corners say how well the slope was found, whatever the
        // condition of the quotient; between them the error is no larger.
        let miss = |corner: DVec3| (slope.dot(corner.truncate()) - corner.z).abs();
        let rounding = ROUNDING * (steepness * (reach.x + reach.y) + reach.z + a.z.abs());
        let error = miss(p).max(miss(q)) + depth_slack + steepness * slack + rounding;
        let most = a.z.max(b.z).max(c.z) + depth_slack;
        Depth { base: a, slope, error, most }
    }

    /// Not nearer than any point of the triangle over a tile that has the
    /// corner `farthest` in its farthest corner.
    #[inline(always)]
    fn at(&self, farthest: DVec2) -> f64 {
        let depth = self.base.z + self.slope.dot(farthest - self.base.truncate()) + self.error;
        // Where the slope is not finite the minimum is the other number.
        self.most.min(depth)
    }
}

/// Notes in the depths of the `rows` of a grid the tiles that lie wholly in
/// a triangle. `depths` begins with the first of these rows.
pub fn cover(grid: &Grid, rows: Range<usize>, depths: &mut [f64], corners: &[Placed; 3]) {
    let own = grid.rows_inside(corners);
    let own = rows.start.max(own.start.into())..rows.end.min(own.end.into());
    if own.is_empty() {
        return;
    }
    let most = |of: fn(&Placed) -> f64| corners.iter().map(of).fold(0.0, f64::max);
    let slack = grid.slack(corners);
    let [a, b, c] = corners.map(|corner| corner.at);
    let turn = (b - a).truncate().perp_dot((c - a).truncate());
    let [a, b, c] = if turn < 0.0 { [a, c, b] } else { [a, b, c] };
    let depth = Depth::of([a, b, c], slack, most(|corner| corner.depth_slack));
    let reach = ((b - a).abs().max((c - a).abs())).truncate().element_sum() * 2.0;
    // The product of two differences, each of whose coordinates may be off by
    // twice the slack and none of which is longer than the triangle; the
    // factor covers the rounding of the products too.
    let margin = (reach + slack) * slack * 16.0;
    let edges = [[a, b], [b, c], [c, a]].map(|[from, to]| Edge::new(from, to, margin));
    for row in own {
        let [low, high] = [grid.border(1, row), grid.border(1, row + 1)];
        // Columns as numbers with fractions, of which whole ones are inside.
        let mut from = 0.0_f64;
        let mut to = grid.columns as f64;
        for edge in &edges {
            edge.narrow(grid, low, high, &mut from, &mut to);
        }
        let (from, to) = (from.ceil(), to.floor());
        if to <= from || (to - from).is_nan() {
            continue;
        }
        let y = if depth.slope.y > 0.0 { high } else { low };
        let further = usize::from(depth.slope.x > 0.0);
        let start = (row - rows.start) * grid.columns;
        let (from, to) = (from as usize, to as usize);
        for (column, covered) in (from..to).zip(&mut depths[start + from..start + to]) {
            let x = grid.border(0, column + further);
            *covered = covered.min(depth.at(DVec2::new(x, y)));
        }
    }
}

/// An edge of a triangle with the inside on its left.
struct Edge {
    from: DVec2,
    along: DVec2,
    /// A point is inside for certain if the cross product is above this.
    margin: f64,
}

impl Edge {
    fn new(from: DVec3, to: DVec3, margin: f64) -> Self {
        Edge { from: from.truncate(), along: (to - from).truncate(), margin }
    }

    /// Leaves those columns of a row of which whole tiles lie inside.
    #[inline(always)]
    fn narrow(&self, grid: &Grid, low: f64, high: f64, from: &mut f64, to: &mut f64) {
        // along.x (y - from.y) - along.y (x - from.x) > margin
        let y = if self.along.x > 0.0 { low } else { high };
        let rest = self.along.x * (y - self.from.y) - self.margin;
        if self.along.y > 0.0 {
            let most = self.from.x + rest / self.along.y;
            *to = to.min((most - grid.rounding - grid.low.x) / grid.side);
        } else if self.along.y < 0.0 {
            let least = self.from.x + rest / self.along.y;
            *from = from.max((least + grid.rounding - grid.low.x) / grid.side);
        } else if rest.is_nan() || rest <= 0.0 {
            *to = 0.0;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    /// Far above the slack of the points below, far below a tile.
    const CLEARANCE: f64 = 1e-9;

    fn placed(at: DVec3) -> Placed {
        Placed { at, image_slack: 1e-12, depth_slack: 1e-12 }
    }

    fn point() -> impl Strategy<Value = DVec3> {
        let coordinate = || (-64..=64_i32).prop_map(|x| f64::from(x) / 32.0);
        (coordinate(), coordinate(), coordinate()).prop_map(|(x, y, z)| DVec3::new(x, y, z))
    }

    /// Corners of something small.
    fn body() -> impl Strategy<Value = [DVec3; 3]> {
        let reach = 0.25;
        (point(), point(), point())
            .prop_map(move |(a, b, c)| [a, a.lerp(b, reach), a.lerp(c, reach)])
    }

    fn map_of(triangles: &[[Placed; 3]], side: f64) -> OcclusionMap {
        let grid = Grid::new(DVec2::splat(-1.5), DVec2::splat(1.5), side, 10_000).expect("a grid");
        let bands = [0..grid.rows() / 3, grid.rows() / 3..grid.rows()].map(|rows| {
            let mut depths = grid.uncovered(rows.len());
            triangles.iter().for_each(|one| cover(&grid, rows.clone(), &mut depths, one));
            depths
        });
        OcclusionMap::of_bands(grid, bands.to_vec())
    }

    /// Whether a triangle lies strictly in front of a point and around it.
    fn hides(corners: &[Placed; 3], point: DVec3) -> bool {
        let [a, b, c] = corners.map(|corner| corner.at);
        let area = |p: DVec3, q: DVec3, r: DVec3| (q - p).truncate().perp_dot((r - p).truncate());
        let whole = area(a, b, c);
        let [u, v, w] =
            [area(point, b, c), area(a, point, c), area(a, b, point)].map(|x| x / whole);
        let inside = u > -CLEARANCE && v > -CLEARANCE && w > -CLEARANCE;
        inside && u * a.z + v * b.z + w * c.z < point.z + CLEARANCE
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(2000))]
        #[test]
        fn what_is_called_hidden_is_hidden(
            triangles in prop::collection::vec((point(), point(), point()), 1..12),
            segments in prop::collection::vec((point(), point()), 20),
            bodies in prop::collection::vec(body(), 20),
            side in 0.03..0.6_f64,
        ) {
            let triangles: Vec<_> = triangles.into_iter().map(|(a, b, c)| [a, b, c].map(placed)).collect();
            let map = map_of(&triangles, side);
            for (a, b) in segments {
                if !map.hides_segment([placed(a), placed(b)]) {
                    continue;
                }
                for step in 0..=64 {
                    let point = a.lerp(b, f64::from(step) / 64.0);
                    prop_assert!(triangles.iter().any(|one| hides(one, point)), "{point}");
                }
            }
            for [a, b, c] in bodies.into_iter().filter(|body| map.hides_between(body.map(placed).into_iter())) {
                for (i, j) in (0..=8).flat_map(|i| (0..=8 - i).map(move |j| (i, j))) {
                    let point = a + (b - a) * f64::from(i) / 8.0 + (c - a) * f64::from(j) / 8.0;
                    prop_assert!(triangles.iter().any(|one| hides(one, point)), "{point}");
                }
            }
        }
    }

    #[test]
    fn a_segment_is_hidden_behind_two_triangles_together_and_not_before_one() {
        let corner = |x: f64, y: f64, z: f64| placed(DVec3::new(x, y, z));
        let near = [corner(-2.0, -2.0, 0.0), corner(0.2, -2.0, 0.0), corner(0.2, 2.0, 0.0)];
        let far = [corner(-0.8, -2.0, 1.0), corner(2.0, -2.0, 1.0), corner(2.0, 2.0, 3.0)];
        let map = map_of(&[near, far], 0.1);
        let ends = |z: f64| [corner(-0.5, -1.0, z), corner(0.5, -1.2, z)];
        assert!(map.hides_segment(ends(3.0)));
        assert!(!map.hides_segment(ends(0.9)));
        assert!(!map_of(&[near], 0.1).hides_segment(ends(3.0)));
        // Beyond the grid nothing is known.
        assert!(!map.hides_segment([corner(0.5, -1.2, 9.0), corner(1.7, -1.2, 9.0)]));
        let small = |z: f64| [corner(-0.1, -1.3, z), corner(0.1, -1.3, z), corner(0.0, -1.1, z)];
        assert!(map.hides_common(&small(5.0), &small(4.0)));
        assert!(!map.hides_common(&small(-0.5), &small(-0.6)));
        let all = |z: f64| small(z).into_iter().chain(ends(4.0));
        assert!(map.hides_between(all(5.0)));
        assert!(!map.hides_between(all(0.5)), "partly in front");
        assert!(!map.hides_between(all(5.0).chain([corner(9.0, 0.0, 5.0)])), "beyond the grid");
        assert!(!map.hides_between([corner(f64::NAN, -1.2, 5.0)].into_iter().chain(all(5.0))));
        assert!(!map.hides_between(std::iter::empty()));
    }

    #[test]
    fn nothing_is_hidden_by_numbers_that_are_none() {
        let wild = [f64::NAN, f64::INFINITY, 1e300].map(|x| placed(DVec3::new(x, -x, x)));
        let map = map_of(&[wild], 0.5);
        let ends = [DVec3::new(0.0, 0.0, 9.0), DVec3::new(f64::NAN, 0.0, 9.0)].map(placed);
        assert!(!map.hides_segment(ends));
        assert!(!map.hides_segment([ends[0], ends[0]]));
    }
}
