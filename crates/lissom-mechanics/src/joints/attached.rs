//! A joint between two nodes, with its rows in the system. Transforms the joint's equations in
//! the relative motion into equations in the unknowns of the nodes.
//!
//! ```text
//! G = H_A⁻¹ H_B of the joint frames,   η = δh_B - Ad(G⁻¹) δh_A,   w = (∂c/∂η)ᵀ μ
//! wrench on the tip's joint frame w, on the base's -Ad(G⁻¹)ᵀ w
//! ```

use std::ops::Range;

use lissom_motion::{Matrix3, Motion, Vector3, Vector6};
use nalgebra::{SMatrix, SVector};

use super::constraint::{Constraint, Port};
use super::derivatives::{Derivatives, IncrementTangent, Inner, LOCAL, OWN, Side, TIP};
use super::{
    AnyJoint, ConstraintHessian, Equations, Gradient, JointCoordinates, MAX_COORDINATES, MAX_EQUATIONS,
    Relative,
};
use crate::joints::evaluation_point::{Chart, Increments, Point};
use crate::kinematics::{CarriedFrame, CoordinateId, Kinematics, Quantity, split};
use crate::wheels::wheel_on_plane::DIRECTIONS;

/// Derivatives of the equations with respect to the local unknowns.
pub type LocalGradient = SMatrix<f64, MAX_EQUATIONS, LOCAL>;

/// A joint between two nodes.
#[derive(Debug)]
pub struct AttachedJoint {
    /// Name in the model.
    pub name: String,
    /// Name of its kind.
    pub kind: &'static str,
    /// Base and tip.
    pub frames: [CarriedFrame; 2],
    /// The joint frames of base and tip in whose axes outputs express motions and reactions: `frames`, except those of the
    /// last joint of a prescribed motion, whose base is a node within the chain. Their tip frames share one origin.
    pub output_frames: [CarriedFrame; 2],
    /// Coordinates of the joint; the first `joint.coordinates().len()` count.
    pub coordinates: Vec<CoordinateId>,
    /// Position of its first multiplier among all multipliers.
    pub first_multiplier: usize,
    /// Kind of the joint with parameters.
    pub joint: Box<dyn AnyJoint>,
}

impl AttachedJoint {
    /// This attachment with another joint.
    pub(super) fn with_joint(&self, joint: Box<dyn AnyJoint>) -> Self {
        Self {
            name: self.name.clone(),
            kind: self.kind,
            frames: self.frames,
            output_frames: self.output_frames,
            coordinates: self.coordinates.clone(),
            first_multiplier: self.first_multiplier,
            joint,
        }
    }

    /// Number of equations.
    #[inline]
    pub fn equations(&self) -> usize {
        self.joint.equations().len()
    }

    /// Multipliers of its reaction among all: those of its equations, then those that prevent a wheel from sliding.
    pub fn reacting(&self) -> Range<usize> {
        let slip = if self.rolls() { DIRECTIONS } else { 0 };
        self.first_multiplier..self.first_multiplier + self.equations() + slip
    }

    /// Whether it is a wheel that does not slide.
    pub fn rolls(&self) -> bool {
        self.joint.contact().is_some_and(|contact| contact.creep == 0.0)
    }

    /// The joint's equations.
    pub fn joint(&self) -> &dyn AnyJoint {
        self.joint.as_ref()
    }

    /// Relative motion of tip to base, between the frames of its equations.
    pub fn relative_motion(&self, at: &Kinematics) -> Motion {
        motion_between(self.frames, at)
    }

    /// Relative rotation and position at the start.
    pub fn start(&self, at: &Kinematics) -> (Matrix3, Vector3) {
        let Motion { rotation, position } = self.relative_motion(at);
        (rotation.matrix(), position)
    }

    /// Relative motion and its change over the step: see `relative_increment`.
    fn relative(&self, (rotation, position): (Matrix3, Vector3), increments: &Increments<'_>) -> Relative {
        let [base, tip] = self.frames.map(|frame| increments.nodes[frame.node].carried_at(&frame.offset));
        let a = base.turn.transpose();
        let turned = a * rotation;
        let rotation_change = turned + (rotation + turned) * tip.turn;
        let shift = rotation * tip.shift - base.shift;
        let position_change = a * (position + shift) + shift;
        Relative {
            rotation: rotation + rotation_change,
            position: position + position_change,
            rotation_change,
            position_change,
        }
    }

