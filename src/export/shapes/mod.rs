//! Polygons as files: GeoJSON and SVG paths, in and out.
//!
//! Coordinates are taken as they are written and written as they are, with
//! as many digits as it takes to read the same doubles again. What is inside
//! follows from the file: GeoJSON's polygons by their own rule, SVG's paths
//! by their `fill-rule`.

#[cfg(feature = "json")]
mod geojson;
#[cfg(feature = "svg")]
mod path_data;
#[cfg(feature = "svg")]
mod svg_paths;

use super::ExportError;
use crate::polygon::clipping::{FillRule, Operation, PlaneShape, Rounded, ShapeError};
use glam::DVec2;
use std::path::Path;

/// A format of polygons.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum ShapeFormat {
    /// Polygons, multi-polygons, features and collections of them.
    GeoJson,
    /// Paths and polygons of an SVG.
    Svg,
}

/// What is filled by one rule.
#[derive(Debug, Clone, PartialEq)]
pub struct ShapePart {
    /// Polygons of rings, not closed by a repeated corner.
    pub polygons: Vec<Vec<Vec<DVec2>>>,
    /// The rule.
    pub rule: FillRule,
}

/// The polygons of a file: the union of its parts.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct ShapeFile {
    /// One part of a GeoJSON file, one for each path of an SVG.
    pub parts: Vec<ShapePart>,
}

impl ShapeFormat {
    /// The format called `name`, which is also its extension; upper or lower
    /// case.
    ///
    /// # Errors
    ///
    /// Where no polygons go by that name.
    pub fn from_name(name: &str) -> Result<Self, ExportError> {
        match name.to_ascii_lowercase().as_str() {
            "geojson" | "json" => Ok(ShapeFormat::GeoJson),
            "svg" => Ok(ShapeFormat::Svg),
            _ => Err(ExportError::ShapeFormat(name.to_owned())),
        }
    }

    /// The format that the extension of `path` names.
    ///
    /// # Errors
    ///
    /// Where there is none, or no polygons go by it.
    pub fn from_path(path: &Path) -> Result<Self, ExportError> {
        match path.extension() {
            Some(extension) => Self::from_name(&extension.to_string_lossy()),
            None => Err(ExportError::ShapeFormat(path.display().to_string())),
        }
    }

    /// Reads polygons.
    ///
    /// # Errors
    ///
    /// Where the text is not of the format, holds what is no polygon, or
    /// this build has no such format.
    pub fn read(self, bytes: &[u8]) -> Result<ShapeFile, ExportError> {
        match self {
            #[cfg(feature = "json")]
            ShapeFormat::GeoJson => geojson::read(bytes),
            #[cfg(feature = "svg")]
            ShapeFormat::Svg => svg_paths::read(bytes),
            #[cfg(not(all(feature = "json", feature = "svg")))]
            _ => Err(self.missing()),
        }
    }

    /// Writes polygons.
    ///
    /// # Errors
    ///
    /// Where this build has no such format.
    pub fn write(self, polygons: &Rounded) -> Result<String, ExportError> {
        match self {
            #[cfg(feature = "json")]
            ShapeFormat::GeoJson => Ok(geojson::write(polygons)),
            #[cfg(feature = "svg")]
            ShapeFormat::Svg => Ok(svg_paths::write(polygons)),
            #[cfg(not(all(feature = "json", feature = "svg")))]
            _ => Err(self.missing()),
        }
    }

    #[cfg(not(all(feature = "json", feature = "svg")))]
    fn missing(self) -> ExportError {
        ExportError::ShapeFormat(format!("{self:?}, which this build does not have"))
    }
}

impl ShapeFile {
    /// The shape of all parts together: each by its own rule, or by one rule
    /// for all rings of the file.
    ///
    /// # Errors
    ///
    /// Where a coordinate is not finite, or there are too many.
    pub fn shape(&self, rule: Option<FillRule>) -> Result<PlaneShape, ShapeError> {
        if let (None, [part]) = (rule, &*self.parts) {
            return PlaneShape::new(&part.polygons, part.rule);
        }
        if let Some(rule) = rule {
            let all = self.parts.iter().flat_map(|part| part.polygons.iter().cloned());
            return PlaneShape::new(&all.collect::<Vec<_>>(), rule);
        }
        let shapes = self.parts.iter().map(|part| PlaneShape::new(&part.polygons, part.rule));
        let shapes = shapes.collect::<Result<Vec<_>, _>>()?;
        PlaneShape::operation(Operation::Union, &shapes.iter().collect::<Vec<_>>())
    }
}

/// A number that reads as the same double, without a sign for zero.
#[cfg(any(feature = "json", feature = "svg"))]
fn number(value: f64) -> String {
    // Few digits for large and small numbers too.
    let (plain, short) = (format!("{}", value + 0.0), format!("{:e}", value + 0.0));
    if plain.len() <= short.len() + 8 { plain } else { short }
}

/// A ring without a last corner that repeats the first.
#[cfg(any(feature = "json", feature = "svg"))]
fn opened(mut ring: Vec<DVec2>) -> Vec<DVec2> {
    if ring.len() > 1 && ring.first() == ring.last() {
        ring.pop();
    }
    ring
}

#[cfg(all(test, feature = "json", feature = "svg"))]
mod tests {
    use super::*;
    use glam::dvec2;

