//! What is recorded: named columns, evaluated from a system and its state.

use std::collections::BTreeMap;
use std::sync::Arc;

use lissom_core::elements::beam::line::{BeamLine, BeamProbe};
use lissom_core::elements::quadrature::gauss_lobatto;
use lissom_core::elements::shape::lagrange;
use lissom_core::elements::superelement::Deformation;
use lissom_core::joints::attached::AttachedJoint;
use lissom_core::joints::{Equations, MAX_COORDINATES};
use lissom_core::kinematics::{CoordinateId, Kinematics, NodeId, Quantity};
use lissom_core::signals::{Argument, SignalFunction};
use lissom_core::system::{ElementId, State, System};
use lissom_motion::{Matrix3, Motion, Rotation, Vector3, rotation_part, translation_part};
use nalgebra::DMatrix;

use crate::document::{
    Feature, NodeReference, Output, OutputKind, OutputSource, ReactionAxes, Subject, interface_name,
};
use crate::expression::Formula;
use crate::lower::Deformed;
use crate::observers::{Observer, Seen};
use crate::report::{Located, Problem};
use crate::superelement_channels::{self, recovered};
use crate::sweep::Fatigue;

/// One output: a name, its components, and how they are found.
#[derive(Clone)]
pub struct Channel {
    /// Name in the model.
    pub name: String,
    /// What it is.
    pub kind: OutputKind,
    /// Components, as `u1`.
    pub components: Vec<String>,
    /// Unit of all components, or of each where they differ.
    pub units: Vec<&'static str>,
    /// How its cycles are counted, if they are.
    pub fatigue: Option<Fatigue>,
    pub(crate) source: Source,
}

/// Names resolved by the lowering.
pub(crate) struct Resolver<'a> {
    pub(crate) nodes: &'a BTreeMap<String, NodeId>,
    pub(crate) lines: &'a BTreeMap<String, BeamLine>,
    pub(crate) deformations: &'a BTreeMap<String, Deformed>,
    pub(crate) coordinates: &'a BTreeMap<String, Vec<CoordinateId>>,
    pub(crate) springs: &'a BTreeMap<String, (ElementId, Quantity)>,
    /// Springs, loads and joints' friction.
    pub(crate) powers: &'a BTreeMap<String, ElementId>,
    /// Signals, inputs and states.
    pub(crate) signals: &'a BTreeMap<String, Argument>,
}

/// Value of a signal, an input or a state.
pub fn signal_value(system: &System, at: &Kinematics, argument: Argument) -> f64 {
    match argument {
        Argument::Held(held) => at.held[held],
        Argument::Signal(signal) => system.signals().value(signal, at),
        Argument::Measured(measurement) => system.signals().measured(measurement, at),
    }
}

/// A point that moves: carried by a node, or at a place in a beam element.
#[derive(Clone)]
pub(crate) enum Place {
    Carried {
        node: NodeId,
        offset: Vector3,
    },
    /// With the element's nodes, and where on each of them the line of sections goes through.
    OnBeam {
        probe: Arc<dyn BeamProbe>,
        xi: f64,
        point: Vector3,
        nodes: Vec<(NodeId, Vector3)>,
    },
}

/// Where a channel's numbers come from.
#[derive(Clone)]
pub(crate) enum Source {
    Place(Place, Motion),
    Joint(usize, ReactionAxes),
    RelativeMotion(usize),
    /// Of a wheel on a rail.
    Contact(usize),
    Drive(usize),
    Coupling(usize),
    Slider(usize),
    Coordinates(Vec<CoordinateId>),
    /// Of coordinates by joint and place in it.
    Accelerations(Vec<(usize, usize)>),
    /// Of coordinates that no joint between nodes has.
    FreeAccelerations(Vec<CoordinateId>),
    Spring(ElementId, Quantity),
    /// Power of an element.
    Power(ElementId),
    /// Power of a drive.
    DrivePower(usize),
    /// What the simulation accumulates.
    Accumulated(usize),
    /// Places along a beam.
    Line(Vec<Place>),
    /// Modal coordinates of a superelement.
    Modal(Arc<Deformation>),
    /// What a matrix makes of its unknowns.
    Recovered(Arc<Deformation>, Arc<DMatrix<f64>>),
    Energy,
    Momentum,
    Signal(Argument),
    /// An expression of components of other channels.
    Expression(Formula, Vec<(Channel, usize)>),
    /// A channel in other axes, or as seen from a frame that moves; with the frame at the start in the observer's.
    Observed {
        inner: Box<Source>,
        axes: Option<Observer>,
        relative_to: Option<(Observer, Motion)>,
    },
}

