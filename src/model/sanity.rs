//! A check of a mesh that every test and fuzz target can call.

use super::Mesh;

impl Mesh {
    /// Checks every promise of the arrays: indices in range, no flat or
    /// duplicate triangle, edges sorted and complete, objects disjoint.
    /// O(n log n).
    ///
    /// # Errors
    ///
    /// Says which promise is broken, and where.
    pub fn sanity_check(&self) -> Result<(), String> {
        let ensure = |holds: bool, what: String| if holds { Ok(()) } else { Err(what) };
        let vertex_count = self.vertices().len() as u32;
        for (i, position) in self.vertices().iter().enumerate() {
            ensure(position.is_finite(), format!("vertex {i} is not finite"))?;
        }
        let mut sides = 0;
        for (i, triangle) in self.triangles().iter().enumerate() {
            let [a, b, c] = *triangle;
            ensure(
                a != b && b != c && c != a && triangle.iter().all(|&v| v < vertex_count),
                format!("triangle {i} has corners {triangle:?}"),
            )?;
            let object = self.object_of_triangle(i as u32);
            ensure(
                triangle.iter().all(|&v| self.object_of_vertex(v) == object),
                format!("triangle {i} reaches into another object"),
            )?;
            for side in [[a, b], [b, c], [c, a]] {
                let edge = self.edges().find(side[0], side[1]);
                let listed = edge.is_some_and(|e| self.edges().triangles(e).contains(&(i as u32)));
                ensure(listed, format!("side {side:?} of triangle {i} is no edge"))?;
                sides += 1;
            }
        }
        let edges = self.edges();
        let mut incident = 0;
        for edge in 0..edges.len() as u32 {
            incident += edges.triangles(edge).len();
            let sorted = edge == 0 || edges.ends(edge - 1) < edges.ends(edge);
            ensure(sorted, format!("edge {edge} is out of order"))?;
            let ascending = edges.triangles(edge).windows(2).all(|pair| pair[0] < pair[1]);
            ensure(ascending, format!("the triangles of edge {edge} are out of order"))?;
        }
        ensure(incident == sides, format!("{sides} sides, but {incident} at edges"))?;
        for (i, object) in self.objects().iter().enumerate().skip(1) {
            let previous = &self.objects()[i - 1];
            ensure(
                previous.vertices.end == object.vertices.start
                    && previous.triangles.end == object.triangles.start
                    && previous.faces.end == object.faces.start,
                format!("object {i} does not begin where the one before ends"),
            )?;
        }
        Ok(())
    }
}
