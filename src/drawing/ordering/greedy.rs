//! The first order: always on to the nearest end that is left.
//!
//! A stroke may be begun at either end; a closed one at any of its points.
//! The pen begins at the lower left corner of the page, where plotters wait.

use super::nearest::Nearest;
use super::{Strokes, Visit, is_closed};
use glam::DVec2;

/// All strokes in greedy order, from the place `home`. Expected
/// O(p log p) for p points where a stroke may begin.
pub(super) fn greedy(strokes: &Strokes, home: DVec2) -> Vec<Visit> {
    let (points, doors) = doors(strokes);
    let mut nearest = Nearest::new(&points);
    let mut first_door = vec![0; strokes.len() + 1];
    for (door, (stroke, _)) in doors.iter().enumerate() {
        first_door[*stroke as usize + 1] = door as u32 + 1;
    }
    let mut visits = Vec::with_capacity(strokes.len());
    let mut pen = home;
    while let Some(door) = nearest.find(pen) {
        let (stroke, point) = doors[door as usize];
        for other in first_door[stroke as usize]..first_door[stroke as usize + 1] {
            nearest.remove(other);
        }
        let points = strokes.get(stroke as usize);
        let visit = if is_closed(points) {
            Visit { stroke, reversed: false, start: point }
        } else {
            Visit { stroke, reversed: point != 0, start: 0 }
        };
        pen = visit.ends(points)[1];
        visits.push(visit);
    }
    visits
}

/// All points where a stroke may begin, stroke by stroke: its number and the
/// number of the point in it.
fn doors(strokes: &Strokes) -> (Vec<DVec2>, Vec<(u32, u32)>) {
    let mut points = Vec::new();
    let mut doors = Vec::new();
    for (stroke, all) in strokes.iter().enumerate() {
        let last = all.len() - 1;
        let mut door = |point: usize| {
            points.push(all[point]);
            doors.push((stroke as u32, point as u32));
        };
        if is_closed(all) {
            (0..last).for_each(door);
        } else {
            door(0);
            door(last);
        }
    }
    (points, doors)
}
