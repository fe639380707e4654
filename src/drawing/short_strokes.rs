//! Strokes too short for a pen, and which of them may be left out.
//!
//! A stroke is what a pen draws in one go, whatever layers and classes cut it
//! into: an outline of many pieces is one, and so no piece of it is too short.
//! A short stroke that leads from one stroke to another, or from one end of a
//! stroke to its other end, is part of something longer and is kept, or there
//! would be a hole. What hangs on something by one end only, or on nothing,
//! is left out; and then what hung on that.

use super::chaining::{pair_ends, point, stroke_numbers};
use glam::DVec2;
use rustc_hash::FxHashMap;

/// For each segment whether it is kept, if strokes shorter than `least` are
/// left out. O(n), except where many lines meet in one point.
pub(super) fn long_enough(segments: &[[DVec2; 2]], least: f64) -> Vec<bool> {
    let (partners, _) = pair_ends(segments, |end| Some(key(point(segments, end))));
    let (stroke_of, count) = stroke_numbers(&partners);
    let mut lengths = vec![0.0; count];
    for (segment, &stroke) in segments.iter().zip(&stroke_of) {
        lengths[stroke as usize] += segment[0].distance(segment[1]);
    }
    let mut net = Net::new(segments, &stroke_of, count);
    let mut kept = vec![true; count];
    let mut short: Vec<u32> =
        (0..count as u32).filter(|&stroke| lengths[stroke as usize] < least).collect();
    // What hung on a stroke that is left out is looked at again.
    while let Some(stroke) = short.pop() {
        if kept[stroke as usize] && net.joins(stroke) < 2 {
            kept[stroke as usize] = false;
            for other in net.take_out(stroke) {
                if lengths[other as usize] < least {
                    short.push(other);
                }
            }
        }
    }
    stroke_of.into_iter().map(|stroke| kept[stroke as usize]).collect()
}

/// Strokes and the points in which they meet.
struct Net {
    /// For each point the strokes through it, each once.
    at: Vec<Vec<u32>>,
    /// For each stroke its points in which others meet it.
    of: Vec<Vec<u32>>,
}

impl Net {
    fn new(segments: &[[DVec2; 2]], stroke_of: &[u32], count: usize) -> Self {
        let mut numbers: FxHashMap<[u64; 2], u32> = FxHashMap::default();
        let mut at: Vec<Vec<u32>> = Vec::new();
        for (segment, &stroke) in segments.iter().zip(stroke_of) {
            for end in segment {
                let number = *numbers.entry(key(*end)).or_insert(at.len() as u32) as usize;
                if number == at.len() {
                    at.push(Vec::new());
                }
                if !at[number].contains(&stroke) {
                    at[number].push(stroke);
                }
            }
        }
        let mut of = vec![Vec::new(); count];
        for (number, strokes) in at.iter().enumerate().filter(|(_, strokes)| 1 < strokes.len()) {
            strokes.iter().for_each(|&stroke| of[stroke as usize].push(number as u32));
        }
        Net { at, of }
    }

    /// In how many points other strokes meet a stroke.
    fn joins(&self, stroke: u32) -> usize {
        self.of[stroke as usize].iter().filter(|&&point| 1 < self.at[point as usize].len()).count()
    }

    /// Takes out a stroke; returns those that it met.
    fn take_out(&mut self, stroke: u32) -> Vec<u32> {
        let mut met = Vec::new();
        for point in std::mem::take(&mut self.of[stroke as usize]) {
            let strokes = &mut self.at[point as usize];
            strokes.retain(|&other| other != stroke);
            met.extend_from_slice(strokes);
        }
        met
    }
}

/// Equal for equal points: page coordinates are never -0.
fn key(point: DVec2) -> [u64; 2] {
    [point.x.to_bits(), point.y.to_bits()]
}

#[cfg(test)]
mod tests {
    use super::*;

    fn kept(segments: &[[[f64; 2]; 2]]) -> Vec<bool> {
        let segments: Vec<_> = segments.iter().map(|ends| ends.map(DVec2::from)).collect();
        long_enough(&segments, 1.0)
    }

    #[test]
    fn what_hangs_on_nothing_or_on_one_end_is_left_out() {
        let speck = [[50.0, 50.0], [50.5, 50.0]];
        let line = [[0.0, 0.0], [10.0, 0.0]];
        let on = [[10.0, 0.0], [20.0, 0.0]];
        let twig = [[10.0, 0.0], [10.0, 0.5]];
        let on_the_twig = [[[10.0, 0.5], [10.3, 0.8]], [[10.0, 0.5], [9.7, 0.8]]];
        let all = [speck, line, on, twig, on_the_twig[0], on_the_twig[1]];
        assert_eq!(kept(&all), [false, true, true, false, false, false]);
    }

    #[test]
    fn a_short_stroke_between_others_is_kept() {
        let bars = [[[0.0, 0.0], [10.0, 0.0]], [[10.0, 0.0], [20.0, 0.0]]];
        let others = [[[0.0, 0.5], [10.0, 0.5]], [[10.0, 0.5], [20.0, 0.5]]];
        let link = [[10.0, 0.0], [10.0, 0.5]];
        assert_eq!(kept(&[bars[0], bars[1], others[0], others[1], link]), [true; 5]);
        assert_eq!(kept(&[bars[0], bars[1], link]), [true, true, false]);
    }

    #[test]
    fn short_pieces_of_a_long_line_are_kept() {
        let at = |i: usize| [0.3 * i as f64, 0.0];
        let pieces: Vec<_> = (0..5).map(|i| [at(i), at(i + 1)]).collect();
        assert_eq!(kept(&pieces), [true; 5]);
        assert_eq!(kept(&pieces[..3]), [false; 3]);
    }
}
