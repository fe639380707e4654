//! OFF (Geomview manual, section "OFF Files"; Princeton Shape Benchmark):
//! the word `OFF`, three counts, a line per vertex, a line per face.
//!
//! Letters before `OFF` announce more numbers per vertex (`ST` texture, `C`
//! colour, `N` normal), which follow the position and are passed over. A face
//! may end in a colour: three or four integers to 255 or fractions to 1; an
//! index into a colour map is passed over. What is no colour is passed over and
//! told. A face of two corners is a line.
//! `4` and `n` announce another space and are refused, as is the binary form.
//! Counts, vertices and faces may run over several lines; a face that does has
//! no colour. What follows the last face is passed over and told.

use glam::DVec3;

use super::super::{Color, FacePlace, Soup};
use super::Found;
use super::error::{Fault, Read, quote};
use super::text::{Text, integer};
use super::text_row::Row;
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
    let mut reader =
        Reader { text, vertex_count, soup: Soup::default(), colors: Vec::new(), odd_color: None };
    for number in 0..vertex_count {
        reader.vertex(number)?;
    }
    let mut corners = Vec::new();
    for number in 0..face_count {
        reader.face(number, face_count, &mut corners)?;
    }
    let mut warnings = Vec::new();
    if let Some((what, line)) = &reader.odd_color {
        warnings.push(format!("colours that are none are ignored ({what} in line {line})"));
    }
    if reader.text.next_full_line() {
        let line = reader.text.line();
        warnings.push(format!("what follows the faces is ignored (line {line})"));
    }
    let Reader { mut soup, colors, .. } = reader;
    if colors.iter().any(Option::is_some) {
        soup.colors = Some(colors);
    }
    Ok(Found { objects: vec![soup], warnings })
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
    let mut row = Row::default();
    let vertex_count = row.natural(text, "the number of vertices")?;
    let face_count = row.natural(text, "the number of faces")?;
    // Nobody needs it, and some leave it out.
    if text.has_word() || !row.is_one_line() {
        row.natural(text, "the number of edges")?;
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
    /// What stands in place of the first colour that is none, and its line.
    odd_color: Option<(String, u64)>,
}

impl Reader<'_> {
    fn vertex(&mut self, number: u64) -> Read<()> {
        if !self.text.next_full_line() {
            return Err(ends_early(&self.text, "vertices", number, self.vertex_count));
        }
        let mut row = Row::default();
        let x = row.number(&mut self.text, "the coordinate x")?;
        let y = row.number(&mut self.text, "the coordinate y")?;
        let z = row.number(&mut self.text, "the coordinate z")?;
        self.soup.vertices.push(DVec3::new(x, y, z));
        row.end(&self.text)
    }

    fn face(&mut self, number: u64, count: u64, corners: &mut Vec<u32>) -> Read<()> {
        if !self.text.next_full_line() {
            return Err(ends_early(&self.text, "faces", number, count));
        }
        let mut row = Row::default();
        let line = self.text.line();
        let corner_count = row.natural(&mut self.text, "the number of corners")?;
        // With too few vertices counted, the next one would look like this.
        if corner_count < 2 {
            let message = format!("a face with {corner_count} corners, expected 3 at least");
            return Err(self.text.fault(message));
        }
        corners.clear();
        for _ in 0..corner_count {
            corners.push(self.corner(&mut row)?);
        }
        row.end(&self.text)?;
        if let [a, b] = corners[..] {
            self.soup.lines.push([a, b]);
            return Ok(());
        }
        let place = FacePlace { number, line: Some(line) };
        self.soup.places.note(self.soup.faces.len() as u32, place);
        let color = color(&mut self.text).unwrap_or_else(|what| {
            self.odd_color.get_or_insert((what, self.text.line()));
            None
        });
        self.soup.faces.push(corners, []);
        self.colors.push(color);
        Ok(())
    }

    fn corner(&mut self, row: &mut Row) -> Read<u32> {
        let number = row.natural(&mut self.text, "a vertex number")?;
        if number < self.vertex_count {
            return Ok(number as u32);
        }
        let count = self.vertex_count;
        let message = if count == 0 {
            format!("vertex {number} does not exist, expected a file with vertices")
        } else {
            format!("vertex {number} does not exist, expected 0 to {}", count - 1)
        };
        Err(row.blame(self.text.fault(message)))
    }
}

/// The colour at the end of a face's line: three or four numbers. One number is
/// an index into a table of colours that is elsewhere; all else is no colour,
/// which is told as what it is.
fn color(text: &mut Text<'_>) -> Result<Option<Color>, String> {
    let words: Vec<_> = std::iter::from_fn(|| text.word()).take(5).collect();
    match words.len() {
        0 | 1 => return Ok(None),
        3 | 4 => {}
        5 => return Err("more than 4 numbers".to_owned()),
        count => return Err(format!("{count} numbers")),
    }
    let whole = words.iter().all(|word| integer(word).is_some());
    let most = if whole { 255.0 } else { 1.0 };
    let mut channels = [0; 3];
    for (channel, word) in channels.iter_mut().zip(words) {
        match text.number_in(word, "a colour") {
            Ok(value) if (0.0..=most).contains(&value) => {
                *channel = (value * (255.0 / most)).round() as u8;
            }
            _ => return Err(quote(word)),
        }
    }
    Ok(Some(Color(channels)))
}

fn ends_early(text: &Text<'_>, what: &str, number: u64, count: u64) -> Fault {
    text.fault(format!("the file ends after {number} {what}, expected {count}"))
}
