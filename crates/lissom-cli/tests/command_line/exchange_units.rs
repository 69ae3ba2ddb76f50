//! Units for model exchange in models: their equations are solved with those of the model.

use std::sync::LazyLock;

use super::support::{Folder, summary};
use super::units::{column, library, run, write_unit_with};

static LIBRARY: LazyLock<Vec<u8>> = LazyLock::new(|| library("exchange.rs.txt"));

/// Description of a unit of a kind with this number of states and event indicators; `flags` are attributes of `ModelExchange`.
fn description(version: u8, kind: &str, [states, indicators]: [usize; 2], flags: &str) -> String {
    let is_second = version == 2;
    let has_feedthrough = matches!(kind, "filter" | "request");
    let variable = |name: &str, reference: usize, facts: &str, [second, third]: [&str; 2], more: &str| {
        if is_second {
            format!(
                "<ScalarVariable name=\"{name}\" valueReference=\"{reference}\" {facts}><{second} {more}/></ScalarVariable>"
            )
        } else {
            format!("<{third} name=\"{name}\" valueReference=\"{reference}\" {facts} {more}/>")
        }
    };
    let real = ["Real", "Float64"];
    let is_discrete = matches!(kind, "stairs" | "relay" | "sampler" | "storm");
    let output = format!(
        "causality=\"output\" variability=\"{}\"",
        if is_discrete { "discrete" } else { "continuous" }
    );
    let parameter = "causality=\"parameter\" variability=\"tunable\"";
    // In the order of the value references, so that indices from 1 and references agree.
    let mut variables = vec![
        variable("u", 1, "causality=\"input\"", real, "start=\"0\""),
        variable("p", 2, parameter, real, "start=\"1\""),
        variable("tau", 3, parameter, real, "start=\"0.1\""),
        variable("mode", 4, parameter, real, "start=\"0\""),
        variable("y", 5, &output, real, ""),
    ];
    for state in 0..2 {
        let facts = "causality=\"local\" initial=\"exact\"";
        variables.push(variable(
            &format!("x[{}]", state + 1),
            6 + state,
            facts,
            real,
            "start=\"0\" nominal=\"2\"",
        ));
    }
    for state in 0..2 {
        let (name, facts) = (format!("der(x[{}])", state + 1), format!("derivative=\"{}\"", 6 + state));
        variables.push(variable(&name, 8 + state, "causality=\"local\"", real, &facts));
    }
    variables.push(variable(
        "count",
        10,
        "causality=\"output\" variability=\"discrete\"",
        ["Integer", "Int32"],
        "",
    ));
    variables.push(variable("z", 11, "causality=\"local\"", real, ""));
    let unknown = |third: &str, number: usize, dependencies: &str| {
        if is_second {
            format!("<Unknown index=\"{number}\" {dependencies}/>")
        } else {
            format!("<{third} valueReference=\"{number}\" {dependencies}/>")
        }
    };
    let outputs =
        unknown("Output", 5, if has_feedthrough { "dependencies=\"1 6\"" } else { "dependencies=\"6 7\"" })
            + &unknown("Output", 10, "");
    let derivatives: String =
        (0..states).map(|state| unknown("ContinuousStateDerivative", 8 + state, "")).collect();
    let (structure, count) = if is_second {
        let structure = format!("<Outputs>{outputs}</Outputs><Derivatives>{derivatives}</Derivatives>");
        (structure, format!("numberOfEventIndicators=\"{indicators}\""))
    } else {
        (
            format!("{outputs}{derivatives}{}", "<EventIndicator valueReference=\"11\"/>".repeat(indicators)),
            String::new(),
        )
    };
    let token = if is_second { "guid" } else { "instantiationToken" };
    format!(
        "<fmiModelDescription fmiVersion=\"{version}.0\" modelName=\"unit\" {token}=\"{kind}\" {count}>\
         <ModelExchange modelIdentifier=\"pi\" {flags}/><ModelVariables>{}</ModelVariables>\
         <ModelStructure>{structure}</ModelStructure></fmiModelDescription>",
        variables.concat()
    )
}

/// Flag of directional derivatives, of both versions of the standard.
const EXACT: &str = "providesDirectionalDerivative=\"true\" providesDirectionalDerivatives=\"true\"";
const SAVES: &str = "canGetAndSetFMUState=\"true\" canSerializeFMUState=\"true\" canGetAndSetFMUstate=\"true\" canSerializeFMUstate=\"true\"";

