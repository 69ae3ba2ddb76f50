//! Sliders along beams in the equations of the whole system: forces, violations and derivatives.

use lissom_motion::Vector6;

use super::receiver::Receiver;
use super::{StepPoint, System};
use crate::joints::evaluation_point::{Augmentation, Chart, Point};
use crate::joints::slider::{LOCAL, MOST_EQUATIONS, OWN, Row, Slider};
use crate::kinematics::step_stages::STAGES;
use crate::kinematics::{Kinematics, LOCKED, Layout};

impl System {
    /// All sliders along beams.
    pub fn sliders(&self) -> &[Slider] {
        &self.sliders
    }

    /// Adds forces and violations of all sliders to a residual.
    pub(super) fn add_sliders(&self, point: &Point<'_>, out: &mut [f64]) {
        for slider in &self.sliders {
            let violation = violation(slider, point);
            let mu = multipliers(slider, point.multipliers) + weighted(&point.augmentation, &violation);
            let place = slider.place(point.at);
            let gradient = slider.gradient(&place, point.at);
            self.add_slider_forces(slider, (place.interval, &gradient), &mu, out);
            self.set_slider_violation(slider, &violation, out);
        }
    }

    fn set_slider_violation(&self, slider: &Slider, violation: &Vector6, out: &mut [f64]) {
        let first = self.layout.coordinate_count() + slider.first_multiplier;
        let count = slider.equations();
        out[first..first + count].copy_from_slice(&violation.as_slice()[..count]);
    }

    fn add_slider_forces(
        &self,
        slider: &Slider,
        (interval, gradient): (usize, &[Row; MOST_EQUATIONS]),
        mu: &Vector6,
        out: &mut [f64],
    ) {
        for (local, row) in rows_of_slider(slider, interval, &self.layout) {
            if local < LOCAL {
                out[row] += (0..slider.equations()).map(|e| gradient[e][local] * mu[e]).sum::<f64>();
            }
        }
    }

    /// Violations of all sliders at `point`, by multiplier.
    pub(super) fn slider_violations(&self, point: &Point<'_>, out: &mut [f64]) {
        for slider in &self.sliders {
            let (first, count) = (slider.first_multiplier, slider.equations());
            out[first..first + count].copy_from_slice(&violation(slider, point).as_slice()[..count]);
        }
    }

    /// Hands the derivatives of all sliders to `out`.
    pub(super) fn linearize_sliders(&self, point: &Point<'_>, chart: Chart<'_>, out: &mut Receiver<'_>) {
        let weights: [f64; MOST_EQUATIONS] =
            std::array::from_fn(|e| point.augmentation.relative(Slider::quantity(e)));
        for slider in &self.sliders {
            let place = slider.place(point.at);
            let plain = slider.gradient(&place, point.at);
            let mu = multipliers(slider, point.multipliers);
            let mut stiffness = slider.curvature(&place, point.at, &mu);
            let mut charted = plain;
            if let Chart::Increments(tangents) = chart {
                for (k, node) in slider.nodes_of(place.interval).into_iter().enumerate() {
                    let Some(node) = node else { continue };
                    for row in stiffness.iter_mut().chain(&mut charted) {
                        tangents[node].through(&mut row[6 * k..6 * k + 6]);
                    }
                }
            }
            for &(i, j, position) in &slider.entries[place.interval] {
                let parts = match (i.checked_sub(LOCAL), j.checked_sub(LOCAL)) {
                    (None, None) => {
                        let gram =
                            (0..slider.equations()).map(|e| weights[e] * plain[e][i] * charted[e][j]).sum();
                        [stiffness[i][j], gram, 0.0]
                    }
                    (None, Some(e)) => [0.0, 0.0, plain[e][i]],
                    (Some(e), None) => [0.0, 0.0, charted[e][j]],
                    (Some(_), Some(_)) => continue,
                };
                out.add_constraint_entry(position, parts);
            }
        }
    }

    /// Adds forces and violations of sliders to the residuals at the stages of `point`. Their rates at the stages are such
    /// that no violation is left at the end; forces are those of the gradients there, so that the work that a slider does is
    /// of the order of the scheme, and not zero as that of joints.
    pub(super) fn add_slider_stages(&self, point: &StepPoint<'_>, out: &mut [Vec<f64>]) {
        let step = &point.step;
        for slider in &self.sliders {
            let places = step.stages.map(|at| slider.place(at));
            let gradients = [0, 1].map(|j| slider.gradient(&places[j], step.stages[j]));
            let rates: [Vector6; STAGES] = [0, 1].map(|j: usize| {
                let speeds = slider.speeds(&places[j], step.stages[j]);
                Vector6::from_fn(|e, _| (0..LOCAL).map(|k| gradients[j][e][k] * speeds[k]).sum())
            });
            let missed = slider.violation_change(&point.increments[STAGES]) - step.whole(rates);
            let whole: f64 = step.lasting.iter().sum();
            let before = multipliers(slider, point.violations);
            let behind = (missed + before) / whole;
            let violations = step.at_stages(Vector6::zeros(), rates.map(|rate| rate + behind));
            for j in 0..STAGES {
                let added = weighted(&point.augmentation, &violations[j]);
                let mu = multipliers(slider, point.multipliers[j]) + added;
                self.add_slider_forces(slider, (places[j].interval, &gradients[j]), &mu, &mut out[j]);
                self.set_slider_violation(slider, &violations[j], &mut out[j]);
            }
        }
    }

    /// Adds the forces of a slider for its multipliers, and sets its violation, evaluated outright.
    pub(super) fn add_slider_outright(&self, index: usize, at: &Kinematics, forces: &[f64], out: &mut [f64]) {
        let slider = &self.sliders[index];
        let place = slider.place(at);
        let gradient = slider.gradient(&place, at);
        self.add_slider_forces(slider, (place.interval, &gradient), &multipliers(slider, forces), out);
        self.set_slider_violation(slider, &slider.violation(at), out);
    }
}

/// Local place and row of the unknowns of a slider in an interval, and of its multipliers, that are there.
pub(crate) fn rows_of_slider(slider: &Slider, interval: usize, layout: &Layout) -> Vec<(usize, usize)> {
    let mut rows = Vec::with_capacity(LOCAL + slider.equations());
    for (k, node) in slider.nodes_of(interval).into_iter().enumerate() {
        let Some(node) = node else { continue };
        let own = layout.rows_of_node(node).iter().enumerate().filter(|&(_, &row)| row != LOCKED);
        rows.extend(own.map(|(i, &row)| (6 * k + i, row as usize)));
    }
    rows.push((OWN, layout.row_of_coordinate(slider.coordinate)));
    let first = layout.coordinate_count() + slider.first_multiplier;
    rows.extend((0..slider.equations()).map(|e| (LOCAL + e, first + e)));
    rows
}

/// A slider's own of numbers by multiplier; those that it does not have are zero.
fn multipliers(slider: &Slider, all: &[f64]) -> Vector6 {
    let own = &all[slider.first_multiplier..][..slider.equations()];
    Vector6::from_fn(|e, _| own.get(e).copied().unwrap_or(0.0))
}

/// What the augmented Lagrangian term adds to multipliers.
fn weighted(augmentation: &Augmentation, violation: &Vector6) -> Vector6 {
    Vector6::from_fn(|e, _| augmentation.weight * augmentation.relative(Slider::quantity(e)) * violation[e])
}

fn violation(slider: &Slider, point: &Point<'_>) -> Vector6 {
    multipliers(slider, point.violations) + slider.violation_change(&point.increments)
}
