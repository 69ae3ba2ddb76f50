//! Natural modes and responses.

mod frames;
mod modes;
mod response;
mod velocity_constraints;
