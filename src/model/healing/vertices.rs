//! Vertices to vertices: places that are near one another become one.
//!
//! To be near is no equivalence, so of each group that hangs together some
//! places are kept, no two of them near one another, and the others go to the
//! nearest that is kept: nothing moves farther than the tolerance, and doing
//! it again changes nothing. Kept first are places where faces across the axes
//! meet, then those with the most others near them, then those nearest to the
//! planes through the origin. Nothing of this depends on the order in a file.
//!
//! Coordinates that belong to a face across an axis stay in its plane: the
//! place that is kept takes them over from those that join it.

use super::net::Net;
use super::{Tolerance, rank};
use crate::model::components::{join, root};
use crate::run::{map_chunks, sort_by};
use glam::DVec3;
use rustc_hash::FxHashMap;
use std::cmp::Ordering;

/// Groups that one task looks at.
const PART: usize = 1 << 10;

/// In larger groups it is not counted how many are near each place.
const MOST_COUNTED: usize = 64;

/// A place of a group.
#[derive(Debug, Clone, Copy)]
struct Member {
    place: u32,
    position: DVec3,
    /// Axes of its coordinates that are not free.
    locks: u8,
    /// How many of the group are near.
    near: u32,
}

/// What becomes of a group.
struct Merged {
    /// A place, and the one that it becomes.
    pairs: Vec<[u32; 2]>,
    /// Places that are kept elsewhere.
    shifted: Vec<(u32, DVec3)>,
}

/// Merges places along links that connect all near ones. `locks` are the axes
/// of coordinates that are not free, as bits.
pub(super) fn merge(net: &mut Net<'_>, links: &[[u32; 2]], locks: &[u8], tolerance: Tolerance) {
    if links.is_empty() {
        return;
    }
    let members = members(links);
    let groups: Vec<&[(u32, u32)]> = members.chunk_by(|a, b| a.0 == b.0).collect();
    let parts = map_chunks(groups.len(), PART, |part| {
        let mut merged = Merged { pairs: Vec::new(), shifted: Vec::new() };
        for group in &groups[part] {
            let member = |&(_, place): &(u32, u32)| Member {
                place,
                position: net.at(place) + DVec3::ZERO,
                locks: locks[place as usize],
                near: 0,
            };
            merge_group(net, group.iter().map(member).collect(), tolerance, &mut merged);
        }
        merged
    });
    let mut target: Vec<u32> = (0..net.first.len() as u32).collect();
    for Merged { pairs, shifted } in parts {
        pairs.iter().for_each(|&[from, to]| target[from as usize] = to);
        shifted.into_iter().for_each(|(place, position)| net.put(place, position));
    }
    net.join(&target);
}

/// The linked places by the group that they are in.
fn members(links: &[[u32; 2]]) -> Vec<(u32, u32)> {
    let mut places = links.as_flattened().to_vec();
    sort_by(&mut places, Ord::cmp);
    places.dedup();
    let number = |place: u32| places.partition_point(|&other| other < place) as u32;
    let mut parents: Vec<u32> = (0..places.len() as u32).collect();
    for link in links {
        join(&mut parents, link.map(number));
    }
    let group = |(number, &place): (u32, &u32)| (root(&mut parents, number), place);
    let mut members: Vec<(u32, u32)> = (0..).zip(&places).map(group).collect();
    sort_by(&mut members, Ord::cmp);
    members
}

