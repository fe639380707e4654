//! Lines that nearly coincide are drawn once.
//!
//! Files hold rounded numbers. Two faces that were laid on one another differ
//! in the last bit, so their edges are two lines, exactly; on paper they are
//! one, drawn twice, and the dashes of one fill the gaps of the other. Which
//! parts of lines are visible is settled; here, in millimetres, of lines that
//! run within a reach of one another one is drawn for the stretch on which
//! they do.
//!
//! 1. `neighbours` tells which pieces have others running along with them.
//!    Most have none and are as they were, bit for bit.
//! 2. `paths` follows those from piece to piece. Paths are of one rank:
//!    visible before hidden, outer outlines first, then by class, as exact
//!    coincidence ranks them; of one rank the nearer one is first.
//! 3. In this order they are drawn (`ink`), and what runs along with
//!    something drawn is left out (`stretches`). Only what is kept
//!    covers, so nothing drifts along a chain of neighbours, and every point
//!    that is left out is within reach of one that is drawn.
//! 4. Where lines were left out, ends that fall together are joined
//!    (`joining`), so that strokes stay whole.
//!
//! What crosses is not cut, however flat, and corners are left as they are:
//! those would be more strokes for no less ink. So is what runs along with
//! others for less than is worth a stroke: 100 reaches, 400 at a corner or
//! where lines weave. Nothing longer is drawn twice. O(n log n) for n pieces, and
//! but one look at most of them.

mod cells;
mod filter;
mod ink;
mod joining;
mod neighbours;
mod paths;
mod stretches;
#[cfg(test)]
mod tests;

use super::layering::LayerPlan;
use super::piece_part::part_of;
use super::placement::Placement;
use super::{DrawingOptions, Join, Window};
use crate::run::{Cancelled, Run, concat_map, map_chunks};
use crate::view::{Crossing, LinePiece, VisibleLines};
use cells::Cells;
use glam::DVec2;
use ink::Ink;
use neighbours::with_neighbours;
use paths::{Net, key};
use std::ops::Range;
use stretches::{Greedy, LeftOut};

pub(super) use joining::{Loose, join_ends};

/// A stretch of fewer reaches is a corner or a crossing.
const LEAST: f64 = 4.0;

/// A stretch of so many reaches is worth a stroke.
const LONG: f64 = 100.0;

/// A corner of so many reaches is, and one of several stretches of a line with
/// less between them.
const LONG_CORNER: f64 = 400.0;

/// The sine of the largest angle between lines that run along one another: any
/// larger, and no stretch is long enough.
const SINE: f64 = 1.0 / LEAST;

/// Pieces that one task puts together.
const PART: usize = 1 << 13;

/// No layer: not drawn.
const UNDRAWN: u32 = u32::MAX;

/// The lines as drawn, and what has to be known of them later.
pub(super) struct Merged {
    pub(super) lines: VisibleLines,
    pub(super) crossings: Vec<Crossing>,
    /// Where ends are to be joined.
    pub(super) loose: Loose,
}

/// Lines on a page, and which of them are drawn.
struct Subject<'a> {
    lines: &'a VisibleLines,
    placement: &'a Placement,
    /// For each piece its place in `plans`, or [`UNDRAWN`].
    plan_of: Vec<u32>,
    plans: &'a [LayerPlan],
    options: &'a DrawingOptions,
}

impl Subject<'_> {
    fn is_drawn(&self, piece: usize) -> bool {
        self.plan_of[piece] != UNDRAWN
    }

    /// A piece on the page.
    #[inline]
    fn segment(&self, piece: usize) -> [DVec2; 2] {
        self.lines.pieces[piece].points.map(|point| self.placement.apply(point))
    }

    /// Where an end lies; ends of piece i are 2 i and 2 i + 1.
    #[inline]
    fn end(&self, end: u32) -> DVec2 {
        self.placement.apply(self.lines.pieces[(end / 2) as usize].points[(end % 2) as usize])
    }

    fn plan(&self, piece: usize) -> &LayerPlan {
        &self.plans[self.plan_of[piece] as usize]
    }

    /// Which strokes a piece may be part of.
    fn layer(&self, piece: usize) -> u32 {
        let class = match self.options.join {
            Join::All => 0,
            Join::Class => self.lines.pieces[piece].class as u32,
        };
        16 * self.plan_of[piece] + class
    }

    /// Level, outline and class: the lesser is drawn.
    fn kind(&self, piece: usize) -> [u32; 3] {
        let LinePiece { outline, class, .. } = self.lines.pieces[piece];
        [self.plan(piece).tags.level, u32::from(!outline), class as u32]
    }

    /// The reach of a piece that is drawn, mm, without what its ends may be
    /// moved over later.
    fn reach(&self, piece: usize) -> f64 {
        self.options.reach_of(self.plan(piece).look.width) * (1.0 - joining::MOVED)
    }
}

