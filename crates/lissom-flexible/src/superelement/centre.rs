//! The centre of mass of a superelement, displaced by its first-order deformation. With the whole mass there, translations of
//! the part are exact regardless of other motions, and weight is the gradient of an energy.
//!
//! Legend: (E, r) frame of an interface in the floating frame, V and V_f twists in own axes, A = Ad((E, r)⁻¹), χ = δh - A δh_f
//! variation of one frame relative to the other, (y, z) = V - A V_f, κ axial vector of E, which is log E to first order.
//!
//! ```text
//! x_c = x_f + R_f ρ,      m ρ = m c + Σ (G_l (r - X) + G_a κ) + G_q q
//! ṙ = E y,     κ̇ = J z,     J = ½ (tr E - Eᵀ),      r̈ = E (ẏ + z × y),      κ̈ = J ż + ax(E z̃ z̃)
//! a_c = v̇_f + ω × v_f + ω̇ × ρ + ω × (ω × ρ) + 2 ω × ρ̇ + ρ̈              (floating axes)
//! force m (a_c - R_fᵀ g), by the transposed gradient W of x_c
//! ```

use lissom_motion::{
    Matrix3, Matrix6, Motion, Vector3, Vector6, axial, lie_bracket, lie_bracket_matrix, rotation_part, screw,
    skew, translation_part,
};
use nalgebra::{Matrix3x6, Matrix3xX};

use super::part::Part;
use lissom_mechanics::elements::{Tangents, add_block};
use lissom_mechanics::kinematics::Kinematics;

/// One interface in the formulas of the centre.
struct Seen {
    /// A.
    to_own: Matrix6,
    /// E.
    turn: Matrix3,
    /// J, and κ.
    map: Matrix3,
    axis: Vector3,
    /// (y, z) and its rate, A V_f and A V̇_f.
    twist: Vector6,
    acceleration: Vector6,
    carried: Vector6,
    carried_acceleration: Vector6,
    /// G_l and G_a over m.
    by_place: Matrix3,
    by_rotation: Matrix3,
}

/// The centre of mass at one instant.
#[derive(Default)]
pub(super) struct Centre {
    seen: Vec<Option<Seen>>,
    /// ρ, ρ̇, ρ̈ [m, m/s, m/s²].
    place: Vector3,
    rate: Vector3,
    /// a_c - R_fᵀ g.
    against: Vector3,
    /// R_fᵀ g.
    gravity: Vector3,
    /// Velocity, angular velocity of the floating frame, and the rate of the latter.
    velocity: Vector3,
    spin: Vector3,
    spin_rate: Vector3,
    /// W.
    gradient: Vec<Vector3>,
}

/// [G_l E, G_a J], for what is linear in (E y, J z).
fn joined(seen: &Seen) -> Matrix3x6<f64> {
    let mut map = Matrix3x6::zeros();
    map.fixed_view_mut::<3, 3>(0, 0).copy_from(&(seen.by_place * seen.turn));
    map.fixed_view_mut::<3, 3>(0, 3).copy_from(&(seen.by_rotation * seen.map));
    map
}

/// A 3 x 3 matrix on the rotations only, with zeros on the translations.
fn on_rotations(matrix: &Matrix3) -> Matrix3x6<f64> {
    let mut map = Matrix3x6::zeros();
    map.fixed_view_mut::<3, 3>(0, 3).copy_from(matrix);
    map
}

/// ∂(J z)/∂χ of the rotation at constant z: -z κᵀ - ½ (Eᵀ z)~.
fn turned_map(seen: &Seen, z: &Vector3) -> Matrix3 {
    -z * seen.axis.transpose() - 0.5 * skew(&seen.turn.tr_mul(z))
}

