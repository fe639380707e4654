//! The proof of visible regions: areas, owners, borders.
//!
//! - *area*: the regions overlap nowhere and together are the images of all
//!   faces. Not sums of areas but sets are compared, in one exact overlay of
//!   everything: a place that is in two regions, in a region but in no image,
//!   or in an image but in no region is a difference, however small.
//! - *owner*: samples of an image made by casting rays; the region of the
//!   face that a ray meets first contains the sample, exactly.
//! - *border*: where regions end along the lines, against the visible pieces
//!   of the answer, places compared exactly.
//!
//! Borders and visible lines are the same set but for named exceptions,
//! which are counted. A visible line is no border if its faces are seen from
//! the edge, or if there is none; or if it lies on another face, on the side
//! of its own, which thus does not show. And a border is no visible piece of
//! its own line where a nearer line lies on it in the image: then the nearer
//! one is drawn.

use super::places::Places;
use crate::kernel::numbers::Sign;
use crate::kernel::predicates::{Chart, Cut, ImagePoint, Place, Point, Policy, Predicates};
use crate::model::{LineOrigin, View};
use crate::polygon::clipping::{Clipper, FillRule, Operand, Polygon};
use crate::raster::samples::Sampled;
use crate::raster::{BoxTree, Samples, SheetCounter, ray_cast};
use crate::run::{Cancelled, Run, map_chunks};
use crate::view::{ExactLines, ExactPiece, LineQuestion, Region, VisibleRegions};
use crate::visibility::{RegionFault, RegionOptions, RegionsError, region_lines, visible_regions};
use glam::DVec2;
use std::fmt;

/// Lines or samples per task.
const PART: usize = 128;

/// Differences that are described in words.
const DESCRIBED: usize = 20;

/// How thorough a verification of regions is.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct RegionVerifyOptions {
    /// Up to this many triangles there is one.
    pub up_to: usize,
    /// Samples along the longer side of the image.
    pub image_size: u32,
    /// A mistake to make.
    pub fault: Option<RegionFault>,
}

impl Default for RegionVerifyOptions {
    /// Up to 20 000 triangles; an image of 128 samples.
    fn default() -> Self {
        RegionVerifyOptions { up_to: 20_000, image_size: 128, fault: None }
    }
}

/// Sums of one check.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct RegionTally {
    /// Regions, samples or pieces on which both sides agree.
    pub agree: u64,
    /// Those on which they differ; of areas, connected ones.
    pub differ: u64,
}

/// Pieces that are a border or a visible line, but not both.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct Surplus {
    /// Visible pieces of lines without a face that has an image.
    pub faceless: u64,
    /// Visible pieces that lie on another face, which is seen instead of
    /// their own.
    pub on_other_face: u64,
    /// Borders on which a nearer line is drawn.
    pub below_other_line: u64,
}

/// What a verification of regions found.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct RegionReport {
    /// Why there was none.
    pub skipped: Option<String>,
    /// Regions, disjoint and together the images.
    pub area: RegionTally,
    /// Whether faces lie between the eye and the near plane, or reach through
    /// it. These hide lines, which regions do not know, so overlaps and owners
    /// are all that is looked for.
    pub near_faces: bool,
    /// Samples.
    pub owner: RegionTally,
    /// Samples on an edge of the triangle that they see, where it ties with
    /// one that is seen beside the edge.
    pub samples_on_edges: u64,
    /// Pieces of lines.
    pub border: RegionTally,
    /// Pieces that differ as they should.
    pub surplus: Surplus,
    described: Vec<String>,
    segments: Vec<[DVec2; 2]>,
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

    fn describe(&mut self, what: String) {
        if self.described.len() < DESCRIBED {
            self.described.push(what);
        }
    }

    fn append(&mut self, other: RegionReport) {
        let add = |own: &mut RegionTally, other: RegionTally| {
            own.agree += other.agree;
            own.differ += other.differ;
        };
        add(&mut self.area, other.area);
        add(&mut self.owner, other.owner);
        add(&mut self.border, other.border);
        self.samples_on_edges += other.samples_on_edges;
        self.surplus.faceless += other.surplus.faceless;
        self.surplus.on_other_face += other.surplus.on_other_face;
        self.surplus.below_other_line += other.surplus.below_other_line;
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
        let Surplus { faceless, on_other_face, below_other_line } = self.surplus;
        writeln!(
            f,
            "border: besides, {faceless} visible pieces of lines without a face that shows, \
             {on_other_face} on another face, {below_other_line} borders below another line"
        )?;
        if self.near_faces {
            writeln!(f, "area: overlaps only, border: not run (faces before the near plane)")?;
        }
        self.described.iter().try_for_each(|what| writeln!(f, "{what}"))
    }
}

