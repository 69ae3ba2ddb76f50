//! Shells as nodes with mass, elements and loads per area.

use std::sync::Arc;

use lissom_flexible::pressure::{FacePressure, face_points};
use lissom_flexible::shell::section::Ply;
use lissom_flexible::shell::surface::{ShellSection, ShellSurface, SurfaceDescription, shell_surface};
use lissom_mechanics::elements::{Attached, Contribution, force};
use lissom_mechanics::registry::{Function, Parameters, Value};
use lissom_mesh::MeshedPart;
use lissom_motion::Vector3;
use lissom_system::Builder;

use super::names::Names;
use super::order::by_name;
use super::pressures;
use crate::document::{AreaLoad, Document, Shell, area_arguments};
use crate::expression::{Expression, Formula};
use crate::functions::{Ramp, of_expression};
use crate::outputs::meshes::BuiltShell;
use crate::reading::mesh_nodes::BuiltNodes;
use crate::text::report::Problem;

/// Instants of the analysis at which a load must be finite.
const INSTANTS: u32 = 16;

/// Name of a node: its place, or its number in a mesh from a file.
pub(super) fn node_name(part: &str, mesh: &MeshedPart, node: usize) -> String {
    let Some(place) = mesh.place(node) else { return format!("{part}@{}", node + 1) };
    let place: Vec<String> = place.iter().map(|value| format!("{value:.4}")).collect();
    format!("{part}@{}", place.join(","))
}

/// Adds all shells.
pub(super) fn add(
    document: &Document,
    builder: &mut Builder,
    names: &mut Names,
    problems: &mut Vec<Problem>,
) {
    for shell in by_name(&document.shells, |shell| &shell.name.value) {
        let name = &shell.name.value;
        let name_of = |node: usize| node_name(name, &shell.mesh, node);
        let (contribution, surface) = shell_surface(
            builder.model(),
            &SurfaceDescription {
                mesh: &shell.mesh,
                names: &name_of,
                fold_angle: shell.fold_angle,
                // Elements of a mesh have no common direction of their own.
                direction: shell.direction.or(shell.mesh.places.is_none().then(Vector3::x)),
                damping: shell.damping,
                section: &|element| ShellSection {
                    tension: 0.5 * (shell.prestress[0] + shell.prestress[1]).max(0.0),
                    ..ShellSection::laminate(&shell.plies(element), shell.offset)
                },
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
        let ShellSurface { nodes, areas, elements } = surface;
        let nodes = BuiltNodes { mesh: Arc::clone(&shell.mesh), nodes };
        let built = BuiltShell { nodes, areas, elements, plies, offset: shell.offset };
        names.meshes.shells.insert(name.clone(), built);
    }
}

fn add_load(
    document: &Document,
    (shell, load): (&Shell, &AreaLoad),
    surface: &ShellSurface,
    builder: &mut Builder,
) -> Result<(), Problem> {
    if let [formula] = load.components.as_slice() {
        let mut contribution = Contribution::to(builder.model());
        let points = face_points();
        for (index, element) in shell.mesh.quadrilaterals().enumerate() {
            let place = shell.mesh.middle(index);
            let middle = 0.25 * element.iter().map(|&node| shell.mesh.positions[node]).sum::<Vector3>();
            let number = |name: &str| place[usize::from(name == "v")];
            let pressure = pressures::pressure(document, (formula, &load.axes), &middle, number);
            let pressure = pressure.map_err(|time| not_finite(shell, load, place, time))?;
            let mut nodes = element.map(|node| surface.nodes[node]);
            // Along the normal is against that of the other side.
            if !load.is_on_top {
                nodes.reverse();
            }
            contribution = contribution.with(FacePressure::new(nodes, Arc::clone(&points), pressure));
        }
        builder.add(contribution);
        return Ok(());
    }
    for (node, &area) in surface.areas.iter().enumerate() {
        let place = shell.mesh.place(node).map_or([0.5; 2], |place| [place[0], place[1]]);
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
    of_load(document, formula).map_err(|time| not_finite(shell, load, place, time))
}

fn not_finite(shell: &Shell, load: &AreaLoad, [u, v]: [f64; 2], time: f64) -> Problem {
    let name = &shell.name.value;
    let message = format!(
        "a load per area of shell `{name}` is not a finite number at u = {u:.4}, v = {v:.4}, t = {time}"
    );
    Problem::error(load.span, message)
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
