//! The description of a unit of another program: `modelDescription.xml` of FMI 2.0 and 3.0.

use lissom_units::{Standard, Variable, VariableType};
use roxmltree::{Document, Node};

use crate::encodings::tags::too_deep;

/// What is known of a unit.
#[derive(Clone, Debug)]
pub(super) struct Description {
    pub(super) standard: Standard,
    /// Name of the shared library without its extension.
    pub(super) library: String,
    /// Instantiation token, or GUID.
    pub(super) token: String,
    /// Whether its state can be stored.
    pub(super) saves: bool,
    pub(super) variables: Vec<Described>,
}

/// A variable of a unit.
#[derive(Clone, Debug)]
pub(super) struct Described {
    pub(super) name: String,
    pub(super) causality: String,
    /// None for types that are no single numbers, such as texts and arrays.
    pub(super) variable: Option<Variable>,
    /// Type in words of the standard.
    pub(super) holds: String,
    pub(super) start: Option<String>,
    /// Whether its value at the start can be set.
    pub(super) is_settable: bool,
}

impl Description {
    /// Reads a description.
    pub(super) fn read(text: &str) -> Result<Self, String> {
        if too_deep(text).is_some() {
            return Err("its description has too many elements one in the other".to_owned());
        }
        let document =
            Document::parse(text).map_err(|error| format!("its description is no XML text: {error}"))?;
        let root = document.root_element();
        let version = root.attribute("fmiVersion").unwrap_or_default();
        let standard = match version.split('.').next() {
            Some("2") => Standard::Fmi2,
            Some("3") => Standard::Fmi3,
            _ => return Err(format!("it is of FMI {version:?}; versions 2.0 and 3.0 are known")),
        };
        let child = |name: &str| root.children().find(|child| child.has_tag_name(name));
        let Some(own) = child("CoSimulation") else {
            let other =
                if child("ModelExchange").is_some() { "model exchange" } else { "scheduled execution" };
            return Err(format!("it supports {other} only; export it for co-simulation"));
        };
        let required = |node: Node<'_, '_>, name: &str| {
            node.attribute(name).map(str::to_owned).ok_or_else(|| format!("its description lacks `{name}`"))
        };
        let is_true = |name: &str| matches!(own.attribute(name), Some("true" | "1"));
        let (token, [can, serializes]) = match standard {
            Standard::Fmi2 => ("guid", ["canGetAndSetFMUstate", "canSerializeFMUstate"]),
            Standard::Fmi3 => ("instantiationToken", ["canGetAndSetFMUState", "canSerializeFMUState"]),
        };
        let variables = child("ModelVariables").into_iter().flat_map(|node| node.children());
        let variables = variables.filter(Node::is_element).map(|node| of_variable(node, standard));
        Ok(Self {
            standard,
            library: required(own, "modelIdentifier")?,
            token: required(root, token)?,
            saves: is_true(can) && is_true(serializes),
            variables: variables.collect::<Result<_, _>>()?,
        })
    }

    /// Folders of the shared library for this platform, as the versions of the standard name them.
    pub(super) fn platforms(&self) -> Vec<String> {
        match self.standard {
            Standard::Fmi3 => vec![super::platform()],
            Standard::Fmi2 => {
                let system = match std::env::consts::OS {
                    "macos" => "darwin",
                    "windows" => "win",
                    other => other,
                };
                let bits = usize::BITS;
                match std::env::consts::ARCH {
                    "x86_64" | "x86" => vec![format!("{system}{bits}")],
                    // Versions 2.0.x have no name for other processors; exporters use these.
                    arch => vec![format!("{arch}-{system}"), format!("{system}{bits}")],
                }
            }
        }
    }
}

fn of_variable(node: Node<'_, '_>, standard: Standard) -> Result<Described, String> {
    let name = node.attribute("name").unwrap_or_default().to_owned();
    let reference = node.attribute("valueReference").and_then(|text| text.parse().ok());
    let reference = reference.ok_or_else(|| format!("its variable `{name}` has no value reference"))?;
    // In FMI 2.0 the type is an element within the variable.
    let typed = match standard {
        Standard::Fmi2 => node.children().find(Node::is_element).unwrap_or(node),
        Standard::Fmi3 => node,
    };
    let holds = typed.tag_name().name().to_owned();
    let is_array = node.children().any(|child| child.has_tag_name("Dimension"));
    let of_type = match holds.as_str() {
        "Real" | "Float64" => Some(VariableType::Real),
        "Integer" | "Int32" => Some(VariableType::Integer),
        "Boolean" => Some(VariableType::Boolean),
        _ => None,
    };
    let variable = of_type.filter(|_| !is_array).map(|holds| Variable { reference, holds });
    let causality = node.attribute("causality").unwrap_or("local").to_owned();
    let is_constant = node.attribute("variability") == Some("constant");
    let is_settable = !is_constant
        && (matches!(causality.as_str(), "parameter" | "input" | "structuralParameter")
            || matches!(node.attribute("initial"), Some("exact" | "approx")));
    let start = typed.attribute("start").map(str::to_owned);
    let holds = if is_array { format!("array of {holds}") } else { holds };
    Ok(Described { name, causality, variable, holds, start, is_settable })
}
