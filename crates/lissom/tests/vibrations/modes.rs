//! Natural modes against closed forms.

use std::f64::consts::{PI, TAU};
use std::fmt::Write;

use lissom::AnalysisWarning;
use lissom::Model;
use lissom::analyses::modes::{ModeReport, ModeRequest, ModesError, OperatingPoint, modes};
use lissom_core::linearized::{Completeness, ModeKind};

use crate::support::paths::near;

fn find(text: &str, about: OperatingPoint, count: usize) -> ModeReport {
    try_find(text, about, count).unwrap_or_else(|error| panic!("{error}"))
}

fn try_find(text: &str, about: OperatingPoint, count: usize) -> Result<ModeReport, ModesError> {
    let request = ModeRequest { count: Some(count), about: Some(about), ..ModeRequest::default() };
    modes(&Model::from_text("model.toml", text), &request)
}

fn frequencies(report: &ModeReport) -> Vec<f64> {
    report.modes.iter().map(|mode| mode.frequency).collect()
}

/// A beam of unit length and mass per length 1, bent about two axes of different stiffness.
fn beam(elements: usize, order: usize, rest: &str) -> String {
    format!(
        r#"
lissom = 1
[sections.bar]
shape = "general"
stiffness = [1e6, 4e4, 4e4, 300, 100, 150]
mass = {{ per_length = 1, inertia = [2e-3, 1e-3, 1e-3] }}
[beams.bar]
section = "bar"
from = [0, 0, 0]
to = [1, 0, 0]
up = [0, 0, 1]
elements = {elements}
order = {order}
{rest}
[analysis]
kind = "modes"
"#
    )
}

const CLAMP: &str = "[joints.root]\nkind = \"clamp\"\nbase = \"ground\"\ntip = \"bar.start\"";

type Matrix = [[f64; 4]; 4];

fn times(a: &Matrix, b: &Matrix) -> Matrix {
    std::array::from_fn(|i| std::array::from_fn(|j| (0..4).map(|k| a[i][k] * b[k][j]).sum()))
}

/// What is left at the free end of a Timoshenko cantilever at an angular frequency: zero at the natural ones.
fn cantilever_determinant(omega: f64, (shear, bending, inertia): (f64, f64, f64)) -> f64 {
    // (w, θ, M, Q): w' = θ + Q/GA, θ' = M/EI, M' = -Q - ω²J θ, Q' = -ω² w.
    let square = omega * omega;
    let steps = 64;
    let part = 1.0 / f64::from(steps);
    let rates = [
        [0.0, part, 0.0, part / shear],
        [0.0, 0.0, part / bending, 0.0],
        [0.0, -square * inertia * part, 0.0, -part],
        [-square * part, 0.0, 0.0, 0.0],
    ];
    let identity: Matrix = std::array::from_fn(|i| std::array::from_fn(|j| f64::from(u8::from(i == j))));
    let (mut exponential, mut term) = (identity, identity);
    for k in 1..20 {
        term = times(&term, &rates);
        term.iter_mut().flatten().for_each(|value| *value /= f64::from(k));
        for (sum, add) in exponential.iter_mut().flatten().zip(term.iter().flatten()) {
            *sum += add;
        }
    }
    let whole = (0..steps).fold(identity, |sum, _| times(&exponential, &sum));
    whole[2][2] * whole[3][3] - whole[2][3] * whole[3][2]
}

fn cantilever_frequencies(section: (f64, f64, f64), count: usize) -> Vec<f64> {
    let mut roots = Vec::new();
    let mut omega = 1.0;
    while roots.len() < count {
        let (mut low, mut high) = (omega, omega + 1.0);
        let at = |omega: f64| cantilever_determinant(omega, section);
        if at(low) * at(high) < 0.0 {
            for _ in 0..60 {
                let middle = 0.5 * (low + high);
                if at(low) * at(middle) <= 0.0 { high = middle } else { low = middle }
            }
            roots.push(low / TAU);
        }
        omega += 1.0;
    }
    roots
}

