# Made by `cargo xtask reference` of the program's own tables: do not edit.
"""Applied forces and moments, and those of actuators."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar, Literal

from ._entry import Entry, Function, Number, Place, Table, Vector


class Load(Entry):
    """Applied forces and moments, and those of actuators."""

    __slots__ = ()
    _table: ClassVar[str] = "loads"
    _tag: ClassVar[str] = "kind"


@dataclass(kw_only=True, slots=True)
class Force(Load):
    """Force on a point, of fixed direction or rotating with the node, scaled by a function of time.

    Args:
        in_: body, point mass or part in whose initial frame positions and directions are expressed; default: the enclosing part; a text, or nothing.
        on: node on which it acts; a node.
        at: location; default: the node's position [m]; a position, or nothing.
        vector: Force or moment at scale 1, in global axes at the start [N or N m]; three numbers.
        scale: Factor; default 1; a size, or nothing.
        follower: Whether it rotates with the node; otherwise its direction is fixed; default `false`; `true` or `false`, or nothing.
    """

    _form: ClassVar[str] = "force"

    in_: str | None = None
    on: str
    at: Place | None = None
    vector: Vector
    scale: Function | None = None
    follower: bool | None = None


@dataclass(kw_only=True, slots=True)
class Moment(Load):
    """Moment on a node, of fixed direction or rotating with the node, scaled by a function of time.

    Args:
        in_: body, point mass or part in whose initial frame positions and directions are expressed; default: the enclosing part; a text, or nothing.
        on: node on which it acts; a node.
        at: location; default: the node's position [m]; a position, or nothing.
        vector: Force or moment at scale 1, in global axes at the start [N or N m]; three numbers.
        scale: Factor; default 1; a size, or nothing.
        follower: Whether it rotates with the node; otherwise its direction is fixed; default `false`; `true` or `false`, or nothing.
    """

    _form: ClassVar[str] = "moment"

    in_: str | None = None
    on: str
    at: Place | None = None
    vector: Vector
    scale: Function | None = None
    follower: bool | None = None


@dataclass(kw_only=True, slots=True)
class ForceBetween(Load):
    """Force of an actuator between two points, along the line through them: a cylinder, a muscle, a cable of given tension.

    Args:
        in_: body, point mass or part in whose initial frame positions and directions are expressed; default: the enclosing part; a text, or nothing.
        base: first node: "ground", "body", "beam.end" …; a node.
        tip: second node; a node.
        at_base: location on the base; default: the node's position [m]; a position, or nothing.
        at_tip: location on the tip; default: the node's position [m]; a position, or nothing.
        force: Force on the tip's point, positive where it pushes the points apart [N]; a size.
    """

    _form: ClassVar[str] = "force_between"

    in_: str | None = None
    base: str
    tip: str
    at_base: Place | None = None
    at_tip: Place | None = None
    force: Function


@dataclass(kw_only=True, slots=True)
class JointTorque(Load):
    """Torque of an actuator on a joint's relative rotation, from the base on the tip.

    Args:
        in_: body, point mass or part in whose initial frame positions and directions are expressed; default: the enclosing part; a text, or nothing.
        joint: the joint whose relative rotation it acts on; the name of an entry of `[joints]`.
        torque: Torque about the joint's axis, positive where it increases the rotation [N m]; a size.
        coordinate: Number of the joint's coordinate, from 1; default: the first suitable one; a number > 0, or nothing.
    """

    _form: ClassVar[str] = "joint_torque"

    in_: str | None = None
    joint: str
    torque: Function
    coordinate: Number | None = None


@dataclass(kw_only=True, slots=True)
class JointForce(Load):
    """Force of an actuator on a joint's relative displacement, from the base on the tip.

    Args:
        in_: body, point mass or part in whose initial frame positions and directions are expressed; default: the enclosing part; a text, or nothing.
        joint: the joint whose relative displacement it acts on; the name of an entry of `[joints]`.
        force: Force along the joint's axis, positive where it increases the displacement [N]; a size.
        coordinate: Number of the joint's coordinate, from 1; default: the first suitable one; a number > 0, or nothing.
    """

    _form: ClassVar[str] = "joint_force"

    in_: str | None = None
    joint: str
    force: Function
    coordinate: Number | None = None


@dataclass(kw_only=True, slots=True)
class Gyrostat(Load):
    """Rotor in a body, with a constant rate of spin relative to it.

    Args:
        in_: body, point mass or part in whose initial frame positions and directions are expressed; default: the enclosing part; a text, or nothing.
        on: node on which it acts; a node.
        at: location; default: the node's position [m]; a position, or nothing.
        axis: Axis of the rotor at the start, global axes; it rotates with the node; a direction.
        inertia: Inertia of the rotor about its axis [kg m²]; a number > 0.
        spin: Rate of spin relative to the body [rad/s]; a number.
    """

    _form: ClassVar[str] = "gyrostat"

    in_: str | None = None
    on: str
    at: Place | None = None
    axis: Vector | str
    inertia: Number
    spin: Number


@dataclass(kw_only=True, slots=True)
class LocalLoad(Entry):
    """Forces and moments that depend on the motion of their own points, along beams and on nodes.

    Args:
        in_: body, point mass or part in whose initial frame positions and directions are expressed; default: the enclosing part; a text, or nothing.
        on: a beam, along which it is distributed, or a node; a node.
        at: where it acts on a node, at the start; default the node [m]; a position, or nothing.
        axes: axes of `force`, `moment`, velocities and relative flow: those of the section or body, global ones, or those of the part in which the load is, to which x, y, z and `flow` refer then too; default `"section"`; `"section"`, `"global"`, `"part"`, or nothing.
        about: another node, such as a hub: r1, r2, r3 is the position relative to it; a node, or nothing.
        axis: direction fixed in the node `about`, at the start: n1, n2, n3 in expressions; a direction, or nothing.
        force: per length of a beam, or on a node: three numbers or expressions [N/m, N]; three expressions of `s` and `t`, or nothing.
        moment: the same for the moment [N, N m]; three expressions of `s` and `t`, or nothing.
        flow: velocity of the surrounding fluid in global axes, or with `axes = "part"` in those of the part: three numbers or expressions of x, y, z, t and inputs [m/s]; three expressions of `s` and `t`, or nothing.
        variables: named expressions for use in the others; or { of = "…", table = [[…]] }, a table over an expression; a table, or nothing.
        states: first-order states at each point: { derivative = "…", start = 0, magnitude = 1 }; a table, or nothing.
    """

    _table: ClassVar[str] = "local_loads"

    in_: str | None = None
    on: str
    at: Place | None = None
    axes: Literal["section", "global", "part"] | None = None
    about: str | None = None
    axis: Vector | str | None = None
    force: Vector | None = None
    moment: Vector | None = None
    flow: Vector | None = None
    variables: Table | None = None
    states: Table | None = None
