//! How a segment lies to one thing after the other, from its first end to
//! its second, and several of these together.

use super::breaks::Questions;
use crate::kernel::predicates::{Place, Policy};
use std::cmp::Ordering;

/// Where a piece of a segment lies.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum State {
    /// Above the upper horizon, below the lower one, beside them, or in
    /// front of the near plane: not hidden.
    Beyond,
    /// On the horizon.
    On,
    /// On the covered side of the horizon, or behind the near plane.
    Within,
}

/// States along a segment, each with the place where it ends.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub(super) struct Track {
    pieces: Vec<(State, Place)>,
}

impl Track {
    /// Forgets everything.
    pub(super) fn clear(&mut self) {
        self.pieces.clear();
    }

    /// Goes on in a state up to a place.
    pub(super) fn go(&mut self, state: State, until: Place) {
        match self.pieces.last_mut() {
            Some((last, end)) if *last == state => *end = until,
            _ => self.pieces.push((state, until)),
        }
    }

    /// One state all along.
    pub(super) fn all(&mut self, state: State) {
        self.clear();
        self.go(state, Place::End);
    }
}

/// Goes along a segment and tells the states of all tracks for every piece
/// on which they do not change.
pub(super) fn merge<const N: usize, P: Policy>(
    questions: &Questions<'_, P>,
    segment: [u32; 2],
    tracks: [&Track; N],
    mut found: impl FnMut([Place; 2], [State; N]),
) {
    let mut at = [0; N];
    let mut from = Place::Start;
    loop {
        let current = |i: usize| tracks[i].pieces.get(at[i]).copied();
        let pieces: [_; N] = std::array::from_fn(|i| current(i).unwrap_or(END));
        let mut until = Place::End;
        for (_, end) in pieces {
            if compare(questions, segment, end, until) == Ordering::Less {
                until = end;
            }
        }
        found([from, until], pieces.map(|(state, _)| state));
        if until == Place::End {
            return;
        }
        for (index, (_, end)) in at.iter_mut().zip(pieces) {
            if compare(questions, segment, end, until) == Ordering::Equal {
                *index += 1;
            }
        }
        from = until;
    }
}

/// Beyond the end of a track nothing changes any more.
const END: (State, Place) = (State::Beyond, Place::End);

/// The order of two ends of pieces along a segment.
fn compare<P: Policy>(
    questions: &Questions<'_, P>,
    segment: [u32; 2],
    first: Place,
    second: Place,
) -> Ordering {
    match (first, second) {
        (first, second) if first == second => Ordering::Equal,
        (Place::Cut(first), Place::Cut(second)) => questions.order(segment, first, second),
        (Place::End, _) | (_, Place::Start) => Ordering::Greater,
        (Place::Start, _) | (_, Place::End) => Ordering::Less,
    }
}
