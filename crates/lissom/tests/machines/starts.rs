//! Velocities at the start: those that are not given follow those that are.

use crate::support::runs::{column, last, run, run_without_warnings, session};

/// A crank, a rod and a piston without forces.
const ENGINE: &str = r#"
lissom = 1
[bodies.crank]
mass = 1
inertia = [0.1, 0.1, 0.1]
position = [0.05, 0, 0]
[bodies.rod]
mass = 1
inertia = [0.1, 0.1, 0.1]
position = [0.25, 0, 0]
[bodies.piston]
mass = 1
inertia = [0.1, 0.1, 0.1]
position = [0.4, 0, 0]
[joints.shaft]
kind = "revolute"
base = "ground"
tip = "crank"
at = [0, 0, 0]
axis = "z"
[joints.pin]
kind = "revolute"
base = "crank"
tip = "rod"
at = [0.1, 0, 0]
axis = "z"
[joints.wrist]
kind = "revolute"
base = "rod"
tip = "piston"
at = [0.4, 0, 0]
axis = "z"
[joints.bore]
kind = "prismatic"
base = "ground"
tip = "piston"
axis = "x"
[outputs.shaft]
kind = "relative"
of = "shaft"
[outputs.rod]
kind = "angular_velocity"
of = "rod"
[analysis]
kind = "dynamics"
end = 0.1
"#;

/// The crank at 20 rad/s turns the rod by -20·0.1/0.3 rad/s, whichever way its speed is given.
#[test]
fn a_free_engine_starts_with_the_speed_of_its_crank() {
    let of_joint =
        ENGINE.replace("axis = \"z\"\n[joints.pin]", "axis = \"z\"\nangle = 0.7\nrate = 20\n[joints.pin]");
    let of_body = ENGINE.replace(
        "position = [0.05, 0, 0]",
        "position = [0.05, 0, 0]\nvelocity = [0, 1, 0]\nangular_velocity = [0, 0, 20]",
    );
    for text in [of_joint, of_body] {
        let record = run_without_warnings(&text, &[]);
        let rate = column(&record, "shaft", "rate")[0];
        assert!((rate - 20.0).abs() < 1e-9, "{rate}");
        let rod = column(&record, "rod", "w3")[0];
        assert!((rod + 20.0 * 0.1 / 0.3).abs() < 1e-9, "{rod}");
    }
}

/// Velocities that exclude each other are still changed as little as possible, with a warning.
#[test]
fn velocities_that_exclude_each_other_are_corrected() {
    let both = ENGINE
        .replace("axis = \"z\"\n[joints.pin]", "axis = \"z\"\nrate = 20\n[joints.pin]")
        .replace("position = [0.25, 0, 0]", "position = [0.25, 0, 0]\nangular_velocity = [0, 0, 3]");
    let session = session(&both, &[]);
    let warnings: Vec<String> = session.warnings().map(ToString::to_string).collect();
    assert!(!warnings.is_empty());
}

/// A load that hangs in a latch is in equilibrium, and falls when it is released.
#[test]
fn a_load_in_a_latch_starts_from_equilibrium() {
    let text = r#"
lissom = 1
gravity = [0, 0, -9.81]
[inputs]
hold = 1
[bodies.carriage]
mass = 3
inertia = [1, 1, 1]
[bodies.load]
mass = 2
inertia = [1, 1, 1]
position = [0, 0, -1]
[joints.rail]
kind = "prismatic"
base = "ground"
tip = "carriage"
axis = "z"
[springs.hook]
kind = "axial_latch"
joint = "rail"
engaged = "hold"
[springs.rope]
kind = "bushing"
base = "carriage"
tip = "load"
at_base = [0, 0, -1]
stiffness = [4e3, 4e3, 4e3, 1e3, 1e3, 1e3]
[outputs.carriage]
kind = "position"
of = "carriage"
[outputs.load]
kind = "position"
of = "load"
[outputs.hook]
kind = "spring"
of = "hook"
[events.drop]
zero_of = "t - 0.2"
set = { hold = 0 }
[initial]
equilibrium = true
[analysis]
kind = "dynamics"
end = 0.5
"#;
    let record = run(text, &[]);
    let sag = -1.0 - 2.0 * 9.81 / 4e3;
    for (k, time) in record.times.iter().enumerate().filter(|(_, time)| **time < 0.2) {
        let (carriage, load) = (column(&record, "carriage", "z")[k], column(&record, "load", "z")[k]);
        assert!(carriage.abs() < 1e-12 && (load - sag).abs() < 1e-9, "t = {time}: {carriage} {load}");
        let force = column(&record, "hook", "force")[k];
        assert!((force.abs() - 5.0 * 9.81).abs() < 1e-6, "t = {time}: {force}");
    }
    let mean = (3.0 * last(&record, "carriage", "z") + 2.0 * last(&record, "load", "z")) / 5.0;
    let fallen = 0.4 * sag - 0.5 * 9.81 * 0.09;
    assert!((mean - fallen).abs() < 1e-6, "{mean} for {fallen}");
    // Load steps keep the latch too.
    let statics = text
        .replace("kind = \"dynamics\"\nend = 0.5", "kind = \"statics\"")
        .replace("[initial]\nequilibrium = true\n", "")
        .replace("[events.drop]\nzero_of = \"t - 0.2\"\nset = { hold = 0 }\n", "");
    let record = run(&statics, &[]);
    assert!((last(&record, "load", "z") - sag).abs() < 1e-9);
}

