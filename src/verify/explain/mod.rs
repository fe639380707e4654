//! Why is this line drawn, or hidden? The faces in front of one exact place.
//!
//! Galimberti and Montanari (1969) carry, along every line, the set of the
//! faces that hide it, where Appel carries only its size. Here the sets are
//! not carried: a drawing needs the sizes alone. But when a drawing surprises,
//! the set is what one wants to know, and for one place it is found afresh:
//!
//! 1. the piece of the drawing nearest to the place is looked up. That is a
//!    question about rounded coordinates, and decides nothing else;
//! 2. a point strictly inside the exact piece it is part of is chosen, about
//!    there, as a combination of the line's ends: a [`Probe`];
//! 3. every triangle whose box reaches in front of the line is asked whether
//!    it hides that point, on the left of the line and on its right. The
//!    side with more of them is the set; the count of the engine is its size.
//!    The order in depth is exact too;
//! 4. every other line is asked whether its image has that point.
//!
//! Members of a set are *triangles*, for these are what the engine counts. A
//! planar polygon is seen as one of its triangles on each side of a line, so
//! it is one member. A polygon that is not planar, or crosses itself, is as
//! many faces as it has triangles. Faces that lie on one another are a member
//! each, but of faces with the same vertices only the first is in the mesh.
//! Not members are faces that are seen edge-on, those in whose plane the line
//! lies, and those that it only touches. Faces in front of the near plane hide
//! too.
//!
//! The set belongs to the point, its size to the piece: along a piece one
//! face takes over from another where they meet at an edge.

mod names;
mod nearest;
mod told;

pub use told::{CoincidentLine, EndCause, EndThere, Explanation, FaceThere, LineThere, Side};

use super::places::Places;
use crate::kernel::predicates::{Exact, Place, Point, Probe};
use crate::model::{LineOrigin, Projection, View};
use crate::raster::samples::depth_on_ray;
use crate::raster::{BoxTree, Samples, SheetCounter, ray_hits};
use crate::run::{Cancelled, Run};
use crate::view::{ExactLines, ExactPiece, LineQuestion, VisibleLines};
use crate::visibility::reduce_with_origins;
use glam::{DVec2, DVec3};
use std::cmp::Ordering;

/// How near to the ends of a piece, as a share of its length, faces are asked:
/// a matter of what is told about places outside of it, not of what is true.
const MARGIN: f64 = 1.0 / 1024.0;

/// Explains places of one drawing.
///
/// ```
/// use glam::DVec2;
/// use umriss::kernel::predicates::Exact;
/// use umriss::model::{Camera, FeatureOptions, Scene, SceneOptions, StandardView, import};
/// use umriss::run::Run;
/// use umriss::verify::Explainer;
/// use umriss::view::PreparedView;
/// use umriss::visibility::{AppelOptions, appel};
///
/// // From the front, a square from y = 0 hides a line at y = 3 from u = 0 on.
/// let model = b"v 0 0 -1\nv 2 0 -1\nv 2 0 1\nv 0 0 1\nv -1 3 0\nv 1 3 0\nf 1 2 3 4\nl 5 6\n";
/// let model = import::read_bytes("square.obj", model, None)?;
/// let scene = Scene::new(model.objects, &SceneOptions::default())?;
/// let front = StandardView::from_name("front").ok_or("no such view")?;
/// let view = Camera::Standard(front).view(scene.mesh.bounds())?;
/// let run = Run::default();
/// let prepared =
///     PreparedView::new::<Exact>(&scene.mesh, &view, &FeatureOptions::default(), &run)?;
/// let question = prepared.question(true);
/// let answer = appel::<Exact>(&question, &AppelOptions::default(), &run)?;
///
/// let explainer = Explainer::new(&view, &question, &answer, &run)?;
/// let origin = view.frame.image(glam::DVec3::ZERO);
/// let there = explainer.at(origin + DVec2::new(0.5, 0.01)).line.ok_or("no line")?;
/// assert_eq!(there.hidden_by.len(), 1);
/// assert_eq!(there.hidden_by[0].face, 0);
/// let there = explainer.at(origin + DVec2::new(-0.5, 0.01)).line.ok_or("no line")?;
/// assert!(there.hidden_by.is_empty());
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug)]
pub struct Explainer<'a> {
    view: View,
    question: &'a LineQuestion<'a>,
    answer: &'a ExactLines,
    tree: BoxTree,
    lines: VisibleLines,
    /// For each piece of the drawing its line and which of its pieces it is
    /// part of.
    origins: Vec<(u32, usize)>,
}

