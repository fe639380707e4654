//! A rectangle of the view frame: the part of a picture that is drawn.

use super::DrawingError;
use glam::DVec2;
use std::str::FromStr;

/// The part of the picture between two corners, in the coordinates of the
/// view frame: u to the right, v upwards; world units, or tangents of a
/// perspective view.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Window {
    low: DVec2,
    high: DVec2,
}

impl Window {
    /// The window with these two opposite corners; refused without an area.
    pub fn new(one: DVec2, other: DVec2) -> Result<Self, DrawingError> {
        let (low, high) = (one.min(other), one.max(other));
        let extent = high - low;
        if one.is_finite() && other.is_finite() && extent.is_finite() && 0.0 < extent.min_element()
        {
            // A sum with zero is never a negative zero.
            Ok(Window { low: low + DVec2::ZERO, high: high + DVec2::ZERO })
        } else {
            let [a, b] = [one, other];
            Err(DrawingError::Window(format!("{},{},{},{}", a.x, a.y, b.x, b.y)))
        }
    }

    /// The window around the middle of the picture.
    pub(super) fn around_zero(half: DVec2) -> Self {
        Window { low: -half, high: half }
    }

    /// The corner to the left and below.
    pub fn low(&self) -> DVec2 {
        self.low
    }

    /// The corner to the right and above.
    pub fn high(&self) -> DVec2 {
        self.high
    }

    /// Whether a point lies in the window or on its border.
    pub fn holds(&self, point: DVec2) -> bool {
        self.low.cmple(point).all() && point.cmple(self.high).all()
    }
}

/// Reads `U0,V0,U1,V1`, two opposite corners.
impl FromStr for Window {
    type Err = DrawingError;

    fn from_str(text: &str) -> Result<Self, DrawingError> {
        let refuse = || DrawingError::Window(text.to_owned());
        let numbers: Result<Vec<f64>, _> =
            text.split(',').map(|word| word.trim().parse()).collect();
        match numbers.as_deref() {
            Ok(&[u0, v0, u1, v1]) => {
                Window::new(DVec2::new(u0, v0), DVec2::new(u1, v1)).map_err(|_| refuse())
            }
            _ => Err(refuse()),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn corners_are_read_in_any_order() {
        let window = Window::new(DVec2::new(-1.0, 2.0), DVec2::new(3.0, 0.5));
        assert_eq!("3, 2, -1, 0.5".parse(), window);
        assert_eq!("-1,0.5,3,2".parse(), window);
    }

    #[test]
    fn what_is_no_window_is_refused() {
        for text in
            ["", "1,2,3", "0,0,0,1", "0,0,1,nan", "0,0,inf,1", "a,b,c,d", "-1e308,0,1e308,1"]
        {
            let refused = text.parse::<Window>();
            assert_eq!(refused, Err(DrawingError::Window(text.to_owned())), "{text}");
        }
    }
}