impl Place {
    /// Nodes that it depends on.
    pub(crate) fn nodes(&self) -> impl Iterator<Item = NodeId> + '_ {
        let (one, several) = match self {
            Self::Carried { node, .. } => (Some(*node), &[][..]),
            Self::OnBeam { nodes, .. } => (None, nodes.as_slice()),
        };
        one.into_iter().chain(several.iter().map(|(node, _)| *node))
    }

    pub(crate) fn frame(&self, at: &Kinematics) -> Motion {
        match self {
            Self::Carried { node, offset } => at.nodes[*node].frame * Motion::translation(*offset),
            Self::OnBeam { probe, xi, point, .. } => probe.frame_at(at, *xi) * Motion::translation(*point),
        }
    }

    /// Velocity and angular velocity in global axes.
    pub(crate) fn velocity(&self, at: &Kinematics) -> (Vector3, Vector3) {
        match self {
            Self::Carried { node, offset } => {
                let node = &at.nodes[*node];
                (node.velocity_at(offset), node.angular_velocity())
            }
            Self::OnBeam { probe, xi, point, .. } => {
                let rotation = probe.frame_at(at, *xi).rotation;
                let twist = probe.twist_at(at, *xi);
                let angular = rotation_part(&twist);
                (rotation.apply(&(translation_part(&twist) + angular.cross(point))), rotation.apply(&angular))
            }
        }
    }

    fn seen(&self, at: &Kinematics) -> Seen {
        let (velocity, angular_velocity) = self.velocity(at);
        Seen { frame: self.frame(at), velocity, angular_velocity, acceleration: self.acceleration(at) }
    }

    /// Acceleration in global axes; between a beam's nodes, those of the line and of its turning are interpolated from theirs.
    fn acceleration(&self, at: &Kinematics) -> Vector3 {
        match self {
            Self::Carried { node, offset } => at.nodes[*node].acceleration_at(offset),
            Self::OnBeam { probe, xi, point, nodes } => {
                let weights: Vec<f64> = match nodes.len() {
                    2 => lagrange::<2>(*xi).0.to_vec(),
                    3 => lagrange::<3>(*xi).0.to_vec(),
                    _ => lagrange::<4>(*xi).0.to_vec(),
                };
                let (mut line, mut turning) = (Vector3::zeros(), Vector3::zeros());
                for ((node, offset), weight) in nodes.iter().zip(weights) {
                    let node = &at.nodes[*node];
                    line += weight * node.acceleration_at(offset);
                    turning += weight * node.frame.rotation.apply(&rotation_part(&node.acceleration));
                }
                let rotation = probe.frame_at(at, *xi).rotation;
                let arm = rotation.apply(point);
                let spin = rotation.apply(&rotation_part(&probe.twist_at(at, *xi)));
                line + turning.cross(&arm) + spin.cross(&spin.cross(&arm))
            }
        }
    }
}

impl Channel {
    /// Appends the components' values.
    pub fn evaluate(&self, system: &System, state: &State, out: &mut Vec<f64>) {
        self.evaluate_source(&self.source, system, state, out);
    }

