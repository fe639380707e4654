//! The path data of SVG, as far as it is straight: M, L, H, V and Z.

use super::opened;
use glam::{DVec2, dvec2};

/// Reads path data: a ring for each subpath, closed or not.
pub(super) fn rings(data: &str) -> Result<Vec<Vec<DVec2>>, String> {
    let mut words = Words { rest: data };
    let (mut rings, mut ring): (Vec<Vec<DVec2>>, Vec<DVec2>) = (Vec::new(), Vec::new());
    let (mut at, mut start) = (DVec2::ZERO, DVec2::ZERO);
    let mut command = None;
    loop {
        if let Some(letter) = words.command() {
            if command.is_none() && !matches!(letter, 'M' | 'm') {
                return Err(format!("path data begins with `{letter}`, expected M or m"));
            }
            command = Some(letter);
            if matches!(letter, 'Z' | 'z') {
                at = start;
                continue;
            }
        } else if words.is_empty() {
            break;
        }
        let Some(letter) = command else {
            return Err(format!("path data begins with `{}`, expected M or m", words.next_word()));
        };
        let origin = if letter.is_ascii_lowercase() { at } else { DVec2::ZERO };
        at = match letter.to_ascii_uppercase() {
            'M' | 'L' => {
                let x = words.number()?;
                origin + dvec2(x, words.number()?)
            }
            'H' => dvec2(origin.x + words.number()?, at.y),
            'V' => dvec2(at.x, origin.y + words.number()?),
            'Z' => return Err(format!("`{}` after Z, expected a command", words.next_word())),
            _ => return Err(format!("`{letter}` in path data, expected M, L, H, V or Z")),
        };
        match letter {
            'M' | 'm' => {
                rings.push(opened(std::mem::take(&mut ring)));
                start = at;
                // Further pairs of numbers are lines.
                command = Some(if letter == 'M' { 'L' } else { 'l' });
            }
            // What follows Z without M starts where the last subpath did.
            _ if ring.is_empty() => ring.push(start),
            _ => {}
        }
        ring.push(at);
        if words.closes() {
            rings.push(opened(std::mem::take(&mut ring)));
        }
    }
    rings.push(opened(ring));
    rings.retain(|ring| !ring.is_empty());
    Ok(rings)
}

/// The points of a polygon: numbers in pairs.
pub(super) fn points(data: &str) -> Result<Vec<DVec2>, String> {
    let mut words = Words { rest: data };
    let mut ring = Vec::new();
    while !words.is_empty() {
        let x = words.number()?;
        ring.push(dvec2(x, words.number()?));
    }
    Ok(opened(ring))
}

struct Words<'d> {
    rest: &'d str,
}

impl<'d> Words<'d> {
    fn skip_space(&mut self) {
        self.rest = self.rest.trim_start_matches([' ', '\t', '\n', '\r', '\x0c', ',']);
    }

    fn is_empty(&mut self) -> bool {
        self.skip_space();
        self.rest.is_empty()
    }

    /// A letter, if one is next.
    fn command(&mut self) -> Option<char> {
        self.skip_space();
        let letter = self.rest.chars().next().filter(char::is_ascii_alphabetic)?;
        self.rest = &self.rest[1..];
        Some(letter)
    }

    /// Whether Z is next.
    fn closes(&mut self) -> bool {
        self.skip_space();
        self.rest.starts_with(['Z', 'z'])
    }

    /// What is next, for messages.
    fn next_word(&mut self) -> &'d str {
        self.skip_space();
        self.rest.split([' ', ',', '\n', '\t']).next().unwrap_or(self.rest)
    }

    /// A number. Two may follow one another without space: `1-2`, `.5.5`.
    fn number(&mut self) -> Result<f64, String> {
        self.skip_space();
        let bytes = self.rest.as_bytes();
        let digits = |mut at: usize| {
            while bytes.get(at).is_some_and(u8::is_ascii_digit) {
                at += 1;
            }
            at
        };
        let is_sign = |at: usize| matches!(bytes.get(at), Some(b'+' | b'-'));
        let mut end = digits(usize::from(is_sign(0)));
        if bytes.get(end) == Some(&b'.') {
            end = digits(end + 1);
        }
        if matches!(bytes.get(end), Some(b'e' | b'E')) {
            let first = end + 1 + usize::from(is_sign(end + 1));
            if digits(first) > first {
                end = digits(first);
            }
        }
        let text = &self.rest[..end];
        match text.parse::<f64>() {
            Ok(value) if value.is_finite() => {
                self.rest = &self.rest[end..];
                Ok(value)
            }
            Ok(_) => Err(format!("`{text}` is beyond the range of numbers")),
            Err(_) if self.rest.is_empty() => Err("the end, expected a number".to_owned()),
            Err(_) => Err(format!("`{}`, expected a number", self.next_word())),
        }
    }
}
