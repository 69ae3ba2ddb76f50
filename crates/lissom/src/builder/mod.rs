//! Models built in code: typed entries instead of tables, ids instead of names, expressions with the operators of Rust.
//!
//! The builder creates a model file: [`ModelBuilder::to_toml`] returns it, and the file reader reads it. So both have the same
//! kinds, defaults, checks and error messages, and a model from code and from a file has the same results, to the last bit.
//!
//! ```
//! use lissom::builder::analyses::Dynamics;
//! use lissom::builder::joints::Revolute;
//! use lissom::builder::outputs::Relative;
//! use lissom::builder::parts::Body;
//! use lissom::builder::{GROUND, ModelBuilder};
//!
//! let mut builder = ModelBuilder::new();
//! builder.gravity([0.0, 0.0, -9.81]);
//! let rod = builder.add(Body::new(1.0, [0.01, 0.01, 0.001]).position([0.5, 0.0, 0.0]));
//! let hinge = builder.add(Revolute::new(GROUND, rod, [0.0, 1.0, 0.0]).at([0.0; 3]));
//! let angle = builder.add(Relative::new(hinge));
//! builder.add(Dynamics::new(0.5).relative_tolerance(1e-8));
//! let mut session = builder.build()?.session()?;
//! session.step_to(0.2)?;
//! assert!(session.output(angle)?[0] > 0.3);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! Mistakes are reported as for files, with the position in the code:
//!
//! ```
//! use lissom::builder::{ModelBuilder, analyses::Dynamics, parts::PointMass};
//!
//! let mut builder = ModelBuilder::new();
//! builder.add_named("stone", PointMass::new(-1.0));
//! builder.add(Dynamics::new(1.0));
//! let report = builder.build().expect_err("a mass cannot be negative").render(false);
//! assert!(report.contains("`mass` of point mass `stone` must be greater than zero, not -1"), "{report}");
//! ```

mod entry;
mod expression;
mod feedback;
mod values;
mod written;

mod entries;

use std::fmt::Write;
use std::ops::Range;
use std::panic::Location;

use lissom_model::toml_text::{key, quoted};
use lissom_model::{Problem, Report, Sources, Span};

use crate::ids::{Id, IdNames, Table};
use crate::model_text::Model;

pub use crate::ids::{
    AnalysisId, BeamId, BodyId, ContactId, EventId, FluidId, ForeignId, GroundId, HydraulicId, InitialId,
    InputId, JointId, LoadId, LocalLoadId, MaterialId, MotionId, OutputId, Part, PointMassId, Quantity,
    SectionId, SignalId, SpringId, StateId, SuperelementId,
};
pub use entries::feedback::{Event, State};
pub use entries::{
    analyses, contacts, hydraulics, joints, loads, motions, outputs, parts, sections, springs, words,
};
pub use entry::Entry;
pub use expression::{Expression, Function, TabulatedFunction};
pub use feedback::{Input, Signal};
pub use values::{GROUND, Inertia, Mass, Matrix, Node, PositionOrNode, SectionMass, Shear, Solid};

use written::Written;

/// Name in messages of a model without a title.
const UNTITLED: &str = "model built in code";

/// An entry and the location where it was added.
struct Added {
    table: Table,
    name: String,
    written: Written,
    at: &'static Location<'static>,
    /// Whether another entry of the table has this name.
    is_repeated: bool,
}

/// Collects the entries of a model.
pub struct ModelBuilder {
    names: IdNames,
    title: Option<String>,
    gravity: Option<[f64; 3]>,
    added: Vec<Added>,
}

impl Default for ModelBuilder {
    fn default() -> Self {
        Self::new()
    }
}

impl ModelBuilder {
    /// A model that contains only the ground.
    pub fn new() -> Self {
        Self { names: IdNames::new(), title: None, gravity: None, added: Vec::new() }
    }

    /// Sets the description of the model, in one line.
    pub fn title(&mut self, title: &str) {
        self.title = Some(title.to_owned());
    }

    /// Sets the acceleration of gravity [m/s²].
    pub fn gravity(&mut self, acceleration: impl Into<[f64; 3]>) {
        self.gravity = Some(acceleration.into());
    }

