//! Pose and motion of a superelement, in the axes of its floating frame.

use lissom_motion::{Matrix3, Vector3, rotation_inverse_tangent};

use super::part::Part;
use super::vectors::{set, three};
use lissom_mechanics::kinematics::{Kinematics, split};

/// Motion and forces of one superelement at one instant. Vectors are in the order of the unknowns: six per interface, then
/// the modal coordinates.
#[derive(Default)]
pub(super) struct ElementScratch {
    /// E_i.
    pub(super) turns: Vec<Matrix3>,
    /// r_i [m].
    pub(super) arms: Vec<Vector3>,
    /// T(log E_i)⁻¹.
    pub(super) inverse_tangents: Vec<Matrix3>,
    /// Angular velocity of each interface relative to the floating frame, in its own axes [rad/s].
    pub(super) relative_spins: Vec<Vector3>,
    /// E_i (v̇_i + ω_i × v_i) and E_i ω̇_i.
    pub(super) own_accelerations: Vec<[Vector3; 2]>,
    /// u.
    pub(super) displacement: Vec<f64>,
    /// u̇.
    pub(super) rate: Vec<f64>,
    /// η.
    pub(super) velocity: Vec<f64>,
    /// η̇.
    pub(super) acceleration: Vec<f64>,
    /// p = M η.
    pub(super) momentum: Vec<f64>,
    /// ṗ = M η̇.
    pub(super) inertia: Vec<f64>,
    /// Forces conjugate to u.
    pub(super) stress: Vec<f64>,
    /// Twist of the floating frame: velocity and angular velocity.
    pub(super) twist: [Vector3; 2],
}

impl ElementScratch {
    /// Evaluates the motion `at`.
    pub(super) fn enter(&mut self, of: &Part, at: &Kinematics) {
        let (nodes, size) = (of.nodes.len(), of.size());
        for vector in [
            &mut self.displacement,
            &mut self.rate,
            &mut self.velocity,
            &mut self.acceleration,
            &mut self.momentum,
            &mut self.inertia,
            &mut self.stress,
        ] {
            vector.clear();
            vector.resize(size, 0.0);
        }
        let base = &at.nodes[of.nodes[of.frame]];
        let (velocity, spin) = split(&base.twist);
        self.twist = [velocity, spin];
        self.turns.clear();
        self.arms.clear();
        self.inverse_tangents.clear();
        self.relative_spins.clear();
        self.own_accelerations.clear();
        for i in 0..nodes {
            let node = &at.nodes[of.nodes[i]];
            let relative = node.frame.relative_to(&base.frame);
            let (turn, arm) = if i == of.frame {
                (Matrix3::identity(), Vector3::zeros())
            } else {
                (relative.rotation.matrix(), relative.position)
            };
            let angles = if i == of.frame { Vector3::zeros() } else { relative.rotation.logarithm() };
            let inverse = rotation_inverse_tangent(&angles);
            let (v, w) = split(&node.twist);
            let (dv, dw) = split(&node.acceleration);
            let (speed, turning) = (turn * v, turn * w);
            let own = [turn * (dv + w.cross(&v)), turn * dw];
            let relative_spin = if i == of.frame { Vector3::zeros() } else { w - turn.tr_mul(&spin) };
            set(&mut self.displacement, 6 * i, &(arm - of.places[i]));
            set(&mut self.displacement, 6 * i + 3, &angles);
            if i != of.frame {
                set(&mut self.rate, 6 * i, &(speed - velocity - spin.cross(&arm)));
                set(&mut self.rate, 6 * i + 3, &(inverse * relative_spin));
            }
            set(&mut self.velocity, 6 * i, &speed);
            set(&mut self.velocity, 6 * i + 3, &turning);
            set(&mut self.acceleration, 6 * i, &(own[0] - spin.cross(&speed)));
            set(&mut self.acceleration, 6 * i + 3, &(own[1] - spin.cross(&turning)));
            self.turns.push(turn);
            self.arms.push(arm);
            self.inverse_tangents.push(inverse);
            self.relative_spins.push(relative_spin);
            self.own_accelerations.push(own);
        }
        for (k, &coordinate) in of.coordinates.iter().enumerate() {
            let (row, motion) = (6 * nodes + k, &at.coordinates[coordinate]);
            self.displacement[row] = motion.value;
            self.rate[row] = motion.rate;
            self.velocity[row] = motion.rate;
            self.acceleration[row] = motion.acceleration;
        }
    }

    /// ṗ_i + ω_f × p_i of the force and ṗ_i + (ω_f - E_i ω_i) × p_i of the moment.
    pub(super) fn inertial(&self, i: usize) -> [Vector3; 2] {
        let (p, l) = (three(&self.momentum, 6 * i), three(&self.momentum, 6 * i + 3));
        let own = three(&self.velocity, 6 * i + 3);
        let spin = self.twist[1];
        [
            three(&self.inertia, 6 * i) + spin.cross(&p),
            three(&self.inertia, 6 * i + 3) + (spin - own).cross(&l),
        ]
    }
}
