// Made by `cargo xtask reference` of the program's own tables: do not edit.
//! What is recorded, one type per kind.

use super::words;
use crate::builder::entry::{entry, keys};
use crate::builder::expression::Expression;
use crate::builder::values::Node;
use crate::ids::{BeamId, ContactId, JointId, LocalLoadId, Quantity, SpringId, SuperelementId};

entry! {
    /// Position of a node, or of a point fixed to it.
    Position => OutputId, "position";
    ["kind" = "position"]
    /// With what must be given.
    ///
    /// - `of`: the node, such as "beam@0.5"
    new(of: Node = "of")
}

entry! {
    /// Displacement from the position in the model file.
    Displacement => OutputId, "displacement";
    ["kind" = "displacement"]
    /// With what must be given.
    ///
    /// - `of`: the node, such as "beam@0.5"
    new(of: Node = "of")
}

entry! {
    /// Rotation vector since the start.
    Rotation => OutputId, "rotation";
    ["kind" = "rotation"]
    /// With what must be given.
    ///
    /// - `of`: the node, such as "beam@0.5"
    new(of: Node = "of")
}

entry! {
    /// Orientation of a node as a unit quaternion with non-negative q0.
    Quaternion => OutputId, "quaternion";
    ["kind" = "quaternion"]
    /// With what must be given.
    ///
    /// - `of`: the node, such as "beam@0.5"
    new(of: Node = "of")
}

entry! {
    /// Orientation of a node as Cardan angles: rotations about x, the rotated y and the twice rotated z.
    CardanAngles => OutputId, "cardan_angles";
    ["kind" = "cardan_angles"]
    /// With what must be given.
    ///
    /// - `of`: the node, such as "beam@0.5"
    new(of: Node = "of")
}

entry! {
    /// Rotation angle of a node about an axis since the start, continuous beyond half a revolution.
    Angle => OutputId, "angle";
    ["kind" = "angle"]
    /// With what must be given.
    ///
    /// - `of`: the node, such as "beam@0.5"
    /// - `axis`: axis at the start, global axes; it is fixed in `relative_to`
    new(of: Node = "of", axis: [f64; 3] = "axis")
}

entry! {
    /// Velocity of a node, or of a point fixed to it.
    Velocity => OutputId, "velocity";
    ["kind" = "velocity"]
    /// With what must be given.
    ///
    /// - `of`: the node, such as "beam@0.5"
    new(of: Node = "of")
}

entry! {
    /// Distance of a node, or of a point fixed to it, from the origin or from another node, and its rate.
    Distance => OutputId, "distance";
    ["kind" = "distance"]
    /// With what must be given.
    ///
    /// - `of`: the node, such as "beam@0.5"
    new(of: Node = "of")
}

entry! {
    /// Angular velocity of a node.
    AngularVelocity => OutputId, "angular_velocity";
    ["kind" = "angular_velocity"]
    /// With what must be given.
    ///
    /// - `of`: the node, such as "beam@0.5"
    new(of: Node = "of")
}

entry! {
    /// Acceleration of a node, or of a point fixed to it.
    Acceleration => OutputId, "acceleration";
    ["kind" = "acceleration"]
    /// With what must be given.
    ///
    /// - `of`: the node, such as "beam@0.5"
    new(of: Node = "of")
}

entry! {
    /// Axial and shear forces in a beam, section axes.
    SectionForce => OutputId, "section_force";
    ["kind" = "section_force"]
    /// With what must be given.
    ///
    /// - `of`: the node, such as "beam@0.5"
    new(of: Node = "of")
}

entry! {
    /// Torsion and bending moments in a beam, section axes.
    SectionMoment => OutputId, "section_moment";
    ["kind" = "section_moment"]
    /// With what must be given.
    ///
    /// - `of`: the node, such as "beam@0.5"
    new(of: Node = "of")
}

entry! {
    /// Forces per length in a shell, local axes of the node: in the surface and across it.
    ShellForce => OutputId, "shell_force";
    ["kind" = "shell_force"]
    /// With what must be given.
    ///
    /// - `of`: the node of a shell, such as "panel@0.5,1"
    new(of: Node = "of")
}

