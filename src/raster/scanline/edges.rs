//! The edge tables: which borders of which faces bound the samples of a
//! scan line, and in which columns.
//!
//! The global table has the borders by the first row that they may bound;
//! an active border knows where it crosses the scan line. That place is
//! the exact fraction `-e(0, row) / (e(1, row) - e(0, row))` of two
//! brackets and is never divided: a float proposes it, growing by `1/m`
//! from line to line, and the exact sign of the bracket at a sample says on
//! which side of it the sample lies. Two samples beside each other on
//! different sides have it between them, which is all there is to know.
//!
//! Level borders cross no scan line and are not left out: they hold all
//! samples of a row or none, which keeps rows just above or below a
//! triangle empty without exact rows of its corners.

use crate::kernel::predicates::Policy;
use crate::raster::samples::{Face, Judge, Sampled};

/// A border and the rows that it may bound.
#[derive(Debug, Clone, Copy)]
pub(super) struct Edge {
    /// Index of its face.
    pub(super) face: u32,
    border: u8,
    rows: [u32; 2],
}

/// The global table: all edges by their first row.
#[derive(Debug)]
pub(super) struct EdgeTable {
    edges: Vec<Edge>,
    /// Where the edges of each row begin; one more than rows.
    starts: Vec<u32>,
}

impl EdgeTable {
    /// O(faces + rows).
    pub(super) fn new(sampled: &Sampled, faces: &[Face]) -> Self {
        let mut edges = Vec::with_capacity(3 * faces.len());
        for (index, face) in faces.iter().enumerate() {
            let rows = sampled.border_rows(face);
            edges.extend((0_u8..4).zip(rows).filter_map(|(border, rows)| {
                Some(Edge { face: index as u32, border, rows: rows? })
            }));
        }
        edges.sort_by_key(|edge| edge.rows[0]);
        let rows = 0..=sampled.samples().height();
        let starts = rows.map(|row| edges.partition_point(|edge| edge.rows[0] < row) as u32);
        EdgeTable { starts: starts.collect(), edges }
    }

    /// Edges that begin in a row.
    pub(super) fn beginning(&self, row: u32) -> &[Edge] {
        let [from, to] = [row, row + 1].map(|row| self.starts[row as usize] as usize);
        &self.edges[from..to]
    }

    /// Edges that began above a row and reach it.
    pub(super) fn reaching(&self, row: u32) -> impl Iterator<Item = &Edge> {
        let before = self.starts[row as usize] as usize;
        self.edges[..before].iter().filter(move |edge| edge.rows[1] >= row)
    }
}

/// Which samples of its face's footprint an edge leaves to the face.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Reach {
    All,
    None,
    /// This column and those behind it.
    From(u32),
    /// This column and those before it.
    Until(u32),
}

/// An edge with its crossing of the current scan line.
#[derive(Debug, Clone, Copy)]
pub(super) struct ActiveEdge {
    pub(super) edge: Edge,
    /// About where it crosses the current line, in columns.
    crossing: f64,
    /// What a line further down adds.
    step: f64,
}

impl ActiveEdge {
    /// An edge at a row.
    pub(super) fn new(edge: Edge, faces: &[Face], row: u32) -> Self {
        let face = &faces[edge.face as usize];
        let form = &face.borders()[usize::from(edge.border)].form;
        let first = face.footprint.columns[0];
        ActiveEdge {
            edge,
            crossing: f64::from(first) - form.at([first, row]) / form.right(),
            step: -form.down() / form.right(),
        }
    }

    /// Whether the edge has rows left at `row`.
    pub(super) fn reaches(&self, row: u32) -> bool {
        row <= self.edge.rows[1]
    }

    /// The first column behind the crossing, by floats.
    pub(super) fn proposal(&self) -> u32 {
        // Saturates on both sides; what is no number becomes zero.
        self.crossing.ceil() as u32
    }

    /// The samples of row `row` on the inner side. Called once for each row
    /// from the one where the edge was made active.
    pub(super) fn reach<P: Policy>(
        &mut self,
        judge: &Judge<'_, P>,
        face: &Face,
        row: u32,
    ) -> Reach {
        let border = usize::from(self.edge.border);
        let holds = |column: u32| judge.holds(face, border, [column, row]);
        let proposal = self.proposal();
        self.crossing += self.step;
        let [first, last] = face.footprint.columns;
        match (holds(first), holds(last)) {
            (true, true) => Reach::All,
            (false, false) => Reach::None,
            (false, true) => Reach::From(first_column([first, last], proposal, holds)),
            (true, false) => {
                let outside = first_column([first, last], proposal, |column| !holds(column));
                Reach::Until(outside - 1)
            }
        }
    }
}

/// The first column after `low`, where `holds` is false, up to `high`, where
/// it is true, from which on it is true: searched from a proposal, in
/// steps that double. O(log distance).
pub(super) fn first_column(
    [mut low, mut high]: [u32; 2],
    proposal: u32,
    holds: impl Fn(u32) -> bool,
) -> u32 {
    let mut probe = proposal.clamp(low + 1, high);
    let downwards = holds(probe);
    let mut step = 1;
    while high - low > 1 {
        if holds(probe) {
            high = probe;
            probe = if downwards { low.max(probe.saturating_sub(step)) } else { low };
        } else {
            low = probe;
            probe = if downwards { high } else { high.min(probe + step) };
        }
        step *= 2;
        if probe <= low || high <= probe {
            probe = low + (high - low) / 2;
        }
    }
    high
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_column_is_found_from_any_proposal() {
        for first in 4..=40 {
            for proposal in 0..50 {
                let found = first_column([3, 40], proposal, |column| column >= first);
                assert_eq!(found, first, "proposed {proposal}");
            }
        }
    }
}
