//! The kinds of recorded quantities: their names in a model file, the parts to which they refer and their keys.

/// Part to which an output refers.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Subject {
    /// Any node.
    Node,
    /// A position on a beam.
    Section,
    Joint,
    Spring,
    /// A spring, load, drive or joint with friction.
    Actor,
    /// A whole beam.
    Beam,
    Superelement,
    /// The whole model.
    Model,
    /// A signal, an input or a state.
    Signal,
    Expression,
}

/// A property of a kind of output, with the keys of the model file that it adds.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Feature {
    /// Expressed in global axes or in those of a joint frame.
    JointAxes,
    /// An angle about a given axis.
    AngleAxis,
    /// Its cycles may be counted as fatigue.
    Fatigue,
    /// An observer other than the ground may see it.
    Observer,
    /// The axes in which it is expressed may be chosen.
    Axes,
    /// It may be of a point that the node carries.
    Point,
    /// It depends on velocities, accelerations or forces of constraints.
    Rates,
    /// It depends on the whole motion since the start.
    Accumulated,
}

/// When signals can depend on a kind.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Feeds {
    /// At all times: its value and gradient follow from positions and velocities of a few nodes and coordinates.
    Signals,
    /// At samples, for this reason.
    Samples(&'static str),
}

/// It follows from the solution of a step.
const SOLUTION: Feeds = Feeds::Samples("it follows from the solution of a step");
/// It is accumulated step by step.
const ACCUMULATED: Feeds = Feeds::Samples("it is accumulated from step to step");
/// It depends on the deformation of an element or the motion of the whole model.
const WITHOUT_GRADIENT: Feeds = Feeds::Samples("it has no gradient for Newton's method");

/// A recorded quantity.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum OutputKind {
    /// Place of a node or of a point it carries [m].
    Position,
    /// Change of place since the start [m].
    Displacement,
    /// Rotation vector since the start [rad].
    Rotation,
    /// Orientation of a node as a unit quaternion.
    Quaternion,
    /// Orientation of a node as Cardan angles [rad].
    CardanAngles,
    /// Angle of a node about an axis, continued beyond half a turn [rad].
    Angle,
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
    /// Positions of all nodes of a beam [m].
    Line,
    /// Modal coordinates of a superelement and their rates.
    Modal,
    /// Product of a superelement's recovery matrix and its deformation.
    Recovered,
    /// Force and moment of a joint on its tip [N, N m], global axes.
    Reaction,
    /// Relative coordinate of a joint [rad or m].
    Relative,
    /// Second derivative of a joint's relative coordinates [rad/s² or m/s²].
    RelativeAcceleration,
    /// Place [m] and rotation vector [rad] of a joint's tip frame in its base frame.
    RelativeMotion,
    /// Contact position of a wheel on its rail, and the forces there.
    Contact,
    /// Elongation, rate and force of a spring [m, m/s, N or rad, rad/s, N m].
    Spring,
    /// Power that a spring, load, drive or friction puts into the model [W].
    Power,
    /// Work that a spring, load, drive or friction has put into the model since the start [J].
    Work,
    /// Energies of the whole model [J].
    Energy,
    /// Momentum and angular momentum of the whole model about the origin [N s, N m s], global axes.
    Momentum,
    /// A signal, an input or a state.
    Signal,
    /// An expression of other outputs.
    Expression,
}

/// Name and unit of a component.
pub(crate) type OutputComponent = (&'static str, &'static str);

/// A kind of output: its name in the model file, the part to which it refers, and its components.
///
/// Components that depend on the subject are in `channel_components.rs`.
struct Declaration {
    kind: OutputKind,
    word: &'static str,
    summary: &'static str,
    subject: Subject,
    features: &'static [Feature],
    feeds: Feeds,
    components: &'static [OutputComponent],
}

const fn declare(
    kind: OutputKind,
    word: &'static str,
    subject: Subject,
    features: &'static [Feature],
    feeds: Feeds,
    components: &'static [OutputComponent],
    summary: &'static str,
) -> Declaration {
    Declaration { kind, word, summary, subject, features, feeds, components }
}

