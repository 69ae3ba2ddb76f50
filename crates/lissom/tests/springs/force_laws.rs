//! Springs with laws: expressions, tables, data files, one side, limits, free play. Energy is conserved, counted as lost or
//! as put in; all schemes, steps of chosen size and sessions restored in the middle agree.

use crate::support::refused;
use crate::support::sessions;

use refused::refused;
use sessions::{finished, session};

const SCHEMES: [&str; 5] = ["radau-iia", "radau-iia-5", "energy-decaying", "generalized-alpha", "hht"];

/// A block of 2 kg on a slide, 0.5 m/s at the start.
const SLIDER: &str = r#"
lissom = 1
[bodies.block]
mass = 2
inertia = [0.1, 0.1, 0.1]
velocity = [0.5, 0, 0]
[joints.slide]
kind = "prismatic"
base = "ground"
tip = "block"
axis = [1, 0, 0]
[springs.spring]
SPRING
[outputs.slide]
kind = "relative"
of = "slide"
[outputs.spring]
kind = "spring"
of = "spring"
[outputs.energy]
kind = "energy"
[analysis]
kind = "dynamics"
ANALYSIS
"#;

const AXIAL: &str = "kind = \"axial\"\njoint = \"slide\"\n";
const POINT: &str =
    "kind = \"point\"\nbase = \"ground\"\ntip = \"block\"\nat_base = [-1, 0, 0]\nat_tip = [0, 0, 0]\n";

fn slider(spring: &str, analysis: &str) -> String {
    SLIDER.replace("SPRING", spring).replace("ANALYSIS", analysis)
}

/// Rows of f = 200 x + 1e5 x³, close enough that a spline has nine digits.
fn rows() -> String {
    let row = |k: i32| {
        let x = 1e-3 * f64::from(k);
        format!("[{x}, {}]", 200.0 * x + 1e5 * x * x * x)
    };
    (-60..=60).map(row).collect::<Vec<_>>().join(", ")
}

/// Time of the first return to x = 0 of 2 x'' + 200 x + 1e5 x³ = 0 with x' = 0.5: half a period of Duffing's equation,
/// 2 ∫ dx/x' by Gauss-Chebyshev quadrature.
fn half_period() -> f64 {
    // ½ m v² = ½ k a² + ¼ k₃ a⁴.
    let square = (-200.0 + (200.0_f64 * 200.0 + 2.0 * 1e5 * 0.5).sqrt()) / 1e5;
    let amplitude = square.sqrt();
    let n = 200;
    let sum: f64 = (0..n)
        .map(|k| {
            let x = amplitude * ((f64::from(k) + 0.5) * std::f64::consts::PI / f64::from(n)).cos();
            // v² = (a² - x²) (k + ½ k₃ (a² + x²))/m.
            1.0 / (0.5 * (200.0 + 0.5e5 * (square + x * x))).sqrt()
        })
        .sum();
    sum * std::f64::consts::PI / f64::from(n)
}

#[test]
fn a_cubic_spring_swings_with_the_period_of_duffing() {
    let half = half_period();
    let expression = "force = \"200*elongation + 1e5*elongation^3\"\n";
    let partly = "stiffness = 200\nforce = \"1e5*elongation^3\"\n";
    let table = format!("force = {{ table = [{}], interpolation = \"spline\" }}\n", rows());
    let monotone = format!("force = {{ table = [{}], interpolation = \"monotone\" }}\n", rows());
    for kind in [AXIAL, POINT] {
        for (law, most) in [(expression, 1e-6), (partly, 1e-7), (&table, 1e-6), (&monotone, 1e-5)] {
            // The other schemes need not see every law.
            let schemes = if law == expression { &SCHEMES[..] } else { &SCHEMES[..1] };
            for scheme in schemes {
                let step = if scheme.starts_with('r') || scheme.starts_with('e') { 1e-4 } else { 5e-5 };
                let analysis =
                    format!("scheme = \"{scheme}\"\nend = {half}\nstep = {step}\ntolerance = 1e-10");
                let session = finished(&slider(&format!("{kind}{law}"), &analysis));
                let place = session.value("slide.displacement").unwrap();
                assert!(place.abs() < most, "{kind}{scheme}: {place:e}");
                let elongation = session.value("spring.elongation").unwrap();
                assert!((elongation - place).abs() < 1e-12, "{elongation} {place}");
                let energy = session.value("energy.total").unwrap();
                assert!((energy - 0.25).abs() < 2e-6, "{scheme}: {energy}");
            }
        }
    }
}