impl DrawingOptions {
    /// The reach of lines drawn with a pen, mm.
    fn reach_of(&self, pen: f64) -> f64 {
        match self.merge {
            Some(reach) => reach.millimetres(),
            None => LEAST_REACH.max(PEN_SHARE * pen),
        }
    }
}

/// The least reach unless one is asked for, mm.
const LEAST_REACH: f64 = 0.02;

/// The share of a pen's width that is its reach.
const PEN_SHARE: f64 = 0.1;

/// Leaves out what runs along with something else, if there is any such
/// thing. `plans` say what is drawn of the lines; what lies outside of the
/// window is not looked at.
///
/// # Errors
///
/// If the run is cancelled.
pub(super) fn merge(
    lines: &VisibleLines,
    crossings: &[Crossing],
    plans: &[LayerPlan],
    placement: &Placement,
    options: &DrawingOptions,
    run: &Run<'_>,
) -> Result<Option<Merged>, Cancelled> {
    let reaches = plans.iter().map(|plan| options.reach_of(plan.look.width));
    let reach = reaches.fold(0.0, f64::max);
    if reach == 0.0 {
        return Ok(None);
    }
    let mut plan_of = vec![UNDRAWN; lines.pieces.len()];
    for (number, plan) in (0..).zip(plans) {
        plan.pieces.iter().for_each(|&piece| plan_of[piece as usize] = number);
    }
    let subject = Subject { lines, placement, plan_of, plans, options };
    let window = options.window_in(&lines.frame);
    let window = window.map(|window| on_page(&window, placement, reach));
    let place = |piece: usize| {
        let segment = subject.is_drawn(piece).then(|| subject.segment(piece))?;
        let segment = match &window {
            Some(window) => super::cropping::clip_segment(segment, window)?,
            None => segment,
        };
        (segment[0] != segment[1]).then_some(segment)
    };
    let chosen = with_neighbours(lines.pieces.len(), place, reach);
    run.check()?;
    if chosen.is_empty() {
        return Ok(None);
    }
    let net = Net::new(&subject, &chosen);
    run.check()?;
    let LeftOut { mut parts, mut loose } =
        Greedy::draw(&subject, &chosen, net, Ink::new(cells(&subject, &chosen, reach), reach));
    run.check()?;
    if parts.is_empty() {
        return Ok(None);
    }
    parts.iter_mut().for_each(|(place, _)| *place = chosen[*place as usize]);
    parts.sort_unstable_by(|a, b| a.0.cmp(&b.0).then(a.1[0].total_cmp(&b.1[0])));
    let kept = Kept::new(lines, &parts);
    loose.extend(kept.cuts().map(|point| placement.apply(point)));
    Ok(Some(Merged {
        crossings: crossings.iter().filter_map(|crossing| kept.crossing(lines, crossing)).collect(),
        loose: Loose::new(loose, reach),
        lines: kept.lines,
    }))
}

/// A window on the page, and something around it.
fn on_page(window: &Window, placement: &Placement, around: f64) -> Window {
    let corners = [window.low(), window.high()].map(|corner| placement.apply(corner));
    let (low, high) = (corners[0].min(corners[1]), corners[0].max(corners[1]));
    let wider = Window::new(low - around, high + around);
    wider.unwrap_or(*window)
}

/// Cells for some pieces.
fn cells(subject: &Subject<'_>, chosen: &[u32], reach: f64) -> Cells {
    let segments = || chosen.iter().map(|&piece| subject.segment(piece as usize));
    let (mut low, mut high) = (DVec2::INFINITY, DVec2::NEG_INFINITY);
    let mut length = 0.0;
    for [a, b] in segments() {
        (low, high) = (low.min(a.min(b)), high.max(a.max(b)));
        length += a.distance(b);
    }
    Cells::new(low, high, (length / chosen.len() as f64).max(4.0 * reach))
}

