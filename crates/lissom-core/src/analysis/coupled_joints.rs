//! Integrated violations in the tangent of both stages: with ċ_j = B_j V_j and the share σ_j of what is missed,
//!
//! ```text
//! ∂c_i/∂D_k = Σ_j d_ij [N_jk + σ_j (∂c_end/∂D_k - Σ_l D_l N_lk)],   N_jk = B_j ∂V_j/∂D_k + V_jᵀ ∂B_jᵀ/∂h ∂h_j/∂D_k
//! ```
//!
//! The share itself is taken as constant.

use nalgebra::{SMatrix, SVector};

use super::coupled::{Coupled, STAGES};
use crate::joints::attached::{AttachedJoint, Increments, LocalGradient};
use crate::joints::coupling::{Coupling, MOST_COUPLED};
use crate::joints::derivatives::{LOCAL, OWN, TIP};
use crate::joints::passage::Visit;
use crate::joints::{Equations, MOST_EQUATIONS};
use crate::scaling::Scaled;
use crate::schemes::Tableau;
use crate::system::places::Run;
use crate::system::{Course, System};

/// One number per coordinate of a coupling.
type Gradient = SVector<f64, MOST_COUPLED>;

impl Coupled {
    /// Adds the rows and columns of all constraints.
    pub(super) fn add_constraints(
        &mut self,
        system: &System,
        course: &Course<'_>,
        tableau: &Tableau,
        scaled: &Scaled,
    ) {
        for (index, joint) in system.joints().iter().enumerate() {
            let mut before = Equations::default();
            let own = joint.first_multiplier..joint.first_multiplier + joint.equations();
            before[..joint.equations()].copy_from_slice(&course.violations[own]);
            let visits = joint.visits(&course.passage, &course.increments, &before);
            let derivatives = self.violation_derivatives(joint, course, &visits, tableau);
            self.add_joint(joint, system.joint_places.of(index), course, &visits, &derivatives, scaled);
        }
        for drive in system.drives() {
            let positions = drive.positions;
            let row = system.layout().coordinate_count() + drive.multiplier;
            let weight = course.augmentation.relative(system.layout().quantities()[row]);
            for stage in 0..STAGES {
                self.add(positions[0], stage, stage, scaled.augmented_factor() * weight);
                self.add(positions[1], stage, stage, scaled.scale());
                self.add(positions[2], stage, stage, scaled.scale());
            }
        }
        for coupling in system.couplings() {
            self.add_coupling(system, coupling, (course, tableau), scaled);
        }
    }

