//! Which segments have another one running along with them.
//!
//! Most have none, so all that matters here is to find that out quickly:
//! segments are dealt into the cells that they come near, and in each cell
//! those of nearly one direction are compared. Neighbours in a polyline
//! follow one another and are dismissed by that; what crosses, by its
//! direction. A cell of many segments is cut into smaller ones. Everything is
//! done in narrow floats with room for their rounding, bands of cells side by
//! side; what is found is a matter of the segments alone.

use super::SINE;
use super::cells::Cells;
use crate::run::{map_chunks, map_indexed, map_small};
use glam::{DVec2, Vec2};
use std::ops::Range;

/// Segments that one task deals into cells.
const PART: usize = 1 << 14;

/// Cells that one task searches hold about so many segments.
const BAND: usize = 1 << 14;

/// A cell of more segments is cut.
const CROWD: usize = 64;

/// A cell is cut into so many, along each side.
const CUT: f64 = 4.0;

/// Neighbours are at least so long beside one another, in their own length.
const SHARE: f32 = 0.02;

/// Half turns are 256 steps; directions that differ by more are not looked
/// at. Directions are squeezed by up to a half where they are counted.
const STEPS: u8 = (128.0 * SINE * 1.04) as u8 + 2;

/// A segment in narrow floats.
#[derive(Debug, Clone, Copy)]
struct Sketch {
    from: Vec2,
    to: Vec2,
}

impl Sketch {
    fn ends(&self) -> [DVec2; 2] {
        [self.from.as_dvec2(), self.to.as_dvec2()]
    }
}

/// Segments along which others may run within `reach`, in ascending order.
/// `place` is where a segment lies, if it is to be looked at.
pub(super) fn with_neighbours(
    count: usize,
    place: impl Fn(usize) -> Option<[DVec2; 2]> + Sync + Send,
    reach: f64,
) -> Vec<u32> {
    let parts = map_chunks(count, PART, |part| Extent::of(part.filter_map(&place)));
    let Extent { low, high, length, count: looked_at } =
        parts.into_iter().fold(Extent::NOTHING, Extent::and);
    if looked_at < 2 {
        return Vec::new();
    }
    let extent = (high - low).max_element();
    // What narrow floats may be off, at most a few of their last digits.
    let reach = reach + 8.0 * extent * f64::from(f32::EPSILON);
    let nowhere = Sketch { from: Vec2::NAN, to: Vec2::NAN };
    let sketches = map_small(count, |i| match place(i) {
        Some([a, b]) => Sketch { from: (a - low).as_vec2(), to: (b - low).as_vec2() },
        None => nowhere,
    });
    // Segments lie in two or three cells each, and there are not many more
    // cells than segments.
    let size = (1.5 * length / looked_at as f64).max(4.0 * reach);
    let size = size.max(extent / (2.0 * (looked_at as f64).sqrt() + 1.0) / 4.0);
    let cells = Cells::new(DVec2::ZERO, high - low, size);
    let rows = cells.count[1] as usize;
    let bands = (2 * looked_at / BAND).clamp(1, rows);
    let band_rows = rows.div_ceil(bands);
    let bands = rows.div_ceil(band_rows);
    let dealt =
        map_chunks(count, PART, |part| Dealt::new(&sketches, part, &cells, reach, band_rows));
    let search = Search { sketches: &sketches, cells: &cells, reach: reach as f32 };
    let found = map_indexed(bands, |band| {
        let rows = band * band_rows..((band + 1) * band_rows).min(rows);
        search.band(&dealt, band, rows.start as u32..rows.end as u32)
    });
    let mut have = vec![false; count];
    found.iter().flatten().for_each(|&segment| have[segment as usize] = true);
    (0..count as u32).filter(|&segment| have[segment as usize]).collect()
}

/// What is known of some segments together.
struct Extent {
    low: DVec2,
    high: DVec2,
    length: f64,
    count: usize,
}

