# Made by `cargo xtask reference` of the program's own tables: do not edit.
"""Beams, shells, solids, rigid bodies, point masses, superelements and sub-assemblies."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar, Literal

from ._entry import Count, Entry, Function, Number, Place, Table, Tables, Vector


@dataclass(kw_only=True, slots=True)
class Beam(Entry):
    """Flexible beams.

    Args:
        in_: body, point mass or part in whose initial frame positions and directions are expressed; default: the enclosing part; a text, or nothing.
        section: name of a section; either it or `stations` is required; the name of an entry of `[sections]`, or nothing.
        stations: [{ at = 0, section = "a" }, …, { at = 1, … }], interpolated linearly; a list of tables, or nothing.
        from_: start: a position, or a node of another part, which is then shared [m]; a position or a node, or nothing.
        to: end: a position, or a node of another part, which is then shared [m]; a position or a node, or nothing.
        through: an intermediate point: the beam is a circular arc [m]; a position, or nothing.
        curve: instead of `from` and `to`: three expressions of s in 0..1 [m]; three expressions of `s`, or nothing.
        elements: number of elements; a whole number from 1 to 100000.
        order: 1, 2 or 3: elements of 2, 3 or 4 nodes; default 3; a whole number from 1 to 3, or nothing.
        up: direction towards which local axis 3 is oriented; a direction, or nothing.
        force_per_length: in global axes, fixed in direction: three numbers or expressions of s and t [N/m]; three expressions of `s` and `t`, or nothing.
        section_force_per_length: in the section's axes 1, 2 and 3, with which it rotates: three numbers or expressions of s and t [N/m]; three expressions of `s` and `t`, or nothing.
        twist: rotation about the tangent, a number or an expression of s [rad]; a number or an expression of `s`, or nothing.
        temperature: above that of the state without stress, over the whole analysis: a number or an expression of s [K]; a number or an expression of `s`, or nothing.
        temperature_slope: change of the temperature along axes 2 and 3 of the section: it bends the beam [K/m]; two numbers, or nothing.
    """

    _table: ClassVar[str] = "beams"

    in_: str | None = None
    section: str | None = None
    stations: list[Table] | None = None
    from_: Place | None = None
    to: Place | None = None
    through: Place | None = None
    curve: Vector | None = None
    elements: Count
    order: Count | None = None
    up: Vector | str | None = None
    force_per_length: Vector | None = None
    section_force_per_length: Vector | None = None
    twist: Number | None = None
    temperature: Number | None = None
    temperature_slope: Vector | None = None


@dataclass(kw_only=True, slots=True)
class Shell(Entry):
    """Flexible shells and plates: curved surfaces of finite elements.

    Args:
        in_: body, point mass or part in whose initial frame positions and directions are expressed; default: the enclosing part; a text, or nothing.
        corners: four corners of a patch, counterclockwise about its normal: u = v = 0; u = 1; u = v = 1; v = 1 [m]; four positions, or nothing.
        surface: instead of `corners`: x, y and z over u and v from 0 to 1 [m]; three expressions of `u` and `v`, or nothing.
        divisions: of a patch: numbers of elements along u and v; two whole numbers, or nothing.
        mesh: instead of `corners`: a Gmsh (.msh), Abaqus (.inp) or Wavefront (.obj) file; path relative to this file; a text, or nothing.
        group: of a mesh: the set of its elements to be used; default all surfaces; a text, or nothing.
        scale: of a mesh: factor to metres; default 1; a number > 0, or nothing.
        join: whether nodes at the same position are one, as along the seam of a tube; default `false`; `true` or `false`, or nothing.
        thickness: a number or an expression of u and v; it or `plies` is required, unless the file of the mesh has one section for all elements [m]; a number or an expression of `u` and `v`, or nothing.
        material: of `thickness`, and of plies without their own; the name of an entry of `[materials]`, or nothing.
        offset: place of the middle of the thickness along the normal of the surface; default 0 [m]; a number, or nothing.
        damping: damping in proportion to the stiffness; default 0 [s]; a number ≥ 0, or nothing.
        plies: layers of a laminate from the bottom to the top of the normal; a list of layers, or nothing.
        direction: projected on the surface, the first local axis, from which angles of plies count; default the direction of u of a patch, global x of a mesh; a direction, or nothing.
        fold_angle: largest angle between elements of a mesh that count as one smooth surface; default 0.52 [rad]; a number from 0 to 3.2, or nothing.
        pressure: force per area along the normal, which it follows, as on the face opposite to it: an expression of u, v, t and the present place x, y, z [Pa]; a number or an expression of `u`, `v` and `t`, or nothing.
        pressure_on_top: force per area on the face of the normal, against the normal, as `top` in `pressure` of a solid: an expression of u, v, t and the present place x, y, z [Pa]; a number or an expression of `u`, `v` and `t`, or nothing.
        force_per_area: in global axes, fixed in direction: three numbers or expressions of u, v and t [Pa]; three expressions of `u`, `v` and `t`, or nothing.
        sets: named nodes: `{ near = [x, y, z] }`, `{ center = [x, y, z], radius = r }` or `{ from = [x, y, z], to = [x, y, z] }`; a table, or nothing.
        temperature: above that of the state without stress, over the whole analysis: a number or an expression of x, y and z at rest, in the axes of the part [K]; a number or an expression of `x`, `y` and `z`, or nothing.
        prestress: of a taut membrane: forces per length 11, 22 and 12 in the local axes before any strain [N/m]; three numbers, or nothing.
    """

    _table: ClassVar[str] = "shells"

    in_: str | None = None
    corners: list[Place] | None = None
    surface: Vector | None = None
    divisions: Vector | None = None
    mesh: str | None = None
    group: str | None = None
    scale: Number | None = None
    join: bool | None = None
    thickness: Number | None = None
    material: str | None = None
    offset: Number | None = None
    damping: Number | None = None
    plies: list[Table] | None = None
    direction: Vector | str | None = None
    fold_angle: Number | None = None
    pressure: Number | None = None
    pressure_on_top: Number | None = None
    force_per_area: Vector | None = None
    sets: Table | None = None
    temperature: Number | None = None
    prestress: Vector | None = None


@dataclass(kw_only=True, slots=True)
class Solid(Entry):
    """Elastic solids: volumes of finite elements.

    Args:
        in_: body, point mass or part in whose initial frame positions and directions are expressed; default: the enclosing part; a text, or nothing.
        size: of a box along the axes: its lengths [m]; three numbers, or nothing.
        origin: of a box: its corner with the lowest coordinates; default the origin [m]; a position, or nothing.
        volume: instead of `size`: x, y and z over u, v and w from 0 to 1, which are right-handed [m]; three expressions of `u`, `v` and `w`, or nothing.
        divisions: of `size` and `volume`: numbers of elements along u, v and w; three whole numbers, or nothing.
        mesh: instead of `size`: a Gmsh (.msh) or Abaqus (.inp) file; path relative to this file; a text, or nothing.
        group: of a mesh: the set of its elements to be used; default all solids; a text, or nothing.
        scale: of a mesh: factor to metres; default 1; a number > 0, or nothing.
        join: whether nodes at the same position are one, as along the seam of a ring; default `false`; `true` or `false`, or nothing.
        material: the material; the name of an entry of `[materials]`.
        model: law of elasticity: for small strains, or for rubber; default `"st-venant-kirchhoff"`; `"st-venant-kirchhoff"`, `"neo-hookean"`, `"mooney-rivlin"`, or nothing.
        c01: second constant of `model = "mooney-rivlin"`; the first one is E/(4 (1 + nu)) - c01 [Pa]; a number ≥ 0, or nothing.
        damping: damping in proportion to the stiffness; default 0 [s]; a number ≥ 0, or nothing.
        pressure: force per area against the outward normal, which it follows: `{ SET = expression }` of t and of the present place x, y, z [Pa]; a table, or nothing.
        sets: named nodes: `{ near = [x, y, z] }`, `{ center = [x, y, z], radius = r }` or `{ from = [x, y, z], to = [x, y, z] }`; a table, or nothing.
        temperature: above that of the state without stress, over the whole analysis: a number or an expression of x, y and z at rest, in the axes of the part [K]; a number or an expression of `x`, `y` and `z`, or nothing.
    """

    _table: ClassVar[str] = "solids"

    in_: str | None = None
    size: Vector | None = None
    origin: Place | None = None
    volume: Vector | None = None
    divisions: Vector | None = None
    mesh: str | None = None
    group: str | None = None
    scale: Number | None = None
    join: bool | None = None
    material: str
    model: Literal["st-venant-kirchhoff", "neo-hookean", "mooney-rivlin"] | None = None
    c01: Number | None = None
    damping: Number | None = None
    pressure: Table | None = None
    sets: Table | None = None
    temperature: Number | None = None


@dataclass(kw_only=True, slots=True)
class Body(Entry):
    """Rigid bodies.

    Args:
        in_: body, point mass or part in whose initial frame positions and directions are expressed; default: the enclosing part; a text, or nothing.
        mass: mass, or { density } of the solid in `inertia`; 0, also for `inertia`, is a frame between joints [kg]; a number ≥ 0, or `{ density }`.
        inertia: about the centre of mass, in body axes: 3 numbers, 3 x 3, or a solid such as { kind = "box", sides = [a, b, c] } [kg m²]; three numbers, a 3 x 3 matrix, or a solid.
        position: position of the reference frame [m]; a position, or nothing.
        rotation: rotation vector of the reference frame [rad]; three numbers, or nothing.
        axes: instead of `rotation`: first and second body axis; two vectors, or nothing.
        center_of_mass: in body axes, from the reference point [m]; three numbers, or nothing.
        shape: what is drawn of it, about the centre of mass; default: a solid with its inertia; [] draws nothing; a solid, or a list of solids, or nothing.
        mesh: instead of `shape`: an STL or glTF file in metres and body axes; path relative to this file; a text, or nothing.
        velocity: of the reference point at the start, global axes [m/s]; three numbers, or nothing.
        angular_velocity: at the start, body axes [rad/s]; three numbers, or nothing.
    """

    _table: ClassVar[str] = "bodies"

    in_: str | None = None
    mass: Function
    inertia: Vector | list[Vector] | Table
    position: Place | None = None
    rotation: Vector | None = None
    axes: list[Vector] | None = None
    center_of_mass: Vector | None = None
    shape: Table | list[Table] | None = None
    mesh: str | None = None
    velocity: Vector | None = None
    angular_velocity: Vector | None = None


@dataclass(kw_only=True, slots=True)
class PointMass(Entry):
    """Point masses.

    Args:
        in_: body, point mass or part in whose initial frame positions and directions are expressed; default: the enclosing part; a text, or nothing.
        mass: mass [kg]; a number > 0.
        position: position at the start [m]; a position, or nothing.
        plane: restricts the motion to this plane; `"xy"`, `"yz"`, `"zx"`, or nothing.
        shape: solid to be drawn about its position; default: a ball; a solid, or a list of solids, or nothing.
        mesh: instead of `shape`: an STL or glTF file in metres, along the global axes; path relative to this file; a text, or nothing.
        velocity: at the start, global axes [m/s]; three numbers, or nothing.
    """

    _table: ClassVar[str] = "point_masses"

    in_: str | None = None
    mass: Number
    position: Place | None = None
    plane: Literal["xy", "yz", "zx"] | None = None
    shape: Table | list[Table] | None = None
    mesh: str | None = None
    velocity: Vector | None = None


@dataclass(kw_only=True, slots=True)
class Superelement(Entry):
    """Linear elastic parts, specified by reduced matrices.

    Args:
        in_: body, point mass or part in whose initial frame positions and directions are expressed; default: the enclosing part; a text, or nothing.
        interfaces: [{ name = "root" }, { name = "tip", at = [1, 0, 0] }]: nodes for joints, in the order of the matrices; a list of `{ name, at }`.
        matrices: NPZ archive with the arrays `mass` (or `M`), `stiffness` (`K`), `damping` (`D`), `preload` and `geometric`, instead of these keys; a text, or nothing.
        mass: Matrix Market file: six rows per interface, displacement and rotation in the axes of the part, then one per mode; a text, or nothing.
        stiffness: Matrix Market file over the same rows; a text, or nothing.
        damping: Matrix Market file over the same rows; a text, or nothing.
        modal_damping: instead of `damping`: damping ratio of every mode of the free part; a number ≥ 0, or nothing.
        stiffness_damping: instead of `damping`: factor of the stiffness [s]; a number ≥ 0, or nothing.
        recovery: file of a matrix for outputs of kind `recovered`: each row yields a stress or displacement from the unknowns; a text, or nothing.
        preload: Matrix Market file of one column: forces on the undeformed part, which rotate with it; a text, or nothing.
        geometric: Matrix Market file of `lissom reduce`: terms of second order in the deformation, such as geometric stiffness; a text, or nothing.
        floating: interface to which the floating frame is attached; default: the first; a text, or nothing.
        position: position of the origin of the part [m]; a position, or nothing.
        rotation: rotation vector of its axes [rad]; three numbers, or nothing.
        axes: instead of `rotation`: first and second axis; two vectors, or nothing.
    """

    _table: ClassVar[str] = "superelements"

    in_: str | None = None
    interfaces: list[Table]
    matrices: str | None = None
    mass: str | None = None
    stiffness: str | None = None
    damping: str | None = None
    modal_damping: Number | None = None
    stiffness_damping: Number | None = None
    recovery: str | None = None
    preload: str | None = None
    geometric: str | None = None
    floating: str | None = None
    position: Place | None = None
    rotation: Vector | None = None
    axes: list[Vector] | None = None


@dataclass(kw_only=True, slots=True)
class Part(Entry):
    """Sub-assemblies, which may be placed and repeated; their entries are named `part.name`.

    Args:
        include: path of the file with its contents, relative to this file, or `lissom:NAME` for a ready-made part; a text, or nothing.
        like: part of the same table of which it is a copy, at another position and orientation; a text, or nothing.
        count: number of copies `name1`, `name2` …; `index` and `count` are parameters in each; a whole number from 1 to 20000, or nothing.
        in_: body, point mass or part in whose initial frame positions and directions are expressed; default: the enclosing part; a text, or nothing.
        position: position of its origin [m]; a position, or nothing.
        rotation: rotation vector of its axes [rad]; three numbers, or nothing.
        parameters: values of its parameters, instead of the defaults in its file; a table, or nothing.
        names: names in the included file that refer to entries outside, such as { hub = "hub" }; a table, or nothing.
        materials: Isotropic elastic materials; entries as in `[materials]`, or nothing.
        sections: Cross sections; axis 1 along the beam, 2 and 3 perpendicular to it; entries as in `[sections]`, or nothing.
        points: Named positions [m]; entries as in `[points]`, or nothing.
        parts: Sub-assemblies, which may be placed and repeated; their entries are named `part.name`; entries as in `[parts]`, or nothing.
        beams: Flexible beams; entries as in `[beams]`, or nothing.
        shells: Flexible shells and plates: curved surfaces of finite elements; entries as in `[shells]`, or nothing.
        solids: Elastic solids: volumes of finite elements; entries as in `[solids]`, or nothing.
        bodies: Rigid bodies; entries as in `[bodies]`, or nothing.
        point_masses: Point masses; entries as in `[point_masses]`, or nothing.
        superelements: Linear elastic parts, specified by reduced matrices; entries as in `[superelements]`, or nothing.
        joints: Constraints between nodes, or between coordinates of joints; entries as in `[joints]`, or nothing.
        springs: Springs, dampers, friction, stops and latches; entries as in `[springs]`, or nothing.
        loads: Applied forces and moments, and those of actuators; entries as in `[loads]`, or nothing.
        local_loads: Forces and moments that depend on the motion of their own points, along beams and on nodes; entries as in `[local_loads]`, or nothing.
        contacts: Parts that may touch, by their shapes; `kind` may be omitted: it follows from parts and keys; entries as in `[contacts]`, or nothing.
        inputs: Numbers that are set during a simulation by events or by the calling program, with their initial values; entries as in `[inputs]`, or nothing.
        signals: Named expressions of time, inputs, states and outputs; entries as in `[signals]`, or nothing.
        states: First-order states: numbers whose time derivative is an expression; entries as in `[states]`, or nothing.
        events: Actions when expressions cross zero; entries as in `[events]`, or nothing.
        units: Units (FMI) of other programs: advanced from sample to sample, or with equations that are solved with those of the model; entries as in `[units]`, or nothing.
        fluids: Fluids of hydraulic parts; entries as in `[fluids]`, or nothing.
        hydraulics: Hydraulic parts: nodes with a pressure, and components between them such as cylinders, valves and pumps; entries as in `[hydraulics]`, or nothing.
        outputs: Quantities to be recorded; entries as in `[outputs]`, or nothing.
    """

    _table: ClassVar[str] = "parts"

    include: str | None = None
    like: str | None = None
    count: Count | None = None
    in_: str | None = None
    position: Place | None = None
    rotation: Vector | None = None
    parameters: Table | None = None
    names: Table | None = None
    materials: Tables | None = None
    sections: Tables | None = None
    points: Tables | None = None
    parts: Tables | None = None
    beams: Tables | None = None
    shells: Tables | None = None
    solids: Tables | None = None
    bodies: Tables | None = None
    point_masses: Tables | None = None
    superelements: Tables | None = None
    joints: Tables | None = None
    springs: Tables | None = None
    loads: Tables | None = None
    local_loads: Tables | None = None
    contacts: Tables | None = None
    inputs: Tables | None = None
    signals: Tables | None = None
    states: Tables | None = None
    events: Tables | None = None
    units: Tables | None = None
    fluids: Tables | None = None
    hydraulics: Tables | None = None
    outputs: Tables | None = None
