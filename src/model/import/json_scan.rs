//! A scanner over JSON text that builds nothing.
//!
//! It finds its way through text that may not be JSON at all: it checks only
//! what it steps on and gives up (`None`) at the first surprise. It keeps no
//! stack: nesting is a counter, so depth costs nothing.

/// The keys of the outermost object, as they are written, until something is
/// no JSON.
pub(super) fn keys(json: &[u8]) -> impl Iterator<Item = &[u8]> {
    let mut scan = Scan { json, at: 0 };
    let mut more = scan.open(b'{').is_some();
    std::iter::from_fn(move || {
        let key = if more { scan.key() } else { None }?;
        more = scan.skip_value().is_some() && scan.comma().is_some();
        Some(key)
    })
}

/// A position in JSON text.
pub(super) struct Scan<'a> {
    pub(super) json: &'a [u8],
    pub(super) at: usize,
}

impl<'a> Scan<'a> {
    /// An opening bracket.
    pub(super) fn open(&mut self, bracket: u8) -> Option<()> {
        self.skip_blanks();
        self.expect(bracket)
    }

    /// A comma between items.
    pub(super) fn comma(&mut self) -> Option<()> {
        self.skip_blanks();
        self.expect(b',')
    }

    /// A key and its colon; leaves the cursor at the value.
    pub(super) fn key(&mut self) -> Option<&'a [u8]> {
        self.skip_blanks();
        let start = self.at + 1;
        self.skip_string()?;
        let key = &self.json[start..self.at - 1];
        self.skip_blanks();
        self.expect(b':')?;
        self.skip_blanks();
        Some(key)
    }

    /// Leaves the cursor behind the value.
    pub(super) fn skip_value(&mut self) -> Option<()> {
        self.skip_blanks();
        let mut depth = 0_usize;
        loop {
            match self.json.get(self.at)? {
                b'"' => self.skip_string()?,
                b'[' | b'{' => {
                    depth += 1;
                    self.at += 1;
                }
                b']' | b'}' if depth == 0 => return Some(()),
                b']' | b'}' => {
                    depth -= 1;
                    self.at += 1;
                }
                b',' if depth == 0 => return Some(()),
                _ => self.at += 1,
            }
            let scalar_goes_on = self
                .json
                .get(self.at)
                .is_some_and(|byte| !byte.is_ascii_whitespace() && !b",]}".contains(byte));
            if depth == 0 && !scalar_goes_on {
                return Some(());
            }
        }
    }

    fn skip_string(&mut self) -> Option<()> {
        self.expect(b'"')?;
        loop {
            match self.json.get(self.at)? {
                b'"' => break,
                b'\\' => self.at += 2,
                _ => self.at += 1,
            }
        }
        self.at += 1;
        Some(())
    }

    /// Leaves the cursor at the next visible byte.
    pub(super) fn skip_blanks(&mut self) {
        while self.json.get(self.at).is_some_and(u8::is_ascii_whitespace) {
            self.at += 1;
        }
    }

    fn expect(&mut self, byte: u8) -> Option<()> {
        let found = self.json.get(self.at) == Some(&byte);
        self.at += usize::from(found);
        found.then_some(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn keys_of_the_outermost_object_only() {
        let text = b"{\"a\\\"b\": [1, {\"}\": []}, -2e3 ],\n \"c\": {\"d\":\n [[], 7]}}";
        let found: Vec<_> = keys(text).collect();
        assert_eq!(found, [&b"a\\\"b"[..], b"c"]);
    }

    #[test]
    fn text_that_ends_within_a_key_has_no_such_key() {
        assert_eq!(keys(b"{\"a\": 1, \"b\\").count(), 1);
        assert_eq!(keys(b"{\"a\": [[[[").count(), 1);
    }
}
