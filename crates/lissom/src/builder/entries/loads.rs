// Made by `cargo xtask reference` of the program's own tables: do not edit.
//! Applied forces and moments, and those of actuators.

use super::words;
use crate::builder::entry::{entry, keys};
use crate::builder::expression::{Expression, Function};
use crate::builder::values::Node;
use crate::ids::JointId;

entry! {
    /// Force on a point, of fixed direction or rotating with the node, scaled by a function of time.
    Force => LoadId, "force";
    ["kind" = "force"]
    /// With what must be given.
    ///
    /// - `on`: node on which it acts
    /// - `vector`: Force or moment at scale 1, in global axes at the start \[N or N m\]
    new(on: Node = "on", vector: [f64; 3] = "vector")
}

entry! {
    /// Moment on a node, of fixed direction or rotating with the node, scaled by a function of time.
    Moment => LoadId, "moment";
    ["kind" = "moment"]
    /// With what must be given.
    ///
    /// - `on`: node on which it acts
    /// - `vector`: Force or moment at scale 1, in global axes at the start \[N or N m\]
    new(on: Node = "on", vector: [f64; 3] = "vector")
}

entry! {
    /// Force of an actuator between two points, along the line through them: a cylinder, a muscle, a cable of given tension.
    ForceBetween => LoadId, "force_between";
    ["kind" = "force_between"]
    /// With what must be given.
    ///
    /// - `base`: first node: "ground", "body", "beam.end" …
    /// - `tip`: second node
    /// - `force`: Force on the tip's point, positive where it pushes the points apart \[N\]
    new(base: Node = "base", tip: Node = "tip", force: Function = "force")
    /// Location on the base; default: the node's position \[m\].
    at_base: [f64; 3] = "at_base";
    /// Location on the tip; default: the node's position \[m\].
    at_tip: [f64; 3] = "at_tip";
}

entry! {
    /// Torque of an actuator on a joint's relative rotation, from the base on the tip.
    JointTorque => LoadId, "joint_torque";
    ["kind" = "joint_torque"]
    /// With what must be given.
    ///
    /// - `joint`: the joint whose relative rotation it acts on
    /// - `torque`: Torque about the joint's axis, positive where it increases the rotation \[N m\]
    new(joint: JointId = "joint", torque: Function = "torque")
}

entry! {
    /// Force of an actuator on a joint's relative displacement, from the base on the tip.
    JointForce => LoadId, "joint_force";
    ["kind" = "joint_force"]
    /// With what must be given.
    ///
    /// - `joint`: the joint whose relative displacement it acts on
    /// - `force`: Force along the joint's axis, positive where it increases the displacement \[N\]
    new(joint: JointId = "joint", force: Function = "force")
}

entry! {
    /// Rotor in a body, with a constant rate of spin relative to it.
    Gyrostat => LoadId, "gyrostat";
    ["kind" = "gyrostat"]
    /// With what must be given.
    ///
    /// - `on`: node on which it acts
    /// - `axis`: Axis of the rotor at the start, global axes; it rotates with the node
    /// - `inertia`: Inertia of the rotor about its axis \[kg m²\]
    /// - `spin`: Rate of spin relative to the body \[rad/s\]
    new(on: Node = "on", axis: [f64; 3] = "axis", inertia: f64 = "inertia", spin: f64 = "spin")
}

entry! {
    /// A force and a moment that depend on the motion of their own points.
    LocalLoad => LocalLoadId, "local_load";
    []
    /// With what must be given.
    ///
    /// - `on`: a beam, along which it is distributed, or a node
    new(on: Node = "on")
    /// Where it acts on a node, at the start; default the node \[m\].
    at: [f64; 3] = "at";
    /// Axes of `force`, `moment`, velocities and relative flow: those of the section or body, global ones, or those of the part in which the load is, to which x, y, z and `flow` refer then too; default `"section"`.
    axes: words::Axes = "axes";
    /// Per length of a beam, or on a node: three numbers or expressions \[N/m, N\].
    force: [Expression; 3] = "force";
    /// The same for the moment \[N, N m\].
    moment: [Expression; 3] = "moment";
    /// Velocity of the surrounding fluid in global axes, or with `axes = "part"` in those of the part: three numbers or expressions of x, y, z, t and inputs \[m/s\].
    flow: [Expression; 3] = "flow";
}

keys! {
    [Force, Moment, Gyrostat]
    /// Location; default: the node's position \[m\].
    at: [f64; 3] = "at";
}

keys! {
    [Force, Moment]
    /// Factor; default 1.
    scale: Function = "scale";
    /// Whether it rotates with the node; otherwise its direction is fixed; default `false`.
    follower: bool = "follower";
}

keys! {
    [JointTorque, JointForce]
    /// Number of the joint's coordinate, from 1; default: the first suitable one.
    coordinate: f64 = "coordinate";
}
