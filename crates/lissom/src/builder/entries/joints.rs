// Made by `cargo xtask reference` of the program's own tables: do not edit.
//! Constraints between nodes, or between coordinates of joints, one type per kind.

use super::words;
use crate::builder::entry::{entry, keys, nested};
use crate::builder::expression::{Expression, Function};
use crate::builder::values::Node;
use crate::ids::{JointId, Part};

entry! {
    /// A coordinate of `other` is a function of a coordinate of `joint`, such as the profile of a cam.
    Cam => JointId, "cam";
    ["kind" = "cam"]
    /// With what must be given.
    ///
    /// - `joint`: joint with the independent coordinate
    /// - `other`: joint with the dependent coordinate
    /// - `profile`: The other coordinate as a function of the first, `x` \[m or rad\]
    new(joint: JointId = "joint", other: JointId = "other", profile: Function = "profile")
}

entry! {
    /// Locks all six relative degrees of freedom.
    Clamp => JointId, "clamp";
    ["kind" = "clamp"]
    /// With what must be given.
    ///
    /// - `base`: first node: "ground", "body", "beam.end" …
    /// - `tip`: second node
    new(base: Node = "base", tip: Node = "tip")
}

entry! {
    /// Two shafts with a common point and any angle between them rotate by the same angle.
    ConstantVelocity => JointId, "constant_velocity";
    ["kind" = "constant_velocity"]
    /// With what must be given.
    ///
    /// - `base`: first node: "ground", "body", "beam.end" …
    /// - `tip`: second node
    /// - `axis`: direction at the start, global axes
    new(base: Node = "base", tip: Node = "tip", axis: [f64; 3] = "axis")
    /// Direction of the tip's shaft at the start, global axes; default: `axis`, the direction of the base's shaft.
    tip_axis: [f64; 3] = "tip_axis";
}

entry! {
    /// The tip slides along an axis and rotates about it; rotation and displacement are coordinates.
    Cylindrical => JointId, "cylindrical";
    ["kind" = "cylindrical"]
    /// With what must be given.
    ///
    /// - `base`: first node: "ground", "body", "beam.end" …
    /// - `tip`: second node
    /// - `axis`: direction at the start, global axes
    new(base: Node = "base", tip: Node = "tip", axis: [f64; 3] = "axis")
}

entry! {
    /// Keeps the distance of two points constant: a massless rod with spherical joints at its ends.
    Distance => JointId, "distance";
    ["kind" = "distance"]
    /// With what must be given.
    ///
    /// - `base`: first node: "ground", "body", "beam.end" …
    /// - `tip`: second node
    new(base: Node = "base", tip: Node = "tip")
}

entry! {
    /// An expression of joint coordinates and time is zero: planetary gears, differentials, curves.
    Equation => JointId, "equation";
    ["kind" = "equation"]
    /// With what must be given.
    ///
    /// - `equation`: The expression that is zero, of coordinates such as `arm.angle` and `slide.displacement`, and of `t`
    new(equation: Expression = "equation")
}

entry! {
    /// A coordinate of `other` changes by `ratio` times the change of a coordinate of `joint`: gears, racks, belts.
    Gear => JointId, "gear";
    ["kind" = "gear"]
    /// With what must be given.
    ///
    /// - `joint`: joint with the independent coordinate
    /// - `other`: joint with the dependent coordinate
    /// - `ratio`: Change of the dependent coordinate per change of the independent one; negative for external gears \[1, m/rad or rad/m\]
    new(joint: JointId = "joint", other: JointId = "other", ratio: f64 = "ratio")
    /// Whether it is meant to relate rotations relative to parts that turn against each other, which is warned about otherwise; default `false`.
    relative: bool = "relative";
}

entry! {
    /// Generalised coordinates that belong to no part, for springs, loads, gears and `coordinate_dynamics`.
    GeneralizedCoordinates => JointId, "generalized_coordinates";
    ["kind" = "generalized_coordinates"]
    /// With what must be given.
    ///
    /// - `start`: Values at the start: as many as there are coordinates \[m or rad\]
    new(start: Vec<f64> = "start")
    /// Rates at the start, as many as in `start`; default zeros \[m/s or rad/s\].
    rate: Vec<f64> = "rate";
    /// Whether they are rotations \[rad\] instead of displacements \[m\]; default `false`.
    rotations: bool = "rotations";
}

entry! {
    /// Locks chosen translations and rotations of the tip in the axes of the base.
    Generic => JointId, "generic";
    ["kind" = "generic"]
    /// With what must be given.
    ///
    /// - `base`: first node: "ground", "body", "beam.end" …
    /// - `tip`: second node
    /// - `locked`: Locked motions: x along `axis`, y along `second_axis`, z perpendicular to both; rx, ry, rz about them
    new(base: Node = "base", tip: Node = "tip", locked: Vec<words::Locked> = "locked")
}

