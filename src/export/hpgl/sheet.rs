//! A page on a sheet in a plotter: from millimetres to plotter units.
//!
//! A page that stands while the sheet lies is turned by a quarter: its top
//! comes to the left of the sheet, as with vpype, so the two programs draw the
//! same. After that some devices want the sheet upside down. Plotter units
//! count from the device's own origin, y away from the lower border.

use super::Device;
use crate::drawing::Window;
use crate::export::ExportError;
use glam::{DVec2, Vec2Swizzles};

/// The largest coordinate of a plotter of which nothing is known: 16 bits.
const LARGEST: f64 = 32767.0;

/// How far a page may differ from a sheet, mm.
const SAME: f64 = 1.0;

/// How a page comes to lie in a plotter.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Sheet {
    /// Width and height of the sheet, mm.
    size: DVec2,
    /// Whether the page is turned by a quarter.
    quarter: bool,
    turned: bool,
    origin: DVec2,
    units_per_mm: f64,
    /// The limits, plotter units.
    pub(super) low: DVec2,
    pub(super) high: DVec2,
    /// The name of the paper, if the device has papers.
    pub(super) paper: Option<String>,
    pub(super) select: Option<u8>,
}

impl Sheet {
    /// The sheet for a page of this size, mm.
    pub(super) fn new(device: &Device, page: DVec2) -> Result<Self, ExportError> {
        let units_per_mm = 1.0 / device.unit;
        if device.papers.is_empty() {
            return Sheet::of_any_size(page, units_per_mm);
        }
        for paper in &device.papers {
            let size = DVec2::from(paper.size);
            let fits = |page: DVec2| (page - size).abs().max_element() <= SAME;
            if fits(page) || fits(page.yx()) {
                return Ok(Sheet {
                    size,
                    quarter: !fits(page),
                    turned: paper.turned,
                    origin: DVec2::from(paper.origin),
                    units_per_mm,
                    low: DVec2::new(f64::from(paper.x[0]), f64::from(paper.y[0])),
                    high: DVec2::new(f64::from(paper.x[1]), f64::from(paper.y[1])),
                    paper: Some(paper.name.clone()),
                    select: paper.select,
                });
            }
        }
        let papers: Vec<_> = device.papers.iter().map(|paper| paper.name.as_str()).collect();
        Err(ExportError::PlotterPaper {
            device: device.name.clone(),
            width: page.x,
            height: page.y,
            papers: papers.join(", "),
        })
    }

    fn of_any_size(page: DVec2, units_per_mm: f64) -> Result<Self, ExportError> {
        let high = (page * units_per_mm).round();
        if !high.is_finite() || LARGEST < high.max_element() {
            return Err(ExportError::PlotterRange {
                width: page.x,
                height: page.y,
                units: high.max_element(),
            });
        }
        Ok(Sheet {
            size: page,
            quarter: false,
            turned: false,
            origin: DVec2::new(0.0, page.y),
            units_per_mm,
            low: DVec2::ZERO,
            high,
            paper: None,
            select: None,
        })
    }

    /// The plotter unit nearest to a point of the page, ties to even.
    pub(super) fn units(&self, point: DVec2) -> DVec2 {
        let point = if self.quarter { self.quarter_turned(point) } else { point };
        let point = if self.turned { self.size - point } else { point };
        let offset = DVec2::new(point.x - self.origin.x, self.origin.y - point.y);
        (offset * self.units_per_mm).map(f64::round_ties_even)
    }

    /// Whether the device reaches a place.
    pub(super) fn reaches(&self, units: DVec2) -> bool {
        self.low.cmple(units).all() && units.cmple(self.high).all()
    }

    /// What the device reaches of the page, mm.
    pub(super) fn window(&self) -> Option<Window> {
        let corners = [self.low, self.high].map(|units| {
            let offset = units / self.units_per_mm;
            let point = DVec2::new(self.origin.x + offset.x, self.origin.y - offset.y);
            let point = if self.turned { self.size - point } else { point };
            // The inverse of the quarter turn.
            if self.quarter { DVec2::new(self.size.y - point.y, point.x) } else { point }
        });
        Window::new(corners[0], corners[1]).ok()
    }

    fn quarter_turned(&self, point: DVec2) -> DVec2 {
        DVec2::new(point.y, self.size.y - point.x)
    }
}
