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
use umriss::kernel::numbers::{Fraction, Sign};
use umriss::kernel::predicates::{Chart, Exact, Predicates};
use umriss::model::{Camera, FeatureOptions, LineClass, Mesh, Soup, View};
use umriss::polygon::clipping::{Clipper, FillRule, Operand, Operation, Polygon};
use umriss::run::Run;
use umriss::verify::{RegionReport, RegionVerifyOptions, verify_regions};
use umriss::view::PreparedView;
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
