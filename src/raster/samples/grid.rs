//! The grid of samples: one ray through each pixel centre.
//!
//! A sample is a world point; the ray is the exact line through that point
//! and the eye. The first sample and the steps to the right and down are
//! rounded once to a coarse dyadic grid, and all others are sums of them
//! without any rounding. So samples are input numbers like vertices, of few
//! enough bits to stay in the quick integers, and whatever is linear in
//! space is *exactly* linear in column and row: a half-plane holds an
//! unbroken run of the samples of a row, and a sign that all four corners
//! of a window have is had by all its samples.

use super::Footprint;
use crate::model::{Frame, Projection, ViewCoordinates};
use glam::{DVec2, DVec3};
use std::ops::Range;

/// Bits of a sample's coordinates below the largest of them. Three fewer
/// than a float has, for sums.
const SAMPLE_BITS: i32 = 50;

/// A grid of pixels over a rectangle of the image; they are square unless
/// they were divided.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Samples {
    /// The upper left corner, view frame.
    corner: DVec2,
    /// The sides of a pixel, view frame units.
    pixel: DVec2,
    width: u32,
    height: u32,
    /// The sample of column 0 and row 0.
    first: DVec3,
    /// The step to the next column.
    right: DVec3,
    /// The step to the next row.
    down: DVec3,
    /// What their coordinates are multiples of.
    grain: f64,
    /// How far, in pixels, rounding may have moved a sample.
    drift: f64,
    perspective: bool,
}

impl Samples {
    /// A grid of at most `size` x `size` pixels around the images of all
    /// vertices in front of the eye, but no farther out than a right angle
    /// of view. `None` if there is no vertex to be seen, or if the grid would
    /// reach beyond all floats.
    pub fn around(
        frame: &Frame,
        coordinates: &ViewCoordinates,
        count: u32,
        size: u32,
    ) -> Option<Self> {
        let (low, high, depth) = extent(frame, coordinates, count)?;
        let longer = (high - low).max_element();
        if !(longer > 0.0 && longer.is_finite() && size > 2) {
            return None;
        }
        let pixel = longer / f64::from(size - 2);
        let pixels = |length: f64| ((length / pixel).ceil() as u32 + 2).min(size);
        let size = [pixels(high.x - low.x), pixels(high.y - low.y)];
        Self::about(frame, middle(low, high), pixel, size, depth).within_floats()
    }

    /// A grid of exactly `width` x `height` pixels with the same content as
    /// that of [`Self::around`] in its middle, as large as it fits.
    pub fn fitting(
        frame: &Frame,
        coordinates: &ViewCoordinates,
        count: u32,
        [width, height]: [u32; 2],
    ) -> Option<Self> {
        let (low, high, depth) = extent(frame, coordinates, count)?;
        if width < 3 || height < 3 {
            return None;
        }
        let inner = DVec2::new(f64::from(width - 2), f64::from(height - 2));
        let pixel = ((high - low) / inner).max_element();
        if !(pixel > 0.0 && pixel.is_finite()) {
            return None;
        }
        Self::about(frame, middle(low, high), pixel, [width, height], depth).within_floats()
    }

    /// The grid, if all of it has finite coordinates.
    fn within_floats(self) -> Option<Self> {
        let [right, down] =
            [self.right * f64::from(self.width), self.down * f64::from(self.height)];
        // The order of sums does not matter where the largest is finite.
        let farthest = self.first.abs() + right.abs() + down.abs();
        (self.corner.is_finite() && self.drift.is_finite() && farthest.is_finite()).then_some(self)
    }

