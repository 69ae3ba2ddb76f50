# Made by `cargo xtask reference` of the program's own tables: do not edit.
"""How the parts are and move at the start."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

from ._entry import Entry, Names, Place, Vector


@dataclass(kw_only=True, slots=True)
class Initial(Entry):
    """Initial conditions: a rigid motion of all parts, or of those listed in an entry [initial.…]; static equilibrium.

    Args:
        velocity: velocity of the point `about` [m/s]; three numbers, or nothing.
        angular_velocity: global axes [rad/s]; three numbers, or nothing.
        about: a point of the rigid motion; default the origin [m]; a position, or nothing.
        equilibrium: start from static equilibrium under the loads at the start; default `false`; `true` or `false`, or nothing.
        steady_rotation: start from the relative equilibrium in which the model rotates steadily with its velocities; default `false`; `true` or `false`, or nothing.
        follow_drives: beams, shells, solids and superelements without given velocities start with those of their drive, otherwise at rest; default `true`; `true` or `false`, or nothing.
        motions: rigid motions of some parts, by names of their own; `PartMotion`, or nothing.
    """

    _table: ClassVar[str] = "initial"

    velocity: Vector | None = None
    angular_velocity: Vector | None = None
    about: Place | None = None
    equilibrium: bool | None = None
    steady_rotation: bool | None = None
    follow_drives: bool | None = None
    motions: dict[str, PartMotion] | None = None


@dataclass(kw_only=True, slots=True)
class PartMotion(Entry):
    """A rigid motion of some parts at the start.

    Args:
        parts: bodies, point masses, beams, shells, solids, superelements and entries of [parts] with this motion; a list of names of parts.
        velocity: velocity of the point `about` [m/s]; three numbers, or nothing.
        angular_velocity: global axes [rad/s]; three numbers, or nothing.
        about: a point of the rigid motion; default the origin [m]; a position, or nothing.
    """

    _table: ClassVar[str] = ""

    parts: Names
    velocity: Vector | None = None
    angular_velocity: Vector | None = None
    about: Place | None = None
