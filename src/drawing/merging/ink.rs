//! What is drawn already, and which stretches of a line run along with it.
//!
//! A line runs along with a segment as far as it lies beside it: within its
//! reach across, and between its ends along. What lies beyond an end is not
//! beside it, so lines that follow one another do not cover each other, and a
//! line is cut exactly where one that covers it ends.

use super::SINE;
use super::cells::Cells;
use glam::DVec2;
use rustc_hash::FxHashMap;

/// No node.
pub(super) const NOWHERE: u32 = u32::MAX;

/// A segment as a start, a direction and a length, mm.
#[derive(Debug, Clone, Copy)]
pub(super) struct Ray {
    pub(super) start: DVec2,
    /// Unit vector.
    pub(super) along: DVec2,
    pub(super) length: f64,
}

impl Ray {
    pub(super) fn new([from, to]: [DVec2; 2]) -> Self {
        let length = from.distance(to);
        Ray { start: from, along: (to - from) / length, length }
    }

    pub(super) fn at(&self, place: f64) -> DVec2 {
        self.start + self.along * place
    }
}

/// A part of a line that is drawn.
#[derive(Debug, Clone, Copy)]
pub(super) struct Inked {
    pub(super) ray: Ray,
    /// How far from it nothing else is drawn that runs along with it.
    pub(super) reach: f64,
    /// The path that it is part of, and where it begins on that.
    pub(super) path: u32,
    pub(super) place: f64,
    /// The nodes in which it ends, [`NOWHERE`] where it was cut.
    pub(super) nodes: [u32; 2],
}

/// Why a stretch ends.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Stop {
    /// The line that is covered ends.
    Own,
    /// What covers it ends here.
    Over(DVec2),
    /// They part.
    Aside,
}

/// An end of a stretch.
#[derive(Debug, Clone, Copy)]
pub(super) struct Limit {
    pub(super) stop: Stop,
    /// How far to the left of the line what covers it lies there.
    pub(super) side: f64,
    /// A node of what covers it that lies within its reach.
    pub(super) node: u32,
}

/// A stretch of a line that something drawn runs along with.
#[derive(Debug, Clone, Copy)]
pub(super) struct Cover {
    /// Where it begins and ends.
    pub(super) range: [f64; 2],
    pub(super) limits: [Limit; 2],
    /// What covers it, and between which places of that.
    pub(super) over: Inking,
    /// The reach of that.
    pub(super) reach: f64,
}

/// Lines that are drawn, by the cells that they come near.
pub(super) struct Ink {
    cells: Cells,
    reach: f64,
    /// For each cell the last of its links.
    heads: FxHashMap<[u32; 2], u32>,
    /// Something inked, and the link before in the same cell.
    links: Vec<[u32; 2]>,
    inked: Vec<Inked>,
    /// For each inked part the number of the last question it came up in.
    asked: Vec<u32>,
    question: u32,
}

/// A stretch of something inked.
#[derive(Debug, Clone, Copy)]
pub(super) struct Inking {
    /// Its number.
    pub(super) inked: u32,
    pub(super) range: [f64; 2],
}

impl Ink {
    /// Nothing yet; `reach` is the largest that will come.
    pub(super) fn new(cells: Cells, reach: f64) -> Self {
        Ink {
            cells,
            reach,
            heads: FxHashMap::default(),
            links: Vec::new(),
            inked: Vec::new(),
            asked: Vec::new(),
            question: 0,
        }
    }

    /// The number of the next thing that is drawn.
    pub(super) fn next(&self) -> u32 {
        self.inked.len() as u32
    }

    /// The first thing that was drawn of a path or of those after it.
    pub(super) fn first_of(&self, path: u32) -> u32 {
        self.inked.partition_point(|inked| inked.path < path) as u32
    }

    /// What was drawn.
    pub(super) fn get(&self, number: u32) -> &Inked {
        &self.inked[number as usize]
    }

    /// Draws something.
    pub(super) fn draw(&mut self, inked: Inked) {
        let number = self.inked.len() as u32;
        let ends = [inked.ray.start, inked.ray.at(inked.ray.length)];
        self.cells.near(ends, 0.5 * self.reach, |column, row| {
            let link = self.links.len() as u32;
            let before = self.heads.insert([column, row], link).unwrap_or(NOWHERE);
            self.links.push([number, before]);
        });
        self.inked.push(inked);
        self.asked.push(0);
    }

