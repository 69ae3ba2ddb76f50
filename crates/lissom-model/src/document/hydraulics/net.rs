//! The network of nodes and components, and the expressions that describe it.

use std::collections::BTreeMap;
use std::fmt::Write as _;

use lissom_mechanics::kinematics::Subject;
use lissom_mechanics::registry::{Parameters, Value as Held};

use super::fluid::{self, ATMOSPHERE, Fluid, fluids};
use super::kind::HydraulicKind;
use super::nodes::{Node, NodeKind};
use crate::document::{Attachment, Component, Document, SignalEntry, StateEntry};
use crate::expression::Formula;
use crate::parts::context::Context;
use crate::reading::reader::Reader;
use crate::registry::{KindEntry, Registry};
use crate::text::report::{Located, Problem, Span};

/// Meaning of a name in a template.
#[derive(Clone, Debug)]
pub(super) enum Term {
    /// A number.
    Number(f64),
    /// A signal, state or coordinate of the whole model.
    Name(String),
}

impl From<f64> for Term {
    fn from(number: f64) -> Self {
        Self::Number(number)
    }
}

impl From<String> for Term {
    fn from(name: String) -> Self {
        Self::Name(name)
    }
}

/// The template's expression over quantities of the whole model, whose names need not be words of expressions.
fn formula(template: &str, terms: &[(&str, Term)]) -> Option<Formula> {
    let mut numbers = BTreeMap::new();
    let mut names = BTreeMap::new();
    for (own, term) in terms {
        match term {
            Term::Number(number) => drop(numbers.insert((*own).to_owned(), *number)),
            Term::Name(name) => drop(names.insert(*own, name.clone())),
        }
    }
    let mut formula = Formula::parse(template, &numbers).ok()?;
    formula.rename(&|own| names.get(own).cloned().unwrap_or_else(|| own.to_owned()));
    Some(formula)
}

/// A hydraulic part as it is read.
pub(super) struct Part<'r, 'c, 'a> {
    pub(super) reader: &'r Reader<'c, 'a>,
    pub(super) name: &'r str,
    /// The nodes of its ports, in their order.
    nodes: Vec<Option<String>>,
}

impl<'r, 'c, 'a> Part<'r, 'c, 'a> {
    /// Reads the ports; none if one is wrong.
    pub(super) fn new(
        reader: &'r Reader<'c, 'a>,
        name: &'r str,
        kind: &HydraulicKind,
        kind_of: impl Fn(&str) -> Option<&'static HydraulicKind>,
    ) -> Option<Self> {
        let context = reader.context;
        let mut nodes: Vec<Option<String>> = Vec::new();
        for port in kind.ports {
            if !reader.has(port.key) {
                // A missing key that is required has been reported.
                nodes.push((!port.is_required).then_some(None)?);
                continue;
            }
            let node = reader.name_in(port.key)?;
            let words = reader.words(port.key);
            let other = kind_of(&node.value)?;
            if !other.ports.is_empty() {
                let message =
                    format!("{words} names `{}`, which is of kind `{}` and no node", node.value, other.word);
                let help = "components are connected at nodes: add an entry of kind `volume`, `pressure` or `junction`, and \
                            name it in both";
                return context.fail(node.span, message, help);
            }
            if nodes.contains(&Some(node.value.clone())) {
                let message = format!("{} is connected to the node `{}` twice", reader.what, node.value);
                return context.fail(node.span, message, "name different nodes");
            }
            if let (Some(first), false) = (nodes.iter().flatten().next(), kind.separates_fluids) {
                let of = |node: &str| fluid::name_of(context, node).unwrap_or_default();
                let (one, two) = (of(first), of(&node.value));
                if one != two {
                    let message = format!(
                        "{} connects nodes of different fluids: `{one}` in `{first}` and `{two}` in `{}`",
                        reader.what, node.value
                    );
                    return context.fail(node.span, message, "give both nodes the same `fluid`");
                }
            }
            nodes.push(Some(node.value));
        }
        Some(Self { reader, name, nodes })
    }

    /// Name of one of its components in the whole model.
    pub(super) fn component(&self, word: &str) -> String {
        format!("{}.{word}", self.name)
    }

    /// Pressure at a port; that of the atmosphere at one without node.
    pub(super) fn pressure(&self, port: usize) -> Term {
        match &self.nodes[port] {
            Some(node) => Term::Name(format!("{node}.pressure")),
            None => Term::Number(ATMOSPHERE),
        }
    }

