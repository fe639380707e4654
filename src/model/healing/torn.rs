//! Borders that rounding has torn apart: told, and left as they are.
//!
//! Where a surface was rounded corner by corner, what was one edge is two
//! borders beside each other, a hair apart. They are drawn, as exactly they
//! must be, and somebody wonders at the lines. What is a hair is told by the
//! file's resolution; but numbers in doubles were often computed in narrow
//! floats, so a few units of those, at the size of the model, are a hair too.

use super::near::{Near, near};
use super::seams::{Border, End, beside};
use super::tolerance::Tolerance;
use crate::model::Mesh;
use crate::model::components::{join, root};
use crate::model::precision::unit_of_float;
use crate::run::{Cancelled, Run};
use glam::DVec3;
use rustc_hash::FxHashMap;

/// Borders beside one another.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct TornBorders {
    /// How many there are.
    pub borders: usize,
    /// They are nearer to one another than this power of ten, in the model's
    /// unit.
    pub within: f64,
    /// Whether all of them have both ends near those of another, so that it is
    /// enough to merge vertices; otherwise some end inside of another.
    pub at_ends: bool,
}

/// Units of a narrow float, at the size of a model, that arithmetic in such
/// floats is off by.
const FLOAT_UNITS: f64 = 16.0;

/// Borders of one object that lie beside another within the larger of the
/// files' resolution and of the roundings of narrow floats; nothing if there
/// are none. Expected O(b log b) for b borders on which
/// nothing lies exactly, and O(1) for none.
///
/// # Errors
///
/// If the run is cancelled.
pub fn torn_borders(mesh: &Mesh, run: &Run<'_>) -> Result<Option<TornBorders>, Cancelled> {
    let open = mesh.borders().open();
    if open.len() < 2 {
        return Ok(None);
    }
    let (low, high) = mesh.bounds();
    let reach = mesh.resolution().max(FLOAT_UNITS * unit_of_float((high - low).max_element()));
    if !(0.0 < reach && reach.is_finite()) {
        return Ok(None);
    }
    let within = power_of_ten_above(reach);
    let ends = Ends::of(mesh, open, Tolerance::new(within));
    let partners = ends.partners();
    let beside = ends.beside(&partners, run)?;
    let [at_ends, inside] = [&partners, &beside].map(|found| found.iter().filter(|f| **f).count());
    let torn = TornBorders { borders: at_ends + inside, within, at_ends: inside == 0 };
    Ok((torn.borders > 0).then_some(torn))
}

/// The least power of ten that is not less than a number.
fn power_of_ten_above(number: f64) -> f64 {
    let exponent = number.log10().floor() as i32;
    let power = |exponent: i32| format!("1e{exponent}").parse().unwrap_or(f64::INFINITY);
    [exponent - 1, exponent, exponent + 1]
        .map(power)
        .into_iter()
        .find(|&p| number <= p)
        .unwrap_or(number)
}

/// The ends of borders, those that are near one another under one name.
struct Ends<'a> {
    mesh: &'a Mesh,
    tolerance: Tolerance,
    edges: &'a [u32],
    /// Two of each edge.
    ends: Vec<[u32; 2]>,
    /// The vertices that are ends, sorted, and what they are called here.
    vertices: Vec<u32>,
    names: Vec<u32>,
}

impl<'a> Ends<'a> {
    fn of(mesh: &'a Mesh, edges: &'a [u32], tolerance: Tolerance) -> Self {
        let mut vertices: Vec<u32> =
            edges.iter().flat_map(|&edge| mesh.edges().ends(edge)).collect();
        vertices.sort_unstable();
        vertices.dedup();
        let positions: Vec<DVec3> =
            vertices.iter().map(|&vertex| mesh.vertices()[vertex as usize]).collect();
        let Near { kept, links, .. } = near(&positions, &vec![0; positions.len()], tolerance);
        let mut names: Vec<u32> = (0..positions.len() as u32).collect();
        for (vertex, &kept) in (0..).zip(&kept) {
            join(&mut names, [vertex, kept]);
        }
        for link in links {
            join(&mut names, link);
        }
        let names: Vec<u32> =
            (0..positions.len() as u32).map(|vertex| root(&mut names, vertex)).collect();
        let name = |vertex| names[vertices.partition_point(|&other| other < vertex)];
        let ends = edges.iter().map(|&edge| mesh.edges().ends(edge).map(name)).collect();
        Ends { mesh, tolerance, edges, ends, vertices, names }
    }

    fn object(&self, edge: usize) -> u32 {
        self.mesh.object_of_vertex(self.mesh.edges().ends(self.edges[edge])[0])
    }

    /// Which edges have their ends in common with another of their object.
    fn partners(&self) -> Vec<bool> {
        let key = |edge: usize| {
            let [a, b] = self.ends[edge];
            (self.object(edge), a.min(b), a.max(b))
        };
        let mut counts: FxHashMap<(u32, u32, u32), u32> = FxHashMap::default();
        (0..self.ends.len()).for_each(|edge| *counts.entry(key(edge)).or_default() += 1);
        let is_long = |edge: usize| self.ends[edge][0] != self.ends[edge][1];
        (0..self.ends.len()).map(|edge| is_long(edge) && counts[&key(edge)] > 1).collect()
    }

    /// Which other edges have an end of another of their object beside them.
    fn beside(&self, partners: &[bool], run: &Run<'_>) -> Result<Vec<bool>, Cancelled> {
        let at = |vertex: u32| self.mesh.vertices()[vertex as usize];
        let alone: Vec<usize> = (0..self.edges.len()).filter(|&edge| !partners[edge]).collect();
        let border = |&edge: &usize| Border {
            object: self.object(edge),
            names: self.ends[edge],
            ends: self.mesh.edges().ends(self.edges[edge]).map(at),
        };
        let borders: Vec<Border> = alone.iter().map(border).collect();
        let end = |(&vertex, &name): (&u32, &u32)| End {
            object: self.mesh.object_of_vertex(vertex),
            name,
            position: at(vertex),
        };
        let ends: Vec<End> = self.vertices.iter().zip(&self.names).map(end).collect();
        let found = beside(&borders, &ends, self.tolerance, run);
        run.check()?;
        let mut beside = vec![false; self.edges.len()];
        found.into_iter().for_each(|[border, _]| beside[alone[border as usize]] = true);
        Ok(beside)
    }
}
