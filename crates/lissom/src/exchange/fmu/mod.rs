//! Models as functional mock-up units (FMI 3.0, co-simulation): their variables, and the archive with model, description and
//! the shared library that simulates it. The library itself is built in `crates/lissom-fmi`.

mod description;

use lissom_core::diagnostics::Diagnose;
use std::collections::BTreeMap;

use crate::start::lower;
use lissom_model::document::AnalysisKind;
use lissom_model::numbers::written_numbers;
use lissom_model::{Document, Report};
use serde::{Deserialize, Serialize};

use crate::model_text::{Model, Override};
use crate::session::columns;

pub use crate::units::platform;

/// Name of the shared library in a unit, without its extension.
pub const LIBRARY: &str = "lissom_fmi";
/// Name of the file with the model among the resources of a unit.
pub const MODEL_FILE: &str = "model.json";

/// Why a model cannot become a unit.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
#[error("{}", self.diagnostic())]
pub enum FmuError {
    /// The model is invalid.
    #[error(transparent)]
    Model(#[from] Report),
    /// The analysis has no time history.
    NotInTime(&'static str),
    /// Two variables would have the same name.
    SameName(String),
    /// The archive cannot be made.
    Archive(#[from] std::io::Error),
}

/// Role of a variable of a unit.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Causality {
    /// The time.
    Independent,
    /// An entry of `[inputs]`, which can be set while the unit runs.
    Input,
    /// An entry of `[parameters]` with a numeric value, which can be set before the unit runs.
    Parameter,
    /// A column that the model records.
    Output,
}

/// A variable of a unit, a real number. Its value reference is its index.
#[derive(Clone, Debug, PartialEq)]
pub struct Variable {
    /// Name of the variable: that of the input, parameter or column.
    pub name: String,
    /// Role of the variable.
    pub causality: Causality,
    /// Initial value of inputs and parameters; none for others.
    pub start: Option<f64>,
    /// Unit of the variable; empty for none.
    pub unit: String,
    /// Recorded quantity of outputs.
    pub quantity: String,
}

/// Variables and time range of a unit.
#[derive(Clone, Debug, PartialEq)]
pub struct Interface {
    /// All variables: the time, inputs, parameters, outputs. The value reference of each is its index.
    pub variables: Vec<Variable>,
    /// First and last time of the model's analysis [s].
    pub span: [f64; 2],
    /// Step of the model's analysis [s]; none for adaptive steps, or for load steps.
    pub step: Option<f64>,
    /// One line about the model.
    pub title: String,
}

/// A model with all its files, as stored among the resources of a unit.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct PackedModel {
    /// Version of the program that packed it.
    pub version: String,
    /// Name of the model in messages.
    pub name: String,
    /// Text of the model.
    pub text: String,
    /// Overrides of the model.
    pub overrides: Vec<Override>,
    /// Texts of the files that it includes, by path.
    pub included: BTreeMap<String, String>,
}

impl PackedModel {
    /// A model.
    ///
    /// # Errors
    /// If the model is invalid.
    pub fn of(model: &Model) -> Result<Self, Report> {
        // The files are read when the document is built.
        lower(&model.document()?)?;
        Ok(Self {
            version: crate::VERSION.to_owned(),
            name: model.name().to_owned(),
            text: model.text().to_owned(),
            overrides: model.overrides().to_vec(),
            included: model.included(),
        })
    }

    /// The model.
    pub fn model(&self) -> Model {
        let model = Model::from_text(&self.name, &self.text).with_included(self.included.clone());
        model.with_overrides(&self.overrides)
    }

    /// As the text of a JSON object.
    ///
    /// # Panics
    /// Never: texts are valid JSON.
    pub fn to_json(&self) -> String {
        serde_json::to_string(self).expect("texts can always be said in JSON")
    }

    /// Identifier of the unit: equal for equal models and versions.
    pub fn token(&self) -> String {
        // FNV-1a, from two initial values.
        let hash = |start: u64| {
            let byte = |hash: u64, byte: u8| (hash ^ u64::from(byte)).wrapping_mul(0x0000_0100_0000_01b3);
            self.to_json().bytes().fold(start, byte)
        };
        format!("{:016x}{:016x}", hash(0xcbf2_9ce4_8422_2325), hash(0x8422_2325_cbf2_9ce4))
    }
}

impl Interface {
    /// The interface of a unit of `model`.
    ///
    /// # Errors
    /// If the model is invalid, has no time history, or two variables would have the same name.
    pub fn of(model: &Model) -> Result<Self, FmuError> {
        let document = model.document()?;
        let step = match &document.analysis.kind {
            AnalysisKind::Dynamics { step, control } => control.is_none().then_some(step.value),
            AnalysisKind::Statics { .. } => None,
            other => return Err(FmuError::NotInTime(other.name())),
        };
        let variables = variables(model, &document)?;
        let mut names: Vec<&str> = variables.iter().map(|variable| variable.name.as_str()).collect();
        names.sort_unstable();
        if let Some(pair) = names.windows(2).find(|pair| pair[0] == pair[1]) {
            return Err(FmuError::SameName(pair[0].to_owned()));
        }
        let span = [document.analysis.start, document.analysis.end];
        Ok(Self { variables, span, step, title: document.title.unwrap_or_default() })
    }
}

fn variables(model: &Model, document: &Document) -> Result<Vec<Variable>, FmuError> {
    let plain = |name: &str, causality, start| Variable {
        name: name.to_owned(),
        causality,
        start,
        unit: String::new(),
        quantity: String::new(),
    };
    let time = Variable { unit: "s".to_owned(), ..plain("time", Causality::Independent, None) };
    let inputs =
        document.inputs.iter().map(|(name, start)| plain(&name.value, Causality::Input, Some(*start)));
    let parameters = written_numbers(model.text(), model.overrides(), "parameters")
        .into_iter()
        .map(|(name, value)| plain(&format!("parameters.{name}"), Causality::Parameter, Some(value)));
    let lowered = lower(document)?;
    let outputs = columns(&lowered.channels).into_iter().map(|column| Variable {
        unit: column.unit.clone(),
        quantity: column.quantity.clone(),
        ..plain(&column.name(), Causality::Output, None)
    });
    let mut all = vec![time];
    all.extend(inputs);
    all.extend(parameters);
    all.extend(outputs);
    Ok(all)
}

/// The archive of a unit. `library` is the shared library for this machine's platform.
///
/// # Errors
/// If the model is invalid or cannot become a unit.
pub fn export(model: &Model, library: &[u8]) -> Result<Vec<u8>, FmuError> {
    let packed = PackedModel::of(model)?;
    let interface = Interface::of(model)?;
    let description = description::xml(&packed, &interface);
    let binary = format!("binaries/{}/{LIBRARY}{}", platform(), std::env::consts::DLL_SUFFIX);
    let (resource, text) = (format!("resources/{MODEL_FILE}"), packed.to_json());
    let files =
        [("modelDescription.xml", description.as_bytes()), (&resource, text.as_bytes()), (&binary, library)];
    Ok(crate::encodings::archive::zip(&files)?)
}
