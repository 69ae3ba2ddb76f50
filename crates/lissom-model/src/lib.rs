//! Model files in, results out.
//!
//! A TOML text becomes a validated plain-data [`Document`], or a [`Report`] that names every
//! mistake with its position and a remedy. Results leave as tables, summaries and plots. No physics is done here.

pub mod document;
pub mod expression;
pub mod failures;
pub mod files;
mod format;
pub mod functions;
pub mod line;
pub mod lower;
pub mod numbers;
pub mod output;
mod outputs;
mod parts;
mod reading;
mod reference;
pub mod registry;
pub mod scene;
pub mod sections;
mod surface;
pub mod sweep;
mod text;

pub use document::Document;
pub use document::model_text::ModelText;
pub use files::library::{self, Library};
pub use format::suggest::help as suggestion;
pub use functions::{table, table_family};
pub use output::component::component_position;
pub use outputs::{Deformed, channels};
pub use reference::forms::{Form, FormKey, forms, function_names, meant};
pub use reference::manual::{manual, topic, topics, unit_of};
pub use reference::model_axes::{EntryAxes, model_axes};
pub use reference::python_entries::python_entries;
pub use reference::schema::schema;
pub use reference::typed_entries::typed_entries;
pub use text::report::{Located, Problem, Remark, Report, Severity, Sources, Span};
pub use text::toml_text;
