//! Scan-line methods: the image row by row, each with the edges that cross
//! it, which are nearly those that crossed the row above.
//!
//! [`scanline`] keeps one line of depths, [`spanning`] compares depths once
//! for each span between two edges. Both stand on the same edge tables
//! (`edges`) and know nothing of each other. Bands of rows are independent;
//! within a band, one line follows from the other.

mod depth_line;
mod edges;
mod spanning;

use self::depth_line::DepthLine;
use self::edges::{Edge, EdgeTable};
use self::spanning::Spanning;
use super::ItemBuffer;
use super::samples::{Face, Judge, Sampled, Samples};
use crate::kernel::predicates::Policy;
use crate::model::View;
use crate::run::{Cancelled, Run, map_chunks};
use crate::view::LineQuestion;

/// Rows per task.
const BAND: usize = 64;

/// The nearest triangle at every sample, by a scan-line z-buffer.
///
/// # Errors
///
/// If the run is cancelled.
pub fn scanline<P: Policy>(
    view: &View,
    question: &LineQuestion,
    samples: &Samples,
    run: &Run,
) -> Result<ItemBuffer, Cancelled> {
    let scene = Scene::new::<P>(Sampled::new(view, question, samples), run)?;
    scene.scan::<P, DepthLine<P>>("scanline", run)
}

/// The nearest triangle at every sample, by Watkins' spanning scan line.
///
/// # Errors
///
/// If the run is cancelled.
pub fn spanning<P: Policy>(
    view: &View,
    question: &LineQuestion,
    samples: &Samples,
    run: &Run,
) -> Result<ItemBuffer, Cancelled> {
    let scene = Scene::new::<P>(Sampled::new(view, question, samples), run)?;
    scene.scan::<P, Spanning<P>>("spanning", run)
}

/// What is scanned.
struct Scene<'a> {
    sampled: Sampled<'a>,
    faces: Vec<Face>,
    table: EdgeTable,
}

/// A scan line that moves down through the scene.
trait Line<'s, P: Policy>: Sized {
    /// A line without edges.
    fn new(scene: &'s Scene<'s>) -> Self;

    /// What it asks.
    fn judge(&self) -> &Judge<'s, P>;

    /// Moves to a row: drops edges that end above it, takes up new ones.
    fn enter<'e>(&mut self, edges: impl Iterator<Item = &'e Edge>, row: u32);

    /// Appends the triangles of all samples of the row.
    fn draw(&mut self, row: u32, items: &mut Vec<Option<u32>>);

    /// What else was counted.
    fn counts(&self) -> (&'static str, u64) {
        ("", 0)
    }
}

impl<'a> Scene<'a> {
    fn new<P: Policy>(sampled: Sampled<'a>, run: &Run) -> Result<Self, Cancelled> {
        let faces = sampled.faces::<P>(run)?;
        let table = EdgeTable::new(&sampled, &faces);
        Ok(Scene { sampled, faces, table })
    }

    fn scan<'s, P: Policy, L: Line<'s, P>>(
        &'s self,
        stage: &'static str,
        run: &Run,
    ) -> Result<ItemBuffer, Cancelled> {
        let height = self.sampled.samples().height() as usize;
        let bands = run.stage(stage, height as u64, || {
            map_chunks(height, BAND, |rows| {
                run.check()?;
                let mut line = L::new(self);
                let mut items = Vec::new();
                let first = rows.start as u32;
                line.enter(self.table.reaching(first), first);
                for row in rows {
                    run.check()?;
                    line.enter(self.table.beginning(row as u32).iter(), row as u32);
                    line.draw(row as u32, &mut items);
                    run.advance(1);
                }
                run.merge(&line.judge().counters());
                let (name, amount) = line.counts();
                if amount > 0 {
                    run.count(name, amount);
                }
                Ok(items)
            })
        });
        let bands: Result<Vec<_>, Cancelled> = bands.into_iter().collect();
        Ok(self.sampled.buffer(bands?.concat()))
    }
}
