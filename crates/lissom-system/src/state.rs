//! The state between two steps, in SI.

use lissom_motion::Vector3;

use lissom_mechanics::kinematics::Kinematics;

/// The state between two steps.
#[derive(Clone, Debug, PartialEq)]
pub struct State {
    /// Positions, velocities and accelerations.
    pub kinematics: Kinematics,
    /// Multipliers: constraint forces and moments [N, N m].
    pub multipliers: Vec<f64>,
    /// Violations of the constraints, carried from step to step: they are evaluated from the
    /// increments of a step, so that the round-off of absolute positions does not enter them.
    pub violations: Vec<f64>,
    /// The scheme's own acceleration-like memory, one entry per coordinate row [m/s², rad/s²].
    pub algorithmic: Vec<f64>,
    /// What rounding has cut off the time so far [s].
    pub time_remainder: f64,
    /// What rounding has cut off each node's position so far [m].
    pub position_remainders: Vec<Vector3>,
    /// Numbers that a simulation accumulates along its way, see `analysis::accumulated`.
    pub accumulated: Vec<f64>,
}
