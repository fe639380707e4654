//! The exact answer of a region method, before anything is rounded.

use crate::polygon::clipping::Polygon;
use glam::{DVec2, DVec3};
use std::ops::Range;

/// What is seen of one face.
#[derive(Debug, Clone, PartialEq)]
pub struct Region {
    /// The triangles of the face: one, or those of a planar polygon. All
    /// other polygons are their triangles.
    pub triangles: Range<u32>,
    /// The face, numbered through the scene.
    pub face: u32,
    /// The object it belongs to.
    pub object: u32,
    /// Corners of a triangle of the face: its plane, exactly.
    pub plane: [u32; 3],
    /// The unit normal on the side that is seen, rounded.
    pub normal: DVec3,
    /// The connected areas in the image, as clipping returns them.
    pub polygons: Vec<Polygon>,
}

/// What is seen of all faces: regions that are disjoint and together the
/// image of the scene, in the order of the mesh's triangles. Faces of which
/// nothing is seen have none.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct VisibleRegions {
    regions: Vec<Region>,
}

impl VisibleRegions {
    /// Regions in the order of their triangles.
    pub fn new(regions: Vec<Region>) -> Self {
        VisibleRegions { regions }
    }

    /// All regions.
    pub fn regions(&self) -> &[Region] {
        &self.regions
    }

    /// The region to which what is seen of a triangle belongs. O(log n).
    pub fn of_triangle(&self, triangle: u32) -> Option<&Region> {
        self.index_of_triangle(triangle).map(|index| &self.regions[index])
    }

    /// Its place among all regions. O(log n).
    pub fn index_of_triangle(&self, triangle: u32) -> Option<usize> {
        let place = self.regions.partition_point(|region| region.triangles.end <= triangle);
        let region = self.regions.get(place)?;
        region.triangles.contains(&triangle).then_some(place)
    }
}

/// What is seen of one face, in coordinates of the view frame.
#[derive(Debug, Clone, PartialEq)]
pub struct ImageRegion {
    /// The face, numbered through the scene.
    pub face: u32,
    /// The object it belongs to.
    pub object: u32,
    /// The unit normal on the side that is seen, world coordinates.
    pub normal: DVec3,
    /// The colour that the file gives the face.
    pub color: Option<crate::model::Color>,
    /// Connected areas: an outline, counterclockwise, and its holes. Every
    /// corner is the exact one, rounded to a few units in the last place.
    pub polygons: Vec<Vec<Vec<DVec2>>>,
}

/// Regions in coordinates of the view frame, in the order of the mesh.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct ImageRegions {
    /// What is seen of each face.
    pub regions: Vec<ImageRegion>,
    /// For each object the image of its first vertex, to anchor patterns to;
    /// zero if it has none.
    pub anchors: Vec<DVec2>,
}