    /// A number of its table, or its default.
    pub(super) fn number(&self, key: &str) -> Option<f64> {
        self.reader.number(key).map(|number| number.value)
    }
}

/// What a part adds to the volume equation of a node.
struct Connection {
    node: String,
    part: String,
    /// Factor and signal of the flow into the node [m³/s].
    flow: (f64, String),
}

/// The network as far as it is read.
pub(super) struct Net<'c, 'a> {
    context: &'c Context<'a>,
    registry: &'c Registry,
    fluids: BTreeMap<String, Option<Fluid>>,
    nodes: Vec<Node>,
    connections: Vec<Connection>,
    /// Signals of volumes [m³] by node.
    volumes: Vec<(String, String)>,
    /// Signals of further volume per pressure [m³/Pa] by node.
    compliances: Vec<(String, String)>,
    signals: Vec<SignalEntry>,
    states: Vec<StateEntry>,
    loads: Vec<Component>,
    springs: Vec<Component>,
}

impl<'c, 'a> Net<'c, 'a> {
    pub(super) fn new(context: &'c Context<'a>, registry: &'c Registry) -> Self {
        Self {
            context,
            registry,
            fluids: fluids(context),
            nodes: Vec::new(),
            connections: Vec::new(),
            volumes: Vec::new(),
            compliances: Vec::new(),
            signals: Vec::new(),
            states: Vec::new(),
            loads: Vec::new(),
            springs: Vec::new(),
        }
    }

    /// Fluid at a port of a part.
    pub(super) fn fluid(&self, part: &Part<'_, '_, '_>, port: usize) -> Option<Fluid> {
        fluid::of(self.context, &self.fluids, part.nodes[port].as_deref()?)
    }

    /// Adds a node, which must name its fluid if there are several.
    pub(super) fn add_node(&mut self, part: &Part<'_, '_, '_>, kind: NodeKind) -> Option<()> {
        let reader = part.reader;
        if reader.has("fluid") {
            reader.name_in("fluid")?;
        } else if self.fluids.len() > 1 {
            let message = format!("{} lacks `fluid`, and there are several", reader.what);
            return self.context.fail(reader.name, message, "add `fluid = …`, the name of one of them");
        }
        self.nodes.push(Node { name: Located::new(part.name.to_owned(), reader.name), kind });
        Some(())
    }

    /// Adds a component of a part as a template over `terms`.
    pub(super) fn signal(
        &mut self,
        part: &Part<'_, '_, '_>,
        word: &str,
        (template, terms): (&str, &[(&str, Term)]),
    ) -> Option<()> {
        self.add_signal(part.component(word), part.reader.name, (template, terms))
    }

    /// Adds a component of a part as the user's expression.
    pub(super) fn expression(&mut self, part: &Part<'_, '_, '_>, word: &str, value: Located<Formula>) {
        let name = Located::new(part.component(word), part.reader.name);
        let (table, sampling, delay, filter) = (None, None, None, None);
        self.signals.push(SignalEntry { name, value, table, sampling, delay, filter });
    }

    fn add_signal(
        &mut self,
        name: String,
        span: Span,
        (template, terms): (&str, &[(&str, Term)]),
    ) -> Option<()> {
        let value = Located::new(formula(template, terms)?, span);
        let name = Located::new(name, span);
        let (table, sampling, delay, filter) = (None, None, None, None);
        self.signals.push(SignalEntry { name, value, table, sampling, delay, filter });
        Some(())
    }

    /// Adds a state of a part; `is_positive` if it is a pressure of a fluid without air.
    pub(super) fn state(
        &mut self,
        part: &Part<'_, '_, '_>,
        (word, magnitude, start, is_positive): (&str, f64, f64, bool),
        (template, terms): (&str, &[(&str, Term)]),
    ) -> Option<()> {
        let span = part.reader.name;
        let derivative = Located::new(formula(template, terms)?, span);
        let name = part.component(word);
        let positive_of = is_positive.then(|| Subject::new("node", &name));
        let name = Located::new(name, span);
        self.states.push(StateEntry { name, derivative, positive_of, is_balance: false, start, magnitude });
        Some(())
    }

