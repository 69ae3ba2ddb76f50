# Made by `cargo xtask reference` of the program's own tables: do not edit.
"""Materials and cross sections."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

from ._entry import Entry, Number, Table, Vector


@dataclass(kw_only=True, slots=True)
class Material(Entry):
    """Isotropic elastic materials.

    Args:
        E: Young's modulus [Pa]; a number > 0.
        nu: Poisson's ratio; either it or `G` is required; a number, or nothing.
        G: shear modulus; either it or `nu` is required [Pa]; a number > 0, or nothing.
        density: mass density [kg/m³]; a number > 0.
        expansion: strain per change of temperature; default 0 [1/K]; a number, or nothing.
    """

    _table: ClassVar[str] = "materials"

    E: Number
    nu: Number | None = None
    G: Number | None = None
    density: Number
    expansion: Number | None = None


class Section(Entry):
    """Cross sections; axis 1 along the beam, 2 and 3 perpendicular to it."""

    __slots__ = ()
    _table: ClassVar[str] = "sections"
    _tag: ClassVar[str] = "shape"


@dataclass(kw_only=True, slots=True)
class Rectangle(Section):
    """Solid rectangle.

    Args:
        material: name of a material; the name of an entry of `[materials]`.
        width: side along axis 2 [m]; a number > 0.
        height: side along axis 3 [m]; a number > 0.
        shear: shear coefficient: one or two numbers (along 2 and 3), "cowper" (default) or "renton"; a number, two numbers, or a word, or nothing.
        damping: damping in proportion to the stiffness [s]; a number ≥ 0, or nothing.
    """

    _form: ClassVar[str] = "rectangle"

    material: str
    width: Number
    height: Number
    shear: Number | Vector | None = None
    damping: Number | None = None


@dataclass(kw_only=True, slots=True)
class Circle(Section):
    """Solid circle.

    Args:
        material: name of a material; the name of an entry of `[materials]`.
        radius: radius [m]; a number > 0.
        shear: shear coefficient: one or two numbers (along 2 and 3), "cowper" (default) or "renton"; a number, two numbers, or a word, or nothing.
        damping: damping in proportion to the stiffness [s]; a number ≥ 0, or nothing.
    """

    _form: ClassVar[str] = "circle"

    material: str
    radius: Number
    shear: Number | Vector | None = None
    damping: Number | None = None


@dataclass(kw_only=True, slots=True)
class Tube(Section):
    """Circular tube.

    Args:
        material: name of a material; the name of an entry of `[materials]`.
        outer_radius: outer radius [m]; a number > 0.
        thickness: thickness of the wall [m]; a number > 0.
        shear: shear coefficient: one or two numbers (along 2 and 3), "cowper" (default) or "renton"; a number, two numbers, or a word, or nothing.
        damping: damping in proportion to the stiffness [s]; a number ≥ 0, or nothing.
    """

    _form: ClassVar[str] = "tube"

    material: str
    outer_radius: Number
    thickness: Number
    shear: Number | Vector | None = None
    damping: Number | None = None


@dataclass(kw_only=True, slots=True)
class General(Section):
    """Specified by its stiffness and mass matrices.

    Args:
        stiffness: 6 x 6 or its diagonal: axial, shear 2, shear 3, torsion, bending 2, bending 3 [N, N m²]; six numbers or a 6 x 6 matrix.
        mass: 6 x 6, or { per_length, inertia = [J11, J22, J33], center = [c2, c3] } [kg/m, kg m]; six numbers, a 6 x 6 matrix, or a table.
        expansion: strain per change of temperature; default 0 [1/K]; a number, or nothing.
        damping: damping in proportion to the stiffness [s]; a number ≥ 0, or nothing.
    """

    _form: ClassVar[str] = "general"

    stiffness: Vector | list[Vector]
    mass: Vector | list[Vector] | Table
    expansion: Number | None = None
    damping: Number | None = None
