//! How triangles look in a preview: a lamp over the viewer's left shoulder,
//! the colours of the model, opacity, and a pattern. Either side of a
//! triangle is lit alike, for meshes need not say which is out. (A lamp at
//! the eye itself would make the three sides of a cube in an isometric view
//! one grey.)

use crate::fill::{Anchor, Pattern};
use crate::kernel::predicates::Eye;
use crate::model::View;
use crate::raster::Samples;
use crate::view::LineQuestion;
use glam::{DVec2, DVec3};

/// How a triangle looks in a pixel.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Paint {
    /// Red, green and blue, 0 to 1.
    pub colour: [f32; 3],
    /// 0 is not there, 1 hides all behind it.
    pub opacity: f32,
}

/// Of objects without a colour.
const CLAY: [f32; 3] = [0.82, 0.83, 0.85];

/// Light on surfaces that the lamp only grazes.
const AMBIENT: f32 = 0.25;

/// How far the lamp is to the left of and above the eye, against its
/// distance.
const SHOULDER: [f64; 2] = [0.45, 0.7];

/// How much darker the marks of a pattern are.
const MARK: f32 = 0.55;

/// The usual look of a scene.
#[derive(Debug, Clone)]
pub struct Shading<'a> {
    view: &'a View,
    question: &'a LineQuestion<'a>,
    opacity: f32,
    pattern: Option<Pattern>,
    /// By object; empty if the pattern is anchored to the page.
    anchors: Vec<[i64; 2]>,
}

impl<'a> Shading<'a> {
    /// Opaque and without a pattern.
    pub fn new(view: &'a View, question: &'a LineQuestion<'a>) -> Self {
        Shading { view, question, opacity: 1.0, pattern: None, anchors: Vec::new() }
    }

    /// The same with every triangle as opaque as this, 0 to 1.
    #[must_use]
    pub fn with_opacity(self, opacity: f32) -> Self {
        Shading { opacity: opacity.clamp(0.0, 1.0), ..self }
    }

    /// The same with a pattern that stays where it is on the page.
    #[must_use]
    pub fn with_pattern(self, pattern: Pattern) -> Self {
        Shading { pattern: Some(pattern), anchors: Vec::new(), ..self }
    }

    /// The same with a pattern that moves with each object: it begins at
    /// the pixel of the object's first vertex.
    #[must_use]
    pub fn with_pattern_of_objects(self, pattern: Pattern, pixels: &Samples) -> Self {
        let anchor = |vertex: u32| {
            let coordinates = self.question.coordinates;
            let (image, _) = coordinates.project(coordinates.point(vertex));
            let place = (image - pixels.image(0, 0)) / DVec2::new(pixels.pixel(), -pixels.pixel());
            [place.x.round() as i64, place.y.round() as i64]
        };
        let objects = self.question.mesh.objects().iter();
        let anchors = objects.map(|object| anchor(object.vertices.start)).collect();
        Shading { pattern: Some(pattern), anchors, ..self }
    }

    /// How a triangle looks in the pixel of a column and row.
    pub fn paint(&self, triangle: u32, at: [u32; 2]) -> Paint {
        let mesh = self.question.mesh;
        let object = mesh.object_of_triangle(triangle) as usize;
        let own = mesh
            .color_of(mesh.face_of(triangle))
            .map(|colour| colour.0.map(|c| f32::from(c) / 255.0));
        let mut light = AMBIENT + (1.0 - AMBIENT) * self.facing(triangle);
        if let Some(pattern) = &self.pattern {
            let anchor = self.anchors.get(object).map_or(Anchor::Page, |&at| Anchor::Object(at));
            if pattern.is_marked(at.map(i64::from), anchor) {
                light *= MARK;
            }
        }
        Paint { colour: own.unwrap_or(CLAY).map(|c| c * light), opacity: self.opacity }
    }

    /// The cosine between a triangle's normal, on the side of the eye, and
    /// the way to the lamp.
    fn facing(&self, triangle: u32) -> f32 {
        let mesh = self.question.mesh;
        let [a, b, c] =
            mesh.triangles()[triangle as usize].map(|vertex| mesh.vertices()[vertex as usize]);
        let normal: DVec3 = (b - a).cross(c - a);
        let towards = match self.view.eye {
            Eye::At(eye) => eye - (a + b + c) / 3.0,
            Eye::Towards(direction) => direction,
        };
        let frame = &self.view.frame;
        let [left, above] = SHOULDER;
        let lamp = towards.normalize() + frame.up * above - frame.right * left;
        let side = normal.dot(towards).signum();
        let cosine = side * normal.dot(lamp) / (normal.length() * lamp.length());
        if cosine.is_finite() { cosine.max(0.0) as f32 } else { 0.0 }
    }
}
