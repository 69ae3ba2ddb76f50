// Made by `cargo xtask reference` of the program's own tables: do not edit.
//! What is recorded, one type per kind.

use super::words;
use crate::builder::entry::{entries, keys};
use crate::builder::expression::Expression;
use crate::builder::values::Node;
use crate::ids::{BeamId, ContactId, JointId, LocalLoadId, Quantity, SpringId, SuperelementId};

entries! {
    /// Position of a node, or of a point fixed to it.
    Position => OutputId, kind: "position" {
        * of: Node = "of", "the node, such as \"beam@0.5\"";
    }

    /// Displacement from the position in the model file.
    Displacement => OutputId, kind: "displacement" {
        * of: Node = "of", "the node, such as \"beam@0.5\"";
    }

    /// Rotation vector since the start.
    Rotation => OutputId, kind: "rotation" {
        * of: Node = "of", "the node, such as \"beam@0.5\"";
    }

    /// Orientation of a node as a unit quaternion with non-negative q0.
    Quaternion => OutputId, kind: "quaternion" {
        * of: Node = "of", "the node, such as \"beam@0.5\"";
    }

    /// Orientation of a node as Cardan angles: rotations about x, the rotated y and the twice rotated z.
    CardanAngles => OutputId, kind: "cardan_angles" {
        * of: Node = "of", "the node, such as \"beam@0.5\"";
    }

    /// Rotation angle of a node about an axis since the start, continuous beyond half a revolution.
    Angle => OutputId, kind: "angle" {
        * of: Node = "of", "the node, such as \"beam@0.5\"";
        * axis: [f64; 3] = "axis", "axis at the start, global axes; it is fixed in `relative_to`";
    }

    /// Velocity of a node, or of a point fixed to it.
    Velocity => OutputId, kind: "velocity" {
        * of: Node = "of", "the node, such as \"beam@0.5\"";
    }

    /// Distance of a node, or of a point fixed to it, from another node, and its rate; without `relative_to`, or with the ground, from the origin: no distance from a surface.
    Distance => OutputId, kind: "distance" {
        * of: Node = "of", "the node, such as \"beam@0.5\"";
    }

    /// Angular velocity of a node.
    AngularVelocity => OutputId, kind: "angular_velocity" {
        * of: Node = "of", "the node, such as \"beam@0.5\"";
    }

    /// Acceleration of a node, or of a point fixed to it.
    Acceleration => OutputId, kind: "acceleration" {
        * of: Node = "of", "the node, such as \"beam@0.5\"";
    }

    /// Axial and shear forces in a beam, section axes.
    SectionForce => OutputId, kind: "section_force" {
        * of: Node = "of", "the node, such as \"beam@0.5\"";
    }

    /// Torsion and bending moments in a beam, section axes.
    SectionMoment => OutputId, kind: "section_moment" {
        * of: Node = "of", "the node, such as \"beam@0.5\"";
    }

    /// Forces per length in a shell, local axes of the node: in the surface and across it.
    ShellForce => OutputId, kind: "shell_force" {
        * of: Node = "of", "the node of a shell, such as \"panel@0.5,1\"";
    }

    /// Bending moments and torsion per length in a shell, local axes of the node; positive where the side of the normal is in tension.
    ShellMoment => OutputId, kind: "shell_moment" {
        * of: Node = "of", "the node of a shell, such as \"panel@0.5,1\"";
    }

    /// Stresses at both faces of a shell, local axes of the node, von Mises stresses at the faces and in the middle, and an estimate of their error.
    ShellStress => OutputId, kind: "shell_stress" {
        * of: Node = "of", "the node of a shell, such as \"panel@0.5,1\"";
    }

    /// Stresses at a node of a solid, global axes, its von Mises stress and its largest principal stress.
    SolidStress => OutputId, kind: "solid_stress" {
        * of: Node = "of", "the node of a solid, such as \"block@0.5,1,0\"";
    }

    /// Positions of all nodes of a beam, from its start to its end.
    Line => OutputId, kind: "line" {
        * of: BeamId = "of", "the beam";
    }

    /// Modal coordinates of a superelement and their rates, in the units of its matrices.
    Modal => OutputId, kind: "modal" {
        * of: SuperelementId = "of", "the superelement";
    }

    /// Stresses or displacements between the interfaces of a superelement: its `recovery` matrix times its deformation.
    Recovered => OutputId, kind: "recovered" {
        * of: SuperelementId = "of", "the superelement";
    }

    /// Force and moment of a joint on its tip.
    Reaction => OutputId, kind: "reaction" {
        * of: JointId = "of", "the joint";
    }

    /// Relative coordinates of a joint.
    Relative => OutputId, kind: "relative" {
        * of: JointId = "of", "the joint";
    }

    /// Accelerations of a joint's relative coordinates.
    RelativeAcceleration => OutputId, kind: "relative_acceleration" {
        * of: JointId = "of", "the joint";
    }

    /// Position and rotation vector of a joint's tip frame, in the axes of its base frame.
    RelativeMotion => OutputId, kind: "relative_motion" {
        * of: JointId = "of", "the joint";
    }

    /// Contact position of a wheel on a rail, with normal force, creep forces and creepages.
    Contact => OutputId, kind: "contact" {
        * of: JointId = "of", "the joint";
    }

    /// Smallest gap of a contact, sum of its normal forces, magnitude of its friction, force on the tip in global axes, sliding velocity, numbers of points that touch and of those that slide, and the centre of the normal forces in global axes.
    ContactForce => OutputId, kind: "contact_force" {
        * of: ContactId = "of", "the contact";
    }

    /// Resultant force of a local load, its moment about the origin, and the power that it supplies, global axes; or with `station` force and moment per length there, in the axes of the load, and its variables.
    LocalLoad => OutputId, kind: "local_load" {
        * of: LocalLoadId = "of", "the local load";
        station: f64 = "station", "Fraction of the length of the beam along which the load acts, at one of its nodes; default the whole load.";
    }

    /// Elongation or rotation of a spring, its rate, and its force or moment.
    Spring => OutputId, kind: "spring" {
        * of: SpringId = "of", "the spring";
    }

    /// Force and moment of a spring, bushing, bearing or rolling contact on its tip, about its point `at_tip`.
    SpringForce => OutputId, kind: "spring_force" {
        * of: SpringId = "of", "the spring";
    }

    /// Slip, slip angle and forces of a tyre in axes of its contact, and its aligning moment; all zero in the air.
    Tyre => OutputId, kind: "tyre" {
        * of: SpringId = "of", "the spring";
    }

    /// Power that a spring, a load, a drive or the friction of a joint delivers to the rest of the model.
    Power => OutputId, kind: "power" {
        * of: Quantity = "of", "the name of a spring, a load, a drive or a joint with friction";
    }

    /// Work that a spring, a load, a drive or the friction of a joint has delivered to the rest of the model.
    Work => OutputId, kind: "work" {
        * of: Quantity = "of", "the name of a spring, a load, a drive or a joint with friction";
    }

    /// Kinetic, strain, gravity and total energy of the model.
    Energy => OutputId, kind: "energy" {
    }

    /// Momentum and angular momentum of the model about the origin, global axes.
    Momentum => OutputId, kind: "momentum" {
    }

    /// Value of a signal, an input or a state.
    Signal => OutputId, kind: "signal" {
        * of: Quantity = "of", "the name of a signal, an input or a state, or of a component of a hydraulic part";
    }

    /// Value of an expression of time, components of other outputs, coordinates of joints, signals, inputs and states.
    ExpressionOutput => OutputId, kind: "expression" {
        * value: Expression = "value", "expression such as \"hypot(a.x - b.x, a.y - b.y)\", of components of outputs";
    }
}