entry! {
    /// The tip's point moves along a line fixed in the base; like `point_on_line`, but without a coordinate.
    Inline => JointId, "inline";
    ["kind" = "inline"]
    /// With what must be given.
    ///
    /// - `base`: first node: "ground", "body", "beam.end" …
    /// - `tip`: second node
    /// - `axis`: direction at the start, global axes
    new(base: Node = "base", tip: Node = "tip", axis: [f64; 3] = "axis")
}

entry! {
    /// The tip rotates only about `axis` and translates freely; the relative rotation is a coordinate.
    ParallelAxes => JointId, "parallel_axes";
    ["kind" = "parallel_axes"]
    /// With what must be given.
    ///
    /// - `base`: first node: "ground", "body", "beam.end" …
    /// - `tip`: second node
    /// - `axis`: direction at the start, global axes
    new(base: Node = "base", tip: Node = "tip", axis: [f64; 3] = "axis")
}

entry! {
    /// Keeps `axis`, fixed in the base, perpendicular to `second_axis`, fixed in the tip.
    PerpendicularAxes => JointId, "perpendicular_axes";
    ["kind" = "perpendicular_axes"]
    /// With what must be given.
    ///
    /// - `base`: first node: "ground", "body", "beam.end" …
    /// - `tip`: second node
    /// - `axis`: direction at the start, global axes
    /// - `second_axis`: second direction at the start, global axes
    new(base: Node = "base", tip: Node = "tip", axis: [f64; 3] = "axis", second_axis: [f64; 3] = "second_axis")
}

entry! {
    /// The tip translates in the plane perpendicular to `axis` and rotates about it; the rotation is a coordinate.
    Planar => JointId, "planar";
    ["kind" = "planar"]
    /// With what must be given.
    ///
    /// - `base`: first node: "ground", "body", "beam.end" …
    /// - `tip`: second node
    /// - `axis`: direction at the start, global axes
    new(base: Node = "base", tip: Node = "tip", axis: [f64; 3] = "axis")
}

entry! {
    /// The tip's point moves in the base's plane perpendicular to `axis`; the tip rotates freely.
    PointInPlane => JointId, "point_in_plane";
    ["kind" = "point_in_plane"]
    /// With what must be given.
    ///
    /// - `base`: first node: "ground", "body", "beam.end" …
    /// - `tip`: second node
    /// - `axis`: direction at the start, global axes
    new(base: Node = "base", tip: Node = "tip", axis: [f64; 3] = "axis")
}

entry! {
    /// The tip's point slides along a line fixed in the base; the tip rotates freely; the displacement is a coordinate.
    PointOnLine => JointId, "point_on_line";
    ["kind" = "point_on_line"]
    /// With what must be given.
    ///
    /// - `base`: first node: "ground", "body", "beam.end" …
    /// - `tip`: second node
    /// - `axis`: direction at the start, global axes
    new(base: Node = "base", tip: Node = "tip", axis: [f64; 3] = "axis")
}

entry! {
    /// Prescribes a joint's relative displacement as a function of time.
    PrescribedDisplacement => JointId, "prescribed_displacement";
    ["kind" = "prescribed_displacement"]
    /// With what must be given.
    ///
    /// - `joint`: the joint whose relative displacement it acts on
    /// - `displacement`: The relative displacement as a function of time \[m\]
    new(joint: JointId = "joint", displacement: Function = "displacement")
}

entry! {
    /// Prescribes displacements and rotations of the tip as functions of time; others are zero, or free.
    PrescribedMotion => JointId, "prescribed_motion";
    ["kind" = "prescribed_motion"]
    /// With what must be given.
    ///
    /// - `base`: first node: "ground", "body", "beam.end" …
    /// - `tip`: second node
    new(base: Node = "base", tip: Node = "tip")
    /// Displacement along `axis` from the start \[m\].
    x: Function = "x";
    /// Displacement along `second_axis` \[m\].
    y: Function = "y";
    /// Displacement perpendicular to both \[m\].
    z: Function = "z";
    /// Rotation about `axis` from the start \[rad\].
    rx: Function = "rx";
    /// Rotation about `second_axis` after its rotation by `rx` \[rad\].
    ry: Function = "ry";
    /// Rotation about the third axis after its rotations by `rx` and `ry` \[rad\].
    rz: Function = "rz";
    /// Components that are neither prescribed nor locked; default none.
    free: Vec<words::Free> = "free";
}

