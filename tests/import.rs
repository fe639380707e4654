//! Good files of every format and exactly what they say.

use glam::DVec3;
use umriss::model::import::{Format, Imported, read_bytes, read_file};
use umriss::model::{Color, Soup};

fn import(name: &str, bytes: &[u8]) -> Imported {
    match read_bytes(name, bytes, None) {
        Ok(imported) => imported,
        Err(error) => panic!("{error}"),
    }
}

fn only(imported: Imported) -> Soup {
    assert_eq!(imported.warnings, Vec::<String>::new());
    let [object] = <[Soup; 1]>::try_from(imported.objects).expect("one object");
    object
}

fn points(soup: &Soup) -> Vec<[f64; 3]> {
    soup.vertices.iter().map(DVec3::to_array).collect()
}

fn faces(soup: &Soup) -> Vec<Vec<Vec<u32>>> {
    (0..soup.faces.len())
        .map(|face| soup.faces.rings(face).map(<[u32]>::to_vec).collect())
        .collect()
}

const SQUARE: [[f64; 3]; 4] = [[0., 0., 0.], [1., 0., 0.], [1., 1., 0.], [0., 1., 0.]];

mod obj {
    use super::*;

    #[test]
    fn polygons_polylines_and_numbers_of_every_kind() {
        let text = "\u{feff}# a square\r\nmtllib a.mtl\nv 0 0 0 1.0\r\nv +1.0 0.0e0 -0 .5 .5 .5\n\
                    v 1 1. 0\nv 0 1e0 \\\n 0\nvn 0 0 1\ns off\nf 1 -3 3//1 4/2/1\nl 1 3 4\n";
        let soup = only(import("a.obj", text.as_bytes()));
        assert_eq!(points(&soup), SQUARE);
        assert_eq!(faces(&soup), [[[0, 1, 2, 3]]]);
        assert_eq!(soup.lines, [[0, 2], [2, 3]]);
        assert_eq!((soup.name.as_str(), soup.vertex_numbers), ("", None));
    }

    #[test]
    fn decimals_are_rounded_correctly() {
        let text = "v 0.1 9007199254740993 2.2250738585072011e-308\nf 1 1 1";
        let soup = only(import("a.obj", text.as_bytes()));
        assert_eq!(points(&soup), [[0.1, 9007199254740992.0, 2.225073858507201e-308]]);
    }

    #[test]
    fn objects_get_the_vertices_they_use() {
        let text = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3\no left\ng ignored\nf 4 3 1\nl 4 2\n\
                    o empty\no right\nf 2 3 4\n";
        let imported = import("a.obj", text.as_bytes());
        let names: Vec<_> = imported.objects.iter().map(|object| object.name.as_str()).collect();
        assert_eq!(names, ["", "left", "right"]);
        let left = &imported.objects[1];
        assert_eq!(left.vertex_numbers, Some(vec![0, 1, 2, 3]));
        assert_eq!(faces(left), [[[3, 2, 0]]]);
        assert_eq!(left.lines, [[3, 1]]);
        let right = &imported.objects[2];
        assert_eq!(right.vertex_numbers, Some(vec![1, 2, 3]));
        assert_eq!(points(right), SQUARE[1..]);
        assert_eq!(faces(right), [[[0, 1, 2]]]);
    }

    #[test]
    fn groups_are_objects_where_there_is_no_object() {
        let text = "v 0 0 0\nv 1 0 0\nv 1 1 0\ng a b\nf 1 2 3\ng c\nf 3 2 1\n";
        let imported = import("a.obj", text.as_bytes());
        let names: Vec<_> = imported.objects.iter().map(|object| object.name.as_str()).collect();
        assert_eq!(names, ["a b", "c"]);
    }

    #[test]
    fn faces_may_come_before_their_vertices() {
        let soup = only(import("a.obj", b"f 1 2 3\nv 0 0 0\nv 1 0 0\nv 1 1 0"));
        assert_eq!(points(&soup), SQUARE[..3]);
    }

    #[test]
    fn unknown_statements_warn_once_each() {
        let imported = import("a.obj", b"v 0 0 0\ncurv 1\ncurv 2\np 1\n");
        assert_eq!(
            imported.warnings,
            ["statements 'curv' are ignored (line 2)", "statements 'p' are ignored (line 4)"]
        );
    }

    #[test]
    fn comment_that_ends_in_a_backslash_ends_there() {
        let soup = only(import("a.obj", b"# C:\\models\\\nv 0 0 0\nv 1 0 0 # x \\\nv 1 1 0\n"));
        assert_eq!(points(&soup), SQUARE[..3]);
    }

