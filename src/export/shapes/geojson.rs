//! GeoJSON (RFC 7946): the geometries that have an area.

use super::{ShapeFile, ShapePart, number, opened};
use crate::export::ExportError;
use crate::polygon::clipping::{FillRule, Rounded};
use glam::DVec2;
use serde::Deserialize;
use serde::de::{Deserializer, Error, SeqAccess, Visitor};
use std::fmt;

/// The polygons of an object, each a list of rings.
#[derive(Deserialize)]
#[serde(try_from = "Object")]
struct Areas(Vec<Vec<Vec<DVec2>>>);

/// Any object of the format.
#[derive(Deserialize)]
struct Object {
    #[serde(rename = "type")]
    kind: Option<String>,
    coordinates: Option<Nested>,
    geometry: Option<Areas>,
    geometries: Option<Vec<Areas>>,
    features: Option<Vec<Areas>>,
}

/// Coordinates, whatever they are those of.
enum Nested {
    Position(DVec2),
    List(Vec<Nested>),
}

/// Reads a file: the union of all polygons in it.
pub(super) fn read(bytes: &[u8]) -> Result<ShapeFile, ExportError> {
    let areas: Areas = serde_json::from_slice(bytes).map_err(|error| {
        let text = error.to_string();
        // The place is told apart from the message.
        let message = text.split(" at line ").next().unwrap_or(&text).to_owned();
        // What is wrong with the whole object has no place of its own: it is
        // where the object begins.
        let line = if error.line() == 0 { first_line(bytes) } else { error.line() };
        ExportError::Shape { line, message }
    })?;
    Ok(ShapeFile { parts: vec![ShapePart { polygons: areas.0, rule: FillRule::Polygons }] })
}

/// The line, from 1 on, of the first byte that is not space.
fn first_line(bytes: &[u8]) -> usize {
    let space = bytes.iter().take_while(|byte| byte.is_ascii_whitespace());
    1 + space.filter(|&&byte| byte == b'\n').count()
}

/// Writes polygons as one multi-polygon.
pub(super) fn write(rounded: &Rounded) -> String {
    let position = |corner: &DVec2| format!("[{},{}]", number(corner.x), number(corner.y));
    let ring = |ring: &Vec<DVec2>| {
        let closed = ring.iter().chain(ring.first());
        format!("[{}]", closed.map(position).collect::<Vec<_>>().join(","))
    };
    let polygon = |rings: &Vec<Vec<DVec2>>| {
        format!("[{}]", rings.iter().map(ring).collect::<Vec<_>>().join(","))
    };
    let polygons: Vec<String> = rounded.polygons.iter().map(polygon).collect();
    format!("{{\"type\":\"MultiPolygon\",\"coordinates\":[{}]}}\n", polygons.join(",\n"))
}

impl TryFrom<Object> for Areas {
    type Error = String;

    fn try_from(object: Object) -> Result<Self, String> {
        const EXPECTED: &str = "expected Polygon, MultiPolygon, Feature, FeatureCollection or \
            GeometryCollection";
        let Some(kind) = object.kind else {
            return Err(format!("an object without a `type`, {EXPECTED}"));
        };
        let coordinates = || {
            let missing = format!("a {kind} without `coordinates`");
            object.coordinates.as_ref().ok_or(missing)
        };
        let all = |list: Option<Vec<Areas>>, name: &str| {
            let missing = format!("a {kind} without `{name}`");
            let list = list.ok_or(missing)?;
            Ok(Areas(list.into_iter().flat_map(|areas| areas.0).collect()))
        };
        match kind.as_str() {
            "Polygon" => Ok(Areas(vec![polygon(coordinates()?)?])),
            "MultiPolygon" => {
                let Nested::List(list) = coordinates()? else {
                    return Err("a position, expected a list of polygons".to_owned());
                };
                Ok(Areas(list.iter().map(polygon).collect::<Result<_, _>>()?))
            }
            "Feature" => Ok(object.geometry.unwrap_or(Areas(Vec::new()))),
            "FeatureCollection" => all(object.features, "features"),
            "GeometryCollection" => all(object.geometries, "geometries"),
            other => Err(format!("`{other}` has no area, {EXPECTED}")),
        }
    }
}

fn polygon(nested: &Nested) -> Result<Vec<Vec<DVec2>>, String> {
    let Nested::List(rings) = nested else {
        return Err("a position, expected a polygon: a list of rings".to_owned());
    };
    rings.iter().map(ring).collect()
}

fn ring(nested: &Nested) -> Result<Vec<DVec2>, String> {
    let Nested::List(positions) = nested else {
        return Err("a position, expected a ring: a list of positions".to_owned());
    };
    let position = |nested: &Nested| match nested {
        Nested::Position(position) => Ok(*position),
        Nested::List(_) => Err("a list, expected a position: [x, y]".to_owned()),
    };
    Ok(opened(positions.iter().map(position).collect::<Result<_, _>>()?))
}

impl<'de> Deserialize<'de> for Nested {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_seq(NestedVisitor)
    }
}

struct NestedVisitor;

/// A member of a list: a number or another list.
enum Member {
    Number(f64),
    List(Nested),
}

impl<'de> Visitor<'de> for NestedVisitor {
    type Value = Nested;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("a list of coordinates")
    }

    fn visit_seq<A: SeqAccess<'de>>(self, mut members: A) -> Result<Nested, A::Error> {
        let (mut numbers, mut lists) = (Vec::new(), Vec::new());
        while let Some(member) = members.next_element::<Member>()? {
            match member {
                Member::Number(number) => numbers.push(number),
                Member::List(list) => lists.push(list),
            }
        }
        match (&*numbers, lists.is_empty()) {
            ([], _) => Ok(Nested::List(lists)),
            ([x, y, ..], true) => Ok(Nested::Position(DVec2::new(*x, *y))),
            _ => Err(A::Error::custom("a position of another form, expected [x, y]")),
        }
    }
}

impl<'de> Deserialize<'de> for Member {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_any(MemberVisitor)
    }
}

struct MemberVisitor;

impl<'de> Visitor<'de> for MemberVisitor {
    type Value = Member;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("a number or a list of coordinates")
    }

    fn visit_f64<E: Error>(self, value: f64) -> Result<Member, E> {
        Ok(Member::Number(value))
    }

    fn visit_i64<E: Error>(self, value: i64) -> Result<Member, E> {
        Ok(Member::Number(value as f64))
    }

    fn visit_u64<E: Error>(self, value: u64) -> Result<Member, E> {
        Ok(Member::Number(value as f64))
    }

    fn visit_seq<A: SeqAccess<'de>>(self, members: A) -> Result<Member, A::Error> {
        NestedVisitor.visit_seq(members).map(Member::List)
    }
}
