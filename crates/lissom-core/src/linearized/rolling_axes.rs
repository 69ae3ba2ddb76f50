//! Wheels that roll steadily, in axes that do not spin with them.
//!
//! Legend: ω rate of a wheel relative to its plane, a axis of the wheel, n normal of the plane, all in the wheel's axes, σ spin.
//!
//! ```text
//! ω = σ a + κ n,      x = exp(-t σ ã) z
//! ```
//!
//! The point of contact moves relative to the axes of a wheel, so that coefficients there change. In axes that rotate about the
//! normal at κ and not with the spin they are constant for a wheel with the inertia of a body of revolution. Displacements x of
//! its node become z there, by the same transformation as that to axes at rest (`multiblade`). This is verified, see
//! [`LinearModel::departure_of`].

use lissom_motion::{Motion, Vector3, Vector6};

use super::generator::Generator;
use super::model::LinearModel;
use crate::kinematics::{Kinematics, LOCKED, NodeId};
use crate::round_off;
use crate::system::System;

/// Spin of every node [rad/s], in its axes: zero except for rolling wheels.
pub(super) fn spins(system: &System, at: &Kinematics) -> Vec<Vector3> {
    let mut spins = vec![Vector3::zeros(); at.nodes.len()];
    for joint in system.joints().iter().filter(|joint| joint.rolls()) {
        let Some(contact) = joint.joint().contact() else { continue };
        let [base, tip] = joint.frames.map(|frame| (&at.nodes[frame.node], frame.offset.rotation));
        let in_tip = |vector: Vector3| tip.0.frame.rotation.apply_inverse(&vector);
        let rate = in_tip(tip.0.angular_velocity() - base.0.angular_velocity());
        let axis = tip.1.apply(&contact.axis);
        let normal = in_tip((base.0.frame.rotation * base.1).apply(&Vector3::z()));
        let cosine = axis.dot(&normal);
        let square = 1.0 - cosine * cosine;
        let along = rate.dot(&axis);
        let spin = if square > round_off::GIVEN * round_off::GIVEN {
            (along - cosine * rate.dot(&normal)) / square
        } else {
            along
        };
        spins[joint.frames[1].node.index()] = spin * axis;
    }
    spins
}

/// A node's frame and twist some time later, if its wheel continues to roll steadily: the axes that do not spin move with their
/// twist W.
pub(super) fn later(frame: Motion, twist: &Vector6, spin: &Vector3, time: f64) -> (Motion, Vector6) {
    let own = lissom_motion::screw(&Vector3::zeros(), spin);
    let rest = twist - own;
    let turn = Motion::exponential(&(time * own));
    (frame * Motion::exponential(&(time * rest)) * turn, turn.adjoint_inverse_times(&rest) + own)
}

impl<'a> LinearModel<'a> {
    /// Whether wheels are rolling: their contacts move relative to the axes of the nodes.
    pub fn rolls_on(&self) -> bool {
        spins(self.system(), self.kinematics()).iter().any(|spin| *spin != Vector3::zeros())
    }

    /// This model in axes that do not spin with the wheels. Its modes are valid only if
    /// [`departure_of`](Self::departure_of) confirms them.
    pub fn in_rolling_axes(&self) -> LinearModel<'a> {
        let layout = self.system().layout();
        let rate = self.spin().norm();
        let mut columns = vec![Vec::new(); self.coordinate_count()];
        for (node, spin) in NodeId::enumerate(spins(self.system(), self.kinematics())) {
            let turning = (spin / rate).cross_matrix();
            let rows = layout.rows_of_node(node);
            for first in [0, 3] {
                for (i, j) in (0..3).flat_map(|i| (0..3).map(move |j| (i, j))) {
                    let (row, column) = (rows[first + i], rows[first + j]);
                    if row != LOCKED && column != LOCKED && turning[(i, j)] != 0.0 {
                        columns[column as usize].push((row as usize, turning[(i, j)]));
                    }
                }
            }
        }
        self.in_axes_of(Generator { columns, rate })
    }
}
