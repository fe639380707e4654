//! Flood fill: everything of one kind that is connected with a seed.
//!
//! A stack of spans instead of recursion: each span taken from it is
//! lengthened as far as its row goes, filled, and leaves one seed for each
//! run of pixels of the kind above it and below it. The stack holds no more
//! than the border is long.

/// Which pixels are neighbours.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Connected {
    /// Those with a common side.
    BySides,
    /// Those with a common corner too.
    ByCorners,
}

/// Replaces the kind of the seed by `with` in all pixels connected with the
/// seed, and returns how many they are. The image is given row by row, and a
/// seed beside it fills nothing. O(filled pixels).
pub fn flood<T: Copy + PartialEq>(
    image: &mut [T],
    width: u32,
    seed: [u32; 2],
    with: T,
    connected: Connected,
) -> usize {
    let columns = width as usize;
    let Some(rows) = image.len().checked_div(columns) else {
        return 0;
    };
    let [column, row] = seed.map(|x| x as usize);
    if columns <= column || rows <= row || image[row * columns + column] == with {
        return 0;
    }
    let kind = image[row * columns + column];
    let reach = usize::from(connected == Connected::ByCorners);
    let mut waiting = vec![[column, row]];
    let mut filled = 0;
    while let Some([column, row]) = waiting.pop() {
        let line = &mut image[row * columns..(row + 1) * columns];
        if line[column] != kind {
            continue;
        }
        let before = line[..column].iter().rev().take_while(|pixel| **pixel == kind).count();
        let behind = line[column..].iter().take_while(|pixel| **pixel == kind).count();
        let (first, end) = (column - before, column + behind);
        line[first..end].fill(with);
        filled += end - first;
        let (left, right) = (first.saturating_sub(reach), (end + reach).min(columns));
        let neighbours = [row.checked_sub(1), (row + 1 < rows).then_some(row + 1)];
        for next in neighbours.into_iter().flatten() {
            let line = &image[next * columns..(next + 1) * columns];
            let starts =
                (left..right).filter(|&c| line[c] == kind && (c == left || line[c - 1] != kind));
            waiting.extend(starts.map(|c| [c, next]));
        }
    }
    filled
}
