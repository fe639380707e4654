//! Objects to be healed, and objects compared.

use crate::split_mix::split_mix;
use glam::{DMat3, DQuat, DVec3};
use proptest::prelude::*;
use umriss::model::{HealReport, Mesh, Soup, Topology, heal};
use umriss::run::Run;

/// Numbers that look like chance and are the same in every run.
#[derive(Debug, Clone)]
pub(crate) struct Random(pub(crate) u64);

impl Random {
    pub(crate) fn next(&mut self) -> u64 {
        split_mix(&mut self.0)
    }

    pub(crate) fn below(&mut self, bound: usize) -> usize {
        (self.next() % bound as u64) as usize
    }

    /// From -1 to 1.
    pub(crate) fn unit(&mut self) -> f64 {
        (self.next() >> 11) as f64 / (1_u64 << 52) as f64 - 1.0
    }

    /// In a ball of this radius.
    pub(crate) fn in_ball(&mut self, radius: f64) -> DVec3 {
        loop {
            let p = DVec3::new(self.unit(), self.unit(), self.unit());
            if p.length() <= 1.0 {
                return p * radius;
            }
        }
    }

    pub(crate) fn shuffle<T>(&mut self, list: &mut [T]) {
        for i in (1..list.len()).rev() {
            list.swap(i, self.below(i + 1));
        }
    }

    pub(crate) fn rotation(&mut self) -> DMat3 {
        let axis = (self.in_ball(1.0) + DVec3::Z * 1e-3).normalize();
        DMat3::from_quat(DQuat::from_axis_angle(axis, self.unit() * 3.0))
    }
}

/// Faces as their corners.
pub(crate) type Polygons = Vec<Vec<DVec3>>;

/// A prism over a star of so many corners, seen counter-clockwise from outside.
pub(crate) fn prism(random: &mut Random, corners: usize) -> Polygons {
    let radius = |random: &mut Random| 1.0 + 0.3 * random.unit();
    let rim: Vec<DVec3> = (0..corners)
        .map(|i| {
            let angle = std::f64::consts::TAU * i as f64 / corners as f64;
            radius(random) * DVec3::new(angle.cos(), angle.sin(), 0.0)
        })
        .collect();
    let height = DVec3::Z * (1.0 + 0.5 * random.unit());
    let mut faces = vec![rim.iter().rev().copied().collect::<Vec<_>>()];
    faces.push(rim.iter().map(|&p| p + height).collect());
    for i in 0..corners {
        let [a, b] = [rim[i], rim[(i + 1) % corners]];
        faces.push(vec![a, b, b + height, a + height]);
    }
    faces
}

/// An object of these faces, every corner a vertex of its own.
pub(crate) fn soup_of(name: &str, faces: &[Vec<DVec3>]) -> Soup {
    let mut soup = Soup { name: name.to_owned(), ..Soup::default() };
    for face in faces {
        let first = soup.vertices.len() as u32;
        soup.vertices.extend_from_slice(face);
        let ring: Vec<u32> = (first..soup.vertices.len() as u32).collect();
        soup.faces.push(&ring, []);
    }
    soup
}

/// Each corner of each face off by less than this, on its own.
pub(crate) fn torn(random: &mut Random, faces: &[Vec<DVec3>], by: f64) -> Polygons {
    let mut tear = |&p: &DVec3| p + random.in_ball(by);
    faces.iter().map(|face| face.iter().map(&mut tear).collect()).collect()
}

pub(crate) fn mapped(faces: &[Vec<DVec3>], map: impl Fn(DVec3) -> DVec3) -> Polygons {
    faces.iter().map(|face| face.iter().map(|&p| map(p)).collect()).collect()
}

/// As a text with so many decimals says it.
pub(crate) fn rounded(p: DVec3, decimals: usize) -> DVec3 {
    DVec3::from_array(p.to_array().map(|x| format!("{x:.decimals$}").parse().unwrap()))
}

/// As narrow floats say it.
pub(crate) fn narrow(p: DVec3) -> DVec3 {
    DVec3::from_array(p.to_array().map(|x| f64::from(x as f32)))
}

