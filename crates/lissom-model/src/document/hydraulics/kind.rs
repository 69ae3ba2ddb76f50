//! What a kind of hydraulic part declares.

use super::net::{Net, Part};
use crate::format::keys::Key;
use crate::outputs::kinds::OutputComponent;

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