    #[test]
    fn million_corners_in_one_line() {
        let mut text = String::from("v 0 0 0\nv 1 0 0\nv 1 1 0\nf");
        for corner in 0..1_000_000 {
            text.push_str([" 1", " 2", " 3"][corner % 3]);
        }
        let soup = only(import("a.obj", text.as_bytes()));
        assert_eq!(soup.faces.rings(0).next().map(<[u32]>::len), Some(1_000_000));
    }
}

/// Small files from the field, and what they say.
#[cfg(all(feature = "ply", feature = "gltf"))]
mod field {
    use super::*;

    fn read(name: &str) -> Result<Imported, String> {
        read_file(&std::path::Path::new("tests/field").join(name), None).map_err(|error| {
            let text = error.to_string();
            text.strip_prefix("tests/field/").map_or(text.clone(), str::to_owned)
        })
    }

    fn object(name: &str) -> Soup {
        only(read(name).expect(name))
    }

    const TETRAHEDRON: [[f64; 3]; 4] = [[0., 0., 0.], [1., 0., 0.], [0., 1., 0.], [0., 0., 1.]];
    const SIDES: [[u32; 3]; 4] = [[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]];

    fn triangles(soup: &Soup) -> &[u32] {
        soup.faces.as_triangles().expect("triangles")
    }

    #[test]
    fn lines_end_in_cr() {
        let bent = [[0., 0., 0.], [1., 0., 0.], [0., 1., 0.], [1., 1., 0.5]];
        let ply = object("ply_cr.ply");
        assert_eq!((points(&ply), triangles(&ply)), (bent.to_vec(), &[0, 1, 2, 1, 3, 2][..]));
        let stl = object("stl_cr.stl");
        let corners = [[0., 0., 0.], [1., 0., 0.], [0., 1., 0.], [1., 0., 0.], [1., 1., 0.]];
        assert_eq!(points(&stl)[..5], corners);
        assert_eq!((stl.name.as_str(), triangles(&stl).len()), ("part", 6));
        let off = object("off_cr.off");
        assert_eq!((points(&off), triangles(&off)), (SQUARE.to_vec(), &[0, 1, 2, 0, 2, 3][..]));
    }

    #[test]
    fn text_formats_have_more_than_one_form() {
        let strips = object("ply_tristrips.ply");
        assert_eq!(triangles(&strips), [0, 1, 2, 1, 3, 2, 0, 2, 1]);
        let off = object("off_face_over_lines.off");
        assert_eq!((points(&off), triangles(&off)), (SQUARE.to_vec(), &[0, 1, 2, 0, 2, 3][..]));
        let ply = read("ply_header_line_without_comment.ply").expect("read");
        assert_eq!(ply.warnings, ["the header line 'Created' is ignored (line 3)"]);
        assert_eq!(triangles(&ply.objects[0]), [0, 1, 2, 1, 3, 2]);
        let obj = read("obj_unknown_statement.obj").expect("read");
        assert_eq!(obj.warnings, ["statements '$' are ignored (line 2)"]);
        assert_eq!(points(&obj.objects[0]), TETRAHEDRON);
        assert_eq!(triangles(&obj.objects[0]), SIDES.as_flattened());
    }

    #[test]
    fn errors_are_told_where_they_are() {
        for (name, message) in [
            (
                "stl_nul.stl",
                "5: byte 80 of the file is the control byte 0x00, expected a coordinate",
            ),
            ("stl_vertex_with_two_numbers.stl", "5: the line ends here, expected a coordinate"),
            ("gltf1.gltf", "3: glTF 1.0, expected 2.0"),
            (
                "gltf_draco_not_declared_required.gltf",
                "27: the mesh is compressed by KHR_draco_mesh_compression, expected one that is not",
            ),
        ] {
            assert_eq!(read(name).expect_err(name), format!("{name}:{message}"));
        }
    }

    #[test]
    fn what_is_not_drawn_may_be_anything() {
        let tetrahedron = |soup: &Soup| {
            assert_eq!(points(soup), TETRAHEDRON);
            assert_eq!(triangles(soup), SIDES.as_flattened());
        };
        tetrahedron(&object("gltf_extras_number.gltf"));
        for (name, warning) in [
            (
                "gltf_animation_channel_without_node.gltf",
                "animations are ignored: nodes stand where the file puts them",
            ),
            (
                "gltf_techniques_required.gltf",
                "the required extension 'KHR_techniques_webgl' is ignored",
            ),
        ] {
            let imported = read(name).expect(name);
            assert_eq!(imported.warnings, [warning]);
            tetrahedron(&imported.objects[0]);
        }
        // Its second primitive is three corners at the origin.
        let zeros = object("gltf_accessor_of_zeros.gltf");
        assert_eq!(points(&zeros), [&TETRAHEDRON[..], &[[0.; 3]; 3]].concat());
        assert_eq!(triangles(&zeros), [SIDES.as_flattened(), &[4, 5, 6]].concat());
    }

