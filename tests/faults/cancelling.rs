//! Every stage that may take long ends soon after it is cancelled.
//!
//! Nothing is asserted about clocks. Each stage gets work that takes far longer
//! than the wait before the cancel; afterwards it may report but a small share
//! of its units and a few times, as a stage that did not listen would go on to
//! the last one.
//! How long it took to answer is printed (`--nocapture`).

// Times are for whoever looks at them.
#![allow(clippy::print_stdout)]

use super::crowds::{Random, in_front_of_one_another, mesh, stl, through_one_another};
use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};
use std::sync::mpsc::{Receiver, Sender, channel};
use std::sync::{Mutex, MutexGuard};
use std::time::{Duration, Instant};
use umriss::drawing::{
    Content, Drawing, DrawingError, DrawingOptions, Effort, Length, Styles, SurfaceOptions,
};
use umriss::kernel::predicates::Exact;
use umriss::model::import::{ImportError, read_bytes_within};
use umriss::model::surface::{CurveOptions, Heights, Surface};
use umriss::model::{
    Camera, Faces, FeatureOptions, LineClass, Mesh, Soup, StandardView, Topology, TopologyError,
    View, interpenetrations,
};
use umriss::polygon::clipping::{FillRule, Operation, PlaneShape, ShapeError};
use umriss::raster::{Samples, methods};
use umriss::run::{Cancelled, Progress, Run};
use umriss::verify::{
    PaintVerifyOptions, RegionVerifyOptions, VerifyOptions, verify, verify_painting, verify_regions,
};
use umriss::view::{ImageRegions, OutlineOf, PreparedSurface, PreparedView};
use umriss::visibility::{
    AppelOptions, HorizonError, Painter, PainterError, PainterOptions, RegionOptions, RegionsError,
    appel, floating_horizon, outlined, paint_order, reduce, reduce_with_crossings, roberts,
    visible_regions,
};

/// How long a stage works before it is cancelled. On a machine where it has
/// ended by then it is made again, and its first report cancels it.
const WAIT: Duration = Duration::from_millis(20);

/// What may still be reported after a cancel: parts that are passed over may
/// report, too.
const MOST_REPORTS: u64 = 10_000;

/// One test at a time: what is measured is the answer, not the crowd.
static ALONE: Mutex<()> = Mutex::new(());

fn alone() -> MutexGuard<'static, ()> {
    ALONE.lock().unwrap_or_else(|poisoned| poisoned.into_inner())
}

/// Hears of one stage, and how much of it is done after the cancel.
struct Listener<'a> {
    stage: &'static str,
    begun: Mutex<Sender<()>>,
    cancel: &'a AtomicBool,
    asked: Mutex<Option<Instant>>,
    /// Whether the first report cancels the stage.
    at_once: bool,
    inside: AtomicBool,
    total: AtomicU64,
    reports: AtomicU64,
    before: AtomicU64,
    after: AtomicU64,
    reports_after: AtomicU64,
    begun_after: Mutex<Vec<&'static str>>,
}

impl Listener<'_> {
    fn ask(&self) {
        self.asked.lock().unwrap().get_or_insert_with(Instant::now);
        self.cancel.store(true, Ordering::SeqCst);
    }
}

impl Progress for Listener<'_> {
    fn begin(&self, stage: &'static str, total: u64) {
        if self.cancel.load(Ordering::SeqCst) {
            self.begun_after.lock().unwrap().push(stage);
        }
        if stage == self.stage && !self.inside.swap(true, Ordering::SeqCst) {
            self.total.store(total, Ordering::SeqCst);
            self.begun.lock().unwrap().send(()).unwrap();
        }
    }

    fn advance(&self, units: u64) {
        let (sum, reports) = match self.cancel.load(Ordering::SeqCst) {
            true => (&self.after, &self.reports_after),
            false => (&self.before, &self.reports),
        };
        if self.inside.load(Ordering::SeqCst) {
            reports.fetch_add(1, Ordering::SeqCst);
            sum.fetch_add(units, Ordering::SeqCst);
            if self.at_once {
                self.ask();
            }
        }
    }

    fn end(&self) {}
}

/// Cancels `work` while it is in a stage; `work` says why it stopped.
fn cancel_in(stage: &'static str, mut work: impl FnMut(&Run<'_>) -> Option<Cancelled>) {
    if !is_cancelled(stage, false, &mut work) {
        assert!(is_cancelled(stage, true, &mut work), "{stage}: it ended in spite of the cancel");
    }
}

