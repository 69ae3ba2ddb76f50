//! Residual and linearisation of the whole system in SI. Knows no time step, scheme or scaling.
//!
//! ```text
//! coordinates:  M(q) a + f(q, v, t) + Bᵀ μ,   μ = λ + w c        multipliers:  c(q, t)
//! ```
//!
//! where the weight w of the augmented Lagrangian term is somebody else's choice.

use super::batch::{Chart, scatter};
use super::receiver::{Place, Receiver};
use super::state::{Kinematics, MotionChange};
use super::threads::Threads;
use super::{Drive, System};
use crate::elements::{MOST_UNKNOWNS, Tangents};
use crate::joints::attached::{AttachedJoint, Increments};
use crate::joints::derivatives::{Derivatives, LOCAL};
use crate::joints::{Equations, MOST_EQUATIONS, Quantity};

/// Where residual and tangent are evaluated.
#[derive(Clone, Copy, Debug)]
pub struct Point<'a> {
    /// Places, twists and accelerations.
    pub at: &'a Kinematics,
    /// Where the stresses of the geometric stiffness are taken from: `at` itself, or, while iterations are
    /// far from equilibrium, the start of the step. Stresses of a far iterate can be larger than any that
    /// the motion ever sees, for a small turn stretches a stiff element [cf. Magisano, Leonetti and Garcea
    /// 2017].
    pub stressed: &'a Kinematics,
    /// What has changed since the start of the step.
    pub increments: Increments<'a>,
    /// Multipliers [N, N m].
    pub multipliers: &'a [f64],
    /// Violations at the start of the step.
    pub violations: &'a [f64],
    /// The augmented Lagrangian term.
    pub augmentation: Augmentation,
}

/// How violations are turned into forces by the augmented Lagrangian term.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Augmentation {
    /// Force per violation of a length [N/m].
    pub weight: f64,
    /// The length that stands for a radian: an angle's violation weighs its square [m].
    pub radian: f64,
}

impl Augmentation {
    /// No forces.
    pub fn none() -> Self {
        Self { weight: 0.0, radian: 1.0 }
    }

    /// Weight of an equation's violation relative to that of a length: 1 or [m²].
    pub fn relative(&self, quantity: Quantity) -> f64 {
        match quantity {
            Quantity::Length => 1.0,
            Quantity::Angle => self.radian * self.radian,
        }
    }
}

/// Derivatives of the equations of motion in SI, each on the values of the tangent's pattern.
#[derive(Clone, Debug, Default)]
pub struct Linearization {
    /// ∂/∂ place, constraint forces at constant multipliers included.
    pub stiffness: Vec<f64>,
    /// ∂/∂ twist.
    pub damping: Vec<f64>,
    /// ∂/∂ acceleration.
    pub mass: Vec<f64>,
    /// BᵀWB: the augmented Lagrangian term for weight 1 of lengths.
    pub gram: Vec<f64>,
    /// B and Bᵀ in the multipliers' rows and columns.
    pub constraint: Vec<f64>,
    pub(super) scratch: Option<Box<Scratch>>,
}

/// Room for derivatives of one element or joint after the other.
#[derive(Clone, Debug)]
pub struct Scratch {
    pub(super) local: Tangents,
    pub(super) joint: Derivatives,
}

impl Default for Scratch {
    fn default() -> Self {
        Self { local: Tangents::new(MOST_UNKNOWNS), joint: Derivatives::new() }
    }
}

impl Linearization {
    /// Room for the linearisation of `system`, all zero.
    pub fn new(system: &System) -> Self {
        let zeros = vec![0.0; system.structure.pattern.entries()];
        Self {
            stiffness: zeros.clone(),
            damping: zeros.clone(),
            mass: zeros.clone(),
            gram: zeros.clone(),
            constraint: zeros,
            scratch: None,
        }
    }

    pub(super) fn clear(&mut self) {
        for values in
            [&mut self.stiffness, &mut self.damping, &mut self.mass, &mut self.gram, &mut self.constraint]
        {
            values.fill(0.0);
        }
    }
}

