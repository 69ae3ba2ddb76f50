//! The state between two steps, in SI.

use lissom_motion::Vector3;

use lissom_mechanics::elements::Energy;
use lissom_mechanics::kinematics::Kinematics;

use crate::touch::Touch;

/// The state between two steps.
#[derive(Debug, PartialEq)]
pub struct State {
    /// Positions, velocities and accelerations.
    pub kinematics: Kinematics,
    /// Multipliers: constraint forces and moments [N, N m].
    pub multipliers: Vec<f64>,
    /// Violations of the constraints, accumulated from step to step: they are evaluated from the increments of a
    /// step, so that the round-off of absolute positions does not affect them.
    pub violations: Vec<f64>,
    /// The scheme's algorithmic acceleration, one entry per coordinate row [m/s², rad/s²].
    pub algorithmic: Vec<f64>,
    /// Accumulated rounding remainder of the time [s].
    pub time_remainder: f64,
    /// Accumulated rounding remainder of each node's position [m].
    pub position_remainders: Vec<Vector3>,
    /// Values that a simulation accumulates along the motion, see `analysis::accumulated`.
    pub accumulated: Vec<f64>,
    /// Touches of the parts of a [`ContactSet`](lissom_contact::set::ContactSet) at the end of the last step, by ascending
    /// keys.
    pub touches: Vec<Touch>,
}

impl State {
    /// Elastic energy of the [`touches`](Self::touches) [J].
    pub fn touch_energy(&self) -> Energy {
        Energy { strain: self.touches.iter().map(|touch| touch.energy).sum(), ..Energy::default() }
    }

    /// Power that what moves the surfaces of touches supplies [W].
    pub fn touch_power(&self) -> f64 {
        self.touches.iter().map(|touch| touch.supplied).sum()
    }
}

impl Clone for State {
    fn clone(&self) -> Self {
        Self {
            kinematics: self.kinematics.clone(),
            multipliers: self.multipliers.clone(),
            violations: self.violations.clone(),
            algorithmic: self.algorithmic.clone(),
            time_remainder: self.time_remainder,
            position_remainders: self.position_remainders.clone(),
            accumulated: self.accumulated.clone(),
            touches: self.touches.clone(),
        }
    }

    /// Copies into the present allocations.
    fn clone_from(&mut self, from: &Self) {
        self.kinematics.clone_from(&from.kinematics);
        self.multipliers.clone_from(&from.multipliers);
        self.violations.clone_from(&from.violations);
        self.algorithmic.clone_from(&from.algorithmic);
        self.time_remainder = from.time_remainder;
        self.position_remainders.clone_from(&from.position_remainders);
        self.accumulated.clone_from(&from.accumulated);
        self.touches.clone_from(&from.touches);
    }
}