keys! {
    [Position, Displacement, Rotation, Quaternion, CardanAngles, Angle, Velocity, Distance, AngularVelocity, Acceleration]
        relative_to: Node = "relative_to", "Body, or position on a beam, relative to which the motion is measured, in its axes; default: the ground.";
}

keys! {
    [Position, Displacement, Rotation, Velocity, AngularVelocity, Acceleration, Momentum]
        seen_in: Node = "in", "Body, or position on a beam, in whose axes it is expressed; default global axes, or those of `relative_to`.";
}

keys! {
    [Position, Displacement, Velocity, Distance, Acceleration]
        point: [f64; 3] = "point", "Position at the start of a point fixed to the node, global axes; default: the node \\[m\\].";
}

keys! {
    [Position, Displacement, Rotation, Quaternion, CardanAngles, Angle, Velocity, Distance, AngularVelocity, Acceleration, SectionForce, SectionMoment, ShellForce, ShellMoment, ShellStress, SolidStress, Line, Modal, Recovered, Reaction, Relative, RelativeAcceleration, RelativeMotion, Contact, ContactForce, LocalLoad, Spring, SpringForce, Tyre, Power, Work, Energy, Momentum, Signal, ExpressionOutput]
        plot: String = "plot", "Plot in which it is drawn together with other outputs of the same word; default its own.";
}

keys! {
    [SectionForce, SectionMoment, ShellForce, ShellMoment, ShellStress, SolidStress, Recovered, Reaction, Spring, SpringForce, Signal, ExpressionOutput]
        woehler_exponent: f64 = "woehler_exponent", "Exponent of the Wöhler curve; the summary then has `damage_equivalent` of each component.";
        reference_cycles: f64 = "reference_cycles", "Number of cycles of the damage equivalent range; default one per second of the run.";
}

keys! {
    [Reaction, SpringForce]
        axes: words::AxesOfTip = "axes", "Global axes, or those of the joint frame fixed in base or tip; default `\"ground\"`.";
}

keys! {
    [Signal, ExpressionOutput]
        unit: String = "unit", "Unit of its values, such as \"kN\", for plots and tables; default none.";
}
