//! The mesh: all objects of a scene in flat arrays, welded within each
//! object, with edges and adjacency.
//!
//! Vertices, triangles and edges are numbered through the whole scene;
//! objects are ranges of them. Nothing is assumed about the soup: it may be
//! open, non-manifold, inconsistently wound, and pass through itself.

use super::adjacency::edges_of;
use super::borders::Borders;
use super::crossed::CrossedFaces;
use super::faces::{Source, Triangles, are_polygonal};
use super::weld::{merge_close, weld};
use super::{Color, Edges, FacePlace, FacePlaces, Precision, Soup};
use crate::run::{Cancelled, Run, map_chunks, map_small};
use glam::DVec3;
use std::ops::Range;

/// One object: a name and its ranges in the arrays of the [`Mesh`].
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Object {
    /// The name from the file; empty if it has none.
    pub name: String,
    /// Its vertices.
    pub vertices: Range<u32>,
    /// Its triangles.
    pub triangles: Range<u32>,
    /// Its faces, counting those set aside.
    pub faces: Range<u32>,
    /// Its loose lines.
    pub loose_lines: Range<u32>,
    /// Where its faces stand in their file.
    pub places: FacePlaces,
}

/// What was done to the faces and vertices of the files.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct MeshReport {
    /// Vertices that fell together with an earlier one.
    pub welded_vertices: usize,
    /// Vertices moved by a welding tolerance.
    pub merged_vertices: usize,
    /// Faces without area, set aside.
    pub zero_area_faces: usize,
    /// Faces that are an earlier one again, whichever way round, set aside.
    pub duplicate_faces: usize,
    /// Polygons whose corners are not coplanar, taken as their triangles.
    pub nonplanar_faces: usize,
    /// Polygons that cross themselves. Their crossings, rounded, are vertices;
    /// those that stay crossed however often are taken as their edges.
    pub crossed_faces: usize,
    /// Loose lines of length zero, set aside.
    pub zero_length_lines: usize,
}