entry! {
    /// Bending moments and torsion per length in a shell, local axes of the node; positive where the side of the normal is in tension.
    ShellMoment => OutputId, "shell_moment";
    ["kind" = "shell_moment"]
    /// With what must be given.
    ///
    /// - `of`: the node of a shell, such as "panel@0.5,1"
    new(of: Node = "of")
}

entry! {
    /// Stresses at both faces of a shell, local axes of the node, von Mises stresses at the faces and in the middle, and an estimate of their error.
    ShellStress => OutputId, "shell_stress";
    ["kind" = "shell_stress"]
    /// With what must be given.
    ///
    /// - `of`: the node of a shell, such as "panel@0.5,1"
    new(of: Node = "of")
}

entry! {
    /// Stresses at a node of a solid, global axes, its von Mises stress and its largest principal stress.
    SolidStress => OutputId, "solid_stress";
    ["kind" = "solid_stress"]
    /// With what must be given.
    ///
    /// - `of`: the node of a solid, such as "block@0.5,1,0"
    new(of: Node = "of")
}

entry! {
    /// Positions of all nodes of a beam, from its start to its end.
    Line => OutputId, "line";
    ["kind" = "line"]
    /// With what must be given.
    ///
    /// - `of`: the beam
    new(of: BeamId = "of")
}

entry! {
    /// Modal coordinates of a superelement and their rates, in the units of its matrices.
    Modal => OutputId, "modal";
    ["kind" = "modal"]
    /// With what must be given.
    ///
    /// - `of`: the superelement
    new(of: SuperelementId = "of")
}

entry! {
    /// Stresses or displacements between the interfaces of a superelement: its `recovery` matrix times its deformation.
    Recovered => OutputId, "recovered";
    ["kind" = "recovered"]
    /// With what must be given.
    ///
    /// - `of`: the superelement
    new(of: SuperelementId = "of")
}

entry! {
    /// Force and moment of a joint on its tip.
    Reaction => OutputId, "reaction";
    ["kind" = "reaction"]
    /// With what must be given.
    ///
    /// - `of`: the joint
    new(of: JointId = "of")
}

entry! {
    /// Relative coordinates of a joint.
    Relative => OutputId, "relative";
    ["kind" = "relative"]
    /// With what must be given.
    ///
    /// - `of`: the joint
    new(of: JointId = "of")
}

entry! {
    /// Accelerations of a joint's relative coordinates.
    RelativeAcceleration => OutputId, "relative_acceleration";
    ["kind" = "relative_acceleration"]
    /// With what must be given.
    ///
    /// - `of`: the joint
    new(of: JointId = "of")
}

entry! {
    /// Position and rotation vector of a joint's tip frame, in the axes of its base frame.
    RelativeMotion => OutputId, "relative_motion";
    ["kind" = "relative_motion"]
    /// With what must be given.
    ///
    /// - `of`: the joint
    new(of: JointId = "of")
}

entry! {
    /// Contact position of a wheel on a rail, with normal force, creep forces and creepages.
    Contact => OutputId, "contact";
    ["kind" = "contact"]
    /// With what must be given.
    ///
    /// - `of`: the joint
    new(of: JointId = "of")
}

entry! {
    /// Smallest gap of a contact, sum of its normal forces, magnitude of its friction, force on the tip in global axes, sliding velocity, numbers of points that touch and of those that slide, and the centre of the normal forces in global axes.
    ContactForce => OutputId, "contact_force";
    ["kind" = "contact_force"]
    /// With what must be given.
    ///
    /// - `of`: the contact
    new(of: ContactId = "of")
}

entry! {
    /// Resultant force of a local load, its moment about the origin, and the power that it supplies, global axes; or with `station` force and moment per length there, in the axes of the load, and its variables.
    LocalLoad => OutputId, "local_load";
    ["kind" = "local_load"]
    /// With what must be given.
    ///
    /// - `of`: the local load
    new(of: LocalLoadId = "of")
    /// Fraction of the length of the beam along which the load acts, at one of its nodes; default the whole load.
    station: f64 = "station";
}

entry! {
    /// Elongation or rotation of a spring, its rate, and its force or moment.
    Spring => OutputId, "spring";
    ["kind" = "spring"]
    /// With what must be given.
    ///
    /// - `of`: the spring
    new(of: SpringId = "of")
}

