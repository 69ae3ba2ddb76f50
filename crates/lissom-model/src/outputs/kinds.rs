//! The kinds of recorded quantities: what a model file calls them, what they refer to and which keys they accept. A kind is a file in
//! `outputs/` with its declaration, and a line here.

use crate::outputs::{self, Build};

/// Part to which an output refers.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Subject {
    /// Any node.
    Node,
    /// A position on a beam.
    Section,
    /// A node of a shell.
    ShellNode,
    /// A node of a solid.
    SolidNode,
    Joint,
    Spring,
    Contact,
    /// A local load.
    LocalLoad,
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
    /// It may be of one station along a beam.
    Station,
    /// The unit may be given.
    Unit,
    /// The cycles may be counted as fatigue.
    Fatigue,
    /// An observer other than the ground may see it.
    Observer,
    /// The axes in which it is expressed may be chosen.
    Axes,
    /// It may be of a point that the node carries.
    Point,
    /// It depends on velocities, but neither on accelerations nor on forces of constraints.
    Velocities,
    /// It depends on accelerations or forces of constraints.
    Accelerations,
    /// It is a force within the model, which deformation determines.
    InternalForces,
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

/// Name and unit of a component.
pub(crate) type OutputComponent = (&'static str, &'static str);

/// A kind of output: what the model file calls it, what it refers to, its components, and how its quantities are found.
pub(crate) struct Declaration {
    pub(crate) word: &'static str,
    pub(crate) summary: &'static str,
    pub(crate) subject: Subject,
    /// In the order of their keys.
    pub(crate) features: &'static [Feature],
    /// Names and units of its components, unless its subject has others.
    pub(crate) components: &'static [OutputComponent],
    pub(crate) build: Build,
}

/// The enumeration and the declarations of all kinds, in the order of the manual.
macro_rules! kinds {
    ($($(#[$doc:meta])* $kind:ident = $declaration:path,)*) => {
        /// A recorded quantity.
        #[derive(Clone, Copy, Debug, PartialEq, Eq)]
        pub enum OutputKind {
            $($(#[$doc])* $kind,)*
        }

        const KINDS: &[(OutputKind, &Declaration)] = &[$((OutputKind::$kind, &$declaration),)*];
    };
}

kinds! {
    /// Place of a node or of a point it carries [m].
    Position = outputs::frames::POSITION,
    /// Change of place since the start [m].
    Displacement = outputs::frames::DISPLACEMENT,
    /// Rotation vector since the start [rad].
    Rotation = outputs::frames::ROTATION,
    /// Orientation of a node as a unit quaternion.
    Quaternion = outputs::frames::QUATERNION,
    /// Orientation of a node as Cardan angles [rad].
    CardanAngles = outputs::frames::CARDAN_ANGLES,
    /// Angle of a node about an axis, continued beyond half a turn [rad].
    Angle = outputs::angle::ANGLE,
    /// Velocity [m/s], global axes.
    Velocity = outputs::frames::VELOCITY,
    /// Distance from the origin or from another node, and its rate [m, m/s].
    Distance = outputs::frames::DISTANCE,
    /// Angular velocity [rad/s], global axes.
    AngularVelocity = outputs::frames::ANGULAR_VELOCITY,
    /// Acceleration [m/s²], global axes.
    Acceleration = outputs::frames::ACCELERATION,
    /// Axial and shear forces in a beam [N], local axes.
    SectionForce = outputs::section::SECTION_FORCE,
    /// Torsion and bending moments in a beam [N m], local axes.
    SectionMoment = outputs::section::SECTION_MOMENT,
    /// Forces per length in a shell [N/m], local axes.
    ShellForce = outputs::shell_stress::SHELL_FORCE,
    /// Moments per length in a shell [N], local axes.
    ShellMoment = outputs::shell_stress::SHELL_MOMENT,
    /// Stresses at the faces of a shell [Pa], local axes.
    ShellStress = outputs::shell_stress::SHELL_STRESS,
    /// Stresses of a solid [Pa], global axes.
    SolidStress = outputs::solid_stress::KIND,
    /// Places of all nodes of a beam [m].
    Line = outputs::line::LINE,
    /// Modal coordinates of a superelement and their rates.
    Modal = outputs::modal::MODAL,
    /// What the recovery matrix of a superelement makes of its deformation.
    Recovered = outputs::recovered::RECOVERED,
    /// Force and moment of a joint on its tip [N, N m], global axes.
    Reaction = outputs::reaction::REACTION,
    /// Relative coordinate of a joint [rad or m].
    Relative = outputs::relative::RELATIVE,
    /// Second derivative of a joint's relative coordinates [rad/s² or m/s²].
    RelativeAcceleration = outputs::relative_acceleration::RELATIVE_ACCELERATION,
    /// Place [m] and rotation vector [rad] of a joint's tip frame in its base frame.
    RelativeMotion = outputs::frames::RELATIVE_MOTION,
    /// Where a wheel touches its rail, and what acts there.
    Contact = outputs::contact::CONTACT,
    /// Gap and force of a contact between two parts.
    ContactForce = outputs::contact_force::CONTACT_FORCE,
    /// Resultant force and moment of a local load [N, N m], and its power [W].
    LocalLoad = outputs::local_load::LOCAL_LOAD,
    /// Elongation, rate and force of a spring [m, m/s, N or rad, rad/s, N m].
    Spring = outputs::spring::SPRING,
    /// Force and moment of a spring on its tip [N, N m].
    SpringForce = outputs::spring_force::SPRING_FORCE,
    /// Slip and forces of a tyre [-, rad, N, N, N, N m].
    Tyre = outputs::tyre::TYRE,
    /// Power that a spring, load, drive or friction puts into the model [W].
    Power = outputs::power::POWER,
    /// Work that a spring, load, drive or friction has put into the model since the start [J].
    Work = outputs::work::WORK,
    /// Energies of the whole model [J].
    Energy = outputs::energy::ENERGY,
    /// Momentum and angular momentum of the whole model about the origin [N s, N m s], global axes.
    Momentum = outputs::momentum::MOMENTUM,
    /// A signal, an input or a state.
    Signal = outputs::signal::SIGNAL,
    /// An expression of other outputs.
    Expression = outputs::expression::EXPRESSION,
}

impl OutputKind {
    /// All of them, in the order of the manual.
    pub fn all() -> impl Iterator<Item = Self> {
        KINDS.iter().map(|(kind, _)| *kind)
    }

    fn declaration(self) -> &'static Declaration {
        KINDS[self as usize].1
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

    /// Features of the kind, in the order of their keys.
    pub(crate) fn features(self) -> &'static [Feature] {
        self.declaration().features
    }

    /// Names and units of its components, unless its subject has others.
    pub(crate) fn components(self) -> &'static [OutputComponent] {
        self.declaration().components
    }

    /// When signals can depend on it.
    pub(crate) fn feeds(self) -> Feeds {
        match self.declaration().build {
            Build::Motion(_) | Build::Element(..) | Build::Expression => Feeds::Signals,
            Build::System(reason, _) => Feeds::Samples(reason),
            Build::Accumulated(_) => Feeds::Samples("it is accumulated from step to step"),
        }
    }

    /// How its quantities are found.
    pub(crate) fn build(self) -> &'static Build {
        &self.declaration().build
    }

    /// Whether it has a feature.
    pub(crate) fn has(self, feature: Feature) -> bool {
        self.features().contains(&feature)
    }
}
