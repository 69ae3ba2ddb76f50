//! Reactions of joints between nodes, with their derivatives: the forces of the constraint, and those that prevent a wheel from
//! sliding or oppose its creep.

use lissom_motion::{Vector3, Vector6, screw};
use nalgebra::SVector;

use super::creep_force::{CreepForce, contact_derivatives};
use super::rolling::RollingCreep;
use super::{Element, Tangents};
use crate::joints::Constraint;
use crate::joints::attached::{AttachedJoint, ported};
use crate::joints::derivatives::TIP;
use crate::joints::no_slip::NoSlip;
use crate::joints::{Equations, Gradient, MAX_EQUATIONS};
use crate::kinematics::local_derivatives::LocalDerivatives;
use crate::kinematics::{CarriedFrame, Kinematics, split};
use crate::wheels::wheel_on_plane::DIRECTIONS;
use crate::wheels::wheel_on_rail::{Pose, RailContactValues};

impl AttachedJoint {
    /// Position and forces of the contact between a wheel and its rail, for the multipliers `mu`; none for other
    /// joints.
    pub fn rail_contact(&self, at: &Kinematics, mu: &Equations) -> Option<RailContactValues> {
        let contact = self.joint.rail_contact()?;
        let (relative, _) = self.evaluate_absolute(at);
        let pose = Pose::new(&relative.rotation, &relative.position);
        let place = contact.place(&pose).place;
        let mut values = RailContactValues {
            on_wheel: place.along,
            on_rail: place.on_rail,
            shift_angle: contact.shift_angle(&pose, place.along),
            normal_force: -mu[0],
            ..RailContactValues::default()
        };
        if let Some(creep) = self.creep_force() {
            let creep = creep.creep(at, -mu[0]);
            (values.forces, values.creepages) = (creep.forces, creep.creepages);
        }
        Some(values)
    }

    /// Derivatives of the nine numbers of [`rail_contact`](Self::rail_contact), in the order of its fields.
    pub fn rail_contact_derivatives(&self, at: &Kinematics, mu: &Equations) -> Option<LocalDerivatives<9>> {
        let contact = self.joint.rail_contact()?;
        let mut found = contact_derivatives(self.frames, (contact, self.joint.creep()), at, -mu[0]);
        found.by_multiplier.resize(self.equations(), SVector::zeros());
        Some(found)
    }

    /// The creep force of a wheel on a rail, if it has one.
    pub fn creep_force(&self) -> Option<CreepForce> {
        let (contact, law) = self.joint.rail_contact().zip(self.joint.creep())?;
        Some(CreepForce::new(self.frames, self.first_multiplier, contact.clone(), law.clone()))
    }

    /// Wrench that prevents a wheel from sliding or opposes its creep, on the tip's joint frame [N, N m].
    pub fn force_of_plane(&self, at: &Kinematics, mu: &Equations) -> Vector6 {
        match self.no_slip() {
            Some(no_slip) => no_slip.wrench(at, &mu[self.equations()..]),
            None => self.plane_creep().map_or_else(Vector6::zeros, |creep| creep.wrench(at)),
        }
    }

    fn no_slip(&self) -> Option<NoSlip> {
        let contact = self.joint.contact().filter(|_| self.rolls())?;
        let first = self.first_multiplier + self.equations();
        Some(NoSlip::new(self.name.clone(), self.frames, contact, first))
    }

    fn plane_creep(&self) -> Option<RollingCreep> {
        let contact = self.joint.contact().filter(|_| !self.rolls())?;
        Some(RollingCreep::new(self.frames, contact))
    }

    /// Wrench of the joint on the tip at the joint's point, in inertial axes [N, N m], for the
    /// multipliers `mu` at the configuration `at`: those of its equations, then those that prevent sliding.
    pub fn reaction(&self, at: &Kinematics, mu: &Equations) -> Vector6 {
        let (relative, own) = self.evaluate_absolute(at);
        let mut gradient = Gradient::zeros();
        self.joint.gradient(&relative, &own, &mut gradient);
        let mut wrench = -gradient.relative.tr_mul(&SVector::<f64, MAX_EQUATIONS>::from_column_slice(mu));
        wrench += self.force_of_plane(at, mu);
        if let Some(creep) = self.creep_force() {
            wrench += creep.wrench(at, -mu[0]);
        }
        let tip = self.frames[1];
        let rotation = at.nodes[tip.node].frame.rotation * tip.offset.rotation;
        let (force, moment) = split(&wrench);
        screw(&rotation.apply(&force), &rotation.apply(&moment))
    }

