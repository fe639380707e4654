//! Exact predicates: the only place where position is decided.
//!
//! A predicate is the sign of a determinant of input coordinates, or of a
//! small polynomial in such determinants. [`Points`] holds a view's
//! coordinates and its eye, [`Formula`] a polynomial, a [`Policy`] decides
//! its sign: [`Exact`] climbs a ladder of number types until the sign is
//! certain, [`FilterOnly`] and [`Plain`] stop at floats and exist to
//! measure what exactness costs and buys; [`Thorough`] climbs to the top
//! every time and counts where two steps differ. [`Predicates`] puts the three
//! together and counts how often the filter failed.
//!
//! Conventions. `[p, q, r, s]` is the 4 x 4 determinant with homogeneous
//! rows. The eye `E` is a row with `w = 1` (perspective) or `w = 0` (the
//! direction towards an orthographic viewer).
//!
//! ```text
//!   side(p, q, r)        = sign [E, p, q, r]   + : r is left of pq in the image
//!   facing(t)            = side(t0, t1, t2)    0 : t is edge-on
//!   plane(t, x)          = sign [t0, t1, t2, x]
//!   x is behind t       <=> plane(t, x) = facing(t), neither zero
//!   x is inside t's image <=> side(ti, ti+1, x) = facing(t) for i = 0, 1, 2
//! ```
//!
//! "Left" always means a half-space of space, so these hold for points
//! behind a perspective eye too.

mod area;
mod bare;
mod carrier;
mod chart;
mod collinear;
mod column;
mod estimate;
mod eye;
mod fold;
mod formula;
mod image;
mod ladder;
mod offset;
mod parameter;
mod plane;
mod points;
mod probe;
mod ray;
mod sorting;

pub use area::turn_of_ring;
pub use bare::{are_coplanar, compare_lengths, crossing_parameter, orientation};
pub use carrier::{Carrier, Cut, Piercing, Place, Point, Probe};
pub use chart::{Chart, ImageLine, ImagePoint};
pub use collinear::{are_collinear, line_fingerprints};
pub use estimate::Estimate;
pub use eye::{Eye, NearPlane};
pub use fold::{Fold, FoldThreshold};
pub use formula::{Formula, Predicate};
pub use image::Approximation;
pub use ladder::{
    Audited, Exact, FilterOnly, Measured, Plain, Policy, Predicates, Thorough, Unfiltered,
};
pub use parameter::Division;
pub use plane::{InputPlane, Plane, PlanePoint};
pub use points::Points;
pub use sorting::sort_by_predicates;
