//! What a verification of painting orders found.

use crate::view::PaintOrder;
use crate::visibility::Painter;
use std::fmt;

/// Differences that are described in words.
const DESCRIBED: usize = 20;

/// Sums of one check.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct PaintTally {
    /// Faces, pairs of pieces or samples that are as they should be.
    pub agree: u64,
    /// Those that are not.
    pub differ: u64,
    /// Samples on borders, of which a picture says nothing.
    pub skipped: u64,
}

/// One way to find an order.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct PainterRow {
    /// Which.
    pub painter: Painter,
    /// Pieces that are painted.
    pub pieces: usize,
    /// Cuts that were made.
    pub cuts: usize,
    /// Faces.
    pub area: PaintTally,
    /// Pairs of pieces that overlap in the image.
    pub order: PaintTally,
    /// Samples.
    pub owner: PaintTally,
    /// Whether there is no order, which is a defect.
    pub failed: bool,
    /// If it was left out for its cuts: the most that were allowed, and the
    /// faces that were not looked at.
    pub left_out: Option<[usize; 2]>,
}

/// What a verification of painting orders found.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct PaintReport {
    /// Why there was none.
    pub skipped: Option<String>,
    /// One for each way.
    pub rows: Vec<PainterRow>,
    described: Vec<String>,
}

impl PaintReport {
    /// Whether nothing differs.
    pub fn is_clean(&self) -> bool {
        self.rows.iter().all(|row| {
            !row.failed && [row.area, row.order, row.owner].iter().all(|tally| tally.differ == 0)
        })
    }

    /// Begins with the next order.
    pub(super) fn row(&mut self, painter: Painter, order: &PaintOrder) {
        let (pieces, cuts) = (order.pieces.len(), order.cuts);
        self.rows.push(PainterRow { painter, pieces, cuts, ..PainterRow::default() });
    }

    /// There is no order.
    pub(super) fn fail(&mut self, painter: Painter, what: String) {
        self.rows.push(PainterRow { painter, failed: true, ..PainterRow::default() });
        self.describe(what);
    }

    /// The order takes more than `most` cuts of the faces that have an image.
    pub(super) fn leave_out(&mut self, painter: Painter, most: usize, faces: usize) {
        let left_out = Some([most, faces]);
        self.rows.push(PainterRow { painter, left_out, ..PainterRow::default() });
    }

    /// The row that was begun last.
    pub(super) fn last(&mut self) -> &mut PainterRow {
        if self.rows.is_empty() {
            self.rows.push(PainterRow::default());
        }
        let last = self.rows.len() - 1;
        &mut self.rows[last]
    }

    pub(super) fn describe(&mut self, what: String) {
        if self.described.len() < DESCRIBED {
            self.described.push(what);
        }
    }
}

impl fmt::Display for PaintReport {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if let Some(reason) = &self.skipped {
            return writeln!(f, "painter: not run ({reason})");
        }
        let heads = ["pieces", "cuts", "area", "differ", "order", "differ", "owner", "differ"];
        write!(f, "{:<7}", "painter")?;
        heads.iter().try_for_each(|head| write!(f, " {head:>9}"))?;
        writeln!(f, " {:>9}", "border")?;
        for row in &self.rows {
            if let Some([most, faces]) = row.left_out {
                let name = row.painter.name();
                writeln!(f, "{name:<7} left out: more than {most} cuts of {faces} faces")?;
                continue;
            }
            write!(f, "{:<7} {:>9} {:>9}", row.painter.name(), row.pieces, row.cuts)?;
            for tally in [row.area, row.order, row.owner] {
                write!(f, " {:>9} {:>9}", tally.agree, tally.differ)?;
            }
            writeln!(f, " {:>9}", row.owner.skipped)?;
        }
        self.described.iter().try_for_each(|what| writeln!(f, "{what}"))
    }
}
