//! Takes sides of cells one by one, holds them against both horizons and
//! keeps what is found of those that are drawn.

use super::breaks::{Break, Questions, Segment};
use super::horizon::Horizon;
use super::order::Step;
use super::tracks::{State, Track, merge};
use crate::kernel::numbers::Sign;
use crate::kernel::predicates::{Carrier, Cut, Place, Point, Policy};
use crate::run::Run;
use crate::view::{ExactLines, ExactPiece, SurfaceQuestion};
use std::cmp::Ordering;

/// The state of the work.
pub(super) struct Walker<'q, P: Policy> {
    question: &'q SurfaceQuestion<'q>,
    questions: Questions<'q, P>,
    upper: Horizon,
    lower: Horizon,
    pieces: Vec<ExactPiece>,
    /// For each line where its pieces begin and end.
    spans: Vec<[u32; 2]>,
    /// What a segment is to the upper and the lower horizon, on the left
    /// and on the right where that is not one.
    tracks: [Track; 4],
    near: Track,
    segments: u64,
}

impl<'q, P: Policy> Walker<'q, P> {
    pub(super) fn new(question: &'q SurfaceQuestion<'q>) -> Self {
        Walker {
            question,
            questions: Questions::new(question.lines.points),
            upper: Horizon::new(Sign::Positive),
            lower: Horizon::new(Sign::Negative),
            pieces: Vec::new(),
            spans: vec![[0; 2]; question.lines.lines.len()],
            tracks: Default::default(),
            near: Track::default(),
            segments: 0,
        }
    }

    /// Adds one step.
    pub(super) fn take(&mut self, step: Step) {
        let (surface, curves) = (self.question.surface, self.question.curves);
        match step {
            Step::Cell([a, b]) => {
                self.segment([a, b], curves.line([a.min(b), a.max(b)]), [true; 2]);
            }
            Step::Base(side, place) => {
                let ends = [place, place + 1].map(|place| {
                    let [i, j] = surface.place_on_side(side, place);
                    surface.base_vertex(i, j)
                });
                // Upright, it lies in a wall that is seen from its edge. Over
                // it in its column is the surface's border, which no horizon
                // has: beyond that it is nowhere.
                let below = surface.has_base_below();
                self.segment(ends, curves.base_line(side, place), [!below, below]);
            }
            Step::BaseCorner(corner) => {
                let [i, j] = surface.corner(corner);
                let ends = [surface.vertex(i, j), surface.base_vertex(i, j)];
                self.segment(ends, curves.base_corner(corner), [true; 2]);
            }
            Step::RowDone => {}
        }
    }

    /// All pieces by lines.
    pub(super) fn finish(self, run: &Run<'_>) -> ExactLines {
        run.merge(&self.questions.predicates.counters());
        run.count("horizon-segments", self.segments);
        run.count("horizon-pieces", self.upper.most().max(self.lower.most()) as u64);
        let mut answer = ExactLines::default();
        for [from, to] in self.spans {
            answer.push_line(self.pieces[from as usize..to as usize].iter().copied());
        }
        answer
    }

    /// Adds the segment between two vertices, which is this line if it is
    /// drawn. If it is upright, it may be seen beyond these of the upper and the
    /// lower horizon.
    fn segment(&mut self, [a, b]: [u32; 2], line: Option<u32>, upright_beyond: [bool; 2]) {
        self.segments += 1;
        let first = self.pieces.len();
        let ends = match self.questions.compare(Break::Vertex(a), b) {
            Ordering::Less => self.sloping([a, b], line.is_some()),
            Ordering::Greater => self.sloping([b, a], line.is_some()),
            Ordering::Equal if line.is_some() => self.upright([a, b], upright_beyond),
            Ordering::Equal => [a, b],
        };
        if let Some(line) = line {
            if self.question.lines.mesh.loose_lines()[line as usize] != ends {
                turn(&mut self.pieces[first..]);
            }
            self.spans[line as usize] = [first as u32, self.pieces.len() as u32];
        }
    }

    /// A segment that has more than one column.
    fn sloping(&mut self, segment: Segment, drawn: bool) -> Segment {
        let [above, below, ..] = &mut self.tracks;
        self.upper.add(&self.questions, segment, above);
        self.lower.add(&self.questions, segment, below);
        if drawn && self.find_near(segment) {
            let tracks = [&self.tracks[0], &self.tracks[1], &self.near];
            let seen = |[above, below, _]: [State; 3]| is_seen(above, below);
            let hidden_wanted = self.question.lines.hidden_wanted;
            collect(&self.questions, segment, tracks, hidden_wanted, seen, &mut self.pieces);
        }
        segment
    }

