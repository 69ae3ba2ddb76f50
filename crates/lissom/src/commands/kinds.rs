//! `lissom kinds`: kinds and keys of model files, from the registry.

use std::fmt::Write;

use clap::Args;
use lissom_core::kinematics::Quantity;
use lissom_core::registry::{Parameter, ParameterType};
use lissom_model::lower::registry::registry;
use lissom_model::registry::{ActsOn, ChoiceEntry, FrameRule, KindEntry, Registry};
use lissom_model::{topic, topics};
use serde_json::{Value, json};

use super::{Exit, Failure};
use crate::terminal;

/// List the kinds of model files with their parameters and samples, and the keys of every table.
#[derive(Args)]
#[command(after_help = "\
Examples:
  lissom kinds                    everything
  lissom kinds revolute           one kind
  lissom kinds --json             joints, springs, loads, schemes and solvers for programs
  lissom kinds output             all kinds of outputs and their keys; also section, beam, part, function …")]
pub(super) struct Kinds {
    /// Show only kinds whose name contains this word, or the tables or functions of this name.
    name: Option<String>,

    /// Print kinds, schemes and solvers with their parameters as one JSON object.
    #[arg(long)]
    json: bool,
}

impl Kinds {
    pub(super) fn run(self) -> Result<Exit, Failure> {
        let registry = registry();
        let wanted = self.name.as_deref().unwrap_or_default();
        if self.json {
            return for_programs(&registry, wanted);
        }
        let mut text = String::new();
        let parts =
            [("joints", &registry.joints), ("springs", &registry.springs), ("loads", &registry.loads)];
        for (table, kinds) in parts {
            let entries =
                kinds.iter().filter(|kind| kind.name.contains(wanted)).map(|kind| of_kind(table, kind));
            section(&mut text, &format!("[{table}.*]  kind = \"…\""), entries);
        }
        let choices = [("scheme", &registry.schemes), ("solver", &registry.solvers)];
        for (word, choices) in choices {
            let entries = choices.iter().filter(|choice| choice.name.contains(wanted)).map(of_choice);
            section(&mut text, &format!("[analysis]  {word} = \"…\"  (the first is the default)"), entries);
        }
        if let Some(topic) = topic(&registry, wanted) {
            text = if text.is_empty() { topic } else { format!("{text}\n{topic}") };
        }
        if wanted.is_empty() {
            // Writing to a string cannot fail.
            let _ = writeln!(text, "\nSee also `lissom kinds WORD` for: {}", topics().join(", "));
        }
        if text.is_empty() {
            let message = format!(
                "there is no kind whose name contains `{wanted}`; see `lissom kinds`, or `lissom kinds` with one of {}",
                topics().join(", ")
            );
            return Err(Failure::request(message));
        }
        terminal::print(&text);
        Ok(Exit::Done)
    }
}

/// All kinds whose name contains `wanted`, as JSON.
fn for_programs(registry: &Registry, wanted: &str) -> Result<Exit, Failure> {
    let parameter = |parameter: &Parameter| {
        json!({
            "name": parameter.name,
            "holds": holds(parameter.holds),
            "unit": parameter.unit,
            "required": parameter.required,
            "summary": parameter.summary,
        })
    };
    let list = |parameters: &[Parameter]| parameters.iter().map(parameter).collect::<Value>();
    let mut all = json!({});
    let mut count = 0;
    for (table, kinds) in
        [("joints", &registry.joints), ("springs", &registry.springs), ("loads", &registry.loads)]
    {
        let kind = |kind: &KindEntry| {
            json!({
                "name": kind.name,
                "summary": kind.summary,
                "acts_on": place(kind.acts_on).0,
                "parameters": list(kind.parameters),
                "sample": kind.sample,
            })
        };
        let found: Vec<Value> = kinds.iter().filter(|kind| kind.name.contains(wanted)).map(kind).collect();
        count += found.len();
        all[table] = found.into();
    }
    for (word, choices) in [("schemes", &registry.schemes), ("solvers", &registry.solvers)] {
        let choice = |choice: &ChoiceEntry| json!({ "name": choice.name, "summary": choice.summary, "parameters": list(choice.parameters) });
        let found: Vec<Value> =
            choices.iter().filter(|choice| choice.name.contains(wanted)).map(choice).collect();
        count += found.len();
        all[word] = found.into();
    }
    if count == 0 {
        let message = format!("there is no kind whose name contains `{wanted}`; see `lissom kinds`");
        return Err(Failure::request(message));
    }
    terminal::print(&format!("{all:#}\n"));
    Ok(Exit::Done)
}

fn section(text: &mut String, heading: &str, entries: impl Iterator<Item = String>) {
    let mut entries = entries.peekable();
    if entries.peek().is_none() {
        return;
    }
    if !text.is_empty() {
        text.push('\n');
    }
    text.push_str(heading);
    text.push('\n');
    text.extend(entries);
}

