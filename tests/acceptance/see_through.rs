//! An object that is seen through hides nothing, and is drawn as ever.
//!
//! Of triangles anywhere in space, half belong to an object that is seen
//! through. The lines of the other half are those of a scene without it; its
//! own lines are hidden by the other half alone, which Roberts' method says
//! too. With wishes that are all alike, nothing is different from no wishes.

use super::scenes::{Random, assert_same_picture, perspective, polygons, rounds};
use glam::{DVec3, dvec3};
use umriss::kernel::predicates::Exact;
use umriss::model::{FeatureOptions, LineClass, Mesh, Soup, View};
use umriss::run::Run;
use umriss::view::{ObjectWish, PreparedView, VisibleLines};
use umriss::visibility::{AppelOptions, appel, reduce, roberts};

fn triangles(random: &mut Random, count: usize) -> Soup {
    let faces: Vec<Vec<DVec3>> =
        (0..count).map(|_| (0..3).map(|_| random.point()).collect()).collect();
    polygons(&faces, &[])
}

fn features() -> FeatureOptions {
    let classes = LineClass::ALL.into_iter().filter(|class| *class != LineClass::Intersection);
    FeatureOptions::default().with_classes(&classes.collect::<Vec<_>>())
}

/// All lines, by Appel's method or by Roberts'.
fn draw(soups: &[Soup], see_through: &[bool], view: &View, by_roberts: bool) -> VisibleLines {
    let mesh = Mesh::new(soups.to_vec(), None).expect("a mesh");
    let run = Run::default();
    let wish = |&see_through| ObjectWish { features: features(), see_through };
    let wishes: Vec<_> = see_through.iter().map(wish).collect();
    let prepared = PreparedView::with_wishes::<Exact>(&mesh, view, &wishes, &run);
    let prepared = prepared.expect("not cancelled");
    let question = prepared.question(true);
    let answer = if by_roberts {
        roberts::<Exact>(&question, None, &run)
    } else {
        appel::<Exact>(&question, &AppelOptions::default(), &run)
    };
    reduce::<Exact>(&question, &answer.expect("not cancelled"), &run).expect("not cancelled")
}

fn of_object(lines: &VisibleLines, object: u32) -> VisibleLines {
    let mut lines = lines.clone();
    lines.pieces.retain(|piece| piece.object == object);
    lines
}

#[test]
fn what_is_seen_through_hides_nothing() {
    for seed in 0..rounds(40) {
        let mut random = Random(seed);
        let soups = [triangles(&mut random, 9), triangles(&mut random, 9)];
        let view = perspective(dvec3(0.3, 0.2, 5.0), DVec3::NEG_Z, 0.01);
        let both = draw(&soups, &[false, true], &view, false);
        let what = format!("seed {seed}");
        let alone = draw(&soups[..1], &[false], &view, false);
        assert_same_picture(&of_object(&both, 0), &alone, &what);
        assert_eq!(both.pieces, draw(&soups, &[false, true], &view, true).pieces, "{what}");
        let clear = draw(&soups, &[true, true], &view, false);
        assert!(clear.pieces.iter().all(|piece| piece.is_visible()), "{what}");
        let solid = draw(&soups, &[false, false], &view, false);
        assert!(solid.pieces.iter().filter(|piece| piece.is_visible()).count() > 0);
        assert_ne!(solid.pieces, both.pieces, "{what}");
    }
}
