//! Patterns: a small tile repeated over the plane.
//!
//! The tile's pixel for (x, y) is `(x mod n, y mod m)`. Anchored to the page
//! it stays where it is when a thing moves, and things side by side show one
//! pattern; anchored to an object it moves with it.

/// What a pattern holds on to.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub enum Anchor {
    /// The page's upper left corner.
    #[default]
    Page,
    /// A pixel that moves with an object, column and row.
    Object([i64; 2]),
}

/// A tile of marks.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Pattern {
    width: usize,
    marks: Vec<bool>,
}

impl Pattern {
    /// The tile drawn by lines of equal length, where a space or a dot is no
    /// mark. `None` if there is no line or they are not equally long.
    pub fn new(lines: &[&str]) -> Option<Self> {
        let width = lines.first()?.chars().count();
        let even = lines.iter().all(|line| line.chars().count() == width);
        let marks = lines.iter().flat_map(|line| line.chars()).map(|c| !matches!(c, ' ' | '.'));
        (even && width > 0).then(|| Pattern { width, marks: marks.collect() })
    }

    /// The pattern of a name: `hatch`, `cross`, `dots` or `bricks`.
    pub fn from_name(name: &str) -> Option<Self> {
        let lines: &[&str] = match name {
            "hatch" => &[".....#", "....#.", "...#..", "..#...", ".#....", "#....."],
            "cross" => &[
                "#.....#.", ".#...#..", "..#.#...", "...#....", "..#.#...", ".#...#..", "#.....#.",
                ".......#",
            ],
            "dots" => &["....", ".#..", "....", "...#"],
            "bricks" => &["########", "#.......", "#.......", "########", "....#...", "....#..."],
            _ => return None,
        };
        Self::new(lines)
    }

    /// Columns and rows of the tile.
    pub fn size(&self) -> [usize; 2] {
        [self.width, self.marks.len() / self.width]
    }

    /// Whether the pattern has a mark at a pixel.
    pub fn is_marked(&self, [column, row]: [i64; 2], anchor: Anchor) -> bool {
        let [x, y] = match anchor {
            Anchor::Page => [0, 0],
            Anchor::Object(at) => at,
        };
        let [width, height] = self.size();
        let column = (column - x).rem_euclid(width as i64) as usize;
        let row = (row - y).rem_euclid(height as i64) as usize;
        self.marks[row * width + column]
    }
}
