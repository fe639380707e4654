//! Regions are what is seen: no two overlap, together they are the images of
//! all faces, the face at a place is the nearest one, and their borders are
//! the visible lines.
//!
//! `verify_regions` holds them against rays, images and Appel's lines; here it
//! does so on random soups that are as degenerate as they can be made, and
//! what must not matter is changed: the order of faces, their winding.

use super::scenes::{
    Kind, Random, orthographic, perspective, polygons, random_camera, random_soups, rounds,
};
use glam::{DVec3, dvec3};
use std::cmp::Ordering;
use umriss::kernel::numbers::{Fraction, Sign};
use umriss::kernel::predicates::{Carrier, Chart, Cut, Exact, Place, Predicates};
use umriss::model::{Camera, FeatureOptions, LineClass, Mesh, Soup, View};
use umriss::polygon::clipping::{Clipper, FillRule, Operand, Operation, Polygon};
use umriss::run::Run;
use umriss::verify::{RegionReport, RegionVerifyOptions, verify_regions};
use umriss::view::{LineQuestion, PreparedView};
use umriss::visibility::{
    AppelOptions, RegionFault, RegionOptions, appel, image_regions, reduce, region_lines,
    visible_regions,
};

fn check(soups: &[Soup], view: &View, fault: Option<RegionFault>) -> Option<RegionReport> {
    let mesh = Mesh::new(soups.to_vec(), None).ok()?;
    let run = Run::default();
    let options = FeatureOptions::default().with_classes(&LineClass::ALL);
    let prepared = PreparedView::new::<Exact>(&mesh, view, &options, &run).expect("a view");
    let question = prepared.question(true);
    let answer = appel::<Exact>(&question, &AppelOptions::default(), &run).expect("an answer");
    let options = RegionVerifyOptions { image_size: 32, fault, ..RegionVerifyOptions::default() };
    Some(verify_regions::<Exact>(view, &question, &answer, &options, &run).expect("a report"))
}

#[test]
fn random_soups_are_what_rays_and_lines_say() {
    let mut checked = 0;
    for kind in Kind::ALL {
        for seed in 0..rounds(40) {
            let mut random = Random(seed);
            let soups = random_soups(&mut random, kind);
            let view = random_camera(&mut random, &soups);
            let Some(report) = check(&soups, &view, None) else {
                continue;
            };
            assert!(report.is_clean(), "{kind:?} seed {seed}:\n{report}");
            checked += report.owner.agree + report.border.agree;
        }
    }
    assert!(checked > 1000, "only {checked} places were compared");
}

#[test]
fn a_forgotten_face_is_found_out() {
    let found = (0..20).filter(|&seed| {
        let mut random = Random(seed);
        let soups = random_soups(&mut random, Kind::General);
        let view = random_camera(&mut random, &soups);
        let fault = Some(RegionFault::ForgetOccluder);
        check(&soups, &view, fault).is_some_and(|report| !report.is_clean())
    });
    assert!(found.count() > 5);
}

/// Whether a part of a line between two places is visible, by the definition:
/// on either side no face is in front that is seen at all. Nothing if a line
/// lies just behind the cut of a face by the near plane.
fn is_visible(
    question: &LineQuestion<'_>,
    predicates: &Predicates<'_, Exact>,
    carrier: Carrier,
    places: [Place; 2],
) -> Option<bool> {
    let inside = |cut| predicates.between(carrier, places, cut);
    let near = question.points.has_near_plane();
    if near && inside(Cut::Near) != Sign::Positive {
        return Some(false);
    }
    let mut hidden = [false; 2];
    for (&[a, b, c], &facing) in question.mesh.triangles().iter().zip(question.facing) {
        if facing.is_zero() || inside(Cut::Face([a, b, c])) != facing {
            continue;
        }
        let mut covers = [true; 2];
        for (edge, third) in [([a, b], c), ([b, c], a), ([c, a], b)] {
            match inside(Cut::Silhouette(edge)) * facing {
                Sign::Positive => {}
                Sign::Negative => covers = [false; 2],
                Sign::Zero => {
                    let left = predicates.image_side(carrier, third) == Sign::Positive;
                    covers = [covers[0] && left, covers[1] && !left];
                }
            }
        }
        if near && covers.contains(&true) {
            // In which sense the ray meets the face beyond the near plane.
            match inside(Cut::NearLine([a, b, c])) * facing {
                Sign::Negative => {}
                Sign::Positive => covers = [false; 2],
                Sign::Zero => return None,
            }
        }
        hidden = [hidden[0] || covers[0], hidden[1] || covers[1]];
    }
    Some(!hidden.contains(&true))
}

