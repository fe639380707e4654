//! Which edges are lines, for this scene and this eye.
//!
//! An edge is seen with its triangles to its left or to its right in the
//! image; edge-on triangles are on neither side. From that alone follow
//! contours and *effective* edges, those behind which the number of sheets
//! changes; winding is never read, for the side of a triangle is where its
//! third corner lies. Creases need the angle of the two faces, compared
//! exactly with the threshold. (Appel 1967 calls effective edges contour
//! lines; for closed surfaces they are the same.)
//!
//! Borders that lie on one another are lines piece by piece: see
//! [`super::Borders`]. Each of them is effective by itself, which comes to
//! the same, for a line behind passes behind all of them at one place.

use super::{Hinge, LineClass, Mesh};
use crate::kernel::numbers::Sign;
use crate::kernel::predicates::{Fold, FoldThreshold, Points, Policy, Predicates};
use crate::run::{Counters, Run, map_chunks};

/// Which lines are wanted.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FeatureOptions {
    classes: [bool; LineClass::ALL.len()],
    fold: FoldThreshold,
    /// Of two surfaces that pass through one another, if not that of creases.
    intersection_fold: Option<FoldThreshold>,
    seams: bool,
}

impl Default for FeatureOptions {
    /// All classes but `mesh`, creases from 30 degrees.
    fn default() -> Self {
        let classes = LineClass::ALL.map(|class| class != LineClass::Mesh);
        let fold = FoldThreshold::from_degrees(30.0);
        FeatureOptions { classes, fold, intersection_fold: None, seams: false }
    }
}

impl FeatureOptions {
    /// Exactly these classes.
    #[must_use]
    pub fn with_classes(mut self, classes: &[LineClass]) -> Self {
        self.classes = LineClass::ALL.map(|class| classes.contains(&class));
        self
    }

    /// Creases are folds of more than this many degrees.
    #[must_use]
    pub fn with_crease_degrees(mut self, degrees: f64) -> Self {
        self.fold = FoldThreshold::from_degrees(degrees);
        self
    }

    /// Surfaces that pass through one another at more than this many degrees
    /// make a line there. Without it the angle of creases counts.
    #[must_use]
    pub fn with_intersection_degrees(mut self, degrees: f64) -> Self {
        self.intersection_fold = Some(FoldThreshold::from_degrees(degrees));
        self
    }

    /// Whether the seam of two objects is a border of both. If not, what
    /// lies on its two sides says what it is, as at any edge.
    #[must_use]
    pub fn with_seams(mut self, seams: bool) -> Self {
        self.seams = seams;
        self
    }

    /// The least angle at which surfaces that cross make a line.
    pub(super) fn intersection_fold(&self) -> FoldThreshold {
        self.intersection_fold.unwrap_or(self.fold)
    }

    /// Whether lines of this class are wanted.
    pub fn wants(&self, class: LineClass) -> bool {
        self.classes[class as usize]
    }
}

/// What carries a line.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum LineOrigin {
    /// An edge of the mesh.
    Edge(u32),
    /// A stretch of borders that lie on one another, in place of the edges
    /// that it is part of.
    Stretch(u32),
    /// A loose line of the mesh.
    Loose(u32),
    /// An intersection line.
    Intersection(u32),
}

impl LineOrigin {
    /// The vertices at its ends; an intersection line has others.
    #[inline]
    pub fn vertices(self, mesh: &Mesh) -> Option<[u32; 2]> {
        match self {
            LineOrigin::Edge(edge) => Some(mesh.edges().ends(edge)),
            LineOrigin::Stretch(_) => self.hinge().map(|hinge| mesh.hinge_ends(hinge)),
            LineOrigin::Loose(index) => Some(mesh.loose_lines()[index as usize]),
            LineOrigin::Intersection(_) => None,
        }
    }

    /// The vertices, of one object, that name it: of a stretch those of an
    /// edge that it is part of.
    pub fn names(self, mesh: &Mesh) -> Option<[u32; 2]> {
        match self {
            LineOrigin::Stretch(index) => {
                Some(mesh.edges().ends(mesh.borders().stretches()[index as usize].edge))
            }
            _ => self.vertices(mesh),
        }
    }

    /// The edge or stretch, if it is one.
    #[inline]
    pub fn hinge(self) -> Option<Hinge> {
        match self {
            LineOrigin::Edge(edge) => Some(Hinge::Edge(edge)),
            LineOrigin::Stretch(index) => Some(Hinge::Stretch(index)),
            LineOrigin::Loose(_) | LineOrigin::Intersection(_) => None,
        }
    }
}

