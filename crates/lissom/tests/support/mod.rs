//! Models and sessions that several tests share.

pub(crate) mod cantilever;
pub(crate) mod folder;
pub(crate) mod on_one_line;
pub(crate) mod paths;
pub(crate) mod rail;
pub(crate) mod refused;
pub(crate) mod runs;
pub(crate) mod series;
pub(crate) mod sessions;
pub(crate) mod starts;
pub(crate) mod truss;

/// Path of an example.
pub(crate) fn example(name: &str) -> String {
    format!("{}/../../examples/{name}.toml", env!("CARGO_MANIFEST_DIR"))
}
