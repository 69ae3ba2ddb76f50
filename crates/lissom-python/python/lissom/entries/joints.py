# Made by `cargo xtask reference` of the program's own tables: do not edit.
"""What holds nodes together, one class per kind."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar, Literal

from ._entry import Entry, Function, Names, Number, Place, Table, Vector


class Joint(Entry):
    """Constraints between nodes, or between coordinates of joints."""

    __slots__ = ()
    _table: ClassVar[str] = "joints"
    _tag: ClassVar[str] = "kind"


@dataclass(kw_only=True, slots=True)
class Cam(Joint):
    """A coordinate of `other` is a function of a coordinate of `joint`, such as the profile of a cam.

    Args:
        in_: body, point mass or part in whose initial frame positions and directions are expressed; default: the enclosing part; a text, or nothing.
        joint: joint with the independent coordinate; the name of an entry of `[joints]`.
        other: joint with the dependent coordinate; the name of an entry of `[joints]`.
        profile: The other coordinate as a function of the first, `x` [m or rad]; an expression of `x`, or a table of it written as a function of time.
        coordinate: Number of the coordinate of `joint`, from 1; may be omitted if there is only one; a number > 0, or nothing.
        other_coordinate: Number of the coordinate of `other`, from 1; may be omitted if there is only one; a number > 0, or nothing.
        friction: friction on its only coordinate; `{ coulomb, static, stribeck, viscous, deflection, damping }`, or nothing.
        latch: latch that engages when its only coordinate first reaches the value `at`, and locks it there; `{ at }`, or nothing.
        release: the latch releases when this expression rises through zero; without `latch` it is engaged from the start; an expression of signals, or nothing.
    """

    _form: ClassVar[str] = "cam"

    in_: str | None = None
    joint: str
    other: str
    profile: Function
    coordinate: Number | None = None
    other_coordinate: Number | None = None
    friction: Table | None = None
    latch: Table | None = None
    release: Number | None = None


@dataclass(kw_only=True, slots=True)
class Clamp(Joint):
    """Locks all six relative degrees of freedom.

    Args:
        in_: body, point mass or part in whose initial frame positions and directions are expressed; default: the enclosing part; a text, or nothing.
        base: first node: "ground", "body", "beam.end" …; a node.
        tip: second node; a node.
        at: location; default: the tip node's position [m]; a position, or nothing.
        friction: friction on its only coordinate; `{ coulomb, static, stribeck, viscous, deflection, damping }`, or nothing.
        latch: latch that engages when its only coordinate first reaches the value `at`, and locks it there; `{ at }`, or nothing.
        release: the latch releases when this expression rises through zero; without `latch` it is engaged from the start; an expression of signals, or nothing.
        at_tip: location on the tip in its approximate position, if different from `at`; requires [assembly] [m]; a position, or nothing.
    """

    _form: ClassVar[str] = "clamp"

    in_: str | None = None
    base: str
    tip: str
    at: Place | None = None
    friction: Table | None = None
    latch: Table | None = None
    release: Number | None = None
    at_tip: Place | None = None


@dataclass(kw_only=True, slots=True)
class ConstantVelocity(Joint):
    """Two shafts with a common point and any angle between them rotate by the same angle.

    Args:
        in_: body, point mass or part in whose initial frame positions and directions are expressed; default: the enclosing part; a text, or nothing.
        base: first node: "ground", "body", "beam.end" …; a node.
        tip: second node; a node.
        at: location; default: the tip node's position [m]; a position, or nothing.
        axis: direction at the start, global axes; a direction.
        tip_axis: Direction of the tip's shaft at the start, global axes; default: `axis`, the direction of the base's shaft; a direction, or nothing.
        friction: friction on its only coordinate; `{ coulomb, static, stribeck, viscous, deflection, damping }`, or nothing.
        latch: latch that engages when its only coordinate first reaches the value `at`, and locks it there; `{ at }`, or nothing.
        release: the latch releases when this expression rises through zero; without `latch` it is engaged from the start; an expression of signals, or nothing.
        at_tip: location on the tip in its approximate position, if different from `at`; requires [assembly] [m]; a position, or nothing.
        axis_at_tip: direction of `axis` on the tip in its approximate position, if different; requires `at_tip`; a direction, or nothing.
    """

    _form: ClassVar[str] = "constant_velocity"

    in_: str | None = None
    base: str
    tip: str
    at: Place | None = None
    axis: Vector | str
    tip_axis: Vector | str | None = None
    friction: Table | None = None
    latch: Table | None = None
    release: Number | None = None
    at_tip: Place | None = None
    axis_at_tip: Vector | str | None = None


@dataclass(kw_only=True, slots=True)
class Cylindrical(Joint):
    """The tip slides along an axis and rotates about it; rotation and displacement are coordinates.

    Args:
        in_: body, point mass or part in whose initial frame positions and directions are expressed; default: the enclosing part; a text, or nothing.
        base: first node: "ground", "body", "beam.end" …; a node.
        tip: second node; a node.
        at: location; default: the tip node's position [m]; a position, or nothing.
        axis: direction at the start, global axes; a direction.
        angle: Value of the relative rotation in the given positions; moves no part, except with `[assembly]`; default 0 [rad]; a number, or nothing.
        rate: Rate of the relative rotation at the start, which parts without a given velocity follow [rad/s]; a number, or nothing.
        displacement: Value of the relative displacement in the given positions; moves no part, except with `[assembly]`; default 0 [m]; a number, or nothing.
        velocity: Velocity of the relative displacement at the start, which parts without a given velocity follow [m/s]; a number, or nothing.
        friction: friction on its only coordinate; `{ coulomb, static, stribeck, viscous, deflection, damping }`, or nothing.
        latch: latch that engages when its only coordinate first reaches the value `at`, and locks it there; `{ at }`, or nothing.
        release: the latch releases when this expression rises through zero; without `latch` it is engaged from the start; an expression of signals, or nothing.
        at_tip: location on the tip in its approximate position, if different from `at`; requires [assembly] [m]; a position, or nothing.
        axis_at_tip: direction of `axis` on the tip in its approximate position, if different; requires `at_tip`; a direction, or nothing.
    """

    _form: ClassVar[str] = "cylindrical"

    in_: str | None = None
    base: str
    tip: str
    at: Place | None = None
    axis: Vector | str
    angle: Number | None = None
    rate: Number | None = None
    displacement: Number | None = None
    velocity: Number | None = None
    friction: Table | None = None
    latch: Table | None = None
    release: Number | None = None
    at_tip: Place | None = None
    axis_at_tip: Vector | str | None = None


@dataclass(kw_only=True, slots=True)
class Distance(Joint):
    """Keeps the distance of two points constant: a massless rod with spherical joints at its ends.

    Args:
        in_: body, point mass or part in whose initial frame positions and directions are expressed; default: the enclosing part; a text, or nothing.
        base: first node: "ground", "body", "beam.end" …; a node.
        tip: second node; a node.
        at_base: location on the base; default: the node's position [m]; a position, or nothing.
        at_tip: location on the tip; default: the node's position [m]; a position, or nothing.
        friction: friction on its only coordinate; `{ coulomb, static, stribeck, viscous, deflection, damping }`, or nothing.
        latch: latch that engages when its only coordinate first reaches the value `at`, and locks it there; `{ at }`, or nothing.
        release: the latch releases when this expression rises through zero; without `latch` it is engaged from the start; an expression of signals, or nothing.
    """

    _form: ClassVar[str] = "distance"

    in_: str | None = None
    base: str
    tip: str
    at_base: Place | None = None
    at_tip: Place | None = None
    friction: Table | None = None
    latch: Table | None = None
    release: Number | None = None


@dataclass(kw_only=True, slots=True)
class Equation(Joint):
    """An expression of joint coordinates and time is zero: planetary gears, differentials, curves.

    Args:
        in_: body, point mass or part in whose initial frame positions and directions are expressed; default: the enclosing part; a text, or nothing.
        equation: The expression that is zero, of coordinates such as `arm.angle` and `slide.displacement`, and of `t`; an expression of coordinates of joints, such as `arm.angle`, and of `t`.
        friction: friction on its only coordinate; `{ coulomb, static, stribeck, viscous, deflection, damping }`, or nothing.
        latch: latch that engages when its only coordinate first reaches the value `at`, and locks it there; `{ at }`, or nothing.
        release: the latch releases when this expression rises through zero; without `latch` it is engaged from the start; an expression of signals, or nothing.
    """

    _form: ClassVar[str] = "equation"

    in_: str | None = None
    equation: Number
    friction: Table | None = None
    latch: Table | None = None
    release: Number | None = None


@dataclass(kw_only=True, slots=True)
class Gear(Joint):
    """A coordinate of `other` changes by `ratio` times the change of a coordinate of `joint`: gears, racks, belts.

    Args:
        in_: body, point mass or part in whose initial frame positions and directions are expressed; default: the enclosing part; a text, or nothing.
        joint: joint with the independent coordinate; the name of an entry of `[joints]`.
        other: joint with the dependent coordinate; the name of an entry of `[joints]`.
        ratio: Change of the dependent coordinate per change of the independent one; negative for external gears [1, m/rad or rad/m]; a number.
        coordinate: Number of the coordinate of `joint`, from 1; may be omitted if there is only one; a number > 0, or nothing.
        other_coordinate: Number of the coordinate of `other`, from 1; may be omitted if there is only one; a number > 0, or nothing.
        efficiency: Share η of the power that arrives at `other` if `joint` drives; 2 - 1/η if `other` drives: below 0.5 it locks; default 1 [1]; a number from 0.01 to 1, or nothing.
        deflection: Elastic motion of `joint` before its friction slips; default 1e-4 [rad or m]; a number > 0, or nothing.
        damping: Damping of this elastic motion; default 0 [N m s/rad or N s/m]; a number ≥ 0, or nothing.
        relative: Whether it is meant to relate rotations relative to parts that turn against each other, which is warned about otherwise; default `false`; `true` or `false`, or nothing.
        friction: friction on its only coordinate; `{ coulomb, static, stribeck, viscous, deflection, damping }`, or nothing.
        latch: latch that engages when its only coordinate first reaches the value `at`, and locks it there; `{ at }`, or nothing.
        release: the latch releases when this expression rises through zero; without `latch` it is engaged from the start; an expression of signals, or nothing.
    """

    _form: ClassVar[str] = "gear"

    in_: str | None = None
    joint: str
    other: str
    ratio: Number
    coordinate: Number | None = None
    other_coordinate: Number | None = None
    efficiency: Number | None = None
    deflection: Number | None = None
    damping: Number | None = None
    relative: bool | None = None
    friction: Table | None = None
    latch: Table | None = None
    release: Number | None = None


@dataclass(kw_only=True, slots=True)
class GeneralizedCoordinates(Joint):
    """Generalised coordinates that belong to no part, for springs, loads, gears and `coordinate_dynamics`.

    Args:
        in_: body, point mass or part in whose initial frame positions and directions are expressed; default: the enclosing part; a text, or nothing.
        start: Values at the start: as many as there are coordinates [m or rad]; a list of numbers.
        rate: Rates at the start, as many as in `start`; default zeros [m/s or rad/s]; a list of numbers, or nothing.
        rotations: Whether they are rotations [rad] instead of displacements [m]; default `false`; `true` or `false`, or nothing.
    """

    _form: ClassVar[str] = "generalized_coordinates"

    in_: str | None = None
    start: Vector
    rate: Vector | None = None
    rotations: bool | None = None


@dataclass(kw_only=True, slots=True)
class Generic(Joint):
    """Locks chosen translations and rotations of the tip in the axes of the base.

    Args:
        in_: body, point mass or part in whose initial frame positions and directions are expressed; default: the enclosing part; a text, or nothing.
        base: first node: "ground", "body", "beam.end" …; a node.
        tip: second node; a node.
        at: location; default: the tip node's position [m]; a position, or nothing.
        axis: direction of x at the start, global axes; default: global x; a direction, or nothing.
        second_axis: direction of y at the start, global axes; default: global y; a direction, or nothing.
        locked: Locked motions: x along `axis`, y along `second_axis`, z perpendicular to both; rx, ry, rz about them; a list of `"x"`, `"y"`, `"z"`, `"rx"`, `"ry"`, `"rz"`.
        friction: friction on its only coordinate; `{ coulomb, static, stribeck, viscous, deflection, damping }`, or nothing.
        latch: latch that engages when its only coordinate first reaches the value `at`, and locks it there; `{ at }`, or nothing.
        release: the latch releases when this expression rises through zero; without `latch` it is engaged from the start; an expression of signals, or nothing.
        at_tip: location on the tip in its approximate position, if different from `at`; requires [assembly] [m]; a position, or nothing.
        axis_at_tip: direction of `axis` on the tip in its approximate position, if different; requires `at_tip`; a direction, or nothing.
        second_axis_at_tip: direction of `second_axis` on the tip in its approximate position; requires `axis_at_tip`; a direction, or nothing.
    """

    _form: ClassVar[str] = "generic"

    in_: str | None = None
    base: str
    tip: str
    at: Place | None = None
    axis: Vector | str | None = None
    second_axis: Vector | str | None = None
    locked: list[Literal["x", "y", "z", "rx", "ry", "rz"]]
    friction: Table | None = None
    latch: Table | None = None
    release: Number | None = None
    at_tip: Place | None = None
    axis_at_tip: Vector | str | None = None
    second_axis_at_tip: Vector | str | None = None


@dataclass(kw_only=True, slots=True)
class Inline(Joint):
    """The tip's point moves along a line fixed in the base; like `point_on_line`, but without a coordinate.

    Args:
        in_: body, point mass or part in whose initial frame positions and directions are expressed; default: the enclosing part; a text, or nothing.
        base: first node: "ground", "body", "beam.end" …; a node.
        tip: second node; a node.
        at: location; default: the tip node's position [m]; a position, or nothing.
        axis: direction at the start, global axes; a direction.
        friction: friction on its only coordinate; `{ coulomb, static, stribeck, viscous, deflection, damping }`, or nothing.
        latch: latch that engages when its only coordinate first reaches the value `at`, and locks it there; `{ at }`, or nothing.
        release: the latch releases when this expression rises through zero; without `latch` it is engaged from the start; an expression of signals, or nothing.
        at_tip: location on the tip in its approximate position, if different from `at`; requires [assembly] [m]; a position, or nothing.
        axis_at_tip: direction of `axis` on the tip in its approximate position, if different; requires `at_tip`; a direction, or nothing.
    """

    _form: ClassVar[str] = "inline"

    in_: str | None = None
    base: str
    tip: str
    at: Place | None = None
    axis: Vector | str
    friction: Table | None = None
    latch: Table | None = None
    release: Number | None = None
    at_tip: Place | None = None
    axis_at_tip: Vector | str | None = None


@dataclass(kw_only=True, slots=True)
class MeanMotion(Joint):
    """A body has the mean motion of a set of nodes of a shell or solid, which deforms freely (distributing coupling, RBE3).

    Args:
        in_: body, point mass or part in whose initial frame positions and directions are expressed; default: the enclosing part; a text, or nothing.
        base: set of nodes that the body follows, such as "block.east"; a node.
        tip: body that follows it; a node.
        friction: friction on its only coordinate; `{ coulomb, static, stribeck, viscous, deflection, damping }`, or nothing.
        latch: latch that engages when its only coordinate first reaches the value `at`, and locks it there; `{ at }`, or nothing.
        release: the latch releases when this expression rises through zero; without `latch` it is engaged from the start; an expression of signals, or nothing.
    """

    _form: ClassVar[str] = "mean_motion"

    in_: str | None = None
    base: str
    tip: str
    friction: Table | None = None
    latch: Table | None = None
    release: Number | None = None


@dataclass(kw_only=True, slots=True)
class ParallelAxes(Joint):
    """The tip rotates only about `axis` and translates freely; the relative rotation is a coordinate.

    Args:
        in_: body, point mass or part in whose initial frame positions and directions are expressed; default: the enclosing part; a text, or nothing.
        base: first node: "ground", "body", "beam.end" …; a node.
        tip: second node; a node.
        at: location; default: the tip node's position [m]; a position, or nothing.
        axis: direction at the start, global axes; a direction.
        angle: Value of the relative rotation in the given positions; moves no part, except with `[assembly]`; default 0 [rad]; a number, or nothing.
        rate: Rate of the relative rotation at the start, which parts without a given velocity follow [rad/s]; a number, or nothing.
        friction: friction on its only coordinate; `{ coulomb, static, stribeck, viscous, deflection, damping }`, or nothing.
        latch: latch that engages when its only coordinate first reaches the value `at`, and locks it there; `{ at }`, or nothing.
        release: the latch releases when this expression rises through zero; without `latch` it is engaged from the start; an expression of signals, or nothing.
        at_tip: location on the tip in its approximate position, if different from `at`; requires [assembly] [m]; a position, or nothing.
        axis_at_tip: direction of `axis` on the tip in its approximate position, if different; requires `at_tip`; a direction, or nothing.
    """

    _form: ClassVar[str] = "parallel_axes"

    in_: str | None = None
    base: str
    tip: str
    at: Place | None = None
    axis: Vector | str
    angle: Number | None = None
    rate: Number | None = None
    friction: Table | None = None
    latch: Table | None = None
    release: Number | None = None
    at_tip: Place | None = None
    axis_at_tip: Vector | str | None = None


@dataclass(kw_only=True, slots=True)
class PerpendicularAxes(Joint):
    """Keeps `axis`, fixed in the base, perpendicular to `second_axis`, fixed in the tip.

    Args:
        in_: body, point mass or part in whose initial frame positions and directions are expressed; default: the enclosing part; a text, or nothing.
        base: first node: "ground", "body", "beam.end" …; a node.
        tip: second node; a node.
        at: location; default: the tip node's position [m]; a position, or nothing.
        axis: direction at the start, global axes; a direction.
        second_axis: second direction at the start, global axes; a direction.
        friction: friction on its only coordinate; `{ coulomb, static, stribeck, viscous, deflection, damping }`, or nothing.
        latch: latch that engages when its only coordinate first reaches the value `at`, and locks it there; `{ at }`, or nothing.
        release: the latch releases when this expression rises through zero; without `latch` it is engaged from the start; an expression of signals, or nothing.
        at_tip: location on the tip in its approximate position, if different from `at`; requires [assembly] [m]; a position, or nothing.
        axis_at_tip: direction of `axis` on the tip in its approximate position, if different; requires `at_tip`; a direction, or nothing.
        second_axis_at_tip: direction of `second_axis` on the tip in its approximate position; requires `axis_at_tip`; a direction, or nothing.
    """

    _form: ClassVar[str] = "perpendicular_axes"

    in_: str | None = None
    base: str
    tip: str
    at: Place | None = None
    axis: Vector | str
    second_axis: Vector | str
    friction: Table | None = None
    latch: Table | None = None
    release: Number | None = None
    at_tip: Place | None = None
    axis_at_tip: Vector | str | None = None
    second_axis_at_tip: Vector | str | None = None


@dataclass(kw_only=True, slots=True)
class Planar(Joint):
    """The tip translates in the plane perpendicular to `axis` and rotates about it; the rotation is a coordinate.

    Args:
        in_: body, point mass or part in whose initial frame positions and directions are expressed; default: the enclosing part; a text, or nothing.
        base: first node: "ground", "body", "beam.end" …; a node.
        tip: second node; a node.
        at: location; default: the tip node's position [m]; a position, or nothing.
        axis: direction at the start, global axes; a direction.
        angle: Value of the relative rotation in the given positions; moves no part, except with `[assembly]`; default 0 [rad]; a number, or nothing.
        rate: Rate of the relative rotation at the start, which parts without a given velocity follow [rad/s]; a number, or nothing.
        friction: friction on its only coordinate; `{ coulomb, static, stribeck, viscous, deflection, damping }`, or nothing.
        latch: latch that engages when its only coordinate first reaches the value `at`, and locks it there; `{ at }`, or nothing.
        release: the latch releases when this expression rises through zero; without `latch` it is engaged from the start; an expression of signals, or nothing.
        at_tip: location on the tip in its approximate position, if different from `at`; requires [assembly] [m]; a position, or nothing.
        axis_at_tip: direction of `axis` on the tip in its approximate position, if different; requires `at_tip`; a direction, or nothing.
    """

    _form: ClassVar[str] = "planar"

    in_: str | None = None
    base: str
    tip: str
    at: Place | None = None
    axis: Vector | str
    angle: Number | None = None
    rate: Number | None = None
    friction: Table | None = None
    latch: Table | None = None
    release: Number | None = None
    at_tip: Place | None = None
    axis_at_tip: Vector | str | None = None


@dataclass(kw_only=True, slots=True)
class PointInPlane(Joint):
    """The tip's point moves in the base's plane perpendicular to `axis`; the tip rotates freely.

    Args:
        in_: body, point mass or part in whose initial frame positions and directions are expressed; default: the enclosing part; a text, or nothing.
        base: first node: "ground", "body", "beam.end" …; a node.
        tip: second node; a node.
        at: location; default: the tip node's position [m]; a position, or nothing.
        axis: direction at the start, global axes; a direction.
        friction: friction on its only coordinate; `{ coulomb, static, stribeck, viscous, deflection, damping }`, or nothing.
        latch: latch that engages when its only coordinate first reaches the value `at`, and locks it there; `{ at }`, or nothing.
        release: the latch releases when this expression rises through zero; without `latch` it is engaged from the start; an expression of signals, or nothing.
        at_tip: location on the tip in its approximate position, if different from `at`; requires [assembly] [m]; a position, or nothing.
        axis_at_tip: direction of `axis` on the tip in its approximate position, if different; requires `at_tip`; a direction, or nothing.
    """

    _form: ClassVar[str] = "point_in_plane"

    in_: str | None = None
    base: str
    tip: str
    at: Place | None = None
    axis: Vector | str
    friction: Table | None = None
    latch: Table | None = None
    release: Number | None = None
    at_tip: Place | None = None
    axis_at_tip: Vector | str | None = None


@dataclass(kw_only=True, slots=True)
class PointOnLine(Joint):
    """The tip's point slides along a line fixed in the base; the tip rotates freely; the displacement is a coordinate.

    Args:
        in_: body, point mass or part in whose initial frame positions and directions are expressed; default: the enclosing part; a text, or nothing.
        base: first node: "ground", "body", "beam.end" …; a node.
        tip: second node; a node.
        at: location; default: the tip node's position [m]; a position, or nothing.
        axis: direction at the start, global axes; a direction.
        displacement: Value of the relative displacement in the given positions; moves no part, except with `[assembly]`; default 0 [m]; a number, or nothing.
        velocity: Velocity of the relative displacement at the start, which parts without a given velocity follow [m/s]; a number, or nothing.
        friction: friction on its only coordinate; `{ coulomb, static, stribeck, viscous, deflection, damping }`, or nothing.
        latch: latch that engages when its only coordinate first reaches the value `at`, and locks it there; `{ at }`, or nothing.
        release: the latch releases when this expression rises through zero; without `latch` it is engaged from the start; an expression of signals, or nothing.
        at_tip: location on the tip in its approximate position, if different from `at`; requires [assembly] [m]; a position, or nothing.
        axis_at_tip: direction of `axis` on the tip in its approximate position, if different; requires `at_tip`; a direction, or nothing.
    """

    _form: ClassVar[str] = "point_on_line"

    in_: str | None = None
    base: str
    tip: str
    at: Place | None = None
    axis: Vector | str
    displacement: Number | None = None
    velocity: Number | None = None
    friction: Table | None = None
    latch: Table | None = None
    release: Number | None = None
    at_tip: Place | None = None
    axis_at_tip: Vector | str | None = None


@dataclass(kw_only=True, slots=True)
class PrescribedDisplacement(Joint):
    """Prescribes a joint's relative displacement as a function of time.

    Args:
        in_: body, point mass or part in whose initial frame positions and directions are expressed; default: the enclosing part; a text, or nothing.
        joint: the joint whose relative displacement it acts on; the name of an entry of `[joints]`.
        displacement: The relative displacement as a function of time [m]; a function of time.
        coordinate: Number of the joint's coordinate, from 1; default: the first suitable one; a number > 0, or nothing.
    """

    _form: ClassVar[str] = "prescribed_displacement"

    in_: str | None = None
    joint: str
    displacement: Function
    coordinate: Number | None = None


@dataclass(kw_only=True, slots=True)
class PrescribedMotion(Joint):
    """Prescribes displacements and rotations of the tip as functions of time; others are zero, or free.

    Args:
        in_: body, point mass or part in whose initial frame positions and directions are expressed; default: the enclosing part; a text, or nothing.
        base: first node: "ground", "body", "beam.end" …; a node.
        tip: second node; a node.
        at: location; default: the tip node's position [m]; a position, or nothing.
        axis: direction of x at the start, global axes; default: global x; a direction, or nothing.
        second_axis: direction of y at the start, global axes; default: global y; a direction, or nothing.
        x: Displacement along `axis` from the start [m]; a function of time, or nothing.
        y: Displacement along `second_axis` [m]; a function of time, or nothing.
        z: Displacement perpendicular to both [m]; a function of time, or nothing.
        rx: Rotation about `axis` from the start [rad]; a function of time, or nothing.
        ry: Rotation about `second_axis` after its rotation by `rx` [rad]; a function of time, or nothing.
        rz: Rotation about the third axis after its rotations by `rx` and `ry` [rad]; a function of time, or nothing.
        free: Components that are neither prescribed nor locked; default none; a list of `"x"`, `"y"`, `"z"`, `"rx"`, `"ry"`, `"rz"`, or nothing.
        friction: friction on its only coordinate; `{ coulomb, static, stribeck, viscous, deflection, damping }`, or nothing.
        latch: latch that engages when its only coordinate first reaches the value `at`, and locks it there; `{ at }`, or nothing.
        release: the latch releases when this expression rises through zero; without `latch` it is engaged from the start; an expression of signals, or nothing.
        at_tip: location on the tip in its approximate position, if different from `at`; requires [assembly] [m]; a position, or nothing.
        axis_at_tip: direction of `axis` on the tip in its approximate position, if different; requires `at_tip`; a direction, or nothing.
        second_axis_at_tip: direction of `second_axis` on the tip in its approximate position; requires `axis_at_tip`; a direction, or nothing.
    """

    _form: ClassVar[str] = "prescribed_motion"

    in_: str | None = None
    base: str
    tip: str
    at: Place | None = None
    axis: Vector | str | None = None
    second_axis: Vector | str | None = None
    x: Function | None = None
    y: Function | None = None
    z: Function | None = None
    rx: Function | None = None
    ry: Function | None = None
    rz: Function | None = None
    free: list[Literal["x", "y", "z", "rx", "ry", "rz"]] | None = None
    friction: Table | None = None
    latch: Table | None = None
    release: Number | None = None
    at_tip: Place | None = None
    axis_at_tip: Vector | str | None = None
    second_axis_at_tip: Vector | str | None = None


@dataclass(kw_only=True, slots=True)
class PrescribedRotation(Joint):
    """Prescribes a joint's relative rotation as a function of time.

    Args:
        in_: body, point mass or part in whose initial frame positions and directions are expressed; default: the enclosing part; a text, or nothing.
        joint: the joint whose relative rotation it acts on; the name of an entry of `[joints]`.
        rotation: The relative rotation as a function of time [rad]; a function of time.
        coordinate: Number of the joint's coordinate, from 1; default: the first suitable one; a number > 0, or nothing.
    """

    _form: ClassVar[str] = "prescribed_rotation"

    in_: str | None = None
    joint: str
    rotation: Function
    coordinate: Number | None = None


@dataclass(kw_only=True, slots=True)
class Prismatic(Joint):
    """The tip slides along an axis without rotation; the displacement is a coordinate.

    Args:
        in_: body, point mass or part in whose initial frame positions and directions are expressed; default: the enclosing part; a text, or nothing.
        base: first node: "ground", "body", "beam.end" …; a node.
        tip: second node; a node.
        at: location; default: the tip node's position [m]; a position, or nothing.
        axis: direction at the start, global axes; a direction.
        displacement: Value of the relative displacement in the given positions; moves no part, except with `[assembly]`; default 0 [m]; a number, or nothing.
        velocity: Velocity of the relative displacement at the start, which parts without a given velocity follow [m/s]; a number, or nothing.
        friction: friction on its only coordinate; `{ coulomb, static, stribeck, viscous, deflection, damping }`, or nothing.
        latch: latch that engages when its only coordinate first reaches the value `at`, and locks it there; `{ at }`, or nothing.
        release: the latch releases when this expression rises through zero; without `latch` it is engaged from the start; an expression of signals, or nothing.
        at_tip: location on the tip in its approximate position, if different from `at`; requires [assembly] [m]; a position, or nothing.
        axis_at_tip: direction of `axis` on the tip in its approximate position, if different; requires `at_tip`; a direction, or nothing.
    """

    _form: ClassVar[str] = "prismatic"

    in_: str | None = None
    base: str
    tip: str
    at: Place | None = None
    axis: Vector | str
    displacement: Number | None = None
    velocity: Number | None = None
    friction: Table | None = None
    latch: Table | None = None
    release: Number | None = None
    at_tip: Place | None = None
    axis_at_tip: Vector | str | None = None


@dataclass(kw_only=True, slots=True)
class Revolute(Joint):
    """The tip rotates about an axis through a common point; the relative rotation is a coordinate.

    Args:
        in_: body, point mass or part in whose initial frame positions and directions are expressed; default: the enclosing part; a text, or nothing.
        base: first node: "ground", "body", "beam.end" …; a node.
        tip: second node; a node.
        at: location; default: the tip node's position [m]; a position, or nothing.
        axis: direction at the start, global axes; a direction.
        angle: Value of the relative rotation in the given positions; moves no part, except with `[assembly]`; default 0 [rad]; a number, or nothing.
        rate: Rate of the relative rotation at the start, which parts without a given velocity follow [rad/s]; a number, or nothing.
        friction: friction on its only coordinate; `{ coulomb, static, stribeck, viscous, deflection, damping }`, or nothing.
        latch: latch that engages when its only coordinate first reaches the value `at`, and locks it there; `{ at }`, or nothing.
        release: the latch releases when this expression rises through zero; without `latch` it is engaged from the start; an expression of signals, or nothing.
        at_tip: location on the tip in its approximate position, if different from `at`; requires [assembly] [m]; a position, or nothing.
        axis_at_tip: direction of `axis` on the tip in its approximate position, if different; requires `at_tip`; a direction, or nothing.
    """

    _form: ClassVar[str] = "revolute"

    in_: str | None = None
    base: str
    tip: str
    at: Place | None = None
    axis: Vector | str
    angle: Number | None = None
    rate: Number | None = None
    friction: Table | None = None
    latch: Table | None = None
    release: Number | None = None
    at_tip: Place | None = None
    axis_at_tip: Vector | str | None = None


@dataclass(kw_only=True, slots=True)
class RigidLink(Joint):
    """Connects two nodes at different positions by a massless rigid link.

    Args:
        in_: body, point mass or part in whose initial frame positions and directions are expressed; default: the enclosing part; a text, or nothing.
        base: first node: "ground", "body", "beam.end" …; a node.
        tip: second node; a node.
        at: location; default: the tip node's position [m]; a position, or nothing.
        friction: friction on its only coordinate; `{ coulomb, static, stribeck, viscous, deflection, damping }`, or nothing.
        latch: latch that engages when its only coordinate first reaches the value `at`, and locks it there; `{ at }`, or nothing.
        release: the latch releases when this expression rises through zero; without `latch` it is engaged from the start; an expression of signals, or nothing.
        at_tip: location on the tip in its approximate position, if different from `at`; requires [assembly] [m]; a position, or nothing.
    """

    _form: ClassVar[str] = "rigid_link"

    in_: str | None = None
    base: str
    tip: str
    at: Place | None = None
    friction: Table | None = None
    latch: Table | None = None
    release: Number | None = None
    at_tip: Place | None = None


@dataclass(kw_only=True, slots=True)
class Rolling(Joint):
    """A wheel, disc or ball rolls on a plane of the base without sliding or lifting off.

    Args:
        in_: body, point mass or part in whose initial frame positions and directions are expressed; default: the enclosing part; a text, or nothing.
        base: first node: "ground", "body", "beam.end" …; a node.
        tip: second node; a node.
        at: location; default: the tip node's position [m]; a position, or nothing.
        axis: direction at the start, global axes; a direction.
        wheel_axis: Axis of the wheel at the start, global axes, through the tip's position, the wheel's centre; a direction.
        radius: Radius of the wheel, without the rounding of its rim; default: the one with which it touches the plane at the start; 0 for a ball of radius `rim` [m]; a number ≥ 0, or nothing.
        rim: Rounding radius of the rim; zero for a sharp edge; default 0 [m]; a number ≥ 0, or nothing.
        friction_coefficient: Coefficient of friction; a warning reports when rolling requires more; default: no limit; a number > 0, or nothing.
        creep: Sliding velocity per force, a linear law of creep. It makes the forces of several wheels on one axle, which constrain each other, unique; default 0 [m/(N s)]; a number ≥ 0, or nothing.
        friction: friction on its only coordinate; `{ coulomb, static, stribeck, viscous, deflection, damping }`, or nothing.
        latch: latch that engages when its only coordinate first reaches the value `at`, and locks it there; `{ at }`, or nothing.
        release: the latch releases when this expression rises through zero; without `latch` it is engaged from the start; an expression of signals, or nothing.
        at_tip: location on the tip in its approximate position, if different from `at`; requires [assembly] [m]; a position, or nothing.
        axis_at_tip: direction of `axis` on the tip in its approximate position, if different; requires `at_tip`; a direction, or nothing.
    """

    _form: ClassVar[str] = "rolling"

    in_: str | None = None
    base: str
    tip: str
    at: Place | None = None
    axis: Vector | str
    wheel_axis: Vector | str
    radius: Number | None = None
    rim: Number | None = None
    friction_coefficient: Number | None = None
    creep: Number | None = None
    friction: Table | None = None
    latch: Table | None = None
    release: Number | None = None
    at_tip: Place | None = None
    axis_at_tip: Vector | str | None = None


@dataclass(kw_only=True, slots=True)
class Screw(Joint):
    """The tip rotates about an axis and moves along it in proportion; the rotation is a coordinate.

    Args:
        in_: body, point mass or part in whose initial frame positions and directions are expressed; default: the enclosing part; a text, or nothing.
        base: first node: "ground", "body", "beam.end" …; a node.
        tip: second node; a node.
        at: location; default: the tip node's position [m]; a position, or nothing.
        axis: direction at the start, global axes; a direction.
        lead: Displacement along `axis` per revolution; negative for a left-handed thread [m]; a number.
        angle: Value of the relative rotation in the given positions; moves no part, except with `[assembly]`; default 0 [rad]; a number, or nothing.
        rate: Rate of the relative rotation at the start, which parts without a given velocity follow [rad/s]; a number, or nothing.
        friction: friction on its only coordinate; `{ coulomb, static, stribeck, viscous, deflection, damping }`, or nothing.
        latch: latch that engages when its only coordinate first reaches the value `at`, and locks it there; `{ at }`, or nothing.
        release: the latch releases when this expression rises through zero; without `latch` it is engaged from the start; an expression of signals, or nothing.
        at_tip: location on the tip in its approximate position, if different from `at`; requires [assembly] [m]; a position, or nothing.
        axis_at_tip: direction of `axis` on the tip in its approximate position, if different; requires `at_tip`; a direction, or nothing.
    """

    _form: ClassVar[str] = "screw"

    in_: str | None = None
    base: str
    tip: str
    at: Place | None = None
    axis: Vector | str
    lead: Number
    angle: Number | None = None
    rate: Number | None = None
    friction: Table | None = None
    latch: Table | None = None
    release: Number | None = None
    at_tip: Place | None = None
    axis_at_tip: Vector | str | None = None


@dataclass(kw_only=True, slots=True)
class Slider(Joint):
    """A point of the tip slides along a flexible beam or a chain of beams, across element boundaries.

    Args:
        in_: body, point mass or part in whose initial frame positions and directions are expressed; default: the enclosing part; a text, or nothing.
        beams: beams along which it slides; each starts at the end of the previous one; a list of names of parts.
        tip: the node that slides; a node.
        at: location on the beam at the start; default: the tip node's position [m]; a position, or nothing.
        orientation: Rotation of the tip: "free"; with the line's "tangent", about which it rotates freely; or with the beam's "section", as on a spline shaft; default `"free"`; `"free"`, `"tangent"`, `"section"`, or nothing.
        friction: friction on its only coordinate; `{ coulomb, static, stribeck, viscous, deflection, damping }`, or nothing.
        latch: latch that engages when its only coordinate first reaches the value `at`, and locks it there; `{ at }`, or nothing.
        release: the latch releases when this expression rises through zero; without `latch` it is engaged from the start; an expression of signals, or nothing.
    """

    _form: ClassVar[str] = "slider"

    in_: str | None = None
    beams: Names
    tip: str
    at: Place | None = None
    orientation: Literal["free", "tangent", "section"] | None = None
    friction: Table | None = None
    latch: Table | None = None
    release: Number | None = None


@dataclass(kw_only=True, slots=True)
class Spherical(Joint):
    """The tip rotates freely about a common point of both nodes.

    Args:
        in_: body, point mass or part in whose initial frame positions and directions are expressed; default: the enclosing part; a text, or nothing.
        base: first node: "ground", "body", "beam.end" …; a node.
        tip: second node; a node.
        at: location; default: the tip node's position [m]; a position, or nothing.
        friction: friction on its only coordinate; `{ coulomb, static, stribeck, viscous, deflection, damping }`, or nothing.
        latch: latch that engages when its only coordinate first reaches the value `at`, and locks it there; `{ at }`, or nothing.
        release: the latch releases when this expression rises through zero; without `latch` it is engaged from the start; an expression of signals, or nothing.
        at_tip: location on the tip in its approximate position, if different from `at`; requires [assembly] [m]; a position, or nothing.
    """

    _form: ClassVar[str] = "spherical"

    in_: str | None = None
    base: str
    tip: str
    at: Place | None = None
    friction: Table | None = None
    latch: Table | None = None
    release: Number | None = None
    at_tip: Place | None = None


@dataclass(kw_only=True, slots=True)
class SwingArm(Joint):
    """A massless link with a revolute joint at the base and a spherical joint at the tip.

    Args:
        in_: body, point mass or part in whose initial frame positions and directions are expressed; default: the enclosing part; a text, or nothing.
        base: first node: "ground", "body", "beam.end" …; a node.
        tip: second node; a node.
        at: location; default: the tip node's position [m]; a position, or nothing.
        axis: direction at the start, global axes; a direction.
        angle: Value of the link's angle in the given positions; moves no part, except with `[assembly]`; default 0 [rad]; a number, or nothing.
        friction: friction on its only coordinate; `{ coulomb, static, stribeck, viscous, deflection, damping }`, or nothing.
        latch: latch that engages when its only coordinate first reaches the value `at`, and locks it there; `{ at }`, or nothing.
        release: the latch releases when this expression rises through zero; without `latch` it is engaged from the start; an expression of signals, or nothing.
        at_tip: location on the tip in its approximate position, if different from `at`; requires [assembly] [m]; a position, or nothing.
        axis_at_tip: direction of `axis` on the tip in its approximate position, if different; requires `at_tip`; a direction, or nothing.
    """

    _form: ClassVar[str] = "swing_arm"

    in_: str | None = None
    base: str
    tip: str
    at: Place | None = None
    axis: Vector | str
    angle: Number | None = None
    friction: Table | None = None
    latch: Table | None = None
    release: Number | None = None
    at_tip: Place | None = None
    axis_at_tip: Vector | str | None = None


@dataclass(kw_only=True, slots=True)
class TelescopicRod(Joint):
    """A massless rod of variable length between two points, otherwise as `distance`; the displacement is a coordinate.

    Args:
        in_: body, point mass or part in whose initial frame positions and directions are expressed; default: the enclosing part; a text, or nothing.
        base: first node: "ground", "body", "beam.end" …; a node.
        tip: second node; a node.
        at_base: location on the base; default: the node's position [m]; a position, or nothing.
        at_tip: location on the tip; default: the node's position [m]; a position, or nothing.
        displacement: Value of the relative displacement in the given positions; moves no part, except with `[assembly]`; default 0 [m]; a number, or nothing.
        velocity: Velocity of the relative displacement at the start, which parts without a given velocity follow [m/s]; a number, or nothing.
        friction: friction on its only coordinate; `{ coulomb, static, stribeck, viscous, deflection, damping }`, or nothing.
        latch: latch that engages when its only coordinate first reaches the value `at`, and locks it there; `{ at }`, or nothing.
        release: the latch releases when this expression rises through zero; without `latch` it is engaged from the start; an expression of signals, or nothing.
    """

    _form: ClassVar[str] = "telescopic_rod"

    in_: str | None = None
    base: str
    tip: str
    at_base: Place | None = None
    at_tip: Place | None = None
    displacement: Number | None = None
    velocity: Number | None = None
    friction: Table | None = None
    latch: Table | None = None
    release: Number | None = None


@dataclass(kw_only=True, slots=True)
class Universal(Joint):
    """Two nodes share a point; two perpendicular axes, one fixed in each; both rotations are coordinates.

    Args:
        in_: body, point mass or part in whose initial frame positions and directions are expressed; default: the enclosing part; a text, or nothing.
        base: first node: "ground", "body", "beam.end" …; a node.
        tip: second node; a node.
        at: location; default: the tip node's position [m]; a position, or nothing.
        axis: direction at the start, global axes; a direction.
        second_axis: second direction at the start, global axes; a direction.
        friction: friction on its only coordinate; `{ coulomb, static, stribeck, viscous, deflection, damping }`, or nothing.
        latch: latch that engages when its only coordinate first reaches the value `at`, and locks it there; `{ at }`, or nothing.
        release: the latch releases when this expression rises through zero; without `latch` it is engaged from the start; an expression of signals, or nothing.
        at_tip: location on the tip in its approximate position, if different from `at`; requires [assembly] [m]; a position, or nothing.
        axis_at_tip: direction of `axis` on the tip in its approximate position, if different; requires `at_tip`; a direction, or nothing.
        second_axis_at_tip: direction of `second_axis` on the tip in its approximate position; requires `axis_at_tip`; a direction, or nothing.
    """

    _form: ClassVar[str] = "universal"

    in_: str | None = None
    base: str
    tip: str
    at: Place | None = None
    axis: Vector | str
    second_axis: Vector | str
    friction: Table | None = None
    latch: Table | None = None
    release: Number | None = None
    at_tip: Place | None = None
    axis_at_tip: Vector | str | None = None
    second_axis_at_tip: Vector | str | None = None


@dataclass(kw_only=True, slots=True)
class WheelOnRail(Joint):
    """A wheel rolls on a straight rail of the base without lifting off, with creep forces if they are specified.

    Args:
        in_: body, point mass or part in whose initial frame positions and directions are expressed; default: the enclosing part; a text, or nothing.
        base: first node: "ground", "body", "beam.end" …; a node.
        tip: second node; a node.
        at: location; default: the tip node's position [m]; a position, or nothing.
        axis: direction at the start, global axes; a direction.
        second_axis: second direction at the start, global axes; a direction.
        axle: Axis of the wheel at the start, global axes, through the tip's position; default: `axis`; a direction, or nothing.
        radius: Radius of the wheel at its nominal circle; default: the one with which it touches the rail at the start [m]; a number > 0, or nothing.
        offset: Distance of the nominal circle from the tip's position along the wheel's axis, outwards positive; default: that of the rail's point `at` at the start [m]; a number, or nothing.
        cone_angle: Cone angle of the wheel: its radius decreases outwards; default 0 [rad]; a number, or nothing.
        wheel_profile: Instead of `cone_angle`: deviation from the nominal radius over the position `y` along the axis, outwards from the nominal circle; requires `tread` [m]; an expression of `y`, or a table of it written as a function of time, or nothing.
        tread: Range of positions `y` at which the wheel may touch the rail; a warning reports contact outside; default: half the radius in both directions [m]; two ascending numbers, which may be `-inf` and `inf`, or nothing.
        head_radius: Radius of the rail's head, a circle through the point `at` [m]; a number > 0, or nothing.
        cant: Angle by which the head rises outwards at the point `at`; default `cone_angle` [rad]; a number, or nothing.
        rail_profile: Instead of `head_radius`: height of the rail over the lateral position `y`, outwards from the point `at`, where it is 0 [m]; an expression of `y`, or a table of it written as a function of time, or nothing.
        friction_coefficient: Limit of the creep force over the normal force; default: no creep forces; a number > 0, or nothing.
        shear_modulus: Shear modulus of wheel and rail, for creep forces [N/m^2]; a number > 0, or nothing.
        poisson_number: Poisson's ratio; default 0.28; a number ≥ 0, or nothing.
        kalker: Kalker's coefficients C11, C22 and C23 of longitudinal, lateral and spin creep; three numbers, or nothing.
        ellipse: Elliptic integral E and ratio g of the semi-axes of the contact ellipse, from tables; default: those of Hertz for the nominal curvatures; a list of numbers, or nothing.
        velocity: Velocity of the base along the rail in global axes, for models in axes that move with a vehicle; default 0 [m/s]; three numbers, or nothing.
        wheel_spin: Angular velocity of the wheel relative to the tip about `axle`, for tips that do not rotate with it; default 0 [rad/s]; a number, or nothing.
        directions: Directions of creep forces: in the tangent plane, or those of Simeon, Fuehrer and Rentrop 1991; default `"exact"`; `"exact"`, `"small_angles"`, or nothing.
        friction: friction on its only coordinate; `{ coulomb, static, stribeck, viscous, deflection, damping }`, or nothing.
        latch: latch that engages when its only coordinate first reaches the value `at`, and locks it there; `{ at }`, or nothing.
        release: the latch releases when this expression rises through zero; without `latch` it is engaged from the start; an expression of signals, or nothing.
        at_tip: location on the tip in its approximate position, if different from `at`; requires [assembly] [m]; a position, or nothing.
        axis_at_tip: direction of `axis` on the tip in its approximate position, if different; requires `at_tip`; a direction, or nothing.
        second_axis_at_tip: direction of `second_axis` on the tip in its approximate position; requires `axis_at_tip`; a direction, or nothing.
    """

    _form: ClassVar[str] = "wheel_on_rail"

    in_: str | None = None
    base: str
    tip: str
    at: Place | None = None
    axis: Vector | str
    second_axis: Vector | str
    axle: Vector | str | None = None
    radius: Number | None = None
    offset: Number | None = None
    cone_angle: Number | None = None
    wheel_profile: Function | None = None
    tread: Vector | None = None
    head_radius: Number | None = None
    cant: Number | None = None
    rail_profile: Function | None = None
    friction_coefficient: Number | None = None
    shear_modulus: Number | None = None
    poisson_number: Number | None = None
    kalker: Vector | None = None
    ellipse: Vector | None = None
    velocity: Vector | None = None
    wheel_spin: Number | None = None
    directions: Literal["exact", "small_angles"] | None = None
    friction: Table | None = None
    latch: Table | None = None
    release: Number | None = None
    at_tip: Place | None = None
    axis_at_tip: Vector | str | None = None
    second_axis_at_tip: Vector | str | None = None
