//! `lissom check`: reports the contents and the errors of a model, without simulating it.

use std::fmt::Write;

use clap::Args;
use lissom::analyses::path::varied_number;
use lissom::core::consistent::mobility::mobility;
use lissom::core::consistent::{Mobility, Redundant};
use lissom::core::errors::Warning;
use lissom::model::document::AnalysisKind;
use lissom::model::lower::check_run;
use lissom::start::{Lowered, lower_with_units};
use lissom::{AnalysisWarning, Document, Report, Session};
use serde_json::{Value, json};

use super::model_arguments::ModelArguments;
use super::outcome::{Exit, Failure, show_warnings, warn};
use super::terminal;

/// Check a model without simulating it: errors, size, degrees of freedom, redundant constraints.
#[derive(Args)]
#[command(after_help = "\
Examples:
  lissom check examples/four-bar.toml
  lissom check examples/tip-crank.toml --set beams.beam.elements=16
  lissom check model.toml --json               for programs: counts, redundant constraints, problems with their lines

Redundant constraints are a warning.
Exit code: 0 the model can be run; 2 it cannot.")]
pub(super) struct Check {
    #[command(flatten)]
    model: ModelArguments,

    /// Print one JSON object instead of text; it includes errors and warnings of the model.
    #[arg(long)]
    json: bool,
}

impl Check {
    pub(super) fn run(self) -> Result<Exit, Failure> {
        if self.json {
            return self.run_for_programs();
        }
        let (model, document) = self.model.read()?;
        show_warnings(&document);
        check_run(&document)?;
        let lowered = lower_with_units(&document)?;
        varied_number(&model, &document)?;
        let freedom = mobility(&lowered.system, &lowered.state);
        terminal::print(&render(model.name(), &document, &lowered, &freedom));
        for redundant in &freedom.redundant {
            warn(&warning(redundant));
        }
        // Errors of a run before its first step are reported here as well.
        let session = Session::start(lowered).map_err(|error| Failure::new(Exit::BadModel, &error))?;
        for warning in session.warnings() {
            warn(warning);
        }
        Ok(Exit::Done)
    }
}

impl Check {
    fn run_for_programs(&self) -> Result<Exit, Failure> {
        let (facts, exit) = self.facts()?;
        terminal::print(&format!("{facts:#}\n"));
        Ok(exit)
    }

    /// Facts about the model, and whether it can be run.
    fn facts(&self) -> Result<(Value, Exit), Failure> {
        let model = self.model.text()?;
        let wrong = |report: &Report| (json!({ "ok": false, "problems": report.to_value() }), Exit::BadModel);
        let document = match model.document() {
            Ok(document) => document,
            Err(report) => return Ok(wrong(&report)),
        };
        let lowered = match check_run(&document).and_then(|()| lower_with_units(&document)) {
            Ok(lowered) => lowered,
            Err(report) => return Ok(wrong(&report)),
        };
        if let Err(report) = varied_number(&model, &document) {
            return Ok(wrong(&report));
        }
        let freedom = mobility(&lowered.system, &lowered.state);
        let redundant = |redundant: &Redundant| json!({ "joint": redundant.joint, "equation": redundant.equation, "among": redundant.among, "direction": redundant.direction });
        let layout = lowered.system.layout();
        let mut facts = json!({
            "name": model.name(),
            "title": document.title,
            "analysis": document.analysis.kind.name(),
            "bodies": document.bodies.len(),
            "point_masses": document.point_masses.len(),
            "beams": document.beams.len(),
            "shells": document.shells.len(),
            "solids": document.elastic_solids.len(),
            "superelements": document.superelements.len(),
            "elements": document.beams.iter().map(|beam| beam.elements.value).sum::<usize>(),
            "nodes": layout.node_count() - 1,
            "joints": document.joints.len(),
            "springs": document.springs.len(),
            "loads": document.loads.len(),
            "local_loads": document.local_loads.len(),
            "contacts": document.contacts.len(),
            "unknowns": layout.size(),
            "states": layout.state_count(),
            "freedoms": freedom.freedoms,
            "coordinates": freedom.coordinates,
            "constraints": freedom.constraints,
            "independent_constraints": freedom.rank,
            "redundant": freedom.redundant.iter().map(redundant).collect::<Vec<_>>(),
            "rotors": rotors(&lowered),
            "outputs": lowered.channels.iter().map(|channel| channel.name.as_str()).collect::<Vec<_>>(),
            "problems": document.warnings.to_value(),
        });
        // Errors of a run before its first step are reported here as well.
        let exit = match Session::start(lowered) {
            Ok(session) => {
                let fact =
                    |warning: &Warning| json!({ "code": warning.code(), "message": warning.to_string() });
                facts["ok"] = json!(true);
                facts["warnings"] = session.warnings().map(fact).collect();
                Exit::Done
            }
            Err(error) => {
                facts["ok"] = json!(false);
                facts["error"] = json!(error.to_string());
                Exit::BadModel
            }
        };
        Ok((facts, exit))
    }
}

fn count(number: usize, one: &str, many: &str) -> String {
    format!("{number} {}", if number == 1 { one } else { many })
}

