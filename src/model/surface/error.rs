//! What is wrong with a surface.

/// Why there is no surface.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum SurfaceError {
    /// A rectangle of cells has two points each way at least.
    #[error("the grid has {columns} columns and {rows} rows: expected at least 2 of each")]
    TooSmall {
        /// Points along x.
        columns: usize,
        /// Points along z.
        rows: usize,
    },
    /// Points and lines are numbered with 32 bits.
    #[error("the grid has {columns} x {rows} points: expected at most 1000000000")]
    TooLarge {
        /// Points along x.
        columns: usize,
        /// Points along z.
        rows: usize,
    },
    /// Coordinates of the grid have to grow.
    #[error("{axis} is {next} after {before}: expected growing finite coordinates")]
    NotGrowing {
        /// `x` or `z`.
        axis: char,
        /// A coordinate.
        before: f64,
        /// The next one.
        next: f64,
    },
    /// A range and a number of points that doubles cannot tell apart.
    #[error("{axis} has no {count} different numbers from {from} to {to}: expected fewer points")]
    TooFine {
        /// `x` or `z`.
        axis: char,
        /// Where the range begins.
        from: f64,
        /// Where it ends.
        to: f64,
        /// How many points were wanted.
        count: usize,
    },
    /// Not as many heights as points.
    #[error("{found} heights for {columns} x {rows} points")]
    WrongCount {
        /// Points along x.
        columns: usize,
        /// Points along z.
        rows: usize,
        /// Heights.
        found: usize,
    },
    /// Holes are nothing that a floating horizon can draw.
    #[error(
        "{missing} of {points} heights are missing, the first at x = {x}, z = {z} (column \
         {column}, row {row}): expected a height everywhere"
    )]
    Missing {
        /// How many are missing.
        missing: usize,
        /// Of how many.
        points: usize,
        /// Where the first one is.
        x: f64,
        /// Where the first one is.
        z: f64,
        /// Its column, counted from 1.
        column: usize,
        /// Its row, counted from 1.
        row: usize,
    },
    /// Nothing is left of a grid that was cut.
    #[error("no rectangle of 2 x 2 heights is without missing ones: expected more data")]
    NothingLeft,
    /// A surface with holes that is nothing but holes.
    #[error("no cell of the grid has three of its four heights: expected more data")]
    NoCells,
    /// A scaled height is infinite.
    #[error("the height {height} times {scale} is not finite: expected a smaller scale")]
    Overflow {
        /// The height.
        height: f64,
        /// The factor.
        scale: f64,
    },
    /// Walls do not cross the surface they stand under.
    #[error(
        "the base {base} lies among the heights of the border, {least} to {greatest}: expected \
         one below or above them"
    )]
    BaseAmongHeights {
        /// The height of the base.
        base: f64,
        /// The least height of the border.
        least: f64,
        /// The greatest.
        greatest: f64,
    },
    /// The expression cannot be read.
    #[error("'{text}': {message}, expected an expression of x and z as in sin(x)*cos(z)")]
    Expression {
        /// The expression.
        text: String,
        /// What is wrong.
        message: String,
    },
}
