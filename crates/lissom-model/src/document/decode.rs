//! The order in which the tables of a model file are read and checked.

use std::collections::{BTreeMap, BTreeSet};
use std::path::Path;
use std::sync::Arc;

use lissom_mechanics::joints::generalized_coordinates::KIND as FREE;
use lissom_motion::Vector3;

use super::contacts::Parts;
use super::entries::PARTS;
use super::tables::variants;
use super::{
    Document, analysis, assembly, beams, bodies, components, connections, contacts, elastic_solids, events,
    ground, hydraulics, initial, local_loads, materials, outputs, ports, shells, signals, superelements,
    units,
};
use crate::expression;
use crate::files::library::Library;
use crate::format::suggest;
use crate::format::top_level::singular;
use crate::format::top_level::{self, Holds};
use crate::parts;
use crate::parts::context::Context;
use crate::registry::Registry;
use crate::text::report::{Problem, Report, Severity, Span};
use crate::text::{self, Node, Tree, Value};

impl Document {
    /// Reads a model file's text. `file_name` is for messages, and files that the model includes are looked for beside it.
    ///
    /// # Errors
    /// If anything is wrong: a report of all mistakes that could be found.
    pub fn parse(text: &str, file_name: &str, registry: &Registry) -> Result<Self, Report> {
        Self::parse_with(text, file_name, registry, &[])
    }

    /// Reads a model file's text with `overrides` of the form (path, value), such as
    /// `("analysis.step", "1e-4")`; a value that is no TOML counts as a text.
    ///
    /// # Errors
    /// As [`Document::parse`]; also if the path of an override does not exist.
    pub fn parse_with(
        text: &str,
        file_name: &str,
        registry: &Registry,
        overrides: &[(String, String)],
    ) -> Result<Self, Report> {
        let library = Arc::new(Library::beside(Path::new(file_name)));
        from_tree(text::read(text, file_name, overrides, library), registry)
    }
}

/// Reads a tree that is laid out.
pub(crate) fn from_tree(tree: Tree, registry: &Registry) -> Result<Document, Report> {
    if !tree.problems.is_empty() {
        return Err(Report::new(tree.problems, &tree.sources));
    }
    let model = parts::expand(tree).map_err(|(problems, sources)| Report::new(problems, &sources))?;
    let context = Context::new(&model, variants);
    let document = decode(&context, registry);
    let problems = context.into_problems();
    if problems.iter().any(|problem| problem.severity == Severity::Error) {
        return Err(Report::new(problems, &model.sources));
    }
    let warnings = Report::new(problems, &model.sources);
    if let Some(document) = document {
        return Ok(Document { warnings, sources: model.sources, ..document });
    }
    // Every decoder that gives nothing has reported why; this is for the case that one forgot.
    let problem = Problem::error(Span::default(), "the model could not be read");
    Err(Report::new(vec![problem], &model.sources))
}

fn decode(context: &Context<'_>, registry: &Registry) -> Option<Document> {
    // A file of another version may have other words: nothing else is worth reporting.
    version(context)?;
    check_words(context);
    check_names(context);
    let title = title(context);
    let parameters = parameters(context);
    let points = points(context);
    let gravity = context.top("gravity").map_or(Some(Vector3::zeros()), |(node, _)| gravity(context, node));
    let materials = materials::materials(context);
    let sections = materials::sections(context, registry, &materials);
    let bodies = bodies::bodies(context);
    let point_masses = bodies::point_masses(context);
    let shells = shells::shells(context, &materials);
    let elastic_solids = elastic_solids::elastic_solids(context, &materials);
    let of_shells = shells.iter().map(|own| (own.name.value.clone(), Arc::clone(&own.mesh)));
    let of_solids = elastic_solids.iter().map(|own| (own.name.value.clone(), Arc::clone(&own.mesh)));
    let meshes = of_shells.chain(of_solids).collect();
    let superelements = superelements::superelements(context);
    let beams = beams::beams(context, &bodies, &point_masses, &sections, (&meshes, &superelements));
    let places = connections::places((&beams, &superelements), meshes, &bodies, &point_masses);
    let joints = components::read(context, "joints", registry, &places);
    let mut springs = components::read(context, "springs", registry, &places);
    ports::turn_drums(context, &joints, &mut springs);
    let loads = components::read(context, "loads", registry, &places);
    let local_loads = local_loads::local_loads(context);
    let ground = ground::ground(context);
    let parts = Parts { bodies: &bodies, point_masses: &point_masses, ground: ground.as_ref() };
    let contacts = contacts::contacts(context, &parts);
    signals::check_names(context);
    let inputs = signals::inputs(context);
    let signals = signals::signals(context);
    let states = signals::states(context);
    let events = events::events(context);
    let units = units::units(context);
    let (initial, initial_of_parts) = initial::initial(context);
    let assembly = assembly::assembly(context);
    if let Some((_, span)) = context.top("assembly").filter(|_| assembly.is_none()) {
        connections::unread(context, "[assembly]", span);
    }
    let outputs = outputs::outputs(context, registry);
    let analysis = analysis::analysis(context, registry);
    let mut document = Document {
        title,
        gravity: gravity?,
        parameters,
        materials,
        sections,
        points,
        beams,
        shells,
        elastic_solids,
        bodies,
        point_masses,
        superelements,
        joints,
        springs,
        loads,
        local_loads,
        ground: ground?,
        contacts,
        inputs,
        signals,
        states,
        events,
        units,
        hydraulics: Vec::new(),
        initial,
        initial_of_parts,
        assembly,
        outputs,
        analysis: analysis?,
        warnings: Report::new(Vec::new(), context.sources),
        sources: context.sources.clone(),
    };
    connections::check(context, &document, &places);
    events::check(context, &document.analysis);
    hydraulics::add(context, registry, &mut document);
    Some(document)
}

