//! A picture in colours, to be painted over.

use super::polygon::{Contours, Rule, fill_polygon};
use glam::DVec2;

/// Red, green, blue and opacity, not premultiplied.
pub type Rgba = [u8; 4];

/// Steps along each axis of a pixel when its coverage is counted.
const STEPS: i64 = 4;

/// Pixels row by row from the top.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Canvas {
    width: u32,
    height: u32,
    pixels: Vec<Rgba>,
}

impl Canvas {
    /// A canvas of one colour.
    pub fn new(width: u32, height: u32, colour: Rgba) -> Self {
        Canvas { width, height, pixels: vec![colour; width as usize * height as usize] }
    }

    /// A canvas of `width` columns with these pixels, row by row. Incomplete
    /// rows are left out.
    pub fn of_pixels(width: u32, mut pixels: Vec<Rgba>) -> Self {
        let height = pixels.len().checked_div(width as usize).unwrap_or(0);
        pixels.truncate(width as usize * height);
        Canvas { width, height: height as u32, pixels }
    }

    /// Columns.
    pub fn width(&self) -> u32 {
        self.width
    }

    /// Rows.
    pub fn height(&self) -> u32 {
        self.height
    }

    /// All pixels, row by row.
    pub fn pixels(&self) -> &[Rgba] {
        &self.pixels
    }

    /// The pixels as bytes, as picture formats want them.
    pub fn bytes(&self) -> Vec<u8> {
        self.pixels.as_flattened().to_vec()
    }

    /// The colour of a pixel; nothing beside the canvas.
    pub fn pixel(&self, column: u32, row: u32) -> Option<Rgba> {
        let inside = column < self.width && row < self.height;
        inside.then(|| self.pixels[row as usize * self.width as usize + column as usize])
    }

    /// The same picture on paper of an opaque colour.
    #[must_use]
    pub fn on(mut self, paper: [u8; 3]) -> Self {
        for pixel in &mut self.pixels {
            let [red, green, blue] = paper;
            *pixel = over(*pixel, [red, green, blue, 255], 1.0);
        }
        self
    }

    /// Paints contours, in pixels with y downwards, with smooth edges: each
    /// pixel by the share of its 4 x 4 points that are inside.
    pub fn paint<'a>(
        &mut self,
        contours: impl IntoIterator<Item = &'a [DVec2]>,
        rule: Rule,
        colour: Rgba,
    ) {
        let mut fine = Contours::default();
        for contour in contours {
            fine.push(contour.iter().map(|point| *point * STEPS as f64));
        }
        let (width, height) = (i64::from(self.width), i64::from(self.height));
        let mut row = vec![0_u32; self.width as usize];
        let mut current = None;
        fill_polygon(&fine, rule, |fine_row, columns| {
            let target = fine_row.div_euclid(STEPS);
            if current != Some(target) {
                self.blend_row(current, &mut row, colour);
                current = (0..height).contains(&target).then_some(target);
            }
            if current.is_some() {
                for column in columns.start.max(0)..columns.end.min(width * STEPS) {
                    row[(column / STEPS) as usize] += 1;
                }
            }
        });
        self.blend_row(current, &mut row, colour);
    }

    /// Paints a row by the points counted in each pixel, and forgets them.
    fn blend_row(&mut self, row: Option<i64>, counts: &mut [u32], colour: Rgba) {
        if let Some(row) = row {
            let width = self.width as usize;
            let line = &mut self.pixels[row as usize * width..(row as usize + 1) * width];
            for (pixel, count) in
                line.iter_mut().zip(counts.iter()).filter(|(_, count)| **count > 0)
            {
                *pixel = over(colour, *pixel, *count as f32 / (STEPS * STEPS) as f32);
            }
        }
        counts.fill(0);
    }
}

/// A colour with a share of its opacity over another one.
fn over(front: Rgba, back: Rgba, share: f32) -> Rgba {
    let front_opacity = f32::from(front[3]) / 255.0 * share;
    let behind = f32::from(back[3]) / 255.0 * (1.0 - front_opacity);
    let opacity = front_opacity + behind;
    if opacity <= 0.0 {
        return [0; 4];
    }
    let mix = |i: usize| {
        let sum = f32::from(front[i]) * front_opacity + f32::from(back[i]) * behind;
        (sum / opacity).round() as u8
    };
    [mix(0), mix(1), mix(2), (opacity * 255.0).round() as u8]
}
