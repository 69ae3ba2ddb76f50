//! Sliders along beams: the nodes of the beams in their order, with arc lengths.

use lissom_core::joints::slider::{CarriedPoint, Orientation};
use lissom_core::system::Builder;
use lissom_motion::Vector3;

use super::{Names, parameter_problem};
use crate::document::{Beam, Component, Document, NodeReference};
use crate::report::{Located, Problem};

/// Cosine of the largest angle at which two beams of a chain may meet, 2 degrees: the line through their nodes is smooth.
const SMOOTH: f64 = 0.999_39;

/// Adds a slider.
pub(super) fn add(
    document: &Document,
    component: &Component,
    (beams, tip, at): (&[Located<String>], &Located<NodeReference>, &Vector3),
    (builder, names): (&mut Builder, &mut Names),
) -> Result<(), Problem> {
    let name = &component.name.value;
    let (mut nodes, mut knots, mut last): (Vec<CarriedPoint>, Vec<f64>, Option<&Beam>) = Default::default();
    // Axis 2 of the section at each node, in its axes.
    let mut sections: Vec<Vector3> = Vec::new();
    let orientation =
        component.parameters.word("orientation").map_err(|error| parameter_problem(component, &error))?;
    for reference in beams {
        let (Some(beam), Some(line)) = (document.beam(&reference.value), names.lines.get(&reference.value))
        else {
            return Err(Problem::error(
                reference.span,
                format!("there is no beam called `{}`", reference.value),
            ));
        };
        let points = line.nodes.iter().zip(&line.offsets);
        let mut own: Vec<CarriedPoint> =
            points.map(|(&node, offset)| CarriedPoint { node, point: offset.position }).collect();
        let from = knots.last().copied().unwrap_or(0.0);
        let mut axes: Vec<Vector3> = (line.nodes.iter().zip(&line.places))
            .map(|(&node, &place)| {
                let axis = beam.frame(place).column(1).into_owned();
                builder.initial_frame(node).rotation.apply_inverse(&axis)
            })
            .collect();
        let mut lengths: Vec<f64> =
            arc_lengths(beam, &line.places).into_iter().map(|own| from + own).collect();
        if let (Some(before), Some(end)) = (last, nodes.last()) {
            if end.node != own[0].node {
                let message = format!(
                    "beam `{}` does not start at the end of `{}`",
                    reference.value, before.name.value
                );
                return Err(Problem::error(reference.span, message)
                    .help("let it start at the node of the other, as `from = \"other.end\"`, and name them in order"));
            }
            let [one, other] =
                [before.frame(1.0).column(0).into_owned(), beam.frame(0.0).column(0).into_owned()];
            if one.dot(&other) < SMOOTH {
                let message = format!(
                    "beams `{}` and `{}` meet at {:.2} degrees: a slider would jolt there",
                    before.name.value,
                    reference.value,
                    one.dot(&other).clamp(-1.0, 1.0).acos().to_degrees()
                );
                return Err(Problem::error(reference.span, message)
                    .help("round the corner with a curved beam between them"));
            }
            let [one, other] = [before.frame(1.0), beam.frame(0.0)].map(|own| own.column(1).into_owned());
            if orientation == Some("section") && one.dot(&other) < SMOOTH {
                let message = format!(
                    "the sections of beams `{}` and `{}` differ in orientation at their common node",
                    before.name.value, reference.value
                );
                return Err(Problem::error(reference.span, message).help("specify the same `up` for both"));
            }
            own.remove(0);
            lengths.remove(0);
            axes.remove(0);
        }
        sections.extend(axes);
        nodes.extend(own);
        knots.extend(lengths);
        last = Some(beam);
    }
    let tip = names.node(tip)?;
    let orientation = match orientation {
        Some("tangent") => Orientation::Tangent,
        Some("section") => Orientation::Section(sections),
        _ => Orientation::Free,
    };
    let coordinate = builder
        .add_slider(name, (nodes, knots), (tip, *at), &orientation)
        .map_err(|error| parameter_problem(component, &error))?;
    names.coordinates.insert(name.clone(), vec![coordinate]);
    Ok(())
}

/// Arc length from the beam's start to each of the positions along it [m].
fn arc_lengths(beam: &Beam, places: &[f64]) -> Vec<f64> {
    const CHORDS: usize = 64;
    let mut lengths = vec![0.0; places.len()];
    for k in 1..places.len() {
        let at = |part: usize| {
            let share = part as f64 / CHORDS as f64;
            beam.line.position(places[k - 1] + share * (places[k] - places[k - 1]))
        };
        let chords: f64 = (0..CHORDS).map(|part| (at(part + 1) - at(part)).norm()).sum();
        lengths[k] = lengths[k - 1] + chords;
    }
    lengths
}
