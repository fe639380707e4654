//! What a single element says of where it is and for whom.

use super::length::Lengths;
use super::property::{Declared, Property};
use super::source::wrong;
use super::transform::transform;
use crate::export::ExportError;
use glam::{DAffine2, DVec2, dvec2};
use roxmltree::Node;
use svgtypes::TransformOrigin;

/// Whether an element is meant for viewers such as this one: English, without
/// extensions (SVG 2, section 5.10).
pub(super) fn is_for_us(node: Node<'_, '_>) -> bool {
    let extensions = node.attribute("requiredExtensions").unwrap_or_default();
    let speaks_english = |languages: &str| {
        languages.split(',').any(|language| {
            let language = language.trim().to_ascii_lowercase();
            language == "en" || language.starts_with("en-")
        })
    };
    extensions.trim().is_empty() && node.attribute("systemLanguage").is_none_or(speaks_english)
}

/// The transform of an element, about its origin, which usually is this.
pub(super) fn own_transform(
    node: Node<'_, '_>,
    declared: &Declared<'_>,
    lengths: &Lengths,
    usual: DVec2,
) -> Result<DAffine2, ExportError> {
    let Some(text) = declared.get(Property::Transform) else { return Ok(DAffine2::IDENTITY) };
    let own = transform(text).map_err(|message| wrong(node, message))?;
    let origin = match declared.get(Property::TransformOrigin) {
        None => usual,
        Some(text) => {
            let message = "cannot be read, expected two lengths";
            let refuse = |_| wrong(node, format!("the transform-origin `{text}` {message}"));
            let origin: TransformOrigin = text.parse().map_err(refuse)?;
            let [width, height] = lengths.viewport;
            let place = || {
                let x = lengths.of(origin.x_offset, width)?;
                Ok(dvec2(x, lengths.of(origin.y_offset, height)?))
            };
            place().map_err(|message: String| wrong(node, message))?
        }
    };
    if origin == DVec2::ZERO {
        return Ok(own);
    }
    let to_origin = DAffine2::from_translation(origin);
    Ok(to_origin * own * DAffine2::from_translation(-origin))
}

/// A length that an element gives; nothing for what it does not give.
pub(super) fn length(
    node: Node<'_, '_>,
    declared: &Declared<'_>,
    property: Property,
    lengths: &Lengths,
) -> Result<Option<f64>, ExportError> {
    let given = declared.get(property).filter(|text| !text.eq_ignore_ascii_case("auto"));
    let Some(text) = given else { return Ok(None) };
    let length = lengths.along(property, text);
    length.map(Some).map_err(|message| wrong(node, format!("{}: {message}", property.name())))
}

/// Where an element is placed by its x and y.
pub(super) fn corner(
    node: Node<'_, '_>,
    declared: &Declared<'_>,
    lengths: &Lengths,
) -> Result<DVec2, ExportError> {
    let x = length(node, declared, Property::X, lengths)?.unwrap_or(0.0);
    Ok(dvec2(x, length(node, declared, Property::Y, lengths)?.unwrap_or(0.0)))
}
