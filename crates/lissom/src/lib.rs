//! Flexible multibody dynamics: the public interface of the simulator. Models are read or built, simulated and
//! recorded here, in memory or to files; the command line uses only this interface. Mechanics is in other crates.
//!
//! # A model from a file
//!
//! [`Model`] contains the text of a [model file](https://toml.io). [`Model::with`] changes values without changing the text;
//! [`Session::run`] returns [`Results`], or an error with the results so far:
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
//! for step in [0.1, 0.01] {
//!     let results = model.with("analysis.step", step).session()?.run()?;
//!     let height = &results["stone.z"];
//!     assert!((height[height.len() - 1] - (10.0 - 0.5 * 9.81)).abs() < 1e-9);
//!     assert_eq!(results.time().last(), Some(&1.0));
//! }
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! # A model built in code
//!
//! [`ModelBuilder`](builder::ModelBuilder) accepts typed entries and returns ids, which represent names. It builds the same
//! model as a file would, with the same checks. A cart on a spring, pushed by an input:
//!
//! ```
//! use lissom::builder::analyses::Dynamics;
//! use lissom::builder::joints::Prismatic;
//! use lissom::builder::loads::JointForce;
//! use lissom::builder::outputs::{Reaction, Relative};
//! use lissom::builder::parts::Body;
//! use lissom::builder::springs::Axial;
//! use lissom::builder::{GROUND, Input, ModelBuilder, Signal};
//!
//! # fn main() -> Result<(), Box<dyn std::error::Error>> {
//! let mut builder = ModelBuilder::new();
//! builder.gravity([0.0, 0.0, -9.81]);
//! let cart = builder.add(Body::new(2.0, [0.1, 0.1, 0.1]));
//! let rail = builder.add(Prismatic::new(GROUND, cart, [1.0, 0.0, 0.0]));
//! builder.add(Axial::new(rail).stiffness(50.0));
//! let push = builder.add(Input::starting_at(0.0));
//! builder.add(JointForce::new(rail, push));
//! let place = builder.add(Relative::new(rail));
//! let support = builder.add(Reaction::new(rail));
//! let stored = builder.add(Signal::new(25.0 * rail.displacement() * rail.displacement()));
//! builder.add(Dynamics::new(1.0).relative_tolerance(1e-8));
//! let model = builder.build()?;
//!
//! // Steps end at the requested times; inputs are constant in between.
//! let mut session = model.session()?;
//! session.set(push, 10.0)?;
//! session.step_to(0.25)?;
//! // x = F/k (1 - cos ωt) with ω² = k/m = 25/s².
//! let expected = 0.2 * (1.0 - 1.25_f64.cos());
//! assert!((session.output(place)?[0] - expected).abs() < 1e-7);
//! assert!((session.quantity(stored)? - 25.0 * expected * expected).abs() < 1e-6);
//! // The rail carries the cart.
//! assert!((session.output(support)?[2] - 2.0 * 9.81).abs() < 1e-6);
//!
//! // A copy is independent of the original.
//! let mut other = session.try_clone()?;
//! other.set(push, -10.0)?;
//! session.step_to(0.5)?;
//! other.step_to(0.5)?;
//! assert!(session.output(place)?[0] > other.output(place)?[0]);
//! # Ok(())
//! # }
//! ```
//!
//! # Many sessions of one model
//!
//! [`Model::prepare`] builds the system once; all sessions that start from a [`Prepared`] model share it, in any number of
//! threads. Each may start from a [`State`](core::system::State) of its own:
//!
//! ```
//! use lissom::builder::{ModelBuilder, analyses::Dynamics, outputs::Position, parts::PointMass};
//!
//! # fn main() -> Result<(), Box<dyn std::error::Error>> {
//! let mut builder = ModelBuilder::new();
//! builder.gravity([0.0, 0.0, -9.81]);
//! let stone = builder.add(PointMass::new(1.0));
//! let place = builder.add(Position::new(stone));
//! builder.add(Dynamics::new(1.0).step(0.1));
//! let prepared = builder.build()?.prepare()?;
//! for speed in [1.0, 2.0, 3.0] {
//!     let mut state = prepared.state().clone();
//!     prepared.set_velocity(&mut state, stone, [speed, 0.0, 0.0], [0.0; 3])?;
//!     let mut session = prepared.session_from(state)?;
//!     session.step_to(1.0)?;
//!     assert!((session.output(place)?[0] - speed).abs() < 1e-12);
//! }
//! # Ok(())
//! # }
//! ```
//!
//! # More
//!
//! The state of a session between two steps is stored and restored by [`Session::snapshot`] and [`Session::restore`], to the last
//! bit. Results are written to files with a [`ResultFolder`]. [`modes`], [`buckling`], [`PathSession`], [`response`], [`linearize`],
//! [`campbell`] and [`gradient`] are analyses without steps in time, [`sweep`] and [`analyses::study`] run a model many times.
//! [`core`] contains what is below a session, for elements and analyses of one's own, and [`model`] the types of a model file. The
//! crate's `examples` folder contains programs that check themselves: a pendulum, an arm with an external controller, a thousand
//! copies on all cores, an element of one's own.

pub mod analyses;
mod analysis_warning;
pub mod builder;
mod catalogue;
mod command_error;
mod diagnostic;
mod encodings;
pub mod exchange;
mod failures;
mod ids;
mod model_text;
pub mod motion;
pub mod pictures;
mod results;
mod run;
mod session;
pub mod start;
pub mod sweep;
pub mod units;

pub use analyses::buckling::buckling;
pub use analyses::campbell::{CampbellRequest, campbell};
pub use analyses::gradient::gradient;
pub use analyses::linearize::{LinearizeRequest, linearize};
pub use analyses::modes::{ModeRequest, modes};
pub use analyses::path::PathSession;
pub use analyses::reduce::{ReduceRequest, reduce};
pub use analyses::response::{ResponseRequest, response};
pub use analysis_warning::AnalysisWarning;
pub use catalogue::catalogue;
pub use command_error::CommandError;
pub use diagnostic::with_code;
pub use encodings::sealed;
pub use lissom_core as core;
pub use lissom_core::diagnostics::{Diagnose, Diagnostic, Severity};
pub use lissom_model as model;
pub use lissom_model::files::FileError;
pub use lissom_model::output::{Column, Record, Summary, Writer};
pub use lissom_model::{Document, Report};
pub use model_text::{Model, Override, Value};
pub use motion::RecordedRun;
pub use results::checkpoint::{Checkpoint, CheckpointError, CheckpointEvery, CheckpointFile};
pub use results::folder::{FolderError, ResultFolder, protect_results};
pub use results::recorded_modes::RecordedModes;
pub use results::summary;
pub use run::report::{EnergyChange, RunError, RunReport, Stopped};
pub use run::results::{ColumnError, IncompleteRun, Results};
pub use run::state_writer::StateWriter;
pub use run::telemetry;
pub use run::timings::Seconds;
pub use session::{
    Checkpoints, JointCoordinateError, JointCoordinates, JointDynamics, PartError, Prepared, Progress,
    ReadError, Session, SessionError, SessionSnapshot, StartError, columns,
};

/// Version of the program, as in every summary.
pub const VERSION: &str = env!("CARGO_PKG_VERSION");

/// The example of the crate's README, which is compiled and run with those of the documentation.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;
