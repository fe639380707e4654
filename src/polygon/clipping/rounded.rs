//! Exact shapes to floats and back, valid whatever is rounded.
//!
//! Vertices of the input are doubles and stay where they are; crossings are
//! moved to doubles, each coordinate by less than one unit in its last place.
//! An edge that is moved may run across a vertex next to it, so what was
//! rounded is taken as a new input and all its crossings are found, exactly;
//! where there are any they are rounded in their turn, until there are none
//! (snap rounding, Greene and Yao 1986, Hobby 1999; Halperin and Packer 2002
//! repeat it too). These later crossings are put on an even grid, whose step
//! is one unit in the last place of the largest coordinate, but not out of
//! the box of either edge: near zero doubles are so dense that crossings
//! would come nearer and nearer for a thousand rounds.
//!
//! The exact look back is taken only where edges come so near to one another
//! that rounding can have mattered (`separation`).
//!
//! It ends: a coordinate is from then on one on the grid or one that a vertex
//! has, and these are finitely many. An edge becomes a chain within its box,
//! monotone in x and in y, and every round puts at least one more of their
//! points into a chain. In practice one look back finds nothing, and
//! more than three rounds are rare.

use super::separation::surely_undisturbed;
use super::{FillRule, PlaneShape, Polygon, Ring, ShapeError};
use crate::kernel::predicates::{Chart, Exact, ImageLine, ImagePoint, Predicates};
use glam::DVec2;

/// The rings of a polygon, without closing corners.
type Rings = Vec<Vec<DVec2>>;

/// A shape in floats.
///
/// Always valid: rings are simple, turn as in [`Polygon`], and meet in single
/// points at most; the inside of each polygon is connected.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Rounded {
    /// Polygons of rings that are not closed by a repeated corner.
    pub polygons: Vec<Vec<Vec<DVec2>>>,
    /// How often crossings were rounded. Every corner is nearer than this
    /// times one unit in the last place of the largest coordinate, in x and
    /// in y, to the border of the exact shape. The first round alone moves
    /// each coordinate by less than one unit in its own last place.
    pub rounds: u32,
}

impl Rounded {
    /// As `geo` has it.
    pub fn to_geo(&self) -> geo::MultiPolygon<f64> {
        let ring = |ring: &Vec<DVec2>| {
            let closed = ring.iter().chain(ring.first());
            geo::LineString(closed.map(|corner| geo::Coord { x: corner.x, y: corner.y }).collect())
        };
        let polygon = |rings: &Rings| {
            let mut rings = rings.iter().map(ring);
            let outline = rings.next().unwrap_or_else(|| geo::LineString(Vec::new()));
            geo::Polygon::new(outline, rings.collect())
        };
        geo::MultiPolygon(self.polygons.iter().map(polygon).collect())
    }
}

impl PlaneShape {
    /// The shape of `geo`'s polygons, by their rule: [`FillRule::Polygons`].
    ///
    /// # Errors
    ///
    /// Where a coordinate is not finite.
    pub fn from_geo(polygons: &geo::MultiPolygon<f64>) -> Result<Self, ShapeError> {
        let ring = |ring: &geo::LineString<f64>| -> Vec<DVec2> {
            let open = ring.0.len() - usize::from(ring.is_closed() && ring.0.len() > 1);
            ring.0[..open].iter().map(|corner| DVec2::new(corner.x, corner.y)).collect()
        };
        let rings = |polygon: &geo::Polygon<f64>| -> Rings {
            std::iter::once(polygon.exterior()).chain(polygon.interiors()).map(ring).collect()
        };
        let rings: Vec<Rings> = polygons.iter().map(rings).collect();
        Self::new(&rings, FillRule::Polygons)
    }

    /// The shape in floats; see [`Rounded`] for what is promised and the
    /// module for how. What is narrower than the grid disappears, what is
    /// wider stays.
    ///
    /// # Errors
    ///
    /// Where corners are too many to be numbered, which needs 2^31 of them.
    pub fn rounded(&self) -> Result<Rounded, ShapeError> {
        let own;
        let mut shape = if self.is_result() {
            self
        } else {
            own = self.normalized(false)?;
            &own
        };
        let mut next;
        let mut rounds = 0;
        // What never was rounded is valid already.
        while !shape.is_on_grid() {
            let polygons = shape.round_once(rounds > 0);
            rounds += 1;
            if rounds == 1 && shape.is_surely_still(&polygons) {
                let polygons = polygons.into_iter().map(from_least_corners).collect();
                return Ok(Rounded { polygons, rounds });
            }
            next = Self::new(&polygons, FillRule::Positive)?.normalized(true)?;
            shape = &next;
        }
        let polygons = if rounds == 0 { shape.round_once(false) } else { shape.straightened() };
        Ok(Rounded { polygons, rounds })
    }

    /// The places of all vertices but those between edges on one line.
    fn straightened(&self) -> Vec<Rings> {
        let points = self.points();
        let predicates = Predicates::<Exact>::new(&points);
        let Some(chart) = Chart::new(&points) else {
            return Vec::new();
        };
        let straight = |ring: &Ring| -> Vec<DVec2> {
            let mut before = ring[ring.len() - 1].line;
            let corners = ring.iter().filter_map(|corner| {
                let bends = !predicates.bend(&chart, before, corner.line).is_zero();
                before = corner.line;
                match corner.point {
                    ImagePoint::Vertex(vertex) if bends => Some(self.vertex(vertex)),
                    _ => None,
                }
            });
            corners.collect()
        };
        let rings = |polygon: &Polygon| polygon.rings.iter().map(straight).collect();
        self.polygons().iter().map(rings).collect()
    }

