// Made by `cargo xtask reference` of the program's own tables: do not edit.
//! What pulls nodes or joints back, one type per kind.

use super::words;
use crate::builder::entry::{entry, keys};
use crate::builder::expression::Function;
use crate::builder::ids::{InputId, JointId};
use crate::builder::values::{Matrix, Node, Place};

entry! {
    /// Spring and damper on a joint's relative displacement.
    Axial => SpringId, "axial";
    ["kind" = "axial"]
    /// With what must be given.
    ///
    /// - `joint`: the joint whose relative displacement it acts on
    new(joint: JointId = "joint")
    /// Relative displacement at which it is free of force; default 0 \[m\].
    displacement: f64 = "displacement";
}

entry! {
    /// Spring and damper between two points, along the line that joins them.
    Point => SpringId, "point";
    ["kind" = "point"]
    /// With what must be given.
    ///
    /// - `base`: the node it starts from: "ground", "body", "beam.end" …
    /// - `tip`: the node it leads to
    new(base: Node = "base", tip: Node = "tip")
    /// Length at which it is free of force; default: the length at the start \[m\].
    length: f64 = "length";
}

entry! {
    /// A wheel, disc or ball on a plane that yields and slips: it may lift, and slides where friction ends.
    RollingContact => SpringId, "rolling_contact";
    ["kind" = "rolling_contact"]
    /// With what must be given.
    ///
    /// - `base`: the node it starts from: "ground", "body", "beam.end" …
    /// - `tip`: the node it leads to
    /// - `normal`: Normal of the plane, which the base carries, at the start, global axes; `at_base` is a point of the plane
    /// - `wheel_axis`: Axis of the wheel at the start, global axes; `at_tip` is the wheel's centre
    /// - `stiffness`: Normal force per penetration \[N/m\]
    new(base: Node = "base", tip: Node = "tip", normal: [f64; 3] = "normal", wheel_axis: [f64; 3] = "wheel_axis", stiffness: f64 = "stiffness")
    /// Radius of the wheel, without the rounding of its rim; default: so that it touches the plane at the start. 0 makes a ball of radius `rim` \[m\].
    radius: f64 = "radius";
    /// Radius of the rounding of the rim; default 0 \[m\].
    rim: f64 = "rim";
    /// Increase of the normal force per velocity of penetration, relative to it; default 0 \[s/m\].
    dissipation: f64 = "dissipation";
    /// Friction over normal force of a wheel that slides; default 0.
    friction_coefficient: f64 = "friction_coefficient";
    /// Velocity v\_s of the law μ tanh(v/v\_s): below it the wheel creeps; default 0.01 \[m/s\].
    slip_velocity: f64 = "slip_velocity";
    /// Coefficient of friction over the sliding velocity `slip` \[m/s\], in place of the law of `friction_coefficient`.
    traction: Function = "traction";
}

entry! {
    /// Rope that slides over several points without friction: reeving over pulleys, and hoists by its length.
    Rope => SpringId, "rope";
    ["kind" = "rope"]
    /// With what must be given.
    ///
    /// - `along`: the points it passes over, from one end to the other \[m\]
    new(along: Vec<(Node, Place)> = "along")
    /// Coordinates of joints that pay it out, such as "drum.angle"; a joint's name alone means all of its.
    drums: Vec<JointId> = "drums";
    /// Stiffness of the whole rope; default 0 \[N/m\].
    stiffness: f64 = "stiffness";
    /// Damping of the whole rope; default 0 \[N s/m\].
    damping: f64 = "damping";
    /// Tension over `elongation` and `rate`, in addition to `stiffness`; a table is over `elongation` \[N\].
    force: Function = "force";
    /// Tension over `rate` and `elongation`, in addition to `damping`; a table is over `rate` \[N\].
    damper_force: Function = "damper_force";
    /// Least and greatest tension; default none \[N\].
    limits: [f64; 2] = "limits";
    /// Free length of the whole rope, over time where a winch changes it; default: the length at the start \[m\].
    length: Function = "length";
    /// Rope that `drums` pay out, each per rad or m of its coordinate; negative where it winds the rope up \[m\].
    drum_radii: Vec<f64> = "drum_radii";
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
    /// Where it acts: on rotations above the free one, below it, or both; default both.
    side: words::SignedSide = "side";
    /// Least and greatest moment; default none \[N m\].
    limits: [f64; 2] = "limits";
    /// Width of the free play about the free rotation, without moment; default 0 \[rad\].
    backlash: f64 = "backlash";
    /// Relative rotation at which it is free of moment; default 0 \[rad\].
    angle: f64 = "angle";
}

entry! {
    /// Dry and viscous friction on a joint's relative displacement; it sticks without creeping.
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
    /// Force per velocity besides; default 0 \[N s/m\].
    viscous: f64 = "viscous";
    /// Elastic displacement before it slips; default 1e-4 \[m\].
    deflection: f64 = "deflection";
    /// Damping of the elastic displacement; default 0 \[N s/m\].
    damping: f64 = "damping";
}

entry! {
    /// Dry and viscous friction on a joint's relative rotation; it sticks without creeping.
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
    /// Moment per rate besides; default 0 \[N m s/rad\].
    viscous: f64 = "viscous";
    /// Elastic rotation before it slips; default 1e-4 \[rad\].
    deflection: f64 = "deflection";
    /// Damping of the elastic rotation; default 0 \[N m s/rad\].
    damping: f64 = "damping";
}