    fn evaluate_source(&self, source: &Source, system: &System, state: &State, out: &mut Vec<f64>) {
        let at = &state.kinematics;
        match source {
            Source::Expression(formula, arguments) => {
                let mut values = Vec::new();
                let arguments: Vec<f64> = arguments
                    .iter()
                    .map(|(channel, index)| {
                        values.clear();
                        channel.evaluate(system, state, &mut values);
                        values.get(*index).copied().unwrap_or(f64::NAN)
                    })
                    .collect();
                out.push(formula.value(at.time, &arguments, &[]));
            }
            Source::Observed { inner, axes, relative_to } => {
                let first = out.len();
                match (relative_to, &**inner) {
                    (Some((observer, start)), Source::Place(place, _)) => {
                        let seen = place.seen(at).relative_to(observer, (self.kind, start), at);
                        out.extend_from_slice(seen.as_slice());
                    }
                    (_, inner) => self.evaluate_source(inner, system, state, out),
                }
                let Some(axes) = axes else { return };
                // What is seen from an observer is in its axes, all else in global ones.
                let told_in =
                    relative_to.map_or(Rotation::IDENTITY, |(observer, _)| observer.frame(at).rotation);
                let axes = axes.frame(at).rotation;
                for part in out[first..].chunks_exact_mut(3) {
                    let vector = axes.apply_inverse(&told_in.apply(&Vector3::from_column_slice(part)));
                    part.copy_from_slice(vector.as_slice());
                }
            }
            Source::Place(place, start) => self.evaluate_place(place, start, at, out),
            Source::RelativeMotion(index) => {
                let Motion { rotation, position } = system.joints()[*index].output_motion(at);
                out.extend(position.iter().chain(rotation.logarithm().iter()));
            }
            Source::Contact(index) => evaluate_contact(&system.joints()[*index], state, out),
            Source::Joint(index, axes) => {
                let joint = &system.joints()[*index];
                let mu = multipliers(joint, state);
                let reaction = joint.reaction(at, &mu);
                let frame = match axes {
                    ReactionAxes::Ground => {
                        out.extend_from_slice(reaction.as_slice());
                        return;
                    }
                    ReactionAxes::Base => joint.output_frames[0],
                    ReactionAxes::Tip => joint.output_frames[1],
                };
                let axes = at.nodes[frame.node].frame.rotation * frame.offset.rotation;
                for part in [translation_part(&reaction), rotation_part(&reaction)] {
                    out.extend_from_slice(axes.apply_inverse(&part).as_slice());
                }
            }
            Source::Drive(index) => out.push(-state.multipliers[system.drives()[*index].multiplier]),
            Source::Coupling(index) => {
                let coupling = &system.couplings()[*index];
                out.extend(coupling.forces(at, state.multipliers[coupling.multiplier]));
            }
            Source::Accelerations(coordinates) => {
                out.extend(coordinates.iter().map(|&own| joint_acceleration(system, own, at)));
            }
            Source::Slider(index) => out.extend(slider_reaction(system, *index, state)),
            Source::FreeAccelerations(coordinates) => {
                out.extend(coordinates.iter().map(|&own| free_acceleration(system, own, at)));
            }
            Source::Coordinates(coordinates) => {
                let motions = coordinates.iter().map(|&coordinate| &at.coordinates[coordinate]);
                out.extend(motions.flat_map(|motion| [motion.value, motion.rate]));
            }
            Source::Spring(element, _) => {
                out.extend(system.spring_motion(*element, at).unwrap_or([f64::NAN; 3]));
            }
            Source::Power(element) => out.push(system.power(*element, at)),
            Source::Accumulated(index) => out.push(*state.accumulated.get(*index).unwrap_or(&f64::NAN)),
            Source::DrivePower(index) => {
                let drive = &system.drives()[*index];
                let rate = at.coordinates[drive.prescribed.coordinate].rate;
                out.push(-state.multipliers[drive.multiplier] * rate);
            }
            Source::Line(places) => {
                out.extend(places.iter().flat_map(|place| {
                    let position = place.frame(at).position;
                    [position.x, position.y, position.z]
                }));
            }
            Source::Modal(unknowns) => out.extend(unknowns.modal(at).flatten()),
            Source::Recovered(unknowns, matrix) => out.extend(recovered(unknowns, matrix, at).iter()),
            Source::Signal(argument) => out.push(signal_value(system, at, *argument)),
            Source::Momentum => {
                let (linear, angular) = system.momentum(at);
                out.extend(linear.iter().chain(angular.iter()));
            }
            Source::Energy => {
                let energy = system.energy(at);
                out.extend([energy.kinetic, energy.strain, energy.potential, energy.total()]);
            }
        }
    }

