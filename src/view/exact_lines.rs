//! The exact answer of a line method, before anything is rounded.

use crate::kernel::predicates::Place;

/// A maximal piece of a line on which the invisibility is constant.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct ExactPiece {
    /// Where the piece begins on the line's carrier.
    pub from: Place,
    /// Where it ends, further along.
    pub to: Place,
    /// The number of sheets in front of it: the larger of the counts on
    /// its left and on its right.
    pub invisibility: u32,
}

/// Pieces of all lines of a question, line by line and in order along each
/// line. Pieces behind the near plane are left out; if hidden pieces were
/// not wanted, so are those.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct ExactLines {
    ends: Vec<u32>,
    pieces: Vec<ExactPiece>,
}

impl ExactLines {
    /// Appends the pieces of the next line.
    pub fn push_line(&mut self, pieces: impl IntoIterator<Item = ExactPiece>) {
        self.pieces.extend(pieces);
        self.ends.push(self.pieces.len() as u32);
    }

    /// The lines of all parts, one part after the other.
    pub fn concat(parts: &[Self]) -> Self {
        let mut all = ExactLines {
            ends: Vec::with_capacity(parts.iter().map(Self::len).sum()),
            pieces: Vec::with_capacity(parts.iter().map(Self::piece_count).sum()),
        };
        for part in parts {
            let offset = all.pieces.len() as u32;
            all.pieces.extend_from_slice(&part.pieces);
            all.ends.extend(part.ends.iter().map(|end| end + offset));
        }
        all
    }

    /// The number of lines.
    pub fn len(&self) -> usize {
        self.ends.len()
    }

    /// Whether there are no lines.
    pub fn is_empty(&self) -> bool {
        self.ends.is_empty()
    }

    /// The pieces of line `line`.
    pub fn line(&self, line: usize) -> &[ExactPiece] {
        let start = if line == 0 { 0 } else { self.ends[line - 1] as usize };
        &self.pieces[start..self.ends[line] as usize]
    }

    /// The number of pieces of all lines.
    pub fn piece_count(&self) -> usize {
        self.pieces.len()
    }
}
