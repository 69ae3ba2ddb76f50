# Made by `cargo xtask reference` of the program's own tables: do not edit.
"""What pulls nodes or joints back, one class per kind."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar, Literal

from ._entry import Entry, Function, Names, Number, Place, Table, Vector


class Spring(Entry):
    """Springs, dampers, friction, stops and latches."""

    __slots__ = ()
    _table: ClassVar[str] = "springs"
    _tag: ClassVar[str] = "kind"


@dataclass(kw_only=True, slots=True)
class Axial(Spring):
    """Spring and damper on a joint's relative displacement.

    Args:
        in_: body, point mass or part in whose initial frame positions and directions are expressed; default: the enclosing part; a text, or nothing.
        joint: the joint whose relative displacement it acts on; the name of an entry of `[joints]`.
        stiffness: Stiffness; default 0 [N/m]; a number ≥ 0, or nothing.
        damping: Damping; default 0 [N s/m]; a number ≥ 0, or nothing.
        force: Force over `elongation` and `rate`, in addition to `stiffness`; a table is over `elongation` [N]; a number, an expression of `elongation` and `rate`, or a table over `elongation`, or nothing.
        damper_force: Force over `rate` and `elongation`, in addition to `damping`; a table is over `rate` [N]; a number, an expression of `rate` and `elongation`, or a table over `rate`, or nothing.
        side: Where it acts: beyond its free length ("tension"), below it ("compression"), or both; default `"both"`; `"both"`, `"tension"`, `"compression"`, or nothing.
        limits: Minimum and maximum force; default: none [N]; two ascending numbers, which may be `-inf` and `inf`, or nothing.
        backlash: Width of the backlash about the free length, without force; default 0 [m]; a number ≥ 0, or nothing.
        displacement: Relative displacement without force; default 0 [m]; a number, or nothing.
        preload: Force at the start, positive if it pulls, instead of the position without force [N]; a number, or nothing.
        coordinate: Number of the joint's coordinate, from 1; default: the first suitable one; a number > 0, or nothing.
    """

    _form: ClassVar[str] = "axial"

    in_: str | None = None
    joint: str
    stiffness: Number | None = None
    damping: Number | None = None
    force: Function | None = None
    damper_force: Function | None = None
    side: Literal["both", "tension", "compression"] | None = None
    limits: Vector | None = None
    backlash: Number | None = None
    displacement: Number | None = None
    preload: Number | None = None
    coordinate: Number | None = None


@dataclass(kw_only=True, slots=True)
class Point(Spring):
    """Spring and damper between two points, along the line through them.

    Args:
        in_: body, point mass or part in whose initial frame positions and directions are expressed; default: the enclosing part; a text, or nothing.
        base: first node: "ground", "body", "beam.end" …; a node.
        tip: second node; a node.
        at_base: location on the base; default: the node's position [m]; a position, or nothing.
        at_tip: location on the tip; default: the node's position [m]; a position, or nothing.
        stiffness: Stiffness; default 0 [N/m]; a number ≥ 0, or nothing.
        damping: Damping; default 0 [N s/m]; a number ≥ 0, or nothing.
        force: Force over `elongation` and `rate`, in addition to `stiffness`; a table is over `elongation` [N]; a number, an expression of `elongation` and `rate`, or a table over `elongation`, or nothing.
        damper_force: Force over `rate` and `elongation`, in addition to `damping`; a table is over `rate` [N]; a number, an expression of `rate` and `elongation`, or a table over `rate`, or nothing.
        side: Where it acts: beyond its free length ("tension"), below it ("compression"), or both; default `"both"`; `"both"`, `"tension"`, `"compression"`, or nothing.
        limits: Minimum and maximum force; default: none [N]; two ascending numbers, which may be `-inf` and `inf`, or nothing.
        backlash: Width of the backlash about the free length, without force; default 0 [m]; a number ≥ 0, or nothing.
        length: Free length; default: the length at the start [m]; a number ≥ 0, or nothing.
        preload: Force at the start, positive if it pulls, instead of the position without force [N]; a number, or nothing.
    """

    _form: ClassVar[str] = "point"

    in_: str | None = None
    base: str
    tip: str
    at_base: Place | None = None
    at_tip: Place | None = None
    stiffness: Number | None = None
    damping: Number | None = None
    force: Function | None = None
    damper_force: Function | None = None
    side: Literal["both", "tension", "compression"] | None = None
    limits: Vector | None = None
    backlash: Number | None = None
    length: Number | None = None
    preload: Number | None = None


@dataclass(kw_only=True, slots=True)
class RollingContact(Spring):
    """A wheel, disc or ball on a compliant plane with friction: it may lift off and slide.

    Args:
        in_: body, point mass or part in whose initial frame positions and directions are expressed; default: the enclosing part; a text, or nothing.
        base: first node: "ground", "body", "beam.end" …; a node.
        tip: second node; a node.
        at_base: location on the base; default: the node's position [m]; a position, or nothing.
        at_tip: location on the tip; default: the node's position [m]; a position, or nothing.
        normal: Normal at the start of the plane, which is fixed in the base, global axes; `at_base` is a point of the plane; a direction.
        wheel_axis: Axis of the wheel at the start, global axes; `at_tip` is the wheel's centre; a direction.
        radius: Radius of the wheel, without the rounding of its rim; default: the one with which it touches the plane at the start; 0 for a ball of radius `rim` [m]; a number ≥ 0, or nothing.
        rim: Rounding radius of the rim; default 0 [m]; a number ≥ 0, or nothing.
        stiffness: Normal force per penetration [N/m]; a number > 0.
        dissipation: Relative increase of the normal force per penetration velocity; default 0 [s/m]; a number ≥ 0, or nothing.
        damping: Normal force per penetration velocity, while in contact; default 0 [N s/m]; a number ≥ 0, or nothing.
        friction_coefficient: Coefficient of sliding friction; default 0; a number ≥ 0, or nothing.
        slip_velocity: Velocity v_s of the law μ tanh(v/v_s), below which the wheel creeps; default 0.01 [m/s]; a number > 0, or nothing.
        traction: Coefficient of friction over the sliding velocity `slip` [m/s], instead of the law of `friction_coefficient`; an expression of `slip`, or a table of it written as a function of time, or nothing.
        roller_angle: Angle about the normal from the axis of the wheel to that of the roller in contact, for a wheel with free rollers on its rim: friction acts along the axis of the roller [rad]; a number, or nothing.
        rolling_friction: Moment per normal force against rolling, of a wheel about its axis, of a ball about every axis in the plane; default 0 [m]; a number ≥ 0, or nothing.
        rolling_damping: Additional moment per normal force and rolling rate; default 0 [m s/rad]; a number ≥ 0, or nothing.
        rolling_rate: Rate ω_s of the law tanh(ω/ω_s) of `rolling_friction`, below which the wheel creeps; default 0.01 [rad/s]; a number > 0, or nothing.
    """

    _form: ClassVar[str] = "rolling_contact"

    in_: str | None = None
    base: str
    tip: str
    at_base: Place | None = None
    at_tip: Place | None = None
    normal: Vector | str
    wheel_axis: Vector | str
    radius: Number | None = None
    rim: Number | None = None
    stiffness: Number
    dissipation: Number | None = None
    damping: Number | None = None
    friction_coefficient: Number | None = None
    slip_velocity: Number | None = None
    traction: Function | None = None
    roller_angle: Number | None = None
    rolling_friction: Number | None = None
    rolling_damping: Number | None = None
    rolling_rate: Number | None = None


@dataclass(kw_only=True, slots=True)
class Tyre(Spring):
    """A tyre on a road, plane or uneven: brush model or Magic Formula with combined slip, relaxation, camber, trail and standstill without creep.

    Args:
        in_: body, point mass or part in whose initial frame positions and directions are expressed; default: the enclosing part; a text, or nothing.
        base: first node: "ground", "body", "beam.end" …; a node.
        tip: second node; a node.
        at_base: location on the base; default: the node's position [m]; a position, or nothing.
        at_tip: location on the tip; default: the node's position [m]; a position, or nothing.
        normal: Normal of the road at the start, which is fixed in the base, global axes; `at_base` is a point of the road; a direction.
        wheel_axis: Axis of the wheel at the start, global axes; `at_tip` is the wheel's centre. The tip is the part that rotates; a direction.
        radius: Free radius; default: the one with which it touches the road at the start [m]; a number > 0, or nothing.
        magic_formula: Coefficients of PAC2002 or MF-Tyre 5.2: a tyre property file `.tir`, or `{ file = "…", LMUY = 0.8 }` with other values of some. They replace the other data of the tyre except for `damping_time`; a tyre property file, or `{ file = "…", NAME = number }`, or nothing.
        mounted: Side of the vehicle, on which `wheel_axis` points to the left; offsets change their sign on the side for which the file was not measured; default: the side of the file; `"left"`, `"right"`, or nothing.
        stiffness: Normal force per deflection; required without `magic_formula` [N/m]; a number > 0, or nothing.
        damping: Normal force per deflection rate, without `magic_formula`; default 0 [N s/m]; a number ≥ 0, or nothing.
        friction_coefficient: Coefficient of friction; that of dry asphalt is the default; default 0.9; a number > 0, or nothing.
        slip_stiffness: Longitudinal force per slip and normal force, at small slip; required without `magic_formula`; a number > 0, or nothing.
        cornering_stiffness: Lateral force per slip angle and normal force, at small angles; required without `magic_formula`; a number > 0, or nothing.
        camber_stiffness: Lateral force per camber angle and normal force, towards the side to which the wheel leans; default 0; a number ≥ 0, or nothing.
        pneumatic_trail: Distance of the lateral force behind the centre of contact at small angles; default a tenth of the radius [m]; a number ≥ 0, or nothing.
        relaxation_length: Distance over which a lateral force builds up; default the radius [m]; a number > 0, or nothing.
        longitudinal_relaxation_length: The same for a longitudinal force; default half of the radius [m]; a number > 0, or nothing.
        damping_time: Damping of the tread over its stiffness, which fades beyond 1 m/s; default 5e-3 [s]; a number ≥ 0, or nothing.
        rolling_resistance: Resistance to rolling over the normal force; default 0; a number ≥ 0, or nothing.
        load_sensitivity: Decrease of friction with the normal force: μ/(1 + this N); default 0 [1/N]; a number ≥ 0, or nothing.
        road: Height of an uneven road above the plane, along `normal`: an expression of `x` and `y`, a table over `x`, a grid `{ file = "…" }`, or a random profile `{ class = "C" }` of ISO 8608; x and y from `at_base`, in the plane [m]; a number, an expression of `x` and `y`, `{ file = "…" }`, `{ grid = "…" }`, `{ class = "C" }`, or a list of these, which are added, or nothing.
        road_direction: Direction of x of the road at the start, global axes; its part in the plane counts; a direction, or nothing.
        width: Width of the contact on an uneven road; default three fifths of the radius [m]; a number > 0, or nothing.
        contact_length: Length of the contact on an uneven road; default two fifths of the radius [m]; a number > 0, or nothing.
    """

    _form: ClassVar[str] = "tyre"

    in_: str | None = None
    base: str
    tip: str
    at_base: Place | None = None
    at_tip: Place | None = None
    normal: Vector | str
    wheel_axis: Vector | str
    radius: Number | None = None
    magic_formula: str | Table | None = None
    mounted: Literal["left", "right"] | None = None
    stiffness: Number | None = None
    damping: Number | None = None
    friction_coefficient: Number | None = None
    slip_stiffness: Number | None = None
    cornering_stiffness: Number | None = None
    camber_stiffness: Number | None = None
    pneumatic_trail: Number | None = None
    relaxation_length: Number | None = None
    longitudinal_relaxation_length: Number | None = None
    damping_time: Number | None = None
    rolling_resistance: Number | None = None
    load_sensitivity: Number | None = None
    road: Function | list[Function] | None = None
    road_direction: Vector | str | None = None
    width: Number | None = None
    contact_length: Number | None = None


@dataclass(kw_only=True, slots=True)
class Rope(Spring):
    """Rope that slides over several points without friction: pulleys, and hoists by its free length.

    Args:
        in_: body, point mass or part in whose initial frame positions and directions are expressed; default: the enclosing part; a text, or nothing.
        along: points over which it passes, from one end to the other [m]; a list of `{ on, at }`, `at` may be omitted; sheaves and drums also have `radius`, `axis`, `sense` and `joint`.
        drums: coordinates of joints that pay it out, such as "drum.angle"; the name of a joint stands for all its coordinates; a list of coordinates of joints, such as `"arm.angle"`, or of joints: all of theirs, or nothing.
        stiffness: Stiffness of the whole rope; default 0 [N/m]; a number ≥ 0, or nothing.
        damping: Damping of the whole rope; default 0 [N s/m]; a number ≥ 0, or nothing.
        force: Tension over `elongation` and `rate`, in addition to `stiffness`; a table is over `elongation` [N]; a number, an expression of `elongation` and `rate`, or a table over `elongation`, or nothing.
        damper_force: Tension over `rate` and `elongation`, in addition to `damping`; a table is over `rate` [N]; a number, an expression of `rate` and `elongation`, or a table over `rate`, or nothing.
        limits: Minimum and maximum tension; default: none [N]; two ascending numbers, which may be `-inf` and `inf`, or nothing.
        length: Free length of the whole rope; a function of time for a winch; default: the length at the start [m]; a function of time, or nothing.
        drum_radii: Length of rope paid out by each of `drums` per rad or m of its coordinate; negative if it winds the rope up [m]; a list of numbers, or nothing.
        diameter: Diameter with which it is drawn; default: a thin line [m]; a number > 0, or nothing.
    """

    _form: ClassVar[str] = "rope"

    in_: str | None = None
    along: list[Table]
    drums: Names | None = None
    stiffness: Number | None = None
    damping: Number | None = None
    force: Function | None = None
    damper_force: Function | None = None
    limits: Vector | None = None
    length: Function | None = None
    drum_radii: Vector | None = None
    diameter: Number | None = None


@dataclass(kw_only=True, slots=True)
class Torsional(Spring):
    """Spring and damper on a joint's relative rotation.

    Args:
        in_: body, point mass or part in whose initial frame positions and directions are expressed; default: the enclosing part; a text, or nothing.
        joint: the joint whose relative rotation it acts on; the name of an entry of `[joints]`.
        stiffness: Stiffness; default 0 [N m/rad]; a number ≥ 0, or nothing.
        damping: Damping; default 0 [N m s/rad]; a number ≥ 0, or nothing.
        moment: Moment over `rotation` and `rate`, in addition to `stiffness`; a table is over `rotation` [N m]; a number, an expression of `rotation` and `rate`, or a table over `rotation`, or nothing.
        damper_moment: Moment over `rate` and `rotation`, in addition to `damping`; a table is over `rate` [N m]; a number, an expression of `rate` and `rotation`, or a table over `rate`, or nothing.
        side: Where it acts: above its free rotation ("positive"), below it ("negative"), or both; default `"both"`; `"both"`, `"positive"`, `"negative"`, or nothing.
        limits: Minimum and maximum moment; default: none [N m]; two ascending numbers, which may be `-inf` and `inf`, or nothing.
        backlash: Width of the backlash about the free rotation, without moment; default 0 [rad]; a number ≥ 0, or nothing.
        angle: Relative rotation without moment; default 0 [rad]; a number, or nothing.
        preload: Moment at the start, positive if it resists a positive rotation, instead of the rotation without moment [N m]; a number, or nothing.
        coordinate: Number of the joint's coordinate, from 1; default: the first suitable one; a number > 0, or nothing.
    """

    _form: ClassVar[str] = "torsional"

    in_: str | None = None
    joint: str
    stiffness: Number | None = None
    damping: Number | None = None
    moment: Function | None = None
    damper_moment: Function | None = None
    side: Literal["both", "positive", "negative"] | None = None
    limits: Vector | None = None
    backlash: Number | None = None
    angle: Number | None = None
    preload: Number | None = None
    coordinate: Number | None = None


@dataclass(kw_only=True, slots=True)
class AxialFriction(Spring):
    """Dry and viscous friction on a joint's relative displacement; sticking is free of creep.

    Args:
        in_: body, point mass or part in whose initial frame positions and directions are expressed; default: the enclosing part; a text, or nothing.
        joint: the joint whose relative displacement it acts on; the name of an entry of `[joints]`.
        coulomb: Force of sliding friction [N]; a number > 0.
        breakaway: Additional force of friction at rest; default none [N]; a number > 0, or nothing.
        stribeck: Velocity at which the additional force has fallen to 1/e; default 0.01 [m/s]; a number > 0, or nothing.
        viscous: Additional force per velocity; default 0 [N s/m]; a number ≥ 0, or nothing.
        deflection: Elastic displacement before it slips; default 1e-4 [m]; a number > 0, or nothing.
        damping: Damping of the elastic displacement; default 0 [N s/m]; a number ≥ 0, or nothing.
        coordinate: Number of the joint's coordinate, from 1; default: the first suitable one; a number > 0, or nothing.
    """

    _form: ClassVar[str] = "axial_friction"

    in_: str | None = None
    joint: str
    coulomb: Number
    breakaway: Number | None = None
    stribeck: Number | None = None
    viscous: Number | None = None
    deflection: Number | None = None
    damping: Number | None = None
    coordinate: Number | None = None


@dataclass(kw_only=True, slots=True)
class TorsionalFriction(Spring):
    """Dry and viscous friction on a joint's relative rotation; sticking is free of creep.

    Args:
        in_: body, point mass or part in whose initial frame positions and directions are expressed; default: the enclosing part; a text, or nothing.
        joint: the joint whose relative rotation it acts on; the name of an entry of `[joints]`.
        coulomb: Moment of sliding friction [N m]; a number > 0.
        breakaway: Additional moment of friction at rest; default none [N m]; a number > 0, or nothing.
        stribeck: Rate at which the additional moment has fallen to 1/e; default 0.01 [rad/s]; a number > 0, or nothing.
        viscous: Additional moment per rate; default 0 [N m s/rad]; a number ≥ 0, or nothing.
        deflection: Elastic rotation before it slips; default 1e-4 [rad]; a number > 0, or nothing.
        damping: Damping of the elastic rotation; default 0 [N m s/rad]; a number ≥ 0, or nothing.
        coordinate: Number of the joint's coordinate, from 1; default: the first suitable one; a number > 0, or nothing.
    """

    _form: ClassVar[str] = "torsional_friction"

    in_: str | None = None
    joint: str
    coulomb: Number
    breakaway: Number | None = None
    stribeck: Number | None = None
    viscous: Number | None = None
    deflection: Number | None = None
    damping: Number | None = None
    coordinate: Number | None = None


@dataclass(kw_only=True, slots=True)
class Bushing(Spring):
    """Springs and dampers along and about three axes, with full matrices, also between coincident points.

    Args:
        in_: body, point mass or part in whose initial frame positions and directions are expressed; default: the enclosing part; a text, or nothing.
        base: first node: "ground", "body", "beam.end" …; a node.
        tip: second node; a node.
        at_base: location on the base; default: the node's position [m]; a position, or nothing.
        at_tip: location on the tip; default: the node's position [m]; a position, or nothing.
        stiffness: 6 x 6 or its diagonal: displacements along the axes, rotations about them; default 0 [N/m, N, N m/rad]; six numbers or a 6 x 6 matrix, or nothing.
        damping: 6 x 6 or its diagonal, as `stiffness`; default 0 [N s/m, N s, N m s/rad]; six numbers or a 6 x 6 matrix, or nothing.
        axis: First axis at the start, global axes; default global x. The axes rotate with the base; a direction, or nothing.
        second_axis: Second axis at the start, global axes, made perpendicular to the first; default global y; a direction, or nothing.
        form: Displacement and rotation in the axes of the base ("base_axes"), or as a screw, which is the same from both sides; default `"base_axes"`; `"base_axes"`, `"screw"`, or nothing.
    """

    _form: ClassVar[str] = "bushing"

    in_: str | None = None
    base: str
    tip: str
    at_base: Place | None = None
    at_tip: Place | None = None
    stiffness: Vector | list[Vector] | None = None
    damping: Vector | list[Vector] | None = None
    axis: Vector | str | None = None
    second_axis: Vector | str | None = None
    form: Literal["base_axes", "screw"] | None = None


@dataclass(kw_only=True, slots=True)
class Bearing(Spring):
    """Bearing of a rotating shaft: stiffness and damping matrices, which may be unsymmetric and depend on the speed.

    Args:
        in_: body, point mass or part in whose initial frame positions and directions are expressed; default: the enclosing part; a text, or nothing.
        base: first node: "ground", "body", "beam.end" …; a node.
        tip: second node; a node.
        at_base: location on the base; default: the node's position [m]; a position, or nothing.
        at_tip: location on the tip; default: the node's position [m]; a position, or nothing.
        stiffness: For displacements across the shaft (2 x 2), along it and across (3 x 3), across with rotations about both axes (4 x 4), or all (5 x 5); a number is for both directions across; default 0 [N/m, N, N m/rad]; a number, a list of numbers (a diagonal), or a square matrix by rows, or nothing.
        damping: As `stiffness`; default 0 [N s/m, N s, N m s/rad]; a number, a list of numbers (a diagonal), or a square matrix by rows, or nothing.
        k22: Stiffness over `speed` [rad/s], added to `stiffness`: force along axis 2 per displacement along it [N/m]; an expression of `speed`, or a table of it written as a function of time, or nothing.
        k23: The same for a displacement along axis 3 [N/m]; an expression of `speed`, or a table of it written as a function of time, or nothing.
        k32: Force along axis 3 per displacement along axis 2 [N/m]; an expression of `speed`, or a table of it written as a function of time, or nothing.
        k33: The same for a displacement along axis 3 [N/m]; an expression of `speed`, or a table of it written as a function of time, or nothing.
        c22: Damping over `speed` [rad/s], added to `damping`, as `k22` [N s/m]; an expression of `speed`, or a table of it written as a function of time, or nothing.
        c23: As `k23` [N s/m]; an expression of `speed`, or a table of it written as a function of time, or nothing.
        c32: As `k32` [N s/m]; an expression of `speed`, or a table of it written as a function of time, or nothing.
        c33: As `k33` [N s/m]; an expression of `speed`, or a table of it written as a function of time, or nothing.
        axis: First axis at the start, global axes; default global x. The axes rotate with the base; a direction, or nothing.
        second_axis: Second axis at the start, global axes, made perpendicular to the first; default global y; a direction, or nothing.
    """

    _form: ClassVar[str] = "bearing"

    in_: str | None = None
    base: str
    tip: str
    at_base: Place | None = None
    at_tip: Place | None = None
    stiffness: Number | Vector | list[Vector] | None = None
    damping: Number | Vector | list[Vector] | None = None
    k22: Function | None = None
    k23: Function | None = None
    k32: Function | None = None
    k33: Function | None = None
    c22: Function | None = None
    c23: Function | None = None
    c32: Function | None = None
    c33: Function | None = None
    axis: Vector | str | None = None
    second_axis: Vector | str | None = None


@dataclass(kw_only=True, slots=True)
class JournalBearing(Spring):
    """Short journal bearing with a fluid film, or squeeze-film damper of a shaft that does not rotate in it.

    Args:
        in_: body, point mass or part in whose initial frame positions and directions are expressed; default: the enclosing part; a text, or nothing.
        base: first node: "ground", "body", "beam.end" …; a node.
        tip: second node; a node.
        at_base: location on the base; default: the node's position [m]; a position, or nothing.
        at_tip: location on the tip; default: the node's position [m]; a position, or nothing.
        radius: Radius of the journal [m]; a number > 0.
        length: Length along the shaft, short against the diameter [m]; a number > 0.
        clearance: Radial clearance [m]; a number > 0.
        viscosity: Dynamic viscosity of the lubricant [Pa s]; a number > 0.
        film: Film where the pressure is positive ("ruptured"), or everywhere ("full"); default `"ruptured"`; `"ruptured"`, `"full"`, or nothing.
        axis: First axis at the start, global axes; default global x. The axes rotate with the base; a direction, or nothing.
    """

    _form: ClassVar[str] = "journal_bearing"

    in_: str | None = None
    base: str
    tip: str
    at_base: Place | None = None
    at_tip: Place | None = None
    radius: Number
    length: Number
    clearance: Number
    viscosity: Number
    film: Literal["ruptured", "full"] | None = None
    axis: Vector | str | None = None


@dataclass(kw_only=True, slots=True)
class CoordinateDynamics(Spring):
    """Mass, damping and stiffness matrices on coordinates: `M q'' + D q' + K (q - rest)` in their equations.

    Args:
        in_: body, point mass or part in whose initial frame positions and directions are expressed; default: the enclosing part; a text, or nothing.
        coordinates: coordinates on which it acts, such as "arm.angle", in the order of its matrices; the name of a joint stands for all its coordinates; a list of coordinates of joints, such as `"arm.angle"`, or of joints: all of theirs.
        mass: Mass matrix, symmetric, without negative eigenvalues; default 0 [kg, kg m or kg m²]; a number, a list of numbers (a diagonal), or a square matrix by rows, or nothing.
        damping: Damping matrix; it may be unsymmetric (gyroscopic forces) or negative; default 0 [N s/m, N s or N m s/rad]; a number, a list of numbers (a diagonal), or a square matrix by rows, or nothing.
        stiffness: Stiffness matrix; it may be unsymmetric (circulatory forces); default 0 [N/m, N/rad or N m/rad]; a number, a list of numbers (a diagonal), or a square matrix by rows, or nothing.
        rest: Values of the coordinates without force of `stiffness`; default zeros [m or rad]; a list of numbers, or nothing.
    """

    _form: ClassVar[str] = "coordinate_dynamics"

    in_: str | None = None
    coordinates: Names
    mass: Number | Vector | list[Vector] | None = None
    damping: Number | Vector | list[Vector] | None = None
    stiffness: Number | Vector | list[Vector] | None = None
    rest: Vector | None = None


@dataclass(kw_only=True, slots=True)
class AxialStop(Spring):
    """Stops at the ends of the range of a joint's relative displacement.

    Args:
        in_: body, point mass or part in whose initial frame positions and directions are expressed; default: the enclosing part; a text, or nothing.
        joint: the joint whose relative displacement it acts on; the name of an entry of `[joints]`.
        range: Displacements of the two stops; none at an infinite end [m]; two ascending numbers, which may be `-inf` and `inf`.
        stiffness: Force at a penetration of 1 m [N/m^n]; a number > 0.
        exponent: Exponent n, at least 1; default 1; a number > 0, or nothing.
        dissipation: Factor a of the penetration rate; default 0 [s/m]; a number ≥ 0, or nothing.
        damping: Force per penetration rate, while in contact; default 0 [N s/m]; a number ≥ 0, or nothing.
        restitution: Instead of `dissipation`: velocity after an impact over that before, 0.01 to 1, at `impact_velocity`; a number > 0, or nothing.
        impact_velocity: Velocity of that impact [m/s]; a number > 0, or nothing.
        coordinate: Number of the joint's coordinate, from 1; default: the first suitable one; a number > 0, or nothing.
    """

    _form: ClassVar[str] = "axial_stop"

    in_: str | None = None
    joint: str
    range: Vector
    stiffness: Number
    exponent: Number | None = None
    dissipation: Number | None = None
    damping: Number | None = None
    restitution: Number | None = None
    impact_velocity: Number | None = None
    coordinate: Number | None = None


@dataclass(kw_only=True, slots=True)
class TorsionalStop(Spring):
    """Stops at the ends of the range of a joint's relative rotation.

    Args:
        in_: body, point mass or part in whose initial frame positions and directions are expressed; default: the enclosing part; a text, or nothing.
        joint: the joint whose relative rotation it acts on; the name of an entry of `[joints]`.
        range: Rotations of the two stops; none at an infinite end [rad]; two ascending numbers, which may be `-inf` and `inf`.
        stiffness: Moment at a penetration of 1 rad [N m/rad^n]; a number > 0.
        exponent: Exponent n, at least 1; default 1; a number > 0, or nothing.
        dissipation: Factor a of the penetration rate; default 0 [s/rad]; a number ≥ 0, or nothing.
        damping: Moment per penetration rate, while in contact; default 0 [N m s/rad]; a number ≥ 0, or nothing.
        restitution: Instead of `dissipation`: rate after an impact over that before, 0.01 to 1, at `impact_velocity`; a number > 0, or nothing.
        impact_velocity: Rate of that impact [rad/s]; a number > 0, or nothing.
        coordinate: Number of the joint's coordinate, from 1; default: the first suitable one; a number > 0, or nothing.
    """

    _form: ClassVar[str] = "torsional_stop"

    in_: str | None = None
    joint: str
    range: Vector
    stiffness: Number
    exponent: Number | None = None
    dissipation: Number | None = None
    damping: Number | None = None
    restitution: Number | None = None
    impact_velocity: Number | None = None
    coordinate: Number | None = None


@dataclass(kw_only=True, slots=True)
class AxialLatch(Spring):
    """Locks a joint's relative displacement at its current value while an input is set: latches and releases.

    Args:
        in_: body, point mass or part in whose initial frame positions and directions are expressed; default: the enclosing part; a text, or nothing.
        joint: the joint whose relative displacement it acts on; the name of an entry of `[joints]`.
        coordinate: Number of the joint's coordinate, from 1; default: the first suitable one; a number > 0, or nothing.
        engaged: Input that engages it: locked above 0.5, otherwise free; set by events; the name of an entry of `[inputs]`.
    """

    _form: ClassVar[str] = "axial_latch"

    in_: str | None = None
    joint: str
    coordinate: Number | None = None
    engaged: str


@dataclass(kw_only=True, slots=True)
class TorsionalLatch(Spring):
    """Locks a joint's relative rotation at its current value while an input is set: latches and releases.

    Args:
        in_: body, point mass or part in whose initial frame positions and directions are expressed; default: the enclosing part; a text, or nothing.
        joint: the joint whose relative rotation it acts on; the name of an entry of `[joints]`.
        coordinate: Number of the joint's coordinate, from 1; default: the first suitable one; a number > 0, or nothing.
        engaged: Input that engages it: locked above 0.5, otherwise free; set by events; the name of an entry of `[inputs]`.
    """

    _form: ClassVar[str] = "torsional_latch"

    in_: str | None = None
    joint: str
    coordinate: Number | None = None
    engaged: str