impl Extent {
    const NOTHING: Extent =
        Extent { low: DVec2::INFINITY, high: DVec2::NEG_INFINITY, length: 0.0, count: 0 };

    fn of(segments: impl Iterator<Item = [DVec2; 2]>) -> Self {
        segments.fold(Extent::NOTHING, |all, [a, b]| Extent {
            low: all.low.min(a.min(b)),
            high: all.high.max(a.max(b)),
            length: all.length + a.distance(b),
            count: all.count + 1,
        })
    }

    fn and(self, other: Self) -> Self {
        Extent {
            low: self.low.min(other.low),
            high: self.high.max(other.high),
            length: self.length + other.length,
            count: self.count + other.count,
        }
    }
}

/// A cell, by its number, and a segment that comes near it.
#[derive(Debug, Clone, Copy, Default)]
struct Entry {
    cell: u32,
    segment: u32,
}

/// Some of the segments, dealt into bands of cells.
struct Dealt {
    entries: Vec<Entry>,
    /// Where each band starts in `entries`, and where the last one stops.
    starts: Vec<u32>,
}

impl Dealt {
    fn new(
        sketches: &[Sketch],
        part: Range<usize>,
        cells: &Cells,
        reach: f64,
        band_rows: usize,
    ) -> Self {
        let bands = (cells.count[1] as usize).div_ceil(band_rows);
        let mut entries = Vec::with_capacity(2 * part.len());
        let mut starts = vec![0; bands + 1];
        for segment in part {
            let sketch = &sketches[segment];
            if !sketch.from.is_nan() {
                cells.near(sketch.ends(), 0.5 * reach, |column, row| {
                    let cell = row * cells.count[0] + column;
                    entries
                        .push((row as usize / band_rows, Entry { cell, segment: segment as u32 }));
                    starts[row as usize / band_rows + 1] += 1;
                });
            }
        }
        for band in 0..bands {
            starts[band + 1] += starts[band];
        }
        let mut fill = starts.clone();
        let mut dealt = vec![Entry::default(); entries.len()];
        for (band, entry) in entries {
            let slot = &mut fill[band];
            dealt[*slot as usize] = entry;
            *slot += 1;
        }
        Dealt { entries: dealt, starts }
    }

    fn band(&self, band: usize) -> &[Entry] {
        &self.entries[self.starts[band] as usize..self.starts[band + 1] as usize]
    }
}

/// What cells are searched with.
struct Search<'a> {
    sketches: &'a [Sketch],
    cells: &'a Cells,
    reach: f32,
}

/// A segment of a cell under search.
#[derive(Debug, Clone, Copy)]
struct Member {
    sketch: Sketch,
    segment: u32,
    /// Its direction, either way being the same.
    turn: u8,
    found: bool,
}

