//! Hydraulic parts against closed forms, against the same equations written as states, and the balances of volume and energy.

use std::f64::consts::{PI, TAU};

use crate::support::runs::{SCHEMES, column, last, run, run_without_warnings};

const ATMOSPHERE: f64 = 101_325.0;

fn close(found: f64, wanted: f64, relative: f64, what: &str) {
    assert!((found - wanted).abs() <= relative * wanted.abs(), "{what}: {found}, not {wanted}");
}

/// A model of hydraulic parts and a mass that rests, with a value.
fn model(parts: &str, value: &str, analysis: &str) -> String {
    format!(
        "lissom = 1\n{parts}\n[bodies.rest]\nmass = 1\ninertia = [1, 1, 1]\n[joints.rest]\nkind = \"clamp\"\nbase = \
         \"ground\"\ntip = \"rest\"\n[outputs.value]\nkind = \"expression\"\nvalue = \"{value}\"\n[analysis]\nkind = \
         \"dynamics\"\nrelative_tolerance = 1e-9\n{analysis}\n"
    )
}

fn value(parts: &str, of: &str, analysis: &str) -> f64 {
    last(&run_without_warnings(&model(parts, of, analysis), &[]), "value", "value")
}

const SLEDGE: &str = r#"
lissom = 1
parameters = { pressure = 0, volume = 1e-4 }
bodies.sledge = { mass = 200, inertia = [1, 1, 1] }
loads.process = { kind = "force", on = "sledge", vector = ["-5000", 0, 0] }
outputs.rod = { kind = "relative", of = "rod" }
outputs.force = { kind = "signal", of = "FORCE" }
analysis = { kind = "dynamics", end = 1, relative_tolerance = 1e-9 }
signals.command = "0.5*sin(2*pi*t)"
[joints.rod]
kind = "prismatic"
base = "ground"
tip = "sledge"
axis = [1, 0, 0]
"#;

const ELEMENTS: &str = r#"
[fluids.oil]
bulk_modulus = 1.2e9
air = 0
[hydraulics.supply]
kind = "pressure"
pressure = 160e5
[hydraulics.tank]
kind = "pressure"
pressure = 2e5
[hydraulics.line_a]
kind = "volume"
volume = "volume"
start = 2e5
[hydraulics.line_b]
kind = "volume"
volume = "volume"
start = 2e5
[hydraulics.valve]
kind = "valve"
supply = "supply"
tank = "tank"
a = "line_a"
b = "line_b"
command = "command"
rated_flow = 5e-4
rated_drop = 35e5
[hydraulics.lift]
kind = "cylinder"
joint = "rod"
a = "line_a"
b = "line_b"
bore = 0.05
rod_diameter = 0.03
stroke = 0.4
extension = 0.2
friction = 100
leakage = 1e-12
stop_stiffness = 2e8
stop_damping = 2e5
"#;

/// The equations of the ready-made part before hydraulic parts existed; pressures are absolute.
const BY_HAND: &str = r#"
[signals]
area_a = "pi*0.05^2/4"
area_b = "pi*(0.05^2 - 0.03^2)/4"
volume_a = "volume + area_a*(0.2 + rod.displacement)"
volume_b = "volume + area_b*(0.2 - rod.displacement)"
opening = "5e-4/sqrt(35e5)*clamp(command, -1, 1)"
drop_a = "if(command > 0, 160e5, 2e5) - pressure_a"
drop_b = "if(command > 0, 2e5, 160e5) - pressure_b"
flow_a = "abs(opening)*drop_a/(drop_a^2 + 1e5^2)^0.25"
flow_b = "abs(opening)*drop_b/(drop_b^2 + 1e5^2)^0.25"
leak = "1e-12*(pressure_a - pressure_b)"
force = "(pressure_a - 101325)*area_a - (pressure_b - 101325)*area_b - 100*rod.velocity"
[states.pressure_a]
derivative = "1.2e9/volume_a*(flow_a - leak - area_a*rod.velocity)"
start = 2e5
magnitude = 1e5
[states.pressure_b]
derivative = "1.2e9/volume_b*(flow_b + leak + area_b*rod.velocity)"
start = 2e5
magnitude = 1e5
[loads.oil]
kind = "joint_force"
joint = "rod"
force = "force"
[springs.end]
kind = "axial_stop"
joint = "rod"
range = [-0.2, 0.2]
stiffness = 2e8
damping = 2e5
"#;

/// Valve and cylinder are the equations that were written by hand.
#[test]
fn a_cylinder_with_a_valve_is_its_equations() {
    let elements = run_without_warnings(&(SLEDGE.replace("FORCE", "lift.force") + ELEMENTS), &[]);
    let by_hand = run_without_warnings(&(SLEDGE.replace("FORCE", "force") + BY_HAND), &[]);
    for (output, component) in [("rod", "displacement"), ("rod", "velocity"), ("force", "value")] {
        let [one, other] = [&elements, &by_hand].map(|record| last(record, output, component));
        close(one, other, 1e-8, output);
    }
}