entry! {
    /// Force and moment of a spring, bushing, bearing or rolling contact on its tip, about its point `at_tip`.
    SpringForce => OutputId, "spring_force";
    ["kind" = "spring_force"]
    /// With what must be given.
    ///
    /// - `of`: the spring
    new(of: SpringId = "of")
}

entry! {
    /// Power that a spring, a load, a drive or the friction of a joint delivers to the rest of the model.
    Power => OutputId, "power";
    ["kind" = "power"]
    /// With what must be given.
    ///
    /// - `of`: the name of a spring, a load, a drive or a joint with friction
    new(of: Quantity = "of")
}

entry! {
    /// Work that a spring, a load, a drive or the friction of a joint has delivered to the rest of the model.
    Work => OutputId, "work";
    ["kind" = "work"]
    /// With what must be given.
    ///
    /// - `of`: the name of a spring, a load, a drive or a joint with friction
    new(of: Quantity = "of")
}

entry! {
    /// Kinetic, strain, gravity and total energy of the model.
    Energy => OutputId, "energy";
    ["kind" = "energy"]
    /// With what must be given.
    new()
}

entry! {
    /// Momentum and angular momentum of the model about the origin, global axes.
    Momentum => OutputId, "momentum";
    ["kind" = "momentum"]
    /// With what must be given.
    new()
}

entry! {
    /// Value of a signal, an input or a state.
    Signal => OutputId, "signal";
    ["kind" = "signal"]
    /// With what must be given.
    ///
    /// - `of`: the name of a signal, an input or a state
    new(of: Quantity = "of")
}

entry! {
    /// Value of an expression of time, components of other outputs, coordinates of joints, signals, inputs and states.
    ExpressionOutput => OutputId, "expression";
    ["kind" = "expression"]
    /// With what must be given.
    ///
    /// - `value`: expression such as "hypot(a.x - b.x, a.y - b.y)", of components of outputs
    new(value: Expression = "value")
}

keys! {
    [Position, Displacement, Rotation, Quaternion, CardanAngles, Angle, Velocity, Distance, AngularVelocity, Acceleration]
    /// Body, or position on a beam, relative to which the motion is measured, in its axes; default: the ground.
    relative_to: Node = "relative_to";
}

keys! {
    [Position, Displacement, Rotation, Velocity, AngularVelocity, Acceleration, Momentum]
    /// Body, or position on a beam, in whose axes it is expressed; default global axes, or those of `relative_to`.
    seen_in: Node = "in";
}

keys! {
    [Position, Displacement, Velocity, Distance, Acceleration]
    /// Position at the start of a point fixed to the node, global axes; default: the node \[m\].
    point: [f64; 3] = "point";
}

keys! {
    [Position, Displacement, Rotation, Quaternion, CardanAngles, Angle, Velocity, Distance, AngularVelocity, Acceleration, SectionForce, SectionMoment, ShellForce, ShellMoment, ShellStress, SolidStress, Line, Modal, Recovered, Reaction, Relative, RelativeAcceleration, RelativeMotion, Contact, ContactForce, LocalLoad, Spring, SpringForce, Power, Work, Energy, Momentum, Signal, ExpressionOutput]
    /// Plot in which it is drawn together with other outputs of the same word; default its own.
    plot: String = "plot";
}

keys! {
    [SectionForce, SectionMoment, ShellForce, ShellMoment, ShellStress, SolidStress, Recovered, Reaction, Spring, SpringForce, Signal, ExpressionOutput]
    /// Exponent of the Wöhler curve; the summary then has `damage_equivalent` of each component.
    woehler_exponent: f64 = "woehler_exponent";
    /// Number of cycles of the damage equivalent range; default one per second of the run.
    reference_cycles: f64 = "reference_cycles";
}

keys! {
    [Reaction, SpringForce]
    /// Global axes, or those of the joint frame fixed in base or tip; default `"ground"`.
    axes: words::AxesOfTip = "axes";
}

keys! {
    [Signal, ExpressionOutput]
    /// Unit of its values, such as "kN", for plots and tables; default none.
    unit: String = "unit";
}