    /// Lets a signal of the part, times `sign`, flow from the node of a port into the part.
    pub(super) fn flow(&mut self, part: &Part<'_, '_, '_>, port: usize, (word, sign): (&str, f64)) {
        if let Some(node) = part.nodes[port].clone() {
            let flow = (-sign, part.component(word));
            self.connections.push(Connection { node, part: part.name.to_owned(), flow });
        }
    }

    /// Lets the signal `flow` of the part flow from its first port to its second.
    pub(super) fn through(&mut self, part: &Part<'_, '_, '_>) {
        self.flow(part, 0, ("flow", 1.0));
        self.flow(part, 1, ("flow", -1.0));
    }

    /// Adds the volume of a signal of the part to the node of a port.
    pub(super) fn volume(&mut self, part: &Part<'_, '_, '_>, port: usize, word: &str) {
        let node = part.nodes[port].clone();
        self.volumes.extend(node.map(|node| (node, part.component(word))));
    }

    /// Adds a volume per pressure to the node of a port, which must store fluid.
    pub(super) fn compliance(&mut self, part: &Part<'_, '_, '_>, port: usize, word: &str) {
        let node = part.nodes[port].clone();
        self.compliances.extend(node.map(|node| (node, part.component(word))));
    }

    /// Adds the power that flows into a part at its ports.
    pub(super) fn add_power(&mut self, part: &Part<'_, '_, '_>) -> Option<()> {
        let mut terms = Vec::new();
        let mut template = "0".to_owned();
        for (k, own) in self.connections.iter().filter(|own| own.part == part.name).enumerate() {
            write!(template, " - s{k}*p{k}*q{k}").ok()?;
            terms.extend([
                (format!("s{k}"), Term::Number(own.flow.0)),
                (format!("p{k}"), Term::Name(format!("{}.pressure", own.node))),
                (format!("q{k}"), Term::Name(own.flow.1.clone())),
            ]);
        }
        // Nodes have no connections of their own; their power follows when all are known.
        if terms.is_empty() { Some(()) } else { self.signal(part, "power", (&template, &borrowed(&terms))) }
    }

    /// Adds a load on the coordinate of a joint whose size is a signal of the part.
    pub(super) fn load(
        &mut self,
        part: &Part<'_, '_, '_>,
        joint: &Located<String>,
        (kind, size, word): (&'static str, &'static str, &str),
    ) -> Option<()> {
        let entry = *self.registry.loads.iter().find(|entry| entry.name == kind)?;
        let signal = formula("f", &[("f", Term::Name(part.component(word)))])?;
        // The load of size one is multiplied.
        let parameters = Parameters::new().declared(entry.parameters).with(size, Held::Number(1.0));
        let mut load = component(part, joint, entry, parameters);
        load.signal = Some((size, Located::new(signal, part.reader.name)));
        self.loads.push(load);
        Some(())
    }

    /// Adds a spring on the coordinate of a joint.
    pub(super) fn spring(
        &mut self,
        part: &Part<'_, '_, '_>,
        joint: &Located<String>,
        (kind, values): (&str, Vec<(&str, Held)>),
    ) -> Option<()> {
        let entry = *self.registry.springs.iter().find(|entry| entry.name == kind)?;
        let mut parameters = Parameters::new().declared(entry.parameters);
        for (name, value) in values {
            parameters.insert(name, value);
        }
        self.springs.push(component(part, joint, entry, parameters));
        Some(())
    }

    /// Adds the equations of all nodes, and everything to the document.
    pub(super) fn finish(mut self, document: &mut Document) {
        for node in std::mem::take(&mut self.nodes) {
            self.add_equation(&node);
        }
        document.signals.append(&mut self.signals);
        document.states.append(&mut self.states);
        document.loads.append(&mut self.loads);
        document.springs.append(&mut self.springs);
    }

