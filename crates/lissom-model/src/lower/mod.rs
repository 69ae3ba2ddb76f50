//! Conversion of a checked document to a system, with the core's builder and the registry. Contains no mechanics.

mod analysis;
mod assembly;
mod beam_contacts;
mod connections;
mod contacts;
mod couplings;
mod delay;
mod discrete_filter;
mod distributed;
mod initial_state;
mod latches;
mod local_loads;
mod measurements;
mod names;
mod order;
mod output_channels;
mod over_argument;
mod parts;
mod ports;
mod readings;
mod redundancy;
pub mod registry;
mod resource_limits;
mod rigid_contacts;
mod signals;
mod straight_line;
mod superelements;

use std::sync::Arc;

use lissom_core::assembly::{AssemblyError, assemble};
use lissom_core::errors::Warning;
use lissom_mechanics::elements::beam::section_error::{ExaminedBeams, SectionError};
use lissom_mechanics::kinematics::{CoordinateId, Kinematics, NodeId};
use lissom_motion::Motion;
use lissom_system::accumulated::Accumulated;
use lissom_system::settings::Settings;
use lissom_system::{Builder, State, System};

pub use contacts::FrictionPoints;

use crate::document::{DEFAULT_ASSEMBLY_TOLERANCE as ASSEMBLY_TOLERANCE, Document};
use crate::functions::Ramp;
use crate::outputs::channels::Channel;
use crate::outputs::entry::{Output, OutputSource};
use crate::outputs::kinds::Subject;
use crate::outputs::reaction::REACTION;
use crate::outputs::section::SECTION_MOMENT;
use crate::reading::node_reference::NodeReference;
use crate::sweep::TimeWindow;
use crate::text::report::{Located, Problem, Report};

pub use analysis::{Plan, Records};
pub use assembly::{Assembly, Brought, MovedPart};
pub use names::Names;
pub use resource_limits::check_run;

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
            &assembly::request(&self.names, &self.fixed, values, ASSEMBLY_TOLERANCE),
        )?;
        Ok(at)
    }

    /// Frame of a node as the model describes it, which an assembly may have moved.
    pub fn drawn_frame(&self, node: NodeId) -> Motion {
        let at_start = || self.state.kinematics.nodes[node].frame;
        self.assembly.as_ref().map_or_else(at_start, |assembly| assembly.drawn[node])
    }
}

/// Makes the system a document describes.
///
/// # Errors
/// All problems found, underlined in the model's text.
pub fn lower(document: &Document) -> Result<Lowered, Report> {
    lower_locked(document, &[])
}