    /// A grid around a point of the image, given the side of a pixel. In
    /// perspective its sample points lie at `depth`, which is no decision,
    /// only a matter of how many bits they have.
    pub fn about(
        frame: &Frame,
        middle: DVec2,
        pixel: f64,
        [width, height]: [u32; 2],
        depth: f64,
    ) -> Self {
        let size = DVec2::new(f64::from(width), f64::from(height));
        let corner = middle + size * DVec2::new(-0.5, 0.5) * pixel;
        let perspective = frame.projection == Projection::Perspective;
        let depth = if perspective { depth } else { 1.0 };
        let centre = corner + DVec2::new(0.5, -0.5) * pixel;
        let offset = frame.right * centre.x + frame.up * centre.y;
        let ray = if perspective { frame.forward + offset } else { offset };
        let first = frame.origin + ray * depth;
        let (right, down) = (frame.right * (pixel * depth), -frame.up * (pixel * depth));
        let reach = first.abs() + right.abs() * size.x + down.abs() * size.y;
        let largest = reach.max_element().max(frame.origin.abs().max_element());
        let exponent = largest.max(f64::MIN_POSITIVE).log2().ceil() as i32 - SAMPLE_BITS;
        let grain = f64::powi(2.0, exponent.max(-1022));
        let round = |v: DVec3| (v / grain).round() * grain + DVec3::ZERO;
        Samples {
            corner,
            pixel: DVec2::splat(pixel),
            width,
            height,
            first: round(first),
            right: round(right),
            down: round(down),
            grain,
            // At most half a grain for each step in each of three
            // coordinates, and what the first sample's computation rounds;
            // up to three times that far in the image, at a right angle.
            drift: grain * 4.0 * (size.x + size.y + 8.0) / (pixel * depth),
            perspective,
        }
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

    /// The world point of a sample. Exact: all terms are multiples of one
    /// grain, and all sums have fewer bits above it than a float holds.
    pub fn point(&self, column: u32, row: u32) -> DVec3 {
        self.first + self.right * f64::from(column) + self.down * f64::from(row)
    }

    /// The pixel of an image point, if it is in the grid.
    pub fn pixel_of(&self, image: DVec2) -> Option<[u32; 2]> {
        let offset = (image - self.corner) / self.pixel;
        let (column, row) = (offset.x.floor(), (-offset.y).floor());
        let inside = (0.0..f64::from(self.width)).contains(&column)
            && (0.0..f64::from(self.height)).contains(&row);
        inside.then_some([column as u32, row as u32])
    }

    /// The image of a pixel's centre, rounded.
    pub fn image(&self, column: u32, row: u32) -> DVec2 {
        let offset = DVec2::new(f64::from(column) + 0.5, -(f64::from(row) + 0.5));
        self.corner + offset * self.pixel
    }

    /// The grid of some rows of this one: the very same samples.
    #[must_use]
    pub fn band(&self, rows: Range<u32>) -> Self {
        let above = f64::from(rows.start);
        Samples {
            corner: self.corner - DVec2::new(0.0, self.pixel.y * above),
            height: rows.end - rows.start,
            first: self.first + self.down * above,
            ..*self
        }
    }

    /// The grid with each pixel divided into `columns` x `rows`, rounded as
    /// finely as this one was.
    #[must_use]
    pub fn divided(&self, columns: u32, rows: u32) -> Self {
        let parts = DVec2::new(f64::from(columns), f64::from(rows));
        let round = |v: DVec3| (v / self.grain).round() * self.grain + DVec3::ZERO;
        let (right, down) = (self.right / parts.x, self.down / parts.y);
        // From the middle of the first pixel to that of its first part.
        let back = (right * (parts.x - 1.0) + down * (parts.y - 1.0)) * 0.5;
        Samples {
            pixel: self.pixel / parts,
            width: self.width * columns,
            height: self.height * rows,
            first: round(self.first - back),
            right: round(right),
            down: round(down),
            // As many more steps, and as many more parts in a pixel; and what
            // the pixels drifted.
            drift: 2.0 * self.drift * parts.max_element().powi(2),
            ..*self
        }
    }

    /// All samples.
    pub(in crate::raster) fn all(&self) -> Footprint {
        Footprint { columns: [0, self.width - 1], rows: [0, self.height - 1] }
    }

    /// Samples around the image of a triangle, as far as the grid reaches:
    /// at least one column more to each side than may see it, so that rows
    /// begin and end outside. All where a corner has no image. Rounded
    /// outward.
    pub(in crate::raster) fn footprint(
        &self,
        coordinates: &ViewCoordinates,
        corners: [u32; 3],
    ) -> Option<Footprint> {
        let Some((places, slack)) = self.places(coordinates, corners) else {
            return Some(self.all());
        };
        let range = |axis: usize, slack: f64, count: u32| {
            let [a, b, c] = places.map(|place| place[axis]);
            indices(a.min(b).min(c) - slack, a.max(b).max(c) + slack, count)
        };
        let columns = range(0, slack + 1.0, self.width)?;
        Some(Footprint { columns, rows: range(1, slack, self.height)? })
    }

    /// Rows that the edges `ab, bc, ca` of a triangle may reach, rounded
    /// outward by the same for all three, so that a row above or below the
    /// triangle that is among those of one edge is among those of both
    /// edges at the nearest corner. All rows where a corner has no image.
    pub(in crate::raster) fn edge_rows(
        &self,
        coordinates: &ViewCoordinates,
        corners: [u32; 3],
    ) -> [Option<[u32; 2]>; 3] {
        let Some((places, slack)) = self.places(coordinates, corners) else {
            return [Some(self.all().rows); 3];
        };
        let [a, b, c] = places.map(|place| place.y);
        [(a, b), (b, c), (c, a)]
            .map(|(p, q)| indices(p.min(q) - slack, p.max(q) + slack, self.height))
    }

    /// Where the images of a triangle's corners lie in units of columns and
    /// rows, and how far that may be off.
    pub(super) fn places(
        &self,
        coordinates: &ViewCoordinates,
        corners: [u32; 3],
    ) -> Option<([DVec2; 3], f64)> {
        let mut places = [DVec2::ZERO; 3];
        let mut slack: f64 = 0.0;
        let finest = self.pixel.min_element();
        for (place, vertex) in places.iter_mut().zip(corners) {
            let point = coordinates.point(vertex);
            let (image, depth) = coordinates.project(point);
            let offset = (image - self.corner) / self.pixel;
            *place = DVec2::new(offset.x - 0.5, -offset.y - 0.5);
            // A thousandth of a pixel and 2^-40 of the coordinates are much
            // more than these lines round.
            let size = (image.abs() + self.corner.abs()).max_element() / finest;
            let error = coordinates.image_slack(point) / finest + self.drift;
            slack = slack.max(error + size * f64::powi(2.0, -40) + 1e-3);
            if !(place.is_finite() && slack.is_finite() && (depth > 0.0 || !self.perspective)) {
                return None;
            }
        }
        Some((places, slack))
    }
}

/// The indices below `count` from `low` to `high`.
fn indices(low: f64, high: f64, count: u32) -> Option<[u32; 2]> {
    let (low, high) = (low.ceil().max(0.0), high.floor().min(f64::from(count - 1)));
    (low <= high).then_some([low as u32, high as u32])
}

/// The corners of the images of vertices in front of the eye, and the
/// depth of the farthest.
fn extent(frame: &Frame, coordinates: &ViewCoordinates, count: u32) -> Option<(DVec2, DVec2, f64)> {
    let perspective = frame.projection == Projection::Perspective;
    let mut low = DVec2::INFINITY;
    let mut high = DVec2::NEG_INFINITY;
    let mut deepest: f64 = 0.0;
    for vertex in 0..count {
        let point = coordinates.point(vertex);
        if !perspective || point.z > 0.0 {
            let (image, _) = coordinates.project(point);
            low = low.min(image);
            high = high.max(image);
            deepest = deepest.max(point.z);
        }
    }
    if perspective {
        low = low.max(DVec2::NEG_ONE);
        high = high.min(DVec2::ONE);
    }
    (low.x <= high.x && low.y <= high.y).then_some((low, high, deepest))
}

/// The middle of a box, halved first: sums of large numbers are none.
fn middle(low: DVec2, high: DVec2) -> DVec2 {
    low * 0.5 + high * 0.5
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::Camera;

    #[test]
    fn samples_are_exact_sums_of_steps_and_lie_in_their_pixels() {
        for eye in [DVec3::new(3.0, -7.0, 2.0), DVec3::new(1e6, -1e6 - 7.0, 2.5)] {
            let forward = DVec3::new(0.1, 1.0, -0.3);
            let (up, target) = (DVec3::Z, Some(eye + forward));
            let cameras = [
                Camera::Orthographic { forward, target, up },
                Camera::Perspective { eye, target, up, near: None, fov_y_degrees: 45.0 },
            ];
            for camera in cameras {
                let view = camera.view((eye, eye + 2.0 * forward)).expect("a view");
                let samples = Samples::about(&view.frame, DVec2::splat(0.1), 1e-3, [301, 200], 2.0);
                for (column, row) in [(0, 0), (300, 199), (150, 3), (17, 180)] {
                    let point = samples.point(column, row);
                    let image = view.frame.image(point);
                    assert_eq!(samples.pixel_of(image), Some([column, row]), "{eye} {image}");
                    assert!(image.distance(samples.image(column, row)) < 1e-5);
                    let sum =
                        samples.point(column, 0) - samples.point(0, 0) + samples.point(0, row);
                    assert_eq!(point, sum);
                }
            }
        }
    }
}
