//! The model file as plain data: everything named, checked and in SI, with the positions of names and values kept
//! for later error messages. Independent of system, unknowns and time scheme.

pub(crate) mod analysis;
mod analysis_tables;
mod assembly;
mod beams;
mod bodies;
mod components;
mod connections;
mod contacts;
pub(crate) mod decode;
mod distributed;
mod elastic_solids;
mod entries;
mod events;
mod ground;
mod hydraulics;
mod initial;
mod load_input;
mod local_loads;
mod materials;
mod meshes;
pub(crate) mod model_text;
mod outputs;
mod places;
mod plausibility;
mod ports;
mod shells;
mod signals;
mod solids;
mod superelements;
pub(crate) mod tables;
mod temperatures;
mod units;
mod unloaded;

use std::borrow::Cow;
use std::collections::BTreeMap;
use std::sync::Arc;

use lissom_contact::forms::PlacedSolid;
use lissom_flexible::superelement::ReducedMatrices;
use lissom_mechanics::elements::Sheave;
use lissom_mechanics::ports::Ports;
use lissom_mechanics::registry::Parameters;
use lissom_motion::{Matrix3, Vector3, Vector6};
use lissom_system::schemes::ContactSolution;
use nalgebra::DMatrix;

use crate::expression::{Expression, Formula};
use crate::line::Line;
use crate::sections::Outline;
use crate::sections::{Isotropic, SectionProperties};
use crate::surface::Surface;
use crate::text::report::{Located, Problem, Report, Sources, Span};
use lissom_mesh::MeshedPart;

pub use crate::format::top_level::VERSION;
pub use crate::outputs::entry::{Output, OutputSource, ReactionAxes};
pub use crate::outputs::kinds::OutputKind;
pub(crate) use crate::outputs::kinds::{Feature, Subject};
pub use crate::reading::node_reference::{MeshPlace, NodeReference, interface_name};
pub use analysis::{Analysis, AnalysisKind, DEFAULT_BUCKLING_COUNT, DEFAULT_MODE_COUNT, Scaling, StepChoice};
pub use assembly::{AssemblyRequest, DEFAULT_ASSEMBLY_TOLERANCE, OnTip};
pub use contacts::{
    CompliantLaw, ContactEntry, ContactLaw, FlexibleLaw, FlexiblePart, Way, table_of_solutions,
};
pub use distributed::DistributedForce;
pub use elastic_solids::{ElasticSolid, FacePressure};
pub use events::EventEntry;
pub use ground::Ground;
pub use hydraulics::HydraulicEntry;
pub use local_loads::{LocalExpression, LocalLaw, LocalLoadEntry, LocalName, LocalState};
pub(crate) use shells::area_arguments;
pub use shells::{AreaLoad, Layer, Shell};
pub use signals::{DelayEntry, DiscreteFilter, SignalEntry, StateEntry};
pub use units::{UnitEntry, UnitEquations, UnitGroup, UnitMode};

/// A model as it was written, checked.
///
/// ```
/// use lissom_model::Document;
/// use lissom_model::registry::Registry;
///
/// let text = r#"
/// lissom = 1
/// [point_masses.ball]
/// mass = 0.2
/// velocity = [3, 0, "sqrt(2)"]
/// [analysis]
/// kind = "dynamics"
/// end = 1
/// step = 1e-3
/// "#;
/// let document = Document::parse(text, "ball.toml", &Registry::default()).expect("a good model");
/// assert_eq!(document.point_masses[0].mass, 0.2);
///
/// let report = Document::parse(&text.replace("mass = 0.2", "mas = 0.2"), "ball.toml", &Registry::default());
/// assert!(report.expect_err("a bad model").render(false).contains("did you mean `mass`?"));
/// ```
#[derive(Clone, Debug)]
pub struct Document {
    /// One line about the model.
    pub title: Option<String>,
    /// Acceleration of gravity [m/s²], zero by default.
    pub gravity: Vector3,
    /// Numbers by name.
    pub parameters: BTreeMap<String, f64>,
    /// Materials in the order of the file, as all that follow.
    pub materials: Vec<Material>,
    /// Cross sections.
    pub sections: Vec<Section>,
    /// Positions by name [m].
    pub points: BTreeMap<String, Vector3>,
    /// Flexible beams.
    pub beams: Vec<Beam>,
    /// Shells.
    pub shells: Vec<Shell>,
    /// Elastic solids.
    pub elastic_solids: Vec<ElasticSolid>,
    /// Rigid bodies.
    pub bodies: Vec<Body>,
    /// Point masses.
    pub point_masses: Vec<PointMass>,
    /// Superelements.
    pub superelements: Vec<Superelement>,
    /// Joints.
    pub joints: Vec<Component>,
    /// Springs.
    pub springs: Vec<Component>,
    /// Loads.
    pub loads: Vec<Component>,
    /// Loads that depend on the motion of their own points.
    pub local_loads: Vec<LocalLoadEntry>,
    /// The shape of the ground.
    pub ground: Ground,
    /// Contacts between parts.
    pub contacts: Vec<ContactEntry>,
    /// Numbers set from outside, with their values at the start.
    pub inputs: Vec<(Located<String>, f64)>,
    /// Named expressions of time, inputs, states and outputs.
    pub signals: Vec<SignalEntry>,
    /// First-order states.
    pub states: Vec<StateEntry>,
    /// Actions when expressions cross zero.
    pub events: Vec<EventEntry>,
    /// Units of other programs.
    pub units: Vec<UnitEntry>,
    /// Hydraulic parts; their equations are among the states, signals, loads and springs.
    pub hydraulics: Vec<HydraulicEntry>,
    /// A rigid motion of all parts at the start.
    pub initial: Option<InitialMotion>,
    /// Rigid motions at the start of parts that move otherwise, by the names of bodies, point masses and beams.
    pub initial_of_parts: BTreeMap<String, InitialMotion>,
    /// Correction of approximate positions; none if all joints must be closed.
    pub assembly: Option<AssemblyRequest>,
    /// Quantities to be recorded.
    pub outputs: Vec<Output>,
    /// Kind of analysis.
    pub analysis: Analysis,
    /// Warnings about probable mistakes.
    pub warnings: Report,
    sources: Sources,
}

