//! Elongation, rate and force of springs.

use std::slice::from_ref;
use std::sync::Arc;

use lissom_mechanics::kinematics::{CoordinateId, Quantity};
use lissom_mechanics::signals::measurement::Measurement;
use lissom_system::OutputDerivatives;
use lissom_system::System;
use lissom_system::element_quantity::Of;

use super::derivatives::{add, multiplier_row};
use super::frames::name_of;
use super::{Build, Evaluation, Found, NamesAndUnits, OutputQuantity, Subjects};
use crate::outputs::entry::Output;
use crate::outputs::kinds::{Declaration, Feature, OutputComponent, Subject};
use crate::text::report::Problem;

/// Registry entry.
pub(crate) const SPRING: Declaration = Declaration {
    word: "spring",
    summary: "Elongation or rotation of a spring, its rate, and its force or moment.",
    subject: Subject::Spring,
    features: &[Feature::Fatigue, Feature::InternalForces],
    components: &[("elongation", "m"), ("rate", "m/s"), ("force", "N")],
    build: Build::Element(|_| Of::Spring, quantity),
};
/// Motion of a spring with its force.
struct Spring {
    measured: Arc<dyn Measurement>,
    /// Whether the elongation is a length or an angle.
    elongation: Quantity,
}

fn quantity(output: &Output, system: &System, subjects: &Subjects<'_>) -> Found {
    let name = name_of(output)?;
    if let Some(&index) = subjects.names.latches.get(&name.value) {
        return Ok(Arc::new(OfLatch { index, elongation: system.latches()[index].quantity }));
    }
    let known = subjects.names.springs.get(&name.value);
    let known = known.filter(|(element, _)| system.spring_motion(*element, subjects.start).is_some());
    let spring = known.and_then(|&(element, elongation)| {
        Some(Spring { measured: system.element_quantity(element, Of::Spring)?, elongation })
    });
    let spring = spring.ok_or_else(|| {
        Problem::error(name.span, format!("spring `{}` has no elongation to record", name.value))
            .help("name a spring between two points, or on a joint's coordinate")
    })?;
    Ok(Arc::new(spring))
}

/// Components of a spring whose elongation is of this quantity.
pub(crate) fn components_of(elongation: Quantity) -> &'static [OutputComponent] {
    match elongation {
        Quantity::Angle => &[("rotation", "rad"), ("rate", "rad/s"), ("moment", "N m")],
        Quantity::Length | Quantity::State => SPRING.components,
    }
}

/// Names and units for an elongation of this quantity.
fn named(elongation: Quantity) -> NamesAndUnits {
    components_of(elongation).iter().map(|&(word, unit)| (word.to_owned(), unit)).collect()
}

/// The coordinate of a latch with its rate, and the force of the latch: its multiplier.
struct OfLatch {
    index: usize,
    elongation: Quantity,
}

impl OutputQuantity for OfLatch {
    fn components(&self, _: &dyn Fn(CoordinateId) -> Quantity) -> Option<NamesAndUnits> {
        Some(named(self.elongation))
    }

    fn append_values(&self, at: &Evaluation<'_>, out: &mut Vec<f64>) {
        let latch = &at.system.latches()[self.index];
        let motion = at.motion().coordinates[latch.coordinate];
        out.extend([motion.value, motion.rate, at.state.multipliers[latch.multiplier]]);
    }

    fn derivatives(&self, at: &Evaluation<'_>, _: f64) -> Option<Vec<OutputDerivatives>> {
        let latch = &at.system.latches()[self.index];
        let row = at.system.layout().row_of_coordinate(latch.coordinate);
        let mut all: [OutputDerivatives; 3] = Default::default();
        add(&mut all[0].by_place, row, 1.0);
        add(&mut all[1].by_rate, row, 1.0);
        add(&mut all[2].by_multiplier, multiplier_row(at.system, latch.multiplier), 1.0);
        Some(all.into())
    }
}

impl OutputQuantity for Spring {
    fn components(&self, _: &dyn Fn(CoordinateId) -> Quantity) -> Option<NamesAndUnits> {
        Some(named(self.elongation))
    }

    fn measurements(&self) -> &[Arc<dyn Measurement>] {
        from_ref(&self.measured)
    }
}
