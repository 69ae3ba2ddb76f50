// Made by `cargo xtask reference` of the program's own tables: do not edit.
//! What pulls nodes or joints back, one type per kind.

use super::words;
use crate::builder::entry::{entry, keys};
use crate::builder::expression::Function;
use crate::builder::values::{Matrix, Node, PositionOrNode};
use crate::ids::{InputId, JointId};

entry! {
    /// Spring and damper on a joint's relative displacement.
    Axial => SpringId, "axial";
    ["kind" = "axial"]
    /// With what must be given.
    ///
    /// - `joint`: the joint whose relative displacement it acts on
    new(joint: JointId = "joint")
    /// Relative displacement without force; default 0 \[m\].
    displacement: f64 = "displacement";
}

entry! {
    /// Spring and damper between two points, along the line through them.
    Point => SpringId, "point";
    ["kind" = "point"]
    /// With what must be given.
    ///
    /// - `base`: first node: "ground", "body", "beam.end" …
    /// - `tip`: second node
    new(base: Node = "base", tip: Node = "tip")
    /// Free length; default: the length at the start \[m\].
    length: f64 = "length";
}

entry! {
    /// A wheel, disc or ball on a compliant plane with friction: it may lift off and slide.
    RollingContact => SpringId, "rolling_contact";
    ["kind" = "rolling_contact"]
    /// With what must be given.
    ///
    /// - `base`: first node: "ground", "body", "beam.end" …
    /// - `tip`: second node
    /// - `normal`: Normal at the start of the plane, which is fixed in the base, global axes; `at_base` is a point of the plane
    /// - `wheel_axis`: Axis of the wheel at the start, global axes; `at_tip` is the wheel's centre
    /// - `stiffness`: Normal force per penetration \[N/m\]
    new(base: Node = "base", tip: Node = "tip", normal: [f64; 3] = "normal", wheel_axis: [f64; 3] = "wheel_axis", stiffness: f64 = "stiffness")
    /// Radius of the wheel, without the rounding of its rim; default: the one with which it touches the plane at the start; 0 for a ball of radius `rim` \[m\].
    radius: f64 = "radius";
    /// Rounding radius of the rim; default 0 \[m\].
    rim: f64 = "rim";
    /// Relative increase of the normal force per penetration velocity; default 0 \[s/m\].
    dissipation: f64 = "dissipation";
    /// Normal force per penetration velocity, while in contact; default 0 \[N s/m\].
    damping: f64 = "damping";
    /// Coefficient of sliding friction; default 0.
    friction_coefficient: f64 = "friction_coefficient";
    /// Velocity v\_s of the law μ tanh(v/v\_s), below which the wheel creeps; default 0.01 \[m/s\].
    slip_velocity: f64 = "slip_velocity";
    /// Coefficient of friction over the sliding velocity `slip` \[m/s\], instead of the law of `friction_coefficient`.
    traction: Function = "traction";
    /// Angle about the normal from the axis of the wheel to that of the roller in contact, for a wheel with free rollers on its rim: friction acts along the axis of the roller \[rad\].
    roller_angle: f64 = "roller_angle";
    /// Moment per normal force against rolling, of a wheel about its axis, of a ball about every axis in the plane; default 0 \[m\].
    rolling_friction: f64 = "rolling_friction";
    /// Additional moment per normal force and rolling rate; default 0 \[m s/rad\].
    rolling_damping: f64 = "rolling_damping";
    /// Rate ω\_s of the law tanh(ω/ω\_s) of `rolling_friction`, below which the wheel creeps; default 0.01 \[rad/s\].
    rolling_rate: f64 = "rolling_rate";
}

entry! {
    /// Rope that slides over several points without friction: pulleys, and hoists by its free length.
    Rope => SpringId, "rope";
    ["kind" = "rope"]
    /// With what must be given.
    ///
    /// - `along`: points over which it passes, from one end to the other \[m\]
    new(along: Vec<(Node, PositionOrNode)> = "along")
    /// Coordinates of joints that pay it out, such as "drum.angle"; the name of a joint stands for all its coordinates.
    drums: Vec<JointId> = "drums";
    /// Stiffness of the whole rope; default 0 \[N/m\].
    stiffness: f64 = "stiffness";
    /// Damping of the whole rope; default 0 \[N s/m\].
    damping: f64 = "damping";
    /// Tension over `elongation` and `rate`, in addition to `stiffness`; a table is over `elongation` \[N\].
    force: Function = "force";
    /// Tension over `rate` and `elongation`, in addition to `damping`; a table is over `rate` \[N\].
    damper_force: Function = "damper_force";
    /// Minimum and maximum tension; default: none \[N\].
    limits: [f64; 2] = "limits";
    /// Free length of the whole rope; a function of time for a winch; default: the length at the start \[m\].
    length: Function = "length";
    /// Length of rope paid out by each of `drums` per rad or m of its coordinate; negative if it winds the rope up \[m\].
    drum_radii: Vec<f64> = "drum_radii";
    /// Diameter with which it is drawn; default: a thin line \[m\].
    diameter: f64 = "diameter";
}

