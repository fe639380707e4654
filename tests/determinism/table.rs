//! The tables of hashes: what was kept, what is drawn now, and what does not
//! fit.

use super::Outcome;
use std::fmt::Write;
use std::path::{Path, PathBuf};

/// FNV-1a, 64 bits (Fowler, Noll and Vo): stable, and short enough to be
/// written out.
pub(crate) fn hash(bytes: &[u8]) -> u64 {
    bytes.iter().fold(0xcbf2_9ce4_8422_2325, |hash, &byte| {
        (hash ^ u64::from(byte)).wrapping_mul(0x0000_0100_0000_01b3)
    })
}

/// What is kept of one drawing.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) struct Row {
    title: String,
    pieces: usize,
    /// Hashes of the drawing and of its counters.
    hashes: [u64; 2],
}

impl Row {
    /// The row of a JSON drawing.
    pub(crate) fn of(title: String, pieces: usize, json: &[u8]) -> Outcome<Self> {
        const COUNTERS: &[u8] = b"\n\"counters\":";
        let begins = |place: &usize| json[*place..].starts_with(COUNTERS);
        let counters = (0..json.len()).rev().find(begins).ok_or("a drawing without counters")?;
        let (drawing, counters) = json.split_at(counters);
        Ok(Row { title, pieces, hashes: [hash(drawing), hash(counters)] })
    }

    fn text(&self) -> String {
        let Row { title, pieces, hashes: [drawing, counters] } = self;
        format!("{title} {pieces:>6} {drawing:016x} {counters:016x}")
    }
}

/// A table that is compared with what was kept of it, or written anew with
/// `UMRISS_BLESS=1`.
pub(crate) struct Table {
    file: PathBuf,
    kept: String,
    bless: bool,
    /// What one thread drew, which is drawn first.
    drawn: Vec<Row>,
    wrong: Vec<String>,
    unknown: usize,
}

impl Table {
    pub(crate) fn read(file: &Path) -> Outcome<Self> {
        let bless = std::env::var_os("UMRISS_BLESS").is_some_and(|value| value == "1");
        let kept = if bless { String::new() } else { std::fs::read_to_string(file)? };
        let (drawn, wrong) = (Vec::new(), Vec::new());
        Ok(Table { file: file.to_owned(), kept, bless, drawn, wrong, unknown: 0 })
    }

    /// Adds what one number of threads drew of a model.
    pub(crate) fn add(&mut self, threads: usize, rows: Vec<Row>) {
        for row in rows {
            match self.drawn.iter().find(|other| other.title == row.title) {
                Some(alone) if *alone != row => self.wrong.push(format!(
                    "{} by {threads} threads, but by one {}",
                    row.text(),
                    alone.text()
                )),
                Some(_) => {}
                None => {
                    self.compare(&row);
                    self.drawn.push(row);
                }
            }
        }
    }

    fn compare(&mut self, row: &Row) {
        let mut lines = self.kept.lines();
        match lines.find(|line| line.strip_prefix(&row.title).is_some_and(|s| s.starts_with(' '))) {
            Some(kept) if kept == row.text() => {}
            Some(kept) => self.wrong.push(format!("{}\n  was {kept}", row.text())),
            None => self.unknown += 1,
        }
    }

    /// Nothing is drawn that is not in the table, and nothing is in the table
    /// that is not drawn.
    pub(crate) fn expect_all_known(&self) {
        if !self.bless {
            assert_eq!(self.unknown, 0, "drawings that are not in the table");
            let kept = self.kept.lines().count();
            assert_eq!(kept, self.drawn.len(), "the table has lines for other drawings");
        }
    }

    /// What is drawn is what was kept; or keeps it.
    pub(crate) fn expect_as_kept(&self) -> Outcome<()> {
        let wrong = &self.wrong;
        assert!(wrong.is_empty(), "{} drawings differ:\n{}", wrong.len(), wrong.join("\n"));
        let mut text = String::new();
        for row in &self.drawn {
            writeln!(text, "{}", row.text())?;
        }
        if self.bless {
            std::fs::write(&self.file, text)?;
        } else {
            println!("{} drawings, {} of them not in the table", self.drawn.len(), self.unknown);
        }
        Ok(())
    }
}

#[test]
fn the_hash_is_that_of_its_inventors() {
    assert_eq!(hash(b""), 0xcbf2_9ce4_8422_2325);
    assert_eq!(hash(b"a"), 0xaf63_dc4c_8601_ec8c);
    assert_eq!(hash(b"foobar"), 0x8594_4171_f739_67e8);
}

#[test]
fn a_table_sees_other_drawings_other_counters_and_other_threads() -> Outcome<()> {
    let row = |line: &str, counter: &str| {
        let json = format!("{{\"lines\":[{line}],\n\"counters\":{{{counter}}}}}");
        Row::of("cube iso".to_owned(), 9, json.as_bytes())
    };
    let table = |kept: &Row| Table {
        file: PathBuf::new(),
        kept: kept.text(),
        bless: false,
        drawn: Vec::new(),
        wrong: Vec::new(),
        unknown: 0,
    };
    let own = row("1", "2")?;
    for (other, differing) in [(row("1", "2")?, 0), (row("3", "2")?, 1), (row("1", "3")?, 1)] {
        let mut kept = table(&own);
        kept.add(1, vec![other.clone()]);
        assert_eq!(kept.wrong.len(), differing, "kept");
        let mut threads = table(&own);
        threads.add(1, vec![own.clone()]);
        threads.add(8, vec![other]);
        assert_eq!(threads.wrong.len(), differing, "threads");
    }
    assert!(Row::of(String::new(), 0, b"{}").is_err());
    Ok(())
}