fn of_kind(table: &str, kind: &KindEntry) -> String {
    let (place, sample) = place(kind.acts_on);
    let mut text = format!("\n  {}: {}\n    acts on     {place}\n", kind.name, kind.summary);
    parameters(&mut text, kind.parameters);
    let name = table.strip_suffix('s').unwrap_or(table);
    // Writing to a string cannot fail.
    let _ = writeln!(text, "    sample      [{table}.my_{name}]");
    for line in std::iter::once(&*format!("kind = \"{}\"", kind.name))
        .chain(sample.lines())
        .chain(kind.sample.lines())
    {
        let _ = writeln!(text, "                {line}");
    }
    text
}

fn of_choice(choice: &ChoiceEntry) -> String {
    let mut text = format!("\n  {}: {}\n", choice.name, choice.summary);
    parameters(&mut text, choice.parameters);
    text
}

fn parameters(text: &mut String, parameters: &[Parameter]) {
    for (index, parameter) in parameters.iter().enumerate() {
        let heading = if index == 0 { "parameters" } else { "" };
        let unit = if parameter.unit.is_empty() { String::new() } else { format!(" [{}]", parameter.unit) };
        let need = if parameter.required { "" } else { ", optional" };
        // Writing to a string cannot fail.
        let _ = writeln!(
            text,
            "    {heading:<11} {}: {}{unit}{need}. {}",
            parameter.name,
            holds(parameter.holds),
            parameter.summary
        );
    }
}

fn holds(holds: ParameterType) -> String {
    match holds {
        ParameterType::Number => "number".to_owned(),
        ParameterType::Positive => "positive number".to_owned(),
        ParameterType::NotNegative => "number, not negative".to_owned(),
        ParameterType::Vector | ParameterType::GlobalVector => "three numbers".to_owned(),
        ParameterType::Direction | ParameterType::DirectionOr(_) => "direction".to_owned(),
        ParameterType::Flag => "true or false".to_owned(),
        ParameterType::Function => "number or expression of t".to_owned(),
        ParameterType::Size => "number or expression of t, inputs, signals, states and outputs".to_owned(),
        ParameterType::Force([first, second]) => {
            format!("number, expression of {first} and {second}, or table over {first}")
        }
        ParameterType::Matrix => "six numbers or 6 x 6 matrix".to_owned(),
        ParameterType::Range => "two ascending numbers".to_owned(),
        ParameterType::Choice(words) => words.join(" | "),
        ParameterType::FunctionOf(variable) => format!("number, expression of {variable} or table"),
        ParameterType::Input => "name of an input".to_owned(),
        ParameterType::Equation => "expression of coordinates, such as arm.angle, and of t".to_owned(),
        ParameterType::Numbers => "list of numbers".to_owned(),
        ParameterType::SquareMatrix => "number, diagonal or square matrix by rows".to_owned(),
        ParameterType::Choices(words) => format!("list of {}", words.join(", ")),
    }
}

/// The keys of a kind's attachment, and a sample of the required ones.
fn place(acts_on: ActsOn) -> (&'static str, &'static str) {
    const TWO: &str = "base = \"ground\"\ntip = \"my_body\"\nat = [0.0, 0.0, 0.0]";
    const PLACES: &str = "base = \"ground\"\ntip = \"my_body\"\nat_base = [0.0, 0.0, 0.0]";
    match acts_on {
        ActsOn::TwoNodes(FrameRule::None) => ("base, tip, at (default: the tip's position)", TWO),
        ActsOn::TwoNodes(FrameRule::Axis) => ("base, tip, at (default: the tip's position), axis", TWO),
        ActsOn::TwoNodes(FrameRule::TwoAxes) => {
            ("base, tip, at (default: the tip's position), axis, second_axis", TWO)
        }
        ActsOn::TwoNodes(FrameRule::GivenOrGlobal) => (
            "base, tip, at (default: the tip's position), axis and second_axis (default: global x and y)",
            TWO,
        ),
        ActsOn::TwoPlaces => ("base, tip, at_base, at_tip (default: the nodes' positions)", PLACES),
        ActsOn::Places => (
            "along: the points over which it passes, each with `on` and `at`; drums: coordinates that pay it out",
            "along = [{ on = \"ground\", at = [0.0, 0.0, 3.0] }, { on = \"my_body\" }]",
        ),
        ActsOn::OneNode => ("on, at (default: the node's position)", "on = \"my_body\""),
        ActsOn::TwoJointCoordinates => (
            "joint, other: the joints whose coordinates it relates",
            "joint = \"my_hinge\"\nother = \"my_slide\"",
        ),
        ActsOn::NamedCoordinates => ("the coordinates that its expression names", ""),
        ActsOn::Coordinates => (
            "coordinates: joint coordinates on which it acts, in the order of its matrices",
            "coordinates = [\"my_hinge.angle\", \"my_slide.displacement\"]",
        ),
        ActsOn::AlongBeams => {
            ("beams, tip, at (default: the tip's position)", "beams = [\"my_beam\"]\ntip = \"my_body\"")
        }
        ActsOn::Nothing => ("nothing: it has coordinates of its own", ""),
        ActsOn::JointCoordinate(Quantity::Angle) => {
            ("joint: acts on its relative rotation", "joint = \"my_hinge\"")
        }
        ActsOn::JointCoordinate(Quantity::Length | Quantity::State) => {
            ("joint: acts on its relative displacement", "joint = \"my_slide\"")
        }
    }
}