entry! {
    /// Spring and damper on a joint's relative rotation.
    Torsional => SpringId, "torsional";
    ["kind" = "torsional"]
    /// With what must be given.
    ///
    /// - `joint`: the joint whose relative rotation it acts on
    new(joint: JointId = "joint")
    /// Stiffness; default 0 \[N m/rad\].
    stiffness: f64 = "stiffness";
    /// Damping; default 0 \[N m s/rad\].
    damping: f64 = "damping";
    /// Moment over `rotation` and `rate`, in addition to `stiffness`; a table is over `rotation` \[N m\].
    moment: Function = "moment";
    /// Moment over `rate` and `rotation`, in addition to `damping`; a table is over `rate` \[N m\].
    damper_moment: Function = "damper_moment";
    /// Where it acts: above its free rotation ("positive"), below it ("negative"), or both; default `"both"`.
    side: words::SignedSide = "side";
    /// Minimum and maximum moment; default: none \[N m\].
    limits: [f64; 2] = "limits";
    /// Width of the backlash about the free rotation, without moment; default 0 \[rad\].
    backlash: f64 = "backlash";
    /// Relative rotation without moment; default 0 \[rad\].
    angle: f64 = "angle";
    /// Moment at the start, positive if it resists a positive rotation, instead of the rotation without moment \[N m\].
    preload: f64 = "preload";
}

entry! {
    /// Dry and viscous friction on a joint's relative displacement; sticking is free of creep.
    AxialFriction => SpringId, "axial_friction";
    ["kind" = "axial_friction"]
    /// With what must be given.
    ///
    /// - `joint`: the joint whose relative displacement it acts on
    /// - `coulomb`: Force of sliding friction \[N\]
    new(joint: JointId = "joint", coulomb: f64 = "coulomb")
    /// Additional force of friction at rest; default none \[N\].
    breakaway: f64 = "breakaway";
    /// Velocity at which the additional force has fallen to 1/e; default 0.01 \[m/s\].
    stribeck: f64 = "stribeck";
    /// Additional force per velocity; default 0 \[N s/m\].
    viscous: f64 = "viscous";
    /// Elastic displacement before it slips; default 1e-4 \[m\].
    deflection: f64 = "deflection";
    /// Damping of the elastic displacement; default 0 \[N s/m\].
    damping: f64 = "damping";
}

entry! {
    /// Dry and viscous friction on a joint's relative rotation; sticking is free of creep.
    TorsionalFriction => SpringId, "torsional_friction";
    ["kind" = "torsional_friction"]
    /// With what must be given.
    ///
    /// - `joint`: the joint whose relative rotation it acts on
    /// - `coulomb`: Moment of sliding friction \[N m\]
    new(joint: JointId = "joint", coulomb: f64 = "coulomb")
    /// Additional moment of friction at rest; default none \[N m\].
    breakaway: f64 = "breakaway";
    /// Rate at which the additional moment has fallen to 1/e; default 0.01 \[rad/s\].
    stribeck: f64 = "stribeck";
    /// Additional moment per rate; default 0 \[N m s/rad\].
    viscous: f64 = "viscous";
    /// Elastic rotation before it slips; default 1e-4 \[rad\].
    deflection: f64 = "deflection";
    /// Damping of the elastic rotation; default 0 \[N m s/rad\].
    damping: f64 = "damping";
}

entry! {
    /// Springs and dampers along and about three axes, with full matrices, also between coincident points.
    Bushing => SpringId, "bushing";
    ["kind" = "bushing"]
    /// With what must be given.
    ///
    /// - `base`: first node: "ground", "body", "beam.end" …
    /// - `tip`: second node
    new(base: Node = "base", tip: Node = "tip")
    /// 6 x 6 or its diagonal: displacements along the axes, rotations about them; default 0 \[N/m, N, N m/rad\].
    stiffness: Matrix = "stiffness";
    /// 6 x 6 or its diagonal, as `stiffness`; default 0 \[N s/m, N s, N m s/rad\].
    damping: Matrix = "damping";
    /// Displacement and rotation in the axes of the base ("base\_axes"), or as a screw, which is the same from both sides; default `"base_axes"`.
    form: words::Form = "form";
}

