//! Elongation, rate and force of springs.

use std::slice::from_ref;
use std::sync::Arc;

use lissom_core::kinematics::{CoordinateId, Quantity};
use lissom_core::signals::measurement::Measurement;
use lissom_core::system::System;
use lissom_core::system::element_quantity::Of;

use super::frames::name_of;
use super::{Build, Found, NamesAndUnits, OutputQuantity, Subjects};
use crate::document::{Declaration, Feature, Output, OutputComponent, Subject};
use crate::report::Problem;

/// Registry entry.
pub(crate) const SPRING: Declaration = Declaration {
    word: "spring",
    summary: "Elongation or rotation of a spring, its rate, and its force or moment.",
    subject: Subject::Spring,
    features: &[Feature::Fatigue, Feature::InternalForces],
    components: &[("elongation", "m"), ("rate", "m/s"), ("force", "N")],
    build: Build::Element(Of::Spring, quantity),
};
/// Motion of a spring with its force.
struct Spring {
    measured: Arc<dyn Measurement>,
    /// Whether the elongation is a length or an angle.
    elongation: Quantity,
}

fn quantity(output: &Output, system: &System, subjects: &Subjects<'_>) -> Found {
    let name = name_of(output)?;
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

impl OutputQuantity for Spring {
    fn components(&self, _: &dyn Fn(CoordinateId) -> Quantity) -> Option<NamesAndUnits> {
        let words = components_of(self.elongation).iter();
        Some(words.map(|&(word, unit)| (word.to_owned(), unit)).collect())
    }

    fn measurements(&self) -> &[Arc<dyn Measurement>] {
        from_ref(&self.measured)
    }
}