    /// Adds an entry with a generated name, such as `revolute_1`.
    #[track_caller]
    pub fn add<E: Entry>(&mut self, entry: E) -> E::Id {
        let mut number = 1;
        let mut name = format!("{}_1", E::WORD);
        while self.names.has(&name) {
            number += 1;
            name = format!("{}_{number}", E::WORD);
        }
        self.keep(name, entry, Location::caller())
    }

    /// Adds an entry with a name, which is used in tables of results and messages. The analysis and the motion of all parts at
    /// the start have no names.
    #[track_caller]
    pub fn add_named<E: Entry>(&mut self, name: &str, entry: E) -> E::Id {
        self.keep(name.to_owned(), entry, Location::caller())
    }

    fn keep<E: Entry>(&mut self, name: String, entry: E, at: &'static Location<'static>) -> E::Id {
        let table = <E::Id as Id>::TABLE;
        let is_same = |other: &Added| other.table == table && (table.is_single() || other.name == name);
        let is_repeated = self.added.iter().any(is_same);
        self.added.push(Added { table, name: name.clone(), written: entry.written(), at, is_repeated });
        self.names.add(name)
    }

    /// The name of an entry.
    ///
    /// # Errors
    /// If the id belongs to another model.
    pub fn name(&self, id: impl Id) -> Result<&str, ForeignId> {
        self.names.name(id)
    }

    /// The model file that was built.
    ///
    /// # Errors
    /// If an entry uses an id of another model, or has the name of another one.
    pub fn to_toml(&self) -> Result<String, Report> {
        let mut text = String::from("lissom = 1\n");
        if let Some(title) = &self.title {
            line(&mut text, &format!("title = {}", quoted(title)));
        }
        if let Some([x, y, z]) = self.gravity {
            // No id is in three numbers.
            let vector = Written::from([x, y, z]).toml(&self.names, "").unwrap_or_default();
            line(&mut text, &format!("gravity = {vector}"));
        }
        let mut entries: Vec<&Added> = self.added.iter().collect();
        entries.sort_by_key(|added| added.table);
        let mut problems = Vec::new();
        let mut heading = "";
        for added in entries {
            let word = added.table.word();
            if word != heading {
                line(&mut text, &format!("\n[{word}]"));
                heading = word;
            }
            let (range, written) = self.write(added, &mut text);
            let span = Span::from(range);
            if let Err(foreign) = written {
                let help = "add all parts of a model to one builder";
                problems.push(Problem::error(span, format!("`{}`: {foreign}", added.name)).help(help));
            }
            if added.is_repeated {
                let message = if added.table.is_single() {
                    format!("there are two [{word}]")
                } else {
                    format!("two entries of [{word}] are called `{}`", added.name)
                };
                problems.push(Problem::error(span, message).help("leave one out, or give it another name"));
            }
        }
        if problems.is_empty() {
            Ok(text)
        } else {
            Err(Report::new(problems, &Sources::new(self.source(), &text)))
        }
    }

    /// Appends an entry to `text`; returns its position.
    fn write(&self, added: &Added, text: &mut String) -> (Range<usize>, Result<(), ForeignId>) {
        let start = text.len();
        let mut wrong = Ok(());
        let lines = match &added.written {
            Written::Fields(fields) if added.table.is_single() => fields.lines(&self.names, &added.name),
            written => written
                .toml(&self.names, &added.name)
                .map(|value| vec![format!("{} = {value}", key(&added.name))]),
        };
        let lines = lines.unwrap_or_else(|foreign| {
            wrong = Err(foreign);
            vec![format!("# {}", added.name)]
        });
        for (index, words) in lines.iter().enumerate() {
            let at = if index == 0 { format!(" # {}", added.at) } else { String::new() };
            line(text, &format!("{words}{at}"));
        }
        (start..start + lines.first().map_or(0, String::len), wrong)
    }

    /// The model's name in messages.
    fn source(&self) -> &str {
        self.title.as_deref().unwrap_or(UNTITLED)
    }

    /// The model. It may be simulated many times, from several threads, and with overrides, as models from files.
    ///
    /// # Errors
    /// All its mistakes, as for a model file.
    pub fn build(&self) -> Result<Model, Report> {
        let model = Model::from_text(self.source(), &self.to_toml()?).with_ids(self.names.clone());
        model.document()?;
        Ok(model)
    }
}

fn line(text: &mut String, words: &str) {
    // Writing to a string cannot fail.
    let _ = writeln!(text, "{words}");
}
