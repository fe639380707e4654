//! Which regions lie beside a line, on its left and on its right.
//!
//! The line is moved in the image, by infinitely little, to the side that is
//! asked about. A side of a region then crosses it or does not: an end of it
//! that lies on the line counts as lying on the other side. At each crossing a
//! region begins or ends, and as no two overlap, one crossing tells what lies
//! before it or behind it. Crossings that fall together on the line are apart
//! on the line that was moved, and their directions tell their order.
//!
//! A side that nothing crosses has one region all along, or none. If sides of
//! regions run along the line, they tell which; if not, the same lies on the
//! left and on the right, and one place has to be looked up ([`place`]).
//!
//! [`place`]: super::place

use super::borders::Border;
use super::lines::{Line, Worker};
use crate::kernel::numbers::Sign;
use crate::kernel::predicates::{
    Approximation, ImageLine, ImagePoint, Place, Policy, sort_by_predicates,
};
use std::cmp::Ordering;

/// A point of a line's image at which what is seen beside it may change.
#[derive(Debug, Clone, Copy)]
pub(super) struct Stop<'e> {
    pub(super) point: ImagePoint,
    pub(super) about: Approximation,
    /// Its place on the line, where that is known.
    pub(super) place: Option<Place>,
    /// The sides of regions that cross the line there.
    pub(super) meetings: &'e [Meeting],
    /// The region whose face hides the line on one side of the point.
    pub(super) behind: Option<u32>,
}

/// A side of a region near a line.
#[derive(Debug, Clone, Copy)]
pub(super) struct Met<'r> {
    pub(super) border: Border<'r>,
    /// On which sides of the line its ends lie.
    signs: [Sign; 2],
}

/// Where a side of a region crosses a line that was moved to one side.
#[derive(Debug, Clone, Copy)]
pub(super) struct Meeting {
    point: ImagePoint,
    about: Approximation,
    /// The side's line.
    pub(super) line: ImageLine,
    /// The same, directed to the left.
    rise: ImageLine,
    region: u32,
    /// Whether the region begins there; else it ends.
    begins: bool,
}

/// All crossings on one side of a line, in their order.
pub(super) struct Side {
    /// Positive is left.
    side: Sign,
    meetings: Vec<Meeting>,
}

