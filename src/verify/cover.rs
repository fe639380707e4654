//! Do the pieces of a line cover it, each place once?

use super::places::Places;
use crate::kernel::numbers::Sign;
use crate::kernel::predicates::{Cut, Place, Policy};
use crate::view::ExactPiece;
use std::cmp::Ordering;

/// What is wrong with the pieces of a line, if anything.
pub(super) fn fault<P: Policy>(
    places: &Places<'_, '_, P>,
    line: usize,
    pieces: &[ExactPiece],
) -> Option<&'static str> {
    let is_on = |piece: &ExactPiece| places.is_on(line, piece.from) && places.is_on(line, piece.to);
    if !pieces.iter().all(is_on) {
        return Some("a piece ends where no place of the line is");
    }
    let hidden_wanted = places.question().hidden_wanted;
    if !hidden_wanted && pieces.iter().any(|piece| piece.invisibility > 0) {
        return Some("a hidden piece, which was not asked for");
    }
    let backwards = |piece: &ExactPiece| places.order(line, piece.from, piece.to) != Ordering::Less;
    if pieces.iter().any(backwards) {
        return Some("a piece without length");
    }
    for (piece, next) in pieces.iter().zip(pieces.iter().skip(1)) {
        match places.order(line, piece.to, next.from) {
            Ordering::Less if hidden_wanted => return Some("a gap between pieces"),
            Ordering::Less => {}
            Ordering::Equal if piece.invisibility == next.invisibility => {
                return Some("a split where nothing changes");
            }
            Ordering::Equal => {}
            Ordering::Greater => return Some("pieces that overlap"),
        }
    }
    ends_fault(places, line, pieces)
}

/// What is wrong with the first and the last place of a line.
fn ends_fault<P: Policy>(
    places: &Places<'_, '_, P>,
    line: usize,
    pieces: &[ExactPiece],
) -> Option<&'static str> {
    let (Some(first), Some(last)) = (pieces.first(), pieces.last()) else {
        let missing = places.question().hidden_wanted && expected_ends(places, line).is_some();
        return missing.then_some("no pieces at all");
    };
    let Some([start, end]) = expected_ends(places, line) else {
        return Some("pieces of a line that the eye cannot see");
    };
    let early = places.order(line, first.from, start);
    let late = places.order(line, last.to, end);
    if early == Ordering::Less || late == Ordering::Greater {
        Some("a piece behind the near plane")
    } else if places.question().hidden_wanted && (early, late) != (Ordering::Equal, Ordering::Equal)
    {
        Some("pieces that do not reach the ends of the line")
    } else {
        None
    }
}

/// Where the pieces of a line must begin and end; nothing if it has none.
fn expected_ends<P: Policy>(places: &Places<'_, '_, P>, line: usize) -> Option<[Place; 2]> {
    let (predicates, carrier) = (places.predicates(), places.carrier(line));
    predicates.axis_across(carrier)?;
    if !places.question().points.has_near_plane() {
        return Some([Place::Start, Place::End]);
    }
    let near = Place::Cut(Cut::Near);
    match carrier.ends.map(|end| predicates.value_sign(Cut::Near, end)) {
        [Sign::Negative, Sign::Positive] => Some([near, Place::End]),
        [Sign::Positive, Sign::Negative] => Some([Place::Start, near]),
        [Sign::Negative | Sign::Zero, Sign::Negative | Sign::Zero] => None,
        _ => Some([Place::Start, Place::End]),
    }
}
