//! The polygon scene: our own JSON for what the other formats cannot say,
//! polygons with holes, each with its colour and object.
//!
//! ```json
//! {"vertices": [[0, 0, 0], [9, 0, 0], [9, 9, 0], [0, 9, 0], [1, 1, 0], [2, 1, 0], [1, 2, 0]],
//!  "faces": [{"outer": [0, 1, 2, 3], "holes": [[4, 5, 6]], "color": "#c0ffee", "object": "lid"}]}
//! ```
//!
//! `holes`, `color` and `object` may be left out. Faces of one object need
//! not follow one another; objects stand in the order of their first faces.
//! Vertices are shared by all. The two keys may come in either order; others
//! are passed over with a warning.
//!
//! Faces are judged while serde_json reads them, one at a time. A face that
//! is wrong stops the parser, and the scanner of [`super::json_places`] finds
//! its line.

use std::fmt;

use glam::DVec3;
use rustc_hash::FxHashMap;
use serde::Deserialize;
use serde::de::{DeserializeSeed, Deserializer, Error, IgnoredAny, MapAccess, SeqAccess, Visitor};

use super::super::{Color, FacePlace};
use super::Found;
use super::error::{Fault, Read};
use super::json_places::{Step, line_of, offset_of, place_of};
use super::json_words::json_message;
use super::parts::{ForwardReferences, Part, split};

/// Reads a polygon scene.
pub(super) fn read(bytes: &[u8]) -> Read<Found> {
    let json = bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes);
    let mut scene = Scene::default();
    let mut parser = serde_json::Deserializer::from_slice(json);
    let outcome = (&mut scene).deserialize(&mut parser).and_then(|()| parser.end());
    if let Some((face, message)) = scene.wrong_face {
        let path = [Step::Key("faces"), Step::Item(face)];
        let line = line_of(json, place_of(json, &path));
        return Err(Fault::line(line, format!("face {face} {message}")));
    }
    if let Err(error) = outcome {
        let line = line_of(json, offset_of(json, error.line(), error.column()));
        return Err(Fault::line(line, json_message(&error, "a polygon scene")));
    }
    Ok(Found { objects: split(scene.vertices, scene.parts), warnings: scene.warnings })
}

/// The line on which a face of a polygon scene begins, counted from 1. Faces
/// are read without their lines, and this scans the text again.
pub(super) fn line_of_face(bytes: &[u8], face: u64) -> u64 {
    let json = bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes);
    let path = [Step::Key("faces"), Step::Item(face as usize)];
    line_of(json, place_of(json, &path))
}

#[derive(Default)]
struct Scene {
    vertices: Vec<DVec3>,
    vertices_are_known: bool,
    parts: Vec<Part>,
    part_of_name: FxHashMap<String, usize>,
    forward: ForwardReferences,
    /// The first face that is wrong, and what is wrong with it.
    wrong_face: Option<(usize, String)>,
    warnings: Vec<String>,
}

#[derive(Deserialize)]
struct Face {
    outer: Vec<u64>,
    #[serde(default)]
    holes: Vec<Vec<u64>>,
    color: Option<String>,
    #[serde(default)]
    object: String,
}

impl<'de> DeserializeSeed<'de> for &mut Scene {
    type Value = ();

    fn deserialize<D: Deserializer<'de>>(self, deserializer: D) -> Result<(), D::Error> {
        deserializer.deserialize_map(self)
    }
}

impl<'de> Visitor<'de> for &mut Scene {
    type Value = ();

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("a polygon scene")
    }

    fn visit_map<A: MapAccess<'de>>(self, mut map: A) -> Result<(), A::Error> {
        let mut has_faces = false;
        while let Some(key) = map.next_key::<String>()? {
            match &*key {
                "vertices" if self.vertices_are_known => {
                    return Err(A::Error::duplicate_field("vertices"));
                }
                "vertices" => {
                    let points: Vec<Point> = map.next_value()?;
                    self.vertices = points.into_iter().map(|point| point.0).collect();
                    self.vertices_are_known = true;
                    self.check_forward_references()?;
                }
                "faces" if has_faces => return Err(A::Error::duplicate_field("faces")),
                "faces" => {
                    map.next_value_seed(FaceList(self))?;
                    has_faces = true;
                }
                _ => {
                    map.next_value::<IgnoredAny>()?;
                    self.warn(&key);
                }
            }
        }
        if !self.vertices_are_known {
            return Err(A::Error::missing_field("vertices"));
        }
        if !has_faces {
            return Err(A::Error::missing_field("faces"));
        }
        Ok(())
    }
}

impl Scene {
    fn add<E: Error>(&mut self, number: usize, face: &Face) -> Result<(), E> {
        self.try_add(number, face).map_err(|message| {
            self.wrong_face = Some((number, message));
            E::custom("a face is wrong")
        })
    }