/// What is left of lines.
struct Kept {
    lines: VisibleLines,
    /// Where the parts of each piece begin, and where the last one's end.
    starts: Vec<u32>,
    /// For each part which shares of its piece it is.
    ranges: Vec<[f64; 2]>,
}

impl Kept {
    /// Leaves out parts, sorted by piece and place.
    fn new(lines: &VisibleLines, left_out: &[(u32, [f64; 2])]) -> Self {
        let chunks = map_chunks(lines.pieces.len(), PART, |part| {
            let mut found = (Vec::with_capacity(part.len()), Vec::new(), Vec::new());
            rest_of(lines, part, left_out, &mut found);
            found
        });
        let mut starts = vec![0];
        let mut first = 0;
        for (pieces, counts, _) in &chunks {
            for count in counts {
                first += count;
                starts.push(first);
            }
            debug_assert!(pieces.len() <= first as usize);
        }
        let pieces: Vec<&[LinePiece]> = chunks.iter().map(|chunk| &chunk.0[..]).collect();
        let ranges: Vec<&[[f64; 2]]> = chunks.iter().map(|chunk| &chunk.2[..]).collect();
        let (objects, counters) = (lines.objects.clone(), lines.counters.clone());
        let pieces = concat_map(&pieces, |_, piece| *piece);
        Kept {
            lines: VisibleLines { frame: lines.frame, objects, pieces, counters },
            starts,
            ranges: concat_map(&ranges, |_, range| *range),
        }
    }

    /// Where pieces were cut, in the picture.
    fn cuts(&self) -> impl Iterator<Item = DVec2> {
        let parts = self.lines.pieces.iter().zip(&self.ranges);
        parts.flat_map(|(piece, range)| {
            let start = (0.0 < range[0]).then_some(piece.points[0]);
            let end = (range[1] < 1.0).then_some(piece.points[1]);
            [start, end].into_iter().flatten()
        })
    }

    /// The crossing between the parts on which it lies, if it does.
    fn crossing(&self, lines: &VisibleLines, crossing: &Crossing) -> Option<Crossing> {
        let [near, far] =
            [crossing.near, crossing.far].map(|piece| lines.pieces[piece as usize].points);
        let (along, across) = (far[1] - far[0], near[1] - near[0]);
        let turn = across.perp_dot(along);
        let place = |piece: u32, place: f64| {
            let parts = self.starts[piece as usize]..self.starts[piece as usize + 1];
            let place = if place.is_nan() { 0.5 } else { place.clamp(0.0, 1.0) };
            let holds = |range: &[f64; 2]| range[0] <= place && place <= range[1];
            parts.into_iter().find(|&part| holds(&self.ranges[part as usize]))
        };
        let offset = near[0] - far[0];
        let on_far = across.perp_dot(offset) / turn;
        let on_near = along.perp_dot(offset) / turn;
        Some(Crossing { near: place(crossing.near, on_near)?, far: place(crossing.far, on_far)? })
    }
}

/// Appends what is left of some pieces, how many parts each has, and which.
fn rest_of(
    lines: &VisibleLines,
    part: Range<usize>,
    left_out: &[(u32, [f64; 2])],
    (pieces, counts, ranges): &mut (Vec<LinePiece>, Vec<u32>, Vec<[f64; 2]>),
) {
    let mut rest = &left_out[left_out.partition_point(|left| (left.0 as usize) < part.start)..];
    for index in part {
        let piece = &lines.pieces[index];
        let count = rest.iter().take_while(|left| left.0 as usize == index).count();
        let (own, others) = rest.split_at(count);
        rest = others;
        let before = pieces.len();
        let mut at = 0.0;
        let ends = own.iter().map(|left| left.1).chain([[1.0, 1.0]]);
        for [from, to] in ends {
            if at < from {
                let range = [at, from];
                let part = if range == [0.0, 1.0] {
                    *piece
                } else {
                    part_of(piece, range, lines.frame.projection)
                };
                pieces.push(part);
                ranges.push(range);
            }
            at = to.max(at);
        }
        counts.push((pieces.len() - before) as u32);
    }
}
