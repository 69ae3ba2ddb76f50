//! Temperatures of parts, above those of their states without stress.

use lissom_mesh::MeshedPart;

use super::meshes::formula;
use crate::format::keys::{Key, Shape, optional};
use crate::reading::reader::Reader;

/// The key of shells and solids.
pub(super) fn key() -> Key {
    optional(
        "temperature",
        Shape::Field,
        "K",
        "above that of the state without stress, over the whole analysis: a number or an expression of x, y and z at rest, in the axes of the part",
    )
}

/// The temperature of each node of a shell or solid [K]; none without the key.
pub(super) fn temperatures(reader: &Reader<'_, '_>, mesh: &MeshedPart) -> Option<Vec<f64>> {
    let Some(node) = reader.node("temperature") else { return Some(Vec::new()) };
    let what = reader.words("temperature");
    let formula = formula(reader, node, &what, &["x", "y", "z"])?;
    let axes = reader.context.frame(reader.scope)?;
    let mut temperatures = Vec::with_capacity(mesh.positions.len());
    for position in &mesh.positions {
        let place = axes.inverse_transform_point(position);
        let of = |name: &str| place["xyz".find(name).unwrap_or(0)];
        let arguments: Vec<f64> = formula.arguments().iter().map(|name| of(&name.text)).collect();
        let value = formula.with_arguments(&arguments).value(0.0);
        if !value.is_finite() {
            let at: Vec<String> = place.iter().map(|coordinate| format!("{coordinate:.4}")).collect();
            let message = format!("{what} is not a finite number at [{}]", at.join(", "));
            return reader.context.fail(node.span, message, "check the expression there");
        }
        temperatures.push(value);
    }
    Some(temperatures)
}

/// Reports a temperature that causes no strain.
pub(super) fn check_expansion(reader: &Reader<'_, '_>, key: &str, expands: bool) -> Option<()> {
    let (Some(node), false) = (reader.node(key), expands) else { return Some(()) };
    let message = format!("{} causes no strain: the material does not expand", reader.words(key));
    reader.context.fail(node.span, message, "add `expansion = …` [1/K] to the material: steel has 12e-6")
}
