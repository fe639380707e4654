//! What is passed over, to be told once for each kind.

use std::collections::BTreeMap;

/// Kinds of things that are passed over.
#[derive(Debug, Default)]
pub(super) struct Told {
    kinds: BTreeMap<(String, &'static str), Kind>,
}

#[derive(Debug)]
struct Kind {
    count: usize,
    first_line: usize,
}

impl Told {
    /// One more thing, by the name of its kind and what it is.
    pub(super) fn add(&mut self, name: &str, what: &'static str, line: usize) {
        let kind = self.kinds.entry((name.to_owned(), what));
        let kind = kind.or_insert(Kind { count: 0, first_line: line });
        kind.count += 1;
        kind.first_line = kind.first_line.min(line);
    }

    /// A sentence for each kind.
    pub(super) fn sentences(self) -> Vec<String> {
        let sentence = self.kinds.into_iter().map(|((name, what), kind)| {
            let Kind { count, first_line } = kind;
            let place = match count {
                1 => format!("line {first_line}"),
                _ => format!("{count}, the first in line {first_line}"),
            };
            format!("passed over: {name}, {what} ({place})")
        });
        sentence.collect()
    }
}
