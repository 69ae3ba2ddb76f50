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

/// A sledge on hydraulic parts, and another on the ready-made part, whose states are written by hand; its pressures are relative.
const SLEDGE: &str = r#"
lissom = 1
points = { foot = [0, 0, 0], eye = [0.5, 0, 0] }
signals.command = "0.3*sin(2*pi*t)"
[bodies.sledge]
mass = 200
inertia = [1, 1, 1]
position = [0.5, 0, 0]
[joints.guide]
kind = "prismatic"
base = "ground"
tip = "sledge"
axis = [1, 0, 0]
[loads.process]
kind = "force"
on = "sledge"
vector = [-5000, 0, 0]
[outputs.sledge]
kind = "displacement"
of = "sledge"
[analysis]
kind = "dynamics"
end = 1
relative_tolerance = 1e-10
"#;

const BY_HAND: &str = r#"
[parts.hand]
include = "lissom:hydraulic-cylinder"
names = { base = "ground", tip = "sledge", foot = "foot", eye = "eye", command = "command" }
parameters = { supply = 160e5, leakage = 1e-12, start_a = 3e6 }
"#;

const ELEMENTS: &str = r#"
[fluids.oil]
bulk_modulus = 1.2e9
air = 0
[joints.rod]
kind = "telescopic_rod"
base = "ground"
tip = "sledge"
at_base = "foot"
at_tip = "eye"
[hydraulics.supply]
kind = "pressure"
pressure = "160e5 + 101325"
[hydraulics.tank]
kind = "pressure"
pressure = "2e5 + 101325"
[hydraulics.line_a]
kind = "volume"
volume = 1e-4
start = "3e6 + 101325"
[hydraulics.line_b]
kind = "volume"
volume = 1e-4
start = "2e5 + 101325"
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
[outputs.force]
kind = "signal"
of = "lift.force"
"#;

/// Valve and cylinder are the equations that were written by hand.
#[test]
fn a_cylinder_with_a_valve_is_its_equations() {
    let elements = run_without_warnings(&format!("{SLEDGE}{ELEMENTS}"), &[]);
    let by_hand = run_without_warnings(&format!("{SLEDGE}{BY_HAND}"), &[]);
    close(last(&elements, "sledge", "u1"), last(&by_hand, "sledge", "u1"), 1e-8, "displacement");
    close(last(&elements, "force", "value"), last(&by_hand, "hand.force", "value"), 1e-8, "force");
}

