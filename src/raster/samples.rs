//! The grid of samples: one ray through each pixel centre.
//!
//! A sample is a world point, rounded once to a coarse dyadic grid; the ray
//! is the exact line through that point and the eye. So samples are input
//! numbers like vertices, decided about exactly, and of few enough bits to
//! stay in the quick integers.

use crate::model::{Frame, Projection, ViewCoordinates};
use glam::{DVec2, DVec3};
use std::ops::Range;

/// Bits of a sample's coordinates below the largest of them.
const SAMPLE_BITS: i32 = 44;

/// A grid of pixels over a rectangle of the image, square ones unless they
/// were divided.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Samples {
    frame: Frame,
    /// The upper left corner, view frame.
    corner: DVec2,
    /// The sides of a pixel, view frame units.
    pixel: DVec2,
    width: u32,
    height: u32,
    /// Depth at which sample points lie.
    depth: f64,
    /// Sample coordinates are multiples of this.
    grain: f64,
}

impl Samples {
    /// A grid of at most `size` x `size` pixels around the images of all
    /// vertices in front of the eye, but no farther out than a right angle
    /// of view. `None` if there is no vertex to be seen.
    pub fn around(
        frame: &Frame,
        coordinates: &ViewCoordinates,
        count: u32,
        size: u32,
    ) -> Option<Self> {
        let perspective = frame.projection == Projection::Perspective;
        let mut low = DVec2::INFINITY;
        let mut high = DVec2::NEG_INFINITY;
        let mut depth: f64 = 0.0;
        let mut largest = frame.origin.abs().max_element();
        for vertex in 0..count {
            let point = coordinates.point(vertex);
            if perspective && point.z <= 0.0 {
                continue;
            }
            let (image, _) = coordinates.project(point);
            low = low.min(image);
            high = high.max(image);
            depth = depth.max(point.z);
            largest = largest.max(point.abs().max_element());
        }
        if perspective {
            low = low.max(DVec2::NEG_ONE);
            high = high.min(DVec2::ONE);
        } else {
            depth = 0.0;
        }
        let extent = (high - low).max_element();
        if !(extent > 0.0 && extent.is_finite() && size > 2) {
            return None;
        }
        let pixel = extent / f64::from(size - 2);
        let pixels = |length: f64| ((length / pixel).ceil() as u32 + 2).min(size);
        let (width, height) = (pixels(high.x - low.x), pixels(high.y - low.y));
        let middle = (low + high) * 0.5;
        let half = DVec2::new(f64::from(width), f64::from(height)) * (pixel * 0.5);
        Some(Samples {
            frame: *frame,
            corner: DVec2::new(middle.x - half.x, middle.y + half.y),
            pixel: DVec2::splat(pixel),
            width,
            height,
            depth,
            grain: f64::powi(2.0, largest.log2().ceil() as i32 - SAMPLE_BITS),
        })
    }

    /// Columns.
    pub fn width(&self) -> u32 {
        self.width
    }

    /// Rows.
    pub fn height(&self) -> u32 {
        self.height
    }

    /// The width of a pixel in view frame units.
    pub fn pixel(&self) -> f64 {
        self.pixel.x
    }

    /// The grid with each pixel divided into `columns` x `rows`.
    #[must_use]
    pub fn divided(&self, columns: u32, rows: u32) -> Self {
        Samples {
            pixel: self.pixel / DVec2::new(f64::from(columns), f64::from(rows)),
            width: self.width * columns,
            height: self.height * rows,
            ..*self
        }
    }

    /// Columns and rows of all samples whose rays may meet something whose
    /// image lies between two points of the view frame, and of a few more
    /// around them.
    pub fn reached_by(&self, [low, high]: [DVec2; 2]) -> [Range<u32>; 2] {
        // A sample is rounded by half a grain along each axis, and a little
        // in what led to it; in perspective that shrinks with its depth.
        let depth = if self.depth > 0.0 { self.depth } else { 1.0 };
        let slack = DVec2::splat(1.5) + DVec2::splat(4.0 * self.grain / depth) / self.pixel;
        let first = DVec2::new(low.x - self.corner.x, self.corner.y - high.y) / self.pixel - slack;
        let end = DVec2::new(high.x - self.corner.x, self.corner.y - low.y) / self.pixel + slack;
        let size = [self.width, self.height];
        // Casts stop at the ends of the range of a number.
        let clamp = |axis: usize, place: f64| (place as u32).min(size[axis]);
        [0, 1].map(|axis| clamp(axis, first[axis].floor())..clamp(axis, end[axis].ceil()))
    }

    /// The world points of the samples of some rows, row by row.
    pub fn points(&self, rows: Range<u32>) -> impl Iterator<Item = DVec3> + '_ {
        rows.flat_map(move |row| (0..self.width).map(move |column| self.point(column, row)))
    }

    /// The world point of a sample.
    pub fn point(&self, column: u32, row: u32) -> DVec3 {
        let centre = DVec2::new(f64::from(column) + 0.5, -(f64::from(row) + 0.5));
        let image = self.corner + centre * self.pixel;
        let frame = &self.frame;
        let point = match frame.projection {
            Projection::Orthographic => frame.origin + frame.right * image.x + frame.up * image.y,
            Projection::Perspective => {
                let ray = frame.forward + frame.right * image.x + frame.up * image.y;
                frame.origin + ray * self.depth
            }
        };
        (point / self.grain).round() * self.grain + DVec3::ZERO
    }

    /// The pixel of an image point, if it is in the grid.
    pub fn pixel_of(&self, image: DVec2) -> Option<[u32; 2]> {
        let offset = (image - self.corner) / self.pixel;
        let (column, row) = (offset.x.floor(), (-offset.y).floor());
        let inside = (0.0..f64::from(self.width)).contains(&column)
            && (0.0..f64::from(self.height)).contains(&row);
        inside.then_some([column as u32, row as u32])
    }
}