impl System {
    /// Residual at `point`: left-hand sides of the equations of motion in the rows of the coordinates,
    /// violations in the rows of the multipliers.
    pub fn residual(&self, point: &Point<'_>, out: &mut [f64]) {
        out.fill(0.0);
        for batch in &self.batches {
            batch.forces(point.at, out);
        }
        for (index, joint) in self.joints.iter().enumerate() {
            let rows = self.rows_of_joint(index);
            let mut local = [0.0; LOCAL + MOST_EQUATIONS];
            joint_residual(joint, point, &mut local[..rows.len()]);
            scatter(rows, &local, out);
        }
        self.add_drives(point, out);
    }

    /// The same on several threads, to the last bit.
    pub(crate) fn residual_side_by_side(&self, point: &Point<'_>, threads: &mut Threads, out: &mut [f64]) {
        out.fill(0.0);
        for batch in &self.batches {
            batch.forces_side_by_side(point.at, threads, out);
        }
        let starts = &self.joint_starts;
        let locals = threads.side_by_side(starts, &|joints, locals| {
            let first = starts[joints.start];
            for joint in joints {
                let own = starts[joint] - first..starts[joint + 1] - first;
                joint_residual(&self.joints[joint], point, &mut locals[own]);
            }
        });
        scatter(&self.joint_rows, locals, out);
        self.add_drives(point, out);
    }

    /// Rows of a joint's local unknowns and equations.
    pub(crate) fn rows_of_joint(&self, joint: usize) -> &[u32] {
        &self.joint_rows[self.joint_starts[joint]..self.joint_starts[joint + 1]]
    }

    /// Rows of a drive's coordinate and multiplier.
    pub(super) fn rows_of_drive(&self, drive: &Drive) -> [usize; 2] {
        let coordinate = self.layout.row_of_coordinate(drive.prescribed.coordinate);
        [coordinate, self.layout.coordinate_count + drive.multiplier]
    }

    fn add_drives(&self, point: &Point<'_>, out: &mut [f64]) {
        for drive in &self.drives {
            let rows = self.rows_of_drive(drive);
            let violation = drive_violation(drive, point);
            out[rows[1]] = violation;
            let weight = point.augmentation.weight * self.relative_weight(point, drive.multiplier);
            out[rows[0]] += point.multipliers[drive.multiplier] + weight * violation;
        }
    }

    fn relative_weight(&self, point: &Point<'_>, multiplier: usize) -> f64 {
        point.augmentation.relative(self.layout.quantities[self.layout.coordinate_count + multiplier])
    }

    /// Violations at `point` alone, by multiplier.
    pub fn stage_violations(&self, point: &Point<'_>, out: &mut [f64]) {
        for joint in &self.joints {
            let configuration = joint.configuration(&point.increments);
            let change = joint.joint().violation_change(&configuration.0, &configuration.1);
            for k in 0..joint.equations() {
                let multiplier = joint.first_multiplier + k;
                out[multiplier] = point.violations[multiplier] + change[k];
            }
        }
        for drive in &self.drives {
            out[drive.multiplier] = drive_violation(drive, point);
        }
    }

    /// Linearisation at `point` with respect to the unknowns of `chart`.
    pub fn linearize(&self, point: &Point<'_>, chart: Chart<'_>, out: &mut Linearization) {
        let mut scratch = out.scratch.take().unwrap_or_default();
        self.hand_derivatives(point, chart, &mut scratch, &mut Receiver::Apart(out));
        out.scratch = Some(scratch);
    }

    /// Hands the derivatives at `point` with respect to the unknowns of `chart` to `out`.
    pub fn hand_derivatives(
        &self,
        point: &Point<'_>,
        chart: Chart<'_>,
        scratch: &mut Scratch,
        out: &mut Receiver<'_>,
    ) {
        out.clear();
        for batch in &self.batches {
            batch.linearize((point.at, point.stressed), chart, &mut scratch.local, out);
        }
        self.linearize_constraints(point, chart, &mut scratch.joint, out);
    }

