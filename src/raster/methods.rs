//! The table of image-space methods: whoever lists, compares or times them
//! reads it, so a method more is a line more here.

use super::{
    ItemBuffer, Samples, a_buffer, ray_cast, scanline, span_buffer, spanning, warnock,
    warnock_vertex, z_buffer,
};
use crate::kernel::predicates::Policy;
use crate::model::View;
use crate::run::{Cancelled, Run};
use crate::view::LineQuestion;

/// What every method does: the nearest triangle at every sample.
pub type Method = fn(&View, &LineQuestion, &Samples, &Run) -> Result<ItemBuffer, Cancelled>;

/// All methods by name. The first is the reference.
pub fn methods<P: Policy>() -> Vec<(&'static str, Method)> {
    vec![
        ("ray-cast", ray_cast::<P>),
        ("z-buffer", z_buffer::<P>),
        ("a-buffer", a_buffer::<P>),
        ("scanline", scanline::<P>),
        ("spanning", spanning::<P>),
        ("span-buffer", span_buffer::<P>),
        ("warnock", warnock::<P>),
        ("warnock-vertex", warnock_vertex::<P>),
    ]
}