/// Finds what is seen of every face and checks it, and the visible pieces of
/// an answer against its borders.
///
/// Expected O(n log n + k log k) for n triangles and k crossings of all
/// images, hidden ones too.
///
/// # Errors
///
/// If the run is cancelled.
pub fn verify_regions<P: Policy>(
    view: &View,
    question: &LineQuestion<'_>,
    answer: &ExactLines,
    options: &RegionVerifyOptions,
    run: &Run<'_>,
) -> Result<RegionReport, Cancelled> {
    let mut report = RegionReport::default();
    let triangles = question.mesh.triangles().len();
    if triangles > options.up_to {
        report.skipped = Some(format!("{triangles} triangles, more than {}", options.up_to));
        return Ok(report);
    }
    let regions = visible_regions::<P>(question, &RegionOptions { fault: options.fault }, run);
    let regions = match regions {
        Ok(regions) => regions,
        Err(RegionsError::Cancelled(cancelled)) => return Err(cancelled),
        Err(other) => {
            report.skipped = Some(other.to_string());
            return Ok(report);
        }
    };
    run.stage("verify-areas", regions.regions().len() as u64, || {
        check_areas::<P>(question, &regions, &mut report);
    });
    run.check()?;
    let count = question.mesh.vertices().len() as u32;
    let samples = Samples::around(question.frame, question.coordinates, count, options.image_size);
    if let Some(samples) = samples {
        report.append(check_owners::<P>(view, question, &regions, &samples, run)?);
    }
    if report.near_faces {
        return Ok(report);
    }
    match region_lines::<P>(question, &regions, run) {
        Ok(borders) => report.append(check_borders::<P>(question, answer, &borders, run)?),
        Err(RegionsError::Cancelled(cancelled)) => return Err(cancelled),
        // Borders where faces are cut are no lines; all else was checked.
        Err(other) => report.describe(format!("border: not run ({other})")),
    }
    Ok(report)
}

/// One overlay of all regions and all images.
fn check_areas<P: Policy>(
    question: &LineQuestion<'_>,
    regions: &VisibleRegions,
    report: &mut RegionReport,
) {
    let predicates = Predicates::<P>::new(question.points);
    let Some(clipper) = Clipper::new(&predicates) else {
        return;
    };
    let near = question.points.has_near_plane();
    let is_in_front = |&corner: &u32| {
        !near || predicates.value_sign(Cut::Near, Point::Vertex(corner)) == Sign::Positive
    };
    let mut images = Vec::new();
    for (corners, facing) in question.mesh.triangles().iter().zip(question.facing) {
        // What lies behind the eye for certain has an empty box.
        if facing.is_zero() || (near && question.coordinates.bounds(*corners).is_empty()) {
            continue;
        }
        report.near_faces |= !corners.iter().all(is_in_front);
        let [a, b, c] = *corners;
        let corners = if *facing == Sign::Positive { [a, b, c] } else { [a, c, b] };
        images.push(Polygon::of_vertices([corners]));
    }
    let all: Vec<Polygon> =
        regions.regions().iter().flat_map(|region| region.polygons.iter().cloned()).collect();
    let odd = Operand::new(&all, FillRule::EvenOdd);
    let any = Operand::new(&all, FillRule::Positive);
    let differs = |inside: &[bool]| u32::from(inside.iter().any(|&one| one != inside[0]));
    let defects = if report.near_faces {
        clipper.overlay(&[odd, any], &differs)
    } else {
        clipper.overlay(&[odd, any, Operand::new(&images, FillRule::Positive)], &differs)
    };
    let defects = defects.get(&1).map_or(&[][..], Vec::as_slice);
    report.area =
        RegionTally { agree: regions.regions().len() as u64, differ: defects.len() as u64 };
    for defect in defects.iter().take(DESCRIBED) {
        report.describe(format!("area: {:?}", defect.outline()));
    }
}