fn merge_group(net: &Net<'_>, mut group: Vec<Member>, tolerance: Tolerance, merged: &mut Merged) {
    let near = |a: &Member, b: &Member| tolerance.allows(a.position, b.position);
    if group.len() <= MOST_COUNTED {
        for i in 0..group.len() {
            group[i].near = group.iter().filter(|other| near(&group[i], other)).count() as u32;
        }
    }
    group.sort_by(by_rank);
    let mut kept = Kept::new(tolerance);
    let mut joined: Vec<Member> = Vec::new();
    for member in group {
        match kept.nearest(&member) {
            Some(_) => joined.push(member),
            None => kept.add(member),
        }
    }
    let mut company: Vec<Vec<Member>> = vec![Vec::new(); kept.members.len()];
    for member in joined {
        if let Some(number) = kept.nearest(&member) {
            company[number].push(member);
        }
    }
    for (keeper, company) in kept.members.iter().zip(company) {
        let place = within_planes(net, keeper, &company, tolerance).unwrap_or(keeper.position);
        if place != keeper.position {
            merged.shifted.push((keeper.place, place));
        }
        // What was moved before may have no way left.
        let comes = |member: &&Member| net.allows(member.place, place, tolerance);
        let joins = company.iter().filter(comes).map(|member| [member.place, keeper.place]);
        merged.pairs.extend(joins);
    }
}

/// Which is kept rather.
fn by_rank(a: &Member, b: &Member) -> Ordering {
    (b.locks.count_ones().cmp(&a.locks.count_ones()))
        .then(b.near.cmp(&a.near))
        .then(rank(a.position, b.position))
}

/// The place that is kept, in the planes of all that join it, if none of them
/// moves too far.
fn within_planes(
    net: &Net<'_>,
    keeper: &Member,
    company: &[Member],
    tolerance: Tolerance,
) -> Option<DVec3> {
    let mut place = keeper.position;
    for axis in 0..3 {
        let is_locked = |member: &&Member| member.locks >> axis & 1 == 1;
        if let Some(member) = [keeper].into_iter().chain(company).find(is_locked) {
            place[axis] = member.position[axis];
        }
    }
    let all = [keeper].into_iter().chain(company);
    let mut ways = all.map(|member| net.allows(member.place, place, tolerance));
    ways.all(|allowed| allowed).then_some(place)
}

/// Places that are kept, none near another.
struct Kept {
    tolerance: Tolerance,
    members: Vec<Member>,
    /// By cells of the tolerance, once there are many.
    cells: FxHashMap<[u64; 3], Vec<u32>>,
}

impl Kept {
    /// So many are all looked at.
    const FEW: usize = 16;

    fn new(tolerance: Tolerance) -> Self {
        Kept { tolerance, members: Vec::new(), cells: FxHashMap::default() }
    }

    fn cell(&self, position: DVec3) -> DVec3 {
        (position / self.tolerance.distance()).floor()
    }

    fn add(&mut self, member: Member) {
        self.members.push(member);
        let from = match self.members.len() {
            count if count <= Self::FEW => return,
            count if count == Self::FEW + 1 => 0,
            count => count - 1,
        };
        for number in from..self.members.len() {
            let cell = self.cell(self.members[number].position);
            let key = (cell + DVec3::ZERO).to_array().map(f64::to_bits);
            self.cells.entry(key).or_default().push(number as u32);
        }
    }

    /// The nearest that is near enough, the first of equals.
    fn nearest(&self, member: &Member) -> Option<usize> {
        let mut best: Option<(f64, usize)> = None;
        let mut look = |number: usize| {
            let position = self.members[number].position;
            let way = ((position - member.position) / self.tolerance.distance()).length_squared();
            let is_better = best.is_none_or(|best| (way, number) < best);
            if self.tolerance.allows(position, member.position) && is_better {
                best = Some((way, number));
            }
        };
        if self.members.len() <= Self::FEW {
            (0..self.members.len()).for_each(look);
        } else {
            let own = self.cell(member.position);
            for step in 0..27 {
                let step = [step % 3, step / 3 % 3, step / 9].map(|step| f64::from(step) - 1.0);
                let key = (own + DVec3::from_array(step) + DVec3::ZERO).to_array();
                let there = self.cells.get(&key.map(f64::to_bits));
                there.into_iter().flatten().for_each(|&number| look(number as usize));
            }
        }
        best.map(|(_, number)| number)
    }
}
