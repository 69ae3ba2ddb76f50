//! Gaps with their derivatives, of surfaces, curves and points. Independent of parts and forces.

pub mod curves;
pub mod gap;
pub mod hollow;
pub mod pairs;
pub mod surfaces;
