//! Wavefront OBJ (Advanced Visualizer manual, appendix B, about 1990): one
//! statement per line, a vertex, a polygon or a polyline, or a name for what
//! follows.
//!
//! Polygons stay polygons, concave ones too. Vertices belong to the file and
//! are numbered from 1, or from -1 backwards; a number may run ahead of its
//! vertex, so those are checked when the file has ended. Each `o` begins an
//! object; where no `o` has been, each `g` does. Materials, normals, texture
//! coordinates and smoothing groups do not change the shape and are passed
//! over; unknown statements are too, with a warning, and so are faces and lines
//! with too few corners.

use glam::DVec3;

use super::super::FacePlace;
use super::Found;
use super::error::{Fault, Read, quote};
use super::parts::{ForwardReferences, Part, split};
use super::text::{Text, integer};
use crate::run::Run;

/// Reads an OBJ file.
pub(super) fn read(bytes: &[u8], run: &Run<'_>) -> Read<Found> {
    let mut reader = Reader::new(bytes, run);
    let outcome = reader.statements();
    // A reference that leads nowhere comes before any later problem, but
    // takes the rest of the file's vertices to be known.
    let later = if outcome.is_err() { reader.count_later_vertices() } else { 0 };
    let count = reader.vertices.len() as u64 + later;
    if let Some((line, number)) = reader.forward.first_beyond(count) {
        let number = number + 1;
        let message = match count {
            0 => format!("vertex {number} does not exist, expected a file with vertices"),
            _ => format!("vertex {number} does not exist, expected 1 to {count}"),
        };
        return Err(Fault::line(line, message));
    }
    outcome?;
    if reader.vertices.is_empty() {
        return Err(reader.text.fault("the file ends without a vertex, expected v statements"));
    }
    let Reader { vertices, parts, warnings, .. } = reader;
    Ok(Found { objects: split(vertices, parts), warnings })
}

struct Reader<'a> {
    text: Text<'a>,
    vertices: Vec<DVec3>,
    parts: Vec<Part>,
    /// How many faces there have been.
    face_count: u64,
    /// The name in force, and whether a part of that name has begun.
    name: &'a [u8],
    begun: bool,
    /// Whether an `o` has been met.
    has_objects: bool,
    forward: ForwardReferences,
    /// The corners of the face or polyline at hand.
    corners: Vec<u32>,
    unknown: Vec<&'a [u8]>,
    few_corners: Vec<&'static str>,
    warnings: Vec<String>,
}

impl<'a> Reader<'a> {
    fn new(bytes: &'a [u8], run: &'a Run<'a>) -> Self {
        Reader {
            text: Text::new(bytes).with_comments().with_continued_lines().within(run),
            vertices: Vec::new(),
            parts: Vec::new(),
            face_count: 0,
            name: b"",
            begun: false,
            has_objects: false,
            forward: ForwardReferences::default(),
            corners: Vec::new(),
            unknown: Vec::new(),
            few_corners: Vec::new(),
            warnings: Vec::new(),
        }
    }

    fn statements(&mut self) -> Read<()> {
        loop {
            if let Some(keyword) = self.text.word() {
                self.statement(keyword)?;
            }
            if !self.text.next_line() {
                return Ok(());
            }
        }
    }

    fn statement(&mut self, keyword: &'a [u8]) -> Read<()> {
        match keyword {
            b"v" => self.vertex(),
            b"f" => self.face(),
            b"l" => self.polyline(),
            b"o" => {
                self.has_objects = true;
                self.begin_part();
                Ok(())
            }
            b"g" => {
                if !self.has_objects {
                    self.begin_part();
                }
                Ok(())
            }
            b"vn" | b"vt" | b"s" | b"usemtl" | b"mtllib" => Ok(()),
            _ => self.unknown(keyword),
        }
    }

    fn vertex(&mut self) -> Read<()> {
        let x = self.text.number("the coordinate x")?;
        let y = self.text.number("the coordinate y")?;
        let z = self.text.number("the coordinate z")?;
        self.vertices.push(DVec3::new(x, y, z));
        Ok(())
    }

    fn face(&mut self) -> Read<()> {
        let line = self.text.line();
        self.read_corners()?;
        if self.corners.len() < 3 {
            self.few_corners("faces with fewer than 3 corners", line);
            return Ok(());
        }
        self.begin();
        if let Some(part) = self.parts.last_mut() {
            let place = FacePlace { number: self.face_count, line: Some(line) };
            part.places.note(part.faces.len() as u32, place);
            part.faces.push(&self.corners, []);
        }
        self.face_count += 1;
        Ok(())
    }

    fn polyline(&mut self) -> Read<()> {
        let line = self.text.line();
        self.read_corners()?;
        if self.corners.len() < 2 {
            self.few_corners("lines with fewer than 2 corners", line);
            return Ok(());
        }
        self.begin();
        if let Some(part) = self.parts.last_mut() {
            part.lines.extend(self.corners.windows(2).map(|ends| [ends[0], ends[1]]));
        }
        Ok(())
    }

    /// Tells once of faces or lines that are passed over.
    fn few_corners(&mut self, what: &'static str, line: u64) {
        if !self.few_corners.contains(&what) {
            self.few_corners.push(what);
            self.warnings.push(format!("{what} are ignored (line {line})"));
        }
    }

    /// Makes sure that the last part is the one in force.
    fn begin(&mut self) {
        if !self.begun {
            let name = String::from_utf8_lossy(self.name).into_owned();
            self.parts.push(Part { name, ..Part::default() });
            self.begun = true;
        }
    }

    fn begin_part(&mut self) {
        self.name = self.text.rest_of_line();
        self.begun = false;
    }

    fn read_corners(&mut self) -> Read<()> {
        self.corners.clear();
        while let Some(word) = self.text.word() {
            let corner = self.corner(word)?;
            self.corners.push(corner);
        }
        Ok(())
    }

    /// The vertex of `v`, `v/vt`, `v//vn` or `v/vt/vn`, counted from 0.
    fn corner(&mut self, word: &[u8]) -> Read<u32> {
        let count = self.vertices.len() as i64;
        let digits = word.split(|&byte| byte == b'/').next().unwrap_or(word);
        let Some(number) = integer(digits) else {
            let message = format!("{} is no vertex number, expected an integer", quote(word));
            return Err(self.text.fault(message));
        };
        if number == 0 || number < -count {
            let backwards =
                if count == 0 { String::new() } else { format!(", or -1 down to -{count}") };
            let message = format!("vertex {number} does not exist, expected 1 and up{backwards}");
            return Err(self.text.fault(message));
        }
        let index = if 0 < number { number - 1 } else { count + number };
        if count <= index {
            self.forward.note(self.text.line(), index as u64);
        }
        Ok(index as u32)
    }

    fn unknown(&mut self, keyword: &'a [u8]) -> Read<()> {
        // What is no text is no OBJ file.
        if let Some(byte) = keyword.iter().find(|byte| byte.is_ascii_control()) {
            let message = format!("{} has the control byte 0x{byte:02x}", quote(keyword));
            return Err(self.text.fault(format!("{message}, expected a statement")));
        }
        const MOST: usize = 20;
        if self.unknown.len() < MOST && !self.unknown.contains(&keyword) {
            self.unknown.push(keyword);
            let line = self.text.line();
            self.warnings.push(format!("statements {} are ignored (line {line})", quote(keyword)));
        }
        Ok(())
    }

    fn count_later_vertices(&self) -> u64 {
        let mut text = self.text.clone();
        let mut count = 0;
        while text.next_line() {
            count += u64::from(text.word() == Some(b"v"));
        }
        count
    }
}