entry! {
    /// Bearing of a rotating shaft: stiffness and damping matrices, which may be unsymmetric and depend on the speed.
    Bearing => SpringId, "bearing";
    ["kind" = "bearing"]
    /// With what must be given.
    ///
    /// - `base`: first node: "ground", "body", "beam.end" …
    /// - `tip`: second node
    new(base: Node = "base", tip: Node = "tip")
    /// For displacements across the shaft (2 x 2), along it and across (3 x 3), across with rotations about both axes (4 x 4), or all (5 x 5); a number is for both directions across; default 0 \[N/m, N, N m/rad\].
    stiffness: Vec<Vec<f64>> = "stiffness";
    /// As `stiffness`; default 0 \[N s/m, N s, N m s/rad\].
    damping: Vec<Vec<f64>> = "damping";
    /// Stiffness over `speed` \[rad/s\], added to `stiffness`: force along axis 2 per displacement along it \[N/m\].
    k22: Function = "k22";
    /// The same for a displacement along axis 3 \[N/m\].
    k23: Function = "k23";
    /// Force along axis 3 per displacement along axis 2 \[N/m\].
    k32: Function = "k32";
    /// The same for a displacement along axis 3 \[N/m\].
    k33: Function = "k33";
    /// Damping over `speed` \[rad/s\], added to `damping`, as `k22` \[N s/m\].
    c22: Function = "c22";
    /// As `k23` \[N s/m\].
    c23: Function = "c23";
    /// As `k32` \[N s/m\].
    c32: Function = "c32";
    /// As `k33` \[N s/m\].
    c33: Function = "c33";
}

entry! {
    /// Short journal bearing with a fluid film, or squeeze-film damper of a shaft that does not rotate in it.
    JournalBearing => SpringId, "journal_bearing";
    ["kind" = "journal_bearing"]
    /// With what must be given.
    ///
    /// - `base`: first node: "ground", "body", "beam.end" …
    /// - `tip`: second node
    /// - `radius`: Radius of the journal \[m\]
    /// - `length`: Length along the shaft, short against the diameter \[m\]
    /// - `clearance`: Radial clearance \[m\]
    /// - `viscosity`: Dynamic viscosity of the lubricant \[Pa s\]
    new(base: Node = "base", tip: Node = "tip", radius: f64 = "radius", length: f64 = "length", clearance: f64 = "clearance", viscosity: f64 = "viscosity")
    /// Film where the pressure is positive ("ruptured"), or everywhere ("full"); default `"ruptured"`.
    film: words::Film = "film";
}

entry! {
    /// Mass, damping and stiffness matrices on coordinates: `M q'' + D q' + K (q - rest)` in their equations.
    CoordinateDynamics => SpringId, "coordinate_dynamics";
    ["kind" = "coordinate_dynamics"]
    /// With what must be given.
    ///
    /// - `coordinates`: coordinates on which it acts, such as "arm.angle", in the order of its matrices; the name of a joint stands for all its coordinates
    new(coordinates: Vec<JointId> = "coordinates")
    /// Mass matrix, symmetric, without negative eigenvalues; default 0 \[kg, kg m or kg m²\].
    mass: Vec<Vec<f64>> = "mass";
    /// Damping matrix; it may be unsymmetric (gyroscopic forces) or negative; default 0 \[N s/m, N s or N m s/rad\].
    damping: Vec<Vec<f64>> = "damping";
    /// Stiffness matrix; it may be unsymmetric (circulatory forces); default 0 \[N/m, N/rad or N m/rad\].
    stiffness: Vec<Vec<f64>> = "stiffness";
    /// Values of the coordinates without force of `stiffness`; default zeros \[m or rad\].
    rest: Vec<f64> = "rest";
}