    /// Appends where a line is covered, shifted by `shift`; by the path `own`
    /// alone, if there is one.
    pub(super) fn cover(
        &mut self,
        ray: &Ray,
        own: Option<u32>,
        shift: f64,
        covers: &mut Vec<Cover>,
    ) {
        self.question += 1;
        let ends = [ray.start, ray.at(ray.length)];
        self.cells.near(ends, 0.5 * self.reach, |column, row| {
            let mut link = self.heads.get(&[column, row]).copied().unwrap_or(NOWHERE);
            while link != NOWHERE {
                let [number, before] = self.links[link as usize];
                link = before;
                if std::mem::replace(&mut self.asked[number as usize], self.question)
                    == self.question
                {
                    continue;
                }
                let inked = &self.inked[number as usize];
                if own.is_none_or(|own| own == inked.path) {
                    covers.extend(beside(ray, inked, number).map(|cover| cover.shifted(shift)));
                }
            }
        });
    }
}

impl Cover {
    fn shifted(self, by: f64) -> Self {
        Cover { range: self.range.map(|place| place + by), ..self }
    }

    /// How much of the stretch after `from` lies within half the reach.
    pub(super) fn close(&self, from: f64) -> f64 {
        let [start, end] = self.range;
        let [first, last] = self.limits.map(|limit| limit.side);
        let at = |place: f64| first + (last - first) * ((place - start) / (end - start));
        let from = from.max(start);
        if end <= from {
            return 0.0;
        }
        // Linear, so what is near is one part.
        let (a, b) = (at(from), last);
        let (low, high) = (a.min(b), a.max(b));
        let half = 0.5 * self.reach;
        if high <= low {
            return if low.abs() < half { end - from } else { 0.0 };
        }
        let share = (high.min(half) - low.max(-half)) / (high - low);
        (end - from) * share.max(0.0)
    }
}

/// Where a line lies beside something drawn.
fn beside(line: &Ray, inked: &Inked, number: u32) -> Option<Cover> {
    let (over, reach) = (&inked.ray, inked.reach);
    let turn = over.along.perp_dot(line.along);
    let pace = over.along.dot(line.along);
    if SINE < turn.abs() {
        return None;
    }
    let offset = line.start - over.start;
    // Along what is drawn, and to its left; both linear along the line.
    let (forward, left) = (over.along.dot(offset), over.along.perp_dot(offset));
    let within = |start: f64, speed: f64, low: f64, high: f64| {
        let (a, b) = ((low - start) / speed, (high - start) / speed);
        [a.min(b), a.max(b)]
    };
    let ends = within(forward, pace, 0.0, over.length);
    let sides = if turn == 0.0 {
        let inside = left.abs() <= reach;
        if inside { [f64::NEG_INFINITY, f64::INFINITY] } else { return None }
    } else {
        within(left, turn, -reach, reach)
    };
    let range = [ends[0].max(sides[0]).max(0.0), ends[1].min(sides[1]).min(line.length)];
    if range[1] - range[0] <= LEAST_PART {
        return None;
    }
    let limit = |end: usize| {
        let place = range[end];
        let stop = if place == ends[end] {
            let begins = (end == 0) == (0.0 < pace);
            Stop::Over(if begins { over.start } else { over.at(over.length) })
        } else if place == sides[end] {
            Stop::Aside
        } else {
            Stop::Own
        };
        // To the left of the line is to the right of what covers it.
        let side = -(left + turn * place) * pace.signum();
        let here = line.at(place);
        let near = |at: DVec2| at.distance(here) <= reach * (1.0 + 1e-9);
        let node = match inked.nodes {
            [first, _] if first != NOWHERE && near(over.start) => first,
            [_, last] if last != NOWHERE && near(over.at(over.length)) => last,
            _ => NOWHERE,
        };
        Limit { stop, side, node }
    };
    let beneath = range.map(|place| forward + pace * place);
    let beneath = [beneath[0].min(beneath[1]), beneath[0].max(beneath[1])];
    let over = Inking { inked: number, range: beneath };
    Some(Cover { range, limits: [limit(0), limit(1)], over, reach })
}

/// Shorter stretches are nothing but rounding, mm.
pub(super) const LEAST_PART: f64 = 1e-9;