/// All places of a line at which something may begin or end, in their order.
fn all_places(
    question: &LineQuestion<'_>,
    predicates: &Predicates<'_, Exact>,
    carrier: Carrier,
) -> Vec<Place> {
    let near = question.points.has_near_plane();
    let faces = question.mesh.triangles().iter().flat_map(|&[a, b, c]| {
        let edges = [[a, b], [b, c], [c, a]].map(Cut::Silhouette);
        let face = [a, b, c];
        edges.into_iter().chain([Cut::Face(face)]).chain(near.then_some(Cut::NearLine(face)))
    });
    let values = |cut| carrier.ends.map(|end| predicates.value(cut, end));
    let mut cuts: Vec<_> = faces
        .chain(near.then_some(Cut::Near))
        .map(|cut| (cut, values(cut)))
        .filter(|(_, [a, b])| a.sign.is_opposite(b.sign))
        .collect();
    cuts.sort_by(|(a, va), (b, vb)| predicates.order(carrier, (*a, va), (*b, vb)));
    cuts.dedup_by(|(a, va), (b, vb)| predicates.order(carrier, (*a, va), (*b, vb)).is_eq());
    let cuts = cuts.into_iter().map(|(cut, _)| Place::Cut(cut));
    [Place::Start].into_iter().chain(cuts).chain([Place::End]).collect()
}

#[test]
fn regions_show_what_is_visible_by_definition_wherever_the_near_plane_is() {
    let mut compared = 0;
    for seed in 0..rounds(20) {
        for kind in Kind::ALL {
            let mut random = Random(seed);
            let soups = random_soups(&mut random, kind);
            let view = random_camera(&mut random, &soups);
            let Ok(mesh) = Mesh::new(soups, None) else { continue };
            let run = Run::default();
            let options = FeatureOptions::default().with_classes(&LineClass::ALL);
            let prepared = PreparedView::new::<Exact>(&mesh, &view, &options, &run);
            let prepared = prepared.expect("a view");
            let question = prepared.question(true);
            let regions = visible_regions::<Exact>(&question, &RegionOptions::default(), &run);
            let shown = region_lines::<Exact>(&question, &regions.expect("regions"), &run);
            let shown = shown.expect("lines");
            let predicates = Predicates::<Exact>::new(question.points);
            for (i, line) in question.lines.iter().enumerate() {
                let carrier = question.carrier(line);
                if predicates.axis_across(carrier).is_none() {
                    assert_eq!(shown.line(i), [], "{kind:?} seed {seed} line {i}");
                    continue;
                }
                let order = |a, b| place_order(&predicates, carrier, a, b);
                let places = all_places(&question, &predicates, carrier);
                let ends = shown.line(i).iter().flat_map(|piece| [piece.from, piece.to]);
                for end in ends {
                    let known = places.iter().any(|place| order(*place, end).is_eq());
                    assert!(known, "{kind:?} seed {seed} line {i}: {end:?}");
                }
                for pair in places.windows(2) {
                    let [from, to] = [pair[0], pair[1]];
                    let visible = is_visible(&question, &predicates, carrier, [from, to]);
                    let found = shown.line(i).iter().any(|piece| {
                        order(piece.from, from).is_le() && order(to, piece.to).is_le()
                    });
                    if let Some(visible) = visible {
                        let what = format!("{kind:?} seed {seed} line {i} from {from:?} to {to:?}");
                        assert_eq!(found, visible, "{what}");
                        compared += 1;
                    }
                }
            }
        }
    }
    assert!(compared > 10_000, "{compared}");
}

