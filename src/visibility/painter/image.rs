//! A painting order in coordinates of the view frame, rounded once.
//!
//! Pieces of one flat area that follow one another are one shape: sides that
//! two of them run along in opposite senses are left out, and what remains is
//! closed again. So a face that was parted at inner edges only, or cut and not
//! parted by another in the order, is printed whole. What is drawn of a border are
//! sides on edges that are lines of the question; sides that cuts made are
//! never drawn. A face that bends is one shape as far as its pieces turn alike
//! and none lies upon another: what winds around a place is then never
//! cancelled, and no line shows through.

use super::PainterError;
use crate::kernel::predicates::{Exact, InputPlane, PlanePoint, Predicates};
use crate::model::{LineClass, LineOrigin, Mesh};
use crate::polygon::{PlaneCorner, PlanePolygon, Side};
use crate::run::Counters;
use crate::view::{
    ImageRegion, LinePiece, LineQuestion, LineSource, PaintOrder, PaintedFace, PaintedPiece,
    VisibleLines,
};
use glam::{DVec2, DVec3};
use rustc_hash::FxHashMap;

/// Rounds all corners; returns the areas from back to front, and the lines
/// that are drawn over each of them. O(corners).
///
/// # Errors
///
/// If the view is a perspective one without a near plane.
pub fn painted_image(
    question: &LineQuestion<'_>,
    order: &PaintOrder,
) -> Result<(Vec<PaintedFace>, VisibleLines), PainterError> {
    super::check_view(question)?;
    let predicates = Predicates::<Exact>::new(question.points);
    let mut printer =
        Printer { question, predicates, drawn: drawn_edges(question), pieces: Vec::new() };
    let mut faces = Vec::new();
    for run in order.pieces.chunk_by(|a, b| a.area == b.area) {
        let mut rest = run;
        while !rest.is_empty() {
            let (shape, others) = rest.split_at(printer.one_shape(rest));
            faces.push(printer.face(shape));
            rest = others;
        }
    }
    let lines = VisibleLines {
        frame: *question.frame,
        objects: question.mesh.objects().iter().map(|object| object.name.clone()).collect(),
        pieces: printer.pieces,
        counters: Counters::default(),
    };
    Ok((faces, lines))
}

/// What is drawn of the edges that are lines of the question, as a whole or in
/// stretches: vertices at the ends, and the class.
fn drawn_edges(question: &LineQuestion<'_>) -> FxHashMap<[u32; 2], Vec<([u32; 2], LineClass)>> {
    let mesh = question.mesh;
    let mut drawn: FxHashMap<[u32; 2], Vec<([u32; 2], LineClass)>> = FxHashMap::default();
    for line in question.lines {
        match line.origin {
            LineOrigin::Edge(edge) => {
                let ends = mesh.edges().ends(edge);
                drawn.entry(ends).or_default().push((ends, line.class));
            }
            LineOrigin::Stretch(index) => {
                let ends = mesh.borders().stretches()[index as usize].ends;
                for side in mesh.borders().sides(index, false) {
                    let own = mesh.edges().ends(side.edge);
                    drawn.entry(own).or_default().push((ends, line.class));
                }
            }
            LineOrigin::Loose(_) | LineOrigin::Intersection(_) => {}
        }
    }
    drawn
}

fn sorted([a, b]: [u32; 2]) -> [u32; 2] {
    [a.min(b), a.max(b)]
}

/// A side of a piece between its corners.
#[derive(Clone, Copy)]
struct Stretch {
    ends: [PlanePoint; 2],
    side: Side,
}

struct Printer<'q> {
    question: &'q LineQuestion<'q>,
    predicates: Predicates<'q, Exact>,
    /// By the vertices of an edge.
    drawn: FxHashMap<[u32; 2], Vec<([u32; 2], LineClass)>>,
    pieces: Vec<LinePiece>,
}