impl<P: Policy> Worker<'_, '_, P> {
    /// The sides of regions that have a point in common with a line's image,
    /// or nearly so.
    pub(super) fn met_borders(&self, line: &Line) -> Vec<Met<'_>> {
        let mut met = Vec::new();
        let ends = line.ends.each_ref().map(|end| &end.about);
        self.borders.near(ends, |border| {
            let side = |point| self.predicates.beside(self.chart, line.image, point);
            let signs = [side(border.from.point), side(border.to.point)];
            if signs[0] != signs[1] || signs[0].is_zero() {
                met.push(Met { border: *border, signs });
            }
        });
        met
    }

    /// What crosses a line that is moved to a side, from its start to its end,
    /// both included.
    pub(super) fn side(&self, line: &Line, side: Sign, met: &[Met<'_>]) -> Side {
        let mut meetings: Vec<Meeting> = Vec::new();
        for Met { border, signs } in met {
            // On the line is on the other side.
            let moved = signs.map(|sign| if sign.is_zero() { -side } else { sign });
            if moved[0] == moved[1] {
                continue;
            }
            let border_line = border.from.line;
            let point = match signs {
                [Sign::Zero, _] => Some(border.from.point),
                [_, Sign::Zero] => Some(border.to.point),
                _ => self.crossing(line.image, border_line),
            };
            let Some(point) = point else { continue };
            let stop = self.stop(point, None);
            let is_before = self.order(line, &stop, &line.ends[0]).is_lt();
            if is_before || self.order(line, &line.ends[1], &stop).is_lt() {
                continue;
            }
            // The region is left of its side, so it ends where that rises.
            let rises = moved[1] == Sign::Positive;
            meetings.push(Meeting {
                point,
                about: stop.about,
                line: border_line,
                rise: if rises { border_line } else { border_line.reversed() },
                region: border.region,
                begins: !rises,
            });
        }
        sort_by_predicates::<P, _>(&mut meetings, |a, b| {
            self.order(line, &stop_of(a), &stop_of(b)).then_with(|| {
                // On the left a line that turns further to the left comes first.
                match self.predicates.bend(self.chart, a.rise, b.rise) * side {
                    Sign::Negative => Ordering::Less,
                    Sign::Zero => Ordering::Equal,
                    Sign::Positive => Ordering::Greater,
                }
            })
        });
        Side { side, meetings }
    }

    /// The region that lies beside a line all along, if one does, where nothing
    /// else tells it; not known if nothing at all meets the line.
    pub(super) fn known_beside(
        &self,
        line: &Line,
        met: &[Met<'_>],
        sides: &[Side; 2],
    ) -> Option<Option<u32>> {
        let is_open = sides.iter().any(|side| side.meetings.is_empty());
        if !is_open || met.iter().any(|met| self.runs_along(line, met)) {
            return Some(None);
        }
        // Nothing runs along the line, so its two sides have the same.
        let other = sides.iter().find(|side| !side.meetings.is_empty())?;
        let parts = self.parts(line, other);
        let first = parts
            .iter()
            .find(|(_, to)| to.is_none_or(|to| self.order(line, &line.ends[0], &to).is_lt()));
        Some(first.and_then(|(region, _)| *region))
    }

    /// Whether a side of a region has more than a point in common with a line.
    fn runs_along(&self, line: &Line, met: &Met<'_>) -> bool {
        if met.signs != [Sign::Zero; 2] {
            return false;
        }
        let mut ends =
            [met.border.from.point, met.border.to.point].map(|point| self.stop(point, None));
        if self.order(line, &ends[1], &ends[0]).is_lt() {
            ends.swap(0, 1);
        }
        self.order(line, &ends[0], &line.ends[1]).is_lt()
            && self.order(line, &line.ends[0], &ends[1]).is_lt()
    }

    /// The regions beside a line from its start on, each with the point at
    /// which it ends; the last ends with the line.
    pub(super) fn regions_beside<'e>(
        &self,
        line: &Line,
        met: &[Met<'_>],
        side: &'e Side,
        located: Option<u32>,
    ) -> Vec<(Option<u32>, Option<Stop<'e>>)> {
        if !side.meetings.is_empty() {
            return self.parts(line, side);
        }
        let mut along = met.iter().filter(|met| self.runs_along(line, met)).peekable();
        if along.peek().is_none() {
            return vec![(located, None)];
        }
        // A region lies left of its sides. One that ends at the line has
        // paper across, or another that ends there too.
        let beside = |met: &&Met<'_>| {
            let ends = [met.border.from.point, met.border.to.point];
            let [from, to] = ends.map(|point| self.stop(point, None));
            let is_left = self.order(line, &from, &to).is_lt();
            is_left == (side.side == Sign::Positive)
        };
        vec![(along.find(beside).map(|met| met.border.region), None)]
    }

    /// The same from crossings, of which there are some.
    fn parts<'e>(&self, line: &Line, side: &'e Side) -> Vec<(Option<u32>, Option<Stop<'e>>)> {
        let is_one = |a: &Meeting, b: &Meeting| self.order(line, &stop_of(a), &stop_of(b)).is_eq();
        let mut parts = Vec::new();
        let mut after = None;
        for meetings in side.meetings.chunk_by(is_one) {
            let stop = Stop { meetings, ..stop_of(&meetings[0]) };
            let [first, last] = [&meetings[0], &meetings[meetings.len() - 1]];
            let with = |one: &Meeting, begins: bool| {
                let same = |other: &&Meeting| {
                    other.begins == begins
                        && self.predicates.bend(self.chart, one.rise, other.rise).is_zero()
                };
                meetings.iter().find(same).map(|meeting| meeting.region)
            };
            let before = if parts.is_empty() { with(first, false) } else { after };
            parts.push((before, Some(stop)));
            after = with(last, true);
        }
        parts.push((after, None));
        parts
    }
}

fn stop_of<'e>(meeting: &Meeting) -> Stop<'e> {
    let Meeting { point, about, .. } = *meeting;
    Stop { point, about, place: None, meetings: &[], behind: None }
}
