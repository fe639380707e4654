//! What cannot be read is refused with its line; what is passed over is told.

use super::{area, page, read, read_with, refusal, shape};
use umriss::export::{ShapeFormat, ShapeOptions};

#[test]
fn errors_name_the_line_and_what_was_expected() {
    for (text, expected) in [
        (
            page("<path d='M0 0K1 1'/>"),
            "line 2: `K` in path data, expected M, L, H, V, C, S, Q, T, A or Z",
        ),
        (page("<path d='M0 0L1'/>"), "line 2: the end, expected a number"),
        (page("<path d='L0 0'/>"), "line 2: path data begins with `L`, expected M or m"),
        (page("<path d='M0 0A1 1 0 2 0 3 3'/>"), "line 2: `2`, expected 0 or 1 in an arc"),
        (page("\n<g transform='spin(3)'/>"), "line 3: the transform `spin(3)` cannot be read"),
        (
            page("<rect width='9 furlongs' height='1'/>"),
            "line 2: width: `9 furlongs` is no length, expected",
        ),
        (
            page("<svg viewBox='0 0 1'/>"),
            "line 2: the viewBox `0 0 1` cannot be read, expected four numbers",
        ),
        (page("<svg viewBox='0 0 -1 1'/>"), "cannot be read, expected four numbers"),
        (
            page("<svg viewBox='0 0 1 1' preserveAspectRatio='middle'/>"),
            "line 2: preserveAspectRatio is `middle`",
        ),
        (
            page("<path d='M0 0L1e308 1e308' transform='scale(1e308)'/>"),
            "line 2: a place beyond the range",
        ),
        (page("<g><path></g>"), "line 2: "),
        ("<html/>".to_owned(), "line 1: <html>, expected <svg>"),
        ("<svg width='-5mm' height='9mm'/>".to_owned(), "line 1: width is negative"),
        ("<svg><rect width='50%' height='9'/></svg>".to_owned(), "50% of a page that has no size"),
        ("<svg>\n&nothing;</svg>".to_owned(), "line 2: "),
        (String::new(), "line 1: "),
        ("just text".to_owned(), "line 1: "),
    ] {
        let found = refusal(&text);
        assert!(found.contains(expected), "{found}: expected {expected}");
    }
    let of_bytes = |bytes: &[u8]| ShapeFormat::Svg.read(bytes).unwrap_err().to_string();
    assert!(of_bytes(b"\x1f\x8b\x08\x00").contains("svgz"));
    assert!(of_bytes(b"\xff\xfe<\0s\0").contains("UTF-16"));
    assert_eq!(of_bytes(b"<svg>\n\xff</svg>"), "line 2: this is no text, expected UTF-8");
    let with_mark = [b"\xef\xbb\xbf", page("<rect width='9' height='9'/>").as_bytes()].concat();
    assert!(ShapeFormat::Svg.read(&with_mark).is_ok());
}

/// What drawing programs write around their files.
#[test]
fn document_types_and_entities_are_read() {
    let text = "<?xml version='1.0' encoding='UTF-8'?>\n<!DOCTYPE svg PUBLIC '-//W3C//DTD SVG 1.1//EN' \
        'http://www.w3.org/Graphics/SVG/1.1/DTD/svg11.dtd' [<!ENTITY w '30'>]>\n\
        <svg xmlns='http://www.w3.org/2000/svg' width='100mm' height='100mm' viewBox='0 0 100 100'>\
        <rect width='&w;' height='10'/></svg>";
    assert_eq!(area(&shape(text)), 300.0);
    // Ten times ten times ten and so on.
    let mut bomb = "<!DOCTYPE svg [<!ENTITY a0 'x'>".to_owned();
    for i in 0..30 {
        bomb += &format!("<!ENTITY a{} '{}'>", i + 1, format!("&a{i};").repeat(10));
    }
    bomb += "]><svg><text>&a30;</text></svg>";
    assert!(refusal(&bomb).starts_with("line 1: "));
}

