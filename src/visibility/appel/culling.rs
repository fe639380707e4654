//! Lines that are hidden all along, found before they are walked.
//!
//! Where only visible pieces are wanted and many layers lie behind one
//! another, most lines lie wholly behind some layer that is near the eye. An
//! occlusion map of all triangles knows many of them from two numbers for
//! each tile that a line may touch; the others are walked as ever. An object
//! that lies wholly behind covered tiles hands in all its lines at once. What
//! is left out has no visible piece, so the answer is the same.
//!
//! The map costs time and pays where triangles cover one another often, so
//! it is made where a sample of them says so.
//!
//! Source: see [`crate::spatial::OcclusionMap`].

use crate::model::{FeatureLine, LineOrigin};
use crate::run::{Cancelled, Run, map_chunks, map_indexed, sample};
use crate::spatial::{Grid, OcclusionMap, Placed, cover};
use crate::view::{Culling, LineQuestion};
use glam::DVec2;
use std::ops::Range;

/// So many tiles has a triangle of average size.
const TILES_OF_A_TRIANGLE: f64 = 64.0;

/// The largest number of tiles.
const MOST_TILES: usize = 1 << 22;

/// A map pays from so many lines on,
const LEAST_LINES: usize = 4096;

/// from so many lines in a hundred triangles on,
const LEAST_SHARE: usize = 4;

/// and where so many triangles lie over one another on average.
const LEAST_LAYERS: f64 = 6.0;

/// So many vertices and triangles tell how large the image is and how often
/// it is covered.
const SAMPLE: usize = 4096;

/// What is certainly covered: tiles of the image, and whole objects.
pub(super) struct Covered {
    map: OcclusionMap,
    /// Whether each object lies wholly behind covered tiles.
    objects: Vec<bool>,
    /// Whether one of them does.
    some_object: bool,
}

/// What the question's triangles cover, if that is worth finding.
///
/// # Errors
///
/// If the run is stopped.
pub(super) fn covered(
    question: &LineQuestion<'_>,
    culling: Culling,
    run: &Run<'_>,
) -> Result<Option<Covered>, Cancelled> {
    match grid_for(question, culling) {
        Some(grid) => {
            let rows = question.mesh.triangles().len() * size_of::<Range<u16>>();
            run.take((grid.tiles() * size_of::<f64>() + rows) as u64)?;
            let map = map_of(question, grid, run);
            run.give_back(rows as u64);
            run.check()?;
            let covered = Covered::of(map, question);
            run.count("objects-covered", covered.objects.iter().filter(|&&it| it).count() as u64);
            Ok(Some(covered))
        }
        None => Ok(None),
    }
}

/// The tiles of the map, if one is to be made.
fn grid_for(question: &LineQuestion<'_>, culling: Culling) -> Option<Grid> {
    let triangles = question.mesh.triangles().len();
    if question.hidden_wanted || triangles == 0 || culling == Culling::Never {
        return None;
    }
    let lines = question.lines.len();
    let few = lines < LEAST_LINES || lines < triangles / 100 * LEAST_SHARE;
    if culling == Culling::WhereItPays && few {
        return None;
    }
    let (low, high) = middle_of_image(question)?;
    let layers = layers(question, low, high);
    if culling == Culling::WhereItPays && layers < LEAST_LAYERS {
        return None;
    }
    let area = (high - low).element_product();
    let tile = area * layers / (triangles as f64 * TILES_OF_A_TRIANGLE);
    Grid::new(low, high, tile.sqrt(), MOST_TILES)
}

/// Fills the tiles of a grid, by bands of rows. Once the run is stopped, bands
/// stay empty.
fn map_of(question: &LineQuestion<'_>, grid: Grid, run: &Run<'_>) -> OcclusionMap {
    let rows_of = map_indexed(question.mesh.triangles().len(), |triangle| {
        corners(question, triangle).map_or(0..0, |corners| grid.rows_inside(&corners))
    });
    let band = grid.rows().div_ceil(BANDS).max(1);
    let bands = map_chunks(grid.rows(), band, |rows| {
        let mut depths = grid.uncovered(rows.len());
        if run.is_stopped() {
            return depths;
        }
        let meets = |own: &Range<u16>| {
            usize::from(own.start) < rows.end && rows.start < usize::from(own.end)
        };
        let meeting = (0..rows_of.len()).filter(|&triangle| meets(&rows_of[triangle]));
        for corners in meeting.filter_map(|triangle| corners(question, triangle)) {
            cover(&grid, rows.clone(), &mut depths, &corners);
        }
        depths
    });
    OcclusionMap::of_bands(grid, bands)
}

/// Bands into which a grid is cut, whatever the number of cores.
const BANDS: usize = 16;

/// The corners of a triangle that may hide something, unless one of them has
/// no place in the image.
fn corners(question: &LineQuestion<'_>, triangle: usize) -> Option<[Placed; 3]> {
    if question.facing[triangle].is_zero() {
        return None;
    }
    let [a, b, c] = question.mesh.triangles()[triangle];
    let placed = |vertex| question.coordinates.placed(vertex);
    Some([placed(a)?, placed(b)?, placed(c)?])
}

/// A rectangle around most of the scene: a few vertices far away shall not
/// make all tiles large.
fn middle_of_image(question: &LineQuestion<'_>) -> Option<(DVec2, DVec2)> {
    let vertices = question.mesh.vertices().len();
    let places: Vec<DVec2> = sample(vertices, SAMPLE)
        .filter_map(|vertex| question.coordinates.placed(vertex as u32))
        .map(|placed| placed.at.truncate())
        .collect();
    if places.is_empty() {
        return None;
    }
    let range = |axis: usize| {
        let mut along: Vec<f64> = places.iter().map(|place| place[axis]).collect();
        along.sort_unstable_by(f64::total_cmp);
        let [least, most] = [along[0], along[along.len() - 1]];
        let aside = along.len() / 50;
        let [low, high] = [along[aside], along[along.len() - 1 - aside]];
        let more = (high - low) * 0.125;
        [least.max(low - more), most.min(high + more)]
    };
    let [x, y] = [range(0), range(1)];
    Some((DVec2::new(x[0], y[0]), DVec2::new(x[1], y[1])))
}

