//! Which stretches of a line are not drawn, because others that are run along
//! with them.
//!
//! A stretch runs on over the joints of its line and of what covers it. What
//! becomes of it is a matter of its two ends:
//!
//! ```text
//!   ===========      the whole of it, or up to where what covers it ends:
//!     -----          left out
//!
//!   ====\  /===      from one side to the other, steadily: a crossing, kept
//!        \/
//!        /\
//!
//!   ===========      from a corner to where they part: left out if a stroke
//!   \__              ends in the corner anyway, or if the stretch is long
//!      \__
//! ```
//!
//! Shorter ones than [`LEAST`] reaches are corners and crossings, and kept.

use super::ink::{Cover, Ink, Inked, Inking, LEAST_PART, Limit, NOWHERE, Ray, Stop};
use super::paths::{Net, Node, Path};
use super::{LEAST, LONG, LONG_CORNER, Subject};
use glam::DVec2;
use rustc_hash::FxHashMap;

/// A part of a path that something drawn runs along with.
#[derive(Debug, Clone, Copy)]
struct Stretch {
    range: [f64; 2],
    limits: [Limit; 2],
    reach: f64,
    /// How much of it lies within half the reach.
    close: f64,
}

/// What becomes of a stretch.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Verdict {
    Kept,
    LeftOut,
    /// Left out if there are strokes to spare.
    Later,
}

/// An end of a stretch.
#[derive(Debug, Clone, Copy)]
enum End {
    /// A node of the line.
    Node {
        node: u32,
        /// Whether the line goes on there.
        goes_on: bool,
    },
    /// In the midst of a piece.
    Cut,
}

/// A path, measured by length.
struct Track {
    path: u32,
    rays: Vec<Ray>,
    /// Length from the beginning to the start of each piece and to the end.
    starts: Vec<f64>,
    reaches: Vec<f64>,
    layers: Vec<u32>,
    /// Nodes at the ends of each piece.
    nodes: Vec<[u32; 2]>,
    closed: bool,
    goes_on: [bool; 2],
}

/// What is not drawn.
#[derive(Debug, Default)]
pub(super) struct LeftOut {
    /// A piece, by its place among those with neighbours, and between which
    /// shares of it, from 0 to 1, in no order.
    pub(super) parts: Vec<(u32, [f64; 2])>,
    /// Points at which ends may be joined anew.
    pub(super) loose: Vec<DVec2>,
}

/// Draws path after path, and leaves out what runs along with what is drawn.
pub(super) struct Greedy<'a> {
    subject: &'a Subject<'a>,
    chosen: &'a [u32],
    nodes: Vec<Node>,
    node_of: Vec<u32>,
    ink: Ink,
    paths: Vec<Path>,
    covers: Vec<Cover>,
    left_out: LeftOut,
    /// What must stay, for something else was left out beside it.
    needed: FxHashMap<u32, Vec<[f64; 2]>>,
    /// Stretches that would make more strokes.
    later: Vec<Later>,
    /// How many ends of strokes there are less, or more, than before.
    gain: i32,
}

/// A stretch that may be left out if there are strokes to spare.
struct Later {
    path: u32,
    stretch: Stretch,
    covers: Vec<Inking>,
}

impl<'a> Greedy<'a> {
    /// Draws all paths of a net.
    pub(super) fn draw(subject: &'a Subject<'a>, chosen: &'a [u32], net: Net, ink: Ink) -> LeftOut {
        let Net { nodes, node_of, paths } = net;
        let mut greedy = Greedy {
            subject,
            chosen,
            nodes,
            node_of,
            ink,
            paths: Vec::new(),
            covers: Vec::new(),
            left_out: LeftOut::default(),
            needed: FxHashMap::default(),
            later: Vec::new(),
            gain: 0,
        };
        for (number, path) in (0..).zip(&paths) {
            greedy.draw_path(number, path);
        }
        greedy.paths = paths;
        greedy.spend();
        greedy.left_out
    }