#[test]
fn a_timoshenko_cantilever_has_its_frequencies() {
    let report = find(&beam(32, 3, CLAMP), OperatingPoint::Undeformed, 8);
    assert_eq!(report.completeness, Completeness::Counted);
    let mut exact = cantilever_frequencies((4e4, 100.0, 1e-3), 5);
    exact.extend(cantilever_frequencies((4e4, 150.0, 1e-3), 5));
    // Torsion: (2k - 1)/4 √(GJ/J), extension likewise.
    exact.extend((0..3).map(|k| f64::from(2 * k + 1) / 4.0 * (300.0_f64 / 2e-3).sqrt()));
    exact.extend((0..3).map(|k| f64::from(2 * k + 1) / 4.0 * 1e6_f64.sqrt()));
    exact.sort_by(f64::total_cmp);
    for (mode, exact) in report.modes.iter().zip(&exact) {
        near(mode.frequency, *exact, 1e-8);
        assert_eq!((mode.kind, mode.damping), (ModeKind::Oscillation, 0.0));
        assert!(mode.residual < 1e-8);
    }
}

#[test]
fn frequencies_converge_in_the_order_of_the_elements() {
    let exact = cantilever_frequencies((4e4, 100.0, 1e-3), 1)[0];
    for (order, expected) in [(1, 2.0), (2, 4.0), (3, 6.0)] {
        let errors = [4, 8].map(|elements| {
            (find(&beam(elements, order, CLAMP), OperatingPoint::Static, 1).modes[0].frequency / exact - 1.0)
                .abs()
        });
        let seen = (errors[0] / errors[1]).log2();
        assert!(seen > expected - 0.3, "order {order}: errors {errors:?}, order {seen}");
    }
}

#[test]
fn a_slender_cantilever_is_that_of_euler_and_bernoulli() {
    let text = beam(12, 3, CLAMP)
        .replace("[1e6, 4e4, 4e4, 300, 100, 150]", "[1e9, 1e9, 1e9, 300, 100, 100]")
        .replace("[2e-3, 1e-3, 1e-3]", "[2e-9, 1e-9, 1e-9]");
    let report = find(&text, OperatingPoint::Undeformed, 4);
    for (pair, root) in report.modes.chunks(2).zip([1.875_104_068_711_961_f64, 4.694_091_132_974_175]) {
        for mode in pair {
            near(mode.frequency, root.powi(2) * 10.0 / TAU, 2e-6);
        }
    }
}

#[test]
fn a_free_beam_has_six_rigid_modes() {
    let report = find(&beam(10, 3, ""), OperatingPoint::Static, 12);
    assert_eq!(report.completeness, Completeness::Counted);
    for mode in &report.modes[..6] {
        assert_eq!((mode.kind, mode.frequency, mode.damping), (ModeKind::Rigid, 0.0, 0.0));
    }
    for mode in &report.modes[6..] {
        assert_eq!(mode.kind, ModeKind::Oscillation);
    }
    // In the limit of a slender beam 22.3733 √(EI/(ρ A L⁴)); shear and rotary inertia lower it.
    let lowest = report.modes[6].frequency * TAU / 10.0;
    assert!((20.5..22.3733).contains(&lowest), "{lowest}");
}

fn pendulum(joint: &str, position: &str, rest: &str) -> String {
    format!(
        r#"
lissom = 1
gravity = [0, 0, -9.81]
[bodies.bob]
mass = 2.0
inertia = [0.1, 0.1, 0.03]
{position}
[joints.pivot]
base = "ground"
tip = "bob"
at = [0, 0, 0]
{joint}
{rest}
"#
    )
}

const REVOLUTE: &str = "kind = \"revolute\"\naxis = [0, 1, 0]";
const MODES: &str = "[analysis]\nkind = \"modes\"";