    #[test]
    fn morph_targets_are_applied() {
        let moved = object("gltf_morph_weight_1.gltf");
        assert_eq!(points(&moved), [&TETRAHEDRON[..3], &[[0., 0., 6.]]].concat());
    }

    #[test]
    fn all_instances_are_there() {
        for (name, places) in
            [("gltf_gpu_instancing.gltf", [0., 3., 6.]), ("inst.gltf", [0., 3., 6.])]
        {
            let imported = read(name).expect(name);
            assert_eq!(imported.warnings, Vec::<String>::new());
            let names: Vec<_> = imported.objects.iter().map(|one| one.name.as_str()).collect();
            assert_eq!(names, ["mesh 0 #1", "mesh 0 #2", "mesh 0 #3"]);
            let first = &imported.objects[0];
            for (object, x) in imported.objects.iter().zip(places) {
                let moved = first.vertices.iter().map(|&vertex| vertex + DVec3::X * x);
                assert_eq!(object.vertices, moved.collect::<Vec<_>>(), "{name}");
                assert_eq!(object.faces, first.faces);
            }
        }
        let boxes = read("inst.gltf").expect("read");
        assert_eq!(
            boxes.objects[0].vertices.iter().max_by(|a, b| a.length().total_cmp(&b.length())),
            Some(&DVec3::new(1., 2., 3.))
        );
    }
}

mod stl {
    use super::*;

    pub(super) fn binary(header: &[u8], facets: &[[f32; 9]]) -> Vec<u8> {
        let mut bytes = header.to_vec();
        bytes.resize(80, b' ');
        bytes.extend((facets.len() as u32).to_le_bytes());
        for facet in facets {
            bytes.extend([0; 12]);
            bytes.extend(facet.iter().flat_map(|number| number.to_le_bytes()));
            bytes.extend([0, 0]);
        }
        bytes
    }

    #[test]
    fn binary_that_begins_with_solid() {
        let facet = [0., 0., 0., 1., 0., 0., 0.1, -0.0, 3.];
        let next = [1., 0., 0., 0., 0., 0., 7., 7., 7.];
        let soup = only(import("noname", &binary(b"solid facet", &[facet, next])));
        let corner = [f64::from(0.1_f32), -0.0, 3.];
        assert_eq!(points(&soup), [SQUARE[0], SQUARE[1], corner, [7., 7., 7.]]);
        assert!(soup.vertices[2].y.is_sign_negative());
        // Corners seen lately are one vertex, numbered where it stood first.
        assert_eq!(soup.faces.as_triangles(), Some(&[0, 1, 2, 1, 0, 3][..]));
        assert_eq!(soup.vertex_numbers, Some(vec![0, 1, 2, 5]));
    }

    #[test]
    fn binary_of_many_facets_keeps_every_corner() {
        // More vertices than are remembered, in parts that are joined.
        let number = |i: usize| ((i * 7919) % 40_009) as f32;
        let facets: Vec<[f32; 9]> = (0..70_000)
            .map(|i| std::array::from_fn(|k| if k % 3 == 0 { number(i / 2 + k) } else { k as f32 }))
            .collect();
        let soup = only(import("a.stl", &binary(b"many", &facets)));
        let corners = soup.faces.as_triangles().expect("nothing but triangles");
        let numbers = soup.vertex_numbers.as_ref().expect("numbers of corners");
        assert_eq!(corners.len(), 3 * facets.len());
        assert!(soup.vertices.len() < corners.len());
        for (at, &corner) in corners.iter().enumerate() {
            let wanted = &facets[at / 3][at % 3 * 3..][..3];
            let found = soup.vertices[corner as usize].to_array();
            assert_eq!(found.map(|x| x as f32)[..], *wanted, "corner {at}");
            assert!(numbers[corner as usize] <= at as u32);
        }
    }