/// A line to be drawn where it is visible.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct FeatureLine {
    /// Its carrier.
    pub origin: LineOrigin,
    /// Its class.
    pub class: LineClass,
}

/// An edge behind which the number of sheets changes.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct EffectiveEdge {
    /// The edge.
    pub edge: u32,
    /// How many sheets a line behind it gains when it passes from the left
    /// of the edge to its right; never zero.
    pub gain: i32,
}

impl EffectiveEdge {
    /// The effective edges of a view, by edge number. O(n).
    pub fn find(mesh: &Mesh, facing: &[Sign]) -> Vec<Self> {
        let parts = map_chunks(mesh.edges().len(), PART, |part| {
            let effective = |edge: usize| {
                let triangles = mesh.edges().triangles(edge as u32).iter().copied();
                EdgeSides::of(mesh, facing, edge as u32, triangles).effective(edge as u32)
            };
            part.filter_map(effective).collect::<Vec<_>>()
        });
        parts.concat()
    }
}

/// Lines and effective edges of a view.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Features {
    /// The lines, by edge number; then stretches of borders, and loose lines.
    pub lines: Vec<FeatureLine>,
    /// The effective edges, by edge number.
    pub effective: Vec<EffectiveEdge>,
}

/// Edges that one task classifies.
const PART: usize = 1 << 14;

/// How each triangle faces the eye. O(n).
pub fn facing<P: Policy>(mesh: &Mesh, points: &Points, run: &Run) -> Vec<Sign> {
    let triangles = mesh.triangles();
    let parts = map_chunks(triangles.len(), PART, |part| {
        let predicates = Predicates::<P>::new(points);
        let signs: Vec<Sign> = triangles[part].iter().map(|&t| predicates.facing(t)).collect();
        (signs, predicates.counters())
    });
    let mut facing = Vec::with_capacity(triangles.len());
    for (signs, counters) in parts {
        facing.extend_from_slice(&signs);
        run.merge(&counters);
    }
    facing
}

impl Features {
    /// Classifies all edges and loose lines. O(n).
    pub fn find<P: Policy>(
        mesh: &Mesh,
        points: &Points,
        facing: &[Sign],
        options: &FeatureOptions,
        run: &Run,
    ) -> Self {
        let parts = map_chunks(mesh.edges().len(), PART, |part| {
            let predicates = Predicates::<P>::new(points);
            let mut found = Features::default();
            for edge in part {
                found.add_edge(mesh, &predicates, facing, options, edge as u32);
            }
            (found, predicates.counters())
        });
        let mut features = Features::default();
        for (found, counters) in parts {
            features.lines.extend_from_slice(&found.lines);
            features.effective.extend_from_slice(&found.effective);
            run.merge(&counters);
        }
        features.add_stretches::<P>(mesh, points, facing, options, run);
        if options.wants(LineClass::Line) {
            let loose = 0..mesh.loose_lines().len() as u32;
            features.lines.extend(loose.map(|index| FeatureLine {
                origin: LineOrigin::Loose(index),
                class: LineClass::Line,
            }));
        }
        features.count(mesh, run);
        features
    }

    fn add_edge<P: Policy>(
        &mut self,
        mesh: &Mesh,
        predicates: &Predicates<'_, P>,
        facing: &[Sign],
        options: &FeatureOptions,
        edge: u32,
    ) {
        let triangles = mesh.edges().triangles(edge).iter().copied();
        let all = EdgeSides::of(mesh, facing, edge, triangles);
        let faces = if mesh.has_polygons() {
            EdgeSides::of(mesh, facing, edge, mesh.bordering(edge))
        } else {
            all
        };
        self.effective.extend(all.effective(edge));
        if faces.all == 1 && mesh.borders().divide(edge) {
            return;
        }
        let is_crease = || is_crease(mesh, predicates, options, edge);
        if let Some(class) = class_of([all, faces], options, is_crease) {
            self.lines.push(FeatureLine { origin: LineOrigin::Edge(edge), class });
        }
    }