/// Samples of an image against regions.
fn check_owners<P: Policy>(
    view: &View,
    question: &LineQuestion<'_>,
    regions: &VisibleRegions,
    samples: &Samples,
    run: &Run<'_>,
) -> Result<RegionReport, Cancelled> {
    let buffer = ray_cast::<P>(view, question, samples, run)?;
    let sampled = Sampled::new(view, question, samples);
    let (width, height) = (samples.width(), samples.height());
    let count = width as usize * height as usize;
    let parts = run.stage("verify-owners", count as u64, || {
        map_chunks(count, PART, |part| {
            run.check()?;
            let predicates = Predicates::<P>::new(sampled.points());
            let mut report = RegionReport::default();
            let Some(chart) = Chart::new(sampled.points()) else {
                return Ok(report);
            };
            for index in part {
                let [column, row] = [index as u32 % width, index as u32 / width];
                let Some(triangle) = buffer.item(column, row) else {
                    continue;
                };
                let vertex = sampled.vertex([column, row]);
                let sample = ImagePoint::Vertex(vertex);
                let owner = regions.of_triangle(triangle);
                if owner.is_some_and(|region| contains(&predicates, &chart, region, sample)) {
                    report.owner.agree += 1;
                } else if is_on_edge(&predicates, sampled.triangle(triangle).0, vertex) {
                    report.samples_on_edges += 1;
                } else {
                    report.owner.differ += 1;
                    report.describe(format!(
                        "owner: sample {column} {row} sees triangle {triangle}, its region does \
                         not contain it"
                    ));
                }
            }
            Ok(report)
        })
    });
    let mut report = RegionReport::default();
    for part in parts {
        report.append(part?);
    }
    Ok(report)
}

/// Whether a sample lies on an edge of a triangle. There another face may be
/// as near, which is seen beside the edge.
fn is_on_edge<P: Policy>(predicates: &Predicates<'_, P>, [a, b, c]: [u32; 3], x: u32) -> bool {
    [(a, b), (b, c), (c, a)].into_iter().any(|(p, q)| predicates.side(p, q, x).is_zero())
}

/// Whether a region contains a point or has it on its border: an odd number
/// of its edges run below.
fn contains<P: Policy>(
    predicates: &Predicates<'_, P>,
    chart: &Chart,
    region: &Region,
    point: ImagePoint,
) -> bool {
    let mut inside = false;
    for ring in region.polygons.iter().flat_map(|polygon| &polygon.rings) {
        let mut before = predicates.sweep(chart, ring[0].point, point);
        for (i, corner) in ring.iter().enumerate() {
            let after = match ring.get(i + 1) {
                Some(next) => predicates.sweep(chart, next.point, point),
                None => predicates.sweep(chart, ring[0].point, point),
            };
            if before.is_eq() || after.is_eq() {
                return true;
            }
            if before != after {
                // Directed against the sweep, left is below.
                let side = predicates.beside(chart, corner.line, point);
                let above = if before.is_lt() { side } else { -side };
                match above {
                    Sign::Zero => return true,
                    Sign::Positive => inside = !inside,
                    Sign::Negative => {}
                }
            }
            before = after;
        }
    }
    inside
}

/// Borders along lines against visible pieces.
fn check_borders<P: Policy>(
    question: &LineQuestion<'_>,
    answer: &ExactLines,
    borders: &ExactLines,
    run: &Run<'_>,
) -> Result<RegionReport, Cancelled> {
    let tree = SheetCounter::<P>::tree(question);
    let count = question.lines.len();
    let parts = run.stage("verify-borders", count as u64, || {
        map_chunks(count, PART, |part| {
            run.check()?;
            let mut worker = Borders {
                question,
                places: Places::<P>::new(question),
                counter: SheetCounter::<P>::new(question, &tree),
                tree: &tree,
                report: RegionReport::default(),
            };
            for line in part {
                worker.line(line, answer.line(line), borders.line(line));
            }
            Ok(worker.report)
        })
    });
    let mut report = RegionReport::default();
    for part in parts {
        report.append(part?);
    }
    Ok(report)
}

struct Borders<'a, 'q, P: Policy> {
    question: &'a LineQuestion<'q>,
    places: Places<'a, 'q, P>,
    counter: SheetCounter<'a, 'q, P>,
    tree: &'a BoxTree,
    report: RegionReport,
}

