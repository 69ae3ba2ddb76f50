//! Reduction of a flexible assembly to the matrices of a superelement: selection of the parts, their state, and the files
//! that describe the superelement.

mod recovery;
mod report;

use lissom_core::catalogued;
use lissom_core::diagnostics::Diagnose;
use std::collections::BTreeSet;
use std::path::Path;

use self::recovery::Recovery;
use crate::start::{Lowered, lower, lower_locked};
use lissom_core::flexible::superelement::ReducedMatrices;
use lissom_core::kinematics::{Kinematics, LOCKED, Layout, NodeId};
use lissom_core::linearized::{Assembly, ReductionError};
use lissom_core::registry::ParameterError;
use lissom_model::Document;
use lissom_model::document::{Attachment, Component, MeshPlace, NodeReference};
use lissom_model::lower::Names;
use serde::Deserialize;

use crate::analyses::interface::{Analysis, AnalysisError, Origin};
use crate::analyses::modes::ModesError;
use crate::analyses::operating_point::OperatingPoint;
use crate::analysis_warning::AnalysisWarning;
use crate::model_text::Model;

/// Modes for corrections: this multiple of the requested number, plus a constant. The contribution of further modes decreases
/// with the square of their number.
const SOUGHT: [usize; 2] = [3, 24];

/// Reduce flexible parts to a superelement with a few interface nodes and modes.
///
/// The results go to a folder: the matrices in the Matrix Market format and as a NumPy archive, and NAME.toml with the table
/// `[superelements.NAME]` that uses them. The stiffness includes the effect of the stresses in the state `--about`, by default static
/// equilibrium without gravity. Joints, springs and loads between an interface and the rest of the model are omitted.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[cfg_attr(
    feature = "clap",
    derive(clap::Args),
    command(after_help = "\
Examples:
  lissom reduce examples/tip-crank.toml --interfaces beam.start,beam.end --modes 6
  lissom reduce bracket.toml --interfaces hub,pin --modes 8 --recover root_stress
  lissom reduce turbine.toml --part blade1 --interfaces blade1.beam.start --modes 10 --name blade

Exit code: 0 success; 2 wrong model or command line; 3 no such state, or parts that are not one elastic assembly.")
)]
pub struct ReduceRequest {
    /// Parts to be reduced: bodies, point masses, beams, superelements, entries of [parts] [default: all].
    #[cfg_attr(feature = "clap", arg(long = "part", value_name = "NAME,…", value_delimiter = ','))]
    pub parts: Vec<String>,
    /// Interface nodes for joints, such as beam.start,beam.end; the floating frame is attached to the first one.
    #[cfg_attr(feature = "clap", arg(long, value_name = "NODE,…", value_delimiter = ',', required = true))]
    pub interfaces: Vec<String>,
    /// Number of modes with fixed interfaces.
    #[cfg_attr(feature = "clap", arg(long, value_name = "NUMBER", default_value_t = 10))]
    pub modes: usize,
    /// Omit correction shapes, which compensate for truncated modes where loads and rotation change the stiffness.
    #[cfg_attr(feature = "clap", arg(long = "modes-alone", action = clap::ArgAction::SetFalse))]
    pub corrections: bool,
    /// Modes of the free parts instead of those with fixed interfaces, without correction shapes.
    #[cfg_attr(feature = "clap", arg(long))]
    pub free_modes: bool,
    /// Outputs of the model to be recovered: stresses, forces and displacements in the reduced parts, as a matrix `recovery`.
    #[cfg_attr(feature = "clap", arg(long, value_name = "OUTPUT,…", value_delimiter = ','))]
    pub recover: Vec<String>,
    /// State about which the model is reduced: `static`, `undeformed` or a time of the model's analysis [s].
    #[cfg_attr(
        feature = "clap",
        arg(long, value_name = "STATE|TIME", default_value = "static", allow_negative_numbers = true)
    )]
    pub about: OperatingPoint,
    /// Name of the superelement [default: that of the only part, or of the model file].
    #[cfg_attr(feature = "clap", arg(long, value_name = "NAME"))]
    pub name: Option<String>,
}