/// Pumps, valves, cylinders and volumes exchange power without loss: everything that flows into parts at their ports is what the
/// nodes give, and the compressed oil and the piston receive what pump and orifices leave.
#[test]
fn volumes_and_energies_balance() {
    let balance = r#"
states.volume_a = { derivative = "line_a.flow", magnitude = 1e-6 }
states.stored_a = { derivative = "line_a.power" }
states.stored_b = { derivative = "line_b.power" }
states.supplied = { derivative = "supply.power + tank.power" }
states.lost = { derivative = "valve.power" }
states.received = { derivative = "lift.power" }
states.worked = { derivative = "(lift.force + 100*rod.velocity)*rod.velocity + 1e-12*(line_a.pressure - line_b.pressure)^2 + 101325*(lift.area_a - lift.area_b)*rod.velocity" }
outputs.sum = { kind = "expression", value = "stored_a + stored_b + supplied + lost + received" }
outputs.lost = { kind = "signal", of = "lost" }
outputs.received = { kind = "signal", of = "received" }
outputs.worked = { kind = "signal", of = "worked" }
outputs.compressed = { kind = "expression", value = "ln(line_a.pressure/2e5)" }
outputs.volume = { kind = "signal", of = "volume_a" }
"#;
    let areas = "signals.area_a = \"pi*0.05^2/4\"\nsignals.area_b = \"pi*(0.05^2 - 0.03^2)/4\"\n";
    let head = SLEDGE.replace("FORCE", "lift.force");
    let (top, joints) = head.split_once("[joints.rod]").unwrap();
    let balance = balance.replace("lift.area", "area");
    let text = format!("{top}{areas}{balance}[joints.rod]{joints}{ELEMENTS}");
    let record = run_without_warnings(&text, &[]);
    let of = |output: &str| last(&record, output, "value");
    assert!(of("lost") > 1e3, "the valve loses {} J", of("lost"));
    assert!(of("sum").abs() < 1e-7 * of("lost"), "{} J appear", of("sum"));
    close(of("received"), of("worked"), 1e-7, "work of the piston");
}

/// Oil flows through an orifice into a volume: t = ∫ V dp/(K Q), with Q = k d/(d² + w²)^¼.
#[test]
fn an_orifice_fills_a_volume() {
    let parts = r#"
[fluids.oil]
bulk_modulus = 1e9
air = 0
[hydraulics.supply]
kind = "pressure"
pressure = 1e7
[hydraulics.chamber]
kind = "volume"
volume = 1e-3
start = 1e5
[hydraulics.throttle]
kind = "orifice"
a = "supply"
b = "chamber"
rated_flow = 1e-4
rated_drop = 1e6
transition = TRANSITION
"#;
    // Turbulent: √d falls linearly in time, d = (√d0 - K k t/(2 V))².
    let turbulent = value(&parts.replace("TRANSITION", "1e-2"), "chamber.pressure", "end = 0.04");
    let root = 9.9e6_f64.sqrt() - 1e9 * 1e-7 * 0.04 / 2e-3;
    close(turbulent, 1e7 - root * root, 1e-8, "turbulent");
    // Laminar: d = d0 e^(-t K k/(V √w)).
    let laminar = value(&parts.replace("TRANSITION", "1e12"), "chamber.pressure", "end = 4");
    let left = 9.9e6 * f64::exp(-4.0 * 1e9 * 1e-7 / (1e-3 * 1e6));
    close(laminar, 1e7 - left, 1e-8, "laminar");
    // By area: Q = α A √(2 Δp/ρ), far above the transition.
    let area = "[hydraulics.supply]\nkind = \"pressure\"\npressure = 1e7\n[hydraulics.tank]\nkind = \"pressure\"\n\
                [hydraulics.hole]\nkind = \"orifice\"\na = \"supply\"\nb = \"tank\"\narea = 1e-5\n";
    let drop = 1e7 - ATMOSPHERE;
    close(value(area, "hole.flow", "end = 0.1"), 0.7e-5 * (2.0 * drop / 860.0).sqrt(), 1e-6, "area");
}

/// Gas compressed by a constant flow: p (V0 - q t)^n = p0 V0^n, with hardly compressible oil beside it.
#[test]
fn an_accumulator_is_polytropic() {
    let parts = r#"
[fluids.oil]
bulk_modulus = 1e18
air = 0
[hydraulics.tank]
kind = "pressure"
[hydraulics.line]
kind = "volume"
volume = 1e-6
start = 5e6
[hydraulics.pump]
kind = "pump"
inlet = "tank"
outlet = "line"
displacement = "2*pi*1e-5"
speed = 20
[hydraulics.bladder]
kind = "accumulator"
a = "line"
gas_volume = 1e-3
precharge = 5e6
exponent = 1.3
"#;
    let pressure = value(parts, "line.pressure", "end = 3");
    close(pressure, 5e6 * (1e-3_f64 / (1e-3 - 2e-4 * 3.0)).powf(1.3), 1e-7, "polytropic");
    close(value(parts, "bladder.volume", "end = 3"), 6e-4, 1e-7, "oil in it");
}

/// A relief valve carries what the pump delivers: p = p_T + p_open + Δp (q - leak)/q_rated; air and junction change nothing.
#[test]
fn a_pump_with_a_relief_valve_has_its_pressure() {
    let parts = r#"
[hydraulics.tank]
kind = "pressure"
[hydraulics.line]
NODE
[hydraulics.pump]
kind = "pump"
inlet = "tank"
outlet = "line"
displacement = 20e-6
speed = "2*pi*25"
leakage = 1e-12
[hydraulics.relief]
kind = "relief_valve"
a = "line"
b = "tank"
opening_pressure = 150e5
rated_flow = 1e-3
pressure_rise = 10e5
"#;
    // q - l d = q_r (d - d_o)/Δ
    let (flow, leak, slope) = (20e-6 * 25.0, 1e-12, 1e-3 / 10e5);
    let wanted = ATMOSPHERE + (flow + slope * 150e5) / (slope + leak);
    for node in ["kind = \"volume\"\nvolume = 1e-4", "kind = \"junction\""] {
        close(value(&parts.replace("NODE", node), "line.pressure", "end = 0.5"), wanted, 1e-9, node);
    }
}