/// About how many triangles lie over a point of the rectangle.
fn layers(question: &LineQuestion<'_>, low: DVec2, high: DVec2) -> f64 {
    let triangles = question.mesh.triangles().len();
    let area = |triangle: usize| {
        let Some([a, b, c]) = corners(question, triangle) else {
            return 0.0;
        };
        let [a, b, c] = [a, b, c].map(|corner| corner.at.truncate().clamp(low, high));
        (b - a).perp_dot(c - a).abs() / 2.0
    };
    let (count, sum) = sample(triangles, SAMPLE)
        .fold((0.0, 0.0), |(count, sum), triangle| (count + 1.0, sum + area(triangle)));
    sum / count * triangles as f64 / (high - low).element_product()
}

/// Whether a line is an edge that a convex part of its own hides.
pub(super) fn is_at_back(question: &LineQuestion<'_>, line: &FeatureLine) -> bool {
    match (question.convex, line.origin) {
        (Some(parts), LineOrigin::Edge(edge)) => {
            parts.hide_own_edge(question.mesh, question.facing, edge)
        }
        _ => false,
    }
}

/// Whether a line lies wholly outside of the part of the image that is wanted.
pub(super) fn is_outside(question: &LineQuestion<'_>, line: &FeatureLine) -> bool {
    let Some(window) = question.window else { return false };
    let outside = |vertices: &[u32]| {
        let placed = vertices.iter().map(|&vertex| question.coordinates.placed(vertex));
        image_box(placed)
            .is_some_and(|[low, high]| high.cmplt(window[0]).any() || window[1].cmplt(low).any())
    };
    match line.origin {
        LineOrigin::Edge(edge) => outside(&question.mesh.edges().ends(edge)),
        LineOrigin::Loose(index) => outside(&question.mesh.loose_lines()[index as usize]),
        LineOrigin::Intersection(index) => {
            let triangles = question.intersections[index as usize].triangles;
            triangles.iter().any(|&triangle| outside(&question.mesh.triangles()[triangle as usize]))
        }
    }
}

/// Two corners around the images of points, and around every point between
/// them as a drawing rounds it; nothing if one of them has no image.
fn image_box(points: impl Iterator<Item = Option<Placed>>) -> Option<[DVec2; 2]> {
    /// A point between others is off by at most four times as much as they
    /// are, and twice that is allowed.
    const SLACKS: f64 = 8.0;
    let (mut low, mut high, mut slack) = (DVec2::INFINITY, DVec2::NEG_INFINITY, 0.0);
    for point in points {
        let Placed { at, image_slack, .. } = point?;
        low = low.min(at.truncate());
        high = high.max(at.truncate());
        slack = image_slack.max(slack);
    }
    Some([low - SLACKS * slack, high + SLACKS * slack])
}

impl Covered {
    /// Looks which objects lie behind a map: all their vertices, and so all
    /// that is between them.
    fn of(map: OcclusionMap, question: &LineQuestion<'_>) -> Self {
        let objects = question.mesh.objects();
        let is_covered = |number: usize| {
            let placed = |vertex| question.coordinates.placed(vertex);
            let vertices = || objects[number].vertices.clone();
            // The first vertex spares most objects a look at the others.
            let first = vertices().next().and_then(placed);
            first.is_some_and(|first| map.hides_segment([first, first]))
                && vertices().all(|vertex| placed(vertex).is_some())
                && map.hides_between(vertices().filter_map(placed))
        };
        let objects = map_indexed(objects.len(), is_covered);
        let some_object = objects.contains(&true);
        Covered { map, objects, some_object }
    }

    /// Whether a line is hidden all along.
    pub(super) fn hides(&self, question: &LineQuestion<'_>, line: &FeatureLine) -> bool {
        match line.origin {
            LineOrigin::Edge(edge) => {
                self.hides_segment(question, question.mesh.edges().ends(edge))
            }
            LineOrigin::Loose(index) => {
                self.hides_segment(question, question.mesh.loose_lines()[index as usize])
            }
            LineOrigin::Intersection(index) => {
                self.hides_common(question, question.intersections[index as usize].triangles)
            }
        }
    }

    fn hides_segment(&self, question: &LineQuestion<'_>, ends: [u32; 2]) -> bool {
        if self.some_object && self.objects[question.mesh.object_of_vertex(ends[0]) as usize] {
            return true;
        }
        match ends.map(|vertex| question.coordinates.placed(vertex)) {
            [Some(a), Some(b)] => self.map.hides_segment([a, b]),
            _ => false,
        }
    }

    /// Whether all that two triangles have in common is hidden.
    fn hides_common(&self, question: &LineQuestion<'_>, triangles: [u32; 2]) -> bool {
        let of_covered =
            |&triangle: &u32| self.objects[question.mesh.object_of_triangle(triangle) as usize];
        if self.some_object && triangles.iter().any(of_covered) {
            return true;
        }
        let placed = |number: u32| {
            let [a, b, c] = question.mesh.triangles()[number as usize]
                .map(|vertex| question.coordinates.placed(vertex));
            Some([a?, b?, c?])
        };
        match triangles.map(placed) {
            [Some(s), Some(t)] => self.map.hides_common(&s, &t),
            _ => false,
        }
    }
}