/// Which of two places of a line comes first.
fn place_order(
    predicates: &Predicates<'_, Exact>,
    carrier: Carrier,
    first: Place,
    second: Place,
) -> Ordering {
    match (first, second) {
        (Place::Start, Place::Start) | (Place::End, Place::End) => Ordering::Equal,
        (Place::Start, _) | (_, Place::End) => Ordering::Less,
        (_, Place::Start) | (Place::End, _) => Ordering::Greater,
        (Place::Cut(first), Place::Cut(second)) => {
            let values = |cut| carrier.ends.map(|end| predicates.value(cut, end));
            let [a, b] = [first, second].map(values);
            predicates.order(carrier, (first, &a), (second, &b))
        }
    }
}

/// The exact area of polygons in the chart of a view.
fn area(predicates: &Predicates<'_, Exact>, chart: &Chart, polygons: &[Polygon]) -> Fraction {
    let mut terms = Vec::new();
    for ring in polygons.iter().flat_map(|polygon| &polygon.rings) {
        let ratios: Vec<_> =
            ring.iter().map(|corner| predicates.ratio(chart, corner.point)).collect();
        for (i, (a, v)) in ratios.iter().enumerate() {
            let (b, w) = &ratios[(i + 1) % ratios.len()];
            let cross = a[0].clone() * b[1].clone() - a[1].clone() * b[0].clone();
            terms.extend(Fraction::new(cross, v.clone() * w.clone()));
        }
    }
    Fraction::sum(&terms)
}

#[test]
fn areas_of_regions_add_up_to_that_of_the_union_exactly() {
    let mut compared = 0;
    for seed in 0..rounds(12) {
        let mut random = Random(seed);
        let kind = Kind::ALL[seed as usize % Kind::ALL.len()];
        let soups = random_soups(&mut random, kind);
        let forward = random.point();
        let view = match seed % 2 {
            0 => orthographic(forward),
            // From so far that everything is in front.
            _ => perspective(forward.normalize() * -64.0, forward, 1.0),
        };
        let Ok(mesh) = Mesh::new(soups, None) else {
            continue;
        };
        let (run, options) = (Run::default(), FeatureOptions::default());
        let prepared = PreparedView::new::<Exact>(&mesh, &view, &options, &run).expect("a view");
        let question = prepared.question(false);
        let options = RegionOptions::default();
        let regions = visible_regions::<Exact>(&question, &options, &run).expect("regions");
        let predicates = Predicates::<Exact>::new(question.points);
        let clipper = Clipper::new(&predicates).expect("a front");
        let images: Vec<Polygon> = mesh
            .triangles()
            .iter()
            .zip(question.facing)
            .filter(|(_, facing)| !facing.is_zero())
            .map(|([a, b, c], facing)| match facing {
                Sign::Positive => Polygon::of_vertices([[*a, *b, *c]]),
                _ => Polygon::of_vertices([[*a, *c, *b]]),
            })
            .collect();
        let union = Operand::new(&images, FillRule::Positive);
        let union = clipper.operation(Operation::Union, &[union]);
        let seen: Vec<Polygon> =
            regions.regions().iter().flat_map(|region| region.polygons.clone()).collect();
        let [whole, parts] = [&union, &seen].map(|all| area(&predicates, clipper.chart(), all));
        assert!((whole - parts).sign().is_zero(), "{kind:?} seed {seed}");
        compared += seen.len();
    }
    assert!(compared > 20, "only {compared} polygons");
}

