//! Random documents against the judge.

use super::judge::judged;
use super::{difference, shape};
use proptest::prelude::*;

/// A shape of a few units, with its attributes.
fn element() -> impl Strategy<Value = String> {
    let number = || (-20..120_i32).prop_map(|n| f64::from(n) / 2.0);
    let size = || (1..60_i32).prop_map(|n| f64::from(n) / 2.0);
    let unit = || prop_oneof![4 => Just(""), 1 => Just("px"), 1 => Just("mm"), 1 => Just("%")];
    let path = prop::collection::vec(command(), 1..7)
        .prop_map(|commands| format!("<path d='M30 30{}'", commands.concat()));
    prop_oneof![
        (number(), number(), size(), size(), unit(), 0..4_u32).prop_map(|(x, y, w, h, unit, r)| {
            format!("<rect x='{x}' y='{y}' width='{w}{unit}' height='{h}{unit}' rx='{r}'")
        }),
        (number(), number(), size(), unit())
            .prop_map(|(x, y, r, unit)| format!("<circle cx='{x}' cy='{y}' r='{r}{unit}'")),
        (number(), number(), size(), size())
            .prop_map(|(x, y, a, b)| format!("<ellipse cx='{x}' cy='{y}' rx='{a}' ry='{b}'")),
        prop::collection::vec((number(), number()), 3..8).prop_map(|points| {
            let points: Vec<_> = points.iter().map(|(x, y)| format!("{x},{y}")).collect();
            format!("<polygon points='{}'", points.join(" "))
        }),
        path,
    ]
}

fn command() -> impl Strategy<Value = String> {
    let n = || -40..80_i32;
    prop_oneof![
        (n(), n()).prop_map(|(x, y)| format!("L{x} {y}")),
        (n(), n()).prop_map(|(x, y)| format!("l{x} {y}")),
        n().prop_map(|x| format!("H{x}")),
        n().prop_map(|y| format!("v{y}")),
        (n(), n(), n(), n(), n(), n())
            .prop_map(|(a, b, c, d, e, f)| format!("C{a} {b} {c} {d} {e} {f}")),
        (n(), n(), n(), n()).prop_map(|(a, b, c, d)| format!("s{a} {b} {c} {d}")),
        (n(), n(), n(), n()).prop_map(|(a, b, c, d)| format!("q{a} {b},{c} {d}")),
        (n(), n()).prop_map(|(a, b)| format!("T{a} {b}")),
        (1..60_i32, 1..60_i32, n(), 0..2_u8, 0..2_u8, n(), n())
            .prop_map(|(a, b, t, l, s, x, y)| format!("A{a} {b} {t} {l}{s}{x} {y}")),
        Just("z".to_owned()),
        (n(), n()).prop_map(|(x, y)| format!("zm{x} {y}")),
    ]
}

/// Attributes that change what is displayed, or where.
fn attributes() -> impl Strategy<Value = String> {
    let one = prop_oneof![
        4 => Just(String::new()),
        2 => transform().prop_map(|text| format!(" transform='{text}'")),
        1 => Just(" fill='none'".to_owned()),
        1 => Just(" fill='red'".to_owned()),
        1 => Just(" style='fill:#00f;fill-rule:evenodd'".to_owned()),
        1 => Just(" fill-rule='evenodd' clip-rule='evenodd'".to_owned()),
        1 => Just(" visibility='hidden'".to_owned()),
        1 => Just(" visibility='visible'".to_owned()),
        1 => Just(" class='a'".to_owned()),
        1 => Just(" class='b c'".to_owned()),
        1 => Just(" clip-path='url(#clip)'".to_owned()),
        1 => Just(" opacity='.5'".to_owned()),
        1 => Just(" fill-opacity='0'".to_owned()),
        1 => Just(" display='none'".to_owned()),
    ];
    prop::collection::vec(one, 0..3).prop_map(|mut all| {
        // An attribute stands once.
        all.sort();
        all.dedup_by_key(|text| text.split('=').next().unwrap_or_default().to_owned());
        all.concat()
    })
}

fn transform() -> impl Strategy<Value = String> {
    let n = || -30..30_i32;
    prop_oneof![
        (n(), n()).prop_map(|(x, y)| format!("translate({x},{y})")),
        n().prop_map(|angle| format!("rotate({angle} 50 50)")),
        (1..4_i32).prop_map(|s| format!("scale(.{s}5 -.9) translate(0 -60)")),
        n().prop_map(|angle| format!("skewX({angle})scale(.5)")),
        n().prop_map(|x| format!("matrix(.5 .25 -.25 .5 {x} 9)")),
    ]
}

/// An element or a container of elements.
fn content() -> impl Strategy<Value = String> {
    let leaf = prop_oneof![
        5 => (element(), attributes()).prop_map(|(element, attributes)| format!("{element}{attributes}/>")),
        1 => (attributes(), -20..40_i32)
            .prop_map(|(attributes, x)| format!("<use href='#shape' x='{x}'{attributes}/>")),
        1 => (attributes(), 5..60_i32).prop_map(|(attributes, width)| {
            format!("<use xlink:href='#symbol' width='{width}' height='40'{attributes}/>")
        }),
    ];
    leaf.prop_recursive(3, 12, 4, |inner| {
        let several = prop::collection::vec(inner, 1..4).prop_map(|all| all.concat());
        prop_oneof![
            (several.clone(), attributes())
                .prop_map(|(content, attributes)| format!("<g{attributes}>{content}</g>")),
            (several, aspect(), 10..80_u32, 10..80_u32).prop_map(|(content, aspect, w, h)| {
                format!(
                    "<svg x='5' width='{w}' height='{h}%' viewBox='-5 0 60 40' \
                     preserveAspectRatio='{aspect}'>{content}</svg>"
                )
            }),
        ]
    })
}

fn aspect() -> impl Strategy<Value = &'static str> {
    prop::sample::select(vec!["none", "xMidYMid", "xMinYMax slice", "xMaxYMin meet"])
}

/// Names that the attributes refer to.
const DEFINITIONS: &str = "<style>.a{fill:none} .b{fill:lime} g .c{visibility:visible}</style>
<clipPath id='clip'><rect x='10' y='10' width='50' height='30'/><circle cx='60' cy='60' r='20' transform='scale(.9)'/></clipPath>
<clipPath id='part' clipPathUnits='objectBoundingBox'><path d='M0 0H.8L.5 1z'/></clipPath>
<defs><path id='shape' d='M10 10h20l5 15-20 5z'/></defs>
<symbol id='symbol' viewBox='0 0 20 20'><rect width='15' height='30'/></symbol>";

proptest! {
    #[test]
    fn documents_are_displayed_as_the_judge_sees_them(
        contents in prop::collection::vec(content(), 1..4),
        size in prop::sample::select(vec![
            "width='100mm' height='100mm' viewBox='0 0 100 100'",
            "width='100' height='80'",
            "width='4in' height='3in' viewBox='-10 -10 120 80' preserveAspectRatio='xMinYMid slice'",
            "viewBox='0 0 100 100'",
        ]),
    ) {
        let text = format!(
            "<svg xmlns='http://www.w3.org/2000/svg' xmlns:xlink='http://www.w3.org/1999/xlink' \
             {size}>{DEFINITIONS}{}</svg>",
            contents.concat()
        );
        let apart = difference(&shape(&text), &judged(&text));
        // Along borders of a metre at most: chords, floats, and the judge's arcs.
        prop_assert!(apart < 3.0, "{} mm2 apart:\n{}", apart, text);
    }
}
