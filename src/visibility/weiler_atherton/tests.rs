//! Scenes whose regions are known.

use super::{RegionFault, RegionOptions, image_regions, visible_regions};
use crate::kernel::predicates::Exact;
use crate::model::{Camera, FeatureOptions, Mesh, Soup};
use crate::run::Run;
use crate::view::{ImageRegion, PreparedView};
use glam::{DVec2, DVec3, dvec3};

fn mesh(faces: &[&[DVec3]]) -> Mesh {
    let mut soup = Soup::default();
    for face in faces {
        let first = soup.vertices.len() as u32;
        soup.vertices.extend_from_slice(face);
        let ring: Vec<u32> = (first..soup.vertices.len() as u32).collect();
        soup.faces.push(&ring, []);
    }
    Mesh::new(vec![soup], None).expect("a mesh")
}

/// From above, with x to the right and y upwards.
fn above() -> Camera {
    Camera::Orthographic { forward: -DVec3::Z, target: Some(DVec3::ZERO), up: DVec3::Y }
}

fn regions_with(faces: &[&[DVec3]], camera: &Camera, options: RegionOptions) -> Vec<ImageRegion> {
    let (mesh, run) = (mesh(faces), Run::default());
    let view = camera.view(mesh.bounds()).expect("a view");
    let prepared = PreparedView::new::<Exact>(&mesh, &view, &FeatureOptions::default(), &run);
    let prepared = prepared.expect("a view");
    let question = prepared.question(false);
    let regions = visible_regions::<Exact>(&question, &options, &run).expect("regions");
    image_regions(&question, &regions).expect("regions").regions
}

fn regions(faces: &[&[DVec3]], camera: &Camera) -> Vec<ImageRegion> {
    regions_with(faces, camera, RegionOptions::default())
}

fn area(region: &ImageRegion) -> f64 {
    let ring = |ring: &Vec<DVec2>| -> f64 {
        let next = ring.iter().cycle().skip(1);
        ring.iter().zip(next).map(|(a, b)| a.perp_dot(*b)).sum::<f64>() * 0.5
    };
    region.polygons.iter().flatten().map(ring).sum()
}

/// Faces and the areas of what is seen of them.
fn areas(regions: &[ImageRegion]) -> Vec<(u32, f64)> {
    regions.iter().map(|region| (region.face, (area(region) * 1e9).round() / 1e9)).collect()
}

fn square(x: [f64; 2], y: [f64; 2], z: f64) -> [DVec3; 4] {
    [dvec3(x[0], y[0], z), dvec3(x[1], y[0], z), dvec3(x[1], y[1], z), dvec3(x[0], y[1], z)]
}

#[test]
fn a_square_leaves_a_hole_in_the_one_behind_it() {
    let (far, near) = (square([0.0, 4.0], [0.0, 4.0], 0.0), square([1.0, 2.0], [1.0, 3.0], 1.0));
    let found = regions(&[&far, &near], &above());
    assert_eq!(areas(&found), [(0, 14.0), (1, 2.0)]);
    assert_eq!(found[0].polygons.len(), 1);
    assert_eq!(found[0].polygons[0].iter().map(Vec::len).collect::<Vec<_>>(), [4, 4]);
    assert_eq!(found[0].normal, DVec3::Z);
}

#[test]
fn three_bars_each_over_the_next() {
    // Each bar slopes: it is above the next one and below the one before.
    let bar = |turn: usize| -> [DVec3; 4] {
        let corner = |along: f64, across: f64| {
            let angle = std::f64::consts::TAU / 3.0 * turn as f64;
            let (x, y) = (along, across + 1.0);
            DVec3::new(
                x * angle.cos() - y * angle.sin(),
                x * angle.sin() + y * angle.cos(),
                along * 0.125,
            )
        };
        [corner(-6.0, -0.25), corner(6.0, -0.25), corner(6.0, 0.25), corner(-6.0, 0.25)]
    };
    let bars = [bar(0), bar(1), bar(2)];
    let found = regions(&[&bars[0], &bars[1], &bars[2]], &above());
    let pieces: Vec<usize> = found.iter().map(|region| region.polygons.len()).collect();
    // Each is cut in two where it passes below another one. Rounded corners
    // are not coplanar, so a bar may be two triangles.
    assert_eq!(found.iter().map(|region| region.face).max(), Some(2));
    assert!(pieces.iter().sum::<usize>() >= 6);
    let all: f64 = found.iter().map(area).sum();
    let overlap = 0.5 * 0.5 / (std::f64::consts::TAU / 6.0).sin();
    assert!((all - 3.0 * (6.0 - overlap)).abs() < 1e-9, "{all}");
}

