//! Stops, friction in joints, bushings, rotors and solids, against closed forms.

use crate::support::on_one_line::refused_on_one_line as refused;
use crate::support::sessions;

use lissom::{Model, Session};
use lissom_motion::{Rotation, Vector3};
use sessions::{finished, session};

const SCHEMES: [&str; 5] = ["radau-iia", "radau-iia-5", "energy-decaying", "generalized-alpha", "hht"];

/// A column of a whole run, with its times.
fn column(text: &str, output: &str, component: &str) -> (Vec<f64>, Vec<f64>) {
    let mut session = session(text);
    let record = session.run().unwrap();
    (record.times.clone(), record.column(output, component).unwrap().to_vec())
}

/// A block that meets a stop with 1 m/s. Beside it a spring so weak that nobody sees it: Newton's method is slow where a
/// coordinate feels no force.
const BOUNCE: &str = r#"
lissom = 1
[bodies.block]
mass = 2
inertia = { box = [0.1, 0.1, 0.1] }
velocity = [-1, 0, 0]
[joints.slide]
kind = "prismatic"
base = "ground"
tip = "block"
axis = [1, 0, 0]
[springs.stop]
kind = "axial_stop"
joint = "slide"
range = [-0.05, inf]
STOP
[springs.weak]
kind = "axial"
joint = "slide"
stiffness = 1e-2
[outputs.slide]
kind = "relative"
of = "slide"
[outputs.stop]
kind = "spring"
of = "stop"
[analysis]
kind = "dynamics"
end = 0.08
ANALYSIS
"#;

fn bounce(stop: &str, analysis: &str) -> String {
    BOUNCE.replace("STOP", stop).replace("ANALYSIS", analysis)
}

#[test]
fn an_impact_has_the_restitution_asked_for() {
    for (law, restitution) in [
        ("stiffness = 1e6\nrestitution = 0.7\nimpact_velocity = 1", 0.7),
        ("stiffness = 1e8\nexponent = 1.5\nrestitution = 0.5\nimpact_velocity = 1", 0.5),
        ("stiffness = 1e6", 1.0),
    ] {
        for scheme in SCHEMES {
            for steps in ["step = 1e-4", "relative_tolerance = 1e-6"] {
                let run = finished(&bounce(law, &format!("scheme = \"{scheme}\"\n{steps}")));
                let found = run.value("slide.velocity").unwrap();
                assert!((found / restitution - 1.0).abs() < 3e-3, "{law}, {scheme}, {steps}: {found}");
            }
        }
    }
    let (_, forces) = column(&bounce("stiffness = 1e6\ndissipation = 3", "step = 1e-4"), "stop", "force");
    assert!(forces.iter().all(|force| *force <= 0.0), "a stop never pulls");
    assert!(forces.iter().any(|force| *force < -500.0));
}

/// A mass on a linear spring and damper that never pulls: contact ends where the force vanishes, at ω_d t = π - 2 asin ζ, and
/// e = exp(-ζ/√(1 - ζ²) (π - 2 asin ζ)).
#[test]
fn an_impact_on_a_damped_stop_has_the_restitution_of_the_linear_oscillator() {
    for ratio in [0.05_f64, 0.2, 0.6] {
        let damping = 2.0 * ratio * (2.0_f64 * 1e6).sqrt();
        let decay = ratio / (1.0 - ratio * ratio).sqrt();
        let restitution = (-decay * (std::f64::consts::PI - 2.0 * ratio.asin())).exp();
        for scheme in SCHEMES {
            for steps in ["step = 2e-5", "relative_tolerance = 1e-6"] {
                let law = format!("stiffness = 1e6\ndamping = {damping}");
                let run = finished(&bounce(&law, &format!("scheme = \"{scheme}\"\n{steps}")));
                let found = run.value("slide.velocity").unwrap();
                assert!(
                    (found / restitution - 1.0).abs() < 1e-2,
                    "{ratio}, {scheme}, {steps}: {found} {restitution}"
                );
            }
        }
    }
    let (_, forces) = column(&bounce("stiffness = 1e6\ndamping = 500", "step = 2e-5"), "stop", "force");
    assert!(forces.iter().all(|force| *force <= 0.0), "a stop never pulls");
    let both = refused(&bounce(
        "stiffness = 1e6\ndamping = 5\nrestitution = 0.5\nimpact_velocity = 1",
        "step = 1e-4",
    ));
    assert!(both.contains("and `restitution` are alternatives"), "{both}");
}