    /// Leaves out more, the longest first, as long as there are no more
    /// strokes than before.
    fn spend(&mut self) {
        let mut later = std::mem::take(&mut self.later);
        let length = |later: &Later| later.stretch.range[1] - later.stretch.range[0];
        later.sort_by(|a, b| length(b).total_cmp(&length(a)));
        let mut removed: FxHashMap<u32, Vec<[f64; 2]>> = FxHashMap::default();
        for Later { path, stretch, covers } in later {
            let meets = |ranges: &[[f64; 2]], range: [f64; 2]| {
                ranges.iter().any(|&other| overlap(other, range))
            };
            let free = |map: &FxHashMap<u32, Vec<[f64; 2]>>, inking: &Inking| {
                !map.get(&inking.inked).is_some_and(|ranges| meets(ranges, inking.range))
            };
            let own = self.inkings(path, stretch.range);
            let free = own.iter().all(|inking| free(&self.needed, inking))
                && covers.iter().all(|inking| free(&removed, inking));
            if !free {
                continue;
            }
            let track = self.track(path, &self.paths[path as usize]);
            let ends = track.ends(&stretch);
            let layers = [0, 1].map(|side| track.layer(stretch.range[side], side));
            let gain = self.gains(&stretch, &ends, &layers);
            if self.gain + gain <= 0 || gain <= 0 {
                self.take_out(&track, &stretch, &ends, &layers);
                self.gain += gain;
                self.need(&covers);
                for inking in own {
                    removed.entry(inking.inked).or_default().push(inking.range);
                }
                let total = track.length();
                let [from, to] = stretch.range;
                let parts = if total < to {
                    vec![[from, total], [0.0, to - total]]
                } else {
                    vec![[from, to]]
                };
                let path = self.paths[path as usize].clone();
                self.note(&track, &path, &parts);
            }
        }
    }

    /// What is inked of a stretch of a path.
    fn inkings(&self, path: u32, [from, to]: [f64; 2]) -> Vec<Inking> {
        let mut found = Vec::new();
        for number in self.ink.first_of(path)..self.ink.next() {
            let inked = self.ink.get(number);
            if inked.path != path {
                break;
            }
            let range = [(from - inked.place).max(0.0), (to - inked.place).min(inked.ray.length)];
            if range[0] < range[1] {
                found.push(Inking { inked: number, range });
            }
        }
        found
    }

    fn need(&mut self, covers: &[Inking]) {
        for cover in covers {
            self.needed.entry(cover.inked).or_default().push(cover.range);
        }
    }

    fn gains(&self, stretch: &Stretch, ends: &[End; 2], layers: &[u32; 2]) -> i32 {
        let gain = |side: usize| self.gain(ends[side], stretch.limits[side].node, layers[side]);
        gain(0) + gain(1)
    }

    fn draw_path(&mut self, number: u32, path: &Path) {
        let track = self.track(number, path);
        let mut covers = std::mem::take(&mut self.covers);
        covers.clear();
        for (ray, &start) in track.rays.iter().zip(&track.starts) {
            self.ink.cover(ray, None, start, &mut covers);
        }
        let mut left_out: Vec<[f64; 2]> = Vec::new();
        if !covers.is_empty() {
            self.leave_out(&track, &mut covers, &mut left_out);
        }
        self.draw_rest(&track, &mut covers, &mut left_out);
        self.covers = covers;
        self.note(&track, path, &left_out);
    }

    fn track(&self, number: u32, path: &Path) -> Track {
        let count = path.steps.len();
        let mut track = Track {
            path: number,
            rays: Vec::with_capacity(count),
            starts: Vec::with_capacity(count + 1),
            reaches: Vec::with_capacity(count),
            layers: Vec::with_capacity(count),
            nodes: Vec::with_capacity(count),
            closed: path.closed,
            goes_on: path.goes_on,
        };
        let mut length = 0.0;
        for step in &path.steps {
            let piece = self.chosen[step.piece as usize] as usize;
            let [a, b] = self.subject.segment(piece);
            let nodes = [0, 1].map(|end| self.node_of[2 * step.piece as usize + end]);
            let ray = Ray::new(if step.back { [b, a] } else { [a, b] });
            track.starts.push(length);
            length += ray.length;
            track.rays.push(ray);
            track.reaches.push(self.subject.reach(piece));
            track.layers.push(self.subject.layer(piece));
            track.nodes.push(if step.back { [nodes[1], nodes[0]] } else { nodes });
        }
        track.starts.push(length);
        track
    }