pub(crate) fn healed(soups: &[Soup], tolerance: f64) -> (Vec<Soup>, HealReport) {
    let mut healed = soups.to_vec();
    let report = heal(&mut healed, tolerance, &Run::default()).unwrap();
    (healed, report)
}

pub(crate) fn mesh(soups: &[Soup]) -> Mesh {
    let mesh = Mesh::new(soups.to_vec(), None).unwrap();
    mesh.sanity_check().unwrap();
    mesh
}

pub(crate) fn topology(soups: &[Soup]) -> Topology {
    Topology::of(&mesh(soups), &Default::default(), &Run::default()).unwrap()
}

/// A position as it is compared.
fn key(p: DVec3) -> [u64; 3] {
    p.to_array().map(|x| (x + 0.0).to_bits())
}

/// What objects are, whatever the order of their vertices, faces and corners:
/// faces by object; a face without area is none.
pub(crate) fn geometry(soups: &[Soup]) -> Vec<(String, Vec<Vec<[u64; 3]>>)> {
    let mut all: Vec<(String, Vec<Vec<[u64; 3]>>)> = soups
        .iter()
        .map(|soup| {
            let ring = |ring: &[u32]| {
                let mut keys: Vec<_> =
                    ring.iter().map(|&corner| key(soup.vertices[corner as usize])).collect();
                keys.dedup();
                while keys.len() > 1 && keys.first() == keys.last() {
                    keys.pop();
                }
                least_turn(&keys)
            };
            let faces = (0..soup.faces.len()).flat_map(|face| soup.faces.rings(face).map(ring));
            let mut faces: Vec<_> = faces.filter(|ring| ring.len() > 2).collect();
            faces.sort();
            (soup.name.clone(), faces)
        })
        .collect();
    all.sort();
    all
}

/// A ring from where and in the direction in which it reads least.
fn least_turn(ring: &[[u64; 3]]) -> Vec<[u64; 3]> {
    let turns = |ring: Vec<[u64; 3]>| {
        (0..ring.len()).map(move |start| [&ring[start..], &ring[..start]].concat())
    };
    let back: Vec<_> = ring.iter().rev().copied().collect();
    turns(ring.to_vec()).chain(turns(back)).min().unwrap_or_default()
}

/// The same objects with vertices, faces, windings, first corners and objects
/// in another order.
pub(crate) fn shuffled(random: &mut Random, soups: &[Soup]) -> Vec<Soup> {
    let mut shuffled: Vec<Soup> = soups
        .iter()
        .map(|soup| {
            let mut order: Vec<u32> = (0..soup.vertices.len() as u32).collect();
            random.shuffle(&mut order);
            let mut place = vec![0; order.len()];
            order.iter().enumerate().for_each(|(new, &old)| place[old as usize] = new as u32);
            let mut faces: Vec<usize> = (0..soup.faces.len()).collect();
            random.shuffle(&mut faces);
            let mut other = Soup { name: soup.name.clone(), ..Soup::default() };
            other.vertices = order.iter().map(|&old| soup.vertices[old as usize]).collect();
            for face in faces {
                let mut rings: Vec<Vec<u32>> =
                    soup.faces.rings(face).map(<[u32]>::to_vec).collect();
                for ring in &mut rings {
                    ring.iter_mut().for_each(|corner| *corner = place[*corner as usize]);
                    let turn = random.below(ring.len());
                    ring.rotate_left(turn);
                    if random.below(2) == 0 {
                        ring.reverse();
                    }
                }
                other.faces.push(&rings[0], rings[1..].iter().map(Vec::as_slice));
            }
            other
        })
        .collect();
    random.shuffle(&mut shuffled);
    shuffled
}

pub(crate) fn seeds() -> impl Strategy<Value = u64> {
    any::<u64>()
}

/// How far the vertices of an object are from where they were.
pub(crate) fn farthest(before: &[Soup], after: &[Soup]) -> f64 {
    let ways = before
        .iter()
        .zip(after)
        .flat_map(|(old, new)| old.vertices.iter().zip(&new.vertices).map(|(p, q)| p.distance(*q)));
    ways.fold(0.0, f64::max)
}
