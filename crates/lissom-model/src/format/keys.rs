//! Keys of the tables of a model file, for the decoder, the schema and the reference.
//! Contains words and types, no values.

use std::borrow::Cow;

use lissom_mechanics::ports::{PortDeclaration, PortType};
use lissom_mechanics::registry::{ModelAxis, Parameter, ParameterType};

/// Shape of the value of a key.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum Shape {
    /// A text.
    Text,
    /// The version of the format.
    Version,
    /// A finite number. Every number may also be a text: an expression of the parameters.
    Number,
    /// A number greater than zero.
    Positive,
    /// A number not less than zero.
    NotNegative,
    /// A number from the first to the second, both included.
    Between(f64, f64),
    /// A whole number from the first to the second, both included.
    Count(usize, usize),
    /// True or false.
    Flag,
    /// Three numbers that are not transformed with the part.
    Vector,
    /// Three numbers in global axes; those of the part inside of one.
    GlobalVector,
    /// Three numbers, or a position in the frame of a part.
    Point,
    /// A list of names of parts.
    Names,
    /// Entries as in the table of this name at the top.
    Entries(&'static str),
    /// Three numbers, not all zero, in global axes; those of the part inside of one.
    Direction,
    /// The same with a default: this axis of the part.
    DirectionOr(ModelAxis),
    /// The same in axes of a body, which are not transformed.
    BodyDirection,
    /// One of the words.
    Choice(Cow<'static, [&'static str]>),
    /// A number, an expression of this variable, or a table of it.
    FunctionOf(&'static str),
    /// An expression of coordinates of joints and of `t`.
    Equation,
    /// Some of these words, each at most once.
    Choices(&'static [&'static str]),
    /// The name of an entry of a table.
    Name(&'static str),
    /// The name of a point, or three numbers.
    Place,
    /// The name of a point, three numbers, or a node of another part.
    PlaceOrNode,
    /// A node: `ground`, a body, a point mass, `beam.start`, `beam.end` or `beam@fraction`.
    Node,
    /// A list of nodes.
    Nodes,
    /// A number, an expression of the time `t`, or a table.
    Function,
    /// A number, an expression of time, inputs, signals, states and outputs, or a table.
    Size,
    /// The same without tables.
    Formula,
    /// A formula, or a table of a formula, its sample period and its start.
    Signal,
    /// A number, or an expression of `s`.
    Profile,
    /// Three numbers or expressions of `s`.
    Curve,
    /// Three numbers or expressions of `s` and `t`, in global axes; those of the part inside of one.
    Distribution,
    /// Three numbers or expressions of `s` and `t`, in the axes of the section.
    SectionDistribution,
    /// Two axes of a frame, in the axes around it.
    Axes,
    /// Rotation vector of a frame, in the axes around it.
    Rotation,
    /// A number greater than zero, or a table of a density.
    Mass,
    /// Three numbers, a 3 x 3 matrix, or a table of a solid.
    Inertia,
    /// A table of a solid.
    Solid,
    /// A table of friction in a joint.
    Friction,
    /// A table of a latch on a joint.
    Latch,
    /// Six numbers, or a 6 x 6 matrix.
    Stiffness,
    /// A 6 x 6 matrix, or a table of mass per length, inertia and centre.
    SectionMass,
    /// A number, two numbers, or the name of a theory.
    Shear,
    /// A list of sections and where they are.
    Stations,
    /// A list of nodes and locations on them.
    Places,
    /// A list of names and positions in the axes of the part.
    Interfaces,
    /// A list of pairs of numbers.
    Rows,
    /// A list of lists of equally many numbers.
    NumberRows,
    /// Two numbers.
    Pair,
    /// Two texts.
    Words,
    /// A number, an expression of the two named quantities, or a table over the first.
    Force(&'static [&'static str; 2]),
    /// Two ascending numbers, which may be infinite.
    Range,
    /// A list of numbers.
    Numbers,
    /// A number, a list of numbers, or a square list of lists of numbers.
    SquareMatrix,
    /// A list of joints, or of their coordinates, such as `arm.angle`.
    Coordinates,
    /// A table that is read entry by entry.
    Table,
}

/// Pattern of the shapes of exactly three numbers or expressions, and of others that are added.
macro_rules! three_numbers {
    ($($other:pat_param),*) => {
        Shape::Vector
            | Shape::GlobalVector
            | Shape::Curve
            | Shape::Distribution
            | Shape::SectionDistribution
            | Shape::Rotation
            $(| $other)*
    };
}

