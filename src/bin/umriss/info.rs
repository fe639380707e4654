//! `umriss info`: what is in the files, and what is wrong with it.

use crate::failure::Failure;
use crate::line_flags::parse_fold;
use crate::model_flags::ModelFlags;
use crate::models::read_scene;
use crate::outputs::print;
use crate::session::RunFlags;
use clap::Args;
use serde::Serialize;
use std::fmt::{Display, Write};
use std::path::PathBuf;
use umriss::model::{FeatureOptions, Mesh, Scene, Topology, interpenetrations};
use umriss::run::Run;

const EXAMPLES: &str = "\
Examples:
  umriss info part.stl
  umriss info house.obj trees.obj --crease 20
  umriss info part.glb --json > part-info.json";

/// Tell what models hold: faces, edges, units, and defects.
///
/// All models are one scene. Nothing is repaired; a model with defects can
/// be drawn all the same.
#[derive(Args)]
#[command(after_help = EXAMPLES)]
pub(crate) struct Info {
    /// Models; - is standard input
    #[arg(value_name = "MODEL", required = true)]
    models: Vec<PathBuf>,
    /// Print JSON instead of a table
    #[arg(long)]
    json: bool,
    /// Folds of more than this are creases
    #[arg(long, value_name = "DEG", default_value = "30", value_parser = parse_fold)]
    crease: f64,
    #[command(flatten)]
    model: ModelFlags,
    #[command(flatten)]
    session: RunFlags,
}

impl Info {
    /// Runs the command.
    pub(crate) fn run(&self) -> Result<(), Failure> {
        let facts = self.session.run(|run| {
            let scene = read_scene(&self.models, &self.model, &self.session, run)?;
            Facts::of(&scene, &FeatureOptions::default().with_crease_degrees(self.crease), run)
        })?;
        if self.json {
            let text = serde_json::to_string_pretty(&facts)
                .map_err(|error| Failure::failed(error.to_string()))?;
            print(format!("{text}\n").as_bytes())
        } else {
            print(facts.table().as_bytes())
        }
    }
}

/// Everything that is told, in the order of the table.
#[derive(Serialize)]
struct Facts {
    objects: Vec<ObjectFacts>,
    faces: usize,
    triangles: usize,
    vertices: usize,
    loose_lines: usize,
    unit: &'static str,
    bounds: [[f64; 3]; 2],
    size: [f64; 3],
    components: usize,
    closed: bool,
    edges: EdgeFacts,
    /// Vertices that fell together with an equal one; no defect.
    welded_vertices: usize,
    merged_vertices: usize,
    defects: Defects,
}

#[derive(Serialize)]
struct ObjectFacts {
    name: String,
    faces: u32,
    vertices: u32,
}

#[derive(Serialize)]
struct EdgeFacts {
    boundary: usize,
    /// Stretches of boundary edges that lie on others of their object.
    matched: usize,
    /// Stretches of boundary edges that two objects have in common.
    seams: usize,
    non_manifold: usize,
    crease: usize,
    smooth: usize,
}

#[derive(Serialize)]
struct Defects {
    degenerate_faces: usize,
    duplicate_faces: usize,
    nonplanar_faces: usize,
    crossed_faces: usize,
    zero_length_lines: usize,
    inconsistent_edges: usize,
    t_junctions: usize,
    interpenetrations: usize,
}