/// With steps of given size a stiff contact may be over before anybody looks: Radau IIA then keeps a fraction of the velocity.
#[test]
fn a_contact_that_steps_do_not_resolve_is_reported() {
    let is_reported = |run: &Session| {
        run.simulation().warnings().iter().any(|warning| warning.code() == "contact-too-short")
    };
    let (mut reported, mut lost) = (0, 0);
    for scheme in SCHEMES {
        for stiffness in ["1e5", "1e6", "1e7", "1e8", "1e9"] {
            for step in ["1.1e-3", "3e-4", "1e-4", "3.3e-5", "1e-5"] {
                let analysis = format!("scheme = \"{scheme}\"\nstep = {step}\nenergy_check = false");
                let run = finished(&bounce(&format!("stiffness = {stiffness}"), &analysis));
                let error = (run.value("slide.velocity").unwrap() - 1.0).abs();
                reported += usize::from(is_reported(&run));
                lost += usize::from(error > 0.1);
                assert!(error < 0.05 || is_reported(&run), "{scheme}, {stiffness} N/m, {step} s: {error:.3}");
                // A contact of 31 steps: no warning.
                let is_resolved =
                    stiffness.parse::<f64>().unwrap() * step.parse::<f64>().unwrap().powi(2) < 0.02;
                assert!(!(is_resolved && is_reported(&run)), "{scheme}, {stiffness} N/m, {step} s");
            }
        }
    }
    assert!(reported >= 30 && lost >= 15, "{reported} reported, {lost} of them lose a tenth of the velocity");
    let run = finished(&bounce("stiffness = 1e8", "scheme = \"radau-iia\"\nstep = 1e-3"));
    let text = run.simulation().warnings()[0].to_string();
    assert!(
        text.contains("the force on `slide.displacement` stops") && text.contains("relative_tolerance"),
        "{text}"
    );
}

/// A ball falls by 5 cm; the height of the bounce is e² of that.
#[test]
fn a_bounce_has_the_height_of_its_restitution() {
    let law = "stiffness = 1e8\nrestitution = 0.7\nimpact_velocity = 0.99045";
    for steps in ["step = 2e-5", "relative_tolerance = 1e-6"] {
        let text = bounce(law, &format!("scheme = \"radau-iia\"\n{steps}"))
            .replace("velocity = [-1, 0, 0]\n", "")
            .replace("lissom = 1\n", "lissom = 1\ngravity = [-9.81, 0, 0]\n")
            .replace("end = 0.08", "end = 0.2");
        let (_, places) = column(&text, "slide", "displacement");
        let first = places.iter().position(|place| *place < -0.05).unwrap();
        let height = places[first..].iter().copied().fold(f64::NEG_INFINITY, f64::max) + 0.05;
        let found = (height / 0.05).sqrt();
        assert!((found / 0.7 - 1.0).abs() < 1e-2, "{steps}: {found}");
    }
}

#[test]
fn a_bounce_restored_in_the_middle_goes_on_to_the_last_bit() {
    for scheme in SCHEMES {
        let text =
            bounce("stiffness = 1e6\ndissipation = 0.3", &format!("scheme = \"{scheme}\"\nstep = 1e-4"));
        let mut whole = session(&text);
        whole.step_to(0.052).unwrap();
        let kept = whole.snapshot().to_bytes();
        whole.step_to(0.07).unwrap();
        let mut other = session(&text);
        other.restore(&lissom::SessionSnapshot::from_bytes(&kept).unwrap()).unwrap();
        other.step_to(0.07).unwrap();
        assert_eq!(whole.simulation().state(), other.simulation().state(), "{scheme}");
    }
}