fn folder_with(name: &str, version: u8, kind: &str, sizes: [usize; 2], flags: &str) -> Folder {
    let folder = Folder::new(name);
    write_unit_with(
        &folder.path().join("unit.fmu"),
        version,
        &description(version, kind, sizes, flags),
        &LIBRARY,
    );
    folder
}

/// A pendulum with a torque, and more entries.
fn model(torque: &str, more: &str) -> String {
    format!(
        r#"lissom = 1
[bodies.bob]
mass = 1
inertia = [0.01, 0.01, 0.01]
position = [0.5, 0, 0]
[joints.arm]
kind = "revolute"
base = "ground"
tip = "bob"
at = [0, 0, 0]
axis = [0, 0, 1]
[loads.motor]
kind = "joint_torque"
joint = "arm"
torque = "{torque}"
{more}
[outputs.arm]
kind = "relative"
of = "arm"
[outputs.torque]
kind = "expression"
value = "{torque}"
[analysis]
kind = "dynamics"
end = 0.5
step = 0.005
"#
    )
}

const VAN_DER_POL: &str = r#"
[units.osc]
file = "unit.fmu"
inputs = { u = "4*arm.angle + arm.rate" }
outputs = { y = "y" }
parameters = { p = 30, tau = 0.2, "x[1]" = 0.5, "x[2]" = 1 }
"#;

/// The same equations.
const VAN_DER_POL_STATES: &str = r#"
[states.a]
derivative = "b"
start = 0.5
magnitude = 2
[states.b]
derivative = "30*(1 - a^2)*b - a + sin(20*t) + 4*arm.angle + arm.rate"
start = 1
magnitude = 2
[signals]
y = "a + 0.2*b"
"#;

const FILTER: &str = r#"
[units.osc]
file = "unit.fmu"
inputs = { u = "1 + 4*arm.angle + arm.rate" }
outputs = { y = "y" }
parameters = { p = -3, tau = 0.02, "x[1]" = 0.5 }
"#;

const FILTER_STATES: &str = r#"
[states.a]
derivative = "(u - a)/0.02"
start = 0.5
magnitude = 2
[signals]
u = "1 + 4*arm.angle + arm.rate"
y = "-3*(u - a)"
"#;

/// Values and Newton iterations of a run.
fn results(folder: &Folder, text: &str, more: &[&str]) -> (Vec<f64>, u64) {
    let ended = run(folder, text, more);
    assert_eq!(ended.code, 0, "{more:?}: {}", ended.errors);
    let iterations = summary(&folder.path().join("out"))["newton_iterations"].as_u64().unwrap();
    ([column(folder, "arm", "angle"), column(folder, "torque", "value")].concat(), iterations)
}

#[test]
fn equations_of_a_unit_are_those_of_states() {
    let adaptive = [
        "analysis.relative_tolerance=1e-6",
        "--unset",
        "analysis.step",
        "--set",
        "analysis.output_step=0.005",
    ];
    let schemes = [
        "backward-euler",
        "generalized-alpha",
        "hht",
        "energy-decaying",
        "radau-iia",
        "radau-iia-5",
        "radau-iia-9",
    ];
    let mut choices: Vec<Vec<&str>> =
        vec![adaptive.to_vec(), [&adaptive[..], &["--set", "analysis.scheme=hht"]].concat()];
    let schemes: Vec<String> = schemes.iter().map(|scheme| format!("analysis.scheme={scheme}")).collect();
    choices.extend(schemes.iter().map(|scheme| vec![&**scheme]));
    let kinds = [("van der pol", 2, VAN_DER_POL, VAN_DER_POL_STATES), ("filter", 1, FILTER, FILTER_STATES)];
    for (kind, states, unit, equations) in kinds {
        for (version, flags) in [(2, EXACT), (3, EXACT), (3, "")] {
            let folder = folder_with("exchange-equal", version, kind, [states, 0], flags);
            for choice in &choices {
                let set = [&["--set"], &**choice].concat();
                let (expected, iterations) = results(&folder, &model("5*y", equations), &set);
                let (found, own) = results(&folder, &model("5*osc.y", unit), &set);
                assert_eq!(found.len(), expected.len(), "{choice:?}");
                for (found, expected) in found.iter().zip(&expected) {
                    // With derivatives by differences the iterates differ, and so do steps that follow the error.
                    // The explicit function of time in the states also limits adaptive steps; of a unit it is not known.
                    let is_adaptive = choice.contains(&"--unset");
                    // Newton's method may end elsewhere within its tolerance, which relaxation oscillations amplify.
                    let exact = if states > 1 { 1e-7 } else { 1e-9 };
                    let allowed = if flags.is_empty() || is_adaptive { 1e-6 } else { exact };
                    assert!(
                        (found - expected).abs() < allowed * expected.abs().max(1.0),
                        "{kind} {version} {choice:?}: {found}, not {expected}"
                    );
                }
                // All derivatives of states depend on all inputs of the unit, so that the pattern and the choice of when to factor may differ.
                let is_free = states > 1 && choice.contains(&"--unset");
                let part = if is_free { 2 } else { 20 };
                let allowed = if flags.is_empty() || states > 1 { iterations / part } else { 0 };
                assert!(
                    own.abs_diff(iterations) <= allowed,
                    "{kind} {version} {choice:?}: {own} iterations, not {iterations}"
                );
            }
        }
    }
}

