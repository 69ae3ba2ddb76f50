// Made by `cargo xtask reference` of the program's own tables: do not edit.
//! Constraints between nodes, or between coordinates of joints, one type per kind.

use super::words;
use crate::builder::entry::{entries, keys};
use crate::builder::expression::{Expression, Function};
use crate::builder::values::Node;
use crate::ids::{JointId, Part};

entries! {
    /// A coordinate of `other` is a function of a coordinate of `joint`, such as the profile of a cam.
    Cam => JointId, kind: "cam" {
        * joint: JointId = "joint", "joint with the independent coordinate";
        * other: JointId = "other", "joint with the dependent coordinate";
        * profile: Function = "profile", "The other coordinate as a function of the first, `x` \\[m or rad\\]";
    }

    /// Locks all six relative degrees of freedom.
    Clamp => JointId, kind: "clamp" {
        * base: Node = "base", "first node: \"ground\", \"body\", \"beam.end\" …";
        * tip: Node = "tip", "second node";
    }

    /// Two shafts with a common point and any angle between them rotate by the same angle.
    ConstantVelocity => JointId, kind: "constant_velocity" {
        * base: Node = "base", "first node: \"ground\", \"body\", \"beam.end\" …";
        * tip: Node = "tip", "second node";
        * axis: [f64; 3] = "axis", "direction at the start, global axes";
        tip_axis: [f64; 3] = "tip_axis", "Direction of the tip's shaft at the start, global axes; default: `axis`, the direction of the base's shaft.";
    }

    /// The tip slides along an axis and rotates about it; rotation and displacement are coordinates.
    Cylindrical => JointId, kind: "cylindrical" {
        * base: Node = "base", "first node: \"ground\", \"body\", \"beam.end\" …";
        * tip: Node = "tip", "second node";
        * axis: [f64; 3] = "axis", "direction at the start, global axes";
    }

    /// Keeps the distance of two points constant: a massless rod with spherical joints at its ends.
    Distance => JointId, kind: "distance" {
        * base: Node = "base", "first node: \"ground\", \"body\", \"beam.end\" …";
        * tip: Node = "tip", "second node";
    }

    /// An expression of joint coordinates and time is zero: planetary gears, differentials, curves.
    Equation => JointId, kind: "equation" {
        * equation: Expression = "equation", "The expression that is zero, of coordinates such as `arm.angle` and `slide.displacement`, and of `t`";
    }

    /// A coordinate of `other` changes by `ratio` times the change of a coordinate of `joint`: gears, racks, belts.
    Gear => JointId, kind: "gear" {
        * joint: JointId = "joint", "joint with the independent coordinate";
        * other: JointId = "other", "joint with the dependent coordinate";
        * ratio: f64 = "ratio", "Change of the dependent coordinate per change of the independent one; negative for external gears \\[1, m/rad or rad/m\\]";
        efficiency: f64 = "efficiency", "Share η of the power that arrives at `other` if `joint` drives; 2 - 1/η if `other` drives: below 0.5 it locks; default 1 \\[1\\].";
        deflection: f64 = "deflection", "Elastic motion of `joint` before its friction slips; default 1e-4 \\[rad or m\\].";
        damping: f64 = "damping", "Damping of this elastic motion; default 0 \\[N m s/rad or N s/m\\].";
        relative: bool = "relative", "Whether it is meant to relate rotations relative to parts that turn against each other, which is warned about otherwise; default `false`.";
    }

    /// Generalised coordinates that belong to no part, for springs, loads, gears and `coordinate_dynamics`.
    GeneralizedCoordinates => JointId, kind: "generalized_coordinates" {
        * start: Vec<f64> = "start", "Values at the start: as many as there are coordinates \\[m or rad\\]";
        rate: Vec<f64> = "rate", "Rates at the start, as many as in `start`; default zeros \\[m/s or rad/s\\].";
        rotations: bool = "rotations", "Whether they are rotations \\[rad\\] instead of displacements \\[m\\]; default `false`.";
    }

    /// Locks chosen translations and rotations of the tip in the axes of the base.
    Generic => JointId, kind: "generic" {
        * base: Node = "base", "first node: \"ground\", \"body\", \"beam.end\" …";
        * tip: Node = "tip", "second node";
        * locked: Vec<words::Locked> = "locked", "Locked motions: x along `axis`, y along `second_axis`, z perpendicular to both; rx, ry, rz about them";
    }

    /// The tip's point moves along a line fixed in the base; like `point_on_line`, but without a coordinate.
    Inline => JointId, kind: "inline" {
        * base: Node = "base", "first node: \"ground\", \"body\", \"beam.end\" …";
        * tip: Node = "tip", "second node";
        * axis: [f64; 3] = "axis", "direction at the start, global axes";
    }

    /// A body has the mean motion of a set of nodes of a shell or solid, which deforms freely (distributing coupling, RBE3).
    MeanMotion => JointId, kind: "mean_motion" {
        * base: Node = "base", "set of nodes that the body follows, such as \"block.east\"";
        * tip: Node = "tip", "body that follows it";
    }

    /// The tip rotates only about `axis` and translates freely; the relative rotation is a coordinate.
    ParallelAxes => JointId, kind: "parallel_axes" {
        * base: Node = "base", "first node: \"ground\", \"body\", \"beam.end\" …";
        * tip: Node = "tip", "second node";
        * axis: [f64; 3] = "axis", "direction at the start, global axes";
    }

    /// Keeps `axis`, fixed in the base, perpendicular to `second_axis`, fixed in the tip.
    PerpendicularAxes => JointId, kind: "perpendicular_axes" {
        * base: Node = "base", "first node: \"ground\", \"body\", \"beam.end\" …";
        * tip: Node = "tip", "second node";
        * axis: [f64; 3] = "axis", "direction at the start, global axes";
        * second_axis: [f64; 3] = "second_axis", "second direction at the start, global axes";
    }

    /// The tip translates in the plane perpendicular to `axis` and rotates about it; the rotation is a coordinate.
    Planar => JointId, kind: "planar" {
        * base: Node = "base", "first node: \"ground\", \"body\", \"beam.end\" …";
        * tip: Node = "tip", "second node";
        * axis: [f64; 3] = "axis", "direction at the start, global axes";
    }

    /// The tip's point moves in the base's plane perpendicular to `axis`; the tip rotates freely.
    PointInPlane => JointId, kind: "point_in_plane" {
        * base: Node = "base", "first node: \"ground\", \"body\", \"beam.end\" …";
        * tip: Node = "tip", "second node";
        * axis: [f64; 3] = "axis", "direction at the start, global axes";
    }

    /// The tip's point slides along a line fixed in the base; the tip rotates freely; the displacement is a coordinate.
    PointOnLine => JointId, kind: "point_on_line" {
        * base: Node = "base", "first node: \"ground\", \"body\", \"beam.end\" …";
        * tip: Node = "tip", "second node";
        * axis: [f64; 3] = "axis", "direction at the start, global axes";
    }

    /// Prescribes a joint's relative displacement as a function of time.
    PrescribedDisplacement => JointId, kind: "prescribed_displacement" {
        * joint: JointId = "joint", "the joint whose relative displacement it acts on";
        * displacement: Function = "displacement", "The relative displacement as a function of time \\[m\\]";
    }

    /// Prescribes displacements and rotations of the tip as functions of time; others are zero, or free.
    PrescribedMotion => JointId, kind: "prescribed_motion" {
        * base: Node = "base", "first node: \"ground\", \"body\", \"beam.end\" …";
        * tip: Node = "tip", "second node";
        x: Function = "x", "Displacement along `axis` from the start \\[m\\].";
        y: Function = "y", "Displacement along `second_axis` \\[m\\].";
        z: Function = "z", "Displacement perpendicular to both \\[m\\].";
        rx: Function = "rx", "Rotation about `axis` from the start \\[rad\\].";
        ry: Function = "ry", "Rotation about `second_axis` after its rotation by `rx` \\[rad\\].";
        rz: Function = "rz", "Rotation about the third axis after its rotations by `rx` and `ry` \\[rad\\].";
        free: Vec<words::Free> = "free", "Components that are neither prescribed nor locked; default none.";
    }

    /// Prescribes a joint's relative rotation as a function of time.
    PrescribedRotation => JointId, kind: "prescribed_rotation" {
        * joint: JointId = "joint", "the joint whose relative rotation it acts on";
        * rotation: Function = "rotation", "The relative rotation as a function of time \\[rad\\]";
    }

    /// The tip slides along an axis without rotation; the displacement is a coordinate.
    Prismatic => JointId, kind: "prismatic" {
        * base: Node = "base", "first node: \"ground\", \"body\", \"beam.end\" …";
        * tip: Node = "tip", "second node";
        * axis: [f64; 3] = "axis", "direction at the start, global axes";
    }

    /// The tip rotates about an axis through a common point; the relative rotation is a coordinate.
    Revolute => JointId, kind: "revolute" {
        * base: Node = "base", "first node: \"ground\", \"body\", \"beam.end\" …";
        * tip: Node = "tip", "second node";
        * axis: [f64; 3] = "axis", "direction at the start, global axes";
    }

    /// Connects two nodes at different positions by a massless rigid link.
    RigidLink => JointId, kind: "rigid_link" {
        * base: Node = "base", "first node: \"ground\", \"body\", \"beam.end\" …";
        * tip: Node = "tip", "second node";
    }

    /// A wheel, disc or ball rolls on a plane of the base without sliding or lifting off.
    Rolling => JointId, kind: "rolling" {
        * base: Node = "base", "first node: \"ground\", \"body\", \"beam.end\" …";
        * tip: Node = "tip", "second node";
        * axis: [f64; 3] = "axis", "direction at the start, global axes";
        * wheel_axis: [f64; 3] = "wheel_axis", "Axis of the wheel at the start, global axes, through the tip's position, the wheel's centre";
        radius: f64 = "radius", "Radius of the wheel, without the rounding of its rim; default: the one with which it touches the plane at the start; 0 for a ball of radius `rim` \\[m\\].";
        rim: f64 = "rim", "Rounding radius of the rim; zero for a sharp edge; default 0 \\[m\\].";
        friction_coefficient: f64 = "friction_coefficient", "Coefficient of friction; a warning reports when rolling requires more; default: no limit.";
        creep: f64 = "creep", "Sliding velocity per force, a linear law of creep. It makes the forces of several wheels on one axle, which constrain each other, unique; default 0 \\[m/(N s)\\].";
    }

    /// The tip rotates about an axis and moves along it in proportion; the rotation is a coordinate.
    Screw => JointId, kind: "screw" {
        * base: Node = "base", "first node: \"ground\", \"body\", \"beam.end\" …";
        * tip: Node = "tip", "second node";
        * axis: [f64; 3] = "axis", "direction at the start, global axes";
        * lead: f64 = "lead", "Displacement along `axis` per revolution; negative for a left-handed thread \\[m\\]";
    }

    /// A point of the tip slides along a flexible beam or a chain of beams, across element boundaries.
    Slider => JointId, kind: "slider" {
        * beams: Vec<Part> = "beams", "beams along which it slides; each starts at the end of the previous one";
        * tip: Node = "tip", "the node that slides";
        at: [f64; 3] = "at", "Location on the beam at the start; default: the tip node's position \\[m\\].";
        orientation: words::Orientation = "orientation", "Rotation of the tip: \"free\"; with the line's \"tangent\", about which it rotates freely; or with the beam's \"section\", as on a spline shaft; default `\"free\"`.";
    }

    /// The tip rotates freely about a common point of both nodes.
    Spherical => JointId, kind: "spherical" {
        * base: Node = "base", "first node: \"ground\", \"body\", \"beam.end\" …";
        * tip: Node = "tip", "second node";
    }

    /// A massless link with a revolute joint at the base and a spherical joint at the tip.
    SwingArm => JointId, kind: "swing_arm" {
        * base: Node = "base", "first node: \"ground\", \"body\", \"beam.end\" …";
        * tip: Node = "tip", "second node";
        * axis: [f64; 3] = "axis", "direction at the start, global axes";
        angle: f64 = "angle", "Value of the link's angle in the given positions; moves no part, except with `[assembly]`; default 0 \\[rad\\].";
    }

    /// A massless rod of variable length between two points, otherwise as `distance`; the displacement is a coordinate.
    TelescopicRod => JointId, kind: "telescopic_rod" {
        * base: Node = "base", "first node: \"ground\", \"body\", \"beam.end\" …";
        * tip: Node = "tip", "second node";
    }

    /// Two nodes share a point; two perpendicular axes, one fixed in each; both rotations are coordinates.
    Universal => JointId, kind: "universal" {
        * base: Node = "base", "first node: \"ground\", \"body\", \"beam.end\" …";
        * tip: Node = "tip", "second node";
        * axis: [f64; 3] = "axis", "direction at the start, global axes";
        * second_axis: [f64; 3] = "second_axis", "second direction at the start, global axes";
    }

    /// A wheel rolls on a straight rail of the base without lifting off, with creep forces if they are specified.
    WheelOnRail => JointId, kind: "wheel_on_rail" {
        * base: Node = "base", "first node: \"ground\", \"body\", \"beam.end\" …";
        * tip: Node = "tip", "second node";
        * axis: [f64; 3] = "axis", "direction at the start, global axes";
        * second_axis: [f64; 3] = "second_axis", "second direction at the start, global axes";
        axle: [f64; 3] = "axle", "Axis of the wheel at the start, global axes, through the tip's position; default: `axis`.";
        radius: f64 = "radius", "Radius of the wheel at its nominal circle; default: the one with which it touches the rail at the start \\[m\\].";
        offset: f64 = "offset", "Distance of the nominal circle from the tip's position along the wheel's axis, outwards positive; default: that of the rail's point `at` at the start \\[m\\].";
        cone_angle: f64 = "cone_angle", "Cone angle of the wheel: its radius decreases outwards; default 0 \\[rad\\].";
        wheel_profile: Function = "wheel_profile", "Instead of `cone_angle`: deviation from the nominal radius over the position `y` along the axis, outwards from the nominal circle; requires `tread` \\[m\\].";
        tread: [f64; 2] = "tread", "Range of positions `y` at which the wheel may touch the rail; a warning reports contact outside; default: half the radius in both directions \\[m\\].";
        head_radius: f64 = "head_radius", "Radius of the rail's head, a circle through the point `at` \\[m\\].";
        cant: f64 = "cant", "Angle by which the head rises outwards at the point `at`; default `cone_angle` \\[rad\\].";
        rail_profile: Function = "rail_profile", "Instead of `head_radius`: height of the rail over the lateral position `y`, outwards from the point `at`, where it is 0 \\[m\\].";
        friction_coefficient: f64 = "friction_coefficient", "Limit of the creep force over the normal force; default: no creep forces.";
        shear_modulus: f64 = "shear_modulus", "Shear modulus of wheel and rail, for creep forces \\[N/m^2\\].";
        poisson_number: f64 = "poisson_number", "Poisson's ratio; default 0.28.";
        kalker: [f64; 3] = "kalker", "Kalker's coefficients C11, C22 and C23 of longitudinal, lateral and spin creep.";
        ellipse: Vec<f64> = "ellipse", "Elliptic integral E and ratio g of the semi-axes of the contact ellipse, from tables; default: those of Hertz for the nominal curvatures.";
        velocity: [f64; 3] = "velocity", "Velocity of the base along the rail in global axes, for models in axes that move with a vehicle; default 0 \\[m/s\\].";
        wheel_spin: f64 = "wheel_spin", "Angular velocity of the wheel relative to the tip about `axle`, for tips that do not rotate with it; default 0 \\[rad/s\\].";
        directions: words::Directions = "directions", "Directions of creep forces: in the tangent plane, or those of Simeon, Fuehrer and Rentrop 1991; default `\"exact\"`.";
    }

    /// Friction in a joint.
    Friction {
        * coulomb: f64 = "coulomb", "sliding friction \\[N, N m\\]";
        static_friction: f64 = "static", "Friction at rest, not below `coulomb`; default equal \\[N, N m\\].";
        stribeck: f64 = "stribeck", "Rate at which the difference is 1/e; default 0.01 \\[m/s, rad/s\\].";
        viscous: f64 = "viscous", "Force per rate besides; default 0 \\[N s/m, N m s/rad\\].";
        deflection: f64 = "deflection", "Elastic motion before it slips; default 1e-4 \\[m, rad\\].";
        damping: f64 = "damping", "Of the elastic motion; default 0 \\[N s/m, N m s/rad\\].";
    }

    /// A latch on a joint.
    Latch {
        * at: f64 = "at", "value of the joint's only coordinate at which it engages, from either side \\[m, rad\\]";
    }
}

