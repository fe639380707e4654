//! What a line method is asked.

use super::LineSource;
use crate::kernel::numbers::Sign;
use crate::kernel::predicates::{Carrier, Points};
use crate::model::{
    ConvexParts, EdgePiercings, EffectiveEdge, Fans, FeatureLine, Frame, IntersectionLine,
    LineOrigin, Mesh, ViewCoordinates, triangle_hierarchy,
};
use crate::run::map_indexed;
use crate::spatial::{Crossings, Hierarchy};
use glam::DVec2;
use std::sync::OnceLock;

/// Which parts of which lines are visible? Everything that a method needs,
/// borrowed; nothing in it is rounded but the frame, which only boxes,
/// grids and output may use.
#[derive(Debug, Clone, Copy)]
pub struct LineQuestion<'a> {
    /// All objects.
    pub mesh: &'a Mesh,
    /// The mesh's vertices and the eye, for predicates.
    pub points: &'a Points,
    /// The view frame.
    pub frame: &'a Frame,
    /// The vertices in that frame, with error bounds.
    pub coordinates: &'a ViewCoordinates,
    /// Facing of each triangle of the mesh; zero is edge-on.
    pub facing: &'a [Sign],
    /// The lines to draw.
    pub lines: &'a [FeatureLine],
    /// The edges behind which the number of sheets changes.
    pub effective: &'a [EffectiveEdge],
    /// The intersection lines that `lines` refers to.
    pub intersections: &'a [IntersectionLine],
    /// Which edges pierce which triangles, where that was searched.
    pub piercings: Option<&'a EdgePiercings>,
    /// How triangles lie around their vertices, where that was searched.
    pub contacts: Option<Contacts<'a>>,
    /// Convex parts, where they were searched.
    pub convex: Option<&'a ConvexParts>,
    /// View boxes of the triangles, once they were asked for:
    /// [`LineQuestion::hierarchy`].
    pub hierarchy: &'a OnceLock<Hierarchy>,
    /// Whether hidden pieces are wanted too. If not, a method may leave a
    /// line as soon as it is known to be hidden.
    pub hidden_wanted: bool,
    /// Whether lines that are hidden all along were left out of `lines`
    /// already, as far as that was worth it. Triangles that lie wholly behind
    /// others are then as if edge-on.
    pub culled: bool,
    /// Two opposite corners, the least first, of the part of the image that is
    /// wanted, if not all of it is. A method may leave out lines that lie
    /// wholly outside.
    pub window: Option<[DVec2; 2]>,
}

/// What is known of the triangles at vertices: enough to carry counts from
/// line to line.
#[derive(Debug, Clone, Copy)]
pub struct Contacts<'a> {
    /// Vertices whose triangles lie around them in the image, once.
    pub fans: &'a Fans,
    /// Vertices that lie on other triangles than their own, sorted.
    pub touching: &'a [u32],
}

impl<'a> LineQuestion<'a> {
    /// The same for a part of the image, between its corners to the left and
    /// below and to the right and above.
    #[must_use]
    pub fn within(self, low: DVec2, high: DVec2) -> LineQuestion<'a> {
        LineQuestion { window: Some([low, high]), ..self }
    }

    /// View boxes of the triangles. O(n log n) when asked for the first time.
    pub fn hierarchy(&self) -> &'a Hierarchy {
        self.hierarchy.get_or_init(|| triangle_hierarchy(self.mesh, self.coordinates, None))
    }

    /// Whether view boxes of the triangles were asked for already.
    pub fn has_hierarchy(&self) -> bool {
        self.hierarchy.get().is_some()
    }

    /// The effective edges by their view boxes. O(n log n).
    pub fn effective_crossings(&self) -> Crossings {
        let boxes = map_indexed(self.effective.len(), |i| {
            self.coordinates.bounds(self.mesh.edges().ends(self.effective[i].edge))
        });
        Crossings::new(&boxes)
    }

    /// The segment that carries `line`.
    pub fn carrier(&self, line: &FeatureLine) -> Carrier {
        match line.origin {
            LineOrigin::Edge(edge) => {
                let [a, b] = self.mesh.edges().ends(edge);
                Carrier::edge(a, b)
            }
            LineOrigin::Stretch(index) => {
                let [a, b] = self.mesh.borders().stretches()[index as usize].ends;
                Carrier::edge(a, b)
            }
            LineOrigin::Loose(index) => {
                let [a, b] = self.mesh.loose_lines()[index as usize];
                Carrier::edge(a, b)
            }
            LineOrigin::Intersection(index) => self.intersections[index as usize].carrier,
        }
    }

    /// The triangles that contain `line` by what it is, each with its corner
    /// beside the line if it ends there.
    pub fn faces_of(&self, line: &FeatureLine) -> Vec<(u32, Option<u32>)> {
        if let LineOrigin::Intersection(index) = line.origin {
            let crossing = &self.intersections[index as usize];
            return (0..2).flat_map(|surface| crossing.faces(self.mesh, surface)).collect();
        }
        if let LineOrigin::Edge(edge) = line.origin {
            let ends = self.mesh.edges().ends(edge);
            let third = |triangle| (triangle, Some(self.mesh.third(triangle, ends)));
            return self.mesh.faces_at(edge).into_iter().map(third).collect();
        }
        let sides = line.origin.hinge().into_iter().flat_map(|it| self.mesh.hinge_sides(it));
        sides.map(|(triangle, third)| (triangle, Some(third))).collect()
    }

    /// The object of `line`, the first face's of an intersection line, and
    /// which of its edges or faces it is, by their numbers in the file.
    pub fn source(&self, line: &FeatureLine) -> (u32, LineSource) {
        if let LineOrigin::Intersection(index) = line.origin {
            let triangles = self.intersections[index as usize].triangles;
            let faces = triangles.map(|triangle| self.mesh.face_number(triangle));
            return (self.mesh.object_of_triangle(triangles[0]), LineSource::Faces(faces));
        }
        let names = line.origin.names(self.mesh).unwrap_or_default();
        let source = LineSource::Edge(names.map(|vertex| self.mesh.vertex_number(vertex)));
        (self.mesh.object_of_vertex(names[0]), source)
    }
}
