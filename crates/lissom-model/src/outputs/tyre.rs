//! Slip and forces of tyres.

use std::slice::from_ref;
use std::sync::Arc;

use lissom_mechanics::elements::tyre::REPORTED;
use lissom_mechanics::signals::measurement::Measurement;
use lissom_system::System;
use lissom_system::element_quantity::Of;

use super::frames::name_of;
use super::{Build, Found, OutputQuantity, Subjects};
use crate::outputs::entry::Output;
use crate::outputs::kinds::{Declaration, Feature, Subject};
use crate::text::report::Problem;

/// Registry entry.
pub(crate) const TYRE: Declaration = Declaration {
    word: "tyre",
    summary: "Slip, slip angle and forces of a tyre in axes of its contact, and its aligning moment; all zero in the air.",
    subject: Subject::Spring,
    features: &[Feature::InternalForces],
    components: REPORTED,
    build: Build::Element(|_| Of::Reported(REPORTED), quantity),
};

/// Slip and forces of an element.
struct Slip(Arc<dyn Measurement>);

fn quantity(output: &Output, system: &System, subjects: &Subjects<'_>) -> Found {
    let name = name_of(output)?;
    let known = subjects.names.springs.get(&name.value);
    let measured = known.and_then(|(element, _)| system.element_quantity(*element, Of::Reported(REPORTED)));
    let measured = measured.ok_or_else(|| {
        Problem::error(name.span, format!("spring `{}` is no tyre", name.value))
            .help("name a spring of kind `tyre`, or use `kind = \"spring\"`")
    })?;
    Ok(Arc::new(Slip(measured)))
}

impl OutputQuantity for Slip {
    fn measurements(&self) -> &[Arc<dyn Measurement>] {
        from_ref(&self.0)
    }
}