    /// Decides about the stretches that some covers make, and appends those
    /// that are left out.
    fn leave_out(&mut self, track: &Track, covers: &mut [Cover], left_out: &mut Vec<[f64; 2]>) {
        covers.sort_unstable_by(|a, b| {
            let by = |end: usize| a.range[end].total_cmp(&b.range[end]);
            by(0).then_with(|| by(1)).then_with(|| a.limits[0].side.total_cmp(&b.limits[0].side))
        });
        let stretches = track.stretches(covers);
        let weaves = track.weaving(&stretches);
        for (&stretch, weaves) in stretches.iter().zip(weaves) {
            let within = |cover: &&Cover| {
                let around = stretch.range.map(|place| place - track.length());
                overlap(cover.range, stretch.range) || overlap(cover.range, around)
            };
            let beneath =
                || covers.iter().filter(within).map(|cover| cover.over).collect::<Vec<_>>();
            let verdict = self.decide(track, &stretch, weaves);
            match verdict {
                Verdict::Kept => continue,
                Verdict::LeftOut => self.need(&beneath()),
                Verdict::Later => {
                    self.later.push(Later { path: track.path, stretch, covers: beneath() });
                    continue;
                }
            }
            let total = track.length();
            let [from, to] = stretch.range;
            if total < to {
                // Over the seam of a closed path.
                left_out.extend([[from, total], [0.0, to - total]]);
            } else {
                left_out.push(stretch.range);
            }
        }
    }

    /// Whether a stretch is left out; if so, ends are counted anew.
    fn decide(&mut self, track: &Track, stretch: &Stretch, weaves: bool) -> Verdict {
        let [from, to] = stretch.range;
        let length = to - from;
        if track.closed && track.length() <= length {
            for nodes in &track.nodes {
                nodes.iter().for_each(|&node| self.nodes[node as usize].degree -= 1);
            }
            self.left_out.loose.extend(track.rays.iter().map(|ray| ray.start));
            let alone =
                |nodes: &[u32; 2]| nodes.iter().all(|&node| self.nodes[node as usize].degree == 0);
            if track.nodes.iter().all(alone) {
                // A stroke of its own.
                self.gain -= 2;
            }
            return Verdict::LeftOut;
        }
        let ends = track.ends(stretch);
        let layers = [0, 1].map(|side| track.layer(stretch.range[side], side));
        let gain = self.gains(stretch, &ends, &layers);
        let dead = |end: &End| matches!(end, End::Node { goes_on: false, .. });
        let whole = !track.closed && from <= 0.0 && track.length() <= to && ends.iter().all(dead);
        let is_corner = [0, 1]
            .iter()
            .any(|&side| dead(&ends[side]) && matches!(stretch.limits[1 - side].stop, Stop::Aside));
        let reaches = length / stretch.reach;
        let long = if is_corner || weaves { LONG_CORNER } else { LONG };
        let worth_a_stroke = long <= reaches;
        let verdict = if whole && gain <= 0 {
            Verdict::LeftOut
        } else if reaches < LEAST || !whole && track.crosses(stretch, &ends) {
            Verdict::Kept
        } else if gain <= 0 || worth_a_stroke {
            Verdict::LeftOut
        } else {
            Verdict::Later
        };
        if verdict == Verdict::LeftOut {
            self.take_out(track, stretch, &ends, &layers);
            self.gain += gain;
        }
        verdict
    }

    /// How many more ends of strokes there are if a line ends here that went
    /// on, or the other way round.
    fn gain(&self, end: End, other: u32, layer: u32) -> i32 {
        let joins = |own: u32| {
            other != NOWHERE && other != own && {
                let other = &self.nodes[other as usize];
                other.layer == layer && other.is_odd()
            }
        };
        match end {
            End::Node { node, .. } if self.nodes[node as usize].is_odd() => -1,
            End::Node { node, .. } if joins(node) => -1,
            End::Cut if joins(NOWHERE) => -1,
            _ => 1,
        }
    }