fn render(name: &str, document: &Document, lowered: &Lowered, freedom: &Mobility) -> String {
    let mut text = match &document.title {
        Some(title) => format!("{name}: {title}\n"),
        None => format!("{name}\n"),
    };
    let lines = [
        ("parts", parts(document, lowered)),
        ("linked by", links(document)),
        ("unknowns", unknowns(lowered, freedom)),
        (
            "freedoms",
            format!(
                "{}: {} coordinates less {} independent constraints of {}",
                freedom.freedoms, freedom.coordinates, freedom.rank, freedom.constraints
            ),
        ),
        ("analysis", analysis(document, lowered)),
        ("outputs", outputs(lowered)),
    ];
    let assembly = lowered.assembly.as_ref().map(|assembly| ("assembly", assembly.words()));
    let round = rotors(lowered);
    let round =
        (!round.is_empty()).then(|| ("rotors", format!("{}, whose spin limits no step", round.join(", "))));
    for (name, words) in lines.into_iter().chain(assembly).chain(round) {
        // Writing to a string cannot fail.
        let _ = writeln!(text, "  {name:<10}{words}");
    }
    text
}

/// Names of the nodes that are symmetric about an axis, with all on them.
fn rotors(lowered: &Lowered) -> Vec<&str> {
    let layout = lowered.system.layout();
    layout.rotors.iter().map(|rotor| layout.node_name(rotor.node)).collect()
}

fn parts(document: &Document, lowered: &Lowered) -> String {
    let elements: usize = document.beams.iter().map(|beam| beam.elements.value).sum();
    let shells = match document.shells.len() {
        0 => String::new(),
        number => {
            let elements: usize = document.shells.iter().map(|shell| shell.mesh.elements.len()).sum();
            let shells = count(number, "shell", "shells");
            format!("{shells} of {}, ", count(elements, "quadrilateral", "quadrilaterals"))
        }
    };
    let solids = match document.elastic_solids.len() {
        0 => String::new(),
        number => {
            let elements: usize = document.elastic_solids.iter().map(|solid| solid.mesh.elements.len()).sum();
            format!("{} of {}, ", count(number, "solid", "solids"), count(elements, "element", "elements"))
        }
    };
    let superelements = match document.superelements.len() {
        0 => String::new(),
        number => format!("{}, ", count(number, "superelement", "superelements")),
    };
    format!(
        "{}, {}, {} of {}, {shells}{solids}{superelements}{}",
        count(document.bodies.len(), "body", "bodies"),
        count(document.point_masses.len(), "point mass", "point masses"),
        count(document.beams.len(), "beam", "beams"),
        count(elements, "element", "elements"),
        // Without the ground.
        count(lowered.system.layout().node_count() - 1, "node", "nodes"),
    )
}

fn links(document: &Document) -> String {
    format!(
        "{}, {}, {}",
        count(document.joints.len(), "joint", "joints"),
        count(document.springs.len(), "spring", "springs"),
        count(document.loads.len(), "load", "loads"),
    )
}

fn unknowns(lowered: &Lowered, freedom: &Mobility) -> String {
    let states = lowered.system.layout().state_count();
    let words = format!(
        "{}: {} coordinates ({} algebraic), {} multipliers",
        lowered.system.layout().size(),
        freedom.coordinates,
        lowered.state.kinematics.coordinates.len() - states,
        freedom.constraints
    );
    if states == 0 { words } else { format!("{words}, {}", count(states, "state", "states")) }
}

fn analysis(document: &Document, lowered: &Lowered) -> String {
    if let AnalysisKind::Modes { count, undeformed, .. } = document.analysis.kind {
        let state = if undeformed { "the undeformed state" } else { "static equilibrium" };
        return format!("{count} natural modes about {state}");
    }
    if let AnalysisKind::Buckling { count } = document.analysis.kind {
        return format!("{count} buckling load factors");
    }
    if let AnalysisKind::Path { end, .. } = document.analysis.kind {
        if let Some(vary) = &document.analysis.vary {
            return format!("equilibrium path along {} to {end}", vary.value);
        }
        return format!("equilibrium path to load factor {end}");
    }
    let (plan, settings) = (&lowered.plan, &lowered.settings);
    let kind = if plan.is_static { "load steps" } else { "steps" };
    if let (Some(control), true) = (&settings.control, plan.is_static) {
        return format!(
            "{} … {} s in load steps with a work error of at most {}, solver {}",
            plan.start, plan.end, control.relative_tolerance, settings.solver.name
        );
    }
    if let Some(control) = &settings.control {
        return format!(
            "{} … {} s in steps chosen for a relative error of {}, {}, solver {}",
            plan.start, plan.end, control.relative_tolerance, settings.scheme.name, settings.solver.name
        );
    }
    format!(
        "{} … {} s in {} {kind} of {} s, {}, solver {}",
        plan.start, plan.end, plan.steps, settings.step_size, settings.scheme.name, settings.solver.name
    )
}

fn outputs(lowered: &Lowered) -> String {
    let columns = lowered.channels.iter().map(|channel| channel.components.len()).sum();
    let outputs = count(lowered.channels.len(), "output", "outputs");
    format!("{outputs}, {}", count(columns, "column", "columns"))
}

fn warning(redundant: &Redundant) -> AnalysisWarning {
    let Redundant { joint, equation, among, direction, .. } = redundant;
    let others: Vec<String> = among.iter().map(|name| format!("`{name}`")).collect();
    let others = if others.is_empty() { "its own other equations".to_owned() } else { others.join(", ") };
    let words = direction.as_ref().map_or(String::new(), |words| format!(": it repeats {words}"));
    let follows = format!("{others}{words}");
    AnalysisWarning::Redundant { joint: joint.clone(), equation: equation.to_string(), follows }
}