#[test]
fn units_in_a_loop_are_equal_to_states() {
    let folder = folder_with("exchange-loop", 3, "van der pol", [2, 0], EXACT);
    write_unit_with(&folder.path().join("filter.fmu"), 2, &description(2, "filter", [1, 0], EXACT), &LIBRARY);
    // `alpha.w` is zero, and no output of the model structure. The first in the order of names needs the second, whose input needs an output of the first without feedthrough.
    let units = VAN_DER_POL.replace("osc", "zeta").replace("{ y = \"y\" }", "{ y = \"y\", b = \"x[2]\" }")
        + &FILTER
            .replace("osc", "alpha")
            .replace("unit.fmu", "filter.fmu")
            .replace("y = \"y\"", "y = \"y\", w = \"x[2]\"")
            .replace("arm.rate", "zeta.b + sum")
        + "[signals]\nsum = \"arm.rate + zeta.y\"\n";
    let units = units.replacen("4*arm.angle + arm.rate", "4*arm.angle + alpha.y", 1);
    let states = VAN_DER_POL_STATES.replace("arm.rate", "high").replace("[signals]", "")
        + "high = \"-3*(u - c)\"\nu = \"1 + 4*arm.angle + b + sum\"\nsum = \"arm.rate + y\"\n\
           [states.c]\nderivative = \"(u - c)/0.02\"\nstart = 0.5\nmagnitude = 2\n";
    let states = states.replace("y = \"a", "[signals]\ny = \"a");
    for choice in [&[][..], &["--set", "analysis.scheme=radau-iia-5"]] {
        let (expected, iterations) = results(&folder, &model("y + 0.1*b", &states), choice);
        let (found, own) = results(&folder, &model("zeta.y + 0.1*zeta.b + alpha.w", &units), choice);
        for (found, expected) in found.iter().zip(&expected) {
            assert!((found - expected).abs() < 1e-9 * expected.abs().max(1.0), "{found}, not {expected}");
        }
        assert!(own.abs_diff(iterations) <= iterations / 20, "{own} iterations, not {iterations}");
    }
    // A loop of feedthrough has no order.
    let ended = run(&folder, &model("zeta.y", &units.replace("zeta.b + sum", "alpha.y")), &[]);
    assert_eq!(ended.code, 2, "{}", ended.errors);
    assert!(ended.errors.contains("algebraic loop"), "{}", ended.errors);
}

#[test]
fn wrong_derivatives_cost_iterations() {
    let folder = folder_with("exchange-wrong", 3, "van der pol", [2, 0], EXACT);
    let (expected, iterations) = results(&folder, &model("5*osc.y", VAN_DER_POL), &[]);
    let wrong = VAN_DER_POL.replace("p = 30", "p = 30, mode = 7");
    let ended = run(&folder, &model("5*osc.y", &wrong), &[]);
    if ended.code == 0 {
        let own = summary(&folder.path().join("out"))["newton_iterations"].as_u64().unwrap();
        assert!(own > iterations + iterations / 2, "{own}, not more than {iterations}");
        assert!(
            (column(&folder, "arm", "angle").last().unwrap() - expected[expected.len() / 2 - 1]).abs() < 1e-5
        );
    }
}

