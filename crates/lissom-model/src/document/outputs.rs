//! What a model file wants recorded.

use lissom_motion::Vector3;

use super::NodeReference;
use super::decode::each_of_kind;
use crate::context::Context;
use crate::expression::Formula;
use crate::reader::Reader;
use crate::registry::Registry;
use crate::report::Located;
use crate::suggest;
use crate::sweep::Fatigue;
use crate::text::Node;

/// A recorded quantity.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum OutputKind {
    /// Place of a node or of a point it carries [m].
    Position,
    /// Change of place since the start [m].
    Displacement,
    /// Rotation vector since the start [rad].
    Rotation,
    /// Velocity [m/s], global axes.
    Velocity,
    /// Angular velocity [rad/s], global axes.
    AngularVelocity,
    /// Acceleration [m/s²], global axes.
    Acceleration,
    /// Axial and shear forces in a beam [N], local axes.
    SectionForce,
    /// Torsion and bending moments in a beam [N m], local axes.
    SectionMoment,
    /// Force and moment of a joint on its tip [N, N m], global axes.
    Reaction,
    /// Relative coordinate of a joint [rad or m].
    Relative,
    /// Second derivative of a joint's relative coordinates [rad/s² or m/s²].
    RelativeAcceleration,
    /// Place [m] and rotation vector [rad] of a joint's tip frame in its base frame.
    RelativeMotion,
    /// Where a wheel touches its rail, and what acts there.
    Contact,
    /// Elongation, rate and force of a spring [m, m/s, N or rad, rad/s, N m].
    Spring,
    /// Power that a spring, load, drive or friction puts into the model [W].
    Power,
    /// Work that a spring, load, drive or friction has put into the model since the start [J].
    Work,
    /// Angle of a node about an axis, continued beyond half a turn [rad].
    Angle,
    /// Places of all nodes of a beam [m].
    Line,
    /// Energies of the whole model [J].
    Energy,
    /// Modal coordinates of a superelement and their rates.
    Modal,
    /// What the recovery matrix of a superelement makes of its deformation.
    Recovered,
    /// A signal, an input or a state.
    Signal,
    /// An expression of other outputs.
    Expression,
    /// Orientation of a node as a unit quaternion.
    Quaternion,
    /// Orientation of a node as Cardan angles [rad].
    CardanAngles,
    /// Momentum and angular momentum of the whole model about the origin [N s, N m s], global axes.
    Momentum,
}

impl OutputKind {
    /// All of them, in the order of the manual.
    pub const ALL: [Self; 26] = [
        Self::Position,
        Self::Displacement,
        Self::Rotation,
        Self::Quaternion,
        Self::CardanAngles,
        Self::Angle,
        Self::Velocity,
        Self::AngularVelocity,
        Self::Acceleration,
        Self::SectionForce,
        Self::SectionMoment,
        Self::Line,
        Self::Modal,
        Self::Recovered,
        Self::Reaction,
        Self::Relative,
        Self::RelativeAcceleration,
        Self::RelativeMotion,
        Self::Contact,
        Self::Spring,
        Self::Power,
        Self::Work,
        Self::Energy,
        Self::Momentum,
        Self::Signal,
        Self::Expression,
    ];