    /// A drawn segment in a single column, seen beyond these horizons only.
    fn upright(&mut self, ends: [u32; 2], beyond: [bool; 2]) -> [u32; 2] {
        let carrier = Carrier::edge(ends[0], ends[1]);
        if self.questions.predicates.axis_across(carrier).is_none() || !self.find_near(ends) {
            // Its image is a point, or behind the eye.
            return ends;
        }
        let horizons = [(&mut self.upper, Sign::Positive, 0), (&mut self.lower, Sign::Negative, 1)];
        for (horizon, sense, first) in horizons {
            for (side, segment) in horizon.beside(&self.questions, ends[0]).into_iter().enumerate()
            {
                let rise = |segment, end| sense * self.questions.above(segment, end);
                let [from, to] = segment
                    .map_or([Sign::Positive; 2], |segment| ends.map(|end| rise(segment, end)));
                let cut = segment.map_or(Place::End, |s| Place::Cut(Cut::Silhouette(s)));
                let track = &mut self.tracks[first + 2 * side];
                match beyond[first] {
                    true => mark(track, [from, to], cut),
                    false => track.all(State::Within),
                }
            }
        }
        let [a, b, c, d] = &self.tracks;
        let seen = |[a, b, c, d, _]: [State; 5]| is_seen(a, b) && is_seen(c, d);
        let hidden_wanted = self.question.lines.hidden_wanted;
        let tracks = [a, b, c, d, &self.near];
        collect(&self.questions, ends, tracks, hidden_wanted, seen, &mut self.pieces);
        ends
    }

    /// Finds what of a segment lies in front of the near plane; false if
    /// nothing does.
    fn find_near(&mut self, ends: [u32; 2]) -> bool {
        if !self.question.lines.points.has_near_plane() {
            self.near.all(State::Beyond);
            return true;
        }
        let sign = |end| self.questions.predicates.value_sign(Cut::Near, Point::Vertex(end));
        let signs = ends.map(sign);
        mark(&mut self.near, signs, Place::Cut(Cut::Near));
        signs.contains(&Sign::Positive)
    }
}

/// Whether what lies so to the upper and the lower horizon is visible: on
/// both of them nothing but an edge-on strip is in front.
fn is_seen(above: State, below: State) -> bool {
    above == State::Beyond || below == State::Beyond || (above == State::On && below == State::On)
}

/// The track of a segment that a plane cuts, by the sides of its ends.
fn mark(track: &mut Track, [from, to]: [Sign; 2], cut: Place) {
    let state = |sign| if sign == Sign::Positive { State::Beyond } else { State::Within };
    if from.is_opposite(to) {
        track.clear();
        track.go(state(from), cut);
        track.go(state(to), Place::End);
    } else {
        track.all(state(from.or(to)));
    }
}

/// Appends the pieces of a segment: visible ones, and hidden ones if they are
/// wanted. The last track is that of the near plane.
fn collect<const N: usize, P: Policy>(
    questions: &Questions<'_, P>,
    segment: [u32; 2],
    tracks: [&Track; N],
    hidden_wanted: bool,
    seen: impl Fn([State; N]) -> bool,
    pieces: &mut Vec<ExactPiece>,
) {
    let first = pieces.len();
    let mut open = false;
    merge(questions, segment, tracks, |[from, to], states| {
        let invisibility = u32::from(!seen(states));
        let wanted = states[N - 1] == State::Beyond && (hidden_wanted || invisibility == 0);
        let joins = open && pieces[first..].last().is_some_and(|p| p.invisibility == invisibility);
        match pieces.last_mut() {
            Some(last) if wanted && joins => last.to = to,
            _ if wanted => pieces.push(ExactPiece { from, to, invisibility, outline: false }),
            _ => {}
        }
        open = wanted;
    });
}

/// The same pieces along the line that goes the other way.
fn turn(pieces: &mut [ExactPiece]) {
    let turned = |place| match place {
        Place::Start => Place::End,
        Place::End => Place::Start,
        cut => cut,
    };
    pieces.reverse();
    for piece in pieces {
        (piece.from, piece.to) = (turned(piece.to), turned(piece.from));
    }
}