    /// Whether no corner is a crossing.
    fn is_on_grid(&self) -> bool {
        let corners = self.polygons().iter().flat_map(|polygon| &polygon.rings).flatten();
        corners.into_iter().all(|corner| matches!(corner.point, ImagePoint::Vertex(_)))
    }

    /// All rings with their corners rounded; where all edges are between
    /// vertices, crossings stay in the boxes of their edges and are put on
    /// the grid.
    fn round_once(&self, stay: bool) -> Vec<Rings> {
        let points = self.points();
        let predicates = Predicates::<Exact>::new(&points);
        let Some(chart) = Chart::new(&points) else {
            return Vec::new();
        };
        let step = self.grid_step();
        let place = |point: ImagePoint| match point {
            ImagePoint::Vertex(vertex) => self.vertex(vertex),
            ImagePoint::Crossing(lines) => {
                let place = DVec2::from(predicates.round(&chart, point));
                if !stay {
                    return place;
                }
                // Exact, for the step is a power of two.
                let even = (place / step).round() * step;
                lines.iter().fold(even, |place, line| self.boxed(place, line))
            }
        };
        let ring = |ring: &Ring| ring.iter().map(|corner| place(corner.point)).collect();
        let rings = |polygon: &Polygon| polygon.rings.iter().map(ring).collect();
        self.polygons().iter().map(rings).collect()
    }

    /// Whether these polygons, which are those of this shape rounded for the
    /// first time, surely lie as these.
    fn is_surely_still(&self, polygons: &[Rings]) -> bool {
        let rings = self.polygons().iter().zip(polygons).flat_map(|(exact, rounded)| {
            exact.rings.iter().zip(rounded).map(|(exact, rounded)| (&exact[..], &rounded[..]))
        });
        surely_undisturbed(rings)
    }

    /// One unit in the last place of the largest coordinate.
    fn grid_step(&self) -> f64 {
        let vertices = self.polygons().iter().flat_map(|polygon| &polygon.rings).flatten();
        let largest = vertices.fold(0.0_f64, |largest, corner| match corner.point {
            ImagePoint::Vertex(vertex) => largest.max(self.vertex(vertex).abs().max_element()),
            ImagePoint::Crossing(_) => largest,
        });
        largest - largest.next_down()
    }

    /// The place in the box of an edge next to this one.
    fn boxed(&self, place: DVec2, line: &ImageLine) -> DVec2 {
        let ImageLine::Edge([a, b]) = *line else {
            return place;
        };
        let (a, b) = (self.vertex(a), self.vertex(b));
        place.clamp(a.min(b), a.max(b))
    }
}

/// The same rings, each from its least corner on. Exactly that may have been
/// another one, which rounding has put below or above.
fn from_least_corners(mut rings: Rings) -> Rings {
    let order = |a: &DVec2, b: &DVec2| a.x.total_cmp(&b.x).then(a.y.total_cmp(&b.y));
    for ring in &mut rings {
        let least = (0..ring.len()).min_by(|&a, &b| order(&ring[a], &ring[b]));
        ring.rotate_left(least.unwrap_or(0));
    }
    rings
}

#[cfg(test)]
mod tests {
    use super::{FillRule, PlaneShape, Rings};
    use crate::polygon::clipping::Operation;
    use glam::DVec2;
    use proptest::prelude::*;

    /// Rings from their least corners on, sorted.
    fn in_order(mut polygons: Vec<Rings>) -> Vec<Rings> {
        let key = |corner: &DVec2| corner.to_array().map(|x| (x + 0.0).to_bits());
        for rings in &mut polygons {
            for ring in rings.iter_mut() {
                let least = (0..ring.len()).min_by_key(|&i| key(&ring[i])).unwrap_or(0);
                ring.rotate_left(least);
            }
            rings[1..].sort_by_key(|ring| ring.iter().map(key).collect::<Vec<_>>());
        }
        polygons.sort_by_key(|rings| rings[0].iter().map(key).collect::<Vec<_>>());
        polygons
    }

    /// A coordinate: of a few, so that edges meet, or any.
    fn coordinate() -> impl Strategy<Value = f64> {
        prop_oneof![
            (0..6_i32).prop_map(f64::from),
            (0..6_i32, 0..3_u32)
                .prop_map(|(x, ulps)| (0..ulps).fold(f64::from(x), |x, _| x.next_up())),
            0.0..6.0,
        ]
    }

    fn ring() -> impl Strategy<Value = Vec<DVec2>> {
        let corner = (coordinate(), coordinate()).prop_map(|(x, y)| DVec2::new(x, y));
        prop::collection::vec(corner, 3..9)
    }

    proptest! {
        /// Where no second look is taken, it would have found nothing.
        #[test]
        fn a_second_look_changes_nothing(a in ring(), b in ring(), which in 0..4_usize) {
            let [a, b] = [a, b].map(|ring| PlaneShape::new(&[vec![ring]], FillRule::EvenOdd).unwrap());
            let exact = PlaneShape::operation(Operation::ALL[which], &[&a, &b]).unwrap();
            let polygons = exact.round_once(false);
            if exact.is_surely_still(&polygons) {
                let again = PlaneShape::new(&polygons, FillRule::Positive).unwrap();
                let again = again.normalized(true).unwrap();
                prop_assert!(again.is_on_grid());
                prop_assert_eq!(in_order(polygons), in_order(again.straightened()));
            }
        }
    }
}
