//! Components of outputs and of joints' coordinates that expressions name, as measurements.

use lissom_mechanics::kinematics::CoordinateId;
use lissom_mechanics::signals::MeasurementId;
use lissom_mechanics::signals::coordinate::Coordinate;
use lissom_system::Builder;
use lissom_system::element_quantity::Of;

use super::names::Names;
use super::signal_references::NamedComponent;
use super::signals::relative_components;
use crate::document::{Component, Document};
use crate::format::suggest;
use crate::output::component::component_position;
use crate::outputs::channel_components::components;
use crate::outputs::entry::{Output, OutputSource};
use crate::outputs::kinds::{Feeds, OutputKind};
use crate::outputs::spring::components_of;
use crate::outputs::{Build, Subjects, all_components};
use crate::text::report::Problem;

/// Why a name cannot be measured.
pub(super) struct Fault {
    pub(super) message: String,
    pub(super) help: Option<String>,
    /// Whether it can be measured at samples.
    pub(super) is_of_solution: bool,
}

/// What measures a name.
pub(super) enum Measured {
    /// A measurement.
    By(MeasurementId),
    /// A quantity of an element that is not added yet.
    Later,
}

fn fault<T>(message: String, help: Option<String>) -> Result<T, Fault> {
    Err(Fault { message, help, is_of_solution: false })
}

/// Adds the measurement of a component of an output, or of a joint where no output is called so.
pub(super) fn measure(
    document: &Document,
    builder: &mut Builder,
    names: &Names,
    owner: &str,
    component: &str,
) -> Result<Measured, Fault> {
    let output = document.outputs.iter().find(|output| output.name.value == owner);
    let coordinates = names.coordinates.get(owner);
    match (output, coordinates) {
        (Some(output), None) => of_output(document, output, builder, names, component),
        (None, Some(coordinates)) => of_coordinates(owner, coordinates, builder, component),
        (Some(output), Some(coordinates)) => {
            let same = matches!((&output.kind, &output.source),
                (OutputKind::Relative, OutputSource::Joint(joint)) if joint.value == owner);
            let is_of_joint =
                relative_components(coordinates, builder).iter().any(|(known, ..)| known == component);
            if is_of_joint && !same {
                let message = format!("`{owner}.{component}` may mean the joint or the output `{owner}`");
                return fault(message, Some("rename the output".to_owned()));
            }
            if is_of_joint {
                of_coordinates(owner, coordinates, builder, component)
            } else {
                of_output(document, output, builder, names, component)
            }
        }
        (None, None) => {
            let known: Vec<&str> = (document.outputs.iter().map(|output| output.name.value.as_str()))
                .chain(names.coordinates.keys().map(String::as_str))
                .collect();
            let help = suggest::help(owner, known);
            fault(format!("there is no output or joint called `{owner}`"), help)
        }
    }
}

fn unknown_component<T>(owner: &str, component: &str, known: &[String]) -> Result<T, Fault> {
    let message = format!("`{owner}` has no component `{component}`");
    let synonyms = known.iter().filter_map(|word| Some(format!("rotation{}", word.strip_prefix("angle")?)));
    let known: Vec<String> = known.iter().cloned().chain(synonyms).collect();
    fault(message, suggest::help(component, known.iter().map(String::as_str)))
}

fn of_coordinates(
    owner: &str,
    coordinates: &[CoordinateId],
    builder: &mut Builder,
    component: &str,
) -> Result<Measured, Fault> {
    let components = relative_components(coordinates, builder);
    if components.is_empty() {
        return fault(format!("joint `{owner}` has no relative coordinate"), None);
    }
    if let Some((_, coordinate, of)) = components.iter().find(|(known, ..)| known == component) {
        return Ok(Measured::By(builder.add_measurement(Coordinate::new(*coordinate, *of))));
    }
    let known: Vec<String> = components.into_iter().map(|(known, ..)| known).collect();
    unknown_component(owner, component, &known)
}