#[test]
fn what_is_passed_over_is_told_by_name() {
    let file = read(&page(
        "<text>A</text>\n<g><text>B</text></g><image href='a.png'/><line x2='5' stroke='red'/>
         <path d='M0 0H5' fill='none' stroke='red'/><circle r='5' fill='none' stroke='red' stroke-width='0'/>
         <mask id='m'/><g mask='url(#m)'><rect width='9' height='9'/></g>
         <rect width='9' height='9' filter='url(#f)' marker-start='url(#x)'/>
         <rect width='5' height='5' clip-path='circle(3)'/>
         <use href='other.svg#x'/><style>@media print { rect { fill: none } }</style>
         <g display='none'><text>C</text></g><foreignObject/><title>none</title>",
    ));
    assert_eq!(
        file.warnings,
        [
            "passed over: <foreignObject>, it has no outline here (line 9)",
            "passed over: <image>, it has no outline here (line 3)",
            "passed over: <line>, lines without a fill have no area (line 3)",
            "passed over: <path>, lines without a fill have no area (line 4)",
            "passed over: <text>, it has no outline here (2, the first in line 2)",
            "passed over: <use>, it shows something from another file (line 8)",
            "passed over: @media, a rule of a style sheet that is not followed (line 8)",
            "passed over: clip-path, what is clipped by a shape of CSS is left out (line 7)",
            "passed over: filter, shapes are taken as they are without it (line 6)",
            "passed over: markers, they have no outline here (line 6)",
            "passed over: mask, what is shown through a mask has no outline (line 5)",
        ]
    );
    assert_eq!(area(&file.shape(None).unwrap()), 81.0);
}

#[test]
fn what_lies_off_the_page_is_cut_off_or_kept() {
    let text = page("<rect x='-20' width='30' height='30'/><rect x='40' width='9' height='9'/>");
    let file = read(&text);
    assert!(file.is_cut_to_page);
    assert_eq!(area(&file.shape(None).unwrap()), 381.0);
    let all = read_with(&text, &ShapeOptions { off_page: true, ..ShapeOptions::default() });
    assert!(!all.is_cut_to_page);
    assert_eq!(area(&all.shape(None).unwrap()), 981.0);
}

#[test]
fn twenty_thousand_groups_are_read_and_instances_without_end_refused() {
    let nested = |open: &str, content: &str, close: &str| {
        page(&format!("{}{content}{}", open.repeat(20_000), close.repeat(20_000)))
    };
    let square = "<rect width='9' height='9'/>";
    assert_eq!(area(&shape(&nested("<g>", square, "</g>"))), 81.0);
    assert_eq!(area(&shape(&nested("<g clip-path='url(#c)'>", square, "</g>"))), 81.0);
    assert_eq!(area(&shape(&nested("<svg>", square, "</svg>"))), 81.0);
    let clip = "<clipPath id='c'><rect width='5' height='5'/></clipPath>";
    let clipped =
        format!("{}{square}{}", "<g clip-path='url(#c)'>".repeat(20_000), "</g>".repeat(20_000));
    assert_eq!(area(&shape(&page(&format!("{clip}{clipped}")))), 25.0);
    // Each ten times the one before.
    let mut bomb = "<defs><g id='a0'/>".to_owned();
    for i in 0..20 {
        let ten = format!("<use href='#a{i}'/>").repeat(10);
        bomb += &format!("<g id='a{}'>{ten}</g>", i + 1);
    }
    let found = refusal(&page(&format!("{bomb}</defs><use href='#a20'/>")));
    assert!(found.contains("elements are drawn, those of every <use> counted"), "{found}");
    let chain: String = (0..200).map(|i| format!("<use id='a{}' href='#a{i}'/>", i + 1)).collect();
    let found = refusal(&page(&format!("<defs>{chain}</defs><use href='#a200'/>")));
    assert!(found.contains("<use> within <use>, expected 64 levels at most"), "{found}");
    // Selectors that try every way up through the elements.
    let selector = "g ".repeat(40);
    let style = format!("<style>.none {selector} {{ fill: none }}</style>");
    let deep = format!("{}{}{}", "<g>".repeat(200), square, "</g>".repeat(200));
    let found = refusal(&page(&format!("{style}{deep}")));
    assert!(found.contains("style sheets that take too long"), "{found}");
    let long = format!("<style>{} {{ fill: none }}</style>", "g ".repeat(100_000));
    assert!(refusal(&page(&long)).contains("a selector of many parts"));
}
