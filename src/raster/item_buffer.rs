//! An image whose samples name triangles instead of colours.

/// The nearest triangle of each sample, row by row from the top.
#[derive(Debug, Clone, PartialEq)]
pub struct ItemBuffer {
    width: u32,
    height: u32,
    items: Vec<Option<u32>>,
    depths: Vec<f64>,
}

impl ItemBuffer {
    /// A buffer of `width` columns with the triangle and depth of each
    /// sample; depth is world units along the view direction, infinite
    /// where there is no triangle. Incomplete rows are left out.
    pub fn new(width: u32, samples: impl IntoIterator<Item = (Option<u32>, f64)>) -> Self {
        let (items, depths): (Vec<_>, Vec<_>) = samples.into_iter().unzip();
        ItemBuffer {
            width,
            height: items.len().checked_div(width as usize).unwrap_or(0) as u32,
            items,
            depths,
        }
    }

    /// Columns.
    pub fn width(&self) -> u32 {
        self.width
    }

    /// Rows.
    pub fn height(&self) -> u32 {
        self.height
    }

    fn index(&self, column: u32, row: u32) -> Option<usize> {
        let inside = column < self.width && row < self.height;
        inside.then_some(row as usize * self.width as usize + column as usize)
    }

    /// The nearest triangle at a sample, if there is one.
    pub fn item(&self, column: u32, row: u32) -> Option<u32> {
        self.items[self.index(column, row)?]
    }

    /// The depth at a sample: infinite outside the image and where there is
    /// no triangle.
    pub fn depth(&self, column: u32, row: u32) -> f64 {
        self.index(column, row).map_or(f64::INFINITY, |index| self.depths[index])
    }
}