#[test]
fn potential_energy_and_force_are_recorded() {
    let text = slider(
        &format!("{AXIAL}force = \"200*elongation + 1e5*elongation^3\"\n"),
        "scheme = \"radau-iia\"\nend = 0.12\nstep = 1e-3",
    );
    let session = finished(&text);
    let x = session.value("slide.displacement").unwrap();
    let wanted = 100.0 * x * x + 0.25e5 * x.powi(4);
    assert!((session.value("energy.strain").unwrap() - wanted).abs() < 1e-12);
    // The force is recovered from the positions, with its elongation.
    let recovered = session.value("spring.elongation").unwrap();
    assert!((recovered - x).abs() < 1e-6 * x.abs());
    let law = 200.0 * recovered + 1e5 * recovered.powi(3);
    assert!((session.value("spring.force").unwrap() - law).abs() < 1e-9);
    assert_eq!(session.value("spring.rate"), session.value("slide.velocity"));
}

/// A spring that cannot pull throws a block back to where it came from, at every bounce.
#[test]
fn a_spring_that_cannot_pull_lets_go() {
    for (scheme, most) in [
        ("radau-iia", 2e-4),
        ("radau-iia-5", 2e-4),
        ("energy-decaying", 2e-4),
        ("generalized-alpha\"\nspectral_radius = 1\n#\"", 5e-3),
    ] {
        // Beside it a spring so weak that nobody sees it: Newton's method is slow where a coordinate feels no force.
        let law = "stiffness = 5e3\nside = \"compression\"\n\
                   [springs.weak]\nkind = \"axial\"\njoint = \"slide\"\nstiffness = 1e-2\n";
        let text = slider(&format!("{AXIAL}{law}"), &format!("scheme = \"{scheme}\"\nend = 1\nstep = 2e-4"))
            .replace("lissom = 1", "lissom = 1\ngravity = [-9.81, 0, 0]");
        let mut session = session(&text);
        let record = session.run().unwrap();
        let places = record.column("slide", "displacement").unwrap();
        let tops: Vec<f64> = places
            .windows(3)
            .filter(|three| three[1] > three[0] && three[1] >= three[2])
            .map(|three| three[1])
            .collect();
        let height = 0.5 * 0.25 / 9.81;
        assert!(tops.len() >= 5, "{scheme}: {tops:?}");
        assert!(tops.iter().all(|top| (top - height).abs() < most * height + 1e-7), "{scheme}: {tops:?}");
        let forces = record.column("spring", "force").unwrap();
        assert!(forces.iter().all(|force| *force <= 0.0));
        assert!(forces.iter().any(|force| *force < -50.0));
    }
}

/// Beyond its limit a spring pulls with a constant force: the block stops after v²/2a.
#[test]
fn limits_hold() {
    // ½ m v² = ½ k x₁² + F (x - x₁), x₁ = F/k.
    let (force, first): (f64, f64) = (1.0, 1.0 / 200.0);
    let amplitude = first + (0.25 - 0.5 * 200.0 * first * first) / force;
    let law = "stiffness = 200\nlimits = [-inf, 1]\n";
    let text = slider(&format!("{AXIAL}{law}"), "scheme = \"radau-iia\"\nend = 1.2\nstep = 2e-4");
    let mut session = session(&text);
    let record = session.run().unwrap();
    let places = record.column("slide", "displacement").unwrap();
    let most = places.iter().copied().fold(0.0, f64::max);
    assert!((most - amplitude).abs() < 1e-5, "{most} {amplitude}");
    let energy = record.column("energy", "total").unwrap();
    assert!(energy.iter().all(|energy| (energy - 0.25).abs() < 1e-6));
}

/// Within its free play a spring does nothing; a table over the rate is a damper.
#[test]
fn backlash_leaves_a_body_alone() {
    let text = slider(
        &format!("{AXIAL}stiffness = 1e3\nbacklash = 0.1\n"),
        "scheme = \"radau-iia\"\nend = 0.1\nstep = 1e-3",
    );
    assert!((finished(&text).value("slide.displacement").unwrap() - 0.05).abs() < 1e-12);
    // Then half a period of the spring, and back through the gap.
    let back = 0.2 + std::f64::consts::PI * (2.0_f64 / 1e3).sqrt();
    let text = text.replace("end = 0.1", &format!("end = {back}")).replace("step = 1e-3", "step = 1e-4");
    assert!(finished(&text).value("slide.displacement").unwrap().abs() < 1e-6);
}