    /// Adds what constraints do.
    pub(super) fn linearize_constraints(
        &self,
        point: &Point<'_>,
        chart: Chart<'_>,
        scratch: &mut Derivatives,
        out: &mut Receiver<'_>,
    ) {
        for (index, joint) in self.joints.iter().enumerate() {
            linearize_joint(joint, point, chart, scratch);
            let place = Place { rows: self.rows_of_joint(index), runs: self.joint_places.of(index) };
            out.add_joint(place, scratch);
        }
        for drive in &self.drives {
            out.add_drive(drive.positions, self.relative_weight(point, drive.multiplier));
        }
    }

    /// Ḃ v + ∂²c/∂t² by multiplier: what the constraints' second time derivative holds besides B v̇.
    pub fn constraint_accelerations(&self, at: &Kinematics, out: &mut [f64]) {
        let still = vec![MotionChange::none(); at.nodes.len()];
        let unchanged = vec![0.0; at.coordinates.len()];
        let increments = Increments { start: at, nodes: &still, coordinates: &unchanged };
        for joint in &self.joints {
            let configuration = joint.configuration(&increments);
            let speeds = joint.speeds(at);
            for equation in 0..joint.equations() {
                let mut mu = Equations::default();
                mu[equation] = 1.0;
                // d/dt (B_eᵀ) = (∂(B_eᵀ)/∂q) v
                let curvature = joint.curvature(&configuration, &mu);
                out[joint.first_multiplier + equation] = speeds.dot(&(curvature * speeds));
            }
        }
        for drive in &self.drives {
            out[drive.multiplier] = -drive.prescribed.value.second_derivative(at.time);
        }
    }

    /// ∂c/∂t by multiplier.
    pub fn constraint_velocities(&self, at: &Kinematics, out: &mut [f64]) {
        out.fill(0.0);
        for drive in &self.drives {
            out[drive.multiplier] = -drive.prescribed.value.first_derivative(at.time);
        }
    }
}

fn drive_violation(drive: &Drive, point: &Point<'_>) -> f64 {
    let change = point.increments.coordinates[drive.prescribed.coordinate];
    point.violations[drive.multiplier]
        + drive.prescribed.violation_change(change, point.at.time, point.at.elapsed)
}

/// Violations c and augmented multipliers μ = λ + w c of a joint.
fn joint_multipliers(
    joint: &AttachedJoint,
    configuration: &(crate::joints::Relative, crate::joints::Own),
    point: &Point<'_>,
) -> (Equations, Equations) {
    let mut violation = joint.joint().violation_change(&configuration.0, &configuration.1);
    let mut mu = Equations::default();
    for k in 0..joint.equations() {
        let multiplier = joint.first_multiplier + k;
        violation[k] += point.violations[multiplier];
        let relative = point.augmentation.relative(joint.joint().equation_quantity(k));
        mu[k] = point.multipliers[multiplier] + point.augmentation.weight * relative * violation[k];
    }
    (violation, mu)
}

/// Forces of a joint on its unknowns, then its violations.
fn joint_residual(joint: &AttachedJoint, point: &Point<'_>, local: &mut [f64]) {
    let configuration = joint.configuration(&point.increments);
    let (violation, mu) = joint_multipliers(joint, &configuration, point);
    let forces = joint.forces(&configuration, &mu);
    let (own, equations) = local.split_at_mut(LOCAL);
    own.copy_from_slice(forces.as_slice());
    equations.copy_from_slice(&violation[..equations.len()]);
}

fn linearize_joint(joint: &AttachedJoint, point: &Point<'_>, chart: Chart<'_>, out: &mut Derivatives) {
    let configuration = joint.configuration(&point.increments);
    // The curvature of the augmented term, w c ∂²c/∂q², is left out: it vanishes at the solution, and far
    // from it, with w c much larger than the multipliers, it would spoil the correction.
    let mut mu = Equations::default();
    mu[..joint.equations()].copy_from_slice(
        &point.multipliers[joint.first_multiplier..joint.first_multiplier + joint.equations()],
    );
    let weights = std::array::from_fn(|k| point.augmentation.relative(joint.joint().equation_quantity(k)));
    let charts = match chart {
        Chart::Increments(tangents) => Some(joint.frames.map(|frame| &tangents[frame.node])),
        Chart::Body | Chart::Departures(_) => None,
    };
    joint.linearize(&configuration, &mu, &weights, charts, out);
}