    /// Counts ends anew where a stretch is left out.
    fn take_out(&mut self, track: &Track, stretch: &Stretch, ends: &[End; 2], layers: &[u32; 2]) {
        for side in 0..2 {
            let other = stretch.limits[side].node;
            let joins = {
                let at = |node: u32| &self.nodes[node as usize];
                let own = match ends[side] {
                    End::Node { node, .. } => node,
                    End::Cut => NOWHERE,
                };
                let odd = own != NOWHERE && at(own).is_odd();
                !odd && other != NOWHERE
                    && other != own
                    && at(other).layer == layers[side]
                    && at(other).is_odd()
            };
            if joins {
                self.nodes[other as usize].degree += 1;
                if let End::Node { node, .. } = ends[side] {
                    self.nodes[node as usize].degree += 1;
                }
            }
            if other != NOWHERE {
                self.left_out.loose.push(self.nodes[other as usize].point);
            }
            if let End::Node { node, .. } = ends[side] {
                self.left_out.loose.push(self.nodes[node as usize].point);
            }
        }
        let total = track.length();
        for index in 0..track.rays.len() {
            for (end, place) in [(0, track.starts[index]), (1, track.starts[index + 1])] {
                let [from, to] = stretch.range;
                let within = |place: f64| {
                    if end == 0 { from <= place && place < to } else { from < place && place <= to }
                };
                if within(place) || within(place + total) {
                    let node = track.nodes[index][end];
                    self.nodes[node as usize].degree -= 1;
                }
            }
        }
    }

    /// Draws what is left of a path piece by piece, and leaves out what runs
    /// along with an earlier part of the path itself.
    fn draw_rest(&mut self, track: &Track, covers: &mut Vec<Cover>, left_out: &mut Vec<[f64; 2]>) {
        left_out.sort_unstable_by(|a, b| a[0].total_cmp(&b[0]));
        let first = left_out.clone();
        covers.clear();
        // Pieces up to `begin` are drawn; those after it are not yet.
        let mut begin = 0;
        for index in 0..track.rays.len() {
            let mut runs_on = false;
            if 1 < track.rays.len() {
                for [from, to] in track.rest(index, &first) {
                    let ray = track.rays[index];
                    let part = Ray { start: ray.at(from), length: to - from, ..ray };
                    let before = covers.len();
                    self.ink.cover(&part, Some(track.path), track.starts[index] + from, covers);
                    let end = track.starts[index + 1];
                    runs_on |= covers[before..].iter().any(|cover| end <= cover.range[1]);
                }
            }
            if runs_on && index + 1 < track.rays.len() {
                continue;
            }
            if !covers.is_empty() {
                self.leave_out(track, covers, left_out);
                covers.clear();
                left_out.sort_unstable_by(|a, b| a[0].total_cmp(&b[0]));
            }
            for piece in begin..=index {
                self.draw_piece(track, piece, left_out);
            }
            begin = index + 1;
        }
    }

    fn draw_piece(&mut self, track: &Track, index: usize, left_out: &[[f64; 2]]) {
        let ray = track.rays[index];
        for [from, to] in track.rest(index, left_out) {
            let [first, last] = track.nodes[index];
            let nodes = [
                if from == 0.0 { first } else { NOWHERE },
                if to == ray.length { last } else { NOWHERE },
            ];
            let part = Ray { start: ray.at(from), length: to - from, ..ray };
            let reach = track.reaches[index];
            let place = track.starts[index] + from;
            self.ink.draw(Inked { ray: part, reach, path: track.path, place, nodes });
        }
    }

