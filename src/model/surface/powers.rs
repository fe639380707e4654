//! Powers in brackets, so that they bind as mathematicians write them, and
//! numbers without exponents, which the parser does not know.
//!
//! The parser of expressions lets a sign bind closer than a power, so that
//! `-x^2` would be (-x)^2, and takes powers from the left. Brackets around each
//! power leave nothing to be taken otherwise:
//!
//! ```text
//!   -x^2        ->  -(x^(2))
//!   a^b^c       ->  (a^((b^(c))))
//!   2*-(x+1)^n  ->  2*-((x+1)^(n))
//! ```
//!
//! What is no sound expression is passed on as it is, for the parser to say
//! what is wrong with it.

/// The expression with brackets around its powers. O(n).
pub(super) fn bind_powers(text: &str) -> String {
    let mut scan = Scan { rest: text, depth: 0 };
    let mut bound = scan.terms();
    // A bracket that closes nothing, or too many of them.
    bound.push_str(scan.rest);
    bound
}

/// Brackets and powers within one another beyond this are left as they are.
const DEEPEST: u32 = 200;

struct Scan<'t> {
    rest: &'t str,
    depth: u32,
}

impl<'t> Scan<'t> {
    /// Everything up to a closing bracket or the end.
    fn terms(&mut self) -> String {
        let mut found = String::new();
        while let Some(next) = self.rest.chars().next() {
            match next {
                ')' => break,
                _ if is_operator(next) => found.push_str(self.take(next.len_utf8())),
                _ if self.depth >= DEEPEST => found.push_str(self.take(self.rest.len())),
                _ => found.push_str(&self.power()),
            }
        }
        found
    }

    /// An operand, and what it is raised to.
    fn power(&mut self) -> String {
        self.depth += 1;
        let base = self.operand();
        let blank = self.rest.len() - self.rest.trim_start().len();
        let power = match self.rest[blank..].strip_prefix('^') {
            Some(_) if !base.is_empty() => {
                self.take(blank + 1);
                let mut exponent = String::new();
                // Signs and blanks before it.
                while let Some(next) = self.rest.chars().next().filter(|c| is_sign(*c)) {
                    exponent.push_str(self.take(next.len_utf8()));
                }
                if self.rest.starts_with(|c| c == ')' || is_operator(c)) || self.rest.is_empty() {
                    format!("{base}^{exponent}")
                } else {
                    exponent.push_str(&self.power());
                    format!("({base}^({exponent}))")
                }
            }
            _ => base,
        };
        self.depth -= 1;
        power
    }

    /// A number, a name, a name with its bracket, or a bracket.
    fn operand(&mut self) -> String {
        let mut found = plain(self.take(self.word()));
        if self.rest.starts_with('(') {
            found.push_str(self.take(1));
            found.push_str(&self.terms());
            if self.rest.starts_with(')') {
                found.push_str(self.take(1));
            }
        }
        if found.is_empty() {
            // Nothing that is known: one character further.
            let next = self.rest.chars().next().map_or(0, char::len_utf8);
            found.push_str(self.take(next));
        }
        found
    }

    /// The bytes of the number or name that stands next.
    fn word(&self) -> usize {
        let mut before = ' ';
        let number = self.rest.starts_with(|c: char| c.is_ascii_digit() || c == '.');
        let ends = |c: char| {
            // The sign of an exponent belongs to its number.
            let exponent = number && matches!(before, 'e' | 'E') && matches!(c, '+' | '-');
            before = c;
            !(c.is_alphanumeric() || c == '_' || c == '.' || exponent)
        };
        self.rest.find(ends).unwrap_or(self.rest.len())
    }

    fn take(&mut self, bytes: usize) -> &'t str {
        let (taken, rest) = self.rest.split_at(bytes);
        self.rest = rest;
        taken
    }
}

/// A number without its exponent, the same double; other words as they are.
fn plain(word: &str) -> String {
    let number = word.starts_with(|c: char| c.is_ascii_digit() || c == '.');
    match word.parse::<f64>() {
        Ok(value) if number && value.is_finite() && word.contains(['e', 'E']) => value.to_string(),
        _ => word.to_owned(),
    }
}

fn is_operator(c: char) -> bool {
    c.is_whitespace() || matches!(c, '+' | '-' | '*' | '/' | '^' | ',' | '%')
}

fn is_sign(c: char) -> bool {
    c.is_whitespace() || matches!(c, '+' | '-')
}

#[cfg(test)]
mod tests {
    use super::bind_powers;

    #[test]
    fn powers_get_brackets_and_nothing_else_does() {
        for (text, bound) in [
            ("sin(x)*cos(z)", "sin(x)*cos(z)"),
            ("-x^2", "-(x^(2))"),
            ("a^b^c", "(a^((b^(c))))"),
            ("2*-(x+1)^n", "2*-((x+1)^(n))"),
            ("exp(-(x^2+z^2)/8)", "exp(-((x^(2))+(z^(2)))/8)"),
            ("sin(x ^ 2) ^ -1.5e-3", "(sin((x^( 2)))^( -0.0015))"),
            ("1e3-2-x2e5", "1000-2-x2e5"),
        ] {
            assert_eq!(bind_powers(text), bound);
        }
    }

    #[test]
    fn what_is_broken_stays_broken() {
        for text in ["", "(", ")", "x^", "^2", "sin(x", "x)^2", "x^)", "{}", "ü!§^"] {
            let bound = bind_powers(text);
            let plain = |text: &str| text.replace(['(', ')'], "");
            assert_eq!(plain(&bound), plain(text));
            let balance =
                |text: &str| text.matches('(').count() as i32 - text.matches(')').count() as i32;
            assert_eq!(balance(&bound), balance(text), "{text}");
        }
        let deep = "(".repeat(100_000);
        assert_eq!(bind_powers(&deep), deep);
    }
}
