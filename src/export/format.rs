//! The table of output formats.

use super::ExportError;
use std::path::Path;

/// A format that this build writes.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum OutputFormat {
    /// Scalable vector graphics with one layer per pen.
    Svg,
    /// Instructions for a pen plotter.
    Hpgl,
    /// The visible lines themselves, before any page.
    Json,
    /// A picture of the SVG.
    Png,
}

/// A format by the names it goes by; the first is its proper one.
struct Row {
    names: &'static [&'static str],
    /// Nothing if the format is only known by name.
    format: Option<OutputFormat>,
}

const TABLE: [Row; 6] = [
    Row { names: &["svg"], format: built(cfg!(feature = "svg"), OutputFormat::Svg) },
    Row { names: &["hpgl", "plt"], format: Some(OutputFormat::Hpgl) },
    Row { names: &["json"], format: built(cfg!(feature = "json"), OutputFormat::Json) },
    Row { names: &["png"], format: built(cfg!(feature = "png"), OutputFormat::Png) },
    Row { names: &["dxf"], format: None },
    Row { names: &["pdf"], format: None },
];

const fn built(with_feature: bool, format: OutputFormat) -> Option<OutputFormat> {
    if with_feature { Some(format) } else { None }
}

impl OutputFormat {
    /// The format called `name`, which is also its extension; upper or lower
    /// case.
    pub fn from_name(name: &str) -> Result<Self, ExportError> {
        let called = |row: &&Row| row.names.iter().any(|known| known.eq_ignore_ascii_case(name));
        let name = name.to_owned();
        match TABLE.iter().find(called) {
            Some(Row { format: Some(format), .. }) => Ok(*format),
            Some(_) => Err(ExportError::UnsupportedFormat { name, supported: supported() }),
            None => Err(ExportError::UnknownFormat { name, supported: supported() }),
        }
    }

    /// The format that the extension of `path` names.
    pub fn from_path(path: &Path) -> Result<Self, ExportError> {
        match path.extension() {
            Some(extension) => Self::from_name(&extension.to_string_lossy()),
            None => Err(ExportError::NoExtension { path: path.to_owned(), supported: supported() }),
        }
    }

    /// The formats of this build.
    pub fn all() -> impl Iterator<Item = Self> {
        TABLE.iter().filter_map(|row| row.format)
    }

    /// The name in flags and extensions.
    pub fn name(self) -> &'static str {
        match self {
            OutputFormat::Svg => "svg",
            OutputFormat::Hpgl => "hpgl",
            OutputFormat::Json => "json",
            OutputFormat::Png => "png",
        }
    }
}

/// All names that would have been understood, for messages.
fn supported() -> String {
    let rows = TABLE.iter().filter(|row| row.format.is_some());
    let names: Vec<&str> = rows.flat_map(|row| row.names).copied().collect();
    names.join(", ")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn extensions_and_names_find_their_format() {
        let plt = OutputFormat::from_path(Path::new("folder.svg/Sheet.PLT"));
        assert!(matches!(plt, Ok(OutputFormat::Hpgl)));
        for format in OutputFormat::all() {
            assert!(matches!(OutputFormat::from_name(format.name()), Ok(same) if same == format));
        }
    }

    #[test]
    fn formats_to_come_are_told_from_unknown_ones() {
        for name in ["dxf", "pdf"] {
            let message = OutputFormat::from_name(name).err().map(|error| error.to_string());
            let message = message.unwrap_or_default();
            assert!(message.contains("not supported yet") && message.contains("hpgl, plt"));
        }
        let unknown = OutputFormat::from_path(Path::new("drawing.gif"));
        assert!(matches!(unknown, Err(ExportError::UnknownFormat { name, .. }) if name == "gif"));
        let bare = OutputFormat::from_path(Path::new("drawing"));
        assert!(matches!(bare, Err(ExportError::NoExtension { .. })));
    }
}
