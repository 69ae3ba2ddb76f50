//! Models at their start: positions of an assembly or of a steady rotation, drives, and redundant constraints.

mod assembly;
mod drives;
mod immobile;
mod redundancy;
mod steady;

use std::sync::Arc;

use lissom_core::assembly::{AssemblyError, assemble};
use lissom_core::errors::Warning;
use lissom_core::kinematics::{CoordinateId, Kinematics, NodeId};
use lissom_core::settings::Settings;
use lissom_core::system::accumulated::Accumulated;
use lissom_core::system::{State, System};
use lissom_model::channels::Channel;
use lissom_model::document::{DEFAULT_ASSEMBLY_TOLERANCE, Document};
use lissom_model::lower::{Built, Names, Observed, Plan, build, settings};
use lissom_model::scene::Placed;
use lissom_model::sweep::TimeWindow;
use lissom_model::{Problem, Remark, Report};

pub use assembly::{Assembly, Brought, MovedPart};

use crate::units::{self, ReadUnit};

/// A model ready to run. Copies share the system.
#[derive(Clone)]
pub struct Lowered {
    /// The simulated system.
    pub system: Arc<System>,
    /// Positions and velocities at the start.
    pub state: State,
    /// Scheme, step size, scaling, limits, solver.
    pub settings: Settings,
    /// From when to when, in how many steps.
    pub plan: Plan,
    /// Quantities to be recorded.
    pub channels: Vec<Channel>,
    /// Part of the records from which statistics are computed.
    pub statistics_window: TimeWindow,
    /// Quantities to be accumulated over the steps, for channels.
    pub accumulated: Vec<Arc<dyn Accumulated>>,
    /// Names of the columns that are not unique because constraints repeat each other at the start.
    pub not_unique: Vec<String>,
    /// Where the parts of the model are among the nodes and coordinates, and its signals.
    pub names: Names,
    /// Information about the model before the run.
    pub warnings: Vec<Warning>,
    /// Result of the assembly, if requested.
    pub assembly: Option<Assembly>,
    /// Units of other programs, in the order of the graph of signals: those with samples, then those with equations.
    pub units: Vec<ReadUnit>,
    /// Nodes that assemblies leave where they are.
    fixed: Vec<NodeId>,
}

impl Lowered {
    /// The positions at the start, changed so that coordinates of joints have these values [rad, m] and all joints close.
    ///
    /// # Errors
    /// If there are none nearby.
    pub fn positions_with(&self, values: &[(CoordinateId, f64)]) -> Result<Kinematics, AssemblyError> {
        let mut at = self.state.kinematics.clone();
        assemble(
            &self.system,
            &mut at,
            &assembly::request(&self.names, &self.fixed, values, DEFAULT_ASSEMBLY_TOLERANCE),
        )?;
        Ok(at)
    }

    /// Where its parts are, for a scene.
    pub fn placed(&self) -> Placed<'_> {
        Placed {
            names: &self.names,
            nodes: &self.state.kinematics.nodes,
            drawn: self.assembly.as_ref().map(|assembly| &assembly.drawn[..]),
            is_static: self.plan.is_static,
        }
    }
}

/// Makes the system a document describes, for analyses of the system alone: without units of other programs, whose outputs are
/// unknown to them.
///
/// # Errors
/// All problems found, underlined in the model's text, and units.
pub fn lower(document: &Document) -> Result<Lowered, Report> {
    lower_locked(document, &[])
}

/// Makes the system a document describes, for a simulation in time.
///
/// # Errors
/// All problems found, underlined in the model's text.
pub fn lower_with_units(document: &Document) -> Result<Lowered, Report> {
    lower_of(document, &[])
}

/// Rejects units where their outputs would be missing, which depend on the past of a simulation.
///
/// # Errors
/// If the model has a unit.
pub(crate) fn reject_units(document: &Document) -> Result<(), Report> {
    document.units.first().map_or(Ok(()), |unit| {
        let message = format!("the unit `{}` has outputs only in a simulation in time", unit.name.value);
        let help = "replace its outputs by inputs, signals or states of this model for this command";
        Err(document.report(vec![Problem::error(unit.name.span, message).help(help)]))
    })
}

/// Makes the system that a document describes, with all degrees of freedom of some nodes locked.
///
/// # Errors
/// As [`lower`].
pub fn lower_locked(document: &Document, locked: &[NodeId]) -> Result<Lowered, Report> {
    reject_units(document)?;
    lower_of(document, locked)
}

fn lower_of(document: &Document, locked: &[NodeId]) -> Result<Lowered, Report> {
    let (document, read) = units::read(document)?;
    let document = &*document;
    let rejected = |problem: Problem| document.report(vec![problem]);
    let mut built = build(document, locked)?;
    let (settings, plan) = settings(document).map_err(rejected)?;
    let drawn = built.state.clone();
    let asked = document.assembly.as_ref();
    let assembled = asked.map(|asked| {
        let Built { system, state, names, start_values } = &mut built;
        assembly::assembled(document, asked, (system, names), start_values, &mut state.kinematics)
    });
    let assembly = assembled.transpose().map_err(rejected)?;
    built.set_velocities(document);
    // Displacements count from here, also where the motion begins deformed.
    let undeformed = built.state.clone();
    if document.starts_in_steady_rotation() {
        built.state =
            steady::steady_rotation(document, &built.system, &built.state, &settings).map_err(rejected)?;
    }
    let mut problems = Vec::new();
    let mut warnings = drives::drives(document, &built.system, &built.state, &mut problems);
    let Observed { channels, accumulated } = built.observe(document, [&drawn, &undeformed], problems)?;
    let Built { system, state, names, .. } = built;
    let (not_unique, doubt) = redundancy::not_unique(&system, &state, &channels);
    warnings.extend(doubt);
    warnings.extend(immobile::immobile(document, &system, &state));
    let graph = system.signals();
    let units = units::in_order(&read, graph.units.iter().map(|unit| unit.name.as_str()));
    let fixed = asked.map(|asked| assembly::fixed_nodes(asked, &names)).unwrap_or_default();
    Ok(Lowered {
        system: Arc::new(system),
        state,
        settings,
        plan,
        channels,
        statistics_window: document.analysis.records.statistics_window.clone(),
        accumulated,
        not_unique,
        names,
        warnings,
        assembly,
        units,
        fixed,
    })
}

/// The problems of a report as warnings of the catalogue.
pub fn warnings_of(report: &Report) -> impl Iterator<Item = Warning> {
    report.remarks().map(|Remark { part, message, help }| Warning::Model { part, message, help })
}