/// Acceleration of gravity. A number, or a table of components, is rejected with the list that was meant.
fn gravity(context: &Context<'_>, node: &Node) -> Option<Vector3> {
    let (found, list) = match &node.value {
        Value::Number(size) => ("number", [0.0, 0.0, -size.abs()]),
        Value::Table(table) => {
            let component = |name: &str| match table.get(name).map(|entry| &entry.node.value) {
                Some(Value::Number(number)) => *number,
                _ => 0.0,
            };
            ("table", ["x", "y", "z"].map(component))
        }
        _ => return context.vector(node, "`gravity`"),
    };
    let [x, y, z] = if list == [0.0; 3] { [0.0, 0.0, -9.81] } else { list };
    let problem = Problem::error(node.span, format!("`gravity` must be a list of 3 numbers, not a {found}"));
    let help = format!("write the acceleration in global axes, such as [{x}, {y}, {z}]");
    context.report(problem.label(format!("this is a {found}")).help(help));
    None
}

/// The version decides how the file is read, so it is checked before anything else.
fn version(context: &Context<'_>) -> Option<()> {
    let Some((node, _)) = context.top("lissom") else {
        let problem = Problem::error(Span::default(), "the file does not specify the version of its format");
        let help = format!("write `lissom = {}` in the first line", top_level::VERSION);
        context.report(problem.label("before this").help(help));
        return None;
    };
    let found = match node.value {
        Value::Number(number) if number.fract() == 0.0 => Some(number),
        _ => None,
    };
    if found == Some(top_level::VERSION as f64) {
        return Some(());
    }
    let message = match found {
        Some(found) => format!("version {found} of the format is not supported"),
        None => "the version of the format must be a whole number".to_owned(),
    };
    let help = format!("this program reads version {0}: write `lissom = {0}`", top_level::VERSION);
    context.fail(node.span, message, help)
}

/// Remedy for a file that specifies units.
const UNITS: &str =
    "remove it, and write lengths in m, masses in kg, times in s, forces in N and angles in rad";

/// Checks the keys at the top level and whether each is a table or a value as required.
fn check_words(context: &Context<'_>) {
    for (word, span, node) in context.tops() {
        let Some(top) = top_level::tops().find(|top| top.name == word) else {
            let help = suggest::help(word, top_level::tops().map(|top| top.name));
            let problem = Problem::error(span, format!("`{word}` is not a key of a model file"));
            context.report(problem.label("unknown").maybe_help(help));
            continue;
        };
        if word == "units" && node.table().is_none() {
            let message = "`units` contains models of other programs, no units of numbers";
            context.fail::<()>(node.span, message, UNITS);
        } else if !matches!(top.holds, Holds::Value(_)) && node.table().is_none() {
            context.wrong_type::<()>(node, &format!("`{word}`"), "a table");
        }
    }
    for top in top_level::tops().filter(|top| top.required && context.top(top.name).is_none()) {
        let message = format!("the model lacks [{}]", top.name);
        let help = if top.name == "analysis" {
            "add it, for example [analysis] with kind = \"dynamics\", end = 1 and step = 1e-3 on lines of their own".to_owned()
        } else {
            format!("add it: {}", top.summary)
        };
        context.report(Problem::error(Span::default(), message).help(help));
    }
    // Generalised coordinates, states and networks change without a part.
    let is_free = |node: &Node| {
        let kind = node.table().and_then(|joint| joint.get("kind"));
        kind.is_some_and(|kind| matches!(&kind.node.value, Value::Text(word) if word == FREE.name))
    };
    let has_free = context.entries("joints").into_iter().any(|(_, _, node)| is_free(node));
    let is_empty = |table: &&str| context.entries(table).is_empty();
    if !has_free && PARTS.iter().chain(&["states", "hydraulics", "units"]).all(is_empty) {
        let problem = Problem::error(
            Span::default(),
            "the model is empty: it has no beam, shell, solid, body, point mass or superelement",
        );
        context.report(problem.help("add for example a table [bodies.top] with mass and inertia"));
    }
}

