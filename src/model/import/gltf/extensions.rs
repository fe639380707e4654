//! Extensions of glTF: what each means to a drawing of lines.

use super::super::error::Read;
use super::super::json_places::Step;
use super::container::Document;

/// Applied where they stand.
const APPLIED: [&str; 3] =
    ["KHR_mesh_quantization", "EXT_mesh_gpu_instancing", "KHR_node_visibility"];

/// Compressions: told where the shape is not to be had without them.
const COMPRESSIONS: [&str; 3] =
    ["KHR_draco_mesh_compression", "EXT_meshopt_compression", "KHR_meshopt_compression"];

/// How the names begin of what decorates a shape, moves it later, or says
/// something about it, and does not change it.
const DECORATIONS: [&str; 15] = [
    "KHR_materials_",
    "EXT_materials_",
    "ADOBE_materials_",
    "KHR_texture_",
    "EXT_texture_",
    "MSFT_texture_",
    "KHR_techniques_webgl",
    "KHR_lights_",
    "EXT_lights_",
    "KHR_animation_",
    "KHR_audio",
    "KHR_xmp",
    "EXT_mesh_features",
    "EXT_instance_features",
    "EXT_structural_metadata",
];

/// Tells of what is passed over.
///
/// # Errors
///
/// If an extension is required without which the shape is not to be had.
pub(super) fn check(document: &Document<'_>, warnings: &mut Vec<String>) -> Read<()> {
    let root = &document.root;
    let is_decoration = |name: &str| DECORATIONS.iter().any(|start| name.starts_with(start));
    for (item, name) in root.extensions_required.iter().enumerate() {
        let shown = shown(name);
        if is_decoration(name) {
            tell(warnings, format!("the required extension '{shown}' is ignored"));
        } else if !APPLIED.contains(&&**name) {
            let path = [Step::Key("extensionsRequired"), Step::Item(item)];
            let message =
                format!("the extension '{shown}' is required, expected a file without it");
            return Err(document.fault(&path, message));
        }
    }
    for name in &root.extensions_used {
        let known = APPLIED.iter().chain(&COMPRESSIONS).any(|known| known == name);
        if !known && !is_decoration(name) {
            tell(warnings, format!("the extension '{}' is ignored", shown(name)));
        }
    }
    if 0 < root.animations.len() {
        tell(warnings, "animations are ignored: nodes stand where the file puts them".to_owned());
    }
    Ok(())
}

/// Adds a warning once.
pub(super) fn tell(warnings: &mut Vec<String>, warning: String) {
    if !warnings.contains(&warning) {
        warnings.push(warning);
    }
}

/// A name for a message: printable, not too long.
fn shown(name: &str) -> String {
    name.chars().take(60).collect::<String>().escape_default().to_string()
}