const BALL: &str = r#"
[units.ball]
file = "unit.fmu"
inputs = { u = 0 }
outputs = { y = "y", v = "x[2]", n = "count" }
parameters = { p = 0.8, "x[1]" = 1 }
[outputs.height]
kind = "expression"
value = "ball.y"
[outputs.speed]
kind = "expression"
value = "ball.v"
[outputs.bounces]
kind = "expression"
value = "ball.n"
"#;

/// Height, speed and bounces of a ball that falls from 1 m.
fn ball(time: f64) -> [f64; 3] {
    let (g, e) = (9.81_f64, 0.8);
    let (mut start, mut speed, mut count) = (-(2.0 / g).sqrt(), (2.0 * g).sqrt(), 0.0);
    while time > start + 2.0 * speed / g {
        start += 2.0 * speed / g;
        (speed, count) = (e * speed, count + 1.0);
    }
    let since = time - start;
    [speed * since - 0.5 * g * since * since, speed - g * since, count]
}

#[test]
fn a_ball_bounces_at_its_instants() {
    for version in [2, 3] {
        let folder = folder_with("exchange-ball", version, "ball", [2, 1], EXACT);
        for more in [
            &["--set", "analysis.scheme=radau-iia"][..],
            &["--set", "analysis.scheme=generalized-alpha"],
            &[
                "--set",
                "analysis.relative_tolerance=1e-8",
                "--unset",
                "analysis.step",
                "--set",
                "analysis.output_step=0.02",
            ],
        ] {
            let more = [more, &["--set", "analysis.end=2.5"]].concat();
            let ended = run(&folder, &model("ball.y", BALL), &more);
            assert_eq!((ended.code, &*ended.errors), (0, ""), "{more:?}");
            let times = times(&folder);
            let rows = ["height", "speed", "bounces"].map(|output| column(&folder, output, "value"));
            for (row, &time) in times.iter().enumerate() {
                for (rows, expected) in rows.iter().zip(ball(time)) {
                    assert!(
                        (rows[row] - expected).abs() < 1e-7,
                        "{more:?}, t = {time}: {}, not {expected}",
                        rows[row]
                    );
                }
            }
            assert_eq!(*rows[2].last().unwrap(), 4.0);
            let events = std::fs::read_to_string(folder.path().join("out/events.csv")).unwrap();
            let times: Vec<f64> =
                events.lines().skip(1).map(|line| line.split(',').next().unwrap().parse().unwrap()).collect();
            assert_eq!(times.len(), 4, "{events}");
            let mut expected = (2.0_f64 / 9.81).sqrt();
            let mut flight = 2.0 * 0.8 * expected;
            for time in times {
                assert!((time - expected).abs() < 1e-8, "{time}, not {expected}");
                (expected, flight) = (expected + flight, 0.8 * flight);
            }
        }
    }
}

const STAIRS: &str = r#"
[units.stairs]
file = "unit.fmu"
inputs = { u = 0 }
outputs = { y = "y", x = "x[1]", n = "count" }
parameters = { p = 0.123 }
[outputs.x]
kind = "expression"
value = "stairs.x"
"#;

#[test]
fn steps_end_at_announced_events() {
    for version in [2, 3] {
        let folder = folder_with("exchange-stairs", version, "stairs", [1, 0], "");
        for more in [
            &["--set", "analysis.scheme=radau-iia"][..],
            &["--set", "analysis.scheme=hht"],
            &[
                "--set",
                "analysis.relative_tolerance=1e-6",
                "--unset",
                "analysis.step",
                "--set",
                "analysis.output_step=0.01",
            ],
        ] {
            let ended = run(&folder, &model("stairs.y", STAIRS), more);
            assert_eq!((ended.code, &*ended.errors), (0, ""), "{more:?}");
            let (times, x, y) =
                (times(&folder), column(&folder, "x", "value"), column(&folder, "torque", "value"));
            for ((time, x), y) in times.iter().zip(x).zip(y) {
                let steps: Vec<f64> =
                    (1..4).map(|step| 0.123 * f64::from(step)).filter(|step| step <= time).collect();
                // The integral of the steps up to here, exact as each step of the scheme is.
                let expected: f64 = steps.iter().map(|step| time - step).sum();
                assert!((x - expected).abs() < 1e-9, "{more:?}, t = {time}: {x}, not {expected}");
                assert_eq!(y, steps.len() as f64);
            }
        }
    }
}

