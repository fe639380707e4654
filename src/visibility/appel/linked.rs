//! All lines, with counts carried from one to the next.
//!
//! Three passes. First every line's events, whose sum says how the counts
//! at its ends differ, whatever they are; then the counts at the vertices
//! ([`super::carry`]); then the pieces. Most lines of a fine mesh have no
//! events and join two fans: of these a single byte is kept in between.

use super::carry::{Foreign, Link, border_cases};
use super::events::Event;
use super::walker::{Walk, Walker};
use super::{gather, part_of, pieces_of};
use crate::kernel::predicates::Policy;
use crate::model::{FeatureLine, LineOrigin};
use crate::run::{Cancelled, Counters, Growing, Run, map_chunks};
use crate::spatial::{Bounds, Nearby};
use crate::view::{Contacts, ExactLines, LineQuestion};
use std::ops::Range;

/// What the first pass keeps of a line.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Kind {
    /// Nothing of the line has an image.
    Imageless,
    /// The line is not wanted, or known to be hidden all along.
    LeftOut,
    /// The line carries no count and is walked afresh.
    Alone,
    /// An edge between two fans, without events.
    Plain,
    /// A link with what belongs to it.
    Listed,
}

/// What the first pass finds for one part of the lines.
#[derive(Debug, Default)]
struct Part {
    /// Of each line.
    kinds: Vec<Kind>,
    /// Of the listed lines.
    links: Vec<Link>,
    /// End of each listed line's events in `events`, as far as kept.
    ends: Vec<u32>,
    /// At most one event per line, on average, is kept; others are found
    /// again.
    events: Vec<Event>,
}

/// A link's events between the passes.
enum Kept<'p> {
    /// These.
    All(&'p [Event]),
    /// They have to be found again.
    None,
}

impl Part {
    fn list(&mut self, link: Link, events: &[Event], most: usize) {
        self.kinds.push(Kind::Listed);
        self.links.push(link);
        if self.ends.len() + 1 == self.links.len() && self.events.len() + events.len() <= most {
            self.events.extend_from_slice(events);
            self.ends.push(self.events.len() as u32);
        }
    }

    /// What its lists take.
    fn bytes(&self) -> u64 {
        let events = self.events.capacity() * size_of::<Event>();
        (events + self.links.capacity() * size_of::<Link>() + self.kinds.len()) as u64
    }

    fn kept(&self, listed: usize) -> Kept<'_> {
        let Some(&end) = self.ends.get(listed) else {
            return Kept::None;
        };
        let start = if listed == 0 { 0 } else { self.ends[listed - 1] };
        Kept::All(&self.events[start as usize..end as usize])
    }

    /// The links of the part's lines, with the lines' numbers from `first`
    /// on.
    fn links<'p>(
        &'p self,
        question: &'p LineQuestion<'_>,
        first: usize,
    ) -> impl Iterator<Item = (u32, Link)> + Clone + 'p {
        let mut listed = self.links.iter();
        self.kinds.iter().zip(first..).filter_map(move |(kind, line)| {
            let link = match kind {
                Kind::Imageless | Kind::LeftOut | Kind::Alone => None,
                Kind::Plain => plain(question, &question.lines[line]),
                Kind::Listed => listed.next().copied(),
            };
            link.map(|link| (line as u32, link))
        })
    }
}

/// The link of a plain line.
fn plain(question: &LineQuestion<'_>, line: &FeatureLine) -> Option<Link> {
    match line.origin {
        LineOrigin::Edge(edge) => Some(Link::plain(question.mesh.edges().ends(edge))),
        _ => None,
    }
}

/// Finds the pieces of all lines.
pub(super) fn linked_lines<'q, P: Policy + 'q>(
    question: &LineQuestion<'_>,
    contacts: &Contacts<'_>,
    walker: impl Fn() -> Walker<'q, P> + Sync + Send,
    run: &Run<'_>,
) -> Result<ExactLines, Cancelled> {
    let size = part_of(question.lines.len());
    let found = map_chunks(question.lines.len(), size, |part| {
        run.check()?;
        let mut walker = walker();
        let found = first_pass(&mut walker, contacts, &question.lines[part], run)?;
        run.take(found.bytes())?;
        Ok((found, walker.counters()))
    });
    let mut counters = Counters::default();
    let mut parts = Vec::with_capacity(found.len());
    for part in found {
        let (part, counted) = part?;
        counters.merge(&counted);
        parts.push(part);
    }
    let links =
        parts.iter().enumerate().flat_map(|(number, part)| part.links(question, number * size));
    let vertices = question.mesh.vertices().len();
    let listed = || parts.iter().flat_map(|part| &part.links);
    let border = border_cases(vertices, listed(), contacts);
    let (foreign, contradictions) = Foreign::gather(&border, links, |roots| {
        let counts = map_chunks(roots.len(), 16, |part| {
            let mut walker = walker();
            let count = |&[root, line]: &[u32; 2]| {
                walker.foreign_count(root, &question.lines[line as usize], contacts)
            };
            // What is left out belongs to no answer.
            let on = roots[part].iter().take_while(|_| !run.is_stopped());
            let counts: Vec<i32> = on.map(count).collect();
            (counts, walker.counters())
        });
        counts
            .into_iter()
            .flat_map(|(counts, counted)| {
                counters.merge(&counted);
                counts
            })
            .collect()
    });
    run.check()?;
    counters.add("carried-contradictions", contradictions);
    run.merge(&counters);
    gather(run, question.lines.len(), |lines| {
        run.check()?;
        let mut walker = walker();
        let part = &parts[lines.start / size];
        let answer = last_pass(&mut walker, part, &foreign, question, lines, run)?;
        Ok((answer, walker.counters()))
    })
}

