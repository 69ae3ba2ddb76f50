//! Loads that depend on the motion of their own points.

use std::sync::Arc;

use lissom_mechanics::elements::Contribution;
use lissom_mechanics::elements::local_load::{LocalArgument, LocalFunction, LocalFunctions, LocalLoad};
use lissom_mechanics::kinematics::{CarriedFrame, DiscreteValueId};
use lissom_mechanics::registry::{Constant, Function};
use lissom_mechanics::signals::{Argument, SignalFunction};
use lissom_system::Builder;

use super::distributed;
use super::names::Names;
use super::over_argument::{OverArgument, OverWind};
use crate::document::{Document, LocalExpression, LocalLaw, LocalLoadEntry, LocalName};
use crate::expression::OverTime;
use crate::functions::Ramp;
use crate::outputs::local_load_points::LocalLoadPoints;
use crate::reading::node_reference::NodeReference;
use crate::text::report::{Located, Problem};

/// Adds a load, and returns its elements.
pub(super) fn add(
    document: &Document,
    entry: &LocalLoadEntry,
    names: &Names,
    builder: &mut Builder,
) -> Result<LocalLoadPoints, Problem> {
    let laws: Vec<Arc<dyn SignalFunction>> = entry.functions.iter().map(law).collect();
    let held = outside(document, entry, names)?;
    let scale = |weight: f64| {
        let ramp = document.analysis.ramp.then_some((document.analysis.start, document.analysis.end));
        let scale: Function = match ramp {
            Some(span) => Arc::new(Ramp { value: 1.0, span }),
            None => Arc::new(Constant(1.0)),
        };
        (weight, scale)
    };
    let points = points(document, entry, names, builder)?;
    let about = match &entry.about {
        Some((node, axis)) => {
            let other = carried(node, names)?;
            check_carried(entry, builder, ("about", node), &other, true)?;
            Some((other, builder.initial_frame(other.node).rotation.apply_inverse(axis)))
        }
        None => None,
    };
    let mut loads = Vec::new();
    for Point { frame, station, weight } in points {
        if weight == 0.0 {
            continue;
        }
        let mut contribution = Contribution::to(builder.model());
        let states = entry.states.iter().map(|(state, _)| {
            let name = format!("{} {}, {}", entry.name.value, loads.len() + 1, state.name);
            contribution.add_state(name, state.start, state.magnitude)
        });
        let states = states.collect();
        let all = entry.functions.iter().zip(&laws).zip(&held).map(|((own, law), held)| LocalFunction {
            subject: Arc::clone(&own.subject),
            function: Arc::clone(law),
            arguments: own
                .arguments
                .iter()
                .zip(held)
                .map(|(name, held)| argument(name, *held, station))
                .collect(),
        });
        let functions = LocalFunctions {
            all: all.collect(),
            flow: entry.flow,
            wrench: entry.wrench,
            rates: entry.states.iter().map(|(_, rate)| *rate).collect(),
        };
        let start = builder.initial_frame(frame.node).transform_point(&frame.offset.position);
        let mut load = LocalLoad::new(
            names.local_loads.len(),
            (frame, start),
            (entry.frame, entry.is_global),
            functions,
            states,
            scale(weight),
        );
        if let Some((other, axis)) = about {
            load = load.about(other, axis);
        }
        builder.add(contribution.with(load.clone()));
        loads.push((station, load));
    }
    Ok(LocalLoadPoints { points: loads, beam: entry.beam.clone(), variables: entry.variables.clone() })
}

fn law(expression: &LocalExpression) -> Arc<dyn SignalFunction> {
    match &expression.law {
        LocalLaw::Formula(formula) => {
            let unknown = vec![None; formula.arguments().len()];
            Arc::new(OverTime::new(formula.clone(), &unknown))
        }
        LocalLaw::Table(table) => Arc::new(OverArgument::new(table.clone(), None)),
        LocalLaw::Wind(wind, component) => Arc::new(OverWind(Arc::clone(wind), *component)),
    }
}

