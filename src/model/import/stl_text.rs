//! The text form of STL: words in a fixed order, in any case and layout.
//!
//! ```text
//! solid NAME
//!   facet normal X Y Z
//!     outer loop
//!       vertex X Y Z    (three times)
//!     endloop
//!   endfacet            (any number of facets)
//! endsolid NAME         (any number of solids)
//! ```

use glam::DVec3;

use super::super::{Faces, Soup};
use super::Found;
use super::error::{Fault, Read, quote};
use super::text::Text;
use crate::run::Run;

/// Reads the text form; each solid becomes an object.
pub(super) fn read(bytes: &[u8], run: &Run<'_>) -> Read<Found> {
    let mut text = Text::new(bytes).within(run);
    let mut found = Found::default();
    while let Some(word) = text.word_across_lines() {
        check(&text, Some(word), "solid")?;
        let name = String::from_utf8_lossy(text.rest_of_line()).into_owned();
        let vertices = facets(&mut text)?;
        let faces = Faces::from_triangles((0..vertices.len() as u32).collect());
        found.objects.push(Soup { name, vertices, faces, ..Soup::default() });
    }
    Ok(found)
}

/// The corners of all facets up to `endsolid`.
fn facets(text: &mut Text<'_>) -> Read<Vec<DVec3>> {
    let mut vertices = Vec::new();
    loop {
        let word = text.word_across_lines();
        if word.is_some_and(|word| word.eq_ignore_ascii_case(b"endsolid")) {
            text.rest_of_line();
            return Ok(vertices);
        }
        if word.is_none_or(|word| !word.eq_ignore_ascii_case(b"facet")) {
            return Err(unexpected(text, word, "facet or endsolid"));
        }
        expect(text, "normal")?;
        // Normals are often rubbish (zero, NaN) and never needed: three
        // words, whatever they are.
        for _ in 0..3 {
            if text.word_across_lines().is_none() {
                return Err(unexpected(text, None, "a normal"));
            }
        }
        expect(text, "outer")?;
        expect(text, "loop")?;
        for _ in 0..3 {
            expect(text, "vertex")?;
            let vertex = DVec3::new(coordinate(text)?, coordinate(text)?, coordinate(text)?);
            vertices.push(vertex);
        }
        expect(text, "endloop")?;
        expect(text, "endfacet")?;
    }
}

fn coordinate(text: &mut Text<'_>) -> Read<f64> {
    match text.word_across_lines() {
        Some(word) => text.number_in(word, "a coordinate"),
        None => Err(unexpected(text, None, "a coordinate")),
    }
}

fn expect(text: &mut Text<'_>, keyword: &str) -> Read<()> {
    let word = text.word_across_lines();
    check(text, word, keyword)
}

fn check(text: &Text<'_>, word: Option<&[u8]>, keyword: &str) -> Read<()> {
    match word {
        Some(word) if word.eq_ignore_ascii_case(keyword.as_bytes()) => Ok(()),
        _ => Err(unexpected(text, word, keyword)),
    }
}

fn unexpected(text: &Text<'_>, word: Option<&[u8]>, expected: &str) -> Fault {
    text.fault(match word {
        Some(word) => format!("{} stands here, expected {expected}", quote(word)),
        None => format!("the file ends here, expected {expected}"),
    })
}
