//! What a verification of regions found.

use glam::DVec2;
use std::fmt;

/// Differences that are described in words.
pub(super) const DESCRIBED: usize = 20;

/// Sums of one check.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct RegionTally {
    /// Regions, samples or pieces on which both sides agree.
    pub agree: u64,
    /// Those on which they differ; of areas, connected ones.
    pub differ: u64,
}

/// What a verification of regions found.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct RegionReport {
    /// Why there was none.
    pub skipped: Option<String>,
    /// Regions, disjoint and together the images.
    pub area: RegionTally,
    /// Samples.
    pub owner: RegionTally,
    /// Samples on an edge of the triangle that they see, where it ties with
    /// one that is seen beside the edge.
    pub samples_on_edges: u64,
    /// Pieces of lines.
    pub border: RegionTally,
    /// Pieces that regions show and faces hide only with what of them lies
    /// before the near plane, which regions do not know.
    pub before_near: u64,
    described: Vec<String>,
    pub(super) segments: Vec<[DVec2; 2]>,
}

impl RegionReport {
    /// Whether nothing differs.
    pub fn is_clean(&self) -> bool {
        [self.area, self.owner, self.border].iter().all(|tally| tally.differ == 0)
    }

    /// Where borders differ, in the view frame.
    pub fn differences(&self) -> impl Iterator<Item = [DVec2; 2]> + '_ {
        self.segments.iter().copied()
    }

    pub(super) fn describe(&mut self, what: String) {
        if self.described.len() < DESCRIBED {
            self.described.push(what);
        }
    }

    pub(super) fn append(&mut self, other: RegionReport) {
        let add = |own: &mut RegionTally, other: RegionTally| {
            own.agree += other.agree;
            own.differ += other.differ;
        };
        add(&mut self.area, other.area);
        add(&mut self.owner, other.owner);
        add(&mut self.border, other.border);
        self.samples_on_edges += other.samples_on_edges;
        self.before_near += other.before_near;
        self.segments.extend(other.segments);
        other.described.into_iter().for_each(|what| self.describe(what));
    }
}

impl fmt::Display for RegionReport {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if let Some(reason) = &self.skipped {
            return writeln!(f, "regions: not run ({reason})");
        }
        writeln!(f, "{:<7} {:>10} {:>10}", "regions", "agree", "differ")?;
        let rows = [("area", self.area), ("owner", self.owner), ("border", self.border)];
        for (name, tally) in rows {
            writeln!(f, "{name:<7} {:>10} {:>10}", tally.agree, tally.differ)?;
        }
        if self.samples_on_edges > 0 {
            writeln!(f, "owner: besides, {} samples on edges", self.samples_on_edges)?;
        }
        if self.before_near > 0 {
            let count = self.before_near;
            writeln!(f, "border: besides, {count} pieces hidden only before the near plane")?;
        }
        self.described.iter().try_for_each(|what| writeln!(f, "{what}"))
    }
}
