//! Estimates of the memory and disk space that a model requires, before it is built: a typing error in a number of elements or
//! in a step would otherwise end the program without a message.

use std::sync::Arc;

use lissom_mesh::MeshedPart;

use crate::document::{AnalysisKind, Document, ElasticSolid};
use crate::files;
use crate::text::report::{Problem, Report, Span};

/// Memory of a node of a beam with its elements, its tangent, its factors and the motion of the run [bytes]: lines of
/// 10⁴ and 3·10⁴ elements need 53 kB (Radau IIA) to 79 kB (generalized-α) for each node at most.
const PER_NODE: f64 = 5e4;
/// Memory of a body [bytes]: 20 000 free ones need 19 kB each.
const PER_BODY: f64 = 3e4;
/// Memory of a joint [bytes]: each of a chain of 20 000 needs 26 kB.
const PER_JOINT: f64 = 3e4;
/// Memory that every machine has [bytes].
const SMALL: f64 = 1e8;
/// Upper limit of memory on any machine [bytes].
const MAX_MEMORY: f64 = 1e12;
/// Bytes of a number in the table of results.
const PER_NUMBER: f64 = 20.0;
/// Largest table of results [bytes].
const MAX_TABLE: f64 = 5e10;
/// Maximum number of planned steps: at a microsecond each, which no model reaches, they take three hours.
const MAX_STEPS: f64 = 1e10;

/// Complaints about a model that is too large.
pub(super) fn check(document: &Document, problems: &mut Vec<Problem>) {
    elements(document, || files::available_memory().unwrap_or(MAX_MEMORY), problems);
}

/// Checks whether a run to the end has a plausible size. Not required by callers that take single steps.
///
/// # Errors
/// If it would take hours, or fill the disk.
pub fn check_run(document: &Document) -> Result<(), Report> {
    let mut problems = Vec::new();
    steps(document, &mut problems);
    if problems.is_empty() { Ok(()) } else { Err(document.report(problems)) }
}

fn elements(document: &Document, available: impl FnOnce() -> f64, problems: &mut Vec<Problem>) {
    let nodes = |beam: &crate::document::Beam| beam.elements.value as f64 * beam.order as f64;
    let in_shell = |shell: &Arc<MeshedPart>| PER_NODE * shell.positions.len() as f64;
    let of_shells = document.shells.iter().map(|shell| in_shell(&shell.mesh)).sum::<f64>();
    // A node has half the unknowns of one of a beam, and more neighbours.
    let in_solid = |solid: &ElasticSolid| 2.0 * PER_NODE * solid.mesh.positions.len() as f64;
    let of_solids = document.elastic_solids.iter().map(in_solid).sum::<f64>();
    let of_bodies = PER_BODY * (document.bodies.len() + document.point_masses.len()) as f64
        + PER_JOINT * document.joints.len() as f64;
    let memory = of_shells + of_solids + of_bodies + PER_NODE * document.beams.iter().map(nodes).sum::<f64>();
    // The available memory is not queried for small models: that would take a tenth of the time of a sweep's member.
    if memory <= SMALL {
        return;
    }
    let available = available().min(MAX_MEMORY);
    if memory <= available {
        return;
    }
    let mut report = |span: Span, what: String, help: &str| {
        let message = format!(
            "the model requires about {} of memory, most of it for {what}; available are {}",
            size(memory),
            size(available)
        );
        problems.push(Problem::error(span, message).help(help));
    };
    let shells = document.shells.iter().map(|shell| (&shell.name, &shell.mesh));
    let solids = document.elastic_solids.iter().map(|solid| (&solid.name, &solid.mesh));
    let largest = [
        ("shell", of_shells, shells.max_by_key(|(_, mesh)| mesh.positions.len())),
        ("solid", of_solids, solids.max_by_key(|(_, mesh)| mesh.positions.len())),
    ];
    for (kind, own, largest) in largest {
        if let Some((name, mesh)) = largest.filter(|_| 2.0 * own > memory) {
            let what = format!("the {} elements of {kind} `{}`", mesh.elements.len(), name.value);
            return report(name.span, what, "use fewer elements, or a machine with more memory");
        }
    }
    let masses = document.point_masses.iter().map(|mass| mass.name.span);
    if let Some(first) = document.bodies.iter().map(|body| body.name.span).chain(masses).next()
        && (2.0 * of_bodies > memory || document.beams.is_empty())
    {
        let count = document.bodies.len() + document.point_masses.len();
        let what = format!("its {count} bodies and point masses with {} joints", document.joints.len());
        return report(first, what, "use fewer bodies, or a machine with more memory");
    }
    let Some(largest) = document.beams.iter().max_by(|a, b| nodes(a).total_cmp(&nodes(b))) else { return };
    let what = format!("the {} elements of beam `{}`", largest.elements.value, largest.name.value);
    let help = "use fewer elements, ten per beam are usual, or a machine with more memory";
    report(largest.elements.span, what, help);
}

fn steps(document: &Document, problems: &mut Vec<Problem>) {
    let analysis = &document.analysis;
    let duration = analysis.end - analysis.start;
    let (steps, span) = match &analysis.kind {
        AnalysisKind::Dynamics { step, control: None } => (duration / step.value, step.span),
        // Steps of chosen size are few, and load steps are limited by the reader.
        _ => return,
    };
    let rows = steps / analysis.records.output_every.unwrap_or(1) as f64;
    let columns = 1.0 + 3.0 * document.outputs.len() as f64;
    let table = PER_NUMBER * rows * columns;
    if steps > MAX_STEPS {
        let message = format!("the analysis requires {steps:.1e} steps: at 10 µs each they take {} hours", {
            (steps * 1e-5 / 3600.0).round()
        });
        problems.push(Problem::error(span, message).help("choose a larger `step` or an earlier `end`"));
    } else if table > MAX_TABLE {
        let message = format!("{rows:.1e} rows of results would require about {} of disk space", size(table));
        let help = "record fewer of them with `output_every`, or choose a larger `step` or an earlier `end`";
        problems.push(Problem::error(span, message).help(help));
    }
}

/// Bytes in words.
fn size(bytes: f64) -> String {
    match bytes {
        bytes if bytes < 1e9 => format!("{:.0} MB", bytes / 1e6),
        bytes if bytes < 1e12 => format!("{:.1} GB", bytes / 1e9),
        bytes => format!("{:.1} TB", bytes / 1e12),
    }
}

#[cfg(test)]
#[path = "../../tests/unit/lower/resource_limits.rs"]
mod tests;