    fn own(&self, at: &Kinematics, changes: &[f64]) -> JointCoordinates {
        let mut own = JointCoordinates::default();
        for (k, &coordinate) in self.coordinates.iter().enumerate() {
            own.change[k] = changes[coordinate.index()];
            own.value[k] = at.coordinates[coordinate].value + own.change[k];
        }
        own
    }

    /// Relative motion and own coordinates, from absolute positions.
    pub fn evaluate_absolute(&self, at: &Kinematics) -> (Relative, JointCoordinates) {
        let mut own = JointCoordinates::default();
        for (k, &coordinate) in self.coordinates.iter().enumerate() {
            own.value[k] = at.coordinates[coordinate].value;
        }
        (Relative::at_start(&self.relative_motion(at)), own)
    }

    /// Derivatives of the equations with respect to the local unknowns, as body variations.
    pub(crate) fn gradient_at(&self, (relative, own): &(Relative, JointCoordinates)) -> LocalGradient {
        let mut gradient = Gradient::zeros();
        self.joint.gradient(relative, own, &mut gradient);
        let mut rows = gradient.relative * self.variation(relative);
        rows.fixed_columns_mut::<MAX_COORDINATES>(OWN).copy_from(&gradient.own);
        rows
    }

    /// Derivatives of the equations with respect to the relative motion and the own coordinates.
    pub fn own_gradient(&self, (relative, own): &(Relative, JointCoordinates)) -> Gradient {
        let mut gradient = Gradient::zeros();
        self.joint.gradient(relative, own, &mut gradient);
        gradient
    }

    /// A relative motion and coordinates that satisfy the equations: those at the creation of the joint.
    pub fn as_built(&self) -> (Relative, JointCoordinates) {
        let (values, relative) = self.joint.initial();
        (Relative::at_start(&relative), JointCoordinates { value: values, ..JointCoordinates::default() })
    }

    /// Relative motion and own coordinates after the increments.
    pub fn configuration(&self, increments: &Increments<'_>) -> (Relative, JointCoordinates) {
        self.configuration_from(self.start(increments.start), increments)
    }

    /// Relative motion and own coordinates, with known relative rotation and position at the start.
    pub(crate) fn configuration_from(
        &self,
        start: (Matrix3, Vector3),
        increments: &Increments<'_>,
    ) -> (Relative, JointCoordinates) {
        (self.relative(start, increments), self.own(increments.start, increments.coordinates))
    }

    /// Forces on the local unknowns for the multipliers `mu`.
    pub fn forces(
        &self,
        (relative, own): &(Relative, JointCoordinates),
        mu: &Equations,
    ) -> SVector<f64, LOCAL> {
        let (wrench, moments) = self.joint.wrench(relative, own, mu);
        let on_base = -adjoint_inverse_transpose(relative, &wrench);
        let base = self.frames[0].offset.adjoint_inverse_transpose_times(&on_base);
        let tip = self.frames[1].offset.adjoint_inverse_transpose_times(&wrench);
        let mut out = SVector::<f64, LOCAL>::zeros();
        out.fixed_rows_mut::<6>(0).copy_from(&base);
        out.fixed_rows_mut::<6>(TIP).copy_from(&tip);
        out.fixed_rows_mut::<MAX_COORDINATES>(OWN).copy_from(&moments);
        out
    }

    /// Derivatives of the equations and of the forces at constant multipliers `mu`, with respect to the local
    /// unknowns. `joint` is this joint's kind, if it is known; `weights` are those of the equations in BᵀWB.
    pub(super) fn linearize_as<J: AnyJoint + ?Sized>(
        &self,
        joint: &J,
        (relative, own): &(Relative, JointCoordinates),
        mu: &Equations,
        weights: &[f64; MAX_EQUATIONS],
        charts: Option<[&IncrementTangent; 2]>,
        out: &mut Derivatives,
    ) {
        let mut gradient = Gradient::zeros();
        joint.gradient(relative, own, &mut gradient);
        let mut hessian = ConstraintHessian::zeros();
        joint.constraint_hessian(relative, own, mu, &mut hessian);
        let (wrench, _) = joint.wrench(relative, own, mu);
        let inner = Inner {
            counts: (joint.equations().len(), joint.coordinates().len()),
            gradient: &gradient,
            hessian: &hessian,
            wrench: &wrench,
            weights,
        };
        out.fill(&self.sides(relative), charts, &inner);
    }

