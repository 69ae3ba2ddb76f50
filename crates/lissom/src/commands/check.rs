//! `lissom check`: says what a model is made of and what is wrong with it, without simulating it.

use std::fmt::Write;

use clap::Args;
use lissom::Document;
use lissom_core::analysis::mobility::{Mobility, Redundant, mobility};
use lissom_model::lower::{Lowered, lower};

use super::{Exit, Failure, ModelArguments, show_warnings};
use crate::terminal;

/// Check a model without simulating it: mistakes, size, degrees of freedom, redundant constraints.
#[derive(Args)]
#[command(after_help = "\
Examples:
  lissom check examples/four-bar.toml
  lissom check examples/tip-crank.toml --set beams.beam.elements=16

Exit code: 0 the model can be run, 2 it cannot. Redundant constraints are a warning.")]
pub(super) struct Check {
    #[command(flatten)]
    model: ModelArguments,
}

impl Check {
    pub(super) fn run(self) -> Result<Exit, Failure> {
        let (model, document) = self.model.read()?;
        show_warnings(&document);
        let lowered = lower(&document)?;
        let freedom = mobility(&lowered.system, &lowered.state);
        terminal::print(&told(model.name(), &document, &lowered, &freedom));
        for redundant in &freedom.redundant {
            terminal::complain(&warning(redundant));
        }
        Ok(Exit::Done)
    }
}

fn count(number: usize, one: &str, many: &str) -> String {
    format!("{number} {}", if number == 1 { one } else { many })
}

fn told(name: &str, document: &Document, lowered: &Lowered, freedom: &Mobility) -> String {
    let layout = lowered.system.layout();
    let (plan, settings) = (&lowered.plan, &lowered.settings);
    let mut text = match &document.title {
        Some(title) => format!("{name}: {title}\n"),
        None => format!("{name}\n"),
    };
    let mut line = |name: &str, words: String| {
        // Writing to a string cannot fail.
        let _ = writeln!(text, "  {name:<10}{words}");
    };
    let elements: usize = document.beams.iter().map(|beam| beam.elements.value).sum();
    line(
        "parts",
        [
            count(document.bodies.len(), "body", "bodies"),
            count(document.point_masses.len(), "point mass", "point masses"),
            format!(
                "{} of {}",
                count(document.beams.len(), "beam", "beams"),
                count(elements, "element", "elements")
            ),
            count(layout.node_count() - 1, "node", "nodes"),
        ]
        .join(", "),
    );
    line(
        "linked by",
        [
            count(document.joints.len(), "joint", "joints"),
            count(document.springs.len(), "spring", "springs"),
            count(document.loads.len(), "load", "loads"),
        ]
        .join(", "),
    );
    line(
        "unknowns",
        format!(
            "{}: {} coordinates ({} algebraic), {} multipliers",
            layout.size(),
            layout.coordinate_count(),
            lowered.state.kinematics.coordinates.len(),
            freedom.constraints
        ),
    );
    line(
        "freedoms",
        format!(
            "{}: {} coordinates less {} independent constraints of {}",
            freedom.freedoms, freedom.coordinates, freedom.rank, freedom.constraints
        ),
    );
    let kind = if plan.is_static { "load steps" } else { "steps" };
    line(
        "analysis",
        format!(
            "{} … {} s in {} {kind} of {} s, {}, solver {}",
            plan.start, plan.end, plan.steps, settings.step_size, settings.scheme.name, settings.solver.name
        ),
    );
    let columns: usize = lowered.channels.iter().map(|channel| channel.components.len()).sum();
    line("outputs", format!("{columns} columns of {}", count(lowered.channels.len(), "output", "outputs")));
    text
}

fn warning(redundant: &Redundant) -> String {
    let Redundant { joint, equation, among } = redundant;
    let others: Vec<String> = among.iter().map(|name| format!("`{name}`")).collect();
    let others = if others.is_empty() { "its own other equations".to_owned() } else { others.join(", ") };
    format!("warning: redundant constraint: {equation} of joint `{joint}` follows from {others}\n")
}
