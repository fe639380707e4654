//! How far a pen goes to draw a drawing, and how long that takes.

use super::Drawing;

/// How fast a plotter moves.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Speeds {
    /// With the pen down, mm/s.
    pub down: f64,
    /// With the pen up, mm/s.
    pub up: f64,
    /// Time for lifting the pen and putting it down again, s.
    pub lift: f64,
    /// Time for changing the pen, s.
    pub change: f64,
}

/// Those of an HP 7475A at its full speed: 38.1 cm/s down, 50.8 cm/s up.
impl Default for Speeds {
    fn default() -> Self {
        Speeds { down: 381.0, up: 508.0, lift: 0.1, change: 4.0 }
    }
}

/// What drawing a drawing takes.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct PenStatistics {
    /// The number of strokes.
    pub strokes: usize,
    /// The number of pens, one for each layer.
    pub pens: usize,
    /// Length drawn, mm.
    pub drawn: f64,
    /// Length travelled between the strokes of one pen, mm. The ways from and
    /// to the pen's place are not in it.
    pub pen_up: f64,
}

impl PenStatistics {
    /// Adds up a drawing. O(n).
    pub fn of(drawing: &Drawing) -> Self {
        let mut sum = PenStatistics::default();
        for layer in &drawing.layers {
            sum.pens += 1;
            sum.strokes += layer.strokes.len();
            sum.drawn += layer.strokes.length();
            sum.pen_up += layer.strokes.pen_up_length();
        }
        sum
    }

    /// An estimate of the time it takes, s: every way at full speed, for
    /// what plotters lose by starting and stopping depends on the plotter.
    pub fn seconds(&self, speeds: &Speeds) -> f64 {
        self.drawn / speeds.down
            + self.pen_up / speeds.up
            + self.strokes as f64 * speeds.lift
            + self.pens as f64 * speeds.change
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::drawing::{Layer, LayerTags, LineStyle, Strokes};
    use crate::model::Color;
    use glam::DVec2;

    #[test]
    fn two_strokes_and_the_way_between_them() {
        let mut strokes = Strokes::default();
        strokes.push([DVec2::ZERO, DVec2::new(30.0, 40.0)]);
        strokes.push([DVec2::new(30.0, 10.0), DVec2::new(30.0, 0.0)]);
        let style = LineStyle { width: 0.5, color: Color([0; 3]) };
        let layer = Layer {
            number: 1,
            label: "1-visible".into(),
            style,
            strokes,
            tags: LayerTags::default(),
        };
        let drawing = Drawing {
            size: DVec2::splat(100.0),
            scale: 1.0,
            layers: vec![layer],
            fills: Vec::new(),
            painting: Vec::new(),
        };
        let sum = PenStatistics::of(&drawing);
        assert_eq!(sum, PenStatistics { strokes: 2, pens: 1, drawn: 60.0, pen_up: 30.0 });
        let speeds = Speeds { down: 60.0, up: 300.0, lift: 0.5, change: 2.0 };
        assert_eq!(sum.seconds(&speeds), 1.0 + 0.1 + 1.0 + 2.0);
    }
}
