//! OFF (Geomview manual, section "OFF Files"; Princeton Shape Benchmark):
//! the word `OFF`, three counts, a line per vertex, a line per face.
//!
//! Letters before `OFF` announce more numbers per vertex (`ST` texture, `C`
//! colour, `N` normal), which follow the position and are passed over. A face
//! may end in a colour: three or four integers to 255 or fractions to 1; an
//! index into a colour map is passed over. A face of two corners is a line.
//! `4` and `n` announce another space and are refused, as is the binary form.

use glam::DVec3;

use super::super::{Color, FacePlace, Soup};
use super::Found;
use super::error::{Fault, Read, quote};
use super::text::{Text, integer};
use crate::run::Run;

/// Whether the word opens an OFF file, even one of a kind that is refused.
pub(super) fn is_magic(word: &[u8]) -> bool {
    prefix(word).is_some()
}

/// What stands before `OFF`.
fn prefix(word: &[u8]) -> Option<&[u8]> {
    let prefix = word.strip_suffix(b"OFF")?;
    let mut rest = prefix;
    for letters in [&b"ST"[..], b"C", b"N", b"4", b"n"] {
        rest = rest.strip_prefix(letters).unwrap_or(rest);
    }
    rest.is_empty().then_some(prefix)
}

/// Reads an OFF file.
pub(super) fn read(bytes: &[u8], run: &Run<'_>) -> Read<Found> {
    let mut text = Text::new(bytes).with_comments().within(run);
    let (vertex_count, face_count) = header(&mut text)?;
    let mut reader = Reader { text, vertex_count, soup: Soup::default(), colors: Vec::new() };
    for number in 0..vertex_count {
        reader.vertex(number)?;
    }
    let mut corners = Vec::new();
    for number in 0..face_count {
        reader.face(number, face_count, &mut corners)?;
    }
    if reader.text.next_full_line() {
        let message = format!("a line follows {face_count} faces, expected the end of the file");
        return Err(reader.text.fault(message));
    }
    let Reader { mut soup, colors, .. } = reader;
    if colors.iter().any(Option::is_some) {
        soup.colors = Some(colors);
    }
    Ok(Found { objects: vec![soup], warnings: Vec::new() })
}

/// The numbers of vertices and faces.
fn header(text: &mut Text<'_>) -> Read<(u64, u64)> {
    let word = text.word_across_lines().unwrap_or_default();
    match prefix(word) {
        None => return Err(text.fault(format!("{} stands here, expected OFF", quote(word)))),
        Some(prefix) if prefix.contains(&b'4') || prefix.contains(&b'n') => {
            let message = format!("{} is not read, expected points in space (OFF)", quote(word));
            return Err(text.fault(message));
        }
        Some(_) => {}
    }
    if !text.has_word() && !text.next_full_line() {
        return Err(text.fault("the file ends here, expected the number of vertices"));
    }
    if text.clone().word() == Some(b"BINARY") {
        return Err(text.fault("the binary form is not read, expected text"));
    }
    let vertex_count = text.natural("the number of vertices")?;
    let face_count = text.natural("the number of faces")?;
    if text.has_word() {
        text.natural("the number of edges")?;
    }
    if let Some(word) = text.word() {
        let message = format!("{} follows the counts, expected the end of the line", quote(word));
        return Err(text.fault(message));
    }
    Ok((vertex_count, face_count))
}

struct Reader<'a> {
    text: Text<'a>,
    vertex_count: u64,
    soup: Soup,
    colors: Vec<Option<Color>>,
}

impl Reader<'_> {
    fn vertex(&mut self, number: u64) -> Read<()> {
        if !self.text.next_full_line() {
            return Err(ends_early(&self.text, "vertices", number, self.vertex_count));
        }
        let x = self.text.number("the coordinate x")?;
        let y = self.text.number("the coordinate y")?;
        let z = self.text.number("the coordinate z")?;
        self.soup.vertices.push(DVec3::new(x, y, z));
        Ok(())
    }

    fn face(&mut self, number: u64, count: u64, corners: &mut Vec<u32>) -> Read<()> {
        if !self.text.next_full_line() {
            return Err(ends_early(&self.text, "faces", number, count));
        }
        let line = self.text.line();
        let corner_count = self.text.natural("the number of corners")?;
        if corner_count < 2 {
            let message = format!("a face with {corner_count} corners, expected 3 at least");
            return Err(self.text.fault(message));
        }
        corners.clear();
        for _ in 0..corner_count {
            corners.push(self.corner()?);
        }
        if let [a, b] = corners[..] {
            self.soup.lines.push([a, b]);
            return Ok(());
        }
        let place = FacePlace { number, line: Some(line) };
        self.soup.places.note(self.soup.faces.len() as u32, place);
        let color = color(&mut self.text)?;
        self.soup.faces.push(corners, []);
        self.colors.push(color);
        Ok(())
    }

    fn corner(&mut self) -> Read<u32> {
        let number = self.text.natural("a vertex number")?;
        if number < self.vertex_count {
            return Ok(number as u32);
        }
        let count = self.vertex_count;
        let message = if count == 0 {
            format!("vertex {number} does not exist, expected a file with vertices")
        } else {
            format!("vertex {number} does not exist, expected 0 to {}", count - 1)
        };
        Err(self.text.fault(message))
    }
}

/// The colour at the end of a face's line.
fn color(text: &mut Text<'_>) -> Read<Option<Color>> {
    let mut words = Vec::new();
    while let Some(word) = text.word() {
        words.push(word);
        if words.len() == 5 {
            break;
        }
    }
    match words.len() {
        0 | 1 => return Ok(None),
        3 | 4 => {}
        count => {
            let count = if count == 5 { "more than 4".to_owned() } else { count.to_string() };
            let message = format!("a colour of {count} numbers, expected 3 or 4");
            return Err(text.fault(message));
        }
    }
    let whole = words.iter().all(|word| integer(word).is_some());
    let (most, what) =
        if whole { (255.0, "a colour from 0 to 255") } else { (1.0, "a colour from 0 to 1") };
    let mut channels = [0; 3];
    for (channel, word) in channels.iter_mut().zip(words) {
        let value = text.number_in(word, what)?;
        if !(0.0..=most).contains(&value) {
            return Err(text.fault(format!("{} is out of range, expected {what}", quote(word))));
        }
        *channel = (value * (255.0 / most)).round() as u8;
    }
    Ok(Some(Color(channels)))
}

fn ends_early(text: &Text<'_>, what: &str, number: u64, count: u64) -> Fault {
    text.fault(format!("the file ends after {number} {what}, expected {count}"))
}
