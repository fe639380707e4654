//! Vertices whose triangles lie around them in the image like an opened fan:
//! side by side, once around, none folded over another.
//!
//! Most vertices of a smooth surface are of this kind, and for them much
//! need not be looked at: no two triangles of a fan meet in space but in
//! what they share, and none of them hides the beginning of an edge at the
//! fan's vertex.
//!
//! A vertex is a fan if every edge at it has exactly two triangles, lying on
//! opposite sides of it in the image, none edge-on, and if going around the
//! vertex once passes all of them. That last number is found without
//! walking: sweep a line across the image; a triangle whose middle corner,
//! in the order of the sweep, is the vertex spans the sweep line on one side
//! of the vertex, and each turn around the vertex has two such triangles (as
//! in counting critical points: Banchoff 1970). The order of the sweep comes
//! from rounded coordinates with their error bounds; where these do not
//! tell, the vertex is not called a fan, which is always allowed.

use super::{EffectiveEdge, Mesh, ViewCoordinates};
use crate::kernel::numbers::Sign;
use crate::run::{fill_indexed, map_chunks};

/// Which vertices are fans in a view, and the triangles at those that are
/// not.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Fans {
    is_fan: Vec<bool>,
    /// End of each vertex's triangles in `triangles`; fans have none there.
    ends: Vec<u32>,
    triangles: Vec<u32>,
}

/// Edges or triangles that one task looks at.
const PART: usize = 1 << 14;

/// A count that says that a vertex is no fan, whatever is added.
const SPOILED: u8 = u8::MAX;

impl Fans {
    /// Finds them. `facing` and `effective` are those of the view. O(n).
    pub fn find(
        mesh: &Mesh,
        coordinates: &ViewCoordinates,
        facing: &[Sign],
        effective: &[EffectiveEdge],
    ) -> Self {
        let mut turns = half_turns(mesh, coordinates, facing);
        let mut spoil = |edge| {
            mesh.edges().ends(edge).into_iter().for_each(|end| turns[end as usize] = SPOILED);
        };
        // With two triangles on one side each, nothing is gained or lost.
        effective.iter().for_each(|effective| spoil(effective.edge));
        let odd = map_chunks(mesh.edges().len(), PART, |part| {
            let edges = part.map(|edge| edge as u32);
            edges.filter(|&edge| mesh.edges().triangles(edge).len() != 2).collect::<Vec<_>>()
        });
        odd.iter().flatten().copied().for_each(spoil);
        let is_fan: Vec<bool> = turns.into_iter().map(|half_turns| half_turns == 2).collect();
        let (ends, triangles) = stars_of_others(mesh, &is_fan);
        Fans { is_fan, ends, triangles }
    }

    /// Whether a vertex is a fan for certain.
    #[inline(always)]
    pub fn is_fan(&self, vertex: u32) -> bool {
        self.is_fan[vertex as usize]
    }

    /// The triangles at a vertex that is not a fan, in ascending order;
    /// none for a fan.
    pub fn star(&self, vertex: u32) -> &[u32] {
        let vertex = vertex as usize;
        let start = if vertex == 0 { 0 } else { self.ends[vertex - 1] as usize };
        &self.triangles[start..self.ends[vertex] as usize]
    }
}

/// For each vertex the triangles of which it is the middle corner in the
/// order of the sweep; spoiled where that order is not certain.
fn half_turns(mesh: &Mesh, coordinates: &ViewCoordinates, facing: &[Sign]) -> Vec<u8> {
    /// As many parts as pay: each has counts for all vertices.
    const PARTS: usize = 4;
    let triangles = mesh.triangles();
    let part = triangles.len().div_ceil(PARTS).max(1 << 14);
    let parts = map_chunks(triangles.len(), part, |part| {
        let mut counts = vec![0_u8; mesh.vertices().len()];
        for triangle in part {
            let corners = triangles[triangle];
            let middle = coordinates.middle_across(corners);
            match middle.filter(|_| !facing[triangle].is_zero()) {
                Some(corner) => {
                    let count = &mut counts[corner as usize];
                    *count = count.saturating_add(1);
                }
                None => corners.into_iter().for_each(|corner| counts[corner as usize] = SPOILED),
            }
        }
        counts
    });
    let mut sums = vec![0_u8; mesh.vertices().len()];
    let sum = |vertex: usize| parts.iter().fold(0_u8, |sum, part| sum.saturating_add(part[vertex]));
    fill_indexed(&mut sums, sum);
    sums
}

