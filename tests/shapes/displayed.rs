//! What is displayed counts, and nothing else. Every area is told by hand,
//! and by the judge unless its view is another one.

use super::judge::judged;
use super::{area, difference, page, read, shape};
use std::f64::consts::PI;

/// Contents of a page of 100 x 100 mm, and the area that is filled.
const CASES: &[(&str, f64)] = &[
    // Shapes.
    ("<rect x='10' y='10' width='30' height='20'/>", 600.0),
    ("<rect width='30' height='20' rx='0'/>", 600.0),
    ("<rect width='0' height='20'/><rect width='20' height='-5'/>", 0.0),
    ("<polygon points='0,0 10,0 10,10'/><polyline points='20 0 30 0 30 10'/>", 100.0),
    ("<path d='M0 0H10V10H0zm20 0h10v10h-10zl0 20 10 0z'/>", 250.0),
    ("<path d='M0 0H10V10H0z M2 2v6h6v-6z'/>", 64.0),
    ("<path d='M0 0H10V10H0z M2 2h6v6h-6z'/>", 100.0),
    ("<path fill-rule='evenodd' d='M0 0H10V10H0z M2 2h6v6h-6z'/>", 64.0),
    ("<line x2='9' y2='9'/><path d='M0 0L9 9'/><path/><path d=''/><polygon/>", 0.0),
    // Units within the page are pixels of its user units.
    ("<rect width='1in' height='96'/>", 96.0 * 96.0),
    ("<rect width='10%' height='20%' x='50%'/>", 200.0),
    ("<rect font-size='10' width='1em' height='2ex'/>", 100.0),
    // Transforms.
    ("<g transform='translate(5 5)scale(2)'><rect width='10' height='10'/></g>", 400.0),
    ("<g transform=''><rect transform='rotate(90 50 50)' width='10' height='20'/></g>", 200.0),
    ("<rect width='10' height='10' transform='matrix(1 1 0 2 0 0)'/>", 200.0),
    ("<rect width='10' height='10' transform='scale(0 1)'/>", 0.0),
    ("<rect width='9' height='9' transform='scale(2)' transform-origin='9 9'/>", 324.0 - 135.0 - 108.0),
    ("<rect width='10' height='10' style='transform:scale(3)'/>", 900.0),
    // What is not displayed.
    ("<g display='none'><rect width='9' height='9'/></g>", 0.0),
    ("<g style='display:none'><rect width='9' height='9'/></g>", 0.0),
    ("<rect width='9' height='9' visibility='hidden'/>", 0.0),
    ("<g visibility='hidden'><rect width='9' height='9' visibility='visible'/></g>", 81.0),
    ("<rect width='9' height='9' visibility='collapse'/>", 0.0),
    ("<g opacity='0'><rect width='9' height='9'/></g>", 0.0),
    ("<rect width='9' height='9' opacity='0%'/>", 0.0),
    ("<rect width='9' height='9' fill-opacity='0'/>", 0.0),
    ("<rect width='9' height='9' opacity='0.01'/>", 81.0),
    ("<g fill='none'><rect width='9' height='9'/><rect width='5' height='5' fill='red'/></g>", 25.0),
    ("<rect width='9' height='9' fill='transparent'/>", 0.0),
    ("<rect width='9' height='9' fill='rgba(0,0,0,0)'/>", 0.0),
    ("<rect width='9' height='9' fill='#ff000000'/>", 0.0),
    ("<rect width='9' height='9' fill='#fff'/>", 81.0),
    ("<g color='rgba(0,0,0,0)'><rect width='9' height='9' fill='currentColor'/></g>", 0.0),
    ("<rect width='9' height='9' fill='url(#no)'/>", 0.0),
    ("<rect width='9' height='9' fill='url(#no) red'/>", 81.0),
    ("<linearGradient id='g'><stop offset='0' stop-color='red'/></linearGradient>
      <rect width='9' height='9' fill='url(#g)'/>", 81.0),
    ("<linearGradient id='g'/><rect width='9' height='9' fill='url(#g)'/>", 0.0),
    ("<defs><rect width='9' height='9'/></defs><symbol><rect width='9' height='9'/></symbol>
      <marker><rect width='9' height='9'/></marker><pattern><rect width='9' height='9'/></pattern>
      <mask id='m'><rect width='9' height='9'/></mask><metadata><rect width='9' height='9'/></metadata>", 0.0),
    ("<clipPath><rect width='9' height='9'/></clipPath>", 0.0),
    ("<foreign xmlns='http://example.org'><rect width='9' height='9'/></foreign>", 0.0),
    ("<unknown><rect width='9' height='9'/></unknown>", 0.0),
    // Style sheets.
    ("<style>rect{fill:none} .a{fill:red} #b{display:none}</style><rect width='5' height='5'/>
      <rect class='x a' width='9' height='9'/><rect id='b' class='a' width='20' height='20'/>", 81.0),
    ("<style><![CDATA[ g > rect { visibility: hidden !important } ]]></style>
      <g><rect style='visibility:visible' width='5' height='5'/></g><rect width='9' height='9'/>", 81.0),
    ("<style>rect{fill:red}</style><rect fill='none' width='9' height='9'/>", 81.0),
    ("<style>rect{fill:red}</style><rect style='fill:none' width='9' height='9'/>", 0.0),
    ("<style type='text/x'>rect{fill:none}</style><rect width='9' height='9'/>", 81.0),
    // Instances.
    ("<defs><rect id='r' width='9' height='9'/></defs><use href='#r'/><use xlink:href='#r' x='20'/>", 162.0),
    ("<rect id='r' width='9' height='9'/><use href='#r' x='20' transform='scale(2)'/>", 81.0 + 324.0),
    ("<g fill='none'><path id='r' d='M0 0H9V9H0z'/></g><use href='#r'/>", 81.0),
    ("<defs><path id='r' d='M0 0H9V9H0z'/></defs><use href='#r' fill='none'/>", 0.0),
    ("<use href='#no'/><use/><use href=''/>", 0.0),
    ("<g id='a'><rect width='9' height='9'/><use href='#a' x='20'/></g>", 81.0),
    ("<defs><use id='a' href='#b'/><use id='b' href='#a'/></defs><use href='#a'/>", 0.0),
    ("<symbol id='s' viewBox='0 0 10 10'><rect width='20' height='10'/></symbol>
      <use href='#s' width='30' height='30'/>", 900.0),
    ("<symbol id='s' viewBox='0 0 10 10' overflow='visible'><rect width='20' height='10'/></symbol>
      <use href='#s' width='30' height='30' x='20'/>", 1800.0),
    ("<defs><rect id='r' width='9' height='9' fill='context-fill'/></defs>
      <use href='#r'/><use href='#r' x='20' fill='none'/>", 81.0),
    // Viewports.
    ("<svg x='10' y='10' width='20' height='20'><rect width='50' height='5'/></svg>", 100.0),
    ("<svg width='20' height='20' overflow='visible'><rect width='50' height='5'/></svg>", 250.0),
    ("<svg width='20' height='40' viewBox='0 0 10 10'><rect width='10' height='10'/></svg>", 400.0),
    ("<svg width='20' height='40' viewBox='0 0 10 10' preserveAspectRatio='none'>
      <rect width='10' height='10'/></svg>", 800.0),
    ("<svg width='20' height='40' viewBox='0 0 10 10' preserveAspectRatio='xMinYMin slice'>
      <rect width='4' height='10'/></svg>", 640.0),
    ("<svg width='50%' height='50%'><rect width='50%' height='10%'/></svg>", 125.0),
    // Conditions.
    ("<switch><rect systemLanguage='xx' width='9' height='9'/><rect width='5' height='5'/>
      <rect width='20' height='20'/></switch>", 25.0),
    ("<switch><g requiredExtensions='http://example.org'/><a><rect width='5' height='5'/></a></switch>", 25.0),
    // Clip paths.
    ("<clipPath id='c'><rect width='5' height='5'/></clipPath>
      <rect width='9' height='9' clip-path='url(#c)'/>", 25.0),
    ("<clipPath id='c'><rect width='5' height='5'/></clipPath>
      <g transform='scale(2)' clip-path='url(\"#c\")'><rect width='9' height='9'/></g>", 100.0),
    ("<clipPath id='c' transform='translate(4)'><rect width='9' height='9'/></clipPath>
      <g clip-path='url(#c)'><rect width='9' height='9'/></g>", 45.0),
    ("<clipPath id='c'><path clip-rule='evenodd' d='M0 0H10V10H0z M2 2h6v6h-6z'/></clipPath>
      <rect width='50' height='50' clip-path='url(#c)'/>", 64.0),
    ("<clipPath id='c'><rect width='5' height='5' fill='none' opacity='0'/>
      <rect x='5' width='5' height='5' display='none'/><rect x='20' width='9' height='9' visibility='hidden'/>
      </clipPath><rect width='50' height='50' clip-path='url(#c)'/>", 25.0),
    ("<clipPath id='c'><g><rect width='5' height='5'/></g></clipPath>
      <rect width='50' height='50' clip-path='url(#c)'/>", 0.0),
    ("<defs><rect id='r' width='5' height='5'/></defs><clipPath id='c'><use href='#r' x='3'/></clipPath>
      <rect width='50' height='50' clip-path='url(#c)'/>", 25.0),
    ("<clipPath id='d'><rect width='3' height='99'/></clipPath>
      <clipPath id='c' clip-path='url(#d)'><rect width='5' height='5'/></clipPath>
      <rect width='50' height='50' clip-path='url(#c)'/>", 15.0),
    ("<clipPath id='d'><rect width='3' height='99'/></clipPath>
      <clipPath id='c'><rect clip-path='url(#d)' width='5' height='5'/></clipPath>
      <rect width='50' height='50' clip-path='url(#c)'/>", 15.0),
    ("<clipPath id='c'><rect width='5' height='5'/></clipPath><clipPath id='d'><rect x='3' width='9' height='9'/>
      </clipPath><g clip-path='url(#c)'><g clip-path='url(#d)'><rect width='50' height='50'/></g></g>", 10.0),
    ("<rect width='9' height='9' clip-path='url(#no)'/>", 81.0),
    ("<clipPath id='c' clipPathUnits='objectBoundingBox'><rect width='.5' height='.25'/></clipPath>
      <rect x='10' width='20' height='20' clip-path='url(#c)'/>", 50.0),
    ("<clipPath id='c' clipPathUnits='objectBoundingBox'><rect width='.5' height='1'/></clipPath>
      <g clip-path='url(#c)' transform='scale(2)'><rect x='2' width='4' height='4'/>
      <rect x='8' width='2' height='4' fill='none'/></g>", 64.0),
    // The page.
    ("<rect x='-10' y='90' width='30' height='30'/>", 200.0),
    ("<rect x='-40' width='30' height='30'/>", 0.0),
];

#[test]
fn what_is_displayed_has_the_right_area_and_the_judge_agrees() {
    for (content, expected) in CASES {
        let text = page(content);
        let shape = shape(&text);
        let found = area(&shape);
        assert!((found - expected).abs() < 1e-3, "{found}, expected {expected}: {content}");
        let apart = difference(&shape, &judged(&text));
        assert!(apart < 0.02, "{apart} mm2 apart: {content}");
    }
}

/// What the judge does not know, or sees otherwise than browsers do.
#[test]
fn what_browsers_display_beyond_the_judge() {
    for (content, expected) in [
        // Properties of CSS that were attributes.
        ("<rect style='width:9px;height:9px;x:3px'/>", 81.0),
        ("<rect width='9' height='9' style='transform:rotate(90deg) translateY(-20px)'/>", 81.0),
        // Nothing is displayed in a viewport without a width.
        ("<svg width='0' height='40'><rect width='10' height='10'/></svg>", 0.0),
        // The viewport of a nested svg is the whole one around.
        ("<svg x='50'><rect width='100' height='10'/></svg>", 500.0),
        ("<rect style='fill:NONE' width='9' height='9'/>", 0.0),
        ("<rect style='fill:bogus' width='9' height='9'/>", 81.0),
        ("<g fill='none'><rect style='fill:initial' width='9' height='9'/></g>", 81.0),
    ] {
        let found = area(&shape(&page(content)));
        assert!((found - expected).abs() < 1e-3, "{found}, expected {expected}: {content}");
    }
}

/// Areas of curves, chords within 0.005 mm.
#[test]
fn curves_have_their_areas() {
    for (content, expected, length) in [
        ("<circle cx='50' cy='50' r='20'/>", PI * 400.0, 126.0),
        ("<ellipse cx='50' cy='50' rx='20' ry='5'/>", PI * 100.0, 90.0),
        ("<rect width='30' height='20' rx='5'/>", 600.0 - (4.0 - PI) * 25.0, 100.0),
        ("<rect width='30' height='20' rx='50' ry='5'/>", 600.0 - (4.0 - PI) * 75.0, 100.0),
        ("<path d='M10 50A40 40 0 0 1 90 50z'/>", PI * 800.0, 126.0),
        ("<path d='M10 50a1 1 0 0 1 80 0z'/>", PI * 800.0, 126.0),
        ("<path d='M40 40a20 20 0 1020 20L40 60z'/>", PI * 300.0, 100.0),
        ("<path d='M10 50a20 40 90 0180 0'/>", PI * 400.0, 130.0),
        // Two thirds of base and height; three fifths of the control polygon.
        ("<path d='M0 0Q30 60 60 0z'/>", 2.0 / 3.0 * 60.0 * 30.0, 90.0),
        ("<path d='M0 50Q15 110 30 50T60 50z'/>", 2.0 * 2.0 / 3.0 * 30.0 * 30.0, 130.0),
        ("<path d='M0 0C0 40 60 40 60 0z'/>", 0.6 * 60.0 * 40.0, 130.0),
        ("<path d='M0 20c0 20 30 20 30 0S60 0 60 20z'/>", 2.0 * 0.6 * 30.0 * 20.0, 130.0),
    ] {
        let text = page(content);
        let file = read(&text);
        assert_eq!(file.flattened, Some(0.005), "{content}");
        let shape = file.shape(None).unwrap();
        let found = area(&shape);
        // Chords lie on one side at most.
        assert!((found - expected).abs() <= 0.005 * length, "{found}, not {expected}: {content}");
        // The judge's arcs are curves within a few thousandths of the radius.
        let apart = difference(&shape, &judged(&text));
        assert!(apart < 0.02 * length, "{apart} mm2 apart: {content}");
    }
}
