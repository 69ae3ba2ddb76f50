//! Conversion of a checked document to a system, with the core's builder and the registry. Contains no mechanics.

mod analysis;
mod connections;
mod contacts;
mod couplings;
mod delay;
mod discrete_filter;
mod distributed;
mod elastic_solids;
mod latches;
mod local_loads;
mod measurements;
mod names;
mod order;
mod output_channels;
mod over_argument;
mod parts;
mod ports;
mod pressures;
mod readings;
pub mod registry;
mod resource_limits;
mod shells;
mod signal_references;
mod signals;
mod straight_line;
mod superelements;
mod units;

use std::sync::Arc;

use lissom_flexible::beam::section_error::{ExaminedBeams, SectionError};
use lissom_mechanics::kinematics::{CoordinateId, NodeId};
use lissom_system::accumulated::Accumulated;
use lissom_system::{Builder, State, System};

pub use contacts::FrictionPoints;

use crate::document::Document;
use crate::functions::Ramp;
use crate::outputs::channels::Channel;
use crate::outputs::entry::{Output, OutputSource};
use crate::outputs::kinds::Subject;
use crate::outputs::reaction::REACTION;
use crate::outputs::section::SECTION_MOMENT;
use crate::reading::node_reference::NodeReference;
use crate::text::report::{Located, Problem, Report};

pub use analysis::{Plan, Records, settings};
pub use names::Names;
pub use resource_limits::check_run;

/// A system with the names of its parts. Positions and velocities at the start may still be changed.
pub struct Built {
    /// The system.
    pub system: System,
    /// Positions and velocities at the start.
    pub state: State,
    /// Where the parts of the model are among the nodes and coordinates, and its signals.
    pub names: Names,
    /// Values of coordinates at the start, as given [rad, m].
    pub start_values: Vec<(CoordinateId, f64)>,
}

/// Quantities that are recorded.
pub struct Observed {
    /// Quantities to be recorded.
    pub channels: Vec<Channel>,
    /// Quantities to be accumulated over the steps, for channels.
    pub accumulated: Vec<Arc<dyn Accumulated>>,
}

/// Builds the system that a document describes, with all degrees of freedom of some nodes locked.
///
/// # Errors
/// All problems found, underlined in the model's text.
pub fn build(document: &Document, locked: &[NodeId]) -> Result<Built, Report> {
    let mut problems = Vec::new();
    resource_limits::check(document, &mut problems);
    stop_at(document, &mut problems)?;
    let mut builder = Builder::new();
    builder.set_gravity(document.gravity);
    let mut names = Names {
        joints: document.joints.iter().map(|joint| joint.name.value.clone()).collect(),
        inputs: document.inputs.iter().map(|(name, _)| name.value.clone()).collect(),
        ..Names::default()
    };
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
    let start_values = builder.start_values().to_vec();
    let (system, state) = builder
        .build(document.analysis.start)
        .map_err(|error| document.report(vec![Problem::error(document.analysis.span, error.to_string())]))?;
    Ok(Built { system, state, names, start_values })
}

impl Built {
    /// Gives parts the velocities of the document.
    pub fn set_velocities(&mut self, document: &Document) {
        parts::velocities(document, &self.names, &self.system, &mut self.state.kinematics);
    }

    /// Binds outputs and readings. Displacements count from the states `[drawn, undeformed]`.
    ///
    /// # Errors
    /// All problems, and those found before.
    pub fn observe(
        &mut self,
        document: &Document,
        [drawn, undeformed]: [&State; 2],
        mut problems: Vec<Problem>,
    ) -> Result<Observed, Report> {
        let Self { system, state, names, .. } = self;
        contacts::start(names.contacts.compliant.values().flatten(), &mut state.kinematics);
        couplings::check(document, system, state, &mut problems);
        let (channels, accumulated) =
            output_channels::of(document, system, (drawn, undeformed), &names.resolver(), &mut problems);
        let readings =
            readings::bind(&names.references.readings, &channels, accumulated.len(), &mut problems);
        system.assign_readings(readings);
        stop_at(document, &mut problems)?;
        system.beams = ExaminedBeams {
            elements: names.lines.iter().map(|(name, line)| (name.clone(), line.elements.clone())).collect(),
            section_errors: section_errors(document, names, system),
            sections_at_joints: sections_at_joints(document, names, system),
        };
        Ok(Observed { channels, accumulated })
    }
}

/// Errors of all section forces and moments that are recorded.
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