/// Pattern of the shapes of directions.
macro_rules! direction {
    () => {
        Shape::Direction | Shape::DirectionOr(_) | Shape::BodyDirection
    };
}

pub(crate) use {direction, three_numbers};

impl Shape {
    /// Whether the value is expressed in model axes, so that the decoder transforms it with the part in which it is written.
    pub(crate) fn is_in_model_axes(&self) -> bool {
        match self {
            Self::GlobalVector
            | Self::Point
            | Self::Direction
            | Self::DirectionOr(_)
            | Self::Place
            | Self::PlaceOrNode
            | Self::Places
            | Self::Curve
            | Self::Distribution
            | Self::Axes
            | Self::Rotation => true,
            // The first eight are in axes of a body, a section or an element; the others have no axes.
            Self::Vector
            | Self::BodyDirection
            | Self::SectionDistribution
            | Self::Inertia
            | Self::Solid
            | Self::Stiffness
            | Self::SectionMass
            | Self::Interfaces
            | Self::Text
            | Self::Version
            | Self::Number
            | Self::Positive
            | Self::NotNegative
            | Self::Between(..)
            | Self::Count(..)
            | Self::Flag
            | Self::Names
            | Self::Entries(_)
            | Self::Choice(_)
            | Self::FunctionOf(_)
            | Self::Equation
            | Self::Choices(_)
            | Self::Name(_)
            | Self::Node
            | Self::Nodes
            | Self::Function
            | Self::Size
            | Self::Formula
            | Self::Signal
            | Self::Profile
            | Self::Mass
            | Self::Friction
            | Self::Latch
            | Self::Shear
            | Self::Stations
            | Self::Rows
            | Self::NumberRows
            | Self::Pair
            | Self::Words
            | Self::Force(_)
            | Self::Range
            | Self::Numbers
            | Self::SquareMatrix
            | Self::Coordinates
            | Self::Table => false,
        }
    }

    /// Keys of a section's mass that is given by its parts.
    pub(crate) fn slice_mass_keys() -> Vec<Key> {
        vec![
            required("per_length", Self::Positive, "kg/m", "mass per length"),
            required("inertia", Self::Vector, "kg m", "[J11, J22, J33] per length about the centre of mass"),
            optional("center", Self::Pair, "m", "[c2, c3]: centre of mass across the beam"),
        ]
    }

    /// Keys of one of several positions.
    pub(crate) fn place_keys() -> Vec<Key> {
        vec![
            required("on", Self::Node, "", "the node that carries it"),
            optional("at", Self::Place, "m", "location at the start; default: the node's position"),
        ]
    }

    /// Keys of an interface of a superelement.
    pub(crate) fn interface_keys() -> Vec<Key> {
        vec![
            required("name", Self::Text, "", "its name: its node is `superelement.name`"),
            optional("at", Self::Vector, "m", "position in the axes of the part; default its origin"),
        ]
    }

    /// Keys of a signal that is given by a table.
    pub(crate) fn signal_keys() -> Vec<Key> {
        let mut keys = vec![
            optional("value", Self::Formula, "", "its expression; either it or `of` is required"),
            optional("of", Self::Formula, "", "the expression over which a table is"),
            optional(
                "sample",
                Self::Positive,
                "s",
                "time from sample to sample; the value is held in between",
            ),
            optional(
                "delay",
                Self::Positive,
                "s",
                "the signal is the value of its expression this time earlier; excludes `sample`",
            ),
            optional(
                "start",
                Self::Number,
                "",
                "value before the first sample, default 0; with `delay` the value before the start, default the expression there",
            ),
            optional(
                "numerator",
                Self::Numbers,
                "",
                "of a discrete filter: [b0, b1, …] of the expression's present and past samples",
            ),
            optional(
                "denominator",
                Self::Numbers,
                "",
                "of a discrete filter: [1, a1, …] of the signal's present and past samples, default [1]",
            ),
        ];
        keys.extend(table_keys());
        keys
    }

    /// Keys of a mass that is given by a density.
    pub(crate) fn density_keys() -> Vec<Key> {
        vec![required("density", Self::Positive, "kg/m³", "mass density of the solid that `inertia` names")]
    }

