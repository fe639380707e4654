//! What a JSON parser says, in the words of users.
//!
//! Its messages name types of Rust and of its own code. Here they name what
//! stands in the file and what was expected there; where that stands is told
//! beside them.

/// The message of an error of serde_json, without the position that it
/// appends. `whole` is what the text should have been: `"a drawing"`.
pub fn json_message(error: &impl ToString, whole: &str) -> String {
    let text = error.to_string();
    let message = text.rfind(" at line ").map_or(&*text, |end| &text[..end]);
    of_syntax(message).map(str::to_owned).unwrap_or_else(|| of_content(message, whole))
}

/// Text that is no JSON.
fn of_syntax(message: &str) -> Option<&'static str> {
    Some(match message {
        "EOF while parsing a list" => "the text ends within an array, expected a closing bracket",
        "EOF while parsing an object" => "the text ends within an object, expected a closing brace",
        "EOF while parsing a string" => "the text ends within a string, expected a closing quote",
        "EOF while parsing a value" => "the text ends here, expected a value",
        "expected value" | "expected ident" => "this is no JSON, expected a value",
        "expected `:`" => "this is no JSON, expected ':'",
        "expected `,` or `]`" => "this is no JSON, expected ',' or ']'",
        "expected `,` or `}`" => "this is no JSON, expected ',' or '}'",
        "expected `\"`" | "key must be a string" => "this is no JSON, expected a key in quotes",
        "invalid escape"
        | "lone leading surrogate in hex escape"
        | "unexpected end of hex escape" => "a wrong escape, expected one of those of JSON",
        "invalid number" => "a wrong number, expected decimal digits",
        "number out of range" => "the number is out of range, expected a smaller one",
        "invalid unicode code point" => "the text is damaged, expected UTF-8",
        "trailing comma" => "this is no JSON, expected another item after the comma",
        "trailing characters" => "something follows here, expected the end of the list or file",
        "recursion limit exceeded" => "brackets are nested too deep, expected 127 levels at most",
        _ if message.starts_with("control character") => {
            "a control character within a string, expected an escape"
        }
        _ => return None,
    })
}

/// JSON that is not what is expected of it.
fn of_content(message: &str, whole: &str) -> String {
    let named = |prefix: &str| message.strip_prefix(prefix)?.split('`').nth(1);
    if let Some(name) = named("missing field ") {
        return format!("the key '{name}' is missing, expected {whole}");
    }
    if let Some(name) = named("duplicate field ") {
        return format!("the key '{name}' stands here twice, expected it once");
    }
    let Some((found, expected)) = message.rsplit_once(", expected ") else {
        return format!("{message}, expected {whole}");
    };
    let expected = expectation(expected, whole);
    for prefix in ["invalid type: ", "invalid value: "] {
        if let Some(found) = found.strip_prefix(prefix) {
            return format!("{} stands here, expected {expected}", finding(found));
        }
    }
    if let Some(count) = found.strip_prefix("invalid length ") {
        return format!("{count} items stand here, expected {expected}");
    }
    for (prefix, what) in [("unknown field ", "key"), ("unknown variant ", "word")] {
        if let Some(name) = named(prefix) {
            return format!("the {what} '{name}' is not known, expected {expected}");
        }
    }
    format!("{found}, expected {expected}")
}

/// What stands there.
fn finding(found: &str) -> String {
    match found {
        "sequence" => "an array".to_owned(),
        "map" => "an object".to_owned(),
        "null" | "unit value" => "null".to_owned(),
        _ => {
            let kinds = ["integer ", "floating point ", "boolean ", "string ", "character "];
            let value = kinds.iter().find_map(|kind| found.strip_prefix(kind));
            let value = value.unwrap_or(found).trim_matches(['`', '"']);
            match value.char_indices().nth(40) {
                Some((end, _)) => format!("'{}...'", &value[..end]),
                None => format!("'{value}'"),
            }
        }
    }
}