impl Document {
    /// A report of problems found later, underlined in the model's text.
    pub fn report(&self, problems: Vec<Problem>) -> Report {
        Report::new(problems, &self.sources)
    }

    /// Names of the events.
    pub fn event_names(&self) -> Vec<&str> {
        self.events.iter().map(|event| event.name.value.as_str()).collect()
    }

    /// Where a part of an expression is, whose text is within `whole`.
    pub(crate) fn within(&self, whole: Span, text: &str, range: &std::ops::Range<usize>) -> Span {
        self.sources.within(whole, text, range)
    }

    /// Initial rigid motion of the body, point mass or beam `part`; none if it is not specified.
    pub fn initial_motion(&self, part: &str) -> Option<&InitialMotion> {
        self.initial_of_parts.get(part).or(self.initial.as_ref())
    }

    /// The model with contacts as elements, which linear models need.
    pub fn with_contacts_as_elements(&self) -> Cow<'_, Self> {
        if self.analysis.contacts == ContactSolution::Elements {
            return Cow::Borrowed(self);
        }
        let mut changed = self.clone();
        changed.analysis.contacts = ContactSolution::Elements;
        Cow::Owned(changed)
    }

    /// Whether positions at the start are those of static equilibrium.
    pub fn starts_in_equilibrium(&self) -> bool {
        self.initial.is_some_and(|initial| initial.equilibrium)
    }

    /// Whether positions at the start are those of a steady rotation.
    pub fn starts_in_steady_rotation(&self) -> bool {
        self.initial.is_some_and(|initial| initial.steady_rotation)
    }

    /// The section called `name`.
    pub fn section(&self, name: &str) -> Option<&Section> {
        self.sections.iter().find(|section| section.name.value == name)
    }

    /// The beam called `name`.
    pub fn beam(&self, name: &str) -> Option<&Beam> {
        self.beams.iter().find(|beam| beam.name.value == name)
    }

    /// Names and meshes of all shells and solids.
    pub fn meshes(&self) -> impl Iterator<Item = (&Located<String>, &Arc<MeshedPart>)> {
        let shells = self.shells.iter().map(|own| (&own.name, &own.mesh));
        shells.chain(self.elastic_solids.iter().map(|own| (&own.name, &own.mesh)))
    }

    /// The mesh of the shell or solid called `name`.
    pub fn mesh(&self, name: &str) -> Option<&MeshedPart> {
        self.meshes().find(|(own, _)| own.value == name).map(|(_, mesh)| &**mesh)
    }

    /// The shell called `name`.
    pub fn shell(&self, name: &str) -> Option<&Shell> {
        self.shells.iter().find(|shell| shell.name.value == name)
    }
}

/// An isotropic elastic material.
#[derive(Clone, Debug, PartialEq)]
pub struct Material {
    /// Name.
    pub name: Located<String>,
    /// Constants of the material.
    pub constants: Isotropic,
}

/// A cross section.
#[derive(Clone, Debug, PartialEq)]
pub struct Section {
    /// Name.
    pub name: Located<String>,
    /// Shape for drawings.
    pub outline: Outline,
    /// Stiffness, mass and damping.
    pub properties: SectionProperties,
}