    /// Classifies the stretches of borders that lie on one another.
    fn add_stretches<P: Policy>(
        &mut self,
        mesh: &Mesh,
        points: &Points,
        facing: &[Sign],
        options: &FeatureOptions,
        run: &Run,
    ) {
        let predicates = Predicates::<P>::new(points);
        for (index, stretch) in (0..).zip(mesh.borders().stretches()) {
            let sides = mesh.borders().sides(index, !options.seams);
            let mut faces = EdgeSides::default();
            sides
                .iter()
                .for_each(|side| faces.add(facing[side.triangle as usize], side.runs_along));
            let is_crease = || match sides {
                [one, other] => {
                    let thirds = [one.third, other.third];
                    Fold::measure(&predicates, stretch.ends, thirds, options.fold).exceeds
                }
                _ => false,
            };
            if let Some(class) = class_of([faces; 2], options, is_crease) {
                self.lines.push(FeatureLine { origin: LineOrigin::Stretch(index), class });
            }
        }
        run.merge(&predicates.counters());
    }

    fn count(&self, mesh: &Mesh, run: &Run) {
        let mut counters = Counters::default();
        counters.add("edges", mesh.edges().len() as u64);
        counters.add("triangles", mesh.triangles().len() as u64);
        counters.add("feature-lines", self.lines.len() as u64);
        counters.add("effective-edges", self.effective.len() as u64);
        run.merge(&counters);
    }
}

/// How many triangles lie on which side of an edge in the image.
#[derive(Debug, Clone, Copy, Default)]
struct EdgeSides {
    left: i32,
    right: i32,
    /// All of them, edge-on ones too.
    all: i32,
}

impl EdgeSides {
    #[inline]
    fn of(mesh: &Mesh, facing: &[Sign], edge: u32, triangles: impl Iterator<Item = u32>) -> Self {
        let ends = mesh.edges().ends(edge);
        let mut sides = EdgeSides::default();
        for triangle in triangles {
            sides.add(facing[triangle as usize], mesh.runs_along(triangle, ends));
        }
        sides
    }

    /// Adds a triangle by the way it turns in the image, and whether it runs
    /// along the edge.
    #[inline]
    fn add(&mut self, turn: Sign, runs_along: bool) {
        self.all += 1;
        // The third corner is left of an edge that the triangle runs
        // along if the triangle turns counter-clockwise.
        match if runs_along { turn } else { -turn } {
            Sign::Positive => self.left += 1,
            Sign::Negative => self.right += 1,
            Sign::Zero => {}
        }
    }

    /// The edge, if these sides make it effective.
    #[inline]
    fn effective(self, edge: u32) -> Option<EffectiveEdge> {
        let gain = self.right - self.left;
        (gain != 0).then_some(EffectiveEdge { edge, gain })
    }

    /// Two faces on one side, or exactly one of the two edge-on.
    fn is_contour(self) -> bool {
        let seen = self.left + self.right;
        self.all == 2 && (seen == 1 || (seen == 2 && self.left != self.right))
    }
}

/// The first wanted class that an edge belongs to. `all` are the sides of
/// its triangles, `faces` those of the triangles whose faces end there: an
/// edge along which a polygon happens to be cut is no edge of that polygon.
#[inline]
fn class_of(
    [all, faces]: [EdgeSides; 2],
    options: &FeatureOptions,
    is_crease: impl FnOnce() -> bool,
) -> Option<LineClass> {
    let wanted = |class| options.wants(class).then_some(class);
    let mesh_line = || wanted(LineClass::Mesh);
    match faces.all {
        // The triangles of a polygon that is not flat may fold to a contour.
        0 => wanted(LineClass::Contour).filter(|_| all.is_contour()),
        1 => wanted(LineClass::Boundary).or_else(mesh_line),
        2 => {
            if faces.is_contour()
                && let Some(class) = wanted(LineClass::Contour)
            {
                return Some(class);
            }
            if options.wants(LineClass::Crease) && is_crease() {
                return Some(LineClass::Crease);
            }
            mesh_line()
        }
        _ => wanted(LineClass::NonManifold).or_else(mesh_line),
    }
}

/// Whether the two faces that end at an edge fold more than the threshold;
/// no if there are not two.
#[inline]
pub(super) fn is_crease<P: Policy>(
    mesh: &Mesh,
    predicates: &Predicates<'_, P>,
    options: &FeatureOptions,
    edge: u32,
) -> bool {
    let mut faces = mesh.bordering(edge);
    let (Some(first), Some(second), None) = (faces.next(), faces.next(), faces.next()) else {
        return false;
    };
    let ends = mesh.edges().ends(edge);
    let thirds = [mesh.third(first, ends), mesh.third(second, ends)];
    Fold::measure(predicates, ends, thirds, options.fold).exceeds
}
