//! Where in a JSON text a value stands.
//!
//! A parser into Rust types forgets positions. When such a value turns out
//! to be wrong (a vertex number out of range, say), the text is scanned again
//! for the place to name.

use super::json_scan::Scan;

/// One step down into a JSON value.
#[derive(Debug, Clone, Copy)]
pub(super) enum Step<'a> {
    /// The value of a key of an object.
    Key(&'a str),
    /// An item of an array.
    Item(usize),
}

/// The offset of the value that `path` leads to, or of the last value on the
/// way that exists. O(length of the text).
pub(super) fn place_of(json: &[u8], path: &[Step<'_>]) -> usize {
    let mut scan = Scan { json, at: 0 };
    scan.skip_blanks();
    let mut place = scan.at;
    for step in path {
        let found = match step {
            Step::Key(key) => enter_key(&mut scan, key),
            Step::Item(item) => enter_item(&mut scan, *item),
        };
        if found.is_none() {
            break;
        }
        place = scan.at;
    }
    place
}

/// The line of the byte at `offset`, counted from 1. A line ends in LF, CR or
/// both.
pub(super) fn line_of(json: &[u8], offset: usize) -> u64 {
    let before = &json[..offset.min(json.len())];
    let ends_at = |place: &usize| match before[*place] {
        b'\r' => true,
        b'\n' => *place == 0 || before[place - 1] != b'\r',
        _ => false,
    };
    1 + (0..before.len()).filter(ends_at).count() as u64
}

/// The offset of a place that serde_json gives as line and column: it counts
/// LFs alone, and columns from 1.
pub(super) fn offset_of(json: &[u8], line: usize, column: usize) -> usize {
    let lines = json.split_inclusive(|&byte| byte == b'\n');
    let before: usize = lines.take(line.saturating_sub(1)).map(<[u8]>::len).sum();
    (before + column.saturating_sub(1)).min(json.len())
}

fn enter_key(scan: &mut Scan<'_>, wanted: &str) -> Option<()> {
    scan.open(b'{')?;
    while scan.key()? != wanted.as_bytes() {
        scan.skip_value()?;
        scan.comma()?;
    }
    Some(())
}

fn enter_item(scan: &mut Scan<'_>, wanted: usize) -> Option<()> {
    scan.open(b'[')?;
    for _ in 0..wanted {
        scan.skip_value()?;
        scan.comma()?;
    }
    scan.skip_blanks();
    scan.json.get(scan.at).is_some_and(|&byte| byte != b']').then_some(())
}

#[cfg(test)]
mod tests {
    use super::*;

    const TEXT: &[u8] = b"{\"a\\\"b\": [1, {\"}\": []}, -2e3 ],\n \"c\": {\"d\":\n [[], 7]}}";

    fn rest(path: &[Step<'_>]) -> &'static str {
        std::str::from_utf8(&TEXT[place_of(TEXT, path)..]).expect("ASCII")
    }

    #[test]
    fn paths_lead_past_strings_and_nesting() {
        assert!(rest(&[Step::Key("c"), Step::Key("d"), Step::Item(1)]).starts_with("7]"));
        assert!(rest(&[Step::Key("a\\\"b"), Step::Item(2)]).starts_with("-2e3"));
        assert_eq!(line_of(TEXT, place_of(TEXT, &[Step::Key("c"), Step::Key("d")])), 3);
    }

    #[test]
    fn what_does_not_exist_is_placed_at_its_container() {
        assert!(rest(&[Step::Key("c"), Step::Key("x")]).starts_with("{\"d\""));
        assert!(rest(&[Step::Key("c"), Step::Key("d"), Step::Item(9)]).starts_with("[[]"));
    }
}
