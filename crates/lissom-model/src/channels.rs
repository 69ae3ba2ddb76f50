//! What is recorded: named columns, evaluated from a system and its state.

use std::collections::BTreeMap;
use std::sync::Arc;

use lissom_core::elements::beam::line::BeamLine;
use lissom_core::elements::superelement::Deformation;
use lissom_core::joints::attached::AttachedJoint;
use lissom_core::joints::{Equations, MAX_COORDINATES};
use lissom_core::kinematics::{CarriedFrame, CoordinateId, Kinematics, NodeId, Quantity};
use lissom_core::signals::measurement::Measurement;
use lissom_core::signals::{Argument, SignalFunction};
use lissom_core::system::{ElementId, State, System};
use lissom_motion::{Rotation, rotation_part, translation_part};
use nalgebra::DMatrix;

use crate::document::{Feature, Output, OutputKind, OutputSource, ReactionAxes};
use crate::expression::Formula;
use crate::lower::Deformed;
use crate::outputs::{self, BeamSection, Location, ObservedSection, Subjects, value_and_rate};
use crate::report::{Located, Problem};
use crate::superelement_channels::recovered;
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

/// Where a channel's numbers come from.
#[derive(Clone)]
pub(crate) enum Source {
    /// Of a frame that a node carries.
    Measured(Arc<dyn Measurement>),
    /// Of a section between the nodes of a beam.
    BetweenNodes(ObservedSection),
    /// Forces or moments of a section.
    Section(BeamSection),
    /// An angle about an axis, before it is accumulated.
    Angle(Location),
    Joint(usize, ReactionAxes),
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
    Line(Vec<Arc<dyn Measurement>>),
    /// Modal coordinates of a superelement.
    Modal(Arc<Deformation>),
    /// What a matrix makes of its unknowns.
    Recovered(Arc<Deformation>, Arc<DMatrix<f64>>),
    Energy,
    /// In global axes, or in those of a frame.
    Momentum(Option<CarriedFrame>),
    Signal(Argument),
    /// An expression of components of other channels.
    Expression(Formula, Vec<(Channel, usize)>),
}

impl Channel {
    /// Appends the components' values.
    pub fn evaluate(&self, system: &System, state: &State, out: &mut Vec<f64>) {
        let at = &state.kinematics;
        match &self.source {
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
            Source::Measured(measurement) => append(&**measurement, at, out),
            Source::BetweenNodes(section) => out.extend_from_slice(&section.values(at)),
            Source::Section(section) => {
                let forces = section.forces(at);
                let vector = match self.kind {
                    OutputKind::SectionForce => translation_part(&forces),
                    _ => rotation_part(&forces),
                };
                out.extend_from_slice(vector.as_slice());
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
                for own in coordinates.iter().flat_map(|&own| value_and_rate((own, 1.0))) {
                    append(&own, at, out);
                }
            }
            Source::Spring(element, _) => {
                out.extend(system.spring_motion(*element, at).unwrap_or([f64::NAN; 3]));
            }
            Source::Power(element) => out.push(system.power(*element, at)),
            Source::Angle(_) => out.push(f64::NAN),
            Source::Accumulated(index) => out.push(*state.accumulated.get(*index).unwrap_or(&f64::NAN)),
            Source::DrivePower(index) => {
                let drive = &system.drives()[*index];
                let rate = at.coordinates[drive.prescribed.coordinate].rate;
                out.push(-state.multipliers[drive.multiplier] * rate);
            }
            Source::Line(positions) => {
                for own in positions {
                    append(&**own, at, out);
                }
            }
            Source::Modal(unknowns) => {
                for own in unknowns.modal().flat_map(value_and_rate) {
                    append(&own, at, out);
                }
            }
            Source::Recovered(unknowns, matrix) => out.extend(recovered(unknowns, matrix, at).iter()),
            Source::Signal(argument) => out.push(signal_value(system, at, *argument)),
            Source::Momentum(axes) => {
                let (linear, angular) = system.momentum(at);
                let axes = axes.map_or(Rotation::IDENTITY, |axes| axes.frame(at).rotation);
                for vector in [linear, angular] {
                    out.extend_from_slice(axes.apply_inverse(&vector).as_slice());
                }
            }
            Source::Energy => {
                let energy = system.energy(at);
                out.extend([energy.kinetic, energy.strain, energy.potential, energy.total()]);
            }
        }
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

/// Source of an output that is no expression.
pub(crate) fn source(
    output: &Output,
    system: &System,
    state: &State,
    subjects: &Subjects<'_>,
) -> Result<Source, Problem> {
    let names = subjects.names;
    if let Some(source) = outputs::source(output, subjects)? {
        return Ok(source);
    }
    match &output.source {
        OutputSource::Model if output.kind == OutputKind::Momentum => {
            let axes = output.seen_in.as_ref().map(|axes| outputs::carried_frame(axes, names)).transpose()?;
            Ok(Source::Momentum(axes))
        }
        OutputSource::Signal(name) => {
            names.signals.get(&name.value).map(|&of| Source::Signal(of)).ok_or_else(|| {
                Problem::error(name.span, format!("there is no signal called `{}`", name.value))
            })
        }
        OutputSource::Spring(name) => {
            let known = names
                .springs
                .get(&name.value)
                .filter(|(element, _)| system.spring_motion(*element, &state.kinematics).is_some());
            known.map(|&(element, quantity)| Source::Spring(element, quantity)).ok_or_else(|| {
                Problem::error(name.span, format!("spring `{}` has no elongation to record", name.value))
                    .help("name a spring between two points, or on a joint's coordinate")
            })
        }
        OutputSource::Actor(name) => power_source(name, system, names),
        OutputSource::Joint(name) => joint_source(output, name, system, names),
        // Expressions name other outputs, which this one does not know.
        OutputSource::Expression(formula) => Ok(Source::Expression(formula.value.clone(), Vec::new())),
        OutputSource::Model
        | OutputSource::Node { .. }
        | OutputSource::Beam(_)
        | OutputSource::Superelement(_) => Ok(Source::Energy),
    }
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

fn joint_source(
    output: &Output,
    name: &Located<String>,
    system: &System,
    names: &Resolver<'_>,
) -> Result<Source, Problem> {
    if output.kind == OutputKind::RelativeAcceleration {
        let coordinates = outputs::coordinates(name, names)?;
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
    if let Some(index) = system.joints().iter().position(|joint| joint.name == name.value) {
        if output.kind == OutputKind::Contact && system.joints()[index].joint().rail_contact().is_none() {
            let message = format!("`{}` is no wheel on a rail", name.value);
            return Err(Problem::error(name.span, message).help("name a joint of kind `wheel_on_rail`"));
        }
        return Ok(match output.kind {
            OutputKind::Contact => Source::Contact(index),
            _ => Source::Joint(index, output.axes),
        });
    }
    if output.kind == OutputKind::Contact {
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

/// Appends the components of a measurement.
fn append(measurement: &dyn Measurement, at: &Kinematics, out: &mut Vec<f64>) {
    out.extend_from_slice(&measurement.values(at)[..measurement.component_count()]);
}