    fn evaluate_place(&self, place: &Place, start: &Motion, at: &Kinematics, out: &mut Vec<f64>) {
        let vector = match self.kind {
            OutputKind::Quaternion => {
                let quaternion = place.frame(at).rotation.quaternion();
                // Both signs mean the same axes.
                let sign = if quaternion[0] < 0.0 { -1.0 } else { 1.0 };
                out.extend(quaternion.map(|part| sign * part));
                return;
            }
            OutputKind::CardanAngles => cardan_angles(&place.frame(at).rotation.matrix()),
            OutputKind::Position => place.frame(at).position,
            OutputKind::Displacement => place.frame(at).position - start.position,
            OutputKind::Rotation => (place.frame(at).rotation * start.rotation.inverse()).logarithm(),
            OutputKind::Velocity => place.velocity(at).0,
            OutputKind::AngularVelocity => place.velocity(at).1,
            OutputKind::Acceleration => place.acceleration(at),
            _ => {
                let Place::OnBeam { probe, xi, .. } = place else { return };
                let forces = probe.section_forces_at(at, *xi);
                if self.kind == OutputKind::SectionForce {
                    translation_part(&forces)
                } else {
                    rotation_part(&forces)
                }
            }
        };
        out.extend_from_slice(vector.as_slice());
    }

    /// Whether it reports velocities, accelerations or forces of constraints. Forces in beams are those of their strains, and a
    /// signal is what acts.
    pub fn reports_rates(&self) -> bool {
        match &self.source {
            Source::Expression(_, arguments) => arguments.iter().any(|(channel, _)| channel.reports_rates()),
            _ => self.kind.has(Feature::Rates),
        }
    }

    /// Column names, as `midspan.u1`.
    pub fn columns(&self) -> impl Iterator<Item = String> + '_ {
        self.components.iter().map(|component| format!("{}.{component}", self.name))
    }
}

/// Angles of R = Rx(α) Ry(β) Rz(γ). Where cos β vanishes α and γ turn about the same axis; then γ is 0.
fn cardan_angles(rotation: &Matrix3) -> Vector3 {
    let cosine = rotation[(0, 0)].hypot(rotation[(0, 1)]);
    let beta = rotation[(0, 2)].atan2(cosine);
    if cosine < 1e-12 {
        return Vector3::new(rotation[(2, 1)].atan2(rotation[(1, 1)]), beta, 0.0);
    }
    let alpha = (-rotation[(1, 2)]).atan2(rotation[(2, 2)]);
    Vector3::new(alpha, beta, (-rotation[(0, 1)]).atan2(rotation[(0, 0)]))
}

/// Where the numbers of an output come from that is no expression. Places are given as the model is drawn; the motion
/// starts from another state where the model was assembled.
pub(crate) fn source(
    output: &Output,
    system: &System,
    (drawn, state): (&State, &State),
    names: &Resolver<'_>,
) -> Result<Source, Problem> {
    Ok(match &output.source {
        // Expressions name other outputs, which this one does not know.
        OutputSource::Expression(formula) => Source::Expression(formula.value.clone(), Vec::new()),
        OutputSource::Model if output.kind == OutputKind::Momentum => Source::Momentum,
        OutputSource::Model => Source::Energy,
        OutputSource::Signal(name) => {
            names.signals.get(&name.value).map(|&of| Source::Signal(of)).ok_or_else(|| {
                Problem::error(name.span, format!("there is no signal called `{}`", name.value))
            })?
        }
        OutputSource::Spring(name) => {
            let known = names
                .springs
                .get(&name.value)
                .filter(|(element, _)| system.spring_motion(*element, &state.kinematics).is_some());
            known.map(|&(element, quantity)| Source::Spring(element, quantity)).ok_or_else(|| {
                Problem::error(name.span, format!("spring `{}` has no elongation to record", name.value))
                    .help("name a spring between two points, or on a joint's coordinate")
            })?
        }
        OutputSource::Actor(name) => power_source(name, system, names)?,
        OutputSource::Beam(name) => Source::Line(nodes_of(name, names)?),
        OutputSource::Superelement(name) => superelement_channels::source(output.kind, name, names)?,
        OutputSource::Joint(name) => joint_source(output, name, system, names)?,
        OutputSource::Node { node, point } => {
            let place = place(output, node, point.as_ref(), drawn, names)?;
            let start = place.frame(&state.kinematics);
            Source::Place(place, start)
        }
    })
}

