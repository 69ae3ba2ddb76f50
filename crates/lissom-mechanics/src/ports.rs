//! Declaration of what a kind of joint, spring or load is attached to. Decoder, schema, manual, construction of the system,
//! pictures and tests read it; this module is independent of files.

use crate::kinematics::Quantity;
use crate::registry::ModelAxis;

/// Type of a port.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum PortType {
    /// A node.
    Node {
        /// Whether it must not be the ground.
        moves: bool,
        /// Whether its axes are used, so that it cannot be a point mass; for joints their equations determine this.
        axes: bool,
    },
    /// A set of nodes of a shell or solid.
    Set,
    /// A location on nodes at the start [m]. Nodes without one have their own position.
    Location {
        /// Keys of the nodes that it is fixed to.
        of: &'static [&'static str],
        /// Keys of nodes: the first of them that is not the ground has the default location.
        default: &'static [&'static str],
    },
    /// A direction of the joint frame at the start. A single one is that of the third axis, two are those of the first and
    /// the second axis. A direction with a default may be omitted, together with the other one.
    Direction(Option<ModelAxis>),
    /// Several nodes in a sequence, each with its location.
    Locations,
    /// A joint: its first coordinate of this quantity, unless the parameter `coordinate` has the number of another one.
    Coordinate(Quantity),
    /// A joint: its only coordinate, or the one whose number the parameter of this name has.
    OnlyCoordinate(&'static str),
    /// Coordinates of joints in a sequence, all different.
    Coordinates,
    /// Coordinates that an expression names, which is a parameter. The port has no key.
    NamedCoordinates,
    /// Beams in a sequence, each of which starts at the end of the one before.
    Beams,
}

/// A part of the model to which a kind is attached, and the key of a model file that names it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct PortDeclaration {
    /// Key in the model file.
    pub key: &'static str,
    /// What it names.
    pub holds: PortType,
    /// Whether it must be given.
    pub required: bool,
    /// What it is, without a full stop.
    pub summary: &'static str,
    /// The key in a list of all keys, with its default; empty if an earlier port of the kind includes it.
    pub listed: &'static str,
    /// A line of a model file; empty if none is needed.
    pub sample: &'static str,
}

impl PortDeclaration {
    /// A port that must be given, listed by its key.
    pub const fn required(key: &'static str, holds: PortType, summary: &'static str) -> Self {
        Self { key, holds, required: true, summary, listed: key, sample: "" }
    }

    /// A port that may be omitted, listed by its key.
    pub const fn optional(key: &'static str, holds: PortType, summary: &'static str) -> Self {
        Self { required: false, ..Self::required(key, holds, summary) }
    }

    /// This port with these words in a list of all keys.
    pub const fn listed(self, listed: &'static str) -> Self {
        Self { listed, ..self }
    }

    /// This port with a line of a model file.
    pub const fn sample(self, sample: &'static str) -> Self {
        Self { sample, ..self }
    }

    const fn with_axes(mut self) -> Self {
        if let PortType::Node { axes, .. } = &mut self.holds {
            *axes = true;
        }
        self
    }

    const fn location(
        key: &'static str,
        of: &'static [&'static str],
        default: &'static [&'static str],
        summary: &'static str,
    ) -> Self {
        Self::optional(key, PortType::Location { of, default }, summary)
    }
}

const BASE: PortDeclaration = PortDeclaration::required(
    "base",
    PortType::Node { moves: false, axes: false },
    "first node: \"ground\", \"body\", \"beam.end\" …",
)
.sample("base = \"ground\"");
const TIP: PortDeclaration =
    PortDeclaration::required("tip", PortType::Node { moves: false, axes: false }, "second node")
        .sample("tip = \"my_body\"");