entry! {
    /// Prescribes a joint's relative rotation as a function of time.
    PrescribedRotation => JointId, "prescribed_rotation";
    ["kind" = "prescribed_rotation"]
    /// With what must be given.
    ///
    /// - `joint`: the joint whose relative rotation it acts on
    /// - `rotation`: The relative rotation as a function of time \[rad\]
    new(joint: JointId = "joint", rotation: Function = "rotation")
}

entry! {
    /// The tip slides along an axis without rotation; the displacement is a coordinate.
    Prismatic => JointId, "prismatic";
    ["kind" = "prismatic"]
    /// With what must be given.
    ///
    /// - `base`: first node: "ground", "body", "beam.end" …
    /// - `tip`: second node
    /// - `axis`: direction at the start, global axes
    new(base: Node = "base", tip: Node = "tip", axis: [f64; 3] = "axis")
}

entry! {
    /// The tip rotates about an axis through a common point; the relative rotation is a coordinate.
    Revolute => JointId, "revolute";
    ["kind" = "revolute"]
    /// With what must be given.
    ///
    /// - `base`: first node: "ground", "body", "beam.end" …
    /// - `tip`: second node
    /// - `axis`: direction at the start, global axes
    new(base: Node = "base", tip: Node = "tip", axis: [f64; 3] = "axis")
}

entry! {
    /// Connects two nodes at different positions by a massless rigid link.
    RigidLink => JointId, "rigid_link";
    ["kind" = "rigid_link"]
    /// With what must be given.
    ///
    /// - `base`: first node: "ground", "body", "beam.end" …
    /// - `tip`: second node
    new(base: Node = "base", tip: Node = "tip")
}

entry! {
    /// A wheel, disc or ball rolls on a plane of the base without sliding or lifting off.
    Rolling => JointId, "rolling";
    ["kind" = "rolling"]
    /// With what must be given.
    ///
    /// - `base`: first node: "ground", "body", "beam.end" …
    /// - `tip`: second node
    /// - `axis`: direction at the start, global axes
    /// - `wheel_axis`: Axis of the wheel at the start, global axes, through the tip's position, the wheel's centre
    new(base: Node = "base", tip: Node = "tip", axis: [f64; 3] = "axis", wheel_axis: [f64; 3] = "wheel_axis")
    /// Radius of the wheel, without the rounding of its rim; default: the one with which it touches the plane at the start; 0 for a ball of radius `rim` \[m\].
    radius: f64 = "radius";
    /// Rounding radius of the rim; zero for a sharp edge; default 0 \[m\].
    rim: f64 = "rim";
    /// Coefficient of friction; a warning reports when rolling requires more; default: no limit.
    friction_coefficient: f64 = "friction_coefficient";
    /// Sliding velocity per force, a linear law of creep. It makes the forces of several wheels on one axle, which constrain each other, unique; default 0 \[m/(N s)\].
    creep: f64 = "creep";
}

entry! {
    /// The tip rotates about an axis and moves along it in proportion; the rotation is a coordinate.
    Screw => JointId, "screw";
    ["kind" = "screw"]
    /// With what must be given.
    ///
    /// - `base`: first node: "ground", "body", "beam.end" …
    /// - `tip`: second node
    /// - `axis`: direction at the start, global axes
    /// - `lead`: Displacement along `axis` per revolution; negative for a left-handed thread \[m\]
    new(base: Node = "base", tip: Node = "tip", axis: [f64; 3] = "axis", lead: f64 = "lead")
}

entry! {
    /// A point of the tip slides along a flexible beam or a chain of beams, across element boundaries.
    Slider => JointId, "slider";
    ["kind" = "slider"]
    /// With what must be given.
    ///
    /// - `beams`: beams along which it slides; each starts at the end of the previous one
    /// - `tip`: the node that slides
    new(beams: Vec<Part> = "beams", tip: Node = "tip")
    /// Location on the beam at the start; default: the tip node's position \[m\].
    at: [f64; 3] = "at";
    /// Rotation of the tip: "free"; with the line's "tangent", about which it rotates freely; or with the beam's "section", as on a spline shaft; default `"free"`.
    orientation: words::Orientation = "orientation";
}

entry! {
    /// The tip rotates freely about a common point of both nodes.
    Spherical => JointId, "spherical";
    ["kind" = "spherical"]
    /// With what must be given.
    ///
    /// - `base`: first node: "ground", "body", "beam.end" …
    /// - `tip`: second node
    new(base: Node = "base", tip: Node = "tip")
}

