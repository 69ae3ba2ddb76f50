//! Loads that depend on the motion of their own point: expressions of its position, velocity and states.

use std::collections::BTreeMap;
use std::slice;
use std::sync::Arc;

use lissom_mechanics::elements::local_load::{MAX_FUNCTIONS, MAX_STATES};
use lissom_mechanics::kinematics::Subject;
use lissom_mechanics::registry::ModelAxis;
use lissom_mechanics::signals::MAX_ARGUMENTS;
use lissom_motion::{Motion, Vector3};

use super::NodeReference;
use super::entries::each;
use crate::expression::{self, Formula};
use crate::files::wind_box::WindBox;
use crate::format::keys::{Key, Shape, choice, optional, required, unitless};
use crate::format::part_tables::placed_in;
use crate::format::suggest;
use crate::functions::table_family::TableFamily;
use crate::parts::context::Context;
use crate::reading::local_tables::local_table_keys;
use crate::reading::reader::Reader;
use crate::text::ScopeId;
use crate::text::report::{Located, Problem, Span};
use crate::text::{Node, Value};

/// Axes of a load.
const AXES: [&str; 3] = ["section", "global", "part"];
/// Names of the motion of the point, besides `s` and `t`.
const MOTION: [(&str, LocalName); 15] = [
    ("x", LocalName::Position(0)),
    ("y", LocalName::Position(1)),
    ("z", LocalName::Position(2)),
    ("dx", LocalName::Displacement(0)),
    ("dy", LocalName::Displacement(1)),
    ("dz", LocalName::Displacement(2)),
    ("v1", LocalName::Velocity(0)),
    ("v2", LocalName::Velocity(1)),
    ("v3", LocalName::Velocity(2)),
    ("w1", LocalName::AngularVelocity(0)),
    ("w2", LocalName::AngularVelocity(1)),
    ("w3", LocalName::AngularVelocity(2)),
    ("u1", LocalName::RelativeFlow(0)),
    ("u2", LocalName::RelativeFlow(1)),
    ("u3", LocalName::RelativeFlow(2)),
];
/// Names of the motion relative to another node.
const RELATIVE: [(&str, LocalName); 6] = [
    ("r1", LocalName::RelativePosition(0)),
    ("r2", LocalName::RelativePosition(1)),
    ("r3", LocalName::RelativePosition(2)),
    ("n1", LocalName::Direction(0)),
    ("n2", LocalName::Direction(1)),
    ("n3", LocalName::Direction(2)),
];
/// The fraction along the beam.
const STATION: &str = "s";

/// What a name in an expression of a load means.
#[derive(Clone, Debug, PartialEq)]
pub enum LocalName {
    /// Component of the position, global axes [m].
    Position(usize),
    /// Component of the displacement since the start, global axes [m].
    Displacement(usize),
    /// Component of the velocity in the load's axes [m/s].
    Velocity(usize),
    /// Component of the angular velocity in the load's axes [rad/s].
    AngularVelocity(usize),
    /// Component of the velocity of the flow relative to the point, in the load's axes [m/s].
    RelativeFlow(usize),
    /// Component of the position relative to another node, in the load's axes [m].
    RelativePosition(usize),
    /// Component of a direction fixed in another node, in the load's axes.
    Direction(usize),
    /// The fraction along the beam.
    Station,
    /// A state of the load.
    State(usize),
    /// An expression before this one.
    Function(usize),
    /// An input or a sampled signal of the model.
    Outside(Located<String>),
}

/// An expression, or tables over its arguments.
#[derive(Clone, Debug, PartialEq)]
pub enum LocalLaw {
    /// An expression.
    Formula(Formula),
    /// A table over one argument, or several of them over two.
    Table(TableFamily),
    /// A component of wind over y, z and time.
    Wind(Arc<WindBox>, usize),
}

/// A law and the meaning of its arguments.
#[derive(Clone, Debug, PartialEq)]
pub struct LocalExpression {
    /// The law.
    pub law: LocalLaw,
    /// Arguments of the law, in their order.
    pub arguments: Vec<LocalName>,
    /// Subject of messages.
    pub subject: Arc<Subject>,
}

