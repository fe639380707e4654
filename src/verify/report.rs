//! What a verification found.

use crate::kernel::predicates::Place;
use glam::DVec2;
use std::fmt;

/// One of the four checks.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Check {
    /// Pieces cover their lines, each place once.
    Cover,
    /// Sheets counted afresh at a point of each piece.
    Count,
    /// Roberts' pieces, exactly.
    Judge,
    /// An image made by casting rays.
    Image,
}

impl Check {
    /// All checks, in the order of the table.
    pub const ALL: [Check; 4] = [Check::Cover, Check::Count, Check::Judge, Check::Image];

    /// The name in the table.
    pub fn name(self) -> &'static str {
        match self {
            Check::Cover => "cover",
            Check::Count => "count",
            Check::Judge => "judge",
            Check::Image => "image",
        }
    }
}

/// Sums of one check.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Tally {
    /// Pieces (lines for `cover`) on which the answers agree.
    pub agree: u64,
    /// Their length in the image, view frame units.
    pub agree_length: f64,
    /// Pieces (lines) on which they differ.
    pub differ: u64,
    /// The length of what differs.
    pub differ_length: f64,
    /// Pieces about which the check could say nothing.
    pub skipped: u64,
}

impl Tally {
    /// The share of pieces that were skipped, from 0 to 1.
    pub fn skipped_share(&self) -> f64 {
        let all = self.agree + self.differ + self.skipped;
        if all == 0 { 0.0 } else { self.skipped as f64 / all as f64 }
    }

    fn append(&mut self, other: &Tally) {
        self.agree += other.agree;
        self.agree_length += other.agree_length;
        self.differ += other.differ;
        self.differ_length += other.differ_length;
        self.skipped += other.skipped;
    }
}

/// One defect, or one disagreement.
#[derive(Debug, Clone, PartialEq)]
pub struct Difference {
    /// Which check found it.
    pub check: Check,
    /// Index of the line in the question.
    pub line: usize,
    /// Where on the line, if it is about a part of it.
    pub places: Option<[Place; 2]>,
    /// What is wrong: what was expected, what the answer says.
    pub what: String,
}

/// Where a difference is in the image.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct DifferenceSegment {
    /// Which check found it.
    pub check: Check,
    /// Index of the line in the question.
    pub line: usize,
    /// Ends in the view frame.
    pub points: [DVec2; 2],
}

/// Differences that a report describes in words, for each check.
const DESCRIBED: usize = 20;

/// The result of a verification.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Report {
    tallies: [Tally; Check::ALL.len()],
    described: Vec<Difference>,
    segments: Vec<DifferenceSegment>,
    /// Lines that the judge saw, all lines, and what chose them.
    pub(super) judged: Option<(usize, usize, u64)>,
}

impl Report {
    /// The sums of a check.
    pub fn tally(&self, check: Check) -> &Tally {
        &self.tallies[check as usize]
    }

    /// Whether all exact checks agree. The image is no exact check.
    pub fn is_clean(&self) -> bool {
        [Check::Cover, Check::Count, Check::Judge]
            .into_iter()
            .all(|check| self.tally(check).differ == 0)
    }

    /// Whether the image could say something about at least half of the
    /// pieces.
    pub fn has_image(&self) -> bool {
        let tally = self.tally(Check::Image);
        tally.agree + tally.differ > 0 && tally.skipped_share() <= 0.5
    }

    /// The first differences of each check, in words.
    pub fn first_differences(&self) -> &[Difference] {
        &self.described
    }

    /// All differences, for a picture.
    pub fn differences(&self) -> &[DifferenceSegment] {
        &self.segments
    }

    /// Notes an agreement of this length.
    pub(super) fn agree(&mut self, check: Check, length: f64) {
        let tally = &mut self.tallies[check as usize];
        tally.agree += 1;
        tally.agree_length += length;
    }

    /// Notes that a check could say nothing about a piece.
    pub(super) fn skip(&mut self, check: Check) {
        self.tallies[check as usize].skipped += 1;
    }

    /// Notes a difference of this length, with the segments that show it.
    pub(super) fn differ(&mut self, difference: Difference, segments: &[[DVec2; 2]]) {
        let check = difference.check;
        let line = difference.line;
        let tally = &mut self.tallies[check as usize];
        tally.differ += 1;
        tally.differ_length += segments.iter().map(|[a, b]| a.distance(*b)).sum::<f64>();
        self.segments.extend(segments.iter().map(|&points| DifferenceSegment {
            check,
            line,
            points,
        }));
        self.describe(difference);
    }

    fn describe(&mut self, difference: Difference) {
        let same = |known: &&Difference| known.check == difference.check;
        if self.described.iter().filter(same).count() < DESCRIBED {
            self.described.push(difference);
        }
    }

    /// Adds what a later part found.
    pub(super) fn append(&mut self, other: Report) {
        for (own, theirs) in self.tallies.iter_mut().zip(&other.tallies) {
            own.append(theirs);
        }
        self.segments.extend(other.segments);
        for difference in other.described {
            self.describe(difference);
        }
        self.judged = self.judged.or(other.judged);
    }
}

impl fmt::Display for Report {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        writeln!(
            f,
            "{:<6} {:>10} {:>14} {:>10} {:>14} {:>10}",
            "check", "agree", "length", "differ", "length", "skipped"
        )?;
        for check in Check::ALL {
            let tally = self.tally(check);
            writeln!(
                f,
                "{:<6} {:>10} {:>14.6} {:>10} {:>14.6} {:>10}",
                check.name(),
                tally.agree,
                tally.agree_length,
                tally.differ,
                tally.differ_length,
                tally.skipped
            )?;
        }
        match self.judged {
            Some((seen, all, _)) if seen == all => writeln!(f, "judge: all {all} lines")?,
            Some((seen, all, seed)) => {
                writeln!(f, "judge: {seen} of {all} lines, chosen by seed {seed}")?;
            }
            None => writeln!(f, "judge: not run")?,
        }
        if self.has_image() {
            let share = 100.0 * self.tally(Check::Image).skipped_share();
            writeln!(f, "image: {share:.1} % of the pieces skipped")?;
        } else {
            writeln!(f, "image: not run (too many pieces lie near an edge)")?;
        }
        for difference in &self.described {
            write!(f, "{} line {}", difference.check.name(), difference.line)?;
            if let Some([from, to]) = difference.places {
                write!(f, " from {from:?} to {to:?}")?;
            }
            writeln!(f, ": {}", difference.what)?;
        }
        Ok(())
    }
}
