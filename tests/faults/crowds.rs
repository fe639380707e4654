//! Models that are a lot of work for their size.

use crate::split_mix::split_mix;
use glam::DVec3;
use std::path::Path;
use tempfile::TempDir;
use umriss::model::{Faces, Mesh, Soup};

/// Numbers from 0 to 1, the same in every run.
pub(crate) struct Random(u64);

impl Random {
    pub(crate) fn new(seed: u64) -> Self {
        Random(seed)
    }

    pub(crate) fn next(&mut self) -> f64 {
        (split_mix(&mut self.0) >> 11) as f64 / (1_u64 << 53) as f64
    }

    fn point(&mut self) -> DVec3 {
        DVec3::new(self.next(), self.next(), self.next())
    }
}

fn soup(vertices: Vec<DVec3>) -> Soup {
    let faces = Faces::from_triangles((0..vertices.len() as u32).collect());
    Soup { name: "crowd".into(), vertices, faces, ..Soup::default() }
}

/// Triangles with corners anywhere in a cube: nearly all of them overlap in
/// every view, and a fifth of all pairs pass through one another.
pub(crate) fn through_one_another(count: usize) -> Soup {
    let mut random = Random::new(7);
    soup((0..3 * count).map(|_| random.point()).collect())
}

/// Large triangles at depths of their own: all overlap in the image, and none
/// meet in space.
pub(crate) fn in_front_of_one_another(count: usize) -> Soup {
    let mut random = Random::new(8);
    let corner = |i: usize| {
        let point = random.point();
        DVec3::new(point.x, point.y, (i / 3) as f64 * 1e-3)
    };
    soup((0..3 * count).map(corner).collect())
}

/// A mesh of one soup.
pub(crate) fn mesh(soup: Soup) -> Mesh {
    Mesh::new(vec![soup], None).unwrap()
}

/// A binary STL file of a soup of triangles.
pub(crate) fn stl(soup: &Soup) -> Vec<u8> {
    let mut bytes = vec![0; 80];
    bytes.extend((soup.vertices.len() as u32 / 3).to_le_bytes());
    for facet in soup.vertices.chunks(3) {
        bytes.extend([0; 12]);
        for number in facet.iter().flat_map(|corner| corner.to_array()) {
            bytes.extend((number as f32).to_le_bytes());
        }
        bytes.extend([0; 2]);
    }
    bytes
}

/// A folder with one file in it.
pub(crate) fn folder_with(name: &str, bytes: &[u8]) -> TempDir {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join(name), bytes).unwrap();
    folder
}

/// The names in a folder, sorted.
pub(crate) fn names(folder: &Path) -> Vec<String> {
    let entries = std::fs::read_dir(folder).unwrap();
    let mut names: Vec<String> =
        entries.map(|entry| entry.unwrap().file_name().into_string().unwrap()).collect();
    names.sort();
    names
}