    /// Word in the model file.
    pub fn name(self) -> &'static str {
        match self {
            Self::Position => "position",
            Self::Displacement => "displacement",
            Self::Rotation => "rotation",
            Self::Velocity => "velocity",
            Self::AngularVelocity => "angular_velocity",
            Self::Acceleration => "acceleration",
            Self::SectionForce => "section_force",
            Self::SectionMoment => "section_moment",
            Self::Reaction => "reaction",
            Self::Relative => "relative",
            Self::RelativeAcceleration => "relative_acceleration",
            Self::RelativeMotion => "relative_motion",
            Self::Contact => "contact",
            Self::Spring => "spring",
            Self::Power => "power",
            Self::Work => "work",
            Self::Angle => "angle",
            Self::Line => "line",
            Self::Modal => "modal",
            Self::Recovered => "recovered",
            Self::Energy => "energy",
            Self::Momentum => "momentum",
            Self::Signal => "signal",
            Self::Expression => "expression",
            Self::Quaternion => "quaternion",
            Self::CardanAngles => "cardan_angles",
        }
    }

    /// One sentence.
    pub fn summary(self) -> &'static str {
        match self {
            Self::Position => "Place of a node or of a point it carries.",
            Self::Displacement => "Change of place since the start.",
            Self::Rotation => "Rotation vector since the start.",
            Self::Velocity => "Velocity of a node or of a point it carries.",
            Self::AngularVelocity => "Angular velocity of a node.",
            Self::Acceleration => "Acceleration of a node or of a point it carries.",
            Self::SectionForce => "Axial and shear forces in a beam, local axes.",
            Self::SectionMoment => "Torsion and bending moments in a beam, local axes.",
            Self::Reaction => "Force and moment of a joint on its tip.",
            Self::Relative => "Relative coordinate of a joint.",
            Self::RelativeAcceleration => "Accelerations of a joint's relative coordinates.",
            Self::RelativeMotion => {
                "Place and rotation vector of a joint's tip frame, in the axes of its base frame."
            }
            Self::Contact => {
                "Place of contact of a wheel on a rail, its normal force, creep forces and creepages."
            }
            Self::Spring => "Elongation or rotation of a spring, its rate, and its force or moment.",
            Self::Power => {
                "Power that a spring, a load, a drive or the friction of a joint puts into the rest of the model."
            }
            Self::Work => {
                "Work that a spring, a load, a drive or the friction of a joint has put into the rest of the model."
            }
            Self::Angle => "Angle of a node about an axis since the start, continued beyond half a turn.",
            Self::Line => "Places of all nodes of a beam along its axis, from its start to its end.",
            Self::Modal => {
                "Modal coordinates of a superelement and their rates, in the units of its matrices."
            }
            Self::Recovered => {
                "Stresses or displacements between the interfaces of a superelement: its `recovery` matrix times its deformation."
            }
            Self::Energy => "Kinetic, strain, gravity and total energy of the model.",
            Self::Signal => "Value of a signal, an input or a state.",
            Self::Expression => {
                "Value of an expression of time, components of other outputs, coordinates of joints, signals, inputs and \
                 states."
            }
            Self::Quaternion => "Axes of a node as a unit quaternion, q0 not negative.",
            Self::CardanAngles => "Axes of a node as angles about x, the turned y and the twice turned z.",
            Self::Momentum => "Momentum and angular momentum of the model about the origin, global axes.",
        }
    }

    /// Whether it belongs to any node.
    pub(crate) fn is_of_node(self) -> bool {
        !(self.is_of_beam()
            || self.is_of_joint()
            || self.is_of_model()
            || matches!(
                self,
                Self::Signal
                    | Self::Spring
                    | Self::Power
                    | Self::Work
                    | Self::Line
                    | Self::Expression
                    | Self::Modal
                    | Self::Recovered
            ))
    }

    /// Whether it belongs to the whole model.
    pub(crate) fn is_of_model(self) -> bool {
        matches!(self, Self::Energy | Self::Momentum)
    }

    /// Whether it belongs to a place on a beam.
    pub(crate) fn is_of_beam(self) -> bool {
        matches!(self, Self::SectionForce | Self::SectionMoment)
    }

    /// Whether it belongs to a joint.
    pub(crate) fn is_of_joint(self) -> bool {
        matches!(
            self,
            Self::Reaction
                | Self::Relative
                | Self::RelativeAcceleration
                | Self::RelativeMotion
                | Self::Contact
        )
    }

    /// Whether it is a vector of a motion, which an observer may see otherwise.
    pub(crate) fn is_of_motion(self) -> bool {
        self.takes_point() || matches!(self, Self::Rotation | Self::AngularVelocity)
    }

    /// Whether an observer other than the ground may see it.
    pub(crate) fn takes_observer(self) -> bool {
        self.is_of_motion() || self == Self::Angle
    }

    /// Whether it depends on the whole way from the start.
    pub(crate) fn is_accumulated(self) -> bool {
        matches!(self, Self::Work | Self::Angle)
    }

    /// Whether its cycles may be counted as fatigue.
    pub(crate) fn takes_fatigue(self) -> bool {
        matches!(
            self,
            Self::SectionForce
                | Self::SectionMoment
                | Self::Reaction
                | Self::Spring
                | Self::Recovered
                | Self::Signal
                | Self::Expression
        )
    }

    /// Whether the axes in which it is reported may be chosen.
    pub(crate) fn takes_axes(self) -> bool {
        self.is_of_motion() || self == Self::Momentum
    }

    /// Whether a point carried by the node may be named.
    pub(crate) fn takes_point(self) -> bool {
        matches!(self, Self::Position | Self::Displacement | Self::Velocity | Self::Acceleration)
    }
}