#[test]
fn a_pendulum_swings_by_the_preload_of_its_pivot() {
    let exact = (2.0_f64 * 9.81 * 0.7 / (0.1 + 2.0 * 0.49)).sqrt() / TAU;
    let report = find(&pendulum(REVOLUTE, "position = [0, 0, -0.7]", MODES), OperatingPoint::Static, 1);
    near(report.modes[0].frequency, exact, 1e-10);
    assert_eq!(report.completeness, Completeness::Counted);
    // Two swings, and a turn about its own axis.
    let report =
        find(&pendulum("kind = \"spherical\"", "position = [0, 0, -0.7]", MODES), OperatingPoint::Static, 5);
    assert_eq!(report.modes.len(), 3);
    assert_eq!(report.modes[0].kind, ModeKind::Rigid);
    near(report.modes[1].frequency, exact, 1e-10);
    near(report.modes[2].frequency, exact, 1e-10);
    // Without gravity nothing brings it back.
    let report = find(&pendulum(REVOLUTE, "position = [0, 0, -0.7]", MODES), OperatingPoint::Undeformed, 1);
    assert_eq!(report.modes[0].kind, ModeKind::Rigid);
}

#[test]
fn equilibrium_is_found_before_modes_are() {
    let spring = "[springs.s]\nkind = \"torsional\"\njoint = \"pivot\"\nstiffness = 100.0\n";
    let report = find(
        &pendulum(REVOLUTE, "position = [0.7, 0, 0]", &format!("{spring}{MODES}")),
        OperatingPoint::Static,
        1,
    );
    // k φ = m g ℓ cos φ below the horizontal, then k + m g ℓ sin φ.
    let weight = 2.0 * 9.81 * 0.7;
    let mut angle = 0.1_f64;
    for _ in 0..50 {
        angle -= (100.0 * angle - weight * angle.cos()) / (100.0 + weight * angle.sin());
    }
    near(report.modes[0].frequency, ((100.0 + weight * angle.sin()) / 1.08).sqrt() / TAU, 1e-9);
}

#[test]
fn an_unstable_equilibrium_is_reported() {
    let report = find(&pendulum(REVOLUTE, "position = [0, 0, 0.7]", MODES), OperatingPoint::Static, 1);
    assert_eq!((report.modes[0].kind, report.modes[0].damping), (ModeKind::Divergence, -1.0));
    near(report.modes[0].frequency, (2.0_f64 * 9.81 * 0.7 / 1.08).sqrt() / TAU, 1e-10);
    assert!(report.warnings[0].code() == "unstable-state", "{:?}", report.warnings);
}

/// Two masses on a line, springs from the ground to the first and from there to the second.
fn two_masses(damping: [f64; 2]) -> String {
    format!(
        r#"
lissom = 1
[bodies.a]
mass = 2.0
inertia = [1, 1, 1]
[bodies.b]
mass = 3.0
inertia = [1, 1, 1]
position = [1, 0, 0]
[joints.first]
kind = "prismatic"
base = "ground"
tip = "a"
axis = [1, 0, 0]
[joints.second]
kind = "prismatic"
base = "a"
tip = "b"
axis = [1, 0, 0]
[springs.first]
kind = "axial"
joint = "first"
stiffness = 500.0
damping = {}
[springs.second]
kind = "axial"
joint = "second"
stiffness = 800.0
damping = {}
{MODES}
"#,
        damping[0], damping[1]
    )
}

#[test]
fn two_masses_swing_as_they_must() {
    let report = find(&two_masses([0.0, 0.0]), OperatingPoint::Static, 20);
    assert_eq!((report.modes.len(), report.asked, report.completeness), (2, 20, Completeness::Counted));
    // 6 λ² - (2·800 + 3·1300) λ + 500·800 = 0
    let root = (5500.0_f64.powi(2) - 4.0 * 6.0 * 4e5).sqrt();
    for (mode, square) in report.modes.iter().zip([(5500.0 - root) / 12.0, (5500.0 + root) / 12.0]) {
        near(mode.frequency, square.sqrt() / TAU, 1e-11);
    }
    // The shape of the first: (k₁ + k₂ - m₁λ) u₁ = k₂ u₂.
    let shape = &report.shapes[0];
    let ratio = shape[0].displacement[0].re / shape[1].displacement[0].re;
    near(ratio, 800.0 / (1300.0 - 2.0 * (5500.0 - root) / 12.0), 1e-9);
    let share: f64 = report.shares[0].values().sum();
    near(share, 1.0, 1e-12);
    near(report.shares[0]["a"], 2.0 * ratio * ratio / (2.0 * ratio * ratio + 3.0), 1e-9);
}

