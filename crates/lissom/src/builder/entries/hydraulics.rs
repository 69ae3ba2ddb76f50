// Made by `cargo xtask reference` of the program's own tables: do not edit.
//! Fluids, and nodes and components of hydraulic networks.

use crate::builder::entry::{entries, keys};
use crate::builder::expression::Expression;
use crate::ids::{FluidId, HydraulicId, JointId};

entries! {
    /// A fluid of hydraulic parts.
    Fluid => FluidId, "fluid" {
        density: f64 = "density", "Density; default 860 \\[kg/m³\\].";
        bulk_modulus: f64 = "bulk_modulus", "Of the liquid without air; default 1.5e9 \\[Pa\\].";
        viscosity: f64 = "viscosity", "Kinematic viscosity; default 4.6e-5 \\[m²/s\\].";
        air: f64 = "air", "Fraction of the volume that is undissolved air at the pressure of the atmosphere; default 5e-3.";
        exponent: f64 = "exponent", "Polytropic exponent of the air; default 1.4.";
    }

    /// Node with a volume of compressible fluid, such as a line; chambers of cylinders connected to it are added.
    Volume => HydraulicId, kind: "volume" {
        * volume: f64 = "volume", "of the node itself, besides the chambers of cylinders and pipes that end there \\[m³\\]";
        start: f64 = "start", "Absolute pressure at the start; default 101325 \\[Pa\\].";
    }

    /// Node with a prescribed pressure: a tank, or an ideal supply.
    Pressure => HydraulicId, kind: "pressure" {
        pressure: Expression = "pressure", "Absolute pressure, a number or an expression; default: that of the atmosphere \\[Pa\\].";
    }

    /// Node without volume: its pressure follows from the balance of the flows.
    Junction => HydraulicId, kind: "junction" {
        start: f64 = "start", "First guess of the absolute pressure at the start; default 101325 \\[Pa\\].";
    }

    /// Cylinder that acts on the displacement of a joint, such as a telescopic rod between two points; the pressure at `a` extends it.
    Cylinder => HydraulicId, kind: "cylinder" {
        * a: HydraulicId = "a", "node of the chamber at the piston";
        * joint: JointId = "joint", "joint with a displacement";
        * bore: f64 = "bore", "diameter of the piston \\[m\\]";
        b: HydraulicId = "b", "Node of the chamber around the rod; default: open to the atmosphere.";
        rod_diameter: f64 = "rod_diameter", "Diameter of the rod in the chamber `b`; default 0 \\[m\\].";
        stroke: f64 = "stroke", "From stop to stop; without it the cylinder has no stops, and its chambers are no part of the volumes \\[m\\].";
        extension: f64 = "extension", "Of the rod at displacement zero, from 0 to `stroke` \\[m\\].";
        friction: f64 = "friction", "Viscous friction; default 0 \\[N s/m\\].";
        leakage: f64 = "leakage", "Past the piston, from `a` to `b`; default 0 \\[m³/(s Pa)\\].";
        stop_stiffness: f64 = "stop_stiffness", "Of the stops at the ends of the stroke; default 1e8 \\[N/m\\].";
        stop_damping: f64 = "stop_damping", "Of the stops; default 100000 \\[N s/m\\].";
    }

    /// Orifice: turbulent flow with the root of the pressure drop, laminar at small drops; with `opening` a throttle or a 2/2 valve.
    Orifice => HydraulicId, kind: "orifice" {
        * a: HydraulicId = "a", "node on one side";
        * b: HydraulicId = "b", "node on the other side";
        area: f64 = "area", "Of the opening; either it or `rated_flow` is required \\[m²\\].";
        discharge: f64 = "discharge", "Discharge coefficient of the area; default 0.7.";
        rated_flow: f64 = "rated_flow", "Instead of `area`: flow at `rated_drop` \\[m³/s\\].";
        rated_drop: f64 = "rated_drop", "Pressure drop at `rated_flow` \\[Pa\\].";
        opening: Expression = "opening", "Fraction of the area that is open, an expression; 0 if negative; default: fully open.";
        transition: f64 = "transition", "Pressure drop between laminar and turbulent flow; default from `critical_reynolds` \\[Pa\\].";
        critical_reynolds: f64 = "critical_reynolds", "Reynolds number at the transition; default 12.";
    }

    /// Proportional 4/3 valve: a positive command opens `supply` to `a` and `b` to `tank`, a negative one `supply` to `b` and `a` to `tank`.
    Valve => HydraulicId, kind: "valve" {
        * supply: HydraulicId = "supply", "node of the supply";
        * tank: HydraulicId = "tank", "node of the return line";
        * a: HydraulicId = "a", "node of the first consumer port";
        * b: HydraulicId = "b", "node of the second consumer port";
        * command: Expression = "command", "opening from -1 to 1, an expression";
        * rated_flow: f64 = "rated_flow", "flow at `rated_drop`, fully open \\[m³/s\\]";
        * rated_drop: f64 = "rated_drop", "pressure drop of one edge at `rated_flow` \\[Pa\\]";
        overlap: f64 = "overlap", "Command below which all edges are closed; negative: opening of all edges at command 0; default 0.";
    }

    /// Check valve: an orifice for flow from `a` to `b`, closed in the other direction.
    CheckValve => HydraulicId, kind: "check_valve" {
        * a: HydraulicId = "a", "node from which it flows";
        * b: HydraulicId = "b", "node into which it flows";
        * rated_flow: f64 = "rated_flow", "flow at `rated_drop`, fully open \\[m³/s\\]";
        * rated_drop: f64 = "rated_drop", "pressure drop at `rated_flow`, above the opening one \\[Pa\\]";
        opening_pressure: f64 = "opening_pressure", "Drop at which it opens; default 0 \\[Pa\\].";
    }

    /// Relief valve: opens at a pressure difference from `a` to `b`, and its flow is proportional to what is above.
    ReliefValve => HydraulicId, kind: "relief_valve" {
        * a: HydraulicId = "a", "node whose pressure it limits";
        * b: HydraulicId = "b", "node into which it flows, such as the tank";
        * opening_pressure: f64 = "opening_pressure", "difference at which it opens \\[Pa\\]";
        * rated_flow: f64 = "rated_flow", "flow at the difference `opening_pressure + pressure_rise` \\[m³/s\\]";
        * pressure_rise: f64 = "pressure_rise", "rise of the difference from opening to `rated_flow` \\[Pa\\]";
    }

    /// Pump or motor: moves its displacement from `inlet` to `outlet` per revolution of a prescribed speed or of a joint.
    Pump => HydraulicId, kind: "pump" {
        * inlet: HydraulicId = "inlet", "node from which it pumps";
        * outlet: HydraulicId = "outlet", "node into which it pumps";
        * displacement: Expression = "displacement", "volume per revolution, a number or an expression \\[m³\\]";
        speed: Expression = "speed", "A number or an expression; either it or `joint` is required \\[rad/s\\].";
        joint: JointId = "joint", "Joint with the rotation of the shaft, on which its torque acts.";
        leakage: f64 = "leakage", "From `outlet` to `inlet`; default 0 \\[m³/(s Pa)\\].";
        friction: f64 = "friction", "Viscous friction on the joint; default 0 \\[N m s/rad\\].";
    }

    /// Accumulator on a volume: its gas is compressed by a polytropic law above the precharge pressure, and below it contains no fluid.
    Accumulator => HydraulicId, kind: "accumulator" {
        * a: HydraulicId = "a", "node of kind `volume`";
        * gas_volume: f64 = "gas_volume", "of the gas at the precharge pressure: that of the accumulator \\[m³\\]";
        * precharge: f64 = "precharge", "absolute pressure of the gas without fluid \\[Pa\\]";
        exponent: f64 = "exponent", "Polytropic exponent of the gas: 1 for slow changes; default 1.4.";
    }

    /// Pipe with inertia, compressibility and friction of the fluid, in segments: waves up to about a fifth of the frequency `wave speed/(segment length)` are resolved.
    Pipe => HydraulicId, kind: "pipe" {
        * a: HydraulicId = "a", "node at one end";
        * b: HydraulicId = "b", "node at the other end";
        * length: f64 = "length", "length \\[m\\]";
        * diameter: f64 = "diameter", "inner diameter \\[m\\]";
        roughness: f64 = "roughness", "Of the wall; default 0 \\[m\\].";
        segments: usize = "segments", "Number of segments; default 5.";
        start: f64 = "start", "Absolute pressure in it at the start; default 101325 \\[Pa\\].";
        start_flow: f64 = "start_flow", "Flow in it at the start, from `a` to `b`; default 0 \\[m³/s\\].";
    }
}

keys! {
    [Volume, Pressure, Junction]
        fluid: FluidId = "fluid", "Name of its fluid; may be omitted if there is one or none, which is then a mineral oil HLP 46.";
}

keys! {
    [Valve, CheckValve]
        transition: f64 = "transition", "Pressure drop between laminar and turbulent flow; default 100000 \\[Pa\\].";
}
