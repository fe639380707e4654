//! Image-space methods against each other, every pair at every sample.
//!
//! All decide by the same exact signs, so they have to name the same
//! triangle and the same depth, to the last bit.

use crate::kernel::predicates::Policy;
use crate::model::View;
use crate::raster::{ItemBuffer, Samples, methods};
use crate::run::{Cancelled, Run};
use crate::view::LineQuestion;
use glam::DVec2;
use std::collections::BTreeSet;
use std::fmt;

/// Two methods on one image.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Comparison {
    /// Their names.
    pub methods: [&'static str; 2],
    /// Samples that were compared.
    pub samples: u64,
    /// Samples that differ.
    pub differ: u64,
}

/// All pairs of methods on one image.
#[derive(Debug, Clone, PartialEq)]
pub struct CrossCheck {
    /// The pairs.
    pub comparisons: Vec<Comparison>,
    /// Samples at which any two differ, as row and column.
    differing: BTreeSet<[u32; 2]>,
    samples: Samples,
}

/// Runs all image-space methods and compares each with each.
///
/// # Errors
///
/// If the run is cancelled.
pub fn cross_check<P: Policy>(
    view: &View,
    question: &LineQuestion,
    samples: &Samples,
    run: &Run,
) -> Result<CrossCheck, Cancelled> {
    let mut images: Vec<(&'static str, ItemBuffer)> = Vec::new();
    let mut check =
        CrossCheck { comparisons: Vec::new(), differing: BTreeSet::new(), samples: *samples };
    for (name, method) in methods::<P>() {
        let image = method(view, question, samples, run)?;
        for (other, earlier) in &images {
            check.compare([other, name], [earlier, &image]);
        }
        images.push((name, image));
    }
    Ok(check)
}

impl CrossCheck {
    fn compare(&mut self, methods: [&'static str; 2], [one, other]: [&ItemBuffer; 2]) {
        let (width, height) = (self.samples.width(), self.samples.height());
        let mut comparison =
            Comparison { methods, samples: u64::from(width) * u64::from(height), differ: 0 };
        for row in 0..height {
            for column in 0..width {
                let [a, b] = [one, other]
                    .map(|image| (image.item(column, row), image.depth(column, row).to_bits()));
                if a != b {
                    comparison.differ += 1;
                    self.differing.insert([row, column]);
                }
            }
        }
        self.comparisons.push(comparison);
    }

    /// Whether no two methods differ anywhere.
    pub fn is_clean(&self) -> bool {
        self.comparisons.iter().all(|comparison| comparison.differ == 0)
    }

    /// A cross through each differing pixel, in the view frame.
    pub fn differences(&self) -> impl Iterator<Item = [DVec2; 2]> + '_ {
        let half = 0.5 * self.samples.pixel();
        self.differing.iter().flat_map(move |&[row, column]| {
            let centre = self.samples.image(column, row);
            [DVec2::new(half, half), DVec2::new(half, -half)]
                .map(|corner| [centre - corner, centre + corner])
        })
    }
}

impl fmt::Display for CrossCheck {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        writeln!(f, "{:<15} {:<15} {:>10} {:>10}", "method", "against", "samples", "differ")?;
        for Comparison { methods: [one, other], samples, differ } in &self.comparisons {
            writeln!(f, "{one:<15} {other:<15} {samples:>10} {differ:>10}")?;
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::{Frame, Projection};
    use glam::DVec3;

    #[test]
    fn a_different_triangle_and_a_different_depth_are_found_and_drawn() {
        let frame = Frame {
            projection: Projection::Orthographic,
            origin: DVec3::ZERO,
            right: DVec3::X,
            up: DVec3::Z,
            forward: DVec3::Y,
            shear: DVec2::ZERO,
            half_height: None,
        };
        let samples = Samples::about(&frame, DVec2::ZERO, 1.0, [2, 2], 1.0);
        let image = |items: [Option<u32>; 4], depth: f64| {
            ItemBuffer::new(2, items.map(|item| (item, depth)))
        };
        let one = image([None, Some(1), Some(2), Some(2)], 3.0);
        let other = image([None, Some(1), Some(2), Some(1)], 3.0);
        let deeper = image([None, Some(1), Some(2), Some(2)], 3.0_f64.next_up());
        let comparisons = Vec::new();
        let mut check = CrossCheck { comparisons, differing: BTreeSet::new(), samples };
        check.compare(["one", "one"], [&one, &one]);
        assert!(check.is_clean());
        check.compare(["one", "other"], [&one, &other]);
        let differ: Vec<u64> = check.comparisons.iter().map(|pair| pair.differ).collect();
        assert_eq!(differ, [0, 1]);
        assert!(!check.is_clean());
        assert!(
            check.to_string().ends_with("one             other                    4          1\n")
        );
        let crosses: Vec<_> = check.differences().collect();
        assert_eq!(crosses[0], [DVec2::new(0.0, -1.0), DVec2::new(1.0, 0.0)]);
        assert_eq!(crosses.len(), 2);
        check.compare(["one", "deeper"], [&one, &deeper]);
        assert_eq!(check.comparisons[2].differ, 4);
    }
}