impl<P: Policy> Borders<'_, '_, P> {
    fn line(&mut self, line: usize, pieces: &[ExactPiece], borders: &[ExactPiece]) {
        let visible: Vec<&ExactPiece> =
            pieces.iter().filter(|piece| piece.invisibility == 0).collect();
        let mut ends: Vec<Place> = visible
            .iter()
            .copied()
            .chain(borders)
            .flat_map(|piece| [piece.from, piece.to])
            .collect();
        ends.sort_by(|a, b| self.places.order(line, *a, *b));
        ends.dedup_by(|a, b| self.places.order(line, *a, *b).is_eq());
        let (mut v, mut b) = (0, 0);
        for pair in ends.windows(2) {
            let [from, to] = [pair[0], pair[1]];
            let order = |a, b| self.places.order(line, a, b);
            while v < visible.len() && order(visible[v].to, from).is_le() {
                v += 1;
            }
            while b < borders.len() && order(borders[b].to, from).is_le() {
                b += 1;
            }
            let is_visible = visible.get(v).is_some_and(|piece| order(piece.from, from).is_le());
            let is_border = borders.get(b).is_some_and(|piece| order(piece.from, from).is_le());
            match (is_visible, is_border) {
                (true, true) => self.report.border.agree += 1,
                (true, false) => self.visible_only(line, [from, to]),
                (false, true) => self.border_only(line, [from, to]),
                (false, false) => {}
            }
        }
    }

    /// The faces of a line, and for each on which sides of the line it lies.
    fn own(&self, line: usize) -> Vec<(u32, [bool; 2])> {
        let question = self.question;
        let carrier = self.places.carrier(line);
        let mut own = match question.lines[line].origin {
            LineOrigin::Loose(_) => Vec::new(),
            LineOrigin::Intersection(i) => {
                let pair = question.intersections[i as usize].triangles;
                pair.map(|triangle| (triangle, [true; 2])).to_vec()
            }
            LineOrigin::Edge(edge) => {
                let ends = question.mesh.edges().ends(edge);
                let side = |&triangle: &u32| {
                    let third = question.mesh.third(triangle, ends);
                    let sign = self.places.predicates().image_side(carrier, third);
                    (triangle, [sign == Sign::Positive, sign == Sign::Negative])
                };
                question.mesh.edges().triangles(edge).iter().map(side).collect()
            }
        };
        own.retain(|(triangle, _)| !question.facing[*triangle as usize].is_zero());
        own
    }

    /// A visible piece at which no region of its faces ends.
    fn visible_only(&mut self, line: usize, places: [Place; 2]) {
        let own = self.own(line);
        let is_crossing = matches!(self.question.lines[line].origin, LineOrigin::Intersection(_));
        // Where one of two crossing faces is seen from the edge, the other
        // is seen on both sides.
        if own.is_empty() || (is_crossing && own.len() < 2) {
            self.report.surplus.faceless += 1;
            return;
        }
        let carrier = self.places.carrier(line);
        let probe = self.counter.probe(carrier, places, 0.5);
        let mut covered = [false; 2];
        for &(triangle, _) in &own {
            let bounds =
                self.question.coordinates.bounds(self.question.mesh.triangles()[triangle as usize]);
            self.tree.in_front(&bounds, |other| {
                let corners = self.question.mesh.triangles()[other as usize];
                let holds = |end| {
                    let sign = self.places.predicates().value_sign(Cut::Face(corners), end);
                    sign.is_zero()
                };
                let foreign = own.iter().all(|(triangle, _)| *triangle != other);
                if foreign && carrier.ends.into_iter().all(holds) {
                    let sides = self.counter.covers(carrier, probe, other);
                    covered[0] |= sides[0];
                    covered[1] |= sides[1];
                }
            });
        }
        let is_covered = |(_, sides): &(u32, [bool; 2])| (0..2).all(|i| !sides[i] || covered[i]);
        if own.iter().all(is_covered) {
            self.report.surplus.on_other_face += 1;
        } else {
            self.differ(line, places, "visible, but no border");
        }
    }

    /// A border on a piece that is not visible.
    fn border_only(&mut self, line: usize, places: [Place; 2]) {
        let carrier = self.places.carrier(line);
        let probe = self.counter.probe(carrier, places, 0.5);
        let sheets = self.counter.count(&self.question.lines[line], probe);
        let own = self.own(line);
        let is_free = |(_, sides): &(u32, [bool; 2])| (0..2).any(|i| sides[i] && sheets[i] == 0);
        if own.iter().any(is_free) {
            self.report.surplus.below_other_line += 1;
        } else {
            self.differ(line, places, "a border, but not visible");
        }
    }

    fn differ(&mut self, line: usize, places: [Place; 2], what: &str) {
        self.report.border.differ += 1;
        self.report.segments.push(self.places.span(line, places));
        let [from, to] = places;
        self.report.describe(format!("border: line {line} from {from:?} to {to:?}: {what}"));
    }
}