/// What should stand there.
fn expectation(expected: &str, whole: &str) -> String {
    match expected {
        "u8" | "u16" | "u32" | "u64" | "usize" => "a natural number".to_owned(),
        "i32" | "i64" => "a whole number".to_owned(),
        "f32" | "f64" => "a number".to_owned(),
        "a sequence" => "an array".to_owned(),
        "a map" => "an object".to_owned(),
        "a boolean" => "true or false".to_owned(),
        "struct Root" => whole.to_owned(),
        _ if expected.starts_with("struct ") => "an object".to_owned(),
        _ => expected.replace("an array of length ", "an array of ").replace('`', "'"),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use serde::Deserialize;

    #[derive(Debug, PartialEq, Deserialize)]
    #[serde(deny_unknown_fields)]
    struct Thing {
        count: u32,
        place: Option<[f64; 3]>,
        kind: Option<Kind>,
        parts: Option<Vec<Thing>>,
        name: Option<String>,
        lit: Option<bool>,
        more: Option<serde_json::Value>,
    }

    #[derive(Debug, PartialEq, Deserialize)]
    #[serde(rename_all = "lowercase")]
    enum Kind {
        Solid,
        Sheet,
    }

    fn words(text: &[u8]) -> String {
        json_message(&serde_json::from_slice::<Thing>(text).unwrap_err(), "a thing")
    }

    #[test]
    fn a_thing_without_a_fault_is_read() {
        let text =
            br#"{"count":1,"place":[1,2,3],"kind":"sheet","parts":[],"name":"a","lit":true}"#;
        let thing = Thing {
            count: 1,
            place: Some([1.0, 2.0, 3.0]),
            kind: Some(Kind::Sheet),
            parts: Some(Vec::new()),
            name: Some("a".to_owned()),
            lit: Some(true),
            more: None,
        };
        assert_eq!(serde_json::from_slice::<Thing>(text).unwrap(), thing);
    }

    #[test]
    fn no_message_has_words_of_rust() {
        let mut deep = br#"{"count":1,"more":"#.to_vec();
        deep.extend([b'['; 200]);
        let texts: [(&[u8], &str); 31] = [
            (b"", "the text ends here, expected a value"),
            (b"{", "the text ends within an object, expected a closing brace"),
            (
                b"{\"count\":1,\"parts\":[",
                "the text ends within an array, expected a closing bracket",
            ),
            (b"{\"cou", "the text ends within a string, expected a closing quote"),
            (b"{\"count\":x}", "this is no JSON, expected a value"),
            (b"{\"count\":1,\"lit\":tru}", "this is no JSON, expected a value"),
            (b"{\"count\" 1}", "this is no JSON, expected ':'"),
            (b"{\"count\":1 2}", "this is no JSON, expected ',' or '}'"),
            (b"{\"count\":1,\"parts\":[1 2]}", "'1' stands here, expected an object"),
            (b"{count:1}", "this is no JSON, expected a key in quotes"),
            (b"{\"count\":1,\"name\":\"\\q\"}", "a wrong escape, expected one of those of JSON"),
            (b"{\"count\":01}", "a wrong number, expected decimal digits"),
            (b"{\"place\":[1e999,0,0]}", "the number is out of range, expected a smaller one"),
            (b"{\"count\":1,\"name\":\"\xff\"}", "the text is damaged, expected UTF-8"),
            (
                b"{\"count\":1,\"name\":\"\n\"}",
                "a control character within a string, expected an escape",
            ),
            (b"{\"count\":1,}", "this is no JSON, expected another item after the comma"),
            (b"{\"count\":1} x", "something follows here, expected the end of the list or file"),
            (
                b"{\"place\":[1,2,3,4]}",
                "something follows here, expected the end of the list or file",
            ),
            (&deep, "brackets are nested too deep, expected 127 levels at most"),
            (b"{}", "the key 'count' is missing, expected a thing"),
            (b"{\"count\":1,\"count\":1}", "the key 'count' stands here twice, expected it once"),
            (
                b"{\"size\":1}",
                "the key 'size' is not known, expected one of 'count', 'place', 'kind', 'parts', 'name', 'lit', 'more'",
            ),
            (b"{\"count\":-1}", "'-1' stands here, expected a natural number"),
            (b"{\"count\":1.5}", "'1.5' stands here, expected a natural number"),
            (b"{\"count\":\"1\"}", "'1' stands here, expected a natural number"),
            (b"{\"count\":null}", "null stands here, expected a natural number"),
            (b"{\"count\":{}}", "an object stands here, expected a natural number"),
            (b"{\"count\":1,\"place\":[1,2]}", "2 items stand here, expected an array of 3"),
            (
                b"{\"count\":1,\"kind\":\"soft\"}",
                "the word 'soft' is not known, expected 'solid' or 'sheet'",
            ),
            (b"{\"count\":1,\"lit\":0}", "'0' stands here, expected true or false"),
            (b"7", "'7' stands here, expected an object"),
        ];
        for (text, expected) in texts {
            assert_eq!(words(text), expected, "{}", text.escape_ascii());
        }
    }
}
