//! A solid element's forces at the stages of a step of the energy-decaying scheme. See `kinematics::step_stages` for the formulas; σ_j
//! are the velocities of the nodes without those of the rigid motion that is nearest, so that corrections along them change neither
//! momentum nor angular momentum.
//!
//! St. Venant-Kirchhoff integrates strains from their rates. Other laws correct the forces so that their work is the change of the
//! energy, as the discrete gradient does [Gonzalez 1996].

use lissom_motion::{Matrix3, Vector3};

use super::{Deformed, Solid};
use lissom_mechanics::elements::Element;
use lissom_mechanics::kinematics::Kinematics;
use lissom_mechanics::kinematics::step_stages::{STAGES, StepStages, above_round_off};
use lissom_mechanics::round_off;

/// Velocities at a stage.
struct Velocities<const NODES: usize> {
    /// Velocities of the nodes.
    all: [Vector3; NODES],
    /// σ.
    relative: [Vector3; NODES],
    /// σ·σ.
    square: f64,
    /// Largest velocity relative to the mean.
    largest: f64,
}

impl<const NODES: usize, const POINTS: usize> Solid<NODES, POINTS> {
    pub(super) fn add_forces_of_strains(&self, step: &StepStages<'_>, out: &mut [&mut [f64]; STAGES]) {
        let stages = step.stages.map(|at| (self.velocities(at), self.deformed(at)));
        let [start, end] = [step.start, step.end].map(|at| self.deformed(at));
        let shift = |i: usize| {
            let node = self.nodes[i];
            step.start.nodes[node].frame.rotation.apply(&step.changes[node].shift)
        };
        let first = shift(0);
        let shifts: [Vector3; NODES] = std::array::from_fn(|i| shift(i) - first);
        let mut rates = stages.each_ref().map(|(velocities, deformed)| self.rates(&velocities.all, deformed));
        let mut missed: [Matrix3; POINTS] = std::array::from_fn(|p| {
            let middle = 0.5 * (start.points[p].gradient + end.points[p].gradient);
            strain_change(&middle, &gradient(&shifts, &self.reference.gradients[p]))
                - step.whole([rates[0][p], rates[1][p]])
        });
        let (inverse, shares) = step.shares([0, 1].map(|j| stages[j].0.square));
        let way = (0..STAGES).map(|j| step.lasting[j].abs() * stages[j].0.largest).fold(0.0, f64::max);
        let round_off = round_off::RIGID_MOTION * way / self.size();
        let largest = missed.iter().map(Matrix3::norm).fold(0.0, f64::max);
        let weight = above_round_off(largest, round_off);
        for missed in &mut missed {
            *missed *= weight;
        }
        for (rates, share) in rates.iter_mut().zip(shares) {
            rates.iter_mut().zip(&missed).for_each(|(rate, missed)| *rate += share * missed);
        }
        for (j, out) in out.iter_mut().enumerate() {
            let (velocities, deformed) = &stages[j];
            let stresses: [Matrix3; POINTS] = std::array::from_fn(|p| {
                let strain = step.at_stages(start.points[p].strain(), [rates[0][p], rates[1][p]])[j];
                self.law.second_stress(&strain)
            });
            let points = deformed.points.iter().zip(&stresses);
            self.add_forces(points.map(|(point, stress)| point.gradient * stress), out);
            let work: f64 =
                (0..POINTS).map(|p| self.reference.volumes[p] * stresses[p].dot(&missed[p])).sum();
            add_along(&velocities.relative, work * inverse, out);
        }
    }

    pub(super) fn add_forces_of_energy(&self, step: &StepStages<'_>, out: &mut [&mut [f64]; STAGES]) {
        let velocities = step.stages.map(|at| self.velocities(at));
        let energies = [step.start, step.end].map(|at| self.energy(at).strain);
        let mut powers = [0.0; STAGES];
        for j in 0..STAGES {
            self.forces(step.stages[j], out[j]);
            let forces = out[j].chunks_exact(6);
            powers[j] =
                forces.zip(&velocities[j].all).map(|(f, v)| f[0] * v.x + f[1] * v.y + f[2] * v.z).sum();
        }
        let missed = energies[1] - energies[0] - step.whole(powers);
        // Energies are differences of terms of the size of the shear modulus.
        let round_off = 16.0 * f64::EPSILON * self.law.shear * self.reference.volume;
        let missed = missed * above_round_off(missed.abs(), round_off);
        let (inverse, _) = step.shares(velocities.each_ref().map(|own| own.square));
        for (own, out) in velocities.iter().zip(out) {
            add_along(&own.relative, missed * inverse, out);
        }
    }

    fn velocities(&self, at: &Kinematics) -> Velocities<NODES> {
        let mean = |of: &[Vector3; NODES]| of.iter().sum::<Vector3>() / NODES as f64;
        let all = self.velocities_at_nodes(at);
        let positions = self.nodes.map(|node| at.nodes[node].frame.position);
        let (centre, drift) = (mean(&positions), mean(&all));
        let arms = positions.map(|position| position - centre);
        let mut relative = all.map(|velocity| velocity - drift);
        let largest = relative.iter().map(Vector3::norm).fold(0.0, f64::max);
        let turning: Vector3 = arms.iter().zip(&relative).map(|(arm, own)| arm.cross(own)).sum();
        let inertia: Matrix3 = arms
            .iter()
            .map(|arm| Matrix3::from_diagonal_element(arm.norm_squared()) - arm * arm.transpose())
            .sum();
        let spin = inertia.try_inverse().map_or_else(Vector3::zeros, |inverse| inverse * turning);
        relative.iter_mut().zip(&arms).for_each(|(own, arm)| *own -= spin.cross(arm));
        let square = relative.iter().map(Vector3::norm_squared).sum();
        Velocities { all, relative, square, largest }
    }

    /// Rates of the strains at all points.
    fn rates(&self, velocities: &[Vector3; NODES], deformed: &Deformed<POINTS>) -> [Matrix3; POINTS] {
        std::array::from_fn(|p| {
            let rate = gradient(velocities, &self.reference.gradients[p]);
            strain_change(&deformed.points[p].gradient, &rate)
        })
    }

    /// A length of the element [m].
    fn size(&self) -> f64 {
        self.reference.volume.cbrt()
    }
}

fn gradient<const NODES: usize>(values: &[Vector3; NODES], slopes: &[Vector3; NODES]) -> Matrix3 {
    // Relative to the first value: a common one has no gradient.
    values.iter().zip(slopes).map(|(value, slope)| (value - values[0]) * slope.transpose()).sum()
}

/// sym Fᵀ δF.
pub(super) fn strain_change(gradient: &Matrix3, change: &Matrix3) -> Matrix3 {
    let product = gradient.tr_mul(change);
    0.5 * (product + product.transpose())
}

fn add_along(directions: &[Vector3], factor: f64, out: &mut [f64]) {
    for (direction, out) in directions.iter().zip(out.chunks_exact_mut(6)) {
        out.iter_mut().zip(&(factor * direction)).for_each(|(sum, value)| *sum += value);
    }
}