const PENDULUM: &str = r#"
lissom = 1
gravity = [0, -9.81, 0]
[bodies.bob]
mass = { density = 1000 }
inertia = { sphere = 0.05 }
position = ["sin(0.06)", "-cos(0.06)", 0]
[joints.hinge]
kind = "revolute"
base = "ground"
tip = "bob"
at = [0, 0, 0]
axis = [0, 0, 1]
FRICTION
[outputs.hinge]
kind = "relative"
of = "hinge"
[analysis]
kind = "dynamics"
scheme = "radau-iia"
end = 12
step = 1e-3
"#;

/// With friction of constant moment M the amplitude falls by 2 M/(m g l) per half swing, up to the third order of the angle.
#[test]
fn the_amplitude_of_a_pendulum_falls_by_a_constant() {
    let weight = 1000.0 * 4.0 / 3.0 * std::f64::consts::PI * 0.05_f64.powi(3) * 9.81;
    let moment = 3e-3 * weight;
    let text = PENDULUM.replace(
        "FRICTION",
        &format!("friction = {{ coulomb = {moment}, deflection = 1e-6, damping = 0.02 }}"),
    );
    let (_, angles) = column(&text, "hinge", "angle");
    let angles: Vec<f64> = angles.iter().map(|angle| angle + 0.06).collect();
    let turns = angles.windows(3).filter(|three| (three[1] - three[0]) * (three[2] - three[1]) < 0.0);
    let peaks: Vec<f64> = turns.map(|three| three[1].abs()).filter(|peak| *peak > 5e-3).collect();
    assert!(peaks.len() >= 6, "{peaks:?}");
    for (k, peak) in peaks.iter().enumerate() {
        let wanted = 0.06 - 6e-3 * (k + 1) as f64;
        assert!((peak - wanted).abs() < 5e-5, "peak {k}: {peak} {wanted}");
    }
    // At rest it stays where the moment of the weight is below that of friction.
    let last = angles[angles.len() - 1];
    assert!(last.abs() < 3e-3 + 1e-5, "{last}");
}

const BELT: &str = r#"
lissom = 1
[bodies.belt]
mass = 1
inertia = [0.1, 0.1, 0.1]
[bodies.block]
mass = 2
inertia = [0.1, 0.1, 0.1]
velocity = [0.1, 0, 0]
[joints.rail]
kind = "prismatic"
base = "ground"
tip = "belt"
axis = [1, 0, 0]
[joints.drive]
kind = "prescribed_displacement"
joint = "rail"
displacement = "0.1*t"
[joints.contact]
kind = "prismatic"
base = "belt"
tip = "block"
axis = [1, 0, 0]
friction = { coulomb = 2, static = 3, stribeck = 1e-3, deflection = 1e-6, damping = 50 }
[springs.spring]
kind = "point"
base = "ground"
tip = "block"
at_base = [-1, 0, 0]
stiffness = 200
[outputs.spring]
kind = "spring"
of = "spring"
[analysis]
kind = "dynamics"
scheme = "radau-iia"
end = 3.2
step = 2e-4
"#;

/// The block sticks until the spring pulls with F_s, and slips until it has the velocity of the belt again.
#[test]
fn a_block_on_a_belt_sticks_and_slips_with_its_period() {
    let (times, elongations) = column(BELT, "spring", "elongation");
    let peaks: Vec<(f64, f64)> = elongations
        .windows(3)
        .zip(&times[1..])
        .filter(|(three, _)| three[1] > three[0] && three[1] >= three[2])
        .map(|(three, time)| (*time, three[1]))
        .collect();
    assert!(peaks.len() >= 4, "{peaks:?}");
    let (past, rate, velocity) = ((3.0 - 2.0) / 200.0, 10.0, 0.1_f64);
    let slip = 2.0 * (std::f64::consts::PI - (past * rate / velocity).atan()) / rate;
    let period = slip + 2.0 * past / velocity;
    let found = (peaks[3].0 - peaks[1].0) / 2.0;
    assert!((found / period - 1.0).abs() < 1e-2, "{found} {period}");
    let amplitude = 2.0 / 200.0 + past.hypot(velocity / rate);
    assert!((peaks[2].1 / amplitude - 1.0).abs() < 1e-2, "{} {amplitude}", peaks[2].1);
}

