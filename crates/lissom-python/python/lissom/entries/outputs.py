# Made by `cargo xtask reference` of the program's own tables: do not edit.
"""What is recorded, one class per kind."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar, Literal

from ._entry import Entry, Number, Place, Vector


class Output(Entry):
    """Quantities to be recorded."""

    __slots__ = ()
    _table: ClassVar[str] = "outputs"
    _tag: ClassVar[str] = "kind"


@dataclass(kw_only=True, slots=True)
class Position(Output):
    """Position of a node, or of a point fixed to it.

    Args:
        of: the node, such as "beam@0.5"; a node.
        relative_to: body, or position on a beam, relative to which the motion is measured, in its axes; default: the ground; a node, or nothing.
        in_: body, or position on a beam, in whose axes it is expressed; default global axes, or those of `relative_to`; a node, or nothing.
        point: position at the start of a point fixed to the node, global axes; default: the node [m]; a position, or nothing.
        plot: plot in which it is drawn together with other outputs of the same word; default its own; a text, or nothing.
    """

    _form: ClassVar[str] = "position"

    of: str
    relative_to: str | None = None
    in_: str | None = None
    point: Place | None = None
    plot: str | None = None


@dataclass(kw_only=True, slots=True)
class Displacement(Output):
    """Displacement from the position in the model file.

    Args:
        of: the node, such as "beam@0.5"; a node.
        relative_to: body, or position on a beam, relative to which the motion is measured, in its axes; default: the ground; a node, or nothing.
        in_: body, or position on a beam, in whose axes it is expressed; default global axes, or those of `relative_to`; a node, or nothing.
        point: position at the start of a point fixed to the node, global axes; default: the node [m]; a position, or nothing.
        plot: plot in which it is drawn together with other outputs of the same word; default its own; a text, or nothing.
    """

    _form: ClassVar[str] = "displacement"

    of: str
    relative_to: str | None = None
    in_: str | None = None
    point: Place | None = None
    plot: str | None = None


@dataclass(kw_only=True, slots=True)
class Rotation(Output):
    """Rotation vector since the start.

    Args:
        of: the node, such as "beam@0.5"; a node.
        relative_to: body, or position on a beam, relative to which the motion is measured, in its axes; default: the ground; a node, or nothing.
        in_: body, or position on a beam, in whose axes it is expressed; default global axes, or those of `relative_to`; a node, or nothing.
        plot: plot in which it is drawn together with other outputs of the same word; default its own; a text, or nothing.
    """

    _form: ClassVar[str] = "rotation"

    of: str
    relative_to: str | None = None
    in_: str | None = None
    plot: str | None = None


@dataclass(kw_only=True, slots=True)
class Quaternion(Output):
    """Orientation of a node as a unit quaternion with non-negative q0.

    Args:
        of: the node, such as "beam@0.5"; a node.
        relative_to: body, or position on a beam, relative to which the motion is measured, in its axes; default: the ground; a node, or nothing.
        plot: plot in which it is drawn together with other outputs of the same word; default its own; a text, or nothing.
    """

    _form: ClassVar[str] = "quaternion"

    of: str
    relative_to: str | None = None
    plot: str | None = None


@dataclass(kw_only=True, slots=True)
class CardanAngles(Output):
    """Orientation of a node as Cardan angles: rotations about x, the rotated y and the twice rotated z.

    Args:
        of: the node, such as "beam@0.5"; a node.
        relative_to: body, or position on a beam, relative to which the motion is measured, in its axes; default: the ground; a node, or nothing.
        plot: plot in which it is drawn together with other outputs of the same word; default its own; a text, or nothing.
    """

    _form: ClassVar[str] = "cardan_angles"

    of: str
    relative_to: str | None = None
    plot: str | None = None


@dataclass(kw_only=True, slots=True)
class Angle(Output):
    """Rotation angle of a node about an axis since the start, continuous beyond half a revolution.

    Args:
        of: the node, such as "beam@0.5"; a node.
        axis: axis at the start, global axes; it is fixed in `relative_to`; a direction.
        relative_to: body, or position on a beam, relative to which the motion is measured, in its axes; default: the ground; a node, or nothing.
        plot: plot in which it is drawn together with other outputs of the same word; default its own; a text, or nothing.
    """

    _form: ClassVar[str] = "angle"

    of: str
    axis: Vector | str
    relative_to: str | None = None
    plot: str | None = None


@dataclass(kw_only=True, slots=True)
class Velocity(Output):
    """Velocity of a node, or of a point fixed to it.

    Args:
        of: the node, such as "beam@0.5"; a node.
        relative_to: body, or position on a beam, relative to which the motion is measured, in its axes; default: the ground; a node, or nothing.
        in_: body, or position on a beam, in whose axes it is expressed; default global axes, or those of `relative_to`; a node, or nothing.
        point: position at the start of a point fixed to the node, global axes; default: the node [m]; a position, or nothing.
        plot: plot in which it is drawn together with other outputs of the same word; default its own; a text, or nothing.
    """

    _form: ClassVar[str] = "velocity"

    of: str
    relative_to: str | None = None
    in_: str | None = None
    point: Place | None = None
    plot: str | None = None


@dataclass(kw_only=True, slots=True)
class Distance(Output):
    """Distance of a node, or of a point fixed to it, from another node, and its rate; without `relative_to`, or with the ground, from the origin: no distance from a surface.

    Args:
        of: the node, such as "beam@0.5"; a node.
        relative_to: body, or position on a beam, relative to which the motion is measured, in its axes; default: the ground; a node, or nothing.
        point: position at the start of a point fixed to the node, global axes; default: the node [m]; a position, or nothing.
        plot: plot in which it is drawn together with other outputs of the same word; default its own; a text, or nothing.
    """

    _form: ClassVar[str] = "distance"

    of: str
    relative_to: str | None = None
    point: Place | None = None
    plot: str | None = None


@dataclass(kw_only=True, slots=True)
class AngularVelocity(Output):
    """Angular velocity of a node.

    Args:
        of: the node, such as "beam@0.5"; a node.
        relative_to: body, or position on a beam, relative to which the motion is measured, in its axes; default: the ground; a node, or nothing.
        in_: body, or position on a beam, in whose axes it is expressed; default global axes, or those of `relative_to`; a node, or nothing.
        plot: plot in which it is drawn together with other outputs of the same word; default its own; a text, or nothing.
    """

    _form: ClassVar[str] = "angular_velocity"

    of: str
    relative_to: str | None = None
    in_: str | None = None
    plot: str | None = None


@dataclass(kw_only=True, slots=True)
class Acceleration(Output):
    """Acceleration of a node, or of a point fixed to it.

    Args:
        of: the node, such as "beam@0.5"; a node.
        relative_to: body, or position on a beam, relative to which the motion is measured, in its axes; default: the ground; a node, or nothing.
        in_: body, or position on a beam, in whose axes it is expressed; default global axes, or those of `relative_to`; a node, or nothing.
        point: position at the start of a point fixed to the node, global axes; default: the node [m]; a position, or nothing.
        plot: plot in which it is drawn together with other outputs of the same word; default its own; a text, or nothing.
    """

    _form: ClassVar[str] = "acceleration"

    of: str
    relative_to: str | None = None
    in_: str | None = None
    point: Place | None = None
    plot: str | None = None


@dataclass(kw_only=True, slots=True)
class SectionForce(Output):
    """Axial and shear forces in a beam, section axes.

    Args:
        of: the node, such as "beam@0.5"; a node.
        woehler_exponent: exponent of the Wöhler curve; the summary then has `damage_equivalent` of each component; a number > 0, or nothing.
        reference_cycles: number of cycles of the damage equivalent range; default one per second of the run; a number > 0, or nothing.
        plot: plot in which it is drawn together with other outputs of the same word; default its own; a text, or nothing.
    """

    _form: ClassVar[str] = "section_force"

    of: str
    woehler_exponent: Number | None = None
    reference_cycles: Number | None = None
    plot: str | None = None


@dataclass(kw_only=True, slots=True)
class SectionMoment(Output):
    """Torsion and bending moments in a beam, section axes.

    Args:
        of: the node, such as "beam@0.5"; a node.
        woehler_exponent: exponent of the Wöhler curve; the summary then has `damage_equivalent` of each component; a number > 0, or nothing.
        reference_cycles: number of cycles of the damage equivalent range; default one per second of the run; a number > 0, or nothing.
        plot: plot in which it is drawn together with other outputs of the same word; default its own; a text, or nothing.
    """

    _form: ClassVar[str] = "section_moment"

    of: str
    woehler_exponent: Number | None = None
    reference_cycles: Number | None = None
    plot: str | None = None


@dataclass(kw_only=True, slots=True)
class ShellForce(Output):
    """Forces per length in a shell, local axes of the node: in the surface and across it.

    Args:
        of: the node of a shell, such as "panel@0.5,1"; a node.
        woehler_exponent: exponent of the Wöhler curve; the summary then has `damage_equivalent` of each component; a number > 0, or nothing.
        reference_cycles: number of cycles of the damage equivalent range; default one per second of the run; a number > 0, or nothing.
        plot: plot in which it is drawn together with other outputs of the same word; default its own; a text, or nothing.
    """

    _form: ClassVar[str] = "shell_force"

    of: str
    woehler_exponent: Number | None = None
    reference_cycles: Number | None = None
    plot: str | None = None


@dataclass(kw_only=True, slots=True)
class ShellMoment(Output):
    """Bending moments and torsion per length in a shell, local axes of the node; positive where the side of the normal is in tension.

    Args:
        of: the node of a shell, such as "panel@0.5,1"; a node.
        woehler_exponent: exponent of the Wöhler curve; the summary then has `damage_equivalent` of each component; a number > 0, or nothing.
        reference_cycles: number of cycles of the damage equivalent range; default one per second of the run; a number > 0, or nothing.
        plot: plot in which it is drawn together with other outputs of the same word; default its own; a text, or nothing.
    """

    _form: ClassVar[str] = "shell_moment"

    of: str
    woehler_exponent: Number | None = None
    reference_cycles: Number | None = None
    plot: str | None = None


@dataclass(kw_only=True, slots=True)
class ShellStress(Output):
    """Stresses at both faces of a shell, local axes of the node, von Mises stresses at the faces and in the middle, and an estimate of their error.

    Args:
        of: the node of a shell, such as "panel@0.5,1"; a node.
        woehler_exponent: exponent of the Wöhler curve; the summary then has `damage_equivalent` of each component; a number > 0, or nothing.
        reference_cycles: number of cycles of the damage equivalent range; default one per second of the run; a number > 0, or nothing.
        plot: plot in which it is drawn together with other outputs of the same word; default its own; a text, or nothing.
    """

    _form: ClassVar[str] = "shell_stress"

    of: str
    woehler_exponent: Number | None = None
    reference_cycles: Number | None = None
    plot: str | None = None


@dataclass(kw_only=True, slots=True)
class SolidStress(Output):
    """Stresses at a node of a solid, global axes, its von Mises stress and its largest principal stress.

    Args:
        of: the node of a solid, such as "block@0.5,1,0"; a node.
        woehler_exponent: exponent of the Wöhler curve; the summary then has `damage_equivalent` of each component; a number > 0, or nothing.
        reference_cycles: number of cycles of the damage equivalent range; default one per second of the run; a number > 0, or nothing.
        plot: plot in which it is drawn together with other outputs of the same word; default its own; a text, or nothing.
    """

    _form: ClassVar[str] = "solid_stress"

    of: str
    woehler_exponent: Number | None = None
    reference_cycles: Number | None = None
    plot: str | None = None


@dataclass(kw_only=True, slots=True)
class Line(Output):
    """Positions of all nodes of a beam, from its start to its end.

    Args:
        of: the beam; the name of an entry of `[beams]`.
        plot: plot in which it is drawn together with other outputs of the same word; default its own; a text, or nothing.
    """

    _form: ClassVar[str] = "line"

    of: str
    plot: str | None = None


@dataclass(kw_only=True, slots=True)
class Modal(Output):
    """Modal coordinates of a superelement and their rates, in the units of its matrices.

    Args:
        of: the superelement; the name of an entry of `[superelements]`.
        plot: plot in which it is drawn together with other outputs of the same word; default its own; a text, or nothing.
    """

    _form: ClassVar[str] = "modal"

    of: str
    plot: str | None = None


@dataclass(kw_only=True, slots=True)
class Recovered(Output):
    """Stresses or displacements between the interfaces of a superelement: its `recovery` matrix times its deformation.

    Args:
        of: the superelement; the name of an entry of `[superelements]`.
        woehler_exponent: exponent of the Wöhler curve; the summary then has `damage_equivalent` of each component; a number > 0, or nothing.
        reference_cycles: number of cycles of the damage equivalent range; default one per second of the run; a number > 0, or nothing.
        plot: plot in which it is drawn together with other outputs of the same word; default its own; a text, or nothing.
    """

    _form: ClassVar[str] = "recovered"

    of: str
    woehler_exponent: Number | None = None
    reference_cycles: Number | None = None
    plot: str | None = None


@dataclass(kw_only=True, slots=True)
class Reaction(Output):
    """Force and moment of a joint on its tip.

    Args:
        of: the joint; the name of an entry of `[joints]`.
        axes: global axes, or those of the joint frame fixed in base or tip; default `"ground"`; `"ground"`, `"base"`, `"tip"`, or nothing.
        woehler_exponent: exponent of the Wöhler curve; the summary then has `damage_equivalent` of each component; a number > 0, or nothing.
        reference_cycles: number of cycles of the damage equivalent range; default one per second of the run; a number > 0, or nothing.
        plot: plot in which it is drawn together with other outputs of the same word; default its own; a text, or nothing.
    """

    _form: ClassVar[str] = "reaction"

    of: str
    axes: Literal["ground", "base", "tip"] | None = None
    woehler_exponent: Number | None = None
    reference_cycles: Number | None = None
    plot: str | None = None


@dataclass(kw_only=True, slots=True)
class Relative(Output):
    """Relative coordinates of a joint.

    Args:
        of: the joint; the name of an entry of `[joints]`.
        plot: plot in which it is drawn together with other outputs of the same word; default its own; a text, or nothing.
    """

    _form: ClassVar[str] = "relative"

    of: str
    plot: str | None = None


@dataclass(kw_only=True, slots=True)
class RelativeAcceleration(Output):
    """Accelerations of a joint's relative coordinates.

    Args:
        of: the joint; the name of an entry of `[joints]`.
        plot: plot in which it is drawn together with other outputs of the same word; default its own; a text, or nothing.
    """

    _form: ClassVar[str] = "relative_acceleration"

    of: str
    plot: str | None = None


@dataclass(kw_only=True, slots=True)
class RelativeMotion(Output):
    """Position and rotation vector of a joint's tip frame, in the axes of its base frame.

    Args:
        of: the joint; the name of an entry of `[joints]`.
        plot: plot in which it is drawn together with other outputs of the same word; default its own; a text, or nothing.
    """

    _form: ClassVar[str] = "relative_motion"

    of: str
    plot: str | None = None


@dataclass(kw_only=True, slots=True)
class Contact(Output):
    """Contact position of a wheel on a rail, with normal force, creep forces and creepages.

    Args:
        of: the joint; the name of an entry of `[joints]`.
        plot: plot in which it is drawn together with other outputs of the same word; default its own; a text, or nothing.
    """

    _form: ClassVar[str] = "contact"

    of: str
    plot: str | None = None


@dataclass(kw_only=True, slots=True)
class ContactForce(Output):
    """Smallest gap of a contact, sum of its normal forces, magnitude of its friction, force on the tip in global axes, sliding velocity, numbers of points that touch and of those that slide, and the centre of the normal forces in global axes.

    Args:
        of: the contact; the name of an entry of `[contacts]`.
        plot: plot in which it is drawn together with other outputs of the same word; default its own; a text, or nothing.
    """

    _form: ClassVar[str] = "contact_force"

    of: str
    plot: str | None = None


@dataclass(kw_only=True, slots=True)
class LocalLoad(Output):
    """Resultant force of a local load, its moment about the origin, and the power that it supplies, global axes; or with `station` force and moment per length there, in the axes of the load, and its variables.

    Args:
        of: the local load; the name of an entry of `[local_loads]`.
        station: fraction of the length of the beam along which the load acts, at one of its nodes; default the whole load; a number from 0 to 1, or nothing.
        plot: plot in which it is drawn together with other outputs of the same word; default its own; a text, or nothing.
    """

    _form: ClassVar[str] = "local_load"

    of: str
    station: Number | None = None
    plot: str | None = None


@dataclass(kw_only=True, slots=True)
class Spring(Output):
    """Elongation or rotation of a spring, its rate, and its force or moment.

    Args:
        of: the spring; the name of an entry of `[springs]`.
        woehler_exponent: exponent of the Wöhler curve; the summary then has `damage_equivalent` of each component; a number > 0, or nothing.
        reference_cycles: number of cycles of the damage equivalent range; default one per second of the run; a number > 0, or nothing.
        plot: plot in which it is drawn together with other outputs of the same word; default its own; a text, or nothing.
    """

    _form: ClassVar[str] = "spring"

    of: str
    woehler_exponent: Number | None = None
    reference_cycles: Number | None = None
    plot: str | None = None


@dataclass(kw_only=True, slots=True)
class SpringForce(Output):
    """Force and moment of a spring, bushing, bearing or rolling contact on its tip, about its point `at_tip`.

    Args:
        of: the spring; the name of an entry of `[springs]`.
        axes: global axes, or those of the joint frame fixed in base or tip; default `"ground"`; `"ground"`, `"base"`, `"tip"`, or nothing.
        woehler_exponent: exponent of the Wöhler curve; the summary then has `damage_equivalent` of each component; a number > 0, or nothing.
        reference_cycles: number of cycles of the damage equivalent range; default one per second of the run; a number > 0, or nothing.
        plot: plot in which it is drawn together with other outputs of the same word; default its own; a text, or nothing.
    """

    _form: ClassVar[str] = "spring_force"

    of: str
    axes: Literal["ground", "base", "tip"] | None = None
    woehler_exponent: Number | None = None
    reference_cycles: Number | None = None
    plot: str | None = None


@dataclass(kw_only=True, slots=True)
class Tyre(Output):
    """Slip, slip angle and forces of a tyre in axes of its contact, and its aligning moment; all zero in the air.

    Args:
        of: the spring; the name of an entry of `[springs]`.
        plot: plot in which it is drawn together with other outputs of the same word; default its own; a text, or nothing.
    """

    _form: ClassVar[str] = "tyre"

    of: str
    plot: str | None = None


@dataclass(kw_only=True, slots=True)
class Power(Output):
    """Power that a spring, a load, a drive or the friction of a joint delivers to the rest of the model.

    Args:
        of: the name of a spring, a load, a drive or a joint with friction; a text.
        plot: plot in which it is drawn together with other outputs of the same word; default its own; a text, or nothing.
    """

    _form: ClassVar[str] = "power"

    of: str
    plot: str | None = None


@dataclass(kw_only=True, slots=True)
class Work(Output):
    """Work that a spring, a load, a drive or the friction of a joint has delivered to the rest of the model.

    Args:
        of: the name of a spring, a load, a drive or a joint with friction; a text.
        plot: plot in which it is drawn together with other outputs of the same word; default its own; a text, or nothing.
    """

    _form: ClassVar[str] = "work"

    of: str
    plot: str | None = None


@dataclass(kw_only=True, slots=True)
class Energy(Output):
    """Kinetic, strain, gravity and total energy of the model.

    Args:
        plot: plot in which it is drawn together with other outputs of the same word; default its own; a text, or nothing.
    """

    _form: ClassVar[str] = "energy"

    plot: str | None = None


@dataclass(kw_only=True, slots=True)
class Momentum(Output):
    """Momentum and angular momentum of the model about the origin, global axes.

    Args:
        in_: body, or position on a beam, in whose axes it is expressed; default global axes, or those of `relative_to`; a node, or nothing.
        plot: plot in which it is drawn together with other outputs of the same word; default its own; a text, or nothing.
    """

    _form: ClassVar[str] = "momentum"

    in_: str | None = None
    plot: str | None = None


@dataclass(kw_only=True, slots=True)
class Signal(Output):
    """Value of a signal, an input or a state.

    Args:
        of: the name of a signal, an input or a state, or of a component of a hydraulic part; a text.
        unit: unit of its values, such as "kN", for plots and tables; default none; a text, or nothing.
        woehler_exponent: exponent of the Wöhler curve; the summary then has `damage_equivalent` of each component; a number > 0, or nothing.
        reference_cycles: number of cycles of the damage equivalent range; default one per second of the run; a number > 0, or nothing.
        plot: plot in which it is drawn together with other outputs of the same word; default its own; a text, or nothing.
    """

    _form: ClassVar[str] = "signal"

    of: str
    unit: str | None = None
    woehler_exponent: Number | None = None
    reference_cycles: Number | None = None
    plot: str | None = None


@dataclass(kw_only=True, slots=True)
class Expression(Output):
    """Value of an expression of time, components of other outputs, coordinates of joints, signals, inputs and states.

    Args:
        value: expression such as "hypot(a.x - b.x, a.y - b.y)", of components of outputs; an expression of signals.
        unit: unit of its values, such as "kN", for plots and tables; default none; a text, or nothing.
        woehler_exponent: exponent of the Wöhler curve; the summary then has `damage_equivalent` of each component; a number > 0, or nothing.
        reference_cycles: number of cycles of the damage equivalent range; default one per second of the run; a number > 0, or nothing.
        plot: plot in which it is drawn together with other outputs of the same word; default its own; a text, or nothing.
    """

    _form: ClassVar[str] = "expression"

    value: Number
    unit: str | None = None
    woehler_exponent: Number | None = None
    reference_cycles: Number | None = None
    plot: str | None = None
