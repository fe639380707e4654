//! Models: what files say ([`Soup`]), the mesh made of it ([`Mesh`]), the
//! camera, and which edges are lines for it; [`Topology`] says what is wrong
//! with a mesh. [`surface`] has grids of heights.

mod adjacency;
mod borders;
mod camera;
mod components;
mod convex;
mod crossed;
mod face_places;
mod faces;
mod fans;
mod features;
mod frame;
mod healing;
mod hinge;
pub mod import;
mod intersections;
mod line_class;
mod mesh;
mod plates;
mod precision;
mod sanity;
mod scene;
mod soup;
mod standard_views;
pub mod surface;
mod topology;
mod view_coordinates;
mod weld;
mod world_boxes;

pub use adjacency::Edges;
pub use borders::{BorderSide, Borders, Stretch};
pub use camera::{Camera, CameraError, View};
pub use convex::ConvexParts;
pub use face_places::{FacePlace, FacePlaces};
pub use fans::Fans;
pub use features::{EffectiveEdge, FeatureLine, FeatureOptions, Features, LineOrigin, facing};
pub use frame::{Frame, Projection};
pub use healing::{HealReport, TornBorders, heal, torn_borders};
pub use hinge::Hinge;
pub use intersections::{
    EdgePiercings, IntersectionLine, Intersections, Known, triangle_hierarchy,
};
pub use line_class::LineClass;
pub use mesh::{Mesh, MeshError, MeshReport, Object};
pub use precision::Precision;
pub use scene::{Scene, SceneOptions};
pub use soup::{Color, Faces, Placement, Soup, Unit, UpAxis};
pub use standard_views::StandardView;
pub use topology::{TJunction, Topology, TopologyError, interpenetrations};
pub use view_coordinates::{RoughPoint, VertexBoxes, ViewCoordinates};
