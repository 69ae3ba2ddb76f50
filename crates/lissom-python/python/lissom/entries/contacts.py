# Made by `cargo xtask reference` of the program's own tables: do not edit.
"""Parts that may touch, and the solids that are fixed in space."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar, Literal

from ._entry import Count, Entry, Number, Table, Vector


@dataclass(kw_only=True, slots=True)
class Contact(Entry):
    """Parts that may touch, by their shapes; `kind` may be omitted: it follows from parts and keys.

    Args:
        kind: its kind; default by its parts and keys; `"compliant"`, `"rigid"`, `"along"`, `"nearest"`, `"nodes"`, or nothing.
        base: a body or point mass with a `shape`, or "ground"; or a beam if the tip is one; or a shell, with `stiffness_per_area`; a node.
        tip: the other part that may touch it; or the name of a beam, a shell or a solid; a node.
        others: further parts: every two of `base`, `tip` and these may touch; a list of nodes, or nothing.
        except_: with `others`: lists of parts of which no two touch; lists of nodes, or nothing.
        rigid: older word for the kinds `rigid` and `compliant`; `true` or `false`, or nothing.
        stiffness: normal force at a penetration of 1 m [N/m^n]; a number > 0, or nothing.
        exponent: exponent n of the penetration, at least 1; default 1; a number > 0, or nothing.
        material: instead of `stiffness` and `exponent`: the material of both parts, for balls on balls or planes by the theory of Hertz; the name of an entry of `[materials]`, or nothing.
        tip_material: material of the tip, if it is another one; the name of an entry of `[materials]`, or nothing.
        restitution: velocity after an impact over that before, at any impact velocity: from 0.01 to 1, and 1 if it is omitted; a number from 0 to 1, or nothing.
        rest_velocity: slower impacts dissipate as those of this velocity; requires `restitution`; default 1e-3 [m/s]; a number > 0, or nothing.
        dissipation: instead of `restitution`: relative increase of the normal force per penetration velocity [s/m]; a number ≥ 0, or nothing.
        friction: coefficient of sliding friction; default 0; a number ≥ 0, or nothing.
        static_friction: coefficient at rest, not below `friction`; default: that of `friction`; a number > 0, or nothing.
        stribeck: sliding velocity at which the difference has fallen to 1/e, and friction begins to yield; default 0.01 [m/s]; a number > 0, or nothing.
        deflection: tangential deflection before it slips; default 1e-5 [m]; a number > 0, or nothing.
        surface_velocity: velocity at which the surface of the base moves along itself, as a conveyor belt, in the axes of the base; requires `friction` [m/s]; three numbers, or nothing.
        rolling_friction: moment against rolling per normal force; default 0 [m]; a number ≥ 0, or nothing.
        torsional_friction: moment against spinning about the normal per normal force; default 0 [m]; a number ≥ 0, or nothing.
        stiffness_per_length: of a beam: normal force per length at a penetration of 1 m [N/m^(n+1)]; a number > 0, or nothing.
        points: of a beam: number of intervals between points of contact in an element; default 2; a whole number from 1 to 64, or nothing.
        radius: of a beam as tip: its radius where it touches; default that of its sections, if they are round and equal [m]; a number > 0, or nothing.
        base_radius: of a beam as base: its radius [m]; a number > 0, or nothing.
        stiffness_per_area: of a shell or a solid: normal force per area at a penetration of 1 m [N/m^(n+2)]; a number > 0, or nothing.
        faces: of a solid: set of nodes whose faces touch; default all outer faces; a text, or nothing.
    """

    _table: ClassVar[str] = "contacts"

    kind: Literal["compliant", "rigid", "along", "nearest", "nodes"] | None = None
    base: str
    tip: str
    others: list[str] | None = None
    except_: list[list[str]] | None = None
    rigid: bool | None = None
    stiffness: Number | None = None
    exponent: Number | None = None
    material: str | None = None
    tip_material: str | None = None
    restitution: Number | None = None
    rest_velocity: Number | None = None
    dissipation: Number | None = None
    friction: Number | None = None
    static_friction: Number | None = None
    stribeck: Number | None = None
    deflection: Number | None = None
    surface_velocity: Vector | None = None
    rolling_friction: Number | None = None
    torsional_friction: Number | None = None
    stiffness_per_length: Number | None = None
    points: Count | None = None
    radius: Number | None = None
    base_radius: Number | None = None
    stiffness_per_area: Number | None = None
    faces: str | None = None


@dataclass(kw_only=True, slots=True)
class Ground(Entry):
    """Solids that are fixed in space, for contacts and drawings.

    Args:
        shape: solids, in global axes; by default at the origin; a solid, or a list of solids, or nothing.
        mesh: instead of `shape`: an STL or glTF file in metres, drawn only; a text, or nothing.
    """

    _table: ClassVar[str] = "ground"

    shape: Table | list[Table] | None = None
    mesh: str | None = None
