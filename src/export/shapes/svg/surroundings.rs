//! What an element is told by those around it.

use super::super::shape_file::ClipId;
use super::length::Lengths;
use super::style::Style;
use super::viewport::Viewport;
use glam::DAffine2;

/// What an element is told by those around it.
#[derive(Debug, Clone, Copy)]
pub(super) struct Surroundings {
    pub(super) style: Style,
    /// From user units to the page.
    pub(super) to_page: DAffine2,
    /// The viewport's size, in user units.
    pub(super) viewport: [f64; 2],
    /// Outside of what nothing is displayed.
    pub(super) clip: Option<ClipId>,
    /// Whether this is a clip path, where fills and opacity do not matter.
    pub(super) in_clip_path: bool,
    /// Width and height that a `use` gives to what it shows.
    pub(super) size_of_use: [Option<f64>; 2],
    /// Whether a `use` shows the element.
    pub(super) is_instance: bool,
}

impl Surroundings {
    /// Those of the outermost element.
    pub(super) fn of_page(viewport: Viewport) -> Self {
        Surroundings {
            style: Style::default(),
            to_page: viewport.to_outside,
            viewport: viewport.size,
            clip: None,
            in_clip_path: false,
            size_of_use: [None; 2],
            is_instance: false,
        }
    }

    pub(super) fn lengths(&self) -> Lengths {
        Lengths { viewport: self.viewport, font_size: self.style.font_size }
    }
}