impl Search<'_> {
    /// The segments of a band of cells that have neighbours in their cell;
    /// some more than once.
    fn band(&self, dealt: &[Dealt], band: usize, rows: Range<u32>) -> Vec<u32> {
        let width = self.cells.count[0] as usize;
        let first = rows.start as usize * width;
        let cells = rows.len() * width;
        let entries = || dealt.iter().flat_map(|part| part.band(band));
        let mut starts = vec![0_u32; cells + 1];
        entries().for_each(|entry| starts[entry.cell as usize - first + 1] += 1);
        for cell in 0..cells {
            starts[cell + 1] += starts[cell];
        }
        let mut fill = starts.clone();
        let mut sorted = vec![0; starts[cells] as usize];
        for entry in entries() {
            let slot = &mut fill[entry.cell as usize - first];
            sorted[*slot as usize] = entry.segment;
            *slot += 1;
        }
        let mut found = Vec::new();
        let mut members = Vec::new();
        for (cell, bounds) in starts.windows(2).enumerate() {
            let segments = &sorted[bounds[0] as usize..bounds[1] as usize];
            if segments.len() < 2 {
                continue;
            }
            members.clear();
            members.extend(segments.iter().map(|&segment| self.member(segment)));
            if members.len() <= CROWD {
                self.compare(&mut members);
            } else {
                let all: Vec<u32> = (0..members.len() as u32).collect();
                let [low, high] =
                    self.cells.bounds((cell % width) as u32, rows.start + (cell / width) as u32);
                self.cut(&mut members, &all, low, high);
            }
            found.extend(members.iter().filter(|member| member.found).map(|member| member.segment));
        }
        found
    }

    fn member(&self, segment: u32) -> Member {
        let sketch = self.sketches[segment as usize];
        Member { sketch, segment, turn: turn(sketch.to - sketch.from), found: false }
    }

    /// Marks the members of a cell that have neighbours in it.
    fn compare(&self, members: &mut [Member]) {
        for i in 1..members.len() {
            let (before, rest) = members.split_at_mut(i);
            before.iter_mut().for_each(|other| self.compare_two(&mut rest[0], other));
        }
    }

    #[inline]
    fn compare_two(&self, own: &mut Member, other: &mut Member) {
        let apart = own.turn.wrapping_sub(other.turn).wrapping_add(STEPS);
        if apart <= 2 * STEPS
            && !(own.found && other.found)
            && beside(&own.sketch, &other.sketch, self.reach)
        {
            (own.found, other.found) = (true, true);
        }
    }

    /// The same for some members that come near a box, which is cut as long
    /// as they are many.
    fn cut(&self, members: &mut [Member], some: &[u32], low: DVec2, high: DVec2) {
        let (reach, size) = (f64::from(self.reach), (high - low).max_element());
        if CROWD < some.len() && 4.0 * reach < size {
            let cells = Cells::new(low, high, size / CUT);
            let width = cells.count[0] as usize;
            let mut lists = vec![Vec::new(); width * cells.count[1] as usize];
            for &member in some {
                cells.near(members[member as usize].sketch.ends(), 0.5 * reach, |column, row| {
                    lists[row as usize * width + column as usize].push(member);
                });
            }
            for (cell, list) in lists.into_iter().enumerate().filter(|(_, list)| 1 < list.len()) {
                let [low, high] = cells.bounds((cell % width) as u32, (cell / width) as u32);
                self.cut(members, &list, low, high);
            }
            return;
        }
        for (i, &one) in some.iter().enumerate() {
            let mut own = members[one as usize];
            for &other in &some[..i] {
                self.compare_two(&mut own, &mut members[other as usize]);
            }
            members[one as usize].found = own.found;
        }
    }
}

/// The direction of a segment, either way being the same, in 256 steps to
/// half a turn (without trigonometry, and not quite even).
fn turn(along: Vec2) -> u8 {
    let along = if along.y < 0.0 { -along } else { along };
    let share = along.x / (along.x.abs() + along.y);
    // From 1 to -1 as the angle grows from 0 to half a turn.
    ((1.0 - share) * 128.0) as i32 as u8
}

/// Whether segments of nearly one direction may run along one another within
/// `reach`.
fn beside(one: &Sketch, other: &Sketch, reach: f32) -> bool {
    let (u, v) = (one.to - one.from, other.to - other.from);
    let (across, along) = (u.perp_dot(v), u.dot(v));
    if across.abs() > 1.1 * SINE as f32 * along.abs() {
        return false;
    }
    let square = u.length_squared();
    // All distances times the length of `one`.
    let length = square.sqrt();
    let offset = other.from - one.from;
    let (aside, least) = (u.perp_dot(offset), reach * length);
    let far = |a: f32, b: f32| least < a.min(b) || a.max(b) < -least;
    if far(aside, aside + across) {
        return false;
    }
    let (start, end) = (u.dot(offset), u.dot(offset) + along);
    let (from, to) = (start.min(end).max(0.0), start.max(end).min(square));
    let shared = (SHARE * along.abs().min(square)).min(least);
    if to - from <= shared {
        return false;
    }
    let at = |place: f32| aside + across * ((place - start) / along);
    !far(at(from), at(to))
}
