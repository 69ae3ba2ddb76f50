//! Flexible multibody dynamics: the front door to the simulator. Models are read, simulated and recorded
//! here, in memory or to files; the command line is built on nothing else. No mechanics is done here.
//!
//! ```
//! use lissom::Model;
//!
//! let text = r#"
//!     lissom = 1
//!     point_masses.stone = { mass = 2, position = [0, 0, 10], velocity = [3, 0, 0] }
//!     gravity = [0, 0, -9.81]
//!     outputs.stone = { kind = "position", of = "stone" }
//!     analysis = { kind = "dynamics", end = 1.0, step = 0.1 }
//! "#;
//! let model = Model::from_text("stone.toml", text);
//! // The same model at two step sizes; sessions may run in parallel threads.
//! for step in ["0.1", "0.01"] {
//!     let overrides = [("analysis.step".to_owned(), step.to_owned())];
//!     let mut session = model.session(&overrides)?;
//!     let (record, report) = session.record();
//!     assert!(report.is_complete());
//!     let height = record.column("stone", "z").expect("it is recorded");
//!     assert!((height[height.len() - 1] - (10.0 - 0.5 * 9.81)).abs() < 1e-9);
//! }
//! # Ok::<(), lissom::SessionError>(())
//! ```

mod about;
pub mod buckling;
pub mod campbell;
mod checkpoint;
mod folder;
mod folder_page;
pub mod geometry;
pub mod gradient;
pub mod linearize;
mod model;
pub mod modes;
pub mod motion;
pub mod path;
pub mod picture;
mod ports;
mod report;
pub mod response;
mod schedule;
mod session;
mod spent;
mod state_writer;
pub mod study;
pub mod summary;
pub mod sweep;
pub mod telemetry;
pub mod view;

pub use checkpoint::{Checkpoint, CheckpointError, CheckpointEvery, CheckpointFile};
pub use folder::{FolderError, ResultFolder};
pub use folder_page::RecordedRun;
pub use lissom_core as core;
pub use lissom_model::files::FileError;
pub use lissom_model::output::{Column, Record, Summary, Writer};
pub use lissom_model::{Document, Report};
pub use model::{Model, Override};
pub use report::{EnergyChange, RunError, RunReport, Stopped};
pub use session::{Checkpoints, Progress, Session, SessionError, SessionSnapshot, columns};
pub use spent::Seconds;
pub use state_writer::StateWriter;

/// Version of the program, as it stands in every summary.
pub const VERSION: &str = env!("CARGO_PKG_VERSION");
