//! Shapes of the plane: polygons that own their coordinates.
//!
//! The plane is a view like any other: points `(x, y, 0)` with the eye
//! `(0, 0, 1, 0)`. An operation numbers the vertices of all its operands
//! anew; its result keeps those it names.

use super::{Clipper, Corner, FillRule, Operand, Operation, Polygon, Ring};
use crate::kernel::numbers::Fraction;
use crate::kernel::predicates::{Chart, Exact, Eye, Points, Predicates};
use crate::run::{Cancelled, Run};
use glam::{DVec2, DVec3};

/// Why coordinates are no shape.
#[derive(Debug, Clone, Copy, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum ShapeError {
    /// Ring `ring` of polygon `polygon` has a coordinate that is infinite or
    /// not a number.
    #[error("ring {ring} of polygon {polygon} has a coordinate that is not finite")]
    NotFinite {
        /// Which polygon, counted from zero.
        polygon: usize,
        /// Which of its rings, counted from zero.
        ring: usize,
    },
    /// There are more than 2^31 corners.
    #[error("there are more corners than 32 bits can number")]
    TooMany,
    /// The run was stopped.
    #[error(transparent)]
    Cancelled(#[from] Cancelled),
}

/// The most vertices of an operation.
const MOST: usize = 1 << 31;

/// A set of rings in the plane with a fill rule, or an exact result of
/// operations on such sets.
///
/// ```
/// use glam::dvec2;
/// use umriss::polygon::clipping::{FillRule, Operation, PlaneShape};
///
/// let square = |low: f64, high: f64| {
///     let ring = vec![dvec2(low, low), dvec2(high, low), dvec2(high, high), dvec2(low, high)];
///     PlaneShape::new(&[vec![ring]], FillRule::EvenOdd)
/// };
/// let (a, b) = (square(0.0, 2.0)?, square(1.0, 3.0)?);
/// let both = PlaneShape::operation(Operation::Intersection, &[&a, &b])?;
/// assert_eq!(both.area().to_f64(), 1.0);
/// let all = PlaneShape::operation(Operation::Union, &[&a, &b, &both])?;
/// assert_eq!(all.polygons().len(), 1);
/// assert_eq!(all.polygons()[0].outline().len(), 8);
/// # Ok::<(), umriss::polygon::clipping::ShapeError>(())
/// ```
#[derive(Debug, Clone, Default)]
pub struct PlaneShape {
    vertices: Vec<DVec3>,
    polygons: Vec<Polygon>,
    rule: FillRule,
    /// Whether the polygons are as operations return them.
    is_result: bool,
}

impl PlaneShape {
    /// The shape of polygons, each a list of rings that are not closed by a
    /// repeated corner. Nothing is asked of the rings but finite numbers;
    /// rings of less than three corners enclose nothing.
    ///
    /// # Errors
    ///
    /// Where a coordinate is not finite.
    pub fn new(polygons: &[Vec<Vec<DVec2>>], rule: FillRule) -> Result<Self, ShapeError> {
        let corners: usize = polygons.iter().flatten().map(Vec::len).sum();
        if corners > MOST {
            return Err(ShapeError::TooMany);
        }
        let mut shape =
            PlaneShape { vertices: Vec::with_capacity(corners), rule, ..Self::default() };
        for (polygon, rings) in polygons.iter().enumerate() {
            let mut numbers = Vec::with_capacity(rings.len());
            for (ring, corners) in rings.iter().enumerate() {
                if !corners.iter().all(|corner| corner.is_finite()) {
                    return Err(ShapeError::NotFinite { polygon, ring });
                }
                let first = shape.vertices.len() as u32;
                shape.vertices.extend(corners.iter().map(|corner| corner.extend(0.0)));
                numbers.push((first..shape.vertices.len() as u32).collect::<Vec<u32>>());
            }
            shape.polygons.push(Polygon::of_vertices(numbers));
        }
        Ok(shape)
    }

    /// The polygons, with vertices numbered as in [`Self::points`]: as given,
    /// or the exact result of an operation.
    pub fn polygons(&self) -> &[Polygon] {
        &self.polygons
    }

    /// What is inside of the rings; of results [`FillRule::Positive`].
    pub fn rule(&self) -> FillRule {
        self.rule
    }

    /// Whether the polygons are as operations return them.
    pub(super) fn is_result(&self) -> bool {
        self.is_result
    }

    /// The vertices, for predicates on corners.
    pub fn points(&self) -> Points {
        plane(&self.vertices)
    }

    /// An operation on any number of shapes: exact, see [`super::Clipper`].
    ///
    /// # Errors
    ///
    /// Where the shapes have more than 2^31 vertices.
    pub fn operation(operation: Operation, shapes: &[&PlaneShape]) -> Result<Self, ShapeError> {
        Self::operation_within(operation, shapes, &Run::default())
    }

    /// The same, asking a run whether to go on.
    ///
    /// # Errors
    ///
    /// As [`Self::operation`]; and if the run is cancelled or reaches a limit.
    pub fn operation_within(
        operation: Operation,
        shapes: &[&PlaneShape],
        run: &Run<'_>,
    ) -> Result<Self, ShapeError> {
        let label = |inside: &[bool]| u32::from(operation.accepts(inside));
        let [result] = Self::overlay(shapes, &label, [1], false, run)?;
        run.check()?;
        Ok(result)
    }

