//! Force and moment of springs, bushings and bearings on their tip.

use std::slice::from_ref;
use std::sync::Arc;

use lissom_mechanics::evaluation::wrench::WrenchAxes;
use lissom_mechanics::signals::measurement::Measurement;
use lissom_system::System;
use lissom_system::element_quantity::Of;

use super::frames::name_of;
use super::{Build, Found, OutputQuantity, Subjects};
use crate::outputs::entry::{Output, ReactionAxes};
use crate::outputs::kinds::{Declaration, Feature, Subject};
use crate::text::report::Problem;

/// Registry entry.
pub(crate) const SPRING_FORCE: Declaration = Declaration {
    word: "spring_force",
    summary: "Force and moment of a spring, bushing, bearing or rolling contact on its tip, about its point `at_tip`.",
    subject: Subject::Spring,
    features: &[Feature::JointAxes, Feature::Fatigue, Feature::InternalForces],
    components: &[("f1", "N"), ("f2", "N"), ("f3", "N"), ("m1", "N m"), ("m2", "N m"), ("m3", "N m")],
    build: Build::Element(wrench, quantity),
};

/// Force and moment of an element.
struct SpringForce(Arc<dyn Measurement>);

fn wrench(output: &Output) -> Of {
    Of::Wrench(match output.axes {
        ReactionAxes::Ground => WrenchAxes::Ground,
        ReactionAxes::Base => WrenchAxes::Base,
        ReactionAxes::Tip => WrenchAxes::Tip,
    })
}

fn quantity(output: &Output, system: &System, subjects: &Subjects<'_>) -> Found {
    let name = name_of(output)?;
    let known = subjects.names.springs.get(&name.value);
    let measured = known.and_then(|(element, _)| system.element_quantity(*element, wrench(output)));
    let measured = measured.ok_or_else(|| {
        Problem::error(name.span, format!("spring `{}` has no single tip on which it acts", name.value))
            .help("name a spring, bushing, bearing or rolling contact between two points, or use `kind = \"spring\"`")
    })?;
    Ok(Arc::new(SpringForce(measured)))
}

impl OutputQuantity for SpringForce {
    fn measurements(&self) -> &[Arc<dyn Measurement>] {
        from_ref(&self.0)
    }
}