    /// A file is read by several tasks at once, bytes by one after the other.
    #[test]
    fn files_are_read_as_their_bytes_are() {
        let count = 100_000_u32;
        let mut bytes = vec![b' '; 80];
        bytes.extend(count.to_le_bytes());
        for facet in 0..count {
            bytes.extend([0; 12]);
            for corner in [facet, facet + 1, 3 * facet] {
                let place = [corner as f32, -0.0, (corner % 7) as f32];
                place.iter().for_each(|x| bytes.extend(x.to_le_bytes()));
            }
            bytes.extend([0; 2]);
        }
        let folder = tempfile::tempdir().expect("a folder");
        let file = folder.path().join("a.stl");
        let both = |bytes: &[u8]| {
            std::fs::write(&file, bytes).expect("a file");
            [read_file(&file, None), read_bytes(&file.display().to_string(), bytes, None)]
                .map(|read| read.map_err(|error| error.to_string()))
        };
        let [file, bytes_alone] = both(&bytes);
        assert_eq!(file, bytes_alone);
        assert_eq!(file.map(|read| read.objects[0].faces.len()), Ok(count as usize));
        // In the third task, behind another one in the fourth.
        for facet in [99_000, 70_001] {
            bytes[84 + 50 * facet + 28..][..4].copy_from_slice(&f32::NAN.to_le_bytes());
            let [file, bytes_alone] = both(&bytes);
            assert_eq!(file, bytes_alone);
            let text = file.expect_err("not a number");
            assert!(text.contains(&format!("byte {}", 84 + 50 * facet + 28)), "{text}");
        }
        for bytes in [&bytes[..bytes.len() - 1], &[&bytes[..], b"xy"].concat()] {
            let [file, bytes_alone] = both(bytes);
            assert_eq!(file, bytes_alone);
        }
    }

    #[test]
    fn few_bytes_after_the_last_facet_warn() {
        let mut bytes = binary(b"x", &[[0.; 9]]);
        bytes.extend(b"end");
        let imported = import("a.stl", &bytes);
        assert_eq!(imported.warnings, ["3 bytes after the last facet are ignored"]);
        assert_eq!(imported.objects[0].faces.len(), 1);
    }

    #[test]
    fn text_with_two_solids() {
        let facet = "FACET normal nan 0 0 OUTER LOOP vertex 0 0 0\nvertex 1 0 0 \
                     vertex 1 1 0.1 endloop endfacet\n";
        let text = format!("solid first one\r\n{facet}endsolid first one\nSOLID\nendsolid\n");
        let imported = import("a", text.as_bytes());
        assert_eq!(imported.format, Format::Stl);
        let [first, second] = &imported.objects[..] else { panic!("two objects") };
        assert_eq!(first.name, "first one");
        assert_eq!(points(first), [SQUARE[0], SQUARE[1], [1., 1., 0.1]]);
        assert_eq!((second.name.as_str(), second.faces.len()), ("", 0));
    }
}

#[cfg(feature = "ply")]
mod ply {
    use super::*;

    const HEADER: &str = "comment by hand\nelement vertex 4\nproperty double z\n\
        property float confidence\nproperty short x\nproperty uchar y\nelement junk 1\n\
        property list uchar ushort much\nproperty int more\nelement face 2\n\
        property list uchar int vertex_indices\nproperty uchar red\nproperty uchar green\n\
        property uchar blue\nelement edge 1\nproperty int vertex1\nproperty int vertex2\n\
        end_header\n";

    fn expect(imported: Imported) {
        assert_eq!(imported.warnings, ["elements 'junk' are ignored"]);
        let soup = &imported.objects[0];
        assert_eq!(points(soup), SQUARE);
        assert_eq!(faces(soup), [vec![vec![0, 1, 2, 3]], vec![vec![2, 1, 0]]]);
        assert_eq!(soup.colors, Some(vec![Some(Color([255, 0, 1])), Some(Color([1, 2, 3]))]));
        assert_eq!(soup.lines, [[3, 0]]);
    }

    #[test]
    fn text() {
        let text = format!(
            "ply\nformat ascii 1.0\n{HEADER}0 7 0 0\n0 nan 1 0\n\n0 7 1 1\n0 7 0 1\n2 8 9 10\n\
             4 0 1 2 3 255 0 1\n3 2 1 0 1 2 3\n3 0\n"
        );
        expect(import("a", text.as_bytes()));
    }

    fn binary(big: bool) -> Vec<u8> {
        let name = if big { "big" } else { "little" };
        let mut bytes = format!("ply\nformat binary_{name}_endian 1.0\n{HEADER}").into_bytes();
        let mut put = |number: &[u8]| {
            let mut number = number.to_vec();
            if big {
                number.reverse();
            }
            bytes.extend(number);
        };
        for [x, y, z] in SQUARE {
            put(&z.to_le_bytes());
            put(&f32::NAN.to_le_bytes());
            put(&(x as i16).to_le_bytes());
            put(&[y as u8]);
        }
        put(&[2]);
        put(&8_u16.to_le_bytes());
        put(&9_u16.to_le_bytes());
        put(&10_i32.to_le_bytes());
        for (corners, color) in [(&[0_i32, 1, 2, 3][..], [255_u8, 0, 1]), (&[2, 1, 0], [1, 2, 3])] {
            put(&[corners.len() as u8]);
            corners.iter().for_each(|corner| put(&corner.to_le_bytes()));
            color.iter().for_each(|channel| put(&[*channel]));
        }
        put(&3_i32.to_le_bytes());
        put(&0_i32.to_le_bytes());
        bytes
    }

