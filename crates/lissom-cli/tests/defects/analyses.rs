//! Models on which an analysis once gave a wrong result without a warning, or was rejected without a reason.

use lissom::AnalysisWarning;
use std::f64::consts::TAU;

use lissom::analyses::campbell::{CampbellRequest, campbell};
use lissom::analyses::gradient::{Confirmation, GradientReport, Method, Target, gradient};
use lissom::analyses::modes::{ModeReport, ModeRequest, OperatingPoint, modes};
use lissom::analyses::path::PathEnd;
use lissom::core::path::CriticalKind;
use lissom::{Model, Override, Session};

use crate::support::paths::{follow, near};

const NEAR_GROWTH: &str = include_str!("models/modes-missing.toml");
const STIFF_BLADE: &str = include_str!("models/steady_rotation_false_refusal.toml");
const DAMPED_ROTOR: &str = include_str!("models/campbell_not_converged.toml");
const GEARED_TRAIN: &str = include_str!("models/redundant_modes_1e-5.toml");
const FOLLOWER_PATH: &str = include_str!("models/path-violates-joint.toml");
const TWO_BIFURCATIONS: &str = include_str!("models/path-merges-bifurcations.toml");
const IMPERFECT: &str = include_str!("models/path-imperfect-bifurcation.toml");
const STOP: &str = include_str!("models/gradient-through-stop.toml");
const GUYED_MAST: &str = include_str!("models/false_jump_warning_prestress.toml");
const SLACK_CABLE: &str = include_str!("models/slack_cable_fails_slowly.toml");

fn set(overrides: &[(&str, &str)]) -> Vec<Override> {
    overrides.iter().map(|&(path, value)| (path.to_owned(), value.to_owned())).collect()
}

fn find(text: &str, overrides: &[(&str, &str)], request: &ModeRequest) -> ModeReport {
    modes(&Model::from_text("model.toml", text).with_overrides(&set(overrides)), request)
        .unwrap_or_else(|error| panic!("{error}"))
}

/// Eigenvalues of a chain of masses on a rail, in ascending order of size, by the companion matrix.
fn chain(masses: &[f64], stiffness: &[f64], damping: &[f64]) -> (String, Vec<(f64, f64)>) {
    use std::fmt::Write;
    let count = masses.len();
    let mut text = "lissom = 1\n".to_owned();
    for (k, mass) in masses.iter().enumerate() {
        let base = if k == 0 { "ground".to_owned() } else { format!("m{}", k - 1) };
        let _ = write!(
            text,
            "[bodies.m{k}]\nmass = {mass:?}\ninertia = [1, 1, 1]\n\
             [joints.j{k}]\nkind = \"prismatic\"\nbase = \"{base}\"\ntip = \"m{k}\"\nat = [0, 0, 0]\naxis = [1, 0, 0]\n\
             [springs.s{k}]\nkind = \"axial\"\njoint = \"j{k}\"\nforce = \"{:?}*elongation + {:?}*rate\"\n",
            stiffness[k], damping[k]
        );
    }
    text += "[analysis]\nkind = \"modes\"\n";
    // In the relative displacements the springs are alone, and masses carry all that follow them.
    let mass = nalgebra::DMatrix::from_fn(count, count, |i, j| masses[i.max(j)..].iter().sum::<f64>());
    let inverse = mass.try_inverse().expect("regular");
    let mut a = nalgebra::DMatrix::<f64>::zeros(2 * count, 2 * count);
    for i in 0..count {
        a[(i, count + i)] = 1.0;
        for j in 0..count {
            a[(count + i, j)] = -inverse[(i, j)] * stiffness[j];
            a[(count + i, count + j)] = -inverse[(i, j)] * damping[j];
        }
    }
    let mut values: Vec<(f64, f64)> = a
        .complex_eigenvalues()
        .iter()
        .filter(|value| value.im >= 0.0)
        .map(|value| (value.re, value.im))
        .collect();
    values.sort_by(|a, b| a.0.hypot(a.1).total_cmp(&b.0.hypot(b.1)));
    (text, values)
}

