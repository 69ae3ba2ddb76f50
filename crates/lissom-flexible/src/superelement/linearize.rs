//! Derivatives of a superelement's forces. The motion enters only through maps y_i = A_i ξ_i + F_i ξ_f of the unknowns ξ of
//! one interface and of the floating frame.

use lissom_motion::{
    Matrix3, Matrix6, Vector3, Vector6, inverse_tangent_derivative, inverse_tangent_transpose_derivative,
    screw, skew,
};
use nalgebra::{DMatrix, Matrix3x6};

use super::element_scratch::ElementScratch;
use super::part::Part;
use super::vectors::three;
use lissom_mechanics::elements::{Tangents, add_block};

/// A linear map of the unknowns, interface by interface.
#[derive(Default)]
pub(super) struct Map {
    own: Vec<Matrix6>,
    frame: Vec<Matrix6>,
    /// Whether modal coordinates are mapped to themselves, or to zero.
    keeps_modes: bool,
}

impl Map {
    pub(super) fn begin(&mut self, keeps_modes: bool) {
        self.own.clear();
        self.frame.clear();
        self.keeps_modes = keeps_modes;
    }

    pub(super) fn push(&mut self, own: &Matrix6, frame: &Matrix6) {
        self.own.push(*own);
        self.frame.push(*frame);
    }

    /// The product of the matrix and this map.
    pub(super) fn after(&self, matrix: &DMatrix<f64>, frame: usize, out: &mut DMatrix<f64>) {
        let size = matrix.ncols();
        make_room(out, matrix.nrows(), size);
        for (i, (own, to_frame)) in self.own.iter().zip(&self.frame).enumerate() {
            let columns = matrix.columns(6 * i, 6);
            out.columns_mut(6 * i, 6).gemm(1.0, &columns, own, 1.0);
            out.columns_mut(6 * frame, 6).gemm(1.0, &columns, to_frame, 1.0);
        }
        if self.keeps_modes {
            let first = 6 * self.own.len();
            out.columns_mut(first, size - first).copy_from(&matrix.columns(first, size - first));
        }
    }

    /// Adds the product of this map's transpose and the matrix.
    pub(super) fn add_before(&self, matrix: &DMatrix<f64>, frame: usize, out: &mut [f64]) {
        let size = matrix.nrows();
        for (i, (own, to_frame)) in self.own.iter().zip(&self.frame).enumerate() {
            let rows = matrix.rows(6 * i, 6);
            add_rows(out, 6 * i, own, &rows);
            if *to_frame != Matrix6::zeros() {
                add_rows(out, 6 * frame, to_frame, &rows);
            }
        }
        if self.keeps_modes {
            for row in 6 * self.own.len()..size {
                for column in 0..size {
                    out[row * size + column] += matrix[(row, column)];
                }
            }
        }
    }
}

/// Six rows of a matrix.
type Rows<'a> = nalgebra::MatrixView<'a, f64, nalgebra::Dyn, nalgebra::Dyn, nalgebra::U1, nalgebra::Dyn>;

/// Adds `map`ᵀ times six rows at the rows from `first` on.
fn add_rows(out: &mut [f64], first: usize, map: &Matrix6, rows: &Rows<'_>) {
    let size = rows.ncols();
    for column in 0..size {
        for i in 0..6 {
            let sum: f64 = (0..6).map(|k| map[(k, i)] * rows[(k, column)]).sum();
            out[(first + i) * size + column] += sum;
        }
    }
}

/// Adds the product of a 3 x 3 factor and three rows of a matrix.
fn add_three(out: &mut DMatrix<f64>, first: usize, factor: &Matrix3, rows: &DMatrix<f64>, from: usize) {
    for column in 0..out.ncols() {
        let own = Vector3::new(rows[(from, column)], rows[(from + 1, column)], rows[(from + 2, column)]);
        let sum = factor * own;
        for k in 0..3 {
            out[(first + k, column)] += sum[k];
        }
    }
}