    /// Derivatives of [`reaction`](Self::reaction), in inertial axes or in those of a frame.
    ///
    /// ```text
    /// reaction a = -ρ w,   ρ = R_axesᵀ R_tip,   δa = -ρ (δw + θ_tip × w) - θ_axes × a
    /// ```
    ///
    /// w is the wrench on the tip's joint frame on the left-hand side, and δw follows from the tangents of all forces on the tip.
    pub fn reaction_derivatives(
        &self,
        at: &Kinematics,
        mu: &Equations,
        axes: Option<CarriedFrame>,
    ) -> LocalDerivatives<6> {
        let [base, tip] = self.frames;
        let nodes: Vec<_> = [base, tip].into_iter().chain(axes).map(|frame| frame.node).collect();
        let first = 6 * nodes.len();
        let mut out = LocalDerivatives::zero(nodes, self.coordinates.clone(), self.reacting().len());
        // On the tip, in the axes of its node.
        let configuration = self.evaluate_absolute(at);
        let forces = self.force_derivatives(&configuration, mu);
        let slots = (0..12).chain(first..);
        for (column, slot) in ported(self.coordinates.len()).zip(slots) {
            out.by_place[slot] += Vector6::from_fn(|i, _| forces[(TIP + i, column)]);
        }
        let gradient = self.gradient_at(&configuration);
        for (equation, column) in out.by_multiplier.iter_mut().take(self.equations()).enumerate() {
            *column += Vector6::from_fn(|i, _| gradient[(equation, TIP + i)]);
        }
        if let Some(no_slip) = self.no_slip() {
            let mut stiffness = [0.0; 12 * 12];
            no_slip.constraint_hessian(at, &mu[self.equations()..], &mut stiffness);
            for column in 0..12 {
                out.by_place[column] += Vector6::from_fn(|i, _| stiffness[(6 + i) * 12 + column]);
            }
            let mut rows = [0.0; DIRECTIONS * 12];
            no_slip.gradient(at, &mut rows);
            for (column, row) in out.by_multiplier[self.equations()..].iter_mut().zip(rows.chunks_exact(12)) {
                *column += Vector6::from_column_slice(&row[6..]);
            }
        }
        if let Some(creep) = self.plane_creep() {
            let mut tangents = Tangents::new(12);
            creep.linearize(at, &mut tangents);
            for column in 0..12 {
                out.by_place[column] += Vector6::from_fn(|i, _| tangents.stiffness[(6 + i) * 12 + column]);
                out.by_rate[column] += Vector6::from_fn(|i, _| tangents.damping[(6 + i) * 12 + column]);
            }
        }
        if let Some(creep) = self.creep_force() {
            let mut tangents = Tangents::new(13);
            creep.linearize_pressed(at, -mu[0], &mut tangents);
            for column in 0..12 {
                out.by_place[column] += Vector6::from_fn(|i, _| tangents.stiffness[(6 + i) * 13 + column]);
                out.by_rate[column] += Vector6::from_fn(|i, _| tangents.damping[(6 + i) * 13 + column]);
            }
            out.by_multiplier[0] += Vector6::from_fn(|i, _| tangents.stiffness[(6 + i) * 13 + 12]);
        }
        let to_tip = tip.offset.inverse();
        let rotation = tip.frame(at).rotation;
        let (force, moment) = split(&self.reaction(at, mu));
        let [force, moment] = [force, moment].map(|part| rotation.apply_inverse(&part));
        let from_tip = axes.map_or(rotation, |axes| axes.frame(at).rotation.inverse() * rotation);
        let turned = |vector: &Vector6| {
            let (force, moment) = split(vector);
            screw(&from_tip.apply(&force), &from_tip.apply(&moment))
        };
        out.each(|column| *column = turned(&-to_tip.adjoint_inverse_transpose_times(column)));
        let reaction = split(&turned(&screw(&force, &moment)));
        for k in 0..3 {
            let along = tip.offset.rotation.apply_inverse(&Vector3::ith(k, 1.0));
            out.by_place[9 + k] += turned(&screw(&along.cross(&force), &along.cross(&moment)));
            if let Some(axes) = axes {
                let along = axes.offset.rotation.apply_inverse(&Vector3::ith(k, 1.0));
                out.by_place[15 + k] -= screw(&along.cross(&reaction.0), &along.cross(&reaction.1));
            }
        }
        out
    }
}
