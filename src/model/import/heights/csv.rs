//! Tables of heights (RFC 4180): a row to a line, separated by semicolons,
//! tabs, commas or white space, the first of these with which the first row
//! is one of numbers. Blanks around fields do not matter.
//!
//! A field that is empty or says `nan` or `na` is a missing height. What
//! follows `#` is a comment. Numbers have a decimal point and may be quoted.
//! Rows of names above the numbers and columns of names or places beside
//! them are told apart from heights in [`layout`](super::layout).

use super::super::error::{Fault, Read, quote};
use super::super::text::Text;
use super::ImportedHeights;
use super::layout::{Layout, Row};
use crate::model::surface::Heights;

/// Reads a table.
pub(super) fn read(bytes: &[u8]) -> Read<ImportedHeights> {
    let rows = rows(bytes);
    let Some(separator) = Separator::of_table(&rows) else {
        return Err(Fault::line(1, "the file has no rows, expected heights"));
    };
    let layout = Layout::of(&rows, |row| separator.fields(row.text))?;
    let body = &rows[layout.header..];
    let first = body[0].line;
    let mut values = Vec::new();
    let mut columns = None;
    for row in body {
        let text = Text::new(&[]);
        let before = values.len();
        let mut skipped = usize::from(layout.has_index);
        separator.each_field(row.text, |field| {
            if skipped > 0 {
                skipped -= 1;
                return Ok(());
            }
            values.push(height(&text, field).map_err(|fault| fault.in_line(row.line))?);
            Ok(())
        })?;
        if layout.ends_in_separator {
            values.pop();
        }
        let found = values.len() - before;
        match *columns.get_or_insert(found) {
            expected if expected != found => {
                return Err(Fault::line(
                    row.line,
                    format!("a row of {found} heights, expected {expected} as in line {first}"),
                ));
            }
            _ => {}
        }
    }
    let columns = columns.unwrap_or_default();
    let (xs, zs) = layout.places(columns, body.len());
    let has_places = layout.has_places();
    let heights = Heights::new(xs, zs, values).map_err(|error| Fault::file(error.to_string()))?;
    Ok(ImportedHeights { heights, warnings: layout.told(), has_places })
}

/// All lines that are no comments. Tabs at their ends are kept: they may part
/// empty fields.
fn rows(bytes: &[u8]) -> Vec<Row<'_>> {
    let mut rest = bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes);
    let mut rows = Vec::new();
    let mut number = 1;
    while !rest.is_empty() {
        // A line ends in LF, CR, or CR and LF.
        let end = rest.iter().position(|byte| matches!(byte, b'\n' | b'\r')).unwrap_or(rest.len());
        let after = if rest[end..].starts_with(b"\r\n") { end + 2 } else { end + 1 };
        let line = rest[..end].split(|&byte| byte == b'#').next().unwrap_or_default();
        if !line.trim_ascii().is_empty() {
            rows.push(Row { line: number, text: line });
        }
        rest = rest.get(after..).unwrap_or_default();
        number += 1;
    }
    rows
}

/// What stands between fields.
#[derive(Debug, Clone, Copy)]
pub(super) enum Separator {
    Byte(u8),
    Space,
}

impl Separator {
    /// That of the first row that begins like numbers, else of the first.
    fn of_table(rows: &[Row<'_>]) -> Option<Self> {
        let begins_like_numbers = |row: &&Row<'_>| {
            let first = row.text.trim_ascii().first();
            first.is_some_and(|byte| !byte.is_ascii_alphabetic() && *byte != b'"')
        };
        let row = rows.iter().find(begins_like_numbers).or(rows.first())?;
        let present = [b';', b'\t', b','].map(Separator::Byte).into_iter();
        let mut present = present.filter(|separator| separator.is_in(row.text)).peekable();
        let first = present.peek().copied().unwrap_or(Separator::Space);
        let fits = |separator: &Separator| {
            separator
                .fields(row.text)
                .iter()
                .all(|field| is_missing(field) || number(field).is_some())
        };
        Some(present.find(fits).unwrap_or(first))
    }