/// Storage for the maps and for matrices.
#[derive(Default)]
pub(super) struct Maps {
    /// ∂u/∂ position, and ∂u̇/∂ position.
    displacement: Map,
    rate: Map,
    /// ∂η/∂ twist, and ∂η/∂ position.
    velocity: Map,
    velocity_by_place: Map,
    /// ∂η̇/∂ twist, and ∂η̇/∂ position.
    acceleration_by_twist: Map,
    acceleration_by_place: Map,
    first: DMatrix<f64>,
    second: DMatrix<f64>,
    /// Six rows of a matrix, and the additional force on the floating frame.
    six: DMatrix<f64>,
    on_frame: DMatrix<f64>,
}

/// Resizes to a matrix of zeros, without allocation if it has the size.
fn make_room(matrix: &mut DMatrix<f64>, rows: usize, columns: usize) {
    if matrix.shape() != (rows, columns) {
        *matrix = DMatrix::zeros(rows, columns);
    }
    matrix.fill(0.0);
}

fn blocks(linear: (Matrix3, Matrix3), angular: (Matrix3, Matrix3)) -> Matrix6 {
    let mut matrix = Matrix6::zeros();
    matrix.fixed_view_mut::<3, 3>(0, 0).copy_from(&linear.0);
    matrix.fixed_view_mut::<3, 3>(0, 3).copy_from(&linear.1);
    matrix.fixed_view_mut::<3, 3>(3, 0).copy_from(&angular.0);
    matrix.fixed_view_mut::<3, 3>(3, 3).copy_from(&angular.1);
    matrix
}

fn rotations(of: impl Fn(&Vector6, &Vector6) -> Matrix6, angles: &Vector3, other: &Vector3) -> Matrix3 {
    let about = |angular: &Vector3| screw(&Vector3::zeros(), angular);
    of(&about(angles), &about(other)).fixed_view::<3, 3>(3, 3).into_owned()
}

impl Maps {
    fn fill(&mut self, of: &Part, scratch: &ElementScratch) {
        let zero = Matrix3::zeros();
        let spin = skew(&scratch.twist[1]);
        self.displacement.begin(true);
        self.rate.begin(false);
        self.velocity.begin(true);
        self.velocity_by_place.begin(false);
        self.acceleration_by_twist.begin(false);
        self.acceleration_by_place.begin(false);
        for i in 0..of.nodes.len() {
            let turn = scratch.turns[i];
            let [v, w] = [0, 3].map(|part| turn.tr_mul(&three(&scratch.velocity, 6 * i + part)));
            let (speed, turning) =
                (skew(&three(&scratch.velocity, 6 * i)), skew(&three(&scratch.velocity, 6 * i + 3)));
            if i == of.frame {
                self.displacement.push(&Matrix6::zeros(), &Matrix6::zeros());
                self.rate.push(&Matrix6::zeros(), &Matrix6::zeros());
            } else {
                let inverse = scratch.inverse_tangents[i];
                let angles = three(&scratch.displacement, 6 * i + 3);
                let arm = skew(&scratch.arms[i]);
                let own = blocks((turn, zero), (zero, inverse));
                let by_frame = blocks((-Matrix3::identity(), arm), (zero, -inverse * turn.transpose()));
                // ∂u̇: of r with respect to v̂ and r; of log E with respect to the angles, and to ω_f in the
                // interface's axes.
                let bent = rotations(inverse_tangent_derivative, &angles, &scratch.relative_spins[i]);
                let seen = turn.tr_mul(&scratch.twist[1]);
                let rate_own =
                    blocks((-spin * turn, -turn * skew(&v)), (zero, bent * inverse - inverse * skew(&seen)));
                let rate_frame = blocks(
                    (spin, speed - spin * arm),
                    (zero, -bent * inverse * turn.transpose() + inverse * turn.transpose() * spin),
                );
                self.displacement.push(&own, &by_frame);
                self.rate.push(&rate_own, &rate_frame);
            }
            self.velocity.push(&blocks((turn, zero), (zero, turn)), &Matrix6::zeros());
            let turned = (-turn * skew(&v), -turn * skew(&w));
            self.velocity_by_place
                .push(&blocks((zero, turned.0), (zero, turned.1)), &blocks((zero, speed), (zero, turning)));
            self.acceleration_by_twist.push(
                &blocks((turn * skew(&w) - spin * turn, turned.0), (zero, -spin * turn)),
                &blocks((zero, speed), (zero, turning)),
            );
            let [linear, angular] = scratch.own_accelerations[i].map(|own| skew(&own));
            // E ã = (E a)~ E.
            self.acceleration_by_place.push(
                &blocks((zero, -linear * turn - spin * turned.0), (zero, -angular * turn - spin * turned.1)),
                &blocks((zero, linear - spin * speed), (zero, angular - spin * turning)),
            );
        }
    }