entry! {
    /// Springs and dampers along and about three axes, with full matrices; its length may be zero.
    Bushing => SpringId, "bushing";
    ["kind" = "bushing"]
    /// With what must be given.
    ///
    /// - `base`: the node it starts from: "ground", "body", "beam.end" …
    /// - `tip`: the node it leads to
    new(base: Node = "base", tip: Node = "tip")
    /// 6 x 6 or its diagonal: displacements along the axes, rotations about them; default 0 \[N/m, N, N m/rad\].
    stiffness: Matrix = "stiffness";
    /// 6 x 6 or its diagonal, likewise; default 0 \[N s/m, N s, N m s/rad\].
    damping: Matrix = "damping";
    /// First axis at the start, global axes; default global x. The axes turn with the base.
    axis: [f64; 3] = "axis";
    /// Second axis at the start, global axes, made perpendicular to the first; default global y.
    second_axis: [f64; 3] = "second_axis";
}

entry! {
    /// Mass, damping and stiffness matrices on coordinates: `M q'' + D q' + K (q - rest)` in their equations.
    CoordinateDynamics => SpringId, "coordinate_dynamics";
    ["kind" = "coordinate_dynamics"]
    /// With what must be given.
    ///
    /// - `coordinates`: coordinates that it acts on, such as "arm.angle", in the order of its matrices; a joint's name alone means all of its
    new(coordinates: Vec<JointId> = "coordinates")
    /// Mass matrix, symmetric, without negative eigenvalues; default 0 \[kg, kg m or kg m²\].
    mass: Vec<Vec<f64>> = "mass";
    /// Damping matrix; it may be unsymmetric (gyroscopic forces) or negative; default 0 \[N s/m, N s or N m s/rad\].
    damping: Vec<Vec<f64>> = "damping";
    /// Stiffness matrix; it may be unsymmetric (circulatory forces); default 0 \[N/m, N/rad or N m/rad\].
    stiffness: Vec<Vec<f64>> = "stiffness";
    /// Values of the coordinates at which `stiffness` is free of force; default zeros \[m or rad\].
    rest: Vec<f64> = "rest";
}

entry! {
    /// Stops at the ends of the range of a joint's relative displacement.
    AxialStop => SpringId, "axial_stop";
    ["kind" = "axial_stop"]
    /// With what must be given.
    ///
    /// - `joint`: the joint whose relative displacement it acts on
    /// - `range`: Displacements between the stops; an end that is infinite has none \[m\]
    /// - `stiffness`: Force at a penetration of 1 m \[N/m^n\]
    new(joint: JointId = "joint", range: [f64; 2] = "range", stiffness: f64 = "stiffness")
    /// Factor a of the penetration rate; default 0 \[s/m\].
    dissipation: f64 = "dissipation";
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
    /// - `range`: Rotations between the stops; an end that is infinite has none \[rad\]
    /// - `stiffness`: Moment at a penetration of 1 rad \[N m/rad^n\]
    new(joint: JointId = "joint", range: [f64; 2] = "range", stiffness: f64 = "stiffness")
    /// Factor a of the penetration rate; default 0 \[s/rad\].
    dissipation: f64 = "dissipation";
    /// Instead of `dissipation`: rate after an impact over that before, 0.01 to 1, at `impact_velocity`.
    restitution: f64 = "restitution";
    /// Rate of that impact \[rad/s\].
    impact_velocity: f64 = "impact_velocity";
}

entry! {
    /// Holds a joint's relative displacement where it is while an input is set: latches and releases.
    AxialLatch => SpringId, "axial_latch";
    ["kind" = "axial_latch"]
    /// With what must be given.
    ///
    /// - `joint`: the joint whose relative displacement it acts on
    /// - `engaged`: The input that engages it: above 0.5 it holds, otherwise it is free; events set it
    new(joint: JointId = "joint", engaged: InputId = "engaged")
}

entry! {
    /// Holds a joint's relative rotation where it is while an input is set: latches and releases.
    TorsionalLatch => SpringId, "torsional_latch";
    ["kind" = "torsional_latch"]
    /// With what must be given.
    ///
    /// - `joint`: the joint whose relative rotation it acts on
    /// - `engaged`: The input that engages it: above 0.5 it holds, otherwise it is free; events set it
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
    /// Where it acts: where it is longer than its free length, where it is shorter, or both; default both.
    side: words::Side = "side";
    /// Least and greatest force; default none \[N\].
    limits: [f64; 2] = "limits";
    /// Width of the free play about the free length, without force; default 0 \[m\].
    backlash: f64 = "backlash";
}

keys! {
    [Axial, Torsional, AxialFriction, TorsionalFriction, AxialStop, TorsionalStop, AxialLatch, TorsionalLatch]
    /// Which of the joint's coordinates, counted from 1; default the first that fits.
    coordinate: f64 = "coordinate";
}

keys! {
    [Point, RollingContact, Bushing]
    /// Location on the base; default: the node's position \[m\].
    at_base: [f64; 3] = "at_base";
    /// Location on the tip; default: the node's position \[m\].
    at_tip: [f64; 3] = "at_tip";
}

keys! {
    [AxialStop, TorsionalStop]
    /// N, from 1 on; default 1.
    exponent: f64 = "exponent";
}