const BUSHING: &str = r#"
lissom = 1
[bodies.block]
mass = 2
inertia = [0.01, 0.02, 0.03]
MOTION
[springs.mount]
kind = "bushing"
base = "ground"
tip = "block"
MATRIX
[outputs.block]
kind = "displacement"
of = "block"
[outputs.turn]
kind = "rotation"
of = "block"
[outputs.energy]
kind = "energy"
[analysis]
ANALYSIS
"#;

fn bushing(motion: &str, matrix: &str, analysis: &str) -> String {
    BUSHING.replace("MOTION", motion).replace("MATRIX", matrix).replace("ANALYSIS", analysis)
}

/// Along its own axes each direction is an oscillator of its own; energy stays, through large rotations too.
#[test]
fn a_body_on_a_bushing_of_no_length_swings_and_keeps_its_energy() {
    let matrix = "stiffness = [800, 200, 100, 4, 4, 4]\naxis = [0, 1, 0]\nsecond_axis = [0, 0, 1]\n";
    for (scheme, most) in [
        ("radau-iia", 1e-6),
        ("radau-iia-5", 1e-6),
        ("energy-decaying", 1e-6),
        ("generalized-alpha", 1e-4),
        ("hht", 1e-4),
    ] {
        let analysis = format!("kind = \"dynamics\"\nscheme = \"{scheme}\"\nend = 0.5\nstep = 2e-4");
        let motion = "velocity = [0.7, 0.4, 0.2]\n";
        let run = finished(&bushing(motion, matrix, &analysis));
        for (component, velocity, stiffness) in
            [("u2", 0.4, 800.0_f64), ("u3", 0.2, 200.0), ("u1", 0.7, 100.0)]
        {
            let rate = (stiffness / 2.0).sqrt();
            let wanted = velocity / rate * (0.5 * rate).sin();
            let found = run.value(&format!("block.{component}")).unwrap();
            assert!((found - wanted).abs() < most, "{scheme} {component}: {found} {wanted}");
        }
        // About one axis, far: amplitude 10/√(4/0.03) = 0.87 rad.
        let motion = "angular_velocity = [0, 0, 10]\n";
        let run = finished(&bushing(motion, matrix, &analysis));
        let rate = (4.0_f64 / 0.03).sqrt();
        let turn = run.value("turn.r3").unwrap();
        assert!((turn - 10.0 / rate * (0.5 * rate).sin()).abs() < 10.0 * most, "{scheme}: {turn}");
        let motion = "velocity = [0.7, 0.4, 0.2]\nangular_velocity = [12, -9, 10]\n";
        let run = finished(&bushing(motion, matrix, &analysis));
        let start = 0.5 * (2.0 * 0.69 + 0.01 * 144.0 + 0.02 * 81.0 + 0.03 * 100.0);
        let energy = run.value("energy.total").unwrap();
        assert!((energy / start - 1.0).abs() < 20.0 * most, "{scheme}: {energy} {start}");
    }
}