/// The triangles at each vertex that is not a fan: ends of the lists, and
/// the lists.
fn stars_of_others(mesh: &Mesh, is_fan: &[bool]) -> (Vec<u32>, Vec<u32>) {
    // On a smooth surface these are few.
    let others = map_chunks(mesh.triangles().len(), PART, |part| {
        let corners = |i: usize| mesh.triangles()[i].map(|corner| (corner, i as u32));
        part.flat_map(corners).filter(|&(corner, _)| !is_fan[corner as usize]).collect::<Vec<_>>()
    });
    let corners = || others.iter().flatten().copied();
    let mut ends = vec![0_u32; is_fan.len()];
    corners().for_each(|(corner, _)| ends[corner as usize] += 1);
    let mut next = Vec::with_capacity(ends.len());
    let mut sum = 0;
    for end in &mut ends {
        next.push(sum);
        sum += *end;
        *end = sum;
    }
    let mut triangles = vec![0; sum as usize];
    for (corner, triangle) in corners() {
        let slot = &mut next[corner as usize];
        triangles[*slot as usize] = triangle;
        *slot += 1;
    }
    (ends, triangles)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::kernel::predicates::{Exact, Points};
    use crate::model::{Faces, FeatureOptions, Features, Soup, StandardView, facing};
    use crate::run::Run;
    use glam::DVec3;

    /// The fans of triangles seen from above.
    fn fans(points: &[[f64; 3]], triangles: &[[u32; 3]]) -> Fans {
        let mut faces = Faces::default();
        triangles.iter().for_each(|triangle| faces.push(triangle, []));
        let vertices = points.iter().map(|&p| DVec3::from(p)).collect();
        let mesh = Mesh::new(vec![Soup { vertices, faces, ..Soup::default() }], None).unwrap();
        let view = StandardView::from_name("top").unwrap().view(DVec3::ZERO).unwrap();
        let points = Points::new(mesh.vertices(), view.eye, view.near);
        let coordinates = ViewCoordinates::new(&view.frame, mesh.vertices());
        let run = Run::default();
        let facing = facing::<Exact>(&mesh, &points, &run);
        let options = FeatureOptions::default();
        let features = Features::find::<Exact>(&mesh, &points, &facing, &options, &run);
        Fans::find(&mesh, &coordinates, &facing, &features.effective)
    }

    /// `count` points around the origin and the triangles between
    /// neighbours, in `turns` turns.
    fn wheel(count: u32, turns: f64) -> (Vec<[f64; 3]>, Vec<[u32; 3]>) {
        let rim = (0..count).map(|i| {
            let angle = 0.1 + turns * std::f64::consts::TAU * f64::from(i) / f64::from(count);
            [angle.cos(), angle.sin(), 0.1 * f64::from(i)]
        });
        let points = std::iter::once([0.0; 3]).chain(rim).collect();
        (points, (0..count).map(|i| [0, 1 + i, 1 + (i + 1) % count]).collect())
    }

    #[test]
    fn a_wheel_is_a_fan_at_its_hub_only() {
        let (points, triangles) = wheel(7, 1.0);
        let fans = fans(&points, &triangles);
        assert!(fans.is_fan(0));
        assert!(fans.star(0).is_empty());
        assert!((1..8).all(|rim| !fans.is_fan(rim) && fans.star(rim).len() == 2));
    }

    #[test]
    fn twice_around_is_no_fan() {
        let (points, triangles) = wheel(7, 2.0);
        assert!(!fans(&points, &triangles).is_fan(0));
    }

    #[test]
    fn a_fold_in_the_image_is_no_fan() {
        let (mut points, triangles) = wheel(7, 1.0);
        points.swap(2, 3);
        assert!(!fans(&points, &triangles).is_fan(0));
    }

    #[test]
    fn a_gap_is_no_fan() {
        let (points, triangles) = wheel(7, 1.0);
        assert!(!fans(&points, &triangles[1..]).is_fan(0));
    }

    #[test]
    fn two_wheels_on_one_hub_are_no_fan() {
        let (mut points, mut triangles) = wheel(5, 1.0);
        let (other, more) = wheel(4, 1.0);
        points.extend(other[1..].iter().map(|&[x, y, z]| [x, y, z + 3.0]));
        triangles.extend(more.iter().map(|&[hub, a, b]| [hub, a + 5, b + 5]));
        assert!(!fans(&points, &triangles).is_fan(0));
    }
}
