//! Runs of samples of a row, and where they end.
//!
//! Samples lie on an exact lattice, so along a row everything linear is
//! linear in the column: a half-plane holds one unbroken run, and of two
//! planes each is the nearer one on one run. Where a run ends is proposed
//! by the zero of the form and decided by the sign.

use crate::kernel::predicates::Policy;
use crate::raster::samples::{Face, Judge};
use std::ops::Range;

/// Probes around a proposed end before the rest is halved.
const NEARBY: u32 = 3;

/// The samples of a row that see a face, borders included.
pub(super) fn run_of<P: Policy>(judge: &Judge<'_, P>, face: &Face, row: u32) -> Range<u32> {
    let [first, last] = face.footprint.columns;
    let mut run = first..last + 1;
    for (k, border) in face.borders().iter().enumerate() {
        let is_in = |column| judge.holds(face, k, [column, row]);
        if run.is_empty() {
            break;
        }
        run = match (is_in(run.start), is_in(run.end - 1)) {
            (true, true) => run,
            (false, false) => run.start..run.start,
            (starts, _) => {
                let value = border.form.at([run.start, row]);
                let turn = turn(&run, -value / border.form.right(), |c| is_in(c) == starts);
                if starts { run.start..turn } else { turn..run.end }
            }
        };
    }
    run
}

/// The first column of a run at which `before` holds no longer, given that
/// it holds at the first column and not at the last, and once at most turns
/// from one to the other; `guess` is about how far it is from the start.
/// O(1) if the guess is good, O(log n) if not.
pub(super) fn turn(run: &Range<u32>, guess: f64, before: impl Fn(u32) -> bool) -> u32 {
    let (mut low, mut high) = (run.start, run.end - 1);
    let mut probe = low.saturating_add(guess.max(0.0) as u32);
    let mut probes = 0;
    while high - low > 1 {
        let middle = if probes < NEARBY { probe } else { low + (high - low) / 2 };
        let column = middle.clamp(low + 1, high - 1);
        if before(column) {
            low = column;
            probe = column + 1;
        } else {
            high = column;
            probe = column - 1;
        }
        probes += 1;
    }
    high
}

#[cfg(test)]
mod tests {
    use super::turn;

    #[test]
    fn a_turn_is_found_whatever_the_guess() {
        for end in [2, 3, 7, 1000] {
            for truth in 1..end.min(60) {
                for guess in [f64::NAN, -1e300, 0.0, 5.5, f64::from(truth), 1e300, f64::INFINITY] {
                    let run = 10..10 + end;
                    assert_eq!(turn(&run, guess, |column| column < 10 + truth), 10 + truth);
                }
            }
        }
    }
}