#[test]
fn a_table_over_the_rate_is_a_damper() {
    let exact = 0.5 * 2.0 / 6.0 * (1.0 - (-6.0_f64 / 2.0).exp());
    for law in [
        "damping = 6\n",
        "damper_force = \"6*rate\"\n",
        "force = \"6*rate\"\n",
        "damper_force = { table = [[-1, -6], [0, 0], [1, 6]] }\n",
    ] {
        for kind in [AXIAL, POINT] {
            let text = slider(&format!("{kind}{law}"), "scheme = \"radau-iia\"\nend = 1\nstep = 1e-3");
            let found = finished(&text).value("slide.displacement").unwrap();
            assert!((found - exact).abs() < 1e-9, "{law}: {found} {exact}");
        }
    }
}

/// Van der Pol: a damper that puts energy in at small amplitudes is no error; the amplitude grows to 2.
#[test]
fn a_damper_that_drives_is_counted_as_a_load() {
    let law = "stiffness = 2\nforce = \"0.4*(elongation^2 - 1)*rate\"\n";
    let text = slider(&format!("{AXIAL}{law}"), "scheme = \"radau-iia\"\nend = 80\nstep = 0.02");
    let mut session = session(&text);
    let record = session.run().unwrap();
    let places = record.column("slide", "displacement").unwrap();
    let late = places[places.len() - 500..].iter().copied().fold(0.0, f64::max);
    // x'' - ε(1 - x²)x' + x = 0, ε = 0.2: 2 + ε²/96.
    assert!((late - 2.0).abs() < 2e-3, "{late}");
}

#[test]
fn chosen_steps_and_restored_sessions_agree() {
    let law =
        "stiffness = 300\nforce = \"if(elongation > 0.02, 2e3*(elongation - 0.02), 0)\"\nbacklash = 0.004\n";
    let fixed = |scheme: &str, analysis: &str| {
        let analysis = format!("scheme = \"{scheme}\"\nend = 0.8\n{analysis}");
        slider(&format!("{AXIAL}{law}"), &analysis)
    };
    let fine = finished(&fixed("radau-iia", "step = 1e-4")).value("slide.displacement").unwrap();
    for scheme in SCHEMES {
        let chosen =
            finished(&fixed(scheme, "relative_tolerance = 1e-6")).value("slide.displacement").unwrap();
        assert!((fine - chosen).abs() < 2e-5, "{scheme}: {fine} {chosen}");
        for analysis in ["step = 1e-3", "relative_tolerance = 1e-5"] {
            let text = fixed(scheme, analysis);
            let mut whole = session(&text);
            whole.step_to(0.31).unwrap();
            let kept = whole.snapshot().to_bytes();
            whole.step_to(0.8).unwrap();
            let mut other = session(&text);
            other.restore(&lissom::SessionSnapshot::from_bytes(&kept).unwrap()).unwrap();
            other.step_to(0.8).unwrap();
            assert_eq!(whole.simulation().state(), other.simulation().state(), "{scheme}");
        }
    }
}

#[test]
fn mistakes_are_reported() {
    for (law, words) in [
        ("force = \"200*elongaton\"", &["cannot name `elongaton`", "did you mean `elongation`"][..]),
        ("force = \"sin(t)\"", &["cannot name the time"]),
        ("force = \"200*slide.displacement\"", &["cannot name `slide.displacement`"]),
        ("force = { table = [[0, 0]] }", &["at least two rows"]),
        ("force = { interpolation = \"linear\" }", &["specify `table` or `file`"]),
        ("force = { table = [[0, 0], [1, 1]], columns = [\"a\", \"b\"] }", &["names columns, but no file"]),
        ("force = { table = [[0, 0], [1, 1]], file = \"a.csv\" }", &["both `table` and `file`"]),
        ("limits = [1, -1]", &["must ascend"]),
        ("limits = [1, nan]", &["finite"]),
        ("side = \"left\"", &["cannot be `left`"]),
        ("force = true", &["must be a number, an expression of elongation and rate"]),
    ] {
        let reported = refused(&slider(&format!("{AXIAL}{law}\n"), "end = 1\nstep = 1e-2"));
        let reported = reported.split_whitespace().collect::<Vec<_>>().join(" ");
        for words in words {
            assert!(reported.contains(words), "{law}\n{reported}");
        }
    }
    // Outside of what its functions allow, a law ends the run.
    let text = slider(&format!("{AXIAL}force = \"sqrt(0.01 - elongation)\"\n"), "end = 1\nstep = 1e-2");
    let mut session = session(&text);
    let (_, report) = session.run().unwrap_or_else(lissom::Results::from).into_parts();
    assert!(!report.is_complete(), "{report:?}");
}