const AT_BASE: PortDeclaration = PortDeclaration::location(
    "at_base",
    &["base"],
    &["base"],
    "location on the base; default: the node's position",
)
.sample("at_base = [0.0, 0.0, 0.0]");
const AT_TIP: PortDeclaration = PortDeclaration::location(
    "at_tip",
    &["tip"],
    &["tip"],
    "location on the tip; default: the node's position",
)
.listed("at_tip (default: the nodes' positions)");
const ON: PortDeclaration =
    PortDeclaration::required("on", PortType::Node { moves: true, axes: false }, "node on which it acts")
        .sample("on = \"my_body\"");
const AT_NODE: PortDeclaration =
    PortDeclaration::location("at", &["on"], &["on"], "location; default: the node's position")
        .listed("at (default: the node's position)");
const AT: PortDeclaration = common_location(&["base", "tip"]);
const AT_HINGE: PortDeclaration = common_location(&["base"]);
const AXIS: PortDeclaration =
    PortDeclaration::required("axis", PortType::Direction(None), "direction at the start, global axes");
const SECOND_AXIS: PortDeclaration = PortDeclaration::required(
    "second_axis",
    PortType::Direction(None),
    "second direction at the start, global axes",
);

const fn common_location(of: &'static [&'static str]) -> PortDeclaration {
    let summary = "location; default: the tip node's position";
    PortDeclaration::location("at", of, &["tip", "base"], summary)
        .listed("at (default: the tip's position)")
        .sample("at = [0.0, 0.0, 0.0]")
}

const fn coordinate(
    quantity: Quantity,
    summary: &'static str,
    listed: &'static str,
    sample: &'static str,
) -> PortDeclaration {
    let port = PortDeclaration::required("joint", PortType::Coordinate(quantity), summary);
    port.listed(listed).sample(sample)
}

/// All ports of a kind.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Ports(pub &'static [PortDeclaration]);

impl Ports {
    /// None: the kind has coordinates of its own.
    pub const NONE: Self = Self(&[]);
    /// Two nodes at one location.
    pub const POINT: Self = Self(&[BASE, TIP, AT]);
    /// Two nodes at one location, and an axis.
    pub const AXIS: Self = Self(&[BASE, TIP, AT, AXIS]);
    /// Two nodes, the tip at its own position, and an axis.
    pub const ARM: Self = Self(&[BASE, TIP, AT_HINGE, AXIS]);
    /// Two nodes at one location, and two perpendicular axes.
    pub const TWO_AXES: Self = Self(&[BASE, TIP, AT, AXIS, SECOND_AXIS]);
    /// Two nodes and two perpendicular axes, by default the first two axes of the model.
    pub const AXES_OF_MODEL: Self = Self(&[
        BASE,
        TIP,
        AT,
        PortDeclaration::optional(
            "axis",
            PortType::Direction(Some(ModelAxis::X)),
            "direction of x at the start, global axes; default: global x",
        )
        .listed("axis and second_axis (default: global x and y)"),
        PortDeclaration::optional(
            "second_axis",
            PortType::Direction(Some(ModelAxis::Y)),
            "direction of y at the start, global axes; default: global y",
        )
        .listed(""),
    ]);
    /// Two nodes, each at a location of its own.
    pub const TWO_LOCATIONS: Self = Self(&[BASE, TIP, AT_BASE, AT_TIP]);
    /// Two nodes, each at a location of its own, with axes in both, which cannot be point masses.
    pub const TWO_FRAMES: Self = Self(&[BASE.with_axes(), TIP.with_axes(), AT_BASE, AT_TIP]);
    /// One node.
    pub const ONE_NODE: Self = Self(&[ON, AT_NODE]);
    /// One node with axes, which cannot be a point mass.
    pub const ONE_FRAME: Self = Self(&[ON.with_axes(), AT_NODE]);
    /// A rotation of a joint.
    pub const ROTATION: Self = Self(&[coordinate(
        Quantity::Angle,
        "the joint whose relative rotation it acts on",
        "joint: acts on its relative rotation",
        "joint = \"my_hinge\"",
    )]);
    /// A displacement of a joint.
    pub const DISPLACEMENT: Self = Self(&[coordinate(
        Quantity::Length,
        "the joint whose relative displacement it acts on",
        "joint: acts on its relative displacement",
        "joint = \"my_slide\"",
    )]);
    /// A coordinate of a joint, and one of another joint.
    pub const TWO_COORDINATES: Self = Self(&[
        PortDeclaration::required(
            "joint",
            PortType::OnlyCoordinate("coordinate"),
            "joint with the independent coordinate",
        )
        .sample("joint = \"my_hinge\""),
        PortDeclaration::required(
            "other",
            PortType::OnlyCoordinate("other_coordinate"),
            "joint with the dependent coordinate",
        )
        .listed("other: the joints whose coordinates it relates")
        .sample("other = \"my_slide\""),
    ]);