#[test]
fn damping_in_proportion_has_its_ratios() {
    // C = β K: ζ = β ω/2.
    let beta = 0.002;
    let report = find(&two_masses([500.0 * beta, 800.0 * beta]), OperatingPoint::Static, 20);
    assert_eq!((report.modes.len(), report.completeness), (2, Completeness::NotCounted));
    let root = (5500.0_f64.powi(2) - 4.0 * 6.0 * 4e5).sqrt();
    for (mode, square) in report.modes.iter().zip([(5500.0 - root) / 12.0, (5500.0 + root) / 12.0]) {
        near(mode.frequency, square.sqrt() / TAU, 1e-9);
        near(mode.damping, 0.5 * beta * square.sqrt(), 1e-8);
        assert_eq!(mode.kind, ModeKind::Oscillation);
    }
}

#[test]
fn overdamped_motion_decays() {
    let spring = "[springs.s]\nkind = \"torsional\"\njoint = \"pivot\"\nstiffness = 10.0\ndamping = 20.0\n";
    let text = pendulum(REVOLUTE, "position = [0, 0, -0.7]", &format!("{spring}{MODES}"));
    let report = find(&text, OperatingPoint::Undeformed, 4);
    // 1.08 s² + 20 s + 10 = 0
    let root = (400.0_f64 - 43.2).sqrt();
    assert_eq!(report.modes.len(), 2);
    for (mode, exact) in report.modes.iter().zip([(20.0 - root) / 2.16, (20.0 + root) / 2.16]) {
        near(mode.frequency, exact / TAU, 1e-8);
        assert_eq!((mode.kind, mode.damping), (ModeKind::Decay, 1.0));
    }
}

#[test]
fn a_string_is_tuned_by_its_tension() {
    let rest = r#"
[joints.left]
kind = "revolute"
base = "ground"
tip = "bar.start"
axis = [0, 0, 1]
[bodies.slider]
mass = 1e-3
inertia = [1e-3, 1e-3, 1e-3]
position = [1, 0, 0]
[joints.rail]
kind = "prismatic"
base = "ground"
tip = "slider"
axis = [1, 0, 0]
[joints.right]
kind = "revolute"
base = "slider"
tip = "bar.end"
axis = [0, 0, 1]
[loads.pull]
kind = "force"
on = "slider"
vector = [2000, 0, 0]
scale = "t"
"#;
    let text = beam(12, 3, rest)
        .replace("[1e6, 4e4, 4e4, 300, 100, 150]", "[1e9, 1e9, 1e9, 1e6, 1e6, 10]")
        .replace("[2e-3, 1e-3, 1e-3]", "[2e-8, 1e-8, 1e-8]")
        .replace("kind = \"modes\"", "kind = \"statics\"\nend = 1\nsteps = 2");
    for (about, tension) in [(OperatingPoint::Static, 2000.0), (OperatingPoint::Time(0.5), 1000.0)] {
        let report = find(&text, about, 3);
        for (n, mode) in (1..).map(f64::from).zip(&report.modes) {
            let number = n * PI;
            let exact = (number.powi(2) * (tension + 10.0 * number.powi(2))).sqrt() / TAU;
            near(mode.frequency, exact, 1e-5);
        }
    }
    // Without the tension only bending is left.
    near(
        find(&text, OperatingPoint::Undeformed, 1).modes[0].frequency,
        PI.powi(2) * 10.0_f64.sqrt() / TAU,
        1e-5,
    );
}