/// The power of a spring, a load, a drive or the friction of a joint.
fn power_source(name: &Located<String>, system: &System, names: &Resolver<'_>) -> Result<Source, Problem> {
    let drive = system.drives().iter().position(|drive| drive.name == name.value);
    let own = names.powers.get(&name.value).map(|&element| Source::Power(element));
    own.or(drive.map(Source::DrivePower)).ok_or_else(|| {
        Problem::error(name.span, format!("`{}` has no power to record", name.value)).help(
            "name a spring, a load, a drive of a joint's coordinate, or a joint with friction; other joints neither give nor take",
        )
    })
}

/// The nodes of a beam as places on its axis.
fn nodes_of(name: &Located<String>, names: &Resolver<'_>) -> Result<Vec<Place>, Problem> {
    let unknown = || Problem::error(name.span, format!("there is no beam called `{}`", name.value));
    let line = names.lines.get(&name.value).ok_or_else(unknown)?;
    // A node may be another part's: the section has its place beside it.
    let places = line.nodes.iter().zip(&line.offsets);
    Ok(places.map(|(&node, offset)| Place::Carried { node, offset: offset.position }).collect())
}

fn joint_source(
    output: &Output,
    name: &Located<String>,
    system: &System,
    names: &Resolver<'_>,
) -> Result<Source, Problem> {
    if matches!(output.kind, OutputKind::Relative | OutputKind::RelativeAcceleration) {
        let coordinates = names.coordinates.get(&name.value).cloned().unwrap_or_default();
        if coordinates.is_empty() {
            let message = format!("joint `{}` has no relative coordinate to record", name.value);
            return Err(Problem::error(name.span, message).help(
                "name a joint that has one, such as a revolute, screw, planar, prismatic or point_on_line joint, \
                 or a drive of one",
            ));
        }
        if output.kind == OutputKind::RelativeAcceleration {
            let is_free = |coordinate: &CoordinateId| {
                system.joints().iter().all(|joint| !joint.coordinates.contains(coordinate))
            };
            if coordinates.iter().all(is_free) {
                return Ok(Source::FreeAccelerations(coordinates));
            }
            let owner = |coordinate: &CoordinateId| {
                let place = |own: &[CoordinateId]| own.iter().position(|known| known == coordinate);
                let mut joints = system.joints().iter().enumerate();
                joints.find_map(|(joint, own)| Some((joint, place(&own.coordinates)?)))
            };
            return Ok(Source::Accelerations(coordinates.iter().filter_map(owner).collect()));
        }
        return Ok(Source::Coordinates(coordinates));
    }
    if let Some(index) = system.joints().iter().position(|joint| joint.name == name.value) {
        if output.kind == OutputKind::Contact && system.joints()[index].joint().rail_contact().is_none() {
            let message = format!("`{}` is no wheel on a rail", name.value);
            return Err(Problem::error(name.span, message).help("name a joint of kind `wheel_on_rail`"));
        }
        return Ok(match output.kind {
            OutputKind::RelativeMotion => Source::RelativeMotion(index),
            OutputKind::Contact => Source::Contact(index),
            _ => Source::Joint(index, output.axes),
        });
    }
    if matches!(output.kind, OutputKind::RelativeMotion | OutputKind::Contact) {
        let message = format!("`{}` stands between no two nodes", name.value);
        return Err(Problem::error(name.span, message).help("name the joint that it acts on"));
    }
    if output.axes != ReactionAxes::Ground {
        let message = format!("the reaction of `{}` has no axes: it acts on coordinates", name.value);
        return Err(Problem::error(name.span, message).help("leave out `axes`"));
    }
    if let Some(index) = system.sliders().iter().position(|slider| slider.name == name.value) {
        return Ok(Source::Slider(index));
    }
    if let Some(index) = system.couplings().iter().position(|coupling| coupling.name == name.value) {
        return Ok(Source::Coupling(index));
    }
    system
        .drives()
        .iter()
        .position(|drive| drive.name == name.value)
        .map(Source::Drive)
        .ok_or_else(|| Problem::error(name.span, format!("there is no joint called `{}`", name.value)))
}