entry! {
    /// Stops at the ends of the range of a joint's relative displacement.
    AxialStop => SpringId, "axial_stop";
    ["kind" = "axial_stop"]
    /// With what must be given.
    ///
    /// - `joint`: the joint whose relative displacement it acts on
    /// - `range`: Displacements of the two stops; none at an infinite end \[m\]
    /// - `stiffness`: Force at a penetration of 1 m \[N/m^n\]
    new(joint: JointId = "joint", range: [f64; 2] = "range", stiffness: f64 = "stiffness")
    /// Factor a of the penetration rate; default 0 \[s/m\].
    dissipation: f64 = "dissipation";
    /// Force per penetration rate, while in contact; default 0 \[N s/m\].
    damping: f64 = "damping";
    /// Instead of `dissipation`: velocity after an impact over that before, 0.01 to 1, at `impact_velocity`.
    restitution: f64 = "restitution";
    /// Velocity of that impact \[m/s\].
    impact_velocity: f64 = "impact_velocity";
}

entry! {
    /// Stops at the ends of the range of a joint's relative rotation.
    TorsionalStop => SpringId, "torsional_stop";
    ["kind" = "torsional_stop"]
    /// With what must be given.
    ///
    /// - `joint`: the joint whose relative rotation it acts on
    /// - `range`: Rotations of the two stops; none at an infinite end \[rad\]
    /// - `stiffness`: Moment at a penetration of 1 rad \[N m/rad^n\]
    new(joint: JointId = "joint", range: [f64; 2] = "range", stiffness: f64 = "stiffness")
    /// Factor a of the penetration rate; default 0 \[s/rad\].
    dissipation: f64 = "dissipation";
    /// Moment per penetration rate, while in contact; default 0 \[N m s/rad\].
    damping: f64 = "damping";
    /// Instead of `dissipation`: rate after an impact over that before, 0.01 to 1, at `impact_velocity`.
    restitution: f64 = "restitution";
    /// Rate of that impact \[rad/s\].
    impact_velocity: f64 = "impact_velocity";
}

entry! {
    /// Locks a joint's relative displacement at its current value while an input is set: latches and releases.
    AxialLatch => SpringId, "axial_latch";
    ["kind" = "axial_latch"]
    /// With what must be given.
    ///
    /// - `joint`: the joint whose relative displacement it acts on
    /// - `engaged`: Input that engages it: locked above 0.5, otherwise free; set by events
    new(joint: JointId = "joint", engaged: InputId = "engaged")
}

entry! {
    /// Locks a joint's relative rotation at its current value while an input is set: latches and releases.
    TorsionalLatch => SpringId, "torsional_latch";
    ["kind" = "torsional_latch"]
    /// With what must be given.
    ///
    /// - `joint`: the joint whose relative rotation it acts on
    /// - `engaged`: Input that engages it: locked above 0.5, otherwise free; set by events
    new(joint: JointId = "joint", engaged: InputId = "engaged")
}

keys! {
    [Axial, Point]
    /// Stiffness; default 0 \[N/m\].
    stiffness: f64 = "stiffness";
    /// Damping; default 0 \[N s/m\].
    damping: f64 = "damping";
    /// Force over `elongation` and `rate`, in addition to `stiffness`; a table is over `elongation` \[N\].
    force: Function = "force";
    /// Force over `rate` and `elongation`, in addition to `damping`; a table is over `rate` \[N\].
    damper_force: Function = "damper_force";
    /// Where it acts: beyond its free length ("tension"), below it ("compression"), or both; default `"both"`.
    side: words::Side = "side";
    /// Minimum and maximum force; default: none \[N\].
    limits: [f64; 2] = "limits";
    /// Width of the backlash about the free length, without force; default 0 \[m\].
    backlash: f64 = "backlash";
    /// Force at the start, positive if it pulls, instead of the position without force \[N\].
    preload: f64 = "preload";
}

keys! {
    [Axial, Torsional, AxialFriction, TorsionalFriction, AxialStop, TorsionalStop, AxialLatch, TorsionalLatch]
    /// Number of the joint's coordinate, from 1; default: the first suitable one.
    coordinate: f64 = "coordinate";
}

keys! {
    [Point, RollingContact, Bushing, Bearing, JournalBearing]
    /// Location on the base; default: the node's position \[m\].
    at_base: [f64; 3] = "at_base";
    /// Location on the tip; default: the node's position \[m\].
    at_tip: [f64; 3] = "at_tip";
}

keys! {
    [Bushing, Bearing, JournalBearing]
    /// First axis at the start, global axes; default global x. The axes rotate with the base.
    axis: [f64; 3] = "axis";
}

keys! {
    [Bushing, Bearing]
    /// Second axis at the start, global axes, made perpendicular to the first; default global y.
    second_axis: [f64; 3] = "second_axis";
}

keys! {
    [AxialStop, TorsionalStop]
    /// Exponent n, at least 1; default 1.
    exponent: f64 = "exponent";
}