    /// Notes what is left out of the pieces of a path.
    fn note(&mut self, track: &Track, path: &Path, left_out: &[[f64; 2]]) {
        for &[from, to] in left_out {
            let first = track.starts.partition_point(|&start| start <= from).max(1) - 1;
            for index in first..track.rays.len() {
                let (start, end) = (track.starts[index], track.starts[index + 1]);
                if to <= start {
                    break;
                }
                let length = track.rays[index].length;
                let share = |place: f64| ((place - start) / length).clamp(0.0, 1.0);
                let range = [
                    if from <= start { 0.0 } else { share(from) },
                    if end <= to { 1.0 } else { share(to) },
                ];
                let step = &path.steps[index];
                let range = if step.back { [1.0 - range[1], 1.0 - range[0]] } else { range };
                if range[0] < range[1] {
                    self.left_out.parts.push((step.piece, range));
                }
            }
        }
    }
}

impl Track {
    fn length(&self) -> f64 {
        self.starts[self.rays.len()]
    }

    /// The piece in which a place lies; where two meet, the one before it for
    /// the end of a stretch, the one after it for its beginning.
    fn piece_at(&self, place: f64, side: usize) -> usize {
        let place = if self.length() < place { place - self.length() } else { place };
        let after = match side {
            0 => self.starts.partition_point(|&start| start <= place),
            _ => self.starts.partition_point(|&start| start < place),
        };
        after.clamp(1, self.rays.len()) - 1
    }

    fn at(&self, place: f64) -> DVec2 {
        let place = if self.length() < place { place - self.length() } else { place };
        let piece = self.piece_at(place, 0);
        self.rays[piece].at(place - self.starts[piece])
    }

    fn layer(&self, place: f64, side: usize) -> u32 {
        self.layers[self.piece_at(place, side)]
    }

    /// The end of a stretch that begins (`side` 0) or ends (1) here.
    fn end(&self, place: f64, side: usize) -> End {
        let piece = self.piece_at(place, side);
        let within = if self.length() < place { place - self.length() } else { place };
        let goes_on = |node: u32| {
            let at_border = match side {
                0 => piece == 0,
                _ => piece + 1 == self.rays.len(),
            };
            End::Node { node, goes_on: self.closed || !at_border || self.goes_on[side] }
        };
        if within == self.starts[piece + side] {
            goes_on(self.nodes[piece][side])
        } else {
            End::Cut
        }
    }

    fn ends(&self, stretch: &Stretch) -> [End; 2] {
        [0, 1].map(|side| self.end(stretch.range[side], side))
    }

    /// For each of some stretches whether it weaves with the one before it or
    /// after it: what would be left between the two is shorter than the longer
    /// of them. Crossings and what is too short to be left out do not count.
    fn weaving(&self, stretches: &[Stretch]) -> Vec<bool> {
        let length = |a: &Stretch| a.range[1] - a.range[0];
        let counts = |a: &Stretch| LEAST * a.reach <= length(a) && !self.crosses(a, &self.ends(a));
        let counted: Vec<usize> = (0..stretches.len()).filter(|&i| counts(&stretches[i])).collect();
        let mut weaves = vec![false; stretches.len()];
        for pair in counted.windows(2) {
            let [a, b] = [&stretches[pair[0]], &stretches[pair[1]]];
            if b.range[0] - a.range[1] < length(a).max(length(b)) {
                pair.iter().for_each(|&i| weaves[i] = true);
            }
        }
        weaves
    }

    /// The parts of a piece that are left, from its start.
    fn rest(&self, index: usize, left_out: &[[f64; 2]]) -> Vec<[f64; 2]> {
        let (start, end) = (self.starts[index], self.starts[index + 1]);
        let mut rest = Vec::new();
        let mut at = start;
        let first = left_out.partition_point(|range| range[1] <= start);
        for range in left_out[first..].iter().take_while(|range| range[0] < end) {
            if at < range[0] {
                rest.push([at - start, range[0] - start]);
            }
            at = at.max(range[1]);
        }
        if at < end {
            let length = self.rays[index].length;
            rest.push([if at == start { 0.0 } else { at - start }, length]);
        }
        rest
    }