    /// Derivatives at a point with respect to the unknowns of `chart`; `joint` is this joint's kind, if it is known.
    pub(super) fn linearize_for<J: AnyJoint + ?Sized>(
        &self,
        joint: &J,
        configuration: &(Relative, JointCoordinates),
        point: &Point<'_>,
        chart: Chart<'_>,
        out: &mut Derivatives,
    ) {
        // The Hessian of the augmented term, w c ∂²c/∂q², is omitted: it vanishes at the solution, and far
        // from it, with w c much larger than the multipliers, it would spoil the correction.
        let mut mu = Equations::default();
        let own = self.first_multiplier..self.first_multiplier + self.equations();
        mu[..self.equations()].copy_from_slice(&point.multipliers[own]);
        let charts = match chart {
            Chart::Increments(tangents) => Some(self.frames.map(|frame| &tangents[frame.node])),
            Chart::Body | Chart::RelativeToDrift(..) => None,
        };
        let weights = std::array::from_fn(|k| point.augmentation.relative(joint.equation_quantity(k)));
        self.linearize_as(joint, configuration, &mu, &weights, charts, out);
    }

    /// Derivatives of the forces at constant multipliers `mu` with respect to the local unknowns, as body variations.
    pub(crate) fn force_derivatives(
        &self,
        configuration: &(Relative, JointCoordinates),
        mu: &Equations,
    ) -> SMatrix<f64, LOCAL, LOCAL> {
        let mut derivatives = Derivatives::new();
        self.linearize_as(self.joint(), configuration, mu, &[0.0; MAX_EQUATIONS], None, &mut derivatives);
        derivatives.sum(1.0, 0.0, 0.0);
        SMatrix::from_fn(|i, j| derivatives.column(j)[i])
    }

    /// Derivatives of the relative motion with respect to base and tip.
    fn sides(&self, relative: &Relative) -> [Side; 2] {
        let [base, tip] = self.frames.map(|frame| (frame.offset.rotation.matrix(), frame.offset.position));
        [
            Side::adjoint_inverse(
                -1.0,
                &(base.0 * relative.rotation),
                &(base.1 + base.0 * relative.position),
            ),
            Side::adjoint_inverse(1.0, &tip.0, &tip.1),
        ]
    }

    /// η as a linear map of the local unknowns.
    pub(super) fn variation(&self, relative: &Relative) -> SMatrix<f64, 6, LOCAL> {
        let mut variation = SMatrix::<f64, 6, LOCAL>::zeros();
        for (side, first) in self.sides(relative).iter().zip([0, TIP]) {
            variation.fixed_view_mut::<3, 3>(0, first).copy_from(&side.turning);
            variation.fixed_view_mut::<3, 3>(0, first + 3).copy_from(&side.shifting);
            variation.fixed_view_mut::<3, 3>(3, first + 3).copy_from(&side.turning);
        }
        variation
    }

    /// Accelerations of its coordinates that follow from those of its nodes, by the least squares of c̈ = 0. Schemes
    /// compute those of massless coordinates to a lower order than those of nodes.
    pub fn coordinate_accelerations(&self, at: &Kinematics) -> [f64; MAX_COORDINATES] {
        let configuration = self.evaluate_absolute(at);
        let rows = self.gradient_at(&configuration);
        let speeds = self.speeds(at);
        let mut accelerations = SVector::<f64, LOCAL>::zeros();
        for (frame, first) in self.frames.iter().zip([0, TIP]) {
            accelerations.fixed_rows_mut::<6>(first).copy_from(&at.nodes[frame.node].acceleration);
        }
        let known = rows * accelerations;
        let own = rows.fixed_columns::<MAX_COORDINATES>(OWN);
        let mut right = SVector::<f64, MAX_COORDINATES>::zeros();
        for equation in 0..self.equations() {
            let mut mu = Equations::default();
            mu[equation] = 1.0;
            let bias = speeds.dot(&(self.force_derivatives(&configuration, &mu) * speeds));
            right -= own.row(equation).transpose() * (known[equation] + bias);
        }
        let mut square = own.tr_mul(&own);
        for k in self.coordinates.len()..MAX_COORDINATES {
            square[(k, k)] = 1.0;
        }
        let inverse = square.try_inverse().unwrap_or_else(SMatrix::zeros);
        (inverse * right).into()
    }
}

