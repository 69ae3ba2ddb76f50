//! The contents of `summary.json`: the request and its result. Scripts read these names.

use std::fmt::Display;

use crate::start::{Assembly, Brought, Lowered, MovedPart, lower_with_units, warnings_of};
use lissom_core::assembly::Gap;
use lissom_core::diagnostics::Diagnose;
use lissom_core::elements::Energy;
use lissom_core::errors::InitialError;
use lissom_core::kinematics::Subject;
use lissom_core::scaling::Representative;
use lissom_core::simulation::Simulation;
use lissom_model::Document;
use lissom_model::output::Column;
use lissom_model::output::Summary;
use lissom_model::sweep::{Accumulator, OF_FATIGUE, STATISTICS};
use serde_json::{Value, json};

use crate::diagnostic::{self, with_code};
use crate::model_text::Model;
use crate::run::report::RunReport;
use crate::session::{Session, columns};

/// Laws at whose kinks and jumps most steps ended that are listed.
const MAX_LAWS: usize = 5;

pub(crate) fn insert(summary: &mut Summary, name: &str, fact: Value) {
    summary.insert(name, fact).expect("a JSON value can be written as JSON");
}

/// Contents for an analysis without time steps before it has a result: it is reported as failed until then.
pub fn of_request(analysis: &str, model: &Model, document: &Document) -> Summary {
    let mut summary = Summary::new();
    let mut insert = |name: &str, fact: Value| insert(&mut summary, name, fact);
    insert("model", json!(model.name()));
    insert("title", json!(document.title));
    insert("version", json!(crate::VERSION));
    insert("analysis", json!(analysis));
    insert("set", of_overrides(model));
    insert("stopped", json!("failed"));
    if document.assembly.is_some()
        && let Ok(Lowered { assembly: Some(assembly), .. }) = lower_with_units(document)
    {
        insert("assembly", of_assembly(&assembly));
    }
    add_warnings_of_model(&mut summary, document);
    summary
}

/// Paths and values of the overrides.
fn of_overrides(model: &Model) -> Value {
    model.overrides().iter().map(|(path, value)| (path.clone(), json!(value))).collect()
}

/// Paths that were omitted from the model's text, if any.
pub fn of_left_out(summary: &mut Summary, model: &Model) {
    if !model.left_out().is_empty() {
        insert(summary, "unset", json!(model.left_out()));
    }
}

/// Contents that are known before the first step. A run that cannot start is reported as failed, with `steps` zero;
/// [`of_run`] replaces this.
pub fn of_model(model: &Model, document: &Document, lowered: &Lowered) -> Summary {
    let Lowered { system, settings, plan, channels, .. } = lowered;
    let layout = system.layout();
    let multipliers = layout.multiplier_rows().len();
    let mut summary = Summary::new();
    let mut insert = |name: &str, fact: Value| insert(&mut summary, name, fact);
    insert("model", json!(model.name()));
    insert("title", json!(document.title));
    insert("version", json!(crate::VERSION));
    insert("set", of_overrides(model));
    insert("stopped", json!("failed"));
    insert("time", json!(plan.start));
    insert("start", json!(plan.start));
    insert("end", json!(plan.end));
    insert("scheme", json!(settings.scheme.name));
    insert("step_size", json!(settings.step_size));
    insert("planned_steps", if plan.is_controlled { Value::Null } else { json!(plan.steps) });
    insert("relative_tolerance", json!(settings.control.map(|control| control.relative_tolerance)));
    insert("steps", json!(0));
    let scaling = &settings.scaling;
    insert(
        "scaling",
        json!({
            "by": scaling.by.name(),
            "equilibrated": scaling.equilibrates(),
            "augmented": scaling.augmented,
            "penalty": scaling.penalty,
        }),
    );
    insert("solver", json!(settings.solver.name));
    insert("threads", json!(settings.threads));
    insert("tolerance", json!(settings.limits.tolerance));
    insert("bodies", json!(document.bodies.len() + document.point_masses.len()));
    insert("beams", json!(document.beams.len()));
    insert("shells", json!(document.shells.len()));
    insert("solids", json!(document.elastic_solids.len()));
    insert("superelements", json!(document.superelements.len()));
    insert(
        "elements",
        json!(
            document.beams.iter().map(|beam| beam.elements.value).sum::<usize>()
                + document.meshes().map(|(_, mesh)| mesh.elements.len()).sum::<usize>()
        ),
    );
    insert("nodes", json!(layout.node_count() - 1));
    insert("joints", json!(document.joints.len()));
    insert("unknowns", json!(layout.size()));
    insert("multipliers", json!(multipliers));
    let columns = columns(channels);
    let column = |column: &crate::Column| {
        let is_unique = !lowered.not_unique.contains(&column.name());
        json!({ "name": column.name(), "quantity": column.quantity, "unit": column.unit, "plot": column.plot, "unique": is_unique })
    };
    insert("columns", columns.iter().map(column).collect());
    if let Some(assembly) = &lowered.assembly {
        insert("assembly", of_assembly(assembly));
    }
    add_warnings_of_model(&mut summary, document);
    summary
}