keys! {
    [Cam, Gear]
        coordinate: f64 = "coordinate", "Number of the coordinate of `joint`, from 1; may be omitted if there is only one.";
        other_coordinate: f64 = "other_coordinate", "Number of the coordinate of `other`, from 1; may be omitted if there is only one.";
}

keys! {
    [Cam, Clamp, ConstantVelocity, Cylindrical, Distance, Equation, Gear, Generic, Inline, MeanMotion, ParallelAxes, PerpendicularAxes, Planar, PointInPlane, PointOnLine, PrescribedMotion, Prismatic, Revolute, RigidLink, Rolling, Screw, Slider, Spherical, SwingArm, TelescopicRod, Universal, WheelOnRail]
        friction: Friction = "friction", "Friction on its only coordinate.";
        latch: Latch = "latch", "Latch that engages when its only coordinate first reaches the value `at`, and locks it there.";
        release: Expression = "release", "The latch releases when this expression rises through zero; without `latch` it is engaged from the start.";
}

keys! {
    [Clamp, ConstantVelocity, Cylindrical, Generic, Inline, ParallelAxes, PerpendicularAxes, Planar, PointInPlane, PointOnLine, PrescribedMotion, Prismatic, Revolute, RigidLink, Rolling, Screw, Spherical, SwingArm, Universal, WheelOnRail]
        at: [f64; 3] = "at", "Location; default: the tip node's position \\[m\\].";
        at_tip: [f64; 3] = "at_tip", "Location on the tip in its approximate position, if different from `at`; requires \\[assembly\\] \\[m\\].";
}

