//! The scan-line z-buffer: one line of depths, filled by the spans of all
//! polygons on it (Wylie, Romney, Evans and Erdahl 1967; Bouknight 1970).
//!
//! Each polygon holds its active edges in no order; what all of them leave
//! to it is its span. O(edges x rows + samples of spans).

use super::edges::{ActiveEdge, Edge, Reach};
use super::{Line, Scene};
use crate::kernel::predicates::Policy;
use crate::raster::samples::{Face, Judge};

/// The active edges, polygon by polygon, and the depth line.
pub(super) struct DepthLine<'s, P: Policy> {
    scene: &'s Scene<'s>,
    judge: Judge<'s, P>,
    active: Vec<ActiveEdge>,
    line: Vec<Option<(&'s Face, f64)>>,
}

impl<'s, P: Policy> Line<'s, P> for DepthLine<'s, P> {
    fn new(scene: &'s Scene<'s>) -> Self {
        let width = scene.sampled.samples().width() as usize;
        let judge = Judge::new(&scene.sampled);
        DepthLine { scene, judge, active: Vec::new(), line: vec![None; width] }
    }

    fn judge(&self) -> &Judge<'s, P> {
        &self.judge
    }

    fn enter<'e>(&mut self, edges: impl Iterator<Item = &'e Edge>, row: u32) {
        self.active.retain(|edge| edge.reaches(row));
        self.active.extend(edges.map(|&edge| ActiveEdge::new(edge, &self.scene.faces, row)));
        // Two sorted runs, which this sort merges.
        self.active.sort_by_key(|edge| edge.edge.face);
    }

    fn draw(&mut self, row: u32, items: &mut Vec<Option<u32>>) {
        self.line.fill(None);
        for polygon in self.active.chunk_by_mut(|a, b| a.edge.face == b.edge.face) {
            let face = &self.scene.faces[polygon[0].edge.face as usize];
            let [mut first, mut last] = face.footprint.columns.map(i64::from);
            for edge in polygon {
                match edge.reach(&self.judge, face, row) {
                    Reach::All => {}
                    Reach::None => last = -1,
                    Reach::From(column) => first = first.max(i64::from(column)),
                    Reach::Until(column) => last = last.min(i64::from(column)),
                }
            }
            if first <= last {
                write(&self.judge, &mut self.line, face, row, [first as u32, last as u32]);
            }
        }
        items.extend(self.line.iter().map(|nearest| nearest.map(|(face, _)| face.triangle)));
    }
}

/// Writes a span where it is nearer than what the line has.
fn write<'s, P: Policy>(
    judge: &Judge<'s, P>,
    line: &mut [Option<(&'s Face, f64)>],
    face: &'s Face,
    row: u32,
    [first, last]: [u32; 2],
) {
    let mut depth = face.depth.at([first, row]);
    for column in first..=last {
        let slot = &mut line[column as usize];
        let new = (face, depth);
        if slot.is_none_or(|old| judge.wins(new, old, [column, row])) {
            *slot = Some(new);
        }
        depth += face.depth.right();
    }
}
