//! The picture of the project: the beam that is lifted by a crank and buckles.

use lissom_model::output::figures;

use super::fragment::Fragment;
use super::{BookError, Studio};

const EXAMPLE: &str = "tip-crank";

/// Displacements at mid-span.
pub(super) fn tip_crank(studio: &Studio) -> Result<Fragment, BookError> {
    let fail = |reason: String| BookError::Run { example: EXAMPLE, reason };
    let model = studio.example(EXAMPLE)?;
    let title = model.document().map_err(|report| fail(report.render(false)))?.title;
    let mut session = model.session().map_err(|error| fail(error.to_string()))?;
    let (record, report) = session.run().unwrap_or_else(lissom::Results::from).into_parts();
    if let Some(error) = report.error() {
        return Err(fail(error.to_string()));
    }
    let drawn = figures(&record, title.as_deref().unwrap_or(EXAMPLE));
    let figure = drawn.iter().find(|figure| figure.name == "midspan");
    let figure = figure.ok_or_else(|| fail("it has no output `midspan`".to_owned()))?;
    let mut fragment = Fragment::default();
    fragment.commands(&[format!("lissom run examples/{EXAMPLE}.toml")]);
    fragment.drawing(
        "images/tip-crank.svg",
        "Displacements at mid-span of a beam that is lifted by a tip crank and buckles sideways",
        figure.draw()?.svg()?,
    );
    Ok(fragment)
}
