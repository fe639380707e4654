//! The sides of all regions by their boxes in the image, so that a line finds
//! those that it may meet.
//!
//! Corners of regions are crossings and have no coordinates, but floats that
//! stand for them and bounds of their errors; boxes around those are in the
//! coordinates of the chart.

use crate::kernel::predicates::{Approximation, Chart, Policy, Predicates};
use crate::polygon::clipping::Corner;
use crate::run::map_chunks;
use crate::spatial::{Bounds, Crossings, Rounding, SegmentProbe};
use crate::view::{LineQuestion, VisibleRegions};
use glam::DVec3;

/// Corners per task.
const PART: usize = 1 << 12;

/// Twice the step between the narrow floats below one, and a little more: how
/// far apart the bounds of a coordinate are that floats know well.
const SHARP: f32 = 3e-7;

/// A side of a region, which lies left of it.
#[derive(Debug, Clone, Copy)]
pub(super) struct Border<'r> {
    /// The number of the region.
    pub(super) region: u32,
    /// Where it begins, and its line.
    pub(super) from: &'r Corner,
    /// Where it ends.
    pub(super) to: &'r Corner,
}

/// All sides of all regions.
pub(super) struct Borders<'r> {
    borders: Vec<Border<'r>>,
    crossings: Crossings,
    rounding: Rounding,
}

impl<'r> Borders<'r> {
    /// Collects them. O(n log n) for n corners.
    pub(super) fn new<P: Policy>(
        question: &LineQuestion<'_>,
        chart: &Chart,
        regions: &'r VisibleRegions,
    ) -> Self {
        let mut borders = Vec::new();
        // The number of the side after each.
        let mut next: Vec<u32> = Vec::new();
        for (region, number) in regions.regions().iter().zip(0..) {
            for ring in region.polygons.iter().flat_map(|polygon| &polygon.rings) {
                let first = borders.len() as u32;
                let count = ring.len() as u32;
                next.extend((1..=count).map(|i| first + if i == count { 0 } else { i }));
                let pairs = ring.iter().zip(ring.iter().cycle().skip(1));
                borders.extend(pairs.map(|(from, to)| Border { region: number, from, to }));
            }
        }
        let places = map_chunks(borders.len(), PART, |part| {
            let predicates = Predicates::<P>::new(question.points);
            let place = |border: &Border<'_>| predicates.approximate(chart, border.from.point);
            borders[part].iter().map(place).collect::<Vec<_>>()
        })
        .concat();
        let rounding = rounding(&places);
        let around = |(from, next): (&Approximation, &u32)| {
            bounds(&rounding, from).union(&bounds(&rounding, &places[*next as usize]))
        };
        let boxes: Vec<Bounds> = places.iter().zip(&next).map(around).collect();
        Borders { borders, crossings: Crossings::new(&boxes), rounding }
    }

    /// Calls `found` with every side that may have a point in common with the
    /// segment between two points of the image.
    pub(super) fn near(&self, ends: [&Approximation; 2], mut found: impl FnMut(&Border<'r>)) {
        let boxes = ends.map(|end| bounds(&self.rounding, end));
        let all = boxes[0].union(&boxes[1]);
        let is_sharp = |bounds: &Bounds| {
            let held = bounds.low.abs().max(bounds.high.abs()).max_element() <= 1.0;
            held && (bounds.high - bounds.low).truncate().max_element() <= SHARP
        };
        let narrow = |end: &Approximation| [0, 1].map(|i| self.rounding.nearest(i, end.place[i]));
        // What a probe says of strips holds for coordinates of boxes.
        let [start, end] = match boxes.iter().all(is_sharp) {
            true => ends.map(narrow),
            false => [[f32::NAN; 2]; 2],
        };
        let probe = SegmentProbe::new(all, start, end);
        self.crossings.candidates(&probe, |i| found(&self.borders[i as usize]));
    }
}

fn is_known(place: &Approximation) -> bool {
    place.error.is_finite() && place.place.iter().all(|x| x.is_finite())
}

/// A rounding for these points.
fn rounding(places: &[Approximation]) -> Rounding {
    let range = |axis: usize| {
        let known = places.iter().filter(|place| is_known(place)).map(|place| place.place[axis]);
        let ends = known
            .fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], x| [low.min(x), high.max(x)]);
        if ends[0] <= ends[1] { ends[0]..ends[1] } else { 0.0..1.0 }
    };
    Rounding::for_ranges([range(0), range(1), 0.0..0.0])
}

/// A flat box around a point.
fn bounds(rounding: &Rounding, Approximation { place: [x, y], error }: &Approximation) -> Bounds {
    if !is_known(&Approximation { place: [*x, *y], error: *error }) {
        return Bounds::ALL;
    }
    let low = DVec3::new(x - error, y - error, 0.0);
    let high = DVec3::new(x + error, y + error, 0.0);
    rounding.around(low, high)
}
