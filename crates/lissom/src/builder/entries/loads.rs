// Made by `cargo xtask reference` of the program's own tables: do not edit.
//! Applied forces and moments, and those of actuators.

use super::words;
use crate::builder::entry::{entries, keys};
use crate::builder::expression::{Expression, Function};
use crate::builder::values::Node;
use crate::ids::JointId;

entries! {
    /// Force on a point, of fixed direction or rotating with the node, scaled by a function of time.
    Force => LoadId, kind: "force" {
        * on: Node = "on", "node on which it acts";
        * vector: [f64; 3] = "vector", "Force or moment at scale 1, in global axes at the start \\[N or N m\\]";
    }

    /// Moment on a node, of fixed direction or rotating with the node, scaled by a function of time.
    Moment => LoadId, kind: "moment" {
        * on: Node = "on", "node on which it acts";
        * vector: [f64; 3] = "vector", "Force or moment at scale 1, in global axes at the start \\[N or N m\\]";
    }

    /// Force of an actuator between two points, along the line through them: a cylinder, a muscle, a cable of given tension.
    ForceBetween => LoadId, kind: "force_between" {
        * base: Node = "base", "first node: \"ground\", \"body\", \"beam.end\" …";
        * tip: Node = "tip", "second node";
        * force: Function = "force", "Force on the tip's point, positive where it pushes the points apart \\[N\\]";
        at_base: [f64; 3] = "at_base", "Location on the base; default: the node's position \\[m\\].";
        at_tip: [f64; 3] = "at_tip", "Location on the tip; default: the node's position \\[m\\].";
    }

    /// Torque of an actuator on a joint's relative rotation, from the base on the tip.
    JointTorque => LoadId, kind: "joint_torque" {
        * joint: JointId = "joint", "the joint whose relative rotation it acts on";
        * torque: Function = "torque", "Torque about the joint's axis, positive where it increases the rotation \\[N m\\]";
    }

    /// Force of an actuator on a joint's relative displacement, from the base on the tip.
    JointForce => LoadId, kind: "joint_force" {
        * joint: JointId = "joint", "the joint whose relative displacement it acts on";
        * force: Function = "force", "Force along the joint's axis, positive where it increases the displacement \\[N\\]";
    }

    /// Rotor in a body, with a constant rate of spin relative to it.
    Gyrostat => LoadId, kind: "gyrostat" {
        * on: Node = "on", "node on which it acts";
        * axis: [f64; 3] = "axis", "Axis of the rotor at the start, global axes; it rotates with the node";
        * inertia: f64 = "inertia", "Inertia of the rotor about its axis \\[kg m²\\]";
        * spin: f64 = "spin", "Rate of spin relative to the body \\[rad/s\\]";
    }

    /// A force and a moment that depend on the motion of their own points.
    LocalLoad => LocalLoadId, "local_load" {
        * on: Node = "on", "a beam, along which it is distributed, or a node";
        at: [f64; 3] = "at", "Where it acts on a node, at the start; default the node \\[m\\].";
        axes: words::Axes = "axes", "Axes of `force`, `moment`, velocities and relative flow: those of the section or body, global ones, or those of the part in which the load is, to which x, y, z and `flow` refer then too; default `\"section\"`.";
        about: Node = "about", "Another node, such as a hub: r1, r2, r3 is the position relative to it.";
        axis: [f64; 3] = "axis", "Direction fixed in the node `about`, at the start: n1, n2, n3 in expressions.";
        force: [Expression; 3] = "force", "Per length of a beam, or on a node: three numbers or expressions \\[N/m, N\\].";
        moment: [Expression; 3] = "moment", "The same for the moment \\[N, N m\\].";
        flow: [Expression; 3] = "flow", "Velocity of the surrounding fluid in global axes, or with `axes = \"part\"` in those of the part: three numbers or expressions of x, y, z, t and inputs \\[m/s\\].";
    }
}

keys! {
    [Force, Moment, Gyrostat]
        at: [f64; 3] = "at", "Location; default: the node's position \\[m\\].";
}

keys! {
    [Force, Moment]
        scale: Function = "scale", "Factor; default 1.";
        follower: bool = "follower", "Whether it rotates with the node; otherwise its direction is fixed; default `false`.";
}

keys! {
    [JointTorque, JointForce]
        coordinate: f64 = "coordinate", "Number of the joint's coordinate, from 1; default: the first suitable one.";
}