    /// The same area, its rings as operations return them. Keeps vertices on
    /// straight borders if asked.
    ///
    /// # Errors
    ///
    /// As [`Self::operation`].
    pub fn normalized(&self, keep_collinear: bool) -> Result<Self, ShapeError> {
        let [result] = Self::overlay(
            &[self],
            &|inside| inside[0].into(),
            [1],
            keep_collinear,
            &Run::default(),
        )?;
        Ok(result)
    }

    /// What of this shape is inside of `clip`, and what is outside, at once.
    ///
    /// # Errors
    ///
    /// As [`Self::operation`].
    pub fn split(&self, clip: &PlaneShape) -> Result<[Self; 2], ShapeError> {
        let label = |inside: &[bool]| match inside {
            [true, true] => 1,
            [true, false] => 2,
            _ => 0,
        };
        Self::overlay(&[self, clip], &label, [1, 2], false, &Run::default())
    }

    fn overlay<const N: usize>(
        shapes: &[&PlaneShape],
        label: &dyn Fn(&[bool]) -> u32,
        labels: [u32; N],
        keep_collinear: bool,
        run: &Run<'_>,
    ) -> Result<[Self; N], ShapeError> {
        let count = shapes.iter().map(|shape| shape.vertices.len()).sum();
        if count > MOST {
            return Err(ShapeError::TooMany);
        }
        let mut vertices = Vec::with_capacity(count);
        let mut operands = Vec::with_capacity(shapes.len());
        for shape in shapes {
            let first_vertex = vertices.len() as u32;
            operands.push(Operand { polygons: &shape.polygons, rule: shape.rule, first_vertex });
            vertices.extend_from_slice(&shape.vertices);
        }
        let points = plane(&vertices);
        let predicates = Predicates::<Exact>::new(&points);
        let Some(clipper) = Clipper::new(&predicates) else {
            return Ok([(); N].map(|()| Self::default()));
        };
        let clipper = clipper.with_collinear_vertices(keep_collinear);
        let mut areas = clipper.within(run).overlay(&operands, label);
        Ok(labels.map(|label| Self::compact(&vertices, areas.remove(&label).unwrap_or_default())))
    }

    /// A shape that has only the vertices its polygons name.
    fn compact(vertices: &[DVec3], mut polygons: Vec<Polygon>) -> Self {
        let corners = |polygons: &mut [Polygon], change: &mut dyn FnMut(&mut Corner)| {
            polygons.iter_mut().flat_map(|p| &mut p.rings).flatten().for_each(change);
        };
        let mut numbers = vec![0_u32; vertices.len()];
        corners(&mut polygons, &mut |corner| {
            corner.vertices(|vertex| numbers[vertex as usize] = 1);
        });
        let mut kept = Vec::new();
        for (vertex, number) in numbers.iter_mut().enumerate() {
            if *number == 1 {
                *number = kept.len() as u32;
                kept.push(vertices[vertex]);
            }
        }
        corners(&mut polygons, &mut |corner| {
            *corner = corner.renumbered(&|vertex| numbers[vertex as usize]);
        });
        PlaneShape { vertices: kept, polygons, rule: FillRule::Positive, is_result: true }
    }

    /// The exact area of what is inside. Numbers grow with the rings: for
    /// tests and reports.
    pub fn area(&self) -> Fraction {
        if self.is_result {
            return Fraction::sum(&self.areas());
        }
        self.normalized(false).map_or_else(|_| Fraction::zero(), |shape| shape.area())
    }

    /// For each polygon the sum of the areas of its rings, each with the
    /// sign of its turn: of results, their exact areas.
    pub fn areas(&self) -> Vec<Fraction> {
        let points = self.points();
        let predicates = Predicates::<Exact>::new(&points);
        let Some(chart) = Chart::new(&points) else {
            return Vec::new();
        };
        let exponent = 2 * predicates.ratio_exponent() - 1;
        let area = |polygon: &Polygon| {
            let mut terms = Vec::new();
            for ring in &polygon.rings {
                let ratios: Vec<_> =
                    ring.iter().map(|corner| predicates.ratio(&chart, corner.point)).collect();
                for (i, (a, v)) in ratios.iter().enumerate() {
                    let (b, w) = &ratios[(i + 1) % ratios.len()];
                    let cross = a[0].clone() * b[1].clone() - a[1].clone() * b[0].clone();
                    terms.extend(Fraction::new(cross, v.clone() * w.clone()));
                }
            }
            Fraction::sum(&terms).times_power_of_two(exponent)
        };
        self.polygons.iter().map(area).collect()
    }

    /// The place of a vertex.
    pub(super) fn vertex(&self, vertex: u32) -> DVec2 {
        self.vertices[vertex as usize].truncate()
    }

    /// The exact coordinates of all corners, ring by ring.
    pub fn positions(&self) -> Vec<Vec<Vec<[Fraction; 2]>>> {
        let points = self.points();
        let predicates = Predicates::<Exact>::new(&points);
        let Some(chart) = Chart::new(&points) else {
            return Vec::new();
        };
        let exponent = predicates.ratio_exponent();
        let position = |corner: &Corner| {
            let (numerators, denominator) = predicates.ratio(&chart, corner.point);
            numerators.map(|x| {
                let quotient = Fraction::new(x, denominator.clone());
                quotient.unwrap_or_else(Fraction::zero).times_power_of_two(exponent)
            })
        };
        let ring = |ring: &Ring| ring.iter().map(position).collect();
        let polygon = |polygon: &Polygon| polygon.rings.iter().map(ring).collect();
        self.polygons.iter().map(polygon).collect()
    }
}

/// The view of the plane from above.
fn plane(vertices: &[DVec3]) -> Points {
    Points::new(vertices, Eye::Towards(DVec3::Z), None)
}
