use super::*;
use crate::model::import::read_bytes;
use crate::model::{Faces, Mesh};

/// A square with a hole and a triangle, of two objects.
fn holed() -> Vec<Soup> {
    let json = br##"{"vertices": [[0,0,0.1],[9,0,0.1],[9,9,0.1],[0,9,0.1],[1,1,0.1],[2,1,0.1],
        [1,2,0.1],[1e-300,-3.5e20,7]],
        "faces": [{"outer":[0,1,2,3],"holes":[[4,5,6]],"color":"#c0ffee","object":"lid"},
        {"outer":[0,1,7],"object":"fin"}]}"##;
    read_bytes("holed.json", json, None).unwrap().objects
}

fn triangles() -> Vec<Soup> {
    let json = br##"{"vertices": [[0,0,0.1],[9,0,0.1],[9,9,0.1],[1e-300,-3.5e20,7]],
        "faces": [{"outer":[0,1,2],"color":"#c0ffee","object":"lid plate"},
        {"outer":[0,1,3],"object":"fin"}]}"##;
    read_bytes("triangles.json", json, None).unwrap().objects
}

/// Vertices in order, and faces by their places.
fn places(objects: &[Soup]) -> Vec<Vec<[u64; 3]>> {
    let mut faces = Vec::new();
    for object in objects {
        for face in 0..object.faces.len() {
            let corners = object.faces.rings(face).flatten();
            let place = |&corner: &u32| object.vertices[corner as usize].to_array();
            faces.push(corners.map(|corner| place(corner).map(f64::to_bits)).collect());
        }
    }
    faces
}

#[test]
fn what_is_written_is_read_again_to_the_last_bit() {
    for format in [Format::Obj, Format::Off, Format::Ply, Format::PolygonScene] {
        let objects = triangles();
        let file = write_model(&objects, format).unwrap();
        let read = read_bytes("again", &file.bytes, Some(format)).unwrap();
        assert_eq!(places(&read.objects), places(&objects), "{format:?}");
        assert!(read.warnings.is_empty(), "{format:?}: {:?}", read.warnings);
    }
    let objects = holed();
    let file = write_model(&objects, Format::PolygonScene).unwrap();
    let read = read_bytes("again", &file.bytes, None).unwrap();
    assert_eq!(places(&read.objects), places(&objects));
    assert_eq!(read.objects[0].colors, objects[0].colors);
    assert_eq!(read.objects[1].name, "fin");
    assert!(file.left_out.is_empty());
}

#[test]
fn what_a_format_cannot_say_is_told_or_refused() {
    assert!(matches!(write_model(&holed(), Format::Obj), Err(ExportError::Holes("obj"))));
    assert!(matches!(write_model(&holed(), Format::Gltf), Err(ExportError::ModelFormat(_))));
    let left_out = |format| write_model(&triangles(), format).unwrap().left_out;
    assert_eq!(left_out(Format::Obj), ["colours"]);
    assert_eq!(left_out(Format::Ply), ["the names of objects"]);
    assert_eq!(left_out(Format::Off), ["the names of objects", "colours"]);
}

#[test]
fn stl_has_the_triangles_of_the_mesh_in_narrow_floats() {
    let file = write_model(&holed(), Format::Stl).unwrap();
    let read = read_bytes("again.stl", &file.bytes, None).unwrap().objects;
    let mesh = Mesh::new(holed(), None).unwrap();
    let places = read[0].faces.corners().iter().map(|&corner| read[0].vertices[corner as usize]);
    let wanted = mesh.triangles().iter().flatten().map(|&corner| mesh.vertices()[corner as usize]);
    let wanted = wanted.map(|place| place.as_vec3().as_dvec3());
    assert!(mesh.triangles().len() > 5);
    assert!(places.eq(wanted));
}

#[test]
fn faces_that_collapsed_are_left_out_and_equal_places_are_one() {
    let mut faces = Faces::default();
    faces.push(&[0, 1, 2], []);
    faces.push(&[3, 4, 5], []);
    let vertices = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [-0.0, 0.0, 0.0]];
    let vertices = [&vertices[..], &[[1.0, 0.0, 0.0]; 2]].concat();
    let vertices = vertices.into_iter().map(DVec3::from_array).collect();
    let soup = Soup { vertices, faces, lines: vec![[3, 4]], ..Soup::default() };
    let file = write_model(&[soup], Format::Obj).unwrap();
    let text = String::from_utf8(file.bytes).unwrap();
    assert_eq!(text, "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\nl 1 2\n");
}