/// Two masses of 2 and 3 kg attract each other with 60 N m²/r², from a distance of 1 m, where they are farthest: for the
/// distance, semi-major axis a = 1/(2 - v²/50).
#[test]
fn masses_that_attract_each_other_go_round_in_ellipses() {
    let text = |law: &str, scheme: &str, step: f64, end: f64| {
        format!(
            "lissom = 1\n[point_masses.one]\nmass = 2\nposition = [0, 0, 0]\nvelocity = [0, -3.6, 0]\n\
             [point_masses.two]\nmass = 3\nposition = [1, 0, 0]\nvelocity = [0, 2.4, 0]\n\
             [springs.attraction]\nkind = \"point\"\nbase = \"one\"\ntip = \"two\"\n{law}\n\
             [outputs.one]\nkind = \"position\"\nof = \"one\"\n[outputs.two]\nkind = \"position\"\nof = \"two\"\n\
             [outputs.energy]\nkind = \"energy\"\n[outputs.momentum]\nkind = \"momentum\"\n\
             [analysis]\nkind = \"dynamics\"\nscheme = \"{scheme}\"\nend = {end}\nstep = {step:e}\n"
        )
    };
    let axis = 1.0 / (2.0 - 36.0 / 50.0);
    let period = std::f64::consts::TAU * f64::sqrt(axis * axis * axis / 50.0);
    let from_the_start = "length = 1\nforce = \"60/(1 + elongation)^2\"";
    for scheme in SCHEMES {
        let third = scheme.starts_with("radau-iia") || scheme == "energy-decaying";
        let (parts, within) = if third { (1000.0, 1e-6) } else { (4000.0, 2e-5) };
        let record = session(&text(from_the_start, scheme, period / parts, period)).run().unwrap();
        let column = |output: &str, component: &str| record.column(output, component).unwrap();
        let apart = |k: usize| {
            let difference = |axis| column("two", axis)[k] - column("one", axis)[k];
            [difference("x"), difference("y")]
        };
        let (last, half) = (record.times.len() - 1, record.times.len() / 2);
        let [x, y] = apart(last);
        assert!((x - 1.0).abs() < within && y.abs() < 10.0 * within, "{scheme}: {x} {y}");
        // The other apsis, and the strain energy from one to the other.
        let near = 2.0 * axis - 1.0;
        let [x, y] = apart(half);
        assert!((x + near).abs() < within && y.abs() < 10.0 * within, "{scheme}: {x} {y} for {near}");
        let strain = column("energy", "strain");
        assert!(
            (strain[half] - 60.0 * (1.0 - 1.0 / near)).abs() < 100.0 * within,
            "{scheme}: {}",
            strain[half]
        );
        let total = column("energy", "total");
        let most = total.iter().fold(0.0_f64, |most, own| most.max((own - total[0]).abs()));
        assert!(most < 100.0 * within, "{scheme}: {most}");
        let turning = column("momentum", "l3");
        let most = turning.iter().fold(0.0_f64, |most, own| most.max((own - turning[0]).abs()));
        assert!(most < 100.0 * within, "{scheme}: {most}");
    }
    // Counted from where both meet there is no potential energy: the work is that of a load, and the motion the same.
    let [one, other] = [from_the_start, "length = 0\nforce = \"60/elongation^2\""]
        .map(|law| session(&text(law, "radau-iia", 1e-3, 0.3)).run().unwrap().into_record());
    let last = |record: &lissom::Record, output: &str, component: &str| {
        *record.column(output, component).unwrap().last().unwrap()
    };
    assert!((last(&one, "two", "y") - last(&other, "two", "y")).abs() < 1e-12);
    assert_eq!(last(&other, "energy", "strain"), 0.0);
}