impl Printer<'_> {
    /// How many of some pieces of one area are one shape, from the first.
    fn one_shape(&self, pieces: &[PaintedPiece]) -> usize {
        let facing = |piece: &PaintedPiece| self.question.facing[piece.triangle as usize];
        let alike = pieces.iter().take_while(|piece| facing(piece) == facing(&pieces[0])).count();
        if !self.bends(&pieces[..alike]) {
            return alike;
        }
        let is_apart =
            |i: &usize| pieces[..*i].iter().all(|earlier| self.are_apart(earlier, &pieces[*i]));
        1 + (1..alike).take_while(is_apart).count()
    }

    /// Whether some of these pieces lie in another plane than the first.
    fn bends(&self, pieces: &[PaintedPiece]) -> bool {
        let mesh = self.question.mesh;
        let corners = |piece: &PaintedPiece| mesh.triangles()[piece.triangle as usize];
        let plane = corners(&pieces[0]);
        let is_in = |x: &u32| plane.contains(x) || self.predicates.plane(plane, *x).is_zero();
        pieces[1..].iter().any(|piece| !corners(piece).iter().all(is_in))
    }

    /// Whether the images of two pieces have no area in common.
    fn are_apart(&self, first: &PaintedPiece, second: &PaintedPiece) -> bool {
        let LineQuestion { mesh, coordinates, facing, .. } = *self.question;
        let [one, other] = [first, second].map(|piece| piece.triangle as usize);
        let [box_one, box_other] =
            [one, other].map(|triangle| coordinates.bounds(mesh.triangles()[triangle]));
        one == other
            || !box_one.of_any_depth().overlaps(&box_other)
            || PlanePolygon::are_apart(
                &self.predicates,
                [&first.polygon, &second.polygon],
                first.polygon.shadow(facing[one]),
                second.polygon.shadow(facing[other]),
            )
    }

    /// Some pieces of one flat area.
    fn face(&mut self, pieces: &[PaintedPiece]) -> PaintedFace {
        let border = border(pieces);
        let first = self.pieces.len() as u32;
        let object = pieces[0].object;
        for stretch in &border {
            let Side::Edge { ends, is_inner: false } = stretch.side else { continue };
            for (part, class) in self.drawn.get(&sorted(ends)).cloned().unwrap_or_default() {
                if let Some(points) = self.common(stretch.ends, ends, part) {
                    self.draw(points, ends, class, object);
                }
            }
        }
        let rings = rings(&border);
        let ring = |ring: Vec<PlanePoint>| ring.into_iter().map(|p| self.place(p).0).collect();
        let polygons = vec![rings.into_iter().map(ring).collect()];
        let mesh = self.question.mesh;
        let facing = self.question.facing[pieces[0].triangle as usize].to_i32();
        let region = ImageRegion {
            face: pieces[0].face,
            object,
            normal: seen_normal(mesh, pieces[0].triangle, facing),
            color: mesh.color_of(pieces[0].face),
            polygons,
        };
        PaintedFace { region, lines: first..self.pieces.len() as u32 }
    }

    /// What a side, which runs along an edge from its first vertex towards its
    /// second, and a part of that edge between two vertices have in common.
    fn common(
        &self,
        [start, end]: [PlanePoint; 2],
        edge: [u32; 2],
        part: [u32; 2],
    ) -> Option<[PlanePoint; 2]> {
        if sorted(edge) == part {
            return Some([start, end]);
        }
        // Along an axis the points of a line are in order.
        let beyond = |point: PlanePoint, vertex: u32, axis: u8| {
            self.predicates.above(InputPlane::Across(vertex, axis).into(), point)
        };
        let second = PlanePoint::Vertex(edge[1]);
        let axis = (0..3).find(|&axis| !beyond(second, edge[0], axis).is_zero())?;
        let onward = beyond(second, edge[0], axis);
        let is_past = |point: PlanePoint, vertex: u32| beyond(point, vertex, axis) == onward;
        let [first, last] = match is_past(PlanePoint::Vertex(part[1]), part[0]) {
            true => part,
            false => [part[1], part[0]],
        };
        let is_before = |point, vertex| beyond(point, vertex, axis) == -onward;
        (is_before(start, last) && is_past(end, first)).then(|| {
            [
                if is_before(start, first) { PlanePoint::Vertex(first) } else { start },
                if is_past(end, last) { PlanePoint::Vertex(last) } else { end },
            ]
        })
    }

    fn draw(&mut self, points: [PlanePoint; 2], ends: [u32; 2], class: LineClass, object: u32) {
        let [start, end] = points.map(|point| self.place(point));
        let mesh = self.question.mesh;
        let run = self.pieces.len() as u32;
        self.pieces.push(LinePiece {
            class,
            invisibility: 0,
            outline: false,
            points: [start.0, end.0],
            depth: [start.1, end.1],
            object,
            source: LineSource::Edge(ends.map(|vertex| mesh.vertex_number(vertex))),
            run,
        });
    }

    /// Image and depth of a point. Those of a vertex are as lines have them.
    fn place(&self, point: PlanePoint) -> (DVec2, f64) {
        let coordinates = self.question.coordinates;
        coordinates.project(match point {
            PlanePoint::Vertex(vertex) => coordinates.point(vertex),
            _ => self.question.frame.coordinates(self.predicates.position(point)),
        })
    }
}