#[test]
fn a_spinning_body_nutates() {
    let text = r#"
lissom = 1
[bodies.rotor]
mass = 1.0
inertia = [1.0, 1.0, 1.6]
angular_velocity = [0, 0, 10]
[joints.pivot]
kind = "spherical"
base = "ground"
tip = "rotor"
[analysis]
kind = "dynamics"
end = 1
step = 1e-3
"#;
    let report = find(text, OperatingPoint::Time(0.0), 3);
    assert!(report.warnings.is_empty(), "the spin is steady: {:?}", report.warnings);
    assert_eq!(report.modes[0].kind, ModeKind::Rigid);
    // In its own axes: nutation at (I₃/I₁ - 1) Ω, and a tilt that stays where it is turns by at Ω.
    near(report.modes[1].frequency, 6.0 / TAU, 1e-7);
    near(report.modes[2].frequency, 10.0 / TAU, 1e-7);
}

#[test]
fn modes_near_a_frequency_are_those_of_the_whole_list() {
    let text = beam(12, 3, CLAMP);
    let all = frequencies(&find(&text, OperatingPoint::Undeformed, 30));
    let request = ModeRequest {
        count: Some(4),
        about: Some(OperatingPoint::Undeformed),
        shift: Some(all[14] * 1.001),
        ..ModeRequest::default()
    };
    let some = modes(&Model::from_text("model.toml", &text), &request).unwrap();
    assert_eq!(some.completeness, Completeness::Counted);
    let mut nearest = all.clone();
    nearest.sort_by(|a, b| {
        let distance = |f: &f64| (f * f - (all[14] * 1.001).powi(2)).abs();
        distance(a).total_cmp(&distance(b))
    });
    nearest.truncate(4);
    nearest.sort_by(f64::total_cmp);
    for (found, exact) in frequencies(&some).iter().zip(nearest) {
        near(*found, exact, 1e-9);
    }
}

#[test]
fn what_means_nothing_is_refused() {
    let text =
        pendulum(REVOLUTE, "position = [0.7, 0, 0]", "[analysis]\nkind = \"dynamics\"\nend = 1\nstep = 0.01");
    // Released level: about to fall.
    assert!(matches!(
        try_find(&text, OperatingPoint::Time(0.0), 1),
        Err(ModesError::NotInEquilibrium { .. })
    ));
    assert!(matches!(try_find(&text, OperatingPoint::Time(2.0), 1), Err(ModesError::Time { .. })));
    assert!(matches!(
        try_find(&two_masses([0.0; 2]), OperatingPoint::Time(0.5), 1),
        Err(ModesError::Time { .. })
    ));
    // Swinging: a warning reports that coefficients are frozen.
    let report = find(&text, OperatingPoint::Time(0.3), 1);
    assert!(report.warnings[0].code() == "frozen-coefficients", "{:?}", report.warnings);
}

/// A planar four-bar of parallel revolutes on a spring: three of its constraints repeat others.
fn four_bar() -> String {
    let revolute = |name: &str, base: &str, tip: &str, at: &str| {
        format!(
            "[joints.{name}]\nkind = \"revolute\"\nbase = \"{base}\"\ntip = \"{tip}\"\nat = {at}\naxis = [0, 0, 1]\n"
        )
    };
    let body = |name: &str, position: &str| {
        format!("[bodies.{name}]\nmass = 1.5\ninertia = [0.01, 0.02, 0.02]\nposition = {position}\n")
    };
    [
        "lissom = 1\n".to_owned(),
        body("crank", "[0, 0.5, 0]"),
        body("coupler", "[1, 1, 0]"),
        body("rocker", "[2, 0.5, 0]"),
        revolute("A", "ground", "crank", "[0, 0, 0]"),
        revolute("B", "crank", "coupler", "[0, 1, 0]"),
        revolute("C", "coupler", "rocker", "[2, 1, 0]"),
        revolute("D", "ground", "rocker", "[2, 0, 0]"),
        "[springs.s]\nkind = \"torsional\"\njoint = \"A\"\nstiffness = 50.0\n".to_owned(),
        MODES.to_owned(),
    ]
    .concat()
}

