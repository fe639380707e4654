//! Strokes cut to a part of the page.
//!
//! A stroke that leaves the window and comes back becomes two. Cuts lie on
//! the border bit for bit, as those of `cropping` do; a closed stroke that is
//! cut is open.

use super::cropping::clip_segment;
use super::{Drawing, Strokes, Window, is_closed};
use glam::DVec2;

/// How far cut strokes may be from the curves that they were, mm.
const FLATNESS: f64 = 1e-3;

impl Drawing {
    /// Cuts all strokes to a part of the page, mm, y downwards. Layers of
    /// which nothing is left are left out; curves become polylines. O(n).
    pub fn cut(&mut self, window: &Window) {
        for layer in &mut self.layers {
            layer.strokes = cut(&layer.strokes.flat(FLATNESS), window);
        }
        self.layers.retain(|layer| !layer.strokes.is_empty());
    }
}

fn cut(strokes: &Strokes, window: &Window) -> Strokes {
    let mut parts = Strokes::default();
    let mut points: Vec<DVec2> = Vec::new();
    for stroke in strokes.iter() {
        if stroke.iter().all(|point| window.holds(*point)) {
            parts.push(stroke.iter().copied());
            continue;
        }
        // A closed stroke begins outside, so that no part is torn apart
        // where it happens to begin.
        let ring = stroke.len() - 1;
        let outside = stroke.iter().position(|point| !window.holds(*point)).unwrap_or(0);
        let start = if is_closed(stroke) { outside % ring } else { 0 };
        let at = |step: usize| {
            stroke[if ring < start + step { start + step - ring } else { start + step }]
        };
        points.clear();
        for step in 0..ring {
            let Some([from, to]) = clip_segment([at(step), at(step + 1)], window) else {
                parts.push(points.drain(..));
                continue;
            };
            if points.last() != Some(&from) {
                parts.push(points.drain(..));
                points.push(from);
            }
            points.push(to);
        }
        parts.push(points.drain(..));
    }
    parts
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;

    fn parts(stroke: &[(f64, f64)]) -> Vec<Vec<DVec2>> {
        let mut strokes = Strokes::default();
        strokes.push(stroke.iter().copied().map(DVec2::from));
        let window = Window::new(DVec2::ZERO, DVec2::new(10.0, 10.0)).unwrap();
        cut(&strokes, &window).iter().map(<[DVec2]>::to_vec).collect()
    }

    #[test]
    fn a_stroke_that_comes_back_is_two() {
        let zigzag = parts(&[(1.0, 1.0), (1.0, 12.0), (3.0, 12.0), (3.0, 1.0)]);
        let expected = [[(1.0, 1.0), (1.0, 10.0)], [(3.0, 10.0), (3.0, 1.0)]];
        assert_eq!(zigzag, expected.map(|ends| ends.map(DVec2::from).to_vec()));
    }

    #[test]
    fn a_ring_that_is_cut_is_one_part_wherever_it_began() {
        let ring = [(5.0, 5.0), (15.0, 5.0), (15.0, 8.0), (5.0, 8.0), (5.0, 5.0)];
        let expected = [(10.0, 8.0), (5.0, 8.0), (5.0, 5.0), (10.0, 5.0)];
        assert_eq!(parts(&ring), [expected.map(DVec2::from).to_vec()]);
        assert_eq!(parts(&[(-5.0, 20.0), (20.0, 20.0)]), Vec::<Vec<DVec2>>::new());
    }
}