impl Facts {
    fn of(scene: &Scene, options: &FeatureOptions, run: &Run<'_>) -> Result<Self, Failure> {
        let mesh = &scene.mesh;
        let triangles = mesh.triangles().len();
        let work = triangles as u64;
        let topology = run.stage("topology", work, || Topology::of(mesh, options, run))?;
        let crossing = run.stage("interpenetrations", work, || interpenetrations(mesh, run))?;
        let (low, high) = mesh.bounds();
        let report = mesh.report();
        Ok(Facts {
            objects: objects(mesh),
            faces: mesh.face_count(),
            triangles,
            vertices: mesh.vertices().len(),
            loose_lines: mesh.loose_lines().len(),
            unit: scene.unit.name(),
            bounds: [low.to_array(), high.to_array()],
            size: (high - low).to_array(),
            components: topology.components,
            closed: topology.is_closed(),
            edges: EdgeFacts {
                boundary: topology.boundary_edges,
                matched: topology.matched_borders,
                seams: topology.seams,
                non_manifold: topology.non_manifold_edges,
                crease: topology.crease_edges,
                smooth: topology.smooth_edges,
            },
            welded_vertices: report.welded_vertices,
            merged_vertices: report.merged_vertices,
            defects: Defects {
                degenerate_faces: report.zero_area_faces,
                duplicate_faces: report.duplicate_faces,
                nonplanar_faces: report.nonplanar_faces,
                crossed_faces: report.crossed_faces,
                zero_length_lines: report.zero_length_lines,
                inconsistent_edges: topology.inconsistent_edges,
                t_junctions: topology.t_junctions.len(),
                interpenetrations: crossing.len(),
            },
        })
    }

    fn table(&self) -> String {
        let Facts { edges, defects, .. } = self;
        let triple = |[x, y, z]: [f64; 3]| format!("{x} {y} {z}");
        let closed = match (self.triangles, self.closed) {
            (0, _) => "no surface",
            (_, true) => "closed",
            (_, false) => "open",
        };
        let mut table = Table::default();
        table.row("objects", self.objects.len(), "");
        table.row("faces", self.faces, "");
        table.row("triangles", self.triangles, "");
        table.row("vertices", self.vertices, "");
        table.row("loose lines", self.loose_lines, "");
        table.row("unit", self.unit, "");
        table.row("from", triple(self.bounds[0]), "");
        table.row("to", triple(self.bounds[1]), "");
        table.row("size", triple(self.size), "");
        table.row("surface", closed, "");
        table.row("components", self.components, "parts without a common edge");
        table.row("boundary edges", edges.boundary, "of one face");
        table.row("matched borders", edges.matched, "where some lie on one another");
        table.row("seams", edges.seams, "where those of two objects do");
        table.row("non-manifold edges", edges.non_manifold, "of three faces or more");
        table.row("crease edges", edges.crease, "of two faces, sharp");
        table.row("smooth edges", edges.smooth, "of two faces, flat or nearly");
        table.row("welded vertices", self.welded_vertices, "equal to an earlier one");
        table.row("merged vertices", self.merged_vertices, "moved by --weld");
        table.row("degenerate faces", defects.degenerate_faces, "without area, set aside");
        table.row("duplicate faces", defects.duplicate_faces, "set aside");
        table.row("nonplanar faces", defects.nonplanar_faces, "taken as triangles");
        table.row("crossed faces", defects.crossed_faces, "outlines that cross themselves");
        table.row("zero-length lines", defects.zero_length_lines, "set aside");
        table.row(
            "inconsistent edges",
            defects.inconsistent_edges,
            "faces turn against each other",
        );
        table.row("T-junctions", defects.t_junctions, "vertices inside boundary edges");
        table.row("interpenetrations", defects.interpenetrations, "pairs of faces that cross");
        table.text
    }
}

fn objects(mesh: &Mesh) -> Vec<ObjectFacts> {
    let facts = mesh.objects().iter().map(|object| ObjectFacts {
        name: object.name.clone(),
        faces: object.faces.len() as u32,
        vertices: object.vertices.len() as u32,
    });
    facts.collect()
}

/// Two columns and a remark.
#[derive(Default)]
struct Table {
    text: String,
}

impl Table {
    fn row(&mut self, name: &str, value: impl Display, remark: &str) {
        let value = value.to_string();
        // Writing to a string cannot fail.
        let _ = match remark {
            "" => writeln!(self.text, "{name:<20} {value}"),
            _ => writeln!(self.text, "{name:<20} {value:<10} {remark}"),
        };
    }
}