    /// The mass matrix, row by row.
    pub(super) fn mass(&mut self, of: &Part, scratch: &ElementScratch, out: &mut Vec<f64>) {
        self.velocity.begin(true);
        let zero = Matrix3::zeros();
        for turn in &scratch.turns {
            self.velocity.push(&blocks((*turn, zero), (zero, *turn)), &Matrix6::zeros());
        }
        out.clear();
        out.resize(of.size() * of.size(), 0.0);
        self.velocity.after(&of.mass, of.frame, &mut self.first);
        self.velocity.add_before(&self.first, of.frame, out);
    }

    /// Adds the derivatives of elastic and viscous forces; the scratch contains motion and stress.
    pub(super) fn add_elastic_tangents(&mut self, of: &Part, scratch: &ElementScratch, out: &mut Tangents) {
        self.fill(of, scratch);
        let frame = of.frame;
        // Elastic and viscous.
        self.displacement.after(&of.stiffness, frame, &mut self.first);
        if let Some(damping) = &of.damping {
            self.displacement.after(damping, frame, &mut self.second);
            self.displacement.add_before(&self.second, frame, &mut out.damping);
            self.rate.after(damping, frame, &mut self.second);
            self.first += &self.second;
        }
        self.displacement.add_before(&self.first, frame, &mut out.stiffness);
        geometric(of, scratch, &mut out.stiffness);
    }

    /// Adds the derivatives of inertial forces, after those of elastic ones; the scratch contains motion and momenta.
    pub(super) fn add_inertial_tangents(&mut self, of: &Part, scratch: &ElementScratch, out: &mut Tangents) {
        let frame = of.frame;
        self.velocity.after(&of.mass, frame, &mut self.first);
        self.velocity.add_before(&self.first, frame, &mut out.mass);
        self.acceleration_by_twist.after(&of.mass, frame, &mut self.second);
        self.add_momenta(of, scratch, false, &mut out.damping);
        self.velocity_by_place.after(&of.mass, frame, &mut self.first);
        self.acceleration_by_place.after(&of.mass, frame, &mut self.second);
        self.add_momenta(of, scratch, true, &mut out.stiffness);
    }