/// All kinds, in the order of the enumeration and of the manual; keys of features are in the order given here.
const KINDS: &[Declaration] = {
    use Feature::{Accumulated, AngleAxis, Axes, Fatigue, JointAxes, Observer, Point, Rates};
    use OutputKind as Kind;
    &[
        declare(
            Kind::Position,
            "position",
            Subject::Node,
            &[Observer, Axes, Point],
            Feeds::Signals,
            &[("x", "m"), ("y", "m"), ("z", "m")],
            "Position of a node, or of a point fixed to it.",
        ),
        declare(
            Kind::Displacement,
            "displacement",
            Subject::Node,
            &[Observer, Axes, Point],
            Feeds::Signals,
            &[("u1", "m"), ("u2", "m"), ("u3", "m")],
            "Displacement since the start.",
        ),
        declare(
            Kind::Rotation,
            "rotation",
            Subject::Node,
            &[Observer, Axes],
            Feeds::Signals,
            &[("r1", "rad"), ("r2", "rad"), ("r3", "rad")],
            "Rotation vector since the start.",
        ),
        declare(
            Kind::Quaternion,
            "quaternion",
            Subject::Node,
            &[],
            Feeds::Signals,
            &[("q0", ""), ("q1", ""), ("q2", ""), ("q3", "")],
            "Orientation of a node as a unit quaternion with non-negative q0.",
        ),
        declare(
            Kind::CardanAngles,
            "cardan_angles",
            Subject::Node,
            &[],
            Feeds::Signals,
            &[("alpha", "rad"), ("beta", "rad"), ("gamma", "rad")],
            "Orientation of a node as Cardan angles: rotations about x, the rotated y and the twice rotated z.",
        ),
        declare(
            Kind::Angle,
            "angle",
            Subject::Node,
            &[AngleAxis, Observer, Accumulated],
            ACCUMULATED,
            &[("angle", "rad")],
            "Rotation angle of a node about an axis since the start, continuous beyond half a revolution.",
        ),
        declare(
            Kind::Velocity,
            "velocity",
            Subject::Node,
            &[Observer, Axes, Point, Rates],
            Feeds::Signals,
            &[("v1", "m/s"), ("v2", "m/s"), ("v3", "m/s")],
            "Velocity of a node, or of a point fixed to it.",
        ),
        declare(
            Kind::AngularVelocity,
            "angular_velocity",
            Subject::Node,
            &[Observer, Axes, Rates],
            Feeds::Signals,
            &[("w1", "rad/s"), ("w2", "rad/s"), ("w3", "rad/s")],
            "Angular velocity of a node.",
        ),
        declare(
            Kind::Acceleration,
            "acceleration",
            Subject::Node,
            &[Observer, Axes, Point, Rates],
            SOLUTION,
            &[("a1", "m/s²"), ("a2", "m/s²"), ("a3", "m/s²")],
            "Acceleration of a node, or of a point fixed to it.",
        ),
        declare(
            Kind::SectionForce,
            "section_force",
            Subject::Section,
            &[Fatigue],
            WITHOUT_GRADIENT,
            &[("f1", "N"), ("f2", "N"), ("f3", "N")],
            "Axial and shear forces in a beam, section axes.",
        ),
        declare(
            Kind::SectionMoment,
            "section_moment",
            Subject::Section,
            &[Fatigue],
            WITHOUT_GRADIENT,
            &[("m1", "N m"), ("m2", "N m"), ("m3", "N m")],
            "Torsion and bending moments in a beam, section axes.",
        ),
        declare(
            Kind::Line,
            "line",
            Subject::Beam,
            &[],
            Feeds::Signals,
            &[],
            "Positions of all nodes of a beam, from its start to its end.",
        ),
        declare(
            Kind::Modal,
            "modal",
            Subject::Superelement,
            &[],
            Feeds::Signals,
            &[],
            "Modal coordinates of a superelement and their rates, in the units of its matrices.",
        ),
        declare(
            Kind::Recovered,
            "recovered",
            Subject::Superelement,
            &[Fatigue],
            WITHOUT_GRADIENT,
            &[],
            "Stresses or displacements between the interfaces of a superelement: its `recovery` matrix times its deformation.",
        ),
        declare(
            Kind::Reaction,
            "reaction",
            Subject::Joint,
            &[JointAxes, Fatigue, Rates],
            SOLUTION,
            &[("f1", "N"), ("f2", "N"), ("f3", "N"), ("m1", "N m"), ("m2", "N m"), ("m3", "N m")],
            "Force and moment of a joint on its tip.",
        ),
        declare(
            Kind::Relative,
            "relative",
            Subject::Joint,
            &[Rates],
            Feeds::Signals,
            &[],
            "Relative coordinates of a joint.",
        ),
        declare(
            Kind::RelativeAcceleration,
            "relative_acceleration",
            Subject::Joint,
            &[Rates],
            SOLUTION,
            &[],
            "Accelerations of a joint's relative coordinates.",
        ),
        declare(
            Kind::RelativeMotion,
            "relative_motion",
            Subject::Joint,
            &[],
            Feeds::Signals,
            &[("x", "m"), ("y", "m"), ("z", "m"), ("r1", "rad"), ("r2", "rad"), ("r3", "rad")],
            "Position and rotation vector of a joint's tip frame, in the axes of its base frame.",
        ),
        declare(
            Kind::Contact,
            "contact",
            Subject::Joint,
            &[Rates],
            SOLUTION,
            &[
                ("wheel", "m"),
                ("rail", "m"),
                ("shift", "rad"),
                ("normal", "N"),
                ("along", "N"),
                ("across", "N"),
                ("creepage1", ""),
                ("creepage2", ""),
                ("spin", "1/m"),
            ],
            "Contact position of a wheel on a rail, with normal force, creep forces and creepages.",
        ),
        declare(
            Kind::Spring,
            "spring",
            Subject::Spring,
            &[Fatigue, Rates],
            WITHOUT_GRADIENT,
            &[("elongation", "m"), ("rate", "m/s"), ("force", "N")],
            "Elongation or rotation of a spring, its rate, and its force or moment.",
        ),
        declare(
            Kind::Power,
            "power",
            Subject::Actor,
            &[Rates],
            WITHOUT_GRADIENT,
            &[("power", "W")],
            "Power that a spring, a load, a drive or the friction of a joint delivers to the rest of the model.",
        ),
        declare(
            Kind::Work,
            "work",
            Subject::Actor,
            &[Accumulated],
            ACCUMULATED,
            &[("work", "J")],
            "Work that a spring, a load, a drive or the friction of a joint has delivered to the rest of the model.",
        ),
        declare(
            Kind::Energy,
            "energy",
            Subject::Model,
            &[Rates],
            WITHOUT_GRADIENT,
            &[("kinetic", "J"), ("strain", "J"), ("potential", "J"), ("total", "J")],
            "Kinetic, strain, gravity and total energy of the model.",
        ),
        declare(
            Kind::Momentum,
            "momentum",
            Subject::Model,
            &[Axes, Rates],
            WITHOUT_GRADIENT,
            &[("p1", "N s"), ("p2", "N s"), ("p3", "N s"), ("l1", "N m s"), ("l2", "N m s"), ("l3", "N m s")],
            "Momentum and angular momentum of the model about the origin, global axes.",
        ),
        declare(
            Kind::Signal,
            "signal",
            Subject::Signal,
            &[Fatigue],
            Feeds::Signals,
            &[("value", "")],
            "Value of a signal, an input or a state.",
        ),
        declare(
            Kind::Expression,
            "expression",
            Subject::Expression,
            &[Fatigue],
            Feeds::Signals,
            &[("value", "")],
            "Value of an expression of time, components of other outputs, coordinates of joints, signals, inputs and states.",
        ),
    ]
};

