//! Rows of numbers in text, which may run over several lines.
//!
//! Some writers break long lines. So a row that is not complete at the end of
//! its line goes on in the next one; but then it has to end where a line ends,
//! for a word that is left over shows that the first line was too short. The
//! line that is too short is the one an error names.

use super::error::{Fault, Read};
use super::text::Text;

/// The row at hand.
#[derive(Default)]
pub(super) struct Row {
    /// What is wrong if this row does not go on in the next line: set once it
    /// does.
    short: Option<Fault>,
}

impl Row {
    /// The next word as a finite number.
    pub(super) fn number(&mut self, text: &mut Text<'_>, what: &str) -> Read<f64> {
        let word = self.word(text, what)?;
        text.number_in(word, what).map_err(|fault| self.blame(fault))
    }

    /// The next word as a number that counts or names things.
    pub(super) fn natural(&mut self, text: &mut Text<'_>, what: &str) -> Read<u64> {
        let word = self.word(text, what)?;
        text.natural_in(word, what).map_err(|fault| self.blame(fault))
    }

    /// The next word, whatever it is.
    pub(super) fn word<'a>(&mut self, text: &mut Text<'a>, what: &str) -> Read<&'a [u8]> {
        match text.word() {
            Some(word) => Ok(word),
            None => self.word_of_next_line(text, what),
        }
    }

    #[cold]
    fn word_of_next_line<'a>(&mut self, text: &mut Text<'a>, what: &str) -> Read<&'a [u8]> {
        let fault = text.line_ends(what);
        if !text.next_full_line() {
            return Err(self.blame(fault));
        }
        self.short.get_or_insert(fault);
        Ok(text.word().unwrap_or_default())
    }

    /// Whether all of the row stood in one line.
    pub(super) fn is_one_line(&self) -> bool {
        self.short.is_none()
    }

    /// The row is complete: of one that ran over several lines no word may be
    /// left.
    pub(super) fn end(&mut self, text: &Text<'_>) -> Read<()> {
        match self.short.take() {
            Some(fault) if text.has_word() => Err(fault),
            _ => Ok(()),
        }
    }

    /// The fault of the first line that was too short, if there is one.
    pub(super) fn blame(&mut self, fault: Fault) -> Fault {
        self.short.take().unwrap_or(fault)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Three numbers of a row, or what is wrong.
    fn three(source: &str) -> Result<Vec<f64>, String> {
        let mut text = Text::new(source.as_bytes());
        let mut row = Row::default();
        let mut read = || {
            let numbers: Vec<f64> =
                (0..3).map(|_| row.number(&mut text, "a number")).collect::<Read<_>>()?;
            row.end(&text)?;
            Ok(numbers)
        };
        read().map_err(|fault: Fault| fault.named("file").to_string())
    }

    #[test]
    fn a_row_over_several_lines_ends_with_one_of_them() {
        assert_eq!(three("1 2 3 4\n"), Ok(vec![1.0, 2.0, 3.0]));
        assert_eq!(three("1\n\n2\n3\n4\n"), Ok(vec![1.0, 2.0, 3.0]));
        let short = |line| Err(format!("file:{line}: the line ends here, expected a number"));
        assert_eq!(three("1 2\n3 4\n"), short(1));
        assert_eq!(three("1\n2\nx\n"), short(1));
        assert_eq!(three("1 2\n"), short(1));
        assert_eq!(three("1 x\n"), Err("file:1: 'x' is no number, expected a number".to_owned()));
    }
}
