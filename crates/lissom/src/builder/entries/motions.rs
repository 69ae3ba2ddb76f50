// Made by `cargo xtask reference` of the program's own tables: do not edit.
//! How the parts are and move at the start.

use crate::builder::entry::{entries, keys};
use crate::ids::Part;

entries! {
    /// A rigid motion of all parts at the start, or static equilibrium.
    InitialMotion => InitialId, "initial_motion" {
        equilibrium: bool = "equilibrium", "Start from static equilibrium under the loads at the start; default `false`.";
        steady_rotation: bool = "steady_rotation", "Start from the relative equilibrium in which the model rotates steadily with its velocities; default `false`.";
        follow_drives: bool = "follow_drives", "Beams, shells, solids and superelements without given velocities start with those of their drive, otherwise at rest; default `true`.";
    }

    /// A rigid motion of some parts at the start.
    PartMotion => MotionId, "part_motion" {
        * parts: Vec<Part> = "parts", "bodies, point masses, beams, shells, solids, superelements and entries of \\[parts\\] with this motion";
    }
}

keys! {
    [InitialMotion, PartMotion]
        velocity: [f64; 3] = "velocity", "Velocity of the point `about` \\[m/s\\].";
        angular_velocity: [f64; 3] = "angular_velocity", "Global axes \\[rad/s\\].";
        about: [f64; 3] = "about", "A point of the rigid motion; default the origin \\[m\\].";
}
