//! The crate against an independent reference in extended precision, and the identities its operators obey.

mod algebra;
mod arguments;
mod errors;
mod extremes;
mod group;
mod inverse_tangent;
mod jets;
mod lanes;
mod rotation;
mod series;
mod tangent;
mod wide;