keys! {
    [ConstantVelocity, Cylindrical, Generic, Inline, ParallelAxes, PerpendicularAxes, Planar, PointInPlane, PointOnLine, PrescribedMotion, Prismatic, Revolute, Rolling, Screw, SwingArm, Universal, WheelOnRail]
        axis_at_tip: [f64; 3] = "axis_at_tip", "Direction of `axis` on the tip in its approximate position, if different; requires `at_tip`.";
}

keys! {
    [Cylindrical, ParallelAxes, Planar, Revolute, Screw]
        angle: f64 = "angle", "Value of the relative rotation in the given positions; moves no part, except with `[assembly]`; default 0 \\[rad\\].";
        rate: f64 = "rate", "Rate of the relative rotation at the start, which parts without a given velocity follow \\[rad/s\\].";
}

keys! {
    [Cylindrical, PointOnLine, Prismatic, TelescopicRod]
        displacement: f64 = "displacement", "Value of the relative displacement in the given positions; moves no part, except with `[assembly]`; default 0 \\[m\\].";
        velocity: f64 = "velocity", "Velocity of the relative displacement at the start, which parts without a given velocity follow \\[m/s\\].";
}

keys! {
    [Distance, TelescopicRod]
        at_base: [f64; 3] = "at_base", "Location on the base; default: the node's position \\[m\\].";
        at_tip: [f64; 3] = "at_tip", "Location on the tip; default: the node's position \\[m\\].";
}

keys! {
    [Generic, PrescribedMotion]
        axis: [f64; 3] = "axis", "Direction of x at the start, global axes; default: global x.";
        second_axis: [f64; 3] = "second_axis", "Direction of y at the start, global axes; default: global y.";
}

keys! {
    [Generic, PerpendicularAxes, PrescribedMotion, Universal, WheelOnRail]
        second_axis_at_tip: [f64; 3] = "second_axis_at_tip", "Direction of `second_axis` on the tip in its approximate position; requires `axis_at_tip`.";
}

keys! {
    [PrescribedDisplacement, PrescribedRotation]
        coordinate: f64 = "coordinate", "Number of the joint's coordinate, from 1; default: the first suitable one.";
}