#[test]
fn every_mode_is_found_beside_one_that_grows() {
    let all = ModeRequest { count: Some(20), about: Some(OperatingPoint::Static), ..ModeRequest::default() };
    let report = find(NEAR_GROWTH, &[], &all);
    let expected = [
        (1.619, 0.0),
        (2.284, 0.0),
        (-1.785, 0.0),
        (-2.342, 0.0),
        (-0.448, 6.836),
        (-0.403, 10.09),
        (-4.981, 7.692),
    ];
    assert_eq!(report.modes.len(), expected.len());
    for (re, im) in expected {
        let is_there = |mode: &lissom::core::linearized::Mode| {
            (mode.eigenvalue.re - re).hypot(mode.eigenvalue.im - im) < 2e-3 * f64::hypot(re, im)
        };
        assert!(report.modes.iter().any(is_there), "{re} + {im}i of {:?}", report.csv());
    }
    assert!(report.warnings.contains(&AnalysisWarning::Unstable { modes: 2 }), "{:?}", report.warnings);
}

#[test]
fn all_modes_of_chains_are_found_whatever_their_stiffness_and_damping() {
    let all = ModeRequest { count: Some(20), about: Some(OperatingPoint::Static), ..ModeRequest::default() };
    for (stiffness, damping) in [
        ([-40.0, 30.0, 100.0], [1.0, 0.5, 0.2]),
        ([-1.0, 1e4, 1e6], [0.1, 20.0, 3.0]),
        ([100.0, 1e3, 1e7], [300.0, 1.0, 1e4]),
        ([50.0, -20.0, 1e3], [0.0, 5.0, 0.0]),
        ([1e-2, 1.0, 1e5], [1e-3, 1e-3, 1e3]),
    ] {
        let (text, exact) = chain(&[1.0, 2.0, 0.5], &stiffness, &damping);
        let report = find(&text, &[], &all);
        assert_eq!(report.modes.len(), exact.len(), "{stiffness:?}, {damping:?}: {} {exact:?}", report.csv());
        let largest = exact.iter().map(|value| value.0.hypot(value.1)).fold(0.0, f64::max);
        for (re, im) in exact {
            let apart = |mode: &lissom::core::linearized::Mode| {
                (mode.eigenvalue.re - re).hypot(mode.eigenvalue.im - im)
            };
            let least = report.modes.iter().map(apart).fold(f64::INFINITY, f64::min);
            assert!(least < 1e-6 * f64::hypot(re, im) + 1e-12 * largest, "{re} + {im}i: {}", report.csv());
        }
    }
}

#[test]
fn redundant_joints_leave_frequencies_alone() {
    // Seen from the first shaft: J₁ = 2, J₂ = 0.1 + 0.5·2.5², J₃ = 1.2·2.5², shafts of k₁ and k₂·2.5².
    for (k1, tolerance) in [(40_000.0_f64, 1e-9), (4e7, 1e-9), (4e12, 1e-7)] {
        let (j, k): ([f64; 3], [f64; 2]) = ([2.0, 0.1 + 0.5 * 6.25, 1.2 * 6.25], [k1, 25_000.0 * 6.25]);
        // det(K - λM)/λ = a λ² - b λ + c.
        let a = j[0] * j[1] * j[2];
        let b = k[0] * j[2] * (j[0] + j[1]) + k[1] * j[0] * (j[1] + j[2]);
        let c = k[0] * k[1] * (j[0] + j[1] + j[2]);
        let high = 0.5 * (b + (b * b - 4.0 * a * c).sqrt()) / a;
        let exact = [c / (a * high), high].map(|square: f64| square.sqrt() / TAU);
        let all =
            ModeRequest { count: Some(20), about: Some(OperatingPoint::Static), ..ModeRequest::default() };
        let report = find(GEARED_TRAIN, &[("springs.k1.stiffness", &format!("{k1:?}"))], &all);
        assert_eq!(report.modes.len(), 3, "{}", report.csv());
        for (mode, exact) in report.modes[1..].iter().zip(exact) {
            near(mode.frequency, exact, tolerance);
        }
    }
}