impl Centre {
    /// Evaluates the motion `at`.
    pub(super) fn enter(&mut self, of: &Part, at: &Kinematics) {
        let base = &at.nodes[of.nodes[of.frame]];
        let inverse = of.total.recip();
        self.velocity = translation_part(&base.twist);
        self.spin = rotation_part(&base.twist);
        self.spin_rate = rotation_part(&base.acceleration);
        self.gravity = base.frame.rotation.apply_inverse(&of.gravity.at(at.time));
        let (mut place, mut rate, mut second) = (inverse * of.moment, Vector3::zeros(), Vector3::zeros());
        self.seen.clear();
        for (i, &node) in of.nodes.iter().enumerate() {
            if i == of.frame {
                self.seen.push(None);
                continue;
            }
            let motion = &at.nodes[node];
            let relative: Motion = motion.frame.relative_to(&base.frame);
            let to_own = relative.inverse().adjoint();
            let turn = relative.rotation.matrix();
            let (carried, carried_acceleration) = (to_own * base.twist, to_own * base.acceleration);
            let twist = motion.twist - carried;
            let acceleration = motion.acceleration - carried_acceleration + lie_bracket(&twist, &carried);
            let axis = axial(&turn);
            let seen = Seen {
                to_own,
                turn,
                map: 0.5 * (Matrix3::from_diagonal_element(turn.trace()) - turn.transpose()),
                axis,
                twist,
                acceleration,
                carried,
                carried_acceleration,
                by_place: inverse * of.carried.fixed_columns::<3>(6 * i),
                by_rotation: inverse * of.carried.fixed_columns::<3>(6 * i + 3),
            };
            let (y, z) = (translation_part(&twist), rotation_part(&twist));
            place += seen.by_place * (relative.position - of.places[i]) + seen.by_rotation * axis;
            let map = joined(&seen);
            rate += map * twist;
            second += map * acceleration
                + seen.by_place * (turn * z.cross(&y))
                + seen.by_rotation * axial(&(turn * skew(&z) * skew(&z)));
            self.seen.push(Some(seen));
        }
        for (k, &coordinate) in of.coordinates.iter().enumerate() {
            let column = inverse * of.carried.column(6 * of.nodes.len() + k);
            let motion = &at.coordinates[coordinate];
            place += motion.value * column;
            rate += motion.rate * column;
            second += motion.acceleration * column;
        }
        (self.place, self.rate) = (place, rate);
        let own = translation_part(&base.acceleration) + self.spin.cross(&self.velocity);
        let turning = self.spin_rate.cross(&place) + self.spin.cross(&self.spin.cross(&place));
        self.against = own + turning + 2.0 * self.spin.cross(&rate) + second - self.gravity;
        self.fill_gradient(of);
    }

    fn fill_gradient(&mut self, of: &Part) {
        self.gradient.clear();
        self.gradient.resize(of.size(), Vector3::zeros());
        let frame = 6 * of.frame;
        let turning = -skew(&self.place);
        for k in 0..3 {
            self.gradient[frame + k][k] += 1.0;
            self.gradient[frame + 3 + k] += turning.column(k);
        }
        for (i, seen) in self.seen.iter().enumerate() {
            let Some(seen) = seen else { continue };
            let own = joined(seen);
            let by_frame = -own * seen.to_own;
            for k in 0..6 {
                self.gradient[6 * i + k] += own.column(k);
                self.gradient[frame + k] += by_frame.column(k);
            }
        }
        for k in 6 * of.nodes.len()..of.size() {
            self.gradient[k] = of.carried.column(k) / of.total;
        }
    }

    /// Velocity of the centre, in floating axes [m/s].
    pub(super) fn velocity(&self) -> Vector3 {
        self.velocity + self.spin.cross(&self.place) + self.rate
    }

    /// Position of the centre from the floating frame, in its axes [m].
    pub(super) fn place(&self) -> Vector3 {
        self.place
    }

    /// Adds the forces of inertia and weight.
    pub(super) fn add_forces(&self, mass: f64, out: &mut [f64]) {
        let force = mass * self.against;
        for (sum, column) in out.iter_mut().zip(&self.gradient) {
            *sum += column.dot(&force);
        }
    }

    /// Adds m WᵀW.
    pub(super) fn add_mass(&self, mass: f64, out: &mut [f64]) {
        let size = self.gradient.len();
        for (i, row) in self.gradient.iter().enumerate() {
            for (j, column) in self.gradient.iter().enumerate() {
                out[i * size + j] += mass * row.dot(column);
            }
        }
    }

