//! `usvg` as the judge of what is displayed: its tree, taken apart
//! independently, in its own floats of 32 bits.

use glam::{DAffine2, DVec2, dvec2};
use umriss::polygon::clipping::{FillRule, Operation, PlaneShape};
use usvg::tiny_skia_path::{Path, PathSegment};
use usvg::{ClipPath, Group, Node, Options, Transform, Tree};

/// Millimetres in one of its pixels.
const PIXEL: f64 = 25.4 / 96.0;

/// What the judge sees of a file, cut to its page.
pub(crate) fn judged(text: &str) -> PlaneShape {
    let tree = Tree::from_str(text, &Options::default()).unwrap();
    let (width, height) = (f64::from(tree.size().width()), f64::from(tree.size().height()));
    let corners = [[0.0, 0.0], [width, 0.0], [width, height], [0.0, height]];
    let ring = corners.map(|corner| DVec2::from(corner) * PIXEL).to_vec();
    let page = PlaneShape::new(&[vec![ring]], FillRule::EvenOdd).unwrap();
    let all = group(tree.root(), Transform::identity(), false);
    PlaneShape::operation(Operation::Intersection, &[&all, &page]).unwrap()
}

fn union(shapes: &[PlaneShape]) -> PlaneShape {
    PlaneShape::operation(Operation::Union, &shapes.iter().collect::<Vec<_>>()).unwrap()
}

/// What is displayed of a group. Within clip paths opacity does not matter.
fn group(group: &Group, outer: Transform, in_clip_path: bool) -> PlaneShape {
    assert!(group.mask().is_none() && group.filters().is_empty());
    if group.opacity().get() == 0.0 && !in_clip_path {
        return PlaneShape::default();
    }
    let own = outer.pre_concat(group.transform());
    let mut shapes = Vec::new();
    for child in group.children() {
        match child {
            Node::Group(child) => shapes.push(self::group(child, own, in_clip_path)),
            Node::Path(path) => {
                let fill = path.fill().filter(|fill| fill.opacity().get() > 0.0);
                if let Some(fill) = fill.filter(|_| path.is_visible()) {
                    let rule = match fill.rule() {
                        usvg::FillRule::EvenOdd => FillRule::EvenOdd,
                        usvg::FillRule::NonZero => FillRule::NonZero,
                    };
                    shapes.push(PlaneShape::new(&[rings(path.data(), own)], rule).unwrap());
                }
            }
            other => panic!("no {other:?} in these files"),
        }
    }
    let mut all = union(&shapes);
    let mut next = group.clip_path();
    while let Some(clip) = next {
        all = clipped(&all, clip, own);
        next = clip.clip_path();
    }
    all
}

fn clipped(shape: &PlaneShape, clip: &ClipPath, outer: Transform) -> PlaneShape {
    let region = group(clip.root(), outer.pre_concat(clip.transform()), true);
    PlaneShape::operation(Operation::Intersection, &[shape, &region]).unwrap()
}

/// The rings of a path, curves in many steps.
fn rings(path: &Path, transform: Transform) -> Vec<Vec<DVec2>> {
    const STEPS: usize = 64;
    let matrix =
        [transform.sx, transform.ky, transform.kx, transform.sy, transform.tx, transform.ty];
    let place = DAffine2::from_cols_array(&matrix.map(f64::from));
    let mut rings: Vec<Vec<DVec2>> = Vec::new();
    let mut at = DVec2::ZERO;
    let bezier = |rings: &mut Vec<Vec<DVec2>>, at: DVec2, points: &[DVec2]| {
        for step in 1..=STEPS {
            let t = step as f64 / STEPS as f64;
            // De Casteljau.
            let mut row: Vec<DVec2> = std::iter::once(at).chain(points.iter().copied()).collect();
            while row.len() > 1 {
                row = row.windows(2).map(|pair| pair[0].lerp(pair[1], t)).collect();
            }
            rings.last_mut().unwrap().push(row[0]);
        }
    };
    for segment in path.segments() {
        let point = |p: usvg::tiny_skia_path::Point| dvec2(p.x.into(), p.y.into());
        match segment {
            PathSegment::MoveTo(p) => rings.push(vec![point(p)]),
            PathSegment::LineTo(p) => rings.last_mut().unwrap().push(point(p)),
            PathSegment::QuadTo(a, b) => bezier(&mut rings, at, &[point(a), point(b)]),
            PathSegment::CubicTo(a, b, c) => {
                bezier(&mut rings, at, &[point(a), point(b), point(c)]);
            }
            PathSegment::Close => {}
        }
        if let Some(last) = rings.last().and_then(|ring| ring.last()) {
            at = *last;
        }
    }
    for point in rings.iter_mut().flatten() {
        *point = place.transform_point2(*point) * PIXEL;
    }
    rings
}