impl<'a> Explainer<'a> {
    /// Makes the drawing of an answer to a question asked for `view`, and
    /// remembers what it is made of. Hidden lines can be explained if the
    /// answer has them. Expected O(n log n).
    ///
    /// # Errors
    ///
    /// If the run is cancelled.
    pub fn new(
        view: &View,
        question: &'a LineQuestion<'a>,
        answer: &'a ExactLines,
        run: &Run<'_>,
    ) -> Result<Self, Cancelled> {
        let (lines, origins) = reduce_with_origins::<Exact>(question, answer, run)?;
        let mut firsts = Vec::with_capacity(answer.len());
        let mut count = 0;
        for line in 0..answer.len() {
            firsts.push(count);
            count += answer.line(line).len();
        }
        let within = |[line, piece]: [u32; 2]| (line, piece as usize - firsts[line as usize]);
        Ok(Explainer {
            // What hides is not cut at the near plane.
            view: View { near: None, ..*view },
            question,
            answer,
            tree: SheetCounter::<Exact>::tree(question),
            lines,
            origins: origins.into_iter().map(within).collect(),
        })
    }

    /// The drawing whose places are explained.
    pub fn lines(&self) -> &VisibleLines {
        &self.lines
    }

    /// What there is at a point of the image, given in the view frame.
    /// Expected O(n).
    pub fn at(&self, point: DVec2) -> Explanation {
        let drawn = nearest::piece(&self.lines, point);
        Explanation {
            line: drawn.map(|drawn| self.piece(drawn, point)),
            faces: self.faces_at(point),
        }
    }

    /// The triangles whose closed image has a point of the image, nearest to
    /// the eye first. The ray is exact: it is that of the point, rounded once
    /// to the bits that samples have. O(n).
    pub fn faces_at(&self, point: DVec2) -> Vec<FaceThere> {
        let coordinates = self.question.coordinates;
        let vertices = 0..self.question.mesh.vertices().len() as u32;
        let depths = vertices.map(|vertex| coordinates.point(vertex).z);
        let deepest = depths.fold(0.0, f64::max);
        if !point.is_finite() || (self.is_perspective() && deepest <= 0.0) {
            return Vec::new();
        }
        // One sample in the middle of a pixel without size: the very point.
        let samples = Samples::about(&self.view.frame, point, f64::MIN_POSITIVE, [1, 1], deepest);
        let hits = ray_hits::<Exact>(&self.view, self.question, &samples, [0, 0]);
        hits.into_iter().map(|(triangle, depth)| self.face(triangle, depth)).collect()
    }

    /// Explains a piece of the drawing, given by its index, where it is
    /// nearest to a point of the image. Expected O(n).
    ///
    /// # Panics
    ///
    /// If the drawing has no such piece.
    pub fn piece(&self, drawn: usize, point: DVec2) -> LineThere {
        let shown = &self.lines.pieces[drawn];
        let (line, index) = self.origins[drawn];
        let (number, image) = (line as usize, nearest::on(shown.points, point));
        let exact = self.answer.line(number)[index];
        let places = Places::<Exact>::new(self.question);
        let counter = SheetCounter::<Exact>::new(self.question, &self.tree);
        let feature = &self.question.lines[number];
        let carrier = self.question.carrier(feature);
        let ends = [exact.from, exact.to].map(|place| self.end(&places, line, place));
        let share = nearest::share(&ends, image, self.is_perspective());
        let share = share.clamp(MARGIN, 1.0 - MARGIN);
        let probe = counter.probe(carrier, [exact.from, exact.to], share);
        let [from, to] = [exact.from, exact.to].map(|place| counter.parameter(carrier, place));
        let inside = self.world(&places, line, from + (to - from) * share);
        let (side, triangles) = chosen(&counter.hiding(feature, probe));
        let crossing = match feature.origin {
            LineOrigin::Intersection(i) => Some(self.question.intersections[i as usize].triangles),
            _ => None,
        };
        let face = |triangle: u32| {
            let vertices = self.question.mesh.vertices();
            let corners = self.question.mesh.triangles()[triangle as usize];
            let corners = corners.map(|corner| vertices[corner as usize]);
            self.face(triangle, depth_on_ray(&self.view, corners, inside))
        };
        LineThere {
            drawn,
            line,
            piece: index,
            distance: image.distance(point),
            image,
            depth: self.view.frame.depth(inside),
            probe,
            ends: self.with_beyond(ends, number, index),
            faces: crossing.map(|triangles| triangles.map(face)),
            hidden_by: triangles.into_iter().map(face).collect(),
            side,
            coincident: self.coincident(&places, line, probe),
        }
    }