impl ReduceRequest {
    /// Name of the superelement, with underscores for letters that names cannot have.
    fn name(&self, model: &Model) -> String {
        let given = self.name.clone().unwrap_or_else(|| match self.parts.as_slice() {
            [part] => part.clone(),
            _ => Path::new(model.name()).file_stem().unwrap_or_default().to_string_lossy().into_owned(),
        });
        given.replace(|c: char| !(c.is_alphanumeric() || matches!(c, '_' | '-')), "_")
    }
}

impl Analysis for ReduceRequest {
    const NAME: &'static str = "reduce";
    const FOLDER: &'static str = "reduced";
    type Report = ReduceReport;
    type Error = ReduceError;

    fn compute(&self, model: &Model) -> Result<ReduceReport, ReduceError> {
        reduce(model, self)
    }
}

/// A reduced assembly, as files and with its properties.
#[derive(Clone, Debug)]
pub struct ReduceReport {
    /// Name of the superelement.
    pub name: String,
    /// Names of text files and their texts.
    pub files: Vec<(String, String)>,
    /// The matrices as a NumPy archive.
    pub archive: Vec<u8>,
    /// Frequencies of the modes with fixed interfaces [Hz].
    pub frequencies: Vec<f64>,
    /// Number of correction shapes after the modes.
    pub corrections: usize,
    /// Names of the interfaces.
    pub interfaces: Vec<String>,
    /// Names of the rows of the matrix `recovery`, with their units.
    pub recovered: Vec<(String, String)>,
    /// Coordinates before and after.
    pub unknowns: [usize; 2],
    /// Mass [kg].
    pub mass: f64,
    /// Whether the state has forces at the interfaces.
    pub is_preloaded: bool,
    /// Warnings.
    pub warnings: Vec<AnalysisWarning>,
}