entry! {
    /// A massless link with a revolute joint at the base and a spherical joint at the tip.
    SwingArm => JointId, "swing_arm";
    ["kind" = "swing_arm"]
    /// With what must be given.
    ///
    /// - `base`: first node: "ground", "body", "beam.end" …
    /// - `tip`: second node
    /// - `axis`: direction at the start, global axes
    new(base: Node = "base", tip: Node = "tip", axis: [f64; 3] = "axis")
    /// Value of the link's angle at the start; default 0 \[rad\].
    angle: f64 = "angle";
}

entry! {
    /// A massless rod of variable length between two points, otherwise as `distance`; the displacement is a coordinate.
    TelescopicRod => JointId, "telescopic_rod";
    ["kind" = "telescopic_rod"]
    /// With what must be given.
    ///
    /// - `base`: first node: "ground", "body", "beam.end" …
    /// - `tip`: second node
    new(base: Node = "base", tip: Node = "tip")
}

entry! {
    /// Two nodes share a point; two perpendicular axes, one fixed in each; both rotations are coordinates.
    Universal => JointId, "universal";
    ["kind" = "universal"]
    /// With what must be given.
    ///
    /// - `base`: first node: "ground", "body", "beam.end" …
    /// - `tip`: second node
    /// - `axis`: direction at the start, global axes
    /// - `second_axis`: second direction at the start, global axes
    new(base: Node = "base", tip: Node = "tip", axis: [f64; 3] = "axis", second_axis: [f64; 3] = "second_axis")
}

entry! {
    /// A wheel rolls on a straight rail of the base without lifting off, with creep forces if they are specified.
    WheelOnRail => JointId, "wheel_on_rail";
    ["kind" = "wheel_on_rail"]
    /// With what must be given.
    ///
    /// - `base`: first node: "ground", "body", "beam.end" …
    /// - `tip`: second node
    /// - `axis`: direction at the start, global axes
    /// - `second_axis`: second direction at the start, global axes
    new(base: Node = "base", tip: Node = "tip", axis: [f64; 3] = "axis", second_axis: [f64; 3] = "second_axis")
    /// Axis of the wheel at the start, global axes, through the tip's position; default: `axis`.
    axle: [f64; 3] = "axle";
    /// Radius of the wheel at its nominal circle; default: the one with which it touches the rail at the start \[m\].
    radius: f64 = "radius";
    /// Distance of the nominal circle from the tip's position along the wheel's axis, outwards positive; default: that of the rail's point `at` at the start \[m\].
    offset: f64 = "offset";
    /// Cone angle of the wheel: its radius decreases outwards; default 0 \[rad\].
    cone_angle: f64 = "cone_angle";
    /// Instead of `cone_angle`: deviation from the nominal radius over the position `y` along the axis, outwards from the nominal circle; requires `tread` \[m\].
    wheel_profile: Function = "wheel_profile";
    /// Range of positions `y` at which the wheel may touch the rail; a warning reports contact outside; default: half the radius in both directions \[m\].
    tread: [f64; 2] = "tread";
    /// Radius of the rail's head, a circle through the point `at` \[m\].
    head_radius: f64 = "head_radius";
    /// Angle by which the head rises outwards at the point `at`; default `cone_angle` \[rad\].
    cant: f64 = "cant";
    /// Instead of `head_radius`: height of the rail over the lateral position `y`, outwards from the point `at`, where it is 0 \[m\].
    rail_profile: Function = "rail_profile";
    /// Limit of the creep force over the normal force; default: no creep forces.
    friction_coefficient: f64 = "friction_coefficient";
    /// Shear modulus of wheel and rail, for creep forces \[N/m^2\].
    shear_modulus: f64 = "shear_modulus";
    /// Poisson's ratio; default 0.28.
    poisson_number: f64 = "poisson_number";
    /// Kalker's coefficients C11, C22 and C23 of longitudinal, lateral and spin creep.
    kalker: [f64; 3] = "kalker";
    /// Elliptic integral E and ratio g of the semi-axes of the contact ellipse, from tables; default: those of Hertz for the nominal curvatures.
    ellipse: Vec<f64> = "ellipse";
    /// Velocity of the base along the rail in global axes, for models in axes that move with a vehicle; default 0 \[m/s\].
    velocity: [f64; 3] = "velocity";
    /// Angular velocity of the wheel relative to the tip about `axle`, for tips that do not rotate with it; default 0 \[rad/s\].
    wheel_spin: f64 = "wheel_spin";
    /// Directions of creep forces: in the tangent plane, or those of Simeon, Fuehrer and Rentrop 1991; default `"exact"`.
    directions: words::Directions = "directions";
}