    /// Adds the derivatives of the forces.
    pub(super) fn add_tangents(&self, of: &Part, scratch: &mut Derivatives, out: &mut Tangents) {
        self.add_mass(of.total, &mut out.mass);
        self.differentiate(of, scratch);
        let size = self.gradient.len();
        for (i, row) in self.gradient.iter().enumerate() {
            for j in 0..size {
                out.stiffness[i * size + j] += of.total * row.dot(&scratch.by_place.column(j));
                out.damping[i * size + j] += of.total * row.dot(&scratch.by_twist.column(j));
            }
        }
        self.add_geometric(of, out);
    }

    /// Derivatives of a_c - R_fᵀ g with respect to positions and twists.
    fn differentiate(&self, of: &Part, scratch: &mut Derivatives) {
        scratch.clear(of.size());
        let frame = 6 * of.frame;
        let spin = skew(&self.spin);
        let centrifugal = skew(&self.spin_rate) + spin * spin;
        // δ(R_fᵀ g) = (R_fᵀ g)~ θ_f.
        add(&mut scratch.by_place, frame + 3, &-skew(&self.gravity));
        add(&mut scratch.by_twist, frame, &spin);
        let whirling = -skew(&self.spin.cross(&self.place)) - spin * skew(&self.place);
        let of_spin = -skew(&self.velocity) + whirling - 2.0 * skew(&self.rate);
        add(&mut scratch.by_twist, frame + 3, &of_spin);
        for (i, seen) in self.seen.iter().enumerate() {
            let Some(seen) = seen else { continue };
            let (y, z) = (translation_part(&seen.twist), rotation_part(&seen.twist));
            let (ay, az) = (translation_part(&seen.acceleration), rotation_part(&seen.acceleration));
            let carried = lie_bracket_matrix(&seen.carried);
            let own = lie_bracket_matrix(&seen.twist);
            let map = joined(seen);
            // Dependence of ρ̈ on the twist: G_l E (δz × y + z × δy) + G_a ax(E (δz~ z̃ + z̃ δz~)).
            let mut squared = Matrix3::zeros();
            let mut squared_by_turn = Matrix3::zeros();
            for k in 0..3 {
                let unit = skew(&Vector3::ith(k, 1.0));
                squared.set_column(k, &axial(&(seen.turn * (unit * skew(&z) + skew(&z) * unit))));
                squared_by_turn.set_column(k, &axial(&(seen.turn * unit * skew(&z) * skew(&z))));
            }
            let mut second_by_twist = Matrix3x6::zeros();
            second_by_twist.fixed_view_mut::<3, 3>(0, 0).copy_from(&(seen.by_place * seen.turn * skew(&z)));
            let by_spin = -seen.by_place * seen.turn * skew(&y) + seen.by_rotation * squared;
            second_by_twist.fixed_view_mut::<3, 3>(0, 3).copy_from(&by_spin);
            // With respect to χ at constant (y, z) and its rate.
            let rate_by_turn =
                -seen.by_place * seen.turn * skew(&y) + seen.by_rotation * turned_map(seen, &z);
            let second_by_turn = -seen.by_place * seen.turn * skew(&(ay + z.cross(&y)))
                + seen.by_rotation * (turned_map(seen, &az) + squared_by_turn);
            let twist_by_place = -carried;
            let acceleration_by_place =
                -lie_bracket_matrix(&seen.carried_acceleration) + carried * carried + own * carried;
            let rate_by_place = on_rotations(&rate_by_turn) + map * twist_by_place;
            let second_by_place = on_rotations(&second_by_turn)
                + map * acceleration_by_place
                + second_by_twist * twist_by_place;
            let by_place = centrifugal * map + 2.0 * spin * rate_by_place + second_by_place;
            add_six(&mut scratch.by_place, 6 * i, &by_place);
            add_six(&mut scratch.by_place, frame, &(-by_place * seen.to_own));
            // With respect to twists: δ(y, z) = δV - A δV_f, and its rate contains -[A V_f, ·] of that and [(y, z), A
            // δV_f].
            let by_relative = 2.0 * spin * map + second_by_twist - map * carried;
            add_six(&mut scratch.by_twist, 6 * i, &by_relative);
            add_six(&mut scratch.by_twist, frame, &((map * own - by_relative) * seen.to_own));
        }
        for k in 6 * of.nodes.len()..of.size() {
            let column = self.gradient[k];
            scratch.by_place.set_column(k, &(centrifugal * column));
            scratch.by_twist.set_column(k, &(2.0 * spin * column));
        }
    }