    fn count(self, is_counted: impl Fn(PortType) -> bool) -> usize {
        self.0.iter().filter(|port| is_counted(port.holds)).count()
    }

    /// Position of the node of this key among the nodes.
    ///
    /// # Panics
    /// If no port names a node by this key.
    pub fn node(self, key: &str) -> usize {
        let mut nodes =
            self.0.iter().filter(|port| matches!(port.holds, PortType::Node { .. } | PortType::Set));
        nodes.position(|port| port.key == key).expect("locations are declared of nodes of the same kind")
    }

    /// Key of the node at this position among the nodes, and whether its axes are used.
    pub fn node_port(self, index: usize) -> (&'static str, bool) {
        let mut nodes = self.0.iter().filter_map(|port| match port.holds {
            PortType::Node { axes, .. } => Some((port.key, axes)),
            PortType::Set => Some((port.key, false)),
            _ => None,
        });
        nodes.nth(index).unwrap_or_else(|| (self.0.first().map_or("", |port| port.key), false))
    }

    /// Whether it connects two nodes, base and tip.
    pub fn connect_two_nodes(self) -> bool {
        self.count(|holds| matches!(holds, PortType::Node { .. } | PortType::Set)) == 2
    }

    /// Number of the keys of locations.
    pub fn locations(self) -> usize {
        self.count(|holds| matches!(holds, PortType::Location { .. }))
    }

    /// Whether it connects two nodes by one location.
    pub fn have_one_location(self) -> bool {
        self.connect_two_nodes() && self.locations() == 1
    }

    /// Number of the keys that name a joint with a coordinate.
    pub fn joints(self) -> usize {
        self.count(|holds| matches!(holds, PortType::Coordinate(_) | PortType::OnlyCoordinate(_)))
    }

    /// Number of the directions that determine the frame.
    pub fn directions(self) -> usize {
        self.count(|holds| matches!(holds, PortType::Direction(_)))
    }

    /// Whether a direction has no default.
    pub fn require_directions(self) -> bool {
        self.count(|holds| holds == PortType::Direction(None)) > 0
    }

    /// Quantity of the one coordinate on which it acts; none for ports of another form.
    pub fn quantity(self) -> Option<Quantity> {
        self.0.iter().find_map(|port| match port.holds {
            PortType::Coordinate(quantity) => Some(quantity),
            _ => None,
        })
    }

    /// Whether a joint with these ports may have friction or a latch: if it joins parts or coordinates and prescribes none.
    pub fn may_have_friction(self) -> bool {
        !self.0.is_empty() && self.quantity().is_none()
    }

    /// Whether an expression names coordinates.
    pub fn name_coordinates(self) -> bool {
        self.count(|holds| holds == PortType::NamedCoordinates) > 0
    }

    /// Whether a joint with these ports relates coordinates of other joints.
    pub fn relate_coordinates(self) -> bool {
        self.name_coordinates() || self.count(|holds| matches!(holds, PortType::OnlyCoordinate(_))) > 0
    }

    /// Position of a joint with these ports in the sequence of all joints: those between parts come before drives of their
    /// coordinates, and these before relations between coordinates.
    pub fn level(self) -> usize {
        if self.relate_coordinates() { 2 } else { usize::from(self.quantity().is_some()) }
    }
}