/// The displacements by which joints were closed.
pub(crate) fn of_assembly(assembly: &Assembly) -> Value {
    let gap = |gap: &Gap| json!({ "joint": gap.joint, "distance": gap.distance, "angle": gap.angle });
    let moved =
        |moved: &MovedPart| json!({ "part": moved.part, "distance": moved.distance, "turn": moved.turn });
    let brought =
        |own: &Brought| json!({ "coordinate": own.coordinate, "value": own.value, "unit": own.unit });
    json!({
        "closed": assembly.closed.iter().map(gap).collect::<Vec<_>>(),
        "moved": assembly.moved.iter().map(moved).collect::<Vec<_>>(),
        "brought": assembly.brought.iter().map(brought).collect::<Vec<_>>(),
        "left": assembly.left,
        "least_change": assembly.is_least,
    })
}

/// Adds warnings as texts and, in the same order, as data.
pub(crate) fn add_warnings<'w, W: Diagnose + 'w>(
    summary: &mut Summary,
    warnings: impl IntoIterator<Item = &'w W>,
) {
    append(summary, warnings.into_iter().map(|warning| (with_code(warning), diagnostic::facts(warning))));
}

fn add_warnings_of_model(summary: &mut Summary, document: &Document) {
    let texts = document.warnings.problems().map(|problem| problem.message.clone());
    append(summary, texts.zip(warnings_of(&document.warnings).map(|warning| diagnostic::facts(&warning))));
}

fn append(summary: &mut Summary, warnings: impl Iterator<Item = (String, Value)>) {
    let known = |name: &str| summary.get(name).and_then(Value::as_array).cloned().unwrap_or_default();
    let (mut texts, mut facts) = (known("warnings"), known("diagnostics"));
    for (text, fact) in warnings {
        texts.push(json!(text));
        facts.push(fact);
    }
    insert(summary, "warnings", Value::Array(texts));
    insert(summary, "diagnostics", Value::Array(facts));
}

/// Records that a run has begun, which remains in the summary if it is killed.
pub fn of_beginning(summary: &mut Summary) {
    insert(summary, "stopped", json!("running"));
}

/// The laws at whose kinks and jumps most steps ended.
fn of_laws(simulation: &Simulation) -> Value {
    let law = |(law, steps): &(Subject, usize)| json!({ "law": law.to_string(), "steps": steps });
    simulation.laws_that_end_steps(MAX_LAWS).iter().map(law).collect()
}

