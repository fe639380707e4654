//! A cursor over the words and lines of a text format.
//!
//! A line ends in LF, CR or both, CR first: all three are one end of a line.
//!
//! It works on bytes, because model files in text form are large and almost
//! wholly numbers, and because names in them come in any encoding. Numbers
//! are parsed by the standard library, so they are correctly rounded.

use super::error::{Fault, Read, quote};
use crate::run::Run;

/// A position between two bytes of a text, and its line.
#[derive(Clone)]
pub(super) struct Text<'a> {
    bytes: &'a [u8],
    at: usize,
    line: u64,
    comments: bool,
    continued: bool,
    run: Option<&'a Run<'a>>,
}

/// Lines between two questions whether to go on: a power of two.
const LINES: u64 = 1 << 10;

impl<'a> Text<'a> {
    /// Starts at the first line, after a byte order mark if there is one.
    pub(super) fn new(bytes: &'a [u8]) -> Self {
        let at = if bytes.starts_with(b"\xef\xbb\xbf") { 3 } else { 0 };
        Text { bytes, at, line: 1, comments: false, continued: false, run: None }
    }

    /// Words that begin with `#` end their line.
    pub(super) fn with_comments(mut self) -> Self {
        self.comments = true;
        self
    }

    /// Once the run is stopped the text looks as if it ended: whatever the
    /// reader makes of that, its caller asks the run first.
    pub(super) fn within(mut self, run: &'a Run<'a>) -> Self {
        self.run = Some(run);
        self
    }

    /// A `\` before the end of a line joins the next line to it.
    pub(super) fn with_continued_lines(mut self) -> Self {
        self.continued = true;
        self
    }

    /// The next word of this line; `None` at the end of the line.
    pub(super) fn word(&mut self) -> Option<&'a [u8]> {
        loop {
            match self.bytes.get(self.at)? {
                b' ' | b'\t' | 0x0b | 0x0c => self.at += 1,
                b'\n' | b'\r' => return None,
                b'#' if self.comments => {
                    self.skip_to_line_end();
                    return None;
                }
                b'\\' if self.joins_lines(self.at) => {
                    self.skip_to_line_end();
                    self.at += self.line_end();
                    self.line += 1;
                }
                _ => break,
            }
        }
        let start = self.at;
        while let Some(byte) = self.bytes.get(self.at) {
            let ends = byte.is_ascii_whitespace() || *byte == 0x0b;
            if ends || *byte == b'\\' && self.joins_lines(self.at) {
                break;
            }
            self.at += 1;
        }
        Some(&self.bytes[start..self.at])
    }

    /// The next word of this line or of a later one; `None` at the end.
    pub(super) fn word_across_lines(&mut self) -> Option<&'a [u8]> {
        loop {
            if let Some(word) = self.word() {
                return Some(word);
            }
            if !self.next_line() {
                return None;
            }
        }
    }

    /// What is left of this line, without the white space around it.
    pub(super) fn rest_of_line(&mut self) -> &'a [u8] {
        let start = self.at;
        self.skip_to_line_end();
        self.bytes[start..self.at].trim_ascii()
    }

    /// Goes to the beginning of the next line; false at the end of the file.
    pub(super) fn next_line(&mut self) -> bool {
        if self.line.is_multiple_of(LINES)
            && let Some(run) = self.run
        {
            run.advance(0);
            if run.is_stopped() {
                self.at = self.bytes.len();
            }
        }
        loop {
            let start = self.at;
            self.skip_to_line_end();
            let left = &self.bytes[start..self.at];
            let next = self.at + self.line_end();
            if self.bytes.len() <= next {
                self.at = self.bytes.len();
                return false;
            }
            self.at = next;
            self.line += 1;
            // A comment ends with its line, whatever it ends in.
            if !(self.continued && left.ends_with(b"\\") && !left.contains(&b'#')) {
                return true;
            }
        }
    }

    /// Goes to the next line that has a word; false if there is none.
    pub(super) fn next_full_line(&mut self) -> bool {
        while self.next_line() {
            if self.has_word() {
                return true;
            }
        }
        false
    }

    /// Whether this line has another word.
    pub(super) fn has_word(&self) -> bool {
        self.clone().word().is_some()
    }

    /// This line, counted from 1. At the end of the file, its last line.
    pub(super) fn line(&self) -> u64 {
        self.line
    }

    /// Whether the next byte but blanks is a CR that ends its line alone.
    #[cfg(feature = "ply")]
    pub(super) fn line_ends_in_cr(&self) -> bool {
        let mut text = self.clone();
        text.word().is_none()
            && text.bytes[text.at..].starts_with(b"\r")
            && !text.bytes[text.at..].starts_with(b"\r\n")
    }

    /// Goes behind the CR that ends this line, whatever follows it.
    #[cfg(feature = "ply")]
    pub(super) fn pass_cr(&mut self) {
        self.skip_to_line_end();
        self.at = (self.at + 1).min(self.bytes.len());
        self.line += 1;
    }

    /// The offset of the next byte.
    pub(super) fn offset(&self) -> usize {
        self.at
    }

    /// A problem in this line.
    pub(super) fn fault(&self, message: impl Into<String>) -> Fault {
        Fault::line(self.line, message)
    }

    /// The next word of this line as a finite number.
    pub(super) fn number(&mut self, what: &str) -> Read<f64> {
        match self.word() {
            Some(word) => self.number_in(word, what),
            None => Err(self.line_ends(what)),
        }
    }

    /// The word as a finite number.
    pub(super) fn number_in(&self, word: &[u8], what: &str) -> Read<f64> {
        match std::str::from_utf8(word).ok().and_then(|word| word.parse::<f64>().ok()) {
            Some(number) if number.is_finite() => Ok(number),
            Some(_) => Err(self.fault(format!("{} is not finite, expected {what}", quote(word)))),
            None => Err(self.no_number(word, what)),
        }
    }

    /// The fault of a word of this text that is no number.
    fn no_number(&self, word: &[u8], what: &str) -> Fault {
        self.fault(match word.iter().position(u8::is_ascii_control) {
            Some(place) => {
                let start = word.as_ptr().addr() - self.bytes.as_ptr().addr();
                let (byte, place) = (word[place], start + place);
                format!(
                    "byte {place} of the file is the control byte 0x{byte:02x}, expected {what}"
                )
            }
            None => format!("{} is no number, expected {what}", quote(word)),
        })
    }

    /// The next word of this line as a number that counts or names things.
    pub(super) fn natural(&mut self, what: &str) -> Read<u64> {
        match self.word() {
            Some(word) => self.natural_in(word, what),
            None => Err(self.line_ends(what)),
        }
    }

    /// The fault of a line that ends too early.
    pub(super) fn line_ends(&self, what: &str) -> Fault {
        self.fault(format!("the line ends here, expected {what}"))
    }

    /// The word as a number that counts or names things.
    pub(super) fn natural_in(&self, word: &[u8], what: &str) -> Read<u64> {
        match integer(word).and_then(|number| u64::try_from(number).ok()) {
            Some(number) => Ok(number),
            None => Err(self.fault(format!(
                "{} is no natural number below 1e18, expected {what}",
                quote(word)
            ))),
        }
    }

    fn skip_to_line_end(&mut self) {
        let rest = &self.bytes[self.at..];
        let is_end = |&byte: &u8| byte == b'\n' || byte == b'\r';
        self.at += rest.iter().position(is_end).unwrap_or(rest.len());
    }

    /// How many bytes the end of the line takes that stands here.
    fn line_end(&self) -> usize {
        if self.bytes[self.at..].starts_with(b"\r\n") { 2 } else { 1 }
    }

    /// Whether the `\` at `at` is the last visible byte of its line.
    fn joins_lines(&self, at: usize) -> bool {
        let rest = &self.bytes[at + 1..];
        self.continued && matches!(rest.first(), Some(b'\n' | b'\r'))
    }
}

