//! Keys of the tables of a model file, for the decoder, the schema and the reference: their words, types and defaults.

use std::borrow::Cow;

use lissom_mechanics::ports::{PortDeclaration, PortType};
use lissom_mechanics::registry::{Declared, Parameter, ParameterType};
pub(crate) use lissom_mechanics::registry::{optional, required, unitless};

use super::solid_kinds::SOLID_KINDS;
pub(crate) use super::value_types::Shape;

impl Shape {
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
            optional(
                "radius",
                Self::Positive,
                "m",
                "of a sheave with its centre there; at an end of a drum on which the rope is wound",
            ),
            unitless("axis", Self::Direction, "axis of the sheave at the start, global axes"),
            unitless(
                "sense",
                choice(&["positive", "negative"]),
                "in which the rope turns about `axis` from its first point to its last; default: from the neighbours",
            ),
            unitless(
                "joint",
                Self::Text,
                "at an end: joint or coordinate by which the drum turns, for more than half a turn",
            ),
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
            unitless("value", Self::Formula, "its expression; either it or `of` is required"),
            unitless("of", Self::Formula, "the expression over which a table is"),
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
            unitless(
                "start",
                Self::Number,
                "value before the first sample, zero if it is omitted; with `delay` the value before the start, default the expression there",
            ),
            unitless(
                "numerator",
                Self::Numbers,
                "of a discrete filter: [b0, b1, …] of the expression's present and past samples",
            ),
            unitless(
                "denominator",
                Self::Numbers,
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
            unitless(
                "kind",
                choice(&["box", "cylinder", "tube", "sphere", "capsule", "ellipsoid"]),
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
                "of a cylinder or tube, and of an outline as it is drawn; of a capsule between the centres of its ends",
            ),
            unitless(
                "axis",
                Self::BodyDirection,
                "of a cylinder, tube, capsule or outline, body axes; default z",
            ),
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
        keys[0].holds = Self::Choice(SOLID_KINDS.iter().map(|kind| kind.word).collect());
        keys.extend([
            optional(
                "points",
                Self::NumberRows,
                "m",
                "of an outline [x, y], the corners of a prism along its axis in their order, or of a hull [x, y, z], its corners",
            ),
            unitless(
                "smooth",
                Self::Flag,
                "of an outline: whether a smooth curve passes through its points, as for a cam",
            ).or_flag(false),
            optional(
                "heights",
                Self::NumberRows,
                "m",
                "of a height field: by row along y, in each row along x",
            ),
            optional("extent", Self::Pair, "m", "of a height field: its sides along x and y"),
            unitless(
                "normal",
                Self::BodyDirection,
                "of a plane, body axes: out of the solid half-space; default z",
            ),
            unitless("file", Self::Text, "of a mesh: an STL or glTF file; path relative to this file"),
            unitless("touches", Self::Flag, "whether contacts of the part include it").or_flag(true),
            unitless("scale", Self::Vector, "of a mesh: factors along its axes, to metres").or_number(1.0),
            optional(
                "position",
                Self::Vector,
                "m",
                "of its centre or of the origin of a mesh, from the body's reference point, body axes; default: a solid is at the centre of mass, a mesh at the reference point",
            ),
            optional("rotation", Self::Vector, "rad", "rotation vector, body axes"),
            unitless("colour", Self::Text, "in which it is drawn, such as \"#d1495b\"; default: that of the part"),
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
            optional("stribeck", Self::Positive, "m/s, rad/s", "rate at which the difference is 1/e")
                .or_number(0.01),
            optional("viscous", Self::NotNegative, "N s/m, N m s/rad", "force per rate besides")
                .or_number(0.0),
            optional("deflection", Self::Positive, "m, rad", "elastic motion before it slips")
                .or_number(1e-4),
            optional("damping", Self::NotNegative, "N s/m, N m s/rad", "of the elastic motion")
                .or_number(0.0),
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
pub(crate) type Key = Declared<Shape>;

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
        ParameterType::Between(low, high) => Shape::Between(low, high),
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
        ParameterType::Coefficients => Shape::Coefficients,
        ParameterType::HeightField => Shape::HeightField,
    };
    let Parameter { name, required, unit, summary, default, usual, .. } = *parameter;
    Key { name, holds, required, unit, summary, default, usual }
}

/// The key of a port; none if it has no key of its own.
pub(crate) fn of_port(port: &PortDeclaration) -> Option<Key> {
    let holds = match port.holds {
        PortType::Node { .. } | PortType::Set => Shape::Node,
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
    Some(Key { name, holds, required, unit, summary, default: None, usual: None })
}

/// Keys of a table.
pub(crate) fn table_keys() -> Vec<Key> {
    let words = choice(&["linear", "spline", "monotone"]);
    vec![
        unitless(
            "table",
            Shape::Rows,
            "rows [argument, value] with ascending arguments; either it or `file` is required",
        ),
        unitless("file", Shape::Text, "a text file with named columns; relative to the file that names it"),
        unitless("columns", Shape::Words, "names of its two columns; default the first two"),
        unitless("interpolation", words, "between the rows").or_word("linear"),
        unitless(
            "extrapolation",
            choice(&["constant", "linear"]),
            "beyond the rows; default constant, for forces over an elongation, rotation or rate linear",
        ),
        unitless(
            "period",
            Shape::Number,
            "argument after which the rows are repeated, such as `2*pi` for one turn of a cam; with `spline` or `monotone`",
        ),
    ]
}