#[test]
fn events_have_inputs_on_which_no_value_depends() {
    // A sampled controller: its output is constant between events.
    let sampler = "[units.sampler]\nfile = \"unit.fmu\"\ninputs = { u = \"cos(10*t)\" }\noutputs = { y = \"y\" }\nparameters = { p = 0.02 }\n";
    for version in [2, 3] {
        let folder = folder_with("exchange-sampler", version, "sampler", [0, 0], "");
        let ended = run(&folder, &model("sampler.y", sampler), &[]);
        assert_eq!((ended.code, &*ended.errors), (0, ""), "FMI {version}.0");
        for (time, y) in times(&folder).iter().zip(column(&folder, "torque", "value")) {
            // A record at the instant of an event has the values before it.
            let sample = 0.02 * ((time / 0.02 - 1e-6).floor()).max(0.0);
            assert!((y - 2.0 * (10.0 * sample).cos()).abs() < 1e-9, "FMI {version}.0, t = {time}: {y}");
        }
    }
}

#[test]
fn indicators_of_inputs_and_requested_events_are_found() {
    let relay = r#"
[units.relay]
file = "unit.fmu"
inputs = { u = "sin(20*t)" }
outputs = { y = "y", n = "count" }
parameters = { p = 0.5, tau = -0.5 }
[outputs.n]
kind = "expression"
value = "relay.n"
"#;
    let folder = folder_with("exchange-relay", 3, "relay", [1, 1], "");
    let ended = run(&folder, &model("relay.y", relay), &[]);
    assert_eq!((ended.code, &*ended.errors), (0, ""));
    let (times, y) = (times(&folder), column(&folder, "torque", "value"));
    for (time, y) in times.iter().zip(y) {
        let phase = (20.0 * time / std::f64::consts::PI).rem_euclid(2.0);
        let is_high = phase > 1.0 / 6.0 && phase < 7.0 / 6.0;
        assert_eq!(y, if is_high { 1.0 } else { -1.0 }, "t = {time}");
    }
    assert_eq!(column(&folder, "n", "value").last(), Some(&4.0));

    // An input that jumps at a sample is an event, too.
    let sampled = relay.replace("sin(20*t)", "level")
        + "[signals]\nlevel = { value = \"sign(t - 0.2)\", sample = 0.1 }\n";
    let ended = run(&folder, &model("relay.y", &sampled), &[]);
    assert_eq!((ended.code, &*ended.errors), (0, ""));
    let y = column(&folder, "torque", "value");
    for (time, y) in times.iter().zip(y) {
        assert_eq!(y, if *time > 0.3 + 1e-9 { 1.0 } else { -1.0 }, "t = {time}");
    }

    let request = "[units.unit]\nfile = \"unit.fmu\"\ninputs = { u = 0 }\noutputs = { x = \"x[1]\", n = \"count\" }\nparameters = { tau = 0.1 }\n\
         [outputs.x]\nkind = \"expression\"\nvalue = \"unit.x\"\n[outputs.n]\nkind = \"expression\"\nvalue = \"unit.n\"\n";
    let folder = folder_with("exchange-request", 2, "request", [1, 0], EXACT);
    let ended = run(&folder, &model("unit.x", request), &[]);
    assert_eq!((ended.code, &*ended.errors), (0, ""));
    let (x, n) = (column(&folder, "x", "value"), column(&folder, "n", "value"));
    assert_eq!(n.iter().position(|n| *n == 1.0), Some(4));
    // The row of the event has the values before it.
    assert!(x[3] == 0.0 && (x[4] - 5.0 * (-0.05_f64).exp()).abs() < 1e-3);
    // Decay from there on.
    assert!((x.last().unwrap() - 5.0 * (-10.0 * (0.5 - 0.015_f64)).exp()).abs() < 1e-3);
}

fn times(folder: &Folder) -> Vec<f64> {
    let table = std::fs::read_to_string(folder.path().join("out/history.csv")).unwrap();
    lissom::Record::from_csv(&table).unwrap().times.clone()
}

