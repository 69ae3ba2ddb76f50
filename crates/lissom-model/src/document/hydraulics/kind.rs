//! What a kind of hydraulic part declares.

use lissom_mechanics::registry::Usual;

use super::net::{Net, Part};
use crate::format::keys::Key;
use crate::outputs::kinds::OutputComponent;

/// Absolute pressures and differences of pressures.
pub(super) const PASCALS: Usual = Usual::new(1e3, 1e9, "in bar or MPa");
/// Flows.
pub(super) const FLOWS: Usual = Usual::new(0.0, 1.0, "in litres per minute");
/// Diameters.
pub(super) const DIAMETERS: Usual = Usual::new(1e-4, 3.0, "in millimetres");
/// Lengths of strokes.
pub(super) const LENGTHS: Usual = Usual::new(1e-4, 30.0, "in millimetres");

/// A key that names a node.
pub(super) struct Port {
    pub(super) key: &'static str,
    pub(super) is_required: bool,
    pub(super) summary: &'static str,
}

/// A kind of hydraulic part.
pub(super) struct HydraulicKind {
    pub(super) word: &'static str,
    pub(super) summary: &'static str,
    pub(super) ports: &'static [Port],
    pub(super) keys: fn() -> Vec<Key>,
    /// Whether its nodes may have different fluids.
    pub(super) separates_fluids: bool,
    /// Names and units of its signals.
    pub(super) components: &'static [OutputComponent],
    pub(super) add: fn(&Part<'_, '_, '_>, &mut Net<'_, '_>) -> Option<()>,
}

pub(super) const fn port(key: &'static str, summary: &'static str) -> Port {
    Port { key, is_required: true, summary }
}
