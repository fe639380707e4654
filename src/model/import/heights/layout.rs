//! What of a table is heights, and what names and places beside them.
//!
//! Rows above the first row of numbers are names. The first column is one of
//! names or places where
//!
//! - it begins with a name in every row,
//! - the row above it has one field less and its numbers only count, as R
//!   writes tables,
//! - the field above it is empty, as pandas does, or
//! - the fields right of that are numbers: places of the columns.
//!
//! Numbers that are names are places if they grow, and of rows also if they
//! fall, as latitudes do from north to south; z is negative then, for north
//! is far. Numbers that only count, from 0 or from 1, are no places.

use super::super::error::{Fault, Read, quote};
use super::csv::{is_missing, number};

/// A line of a table.
#[derive(Debug, Clone, Copy)]
pub(super) struct Row<'a> {
    /// Its number in the file.
    pub(super) line: u64,
    pub(super) text: &'a [u8],
}

/// Where in a table the heights are.
#[derive(Debug, Default)]
pub(super) struct Layout {
    /// How many rows are names.
    pub(super) header: usize,
    /// Whether the first column is no heights.
    pub(super) has_index: bool,
    /// Whether every row ends in a separator.
    pub(super) ends_in_separator: bool,
    xs: Option<Vec<f64>>,
    zs: Option<Vec<f64>>,
    told: Vec<String>,
}

/// How a field begins a row.
fn is_name(field: &[u8]) -> bool {
    let like_number = |byte: &u8| byte.is_ascii_digit() || matches!(byte, b'+' | b'-' | b'.');
    !is_missing(field) && number(field).is_none() && !field.first().is_some_and(like_number)
}

