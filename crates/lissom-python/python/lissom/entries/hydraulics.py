# Made by `cargo xtask reference` of the program's own tables: do not edit.
"""Fluids, and nodes and components of hydraulic networks."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

from ._entry import Count, Entry, Number


@dataclass(kw_only=True, slots=True)
class Fluid(Entry):
    """Fluids of hydraulic parts.

    Args:
        density: density; default 860 [kg/m³]; a number > 0, or nothing.
        bulk_modulus: of the liquid without air; default 1.5e9 [Pa]; a number > 0, or nothing.
        viscosity: kinematic viscosity; default 4.6e-5 [m²/s]; a number > 0, or nothing.
        air: fraction of the volume that is undissolved air at the pressure of the atmosphere; default 5e-3; a number from 0 to 0.5, or nothing.
        exponent: polytropic exponent of the air; default 1.4; a number from 1 to 2, or nothing.
    """

    _table: ClassVar[str] = "fluids"

    density: Number | None = None
    bulk_modulus: Number | None = None
    viscosity: Number | None = None
    air: Number | None = None
    exponent: Number | None = None


class HydraulicPart(Entry):
    """Hydraulic parts: nodes with a pressure, and components between them such as cylinders, valves and pumps."""

    __slots__ = ()
    _table: ClassVar[str] = "hydraulics"
    _tag: ClassVar[str] = "kind"


@dataclass(kw_only=True, slots=True)
class Volume(HydraulicPart):
    """Node with a volume of compressible fluid, such as a line; chambers of cylinders connected to it are added.

    Args:
        fluid: name of its fluid; may be omitted if there is one or none, which is then a mineral oil HLP 46; the name of an entry of `[fluids]`, or nothing.
        volume: of the node itself, besides the chambers of cylinders and pipes that end there [m³]; a number > 0.
        start: absolute pressure at the start; default 101325 [Pa]; a number > 0, or nothing.
    """

    _form: ClassVar[str] = "volume"

    fluid: str | None = None
    volume: Number
    start: Number | None = None


@dataclass(kw_only=True, slots=True)
class Pressure(HydraulicPart):
    """Node with a prescribed pressure: a tank, or an ideal supply.

    Args:
        fluid: name of its fluid; may be omitted if there is one or none, which is then a mineral oil HLP 46; the name of an entry of `[fluids]`, or nothing.
        pressure: absolute pressure, a number or an expression; default: that of the atmosphere [Pa]; an expression of signals, or nothing.
    """

    _form: ClassVar[str] = "pressure"

    fluid: str | None = None
    pressure: Number | None = None


@dataclass(kw_only=True, slots=True)
class Junction(HydraulicPart):
    """Node without volume: its pressure follows from the balance of the flows.

    Args:
        fluid: name of its fluid; may be omitted if there is one or none, which is then a mineral oil HLP 46; the name of an entry of `[fluids]`, or nothing.
        start: first guess of the absolute pressure at the start; default 101325 [Pa]; a number > 0, or nothing.
    """

    _form: ClassVar[str] = "junction"

    fluid: str | None = None
    start: Number | None = None


@dataclass(kw_only=True, slots=True)
class Cylinder(HydraulicPart):
    """Cylinder that acts on the displacement of a joint, such as a telescopic rod between two points; the pressure at `a` extends it.

    Args:
        a: node of the chamber at the piston; the name of an entry of `[hydraulics]`.
        b: node of the chamber around the rod; default: open to the atmosphere; the name of an entry of `[hydraulics]`, or nothing.
        joint: joint with a displacement; the name of an entry of `[joints]`.
        bore: diameter of the piston [m]; a number > 0.
        rod_diameter: diameter of the rod in the chamber `b`; default 0 [m]; a number ≥ 0, or nothing.
        stroke: from stop to stop; without it the cylinder has no stops, and its chambers are no part of the volumes [m]; a number > 0, or nothing.
        extension: of the rod at displacement zero, from 0 to `stroke` [m]; a number ≥ 0, or nothing.
        friction: viscous friction; default 0 [N s/m]; a number ≥ 0, or nothing.
        leakage: past the piston, from `a` to `b`; default 0 [m³/(s Pa)]; a number ≥ 0, or nothing.
        stop_stiffness: of the stops at the ends of the stroke; default 1e8 [N/m]; a number > 0, or nothing.
        stop_damping: of the stops; default 100000 [N s/m]; a number ≥ 0, or nothing.
    """

    _form: ClassVar[str] = "cylinder"

    a: str
    b: str | None = None
    joint: str
    bore: Number
    rod_diameter: Number | None = None
    stroke: Number | None = None
    extension: Number | None = None
    friction: Number | None = None
    leakage: Number | None = None
    stop_stiffness: Number | None = None
    stop_damping: Number | None = None


@dataclass(kw_only=True, slots=True)
class Orifice(HydraulicPart):
    """Orifice: turbulent flow with the root of the pressure drop, laminar at small drops; with `opening` a throttle or a 2/2 valve.

    Args:
        a: node on one side; the name of an entry of `[hydraulics]`.
        b: node on the other side; the name of an entry of `[hydraulics]`.
        area: of the opening; either it or `rated_flow` is required [m²]; a number > 0, or nothing.
        discharge: discharge coefficient of the area; default 0.7; a number from 0.01 to 1, or nothing.
        rated_flow: instead of `area`: flow at `rated_drop` [m³/s]; a number > 0, or nothing.
        rated_drop: pressure drop at `rated_flow` [Pa]; a number > 0, or nothing.
        opening: fraction of the area that is open, an expression; 0 if negative; default: fully open; an expression of signals, or nothing.
        transition: pressure drop between laminar and turbulent flow; default from `critical_reynolds` [Pa]; a number > 0, or nothing.
        critical_reynolds: Reynolds number at the transition; default 12; a number > 0, or nothing.
    """

    _form: ClassVar[str] = "orifice"

    a: str
    b: str
    area: Number | None = None
    discharge: Number | None = None
    rated_flow: Number | None = None
    rated_drop: Number | None = None
    opening: Number | None = None
    transition: Number | None = None
    critical_reynolds: Number | None = None


@dataclass(kw_only=True, slots=True)
class Valve(HydraulicPart):
    """Proportional 4/3 valve: a positive command opens `supply` to `a` and `b` to `tank`, a negative one `supply` to `b` and `a` to `tank`.

    Args:
        supply: node of the supply; the name of an entry of `[hydraulics]`.
        tank: node of the return line; the name of an entry of `[hydraulics]`.
        a: node of the first consumer port; the name of an entry of `[hydraulics]`.
        b: node of the second consumer port; the name of an entry of `[hydraulics]`.
        command: opening from -1 to 1, an expression; an expression of signals.
        rated_flow: flow at `rated_drop`, fully open [m³/s]; a number > 0.
        rated_drop: pressure drop of one edge at `rated_flow` [Pa]; a number > 0.
        transition: pressure drop between laminar and turbulent flow; default 100000 [Pa]; a number > 0, or nothing.
        overlap: command below which all edges are closed; negative: opening of all edges at command 0; default 0; a number from -0.9 to 0.9, or nothing.
    """

    _form: ClassVar[str] = "valve"

    supply: str
    tank: str
    a: str
    b: str
    command: Number
    rated_flow: Number
    rated_drop: Number
    transition: Number | None = None
    overlap: Number | None = None


@dataclass(kw_only=True, slots=True)
class CheckValve(HydraulicPart):
    """Check valve: an orifice for flow from `a` to `b`, closed in the other direction.

    Args:
        a: node from which it flows; the name of an entry of `[hydraulics]`.
        b: node into which it flows; the name of an entry of `[hydraulics]`.
        rated_flow: flow at `rated_drop`, fully open [m³/s]; a number > 0.
        rated_drop: pressure drop at `rated_flow`, above the opening one [Pa]; a number > 0.
        transition: pressure drop between laminar and turbulent flow; default 100000 [Pa]; a number > 0, or nothing.
        opening_pressure: drop at which it opens; default 0 [Pa]; a number ≥ 0, or nothing.
    """

    _form: ClassVar[str] = "check_valve"

    a: str
    b: str
    rated_flow: Number
    rated_drop: Number
    transition: Number | None = None
    opening_pressure: Number | None = None


@dataclass(kw_only=True, slots=True)
class ReliefValve(HydraulicPart):
    """Relief valve: opens at a pressure difference from `a` to `b`, and its flow is proportional to what is above.

    Args:
        a: node whose pressure it limits; the name of an entry of `[hydraulics]`.
        b: node into which it flows, such as the tank; the name of an entry of `[hydraulics]`.
        opening_pressure: difference at which it opens [Pa]; a number > 0.
        rated_flow: flow at the difference `opening_pressure + pressure_rise` [m³/s]; a number > 0.
        pressure_rise: rise of the difference from opening to `rated_flow` [Pa]; a number > 0.
    """

    _form: ClassVar[str] = "relief_valve"

    a: str
    b: str
    opening_pressure: Number
    rated_flow: Number
    pressure_rise: Number


@dataclass(kw_only=True, slots=True)
class Pump(HydraulicPart):
    """Pump or motor: moves its displacement from `inlet` to `outlet` per revolution of a prescribed speed or of a joint.

    Args:
        inlet: node from which it pumps; the name of an entry of `[hydraulics]`.
        outlet: node into which it pumps; the name of an entry of `[hydraulics]`.
        displacement: volume per revolution, a number or an expression [m³]; an expression of signals.
        speed: a number or an expression; either it or `joint` is required [rad/s]; an expression of signals, or nothing.
        joint: joint with the rotation of the shaft, on which its torque acts; the name of an entry of `[joints]`, or nothing.
        leakage: from `outlet` to `inlet`; default 0 [m³/(s Pa)]; a number ≥ 0, or nothing.
        friction: viscous friction on the joint; default 0 [N m s/rad]; a number ≥ 0, or nothing.
    """

    _form: ClassVar[str] = "pump"

    inlet: str
    outlet: str
    displacement: Number
    speed: Number | None = None
    joint: str | None = None
    leakage: Number | None = None
    friction: Number | None = None


@dataclass(kw_only=True, slots=True)
class Accumulator(HydraulicPart):
    """Accumulator on a volume: its gas is compressed by a polytropic law above the precharge pressure, and below it contains no fluid.

    Args:
        a: node of kind `volume`; the name of an entry of `[hydraulics]`.
        gas_volume: of the gas at the precharge pressure: that of the accumulator [m³]; a number > 0.
        precharge: absolute pressure of the gas without fluid [Pa]; a number > 0.
        exponent: polytropic exponent of the gas: 1 for slow changes; default 1.4; a number from 1 to 2, or nothing.
    """

    _form: ClassVar[str] = "accumulator"

    a: str
    gas_volume: Number
    precharge: Number
    exponent: Number | None = None


@dataclass(kw_only=True, slots=True)
class Pipe(HydraulicPart):
    """Pipe with inertia, compressibility and friction of the fluid, in segments: waves up to about a fifth of the frequency `wave speed/(segment length)` are resolved.

    Args:
        a: node at one end; the name of an entry of `[hydraulics]`.
        b: node at the other end; the name of an entry of `[hydraulics]`.
        length: length [m]; a number > 0.
        diameter: inner diameter [m]; a number > 0.
        roughness: of the wall; default 0 [m]; a number ≥ 0, or nothing.
        segments: number of segments; default 5; a whole number from 1 to 50, or nothing.
        start: absolute pressure in it at the start; default 101325 [Pa]; a number > 0, or nothing.
        start_flow: flow in it at the start, from `a` to `b`; default 0 [m³/s]; a number, or nothing.
    """

    _form: ClassVar[str] = "pipe"

    a: str
    b: str
    length: Number
    diameter: Number
    roughness: Number | None = None
    segments: Count | None = None
    start: Number | None = None
    start_flow: Number | None = None