/// A decimal integer with or without a sign; `None` if it is none or large.
pub(super) fn integer(word: &[u8]) -> Option<i64> {
    let (negative, digits) = match word {
        [b'-', digits @ ..] => (true, digits),
        [b'+', digits @ ..] => (false, digits),
        digits => (false, digits),
    };
    if digits.is_empty() || 18 < digits.len() {
        return None;
    }
    let mut value = 0;
    for digit in digits {
        if !digit.is_ascii_digit() {
            return None;
        }
        value = 10 * value + i64::from(digit - b'0');
    }
    Some(if negative { -value } else { value })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn words_end_at_comments_and_run_over_continued_lines() {
        let mut text = Text::new(b"a b\\\r\nc # d\ne").with_comments().with_continued_lines();
        assert_eq!(text.word(), Some(&b"a"[..]));
        assert_eq!(text.word(), Some(&b"b"[..]));
        assert_eq!((text.word(), text.line()), (Some(&b"c"[..]), 2));
        assert_eq!(text.word(), None);
        assert!(text.next_line());
        assert_eq!((text.word(), text.line()), (Some(&b"e"[..]), 3));
        assert!(!text.next_line());
    }

    #[test]
    fn lines_end_in_any_of_three_ways() {
        for end in ["\n", "\r", "\r\n"] {
            let source = ["a # c", "b \\", "c", "", "d", ""].join(end);
            let mut text = Text::new(source.as_bytes()).with_comments().with_continued_lines();
            let mut words = Vec::new();
            while let Some(word) = text.word_across_lines() {
                words.push((text.line(), word));
            }
            assert_eq!(words, [(1, &b"a"[..]), (2, b"b"), (3, b"c"), (5, b"d")], "{end:?}");
            assert_eq!(text.line(), 5);
        }
    }

    #[test]
    fn a_final_newline_begins_no_line() {
        let mut text = Text::new(b"a\n");
        assert_eq!(text.word_across_lines(), Some(&b"a"[..]));
        assert_eq!(text.word_across_lines(), None);
        assert_eq!(text.line(), 1);
    }

    #[test]
    fn integers_too_long_are_no_integers() {
        assert_eq!(integer(b"-12"), Some(-12));
        assert_eq!(integer(b"99999999999999999999"), None);
        assert_eq!(integer(b"-"), None);
        assert_eq!(integer(b"1.0"), None);
    }
}
