//! Scenes in which faces of several objects lie upon one another and touch
//! themselves: what regions show of lines is what Appel's method finds, piece
//! by piece, and every other check of `verify` agrees as well.

use super::scenes::{Random, assert_same_picture, flat_scene, look_at, orthographic, rounds};
use glam::{DVec2, DVec3};
use std::collections::BTreeMap;
use umriss::kernel::predicates::Exact;
use umriss::model::{Camera, FeatureOptions, LineClass, Mesh, Soup, View};
use umriss::run::Run;
use umriss::verify::{
    PaintVerifyOptions, RegionVerifyOptions, VerifyOptions, verify, verify_painting, verify_regions,
};
use umriss::view::PreparedView;
use umriss::visibility::{
    AppelOptions, RegionOptions, appel, reduce, region_lines, visible_regions,
};

/// Parallel rays, or an eye from which the whole scene is in front.
fn camera(random: &mut Random, soups: &[Soup]) -> View {
    let forward = look_at(random);
    if random.one_in(2) {
        return orthographic(forward);
    }
    let vertices = || soups.iter().flat_map(|soup| soup.vertices.iter().copied());
    let low = vertices().fold(DVec3::INFINITY, DVec3::min);
    let high = vertices().fold(DVec3::NEG_INFINITY, DVec3::max);
    let size = (high - low).length().max(1.0);
    // An eye far to one side of a plane, or in it.
    let target = vertices().next().unwrap_or_default();
    let away = (forward.normalize() * (4.0 * size)).round();
    let eye = target - away;
    let up = if (target - eye).truncate() == DVec2::ZERO { DVec3::Y } else { DVec3::Z };
    let (near, target) = (Some(size * 0.125), Some(target));
    let camera = Camera::Perspective { eye, target, up, near, fov_y_degrees: 60.0 };
    camera.view((low, high)).expect("a view")
}

/// Whether the triangles of some face lie upon one another, as those of an
/// outline may that crosses itself: by their areas. Painters paint such a face
/// in any order, for it is of one colour.
fn is_folded(soups: &[Soup], mesh: &Mesh) -> bool {
    let doubled = |corners: &[DVec3]| -> DVec3 {
        (2..corners.len())
            .map(|i| (corners[i - 1] - corners[0]).cross(corners[i] - corners[0]))
            .sum()
    };
    let (mut areas, mut rings) = (BTreeMap::new(), BTreeMap::new());
    for (triangle, corners) in (0..).zip(mesh.triangles()) {
        let corners = corners.map(|vertex| mesh.vertices()[vertex as usize]);
        let soup = &soups[mesh.object_of_triangle(triangle) as usize];
        let ring = soup.faces.rings(mesh.face_number(triangle) as usize).next();
        let ring: Vec<DVec3> =
            ring.unwrap_or_default().iter().map(|&i| soup.vertices[i as usize]).collect();
        rings.insert(mesh.face_of(triangle), doubled(&ring).length());
        *areas.entry(mesh.face_of(triangle)).or_insert(0.0) += doubled(&corners).length();
    }
    rings.iter().any(|(face, ring)| (areas[face] - ring).abs() > 1e-6 * areas[face])
}

/// What was found of a scene.
#[derive(Default)]
struct Found {
    fault: Option<String>,
    pieces: u64,
    painted: bool,
}

/// Runs all checks on a scene.
fn check(soups: &[Soup], view: &View, classes: Option<&[LineClass]>) -> Found {
    let Ok(mesh) = Mesh::new(soups.to_vec(), None) else { return Found::default() };
    let run = Run::default();
    let options = FeatureOptions::default();
    let options = classes.map_or(options, |classes| options.with_classes(classes));
    let prepared = PreparedView::new::<Exact>(&mesh, view, &options, &run).expect("a view");
    let question = prepared.question(true);
    let answer = appel::<Exact>(&question, &AppelOptions::default(), &run).expect("an answer");
    let wish = RegionVerifyOptions { image_size: 16, ..RegionVerifyOptions::default() };
    let regions = verify_regions::<Exact>(view, &question, &answer, &wish, &run).expect("a report");
    let wish = VerifyOptions { image_size: 0, ..VerifyOptions::default() };
    let lines = verify::<Exact>(view, &question, &answer, &wish, &run).expect("a report");
    let mut fault =
        (!(regions.is_clean() && lines.is_clean())).then(|| format!("{regions}{lines}"));
    let painted = fault.is_none() && !is_folded(soups, &mesh);
    if painted {
        let wish = PaintVerifyOptions { image_size: 16, ..PaintVerifyOptions::default() };
        let painting = verify_painting::<Exact>(view, &question, &wish, &run).expect("a report");
        fault = (!painting.is_clean()).then(|| painting.to_string());
    }
    Found { fault, pieces: regions.border.agree, painted }
}

#[test]
fn regions_show_the_lines_that_are_visible_in_flat_scenes() {
    let (mut pieces, mut painted) = (0, 0);
    for seed in 0..rounds(150) {
        let mut random = Random(seed);
        let soups = flat_scene(&mut random);
        let view = camera(&mut random, &soups);
        let classes = random.one_in(2).then_some(&LineClass::ALL[..]);
        let found = check(&soups, &view, classes);
        assert!(found.fault.is_none(), "seed {seed}:\n{}", found.fault.unwrap_or_default());
        pieces += found.pieces;
        painted += u32::from(found.painted);
    }
    assert!(2000 < pieces && 50 < painted, "{pieces} pieces, {painted} scenes painted");
}

#[test]
fn both_methods_draw_the_same_picture_of_flat_scenes() {
    for seed in 1_000_000..1_000_000 + rounds(40) {
        let mut random = Random(seed);
        let soups = flat_scene(&mut random);
        let view = camera(&mut random, &soups);
        let Ok(mesh) = Mesh::new(soups, None) else { continue };
        let run = Run::default();
        let prepared = PreparedView::new::<Exact>(&mesh, &view, &FeatureOptions::default(), &run);
        let prepared = prepared.expect("a view");
        let question = prepared.question(false);
        let answer = appel::<Exact>(&question, &AppelOptions::default(), &run).expect("an answer");
        let regions = visible_regions::<Exact>(&question, &RegionOptions::default(), &run);
        let shown = region_lines::<Exact>(&question, &regions.expect("regions"), &run);
        let [one, other] = [answer, shown.expect("lines")]
            .map(|answer| reduce::<Exact>(&question, &answer, &run).expect("not cancelled"));
        let size = one.pieces.iter().flat_map(|piece| piece.points);
        let size = size.fold(0.0, |size: f64, point| size.max(point.abs().max_element()));
        if size < 1e4 {
            assert_same_picture(&one, &other, &format!("seed {seed}"));
        }
    }
}