    /// Keys of an inertia that is given by a solid.
    pub(crate) fn solid_keys() -> Vec<Key> {
        vec![
            optional(
                "kind",
                choice(&["box", "cylinder", "tube", "sphere", "capsule", "ellipsoid"]),
                "",
                "which solid it is",
            ),
            optional("sides", Self::Vector, "m", "of a box, along the body axes"),
            optional(
                "radius",
                Self::Positive,
                "m",
                "of a cylinder, sphere or capsule; the outer one of a tube",
            ),
            optional("inner_radius", Self::Positive, "m", "of a tube"),
            optional(
                "length",
                Self::Positive,
                "m",
                "of a cylinder or tube; of a capsule between the centres of its ends",
            ),
            optional("axis", Self::BodyDirection, "", "of a cylinder, tube or capsule, body axes; default z"),
            optional("semi_axes", Self::Vector, "m", "of an ellipsoid, along the body axes"),
            optional("box", Self::Vector, "m", "sides along the body axes, instead of `kind` and dimensions"),
            optional("cylinder", Self::Pair, "m", "[radius, length], instead of `kind` and dimensions"),
            optional(
                "tube",
                Self::Vector,
                "m",
                "[outer radius, inner radius, length], instead of `kind` and dimensions",
            ),
            optional("sphere", Self::Positive, "m", "radius, instead of `kind` and dimensions"),
        ]
    }

    /// Keys of what is drawn of a body.
    pub(crate) fn drawn_keys() -> Vec<Key> {
        let mut keys = Self::solid_keys();
        keys[0].holds = choice(&[
            "box",
            "cylinder",
            "tube",
            "sphere",
            "capsule",
            "ellipsoid",
            "plane",
            "outline",
            "hull",
            "height_field",
            "mesh",
        ]);
        keys.extend([
            optional(
                "points",
                Self::NumberRows,
                "m",
                "of an outline [x, y], the corners of a prism along z in their order, or of a hull [x, y, z], its corners",
            ),
            optional(
                "smooth",
                Self::Flag,
                "",
                "of an outline: whether a smooth curve passes through its points, as for a cam; default `false`",
            ),
            optional(
                "heights",
                Self::NumberRows,
                "m",
                "of a height field: by row along y, in each row along x",
            ),
            optional("extent", Self::Pair, "m", "of a height field: its sides along x and y"),
            optional(
                "normal",
                Self::BodyDirection,
                "",
                "of a plane, body axes: out of the solid half-space; default z",
            ),
            optional("file", Self::Text, "", "of a mesh: an STL or glTF file; path relative to this file"),
            optional("touches", Self::Flag, "", "whether contacts of the part include it, default `true`"),
            optional("scale", Self::Vector, "", "of a mesh: factors along its axes, to metres; default 1"),
            optional(
                "position",
                Self::Vector,
                "m",
                "body axes; default the centre of mass, of a mesh the origin",
            ),
            optional("rotation", Self::Vector, "rad", "rotation vector, body axes"),
        ]);
        keys
    }

    /// Keys of friction in a joint.
    pub(crate) fn friction_keys() -> Vec<Key> {
        vec![
            required("coulomb", Self::Positive, "N, N m", "sliding friction"),
            optional(
                "static",
                Self::Positive,
                "N, N m",
                "friction at rest, not below `coulomb`; default equal",
            ),
            optional(
                "stribeck",
                Self::Positive,
                "m/s, rad/s",
                "rate at which the difference is 1/e; default 0.01",
            ),
            optional("viscous", Self::NotNegative, "N s/m, N m s/rad", "force per rate besides, default 0"),
            optional("deflection", Self::Positive, "m, rad", "elastic motion before it slips, default 1e-4"),
            optional("damping", Self::NotNegative, "N s/m, N m s/rad", "of the elastic motion, default 0"),
        ]
    }

    /// Keys of a latch on a joint.
    pub(crate) fn latch_keys() -> Vec<Key> {
        vec![required(
            "at",
            Self::Number,
            "m, rad",
            "value of the joint's only coordinate at which it engages, from either side",
        )]
    }

    /// Keys of an entry of a beam's stations.
    pub(crate) fn station_keys() -> Vec<Key> {
        vec![
            required("at", Self::Between(0.0, 1.0), "", "fraction of the beam"),
            required("section", Self::Name("sections"), "", "name of a section"),
        ]
    }
}