#[test]
fn redundant_constraints_leave_the_modes_there_are() {
    // A parallelogram: crank and rocker turn by φ, the coupler moves with the crank's end.
    let inertia = 2.0 * (0.02 + 1.5 * 0.25) + 1.5;
    let exact = (50.0_f64 / inertia).sqrt();
    let report = find(&four_bar(), OperatingPoint::Static, 10);
    assert_eq!(
        (report.modes.len(), report.completeness),
        (1, Completeness::Counted),
        "{:?}",
        frequencies(&report)
    );
    near(report.modes[0].frequency, exact / TAU, 1e-9);
    // With a damper: I φ̈ + 2 φ̇ + 50 φ = 0.
    let damped = find(
        &four_bar().replace("stiffness = 50.0", "stiffness = 50.0\ndamping = 2.0"),
        OperatingPoint::Static,
        10,
    );
    assert_eq!(damped.modes.len(), 1, "{:?}", frequencies(&damped));
    near(damped.modes[0].frequency, exact / TAU, 1e-9);
    near(damped.modes[0].damping, 1.0 / (50.0 * inertia).sqrt(), 1e-8);
}

#[test]
fn a_mechanism_that_is_driven_has_no_modes() {
    let drive = "[joints.drive]\nkind = \"prescribed_rotation\"\njoint = \"pivot\"\nrotation = 0.0\n";
    let report = find(
        &pendulum(REVOLUTE, "position = [0, 0, -0.7]", &format!("{drive}{MODES}")),
        OperatingPoint::Static,
        3,
    );
    assert_eq!(report.modes.len(), 0);
}

/// A rotor that turns freely: hub, disc on a cross of two axes with springs, both without anything that holds their rotation.
const FREE_ROTOR: &str = concat!(
    "lissom = 1\n",
    include_str!("../support/rotor.toml"),
    "stiffness = 3000\n[analysis]\nkind = \"modes\"\n"
);

#[test]
fn a_rotor_that_turns_freely_has_a_rigid_mode_and_all_others() {
    // About the cross the disc has 0.15 + 5·0.3² in both directions; the rotation strains nothing at all.
    let across = 0.15 + 5.0 * 0.09;
    let exact = [2000.0_f64, 3000.0].map(|stiffness| (stiffness / across).sqrt() / std::f64::consts::TAU);
    // Masses and inertias of the hub that let the shift fall on the rigid mode, each in its way.
    for (mass, inertia) in [(1.0, 0.1), (0.01, 0.1), (1.0, 1.0), (10.0, 1e-3), (1e-3, 1e-6)] {
        let text = FREE_ROTOR.replace(
            "mass = 1\ninertia = [0.1, 0.1, 0.1]",
            &format!("mass = {mass:?}\ninertia = [{inertia:?}, {inertia:?}, {inertia:?}]"),
        );
        let found = modes(&Model::from_text("model.toml", &text), &ModeRequest::default())
            .unwrap_or_else(|error| panic!("hub of {mass} kg and {inertia} kg m²: {error}"));
        let frequencies: Vec<f64> = found.modes.iter().map(|mode| mode.frequency).collect();
        assert_eq!(frequencies.len(), 3, "hub of {mass} kg and {inertia} kg m²: {frequencies:?}");
        assert_eq!(frequencies[0], 0.0);
        for (found, exact) in frequencies[1..].iter().zip(exact) {
            assert!((found / exact - 1.0).abs() < 1e-9, "{found} for {exact}");
        }
    }
}

#[test]
fn frequencies_that_come_several_times_are_counted_whole_wherever_the_count_cuts_them() {
    // Clamped beams side by side, each as stiff about both axes of its section: 2, 6 and 10 equal frequencies.
    for (beams, counts) in [(1, 1..=5), (3, 3..=3), (5, 2..=3)] {
        let mut text = "lissom = 1\n[analysis]\nkind = \"modes\"\n[sections.tube]\nshape = \"general\"\n\
            stiffness = [1e6, 4e4, 4e4, 300, 100, 100]\nmass = { per_length = 1, inertia = [2e-3, 1e-3, 1e-3] }\n"
            .to_owned();
        for k in 0..beams {
            // Writing to a string cannot fail.
            let _ = write!(
                text,
                "[beams.b{k}]\nsection = \"tube\"\nfrom = [0, {k}, 0]\nto = [1, {k}, 0]\nelements = 3\n\
                [joints.j{k}]\nkind = \"clamp\"\nbase = \"ground\"\ntip = \"b{k}.start\"\n"
            );
        }
        for count in counts {
            let report = find(&text, OperatingPoint::Static, count);
            assert_eq!(report.completeness, Completeness::Counted, "{count} of {beams}");
            assert!(report.warnings.is_empty(), "{:?}", report.warnings);
            let found = frequencies(&report);
            assert_eq!(found.len(), count);
            let same = count.min(2 * beams);
            near(found[same - 1], found[0], 1e-7);
            near(found[0], 1.875_104_f64.powi(2) * 10.0 / TAU, 0.02);
            assert!(found.get(same).is_none_or(|next| *next > 4.0 * found[0]), "{found:?}");
        }
    }
}