/// A scene that cannot become a mesh.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
pub enum MeshError {
    /// No faces and no lines in any file.
    #[error("the model is empty: expected at least one face or line")]
    Empty,
    /// Numbers are 32 bits wide.
    #[error("the model has {0} {1}: expected at most 1431655765")]
    TooLarge(usize, &'static str),
    /// The run was stopped.
    #[error(transparent)]
    Cancelled(#[from] Cancelled),
}

/// All objects of a scene.
#[derive(Debug, Clone, Default)]
pub struct Mesh {
    vertices: Vec<DVec3>,
    vertex_numbers: Vec<u32>,
    triangles: Vec<[u32; 3]>,
    faces: Option<Vec<u32>>,
    polygonal: bool,
    edges: Edges,
    loose_lines: Vec<[u32; 2]>,
    objects: Vec<Object>,
    colors: Vec<Option<Color>>,
    borders: Borders,
    crossed_faces: Vec<u32>,
    /// That of each object.
    precisions: Vec<Precision>,
    report: MeshReport,
}

/// The largest number of vertices or triangles: three half-edges each have
/// to be numbered with 32 bits.
const MOST: usize = (u32::MAX / 3) as usize;

impl Mesh {
    /// Welds, triangulates and connects the objects of a scene.
    ///
    /// `tolerance` merges vertices of one object that are closer than this
    /// (world units) before anything else. Expected O(n).
    ///
    /// # Errors
    ///
    /// If there is nothing to draw, or more than 32-bit numbers can name.
    pub fn new(soups: Vec<Soup>, tolerance: Option<f64>) -> Result<Self, MeshError> {
        Self::within(soups, tolerance, &Run::default())
    }

    /// As [`Mesh::new`], asking a run whether to go on, between steps that are
    /// linear each, and whether there is memory enough.
    ///
    /// # Errors
    ///
    /// As [`Mesh::new`]; and if the run is cancelled or reaches a limit.
    pub fn within(
        mut soups: Vec<Soup>,
        tolerance: Option<f64>,
        run: &Run<'_>,
    ) -> Result<Self, MeshError> {
        run.take(soups.iter().map(bytes_of_mesh).sum())?;
        let mut report = MeshReport::default();
        let (mut positions, mut first_vertex) =
            welded_positions(&mut soups, tolerance, &mut report)?;
        let mut crossed = CrossedFaces::default();
        let (welded, vertices, mut triangles) = loop {
            run.check()?;
            let welded = weld(&positions, &first_vertex);
            run.check()?;
            report.welded_vertices = positions.len() - welded.first_old.len();
            // Adding 0 turns -0 into 0, so that equal positions have equal bits.
            let vertices = map_small(welded.first_old.len(), |i| {
                positions[welded.first_old[i] as usize] + DVec3::ZERO
            });
            if !are_polygonal(&soups) {
                positions = Vec::new();
            }
            run.check()?;
            let source = Source {
                soups: &soups,
                first_vertex: &first_vertex,
                new_of_old: &welded.new_of_old,
                vertices: &vertices,
                crossed: &crossed,
            };
            let mut triangles = Triangles::of(&source, run);
            run.check()?;
            let crossing = std::mem::take(&mut triangles.crossing);
            if crossing.is_empty() {
                break (welded, vertices, triangles);
            }
            crossed.mend(&mut soups, &mut positions, &mut first_vertex, crossing);
        };
        drop(positions);
        let vertex_numbers = file_numbers(&soups, &first_vertex, &welded.first_old);
        run.check()?;
        let mut edges = edges_of(&triangles.corners, vertices.len());
        run.check()?;
        report.duplicate_faces = triangles.drop_duplicates(&edges);
        if report.duplicate_faces > 0 {
            edges = edges_of(&triangles.corners, vertices.len());
        }
        triangles.report(&mut report);
        let mut mesh = Mesh {
            vertices,
            vertex_numbers,
            triangles: triangles.corners,
            faces: triangles.faces,
            polygonal: triangles.polygonal,
            crossed_faces: triangles.crossed,
            edges,
            report,
            ..Mesh::default()
        };
        mesh.add_objects(soups, &first_vertex, &welded.new_of_old, &welded.first_old);
        if mesh.triangles.is_empty() && mesh.loose_lines.is_empty() {
            return Err(MeshError::Empty);
        }
        run.check()?;
        mesh.borders = Borders::find(&mesh);
        Ok(mesh)
    }

    /// Vertices, all of them different, and loose lines between them; one
    /// object without a face. O(n).
    ///
    /// # Errors
    ///
    /// If there is no line.
    pub fn of_lines(
        name: &str,
        vertices: Vec<DVec3>,
        lines: Vec<[u32; 2]>,
    ) -> Result<Self, MeshError> {
        if lines.is_empty() {
            return Err(MeshError::Empty);
        }
        let object = Object {
            name: name.to_owned(),
            vertices: 0..vertices.len() as u32,
            triangles: 0..0,
            faces: 0..0,
            loose_lines: 0..lines.len() as u32,
            places: FacePlaces::default(),
        };
        Ok(Mesh {
            vertex_numbers: (0..vertices.len() as u32).collect(),
            vertices,
            loose_lines: lines,
            objects: vec![object],
            precisions: vec![Precision::default()],
            ..Mesh::default()
        })
    }

    /// Fills in the objects, their loose lines and colours.
    fn add_objects(
        &mut self,
        soups: Vec<Soup>,
        first_vertex: &[u32],
        new_of_old: &[u32],
        first_old: &[u32],
    ) {
        let mut first_face = 0;
        for (i, soup) in soups.into_iter().enumerate() {
            let old_end = first_vertex.get(i + 1).copied().unwrap_or(u32::MAX);
            let vertex_start = first_old.partition_point(|&old| old < first_vertex[i]) as u32;
            let vertex_end = first_old.partition_point(|&old| old < old_end) as u32;
            let faces = first_face..first_face + soup.faces.len() as u32;
            first_face = faces.end;
            let line_start = self.loose_lines.len() as u32;
            for line in &soup.lines {
                let [a, b] = line.map(|old| new_of_old[(first_vertex[i] + old) as usize]);
                if a == b {
                    self.report.zero_length_lines += 1;
                } else {
                    self.loose_lines.push([a, b]);
                }
            }
            let triangles = self.triangles_of_faces(&faces);
            if let Some(colors) = soup.colors {
                self.colors.resize(faces.start as usize, None);
                self.colors.extend(colors);
            }
            self.precisions.push(soup.precision);
            self.objects.push(Object {
                name: soup.name,
                vertices: vertex_start..vertex_end,
                triangles,
                faces,
                loose_lines: line_start..self.loose_lines.len() as u32,
                places: soup.places,
            });
        }
    }

    /// The triangles of a range of faces: triangles are ordered by face.
    fn triangles_of_faces(&self, faces: &Range<u32>) -> Range<u32> {
        match &self.faces {
            None => faces.clone(),
            Some(list) => {
                let find = |face| list.partition_point(|&other| other < face) as u32;
                find(faces.start)..find(faces.end)
            }
        }
    }

    /// Positions, world units. Equal positions of one object are one vertex.
    pub fn vertices(&self) -> &[DVec3] {
        &self.vertices
    }

    /// Triangles: three vertices each, in the file's winding.
    pub fn triangles(&self) -> &[[u32; 3]] {
        &self.triangles
    }

    /// Edges and their triangles.
    pub fn edges(&self) -> &Edges {
        &self.edges
    }

    /// Edges of one face that lie on others of their kind.
    pub fn borders(&self) -> &Borders {
        &self.borders
    }

    /// Loose lines (OBJ `l`).
    pub fn loose_lines(&self) -> &[[u32; 2]] {
        &self.loose_lines
    }

    /// The objects in the order of the files.
    pub fn objects(&self) -> &[Object] {
        &self.objects
    }

    /// What was welded and set aside.
    pub fn report(&self) -> MeshReport {
        self.report
    }

    /// The number of faces in the files, set aside or not.
    pub fn face_count(&self) -> usize {
        self.objects.last().map_or(0, |object| object.faces.end as usize)
    }

    /// The face of a triangle, numbered through the scene.
    #[inline(always)]
    pub fn face_of(&self, triangle: u32) -> u32 {
        self.faces.as_ref().map_or(triangle, |faces| faces[triangle as usize])
    }

    /// The number of a triangle's face within its object, in the file's order,
    /// counted from 0.
    pub fn face_number(&self, triangle: u32) -> u32 {
        let object = self.object_of_triangle(triangle);
        self.face_of(triangle) - self.objects[object as usize].faces.start
    }

    /// Faces that cross themselves, ascending, numbered through the scene.
    pub fn crossed_faces(&self) -> &[u32] {
        &self.crossed_faces
    }

    /// The object of a face, and where the face stands in its file.
    pub fn place_of_face(&self, face: u32) -> (&Object, FacePlace) {
        let object = self.objects.partition_point(|object| object.faces.end <= face);
        let object = &self.objects[object];
        (object, object.places.place_of(face - object.faces.start))
    }

    /// The colour that the file gives a face.
    pub fn color_of(&self, face: u32) -> Option<Color> {
        self.colors.get(face as usize).copied().flatten()
    }

    /// Whether some face is more than one triangle.
    pub(super) fn has_polygons(&self) -> bool {
        self.polygonal
    }

    /// Whether an edge is an inner edge of one polygon's triangulation.
    #[inline(always)]
    pub fn is_inner(&self, edge: u32) -> bool {
        self.polygonal
            && matches!(self.edges.triangles(edge), &[s, t] if self.face_of(s) == self.face_of(t))
    }

    /// The triangles at an edge whose faces end there: all but those of
    /// polygons that are cut along the edge.
    pub fn bordering(&self, edge: u32) -> impl Iterator<Item = u32> + '_ {
        let triangles = self.edges.triangles(edge);
        triangles.iter().copied().filter(move |&triangle| {
            let face = self.face_of(triangle);
            let twin = |&other: &u32| other != triangle && self.face_of(other) == face;
            !(self.polygonal && triangles.iter().any(twin))
        })
    }

    /// The triangles of the faces to which an edge belongs: those that end
    /// there, and where none does, those of the polygon that is cut along it.
    pub fn faces_at(&self, edge: u32) -> Vec<u32> {
        let bordering: Vec<u32> = self.bordering(edge).collect();
        if bordering.is_empty() { self.edges.triangles(edge).to_vec() } else { bordering }
    }

    /// The number of a vertex in its file, counted from 0.
    pub fn vertex_number(&self, vertex: u32) -> u32 {
        self.vertex_numbers[vertex as usize]
    }

    /// The object of a vertex.
    pub fn object_of_vertex(&self, vertex: u32) -> u32 {
        self.objects.partition_point(|object| object.vertices.end <= vertex) as u32
    }

    /// The object of a triangle.
    pub fn object_of_triangle(&self, triangle: u32) -> u32 {
        self.objects.partition_point(|object| object.triangles.end <= triangle) as u32
    }

    /// The corner of `triangle` that is neither `a` nor `b`.
    #[inline(always)]
    pub fn third(&self, triangle: u32, [a, b]: [u32; 2]) -> u32 {
        let [x, y, z] = self.triangles[triangle as usize];
        if x != a && x != b {
            x
        } else if y != a && y != b {
            y
        } else {
            z
        }
    }

    /// Whether `triangle` runs along the edge from `a` to `b` in its own
    /// winding.
    #[inline(always)]
    pub fn runs_along(&self, triangle: u32, [a, b]: [u32; 2]) -> bool {
        let [x, y, z] = self.triangles[triangle as usize];
        (x == a && y == b) || (y == a && z == b) || (z == a && x == b)
    }

    /// The distance within which places of the files may be one, the largest
    /// of all objects: [`Precision::resolution`]. O(n).
    pub fn resolution(&self) -> f64 {
        let objects = self.objects.iter().zip(&self.precisions);
        let of = |(object, precision): (&Object, &Precision)| {
            let vertices = object.vertices.start as usize..object.vertices.end as usize;
            precision.resolution(&self.vertices[vertices])
        };
        objects.map(of).fold(0.0, f64::max)
    }

    /// The box of all triangles and loose lines as (least, greatest) corner.
    /// Vertices that nothing uses are no part of what is seen. O(n).
    pub fn bounds(&self) -> (DVec3, DVec3) {
        let empty = (DVec3::INFINITY, DVec3::NEG_INFINITY);
        let join = |a: (DVec3, DVec3), b: (DVec3, DVec3)| (a.0.min(b.0), a.1.max(b.1));
        let add = |bounds, &vertex: &u32| {
            let p = self.vertices[vertex as usize];
            join(bounds, (p, p))
        };
        let boxes = map_chunks(self.triangles.len(), 1 << 16, |part| {
            self.triangles[part].as_flattened().iter().fold(empty, add)
        });
        let lines = self.loose_lines.as_flattened().iter().fold(empty, add);
        boxes.into_iter().fold(lines, join)
    }
}

/// What the arrays of a mesh take for a soup: positions, numbers and their
/// table; triangles, faces, and three halves of an edge for each.
fn bytes_of_mesh(soup: &Soup) -> u64 {
    (soup.vertices.len() * 40 + soup.faces.len() * 48 + soup.lines.len() * 8) as u64
}

/// Moves all positions into one array, if they can be numbered, and merges
/// those that are closer than a tolerance; with the first vertex of each soup.
fn welded_positions(
    soups: &mut [Soup],
    tolerance: Option<f64>,
    report: &mut MeshReport,
) -> Result<(Vec<DVec3>, Vec<u32>), MeshError> {
    let total: usize = soups.iter().map(|soup| soup.vertices.len()).sum();
    let corners: usize = soups.iter().map(|soup| soup.faces.len()).sum();
    if corners > MOST {
        return Err(MeshError::TooLarge(corners, "faces"));
    }
    if total > u32::MAX as usize / 2 * 2 - 1 {
        return Err(MeshError::TooLarge(total, "vertices"));
    }
    let (mut positions, first_vertex) = super::soup::take_positions(soups);
    if let Some(tolerance) = tolerance.filter(|&tolerance| tolerance > 0.0) {
        report.merged_vertices = merge_close(&mut positions, &first_vertex, tolerance);
    }
    Ok((positions, first_vertex))
}

/// The file's number of each new vertex.
fn file_numbers(soups: &[Soup], first_vertex: &[u32], first_old: &[u32]) -> Vec<u32> {
    map_small(first_old.len(), |new| {
        let old = first_old[new];
        let soup = first_vertex.partition_point(|&first| first <= old) - 1;
        let index = old - first_vertex[soup];
        soups[soup].vertex_numbers.as_ref().map_or(index, |numbers| numbers[index as usize])
    })
}
