//! What certainly lies behind something else, found before it is looked at.
//!
//! Where only visible pieces are wanted and many layers lie behind one
//! another, most lines lie wholly behind some layer that is near the eye. An
//! occlusion map of all triangles knows many of them from two numbers for
//! each tile that they may touch. No line of a triangle that lies behind
//! covered tiles has a visible piece. Nor does such a triangle hide anything
//! that is not hidden by what is nearer still, for the nearest triangle at a
//! place of the image lies behind nothing. So it need not be there at all: the
//! others, whatever holes they have, show the same pieces.
//!
//! The map costs time and pays where triangles cover one another often, so
//! it is made where a sample of them says so.
//!
//! Source: see [`crate::spatial::OcclusionMap`].

use super::{Culling, LineQuestion};
use crate::model::{FeatureLine, LineOrigin};
use crate::run::{Cancelled, Run, map_chunks, map_small, sample};
use crate::spatial::{Grid, OcclusionMap, Placed, cover};
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

/// Lines that one task looks at.
const PART: usize = 1 << 13;

/// What is certainly covered: tiles of the image, and triangles behind them.
#[derive(Debug, Clone)]
pub(crate) struct Covered {
    map: OcclusionMap,
    /// Whether each triangle lies wholly behind covered tiles.
    triangles: Vec<bool>,
}

impl Covered {
    /// What the question's triangles cover, if that is worth finding.
    ///
    /// # Errors
    ///
    /// If the run is stopped.
    pub(crate) fn find(
        question: &LineQuestion<'_>,
        culling: Culling,
        run: &Run<'_>,
    ) -> Result<Option<Self>, Cancelled> {
        let Some(grid) = grid_for(question, culling) else { return Ok(None) };
        let triangles = question.mesh.triangles().len();
        let rows = triangles * size_of::<Range<u16>>();
        run.take((grid.tiles() * size_of::<f64>() + rows + triangles) as u64)?;
        let map = map_of(question, grid, run);
        run.give_back(rows as u64);
        run.check()?;
        let triangles = map_small(triangles, |it| hides_triangle(&map, question, it));
        run.count("triangles-covered", triangles.iter().filter(|&&it| it).count() as u64);
        Ok(Some(Covered { map, triangles }))
    }

    /// Whether each triangle lies wholly behind covered tiles.
    pub(crate) fn triangles(&self) -> &[bool] {
        &self.triangles
    }

    /// Whether a line is hidden all along.
    pub(crate) fn hides(&self, question: &LineQuestion<'_>, line: &FeatureLine) -> bool {
        let is_covered = |&triangle: &u32| self.triangles[triangle as usize];
        match line.origin {
            LineOrigin::Edge(edge) => {
                question.mesh.edges().triangles(edge).iter().any(is_covered)
                    || self.hides_segment(question, question.mesh.edges().ends(edge))
            }
            LineOrigin::Stretch(index) => {
                let sides = question.mesh.borders().sides(index, true);
                sides.iter().any(|side| is_covered(&side.triangle))
                    || self.hides_segment(
                        question,
                        question.mesh.borders().stretches()[index as usize].ends,
                    )
            }
            LineOrigin::Loose(index) => {
                self.hides_segment(question, question.mesh.loose_lines()[index as usize])
            }
            LineOrigin::Intersection(index) => {
                let triangles = question.intersections[index as usize].triangles;
                triangles.iter().any(is_covered) || self.hides_common(question, triangles)
            }
        }
    }

    /// The lines that are not certainly hidden all along.
    pub(crate) fn shown(
        &self,
        question: &LineQuestion<'_>,
        lines: &[FeatureLine],
    ) -> Vec<FeatureLine> {
        let parts = map_chunks(lines.len(), PART, |part| {
            let shows = |line: &&FeatureLine| !self.hides(question, line);
            lines[part].iter().filter(shows).copied().collect::<Vec<_>>()
        });
        parts.concat()
    }

    fn hides_segment(&self, question: &LineQuestion<'_>, ends: [u32; 2]) -> bool {
        match ends.map(|vertex| question.coordinates.placed(vertex)) {
            [Some(a), Some(b)] => self.map.hides_segment([a, b]),
            _ => false,
        }
    }

    /// Whether all that two triangles have in common is hidden.
    fn hides_common(&self, question: &LineQuestion<'_>, triangles: [u32; 2]) -> bool {
        match triangles.map(|triangle| all_placed(question, triangle as usize)) {
            [Some(s), Some(t)] => self.map.hides_common(&s, &t),
            _ => false,
        }
    }
}

/// Whether a triangle lies wholly behind covered tiles.
fn hides_triangle(map: &OcclusionMap, question: &LineQuestion<'_>, triangle: usize) -> bool {
    let [a, b, c] = question.mesh.triangles()[triangle];
    let placed = |vertex| question.coordinates.placed(vertex);
    // One corner spares most triangles that show a look at the others.
    let Some(first) = placed(a).filter(|&first| map.hides_segment([first, first])) else {
        return false;
    };
    match [placed(b), placed(c)] {
        [Some(second), Some(third)] => map.hides_between([first, second, third].into_iter()),
        _ => false,
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

/// Fills the tiles of a grid, by bands of rows. Faces seen from their backs
/// cover too: where the front of a body is an edge, its back may be none. Once
/// the run is stopped, bands stay empty.
fn map_of(question: &LineQuestion<'_>, grid: Grid, run: &Run<'_>) -> OcclusionMap {
    let rows_of = map_small(question.mesh.triangles().len(), |triangle| {
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
    all_placed(question, triangle)
}

/// The corners of a triangle, unless one of them has no place in the image.
fn all_placed(question: &LineQuestion<'_>, triangle: usize) -> Option<[Placed; 3]> {
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
