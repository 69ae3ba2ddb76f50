//! A rope over pulleys: a spring and damper without compression along the polyline through several positions, over which it
//! slides without friction, so that its tension is uniform. Drums wind it. `reeving.rs` has the length over sheaves with a radius.
//!
//! Legend: x_p positions, Δ_i = x_{i+1} - x_i with length ℓ_i and direction u_i, L free length, L₀(t) as given, q_d coordinates
//! of drums with initial values q_d0, r_d length paid out per unit.
//!
//! ```text
//! e = Σ ℓ_i - L,   ė = Σ u_i·Δ̇_i - L̇,   L = L₀(t) + Σ r_d (q_d - q_d0),   T = max(0, k e + c ė) or another law for e > 0
//! T times ∂e:   at places  g_p = ∂Σℓ/∂x_p = u_{p-1} - u_p,   at drums  ∂e/∂q_d = -r_d
//! ```

use lissom_motion::Vector3;

use super::contribution::Contribution;
use super::force_law::ForceLaw;
use super::initial_model::InitialModel;
use super::kind::{Attached, ElementKind};
use super::over_measure::OverMeasure;
use super::polyline::Polyline;
use super::reeving::Reeving;
use crate::kinematics::{CoordinateId, GROUND, MAX_NODES, NodeId, Quantity};
use crate::ports::{PortDeclaration, PortType, Ports};
use crate::registry::ParameterType::{NotNegative, Positive};
use crate::registry::{Constant, Function, ParameterError, ParameterType, Parameters, Value, optional};

/// Registry entry.
pub const KIND: ElementKind = ElementKind {
    name: "rope",
    summary: "Rope that slides over several points without friction: pulleys, and hoists by its free length.",
    sample: "stiffness = 1e4\ndamping = 10.0\nlength = \"3 - 0.1*t\"",
    parameters: &[
        optional(
            "stiffness",
            NotNegative,
            "N/m",
            "Stiffness of the whole rope.",
        ).or_number(0.0),
        optional(
            "damping",
            NotNegative,
            "N s/m",
            "Damping of the whole rope.",
        ).or_number(0.0),
        optional(
            "force",
            ParameterType::Force(&["elongation", "rate"]),
            "N",
            "Tension over `elongation` and `rate`, in addition to `stiffness`; a table is over `elongation`.",
        ),
        optional(
            "damper_force",
            ParameterType::Force(&["rate", "elongation"]),
            "N",
            "Tension over `rate` and `elongation`, in addition to `damping`; a table is over `rate`.",
        ),
        optional(
            "limits",
            ParameterType::Range,
            "N",
            "Minimum and maximum tension; default: none.",
        ),
        optional(
            "length",
            ParameterType::Function,
            "m",
            "Free length of the whole rope; a function of time for a winch; default: the length at the start.",
        ),
        optional(
            "drum_radii",
            ParameterType::Numbers,
            "m",
            "Length of rope paid out by each of `drums` per rad or m of its coordinate; negative if it winds the rope up.",
        ),
        optional(
            "diameter",
            Positive,
            "m",
            "Diameter with which it is drawn; default: a thin line.",
        ),
    ],
    ports: Ports(&[
        PortDeclaration::required(
            "along",
            PortType::Locations,
            "points over which it passes, from one end to the other",
        )
        .listed("along: the points over which it passes, each with `on` and `at`")
        .sample("along = [{ on = \"ground\", at = [0.0, 0.0, 3.0] }, { on = \"my_body\" }]"),
        PortDeclaration::optional(
            "drums",
            PortType::Coordinates,
            "coordinates of joints that pay it out, such as \"drum.angle\"; the name of a joint stands for all its coordinates",
        )
        .listed("drums: coordinates that pay it out"),
    ]),
    build,
};

/// Maximum number of positions of a rope.
pub(super) const MAX_PLACES: usize = 16;