/// Whether `work` was stopped by a cancel, after a while or at once; in the
/// first case it is held against what may be done after one.
fn is_cancelled(
    stage: &'static str,
    at_once: bool,
    mut work: impl FnMut(&Run<'_>) -> Option<Cancelled>,
) -> bool {
    let cancel = AtomicBool::new(false);
    let (begun, waiting): (_, Receiver<()>) = channel();
    let listener = Listener {
        stage,
        begun: Mutex::new(begun),
        cancel: &cancel,
        asked: Mutex::new(None),
        at_once,
        inside: AtomicBool::new(false),
        total: AtomicU64::new(0),
        reports: AtomicU64::new(0),
        before: AtomicU64::new(0),
        after: AtomicU64::new(0),
        reports_after: AtomicU64::new(0),
        begun_after: Mutex::new(Vec::new()),
    };
    let run = Run::new(&listener).with_cancel(&cancel);
    let (stopped, ended) = std::thread::scope(|scope| {
        let listener = &listener;
        scope.spawn(move || {
            if waiting.recv().is_ok() {
                std::thread::sleep(WAIT);
                listener.ask();
            }
        });
        let stopped = work(&run);
        let ended = Instant::now();
        // Whoever waits for a stage that never began is let go.
        *listener.begun.lock().unwrap() = channel().0;
        (stopped, ended)
    });
    assert!(listener.inside.load(Ordering::SeqCst), "{stage}: the stage never began");
    let asked = *listener.asked.lock().unwrap();
    let (Some(asked), Some(stopped)) = (asked, stopped) else {
        return false;
    };
    assert_eq!(stopped, Cancelled::Asked, "{stage}");
    let load = |sum: &AtomicU64| sum.load(Ordering::SeqCst);
    let (total, reports) = (load(&listener.total), load(&listener.reports));
    let (before, after) = (load(&listener.before), load(&listener.after));
    println!(
        "{stage:<22} answered in {:>7.1} ms: {before} units before, {after} after, of {total}, {reports} reports",
        ended.saturating_duration_since(asked).as_secs_f64() * 1e3,
    );
    if at_once {
        return true;
    }
    let reports_after = load(&listener.reports_after);
    assert!(reports_after <= MOST_REPORTS, "{stage}: {reports_after} reports after the cancel");
    assert!(after <= total / 2, "{stage}: {after} of {total} units after the cancel");
    assert_eq!(*listener.begun_after.lock().unwrap(), [""; 0], "{stage}: stages after the cancel");
    true
}

fn view(mesh: &Mesh) -> View {
    Camera::Standard(StandardView::from_name("top").unwrap()).view(mesh.bounds()).unwrap()
}

fn every_edge() -> FeatureOptions {
    use LineClass::{Boundary, Contour, Crease, Mesh, NonManifold};
    FeatureOptions::default().with_classes(&[Contour, Boundary, NonManifold, Crease, Mesh])
}

fn import_reason(error: ImportError) -> Option<Cancelled> {
    match error {
        ImportError::Cancelled(cancelled) => Some(cancelled),
        other => panic!("{other}"),
    }
}

#[test]
fn readers() {
    let _alone = alone();
    let mut random = Random::new(1);
    let mut number = || random.next();
    let count = 400_000;
    let points: Vec<String> =
        (0..count).map(|_| format!("{} {} {}\n", number(), number(), number())).collect();
    let obj: String = points.iter().map(|point| format!("v {point}")).collect();
    let obj = obj + "f 1 2 3\n";
    let off = format!("OFF\n{count} 1 0\n{}3 0 1 2\n", points.concat());
    let ply = format!(
        "ply\nformat ascii 1.0\nelement vertex {count}\nproperty double x\nproperty double \
         y\nproperty double z\nend_header\n{}",
        points.concat()
    );
    let facet = |corners: &[String]| {
        let [a, b, c] = [0, 1, 2].map(|i| &corners[i]);
        format!("facet normal 0 0 1\nouter loop\nvertex {a}vertex {b}vertex {c}endloop\nendfacet\n")
    };
    let facets: String = points.chunks_exact(3).map(facet).collect();
    let text = format!("solid s\n{facets}endsolid s\n");
    let files = [
        ("a.obj", obj.into_bytes()),
        ("a.off", off.into_bytes()),
        ("a.ply", ply.into_bytes()),
        ("a.stl", text.into_bytes()),
    ];
    for (name, bytes) in files {
        println!("{name}, {} MB", bytes.len() / 1_000_000);
        cancel_in("reading", |run| {
            run.stage("reading", 1, || match read_bytes_within(name, &bytes, None, run) {
                Ok(_) => None,
                Err(error) => import_reason(error),
            })
        });
    }
}

#[test]
fn meshes_and_topology() {
    let _alone = alone();
    let crowd = through_one_another(300_000);
    cancel_in("mesh", |run| {
        let soup = crowd.clone();
        run.stage("mesh", 1, || match Mesh::within(vec![soup], None, run) {
            Ok(_) => None,
            Err(umriss::model::MeshError::Cancelled(cancelled)) => Some(cancelled),
            Err(other) => panic!("{other}"),
        })
    });
    let mesh = mesh(crowd);
    cancel_in("topology", |run| {
        let options = FeatureOptions::default();
        run.stage("topology", 900_000, || Topology::of(&mesh, &options, run).err())
    });
    cancel_in("interpenetrations", |run| {
        run.stage("interpenetrations", 300_000, || match interpenetrations(&mesh, run) {
            Ok(_) => None,
            Err(TopologyError::Cancelled(cancelled)) => Some(cancelled),
            Err(other) => panic!("{other}"),
        })
    });
    cancel_in("intersections", |run| {
        PreparedView::new::<Exact>(&mesh, &view(&mesh), &FeatureOptions::default(), run).err()
    });
}

#[test]
fn lines_and_what_is_made_of_them() {
    let _alone = alone();
    let mesh = mesh(in_front_of_one_another(900));
    let run = Run::default();
    let prepared = PreparedView::new::<Exact>(&mesh, &view(&mesh), &every_edge(), &run).unwrap();
    let question = prepared.question(true);
    let options = AppelOptions::default();
    cancel_in("appel", |run| appel::<Exact>(&question, &options, run).err());
    cancel_in("roberts", |run| roberts::<Exact>(&question, None, run).err());
    let answer = appel::<Exact>(&question, &options, &run).unwrap();
    println!("{} pieces", answer.piece_count());
    cancel_in("rounding", |run| reduce::<Exact>(&question, &answer, run).err());
    cancel_in("coincident lines", |run| reduce::<Exact>(&question, &answer, run).err());
    cancel_in("crossings", |run| reduce_with_crossings::<Exact>(&question, &answer, run).err());
    cancel_in("outline", |run| {
        outlined::<Exact>(&question, &answer, OutlineOf::Objects, run).err()
    });
    cancel_in("verify", |run| {
        verify::<Exact>(&view(&mesh), &question, &answer, &VerifyOptions::default(), run).err()
    });
}

#[test]
fn faces() {
    let _alone = alone();
    let mesh = mesh(through_one_another(1200));
    let view = view(&mesh);
    let run = Run::default();
    let prepared = PreparedView::new::<Exact>(&mesh, &view, &every_edge(), &run).unwrap();
    let question = prepared.question(false);
    cancel_in("regions", |run| {
        match visible_regions::<Exact>(&question, &RegionOptions::default(), run) {
            Ok(_) => None,
            Err(RegionsError::Cancelled(cancelled)) => Some(cancelled),
            Err(other) => panic!("{other}"),
        }
    });
    for (painter, stage) in [
        (Painter::Graph, "painter-graph"),
        (Painter::Graph, "painter-cycles"),
        (Painter::List, "painter-list"),
        (Painter::Tree, "painter-tree"),
    ] {
        let options = PainterOptions { painter, ..PainterOptions::default() };
        cancel_in(stage, |run| match paint_order::<Exact>(&question, &options, run) {
            Ok(_) => None,
            Err(PainterError::Cancelled(cancelled)) => Some(cancelled),
            Err(other) => panic!("{other}"),
        });
    }
}

#[test]
fn proofs_of_faces() {
    let _alone = alone();
    let mesh = mesh(in_front_of_one_another(250));
    let view = view(&mesh);
    let run = Run::default();
    let prepared = PreparedView::new::<Exact>(&mesh, &view, &every_edge(), &run).unwrap();
    let question = prepared.question(true);
    let answer = appel::<Exact>(&question, &AppelOptions::default(), &run).unwrap();
    let options = RegionVerifyOptions { image_size: 512, ..Default::default() };
    for stage in ["verify-areas", "verify-owners"] {
        cancel_in(stage, |run| {
            verify_regions::<Exact>(&view, &question, &answer, &options, run).err()
        });
    }
    let options = PaintVerifyOptions { image_size: 512, ..Default::default() };
    for stage in ["verify-paint-order", "verify-paint-owners"] {
        cancel_in(stage, |run| verify_painting::<Exact>(&view, &question, &options, run).err());
    }
}

#[test]
fn images() {
    let _alone = alone();
    let mesh = mesh(in_front_of_one_another(1500));
    let view = view(&mesh);
    let run = Run::default();
    let prepared = PreparedView::new::<Exact>(&mesh, &view, &every_edge(), &run).unwrap();
    let question = prepared.question(false);
    let vertices = mesh.vertices().len() as u32;
    let samples = Samples::around(question.frame, question.coordinates, vertices, 1000).unwrap();
    for (name, method) in methods::<Exact>() {
        // What differs from the name is the same method in another form.
        let stage = match name {
            "ray-cast" | "z-buffer" | "span-buffer" | "a-buffer" => name,
            name if name.starts_with("warnock") => "warnock",
            name if name.starts_with("scan") => "scanline",
            _ => continue,
        };
        cancel_in(stage, |run| method(&view, &question, &samples, run).err());
    }
}

#[test]
fn surfaces() {
    let _alone = alone();
    let steps = |name| Heights::steps(name, [-9.0, 9.0], 1000).unwrap();
    let value = |x: f64, z: f64| x.sin() * z.cos();
    let (xs, zs) = (steps('x'), steps('z'));
    let values = zs.iter().flat_map(|&z| xs.iter().map(move |&x| value(x, z))).collect();
    let surface = Surface::new(Heights::new(xs, zs, values).unwrap(), None).unwrap();
    let view = Camera::Standard(StandardView::from_name("iso").unwrap());
    let view = view.view(surface.bounds()).unwrap();
    let run = Run::default();
    let prepared =
        PreparedSurface::new("wave", &surface, &view, &CurveOptions::default(), &run).unwrap();
    let question = prepared.question(true);
    cancel_in("floating horizon", |run| match floating_horizon::<Exact>(&question, run) {
        Ok(_) => None,
        Err(HorizonError::Cancelled(cancelled)) => Some(cancelled),
        Err(other) => panic!("{other}"),
    });
}

#[test]
fn clips() {
    let _alone = alone();
    // Long edges that all cross one another.
    let mut random = Random::new(3);
    let ring: Vec<[f64; 2]> = (0..3000).map(|_| [random.next(), random.next()]).collect();
    let ring = ring.into_iter().map(glam::DVec2::from).collect();
    let shape = PlaneShape::new(&[vec![ring]], FillRule::EvenOdd).unwrap();
    cancel_in("clipping", |run| {
        run.stage("clipping", 1, || {
            match PlaneShape::operation_within(Operation::Union, &[&shape], run) {
                Ok(_) => None,
                Err(ShapeError::Cancelled(cancelled)) => Some(cancelled),
                Err(other) => panic!("{other}"),
            }
        })
    });
}

#[test]
fn pages() {
    let _alone = alone();
    let mesh = mesh(in_front_of_one_another(1000));
    let run = Run::default();
    let prepared = PreparedView::new::<Exact>(&mesh, &view(&mesh), &every_edge(), &run).unwrap();
    let question = prepared.question(true);
    let answer = appel::<Exact>(&question, &AppelOptions::default(), &run).unwrap();
    let (lines, crossings) = reduce_with_crossings::<Exact>(&question, &answer, &run).unwrap();
    println!("{} pieces, {} crossings", lines.pieces.len(), crossings.len());
    let regions = ImageRegions::default();
    let content = Content { lines: &lines, crossings: &crossings, regions: &regions };
    let halo: Length = "0.2mm".parse().unwrap();
    let options = DrawingOptions { halo, ..DrawingOptions::default() };
    let (styles, surfaces) = (Styles::default(), SurfaceOptions::default());
    cancel_in("page", |run| {
        run.stage("page", 1, || {
            match Drawing::of_within(&content, &options, &styles, &surfaces, run) {
                Ok(_) => None,
                Err(DrawingError::Cancelled(cancelled)) => Some(cancelled),
                Err(other) => panic!("{other}"),
            }
        })
    });
    let mut drawing = Drawing::new(&lines, &DrawingOptions::default()).unwrap();
    cancel_in("pen order", |run| {
        let effort = Effort::Steps(1 << 40);
        run.stage("pen order", 1, || drawing.order_within(effort, run).err())
    });
}

/// A binary file is decoded in parallel, faster than anything else here.
#[test]
fn binary_files_stop_between_their_parts() {
    let _alone = alone();
    let bytes = stl(&through_one_another(100_000));
    let cancel = AtomicBool::new(true);
    let run = Run::default().with_cancel(&cancel);
    let stopped = read_bytes_within("a.stl", &bytes, None, &run).map(drop);
    assert_eq!(import_reason(stopped.unwrap_err()), Some(Cancelled::Asked));
    let soup = Soup { faces: Faces::from_triangles(vec![0, 1, 2]), ..Soup::default() };
    assert!(Mesh::within(vec![soup], None, &run).is_err());
}