#[test]
fn squares_that_pass_through_one_another_share_the_image() {
    let flat = square([0.0, 4.0], [0.0, 4.0], 1.0);
    let steep =
        [dvec3(0.0, 0.0, 0.0), dvec3(4.0, 0.0, 4.0), dvec3(4.0, 4.0, 4.0), dvec3(0.0, 4.0, 0.0)];
    let found = regions(&[&flat, &steep], &above());
    assert_eq!(areas(&found), [(0, 4.0), (1, 12.0)]);
    let found = regions(&[&steep, &flat], &above());
    assert_eq!(areas(&found), [(0, 12.0), (1, 4.0)]);
}

#[test]
fn coplanar_triangles_go_by_their_least_corners() {
    let low = [dvec3(0.0, 0.0, 0.0), dvec3(4.0, 0.0, 0.0), dvec3(0.0, 4.0, 0.0)];
    let high = [dvec3(1.0, 0.0, 0.0), dvec3(5.0, 0.0, 0.0), dvec3(1.0, 4.0, 0.0)];
    assert_eq!(areas(&regions(&[&low, &high], &above())), [(0, 8.0), (1, 3.5)]);
    assert_eq!(areas(&regions(&[&high, &low], &above())), [(0, 3.5), (1, 8.0)]);
}

#[test]
fn polygons_that_overlap_alternately() {
    // Two U shapes of which each lies over one arm of the other.
    let u = |height: [f64; 2]| -> Vec<DVec3> {
        let at = |x: f64, y: f64| dvec3(x, y, height[0] + (height[1] - height[0]) * x / 4.0);
        vec![
            at(0.0, 0.0),
            at(4.0, 0.0),
            at(4.0, 4.0),
            at(3.0, 4.0),
            at(3.0, 1.0),
            at(1.0, 1.0),
            at(1.0, 4.0),
            at(0.0, 4.0),
        ]
    };
    let first = u([0.0, 4.0]);
    let second: Vec<DVec3> = u([3.0, 1.0]).iter().map(|p| dvec3(p.x, 5.0 - p.y, p.z)).collect();
    let found = regions(&[&first, &second], &above());
    // Both have an area of ten; arms overlap in two strips of 1 x 3.
    assert_eq!(areas(&found), [(0, 7.0), (1, 7.0)]);
}

#[test]
fn faces_end_at_the_near_plane() {
    // A floor that goes on behind the eye, and a wall that stands on it.
    let floor = [
        dvec3(-9.0, -9.0, 0.0),
        dvec3(9.0, -9.0, 0.0),
        dvec3(9.0, 9.0, 0.0),
        dvec3(-9.0, 9.0, 0.0),
    ];
    let wall =
        [dvec3(-1.0, 4.0, 0.0), dvec3(1.0, 4.0, 0.0), dvec3(1.0, 4.0, 2.0), dvec3(-1.0, 4.0, 2.0)];
    let camera = Camera::Perspective {
        eye: dvec3(0.0, 0.0, 1.0),
        target: Some(dvec3(0.0, 1.0, 1.0)),
        up: DVec3::Z,
        near: Some(0.5),
        fov_y_degrees: 60.0,
    };
    let found = regions(&[&floor, &wall], &camera);
    let lowest = found[0].polygons.iter().flatten().flatten().map(|p| p.y).fold(0.0, f64::min);
    // One below the eye, half in front of it.
    assert_eq!(lowest, -2.0);
    assert_eq!(areas(&found[1..]), [(1, 0.25)]);
    let highest = found[0].polygons.iter().flatten().flatten().map(|p| p.y).fold(-9.0, f64::max);
    assert!((highest + 1.0 / 9.0).abs() < 1e-12);
}

#[test]
fn what_was_forgotten_shows() {
    let (far, near) = (square([0.0, 4.0], [0.0, 4.0], 0.0), square([1.0, 2.0], [1.0, 3.0], 1.0));
    let broken = RegionOptions { fault: Some(RegionFault::ForgetOccluder) };
    let found = regions_with(&[&far, &near], &above(), broken);
    assert_ne!(areas(&found), [(0, 14.0), (1, 2.0)]);
}
