//! Momentum and angular momentum of the whole model.

use std::sync::Arc;

use lissom_core::kinematics::CarriedFrame;
use lissom_motion::Rotation;

use super::frames::carried_frame;
use super::{Build, Evaluation, OutputQuantity, WITHOUT_GRADIENT};
use crate::document::{Declaration, Feature, Subject};

/// Registry entry.
pub(crate) const MOMENTUM: Declaration = Declaration {
    word: "momentum",
    summary: "Momentum and angular momentum of the model about the origin, global axes.",
    subject: Subject::Model,
    features: &[Feature::Axes, Feature::Rates],
    components: &[
        ("p1", "N s"),
        ("p2", "N s"),
        ("p3", "N s"),
        ("l1", "N m s"),
        ("l2", "N m s"),
        ("l3", "N m s"),
    ],
    build: Build::System(WITHOUT_GRADIENT, |output, _, subjects| {
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
}
