//! Pages in every unit are the same page.

use super::{area, difference, read, shape};
use glam::dvec2;

fn page(attributes: &str, content: &str) -> String {
    format!("<svg xmlns='http://www.w3.org/2000/svg' {attributes}>{content}</svg>")
}

const SQUARE: &str = "<path d='M10 10H60V60H10z'/>";

#[test]
fn a_page_in_any_unit_is_the_same_page() {
    let millimetres = shape(&page("width='100mm' height='100mm' viewBox='0 0 100 100'", SQUARE));
    assert_eq!(area(&millimetres), 2500.0);
    for (attributes, content) in [
        ("width='10cm' height='10cm' viewBox='0 0 100 100'", SQUARE),
        ("width='3.9370079in' height='3.9370079in' viewBox='0 0 100 100'", SQUARE),
        ("width='283.46457pt' height='283.46457pt' viewBox='0 0 100 100'", SQUARE),
        ("width='23.622047pc' height='23.622047pc' viewBox='0 0 100 100'", SQUARE),
        ("width='377.95276' height='377.95276px' viewBox='0 0 100 100'", SQUARE),
        ("width='100mm' height='100mm' viewBox='5 -5 100 100'", "<path d='M15 5h50v50h-50z'/>"),
        ("width='100mm' height='50mm' viewBox='-50 0 100 50'", "<path d='M-40 10h50v50h-50z'/>"),
        ("width='100mm' viewBox='0 0 200 200'", "<path d='M20 20H120V120H20z'/>"),
        ("height='100mm' viewBox='0 0 200 200'", "<path d='M20 20H120V120H20z'/>"),
        ("width='100mm' height='100mm' viewBox='0 0 50 100'", "<path d='M-15 10h50v50h-50z'/>"),
        (
            "width='100mm' height='200mm' viewBox='0 0 50 50' preserveAspectRatio='none'",
            "<path d='M5 2.5h25v12.5h-25z'/>",
        ),
        (
            "width='377.95276' height='377.95276'",
            "<path d='M37.795276 37.795276H226.77165V226.77165H37.795276z'/>",
        ),
        ("", "<path d='M37.795276 37.795276H226.77165V226.77165H37.795276z'/>"),
        (
            "width='100%' height='100%' viewBox='0 0 377.95276 377.95276'",
            "<path d='M37.795276 37.795276H226.77165V226.77165H37.795276z'/>",
        ),
        ("width='auto'", "<path transform='scale(3.7795276)' d='M10 10H60V60H10z'/>"),
    ] {
        let text = page(attributes, content);
        let shape = shape(&text);
        let clipped = if attributes.contains("50mm") { 50.0 * 10.0 + 0.0 } else { 0.0 };
        // Exactly the same, but for the page that is only 50 mm high.
        assert_eq!(difference(&millimetres, &shape), clipped, "{text}");
    }
}

#[test]
fn pages_have_their_size() {
    let size = |attributes: &str| read(&page(attributes, "")).page.map(|page| page.high - page.low);
    assert_eq!(size("width='100mm' height='5cm'"), Some(dvec2(100.0, 50.0)));
    assert_eq!(size("width='96' height='48' viewBox='0 0 1 1'"), Some(dvec2(25.4, 12.7)));
    assert_eq!(size("viewBox='0 0 96 48'"), Some(dvec2(25.4, 12.7)));
    assert_eq!(size("width='50%' viewBox='0 0 96 48'"), Some(dvec2(12.7, 6.35)));
    assert_eq!(size("height='20mm' viewBox='0 0 96 48'"), Some(dvec2(40.0, 20.0)));
    assert_eq!(size("width='100mm'"), None);
    assert_eq!(size(""), None);
    assert!(read(&page("viewBox='0 0 9 9'", "")).is_in_pixels);
    assert!(!read(&page("width='9mm' height='9mm'", "")).is_in_pixels);
    for nothing in ["width='0' height='9'", "viewBox='0 0 0 9'", "display='none'", "opacity='0'"] {
        assert_eq!(area(&shape(&page(nothing, SQUARE))), 0.0, "{nothing}");
    }
}

#[test]
fn a_page_may_be_turned_about_its_middle() {
    let text = page(
        "width='100mm' height='50mm' viewBox='0 0 100 50' transform='rotate(180)'",
        "<rect width='30' height='10'/>",
    );
    let turned = page(
        "width='100mm' height='50mm' viewBox='0 0 100 50'",
        "<rect x='70' y='40' width='30' height='10'/>",
    );
    assert_eq!(difference(&shape(&text), &shape(&turned)), 0.0);
}
