//! All points near a segment, and what of another segment lies among them
//! and behind.
//!
//! A stadium is convex, so a segment's part in it is one stretch: from the
//! first to the last place in either disc or in the strip between them. The
//! nearest point of the stadium's segment runs along it with the projection
//! and rests at its ends before and after; between those two places the
//! difference in depth is linear.

use glam::DVec2;

/// A segment and something linear along its image that grows with depth.
#[derive(Debug, Clone, Copy)]
pub(super) struct Profile {
    pub(super) points: [DVec2; 2],
    pub(super) depths: [f64; 2],
}

impl Profile {
    fn point(&self, t: f64) -> DVec2 {
        self.points[0].lerp(self.points[1], t)
    }

    pub(super) fn depth(&self, t: f64) -> f64 {
        self.depths[0] + (self.depths[1] - self.depths[0]) * t
    }
}

/// The points within a distance of a segment.
#[derive(Debug, Clone, Copy)]
pub(super) struct Stadium {
    spine: Profile,
    radius: f64,
}

impl Stadium {
    pub(super) fn new(spine: Profile, radius: f64) -> Self {
        Stadium { spine, radius }
    }

    /// Changes all depths.
    pub(super) fn lift(&mut self, by: f64) {
        self.spine.depths = self.spine.depths.map(|depth| depth + by);
    }

    /// The depth of the point of the spine that is nearest to `point`.
    pub(super) fn depth_beside(&self, point: DVec2) -> f64 {
        let along = self.spine.points[1] - self.spine.points[0];
        let square = along.length_squared();
        let t = (point - self.spine.points[0]).dot(along) / square;
        self.spine.depth(if square > 0.0 { t.clamp(0.0, 1.0) } else { 0.0 })
    }

    /// Where `far` lies in the stadium and not in front of its nearest
    /// point: up to three stretches.
    pub(super) fn over(&self, far: &Profile) -> impl Iterator<Item = [f64; 2]> {
        let stretch = self.stretch(far.points);
        let [from, to] = stretch.unwrap_or([0.0; 2]);
        let mut stops = self.turns(far.points);
        stops = stops.map(|stop| stop.clamp(from, to));
        let behind = |t: f64| far.depth(t) - self.depth_beside(far.point(t));
        let parts = [[from, stops[0]], [stops[0], stops[1]], [stops[1], to]];
        parts
            .map(|part| stretch.and_then(|_| not_below_zero(part, part.map(behind))))
            .into_iter()
            .flatten()
    }

    /// The part of a segment in the stadium.
    fn stretch(&self, far: [DVec2; 2]) -> Option<[f64; 2]> {
        let [p, q] = self.spine.points;
        let along = far[1] - far[0];
        let mut hull: Option<[f64; 2]> = None;
        let mut add = |range: Option<[f64; 2]>| {
            if let Some([from, to]) = range {
                let [low, high] = hull.unwrap_or([from, to]);
                hull = Some([low.min(from), high.max(to)]);
            }
        };
        for centre in [p, q] {
            add(in_disc(far[0] - centre, along, self.radius));
        }
        add(in_strip([far[0], along], [p, q - p], self.radius));
        let [from, to] = hull?;
        let (from, to) = (from.max(0.0), to.min(1.0));
        (from <= to).then_some([from, to])
    }

    /// Where the nearest point leaves one end of the spine and comes to the
    /// other, in the order in which the segment passes.
    fn turns(&self, far: [DVec2; 2]) -> [f64; 2] {
        let spine = self.spine.points[1] - self.spine.points[0];
        let speed = (far[1] - far[0]).dot(spine);
        if speed == 0.0 {
            return [0.0; 2];
        }
        let [a, b] = self.spine.points.map(|end| (end - far[0]).dot(spine) / speed);
        [a.min(b), a.max(b)]
    }
}

/// Where `offset + t along` is within `radius` of the origin.
fn in_disc(offset: DVec2, along: DVec2, radius: f64) -> Option<[f64; 2]> {
    let square = along.length_squared();
    if square == 0.0 {
        return (offset.length() <= radius).then_some([0.0, 1.0]);
    }
    let middle = -offset.dot(along) / square;
    let aside = offset.perp_dot(along) / square.sqrt();
    let half = (radius - aside) * (radius + aside);
    (0.0 <= half).then(|| {
        let half = (half / square).sqrt();
        [middle - half, middle + half]
    })
}

/// Where a ray is within `radius` of a segment, both as start and direction,
/// and beside it.
fn in_strip(
    [start, along]: [DVec2; 2],
    [origin, spine]: [DVec2; 2],
    radius: f64,
) -> Option<[f64; 2]> {
    let length = spine.length();
    if length == 0.0 {
        return None;
    }
    let unit = spine / length;
    let offset = start - origin;
    let beside = within(offset.dot(unit), along.dot(unit), 0.0, length)?;
    let across = within(unit.perp_dot(offset), unit.perp_dot(along), -radius, radius)?;
    let (from, to) = (beside[0].max(across[0]), beside[1].min(across[1]));
    (from <= to).then_some([from, to])
}

/// Where `low <= start + t speed <= high`.
fn within(start: f64, speed: f64, low: f64, high: f64) -> Option<[f64; 2]> {
    if speed == 0.0 {
        return (low <= start && start <= high).then_some([f64::NEG_INFINITY, f64::INFINITY]);
    }
    let (a, b) = ((low - start) / speed, (high - start) / speed);
    Some([a.min(b), a.max(b)])
}

/// The part of a range in which what is linear from one value to the other
/// is not negative.
fn not_below_zero([from, to]: [f64; 2], [first, last]: [f64; 2]) -> Option<[f64; 2]> {
    let root = || from + (to - from) * (first / (first - last));
    match (0.0 <= first, 0.0 <= last) {
        (true, true) => Some([from, to]),
        (true, false) => Some([from, root()]),
        (false, true) => Some([root(), to]),
        (false, false) => None,
    }
}