/// Whose quantity is recorded.
#[derive(Clone, Debug, PartialEq)]
pub enum OutputSource {
    /// A node, at its own place or at a point [m] (place at the start) that it carries.
    Node {
        /// The node.
        node: Located<NodeReference>,
        /// The point.
        point: Option<Vector3>,
    },
    /// A joint, by name.
    Joint(Located<String>),
    /// A spring, by name.
    Spring(Located<String>),
    /// A spring, a load, a drive or a joint with friction, by name.
    Actor(Located<String>),
    /// A whole beam, by name.
    Beam(Located<String>),
    /// A superelement, by name.
    Superelement(Located<String>),
    /// The whole model.
    Model,
    /// A signal, an input or a state, by name.
    Signal(Located<String>),
    /// An expression.
    Expression(Located<Formula>),
}

/// Axes in which a joint's reaction is reported.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum ReactionAxes {
    /// Global ones.
    #[default]
    Ground,
    /// Those of the joint frame that the base carries.
    Base,
    /// Those of the joint frame that the tip carries.
    Tip,
}

impl ReactionAxes {
    /// Words in the model file.
    pub(crate) const WORDS: [&'static str; 3] = ["ground", "base", "tip"];

    fn named(word: &str) -> Self {
        match word {
            "base" => Self::Base,
            "tip" => Self::Tip,
            _ => Self::Ground,
        }
    }
}

/// One recorded quantity.
#[derive(Clone, Debug, PartialEq)]
pub struct Output {
    /// Name.
    pub name: Located<String>,
    /// Quantity.
    pub kind: OutputKind,
    /// Whose.
    pub source: OutputSource,
    /// In which axes, for a reaction.
    pub axes: ReactionAxes,
    /// The node in whose axes its vectors are reported; global axes, or those of the observer, where there is none.
    pub seen_in: Option<Located<NodeReference>>,
    /// The node as seen from which it is; the ground where there is none.
    pub relative_to: Option<Located<NodeReference>>,
    /// The axis of an angle, at the start, global axes.
    pub axis: Option<Vector3>,
    /// How the cycles of its components are counted, if they are.
    pub fatigue: Option<Fatigue>,
}

pub(super) fn outputs(context: &Context<'_>, registry: &Registry) -> Vec<Output> {
    each_of_kind(context, "outputs", registry, |reader, name, word| {
        let kind = OutputKind::ALL.into_iter().find(|kind| kind.name() == word)?;
        let source = if kind.is_of_joint() {
            OutputSource::Joint(reader.name_in("of")?)
        } else if kind == OutputKind::Spring {
            OutputSource::Spring(reader.name_in("of")?)
        } else if matches!(kind, OutputKind::Power | OutputKind::Work) {
            let what = "spring, load or joint";
            OutputSource::Actor(name_of_one(reader, &["springs", "loads", "joints"], what)?)
        } else if kind == OutputKind::Line {
            OutputSource::Beam(reader.name_in("of")?)
        } else if matches!(kind, OutputKind::Modal | OutputKind::Recovered) {
            OutputSource::Superelement(reader.name_in("of")?)
        } else if kind == OutputKind::Signal {
            OutputSource::Signal(name_of_one(
                reader,
                &["signals", "inputs", "states"],
                "signal, input or state",
            )?)
        } else if kind == OutputKind::Expression {
            OutputSource::Expression(reader.formula("value")?)
        } else if kind.is_of_model() {
            OutputSource::Model
        } else {
            let node = context.node(reader.node("of")?, &reader.words("of"))?;
            if kind.is_of_beam() && !matches!(node.value, NodeReference::Beam { .. }) {
                let message = format!("{} is of a node that is not on a beam", reader.what);
                return context.fail(node.span, message, "name a place on a beam, such as \"beam@0.5\"");
            }
            let point = match kind.takes_point().then(|| reader.node("point")).flatten() {
                None => None,
                Some(place) => Some(context.place(place, &reader.words("point"))?.value),
            };
            if matches!(node.value, NodeReference::PointMass(_)) && point.is_some() {
                let message = format!("{} names a point, but a point mass carries none", reader.what);
                return context.fail(
                    reader.node("point").map_or(node.span, |point| point.span),
                    message,
                    "leave out `point`",
                );
            }
            OutputSource::Node { node, point }
        };
        let axes = match kind {
            OutputKind::Reaction => reader.choice("axes").map(|word| ReactionAxes::named(word.value)),
            _ => None,
        };
        let frame = |key: &str, is_allowed: bool| match is_allowed.then(|| reader.node(key)).flatten() {
            None => Some(None),
            Some(node) => frame(reader, node, key).map(Some),
        };
        let (seen_in, relative_to) =
            (frame("in", kind.takes_axes())?, frame("relative_to", kind.takes_observer())?);
        let axis = if kind == OutputKind::Angle { Some(reader.vector("axis")?.value) } else { None };
        let fatigue = if kind.takes_fatigue() { fatigue(reader) } else { None };
        let name = Located::new(name.to_owned(), reader.name);
        let axes = axes.unwrap_or_default();
        Some(Output { name, kind, source, axes, seen_in, relative_to, axis, fatigue })
    })
}

/// How cycles are counted; none where there is no exponent, and where something is wrong, which is reported.
fn fatigue(reader: &Reader<'_, '_>) -> Option<Fatigue> {
    let (exponent, cycles) = (reader.number("woehler_exponent"), reader.number("reference_cycles"));
    if let (Some(cycles), false) = (&cycles, reader.has("woehler_exponent")) {
        let message = format!("{} has `reference_cycles` without `woehler_exponent`", reader.what);
        return reader.context.fail(cycles.span, message, "add `woehler_exponent`, or leave this out");
    }
    exponent.map(|exponent| Fatigue { exponent: exponent.value, cycles: cycles.map(|cycles| cycles.value) })
}

/// A node that has axes.
fn frame(reader: &Reader<'_, '_>, node: &Node, key: &str) -> Option<Located<NodeReference>> {
    let found = reader.context.node(node, &reader.words(key))?;
    if let NodeReference::PointMass(name) = &found.value {
        let message = format!("{} names the point mass `{name}`, which has no axes", reader.words(key));
        return reader.context.fail(node.span, message, "name the ground, a body or a place on a beam");
    }
    Some(found)
}

/// The name of an entry of one of some `tables`, which are called `what`.
fn name_of_one(reader: &Reader<'_, '_>, tables: &[&str], what: &str) -> Option<Located<String>> {
    let name = reader.text("of")?;
    let known = || tables.iter().flat_map(|table| reader.context.names(table)).map(|(name, _)| name);
    let scope = reader.node("of")?.scope;
    let exists = |full: &str| tables.iter().any(|table| reader.context.has(table, full));
    if let Some(full) = reader.context.resolve(name.value, scope, &exists) {
        return Some(Located::new(full, name.span));
    }
    let message = format!("{} names `{}`, which is no {what}", reader.words("of"), name.value);
    let help = suggest::help(name.value, known()).unwrap_or_else(|| format!("add it to [{}]", tables[0]));
    reader.context.fail(name.span, message, help)
}