/// Off the diagonal: the deflection under a small force is K⁻¹ f.
#[test]
fn a_bushing_couples_directions() {
    let matrix = "stiffness = [[1000, 0, 0, 0, 0, 60], [0, 800, 0, 0, 0, 0], [0, 0, 800, 0, 0, 0], \
                  [0, 0, 0, 10, 0, 0], [0, 0, 0, 0, 10, 0], [60, 0, 0, 0, 0, 10]]\n\
                  [loads.push]\nkind = \"force\"\non = \"block\"\nvector = [1e-3, 0, 0]\n";
    let run = finished(&bushing("", matrix, "kind = \"statics\""));
    let determinant = 1000.0 * 10.0 - 3600.0;
    let (u, r) = (run.value("block.u1").unwrap(), run.value("turn.r3").unwrap());
    assert!((u - 1e-3 * 10.0 / determinant).abs() < 1e-11, "{u}");
    assert!((r + 1e-3 * 60.0 / determinant).abs() < 1e-10, "{r}");
    let damped = "stiffness = [100, 100, 100, 1, 1, 1]\ndamping = [20, 0, 0, 0, 0, 0]\n";
    let analysis = "kind = \"dynamics\"\nscheme = \"radau-iia\"\nend = 0.5\nstep = 1e-3";
    let found = finished(&bushing("velocity = [0.7, 0, 0]\n", damped, analysis)).value("block.u1").unwrap();
    let (delta, rate) = (5.0, (50.0_f64 - 25.0).sqrt());
    let wanted = 0.7 / rate * (-delta * 0.5_f64).exp() * (0.5 * rate).sin();
    assert!((found - wanted).abs() < 1e-8, "{found} {wanted}");
    let bad = "stiffness = [[1, 0, 0, 0, 0, 3], [0, 1, 0, 0, 0, 0], [0, 0, 1, 0, 0, 0], [0, 0, 0, 1, 0, 0], \
               [0, 0, 0, 0, 1, 0], [3, 0, 0, 0, 0, 1]]\n";
    assert!(refused(&bushing("", bad, analysis)).contains("must not have negative eigenvalues"));
    let parallel = "stiffness = [1, 1, 1, 1, 1, 1]\naxis = [0, 1, 0]\n";
    assert!(refused(&bushing("", parallel, analysis)).contains("specify both `axis` and `second_axis`"));
}

/// The axis of a sphere with a rotor goes round the angular momentum at the rate |L|/I.
#[test]
fn a_gyrostat_precesses_about_its_angular_momentum() {
    let text = r#"
lissom = 1
[bodies.ball]
mass = 5
inertia = { sphere = 0.2 }
angular_velocity = [2, 0, 0]
[loads.rotor]
kind = "gyrostat"
on = "ball"
axis = [0, 0, 1]
inertia = 0.002
spin = 300
[outputs.axis]
kind = "position"
of = "ball"
point = [0, 0, 1]
[outputs.energy]
kind = "energy"
[outputs.momentum]
kind = "momentum"
[analysis]
kind = "dynamics"
scheme = "radau-iia"
end = 1.3
step = 1e-3
"#;
    let inertia = 0.4 * 5.0 * 0.04;
    let momentum = Vector3::new(inertia * 2.0, 0.0, 0.6);
    for scheme in SCHEMES {
        let run = finished(&text.replace("radau-iia", scheme));
        let angle = momentum.norm() / inertia * 1.3;
        let wanted = Rotation::about_axis(&momentum.normalize(), angle).apply(&Vector3::z());
        let found = Vector3::from(["x", "y", "z"].map(|c| run.value(&format!("axis.{c}")).unwrap()));
        let most = if scheme.starts_with("radau-iia") || scheme == "energy-decaying" { 1e-6 } else { 2e-4 };
        assert!((found - wanted).norm() < most, "{scheme}: {found} {wanted}");
        assert!((run.value("energy.total").unwrap() / (0.5 * inertia * 4.0) - 1.0).abs() < 100.0 * most);
        let kept = Vector3::from(["l1", "l2", "l3"].map(|c| run.value(&format!("momentum.{c}")).unwrap()));
        assert!((kept - momentum).norm() < most * momentum.norm(), "{scheme}: {kept} {momentum}");
    }
}

#[test]
fn solids_have_their_mass_and_inertia() {
    let body = |keys: &str| {
        format!("lissom = 1\n[bodies.a]\n{keys}\n[analysis]\nkind = \"dynamics\"\nend = 1\nstep = 1e-2\n")
    };
    let read = |keys: &str| {
        let document = Model::from_text("solid.toml", &body(keys)).document().unwrap();
        (document.bodies[0].mass, document.bodies[0].inertia.diagonal())
    };
    let (mass, inertia) = read("mass = { density = 500 }\ninertia = { box = [0.1, 0.2, 0.3] }");
    assert!((mass - 3.0).abs() < 1e-12);
    assert!((inertia - Vector3::new(0.13, 0.1, 0.05) * 3.0 / 12.0).norm() < 1e-12);
    let (mass, inertia) = read("mass = 4\ninertia = { cylinder = [0.1, 0.6], axis = \"x\" }");
    assert_eq!(mass, 4.0);
    assert!((inertia - Vector3::new(0.02, 0.13, 0.13)).norm() < 1e-12, "{inertia}");
    for (keys, words) in [
        ("mass = { density = 1 }\ninertia = [1, 1, 1]", "`inertia` names no solid"),
        ("mass = 1\ninertia = { box = [1, 1, 1], sphere = 1 }", "must name one solid, not 2"),
        ("mass = 1\ninertia = { tube = [0.1, 0.2, 1] }", "is not a valid solid"),
        ("mass = 1\ninertia = { box = [1, 1, 1], axis = \"x\" }", "a box has no `axis`"),
        ("inertia = { box = [1, 1, 1] }", "lacks `mass`"),
    ] {
        assert!(refused(&body(keys)).contains(words), "{keys}");
    }
}

