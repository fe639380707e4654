//! `Limits` of a run, and the flags that set them.

use super::crowds::{folder_with, in_front_of_one_another, mesh, names, stl, through_one_another};
use assert_cmd::Command;
use umriss::kernel::predicates::Exact;
use umriss::model::{
    Camera, FeatureOptions, LineClass, Mesh, StandardView, View, interpenetrations,
};
use umriss::run::{Cancelled, Limits, Run};
use umriss::view::PreparedView;
use umriss::visibility::{
    AppelOptions, Painter, PainterError, PainterOptions, RegionOptions, RegionsError, appel,
    paint_order, reduce, reduce_with_crossings, visible_regions,
};

fn view(mesh: &Mesh) -> View {
    Camera::Standard(StandardView::from_name("top").unwrap()).view(mesh.bounds()).unwrap()
}

fn crossings(limit: u64) -> Run<'static> {
    Run::default().with_limits(Limits { crossings: Some(limit), memory: None })
}

fn memory(limit: u64) -> Run<'static> {
    Run::default().with_limits(Limits { crossings: None, memory: Some(limit) })
}

/// Every edge is drawn, nothing more.
fn every_edge() -> FeatureOptions {
    use LineClass::{Boundary, Contour, Crease, Mesh, NonManifold};
    FeatureOptions::default().with_classes(&[Contour, Boundary, NonManifold, Crease, Mesh])
}

#[test]
fn triangles_through_one_another_stop_at_either_limit() {
    let mesh = mesh(through_one_another(3000));
    let options = FeatureOptions::default();
    let run = crossings(100_000);
    let stopped = PreparedView::new::<Exact>(&mesh, &view(&mesh), &options, &run).unwrap_err();
    let expected = Cancelled::TooManyCrossings { limit: 100_000, stage: "intersections" };
    assert_eq!(stopped, expected);
    assert_eq!(run.check(), Err(expected), "what else is asked of the run is told the same");
    let run = memory(20 << 20);
    let stopped = PreparedView::new::<Exact>(&mesh, &view(&mesh), &options, &run).unwrap_err();
    let Cancelled::TooMuchMemory { limit, wanted, stage } = stopped else {
        panic!("{stopped}");
    };
    assert_eq!((limit, stage), (20 << 20, "intersections"));
    // Asked before much more than the limit is there.
    assert!((limit..limit + (4 << 20)).contains(&wanted), "{wanted}");
    let stopped = interpenetrations(&mesh, &crossings(100_000)).unwrap_err();
    assert!(stopped.to_string().contains("more than 100000 crossings"), "{stopped}");
}

#[test]
fn arrays_that_follow_from_the_input_are_refused_before_they_are_made() {
    let soup = through_one_another(3000);
    let stopped = Mesh::within(vec![soup.clone()], None, &memory(100_000)).unwrap_err();
    assert!(stopped.to_string().contains("the limit of this run is 100000"), "{stopped}");
    let bytes = stl(&soup);
    let read = |run: &Run<'_>| {
        umriss::model::import::read_bytes_within("a.stl", &bytes, None, run).map(drop)
    };
    assert!(read(&memory(100_000)).is_err());
    assert!(read(&memory(1 << 30)).is_ok());
    let mesh = mesh(soup);
    let options = FeatureOptions::default();
    let prepared = PreparedView::new::<Exact>(&mesh, &view(&mesh), &options, &memory(100_000));
    assert!(prepared.is_err());
}