/// Pumps, valves, cylinders and volumes exchange power without loss: everything that flows into parts at their ports is what the
/// nodes give, and the compressed oil and the piston receive what pump and orifices leave.
#[test]
fn volumes_and_energies_balance() {
    // Of the piston: work on the rod and against the atmosphere, friction and leakage.
    let balance = r#"
[signals]
areas = "pi*0.03^2/4"
worked = "(lift.force + 100*rod.velocity + 101325*areas)*rod.velocity + 1e-12*(line_a.pressure - line_b.pressure)^2"
sum = "line_a.power + line_b.power + supply.power + tank.power + valve.power + lift.power"
[states]
lost = { derivative = "valve.power" }
difference = { derivative = "lift.power - worked" }
sum_of_powers = { derivative = "sum" }
swept = { derivative = "-1.2e9*line_a.flow/(1e-4 + lift.volume_a)", magnitude = 1e6 }
[outputs]
lost = { kind = "signal", of = "lost" }
sum = { kind = "signal", of = "sum_of_powers" }
difference = { kind = "signal", of = "difference" }
[outputs.volume]
kind = "expression"
value = "swept + line_a.pressure - 3101325"
"#;
    let (top, rest) = SLEDGE.split_once("signals.command").unwrap();
    let (command, rest) = rest.split_once('\n').unwrap();
    let balance = balance.replace("[signals]", &format!("[signals]\ncommand{command}"));
    let record = run_without_warnings(&format!("{top}{rest}{balance}{ELEMENTS}"), &[]);
    let of = |output: &str| last(&record, output, "value");
    assert!(of("lost") > 1e3, "the valve loses {} J", of("lost"));
    for output in ["sum", "difference"] {
        assert!(of(output).abs() < 1e-12 * of("lost"), "{output}: {} J", of(output));
    }
    assert!(of("volume").abs() < 1.0, "{} Pa", of("volume"));
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

/// Gas compressed by a constant flow: p (V0 - q t)^n = p0 V0^n, V0 - q t that of the gas except for what the line stores.
#[test]
fn an_accumulator_is_polytropic() {
    let parts = r#"
[fluids.oil]
bulk_modulus = 1e9
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
    let (pressure, oil) =
        (value(parts, "line.pressure", "end = 3"), value(parts, "bladder.volume", "end = 3"));
    close(pressure, 5e6 * (1e-3_f64 / (1e-3 - oil)).powf(1.3), 1e-9, "polytropic");
    close(oil + 1e-6 / 1e9 * (pressure - 5e6), 6e-4, 1e-7, "oil in it and in the line");
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

/// A press: forces as areas, F = A (f/a + p₀) - p₀ A, with a junction between the pistons, and their displacements as 1 to A/a.
#[test]
fn a_press_multiplies_forces() {
    let text = r#"
lissom = 1
bodies.small = { mass = 1, inertia = [1, 1, 1] }
bodies.large = { mass = 10, inertia = [1, 1, 1], position = [1, 0, 0] }
joints.small = { kind = "prismatic", base = "ground", tip = "small", axis = [0, 0, 1] }
joints.large = { kind = "prismatic", base = "ground", tip = "large", axis = [0, 0, 1] }
loads.hand = { kind = "force", on = "small", vector = [0, 0, -100] }
springs.work = { kind = "axial", joint = "large", stiffness = 1e5 }
springs.damper = { kind = "axial", joint = "large", damping = 2e4 }
hydraulics.line = { kind = "junction", start = 2e5 }
hydraulics.one = { kind = "cylinder", joint = "small", a = "line", bore = 0.02 }
hydraulics.two = { kind = "cylinder", joint = "large", a = "line", bore = 0.1, leakage = LEAK }
outputs.force = { kind = "signal", of = "two.force" }
outputs.small = { kind = "relative", of = "small" }
outputs.large = { kind = "relative", of = "large" }
analysis = { kind = "dynamics", end = 10, relative_tolerance = 1e-7 }
"#;
    let record = run_without_warnings(&text.replace("LEAK", "1e-13"), &[]);
    // The leak is the pressure's only equation beside the motion.
    let moved = last(&record, "large", "displacement") / last(&record, "small", "displacement");
    close(last(&record, "force", "value"), 2500.0, 1e-3, "force");
    close(moved, -1.0 / 25.0, 1e-2, "displacements");
}

/// Closing a valve at once raises the pressure by ρ c v, and the first quarter wave has the period 4 L/c.
#[test]
fn a_pipe_has_the_pressure_of_joukowsky() {
    let parts = r#"
[fluids.water]
density = 1000
bulk_modulus = 2.1e9
viscosity = 1e-9
air = 0
[hydraulics.tank]
kind = "pressure"
pressure = 20e5
[hydraulics.valve]
kind = "volume"
volume = 1e-12
start = 20e5
[hydraulics.line]
kind = "pipe"
a = "tank"
b = "valve"
length = 20
diameter = 0.02
segments = 20
start = 20e5
start_flow = "0.5*pi*0.02^2/4"
"#;
    let text = model(parts, "valve.pressure", "end = 0.2\n").replace("1e-9\nend", "1e-7\nend");
    let record = run_without_warnings(&text, &[]);
    let (times, pressures) = (&record.times, column(&record, "value", "value"));
    let speed = (2.1e9_f64 / 1000.0).sqrt();
    // Mean over the first half period, in which the pressure is that of a plateau with ripples, by the trapezoidal rule.
    let mean = |from: f64, to: f64| {
        let within = (1..times.len()).filter(|&k| times[k - 1] >= from && times[k] <= to);
        let (sum, length) = within.fold((0.0, 0.0), |(sum, length), k| {
            let step = times[k] - times[k - 1];
            (sum + step * (pressures[k] + pressures[k - 1]) / 2.0, length + step)
        });
        sum / length
    };
    let quarter = 20.0 / speed;
    close(mean(0.2 * quarter, 1.8 * quarter), 20e5 + 1000.0 * speed * 0.5, 0.02, "pressure of Joukowsky");
    close(mean(2.2 * quarter, 3.8 * quarter), 20e5 - 1000.0 * speed * 0.5, 0.04, "reflected wave");
}

/// Laminar flow through a pipe: Hagen and Poiseuille; turbulent: near Blasius.
#[test]
fn a_pipe_has_its_friction() {
    let text = |drop: f64| {
        format!(
            "[hydraulics.in]\nkind = \"pressure\"\npressure = {}\n[hydraulics.out]\nkind = \"pressure\"\npressure = 10e5\n\
             [hydraulics.line]\nkind = \"pipe\"\na = \"in\"\nb = \"out\"\nlength = 5\ndiameter = 0.01\nsegments = 3\nstart = 10e5\n",
            drop + 10e5
        )
    };
    let (area, viscosity, density) = (PI * 1e-4 / 4.0, 46e-6, 860.0);
    let of = |drop: f64| value(&text(drop), "line.flow_a", "end = 5");
    close(of(1e5), PI * 1e-8 * 1e5 / (128.0 * viscosity * density * 5.0), 1e-7, "laminar");
    // Δp = λ l/d ρ v²/2, λ = 0.3164 Re^(-1/4)
    let speed = of(80e5) / area;
    let reynolds = speed * 0.01 / viscosity;
    assert!(reynolds > 4000.0, "Re = {reynolds}");
    close(0.3164 / reynolds.powf(0.25) * 500.0 * density * speed * speed / 2.0, 80e5, 0.03, "turbulent");
}

/// A motor between two pressures accelerates a disc to the speed at which friction takes its torque; a check valve is closed.
#[test]
fn a_motor_turns_a_disc() {
    let text = r#"
lissom = 1
bodies.disc = { mass = 1, inertia = [0.1, 0.1, 0.1] }
joints.shaft = { kind = "revolute", base = "ground", tip = "disc", axis = [0, 0, 1] }
hydraulics.supply = { kind = "pressure", pressure = 100e5 }
hydraulics.tank = { kind = "pressure", pressure = 1e5 }
hydraulics.motor = { kind = "pump", inlet = "supply", outlet = "tank", displacement = 50e-6, joint = "shaft", friction = 1, leakage = 1e-12 }
hydraulics.check = { kind = "check_valve", a = "tank", b = "supply", rated_flow = 1e-3, rated_drop = 1e5 }
hydraulics.other = { kind = "check_valve", a = "supply", b = "tank", rated_flow = 1e-3, rated_drop = 1e5, opening_pressure = 98e5 }
outputs.shaft = { kind = "relative", of = "shaft" }
outputs.flow = { kind = "signal", of = "motor.flow" }
outputs.closed = { kind = "signal", of = "check.flow" }
outputs.open = { kind = "signal", of = "other.flow" }
analysis = { kind = "dynamics", end = 4, relative_tolerance = 1e-9 }
"#;
    let record = run_without_warnings(text, &[]);
    let torque = 50e-6 / TAU * 99e5;
    close(last(&record, "shaft", "rate"), torque, 1e-8, "speed");
    close(last(&record, "flow", "value"), 50e-6 / TAU * torque + 99e-7, 1e-8, "flow");
    assert_eq!(last(&record, "closed", "value"), 0.0);
    let regularised = 1e-3 / 1e5_f64.sqrt() * 1e5 / (2e10_f64).powf(0.25);
    close(last(&record, "open", "value"), regularised, 1e-9, "open");
}

/// Half a percent of air makes the oil soft at low pressure, and no pull makes its pressure negative; without air it is warned of.
#[test]
fn air_keeps_the_pressure_positive() {
    let text = r#"
lissom = 1
fluids.oil = { air = AIR }
bodies.piston = { mass = 1, inertia = [1, 1, 1] }
joints.rod = { kind = "prismatic", base = "ground", tip = "piston", axis = [1, 0, 0] }
joints.stroke = { kind = "prescribed_displacement", joint = "rod", displacement = "0.01*smoothstep(t)" }
hydraulics.chamber = { kind = "volume", volume = 1e-4 }
hydraulics.cylinder = { kind = "cylinder", joint = "rod", a = "chamber", bore = 0.05, stroke = 0.2, extension = 0.1 }
outputs.pressure = { kind = "signal", of = "chamber.pressure" }
analysis = { kind = "dynamics", end = 1, relative_tolerance = 1e-9 }
"#;
    let record = run_without_warnings(&text.replace("AIR", "0.005"), &[]);
    let pressure = last(&record, "pressure", "value");
    // What was in the chamber at first fills it: (V0 + A x)/V0 = (1 - a) e^((p0 - p)/E) + a (p0/p)^(1/n).
    let (first, added) = (1e-4 + PI * 0.0025 / 4.0 * 0.1, PI * 0.0025 / 4.0 * 0.01);
    let liquid = 0.995 * ((ATMOSPHERE - pressure) / 1.5e9).exp();
    close(liquid + 0.005 * (ATMOSPHERE / pressure).powf(1.0 / 1.4), 1.0 + added / first, 1e-9, "volume");
    assert!(pressure > 0.0 && pressure < 3e3, "{pressure}");
    let mut session = crate::support::runs::session(&text.replace("AIR", "0"), &[]);
    crate::support::runs::record(&mut session);
    let warnings: Vec<String> = session.warnings().map(ToString::to_string).collect();
    assert!(
        warnings.iter().any(|own| own.contains("node `chamber`") && own.contains("torn apart")),
        "{warnings:?}"
    );
}

/// Junctions are solved by every scheme, with its order: the pressure between two orifices that fill a volume.
#[test]
fn junctions_have_the_order_of_their_scheme() {
    let parts = r#"
[fluids.oil]
bulk_modulus = 1e9
air = 0
[hydraulics.supply]
kind = "pressure"
pressure = "1e7 + 5e6*sin(20*t)"
[hydraulics.middle]
kind = "junction"
[hydraulics.chamber]
kind = "volume"
volume = 1e-3
start = 1e6
[hydraulics.first]
kind = "orifice"
a = "supply"
b = "middle"
rated_flow = 1e-5
rated_drop = 1e6
transition = 1e6
[hydraulics.second]
kind = "orifice"
a = "middle"
b = "chamber"
rated_flow = 2e-5
rated_drop = 1e6
transition = 1e6
"#;
    let text = model(parts, "middle.pressure", "end = 0.4").replace("relative_tolerance = 1e-9\n", "");
    let wanted = value(parts, "middle.pressure", "end = 0.4");
    for scheme in SCHEMES {
        let error = |step: &str| {
            let set = [("analysis.scheme", scheme), ("analysis.step", step)];
            (last(&run(&text, &set), "value", "value") - wanted).abs() / wanted
        };
        let [coarse, fine] = ["0.02", "0.01"].map(error);
        assert!(fine < 1e-9 || coarse / fine > 3.0, "{scheme}: {coarse:e}, {fine:e}");
        assert!(fine < 1e-3, "{scheme}: {fine:e}");
    }
}

/// A junction that nothing determines is named.
#[test]
fn a_junction_between_closed_valves_is_named() {
    let parts = r#"
[hydraulics.tank]
kind = "pressure"
[hydraulics.middle]
kind = "junction"
[hydraulics.one]
kind = "orifice"
a = "tank"
b = "middle"
area = 1e-5
opening = 0
"#;
    let model = lissom::Model::from_text("model.toml", &model(parts, "middle.pressure", "end = 1"));
    let error = model.session().err().expect("no pressure").to_string();
    assert!(error.contains("middle"), "{error}");
}

/// The cylinders of an excavator that holds carry the moments about its pins.
#[test]
fn an_excavator_holds_by_its_valves() {
    let text = include_str!("../../../../examples/excavator-hydraulics.toml");
    let points = r#"
boom = { kind = "position", of = "boom" }
stick = { kind = "position", of = "stick" }
tip_of_lift = { kind = "position", of = "boom", point = [1.3, 0, 1.5] }
base_of_reach = { kind = "position", of = "boom", point = [1.4, 0, 1.95] }
tip_of_reach = { kind = "position", of = "stick", point = [2.8, 0, 2.5] }
base_of_curl = { kind = "position", of = "stick", point = [3.15, 0, 1.7] }
tip_of_curl = { kind = "position", of = "bucket", point = [3.55, 0, 0.65] }
elbow = { kind = "position", of = "boom", point = [2.9, 0, 2.15] }
wrist = { kind = "position", of = "stick", point = [3.3, 0, 0.55] }
"#;
    let points = points.lines().filter(|line| !line.is_empty()).map(|line| format!("outputs.{line}\n"));
    let (version, rest) = text.split_once("lissom = 1\n").unwrap();
    let text = format!("{version}lissom = 1\n{}{rest}", points.collect::<String>());
    let record = run(&text, &[("analysis.end", "8")]);
    let at = |output: &str| [last(&record, output, "x"), last(&record, output, "z")];
    let foot = [-0.05, 1.25];
    // Pin, parts beyond it with their weights, ends of the cylinder.
    let (boom, stick, bucket) = ((at("boom"), 900.0), (at("stick"), 400.0), (at("bucket"), 1050.0));
    let rows = [
        ("lift", foot, vec![boom, stick, bucket], [0.1, 0.6], at("tip_of_lift")),
        ("reach", at("elbow"), vec![stick, bucket], at("base_of_reach"), at("tip_of_reach")),
        ("curl", at("wrist"), vec![bucket], at("base_of_curl"), at("tip_of_curl")),
    ];
    for (name, pin, parts, base, tip) in rows {
        let moment: f64 = parts.iter().map(|(place, mass)| mass * 9.81 * (place[0] - pin[0])).sum();
        let along = [tip[0] - base[0], tip[1] - base[1]];
        let length = along[0].hypot(along[1]);
        // Lift of the cylinder's force about the pin, against that of the weights.
        let arm = ((tip[0] - pin[0]) * along[1] - (tip[1] - pin[1]) * along[0]) / length;
        close(last(&record, &format!("{name}_force"), "value"), moment / arm, 1e-4, name);
    }
    close(last(&record, "lift", "displacement"), 0.3, 0.05, "length");
}