    /// Unites covers, sorted by where they begin, to stretches.
    fn stretches(&self, covers: &[Cover]) -> Vec<Stretch> {
        let mut stretches: Vec<Stretch> = Vec::new();
        for cover in covers {
            let own = |close: f64| Stretch {
                range: cover.range,
                limits: cover.limits,
                reach: cover.reach,
                close,
            };
            match stretches.last_mut() {
                Some(last) if self.runs_on(last, cover) => {
                    if last.range[1] < cover.range[1] {
                        last.close += cover.close(last.range[1]);
                        last.range[1] = cover.range[1];
                        last.limits[1] = cover.limits[1];
                    } else if last.range[1] == cover.range[1] && last.limits[1].node == NOWHERE {
                        last.limits[1].node = cover.limits[1].node;
                    }
                    if cover.range[0] == last.range[0] && last.limits[0].node == NOWHERE {
                        last.limits[0].node = cover.limits[0].node;
                    }
                    last.reach = last.reach.max(cover.reach);
                }
                _ => stretches.push(own(cover.close(cover.range[0]))),
            }
        }
        let total = self.length();
        if !self.closed {
            self.take_in_ends(&mut stretches);
        } else if let [first, .., last] = &mut stretches[..]
            && first.range[0] <= 0.0
            && total <= last.range[1]
        {
            last.range[1] = total + first.range[1];
            last.limits[1] = first.limits[1];
            last.close += first.close;
            last.reach = last.reach.max(first.reach);
            stretches.remove(0);
        }
        stretches
    }

    /// Whether a cover goes on from a stretch, perhaps over a gap that is
    /// within reach of the ends beside it.
    fn runs_on(&self, stretch: &Stretch, cover: &Cover) -> bool {
        let (from, to) = (stretch.range[1], cover.range[0]);
        if to <= from {
            return true;
        }
        let reach = stretch.reach.min(cover.reach);
        if 2.0 * reach < to - from {
            return false;
        }
        let stops = [stretch.limits[1].stop, cover.limits[0].stop];
        let near = |place: f64| {
            let point = self.at(place);
            stops.iter().any(|stop| matches!(stop, Stop::Over(end) if end.distance(point) <= reach))
        };
        near(from) && near(0.5 * from + 0.5 * to) && near(to)
    }

    /// Stretches that end within reach of the end of the path are taken to
    /// end there, if nothing goes on from it.
    fn take_in_ends(&self, stretches: &mut [Stretch]) {
        let total = self.length();
        if let Some(first) = stretches.first_mut()
            && self.is_stub(first, 0.0, 0)
        {
            first.range[0] = 0.0;
        }
        if let Some(last) = stretches.last_mut()
            && self.is_stub(last, total, 1)
        {
            last.range[1] = total;
        }
    }

    /// Whether what is left of the path beyond an end of a stretch is next to
    /// nothing.
    fn is_stub(&self, stretch: &Stretch, border: f64, side: usize) -> bool {
        let place = stretch.range[side];
        let Stop::Over(end) = stretch.limits[side].stop else { return false };
        let most = if self.goes_on[side] { STUB * stretch.reach } else { 2.0 * stretch.reach };
        let near = |place: f64| self.at(place).distance(end) <= stretch.reach;
        place != border
            && (place - border).abs() <= most
            && near(border)
            && near(0.5 * place + 0.5 * border)
    }

    /// Whether a stretch passes from one side of what covers it to the other,
    /// steadily: so that half of it, about, is within half the reach.
    fn crosses(&self, stretch: &Stretch, ends: &[End; 2]) -> bool {
        let parts = |side: usize| match (stretch.limits[side].stop, ends[side]) {
            (Stop::Aside, _) => true,
            (Stop::Own, End::Node { goes_on, .. }) => goes_on,
            _ => false,
        };
        let [first, last] = stretch.limits.map(|limit| limit.side);
        let share = stretch.close / (stretch.range[1] - stretch.range[0]);
        parts(0) && parts(1) && first * last < 0.0 && (0.25..=0.75).contains(&share)
    }
}

/// Whether ranges have more in common than rounding.
fn overlap(one: [f64; 2], other: [f64; 2]) -> bool {
    one[0] + LEAST_PART < other[1] && other[0] + LEAST_PART < one[1]
}

/// What is left of a path that goes on and is shorter than this part of the
/// reach is nothing.
const STUB: f64 = 0.01;