    #[test]
    fn little_endian() {
        expect(import("a", &binary(false)));
    }

    #[test]
    fn big_endian() {
        expect(import("a", &binary(true)));
    }

    /// The crate ply-rs-bw as a judge: the same vertices and faces.
    #[test]
    fn same_as_another_reader() {
        use ply_rs_bw::ply::{DefaultElement, Property};
        for bytes in [binary(false), binary(true)] {
            let ours = import("a.ply", &bytes);
            let parser = ply_rs_bw::parser::Parser::<DefaultElement>::new();
            let theirs = parser.read_ply(&mut &bytes[..]).expect("sound file");
            for (vertex, row) in ours.objects[0].vertices.iter().zip(&theirs.payload["vertex"]) {
                assert_eq!(row["x"], Property::Short(vertex.x as i16));
                assert_eq!(row["y"], Property::UChar(vertex.y as u8));
                assert_eq!(row["z"], Property::Double(vertex.z));
            }
            for (face, row) in theirs.payload["face"].iter().enumerate() {
                let ring = ours.objects[0].faces.rings(face).next().expect("outer ring");
                let corners = ring.iter().map(|&corner| corner as i32).collect();
                assert_eq!(row["vertex_indices"], Property::ListInt(corners));
            }
        }
    }
}

mod off {
    use super::*;

    #[test]
    fn colours_comments_and_extra_numbers() {
        let text = "# square\nCNOFF\n# counts\n4 4 0\n0 0 0 0 0 1 1 1 1 1\n1 0 0\n1 1 0 # corner\n\n\
                    0 1 0\n4 0 1 2 3 255 128 0\n3 0 1 2 0.0 0.5 1.0 1.0\n3 0 1 2 7\n2 0 2\n";
        let soup = only(import("a", text.as_bytes()));
        assert_eq!(points(&soup), SQUARE);
        assert_eq!(
            faces(&soup),
            [vec![vec![0, 1, 2, 3]], vec![vec![0, 1, 2]], vec![vec![0, 1, 2]]]
        );
        let colors = vec![Some(Color([255, 128, 0])), Some(Color([0, 128, 255])), None];
        assert_eq!(soup.colors, Some(colors));
        assert_eq!(soup.lines, [[0, 2]]);
    }

    #[test]
    fn counts_on_the_first_line() {
        let soup = only(import("a", b"OFF 3 1\n0 0 0\n1 0 0\n1 1 0\n3 0 1 2\n"));
        assert_eq!(soup.faces.as_triangles(), Some(&[0, 1, 2][..]));
        assert_eq!(soup.colors, None);
    }
}

#[cfg(feature = "json")]
mod polygon_scene {
    use super::*;

    #[test]
    fn holes_colours_and_objects() {
        let text = r##"{"faces": [
            {"outer": [0,1,2,3], "holes": [[2,1,0]], "color": "#C0ffee"},
            {"outer": [1,2,3], "object": "b", "holes": []},
            {"outer": [3,2,1], "color": null}],
            "vertices": [[0,0,0],[1,0,0],[1,1,0],[0,1.0,0]]}"##;
        let imported = import("a", text.as_bytes());
        assert_eq!(imported.format, Format::PolygonScene);
        let [first, second] = &imported.objects[..] else { panic!("two objects") };
        assert_eq!(points(first), SQUARE);
        assert_eq!(faces(first), [vec![vec![0, 1, 2, 3], vec![2, 1, 0]], vec![vec![3, 2, 1]]]);
        assert_eq!(first.colors, Some(vec![Some(Color([0xc0, 0xff, 0xee])), None]));
        assert_eq!((second.name.as_str(), &second.colors), ("b", &None));
        assert_eq!(second.vertex_numbers, Some(vec![1, 2, 3]));
        assert_eq!(faces(second), [[[0, 1, 2]]]);
    }

    #[test]
    fn other_keys_warn_however_deep_they_are() {
        let deep = "[".repeat(100_000) + &"]".repeat(100_000);
        let text = format!(r#"{{"note": {deep}, "vertices": [], "faces": []}}"#);
        let imported = import("a", text.as_bytes());
        assert_eq!(imported.warnings, ["the key 'note' is ignored"]);
    }
}