/// A state at each point of a load.
#[derive(Clone, Debug, PartialEq)]
pub struct LocalState {
    /// Name.
    pub name: String,
    /// Value at the start.
    pub start: f64,
    /// Usual magnitude, by which errors are measured.
    pub magnitude: f64,
}

/// A load that depends on the motion of its own point.
#[derive(Clone, Debug, PartialEq)]
pub struct LocalLoadEntry {
    /// Name.
    pub name: Located<String>,
    /// The node on which it acts; of a beam its start.
    pub node: Located<NodeReference>,
    /// Where it acts, if that is not the node [m].
    pub at: Option<Vector3>,
    /// The beam along which it acts, if it acts along one.
    pub beam: Option<String>,
    /// The node to which positions are relative, and a direction fixed in it, at the start in global axes.
    pub about: Option<(Located<NodeReference>, Vector3)>,
    /// The frame of the model, or of the part in which it is written, for positions, flow and global axes.
    pub frame: Motion,
    /// Whether its axes are those of this frame.
    pub is_global: bool,
    /// All expressions, each after those that it names.
    pub functions: Vec<LocalExpression>,
    /// The components of the flow's velocity in global axes.
    pub flow: [Option<usize>; 3],
    /// The components of force and moment.
    pub wrench: [Option<usize>; 6],
    /// The states, and the expressions of their derivatives.
    pub states: Vec<(LocalState, usize)>,
    /// The named variables that other expressions use, and their expressions.
    pub variables: Vec<(String, usize)>,
}

/// Keys of a load.
pub(super) fn keys() -> Vec<Key> {
    vec![
        placed_in(),
        required("on", Shape::Node, "", "a beam, along which it is distributed, or a node"),
        optional("at", Shape::Place, "m", "where it acts on a node, at the start; default the node"),
        unitless(
            "axes",
            choice(&AXES),
            "axes of `force`, `moment`, velocities and relative flow: those of the section or body, global ones, or those of the part in which the load is, to which x, y, z and `flow` refer then too",
        )
        .or_word(AXES[0]),
        optional("about", Shape::Node, "", "another node, such as a hub: r1, r2, r3 is the position relative to it"),
        unitless(
            "axis",
            Shape::DirectionOr(ModelAxis::X),
            "direction fixed in the node `about`, at the start: n1, n2, n3 in expressions",
        ),
        optional(
            "force",
            Shape::SectionDistribution,
            "N/m, N",
            "per length of a beam, or on a node: three numbers or expressions",
        ),
        optional("moment", Shape::SectionDistribution, "N, N m", "the same for the moment"),
        optional(
            "flow",
            Shape::SectionDistribution,
            "m/s",
            "velocity of the surrounding fluid in global axes, or with `axes = \"part\"` in those of the part: three numbers or expressions of x, y, z, t and inputs",
        ),
        unitless(
            "variables",
            Shape::Table,
            "named expressions for use in the others; or { of = \"…\", table = [[…]] }, a table over an expression",
        ),
        unitless(
            "states",
            Shape::Table,
            "first-order states at each point: { derivative = \"…\", start = 0, magnitude = 1 }",
        ),
    ]
}

fn state_keys() -> Vec<Key> {
    vec![
        required("derivative", Shape::Formula, "1/s", "expression of its derivative by time"),
        unitless("start", Shape::Number, "value at the start").or_number(0.0),
        unitless("magnitude", Shape::Positive, "usual magnitude, by which errors are measured")
            .or_number(1.0),
    ]
}