/// Why a reduction failed.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
#[error("{}", self.diagnostic())]
pub enum ReduceError {
    /// There is no state, or the model is invalid.
    #[error(transparent)]
    State(#[from] ModesError),
    /// The request is invalid for the model.
    Question(String),
    /// The reduction cannot be computed.
    #[error(transparent)]
    Reduction(#[from] ReductionError),
    /// The matrices are not those of a free part.
    Matrices(#[from] ParameterError),
    /// The archive could not be packed.
    Archive(#[from] std::io::Error),
}

impl AnalysisError for ReduceError {
    fn origin(&self) -> Origin<'_> {
        match self {
            Self::State(ModesError::Model(report)) => Origin::Model(report),
            Self::Question(_) | Self::State(ModesError::Time { .. }) => Origin::Request,
            _ => Origin::Computation,
        }
    }
}

fn question<T>(words: impl Into<String>) -> Result<T, ReduceError> {
    Err(ReduceError::Question(words.into()))
}

/// Reduces parts of `model`. Gravity is omitted: weight belongs to the model that uses the superelement.
///
/// # Errors
/// If the request is invalid for the model, the state cannot be reached, or the parts are not an elastic assembly.
pub fn reduce(model: &Model, request: &ReduceRequest) -> Result<ReduceReport, ReduceError> {
    let mut document = model.document().map_err(ModesError::from)?;
    let has_gravity = document.gravity.norm() > 0.0;
    document.gravity.fill(0.0);
    let names = lower(&document).map_err(ModesError::from)?;
    let found: Result<(Kinematics, Layout, Vec<AnalysisWarning>), ModesError> =
        request.about.linearized(&document, |reached| {
            let layout = reached.model.system().layout().clone();
            Ok((reached.model.kinematics().clone(), layout, reached.warnings))
        });
    let (at, layout, mut warnings) = found?;
    if has_gravity {
        warnings.push(AnalysisWarning::GravityOmitted);
    }
    let chosen = Chosen::of(&document, request, &names.names)?;
    let own = chosen.document(&document, &request.recover)?;
    let Lowered { system, mut state, settings, names: own_names, channels, .. } =
        lower(&own).map_err(ModesError::from)?;
    take_places(system.layout(), &mut state.kinematics, (&layout, &at))?;
    let interfaces: Vec<NodeId> =
        chosen.interfaces.iter().map(|name| node_of(&own_names, name)).collect::<Result<_, _>>()?;
    if let Some(&node) = interfaces.iter().find(|&&node| system.layout().rows_of_node(node).contains(&LOCKED))
    {
        let name = system.layout().node_name(node);
        return question(format!(
            "`{name}` cannot be an interface: it has no rotations; clamp it to a body or a beam"
        ));
    }
    let inner = system.layout().coordinate_count() - 6 * interfaces.len();
    let locked =
        if inner == 0 { None } else { Some(lower_locked(&own, &interfaces).map_err(ModesError::from)?) };
    let assembly = Assembly {
        free: &system,
        locked: locked.as_ref().map(|lowered| &*lowered.system),
        state: &state,
        interfaces: &interfaces,
        solver: settings.solver,
    };
    // The lowest mode shows whether a part can move freely with fixed interfaces, even if no mode is requested. The
    // estimate of the effect of loads on the stiffness needs the omitted modes, with and without corrections.
    // Omitted modes with fixed interfaces would take with them parts of the free ones.
    let sought = if request.free_modes { request.modes } else { SOUGHT[0] * request.modes + SOUGHT[1] };
    let found = assembly.reduce(sought.min(inner), request.free_modes)?;
    let found = found.with_modes(request.modes, request.corrections && !request.free_modes);
    if found.frequencies.len() < request.modes {
        let number = found.frequencies.len();
        return question(format!(
            "there are only {number} modes with fixed interfaces: request at most as many by `--modes`"
        ));
    }
    if !found.is_counted && request.modes > 0 {
        warnings.push(AnalysisWarning::InterfaceModesUnknown);
    }
    if found.matrices.geometric.is_none() && inner > 0 {
        warnings.push(AnalysisWarning::FirstOrder);
    }
    let recovery = Recovery::of(&channels, (&system, &state), &found)?;
    let matrices = found.matrices.check(&found.places)?;
    let labels: Vec<String> = chosen.interfaces.iter().map(|name| label(name)).collect();
    let unknowns = [found.unknowns, matrices.mass.nrows()];
    let mass = (0..3).map(|k| total(&matrices, labels.len(), k)).sum::<f64>() / 3.0;
    let name = request.name(model);
    Ok(ReduceReport {
        files: report::files(&name, (&labels, &found.places), (&matrices, &recovery)),
        archive: report::archive((&labels, &found.places), (&matrices, &recovery))?,
        recovered: recovery.names,
        frequencies: found.frequencies,
        corrections: found.corrections,
        interfaces: labels,
        unknowns,
        mass,
        is_preloaded: !matrices.preload.is_empty(),
        warnings,
        name,
    })
}

/// Mass for translations along an axis.
fn total(matrices: &ReducedMatrices, interfaces: usize, axis: usize) -> f64 {
    let rows = || (0..interfaces).map(|i| 6 * i + axis);
    rows().flat_map(|row| rows().map(move |column| (row, column))).map(|at| matrices.mass[at]).sum()
}

/// Names of nodes that were separated at every comma, also at that between u and v.
fn joined_places(pieces: &[String]) -> Vec<String> {
    let mut names: Vec<String> = Vec::new();
    for piece in pieces {
        match names.last_mut() {
            Some(before) if before.contains('@') && piece.trim().parse::<f64>().is_ok() => {
                *before = format!("{before},{piece}");
            }
            _ => names.push(piece.clone()),
        }
    }
    names
}

/// The node of this name: a body, a point mass, an interface, a position on a beam, or a node of a shell or solid.
fn node_of(names: &Names, name: &str) -> Result<NodeId, ReduceError> {
    if let Some(&node) = names.nodes.get(name) {
        return Ok(node);
    }
    if let Some((part, place)) = name.split_once('@')
        && let Some(nodes) = names.meshes.nodes_of(part)
    {
        let numbers: Option<Vec<f64>> = place.split(',').map(|number| number.trim().parse().ok()).collect();
        return match numbers.and_then(|numbers| nodes.node_at(&MeshPlace::Fractions(numbers))) {
            Some(node) => Ok(node),
            None => question(format!(
                "`{name}` is no node: write u and v of one, and w of a solid, as \"panel@0.5,1\""
            )),
        };
    }
    if let Some((part, set)) = name.rsplit_once('.')
        && let Some(nodes) = names.meshes.nodes_of(part)
    {
        return match nodes.node_at(&MeshPlace::Set(set.to_owned())) {
            Some(node) => Ok(node),
            None => question(format!(
                "`{name}` is not one node: write a set of one node, as `{{ near = [x, y, z] }}`"
            )),
        };
    }
    let (beam, fraction) =
        match (name.strip_suffix(".start"), name.strip_suffix(".end"), name.split_once('@')) {
            (Some(beam), ..) => (beam, Some(0.0)),
            (_, Some(beam), _) => (beam, Some(1.0)),
            (.., Some((beam, fraction))) => (beam, fraction.trim().parse::<f64>().ok()),
            _ => (name, None),
        };
    let Some(line) = names.lines.get(beam) else {
        return question(format!(
            "the reduced parts have no node `{name}`: write a body, \"beam.start\", \"beam.end\", \"beam@0.5\" or \"shell.set\""
        ));
    };
    match fraction.and_then(|fraction| line.node_at(fraction)) {
        Some(node) => Ok(node),
        None => question(format!(
            "beam `{beam}` has no node at `{name}`: write its start, its end, or a node between elements"
        )),
    }
}

/// The name of an interface for the name of a node.
fn label(name: &str) -> String {
    name.chars().map(|c| if c.is_alphanumeric() || matches!(c, '_' | '-') { c } else { '_' }).collect()
}

/// Copies positions and coordinates of the whole model to those of a part of it, by name.
fn take_places(
    own: &Layout,
    at: &mut Kinematics,
    (layout, whole): (&Layout, &Kinematics),
) -> Result<(), ReduceError> {
    for node in own.nodes().skip(1) {
        let name = own.node_name(node);
        let found = layout.nodes().skip(1).find(|&other| layout.node_name(other) == name);
        match found {
            Some(other) => at.nodes[node] = whole.nodes[other],
            None => {
                return question(format!("the node `{name}` exists only with parts that are not reduced"));
            }
        }
    }
    for coordinate in own.coordinates() {
        let name = own.coordinate_name(coordinate);
        let found = layout.coordinates().find(|&other| layout.coordinate_name(other) == name);
        match found {
            Some(other) => at.coordinates[coordinate] = whole.coordinates[other],
            None => {
                return question(format!(
                    "the coordinate `{name}` exists only with parts that are not reduced"
                ));
            }
        }
    }
    Ok(())
}

/// The reduced part of a model.
struct Chosen {
    /// Names of parts.
    parts: BTreeSet<String>,
    /// Names of the interfaces' nodes.
    interfaces: Vec<String>,
    /// Names of the interfaces' nodes, and the corresponding nodes in the whole model.
    nodes: Vec<NodeId>,
    names: Names,
}

/// Relation of a component to the reduced parts.
enum Touches {
    /// It is not connected to them.
    Nothing,
    /// It is connected only to them.
    Inside,
    /// It connects interfaces to other parts.
    Interfaces,
}

impl Chosen {
    fn of(document: &Document, request: &ReduceRequest, names: &Names) -> Result<Self, ReduceError> {
        let all: Vec<&String> = (document.beams.iter().map(|beam| &beam.name.value))
            .chain(document.meshes().map(|(name, _)| &name.value))
            .chain(document.bodies.iter().map(|body| &body.name.value))
            .chain(document.point_masses.iter().map(|mass| &mass.name.value))
            .chain(document.superelements.iter().map(|element| &element.name.value))
            .collect();
        let mut parts = BTreeSet::new();
        for asked in &request.parts {
            let inside = format!("{asked}.");
            let before = parts.len();
            parts.extend(
                all.iter()
                    .filter(|name| **name == asked || name.starts_with(&inside))
                    .map(|name| (*name).clone()),
            );
            if parts.len() == before {
                let known = all.iter().map(|name| format!("`{name}`")).collect::<Vec<_>>().join(", ");
                return question(format!(
                    "there is no part `{asked}`; parts that can be reduced are {known}"
                ));
            }
        }
        if request.parts.is_empty() {
            parts.extend(all.into_iter().cloned());
        }
        let interfaces = joined_places(&request.interfaces);
        if interfaces.is_empty() {
            return question("specify at least one interface by `--interfaces`, such as beam.start,beam.end");
        }
        let nodes: Vec<NodeId> =
            interfaces.iter().map(|name| node_of(names, name)).collect::<Result<_, _>>()?;
        for (index, node) in nodes.iter().enumerate() {
            if nodes[..index].contains(node) {
                return question(format!("the interface `{}` is specified twice", interfaces[index]));
            }
        }
        Ok(Self { parts, interfaces, nodes, names: names.clone() })
    }

    fn is_part(&self, node: &NodeReference) -> bool {
        match node {
            NodeReference::Ground => false,
            NodeReference::Body(name) | NodeReference::PointMass(name) => self.parts.contains(name),
            NodeReference::Beam { beam, .. } => self.parts.contains(beam),
            NodeReference::Mesh { part, .. } => self.parts.contains(part),
            NodeReference::Interface { superelement, .. } => self.parts.contains(superelement),
        }
    }

    fn is_interface(&self, node: &NodeReference) -> bool {
        let found = match node {
            NodeReference::Ground => None,
            NodeReference::Body(name) | NodeReference::PointMass(name) => self.names.nodes.get(name).copied(),
            NodeReference::Mesh { part, place } => {
                self.names.meshes.nodes_of(part).and_then(|nodes| nodes.node_at(place))
            }
            NodeReference::Beam { beam, fraction } => {
                self.names.lines.get(beam).and_then(|line| line.node_at(*fraction))
            }
            NodeReference::Interface { superelement, interface } => {
                self.names.nodes.get(&format!("{superelement}.{interface}")).copied()
            }
        };
        found.is_some_and(|node| self.nodes.contains(&node))
    }

    /// The relation of nodes to the parts.
    fn touches(&self, component: &Component, nodes: &[&NodeReference]) -> Result<Touches, ReduceError> {
        let inside = nodes.iter().filter(|node| self.is_part(node)).count();
        if inside == 0 {
            return Ok(Touches::Nothing);
        }
        if inside == nodes.len() && nodes.len() > 1 {
            return Ok(Touches::Inside);
        }
        if nodes.iter().all(|node| !self.is_part(node) || self.is_interface(node)) {
            return Ok(Touches::Interfaces);
        }
        question(format!(
            "`{}` connects a part that is not reduced to a node that is not an interface: make that node an interface, or remove `{0}` \
            by `--unset`",
            component.name.value
        ))
    }

    /// Rejects distributed loads, and beams that are connected to other parts elsewhere than at interfaces.
    fn refuse_beams(&self, own: &Document) -> Result<(), ReduceError> {
        let shells = own.shells.iter().filter(|shell| !shell.loads.is_empty()).map(|shell| &shell.name);
        let solids = own.elastic_solids.iter().filter(|solid| !solid.pressures.is_empty());
        if let Some(name) = shells.chain(solids.map(|solid| &solid.name)).next() {
            return question(format!(
                "`{}` has pressure or forces per area, which a superelement cannot represent: remove them",
                name.value
            ));
        }
        for beam in &own.beams {
            if !beam.distributed.is_empty() {
                return question(format!(
                    "beam `{}` has distributed forces, which a superelement cannot represent: remove them",
                    beam.name.value
                ));
            }
            for shared in beam.shared_start.iter().chain(&beam.shared_end) {
                if !self.is_part(&shared.value) {
                    return question(format!(
                        "beam `{}` shares a node with a part that is not reduced: reduce that part as well, or connect them by a clamp",
                        beam.name.value
                    ));
                }
            }
        }
        Ok(())
    }

    /// The document of the parts only: external components on the interfaces are omitted.
    fn document(&self, whole: &Document, recovered: &[String]) -> Result<Document, ReduceError> {
        let mut own = whole.clone();
        let known: Vec<&str> = own.outputs.iter().map(|output| output.name.value.as_str()).collect();
        if let Some(name) = recovered.iter().find(|name| !known.contains(&name.as_str())) {
            return question(format!(
                "there is no output `{name}` to recover; outputs are {}",
                known.join(", ")
            ));
        }
        own.outputs.retain(|output| recovered.contains(&output.name.value));
        let is_in = |name: &String| self.parts.contains(name);
        own.beams.retain(|beam| is_in(&beam.name.value));
        own.shells.retain(|shell| is_in(&shell.name.value));
        own.elastic_solids.retain(|solid| is_in(&solid.name.value));
        own.bodies.retain(|body| is_in(&body.name.value));
        own.point_masses.retain(|mass| is_in(&mass.name.value));
        own.superelements.retain(|element| is_in(&element.name.value));
        own.events.clear();
        own.signals.clear();
        own.states.clear();
        own.inputs.clear();
        own.initial = None;
        own.initial_of_parts.clear();
        self.refuse_beams(&own)?;
        let mut joints: BTreeSet<String> = BTreeSet::new();
        let keep = |component: &Component, joints: &BTreeSet<String>| -> Result<bool, ReduceError> {
            let Attachment { nodes, coordinates, beams, .. } = &component.attachment;
            let nodes: Vec<&NodeReference> = nodes.iter().map(|own| &own.node.value).collect();
            let has_part = nodes.iter().any(|node| self.is_part(node));
            if !beams.is_empty() {
                let start = |beam: &str| NodeReference::Beam { beam: beam.to_owned(), fraction: 0.0 };
                if has_part || beams.iter().any(|beam| self.is_part(&start(&beam.value))) {
                    return question(format!(
                        "`{}` slides along a beam, which a superelement cannot represent: remove it, or reduce other parts",
                        component.name.value
                    ));
                }
                return Ok(false);
            }
            let are_reduced = coordinates.iter().all(|(joint, _)| joints.contains(&joint.value));
            if nodes.is_empty() {
                return Ok(!coordinates.is_empty() && are_reduced);
            }
            // A rope with drums is kept or omitted as a whole.
            if !are_reduced && has_part {
                return question(format!(
                    "`{}` has a drum that is not reduced: remove it, or reduce the part with the drum as well",
                    component.name.value
                ));
            }
            if !are_reduced {
                return Ok(false);
            }
            Ok(matches!(self.touches(component, &nodes)?, Touches::Inside))
        };
        // Joints between nodes come before components on their coordinates.
        for pass in [true, false] {
            for component in &whole.joints {
                if component.ports.connect_two_nodes() == pass && keep(component, &joints)? {
                    joints.insert(component.name.value.clone());
                }
            }
        }
        own.joints.retain(|component| joints.contains(&component.name.value));
        let mut springs = Vec::new();
        for component in &whole.springs {
            if keep(component, &joints)? {
                springs.push(component.clone());
            }
        }
        own.springs = springs;
        let mut loads = Vec::new();
        for component in &whole.loads {
            if keep(component, &joints)? {
                loads.push(component.clone());
            }
        }
        own.loads = loads;
        let by_signal = own.springs.iter().chain(&own.loads).find(|component| component.signal.is_some());
        if let Some(component) = by_signal {
            return question(format!(
                "`{}` depends on a signal, which a superelement cannot represent: remove it by `--unset`",
                component.name.value
            ));
        }
        Ok(own)
    }
}

catalogued! {
    Failure ReduceError {
        Question { 0 => reason } => "reduction-request" {
            cause: "{reason}",
            remedy: "",
            meaning: "The parts, interfaces or modes requested for a reduction do not match the model, or have elements that a \
                      superelement cannot represent.",
            advice: "Follow the message: change the interfaces, or remove the named elements by `--unset`.",
        }
        Matrices { 0 => error } => "reduction-matrices" {
            cause: "the reduced {error}, so the reduction cannot be used",
            remedy: "check whether the parts are free to move as a rigid body",
            meaning: "The reduced matrices are not those of a free part: rigid motions cause forces, or the mass is not positive.",
            advice: "Remove connections of the parts to the ground, and check their masses.",
        }
        Archive { 0 => error } => "reduction-archive" {
            cause: "the archive of matrices cannot be packed: {error}",
            remedy: "reduce the number of modes or interfaces",
            meaning: "The matrices exceed the size of a NumPy archive, or memory is insufficient.",
        }
    } wraps {
        State { 0 => error } => error.diagnostic(),
        Reduction { 0 => error } => error.diagnostic(),
    }
}
