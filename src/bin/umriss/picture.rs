//! A picture of a drawing with differences in it.
//!
//! Differences become lines of an object of their own, so that they are
//! placed on the page like all other lines and have a layer to be coloured.

use crate::failure::Failure;
use glam::DVec2;
use umriss::drawing::{Drawing, DrawingOptions, Hidden, LayerBy};
use umriss::export::{PREVIEW_WIDTH, SvgOptions, to_png, to_svg};
use umriss::model::{Color, LineClass, Unit};
use umriss::view::{LinePiece, LineSource, VisibleLines};

/// What the layer of the differences is called.
const DIFFERENCES: &str = "differences";

const RED: Color = Color([230, 0, 0]);

/// All lines, hidden ones dashed, and the differences over them in red; PNG.
pub(crate) fn picture(
    mut lines: VisibleLines,
    differences: impl Iterator<Item = [DVec2; 2]>,
    unit: Unit,
) -> Result<Vec<u8>, Failure> {
    for name in &mut lines.objects {
        name.clear();
    }
    let object = lines.objects.len() as u32;
    lines.objects.push(DIFFERENCES.to_owned());
    let first_run = lines.pieces.iter().map(|piece| piece.run + 1).max().unwrap_or(0);
    for (points, run) in differences.zip(first_run..) {
        lines.pieces.push(LinePiece {
            class: LineClass::Line,
            invisibility: 0,
            outline: false,
            points,
            depth: [0.0; 2],
            object,
            source: LineSource::Edge([0; 2]),
            run,
        });
    }
    let options = DrawingOptions {
        hidden: Hidden::Dashed,
        layer_by: LayerBy::Object,
        unit,
        ..DrawingOptions::default()
    };
    let mut drawing = Drawing::new(&lines, &options)?;
    for layer in &mut drawing.layers {
        if layer.label.ends_with(DIFFERENCES) {
            layer.style.color = RED;
            layer.style.width *= 2.0;
        }
    }
    let svg = to_svg(&drawing, &SvgOptions::default())?;
    Ok(to_png(&svg, PREVIEW_WIDTH)?)
}