    /// Adds the derivatives of the inertial forces: `first` contains those of p, `second` those of ṗ.
    fn add_momenta(&mut self, of: &Part, scratch: &ElementScratch, by_place: bool, out: &mut [f64]) {
        let size = of.size();
        let frame = of.frame;
        let spin = skew(&scratch.twist[1]);
        make_room(&mut self.on_frame, 3, size);
        make_room(&mut self.six, 6, size);
        for i in 0..of.nodes.len() {
            let turn = scratch.turns[i];
            let p = skew(&three(&scratch.momentum, 6 * i));
            let l = skew(&three(&scratch.momentum, 6 * i + 3));
            let speed = skew(&three(&scratch.velocity, 6 * i));
            let turning = skew(&three(&scratch.velocity, 6 * i + 3));
            self.six.copy_from(&self.first.rows(6 * i, 6));
            add_three(&mut self.second, 6 * i, &spin, &self.six, 0);
            add_three(&mut self.second, 6 * i + 3, &(spin - turning), &self.six, 3);
            add_three(&mut self.on_frame, 0, &speed, &self.six, 0);
            add_three(&mut self.on_frame, 0, &turning, &self.six, 3);
            // Terms with η_i itself, and with ω_f.
            let map = if by_place { &self.velocity_by_place } else { &self.velocity };
            for (columns, map) in [(6 * i, map.own[i]), (6 * frame, map.frame[i])] {
                let linear: Matrix3x6<f64> = -p * map.fixed_view::<3, 6>(0, 0);
                let angular: Matrix3x6<f64> = l * map.fixed_view::<3, 6>(3, 0);
                add_to(&mut self.second, (6 * i + 3, columns), &angular);
                add_to(&mut self.on_frame, (0, columns), &(linear - angular));
            }
            let [force, moment] = scratch.inertial(i);
            if by_place {
                for (part, own) in [(0, force), (3, moment)] {
                    // δ(Eᵀ s) = (Eᵀ s)~ θ_i - Eᵀ s̃ θ_f.
                    let local = skew(&turn.tr_mul(&own));
                    add_block(out, size, (6 * i + part, 6 * i + 3), &local);
                    add_block(out, size, (6 * i + part, 6 * frame + 3), &-turn.tr_mul(&skew(&own)));
                }
            } else {
                for (part, own) in [(0, &p), (3, &l)] {
                    add_to(&mut self.second, (6 * i + part, 6 * frame + 3), &-own);
                }
            }
        }
        self.velocity.add_before(&self.second, frame, out);
        for k in 0..3 {
            for column in 0..size {
                out[(6 * frame + 3 + k) * size + column] += self.on_frame[(k, column)];
            }
        }
    }
}

fn add_to<const R: usize, const C: usize>(
    matrix: &mut DMatrix<f64>,
    (row, column): (usize, usize),
    block: &nalgebra::SMatrix<f64, R, C>,
) {
    let mut view = matrix.fixed_view_mut::<R, C>(row, column);
    view += block;
}

/// Adds the terms due to the rotation of the forces conjugate to u.
fn geometric(of: &Part, scratch: &ElementScratch, out: &mut [f64]) {
    let size = of.size();
    let rotation = 6 * of.frame + 3;
    for i in (0..of.nodes.len()).filter(|&i| i != of.frame) {
        let (turn, inverse) = (scratch.turns[i], scratch.inverse_tangents[i]);
        let (force, moment) = (three(&scratch.stress, 6 * i), three(&scratch.stress, 6 * i + 3));
        let own = 6 * i + 3;
        // Eᵀ f.
        add_block(out, size, (6 * i, own), &skew(&turn.tr_mul(&force)));
        add_block(out, size, (6 * i, rotation), &-turn.tr_mul(&skew(&force)));
        // On the frame -r × f.
        let force = skew(&force);
        add_block(out, size, (rotation, 6 * i), &(force * turn));
        add_block(out, size, (rotation, 6 * of.frame), &-force);
        add_block(out, size, (rotation, rotation), &(force * skew(&scratch.arms[i])));
        // T⁻ᵀ m, and the balancing moment on the frame.
        let local = inverse.tr_mul(&moment);
        let angles = three(&scratch.displacement, own);
        let bent = rotations(inverse_tangent_transpose_derivative, &angles, &moment) * inverse;
        let seen = bent * turn.transpose();
        add_block(out, size, (own, own), &bent);
        add_block(out, size, (own, rotation), &-seen);
        add_block(out, size, (rotation, own), &(turn * (skew(&local) - bent)));
        add_block(out, size, (rotation, rotation), &(turn * seen - skew(&(turn * local))));
    }
}