/// A body, and a hinge that carries it.
fn link(name: &str, base: &str, [at, position]: [[f64; 2]; 2], more: &str) -> String {
    let [[x, y], [u, v]] = [at, position];
    format!(
        "[bodies.{name}]\nmass = 1\ninertia = [0.1, 0.1, 0.1]\nposition = [{u}, {v}, 0]\n\
         [joints.to_{name}]\nkind = \"revolute\"\nbase = \"{base}\"\ntip = \"{name}\"\nat = [{x}, {y}, 0]\naxis = \"z\"\n{more}\n\
         [outputs.to_{name}]\nkind = \"relative\"\nof = \"to_{name}\"\n"
    )
}

const END: &str = "[analysis]\nkind = \"dynamics\"\nend = 0.01\n";

fn rates_at_start<const N: usize>(text: &str, names: [&str; N]) -> [f64; N] {
    let record = run_without_warnings(text, &[]);
    names.map(|name| column(&record, name, "rate")[0])
}

fn assert_near<const N: usize>(found: [f64; N], wanted: [f64; N]) {
    let error = found.iter().zip(wanted).fold(0.0_f64, |most, (a, b)| most.max((a - b).abs()));
    assert!(error < 1e-8, "{found:?} instead of {wanted:?}");
}

#[test]
fn joints_of_an_open_tree_without_a_rate_start_at_rest() {
    let names = ["to_a", "to_b", "to_c"];
    let chain = |rates: [&str; 3]| {
        let of = |own: usize| [[own as f64, 0.0], [own as f64 + 0.5, 0.0]];
        let links = [
            link("a", "ground", of(0), rates[0]),
            link("b", "a", of(1), rates[1]),
            link("c", "b", of(2), rates[2]),
        ];
        format!("lissom = 1\n{}{END}", links.concat())
    };
    assert_near(rates_at_start(&chain(["", "rate = 3", ""]), names), [0.0, 3.0, 0.0]);
    assert_near(rates_at_start(&chain(["rate = 2", "rate = 3", ""]), names), [2.0, 3.0, 0.0]);
    assert_near(rates_at_start(&chain(["", "", "rate = -1"]), names), [0.0, 0.0, -1.0]);
    // The velocity of the last link determines how the others move: it is kept, and none of them is at rest.
    let pushed = chain(["", "", ""]).replace(
        "position = [2.5, 0, 0]",
        "position = [2.5, 0, 0]\nvelocity = [0, 1, 0]\nangular_velocity = [0, 0, 0]",
    );
    let [a, b, c] = rates_at_start(&pushed, names);
    assert!((a + b + c).abs() < 1e-8 && (2.0 * a + b - 1.0).abs() < 1e-8, "{a} {b} {c}");
}

/// Five links in a loop have two degrees of freedom.
#[test]
fn a_zero_that_is_written_is_given() {
    let pentagon = |last: &str| {
        let links = [
            link("a", "ground", [[0.0, 0.0], [0.0, 0.5]], "rate = 5"),
            link("b", "a", [[0.0, 1.0], [0.5, 1.4]], ""),
            link("c", "b", [[1.0, 1.8], [1.5, 1.4]], ""),
            link("d", "c", [[2.0, 1.0], [2.0, 0.5]], ""),
        ];
        let ground = "[joints.last]\nkind = \"revolute\"\nbase = \"ground\"\ntip = \"d\"\nat = [2, 0, 0]\naxis = \"z\"\n";
        let output = "[outputs.last]\nkind = \"relative\"\nof = \"last\"\n";
        format!("lissom = 1\n{}{ground}{last}\n{output}{END}", links.concat())
    };
    assert_near(rates_at_start(&pentagon("rate = 0"), ["to_a", "last"]), [5.0, 0.0]);
    let [a, last] = rates_at_start(&pentagon(""), ["to_a", "last"]);
    assert!((a - 5.0).abs() < 1e-8 && last.abs() > 0.1, "{a} {last}");
    let held = pentagon("").replace("position = [2, 0.5, 0]", "position = [2, 0.5, 0]\nvelocity = [0, 0, 0]");
    assert_near(rates_at_start(&held, ["to_a", "last"]), [5.0, 0.0]);
}