nested! {
    /// Friction in a joint.
    Friction;
    /// With what must be given.
    ///
    /// - `coulomb`: sliding friction \[N, N m\]
    new(coulomb: f64 = "coulomb")
    /// Friction at rest, not below `coulomb`; default equal \[N, N m\].
    static_friction: f64 = "static";
    /// Rate at which the difference is 1/e; default 0.01 \[m/s, rad/s\].
    stribeck: f64 = "stribeck";
    /// Force per rate besides; default 0 \[N s/m, N m s/rad\].
    viscous: f64 = "viscous";
    /// Elastic motion before it slips; default 1e-4 \[m, rad\].
    deflection: f64 = "deflection";
    /// Of the elastic motion; default 0 \[N s/m, N m s/rad\].
    damping: f64 = "damping";
}

nested! {
    /// A latch on a joint.
    Latch;
    /// With what must be given.
    ///
    /// - `at`: value of the joint's only coordinate at which it engages, from either side \[m, rad\]
    new(at: f64 = "at")
}

keys! {
    [Cam, Gear]
    /// Number of the coordinate of `joint`, from 1; may be omitted if there is only one.
    coordinate: f64 = "coordinate";
    /// Number of the coordinate of `other`, from 1; may be omitted if there is only one.
    other_coordinate: f64 = "other_coordinate";
}

keys! {
    [Cam, Clamp, ConstantVelocity, Cylindrical, Distance, Equation, Gear, Generic, Inline, ParallelAxes, PerpendicularAxes, Planar, PointInPlane, PointOnLine, PrescribedMotion, Prismatic, Revolute, RigidLink, Rolling, Screw, Slider, Spherical, SwingArm, TelescopicRod, Universal, WheelOnRail]
    /// Friction on its only coordinate.
    friction: Friction = "friction";
    /// Latch that engages when its only coordinate first reaches the value `at`, and locks it there.
    latch: Latch = "latch";
    /// The latch releases when this expression rises through zero; without `latch` it is engaged from the start.
    release: Expression = "release";
}

keys! {
    [Clamp, ConstantVelocity, Cylindrical, Generic, Inline, ParallelAxes, PerpendicularAxes, Planar, PointInPlane, PointOnLine, PrescribedMotion, Prismatic, Revolute, RigidLink, Rolling, Screw, Spherical, SwingArm, Universal, WheelOnRail]
    /// Location; default: the tip node's position \[m\].
    at: [f64; 3] = "at";
    /// Location on the tip in its approximate position, if different from `at`; requires \[assembly\] \[m\].
    at_tip: [f64; 3] = "at_tip";
}

keys! {
    [ConstantVelocity, Cylindrical, Generic, Inline, ParallelAxes, PerpendicularAxes, Planar, PointInPlane, PointOnLine, PrescribedMotion, Prismatic, Revolute, Rolling, Screw, SwingArm, Universal, WheelOnRail]
    /// Direction of `axis` on the tip in its approximate position, if different; requires `at_tip`.
    axis_at_tip: [f64; 3] = "axis_at_tip";
}

keys! {
    [Cylindrical, ParallelAxes, Planar, Revolute, Screw]
    /// Value of the relative rotation at the start; default 0 \[rad\].
    angle: f64 = "angle";
    /// Rate of the relative rotation at the start, which parts without a given velocity follow \[rad/s\].
    rate: f64 = "rate";
}

keys! {
    [Cylindrical, PointOnLine, Prismatic, TelescopicRod]
    /// Value of the relative displacement at the start; default 0 \[m\].
    displacement: f64 = "displacement";
    /// Velocity of the relative displacement at the start, which parts without a given velocity follow \[m/s\].
    velocity: f64 = "velocity";
}

keys! {
    [Distance, TelescopicRod]
    /// Location on the base; default: the node's position \[m\].
    at_base: [f64; 3] = "at_base";
    /// Location on the tip; default: the node's position \[m\].
    at_tip: [f64; 3] = "at_tip";
}

keys! {
    [Generic, PrescribedMotion]
    /// Direction of x at the start, global axes; default: global x.
    axis: [f64; 3] = "axis";
    /// Direction of y at the start, global axes; default: global y.
    second_axis: [f64; 3] = "second_axis";
}

keys! {
    [Generic, PerpendicularAxes, PrescribedMotion, Universal, WheelOnRail]
    /// Direction of `second_axis` on the tip in its approximate position; requires `axis_at_tip`.
    second_axis_at_tip: [f64; 3] = "second_axis_at_tip";
}

keys! {
    [PrescribedDisplacement, PrescribedRotation]
    /// Number of the joint's coordinate, from 1; default: the first suitable one.
    coordinate: f64 = "coordinate";
}