#[test]
fn crossings_in_the_image_stop_the_methods() {
    let mesh = mesh(in_front_of_one_another(600));
    let prepared =
        PreparedView::new::<Exact>(&mesh, &view(&mesh), &every_edge(), &Run::default()).unwrap();
    let question = prepared.question(true);
    let options = AppelOptions::default();
    let stopped = appel::<Exact>(&question, &options, &crossings(50_000)).unwrap_err();
    assert_eq!(stopped, Cancelled::TooManyCrossings { limit: 50_000, stage: "appel" });
    let stopped = appel::<Exact>(&question, &options, &memory(5 << 20)).unwrap_err();
    assert!(matches!(stopped, Cancelled::TooMuchMemory { stage: "appel", .. }), "{stopped}");

    let answer = appel::<Exact>(&question, &options, &Run::default()).unwrap();
    let stopped = reduce::<Exact>(&question, &answer, &memory(5 << 20)).unwrap_err();
    assert!(matches!(stopped, Cancelled::TooMuchMemory { stage: "rounding", .. }), "{stopped}");
    let stopped = reduce_with_crossings::<Exact>(&question, &answer, &crossings(50_000));
    let expected = Cancelled::TooManyCrossings { limit: 50_000, stage: "crossings" };
    assert_eq!(stopped.unwrap_err(), expected);

    // A limit that is not reached changes nothing.
    let enough = Limits { crossings: Some(100_000_000), memory: Some(4 << 30) };
    let within = Run::default().with_limits(enough);
    assert_eq!(appel::<Exact>(&question, &options, &within).unwrap(), answer);
}

#[test]
fn regions_and_painting_orders_ask_for_memory() {
    let mesh = mesh(in_front_of_one_another(300));
    let prepared =
        PreparedView::new::<Exact>(&mesh, &view(&mesh), &every_edge(), &Run::default()).unwrap();
    let question = prepared.question(false);
    let few = 40_000;
    let stopped = visible_regions::<Exact>(&question, &RegionOptions::default(), &memory(few));
    let Err(RegionsError::Cancelled(Cancelled::TooMuchMemory { stage: "regions", .. })) = stopped
    else {
        panic!("{stopped:?}");
    };
    for (painter, expected, few) in [
        (Painter::Graph, "painter-graph", 400_000),
        (Painter::List, "painter-list", 400_000),
        (Painter::Tree, "painter-tree", 60_000),
    ] {
        let options = PainterOptions { painter, ..PainterOptions::default() };
        let stopped = paint_order::<Exact>(&question, &options, &memory(few));
        match stopped {
            Err(PainterError::Cancelled(Cancelled::TooMuchMemory { stage, .. })) => {
                assert_eq!(stage, expected);
            }
            other => panic!("{}: {:?}", painter.name(), other.map(|order| order.cuts)),
        }
    }
}

#[test]
fn the_program_says_which_limit_where_and_what_to_do() {
    let folder = folder_with("crowd.stl", &stl(&through_one_another(3000)));
    let fails = |arguments: &str, code: i32| {
        let mut command = Command::new(env!("CARGO_BIN_EXE_umriss"));
        let assert = command.current_dir(folder.path()).args(arguments.split(' ')).assert();
        let output = assert.code(code).get_output().clone();
        assert_eq!(names(folder.path()), ["crowd.stl"]);
        String::from_utf8(output.stderr).unwrap()
    };
    let crossings = "umriss: intersections: more than 100000 crossings, the limit of \
        --max-crossings; expected a model of which less passes through or behind one another, or a \
        higher limit\n";
    for command in ["draw crowd.stl -o a.svg", "verify crowd.stl"] {
        assert_eq!(fails(&format!("{command} --max-crossings 100000"), 1), crossings);
    }
    let told = fails("info crowd.stl --max-crossings 100000", 1);
    assert!(told.starts_with("umriss: interpenetrations: more than 100000"), "{told}");
    let told = fails("draw crowd.stl -o a.svg -o a.json --max-memory 20M", 1);
    let start = "umriss: intersections: 21 MiB of memory wanted, the limit of --max-memory is 20 \
        MiB; expected a smaller model, or a higher limit\n";
    assert_eq!(told, start);
    let told = fails("draw crowd.stl -o a.svg --method painter --max-memory 2M", 1);
    assert!(told.contains("the limit of --max-memory is 2 MiB"), "{told}");
    let told = fails("raster crowd.stl -o a.png --max-memory 100K", 1);
    assert!(told.contains("the limit of --max-memory"), "{told}");
    let told = fails("surface sin(x) --nx 30000 --nz 30000 -o a.svg --max-memory 1G", 1);
    assert!(told.starts_with("umriss: heights: "), "{told}");
    for wrong in ["--max-memory 2X", "--max-memory 0", "--max-crossings -1"] {
        assert!(fails(&format!("draw crowd.stl -o a.svg {wrong}"), 2).starts_with("umriss: "));
    }
}