/// One key of a table.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Key {
    /// Word in the model file.
    pub(crate) name: &'static str,
    /// Shape of its value.
    pub(crate) holds: Shape,
    /// Whether it must be given.
    pub(crate) required: bool,
    /// Unit, as in `kg/m³`; empty for none.
    pub(crate) unit: &'static str,
    /// One sentence.
    pub(crate) summary: &'static str,
}

/// A key that must be given.
pub(crate) const fn required(
    name: &'static str,
    holds: Shape,
    unit: &'static str,
    summary: &'static str,
) -> Key {
    Key { name, holds, required: true, unit, summary }
}

/// A key that may be omitted.
pub(crate) const fn optional(
    name: &'static str,
    holds: Shape,
    unit: &'static str,
    summary: &'static str,
) -> Key {
    Key { name, holds, required: false, unit, summary }
}

/// A choice among fixed words.
pub(crate) const fn choice(words: &'static [&'static str]) -> Shape {
    Shape::Choice(Cow::Borrowed(words))
}

/// The key of a registered parameter.
pub(crate) fn of_parameter(parameter: &Parameter) -> Key {
    let holds = match parameter.holds {
        ParameterType::Number => Shape::Number,
        ParameterType::Positive => Shape::Positive,
        ParameterType::NotNegative => Shape::NotNegative,
        ParameterType::Vector => Shape::Vector,
        ParameterType::GlobalVector => Shape::GlobalVector,
        ParameterType::Direction => Shape::Direction,
        ParameterType::DirectionOr(axis) => Shape::DirectionOr(axis),
        ParameterType::Flag => Shape::Flag,
        ParameterType::Function => Shape::Function,
        ParameterType::Size => Shape::Size,
        ParameterType::Force(names) => Shape::Force(names),
        ParameterType::Range => Shape::Range,
        ParameterType::Matrix => Shape::Stiffness,
        ParameterType::Choice(words) => choice(words),
        ParameterType::Choices(words) => Shape::Choices(words),
        ParameterType::FunctionOf(variable) => Shape::FunctionOf(variable),
        ParameterType::Equation => Shape::Equation,
        ParameterType::Numbers => Shape::Numbers,
        ParameterType::SquareMatrix => Shape::SquareMatrix,
        ParameterType::Input => Shape::Name("inputs"),
    };
    let Parameter { name, required, unit, summary, .. } = *parameter;
    Key { name, holds, required, unit, summary }
}

/// The key of a port; none if it has no key of its own.
pub(crate) fn of_port(port: &PortDeclaration) -> Option<Key> {
    let holds = match port.holds {
        PortType::Node { .. } => Shape::Node,
        PortType::Location { .. } => Shape::Place,
        PortType::Direction(None) => Shape::Direction,
        PortType::Direction(Some(axis)) => Shape::DirectionOr(axis),
        PortType::Locations => Shape::Places,
        PortType::Coordinate(_) | PortType::OnlyCoordinate(_) => Shape::Name("joints"),
        PortType::Coordinates => Shape::Coordinates,
        PortType::NamedCoordinates => return None,
        PortType::Beams => Shape::Names,
    };
    let unit = if matches!(holds, Shape::Place | Shape::Places) { "m" } else { "" };
    let PortDeclaration { key: name, required, summary, .. } = *port;
    Some(Key { name, holds, required, unit, summary })
}

/// Keys of a table.
pub(crate) fn table_keys() -> Vec<Key> {
    let words = choice(&["linear", "spline", "monotone"]);
    vec![
        optional(
            "table",
            Shape::Rows,
            "",
            "rows [argument, value] with ascending arguments; either it or `file` is required",
        ),
        optional(
            "file",
            Shape::Text,
            "",
            "a text file with named columns; relative to the file that names it",
        ),
        optional("columns", Shape::Words, "", "names of its two columns; default the first two"),
        optional("interpolation", words, "", "between the rows, default linear"),
        optional(
            "extrapolation",
            choice(&["constant", "linear"]),
            "",
            "beyond the rows; default constant, for forces over an elongation, rotation or rate linear",
        ),
        optional(
            "period",
            Shape::Number,
            "",
            "argument after which the rows are repeated, such as `2*pi` for one turn of a cam; with `spline` or `monotone`",
        ),
    ]
}