    fn is_perspective(&self) -> bool {
        self.view.frame.projection == Projection::Perspective
    }

    /// A world point of a line, by its parameter.
    fn world(&self, places: &Places<'_, '_, Exact>, line: u32, parameter: f64) -> DVec3 {
        let [start, end] = places.ends_of(&self.question.lines[line as usize]);
        let frame = &self.view.frame;
        let DVec3 { x, y, z } = start.lerp(end, parameter);
        // Oblique views shear what is deeper.
        let plane =
            DVec2::new(x, y) - if self.is_perspective() { DVec2::ZERO } else { frame.shear * z };
        frame.origin + frame.right * plane.x + frame.up * plane.y + frame.forward * z
    }

    /// An end, whatever is beyond.
    fn end(&self, places: &Places<'_, '_, Exact>, line: u32, place: Place) -> EndThere {
        let [start, end] = places.ends_of(&self.question.lines[line as usize]);
        let point = start.lerp(end, places.parameter(line as usize, place));
        let (image, depth) = self.question.coordinates.project(point);
        let carrier = places.carrier(line as usize);
        let cause = names::cause(self.question.mesh, carrier, place);
        EndThere { image, depth, cause, beyond: None }
    }

    /// Looks at the pieces before and after a piece.
    fn with_beyond(&self, mut ends: [EndThere; 2], line: usize, index: usize) -> [EndThere; 2] {
        let pieces = self.answer.line(line);
        let exact = pieces[index];
        let before = index.checked_sub(1).map(|before| pieces[before]);
        let after = pieces.get(index + 1);
        ends[0].beyond = before.filter(|piece| piece.to == exact.from).map(|p| p.invisibility);
        ends[1].beyond = after.filter(|piece| piece.from == exact.to).map(|p| p.invisibility);
        ends
    }

    /// Lines whose images have the probe of a line strictly inside.
    fn coincident(
        &self,
        places: &Places<'_, '_, Exact>,
        line: u32,
        probe: Probe,
    ) -> Vec<CoincidentLine> {
        let predicates = places.predicates();
        let carrier = places.carrier(line as usize);
        let Some(axis) = predicates.axis_across(carrier) else {
            return Vec::new();
        };
        let lies_on = |point: Point| predicates.image_side_of_point(carrier, point).is_zero();
        let mut found = Vec::new();
        for other in (0..self.question.lines.len() as u32).filter(|&other| other != line) {
            let pieces = self.answer.line(other as usize);
            if pieces.is_empty() || !places.carrier(other as usize).ends.into_iter().all(lies_on) {
                continue;
            }
            let own = places.carrier(other as usize);
            // A piece that begins at the probe has it, one that ends there
            // has not.
            let is_after =
                |place| predicates.order_at(axis, (carrier, probe), (own, place)) == Ordering::Less;
            let has = |piece: &&ExactPiece| is_after(piece.from) != is_after(piece.to);
            found.extend(pieces.iter().find(has).map(|piece| {
                let (object, source) = self.question.source(&self.question.lines[other as usize]);
                CoincidentLine {
                    line: other,
                    class: self.question.lines[other as usize].class,
                    object,
                    source,
                    invisibility: piece.invisibility,
                }
            }));
        }
        found
    }

    fn face(&self, triangle: u32, depth: f64) -> FaceThere {
        let mesh = self.question.mesh;
        let object = mesh.object_of_triangle(triangle);
        FaceThere {
            triangle,
            object,
            face: mesh.face_number(triangle),
            vertices: mesh.triangles()[triangle as usize].map(|v| mesh.vertex_number(v)),
            depth,
        }
    }
}

/// Of triangles with the sides of a line on which they hide it those of the
/// side that has more.
fn chosen(hiding: &[(u32, [bool; 2])]) -> (Side, Vec<u32>) {
    let on =
        |side: usize| hiding.iter().filter(|(_, hides)| hides[side]).map(|(t, _)| *t).collect();
    let [left, right]: [Vec<u32>; 2] = [on(0), on(1)];
    match left.len().cmp(&right.len()) {
        Ordering::Equal if left == right => (Side::Both, left),
        Ordering::Less => (Side::Right, right),
        Ordering::Equal | Ordering::Greater => (Side::Left, left),
    }
}