/// Longest name of a part, output or anything else, with the parts around it [bytes]: names of files have at most 255.
const MAX_NAME: usize = 160;

/// Names must be usable in references such as `beam.end`, and parts must differ from each other.
fn check_names(context: &Context<'_>) {
    let usable = |name: &str| {
        !name.is_empty() && name.chars().all(|c| c.is_alphanumeric() || matches!(c, '_' | '-' | ' '))
    };
    for top in top_level::tops().filter(|top| top_level::has_named_entries(top.name)) {
        for (name, span, node) in context.entries(top.name) {
            if name.len() > MAX_NAME {
                let message = format!("a name in [{}] is longer than {MAX_NAME} bytes", top.name);
                context.fail::<()>(span, message, "choose a shorter name: plots are files of this name");
                continue;
            }
            let name = context.local_name(name, node);
            if !usable(name) {
                let message = format!("`{name}` cannot be the name of a {}", singular(top.name));
                context.fail::<()>(span, message, "names are made of letters, digits, `_`, `-` and blanks");
            }
        }
    }
    let mut parts: BTreeMap<&str, (Span, &str)> = BTreeMap::new();
    for table in PARTS {
        for (name, span) in context.names(table) {
            if name == "ground" || name.ends_with(".ground") {
                let message = format!("a {} cannot be called `ground`", singular(table));
                context.fail::<()>(span, message, "`ground` is the fixed frame; choose another name");
            }
            if let Some((first, other)) = parts.insert(name, (span, singular(table))) {
                let message = format!("the {} `{name}` has the name of a {other}", singular(table));
                let problem = Problem::error(span, message).label("again").also(first, "first here");
                context.report(problem.help(
                    "beams, shells, solids, bodies, point masses and superelements need different names",
                ));
            }
            if context.instances.contains_key(name) {
                let message = format!("the {} `{name}` has the name of a part", singular(table));
                context.fail::<()>(span, message, "rename it, or the entry of [parts]");
            }
        }
    }
}

fn title(context: &Context<'_>) -> Option<String> {
    let (node, _) = context.top("title")?;
    match &node.value {
        Value::Text(text) => Some(text.clone()),
        _ => context.wrong_type(node, "`title`", "a text"),
    }
}

/// A parameter may refer to others of the same table; one of a part in the same file also to those of enclosing parts.
fn parameters(context: &Context<'_>) -> BTreeMap<String, f64> {
    for (scope, own) in context.scopes.iter().enumerate() {
        if let (Some(parent), parts::Outside::All) = (own.parent, &own.outside) {
            context.inherit_parameters(scope, parent);
        }
        if let Some((index, count)) = own.index {
            context.set_parameter(scope, "index", index as f64);
            context.set_parameter(scope, "count", count as f64);
        }
        let mut waiting: Vec<_> = own.parameters.iter().collect();
        let mut unknown: BTreeSet<&str> = waiting.iter().map(|(name, ..)| name.as_str()).collect();
        unknown.retain(|name| !context.parameters_of(scope).contains_key(*name));
        while !waiting.is_empty() {
            let is_ready = |(name, _, node): &&(String, Span, Node)| {
                let Value::Text(text) = &node.value else { return true };
                let mut words = text.split(|sign: char| !sign.is_alphanumeric() && sign != '_');
                words.all(|word| word == name || !unknown.contains(word))
            };
            let (name, span, node) = waiting.remove(waiting.iter().position(is_ready).unwrap_or(0));
            unknown.remove(name.as_str());
            let what = format!("parameter `{name}`");
            if expression::is_reserved(name) {
                let message = format!("a parameter cannot be called `{name}`");
                context.fail::<()>(*span, message, "this word has another meaning in expressions");
                continue;
            }
            // A wrong parameter stays known, or every expression that names it would be wrong as well.
            let value = context.number(node, &what).unwrap_or(1.0);
            context.set_parameter(scope, name, value);
        }
    }
    context.own_parameters()
}

fn points(context: &Context<'_>) -> BTreeMap<String, Vector3> {
    let place = |(name, _): (&str, Span)| Some((name.to_owned(), context.point(name)?));
    context.names("points").into_iter().filter_map(place).collect()
}