#[cfg(feature = "gltf")]
mod gltf {
    use super::*;
    use umriss::model::{Placement, Unit, UpAxis};

    /// Positions of SQUARE as f32, then the indices 0 1 2 3 as bytes, then
    /// the value (5, 6, 7) as f32.
    fn buffer() -> Vec<u8> {
        let mut bytes = Vec::new();
        for number in SQUARE.as_flattened() {
            bytes.extend((*number as f32).to_le_bytes());
        }
        bytes.extend([0, 1, 2, 3]);
        bytes.extend([5_f32, 6., 7.].iter().flat_map(|number| number.to_le_bytes()));
        bytes
    }

    const VIEWS: &str = r#""bufferViews":[{"buffer":0,"byteLength":48},
        {"buffer":0,"byteOffset":48,"byteLength":4},{"buffer":0,"byteOffset":52,"byteLength":12}],
        "accessors":[{"bufferView":0,"componentType":5126,"type":"VEC3","count":4},
        {"bufferView":1,"componentType":5121,"type":"SCALAR","count":4},
        {"bufferView":1,"componentType":5121,"type":"SCALAR","count":3},
        {"bufferView":0,"componentType":5126,"type":"VEC3","count":4,"sparse":{"count":1,
          "indices":{"bufferView":1,"byteOffset":2,"componentType":5121},"values":{"bufferView":2}}}]"#;

    fn glb(json: &str) -> Vec<u8> {
        glb_of(json, &buffer())
    }

    fn glb_of(json: &str, binary: &[u8]) -> Vec<u8> {
        let mut json = json.as_bytes().to_vec();
        json.resize(json.len().next_multiple_of(4), b' ');
        let mut bytes = b"glTF\x02\0\0\0".to_vec();
        bytes.extend((28 + json.len() as u32 + binary.len() as u32).to_le_bytes());
        bytes.extend((json.len() as u32).to_le_bytes());
        bytes.extend(b"JSON");
        bytes.extend(json);
        bytes.extend((binary.len() as u32).to_le_bytes());
        bytes.extend(b"BIN\0");
        bytes.extend(binary);
        bytes
    }

    fn scene(nodes: &str, primitives: &str) -> String {
        format!(
            r#"{{"asset":{{"version":"2.0"}},"scene":0,"scenes":[{{"nodes":[0]}}],
            "nodes":[{nodes}],"meshes":[{{"name":"mesh","primitives":[{primitives}]}}],
            "buffers":[{{"byteLength":64}}],{VIEWS}}}"#
        )
    }

    fn mesh(primitives: &str) -> Soup {
        only(import("a", &glb(&scene(r#"{"mesh":0}"#, primitives))))
    }

    #[test]
    fn triangles_in_metres_with_y_up() {
        let json = scene(
            r#"{"mesh":0}"#,
            r#"{"attributes":{"POSITION":0},"indices":2},{"attributes":{"POSITION":0},"indices":2}"#,
        );
        let imported = import("a", &glb(&json));
        assert_eq!(imported.placement, Placement { unit: Unit::Metre, up: UpAxis::Y });
        let soup = only(imported);
        assert_eq!(soup.name, "mesh");
        assert_eq!(points(&soup), SQUARE);
        assert_eq!(soup.faces.as_triangles(), Some(&[0, 1, 2, 0, 1, 2][..]));
    }

    #[test]
    fn strips_fans_and_lines() {
        let with_mode = |mode: u8| {
            mesh(&format!(r#"{{"attributes":{{"POSITION":0}},"indices":1,"mode":{mode}}}"#))
        };
        assert_eq!(with_mode(5).faces.as_triangles(), Some(&[0, 1, 2, 1, 3, 2][..]));
        assert_eq!(with_mode(6).faces.as_triangles(), Some(&[0, 1, 2, 0, 2, 3][..]));
        assert_eq!(with_mode(1).lines, [[0, 1], [2, 3]]);
        assert_eq!(with_mode(2).lines, [[0, 1], [1, 2], [2, 3], [3, 0]]);
        assert_eq!(with_mode(3).lines, [[0, 1], [1, 2], [2, 3]]);
    }

    #[test]
    fn sparse_accessor_replaces_single_vertices() {
        let soup = mesh(r#"{"attributes":{"POSITION":3},"indices":2}"#);
        assert_eq!(points(&soup), [SQUARE[0], SQUARE[1], [5., 6., 7.], SQUARE[3]]);
    }

    #[test]
    fn transforms_compose_from_the_root() {
        let nodes = r#"{"translation":[10,0,0],"children":[2,1]},{"name":"b","mesh":0},
            {"name":"a","mesh":0,"scale":[2,3,4],"rotation":[0,0,0.70710678,0.70710678]}"#;
        let imported =
            import("a", &glb(&scene(nodes, r#"{"attributes":{"POSITION":0},"indices":2}"#)));
        let [a, b] = &imported.objects[..] else { panic!("two objects") };
        assert_eq!((a.name.as_str(), b.name.as_str()), ("a", "b"));
        // Scaled, then turned by 90 degrees about z, then moved.
        let expected = [[10., 0., 0.], [10., 2., 0.], [7., 2., 0.], [7., 0., 0.]];
        for (found, expected) in a.vertices.iter().zip(expected) {
            assert!((*found - DVec3::from_array(expected)).length() < 1e-14, "{found}");
        }
        assert_eq!(points(b)[2], [11., 1., 0.]);
    }

    /// A GLB with one mesh of the square's first three corners, and with more
    /// numbers behind them: views and accessors 2 and on are those of `floats`.
    fn with_floats(nodes: &str, mesh: &str, floats: &[(&str, &[f32])]) -> Vec<u8> {
        let (mut binary, mut views, mut accessors) = (buffer(), String::new(), String::new());
        for (number, (kind, values)) in floats.iter().enumerate() {
            let size = if *kind == "VEC4" { 4 } else { 3 };
            views += &format!(
                r#",{{"buffer":0,"byteOffset":{},"byteLength":{}}}"#,
                binary.len(),
                4 * values.len()
            );
            accessors += &format!(
                r#",{{"bufferView":{},"componentType":5126,"type":"{kind}","count":{}}}"#,
                number + 2,
                values.len() / size
            );
            binary.extend(values.iter().flat_map(|value| value.to_le_bytes()));
        }
        let json = format!(
            r#"{{"asset":{{"version":"2.0"}},"scenes":[{{"nodes":[0]}}],"nodes":[{nodes}],
            "meshes":[{mesh}],"buffers":[{{"byteLength":{}}}],
            "bufferViews":[{{"buffer":0,"byteLength":36}},
              {{"buffer":0,"byteOffset":48,"byteLength":3}}{views}],
            "accessors":[{{"bufferView":0,"componentType":5126,"type":"VEC3","count":3}},
              {{"bufferView":1,"componentType":5121,"type":"SCALAR","count":3}}{accessors}]}}"#,
            binary.len()
        );
        glb_of(&json, &binary)
    }

    /// Scaled, turned and moved each by itself, within the transform of their
    /// node.
    #[test]
    fn instances_have_transforms_and_names_of_their_own() {
        let half = std::f32::consts::FRAC_1_SQRT_2;
        let floats: [(&str, &[f32]); 3] = [
            ("VEC3", &[0., 0., 0., 10., 0., 0.]),
            ("VEC4", &[0., 0., 0., 1., 0., 0., half, half]),
            ("VEC3", &[1., 1., 1., 2., 3., 4.]),
        ];
        let node = r#"{"name":"tree","mesh":0,"translation":[0,0,5],"extensions":
            {"EXT_mesh_gpu_instancing":{"attributes":{"TRANSLATION":2,"ROTATION":3,"SCALE":4}}}}"#;
        let mesh = r#"{"name":"mesh","primitives":[{"attributes":{"POSITION":0},"indices":1}]}"#;
        let imported = import("a", &with_floats(node, mesh, &floats));
        let [first, second] = &imported.objects[..] else { panic!("two objects") };
        assert_eq!((first.name.as_str(), second.name.as_str()), ("tree #1", "tree #2"));
        assert_eq!(points(first), [[0., 0., 5.], [1., 0., 5.], [1., 1., 5.]]);
        // (x, y) becomes (10 - 3y, 2x).
        for (found, expected) in second.vertices.iter().zip([[10., 0.], [10., 2.], [7., 2.]]) {
            let expected = DVec3::new(expected[0], expected[1], 5.0);
            assert!((*found - expected).length() < 1e-14, "{found}");
        }
        assert_eq!(faces(second), [[[0, 1, 2]]]);
    }

    #[test]
    fn nodes_that_share_a_mesh_are_told_apart() {
        let mesh = r#"{"primitives":[{"attributes":{"POSITION":0}}]},
            {"name":"wheel","primitives":[{"attributes":{"POSITION":0}}]}"#;
        let nodes = r#"{"children":[1,2,3,4,5,6]},{"mesh":1},{"mesh":0},{"mesh":1},
            {"mesh":1,"name":"spare"},{"mesh":0,"name":""},{"mesh":1}"#;
        let imported = import("a", &with_floats(nodes, mesh, &[]));
        let names: Vec<_> = imported.objects.iter().map(|object| object.name.as_str()).collect();
        assert_eq!(names, ["wheel #1", "mesh 0 #1", "wheel #2", "spare", "mesh 0 #2", "wheel #3"]);
        // A single one is called as before.
        let imported = import("a", &with_floats(r#"{"mesh":0}"#, mesh, &[]));
        assert_eq!(imported.objects[0].name, "");
    }

    #[test]
    fn morph_targets_move_by_their_weights() {
        let floats: [(&str, &[f32]); 2] = [
            ("VEC3", &[0., 0., 1., 0., 0., 2., 0., 0., 3.]),
            ("VEC3", &[8., 0., 0., 0., 8., 0., 0., 0., 8.]),
        ];
        let mesh = |weights: &str| {
            format!(
                r#"{{"primitives":[{{"attributes":{{"POSITION":0}},
                "targets":[{{"POSITION":2}},{{"NORMAL":9}},{{"POSITION":3}}]}}]{weights}}}"#
            )
        };
        let read = |node: &str, weights: &str| {
            points(&only(import("a", &with_floats(node, &mesh(weights), &floats))))
        };
        let plain = r#"{"mesh":0}"#;
        assert_eq!(read(plain, ""), SQUARE[..3]);
        assert_eq!(read(plain, r#","weights":[0,1,0]"#), SQUARE[..3]);
        let both = [[2., 0., 0.5], [1., 2., 1.0], [1., 1., 3.5]];
        assert_eq!(read(plain, r#","weights":[0.5,0,0.25]"#), both);
        // The node's own weights stand in place of those.
        let node = r#"{"mesh":0,"weights":[0.5,1,0.25]}"#;
        assert_eq!(read(node, r#","weights":[1,1,1]"#), both);
        assert_eq!(read(r#"{"mesh":0,"weights":[]}"#, r#","weights":[1,1,1]"#), SQUARE[..3]);
    }

    #[test]
    fn deep_hierarchy_needs_no_deep_stack() {
        let mut nodes = String::new();
        for node in 1..200_000 {
            nodes += &format!(r#"{{"children":[{node}]}},"#);
        }
        nodes += r#"{"mesh":0}"#;
        let soup = only(import(
            "a",
            &glb(&scene(&nodes, r#"{"attributes":{"POSITION":0}}"#)
                .replace("\"count\":4}", "\"count\":3}")),
        ));
        assert_eq!(points(&soup), SQUARE[..3]);
    }

    #[test]
    fn buffers_beside_the_file_and_within() {
        let folder = tempfile::tempdir().expect("temporary folder");
        std::fs::write(folder.path().join("a buffer.bin"), buffer()).expect("writable");
        let json = scene(r#"{"mesh":0}"#, r#"{"attributes":{"POSITION":0},"indices":2}"#);
        let beside = json.replace("\"byteLength\":64", r#""byteLength":64,"uri":"a%20buffer.bin""#);
        let path = folder.path().join("model.gltf");
        std::fs::write(&path, &beside).expect("writable");
        let soup = only(read_file(&path, None).expect("sound file"));
        assert_eq!(points(&soup), SQUARE);
        let refused = read_bytes("a", beside.as_bytes(), None).expect_err("no folder").to_string();
        assert_eq!(
            refused,
            "a:3: the file 'a%20buffer.bin' is elsewhere, expected all in one file"
        );
    }
}

#[test]
fn files_that_cannot_be_read_say_so() {
    let error = read_file(std::path::Path::new("no/such/model.obj"), None).expect_err("no file");
    assert!(error.to_string().starts_with("no/such/model.obj: cannot be read: "), "{error}");
}

#[test]
fn unknown_format_is_an_error_and_a_given_one_is_obeyed() {
    let error = read_bytes("a.xyz", b"1 2 3\n", None).expect_err("unknown").to_string();
    assert_eq!(
        error,
        "a.xyz: the format is unknown, expected OBJ, STL, PLY, OFF, JSON, glTF or GLB"
    );
    assert!(read_bytes("a.xyz", b"# nothing\nv 1 2 3\n", Some(Format::Obj)).is_ok());
}

#[cfg(not(feature = "gltf"))]
#[test]
fn format_left_out_of_this_build_says_so() {
    let error = read_bytes("a.glb", b"glTF\x02\0\0\0", None).expect_err("left out").to_string();
    assert_eq!(error, "a.glb: this build cannot read gltf files, expected one with feature gltf");
}