/// Finds the events of lines and what follows from them.
fn first_pass<P: Policy>(
    walker: &mut Walker<'_, P>,
    contacts: &Contacts<'_>,
    lines: &[FeatureLine],
    run: &Run<'_>,
) -> Result<Part, Cancelled> {
    let mut met = Growing::new(run, 0).of_crossings();
    let mut part = Part { kinds: Vec::with_capacity(lines.len()), ..Part::default() };
    let mut walks = Vec::with_capacity(NEIGHBOURS);
    for neighbours in lines.chunks(NEIGHBOURS) {
        run.advance(neighbours.len() as u64);
        walks.clear();
        for line in neighbours {
            let left_out = walker.is_left_out(line);
            walks.push(if left_out {
                Err(Kind::LeftOut)
            } else {
                walker.begin(line).ok_or(Kind::Imageless)
            });
        }
        let boxes = walks.iter().flatten().map(|walk| walk.probed.probe.bounds());
        let around = boxes.fold(Bounds::EMPTY, |sum, bounds| sum.union(bounds));
        walker.nearby = walker.effective.look_around(&around);
        for (line, walk) in neighbours.iter().zip(&walks) {
            if !met.goes_on(walker.events_held()) {
                break;
            }
            match walk {
                Err(kind) => part.kinds.push(*kind),
                Ok(walk) => look_at(walker, contacts, line, walk, &mut part, lines.len()),
            }
        }
    }
    walker.nearby = Nearby::EVERYTHING;
    met.finish(walker.events_held())?;
    Ok(part)
}

/// Lines that follow one another and are looked at together: they often lie
/// side by side.
const NEIGHBOURS: usize = 64;

/// So many effective edges along one line are a crowd, as where sheets are
/// stacked in one image line: each line would be held against all others.
const CROWD: u64 = 1 << 10;

/// Adds one line, keeping at most `most` events in all.
fn look_at<P: Policy>(
    walker: &mut Walker<'_, P>,
    contacts: &Contacts<'_>,
    line: &FeatureLine,
    walk: &Walk,
    part: &mut Part,
    most: usize,
) {
    if !matches!(line.origin, LineOrigin::Edge(_)) || walk.cut {
        part.kinds.push(Kind::Alone);
        return;
    }
    if walker.leaves_early
        && walker.is_crowded
        && walker.fault.is_none()
        && walker.one_triangle_hides(walk)
    {
        walker.left_early += 1;
        part.kinds.push(Kind::LeftOut);
        return;
    }
    let tested = walker.crossings_tested;
    walker.find_events(walk);
    walker.is_crowded = walker.crossings_tested - tested > CROWD;
    match walker.link(line, walk, contacts) {
        None => part.kinds.push(Kind::Alone),
        Some(link) if walker.events.is_empty() && link.is_plain() => part.kinds.push(Kind::Plain),
        Some(link) => part.list(link, &walker.events, most),
    }
}

/// Makes the pieces of one part of the lines.
fn last_pass<P: Policy>(
    walker: &mut Walker<'_, P>,
    part: &Part,
    foreign: &Foreign,
    question: &LineQuestion<'_>,
    lines: Range<usize>,
    run: &Run<'_>,
) -> Result<ExactLines, Cancelled> {
    let mut answer = ExactLines::default();
    let mut made = pieces_of(run);
    let mut listed = 0;
    for (place, (kind, line)) in part.kinds.iter().zip(&question.lines[lines]).enumerate() {
        if place % NEIGHBOURS == 0 {
            run.advance(0);
        }
        walker.pieces.clear();
        if !made.goes_on(answer.piece_count()) {
            break;
        }
        match kind {
            Kind::Imageless | Kind::LeftOut => {}
            Kind::Alone => walker.walk(line),
            Kind::Plain => {
                let first = plain(question, line).and_then(|link| foreign.first_count(&link));
                match first {
                    Some(first) => walker.whole_piece(first),
                    // Both ends are border cases of other lines.
                    None => walker.walk(line),
                }
            }
            Kind::Listed => {
                finish_link(walker, &part.links[listed], part.kept(listed), foreign, line);
                listed += 1;
            }
        }
        answer.push_line(walker.pieces());
    }
    made.finish(answer.piece_count())?;
    Ok(answer)
}

/// Makes the pieces of a listed line.
fn finish_link<P: Policy>(
    walker: &mut Walker<'_, P>,
    link: &Link,
    kept: Kept<'_>,
    foreign: &Foreign,
    line: &FeatureLine,
) {
    let known = foreign.first_count(link);
    if walker.leaves_early && known.is_some_and(|first| link.stays_hidden(first)) {
        walker.left_early += 1;
        return;
    }
    let Some(walk) = walker.begin(line) else {
        return;
    };
    let first = known.unwrap_or_else(|| walker.first_count(&walk));
    match kept {
        Kept::All(events) => {
            walker.events.clear();
            walker.events.extend_from_slice(events);
        }
        Kept::None => walker.find_events(&walk),
    }
    walker.finish(&walk, first);
}