pub(super) fn local_loads(context: &Context<'_>) -> Vec<LocalLoadEntry> {
    each(context, "local_loads", |reader, name| {
        let (node, beam) = on(reader)?;
        let at = match reader.node("at") {
            Some(place) => Some(context.place(place, &reader.words("at"))?.value),
            None => None,
        };
        if let (Some(_), Some(place)) = (&beam, reader.node("at")) {
            let message = format!("{} acts along a beam, so `at` is unused", reader.what);
            return context.fail(place.span, message, "remove it, or name a node such as \"beam.end\"");
        }
        if !reader.has("force") && !reader.has("moment") {
            let message = format!("{} has neither `force` nor `moment`", reader.what);
            return context.fail(reader.name, message, "add `force = [\"…\", \"…\", \"…\"]`");
        }
        let about = match reader.node("about") {
            Some(node) => {
                Some((context.node(node, &reader.words("about"))?, reader.vector("axis")?.value.normalize()))
            }
            None if reader.has("axis") => {
                let message = format!("{} has `axis`, but lacks `about`", reader.what);
                return context.fail(
                    reader.name,
                    message,
                    "add `about`, the node in which the axis is fixed",
                );
            }
            None => None,
        };
        let mut laws = Laws::open(reader, name, beam.is_some())?;
        let flow = laws.vector("flow")?;
        let force = laws.vector("force")?;
        let moment = laws.vector("moment")?;
        let rates = laws.rates()?;
        if laws.functions.len() > MAX_FUNCTIONS {
            let message = format!("{} has more than {MAX_FUNCTIONS} expressions", reader.what);
            return context.fail(reader.name, message, "combine some of its `variables`");
        }
        let Laws { functions, states, known, .. } = laws;
        let variables = known.into_iter().filter_map(|(name, index)| Some((name.to_owned(), index?)));
        let axes = reader.choice("axes")?.value;
        Some(LocalLoadEntry {
            name: Located::new(name.to_owned(), reader.name),
            node,
            at,
            beam,
            about,
            frame: if axes == AXES[2] { context.frame(reader.scope)? } else { Motion::identity() },
            is_global: axes != AXES[0],
            functions,
            flow,
            wrench: [force[0], force[1], force[2], moment[0], moment[1], moment[2]],
            states: states.into_iter().map(|(state, _)| state).zip(rates).collect(),
            variables: variables.collect(),
        })
    })
}

/// Node and beam on which a load acts.
fn on(reader: &Reader<'_, '_>) -> Option<(Located<NodeReference>, Option<String>)> {
    let context = reader.context;
    let node = reader.node("on")?;
    if let Value::Text(text) = &node.value
        && let Some(beam) = context.resolve(text, node.scope, &|full| context.has("beams", full))
    {
        let start = NodeReference::Beam { beam: beam.clone(), fraction: 0.0 };
        return Some((Located::new(start, node.span), Some(beam)));
    }
    let found = context.node(node, &reader.words("on"))?;
    if found.value == NodeReference::Ground {
        let message = format!("{} acts on the ground, which does not move", reader.what);
        return context.fail(node.span, message, "specify a beam, or a node of a body or beam");
    }
    Some((found, None))
}

/// The expressions of a load while they are read.
struct Laws<'r, 'c, 'a> {
    reader: &'r Reader<'c, 'a>,
    name: &'r str,
    is_along_beam: bool,
    variables: BTreeMap<&'r str, &'r Node>,
    /// Variables that are read, and those that are being read.
    known: BTreeMap<&'r str, Option<usize>>,
    states: Vec<(LocalState, &'r Node)>,
    functions: Vec<LocalExpression>,
    /// Whether an expression of the flow is read.
    is_flow: bool,
}