/// The same with all degrees of freedom of some nodes locked.
///
/// # Errors
/// As [`lower`].
pub fn lower_locked(document: &Document, locked: &[NodeId]) -> Result<Lowered, Report> {
    let mut problems = Vec::new();
    resource_limits::check(document, &mut problems);
    stop_at(document, &mut problems)?;
    let mut builder = Builder::new();
    builder.set_gravity(document.gravity);
    let mut names = Names::default();
    if document.analysis.ramp {
        let span = (document.analysis.start, document.analysis.end);
        builder.set_gravity_factor(Arc::new(Ramp { value: 1.0, span }));
    }
    if document.assembly.is_some() {
        builder.assemble_later();
    }
    parts::add(document, &mut builder, &mut names, &mut problems);
    for &node in locked {
        builder.lock(node);
    }
    stop_at(document, &mut problems)?;
    connections::add(document, &mut builder, &mut names, &mut problems);
    stop_at(document, &mut problems)?;
    let (settings, plan) = match analysis::settings(document) {
        Ok(chosen) => chosen,
        Err(problem) => return Err(document.report(vec![problem])),
    };
    let start_values = builder.start_values().to_vec();
    let built = builder
        .build(document.analysis.start)
        .map_err(|error| document.report(vec![Problem::error(document.analysis.span, error.to_string())]));
    let (mut system, mut state) = built?;
    let drawn = state.clone();
    let mut assembly = None;
    if let Some(asked) = &document.assembly {
        let model = (&system, &names);
        match assembly::assembled(document, asked, model, &start_values, &mut state.kinematics) {
            Ok(assembled) => assembly = Some(assembled),
            Err(problem) => return Err(document.report(vec![problem])),
        }
    }
    parts::velocities(document, &names, &system, &mut state.kinematics);
    // Displacements count from here, also where the motion begins deformed.
    let undeformed = state.clone();
    if document.starts_in_steady_rotation() {
        match initial_state::steady_rotation(document, &system, &state, &settings) {
            Ok(turning) => state = turning,
            Err(problem) => return Err(document.report(vec![problem])),
        }
    }
    contacts::start(names.contacts.values().flatten(), &mut state.kinematics);
    let mut warnings = initial_state::drives(document, &system, &state, &mut problems);
    couplings::check(document, &system, &state, &mut problems);
    let (channels, accumulated) =
        output_channels::of(document, &system, (&drawn, &undeformed), &names.resolver(), &mut problems);
    system.assign_readings(readings::bind(&names.readings, &channels, accumulated.len(), &mut problems));
    stop_at(document, &mut problems)?;
    system.beams = ExaminedBeams {
        elements: names.lines.iter().map(|(name, line)| (name.clone(), line.elements.clone())).collect(),
        section_errors: section_errors(document, &names, &system),
        sections_at_joints: sections_at_joints(document, &names, &system),
    };
    let (not_unique, doubt) = redundancy::not_unique(&system, &state, &channels);
    warnings.extend(doubt);
    let system = Arc::new(system);
    let asked = document.assembly.as_ref();
    let fixed = asked.map(|asked| assembly::fixed_nodes(asked, &names)).unwrap_or_default();
    Ok(Lowered {
        system,
        state,
        settings,
        plan,
        channels,
        statistics_window: document.analysis.statistics_window.clone(),
        accumulated,
        not_unique,
        names,
        warnings,
        assembly,
        fixed,
    })
}

/// Of all section forces and moments that are recorded.
fn section_errors(document: &Document, names: &Names, system: &System) -> Vec<SectionError> {
    let recorded = document.outputs.iter().filter(|output| output.kind.subject() == Subject::Section);
    let on_beam = |output: &Output| match &output.source {
        OutputSource::Node {
            node: Located { value: NodeReference::Beam { beam, fraction }, .. }, ..
        } => {
            let first = if output.kind.name() == SECTION_MOMENT.word { 3 } else { 0 };
            Some((beam.clone(), (*fraction, first)))
        }
        _ => None,
    };
    let sections: Vec<_> = recorded.filter_map(on_beam).collect();
    if sections.is_empty() {
        return Vec::new();
    }
    let attached = system.attached();
    let of = |(beam, place): (String, (f64, usize))| {
        let line = names.lines.get(&beam)?;
        Some(SectionError::new(&beam, line, place, |node| attached[node.index()]))
    };
    sections.into_iter().filter_map(of).collect()
}

/// At the ends of beams whose joints' reactions are recorded, force and moment.
fn sections_at_joints(document: &Document, names: &Names, system: &System) -> Vec<SectionError> {
    let recorded = document.outputs.iter().filter(|output| output.kind.name() == REACTION.word);
    let joints = recorded.filter_map(|output| match &output.source {
        OutputSource::Joint(name) => system.joints().iter().find(|joint| joint.name == name.value),
        _ => None,
    });
    let nodes: Vec<NodeId> =
        joints.flat_map(|joint| joint.frames.each_ref().map(|frame| frame.node)).collect();
    let attached = if nodes.is_empty() { Vec::new() } else { system.attached() };
    let mut sections = Vec::new();
    for (beam, line) in &names.lines {
        let ends = line.nodes.iter().zip(&line.places).filter(|(node, _)| nodes.contains(node));
        for (_, &place) in ends {
            let of = |first| SectionError::new(beam, line, (place, first), |node| attached[node.index()]);
            sections.extend([0, 3].map(of));
        }
    }
    sections
}

fn stop_at(document: &Document, problems: &mut Vec<Problem>) -> Result<(), Report> {
    if problems.is_empty() { Ok(()) } else { Err(document.report(std::mem::take(problems))) }
}
