//! Positions of all nodes of a beam.

use std::sync::Arc;

use lissom_mechanics::kinematics::{CarriedFrame, CoordinateId, NodeId, Quantity};
use lissom_mechanics::signals::frame_quantity::{FrameQuantity, Of};
use lissom_mechanics::signals::measurement::Measurement;
use lissom_motion::Motion;

use super::frames::name_of;
use super::{Build, Found, NamesAndUnits, OutputQuantity, Subjects};
use crate::outputs::entry::Output;
use crate::outputs::kinds::{Declaration, Subject};
use crate::text::report::Problem;

/// Registry entry.
pub(crate) const LINE: Declaration = Declaration {
    word: "line",
    summary: "Positions of all nodes of a beam, from its start to its end.",
    subject: Subject::Beam,
    features: &[],
    components: &[],
    build: Build::Motion(quantity),
};
/// Positions along a beam.
struct Points(Vec<Arc<dyn Measurement>>);

fn quantity(output: &Output, subjects: &Subjects<'_>) -> Found {
    let name = name_of(output)?;
    let unknown = || Problem::error(name.span, format!("there is no beam called `{}`", name.value));
    let line = subjects.names.lines.get(&name.value).ok_or_else(unknown)?;
    let point = |(&node, offset): (&NodeId, &Motion)| -> Arc<dyn Measurement> {
        // A node may be another part's: the section has its position beside it.
        let own = CarriedFrame { node, offset: Motion::translation(offset.position) };
        Arc::new(FrameQuantity::new(Of::Position, own, None, None, Motion::identity()))
    };
    Ok(Arc::new(Points(line.nodes.iter().zip(&line.offsets).map(point).collect())))
}

impl OutputQuantity for Points {
    fn components(&self, _: &dyn Fn(CoordinateId) -> Quantity) -> Option<NamesAndUnits> {
        let of = |k: usize| ["x", "y", "z"].map(|axis| (format!("{axis}{k}"), "m"));
        Some((0..self.0.len()).flat_map(of).collect())
    }

    fn measurements(&self) -> &[Arc<dyn Measurement>] {
        &self.0
    }
}
