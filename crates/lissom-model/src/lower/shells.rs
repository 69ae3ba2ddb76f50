//! Shells as nodes with mass, elements and loads per area.

use std::sync::Arc;

use lissom_flexible::shell::pressure::Pressure;
use lissom_flexible::shell::section::Ply;
use lissom_flexible::shell::surface::{ShellSection, ShellSurface, SurfaceDescription, shell_surface};
use lissom_mechanics::elements::{Attached, Contribution, force};
use lissom_mechanics::registry::{Function, Parameters, Value};
use lissom_motion::Vector3;
use lissom_system::Builder;

use super::names::Names;
use super::order::by_name;
use crate::document::{AreaLoad, Document, Shell, area_arguments};
use crate::expression::{Expression, Formula};
use crate::functions::{Ramp, of_expression};
use crate::outputs::shell_nodes::BuiltShell;
use crate::text::report::Problem;

/// Instants of the analysis at which a load must be finite.
const INSTANTS: u32 = 16;

/// Adds all shells.
pub(super) fn add(
    document: &Document,
    builder: &mut Builder,
    names: &mut Names,
    problems: &mut Vec<Problem>,
) {
    for shell in by_name(&document.shells, |shell| &shell.name.value) {
        let name = &shell.name.value;
        let name_of = |node: usize| match &shell.mesh.places {
            Some(places) => format!("{name}@{:.4},{:.4}", places[node][0], places[node][1]),
            None => format!("{name}.{}", node + 1),
        };
        let (contribution, surface) = shell_surface(
            builder.model(),
            &SurfaceDescription {
                positions: &shell.mesh.positions,
                names: &name_of,
                elements: &shell.mesh.elements,
                normals: shell.mesh.normals.as_deref(),
                fold_angle: shell.fold_angle,
                // Elements of a mesh have no common direction of their own.
                direction: shell.direction.or(shell.mesh.places.is_none().then(Vector3::x)),
                damping: shell.damping,
                section: &|element| ShellSection::laminate(&shell.plies(element), shell.offset),
            },
        );
        builder.add(contribution);
        let mut plies: Vec<Vec<Ply>> = (0..shell.mesh.elements.len()).map(|k| shell.plies(k)).collect();
        if plies.windows(2).all(|pair| pair[0] == pair[1]) {
            plies.truncate(1);
        }
        let plies = plies.into_iter().map(Into::into).collect();
        for load in &shell.loads {
            problems.extend(add_load(document, (shell, load), &surface, builder).err());
        }
        let built = BuiltShell { mesh: Arc::clone(&shell.mesh), surface, plies, offset: shell.offset };
        names.meshes.shells.insert(name.clone(), built);
    }
}

fn add_load(
    document: &Document,
    (shell, load): (&Shell, &AreaLoad),
    surface: &ShellSurface,
    builder: &mut Builder,
) -> Result<(), Problem> {
    if let [pressure] = load.components.as_slice() {
        let mut contribution = Contribution::to(builder.model());
        for (index, element) in shell.mesh.elements.iter().enumerate() {
            let function = function(document, (shell, load), pressure, shell.mesh.middle(index))?;
            let mut nodes = element.map(|node| surface.nodes[node]);
            if load.is_on_top {
                nodes.reverse();
            }
            contribution = contribution.with(Pressure::new(nodes, function));
        }
        builder.add(contribution);
        return Ok(());
    }
    for (node, &area) in surface.areas.iter().enumerate() {
        let place = shell.mesh.places.as_ref().map_or([0.5; 2], |places| places[node]);
        for (axis, component) in load.components.iter().enumerate() {
            let function = function(document, (shell, load), component, place)?;
            if function.is_constant() && function.value(document.analysis.end) == 0.0 {
                continue;
            }
            let vector = area * load.axes.rotation.apply(&Vector3::ith(axis, 1.0));
            let parameters = Parameters::new()
                .with("vector", Value::Vector(vector))
                .with("scale", Value::Function(function))
                .with("follower", Value::Flag(false));
            let attached = Attached::to_nodes([(surface.nodes[node], Vector3::zeros())]);
            builder
                .add_of_kind(&force::KIND, attached, &parameters)
                .map_err(|error| Problem::error(load.span, error.to_string()))?;
        }
    }
    Ok(())
}

/// A load at a place as a function of time.
fn function(
    document: &Document,
    (shell, load): (&Shell, &AreaLoad),
    formula: &Formula,
    place: [f64; 2],
) -> Result<Function, Problem> {
    let formula = formula.with_arguments(&area_arguments(formula, place));
    of_load(document, formula).map_err(|time| {
        let message = format!(
            "a load per area of shell `{}` is not a finite number at u = {:.4}, v = {:.4}, t = {time}",
            shell.name.value, place[0], place[1]
        );
        Problem::error(load.span, message)
    })
}

/// A load as a function of time; constant loads grow in load steps. It must be finite during the analysis: otherwise an instant at which it
/// is not.
pub(super) fn of_load(document: &Document, expression: Expression) -> Result<Function, f64> {
    let function = of_expression(expression);
    let (start, end) = (document.analysis.start, document.analysis.end);
    let mut times = (0..=INSTANTS).map(|i| start + (end - start) * f64::from(i) / f64::from(INSTANTS));
    if let Some(time) = times.find(|time| !function.value(*time).is_finite()) {
        return Err(time);
    }
    if document.analysis.ramp && function.is_constant() {
        return Ok(Arc::new(Ramp { value: function.value(start), span: (start, end) }));
    }
    Ok(function)
}
