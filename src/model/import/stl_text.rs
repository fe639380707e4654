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
//!
//! `end loop` and the like are written in two words too. What else stands in
//! the line of a statement (a colour, an attribute) is
//! passed over and told, as is text between solids or after the last one. The
//! end of a file stands for an `endsolid` that was never written. All else
//! that is not in its place is an error.

use glam::DVec3;

use super::super::{Faces, Soup};
use super::Found;
use super::error::{Fault, Read, quote};
use super::text::Text;
use crate::run::Run;

/// Words of the grammar: these are never passed over.
const KEYWORDS: [&str; 9] =
    ["solid", "facet", "normal", "outer", "loop", "vertex", "endloop", "endfacet", "endsolid"];

/// Reads the text form; each solid becomes an object.
pub(super) fn read(bytes: &[u8], run: &Run<'_>) -> Read<Found> {
    let mut reader = Reader {
        text: Text::new(bytes).within(run),
        found: Found::default(),
        passed_words: false,
        passed_lines: false,
    };
    while let Some(word) = reader.word() {
        if is(word, "solid") {
            reader.solid()?;
        } else if reader.found.objects.is_empty() {
            return Err(reader.unexpected(Some(word), "solid"));
        } else {
            reader.pass_line(word);
        }
    }
    Ok(reader.found)
}

struct Reader<'a> {
    text: Text<'a>,
    found: Found,
    /// Whether words within solids, and lines outside of them, were told of.
    passed_words: bool,
    passed_lines: bool,
}

impl<'a> Reader<'a> {
    fn solid(&mut self) -> Read<()> {
        let name = String::from_utf8_lossy(self.text.rest_of_line()).into_owned();
        let mut vertices = Vec::new();
        while self.begins_facet(vertices.is_empty())? {
            self.facet(&mut vertices)?;
        }
        let faces = Faces::from_triangles((0..vertices.len() as u32).collect());
        self.found.objects.push(Soup { name, vertices, faces, ..Soup::default() });
        Ok(())
    }

    /// Whether another facet begins here; otherwise the solid ends.
    fn begins_facet(&mut self, is_first: bool) -> Read<bool> {
        const EXPECTED: &str = "facet or endsolid";
        let line = self.text.line();
        loop {
            let Some(word) = self.word() else {
                if is_first {
                    return Err(self.unexpected(None, EXPECTED));
                }
                let warning = format!("the file ends without endsolid (line {})", self.text.line());
                self.found.warnings.push(warning);
                return Ok(false);
            };
            if is(word, "facet") {
                return Ok(true);
            }
            if is(word, "endsolid") {
                self.text.rest_of_line();
                return Ok(false);
            }
            self.pass_word(word, line, EXPECTED)?;
        }
    }

    fn facet(&mut self, vertices: &mut Vec<DVec3>) -> Read<()> {
        self.skip_normal()?;
        self.expect("loop")?;
        for _ in 0..3 {
            self.expect("vertex")?;
            let vertex = DVec3::new(self.coordinate()?, self.coordinate()?, self.coordinate()?);
            vertices.push(vertex);
        }
        self.expect("endloop")?;
        self.expect("endfacet")
    }

    /// Normals are often rubbish (zero, NaN, too short) and never needed:
    /// whatever stands before `outer`.
    fn skip_normal(&mut self) -> Read<()> {
        loop {
            match self.word() {
                Some(word) if is(word, "outer") => return Ok(()),
                Some(word) if !is_keyword(word) || is(word, "normal") => {}
                word => return Err(self.unexpected(word, "outer loop")),
            }
        }
    }

    /// The next word; `end loop` is one word.
    fn word(&mut self) -> Option<&'a [u8]> {
        let word = self.text.word_across_lines()?;
        if !is(word, "end") {
            return Some(word);
        }
        let mut ahead = self.text.clone();
        let next = ahead.word();
        let both = ["endloop", "endfacet", "endsolid"];
        let joined = both.into_iter().find(|both| next.is_some_and(|next| is(next, &both[3..])));
        Some(joined.map_or(word, |joined| {
            self.text = ahead;
            joined.as_bytes()
        }))
    }

    fn coordinate(&mut self) -> Read<f64> {
        const EXPECTED: &str = "a coordinate";
        let line = self.text.line();
        let Some(word) = self.text.word_across_lines() else {
            return Err(self.unexpected(None, EXPECTED));
        };
        let number = self.text.number_in(word, EXPECTED);
        // A word of another line that is no number is not the one that is wrong.
        if number.is_err() && self.text.line() != line {
            return Err(Fault::line(line, format!("the line ends here, expected {EXPECTED}")));
        }
        number
    }

    fn expect(&mut self, keyword: &str) -> Read<()> {
        let line = self.text.line();
        loop {
            match self.word() {
                Some(word) if is(word, keyword) => return Ok(()),
                Some(word) => self.pass_word(word, line, keyword)?,
                None => return Err(self.unexpected(None, keyword)),
            }
        }
    }

    /// Passes over a word in the line of the statement before it.
    fn pass_word(&mut self, word: &'a [u8], line: u64, expected: &str) -> Read<()> {
        if self.text.line() != line || is_keyword(word) {
            return Err(self.unexpected(Some(word), expected));
        }
        if !self.passed_words {
            self.passed_words = true;
            let word = quote(word);
            let warning = format!("words after statements are ignored ({word} in line {line})");
            self.found.warnings.push(warning);
        }
        Ok(())
    }

    /// Passes over a line that belongs to no solid.
    fn pass_line(&mut self, word: &[u8]) {
        if !self.passed_lines {
            self.passed_lines = true;
            let (word, line) = (quote(word), self.text.line());
            let warning = format!("text outside of solids is ignored ({word} in line {line})");
            self.found.warnings.push(warning);
        }
        self.text.rest_of_line();
    }

    fn unexpected(&self, word: Option<&[u8]>, expected: &str) -> Fault {
        self.text.fault(match word {
            Some(word) => format!("{} stands here, expected {expected}", quote(word)),
            None => format!("the file ends here, expected {expected}"),
        })
    }
}

fn is(word: &[u8], keyword: &str) -> bool {
    word.eq_ignore_ascii_case(keyword.as_bytes())
}

fn is_keyword(word: &[u8]) -> bool {
    KEYWORDS.iter().any(|keyword| is(word, keyword))
}