#[test]
fn mistakes_of_stops_and_friction_are_reported() {
    for (law, words) in [
        ("stiffness = 1e6\nrestitution = 0.5", "requires `impact_velocity`"),
        ("stiffness = 1e6\nrestitution = 1.5\nimpact_velocity = 1", "must be from 0.01 to 1"),
        ("stiffness = 1e6\nrestitution = 0.5\nimpact_velocity = 1\ndissipation = 1", "remove one of them"),
        ("stiffness = 1e6\nimpact_velocity = 1", "no meaning without `restitution`"),
        ("stiffness = 1e6\nexponent = 0.5", "must be 1 or greater"),
    ] {
        let reported = refused(&bounce(law, "step = 1e-4"));
        assert!(reported.contains(words), "{reported}");
    }
    let reported = refused(&PENDULUM.replace("FRICTION", "friction = { coulomb = 2, static = 1 }"));
    assert!(reported.contains("is below `coulomb`"), "{reported}");
    let spherical =
        PENDULUM.replace("FRICTION", "friction = { coulomb = 2 }").replace("revolute", "spherical");
    let reported = refused(&spherical.replace("axis = [0, 0, 1]\n", ""));
    assert!(reported.contains("no relative coordinate for friction"), "{reported}");
}

/// Joints of a falling mechanism that start at their stops, and neither press nor leave them, end no steps.
#[test]
fn joints_that_stay_at_their_stops_end_no_steps() {
    use std::fmt::Write;
    let mut text =
        "lissom = 1\ngravity = [0, 0, -9.81]\n[bodies.base]\nmass = 5\ninertia = [0.1, 0.1, 0.1]\n"
            .to_owned();
    for i in 0..10 {
        let base = if i % 3 == 0 { "base".to_owned() } else { format!("b{}", i - 1) };
        let (x, y, axis) = (
            f64::from(i % 3) + 0.1 * f64::from(i / 3),
            0.3 * f64::from(i / 3),
            ["x", "y", "z"][i as usize % 3],
        );
        write!(
            text,
            "[bodies.b{i}]\nmass = {}\ninertia = [0.01, 0.012, 0.011]\nposition = [{}, {y}, {}]\n\
             [joints.j{i}]\nkind = \"revolute\"\nbase = \"{base}\"\ntip = \"b{i}\"\nat = [{x}, {y}, 0]\naxis = \"{axis}\"\n\
             [springs.s{i}]\nkind = \"torsional_stop\"\njoint = \"j{i}\"\nrange = [0, 1.5]\nstiffness = 1e3\ndissipation = 0.5\n",
            1.0 + 0.3 * f64::from(i),
            x + 0.5,
            0.1 * f64::from(i)
        )
        .unwrap();
    }
    let totals = |text: &str| {
        let mut session = session(text);
        session.step_to(1.0).unwrap();
        let totals = session.simulation().totals();
        (totals.steps, totals.rejected_steps)
    };
    let analysis = "[analysis]\nkind = \"dynamics\"\nend = 1\nrelative_tolerance = 1e-3\n";
    let (at_stops, far) =
        (totals(&(text.clone() + analysis)), totals(&(text.replace("[0, 1.5]", "[-1, 1.5]") + analysis)));
    assert_eq!(at_stops, far);
}