    fn add_equation(&mut self, node: &Node) -> Option<()> {
        let (name, span) = (&node.name.value, node.name.span);
        let own: Vec<&Connection> = self.connections.iter().filter(|own| own.node == *name).collect();
        let is_used = |all: &[(String, String)]| all.iter().any(|(own, _)| own == name);
        if own.is_empty() && !is_used(&self.compliances) {
            let problem = Problem::warning(span, format!("no component is connected to the node `{name}`"));
            self.context
                .report(problem.label("not used").help("name it at a port of a component, or remove it"));
        }
        let mut terms: Vec<(String, Term)> = Vec::new();
        let mut flow = "0".to_owned();
        for (k, own) in own.iter().enumerate() {
            write!(flow, " {} q{k}", if own.flow.0 > 0.0 { '+' } else { '-' }).ok()?;
            terms.push((format!("q{k}"), Term::Name(own.flow.1.clone())));
        }
        let whole = |word: &str| format!("{name}.{word}");
        let [pressure, inflow] = ["pressure", "flow"].map(whole);
        self.add_signal(inflow.clone(), span, (&flow, &borrowed(&terms)))?;
        let terms = [("p", Term::Name(pressure.clone())), ("q", Term::Name(inflow))];
        self.add_signal(whole("power"), span, ("p*q", &terms))?;
        let stores =
            |own: &[(String, String)]| own.iter().find(|(own, _)| own == name).map(|own| own.1.clone());
        // A fluid without air is torn apart.
        let pulled = |fluid: &Fluid| (!fluid.has_air()).then(|| Subject::new("node", name));
        match node.kind {
            NodeKind::Volume { volume, start } => {
                let fluid = fluid::of(self.context, &self.fluids, name)?;
                let positive_of = pulled(&fluid);
                let (compressibility, fluid) = fluid.compressibility();
                let mut terms: Vec<(String, Term)> = terms.map(|(own, term)| (own.to_owned(), term)).into();
                terms.extend(fluid.into_iter().map(|(own, term)| (own.to_owned(), term)));
                terms.push(("V".to_owned(), Term::Number(volume)));
                let mut sums = [String::new(), String::new()];
                for (sum, (letter, all)) in
                    sums.iter_mut().zip([("v", &self.volumes), ("c", &self.compliances)])
                {
                    for (k, (_, own)) in all.iter().filter(|(own, _)| own == name).enumerate() {
                        write!(sum, " + {letter}{k}").ok()?;
                        terms.push((format!("{letter}{k}"), Term::Name(own.clone())));
                    }
                }
                let rate = format!("q/((V{})*({compressibility}){})", sums[0], sums[1]);
                self.add_signal(whole("rate"), span, (&rate, &borrowed(&terms)))?;
                let derivative = Located::new(formula("r", &[("r", Term::Name(whole("rate")))])?, span);
                let (name, magnitude) = (Located::new(pressure, span), ATMOSPHERE);
                self.states.push(StateEntry {
                    name,
                    derivative,
                    positive_of,
                    is_balance: false,
                    start,
                    magnitude,
                });
            }
            NodeKind::Junction { start } => {
                let positive_of = pulled(&fluid::of(self.context, &self.fluids, name)?);
                let derivative = Located::new(formula("q", &terms)?, span);
                let (name, magnitude) = (Located::new(pressure, span), ATMOSPHERE);
                self.states.push(StateEntry {
                    name,
                    derivative,
                    positive_of,
                    is_balance: true,
                    start,
                    magnitude,
                });
            }
            NodeKind::Pressure => {}
        }
        match node.kind {
            NodeKind::Volume { .. } => {}
            NodeKind::Pressure | NodeKind::Junction { .. } => {
                if let Some(part) = stores(&self.compliances) {
                    let part = part.rsplit_once('.').map_or(part.as_str(), |(part, _)| part);
                    let message =
                        format!("accumulator `{part}` is connected to `{name}`, which stores no fluid");
                    return self.context.fail(span, message, "let the node be of kind `volume`");
                }
            }
        }
        Some(())
    }
}

fn borrowed(terms: &[(String, Term)]) -> Vec<(&str, Term)> {
    terms.iter().map(|(own, term)| (own.as_str(), term.clone())).collect()
}

/// A spring or load on the coordinate of a joint.
fn component(
    part: &Part<'_, '_, '_>,
    joint: &Located<String>,
    entry: KindEntry,
    parameters: Parameters,
) -> Component {
    let span = part.reader.name;
    Component {
        name: Located::new(part.name.to_owned(), span),
        kind: Located::new(entry.name.to_owned(), span),
        ports: entry.ports,
        attachment: Attachment { coordinates: vec![(joint.clone(), None)], ..Attachment::default() },
        parameters,
        parameter_spans: Vec::new(),
        signal: None,
        latch: None,
        release: None,
        friction: None,
        on_tip: None,
    }
}