fn argument(name: &LocalName, held: Option<DiscreteValueId>, station: f64) -> LocalArgument {
    match *name {
        LocalName::Position(k) => LocalArgument::Position(k),
        LocalName::Displacement(k) => LocalArgument::Displacement(k),
        LocalName::Velocity(k) => LocalArgument::Velocity(k),
        LocalName::AngularVelocity(k) => LocalArgument::AngularVelocity(k),
        LocalName::RelativeFlow(k) => LocalArgument::RelativeFlow(k),
        LocalName::RelativePosition(k) => LocalArgument::RelativePosition(k),
        LocalName::Direction(k) => LocalArgument::Direction(k),
        LocalName::State(k) => LocalArgument::State(k),
        LocalName::Function(index) => LocalArgument::Function(index),
        LocalName::Station => LocalArgument::Constant(station),
        LocalName::Outside(_) => held.map_or(LocalArgument::Constant(f64::NAN), LocalArgument::Held),
    }
}

/// The held values of inputs and sampled signals that each expression names, by argument.
fn outside(
    document: &Document,
    entry: &LocalLoadEntry,
    names: &Names,
) -> Result<Vec<Vec<Option<DiscreteValueId>>>, Problem> {
    let of = |name: &LocalName| match name {
        LocalName::Outside(name) => held(entry, names, name).map(Some),
        LocalName::Displacement(_) if document.assembly.is_some() => {
            let message = format!(
                "local load `{}` names a displacement, which has no reference where [assembly] moves the parts",
                entry.name.value
            );
            Err(Problem::error(entry.name.span, message).help("name x, y and z instead"))
        }
        _ => Ok(None),
    };
    entry.functions.iter().map(|own| own.arguments.iter().map(of).collect()).collect()
}

fn held(entry: &LocalLoadEntry, names: &Names, name: &Located<String>) -> Result<DiscreteValueId, Problem> {
    if let Some(Argument::Held(held)) = names.signals.get(&name.value) {
        return Ok(*held);
    }
    names.references.samples.get(&name.value).copied().ok_or_else(|| {
        let message = format!(
            "local load `{}` names the signal `{}`, which is not sampled",
            entry.name.value, name.value
        );
        let help = "add `sample` to the signal, or write its expression in the `variables` of the load";
        Problem::error(name.span, message).help(help)
    })
}

/// A point on which a load acts.
struct Point {
    frame: CarriedFrame,
    station: f64,
    /// Length that belongs to it, or 1.
    weight: f64,
}

fn points(
    document: &Document,
    entry: &LocalLoadEntry,
    names: &Names,
    builder: &Builder,
) -> Result<Vec<Point>, Problem> {
    if let Some(beam) = &entry.beam {
        let unknown = || Problem::error(entry.name.span, format!("there is no beam `{beam}`"));
        let line = names.lines.get(beam).ok_or_else(unknown)?;
        let weights = distributed::lengths(document.beam(beam).ok_or_else(unknown)?, line);
        let point = |k: usize| Point {
            frame: CarriedFrame { node: line.nodes[k], offset: line.offsets[k] },
            station: line.places[k],
            weight: weights[k],
        };
        return Ok((0..line.nodes.len()).map(point).collect());
    }
    let mut frame = carried(&entry.node, names)?;
    if let Some(at) = entry.at {
        frame.offset.position = builder.initial_frame(frame.node).inverse_transform_point(&at);
    }
    let moments = entry.wrench[3..].iter().any(Option::is_some);
    check_carried(entry, builder, ("on", &entry.node), &frame, moments)?;
    Ok(vec![Point { frame, station: 0.0, weight: 1.0 }])
}

/// The frame of a node; on a beam that of the section.
fn carried(reference: &Located<NodeReference>, names: &Names) -> Result<CarriedFrame, Problem> {
    let mut frame = CarriedFrame::of_node(names.node(reference)?);
    if let NodeReference::Beam { beam, .. } = &reference.value
        && let Some(line) = names.lines.get(beam)
        && let Some(k) = line.nodes.iter().position(|&own| own == frame.node)
    {
        // The node may be another part's: axes and position are those of the section.
        frame.offset = line.offsets[k];
    }
    Ok(frame)
}

fn check_carried(
    entry: &LocalLoadEntry,
    builder: &Builder,
    (key, node): (&'static str, &Located<NodeReference>),
    frame: &CarriedFrame,
    turns: bool,
) -> Result<(), Problem> {
    let carried = (frame.node, frame.offset.position);
    builder
        .model()
        .check_carried(key, carried, turns)
        .map_err(|error| Problem::error(node.span, format!("local load `{}`: {error}", entry.name.value)))
}
