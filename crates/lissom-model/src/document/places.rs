//! References to positions and nodes in a model file.

use lissom_motion::Vector3;

use super::NodeReference;
use super::entries::PARTS;
use crate::format::suggest;
use crate::parts::context::Context;
use crate::reading::node_reference::MeshPlace;
use crate::text::Node;
use crate::text::ScopeId;
use crate::text::Value;
use crate::text::report::{Located, Problem, Span};

/// A position, or a node that has one.
#[derive(Clone, Debug)]
pub(super) enum PlaceOrNode {
    Place(Located<Vector3>),
    Node(Located<NodeReference>),
}

impl Context<'_> {
    /// The name of a point, or three numbers.
    pub(crate) fn place(&self, node: &Node, what: &str) -> Option<Located<Vector3>> {
        let place = match &node.value {
            Value::Text(name) => {
                let name = self.entry_named("points", name, node, what)?;
                if !self.is_known("points", &name, node.span, what) {
                    return None;
                }
                self.point(&name)?
            }
            Value::List(_) => {
                let own = self.vector(node, what)?;
                self.to_global(node.scope, &own)?
            }
            _ => return self.wrong_type(node, what, "the name of a point, or three numbers"),
        };
        Some(Located::new(place, node.span))
    }

    /// The name of a point, three numbers, or a node of a part.
    pub(super) fn place_or_node(&self, node: &Node, what: &str) -> Option<PlaceOrNode> {
        if let Value::Text(name) = &node.value
            && !self.has("points", &self.entry_named("points", name, node, what)?)
        {
            if self.looks_like_node(name) || self.node_resolved(name, node.scope).is_some() {
                return self.node(node, what).map(PlaceOrNode::Node);
            }
            let points = self.names("points");
            let nodes = self.node_names();
            let known = points.iter().map(|(name, _)| *name).chain(nodes.iter().map(String::as_str));
            let message = format!("{what} names `{name}`, which is neither a point nor a node");
            let help = suggest::help(name, known);
            self.report(Problem::error(node.span, message).label("unknown").maybe_help(help));
            return None;
        }
        self.place(node, what).map(PlaceOrNode::Place)
    }

    fn looks_like_node(&self, name: &str) -> bool {
        let part = name.split(['.', '@']).next().unwrap_or(name);
        name == "ground" || name.contains(['.', '@']) || PARTS.iter().any(|table| self.has(table, part))
    }

    /// A node named in a text.
    pub(super) fn node(&self, node: &Node, what: &str) -> Option<Located<NodeReference>> {
        let Value::Text(text) = &node.value else {
            return self.wrong_type(
                node,
                what,
                "the name of a node, such as \"ground\", \"body\" or \"beam.end\"",
            );
        };
        let written = self.written(text, (node.span, node.scope), what)?;
        let full = self.node_resolved(&written, node.scope);
        let text = full.as_deref().unwrap_or(&written);
        self.node_named(text, node.span, what).map(|found| Located::new(found, node.span))
    }
    /// Name in the whole model of a node, or of a part that is not a node.
    fn node_resolved(&self, text: &str, scope: ScopeId) -> Option<String> {
        self.resolve(text, scope, &|full| {
            let is_there = |name: &str| PARTS.iter().any(|table| self.has(table, name));
            let beam = full
                .strip_suffix(".start")
                .or(full.strip_suffix(".end"))
                .or(full.split_once('@').map(|(beam, _)| beam));
            let element = full.rsplit_once('.').map(|(element, _)| element);
            full == "ground"
                || is_there(full)
                || beam.is_some_and(|beam| self.has("beams", beam) || self.mesh_table(beam).is_some())
                || element.is_some_and(|element| {
                    self.has("superelements", element) || self.mesh_table(element).is_some()
                })
        })
    }

    fn node_named(&self, text: &str, span: Span, what: &str) -> Option<NodeReference> {
        if text == "ground" {
            return Some(NodeReference::Ground);
        }
        if self.has("bodies", text) {
            return Some(NodeReference::Body(text.to_owned()));
        }
        if self.has("point_masses", text) {
            return Some(NodeReference::PointMass(text.to_owned()));
        }
        if self.has("beams", text) {
            let message = format!("{what} names the beam `{text}`, which is a line, not a node");
            let help = format!("say which node: \"{text}.start\", \"{text}.end\" or \"{text}@0.5\"");
            return self.fail(span, message, help);
        }
        if self.has("joints", text) {
            let message = format!("{what} names the joint `{text}`, which is not a node");
            let help = "use one of the nodes that it connects; quantities of a joint are recorded by outputs of the kinds `relative` and \
                        `reaction`";
            return self.fail(span, message, help);
        }
        if self.is_of_mesh(text) {
            return self.mesh_node(text, span, what);
        }
        if let Some((superelement, interface)) = self.interface_in(text) {
            return self.interface((superelement, interface), span, what);
        }
        let (beam, fraction) =
            match (text.strip_suffix(".start"), text.strip_suffix(".end"), text.split_once('@')) {
                (Some(beam), ..) => (beam, Some(0.0)),
                (_, Some(beam), _) => (beam, Some(1.0)),
                (_, _, Some((beam, fraction))) => (beam, fraction.trim().parse::<f64>().ok()),
                _ => (text, None),
            };
        let inside = fraction.filter(|fraction| (0.0..=1.0).contains(fraction));
        match inside {
            Some(fraction) if self.has("beams", beam) => {
                Some(NodeReference::Beam { beam: beam.to_owned(), fraction })
            }
            None if self.has("beams", beam) => {
                let message = format!("{what} names `{text}`, which is not a position on the beam `{beam}`");
                self.fail(span, message, "the fraction after `@` must be from 0 (start) to 1 (end)")
            }
            _ => {
                let known = self.node_names();
                let help = suggest::help(text, known.iter().map(String::as_str));
                let problem =
                    Problem::error(span, format!("{what} names the node `{text}`, which does not exist"));
                let other = "nodes are \"ground\", the names of bodies and point masses, and \"beam.start\", \
                             \"beam.end\", \"beam@0.5\", \"superelement.interface\"";
                self.report(problem.label("no such node").help(other).maybe_help(help));
                None
            }
        }
    }

    fn node_names(&self) -> Vec<String> {
        let mut names = vec!["ground".to_owned()];
        for table in ["bodies", "point_masses"] {
            names.extend(self.names(table).into_iter().map(|(name, _)| name.to_owned()));
        }
        for (beam, _) in self.names("beams") {
            names.extend([format!("{beam}.start"), format!("{beam}.end")]);
        }
        for (shell, _) in self.names("shells") {
            names.extend(["west", "east", "south", "north"].map(|side| format!("{shell}.{side}")));
        }
        for (solid, _) in self.names("solids") {
            names.extend(
                ["west", "east", "south", "north", "bottom", "top"].map(|side| format!("{solid}.{side}")),
            );
        }
        for (element, _) in self.names("superelements") {
            names.extend(self.interface_names(element).map(|interface| format!("{element}.{interface}")));
        }
        names
    }

    /// The table of the shell or solid of this name.
    fn mesh_table(&self, name: &str) -> Option<&'static str> {
        ["shells", "solids"].into_iter().find(|table| self.has(table, name))
    }

    /// Whether a text names a shell or solid, or nodes of one.
    fn is_of_mesh(&self, text: &str) -> bool {
        let part = text.split_once('@').or(text.rsplit_once('.')).map_or(text, |(part, _)| part);
        self.mesh_table(text).is_some() || self.mesh_table(part).is_some()
    }

    /// A node or set of nodes of a shell or solid.
    fn mesh_node(&self, text: &str, span: Span, what: &str) -> Option<NodeReference> {
        let reference = |part: &str, place| Some(NodeReference::Mesh { part: part.to_owned(), place });
        // Names in parts have points, too.
        let part = [text.split_once('@'), text.rsplit_once('.')].into_iter().flatten().map(|(part, _)| part);
        let table = part.chain([text]).find_map(|part| self.mesh_table(part));
        let (word, kind, count, all) = match table {
            Some("solids") => ("solid", "volume", 3, "0.5,1,0\" at u, v and w"),
            _ => ("shell", "surface", 2, "0.5,1\" at u and v"),
        };
        let help = |part: &str| {
            format!(
                "say which nodes: \"{part}@{all} from 0 to 1, a side as \"{part}.west\", or one of its `sets`"
            )
        };
        if self.mesh_table(text).is_some() {
            let message = format!("{what} names the {word} `{text}`, which is a {kind}, not a node");
            return self.fail(span, message, help(text));
        }
        if let Some((part, fractions)) = text.split_once('@') {
            let number = |text: &str| text.trim().parse::<f64>().ok().filter(|u| (0.0..=1.0).contains(u));
            let all: Option<Vec<f64>> = fractions.split(',').map(number).collect();
            let Some(all) = all.filter(|all| all.len() == count) else {
                let message = format!("{what} names `{text}`, which is no position on the {word} `{part}`");
                return self.fail(span, message, help(part));
            };
            return reference(part, MeshPlace::Fractions(all));
        }
        let (part, set) = text.rsplit_once('.')?;
        reference(part, MeshPlace::Set(set.to_owned()))
    }

    /// The superelement and the interface of a name of this form.
    fn interface_in<'t>(&self, text: &'t str) -> Option<(&'t str, &'t str)> {
        if self.has("superelements", text) {
            return Some((text, ""));
        }
        text.rsplit_once('.').filter(|(element, _)| self.has("superelements", element))
    }

    /// Names of the interfaces of a superelement, if they can be read.
    fn interface_names(&self, element: &str) -> impl Iterator<Item = &str> {
        let table = self.entry("superelements", element).and_then(Node::table);
        let list = table.and_then(|table| match &table.get("interfaces")?.node.value {
            Value::List(list) => Some(list.as_slice()),
            _ => None,
        });
        list.unwrap_or_default().iter().filter_map(|entry| match &entry.table()?.get("name")?.node.value {
            Value::Text(name) => Some(name.as_str()),
            _ => None,
        })
    }

    fn interface(&self, (element, interface): (&str, &str), span: Span, what: &str) -> Option<NodeReference> {
        if self.interface_names(element).any(|known| known == interface) {
            return Some(NodeReference::Interface {
                superelement: element.to_owned(),
                interface: interface.to_owned(),
            });
        }
        let message = if interface.is_empty() {
            format!("{what} names the superelement `{element}`, not one of its interfaces")
        } else {
            format!("{what} names `{interface}`, which is not an interface of the superelement `{element}`")
        };
        let known: Vec<String> =
            self.interface_names(element).map(|known| format!("\"{element}.{known}\"")).collect();
        self.fail(span, message, format!("its interfaces are {}", known.join(", ")))
    }
}
