//! Model files in, results out.
//!
//! A TOML text becomes a validated plain-data [`Document`], or a [`Report`] that names every
//! mistake with its position and a remedy. Results leave as tables, summaries and plots. No physics is done here.

mod channel_components;
pub mod channels;
mod contact_point;
mod context;
mod data_file;
pub mod document;
mod excerpt;
pub mod expression;
pub mod failures;
pub mod files;
mod force_values;
mod forms;
mod function_values;
pub mod functions;
mod keys;
pub mod library;
pub mod line;
mod local_tables;
pub mod lower;
mod manual;
mod matrix_file;
mod model_axes;
mod model_text;
mod npz;
pub mod numbers;
pub mod output;
mod output_channels;
mod outputs;
mod parts;
mod polar_file;
mod python_entries;
mod reader;
pub mod registry;
mod remembered;
mod report;
pub mod scene;
mod schema;
pub mod sections;
mod solid;
mod suggest;
mod surface;
pub mod sweep;
mod synonyms;
pub mod table;
pub mod table_family;
mod table_values;
mod text;
pub mod toml_text;
mod typed_entries;
mod values;

pub use channel_components::component_position;
pub use document::Document;
pub use forms::{Form, FormKey, forms, function_names, meant};
pub use library::Library;
pub use manual::{manual, topic, topics, unit_of};
pub use model_axes::{EntryAxes, model_axes};
pub use model_text::ModelText;
pub use python_entries::python_entries;
pub use report::{Located, Problem, Report, Severity, Sources, Span};
pub use schema::schema;
pub use typed_entries::typed_entries;