#[test]
fn a_unit_that_fails_keeps_the_results_up_to_there() {
    for version in [2, 3] {
        let folder = folder_with("exchange-fail", version, "filter", [1, 0], EXACT);
        for (mode, words) in [
            (1, "signal 6 (abort)"),
            (2, "did not answer within 0.5 s"),
            (3, "returned Error"),
            (4, "is not finite"),
            (5, "returned Discard"),
            (6, "it ended the simulation"),
        ] {
            let text =
                FILTER.replace("tau = 0.02", &format!("tau = 0.02, mode = {mode}")) + "timeout = 0.5\n";
            let ended = run(&folder, &model("5*osc.y", &text), &[]);
            assert_eq!(ended.code, 3, "{mode}: {}", ended.errors);
            assert!(ended.errors.contains(words), "{mode}: {}", ended.errors);
            assert!(
                ended.errors.contains("the unit `osc` failed in its step to t = 0.0"),
                "{mode}: {}",
                ended.errors
            );
            let rows = times(&folder);
            assert!((9..=11).contains(&rows.len()), "{mode}: {rows:?}");
        }
        // A point that is discarded once costs a shorter step.
        let text = FILTER.replace("tau = 0.02", "tau = 0.02, mode = 8");
        let (expected, _) = results(&folder, &model("5*osc.y", FILTER), &[]);
        let (found, _) = results(&folder, &model("5*osc.y", &text), &[]);
        assert!(found.iter().zip(&expected).all(|(found, expected)| (found - expected).abs() < 1e-2));
    }
}

#[test]
fn snapshots_contain_the_discrete_state() {
    for (kind, sizes, unit, torque) in [
        ("ball", [2, 1], BALL, "ball.y"),
        ("stairs", [1, 0], STAIRS, "stairs.y"),
        ("van der pol", [2, 0], VAN_DER_POL, "osc.y"),
    ] {
        let flags = format!("{EXACT} {SAVES}");
        let folder = folder_with("exchange-resume", 3, kind, sizes, &flags);
        let set = ["--set", "analysis.end=3", "--set", "analysis.step=5e-4"];
        let text = model(torque, unit);
        let ended = run(&folder, &text, &set);
        assert_eq!(ended.code, 0, "{}", ended.errors);
        let expected = std::fs::read_to_string(folder.path().join("out/history.csv")).unwrap();
        let arguments = ["run", "model.toml", "--no-plots", "--out", "out", "--checkpoint-every", "20steps"];
        let mut started = super::support::Run::start(&[&arguments[..], &set].concat(), folder.path());
        let checkpoint = folder.path().join("out/checkpoint.lissom");
        // The first checkpoint is that of the start.
        super::support::wait_for(|| checkpoint.is_file() && times(&folder).len() > 1000);
        started.0.kill().unwrap();
        drop(started);
        assert!(checkpoint.is_file(), "the run was not killed before its end");
        let ended = super::support::lissom(&["run", "--resume", "out", "--quiet"], folder.path());
        assert_eq!((ended.code, &*ended.errors), (0, ""));
        assert_eq!(
            std::fs::read_to_string(folder.path().join("out/history.csv")).unwrap(),
            expected,
            "{kind}"
        );
    }
}

/// Takes a step, and appends the bits of all values.
fn step(session: &mut lissom::Session, bits: &mut Vec<u64>) {
    session.advance().unwrap();
    let mut values = Vec::new();
    session.values(&mut values);
    bits.extend(values.into_iter().map(f64::to_bits));
}

#[test]
fn sessions_of_a_prepared_model_have_units_of_their_own() {
    for (kind, sizes, unit, torque) in [
        ("ball", [2, 1], BALL, "ball.y"),
        ("stairs", [1, 0], STAIRS, "stairs.y"),
        ("van der pol", [2, 0], VAN_DER_POL, "osc.y"),
    ] {
        let folder = folder_with("exchange-sessions", 3, kind, sizes, EXACT);
        folder.write("model.toml", &model(torque, unit));
        let model = lissom::Model::read(&folder.path().join("model.toml")).unwrap();
        let prepared = model.prepare().unwrap();
        let run = |session: &mut lissom::Session| {
            let mut bits = Vec::new();
            while !session.is_finished() {
                step(session, &mut bits);
            }
            bits
        };
        let alone = run(&mut prepared.session().unwrap());
        // In turn, where the second one begins while the first one has run for a while.
        let (mut first, mut first_bits) = (prepared.session().unwrap(), Vec::new());
        (0..30).for_each(|_| step(&mut first, &mut first_bits));
        let (mut second, mut second_bits) = (prepared.session().unwrap(), Vec::new());
        while !second.is_finished() {
            if !first.is_finished() {
                step(&mut first, &mut first_bits);
            }
            step(&mut second, &mut second_bits);
        }
        assert!(first_bits == alone && second_bits == alone, "{kind}, in turn");
        // At once.
        let at_once = std::thread::scope(|scope| {
            let threads = [(); 2].map(|()| scope.spawn(|| run(&mut prepared.session().unwrap())));
            threads.map(|thread| thread.join().unwrap())
        });
        assert!(at_once.iter().all(|bits| *bits == alone), "{kind}, at once");
    }
}

