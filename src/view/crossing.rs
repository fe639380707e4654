//! Where one line of a drawing passes in front of another.

/// Two pieces whose images meet in a point in which one lies strictly in
/// front of the other. Pieces that meet in space have no crossing.
///
/// Which piece is the nearer one is exact. That the point lies on both of
/// them is true within rounding, and ends count: where a line goes behind
/// the contour of a face, its visible piece and the contour have a crossing.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Crossing {
    /// Index of the nearer piece.
    pub near: u32,
    /// Index of the piece behind it.
    pub far: u32,
}