    /// Adds the terms due to the rotation of the forces: ∂(Wᵀ F)/∂ position at constant F.
    fn add_geometric(&self, of: &Part, out: &mut Tangents) {
        let (size, frame) = (of.size(), 6 * of.frame);
        let force = of.total * self.against;
        // ρ × F on the floating frame.
        let lever = skew(&force);
        let mut add_lever = |column: usize, by: &Vector3| {
            let moment = -lever * by;
            for k in 0..3 {
                out.stiffness[(frame + 3 + k) * size + column] += moment[k];
            }
        };
        for k in 6 * of.nodes.len()..size {
            add_lever(k, &self.gradient[k]);
        }
        for (i, seen) in self.seen.iter().enumerate() {
            let Some(seen) = seen else { continue };
            let own = joined(seen);
            let by_frame = -own * seen.to_own;
            for k in 0..6 {
                add_lever(6 * i + k, &own.column(k).into_owned());
                add_lever(frame + k, &by_frame.column(k).into_owned());
            }
        }
        for (i, seen) in self.seen.iter().enumerate() {
            let Some(seen) = seen else { continue };
            let (p, m) = (seen.by_place.tr_mul(&force), seen.by_rotation.tr_mul(&force));
            let (linear, angular) = (seen.turn.tr_mul(&p), seen.map.tr_mul(&m));
            // δ(Eᵀ p) = (Eᵀ p)~ χ, δ(Jᵀ m) = -m κᵀ χ + ½ E m̃ χ.
            let mut by_place = Matrix6::zeros();
            by_place.fixed_view_mut::<3, 3>(0, 3).copy_from(&skew(&linear));
            let bent = -m * seen.axis.transpose() + 0.5 * seen.turn * skew(&m);
            by_place.fixed_view_mut::<3, 3>(3, 3).copy_from(&bent);
            // ad(χ)ᵀ w as a matrix on χ.
            let mut coadjoint = Matrix6::zeros();
            let wrench = screw(&linear, &angular);
            let (f, t) = (skew(&translation_part(&wrench)), skew(&rotation_part(&wrench)));
            coadjoint.fixed_view_mut::<3, 3>(0, 3).copy_from(&f);
            coadjoint.fixed_view_mut::<3, 3>(3, 0).copy_from(&f);
            coadjoint.fixed_view_mut::<3, 3>(3, 3).copy_from(&t);
            let on_frame = seen.to_own.transpose() * (coadjoint - by_place);
            for (row, block) in [(6 * i, by_place), (frame, on_frame)] {
                add_block(&mut out.stiffness, size, (row, 6 * i), &block);
                add_block(&mut out.stiffness, size, (row, frame), &(-block * seen.to_own));
            }
        }
    }
}

/// Derivatives of the acceleration of the centre, one column per unknown.
pub(super) struct Derivatives {
    by_place: Matrix3xX<f64>,
    by_twist: Matrix3xX<f64>,
}

impl Default for Derivatives {
    fn default() -> Self {
        Self { by_place: Matrix3xX::zeros(0), by_twist: Matrix3xX::zeros(0) }
    }
}

impl Derivatives {
    fn clear(&mut self, size: usize) {
        for matrix in [&mut self.by_place, &mut self.by_twist] {
            if matrix.ncols() != size {
                *matrix = Matrix3xX::zeros(size);
            }
            matrix.fill(0.0);
        }
    }
}

fn add(matrix: &mut Matrix3xX<f64>, column: usize, block: &Matrix3) {
    let mut view = matrix.fixed_columns_mut::<3>(column);
    view += block;
}

fn add_six(matrix: &mut Matrix3xX<f64>, column: usize, block: &Matrix3x6<f64>) {
    let mut view = matrix.fixed_columns_mut::<6>(column);
    view += block;
}