/// Lengths that drums pay out per unit of their coordinates, and the initial values of these.
fn drums(
    model: &InitialModel,
    drums: &[CoordinateId],
    parameters: &Parameters,
) -> Result<Vec<[f64; 2]>, ParameterError> {
    let radii = if parameters.has("drum_radii") { parameters.numbers("drum_radii")? } else { &[] };
    let fault = |problem: String| Err(ParameterError::new("drum_radii", problem));
    if radii.len() != drums.len() {
        return fault(format!("must be as many as `drums`: {} for {}", radii.len(), drums.len()));
    }
    if drums.len() > 2 {
        return fault("belong to more than two drums: a rope has two ends".to_owned());
    }
    if radii.contains(&0.0) {
        return fault("must not be zero: such a drum pays out no rope".to_owned());
    }
    Ok(radii.iter().zip(drums).map(|(radius, drum)| [*radius, model.coordinate_value(*drum)]).collect())
}

fn build(
    model: &InitialModel,
    attached: Attached,
    parameters: &Parameters,
) -> Result<Contribution, ParameterError> {
    let Attached { nodes: along, coordinates: mut winding, sheaves } = attached;
    let points: Vec<Vector3> =
        along.iter().map(|(node, place)| model.frame(*node).transform_point(place)).collect();
    let fault = |problem: &str| Err(ParameterError::new("along", problem));
    if points.len() < 2 {
        return fault("needs at least two points");
    }
    if points.len() > MAX_PLACES {
        return fault("has more than 16 points: attach two ropes to a part in between");
    }
    let lengths = points.windows(2).map(|pair| (pair[1] - pair[0]).norm());
    if let Some(index) = lengths.clone().position(|length| length == 0.0) {
        let problem = format!(
            "has the points {} and {} at one position: the rope has no direction",
            index + 1,
            index + 2
        );
        return fault(&problem);
    }
    let at_start: f64 = lengths.sum();
    for (index, _) in sheaves.iter().filter(|(index, _)| along[*index].0 != GROUND) {
        model.check_carried("along", along[*index], true)?;
    }
    let mut nodes: Vec<NodeId> = Vec::new();
    let mut places = Vec::new();
    for (node, place) in along {
        if node == GROUND {
            places.push((None, model.frame(node).transform_point(&place)));
            continue;
        }
        let known = nodes.iter().position(|known| *known == node).unwrap_or_else(|| {
            nodes.push(node);
            nodes.len() - 1
        });
        places.push((Some(known), place));
    }
    match nodes.len() {
        0 => return fault("is all on the ground, which does not move"),
        1..=MAX_NODES => {}
        _ => {
            return fault(
                "passes over more than four parts in addition to the ground: connect two ropes at an intermediate part",
            );
        }
    }
    let turning = sheaves.iter().filter(|(_, own)| own.turns.is_some()).count();
    let mut of_sheaves = Vec::new();
    for own in winding.drain(..turning.min(winding.len())) {
        if model.coordinate_quantity(own) != Quantity::Angle {
            let name = model.coordinate_name(own);
            return fault(&format!(
                "has a drum whose `joint` has the coordinate `{name}`, which is not an angle"
            ));
        }
        of_sheaves.push((own, model.coordinate_value(own)));
    }
    let pays_out = drums(model, &winding, parameters)?;
    // It cannot push.
    let pulls = parameters.clone().with("side", Value::Text("tension".to_owned()));
    let law = ForceLaw::new(&pulls, ["force", "damper_force"])?;
    let length: Function = if parameters.has("length") {
        parameters.function("length")?
    } else {
        std::sync::Arc::new(Constant(at_start))
    };
    let line: Polyline<MAX_PLACES> =
        Polyline { nodes, places, length, drums: winding, pays_out, frames: None };
    if !sheaves.is_empty() {
        let points = line.points(|node| &model.nodes[node].motion);
        let mut reeving = Reeving::new(&points, line, &sheaves, of_sheaves)?;
        if !parameters.has("length") {
            reeving.set_length(reeving.initial_length(&points));
        }
        return Ok(OverMeasure::contribution(model, reeving, law));
    }
    Ok(OverMeasure::contribution(model, line, law))
}