/// More than there are: all that there are, and a warning; what nobody asked for is no matter.
#[test]
fn fewer_modes_than_asked_for_are_reported() {
    let text = beam(1, 1, CLAMP);
    let reported = |count: Option<usize>| {
        let request =
            ModeRequest { count, about: Some(OperatingPoint::Undeformed), ..ModeRequest::default() };
        let report = modes(&Model::from_text("model.toml", &text), &request).unwrap();
        (report.modes.len(), report.warnings)
    };
    let fewer = AnalysisWarning::FewerModes { wanted: 50, evidence: "the model has", found: 6 };
    assert_eq!(reported(Some(50)), (6, vec![fewer]));
    assert_eq!(reported(Some(6)), (6, Vec::new()));
    assert_eq!(reported(None), (6, Vec::new()));
}

/// A free part that a load accelerates has no equilibrium: its modes are those without loads, and the load is named.
#[test]
fn a_free_part_under_a_load_has_the_modes_of_the_unloaded_one() {
    let load = "[loads.turn]\nkind = \"moment\"\non = \"bar.end\"\nvector = [0, 10, 0]\n";
    let report = find(&beam(4, 3, load), OperatingPoint::Static, 8);
    let [AnalysisWarning::NoEquilibrium { part, load }] = &report.warnings[..] else {
        panic!("{:?}", report.warnings)
    };
    assert_eq!((part.as_str(), load.as_str()), ("bar", "`turn`"));
    let causes = [("force_per_length = [0, 0, 3]", "its distributed loads"), ("", "gravity")];
    for (keys, wanted) in causes {
        let text = beam(4, 3, keys);
        let text = if keys.is_empty() {
            text.replace("lissom = 1", "lissom = 1\ngravity = [0, 0, -9.81]")
        } else {
            text
        };
        let report = find(&text, OperatingPoint::Static, 8);
        assert!(report.warnings.iter().any(|own| own.to_string().contains(wanted)), "{:?}", report.warnings);
    }
    let unloaded = find(&beam(4, 3, ""), OperatingPoint::Static, 8);
    assert!(unloaded.warnings.is_empty());
    assert_eq!(frequencies(&report), frequencies(&unloaded));
}

/// States of a controller decay slower than the motion, and do not count as requested.
#[test]
fn decays_of_states_are_found_besides() {
    let states = |k: u32| format!("[states.s{k}]\nderivative = \"-0.0{k}*s{k}\"\nstart = 0\n");
    let text = r#"
lissom = 1
[bodies.a]
mass = 1
inertia = [1, 1, 1]
[joints.j]
kind = "prismatic"
base = "ground"
tip = "a"
axis = [1, 0, 0]
[springs.k]
kind = "coordinate_dynamics"
coordinates = ["j.displacement"]
stiffness = 100
damping = 0.1
[analysis]
kind = "modes"
"#;
    let text = text.to_owned() + &(1..=6).map(states).collect::<String>();
    let found = frequencies(&find(&text, OperatingPoint::Static, 1));
    let oscillations: Vec<f64> = found.iter().copied().filter(|frequency| *frequency > 1.0).collect();
    assert!(oscillations.len() == 1 && (oscillations[0] - 10.0 / TAU).abs() < 1e-9, "{found:?}");
}