/// Corners of all regions of a soup of triangles, whatever their order.
fn corners(faces: &[Vec<DVec3>], view: &View) -> Vec<Vec<[u64; 2]>> {
    let mesh = Mesh::new(vec![polygons(faces, &[])], None).expect("a mesh");
    let run = Run::default();
    let options = FeatureOptions::default();
    let prepared = PreparedView::new::<Exact>(&mesh, view, &options, &run).expect("a view");
    let question = prepared.question(false);
    let regions = visible_regions::<Exact>(&question, &RegionOptions::default(), &run);
    let regions = image_regions(&question, &regions.expect("regions")).expect("regions");
    let mut all: Vec<Vec<[u64; 2]>> = Vec::new();
    for region in regions.regions {
        let corners = region.polygons.iter().flatten().flatten();
        // Names of corners may differ, and then they round differently.
        let rounded = corners.map(|p| p.to_array().map(|x| (x * 1e6).round() as i64 as u64));
        all.push(rounded.collect());
    }
    all.sort();
    all
}

#[test]
fn neither_order_nor_winding_of_faces_matters() {
    for seed in 0..rounds(20) {
        let mut random = Random(seed);
        let mut faces: Vec<Vec<DVec3>> =
            (0..9).map(|_| (0..3).map(|_| random.grid_point(5)).collect()).collect();
        faces.push((0..3).map(|_| random.point() * 4.0).collect());
        let view = orthographic(random.point());
        if Mesh::new(vec![polygons(&faces, &[])], None).is_err() {
            continue;
        }
        let expected = corners(&faces, &view);
        faces.reverse();
        faces.iter_mut().step_by(2).for_each(|face| face.reverse());
        assert_eq!(corners(&faces, &view), expected, "seed {seed}");
    }
}

#[test]
fn a_line_ends_where_the_near_plane_cuts_another_face() {
    // A catwalk from behind the eye, and a wall beyond its end that reaches
    // far up and down: its left side shows above and below.
    let walk = [
        dvec3(-0.25, -9.0, 0.0),
        dvec3(0.25, -9.0, 0.0),
        dvec3(0.25, 9.0, 0.0),
        dvec3(-0.25, 9.0, 0.0),
    ];
    let wall = [
        dvec3(1.0, 10.0, -30.0),
        dvec3(20.0, 10.0, -30.0),
        dvec3(20.0, 10.0, 5.0),
        dvec3(1.0, 10.0, 5.0),
    ];
    let camera = Camera::Perspective {
        eye: dvec3(0.0, 0.0, 1.0),
        target: Some(dvec3(0.0, 1.0, 1.0)),
        up: DVec3::Z,
        near: Some(0.5),
        fov_y_degrees: 60.0,
    };
    let mesh = Mesh::new(vec![polygons(&[walk, wall], &[])], None).expect("a mesh");
    let run = Run::default();
    let view = camera.view(mesh.bounds()).expect("a view");
    let prepared = PreparedView::new::<Exact>(&mesh, &view, &FeatureOptions::default(), &run);
    let prepared = prepared.expect("a view");
    let question = prepared.question(false);
    let regions = visible_regions::<Exact>(&question, &RegionOptions::default(), &run);
    let lines = region_lines::<Exact>(&question, &regions.expect("regions"), &run);
    let drawn = reduce::<Exact>(&question, &lines.expect("lines"), &run).expect("not cancelled");
    let mut side: Vec<[f64; 2]> = drawn
        .pieces
        .iter()
        .filter(|piece| piece.points.iter().all(|point| (point.x - 0.1).abs() < 1e-12))
        .map(|piece| piece.points.map(|point| point.y))
        .map(|[a, b]| [a.min(b), a.max(b)])
        .collect();
    side.sort_by(|a, b| a[0].total_cmp(&b[0]));
    // The walk is cut half in front of the eye, one below it.
    for (found, expected) in side.iter().flatten().zip([-3.1, -2.0, -0.4, 0.4]) {
        assert!((found - expected).abs() < 1e-12, "{side:?}");
    }
    assert_eq!(side.len(), 2);
}
