//! The description of a unit of another program: `modelDescription.xml` of FMI 2.0 and 3.0.

use lissom_units::{Standard, Variable, VariableType};
use roxmltree::{Document, Node};

use crate::encodings::tags::{too_deep, without_comments};

/// What is known of a unit.
#[derive(Clone, Debug)]
pub(super) struct Description {
    pub(super) standard: Standard,
    /// Instantiation token, or GUID.
    pub(super) token: String,
    pub(super) co_simulation: Option<Kind>,
    pub(super) model_exchange: Option<Kind>,
    pub(super) variables: Vec<Described>,
    /// Outputs with the variables on which they depend; none if these are unknown.
    pub(super) outputs: Vec<(usize, Option<Vec<usize>>)>,
    /// Derivatives of continuous states, likewise.
    pub(super) derivatives: Vec<(usize, Option<Vec<usize>>)>,
    /// Number of event indicators.
    pub(super) indicators: usize,
}

/// What a unit supports for co-simulation or model exchange.
#[derive(Clone, Debug)]
pub(super) struct Kind {
    /// Name of the shared library without its extension.
    pub(super) library: String,
    /// Whether its state can be stored.
    pub(super) saves: bool,
    /// Whether it provides directional derivatives.
    pub(super) differentiates: bool,
    /// Whether it must be notified of accepted steps.
    pub(super) completes: bool,
}

/// A variable of a unit.
#[derive(Clone, Debug)]
pub(super) struct Described {
    pub(super) name: String,
    /// Value reference.
    pub(super) reference: u32,
    pub(super) causality: String,
    /// None for types that are no single numbers, such as texts and arrays.
    pub(super) variable: Option<Variable>,
    /// Type in words of the standard.
    pub(super) holds: String,
    pub(super) start: Option<String>,
    /// Whether its value at the start can be set.
    pub(super) is_settable: bool,
    /// Whether it changes between events.
    pub(super) is_continuous: bool,
    /// Usual magnitude.
    pub(super) nominal: f64,
    /// For a derivative: its state, by the index or the value reference, as the version of the standard defines.
    pub(super) derivative: Option<u32>,
}

/// Largest number of event indicators: every step evaluates them all.
const MAX_INDICATORS: usize = 2000;

impl Description {
    /// Reads a description.
    pub(super) fn read(text: &str) -> Result<Self, String> {
        let text = &without_comments(text.to_owned());
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
        let required = |node: Node<'_, '_>, name: &str| {
            node.attribute(name).map(str::to_owned).ok_or_else(|| format!("its description lacks `{name}`"))
        };
        let (token, [can, serializes]) = match standard {
            Standard::Fmi2 => ("guid", ["canGetAndSetFMUstate", "canSerializeFMUstate"]),
            Standard::Fmi3 => ("instantiationToken", ["canGetAndSetFMUState", "canSerializeFMUState"]),
        };
        let kind = |name: &str| {
            let Some(own) = child(name) else { return Ok(None) };
            let is_true = |name: &str| matches!(own.attribute(name), Some("true" | "1"));
            let is_needed = own.attribute("needsCompletedIntegratorStep").is_none()
                || is_true("needsCompletedIntegratorStep");
            Ok::<_, String>(Some(Kind {
                library: required(own, "modelIdentifier")?,
                saves: is_true(can) && is_true(serializes),
                differentiates: is_true("providesDirectionalDerivative")
                    || is_true("providesDirectionalDerivatives"),
                completes: is_needed && !is_true("completedIntegratorStepNotNeeded"),
            }))
        };
        let variables = child("ModelVariables").into_iter().flat_map(|node| node.children());
        let variables = variables.filter(Node::is_element).map(|node| of_variable(node, standard));
        let variables: Vec<Described> = variables.collect::<Result<_, _>>()?;
        let structure = child("ModelStructure");
        let unknowns = |second: &str, third: &str| {
            let nodes: Vec<Node<'_, '_>> = match standard {
                Standard::Fmi2 => {
                    let list =
                        structure.and_then(|node| node.children().find(|own| own.has_tag_name(second)));
                    list.into_iter().flat_map(|node| node.children()).filter(Node::is_element).collect()
                }
                Standard::Fmi3 => {
                    let all = structure.into_iter().flat_map(|node| node.children());
                    all.filter(|node| node.has_tag_name(third)).collect()
                }
            };
            nodes
                .into_iter()
                .map(|node| of_unknown(node, standard, &variables))
                .collect::<Result<Vec<_>, _>>()
        };
        let (outputs, derivatives) =
            (unknowns("Outputs", "Output")?, unknowns("Derivatives", "ContinuousStateDerivative")?);
        let indicators = match standard {
            Standard::Fmi2 => root.attribute("numberOfEventIndicators").map_or(0, |count| {
                // What is no number is more than can be used.
                count.trim().parse().unwrap_or(usize::MAX)
            }),
            Standard::Fmi3 => {
                let all = unknowns("", "EventIndicator")?;
                if let Some((array, _)) = all.iter().find(|(index, _)| variables[*index].variable.is_none()) {
                    return Err(format!("its event indicator `{}` is an array", variables[*array].name));
                }
                all.len()
            }
        };
        if indicators > MAX_INDICATORS {
            return Err(format!("its description has more than {MAX_INDICATORS} event indicators"));
        }
        let [co_simulation, model_exchange] = [kind("CoSimulation")?, kind("ModelExchange")?];
        Ok(Self {
            standard,
            token: required(root, token)?,
            co_simulation,
            model_exchange,
            outputs,
            derivatives,
            indicators,
            variables,
        })
    }

    /// The variable that an attribute names: by the index from 1 in FMI 2.0, by the value reference in FMI 3.0.
    pub(super) fn named(&self, number: u32) -> Option<usize> {
        named(&self.variables, self.standard, number)
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

fn named(variables: &[Described], standard: Standard, number: u32) -> Option<usize> {
    match standard {
        Standard::Fmi2 => (number as usize).checked_sub(1).filter(|index| *index < variables.len()),
        Standard::Fmi3 => variables.iter().position(|own| own.reference == number),
    }
}

/// A variable of the structure with those on which it depends.
fn of_unknown(
    node: Node<'_, '_>,
    standard: Standard,
    variables: &[Described],
) -> Result<(usize, Option<Vec<usize>>), String> {
    let find = |text: &str| text.parse().ok().and_then(|number| named(variables, standard, number));
    let own = node.attribute(if standard == Standard::Fmi2 { "index" } else { "valueReference" });
    let wrong = || "its model structure names a variable that it does not have".to_owned();
    let index = own.and_then(find).ok_or_else(wrong)?;
    let Some(list) = node.attribute("dependencies") else { return Ok((index, None)) };
    let all = list.split_whitespace().map(|text| find(text).ok_or_else(wrong));
    Ok((index, Some(all.collect::<Result<_, _>>()?)))
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
    let is_real = variable.is_some_and(|variable| variable.holds == VariableType::Real);
    let is_continuous = is_real
        && causality != "parameter"
        && matches!(node.attribute("variability"), None | Some("continuous"));
    let nominal = typed.attribute("nominal").and_then(|text| text.parse::<f64>().ok()).map(f64::abs);
    Ok(Described {
        name,
        reference,
        causality,
        variable,
        holds,
        start,
        is_settable,
        is_continuous,
        nominal: nominal.filter(|nominal| *nominal > 0.0 && nominal.is_finite()).unwrap_or(1.0),
        derivative: typed.attribute("derivative").and_then(|text| text.parse().ok()),
    })
}
