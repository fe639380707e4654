//! Where a mesh stands: transforms of nodes, and of the instances of one node
//! (EXT_mesh_gpu_instancing).

use glam::{DMat4, DQuat, DVec3, DVec4};

use super::super::error::Read;
use super::super::json_places::Step;
use super::container::Document;
use super::document::{Instancing, Natural, Node};
use super::extensions::tell;

/// The transform of one node, with a rotation of length 1 in f64.
pub(super) fn transform(
    document: &Document<'_>,
    node: &Node,
    number: usize,
    warnings: &mut Vec<String>,
) -> Read<DMat4> {
    let matrix = if let Some(matrix) = node.matrix {
        DMat4::from_cols_array(&matrix.map(f64::from))
    } else {
        composed(
            node.translation.map(|translation| translation.map(f64::from)),
            node.rotation.map(|rotation| rotation.map(f64::from)),
            node.scale.map(|scale| scale.map(f64::from)),
            warnings,
        )
    };
    let is_affine = matrix.row(3) == DVec4::W;
    if matrix.is_finite() && is_affine {
        return Ok(matrix);
    }
    let path = [Step::Key("nodes"), Step::Item(number)];
    let message = format!("the transform of node {number} is not finite and affine, expected one");
    Err(document.fault(&path, message))
}

/// Scaled, then turned, then moved. A rotation of nothing turns nothing.
fn composed(
    translation: Option<[f64; 3]>,
    rotation: Option<[f64; 4]>,
    scale: Option<[f64; 3]>,
    warnings: &mut Vec<String>,
) -> DMat4 {
    let turn = |rotation| {
        if rotation == [0.0; 4] {
            tell(warnings, "rotations of four zeros are ignored".to_owned());
            return DQuat::IDENTITY;
        }
        DQuat::from_array(rotation).normalize()
    };
    DMat4::from_scale_rotation_translation(
        scale.map_or(DVec3::ONE, DVec3::from_array),
        rotation.map_or(DQuat::IDENTITY, turn),
        translation.map_or(DVec3::ZERO, DVec3::from_array),
    )
}

/// The transforms of all instances of a node within its own; one that changes
/// nothing if the node has no instances.
pub(super) fn instances(
    document: &Document<'_>,
    node: &Node,
    number: usize,
    warnings: &mut Vec<String>,
) -> Read<Vec<DMat4>> {
    let Some(Instancing { attributes }) = &node.extensions.instancing else {
        return Ok(vec![DMat4::IDENTITY]);
    };
    let path = [
        Step::Key("nodes"),
        Step::Item(number),
        Step::Key("extensions"),
        Step::Key("EXT_mesh_gpu_instancing"),
        Step::Key("attributes"),
    ];
    let translations = attribute::<3>(document, attributes.translation, &path, "TRANSLATION")?;
    let rotations = attribute::<4>(document, attributes.rotation, &path, "ROTATION")?;
    let scales = attribute::<3>(document, attributes.scale, &path, "SCALE")?;
    let lengths = [
        translations.as_ref().map(Vec::len),
        rotations.as_ref().map(Vec::len),
        scales.as_ref().map(Vec::len),
    ];
    let mut lengths = lengths.into_iter().flatten();
    let count = lengths.next().unwrap_or(1);
    if let Some(other) = lengths.find(|&other| other != count) {
        let message = format!("{other} instances, expected {count} as in the attribute before");
        return Err(document.fault(&path, message));
    }
    let mut transforms = Vec::with_capacity(count);
    for i in 0..count {
        let transform = composed(
            translations.as_ref().map(|list| list[i]),
            rotations.as_ref().map(|list| list[i]),
            scales.as_ref().map(|list| list[i]),
            warnings,
        );
        if !transform.is_finite() {
            let message =
                format!("the transform of instance {i} is not finite, expected one that is");
            return Err(document.fault(&path, message));
        }
        transforms.push(transform);
    }
    Ok(transforms)
}

/// The elements of an attribute, if there is one.
fn attribute<const N: usize>(
    document: &Document<'_>,
    accessor: Option<Natural>,
    path: &[Step<'_>; 5],
    name: &'static str,
) -> Read<Option<Vec<[f64; N]>>> {
    let user = || [&path[..], &[Step::Key(name)]].concat();
    accessor.map(|number| document.elements::<N>(number.index(), &user())).transpose()
}