#[test]
fn events_without_end_are_a_failure() {
    let storm = |pause: &str| {
        format!(
            "[units.storm]\nfile = \"unit.fmu\"\ninputs = {{ u = 0 }}\noutputs = {{ y = \"y\" }}\nparameters = {{ p = {pause} }}\n"
        )
    };
    let folder = folder_with("exchange-storm", 3, "storm", [0, 0], "");
    for pause in ["1e-9", "1e-14"] {
        let ended = run(&folder, &model("storm.y", &storm(pause)), &[]);
        assert_eq!(ended.code, 3, "{}", ended.errors);
        assert!(ended.errors.contains("the unit `storm`"), "{}", ended.errors);
        assert!(ended.errors.contains("it had 5000 events between t = 0 s and t = "), "{}", ended.errors);
    }
    // Many events in a long run are none.
    let ended = run(&folder, &model("storm.y", &storm("1e-4")), &["--set", "analysis.step=1e-3"]);
    assert_eq!((ended.code, &*ended.errors), (0, ""));
}

#[test]
fn mistakes_are_reported() {
    let folder = folder_with("exchange-bad", 3, "filter", [1, 0], EXACT);
    let check = |from: &str, to: &str, words: &[&str]| {
        let unit = FILTER.replace(from, to);
        assert_ne!(unit, FILTER, "{from}");
        let ended = run(&folder, &model("5*osc.y", &unit), &[]);
        assert_eq!(ended.code, 2, "{to}: {}", ended.errors);
        for words in words {
            assert!(ended.errors.contains(words), "{to}: {words}\n{}", ended.errors);
        }
    };
    check("inputs", "sample = 1e-3\ninputs", &["is for model exchange, and has no samples"]);
    check("inputs", "mode = \"co_simulation\"\ninputs", &["does not support co-simulation"]);
    check("1 + 4*arm.angle", "osc.y", &["algebraic loop"]);
    check("y = \"y\"", "z = \"y\"", &["the unit `osc` has no output `y`"]);
    // An output without feedthrough may be the input of its own unit.
    let ended = run(
        &folder,
        &model(
            "5*osc.y",
            &FILTER.replace("y = \"y\"", "y = \"y\", x = \"x[1]\"").replace("1 + 4", "osc.x + 4"),
        ),
        &[],
    );
    assert_eq!((ended.code, &*ended.errors), (0, ""));
    // Inputs must be continuous, and derivatives must name their states.
    for (from, to, words) in [
        ("<Float64 name=\"u\"", "<Int32 name=\"u\"", "is not continuous"),
        ("derivative=\"6\"", "", "has no state"),
        (
            "</ModelStructure>",
            &("<EventIndicator valueReference=\"11\"/>".repeat(2001) + "</ModelStructure>"),
            "has more than 2000 event indicators",
        ),
        ("valueReference=\"8\" />", "valueReference=\"80\" />", "names a variable that it does not have"),
    ] {
        let text = description(3, "filter", [1, 0], EXACT);
        let changed = text.replacen(from, to, 1);
        assert_ne!(text, changed, "{from}");
        write_unit_with(&folder.path().join("unit.fmu"), 3, &changed, &LIBRARY);
        let ended = run(&folder, &model("5*osc.y", FILTER), &[]);
        assert_eq!(ended.code, 2, "{to}: {}", ended.errors);
        assert!(ended.errors.contains(words), "{to}: {}", ended.errors);
    }
    for count in ["4000000000", "18446744073709551616"] {
        let text = description(2, "filter", [1, 0], EXACT)
            .replace("Indicators=\"0\"", &format!("Indicators=\"{count}\""));
        write_unit_with(&folder.path().join("unit.fmu"), 2, &text, &LIBRARY);
        let ended = run(&folder, &model("5*osc.y", FILTER), &[]);
        assert_eq!(ended.code, 2, "{count}: {}", ended.errors);
        assert!(ended.errors.contains("has more than 2000 event indicators"), "{count}: {}", ended.errors);
    }
}