impl Layout {
    /// Looks at a table. O(n).
    pub(super) fn of<'a>(
        rows: &[Row<'a>],
        fields: impl Fn(&Row<'a>) -> Vec<&'a [u8]>,
    ) -> Read<Self> {
        let begins_with_name = |row: &Row<'a>| fields(row).first().is_some_and(|f| is_name(f));
        let is_body = |(index, row): (usize, &Row<'a>)| {
            let all = fields(row);
            let rest_is_heights =
                all[1..].iter().all(|field| is_missing(field) || number(field).is_some());
            match is_name(all[0]) {
                // A name before heights, if the next row has one too.
                true => {
                    all.len() > 1
                        && rest_is_heights
                        && rows.get(index + 1).is_none_or(begins_with_name)
                }
                // Names of columns, with nothing above the names of rows.
                false => {
                    !(all[0].is_empty() && all.len() > 1 && all[1..].iter().all(|f| is_name(f)))
                }
            }
        };
        // Without any row of numbers the first row is to blame.
        let Some(header) = rows.iter().enumerate().position(is_body) else {
            let first = fields(&rows[0])[0];
            let message = format!("{} is no number, expected a height", quote(first));
            return Err(Fault::line(rows[0].line, message));
        };
        let mut layout = Layout { header, ..Layout::default() };
        let body = &rows[header..];
        let first = fields(&body[0]);
        let names = rows[..header].last().map(&fields).unwrap_or_default();
        if let ([x, y, _], 3) = (&*names, first.len())
            && is_list_of_points(x, y)
        {
            let message = "a list of points, expected a grid: a row of heights to a line";
            return Err(Fault::line(rows[header - 1].line, message));
        }
        layout.ends_in_separator = first.len() > 2
            && body.iter().all(|row| fields(row).last().is_some_and(|f| f.is_empty()));
        let places =
            names.get(1..).filter(|places| !places.is_empty() && numbers(places).is_some());
        let index = || body.iter().map(|row| fields(row)[0]).collect::<Vec<_>>();
        let only_counts = |fields: &[&[u8]]| numbers(fields).is_some_and(|list| counts(&list));
        layout.has_index = first.len() > 1
            && (is_name(first[0])
                || (names.len() == first.len() && (names[0].is_empty() || places.is_some()))
                || (names.len() > 1 && names.len() + 1 == first.len() && only_counts(&index())));
        // Counters all around, without a name above them.
        if header == 0 && !layout.has_index && counts_all_around(body, &fields) {
            (layout.header, layout.has_index) = (1, true);
            layout.told.push("passed over: the first row and the first column, which count".into());
            return Ok(layout);
        }
        if layout.has_index {
            let columns = if names.len() == first.len() { &names[1..] } else { &names[..] };
            layout.xs = grown(columns, false);
            layout.zs = grown(&index(), true);
        }
        let used = usize::from(layout.xs.is_some());
        layout.tell_header(&rows[..header - used]);
        layout.tell_index();
        Ok(layout)
    }

    /// Places of columns and rows: those of the table, else their numbers.
    pub(super) fn places(&self, columns: usize, rows: usize) -> (Vec<f64>, Vec<f64>) {
        let steps = |count: usize| (0..count).map(|i| i as f64).collect();
        let own = |places: &Option<Vec<f64>>, count| {
            places.clone().filter(|places| places.len() == count).unwrap_or_else(|| steps(count))
        };
        (own(&self.xs, columns), own(&self.zs, rows))
    }

    /// Whether the table says where its heights are.
    pub(super) fn has_places(&self) -> bool {
        self.xs.is_some() && self.zs.is_some()
    }

    /// What is passed over or taken for places.
    pub(super) fn told(self) -> Vec<String> {
        self.told
    }

    fn tell_header(&mut self, header: &[Row<'_>]) {
        if let (Some(first), Some(last)) = (header.first(), header.last()) {
            self.told.push(match header.len() {
                1 => format!("passed over: a row of names (line {})", first.line),
                _ => format!("passed over: rows of names (lines {} to {})", first.line, last.line),
            });
        }
    }

    fn tell_index(&mut self) {
        let say = |places: &Option<Vec<f64>>| places.as_ref().map(|p| (p[0], p[p.len() - 1]));
        if let Some((from, to)) = say(&self.xs) {
            self.told.push(format!("the names of columns are their x, {from} to {to}"));
        }
        if let Some((from, to)) = say(&self.zs) {
            self.told.push(format!("the first column is z, {from} to {to}"));
        } else if self.has_index {
            self.told.push("passed over: the first column, of names".to_owned());
        }
    }
}

/// Numbers that grow and do more than count; their negatives where they fall,
/// if that is wished.
fn grown(fields: &[&[u8]], may_fall: bool) -> Option<Vec<f64>> {
    let numbers = numbers(fields)?;
    let grow = |numbers: &[f64]| numbers.len() > 1 && numbers.windows(2).all(|p| p[0] < p[1]);
    if counts(&numbers) {
        return None;
    }
    let fallen: Vec<f64> = numbers.iter().map(|number| 0.0 - number).collect();
    match (grow(&numbers), may_fall && grow(&fallen)) {
        (true, _) => Some(numbers),
        (_, true) => Some(fallen),
        _ => None,
    }
}

fn numbers(fields: &[&[u8]]) -> Option<Vec<f64>> {
    fields.iter().map(|field| number(field)).collect()
}

/// Whether numbers are 0, 1, 2 or 1, 2, 3 and so on.
fn counts(numbers: &[f64]) -> bool {
    let from = |first: f64| numbers.iter().enumerate().all(|(i, n)| *n == first + i as f64);
    from(0.0) || from(1.0)
}

/// Whether nothing is at the corner of a table and the first row and the
/// first column only count.
fn counts_all_around<'a>(body: &[Row<'a>], fields: impl Fn(&Row<'a>) -> Vec<&'a [u8]>) -> bool {
    let first = fields(&body[0]);
    let beside = || body[1..].iter().map(|row| fields(row)[0]).collect::<Vec<_>>();
    first[0].is_empty()
        && first.len() > 2
        && body.len() > 2
        && numbers(&first[1..]).is_some_and(|above| counts(&above))
        && numbers(&beside()).is_some_and(|beside| counts(&beside))
}

/// Whether columns of these names are places of points.
fn is_list_of_points(first: &[u8], second: &[u8]) -> bool {
    const PAIRS: [[&str; 2]; 7] = [
        ["x", "y"],
        ["x", "z"],
        ["lon", "lat"],
        ["lat", "lon"],
        ["longitude", "latitude"],
        ["latitude", "longitude"],
        ["easting", "northing"],
    ];
    let is = |field: &[u8], name: &str| field.eq_ignore_ascii_case(name.as_bytes());
    PAIRS.iter().any(|[one, other]| is(first, one) && is(second, other))
}

#[cfg(test)]
mod tests {
    use super::super::csv::read;

