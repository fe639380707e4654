//! The spanning scan line: depths are compared once for each span between
//! two edges, not for each sample (Watkins 1970).
//!
//! Edges lie in the edge table in the order in which they cross the scan
//! line; from line to line little of that order changes, so it is repaired
//! by insertion. A polygon's entry in the polygon table is its in/out flag:
//! the number of its edges on whose outer side the sweep is. At zero it is
//! in; each edge the sweep passes adds one or takes one away. This holds
//! for two edges on a line as for three or four.
//!
//! Between two edges the set of polygons is constant and depths are affine.
//! So a polygon that is in front at both ends of a span is in front all
//! along it. Where two different ones are, their planes cross in the span;
//! it is cut behind the last sample that the first of them wins, and both
//! parts are looked at again.
//!
//! O(edges x rows + sum over spans of polygons in them).

use super::edges::{ActiveEdge, Edge, Reach, first_column};
use super::{Line, Scene};
use crate::kernel::predicates::Policy;
use crate::raster::samples::Judge;

/// An active edge and the column at which the sweep comes to it.
#[derive(Clone, Copy)]
struct Passed {
    active: ActiveEdge,
    /// The first column on the other side; about where that would be if
    /// the whole line lies on one side.
    at: u32,
    /// Whether the other side is the inner one; nothing if there is none.
    opens: Option<bool>,
}

/// The two tables of a scan line.
pub(super) struct Spanning<'s, P: Policy> {
    scene: &'s Scene<'s>,
    judge: Judge<'s, P>,
    edges: Vec<Passed>,
    /// Edges that were already on the line above: the first so many.
    old: usize,
    /// For each face, how many of its edges have the sweep outside.
    outside: Vec<u8>,
    /// The faces with a zero there.
    inside: Vec<u32>,
    cuts: u64,
}

impl<'s, P: Policy> Line<'s, P> for Spanning<'s, P> {
    fn new(scene: &'s Scene<'s>) -> Self {
        Spanning {
            scene,
            judge: Judge::new(&scene.sampled),
            edges: Vec::new(),
            old: 0,
            outside: vec![0; scene.faces.len()],
            inside: Vec::new(),
            cuts: 0,
        }
    }

    fn judge(&self) -> &Judge<'s, P> {
        &self.judge
    }

    fn counts(&self) -> (&'static str, u64) {
        ("spans-cut-at-crossing-planes", self.cuts)
    }

    fn enter<'e>(&mut self, edges: impl Iterator<Item = &'e Edge>, row: u32) {
        self.edges.retain(|edge| edge.active.reaches(row));
        self.old = self.edges.len();
        self.edges.extend(edges.map(|&edge| {
            let active = ActiveEdge::new(edge, &self.scene.faces, row);
            Passed { active, at: 0, opens: None }
        }));
    }

    fn draw(&mut self, row: u32, items: &mut Vec<Option<u32>>) {
        self.cross(row);
        let begin = items.len();
        let width = self.scene.sampled.samples().width();
        items.resize(begin + width as usize, None);
        let line = &mut items[begin..];
        let mut column = 0;
        for index in 0..self.edges.len() {
            let Passed { active, at, opens } = self.edges[index];
            let Some(opens) = opens else {
                continue;
            };
            if column < at {
                self.span([column, at - 1], row, line);
                column = at;
            }
            self.pass(active.edge.face, opens);
        }
        if column < width {
            self.span([column, width - 1], row, line);
        }
        for edge in &self.edges {
            self.outside[edge.active.edge.face as usize] = 0;
        }
        self.inside.clear();
    }
}

impl<P: Policy> Spanning<'_, P> {
    /// Finds where the sweep passes the edges, which flags they set before
    /// the first column, and brings them into order.
    fn cross(&mut self, row: u32) {
        for edge in &mut self.edges {
            let face = edge.active.edge.face as usize;
            let proposal = edge.active.proposal();
            let reach = edge.active.reach(&self.judge, &self.scene.faces[face], row);
            (edge.at, edge.opens) = match reach {
                Reach::All | Reach::None => (proposal, None),
                Reach::From(column) => (column, Some(true)),
                Reach::Until(column) => (column + 1, Some(false)),
            };
            self.outside[face] += u8::from(matches!(reach, Reach::None | Reach::From(_)));
        }
        for edge in &self.edges {
            let face = edge.active.edge.face;
            if self.outside[face as usize] == 0 && !self.inside.contains(&face) {
                self.inside.push(face);
            }
        }
        sort(&mut self.edges, self.old);
    }

    /// The sweep passes an edge of a face.
    fn pass(&mut self, face: u32, opens: bool) {
        let outside = &mut self.outside[face as usize];
        if opens {
            *outside -= 1;
            if *outside == 0 {
                self.inside.push(face);
            }
        } else {
            *outside += 1;
            if *outside == 1 {
                self.inside.retain(|&other| other != face);
            }
        }
    }

    /// Writes the samples between two edges.
    fn span(&mut self, [first, last]: [u32; 2], row: u32, line: &mut [Option<u32>]) {
        let Some(left) = self.front([first, row]) else {
            return;
        };
        if let Some(right) = self.front([last, row]) {
            self.part([first, last], [left, right], row, line);
        }
    }

    /// The nearest of the polygons inside at a sample.
    fn front(&self, at: [u32; 2]) -> Option<u32> {
        let faces = &self.scene.faces;
        self.inside.iter().copied().reduce(|best, other| {
            let wins = self.judge.beats(&faces[other as usize], &faces[best as usize], at);
            if wins { other } else { best }
        })
    }

    /// Writes a part of a span, given the faces in front at its ends.
    fn part(
        &mut self,
        [first, last]: [u32; 2],
        [left, right]: [u32; 2],
        row: u32,
        line: &mut [Option<u32>],
    ) {
        let [one, other] = [left, right].map(|face| &self.scene.faces[face as usize]);
        if left == right {
            line[first as usize..=last as usize].fill(Some(one.triangle));
            return;
        }
        self.cuts += 1;
        let lead = |column: u32| one.depth.at([column, row]) - other.depth.at([column, row]);
        let begin = lead(first);
        let crossing = begin / (begin - lead(last)) * f64::from(last - first);
        let proposal = first.saturating_add(crossing.ceil() as u32);
        let behind = first_column([first, last], proposal, |column| {
            self.judge.beats(other, one, [column, row])
        });
        // Others may be in front of both where they cross.
        if let Some(face) = self.front([behind - 1, row]) {
            self.part([first, behind - 1], [left, face], row, line);
        }
        if let Some(face) = self.front([behind, row]) {
            self.part([behind, last], [face, right], row, line);
        }
    }
}

/// Puts edges in the order of their columns: those of the line above by
/// insertion, in O(n) where hardly any has changed its place, then new ones
/// among them, by merging.
fn sort(edges: &mut [Passed], old: usize) {
    for i in 1..old {
        let edge = edges[i];
        let mut j = i;
        while j > 0 && edge.at < edges[j - 1].at {
            edges[j] = edges[j - 1];
            j -= 1;
        }
        edges[j] = edge;
    }
    edges[old..].sort_by_key(|edge| edge.at);
    // Finds two sorted runs and merges them.
    edges.sort_by_key(|edge| edge.at);
}