/// The sides of pieces without those that two of them share.
fn border(pieces: &[PaintedPiece]) -> Vec<Stretch> {
    let mut all = Vec::new();
    for piece in pieces {
        let corners = &piece.polygon.corners;
        let next = corners.iter().cycle().skip(1);
        let stretch = |(corner, next): (&PlaneCorner, &PlaneCorner)| Stretch {
            ends: [corner.point, next.point],
            side: corner.side,
        };
        all.extend(corners.iter().zip(next).map(stretch));
    }
    if pieces.len() < 2 {
        return all;
    }
    let mut count: FxHashMap<[PlanePoint; 2], i32> = FxHashMap::default();
    for stretch in &all {
        *count.entry(stretch.ends).or_default() += 1;
    }
    all.retain(|stretch| {
        let [start, end] = stretch.ends;
        !count.contains_key(&[end, start])
    });
    all
}

/// Sides as closed rings: as many of them end in a point as begin there.
fn rings(border: &[Stretch]) -> Vec<Vec<PlanePoint>> {
    let mut leaving: FxHashMap<PlanePoint, Vec<usize>> = FxHashMap::default();
    for (i, stretch) in border.iter().enumerate().rev() {
        leaving.entry(stretch.ends[0]).or_default().push(i);
    }
    let mut is_used = vec![false; border.len()];
    let mut rings = Vec::new();
    for first in 0..border.len() {
        let mut ring = Vec::new();
        let mut at = first;
        while !is_used[at] {
            is_used[at] = true;
            ring.push(border[at].ends[0]);
            let next = leaving.get_mut(&border[at].ends[1]);
            let next = next.and_then(|list| {
                while list.last().is_some_and(|&i| is_used[i]) {
                    list.pop();
                }
                list.pop()
            });
            match next {
                Some(next) => at = next,
                None => break,
            }
        }
        if !ring.is_empty() {
            rings.push(ring);
        }
    }
    rings
}

/// The normal of a triangle on the side that is seen.
fn seen_normal(mesh: &Mesh, triangle: u32, facing: i32) -> DVec3 {
    let at = |vertex: u32| mesh.vertices()[vertex as usize];
    let [a, b, c] = mesh.triangles()[triangle as usize].map(at);
    // Scaled first, so that products neither vanish nor overflow.
    let (u, v) = (b - a, c - a);
    let [u, v] = [u, v].map(|edge| edge / edge.abs().max_element());
    u.cross(v).normalize_or_zero() * f64::from(facing)
}