#[test]
fn redundant_joints_with_damping_have_their_modes() {
    let damped = GEARED_TRAIN.replace("stiffness=25000.0", "stiffness=25000.0\ndamping=10");
    let all = ModeRequest { count: Some(20), about: Some(OperatingPoint::Static), ..ModeRequest::default() };
    let report = find(&damped, &[], &all);
    assert_eq!(report.modes.len(), 3, "{}", report.csv());
    near(report.modes[1].frequency, 22.602_25, 1e-3);
}

#[test]
fn a_blade_of_any_axial_stiffness_has_its_modes_in_rotation() {
    let six = ModeRequest { count: Some(6), about: Some(OperatingPoint::Rotation), ..ModeRequest::default() };
    let soft = find(&STIFF_BLADE.replace("1e13,1e13,1e13", "1e11,1e11,1e11"), &[], &six);
    let stiff = find(STIFF_BLADE, &[], &six);
    assert_eq!(stiff.modes.len(), 6, "{:?}", stiff.warnings);
    for (one, other) in soft.modes.iter().zip(&stiff.modes) {
        near(other.frequency, one.frequency, 1e-3);
    }
}

#[test]
fn a_diagram_of_a_light_damped_shaft_converges_at_every_speed() {
    let request = CampbellRequest {
        vary: "parameters.speed=100:400:7".parse().unwrap(),
        count: 3,
        shift: None,
        averaged: false,
        rays: vec![1],
    };
    let report = campbell(&Model::from_text("model.toml", DAMPED_ROTOR), &request)
        .unwrap_or_else(|error| panic!("{error}"));
    assert_eq!(report.points.len(), 7);
    assert!(report.points.iter().all(|point| point.modes.len() == 3), "{}", report.csv());
    // Backward whirl of the disc over the speed of rotation, in rotating axes.
    let of = |k: usize| report.points[k].modes[2].mode.frequency - report.points[k].spin;
    for k in 1..6 {
        assert!((of(k) - 0.5 * (of(k - 1) + of(k + 1))).abs() < 0.1, "{}", report.csv());
    }
}

fn slider(spring: &str) -> String {
    format!(
        "lissom = 1\n[bodies.m]\nmass = 1\ninertia = [1, 1, 1]\n\
         [joints.s]\nkind = \"prismatic\"\nbase = \"ground\"\ntip = \"m\"\nat = [0, 0, 0]\naxis = [1, 0, 0]\n{spring}\n\
         [analysis]\nkind = \"dynamics\"\nend = 1\n"
    )
}

fn axial(law: &str) -> String {
    slider(&format!("[springs.k]\nkind = \"axial\"\njoint = \"s\"\n{law}"))
}

#[test]
fn kinks_and_jumps_of_forces_are_reported_beside_modes() {
    let all = ModeRequest { count: Some(5), about: Some(OperatingPoint::Static), ..ModeRequest::default() };
    let warns =
        |text: &str| find(text, &[], &all).warnings.iter().any(|own| own.code() == "linearization-kink");
    for law in [
        "force = { table = [[-1, -10], [0, 0], [1, 1000]] }",
        "force = \"100*elongation + 3*abs(elongation)\"",
        "force = \"10*if(elongation < 0, -1, 1)*sqrt(abs(elongation))\"",
        "force = \"100*elongation + 5*max(rate, 0)\"",
        "stiffness = 100\nside = \"tension\"",
    ] {
        assert!(warns(&axial(law)), "{law}");
    }
    for law in [
        "stiffness = 100",
        "force = \"100*elongation + 100*elongation^2\"",
        "stiffness = 100\nbacklash = 0.01",
    ] {
        assert!(!warns(&axial(law)), "{law}");
    }
    let stop = |range: &str| {
        slider(&format!(
            "[springs.k]\nkind = \"axial_stop\"\njoint = \"s\"\nrange = {range}\nstiffness = 100"
        ))
    };
    assert!(warns(&stop("[0, 1]")), "a stop in grazing contact");
    assert!(!warns(&stop("[-1, 1]")), "between stops");
    let load = |scale: &str| {
        slider(&format!(
            "[springs.k]\nkind = \"axial\"\njoint = \"s\"\nstiffness = 100\n\
             [loads.f]\nkind = \"force\"\non = \"m\"\nvector = [1, 0, 0]\nscale = \"{scale}\""
        ))
    };
    assert!(warns(&load("-50*abs(s.displacement)")));
    assert!(!warns(&load("-50*s.displacement^2")));
}

