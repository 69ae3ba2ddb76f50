//! Momentum and angular momentum of the whole model.

use std::sync::Arc;

use lissom_mechanics::kinematics::{CarriedFrame, LOCKED};
use lissom_motion::{Rotation, Vector3};
use lissom_system::OutputDerivatives;

use super::derivatives::{add, add_scaled, of_slopes};
use super::frames::carried_frame;
use super::{Build, Evaluation, OutputQuantity, WHOLE_MODEL};
use crate::outputs::kinds::{Declaration, Feature, Subject};

/// Registry entry.
pub(crate) const MOMENTUM: Declaration = Declaration {
    word: "momentum",
    summary: "Momentum and angular momentum of the model about the origin, global axes.",
    subject: Subject::Model,
    features: &[Feature::Axes, Feature::Velocities],
    components: &[
        ("p1", "N s"),
        ("p2", "N s"),
        ("p3", "N s"),
        ("l1", "N m s"),
        ("l2", "N m s"),
        ("l3", "N m s"),
    ],
    build: Build::System(WHOLE_MODEL, |output, _, subjects| {
        let axes = output.seen_in.as_ref().map(|axes| carried_frame(axes, subjects.names)).transpose()?;
        Ok(Arc::new(Momentum(axes)))
    }),
};
/// In global axes, or in those of a frame.
struct Momentum(Option<CarriedFrame>);

impl OutputQuantity for Momentum {
    fn append_values(&self, at: &Evaluation<'_>, out: &mut Vec<f64>) {
        let (linear, angular) = at.system.momentum(at.motion());
        let axes = self.0.map_or(Rotation::IDENTITY, |axes| axes.frame(at.motion()).rotation);
        for vector in [linear, angular] {
            out.extend_from_slice(axes.apply_inverse(&vector).as_slice());
        }
    }

    /// δ(Rᵀ p) = Rᵀ δp - θ × Rᵀ p.
    fn derivatives(&self, at: &Evaluation<'_>, _: f64) -> Option<Vec<OutputDerivatives>> {
        let global = at.system.momentum_slopes(at.motion()).each_ref().map(of_slopes);
        let Some(axes) = self.0 else { return Some(global.to_vec()) };
        let mut values = Vec::new();
        self.append_values(at, &mut values);
        let matrix = axes.frame(at.motion()).rotation.matrix();
        let mut all = vec![OutputDerivatives::default(); values.len()];
        for (index, output) in all.iter_mut().enumerate() {
            let (first, own) = (index / 3 * 3, index % 3);
            (0..3).for_each(|k| add_scaled(output, &global[first + k], matrix[(k, own)]));
            let vector = Vector3::from_column_slice(&values[first..first + 3]);
            for (k, &row) in at.system.layout().rows_of_node(axes.node)[3..].iter().enumerate() {
                let turn = axes.offset.rotation.apply_inverse(&Vector3::ith(k, 1.0));
                if row != LOCKED {
                    add(&mut output.by_place, row as usize, -turn.cross(&vector)[own]);
                }
            }
        }
        Some(all)
    }
}