/// Columns `x`, the rate and the force of the spring at the start.
fn at_start(spring: &str) -> Vec<f64> {
    let session = session(&slider(spring, "end = 1\nstep = 0.01"));
    let mut values = Vec::new();
    session.values(&mut values);
    let columns = session.columns().iter().zip(values);
    columns.filter(|(column, _)| column.name().starts_with("spring.")).map(|(_, value)| value).collect()
}

#[test]
fn a_preload_is_the_force_at_the_start() {
    for kind in [AXIAL, POINT] {
        let [elongation, _, force] = at_start(&format!("{kind}stiffness = 200\npreload = -6"))[..] else {
            panic!()
        };
        assert!(
            (elongation + 0.03).abs() < 1e-15 && (force + 6.0).abs() < 1e-12,
            "{elongation} m, {force} N"
        );
        let rest = if kind == AXIAL { "displacement = 0.03" } else { "length = 1.03" };
        let same = at_start(&format!("{kind}stiffness = 200\n{rest}"));
        assert!((same[0] - elongation).abs() < 1e-15 && (same[2] - force).abs() < 1e-12, "{same:?}");
    }
    let model = |spring: &str| slider(spring, "end = 1\nstep = 0.01");
    for (spring, words) in [
        (format!("{AXIAL}stiffness = 200\npreload = 6\ndisplacement = 1"), "remove one of them"),
        (format!("{POINT}stiffness = 200\npreload = 6\nlimits = [-5, 5]"), "cannot be reached"),
        (format!("{POINT}preload = 6"), "needs a `stiffness`"),
        (format!("{POINT}stiffness = 200\npreload = 600"), "a length without force of -2 m"),
    ] {
        let problem = refused(&model(&spring));
        assert!(problem.contains(words), "{problem}");
    }
}

/// A block meets a wall whose force is a power of the penetration, as a load with `max`, with `if` and as a spring on one side: the
/// energy gives the depth, and it returns with the velocity it came with. Exponents between whole numbers have no value beyond the
/// switch, where steps continue them by round-off.
#[test]
fn penetrations_to_a_power_rebound_elastically() {
    let (mass, velocity, stiffness) = (2.0_f64, 0.5_f64, 3e4_f64);
    for exponent in [1.2, 1.5, 2.0, 2.2, 3.0] {
        let analysis = "end = 1\nrelative_tolerance = 1e-9";
        let load = |force: &str| {
            let load =
                format!("[loads.wall]\nkind = \"joint_force\"\njoint = \"slide\"\nforce = \"{force}\"\n");
            SLIDER
                .replace("[springs.spring]\nSPRING\n", &load)
                .replace("[outputs.spring]\nkind = \"spring\"\nof = \"spring\"\n", "")
                .replace("ANALYSIS", analysis)
        };
        let models = [
            load(&format!("-{stiffness}*max(0, slide.displacement - 0.1)^{exponent}")),
            load(&format!(
                "if(slide.displacement > 0.1, -{stiffness}*(slide.displacement - 0.1)^{exponent}, 0)"
            )),
            load(&format!("-{stiffness}*sqrt(max(0, slide.displacement - 0.1))^{}", 2.0 * exponent)),
            slider(
                &format!(
                    "{AXIAL}displacement = 0.1\nside = \"tension\"\nforce = \"{stiffness}*elongation^{exponent}\""
                ),
                analysis,
            ),
        ];
        let depth =
            (0.5 * mass * velocity * velocity * (exponent + 1.0) / stiffness).powf(1.0 / (exponent + 1.0));
        for text in models {
            let record = session(&text).run().unwrap().into_record();
            let place = record.column("slide", "displacement").unwrap();
            let deepest = place.iter().copied().fold(0.0, f64::max) - 0.1;
            assert!(
                deepest <= depth * (1.0 + 1e-7) && deepest > 0.9 * depth,
                "{exponent}: {deepest} of {depth}\n{text}"
            );
            let rate = record.column("slide", "velocity").unwrap().last().unwrap();
            assert!((rate + velocity).abs() < 1e-6, "{exponent}: {rate}\n{text}");
        }
    }
}