#[test]
fn a_path_with_a_follower_force_stays_on_its_joints() {
    let (record, report) = follow(FOLLOWER_PATH, &[]);
    assert!(matches!(report.end, PathEnd::Reached), "{:?}", report.end);
    for component in ["x", "y", "r1", "r2", "r3"] {
        let column = record.column("m", component).unwrap_or_else(|| panic!("{component}"));
        let largest = column.iter().fold(0.0_f64, |most, value| most.max(value.abs()));
        assert!(largest < 2e-12, "{component}: {largest}");
    }
    // Pivots of an unsymmetric tangent count nothing in pairs.
    for point in &report.critical {
        assert_eq!(point.unstable[0].abs_diff(point.unstable[1]), 1, "{:?}", report.critical);
    }
}

#[test]
fn two_bifurcations_in_one_step_are_two() {
    for step in ["20", "60", "5"] {
        let (_, report) = follow(TWO_BIFURCATIONS, &[("analysis.step", step)]);
        assert!(matches!(report.end, PathEnd::Reached), "{:?}", report.end);
        let found: Vec<_> = report.critical.iter().map(|point| (point.kind, point.unstable)).collect();
        let kind = CriticalKind::Bifurcation;
        assert_eq!(found, [(kind, [0, 1]), (kind, [1, 2])], "step {step}: {:?}", report.critical);
        for (point, exact) in report.critical.iter().zip([122.3717, 194.8607]) {
            assert!(point.is_located, "{point:?}");
            near(point.load_factor, exact, 1e-6);
        }
    }
}

#[test]
fn an_imperfect_bifurcation_is_passed_on_the_connected_path() {
    for step in ["0.02", "0.05", "0.1", "0.2"] {
        let (_, report) = follow(IMPERFECT, &[("analysis.step", step)]);
        assert!(matches!(report.end, PathEnd::Reached), "{:?}", report.end);
        let factors: Vec<f64> = report.critical.iter().map(|point| point.load_factor).collect();
        assert!(report.critical.iter().all(|point| point.kind == CriticalKind::Limit), "{factors:?}");
        assert_eq!(factors.len(), 2, "step {step}: {factors:?}");
        near(factors[0], 0.170_86, 1e-4);
        near(factors[1], -0.136_85, 1e-4);
    }
}

fn derivatives(text: &str, of: &str, by: &[&str]) -> GradientReport {
    let target: Target = of.parse().unwrap();
    let paths: Vec<String> = by.iter().map(|&path| path.to_owned()).collect();
    gradient(&Model::from_text("model.toml", text), &target, &paths, true)
        .unwrap_or_else(|error| panic!("{error}"))
}

#[test]
fn derivatives_through_a_stop_see_when_it_is_met() {
    // Met at 1/v, and left π √(m/k) later with the velocity reversed: x = 2 - v t + π v √(m/k).
    let found = derivatives(STOP, "s.displacement", &["parameters.k", "parameters.v", "parameters.m"]);
    let half_period = std::f64::consts::PI * 0.02_f64.sqrt();
    let exact = [-0.5 * half_period / 100.0, -2.0 + half_period, 0.5 * half_period / 2.0];
    for (derivative, exact) in found.derivatives.iter().zip(exact) {
        near(derivative.value, exact, 1e-5);
        assert_eq!(derivative.method, Method::Runs);
    }
    assert!(matches!(found.confirmation, Some(Confirmation::Confirmed { .. })), "{found:?}");
    // Before the stop is met nothing switches.
    let free = derivatives(STOP, "s.displacement@0.8", &["parameters.v"]);
    near(free.derivatives[0].value, 0.8, 1e-9);
    assert_ne!(free.derivatives[0].method, Method::Runs);
}