fn place(
    output: &Output,
    node: &Located<NodeReference>,
    point: Option<&Vector3>,
    state: &State,
    names: &Resolver<'_>,
) -> Result<Place, Problem> {
    let at = &state.kinematics;
    let carried = |node: NodeId| {
        let frame = at.nodes[node].frame;
        let offset = point.map_or_else(Vector3::zeros, |point| frame.inverse_transform_point(point));
        Place::Carried { node, offset }
    };
    let unknown = |name: &str| Problem::error(node.span, format!("there is no part called `{name}`"));
    match &node.value {
        NodeReference::Ground => Ok(carried(lissom_core::kinematics::GROUND)),
        NodeReference::Body(name) | NodeReference::PointMass(name) => {
            names.nodes.get(name).map(|&node| carried(node)).ok_or_else(|| unknown(name))
        }
        NodeReference::Interface { superelement, interface } => {
            let name = interface_name(superelement, interface);
            names.nodes.get(&name).map(|&node| carried(node)).ok_or_else(|| unknown(&name))
        }
        NodeReference::Beam { beam, fraction } => {
            let line = names.lines.get(beam).ok_or_else(|| unknown(beam))?;
            let of_section = output.kind.subject() == Subject::Section;
            if let Some(node) = line.node_at(*fraction).filter(|_| !of_section) {
                // The node may be another part's: take the section's place, not the node's.
                let index = line.nodes.iter().position(|&other| other == node).unwrap_or(0);
                let offset = line.offsets[index].position;
                return Ok(match point {
                    Some(_) => carried(node),
                    None => Place::Carried { node, offset },
                });
            }
            let (probe, xi) = line.locate(*fraction);
            let frame = probe.frame_at(at, xi);
            let element = line.elements.iter().position(|other| Arc::ptr_eq(other, probe)).unwrap_or(0);
            let first = element * line.order;
            Ok(Place::OnBeam {
                probe: Arc::clone(probe),
                xi,
                point: point.map_or_else(Vector3::zeros, |point| frame.inverse_transform_point(point)),
                nodes: (first..first + gauss_lobatto(line.order + 1).len())
                    .map(|index| (line.nodes[index], line.offsets[index].position))
                    .collect(),
            })
        }
    }
}

/// Second derivative of a coordinate of a joint, by the joint and the place in it.
fn joint_acceleration(system: &System, (joint, own): (usize, usize), at: &Kinematics) -> f64 {
    let all: [f64; MAX_COORDINATES] = system.joints()[joint].coordinate_accelerations(at);
    all[own]
}

/// Whether the tip of a slider turns with its line.
pub(crate) fn is_aligned(system: &System, slider: usize) -> bool {
    system.sliders()[slider].equations() > 3
}

/// Force of a slider on its tip, global axes [N], and the moment [N m] where it holds the tip's orientation.
fn slider_reaction(system: &System, slider: usize, state: &State) -> Vec<f64> {
    let own = &system.sliders()[slider];
    let reaction = own.reaction(&state.kinematics, &state.multipliers[own.first_multiplier..]);
    let count = if is_aligned(system, slider) { 2 } else { 1 };
    reaction.iter().take(count).flatten().copied().collect()
}

/// Second derivative of a coordinate that no joint between nodes has; that of a slider follows from those of nodes.
fn free_acceleration(system: &System, own: CoordinateId, at: &Kinematics) -> f64 {
    let slider = system.sliders().iter().find(|slider| slider.coordinate == own);
    slider.map_or(at.coordinates[own].acceleration, |slider| slider.coordinate_acceleration(at))
}

/// Appends where a wheel touches its rail and what acts there.
fn evaluate_contact(joint: &AttachedJoint, state: &State, out: &mut Vec<f64>) {
    let Some(contact) = joint.rail_contact(&state.kinematics, &multipliers(joint, state)) else { return };
    out.extend([contact.on_wheel, contact.on_rail, contact.shift_angle, contact.normal_force]);
    out.extend(contact.forces.iter().chain(&contact.creepages));
}

/// A joint's own of the state's multipliers.
fn multipliers(joint: &AttachedJoint, state: &State) -> Equations {
    let mut mu = Equations::default();
    let first = joint.first_multiplier;
    mu[..joint.equations()].copy_from_slice(&state.multipliers[first..first + joint.equations()]);
    mu
}