    fn read(format: ShapeFormat, text: &str) -> Result<ShapeFile, String> {
        format.read(text.as_bytes()).map_err(|error| error.to_string())
    }

    fn rounded() -> Rounded {
        let square = |low: f64, high: f64| {
            vec![dvec2(low, low), dvec2(high, low), dvec2(high, high), dvec2(low, high)]
        };
        let mut hole = square(0.25, 1.0 / 3.0);
        hole.reverse();
        Rounded {
            polygons: vec![vec![square(-0.0, 1.0), hole], vec![square(1e300, 2e300)]],
            rounds: 0,
        }
    }

    #[test]
    fn what_is_written_is_read_again_bit_by_bit() {
        for format in [ShapeFormat::GeoJson, ShapeFormat::Svg] {
            let text = format.write(&rounded()).unwrap();
            assert!(!text.contains("-0,") && !text.contains("-0 "), "{text}");
            let file = read(format, &text).unwrap();
            let all: Vec<_> = file.parts.into_iter().flat_map(|part| part.polygons).collect();
            assert_eq!(all, rounded().polygons, "{text}");
        }
    }

    #[test]
    fn features_and_collections_are_one_union() {
        let text = r#"{"type": "FeatureCollection", "features": [
            {"type": "Feature", "properties": {"type": 7}, "geometry":
                {"coordinates": [[[0,0],[1,0],[1,1],[0,0]]], "type": "Polygon"}},
            {"type": "Feature", "properties": null, "geometry": null},
            {"type": "Feature", "geometry": {"type": "GeometryCollection", "geometries": [
                {"type": "MultiPolygon", "coordinates": [[[[5,5,9],[6,5,9],[6,6,9],[5,5,9]]]]}]}}
        ]}"#;
        let file = read(ShapeFormat::GeoJson, text).unwrap();
        assert_eq!(file.parts.len(), 1);
        assert_eq!(file.parts[0].polygons.len(), 2);
        assert_eq!(file.parts[0].polygons[0][0].len(), 3);
        assert_eq!(file.shape(None).unwrap().area().to_f64(), 1.0);
    }

    #[test]
    fn paths_have_their_own_rules() {
        let text = r#"<svg xmlns="http://www.w3.org/2000/svg"><g fill-rule="evenodd">
            <path d="M0 0H4V4H0zM1 1h2v2h-2z"/>
            <path style="fill:red; fill-rule: nonzero" d="m10,0 4,0 0,4-4,0zm1,1 2 0 0 2-2 0z"/></g>
            <polygon points="20,0 21,0 21,1 20,1"/><defs><path d="M0 0L9 9L9 0z"/></defs></svg>"#;
        let file = read(ShapeFormat::Svg, text).unwrap();
        let rules: Vec<_> = file.parts.iter().map(|part| part.rule).collect();
        assert_eq!(rules, [FillRule::EvenOdd, FillRule::NonZero, FillRule::NonZero]);
        assert_eq!(file.shape(None).unwrap().area().to_f64(), 12.0 + 16.0 + 1.0);
        assert_eq!(file.shape(Some(FillRule::EvenOdd)).unwrap().area().to_f64(), 25.0);
    }

    #[test]
    fn errors_name_the_line_and_what_was_expected() {
        let wrong = [
            (ShapeFormat::GeoJson, "\n{\"type\": \"Point\", \"coordinates\": [1, 2]}", "line 2"),
            (ShapeFormat::GeoJson, "{\"type\": \"Polygon\",\n \"coordinates\": [[[0]]]}", "line 2"),
            (ShapeFormat::GeoJson, "{\"type\": \"Polygon\", \"coordinates\": [[0, 1]]}", "line 1"),
            (
                ShapeFormat::GeoJson,
                "{\"type\": \"Polygon\", \"coordinates\": [[[0, \"1\"]]]}",
                "expected",
            ),
            (ShapeFormat::GeoJson, "{\"type\": \"Polygon\"}", "coordinates"),
            (ShapeFormat::GeoJson, "{}", "type"),
            (ShapeFormat::GeoJson, "", "line 1"),
            (ShapeFormat::Svg, "<svg>\n<path d=\"M0 0C1 1 2 2 3 3z\"/></svg>", "line 2"),
            (ShapeFormat::Svg, "<svg>\n<path d=\"L0 0\"/></svg>", "line 2"),
            (ShapeFormat::Svg, "<svg>\n<path d=\"M0 x\"/></svg>", "line 2"),
            (ShapeFormat::Svg, "<svg>\n<path d=\"M0\"/></svg>", "line 2"),
            (
                ShapeFormat::Svg,
                "<svg>\n\n<g transform=\"scale(2)\"><path d=\"M0 0\"/></g></svg>",
                "line 3",
            ),
            (ShapeFormat::Svg, "<svg>\n<circle r=\"1\"/></svg>", "expected"),
            (ShapeFormat::Svg, "<svg>\n<path d=\"M0 0H1\"></svg>", "line"),
            (ShapeFormat::Svg, "<svg><path d=\"M0 1e999\"/></svg>", "1e999"),
        ];
        for (format, text, expected) in wrong {
            let error = read(format, text).unwrap_err();
            assert!(error.contains(expected), "{text}: {error}");
        }
    }
}