    /// As for joints: see the formula above.
    fn add_coupling(
        &mut self,
        system: &System,
        coupling: &Coupling,
        (course, tableau): (&Course<'_>, &Tableau),
        scaled: &Scaled,
    ) {
        let (passage, count) = (&course.passage, coupling.count());
        let visits = system.coupling_visits(coupling, course);
        let row = system.layout().coordinate_count() + coupling.multiplier;
        let weight =
            scaled.augmented_factor() * course.augmentation.relative(system.layout().quantities()[row]);
        let transports = self.transports.last().expect("one for coordinates");
        let shares: [[f64; STAGES]; STAGES] =
            transports.each_ref().map(|own| own.rate.map(|rate| rate[(0, 0)]));
        // N_jk.
        let rates: [[Gradient; STAGES]; STAGES] = std::array::from_fn(|j| {
            let at = passage.stages[j];
            let gradient = Gradient::from(coupling.gradient(at));
            let bending = Gradient::from(coupling.second(at, (1.0, &coupling.rates(at))));
            std::array::from_fn(|k| {
                let own = if j == k { bending } else { Gradient::zeros() };
                gradient * shares[j][k] + own
            })
        });
        let end = Gradient::from(coupling.gradient(passage.end));
        for stage in 0..STAGES {
            let [first, second] = passage.durations[stage];
            let share = first * visits[0].share + second * visits[1].share;
            for other in 0..STAGES {
                let by_rates = [rates[0][other], rates[1][other]];
                let missed = end * tableau.reached[other] - passage.whole(by_rates);
                let derivative = by_rates[0] * first + by_rates[1] * second + missed * share;
                let rows = &visits[stage].rows;
                for (entry, &position) in coupling.positions.iter().enumerate() {
                    let (i, j) = (entry % (count + 1), entry / (count + 1));
                    let value = match (i < count, j < count) {
                        (true, true) => weight * rows[i] * derivative[j],
                        (false, true) => scaled.scale() * derivative[j],
                        (true, false) if other == stage => scaled.scale() * rows[i],
                        _ => continue,
                    };
                    self.add(position, stage, other, value);
                }
            }
        }
    }

    /// Columns of both frames and of the own coordinates times what `part` takes of the nodes' transports.
    fn through(
        &self,
        joint: &AttachedJoint,
        rows: &LocalGradient,
        part: impl Fn(&super::coupled::Transport) -> lissom_motion::Matrix6,
        stage: usize,
    ) -> LocalGradient {
        let mut result = LocalGradient::zeros();
        for (frame, first) in joint.frames.iter().zip([0, TIP]) {
            let columns = rows.fixed_columns::<6>(first) * part(&self.transports[frame.node][stage]);
            result.fixed_columns_mut::<6>(first).copy_from(&columns);
        }
        let plain = part(&self.transports[self.transports.len() - 1][stage])[(0, 0)];
        for k in OWN..LOCAL {
            result.set_column(k, &(plain * rows.column(k)));
        }
        result
    }

    /// ∂c_i/∂D_k.
    fn violation_derivatives(
        &self,
        joint: &AttachedJoint,
        course: &Course<'_>,
        visits: &[Visit; STAGES],
        tableau: &Tableau,
    ) -> [[LocalGradient; STAGES]; STAGES] {
        let passage = &course.passage;
        let rates: [[LocalGradient; STAGES]; STAGES] = std::array::from_fn(|j| {
            let bending = bending(joint, &course.increments[j], passage.stages[j]);
            std::array::from_fn(|k| {
                let mut rate = self.through(joint, &visits[j].plain, |node| node.rate[k], j);
                if j == k {
                    rate += self.through(joint, &bending, |node| node.place, j);
                }
                rate
            })
        });
        let end = joint.gradient_at(&joint.configuration(&course.increments[STAGES]));
        let at_end = self.through(joint, &end, |node| node.place, STAGES - 1);
        std::array::from_fn(|i| {
            let durations = passage.durations[i];
            let share = durations[0] * visits[0].share + durations[1] * visits[1].share;
            std::array::from_fn(|k| {
                let by_rates = [rates[0][k], rates[1][k]];
                let missed = tableau.reached[k] * at_end - passage.whole(by_rates);
                by_rates[0] * durations[0] + by_rates[1] * durations[1] + share * missed
            })
        })
    }

    fn add_joint(
        &mut self,
        joint: &AttachedJoint,
        runs: &[Run],
        course: &Course<'_>,
        visits: &[Visit; STAGES],
        derivatives: &[[LocalGradient; STAGES]; STAGES],
        scaled: &Scaled,
    ) {
        for stage in 0..STAGES {
            let rows = &visits[stage].rows;
            let mut weighted = *rows;
            for k in 0..joint.equations() {
                let relative = course.augmentation.relative(joint.joint().equation_quantity(k));
                weighted.row_mut(k).scale_mut(scaled.augmented_factor() * relative);
            }
            for (other, derivative) in derivatives[stage].iter().enumerate() {
                let augmented: SMatrix<f64, LOCAL, LOCAL> = weighted.tr_mul(derivative);
                for (position, i, j) in runs.iter().flat_map(|run| run.entries()) {
                    let value = match (i.checked_sub(LOCAL), j.checked_sub(LOCAL)) {
                        (None, None) => augmented[(i, j)],
                        (Some(equation), _) => scaled.scale() * derivative[(equation, j)],
                        (None, Some(equation)) if other == stage => scaled.scale() * rows[(equation, i)],
                        (None, Some(_)) => continue,
                    };
                    self.add(position, stage, other, value);
                }
            }
        }
    }

    fn add(&mut self, position: usize, stage: usize, other: usize, value: f64) {
        self.values[self.places[position][stage][other]] += value;
    }
}

/// Vᵀ ∂Bᵀ/∂h: how the rates of the violations change with the place at constant velocities.
fn bending(
    joint: &AttachedJoint,
    increments: &Increments<'_>,
    at: &crate::system::Kinematics,
) -> LocalGradient {
    let configuration = joint.configuration(increments);
    let speeds = joint.speeds(at);
    let mut rows = LocalGradient::zeros();
    for equation in 0..joint.equations().min(MOST_EQUATIONS) {
        let mut mu = Equations::default();
        mu[equation] = 1.0;
        let curvature = joint.curvature(&configuration, &mu);
        rows.set_row(equation, &curvature.tr_mul(&speeds).transpose());
    }
    rows
}
