//! Approximate positions of parts: the table `[assembly]`, and the positions of joints on their tips.

use lissom_mechanics::ports::Ports;
use lissom_motion::Vector3;

use super::initial::parts;
use crate::format::keys::{Key, Shape, optional, unitless};
use crate::parts::context::Context;
use crate::reading::reader::Reader;
use crate::text::report::{Located, Problem, Span};

/// Gap that counts as closed, relative to the size of the model.
pub const DEFAULT_ASSEMBLY_TOLERANCE: f64 = 1e-10;

/// Settings of an assembly.
#[derive(Clone, Debug, PartialEq)]
pub struct AssemblyRequest {
    /// Bodies, point masses and beams that stay where they are.
    pub fixed: Vec<(String, Span)>,
    /// Gap that counts as closed, relative to the size of the model; for angles [rad].
    pub tolerance: f64,
    /// Position of the request in the text.
    pub span: Span,
}

/// Position of a joint on its tip, in global axes, for the approximate position of the tip.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct OnTip {
    /// Location [m].
    pub at: Vector3,
    /// Direction of the axis.
    pub axis: Option<Vector3>,
    /// Second direction.
    pub second_axis: Option<Vector3>,
}

/// Keys of `[assembly]`.
pub(super) fn keys() -> Vec<Key> {
    vec![
        unitless(
            "fixed",
            Shape::Names,
            "bodies, point masses, beams, shells, solids, superelements and entries of [parts] that are not moved",
        ),
        unitless(
            "tolerance",
            Shape::Positive,
            "tolerance of closed joints, relative to the size of the model; for angles [rad]",
        )
        .or_number(DEFAULT_ASSEMBLY_TOLERANCE),
    ]
}

/// Keys of joints with one location, whose positions on both nodes differ; none for others.
pub(super) fn keys_on_tip(ports: Ports) -> Vec<Key> {
    if !ports.have_one_location() {
        return Vec::new();
    }
    let mut keys = vec![optional(
        "at_tip",
        Shape::Place,
        "m",
        "location on the tip in its approximate position, if different from `at`; requires [assembly]",
    )];
    if ports.directions() > 0 {
        let words =
            "direction of `axis` on the tip in its approximate position, if different; requires `at_tip`";
        keys.push(unitless("axis_at_tip", Shape::Direction, words));
    }
    if ports.directions() > 1 {
        let words =
            "direction of `second_axis` on the tip in its approximate position; requires `axis_at_tip`";
        keys.push(unitless("second_axis_at_tip", Shape::Direction, words));
    }
    keys
}

/// The table `[assembly]`.
pub(super) fn assembly(context: &Context<'_>) -> Option<AssemblyRequest> {
    let (node, span) = context.top("assembly")?;
    node.table()?;
    let reader = Reader::open(context, node, ("[assembly]".to_owned(), span), keys())?;
    let tolerance = reader.number("tolerance")?.value;
    let fixed = if reader.has("fixed") { parts(&reader, "fixed") } else { Vec::new() };
    Some(AssemblyRequest { fixed, tolerance, span })
}

/// Position of a joint on its tip.
pub(super) fn on_tip(reader: &Reader<'_, '_>, ports: Ports) -> Option<Located<OnTip>> {
    let context = reader.context;
    let known: Vec<&str> = keys_on_tip(ports).iter().map(|key| key.name).collect();
    if known.is_empty() {
        return None;
    }
    let direction = |key: &str| {
        let is_given = known.contains(&key) && reader.node(key).is_some();
        if is_given { reader.vector(key) } else { None }
    };
    let (axis, second_axis) = (direction("axis_at_tip"), direction("second_axis_at_tip"));
    let needs = |key: &str, other: &str, span| {
        let message = format!("{} has `{key}`, but not `{other}`", reader.what);
        context.fail::<()>(span, message, format!("also specify `{other}`"));
    };
    if let (Some(second), None) = (&second_axis, &axis) {
        needs("second_axis_at_tip", "axis_at_tip", second.span);
    }
    let Some(node) = reader.node("at_tip") else {
        if let Some(axis) = axis {
            needs("axis_at_tip", "at_tip", axis.span);
        }
        return None;
    };
    if !reader.has("at") {
        needs("at_tip", "at", node.span);
    }
    if context.top("assembly").is_none() {
        let message = format!("{} lies at different positions on its base and its tip", reader.what);
        let problem = Problem::error(node.span, message).label("apart from `at`");
        context
            .report(problem.help("add a table [assembly], which moves the parts until their joints close"));
    }
    let at = context.place(node, &reader.words("at_tip"))?.value;
    let value =
        OnTip { at, axis: axis.map(|axis| axis.value), second_axis: second_axis.map(|axis| axis.value) };
    Some(Located::new(value, node.span))
}
