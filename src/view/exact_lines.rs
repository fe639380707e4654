//! The exact answer of a line method, before anything is rounded.

use crate::kernel::predicates::Place;
use crate::run::concat_map;

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
    /// Whether it parts the picture from the background, where that was
    /// asked; else not.
    pub outline: bool,
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
        let mut offsets = Vec::with_capacity(parts.len());
        let mut sum = 0;
        for part in parts {
            offsets.push(sum);
            sum += part.pieces.len() as u32;
        }
        let ends: Vec<&[u32]> = parts.iter().map(|part| &part.ends[..]).collect();
        let pieces: Vec<&[ExactPiece]> = parts.iter().map(|part| &part.pieces[..]).collect();
        ExactLines {
            ends: concat_map(&ends, |part, end| end + offsets[part]),
            pieces: concat_map(&pieces, |_, piece| *piece),
        }
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