impl<'r, 'c: 'r, 'a> Laws<'r, 'c, 'a> {
    fn open(reader: &'r Reader<'c, 'a>, name: &'r str, is_along_beam: bool) -> Option<Self> {
        let mut laws = Self {
            reader,
            name,
            is_along_beam,
            variables: BTreeMap::new(),
            known: BTreeMap::new(),
            states: Vec::new(),
            functions: Vec::new(),
            is_flow: false,
        };
        for (name, node) in laws.named("variables")? {
            laws.variables.insert(name, node);
        }
        for (name, node) in laws.named("states")? {
            if laws.variables.contains_key(name) {
                let message = format!("{} has a variable and a state `{name}`", reader.what);
                return reader.context.fail(node.span, message, "give one of them another name");
            }
            let what = format!("state `{name}` of {}", reader.what);
            let own = Reader::open(reader.context, node, (what, node.span), state_keys())?;
            let state = LocalState {
                name: name.to_owned(),
                start: own.number("start")?.value,
                magnitude: own.number("magnitude")?.value,
            };
            laws.states.push((state, own.node("derivative")?));
        }
        if laws.states.len() > MAX_STATES {
            let message = format!("{} has more than {MAX_STATES} states", reader.what);
            return reader.context.fail(reader.name, message, "divide it into two loads");
        }
        laws.check_parameters(reader.scope)?;
        Some(laws)
    }

    /// The entries of a table whose names expressions can contain.
    fn named(&self, key: &str) -> Option<Vec<(&'r str, &'r Node)>> {
        let context = self.reader.context;
        let Some(node) = self.reader.node(key) else { return Some(Vec::new()) };
        let Value::Table(table) = &node.value else {
            return context.wrong_type(node, &self.reader.words(key), "a table of names and expressions");
        };
        for (name, entry) in table {
            let mut letters = name.chars();
            let is_word = letters.next().is_some_and(|first| first.is_ascii_alphabetic())
                && letters.all(|letter| letter.is_ascii_alphanumeric() || letter == '_');
            let has_meaning = expression::is_reserved(name) || self.motion().any(|(own, _)| own == name);
            if !is_word || has_meaning {
                let message = format!("{} cannot contain the name `{name}`", self.reader.words(key));
                let help = if is_word {
                    "this word has another meaning in expressions of a load"
                } else {
                    "use letters, digits and `_`, a letter first"
                };
                return context.fail(entry.key, message, help);
            }
        }
        Some(table.iter().map(|(name, entry)| (name.as_str(), &entry.node)).collect())
    }

    /// Names of the motion of the point.
    fn motion(&self) -> impl Iterator<Item = &'static (&'static str, LocalName)> {
        let relative: &[_] = if self.reader.has("about") { &RELATIVE } else { &[] };
        MOTION.iter().chain(relative)
    }

    /// A parameter with the name of a quantity would replace it by a number.
    fn check_parameters(&self, scope: ScopeId) -> Option<()> {
        let context = self.reader.context;
        let states = self.states.iter().map(|(state, _)| state.name.as_str());
        let words = self.motion().map(|(name, _)| *name).chain(self.variables.keys().copied()).chain(states);
        let taken = words.into_iter().find(|word| context.parameters_of(scope).contains_key(*word));
        let Some(taken) = taken else { return Some(()) };
        let message =
            format!("{} has a quantity `{taken}`, which is the name of a parameter too", self.reader.what);
        context.fail(self.reader.name, message, "give the parameter another name")
    }

    /// Three expressions; zeros are omitted.
    fn vector(&mut self, key: &str) -> Option<[Option<usize>; 3]> {
        let reader = self.reader;
        let Some(node) = reader.node(key) else { return Some([None; 3]) };
        let what = reader.words(key);
        self.is_flow = key == "flow";
        let list = reader.context.list(node, 3, &what)?;
        let mut all = [None; 3];
        for (own, entry) in all.iter_mut().zip(list) {
            if !matches!(entry.value, Value::Number(0.0)) {
                *own = Some(self.formula(entry, &what)?);
            }
        }
        Some(all)
    }

    /// The derivatives of the states.
    fn rates(&mut self) -> Option<Vec<usize>> {
        self.is_flow = false;
        let nodes: Vec<_> = self.states.iter().map(|(state, node)| (state.name.clone(), *node)).collect();
        let mut rates = Vec::new();
        for (name, node) in nodes {
            let what = format!("`derivative` of state `{name}` of {}", self.reader.what);
            rates.push(self.formula(node, &what)?);
        }
        Some(rates)
    }

    /// Index of a named variable.
    fn variable(&mut self, name: &'r str, place: Span) -> Option<usize> {
        let what = format!("variable `{name}` of {}", self.reader.what);
        match self.known.get(name) {
            Some(Some(index)) => return Some(*index),
            Some(None) => {
                let message = format!("{what} needs its own value");
                let help = "let it be one of `states`, whose derivative may depend on it";
                return self.reader.context.fail(place, message, help);
            }
            _ => {}
        }
        self.known.insert(name, None);
        let node = self.variables[name];
        let index = if let Value::Table(_) = node.value {
            self.table(node, &what)?
        } else {
            self.formula(node, &what)?
        };
        self.known.insert(name, Some(index));
        Some(index)
    }

    /// A table over an expression, or several over two.
    fn table(&mut self, node: &'r Node, what: &str) -> Option<usize> {
        let context = self.reader.context;
        let reader = Reader::open(context, node, (what.to_owned(), node.span), local_table_keys())?;
        let of = reader.node("of")?;
        let expressions = match &of.value {
            Value::List(list) if list.len() == 2 || (list.len() == 3 && reader.has("wind")) => {
                list.as_slice()
            }
            Value::List(_) => {
                let message = format!("{} must be one or two expressions", reader.words("of"));
                return context.fail(
                    of.span,
                    message,
                    "write `of = \"alpha\"` or `of = [\"alpha\", \"re\"]`",
                );
            }
            _ => slice::from_ref(of),
        };
        let (law, words) = if reader.has("wind") {
            let (wind, component) = context.wind_of(&reader, node, expressions.len())?;
            let words = format!("{what}, whose wind is known for {}", wind.extent());
            (LocalLaw::Wind(wind, component), words)
        } else {
            (LocalLaw::Table(context.local_table(&reader, node, expressions.len())?), what.to_owned())
        };
        let mut arguments = Vec::new();
        for own in expressions {
            arguments.push(LocalName::Function(self.formula(own, &format!("`of` of {what}"))?));
        }
        Some(self.push(law, arguments, &words))
    }

    fn push(&mut self, law: LocalLaw, arguments: Vec<LocalName>, what: &str) -> usize {
        let subject = Subject::new("local load", self.name).called(what);
        self.functions.push(LocalExpression { law, arguments, subject: Arc::new(subject) });
        self.functions.len() - 1
    }

    /// An expression, after those that it names.
    fn formula(&mut self, node: &'r Node, what: &str) -> Option<usize> {
        let context = self.reader.context;
        let formula = context.own_formula(node, what)?;
        let mut arguments = Vec::new();
        for name in formula.arguments() {
            let place = match &node.value {
                Value::Text(text) => context.sources.within(node.span, text, &name.range),
                _ => node.span,
            };
            arguments.push(self.meaning(&name.text, (place, node), what)?);
        }
        if arguments.len() > MAX_ARGUMENTS {
            return context.fail(node.span, format!("{what} names too much"), "divide it into `variables`");
        }
        let words = format!("{what} = {}", formula.text());
        Some(self.push(LocalLaw::Formula(formula), arguments, &words))
    }

    fn meaning(&mut self, name: &str, (place, node): (Span, &Node), what: &str) -> Option<LocalName> {
        let context = self.reader.context;
        if let Some((_, meaning)) = self.motion().find(|(own, _)| *own == name) {
            if self.is_flow && !matches!(meaning, LocalName::Position(_)) {
                let message = format!("{what} cannot name `{name}`");
                return context.fail(place, message, "the flow is a function of x, y, z, t and inputs");
            }
            return Some(meaning.clone());
        }
        if name == STATION {
            let help = "only loads along a beam have the fraction `s`";
            let message = format!("{what} cannot name `s`");
            return if self.is_along_beam {
                Some(LocalName::Station)
            } else {
                context.fail(place, message, help)
            };
        }
        if let Some(index) = self.states.iter().position(|(state, _)| state.name == name) {
            if self.is_flow {
                let message = format!("{what} cannot name the state `{name}`");
                return context.fail(place, message, "the flow is a function of x, y, z, t and inputs");
            }
            return Some(LocalName::State(index));
        }
        if let Some((&own, _)) = self.variables.get_key_value(name) {
            return self.variable(own, place).map(LocalName::Function);
        }
        let is_there = |full: &str| context.has("inputs", full) || context.has("signals", full);
        if let Some(full) = context.resolve(name, node.scope, &is_there) {
            return Some(LocalName::Outside(Located::new(full, place)));
        }
        if RELATIVE.iter().any(|(own, _)| *own == name) {
            return context.fail(
                place,
                format!("{what} cannot name `{name}`"),
                "add `about`, the node to which positions are relative",
            );
        }
        let own = self.motion().map(|(own, _)| *own).chain([STATION, "t"]);
        let own = own.chain(self.variables.keys().copied());
        let near = suggest::help(name, own);
        let problem = Problem::error(place, format!("{what} cannot name `{name}`")).label("unknown here");
        context.report(problem.maybe_help(near));
        None
    }
}
