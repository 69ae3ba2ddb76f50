// Made by `cargo xtask reference` of the program's own tables: do not edit.
//! How the parts are and move at the start.

use crate::builder::entry::{entry, keys};
use crate::ids::Part;

entry! {
    /// A rigid motion of all parts at the start, or static equilibrium.
    InitialMotion => InitialId, "initial_motion";
    []
    /// With what must be given.
    new()
    /// Start from static equilibrium under the loads at the start; default `false`.
    equilibrium: bool = "equilibrium";
    /// Start from the relative equilibrium in which the model rotates steadily with its velocities; default `false`.
    steady_rotation: bool = "steady_rotation";
    /// Beams, shells, solids and superelements without given velocities start with those of their drive, otherwise at rest; default `true`.
    follow_drives: bool = "follow_drives";
}

entry! {
    /// A rigid motion of some parts at the start.
    PartMotion => MotionId, "part_motion";
    []
    /// With what must be given.
    ///
    /// - `parts`: bodies, point masses, beams, shells, solids, superelements and entries of \[parts\] with this motion
    new(parts: Vec<Part> = "parts")
}

keys! {
    [InitialMotion, PartMotion]
    /// Velocity of the point `about` \[m/s\].
    velocity: [f64; 3] = "velocity";
    /// Global axes \[rad/s\].
    angular_velocity: [f64; 3] = "angular_velocity";
    /// A point of the rigid motion; default the origin \[m\].
    about: [f64; 3] = "about";
}