/// A section at a position along a beam.
#[derive(Clone, Debug, PartialEq)]
pub struct Station {
    /// Fraction of the beam, 0 to 1.
    pub at: f64,
    /// Name of the section there.
    pub section: Located<String>,
}

/// A flexible beam.
#[derive(Clone, Debug, PartialEq)]
pub struct Beam {
    /// Name.
    pub name: Located<String>,
    /// Sections from 0 to 1, linear between, two at one place where it changes at once; a single one for a uniform beam.
    pub stations: Vec<Station>,
    /// Reference line.
    pub line: Line,
    /// Where the line is described.
    pub line_span: Span,
    /// Node of another part that is this beam's first node.
    pub shared_start: Option<Located<NodeReference>>,
    /// Node of another part that is this beam's last node.
    pub shared_end: Option<Located<NodeReference>>,
    /// Number of elements.
    pub elements: Located<usize>,
    /// Polynomial order: elements of `order + 1` nodes.
    pub order: usize,
    /// Direction towards which local axis 3 is oriented; nowhere parallel to the line.
    pub up: Vector3,
    /// Turn about the tangent [rad], an expression of the fraction `s`.
    pub twist: Expression,
    /// Forces per length.
    pub distributed: Vec<DistributedForce>,
    /// Temperature above that of the state without stress over `s` [K].
    pub temperature: Expression,
    /// Change of the temperature along axes 2 and 3 [K/m].
    pub temperature_slope: [f64; 2],
}

impl Beam {
    /// Axes 1, 2 and 3 at the fraction `s`, as columns.
    pub fn frame(&self, s: f64) -> Matrix3 {
        self.line.frame(s, &self.up, self.twist.jet(s).value)
    }

    /// Strains without forces at the fraction `s` of a section that expands by so much per change of temperature [-, 1/m].
    pub fn free_strains(&self, s: f64, expansion: f64) -> Vector6 {
        let [along_2, along_3] = self.temperature_slope;
        // A fibre at x2, x3 has the strain ε1 + x3 κ2 - x2 κ3.
        expansion * Vector6::new(self.temperature.jet(s).value, 0.0, 0.0, 0.0, along_3, -along_2)
    }

    /// Section properties at the fraction `s`, from the sections of `document`: where they change at once those on the side of `towards`.
    pub fn properties(&self, document: &Document, s: f64, towards: f64) -> Option<SectionProperties> {
        let of =
            |station: &Station| document.section(&station.section.value).map(|section| section.properties);
        // Places of nodes are rounded.
        let is_passed = |at: f64| if (at - s).abs() < 1e-9 { towards >= s } else { at < s };
        let next = self
            .stations
            .partition_point(|station| is_passed(station.at))
            .clamp(1, self.stations.len().max(1));
        let before = self.stations.get(next - 1)?;
        match self.stations.get(next) {
            None => of(before),
            Some(after) => Some(of(before)?.towards(&of(after)?, (s - before.at) / (after.at - before.at))),
        }
    }
}

/// A rigid body.
#[derive(Clone, Debug, PartialEq)]
pub struct Body {
    /// Name.
    pub name: Located<String>,
    /// Mass [kg].
    pub mass: f64,
    /// Inertia about the centre of mass in body axes [kg m²].
    pub inertia: Matrix3,
    /// Position of the reference frame [m].
    pub position: Vector3,
    /// Body axes as columns in global axes.
    pub axes: Matrix3,
    /// Centre of mass in body axes [m].
    pub center_of_mass: Vector3,
    /// Shape for drawings, if it is specified.
    pub surface: Option<Arc<Surface>>,
    /// Solids with which it touches others.
    pub(crate) solids: Vec<PlacedSolid>,
    /// Velocity of the reference point at the start, global axes [m/s]; `None` leaves it to the initial motion.
    pub velocity: Option<Located<Vector3>>,
    /// Angular velocity at the start, body axes [rad/s]; `None` leaves it to the initial motion.
    pub angular_velocity: Option<Located<Vector3>>,
}

/// A plane of the global axes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Plane {
    /// x and y.
    Xy,
    /// y and z.
    Yz,
    /// z and x.
    Zx,
}

/// A mass without extension.
#[derive(Clone, Debug, PartialEq)]
pub struct PointMass {
    /// Name.
    pub name: Located<String>,
    /// Mass [kg].
    pub mass: f64,
    /// Position at the start [m].
    pub position: Vector3,
    /// The plane it stays in; free in space when `None`.
    pub plane: Option<Plane>,
    /// Shape to be drawn, if it is specified.
    pub surface: Option<Arc<Surface>>,
    /// Solids with which it touches others.
    pub(crate) solids: Vec<PlacedSolid>,
    /// Velocity at the start, global axes [m/s]; `None` leaves it to the initial motion.
    pub velocity: Option<Located<Vector3>>,
}