/// The local unknowns as those of its ports: base, tip, coordinates.
pub(crate) fn ported(coordinates: usize) -> impl Iterator<Item = usize> + Clone {
    (0..6).chain(TIP..TIP + 6).chain(OWN..OWN + coordinates)
}

/// Within a step, joints are evaluated in lanes, several of a kind at a time (`blocks`); queries evaluate them one by
/// one.
impl Constraint for AttachedJoint {
    fn name(&self) -> &str {
        &self.name
    }

    fn first_multiplier(&self) -> usize {
        self.first_multiplier
    }

    fn equations(&self) -> usize {
        self.equations()
    }

    fn quantity(&self, equation: usize) -> Quantity {
        self.joint.equation_quantity(equation)
    }

    fn ports(&self) -> usize {
        2 + self.coordinates.len()
    }

    fn port(&self, _arrangement: usize, index: usize) -> Port {
        match self.frames.get(index) {
            Some(frame) => Port::Node(frame.node),
            None => Port::Coordinate(self.coordinates[index - 2]),
        }
    }

    fn violation(&self, at: &Kinematics, out: &mut [f64]) {
        let (relative, own) = self.evaluate_absolute(at);
        out.copy_from_slice(&self.joint.violation(&relative, &own)[..self.equations()]);
    }

    fn violation_change(&self, increments: &Increments<'_>, _time_elapsed: (f64, f64), out: &mut [f64]) {
        let (relative, own) = self.configuration(increments);
        out.copy_from_slice(&self.joint.violation_change(&relative, &own)[..self.equations()]);
    }

    fn gradient(&self, at: &Kinematics, out: &mut [f64]) {
        let local = self.gradient_at(&self.evaluate_absolute(at));
        let columns = ported(self.coordinates.len());
        let entries = (0..self.equations()).flat_map(|e| columns.clone().map(move |k| (e, k)));
        out.iter_mut().zip(entries).for_each(|(value, entry)| *value = local[entry]);
    }

    fn constraint_hessian(&self, at: &Kinematics, multipliers: &[f64], out: &mut [f64]) {
        let mut mu = Equations::default();
        mu[..multipliers.len()].copy_from_slice(multipliers);
        let local = self.force_derivatives(&self.evaluate_absolute(at), &mu);
        let columns = ported(self.coordinates.len());
        let entries = columns.clone().flat_map(|i| columns.clone().map(move |j| (i, j)));
        out.iter_mut().zip(entries).for_each(|(value, entry)| *value = local[entry]);
    }

    fn acceleration(&self, at: &Kinematics, out: &mut [f64]) {
        let configuration = self.evaluate_absolute(at);
        let speeds = self.speeds(at);
        for (equation, value) in out.iter_mut().enumerate() {
            let mut mu = Equations::default();
            mu[equation] = 1.0;
            // d/dt (B_eᵀ) = (∂(B_eᵀ)/∂q) v
            *value = speeds.dot(&(self.force_derivatives(&configuration, &mu) * speeds));
        }
    }
}

/// Motion of the second frame relative to the first.
fn motion_between(frames: [CarriedFrame; 2], at: &Kinematics) -> Motion {
    let [base, tip] = frames.map(|frame| at.nodes[frame.node].frame * frame.offset);
    tip.relative_to(&base)
}

/// Ad(G⁻¹)ᵀ w: the wrench moved from the tip's to the base's joint frame.
fn adjoint_inverse_transpose(relative: &Relative, wrench: &Vector6) -> Vector6 {
    let (force, moment) = split(wrench);
    let force = relative.rotation * force;
    let moment = relative.rotation * moment + relative.position.cross(&force);
    lissom_motion::screw(&force, &moment)
}