/// Adds the result of a run.
pub fn of_run(summary: &mut Summary, session: &Session, report: &RunReport) {
    let simulation = session.simulation();
    let totals = &report.totals;
    add_warnings(summary, session.warnings());
    let mut insert = |name: &str, fact: Value| insert(summary, name, fact);
    insert("stopped", json!(report.stopped.name()));
    insert("stopped_by", json!(session.stopped_by()));
    if session.plan().is_static {
        let fact = |(time, directions): &(f64, Option<usize>)| json!({ "time": time, "unstable_directions": directions });
        insert("stability", simulation.stability().iter().map(fact).collect());
    }
    insert("events", of_events(session));
    if let Some(error) = report.error() {
        insert("error", json!(error.to_string()));
        insert("failure", diagnostic::facts(error));
    }
    insert("time", json!(report.time));
    insert("records", json!(report.records));
    insert("steps", json!(totals.steps));
    insert("rejected_steps", json!(totals.rejected_steps));
    insert("laws_that_end_steps", of_laws(simulation));
    insert("stagnated_steps", json!(totals.stagnated_steps));
    insert("newton_iterations", json!(totals.newton_iterations));
    insert("factorizations", json!(totals.factorizations));
    let name_of = |row: usize| simulation.system().layout().name_of(row);
    insert("fell_back_at", json!(totals.fell_back_at.map(name_of)));
    insert("yielded_at", json!(totals.regularized_at.map(name_of)));
    insert("factor_entries", json!(simulation.factor_entries()));
    insert("smallest_relative_pivot", json!(totals.smallest_relative_pivot));
    insert("wall_seconds", json!(report.wall.as_secs_f64()));
    insert("solve_seconds", json!(report.solving.as_secs_f64()));
    let seconds = &report.seconds;
    insert(
        "seconds",
        json!({
            "start": seconds.start,
            "evaluation": seconds.evaluation,
            "linearisation": seconds.linearisation,
            "factorisation": seconds.factorisation,
            "solve": seconds.solve,
            "rest": seconds.rest,
            "output": seconds.output,
        }),
    );
    insert("max_constraint_violation", json!(report.violation));
    insert("max_carried_violation", json!(totals.max_constraint_violation));
    insert("velocity_correction", json!(simulation.velocity_correction()));
    let (energy, energy_balance) = (&report.energy, simulation.energy_balance());
    insert(
        "energy",
        json!({
            "start": of_energy(&energy.start),
            "end": of_energy(&energy.end),
            "largest_change": energy.largest,
            "work_of_loads": energy_balance.loads,
            "work_of_drives": energy_balance.drives,
            "lost_in_latches": energy_balance.latches,
            "surplus": energy_balance.surplus,
            "lost": energy_balance.lost,
            "turned_over": energy_balance.turned_over,
        }),
    );
    match session.histories() {
        Ok(histories) => insert("statistics", statistics(session.columns(), &histories)),
        Err(error) => {
            insert("statistics", Value::Null);
            insert("statistics_error", json!(format!("{}; {}", error.message, error.remedy)));
        }
    }
    let scaling = &simulation.settings().scaling;
    insert(
        "scaling",
        json!({
            "by": scaling.by.name(),
            "equilibrated": scaling.equilibrates(),
            "augmented": scaling.augmented,
            "penalty": scaling.penalty,
            "scale": session.scale(),
        }),
    );
    let [start, end] = report.conditions;
    let range = session.telemetry().condition_range();
    insert(
        "tangent",
        json!({
            "condition_estimate": {
                "start": start,
                "end": end,
                "least": range.map(|range| range.0),
                "most": range.map(|range| range.1),
            },
            "smallest_relative_pivot": totals.smallest_relative_pivot,
            "scale": session.scale(),
            "penalty": if scaling.augmented { scaling.penalty } else { 0.0 },
        }),
    );
    let Representative { mass, damping, stiffness, length } = *simulation.representative();
    insert(
        "representative",
        json!({ "mass": mass, "damping": damping, "stiffness": stiffness, "length": length }),
    );
}

/// Adds a failure: its message, and its code, values and remedy.
pub fn of_failure(summary: &mut Summary, error: &(impl Diagnose + Display)) {
    insert(summary, "error", json!(error.to_string()));
    insert(summary, "failure", diagnostic::facts(error));
}

/// Adds the reason why a run could not start.
pub fn of_failed_start(summary: &mut Summary, error: &InitialError) {
    insert(summary, "stopped", json!("failed"));
    of_failure(summary, error);
    for name in ["records", "rejected_steps", "stagnated_steps", "newton_iterations", "factorizations"] {
        insert(summary, name, json!(0));
    }
    // The names are always present, so that scripts need not check.
    for name in [
        "fell_back_at",
        "yielded_at",
        "factor_entries",
        "smallest_relative_pivot",
        "wall_seconds",
        "solve_seconds",
        "seconds",
        "max_constraint_violation",
        "max_carried_violation",
        "velocity_correction",
        "energy",
        "statistics",
        "representative",
    ] {
        insert(summary, name, Value::Null);
    }
}

/// Number of occurrences of each event, and the first and last time.
fn of_events(session: &Session) -> Value {
    let mut facts = serde_json::Map::new();
    for event in session.simulation().system().signals().events() {
        let times: Vec<f64> =
            session.events().filter(|(name, _)| *name == event.name).map(|(_, time)| time).collect();
        let fact = json!({ "count": times.len(), "first": times.first(), "last": times.last() });
        facts.insert(event.name.clone(), fact);
    }
    Value::Object(facts)
}

/// Statistics of each column, as in sweeps; `null` if a record is not finite.
fn statistics(columns: &[Column], histories: &[Accumulator]) -> Value {
    let of = |column: &Column, history: &Accumulator| -> Value {
        let asked = STATISTICS.iter().filter(|known| known.name != OF_FATIGUE || column.fatigue.is_some());
        asked.map(|statistic| (statistic.name.to_owned(), json!(statistic.of(history)))).collect()
    };
    columns.iter().zip(histories).map(|(column, history)| (column.name(), of(column, history))).collect()
}

fn of_energy(energy: &Energy) -> Value {
    json!({
        "kinetic": energy.kinetic,
        "strain": energy.strain,
        "potential": energy.potential,
        "total": energy.total(),
    })
}