    fn try_add(&mut self, number: usize, face: &Face) -> Result<(), String> {
        let outer = self.ring(number, &face.outer)?;
        let mut holes = Vec::with_capacity(face.holes.len());
        for hole in &face.holes {
            holes.push(self.ring(number, hole)?);
        }
        let color = match &face.color {
            None => None,
            Some(text) => Some(color(text).ok_or_else(|| {
                format!("has the colour '{}', expected '#rrggbb'", text.escape_default())
            })?),
        };
        let place = match self.part_of_name.get(&face.object) {
            Some(&place) => place,
            None => {
                let name = face.object.clone();
                self.part_of_name.insert(name.clone(), self.parts.len());
                self.parts.push(Part { name, ..Part::default() });
                self.parts.len() - 1
            }
        };
        let part = &mut self.parts[place];
        if color.is_some() || part.colors.is_some() {
            let colors = part.colors.get_or_insert_default();
            colors.resize(part.faces.len(), None);
            colors.push(color);
        }
        let place = FacePlace { number: number as u64, line: None };
        part.places.note(part.faces.len() as u32, place);
        part.faces.push(&outer, holes.iter().map(Vec::as_slice));
        Ok(())
    }

    fn ring(&mut self, face: usize, corners: &[u64]) -> Result<Vec<u32>, String> {
        if corners.len() < 3 {
            let count = corners.len();
            return Err(format!("has a ring of {count} corners, expected 3 at least"));
        }
        let count = self.vertices.len() as u64;
        for &corner in corners {
            if !self.vertices_are_known {
                self.forward.note(face as u64, corner);
            } else if count <= corner {
                return Err(no_such_vertex(corner, count));
            }
        }
        // Numbers beyond 32 bits are out of range, found so here or later.
        Ok(corners.iter().map(|&corner| corner as u32).collect())
    }

    fn check_forward_references<E: Error>(&mut self) -> Result<(), E> {
        let count = self.vertices.len() as u64;
        let Some((face, number)) = self.forward.first_beyond(count) else { return Ok(()) };
        self.wrong_face = Some((face as usize, no_such_vertex(number, count)));
        Err(E::custom("a face is wrong"))
    }

    fn warn(&mut self, key: &str) {
        const MOST: usize = 20;
        if self.warnings.len() < MOST {
            let key: String = key.chars().take(40).collect();
            self.warnings.push(format!("the key '{}' is ignored", key.escape_default()));
        }
    }
}

fn no_such_vertex(number: u64, count: u64) -> String {
    format!("names vertex {number}, expected a number less than {count}")
}

fn color(text: &str) -> Option<Color> {
    let digits = text.strip_prefix('#')?;
    if digits.len() != 6 || !digits.bytes().all(|byte| byte.is_ascii_hexdigit()) {
        return None;
    }
    let [_, red, green, blue] = u32::from_str_radix(digits, 16).ok()?.to_be_bytes();
    Some(Color([red, green, blue]))
}

/// The faces, added to the scene one by one.
struct FaceList<'a>(&'a mut Scene);

impl<'de> DeserializeSeed<'de> for FaceList<'_> {
    type Value = ();

    fn deserialize<D: Deserializer<'de>>(self, deserializer: D) -> Result<(), D::Error> {
        deserializer.deserialize_seq(self)
    }
}

impl<'de> Visitor<'de> for FaceList<'_> {
    type Value = ();

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("an array of faces")
    }

    fn visit_seq<A: SeqAccess<'de>>(self, mut list: A) -> Result<(), A::Error> {
        let mut number = 0;
        while let Some(face) = list.next_element::<Face>()? {
            self.0.add(number, &face)?;
            number += 1;
        }
        Ok(())
    }
}

/// Three numbers, no more and no fewer. serde_json refuses what is beyond
/// the range of f64, so they are finite.
struct Point(DVec3);

impl<'de> Deserialize<'de> for Point {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_seq(PointVisitor)
    }
}

struct PointVisitor;

impl<'de> Visitor<'de> for PointVisitor {
    type Value = Point;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("three coordinates")
    }

    fn visit_seq<A: SeqAccess<'de>>(self, mut list: A) -> Result<Point, A::Error> {
        let mut point = [0.0; 3];
        for (place, coordinate) in point.iter_mut().enumerate() {
            *coordinate =
                list.next_element()?.ok_or_else(|| A::Error::invalid_length(place, &self))?;
        }
        if list.next_element::<IgnoredAny>()?.is_some() {
            return Err(A::Error::custom("a vertex of more numbers, expected three coordinates"));
        }
        Ok(Point(DVec3::from_array(point)))
    }
}
