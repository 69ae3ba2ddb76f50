//! The words at the top of a model file, and the forms of a table.

use crate::format::keys::{Key, Shape};

/// Contents of a key at the top level of a model file.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum Holds {
    /// A value.
    Value(Shape),
    /// Values by name.
    Values(Shape),
    /// One table.
    Table,
    /// Tables by name.
    Entries,
}

/// A word at the top of a model file.
pub(crate) struct Top {
    pub(crate) name: &'static str,
    pub(crate) holds: Holds,
    pub(crate) required: bool,
    pub(crate) summary: &'static str,
}

const fn top(name: &'static str, holds: Holds, required: bool, summary: &'static str) -> Top {
    Top { name, holds, required, summary }
}

/// The newest version of the format.
pub const VERSION: usize = 1;

/// All the words at the top.
pub(crate) static TOP: [Top; 30] = [
    top("lissom", Holds::Value(Shape::Version), true, "Version of the file format."),
    top("title", Holds::Value(Shape::Text), false, "One line about the model."),
    top(
        "gravity",
        Holds::Value(Shape::GlobalVector),
        false,
        "Acceleration of gravity [m/s²]; default: none.",
    ),
    top("parameters", Holds::Values(Shape::Number), false, "Numbers for use in expressions."),
    top("materials", Holds::Entries, false, "Isotropic elastic materials."),
    top(
        "sections",
        Holds::Entries,
        false,
        "Cross sections; axis 1 along the beam, 2 and 3 perpendicular to it.",
    ),
    top("points", Holds::Values(Shape::Point), false, "Named positions [m]."),
    top(
        "parts",
        Holds::Entries,
        false,
        "Sub-assemblies, which may be placed and repeated; their entries are named `part.name`.",
    ),
    top("beams", Holds::Entries, false, "Flexible beams."),
    top("shells", Holds::Entries, false, "Flexible shells and plates: curved surfaces of finite elements."),
    top("solids", Holds::Entries, false, "Elastic solids: volumes of finite elements."),
    top("bodies", Holds::Entries, false, "Rigid bodies."),
    top("point_masses", Holds::Entries, false, "Point masses."),
    top("superelements", Holds::Entries, false, "Linear elastic parts, specified by reduced matrices."),
    top("joints", Holds::Entries, false, "Constraints between nodes, or between coordinates of joints."),
    top("springs", Holds::Entries, false, "Springs, dampers, friction, stops and latches."),
    top("loads", Holds::Entries, false, "Applied forces and moments, and those of actuators."),
    top(
        "local_loads",
        Holds::Entries,
        false,
        "Forces and moments that depend on the motion of their own points, along beams and on nodes.",
    ),
    top("ground", Holds::Table, false, "Solids that are fixed in space, for contacts and drawings."),
    top(
        "contacts",
        Holds::Entries,
        false,
        "Parts that may touch, by their shapes; `kind` may be omitted: it follows from parts and keys.",
    ),
    top(
        "inputs",
        Holds::Values(Shape::Number),
        false,
        "Numbers that are set during a simulation by events or by the calling program, with their initial values.",
    ),
    top(
        "signals",
        Holds::Values(Shape::Signal),
        false,
        "Named expressions of time, inputs, states and outputs.",
    ),
    top(
        "states",
        Holds::Entries,
        false,
        "First-order states: numbers whose time derivative is an expression.",
    ),
    top("events", Holds::Entries, false, "Actions when expressions cross zero."),
    top(
        "units",
        Holds::Entries,
        false,
        "Units (FMI) of other programs: advanced from sample to sample, or with equations that are solved with those of the model.",
    ),
    top("fluids", Holds::Entries, false, "Fluids of hydraulic parts."),
    top(
        "hydraulics",
        Holds::Entries,
        false,
        "Hydraulic parts: nodes with a pressure, and components between them such as cylinders, valves and pumps.",
    ),
    top(
        "initial",
        Holds::Table,
        false,
        "Initial conditions: a rigid motion of all parts, or of those listed in an entry [initial.…]; static equilibrium.",
    ),
    top(
        "assembly",
        Holds::Table,
        false,
        "Corrects approximate positions of parts: they are moved by the smallest amount that closes all joints at their initial values.",
    ),
    top("outputs", Holds::Entries, false, "Quantities to be recorded."),
];

/// The table of the analysis, separate because it is required.
pub(crate) static ANALYSIS: Top = top("analysis", Holds::Table, true, "Kind of analysis and its settings.");

/// Every word at the top, the analysis last.
pub(crate) fn tops() -> impl Iterator<Item = &'static Top> {
    TOP.iter().chain([&ANALYSIS])
}

/// Whether users choose the words inside this table.
pub(crate) fn has_named_entries(name: &str) -> bool {
    TOP.iter().any(|top| top.name == name && matches!(top.holds, Holds::Values(_) | Holds::Entries))
}

/// One form of a table.
pub(crate) struct Variant {
    /// The word that chooses it.
    pub(crate) word: &'static str,
    pub(crate) summary: &'static str,
    pub(crate) keys: Vec<Key>,
}

/// The forms of a table, and the key whose word chooses among them, if there are several.
pub(crate) struct Variants {
    pub(crate) tag: Option<&'static str>,
    /// Whether an entry without that key has the form that its other keys imply.
    pub(crate) is_inferred: bool,
    pub(crate) all: Vec<Variant>,
}

/// One entry of a table, in words.
pub(crate) fn singular(table: &str) -> &'static str {
    match table {
        "materials" => "material",
        "sections" => "section",
        "points" => "point",
        "beams" => "beam",
        "shells" => "shell",
        "solids" => "solid",
        "bodies" => "body",
        "point_masses" => "point mass",
        "superelements" => "superelement",
        "joints" => "joint",
        "springs" => "spring",
        "loads" => "load",
        "local_loads" => "local load",
        "contacts" => "contact",
        "outputs" => "output",
        "inputs" => "input",
        "signals" => "signal",
        "states" => "state",
        "events" => "event",
        "units" => "unit",
        "fluids" => "fluid",
        "hydraulics" => "hydraulic part",
        "parameters" => "parameter",
        "parts" => "part",
        _ => "entry",
    }
}
