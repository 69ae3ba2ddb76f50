//! Modal coordinates of superelements and their rates.

use std::sync::Arc;

use lissom_mechanics::kinematics::{CoordinateId, Quantity};
use lissom_mechanics::signals::measurement::Measurement;

use super::Deformed;
use super::frames::name_of;
use super::relative::value_and_rate;
use super::{Build, Found, NamesAndUnits, OutputQuantity, Resolver, Subjects};
use crate::outputs::entry::Output;
use crate::outputs::kinds::{Declaration, Subject};
use crate::text::report::{Located, Problem};

/// Registry entry.
pub(crate) const MODAL: Declaration = Declaration {
    word: "modal",
    summary: "Modal coordinates of a superelement and their rates, in the units of its matrices.",
    subject: Subject::Superelement,
    features: &[],
    components: &[],
    build: Build::Motion(quantity),
};
/// Value and rate of each modal coordinate.
struct Modal(Vec<Arc<dyn Measurement>>);

fn quantity(output: &Output, subjects: &Subjects<'_>) -> Found {
    let name = name_of(output)?;
    let Deformed { unknowns, .. } = deformed(name, subjects.names)?;
    if unknowns.coordinates().len() == 0 {
        let message = format!("the superelement `{}` has no modal coordinates to record", name.value);
        return Err(Problem::error(name.span, message).help("reduce it with modes, or leave this output out"));
    }
    Ok(Arc::new(Modal(unknowns.modal().flat_map(value_and_rate).collect())))
}

/// The unknowns of a superelement.
pub(super) fn deformed<'n>(name: &Located<String>, names: &Resolver<'n>) -> Result<&'n Deformed, Problem> {
    let unknown = || Problem::error(name.span, format!("there is no superelement called `{}`", name.value));
    names.deformations.get(&name.value).ok_or_else(unknown)
}

impl OutputQuantity for Modal {
    fn components(&self, _: &dyn Fn(CoordinateId) -> Quantity) -> Option<NamesAndUnits> {
        let of = |k: usize| ["q", "v"].map(|letter| (format!("{letter}{k}"), ""));
        Some((1..=self.0.len() / 2).flat_map(of).collect())
    }

    fn measurements(&self) -> &[Arc<dyn Measurement>] {
        &self.0
    }
}