impl OutputKind {
    /// All of them, in the order of the manual.
    pub fn all() -> impl Iterator<Item = Self> {
        KINDS.iter().map(|own| own.kind)
    }

    fn declaration(self) -> &'static Declaration {
        &KINDS[self as usize]
    }

    /// Word in the model file.
    pub fn name(self) -> &'static str {
        self.declaration().word
    }

    /// One sentence.
    pub fn summary(self) -> &'static str {
        self.declaration().summary
    }
    /// Part to which it refers.
    pub(crate) fn subject(self) -> Subject {
        self.declaration().subject
    }

    /// Its features, in the order of their keys.
    pub(crate) fn features(self) -> &'static [Feature] {
        self.declaration().features
    }

    /// Names and units of its components, unless its subject has others.
    pub(crate) fn components(self) -> &'static [OutputComponent] {
        self.declaration().components
    }

    /// When signals can depend on it.
    pub(crate) fn feeds(self) -> Feeds {
        self.declaration().feeds
    }

    /// Whether it has a feature.
    pub(crate) fn has(self, feature: Feature) -> bool {
        self.features().contains(&feature)
    }
}

/// The table has the order of the enumeration, by which it is indexed.
const _: () = {
    let mut index = 0;
    while index < KINDS.len() {
        assert!(KINDS[index].kind as usize == index);
        index += 1;
    }
    assert!(KINDS.len() == OutputKind::Expression as usize + 1);
};
