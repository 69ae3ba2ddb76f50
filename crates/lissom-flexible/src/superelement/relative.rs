//! The frame of an interface relative to the floating frame.
//!
//! Legend: (E, r) frame of an interface in the floating frame, V and V_f twists in own axes, A = Ad((E, r)⁻¹), χ = δh - A δh_f
//! variation of one frame relative to the other, (y, z) = V - A V_f, κ axial vector of E, which is log E to first order.
//!
//! ```text
//! ṙ = E y,     κ̇ = J z,     J = ½ (tr E - Eᵀ),      r̈ = E (ẏ + z × y),      κ̈ = J ż + ax(E z̃ z̃)
//! ```

use lissom_motion::{
    Matrix3, Matrix6, Motion, Vector3, Vector6, axial, lie_bracket, lie_bracket_matrix, rotation_part, screw,
    skew, translation_part,
};

use super::part::Part;
use lissom_mechanics::elements::add_block;
use lissom_mechanics::kinematics::Kinematics;

/// One interface at one instant.
pub(super) struct Relative {
    /// A.
    pub(super) to_own: Matrix6,
    /// E, and r [m].
    pub(super) turn: Matrix3,
    pub(super) arm: Vector3,
    /// J, and κ.
    pub(super) map: Matrix3,
    pub(super) axis: Vector3,
    /// (y, z) and its rate, A V_f and A V̇_f.
    pub(super) twist: Vector6,
    pub(super) acceleration: Vector6,
    pub(super) carried: Vector6,
    pub(super) carried_acceleration: Vector6,
}

/// Derivatives of (ṙ, κ̇) and (r̈, κ̈) with respect to χ and to the twist.
pub(super) struct Slopes {
    /// ∂(ṙ, κ̇)/∂χ.
    pub(super) rate_by_place: Matrix6,
    /// ∂(r̈, κ̈)/∂χ.
    pub(super) second_by_place: Matrix6,
    /// ∂(r̈, κ̈)/∂V at constant V_f.
    pub(super) second_by_twist: Matrix6,
    /// ∂(r̈, κ̈)/∂(A V_f) at constant V.
    pub(super) second_by_carried: Matrix6,
}

fn diagonal(linear: &Matrix3, angular: &Matrix3) -> Matrix6 {
    let mut matrix = Matrix6::zeros();
    matrix.fixed_view_mut::<3, 3>(0, 0).copy_from(linear);
    matrix.fixed_view_mut::<3, 3>(3, 3).copy_from(angular);
    matrix
}

fn on_rotations(linear: &Matrix3, angular: &Matrix3) -> Matrix6 {
    let mut matrix = Matrix6::zeros();
    matrix.fixed_view_mut::<3, 3>(0, 3).copy_from(linear);
    matrix.fixed_view_mut::<3, 3>(3, 3).copy_from(angular);
    matrix
}

impl Relative {
    /// Interface `i`; none for the floating one.
    pub(super) fn of(element: &Part, i: usize, at: &Kinematics) -> Option<Self> {
        if i == element.frame {
            return None;
        }
        let base = &at.nodes[element.nodes[element.frame]];
        let motion = &at.nodes[element.nodes[i]];
        let relative: Motion = motion.frame.relative_to(&base.frame);
        let to_own = relative.inverse().adjoint();
        let turn = relative.rotation.matrix();
        let (carried, carried_acceleration) = (to_own * base.twist, to_own * base.acceleration);
        let twist = motion.twist - carried;
        Some(Self {
            to_own,
            turn,
            arm: relative.position,
            map: 0.5 * (Matrix3::from_diagonal_element(turn.trace()) - turn.transpose()),
            axis: axial(&turn),
            twist,
            acceleration: motion.acceleration - carried_acceleration + lie_bracket(&twist, &carried),
            carried,
            carried_acceleration,
        })
    }

    /// ∂(r, κ)/∂χ, which also maps (y, z) to (ṙ, κ̇).
    pub(super) fn gradient(&self) -> Matrix6 {
        diagonal(&self.turn, &self.map)
    }

