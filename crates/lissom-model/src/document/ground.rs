//! Solids that are fixed in space.

use std::sync::Arc;

use lissom_contact::forms::PlacedSolid;
use lissom_motion::Vector3;

use super::solids::shape;
use crate::format::keys::{Key, Shape, unitless};
use crate::parts::context::Context;
use crate::reading::reader::Reader;
use crate::registry::Registry;
use crate::surface::Surface;

/// Solids that are fixed in space.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Ground {
    /// Shape for drawings.
    pub surface: Option<Arc<Surface>>,
    /// Solids that parts touch, in global axes.
    pub(crate) solids: Vec<PlacedSolid>,
}

/// Keys of `[ground]`.
pub(super) fn keys() -> Vec<Key> {
    vec![
        unitless("shape", Shape::Solid, "solids, in global axes; by default at the origin"),
        unitless("mesh", Shape::Text, "instead of `shape`: an STL or glTF file in metres, drawn only"),
    ]
}

/// The shape of the ground; none stands for an error.
pub(super) fn ground(context: &Context<'_>) -> Option<Ground> {
    let Some((node, span)) = context.top("ground").filter(|(node, _)| node.table().is_some()) else {
        return Some(Ground::default());
    };
    let keys = (context.forms)("ground", &Registry::default()).all.into_iter().next()?.keys;
    let reader = Reader::open(context, node, ("[ground]".to_owned(), span), keys)?;
    shape(&reader, &Vector3::zeros()).map(|shape| Ground { surface: shape.surface, solids: shape.solids })
}
