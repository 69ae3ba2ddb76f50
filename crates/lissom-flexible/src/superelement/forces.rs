//! Forces of a superelement to first order in its deformation: elastic forces, inertia and weight.

use lissom_motion::Vector3;

use super::centre::Centre;
use super::element_scratch::ElementScratch;
use super::part::Part;
use super::vectors::{add, product, three};
use lissom_mechanics::kinematics::Kinematics;

impl Part {
    /// K u + D u̇ + f₀.
    pub(super) fn stress(&self, scratch: &mut ElementScratch) {
        scratch.stress.copy_from_slice(self.preload.as_slice());
        product(&self.stiffness, &scratch.displacement, &mut scratch.stress);
        if let Some(damping) = &self.damping {
            product(damping, &scratch.rate, &mut scratch.stress);
        }
    }

    /// Adds forces that are conjugate to u: by the transposed gradient of u.
    pub(super) fn add_conjugate(&self, scratch: &ElementScratch, stress: &[f64], out: &mut [f64]) {
        let (mut force, mut moment) = (Vector3::zeros(), Vector3::zeros());
        for i in (0..self.nodes.len()).filter(|&i| i != self.frame) {
            let (f, m) = (three(stress, 6 * i), three(stress, 6 * i + 3));
            let own = scratch.inverse_tangents[i].tr_mul(&m);
            add(out, 6 * i, &scratch.turns[i].tr_mul(&f));
            add(out, 6 * i + 3, &own);
            force -= f;
            moment -= scratch.arms[i].cross(&f) + scratch.turns[i] * own;
        }
        add(out, 6 * self.frame, &force);
        add(out, 6 * self.frame + 3, &moment);
        for k in 6 * self.nodes.len()..self.size() {
            out[k] += stress[k];
        }
    }

    /// Adds the terms of inertia and weight other than the forces conjugate to u.
    pub(super) fn add_inertia(
        &self,
        at: &Kinematics,
        scratch: &mut ElementScratch,
        centre: &mut Centre,
        out: &mut [f64],
    ) {
        centre.enter(self, at);
        self.momenta(scratch);
        let mut on_frame = Vector3::zeros();
        for i in 0..self.nodes.len() {
            let (p, l) = (three(&scratch.momentum, 6 * i), three(&scratch.momentum, 6 * i + 3));
            let (v, w) = (three(&scratch.velocity, 6 * i), three(&scratch.velocity, 6 * i + 3));
            let [force, moment] = scratch.inertial(i);
            add(out, 6 * i, &scratch.turns[i].tr_mul(&force));
            add(out, 6 * i + 3, &scratch.turns[i].tr_mul(&moment));
            on_frame += v.cross(&p) + w.cross(&l);
        }
        add(out, 6 * self.frame + 3, &on_frame);
        for k in 6 * self.nodes.len()..self.size() {
            out[k] += scratch.inertia[k];
        }
        centre.add_forces(self.total, out);
    }

    /// Momentum, and the inertial forces before their rotation.
    pub(super) fn momenta(&self, scratch: &mut ElementScratch) {
        scratch.momentum.fill(0.0);
        scratch.inertia.fill(0.0);
        product(&self.mass, &scratch.velocity, &mut scratch.momentum);
        product(&self.mass, &scratch.acceleration, &mut scratch.inertia);
    }
}
