//! Adding up: events in exact order along the line become pieces.

use super::events::Event;
use super::walker::{Sides, Walk, Walker};
use crate::kernel::predicates::{Cut, Place, Policy, sort_by_predicates};
use crate::view::ExactPiece;
use std::cmp::Ordering;

impl<P: Policy> Walker<'_, P> {
    /// Whether the line is hidden all along, whatever the order of events:
    /// even all losses together would leave a sheet on one side.
    pub(super) fn stays_hidden(&self, first: Sides) -> bool {
        let mut least = first;
        self.events.iter().for_each(|event| least.add(event.change.losses()));
        least.invisibility() > 0
    }

    /// Emits the one piece of a line without events.
    pub(super) fn whole_piece(&mut self, first: Sides) {
        let invisibility = first.invisibility();
        let hidden_wanted = self.question.hidden_wanted;
        push(&mut self.pieces, hidden_wanted, Place::Start, Place::End, invisibility);
    }

    /// Emits the pieces of a walk, up to the near plane if it leads there.
    pub(super) fn sweep(&mut self, walk: &Walk, first: Sides) {
        let mut events = std::mem::take(&mut self.events);
        let end = self.end_of_walk(walk, &mut events);
        events.retain(|event| event.change != Sides::default());
        let order = |a: &Event, b: &Event| {
            self.predicates.order(walk.carrier, (a.cut, &a.values), (b.cut, &b.values))
        };
        sort_by_predicates::<P, _>(&mut events, order);
        let mut sum = first;
        let mut from = Place::Start;
        for group in events.chunk_by(|a, b| order(a, b) == Ordering::Equal) {
            let before = sum.invisibility();
            // Of cuts in one place one is named, in whatever order they
            // were found, and by vertices in an order of their own.
            let mut cut = group[0].cut.canonical();
            for event in group {
                sum.left += event.change.left;
                sum.right += event.change.right;
                cut = cut.min(event.cut.canonical());
            }
            if sum.invisibility() != before {
                let to = Place::Cut(cut);
                push(&mut self.pieces, self.question.hidden_wanted, from, to, before);
                from = to;
            }
        }
        push(&mut self.pieces, self.question.hidden_wanted, from, end, sum.invisibility());
        events.clear();
        self.events = events;
    }

    /// The place where the walk ends; drops the events beyond it.
    fn end_of_walk(&self, walk: &Walk, events: &mut Vec<Event>) -> Place {
        if !walk.cut {
            return Place::End;
        }
        let near = walk.carrier.ends.map(|point| self.predicates.value(Cut::Near, point));
        events.retain(|event| {
            self.predicates.order(walk.carrier, (event.cut, &event.values), (Cut::Near, &near))
                == Ordering::Less
        });
        Place::Cut(Cut::Near)
    }
}

/// Appends a piece if it is wanted.
fn push(
    pieces: &mut Vec<ExactPiece>,
    hidden_wanted: bool,
    from: Place,
    to: Place,
    invisibility: u32,
) {
    if hidden_wanted || invisibility == 0 {
        pieces.push(ExactPiece { from, to, invisibility, outline: false });
    }
}