/// A linear elastic part that is given by reduced matrices.
#[derive(Clone, Debug, PartialEq)]
pub struct Superelement {
    /// Name.
    pub name: Located<String>,
    /// Position of the origin of its axes [m].
    pub position: Vector3,
    /// Axes of the part as columns in global axes.
    pub axes: Matrix3,
    /// Interfaces of the part, in the order of the matrices.
    pub interfaces: Vec<Interface>,
    /// Index of the interface that carries the floating frame.
    pub floating: usize,
    /// Matrices of the part, checked.
    pub matrices: ReducedMatrices,
    /// Matrix for outputs from its unknowns, one row per output.
    pub recovery: Option<Arc<DMatrix<f64>>>,
}

impl Superelement {
    /// Position of an interface at the start, in global axes [m].
    pub fn place_of(&self, interface: &str) -> Option<Vector3> {
        let found = self.interfaces.iter().find(|own| own.name == interface)?;
        Some(self.position + self.axes * found.place)
    }
}

/// An interface of a superelement.
#[derive(Clone, Debug, PartialEq)]
pub struct Interface {
    /// Name within the superelement.
    pub name: String,
    /// Position in the axes of the part [m].
    pub place: Vector3,
}

/// A joint, with the word of one of its coordinates, or with all of them.
pub type CoordinateName = (Located<String>, Option<String>);

/// A node, and a location on it.
#[derive(Clone, Debug, PartialEq)]
pub struct NodeLocation {
    /// The node.
    pub node: Located<NodeReference>,
    /// Location at the start [m]; none for that of the node.
    pub at: Option<Vector3>,
    /// The sheave of a rope with its centre there; its joint is the next coordinate.
    pub sheave: Option<Sheave>,
}

/// What a joint, spring or load is attached to, in the order of the ports of its kind.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Attachment {
    /// Nodes, such as base and tip.
    pub nodes: Vec<NodeLocation>,
    /// Directions at the start, global axes, not normalised.
    pub axes: Vec<Located<Vector3>>,
    /// Coordinates of joints.
    pub coordinates: Vec<CoordinateName>,
    /// Names of beams.
    pub beams: Vec<Located<String>>,
}

impl Attachment {
    /// The names of the joints whose coordinates it acts on; adjacent ones of one joint once.
    pub fn joints(&self) -> Vec<&str> {
        let mut joints: Vec<&str> = self.coordinates.iter().map(|(joint, _)| joint.value.as_str()).collect();
        joints.dedup();
        joints
    }
}

/// A joint, spring or load of a registered kind.
#[derive(Clone, Debug)]
pub struct Component {
    /// Name.
    pub name: Located<String>,
    /// Word of its kind.
    pub kind: Located<String>,
    /// The ports of its kind.
    pub ports: Ports,
    /// What it is attached to.
    pub attachment: Attachment,
    /// The parameters of its kind that were given.
    pub parameters: Parameters,
    /// Where each of them is.
    pub parameter_spans: Vec<(String, Span)>,
    /// Size of the component and the key it is given by, where it is more than a function of time. Its parameter is then 1.
    pub signal: Option<(&'static str, Located<Formula>)>,
    /// A latch on a joint: the value of its coordinate at which it engages [m, rad].
    pub latch: Option<Located<f64>>,
    /// Where a latch on a joint lets go: where this rises through zero.
    pub release: Option<Located<Formula>>,
    /// Friction in a joint: the parameters of a friction element on its coordinate.
    pub friction: Option<Located<Parameters>>,
    /// Position of a joint on its tip, if different from that on its base.
    pub on_tip: Option<Located<OnTip>>,
}

impl Component {
    /// Where the parameter `name` is, or the component's own name.
    pub fn span_of(&self, name: &str) -> Span {
        let found = self.parameter_spans.iter().find(|(known, _)| known == name);
        found.map_or(self.name.span, |(_, span)| *span)
    }
}

/// A rigid motion given to every part at the start, in global axes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct InitialMotion {
    /// Velocity of the point `about` [m/s].
    pub velocity: Vector3,
    /// Angular velocity [rad/s].
    pub angular_velocity: Vector3,
    /// A point of the motion [m].
    pub about: Vector3,
    /// Whether the positions at the start are those of static equilibrium.
    pub equilibrium: bool,
    /// Whether the positions at the start are those of a steady rotation with the velocities given.
    pub steady_rotation: bool,
    /// Whether flexible parts without given velocities start with the velocity of their drive.
    pub follow_drives: bool,
}
