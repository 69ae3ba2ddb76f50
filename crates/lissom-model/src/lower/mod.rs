//! Conversion of a checked document to a system, with the core's builder and the registry. Contains no mechanics.

mod analysis;
mod assembly;
mod beam_contacts;
mod connections;
mod contacts;
mod couplings;
mod discrete_filter;
mod distributed;
mod initial_state;
mod latches;
mod local_loads;
mod measurements;
mod order;
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

use std::collections::BTreeMap;
use std::sync::Arc;

use lissom_core::assembly::{AssemblyError, assemble};
use lissom_core::elements::beam::line::BeamLine;
use lissom_core::elements::beam::section_error::{ExaminedBeams, SectionError};
use lissom_core::elements::local_load::LocalLoad;
use lissom_core::errors::Warning;
use lissom_core::kinematics::{CoordinateId, Kinematics, NodeId, Quantity};
use lissom_core::registry::ParameterError;
use lissom_core::settings::Settings;
use lissom_core::signals::{Argument, DiscreteValueId, SignalId};
use lissom_core::simulation::accumulated::Accumulated;
use lissom_core::system::{Builder, ElementId, State, System};
use lissom_motion::Motion;

pub use contacts::FrictionPoints;

use crate::channels::Channel;
use crate::contact_point::{ContactPoint, RigidPoint};
use crate::document::{
    Component, DEFAULT_ASSEMBLY_TOLERANCE as ASSEMBLY_TOLERANCE, Document, NodeReference, Output,
    OutputSource, Subject, interface_name,
};
use crate::functions::Ramp;
use crate::output_channels;
use crate::outputs::reaction::REACTION;
use crate::outputs::section::SECTION_MOMENT;
use crate::outputs::{Deformed, Resolver};
use crate::report::{Located, Problem, Report};
use crate::sweep::TimeWindow;

pub use analysis::{Plan, Records};
pub use assembly::{Assembly, Brought, MovedPart};
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

/// Nodes, coordinates and signals by the names of the model.
#[derive(Clone, Default)]
pub struct Names {
    /// Node of each body and point mass.
    pub nodes: BTreeMap<String, NodeId>,
    /// Nodes of each superelement, in the order of its interfaces; they are also among `nodes`, as `superelement.interface`.
    pub superelements: BTreeMap<String, Vec<NodeId>>,
    /// Deformation of each superelement.
    pub deformations: BTreeMap<String, Deformed>,
    /// Nodes and elements of each beam.
    pub lines: BTreeMap<String, BeamLine>,
    /// Coordinates of each joint; a drive has those of the joint it drives.
    pub coordinates: BTreeMap<String, Vec<CoordinateId>>,
    /// Springs that have an elongation, and whether it is a length or an angle.
    pub springs: BTreeMap<String, (ElementId, Quantity)>,
    /// Index of each latch among the springs.
    pub latches: BTreeMap<String, usize>,
    /// Springs, loads and joints' friction, whose power can be determined.
    pub powers: BTreeMap<String, ElementId>,
    /// Points of each contact.
    pub(crate) contacts: BTreeMap<String, Vec<ContactPoint>>,
    /// Points of each rigid contact.
    pub(crate) rigid_contacts: BTreeMap<String, Vec<RigidPoint>>,
    /// Points of each local load.
    pub(crate) local_loads: BTreeMap<String, Vec<LocalLoad>>,
    /// Loads on coordinates of joints; those of size zero have no element.
    pub actuators: Vec<(CoordinateId, Option<ElementId>)>,
    /// Signals, inputs and states.
    pub signals: BTreeMap<String, Argument>,
    /// Values of sampled signals between samples.
    samples: BTreeMap<String, DiscreteValueId>,
    /// Those of the signals that are straight lines of time, a + b t.
    lines_of_time: BTreeMap<SignalId, (f64, f64)>,
    /// Components of outputs and of joints' coordinates that signals use, by the names they are written with and whether the
    /// signals are sampled.
    measured: BTreeMap<(String, bool), Argument>,
    /// Those of them that are of elements, which are added after signals.
    later_measurements: Vec<measurements::LaterMeasurement>,
    /// Those of them that are read at samples.
    readings: Vec<readings::NamedReading>,
    /// Outputs that are expressions and are being resolved, each named by the one before.
    open_expressions: Vec<String>,
}

impl Names {
    /// The node a reference means.
    fn node(&self, reference: &Located<NodeReference>) -> Result<NodeId, Problem> {
        let unknown = |name: &str| {
            Problem::error(reference.span, format!("there is no part called `{name}`"))
                .help("name a body, a point mass, a beam's end or `ground`")
        };
        match &reference.value {
            NodeReference::Ground => Ok(lissom_core::kinematics::GROUND),
            NodeReference::Body(name) | NodeReference::PointMass(name) => {
                self.nodes.get(name).copied().ok_or_else(|| unknown(name))
            }
            NodeReference::Interface { superelement, interface } => {
                let name = interface_name(superelement, interface);
                self.nodes.get(&name).copied().ok_or_else(|| unknown(&name))
            }
            NodeReference::Beam { beam, fraction } => {
                let line = self.lines.get(beam).ok_or_else(|| unknown(beam))?;
                line.node_at(*fraction).ok_or_else(|| no_node(reference, beam, line, *fraction))
            }
        }
    }
}

/// A position on a beam where something is attached has no node.
fn no_node(reference: &Located<NodeReference>, beam: &str, line: &BeamLine, fraction: f64) -> Problem {
    let nearest = line
        .places
        .iter()
        .copied()
        .min_by(|a, b| (a - fraction).abs().total_cmp(&(b - fraction).abs()))
        .unwrap_or(0.0);
    Problem::error(reference.span, format!("beam `{beam}` has no node at {fraction}"))
        .label("nothing can be attached here")
        .help(format!("the nearest node is at {nearest:.6}; or choose the number of elements to suit"))
}

/// A core complaint about a component's parameter, underlined.
fn parameter_problem(component: &Component, error: &ParameterError) -> Problem {
    Problem::error(component.span_of(&error.parameter), format!("`{}`: {error}", component.name.value))
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
        output_channels::of(document, &system, (&drawn, &state), &names.resolver(), &mut problems);
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

impl Names {
    fn resolver(&self) -> Resolver<'_> {
        Resolver {
            nodes: &self.nodes,
            lines: &self.lines,
            deformations: &self.deformations,
            coordinates: &self.coordinates,
            springs: &self.springs,
            latches: &self.latches,
            powers: &self.powers,
            contacts: &self.contacts,
            local_loads: &self.local_loads,
            rigid_contacts: &self.rigid_contacts,
            signals: &self.signals,
        }
    }
}

fn stop_at(document: &Document, problems: &mut Vec<Problem>) -> Result<(), Report> {
    if problems.is_empty() { Ok(()) } else { Err(document.report(std::mem::take(problems))) }
}
