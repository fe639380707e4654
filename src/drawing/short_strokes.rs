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
mod tests;