fn of_output(
    document: &Document,
    output: &Output,
    builder: &mut Builder,
    names: &Names,
    component: &str,
) -> Result<Measured, Fault> {
    let owner = &output.name.value;
    if let Feeds::Samples(reason) = output.kind.feeds() {
        let message = format!(
            "`{owner}` is of kind `{}`, which only sampled signals can depend on: {reason}",
            output.kind.name()
        );
        return of_solution(message);
    }
    let (start, resolver) = (builder.initial_kinematics(), names.resolver());
    let joint_frames = |joint: &str| builder.output_frames(joint);
    let subjects = Subjects { names: &resolver, drawn: &start, start: &start, joint_frames: &joint_frames };
    let build = match output.kind.build() {
        Build::Motion(build) => build,
        Build::Element(..) if is_unscaled(document, output) => return Ok(Measured::Later),
        _ => {
            let message = format!("`{owner}` is of a drive or of a load that a signal scales");
            return of_solution(message);
        }
    };
    let quantity = build(output, &subjects)?;
    let measurements = all_components(quantity.measurements());
    if measurements.is_empty() {
        let message = format!(
            "`{owner}` lies between nodes of a beam or depends on too many unknowns, where only sampled signals can measure"
        );
        return of_solution(message);
    }
    let quantity_of = |coordinate| builder.coordinate_quantity(coordinate);
    let (known, _) = components(output.kind, &*quantity, &quantity_of);
    match component_position(known.iter().map(String::as_str), component) {
        Some(index) => Ok(Measured::By(builder.add_component(measurements[index].clone()))),
        None => unknown_component(owner, component, &known),
    }
}

/// Whether an output is of an element that no signal scales: a spring, a load, or the friction of a joint.
fn is_unscaled(document: &Document, output: &Output) -> bool {
    let (OutputSource::Spring(name) | OutputSource::Actor(name)) = &output.source else { return false };
    let is_element = |own: &&Component| own.name.value == name.value && own.signal.is_none();
    let elements = document.springs.iter().chain(&document.loads);
    let with_friction = document.joints.iter().filter(|joint| joint.friction.is_some());
    elements.chain(with_friction).find(is_element).is_some()
}

/// Finds the elements of measurements that signals have named before.
pub(super) fn bind(
    document: &Document,
    builder: &mut Builder,
    names: &mut Names,
    problems: &mut Vec<Problem>,
) {
    for later in std::mem::take(&mut names.references.later_measurements) {
        let NamedComponent { target: measurement, output: owner, component, place, reader } = later;
        let output = document.outputs.iter().find(|output| output.name.value == owner);
        let Some((output, Build::Element(of, _))) = output.map(|output| (output, output.kind.build())) else {
            continue;
        };
        let (OutputSource::Spring(name) | OutputSource::Actor(name)) = &output.source else { continue };
        if names.latches.contains_key(&name.value) {
            let message = format!(
                "{reader} cannot be read: `{owner}` is of a latch, whose force follows from the solution of a step"
            );
            problems.push(Problem::error(place, message).label("here").help("add `sample` to the signal"));
            continue;
        }
        let spring = names.springs.get(&name.value);
        let of = of(output);
        if of == Of::Power && names.powers.get(&name.value).is_some_and(|own| own.len() > 1) {
            let message =
                format!("{reader} cannot be read: `{owner}` is of a load that is spread over a set of nodes");
            problems.push(Problem::error(place, message).label("here").help("add `sample` to the signal"));
            continue;
        }
        let element = match of {
            Of::Spring => spring.map(|&(element, elongation)| (element, components_of(elongation))),
            Of::Power => names.powers.get(&name.value).and_then(|own| match own[..] {
                [element] => Some((element, output.kind.components())),
                _ => None,
            }),
            Of::Reported(_) | Of::Wrench(_) => {
                spring.map(|&(element, _)| (element, output.kind.components()))
            }
        };
        // An element that could not be added, and a spring without elongation, have their own problems.
        let Some((element, components)) = element else { continue };
        let words = || components.iter().map(|(word, _)| *word);
        let problem = |message: String| {
            Problem::error(place, format!("{reader} cannot be read: {message}")).label("here")
        };
        let Some(index) = component_position(words(), &component) else {
            let message = format!("`{owner}` has no component `{component}`");
            problems.push(problem(message).maybe_help(suggest::help(&component, words())));
            continue;
        };
        if !builder.measure_element(measurement, element, (of, index)) {
            let message =
                format!("`{owner}` has no gradient: its element has none, or has too many unknowns");
            problems.push(problem(message).help("add `sample` to the signal"));
        }
    }
}

impl From<Problem> for Fault {
    fn from(problem: Problem) -> Self {
        Self { message: problem.message, help: problem.help, is_of_solution: false }
    }
}

/// An error for a quantity on which only sampled signals can depend.
fn of_solution<T>(message: String) -> Result<T, Fault> {
    let help =
        "add `sample` to the signal, or use a joint or an output at a node, such as its position or velocity";
    Err(Fault { message, help: Some(help.to_owned()), is_of_solution: true })
}