    /// Whether it is in a line, but for blanks around.
    fn is_in(self, line: &[u8]) -> bool {
        matches!(self, Separator::Byte(byte) if line.trim_ascii().contains(&byte))
    }

    /// The fields of a line, without blanks and quotes around them.
    fn fields(self, line: &[u8]) -> Vec<&[u8]> {
        let mut fields = Vec::new();
        let _ = self.each_field(line, |field| {
            fields.push(field);
            Ok(())
        });
        fields
    }

    fn each_field<'l>(
        self,
        line: &'l [u8],
        mut take: impl FnMut(&'l [u8]) -> Read<()>,
    ) -> Read<()> {
        let is_end = |byte: &u8| match self {
            Separator::Byte(separator) => *byte == separator,
            Separator::Space => byte.is_ascii_whitespace(),
        };
        let mut rest = if matches!(self, Separator::Space) { line.trim_ascii() } else { line };
        loop {
            let is_blank = |byte: &u8| byte.is_ascii_whitespace() && !is_end(byte);
            let blanks = rest.iter().take_while(|byte| is_blank(byte)).count();
            rest = &rest[blanks..];
            // Separators within quotes part nothing.
            let quoted = match rest.first() {
                Some(b'"') => rest[1..].iter().position(|&byte| byte == b'"').map(|end| end + 2),
                _ => None,
            };
            let start = quoted.unwrap_or(0);
            let end = rest[start..].iter().position(is_end).map(|end| start + end);
            take(unquoted(rest[..end.unwrap_or(rest.len())].trim_ascii_end()))?;
            let Some(end) = end else { return Ok(()) };
            rest = &rest[end + 1..];
            if matches!(self, Separator::Space) {
                rest = rest.trim_ascii_start();
            }
        }
    }
}

fn unquoted(field: &[u8]) -> &[u8] {
    match field {
        [b'"', inner @ .., b'"'] => inner.trim_ascii(),
        field => field,
    }
}

/// Whether a field says that there is no height.
pub(super) fn is_missing(field: &[u8]) -> bool {
    field.is_empty() || field.eq_ignore_ascii_case(b"nan") || field.eq_ignore_ascii_case(b"na")
}

/// A field's number, if it is one.
pub(super) fn number(field: &[u8]) -> Option<f64> {
    let number = std::str::from_utf8(field).ok()?.parse::<f64>().ok()?;
    number.is_finite().then_some(number)
}

/// A field's height.
fn height(text: &Text<'_>, field: &[u8]) -> Read<f64> {
    if is_missing(field) {
        return Ok(f64::NAN);
    }
    if field.starts_with(b"\"") {
        let message = format!("{} is not closed, expected another \"", quote(field));
        return Err(text.fault(message));
    }
    text.number_in(field, "a height")
}

#[cfg(test)]
mod tests {
    use super::*;

    fn values(text: &str) -> (usize, Vec<String>) {
        let heights = read(text.as_bytes()).unwrap().heights;
        let values = heights.values().iter().map(f64::to_string).collect();
        (heights.xs().len(), values)
    }

    #[test]
    fn four_separators_and_missing_heights() {
        let expected = (3, ["1", "-2.5", "NaN", "4", "NaN", "600"].map(str::to_owned).to_vec());
        for table in [
            "1,-2.5,nan\n4,,6e2\n",
            "# heights\n\n1;-2.5;\r\n4; NA ;600",
            "1\t-2.5\tNaN\n4\t\t600\n",
            "1\t-2.5\t\r4\t\t600\r",
            "  1   -2.5 nan # first\n4 na  600\n",
            "1 , -2.5 , nan\n4,\t,  600\n",
            "1,\t-2.5,\tnan\n4,\tnan,\t600\n",
            "\"1\",\"-2.5\",\"\"\n4,,\"600\"\n",
        ] {
            assert_eq!(values(table), expected, "{table:?}");
        }
    }

    #[test]
    fn a_separator_at_the_end_of_every_row_parts_nothing() {
        assert_eq!(values("1,2,\n3,4,\n").0, 2);
        assert_eq!(values("1,2,\n3,4,5\n").0, 3);
    }
}
