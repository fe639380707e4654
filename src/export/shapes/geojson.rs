//! GeoJSON (RFC 7946): the geometries that have an area.

use super::{ShapeFile, ShapePart, line_of, number};
use crate::export::ExportError;
use crate::polygon::clipping::{FillRule, Rounded};
use glam::DVec2;
use serde::Deserialize;
use serde::de::{Deserializer, Error, SeqAccess, Visitor};
use std::collections::BTreeMap;
use std::fmt;

/// What is expected where an object has no area.
const EXPECTED: &str =
    "expected Polygon, MultiPolygon, Feature, FeatureCollection or GeometryCollection";

/// What an object has.
#[derive(Default, Deserialize)]
#[serde(try_from = "Object")]
struct Areas {
    /// Polygons, each a list of rings.
    polygons: Vec<Vec<Vec<DVec2>>>,
    /// How many geometries of each kind have no area.
    without_area: BTreeMap<&'static str, usize>,
}

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

/// Reads a file: the union of all polygons in it. Points and lines beside
/// them are passed over.
pub(super) fn read(bytes: &[u8]) -> Result<ShapeFile, ExportError> {
    let areas: Areas = serde_json::from_slice(bytes).map_err(|error| {
        let message = plain(&error);
        // What is wrong with the whole object has no place of its own: it is
        // where the object begins.
        let line = if error.line() == 0 { first_line(bytes) } else { error.line() };
        ExportError::Shape { line, message }
    })?;
    if let (true, Some(kind)) = (areas.polygons.is_empty(), areas.without_area.keys().next()) {
        let message = format!("`{kind}` has no area, {EXPECTED}");
        return Err(ExportError::Shape { line: first_line(bytes), message });
    }
    let mut file = ShapeFile::default();
    let told = areas.without_area.iter();
    let told = told.map(|(kind, count)| format!("passed over: {kind}, it has no area ({count})"));
    file.warnings = told.collect();
    file.parts = vec![ShapePart { polygons: areas.polygons, rule: FillRule::Polygons, clip: None }];
    Ok(file)
}

/// What is wrong, without the place, which is told apart, in words that do
/// not change with the library.
fn plain(error: &serde_json::Error) -> String {
    let text = error.to_string();
    let text = text.split(" at line ").next().unwrap_or(&text);
    if let Some(rest) = text.strip_prefix("EOF while parsing ") {
        return format!("the file ends within {rest}, expected its end");
    }
    if let Some(rest) = text.strip_prefix("invalid type: ") {
        return format!("{rest}, which stands here");
    }
    match text {
        "recursion limit exceeded" => "values within one another, expected fewer levels".to_owned(),
        "expected value" => "no value of JSON, expected one".to_owned(),
        _ => text.to_owned(),
    }
}

/// The line, from 1 on, of the first byte that is not space.
fn first_line(bytes: &[u8]) -> usize {
    line_of(bytes, bytes.iter().take_while(|byte| byte.is_ascii_whitespace()).count())
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
        let Some(kind) = object.kind else {
            return Err(format!("an object without a `type`, {EXPECTED}"));
        };
        let coordinates = || {
            let missing = format!("a {kind} without `coordinates`");
            object.coordinates.as_ref().ok_or(missing)
        };
        let all = |list: Option<Vec<Areas>>, name: &str| {
            let missing = format!("a {kind} without `{name}`");
            Ok(list.ok_or(missing)?.into_iter().fold(Areas::default(), Areas::and))
        };
        let polygons = |polygons| Areas { polygons, ..Areas::default() };
        let none = |kind| Areas { without_area: BTreeMap::from([(kind, 1)]), ..Areas::default() };
        match kind.as_str() {
            "Polygon" => Ok(polygons(vec![polygon(coordinates()?)?])),
            "MultiPolygon" => {
                let Nested::List(list) = coordinates()? else {
                    return Err("a position, expected a list of polygons".to_owned());
                };
                Ok(polygons(list.iter().map(polygon).collect::<Result<_, _>>()?))
            }
            "Point" => Ok(none("Point")),
            "MultiPoint" => Ok(none("MultiPoint")),
            "LineString" => Ok(none("LineString")),
            "MultiLineString" => Ok(none("MultiLineString")),
            "Feature" => Ok(object.geometry.unwrap_or_default()),
            "FeatureCollection" => all(object.features, "features"),
            "GeometryCollection" => all(object.geometries, "geometries"),
            other => Err(format!("`{other}` has no area, {EXPECTED}")),
        }
    }
}

impl Areas {
    fn and(mut self, other: Self) -> Self {
        self.polygons.extend(other.polygons);
        for (kind, count) in other.without_area {
            *self.without_area.entry(kind).or_default() += count;
        }
        self
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
    let mut ring: Vec<DVec2> = positions.iter().map(position).collect::<Result<_, _>>()?;
    // The last position repeats the first.
    if ring.len() > 1 && ring.first() == ring.last() {
        ring.pop();
    }
    Ok(ring)
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
