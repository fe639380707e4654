//! Polygons as files: GeoJSON and SVG, in and out.
//!
//! GeoJSON's coordinates are taken as they are written and written as they
//! are, with as many digits as it takes to read the same doubles again. SVG
//! is read as it is displayed and becomes millimetres of its page. What is
//! inside follows from the file: GeoJSON's polygons by their own rule, SVG's
//! shapes by their `fill-rule`.

#[cfg(feature = "json")]
mod geojson;
mod shape_file;
#[cfg(feature = "svg")]
mod svg;

pub use shape_file::{ClipId, ShapeFile, ShapePage, ShapePart};

use super::ExportError;
use crate::polygon::clipping::Rounded;
use std::path::Path;

/// A format of polygons.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum ShapeFormat {
    /// Polygons, multi-polygons, features and collections of them.
    GeoJson,
    /// What an SVG displays as filled.
    Svg,
}

/// How SVG becomes polygons.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ShapeOptions {
    /// Curves become chords that are nowhere farther from them, in
    /// millimetres; more than 0.
    pub flatness: f64,
    /// The grid of places, in millimetres; 0 for none. If nothing is said,
    /// what units and transforms convert is rounded to [`Self::GRID`] and
    /// what is written in millimetres is taken as it is.
    pub snap: Option<f64>,
    /// Whether what lies off the page is taken too.
    pub off_page: bool,
}

impl ShapeOptions {
    /// The grid of converted places, mm: a file that writes eight digits of
    /// its pixels means a place this well.
    pub const GRID: f64 = 1e-5;

    /// How near chords are to their curves, mm, unless something else is
    /// asked for.
    pub const FLATNESS: f64 = 0.005;

    #[cfg(feature = "svg")]
    fn grid_of_converted(&self) -> Option<f64> {
        Some(self.snap.unwrap_or(Self::GRID)).filter(|grid| *grid > 0.0)
    }

    #[cfg(feature = "svg")]
    fn grid_of_written(&self) -> Option<f64> {
        self.snap.filter(|grid| *grid > 0.0)
    }
}

impl Default for ShapeOptions {
    fn default() -> Self {
        ShapeOptions { flatness: Self::FLATNESS, snap: None, off_page: false }
    }
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

    /// Reads polygons with the usual options.
    ///
    /// # Errors
    ///
    /// As [`Self::read_with`].
    pub fn read(self, bytes: &[u8]) -> Result<ShapeFile, ExportError> {
        self.read_with(bytes, &ShapeOptions::default())
    }

    /// Reads polygons. What has no area is passed over, and told in the
    /// file's warnings.
    ///
    /// # Errors
    ///
    /// Where the text is not of the format, cannot be understood, or this
    /// build has no such format.
    pub fn read_with(self, bytes: &[u8], options: &ShapeOptions) -> Result<ShapeFile, ExportError> {
        if bytes.starts_with(&[0xff, 0xfe]) || bytes.starts_with(&[0xfe, 0xff]) {
            let message = "the text is UTF-16, expected UTF-8".to_owned();
            return Err(ExportError::Shape { line: 1, message });
        }
        let bytes = bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes);
        match self {
            #[cfg(feature = "json")]
            ShapeFormat::GeoJson => {
                let _ = options;
                geojson::read(bytes)
            }
            #[cfg(feature = "svg")]
            ShapeFormat::Svg => svg::read(bytes, options),
            #[cfg(not(all(feature = "json", feature = "svg")))]
            _ => Err(self.missing()),
        }
    }

    /// Writes polygons: a multi-polygon, or a page in millimetres that is as
    /// large as they are.
    ///
    /// # Errors
    ///
    /// Where this build has no such format.
    pub fn write(self, polygons: &Rounded) -> Result<String, ExportError> {
        self.write_on(polygons, None)
    }

    /// Writes polygons, on a page if the format has pages. It is made larger
    /// where they lie beyond it.
    ///
    /// # Errors
    ///
    /// Where this build has no such format.
    pub fn write_on(
        self,
        polygons: &Rounded,
        page: Option<ShapePage>,
    ) -> Result<String, ExportError> {
        match self {
            #[cfg(feature = "json")]
            ShapeFormat::GeoJson => {
                let _ = page;
                Ok(geojson::write(polygons))
            }
            #[cfg(feature = "svg")]
            ShapeFormat::Svg => Ok(svg::write(polygons, page)),
            #[cfg(not(all(feature = "json", feature = "svg")))]
            _ => Err(self.missing()),
        }
    }

    #[cfg(not(all(feature = "json", feature = "svg")))]
    fn missing(self) -> ExportError {
        ExportError::ShapeFormat(format!("{self:?}, which this build does not have"))
    }
}

/// A number that reads as the same double, without a sign for zero.
#[cfg(any(feature = "json", feature = "svg"))]
fn number(value: f64) -> String {
    // Few digits for large and small numbers too.
    let (plain, short) = (format!("{}", value + 0.0), format!("{:e}", value + 0.0));
    if plain.len() <= short.len() + 8 { plain } else { short }
}

/// The line, from 1 on, of a byte.
#[cfg(any(feature = "json", feature = "svg"))]
fn line_of(bytes: &[u8], place: usize) -> usize {
    1 + bytes[..place].iter().filter(|&&byte| byte == b'\n').count()
}

#[cfg(all(test, feature = "json", feature = "svg"))]
mod tests {
    use super::*;
    use crate::polygon::clipping::FillRule;
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
        let text = r#"<svg xmlns="http://www.w3.org/2000/svg" width="30mm" height="10mm"
            viewBox="0 0 30 10"><g fill-rule="evenodd">
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
            (ShapeFormat::Svg, "<svg>\n<path d=\"M0 0C1 1 2 2 3z\"/></svg>", "line 2"),
            (ShapeFormat::Svg, "<svg>\n<path d=\"L0 0\"/></svg>", "line 2"),
            (ShapeFormat::Svg, "<svg>\n<path d=\"M0 x\"/></svg>", "line 2"),
            (ShapeFormat::Svg, "<svg>\n<path d=\"M0\"/></svg>", "line 2"),
            (ShapeFormat::Svg, "<svg>\n\n<g transform=\"big(2)\"/></svg>", "line 3"),
            (ShapeFormat::Svg, "<svg>\n<circle r=\"large\"/></svg>", "expected"),
            (ShapeFormat::Svg, "<svg>\n<path d=\"M0 0H1\"></svg>", "line"),
            (ShapeFormat::Svg, "<svg><path d=\"M0 1e999\"/></svg>", "1e999"),
        ];
        for (format, text, expected) in wrong {
            let error = read(format, text).unwrap_err();
            assert!(error.contains(expected), "{text}: {error}");
        }
    }
}