    /// (ṙ, κ̇).
    pub(super) fn rate(&self) -> Vector6 {
        self.gradient() * self.twist
    }

    /// (r̈, κ̈).
    pub(super) fn second(&self) -> Vector6 {
        let (y, z) = (translation_part(&self.twist), rotation_part(&self.twist));
        let linear = self.turn * z.cross(&y);
        let angular = axial(&(self.turn * skew(&z) * skew(&z)));
        self.gradient() * self.acceleration + screw(&linear, &angular)
    }

    /// ∂(J z)/∂χ of the rotation at constant z: -z κᵀ - ½ (Eᵀ z)~.
    pub(super) fn turned_map(&self, z: &Vector3) -> Matrix3 {
        -z * self.axis.transpose() - 0.5 * skew(&self.turn.tr_mul(z))
    }

    /// Derivatives of rates and second rates with respect to the motion.
    pub(super) fn slopes(&self) -> Slopes {
        let (y, z) = (translation_part(&self.twist), rotation_part(&self.twist));
        let (ay, az) = (translation_part(&self.acceleration), rotation_part(&self.acceleration));
        let carried = lie_bracket_matrix(&self.carried);
        let own = lie_bracket_matrix(&self.twist);
        let map = self.gradient();
        // ax(E (δz~ z̃ + z̃ δz~)), and its derivative with respect to the rotation.
        let mut squared = Matrix3::zeros();
        let mut squared_by_turn = Matrix3::zeros();
        for k in 0..3 {
            let unit = skew(&Vector3::ith(k, 1.0));
            squared.set_column(k, &axial(&(self.turn * (unit * skew(&z) + skew(&z) * unit))));
            squared_by_turn.set_column(k, &axial(&(self.turn * unit * skew(&z) * skew(&z))));
        }
        let mut by_relative = on_rotations(&(-self.turn * skew(&y)), &squared);
        by_relative.fixed_view_mut::<3, 3>(0, 0).copy_from(&(self.turn * skew(&z)));
        let rate_by_turn = on_rotations(&(-self.turn * skew(&y)), &self.turned_map(&z));
        let second_by_turn = on_rotations(
            &(-self.turn * skew(&(ay + z.cross(&y)))),
            &(self.turned_map(&az) + squared_by_turn),
        );
        let twist_by_place = -carried;
        let acceleration_by_place =
            -lie_bracket_matrix(&self.carried_acceleration) + carried * carried + own * carried;
        let second_by_twist = by_relative - map * carried;
        Slopes {
            rate_by_place: rate_by_turn + map * twist_by_place,
            second_by_place: second_by_turn + map * acceleration_by_place + by_relative * twist_by_place,
            second_by_twist,
            second_by_carried: map * own - second_by_twist,
        }
    }

    /// Adds the terms due to the rotation of forces conjugate to (r, κ): ∂(Yᵀ f)/∂ position at constant f, for the interface `i`
    /// and the floating frame.
    pub(super) fn add_geometric(
        &self,
        (element, i): (&Part, usize),
        (force, moment): (&Vector3, &Vector3),
        out: &mut [f64],
    ) {
        let (size, frame) = (element.size(), 6 * element.frame);
        let (linear, angular) = (self.turn.tr_mul(force), self.map.tr_mul(moment));
        // δ(Eᵀ p) = (Eᵀ p)~ χ, δ(Jᵀ m) = -m κᵀ χ + ½ E m̃ χ.
        let bent = -moment * self.axis.transpose() + 0.5 * self.turn * skew(moment);
        let by_place = on_rotations(&skew(&linear), &bent);
        // ad(χ)ᵀ w as a matrix on χ.
        let mut coadjoint = on_rotations(&skew(&linear), &skew(&angular));
        coadjoint.fixed_view_mut::<3, 3>(3, 0).copy_from(&skew(&linear));
        let on_frame = self.to_own.transpose() * (coadjoint - by_place);
        for (row, block) in [(6 * i, by_place), (frame, on_frame)] {
            add_block(out, size, (row, 6 * i), &block);
            add_block(out, size, (row, frame), &(-block * self.to_own));
        }
    }
}
