//! Which format a file has: what its bytes say, and only then its name.

use std::path::Path;

use super::json_scan::keys;
use super::text::Text;

/// A model format.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Format {
    /// Wavefront OBJ: polygons and polylines.
    Obj,
    /// STL, binary or text.
    Stl,
    /// PLY, binary or text.
    Ply,
    /// Geomview OFF, text.
    Off,
    /// Our own JSON: polygons with holes.
    PolygonScene,
    /// glTF 2.0, JSON or binary (GLB).
    Gltf,
}

impl Format {
    /// Every format.
    pub const ALL: [Format; 6] =
        [Format::Obj, Format::Stl, Format::Ply, Format::Off, Format::PolygonScene, Format::Gltf];

    /// What the format is called: its usual extension.
    pub fn name(self) -> &'static str {
        match self {
            Format::Obj => "obj",
            Format::Stl => "stl",
            Format::Ply => "ply",
            Format::Off => "off",
            Format::PolygonScene => "json",
            Format::Gltf => "gltf",
        }
    }

    /// The format of a name or extension: `obj`, `stl`, `ply`, `off`, `json`,
    /// `gltf` or `glb`, in small or capital letters.
    pub fn from_name(name: &str) -> Option<Format> {
        if name.eq_ignore_ascii_case("glb") {
            return Some(Format::Gltf);
        }
        Format::ALL.into_iter().find(|format| name.eq_ignore_ascii_case(format.name()))
    }

    /// The format that the extension of a file's name says.
    pub fn from_extension(path: &Path) -> Option<Format> {
        path.extension().and_then(|extension| extension.to_str()).and_then(Format::from_name)
    }

    /// The format that the bytes themselves say, `None` if they do not say
    /// it clearly. A truncated binary STL file, for one, says nothing.
    pub fn from_content(bytes: &[u8]) -> Option<Format> {
        Format::from_magic(bytes, bytes.len() as u64).or_else(|| from_first_words(bytes))
    }

    /// The format that the first bytes of a file of so many bytes prove.
    pub(super) fn from_magic(bytes: &[u8], length: u64) -> Option<Format> {
        if bytes.starts_with(b"glTF") {
            return Some(Format::Gltf);
        }
        if bytes.starts_with(b"ply\n") || bytes.starts_with(b"ply\r") {
            return Some(Format::Ply);
        }
        super::stl::is_binary(bytes, length).then_some(Format::Stl)
    }
}

fn from_first_words(bytes: &[u8]) -> Option<Format> {
    let mut text = Text::new(bytes).with_comments();
    let word = text.word_across_lines()?;
    if word.starts_with(b"{") {
        return from_keys(&bytes[text.offset() - word.len()..]);
    }
    if word.eq_ignore_ascii_case(b"solid") {
        text.next_line();
        let next = text.word_across_lines()?;
        let facets = next.eq_ignore_ascii_case(b"facet") || next.eq_ignore_ascii_case(b"endsolid");
        return facets.then_some(Format::Stl);
    }
    if super::off::is_magic(word) {
        return Some(Format::Off);
    }
    const STATEMENTS: [&[u8]; 11] =
        [b"v", b"vn", b"vt", b"f", b"l", b"o", b"g", b"s", b"usemtl", b"mtllib", b"p"];
    STATEMENTS.contains(&word).then_some(Format::Obj)
}

/// glTF and the polygon scene are both JSON; the first key that only one of
/// them has tells.
fn from_keys(json: &[u8]) -> Option<Format> {
    keys(json).find_map(|key| match key {
        b"vertices" | b"faces" => Some(Format::PolygonScene),
        b"asset"
        | b"scene"
        | b"scenes"
        | b"nodes"
        | b"meshes"
        | b"accessors"
        | b"buffers"
        | b"bufferViews"
        | b"materials"
        | b"extensionsUsed"
        | b"extensionsRequired" => Some(Format::Gltf),
        _ => None,
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn content_tells_the_format() {
        for (bytes, format) in [
            (&b"glTF\x02\0\0\0"[..], Format::Gltf),
            (b"{\"scene\": 0, \"asset\": {}}", Format::Gltf),
            (b"\n { \"name\": \"asset\", \"faces\": []}", Format::PolygonScene),
            (b"ply\r\nformat", Format::Ply),
            (b"# by hand\nCOFF 3 1 0", Format::Off),
            (b"# by hand\n\nmtllib a.mtl", Format::Obj),
            (b" solid a\n facet normal", Format::Stl),
        ] {
            assert_eq!(Format::from_content(bytes), Some(format), "{}", bytes.escape_ascii());
        }
        assert_eq!(Format::from_content(b"solid of revolution"), None);
        assert_eq!(Format::from_content(b""), None);
    }

    #[test]
    fn names_are_read_without_case() {
        assert_eq!(Format::from_extension(Path::new("a/b.GLB")), Some(Format::Gltf));
        assert_eq!(Format::from_extension(Path::new("a/b.step")), None);
        for format in Format::ALL {
            assert_eq!(Format::from_name(format.name()), Some(format));
        }
    }
}