    fn table(text: &str) -> (Vec<f64>, Vec<f64>, Vec<f64>, Vec<String>) {
        let found = read(text.as_bytes()).unwrap();
        let heights = found.heights;
        (heights.xs().to_vec(), heights.zs().to_vec(), heights.values().to_vec(), found.warnings)
    }

    const HEIGHTS: [f64; 4] = [5.0, 6.0, 7.0, 8.0];

    #[test]
    fn rows_and_columns_of_names_are_no_heights() {
        for (text, told) in [
            ("a,b\n5,6\n7,8\n", vec!["passed over: a row of names (line 1)"]),
            (
                "Heights of 1990\n\n\"col 1\";col 2\n5;6\n7;8",
                vec!["passed over: rows of names (lines 1 to 3)"],
            ),
            (
                ",a,b\nr,5,6\ns,7,8\n",
                vec![
                    "passed over: a row of names (line 1)",
                    "passed over: the first column, of names",
                ],
            ),
            (
                ",a,b\n0,5,6\n1,7,8\n",
                vec![
                    "passed over: a row of names (line 1)",
                    "passed over: the first column, of names",
                ],
            ),
            (
                "a b\n\"1\" 5 6\n\"2\" 7 8\n",
                vec![
                    "passed over: a row of names (line 1)",
                    "passed over: the first column, of names",
                ],
            ),
            ("r 5 6\ns 7 8\n", vec!["passed over: the first column, of names"]),
            (
                ",0,1\n0,5,6\n1,7,8\n",
                vec!["passed over: the first row and the first column, which count"],
            ),
            (
                "y,1,2\n1,5,6\n2,7,8\n",
                vec![
                    "passed over: a row of names (line 1)",
                    "passed over: the first column, of names",
                ],
            ),
        ] {
            let (xs, zs, values, found) = table(text);
            assert_eq!(values, HEIGHTS, "{text:?}");
            assert_eq!(found, told, "{text:?}");
            assert_eq!((xs, zs), (vec![0.0, 1.0], vec![0.0, 1.0]), "{text:?}");
        }
    }

    #[test]
    fn names_that_are_numbers_are_places() {
        let (xs, zs, values, told) = table("lat,7.5,7.75\n47.5,5,6\n47.25,7,8\n");
        assert_eq!((values, xs, zs), (HEIGHTS.to_vec(), vec![7.5, 7.75], vec![-47.5, -47.25]));
        assert_eq!(
            told,
            [
                "the names of columns are their x, 7.5 to 7.75",
                "the first column is z, -47.5 to -47.25"
            ]
        );
        let (xs, zs, ..) = table(",a,b\n0.5,5,6\n0.75,7,8\n");
        assert_eq!((xs, zs), (vec![0.0, 1.0], vec![0.5, 0.75]));
        // Neither grows nor falls.
        let (_, zs, ..) = table(",a,b\n3,5,6\n9,7,8\n4,0,0\n");
        assert_eq!(zs, [0.0, 1.0, 2.0]);
    }

    #[test]
    fn what_might_be_heights_is_heights() {
        // A missing height at the corner.
        let (_, _, values, told) = table(",5,6\n7,8,9\n");
        assert_eq!((values.len(), told.len()), (6, 0));
        assert!(values[0].is_nan());
        let error = |text: &str| read(text.as_bytes()).unwrap_err().named("t").to_string();
        assert_eq!(error("1,five\n2,3\n"), "t:1: 'five' is no number, expected a height");
        assert_eq!(error("a,b\n1,2\nc,3\n"), "t:3: 'c' is no number, expected a height");
        assert_eq!(error("a,b\nc,d\n"), "t:1: 'a' is no number, expected a height");
        assert_eq!(
            error("X,Y,h\n1,2,3\n4,5,6\n"),
            "t:1: a list of points, expected a grid: a row of heights to a line"
        );
    }
}