#[test]
fn derivatives_through_one_sided_springs_and_free_play_see_when_they_switch() {
    let moving = |spring: &str, start: f64| {
        format!(
            "lissom = 1\n[parameters]\nk = 100\nv = 1\n[bodies.m]\nmass = 2\ninertia = [1, 1, 1]\nvelocity = [\"v\", 0, 0]\n\
             [joints.s]\nkind = \"prismatic\"\nbase = \"ground\"\ntip = \"m\"\nat = [0, 0, 0]\naxis = [1, 0, 0]\n\
             [springs.k]\nkind = \"axial\"\njoint = \"s\"\nstiffness = \"k\"\n{spring}\ndisplacement = {start}\n\
             [outputs.s]\nkind = \"relative\"\nof = \"s\"\n[analysis]\nkind = \"dynamics\"\nend = 2\n"
        )
    };
    let half_period = std::f64::consts::PI * 0.02_f64.sqrt();
    // The gap is 1 for the spring in tension, half of the width for free play: met at 1/v as before.
    for text in [moving("side = \"tension\"", 1.0), moving("backlash = 2", 0.0)] {
        let found = derivatives(&text, "s.displacement", &["parameters.k", "parameters.v"]);
        near(found.derivatives[0].value, -0.5 * half_period / 100.0, 1e-5);
        near(found.derivatives[1].value, -2.0 + half_period, 1e-5);
    }
}

fn warnings_of(text: &str) -> (Vec<String>, bool) {
    let document = Model::from_text("model.toml", text).document().unwrap_or_else(|error| panic!("{error}"));
    let mut session = Session::new(&document).unwrap_or_else(|error| panic!("{error}"));
    let (_, report) = session.run().unwrap_or_else(lissom::Results::from).into_parts();
    let words = session.simulation().warnings().iter().map(|warning| warning.code().to_owned()).collect();
    (words, report.error().is_none())
}

#[test]
fn released_prestress_is_no_jump() {
    let (codes, is_done) = warnings_of(GUYED_MAST);
    assert!(is_done && !codes.iter().any(|code| code == "jump"), "{codes:?}");
}

#[test]
fn a_slack_cable_is_decided_quickly() {
    let document = Model::from_text("model.toml", SLACK_CABLE).document().unwrap();
    let mut session = Session::new(&document).unwrap();
    let (_, report) = session.run().unwrap_or_else(lissom::Results::from).into_parts();
    let iterations = session.simulation().totals().newton_iterations;
    assert!(iterations < 3000, "{iterations} iterations, {:?}", report.error());
}

#[test]
fn an_arc_has_a_default_up_that_it_does_not_run_along() {
    let text = SLACK_CABLE.replace("up=[0,1,0]\n", "");
    assert_ne!(text, SLACK_CABLE);
    let document = Model::from_text("model.toml", &text).document().unwrap();
    assert!(Session::new(&document).is_ok());
    let flipped = SLACK_CABLE.replace("up=[0,1,0]", "up=[0,0,1]");
    let error = Model::from_text("model.toml", &flipped).document().unwrap_err().render(false);
    assert!(error.contains("`up`") && error.contains("would reverse"), "{error}");
}

#[test]
fn velocities_of_round_off_are_no_contradiction() {
    let held = |speed: &str| {
        format!(
            "lissom = 1\n[bodies.a]\nmass = 1\ninertia = [0.1, 0.1, 0.1]\nvelocity = [{speed}, 0, 0]\n\
             [bodies.b]\nmass = 1\ninertia = [0.1, 0.1, 0.1]\nposition = [1, 0, 0]\nvelocity = [{speed}, {speed}, 0]\n\
             [joints.j]\nkind = \"clamp\"\nbase = \"ground\"\ntip = \"a\"\n\
             [joints.k]\nkind = \"clamp\"\nbase = \"a\"\ntip = \"b\"\n[analysis]\nkind = \"dynamics\"\nend = 0.1\n"
        )
    };
    for speed in ["1e-30", "1e-17", "-3e-16"] {
        let (codes, is_done) = warnings_of(&held(speed));
        assert!(is_done && codes.is_empty(), "{speed}: {codes:?}");
    }
    let document = Model::from_text("model.toml", &held("1")).document().unwrap();
    let error = Session::new(&document).err().expect("entirely prevented").to_string();
    assert!(error.contains("initial velocity") && !error.contains("drives prescribe"), "{error}");
}
