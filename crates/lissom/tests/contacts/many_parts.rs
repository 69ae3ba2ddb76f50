//! Contacts of many parts, solved for all touches of a step at once.

use std::fmt::Write;

use lissom::analyses::modes::{ModeRequest, OperatingPoint, modes};
use lissom::{Model, Record, Session, SessionSnapshot};

use crate::support::refused::refused;
use crate::support::runs::{run, run_without_warnings, session};
use crate::support::series::{last, series};

/// Gravity [m/s²].
const G: f64 = 9.81;

/// A model on a plane with gravity in direction of x and z, and a step [s].
fn on_plane([along, down]: [f64; 2], bodies: &str, contact: &str, [step, end]: [f64; 2]) -> String {
    format!(
        "lissom = 1\ngravity = [{along}, 0, {down}]\n[ground]\nshape = {{ kind = \"plane\" }}\n{bodies}\n[contacts.all]\n\
         base = \"ground\"\nstiffness = 1e6\n{contact}\n[outputs.all]\nkind = \"contact_force\"\nof = \"all\"\n\
         [outputs.energy]\nkind = \"energy\"\n[analysis]\nkind = \"dynamics\"\nscheme = \"backward-euler\"\nstep = {step}\nend = {end}\n"
    )
}

fn ball(name: &str, radius: f64, place: [f64; 3], more: &str) -> String {
    format!(
        "[bodies.{name}]\nmass = 1\ninertia = {{ sphere = {radius} }}\nshape = {{ sphere = {radius} }}\nposition = {place:?}\n{more}\n\
         [outputs.{name}]\nkind = \"position\"\nof = \"{name}\"\n[outputs.v_{name}]\nkind = \"velocity\"\nof = \"{name}\"\n"
    )
}

/// Balls in layers of four, just apart, in a box, with its walls as the ground.
fn poured(layers: usize, contact: &str, [step, end]: [f64; 2]) -> String {
    let mut text = String::new();
    let mut names = Vec::new();
    for k in 0..4 * layers {
        let aside = |factor: f64| 0.002 * ((k as f64 * factor).fract() - 0.5);
        let of = |bit: usize| if k >> bit & 1 == 0 { -0.0525 } else { 0.0525 };
        let z = 0.07 + 0.115 * (k / 4) as f64;
        let place = [of(0) + aside(0.754_877), of(1) + aside(0.569_840), z + aside(0.430_159)];
        text += &ball(&format!("b{k}"), 0.05, place, "");
        names.push(format!("\"b{k}\""));
    }
    let wall = |normal: [i32; 3]| {
        let place = normal.map(|n| -0.11 * f64::from(n));
        format!("{{ kind = \"plane\", normal = {normal:?}, position = {place:?} }}")
    };
    let walls = [[1, 0, 0], [-1, 0, 0], [0, 1, 0], [0, -1, 0]].map(wall).join(", ");
    let contact = format!("tip = \"b0\"\nothers = [{}]\n{contact}", names[1..].join(", "));
    on_plane([0.0, -G], &text, &contact, [step, end])
        .replace("shape = { kind = \"plane\" }", &format!("shape = [{{ kind = \"plane\" }}, {walls}]"))
}

fn largest_rise(values: &[f64]) -> f64 {
    values.windows(2).map(|pair| pair[1] - pair[0]).fold(f64::NEG_INFINITY, f64::max)
}

/// The value of a column at the middle of a run.
fn middle(record: &Record, name: &str) -> f64 {
    let values = series(record, name);
    values[values.len() / 2]
}

/// A box sticks on a slope just below the friction angle, without creeping, and slides just above it as it should.
#[test]
fn a_box_sticks_on_a_slope_up_to_the_friction_angle() {
    let friction = 0.4;
    let body = "[bodies.b]\nmass = 2\ninertia = [0.0083, 0.0083, 0.0133]\nshape = { box = [0.2, 0.2, 0.1] }\nposition = [0, 0, 0.05]\n\
                [outputs.b]\nkind = \"position\"\nof = \"b\"\n[outputs.v]\nkind = \"velocity\"\nof = \"b\"\n";
    let contact = "tip = \"b\"\ndissipation = 0.3\nfriction = 0.4";
    for step in [1e-2, 1e-3] {
        for share in [0.99, 1.01] {
            let angle = f64::atan(share * friction);
            let text = on_plane([G * angle.sin(), -G * angle.cos()], body, contact, [step, 2.0]);
            let record = run(&text, &[]);
            let crept = last(&record, "b.x") - middle(&record, "b.x");
            if share < 1.0 {
                assert!(crept.abs() < 1e-10, "{step}: {crept:e}");
            } else {
                let gained = last(&record, "v.v1") - middle(&record, "v.v1");
                let wanted = G * (angle.sin() - friction * angle.cos());
                assert!((gained / wanted - 1.0).abs() < 1e-3, "{step}: {gained} {wanted}");
            }
        }
    }
}

/// Three balls on a plane carry a fourth, which stands if the friction exceeds tan(asin(1/√3)/2).
#[test]
fn a_pyramid_of_balls_stands_with_enough_friction() {
    let threshold = (0.5 * (1.0 / 3.0_f64.sqrt()).asin()).tan();
    let (radius, around) = (0.1, 0.2 / 3.0_f64.sqrt());
    for (share, stands) in [(1.01, true), (0.99, false)] {
        let mut text = String::new();
        for k in 0..3 {
            let angle = 2.0 * std::f64::consts::FRAC_PI_3 * f64::from(k);
            text += &ball(&format!("b{k}"), radius, [around * angle.cos(), around * angle.sin(), radius], "");
        }
        let top = radius + 2.0 * radius * (2.0_f64 / 3.0).sqrt();
        text += &ball("top", radius, [0.0, 0.0, top], "");
        let friction = share * threshold;
        let contact = format!(
            "tip = \"b0\"\nothers = [\"b1\", \"b2\", \"top\"]\ndissipation = 0.3\nfriction = {friction}"
        );
        let record = run(&on_plane([0.0, -G], &text, &contact, [5e-3, 4.0]), &[]);
        let fallen = top - last(&record, "top.z");
        assert_eq!(fallen < 1e-3, stands, "{share}: {fallen}");
    }
}

/// A ball that slides rolls in the end, at 5/7 of its velocity; errors are of first order in the step.
#[test]
fn a_sliding_ball_ends_up_rolling() {
    let errors = [2e-3, 1e-3].map(|step| {
        let text = ball("b", 0.1, [0.0, 0.0, 0.1], "velocity = [2, 0, 0]");
        let contact = "tip = \"b\"\ndissipation = 1\nfriction = 0.2";
        let record = run(&on_plane([0.0, -G], &text, contact, [step, 1.0]), &[]);
        assert!((last(&record, "v_b.v1") - 10.0 / 7.0).abs() < 1e-3);
        assert!(last(&record, "v_b.v3").abs() < 1e-6, "it does not climb");
        assert!((last(&record, "all.f3") - G).abs() < 1e-4 * G, "{}", last(&record, "all.f3"));
        let until = 4.0 / (7.0 * 0.2 * G);
        let wanted = 2.0 * until - 0.1 * G * until * until + 10.0 / 7.0 * (1.0 - until);
        (last(&record, "b.x") - wanted).abs()
    });
    assert!(errors[1] < 1e-3 && errors[1] < 0.7 * errors[0], "{errors:?}");
}

/// The first rebound has the height of the restitution though no step resolves the impact, and no step gains energy.
#[test]
fn impacts_that_steps_do_not_resolve_have_their_restitution() {
    for restitution in [0.9, 0.7, 0.4] {
        for (step, allowed) in [(1e-3, 0.03), (1e-4, 0.01)] {
            let text = ball("b", 0.05, [0.0, 0.0, 0.25], "");
            let contact = format!("tip = \"b\"\nrestitution = {restitution}\nfriction = 0.4");
            let record = run(&on_plane([0.0, -G], &text, &contact, [step, 0.6]), &[]);
            let heights = series(&record, "b.z");
            let top =
                heights.windows(3).find(|own| own[1] >= own[0] && own[1] > own[2]).expect("it rebounds")[1];
            let ratio = (top - 0.05) / 0.2 / (restitution * restitution);
            assert!((ratio - 1.0).abs() < allowed, "{restitution} {step}: {ratio}");
            // Of the tolerance of the iterations.
            let rise = largest_rise(series(&record, "energy.total"));
            assert!(rise < 5e-6, "{restitution} {step}: {rise:e}");
        }
    }
    // The friction of an impact: μ (1 + e) v.
    let text = ball("b", 0.05, [0.0, 0.0, 0.1], "velocity = [3, 0, -2]");
    let contact = "tip = \"b\"\nrestitution = 0.8\nfriction = 0.1";
    let record = run(&on_plane([0.0, 0.0], &text, contact, [1e-3, 0.1]), &[]);
    assert!((3.0 - last(&record, "v_b.v1") - 0.1 * 1.8 * 2.0).abs() < 1e-3);
    assert!((last(&record, "v_b.v3") - 1.6).abs() < 1e-4, "{}", last(&record, "v_b.v3"));
}

/// Balls that are poured into a box lose energy in every step and rest in the end; the ground bears their weight.
#[test]
fn a_poured_pile_loses_energy_and_comes_to_rest() {
    for (contact, step) in [
        ("dissipation = 0.3\nfriction = 0.4", 1e-3),
        ("dissipation = 0.3\nfriction = 0.4", 1e-2),
        ("restitution = 0.5\nfriction = 0.4", 1e-3),
        ("restitution = 0.2", 2e-3),
    ] {
        let record = run(&poured(5, contact, [step, 3.0]), &[]);
        let energy = series(&record, "energy.total");
        let allowed = if contact.contains("restitution") { 1e-6 } else { 1e-9 };
        assert!(largest_rise(energy) < allowed * energy[0], "{contact} {step}: {:e}", largest_rise(energy));
        assert!(
            last(&record, "energy.kinetic") < 1e-4,
            "{contact} {step}: {}",
            last(&record, "energy.kinetic")
        );
    }
}

/// Free balls that collide with friction and spin keep their momentum, and their angular momentum to first order in the step.
#[test]
fn collisions_keep_momenta() {
    let mut text = String::new();
    for k in 0..8 {
        let share = |factor: f64| (f64::from(k) * factor).fract() - 0.5;
        let place = [0, 1, 2].map(|bit| if k >> bit & 1 == 0 { -0.08 } else { 0.08 });
        let velocity = place.map(|x| -8.0 * x + share(0.61));
        let spin = [share(0.31), share(0.77), share(0.13)].map(|x| 40.0 * x);
        text += &ball(
            &format!("b{k}"),
            0.05,
            place,
            &format!("velocity = {velocity:?}\nangular_velocity = {spin:?}"),
        );
    }
    let others = "[\"b1\", \"b2\", \"b3\", \"b4\", \"b5\", \"b6\", \"b7\"]";
    let contact = format!("tip = \"b0\"\nothers = {others}\nrestitution = 0.6\nfriction = 0.3");
    let text = on_plane([0.0, 0.0], &text, &contact, [1e-3, 0.4])
        .replace("base = \"ground\"\n", "")
        .replace("tip = \"b0\"\nothers = [\"b1\", ", "base = \"b0\"\ntip = \"b1\"\nothers = [")
        + "[outputs.m]\nkind = \"momentum\"\n";
    // Momenta are those of the equations, which are solved to the tolerance.
    let record = run(&text, &[("analysis.tolerance", "1e-12")]);
    let kinetic = series(&record, "energy.kinetic");
    assert!(kinetic[kinetic.len() - 1] < 0.8 * kinetic[0], "they have collided");
    for (name, allowed) in
        [("m.p1", 1e-9), ("m.p2", 1e-9), ("m.p3", 1e-9), ("m.l1", 1e-3), ("m.l2", 1e-3), ("m.l3", 1e-3)]
    {
        let values = series(&record, name);
        let change = (values[values.len() - 1] - values[0]).abs();
        assert!(change < allowed, "{name} {change:e}");
    }
}

/// A chain that falls on the ground keeps its joints to round-off and loses energy.
#[test]
fn a_chain_falls_on_the_ground() {
    let mut text = String::new();
    let mut names = Vec::new();
    for k in 0..10 {
        let place = |k: f64| [0.08 * k, 0.0, 0.3 + 0.06 * k];
        text += &ball(&format!("c{k}"), 0.04, place(f64::from(k)), "");
        if k > 0 {
            let at = place(f64::from(k) - 0.5);
            write!(
                text,
                "[joints.j{k}]\nkind = \"spherical\"\nbase = \"c{}\"\ntip = \"c{k}\"\nat = {at:?}\n",
                k - 1
            )
            .unwrap();
            names.push(format!("\"c{k}\""));
        }
    }
    let contact = format!("tip = \"c0\"\nothers = [{}]\ndissipation = 0.3\nfriction = 0.4", names.join(", "));
    for step in [1e-3, 5e-3] {
        let mut session = session(&on_plane([0.0, -G], &text, &contact, [step, 1.5]), &[]);
        let record = crate::support::runs::record(&mut session);
        let energy = series(&record, "energy.total");
        assert!(largest_rise(energy) < 1e-9 * energy[0], "{step}: {:e}", largest_rise(energy));
        assert!(last(&record, "all.points") >= 5.0 && last(&record, "energy.kinetic") < 0.05);
        let heights: Vec<f64> = (0..10).map(|k| last(&record, &format!("c{k}.z"))).collect();
        assert!(heights.iter().all(|z| *z > 0.039), "{heights:?}");
    }
}

/// A run that is restored in the middle goes on to the last bit.
#[test]
fn piles_are_restored_to_the_last_bit() {
    let text = poured(3, "restitution = 0.5\nfriction = 0.4", [1e-3, 1.0]);
    let model = Model::from_text("pile.toml", &text);
    let go_on = |session: &mut Session| {
        session.step_to(0.5).unwrap();
        let mut values = Vec::new();
        session.values(&mut values);
        values
    };
    let mut first = model.session().unwrap();
    first.step_to(0.3).unwrap();
    let snapshot = first.snapshot().to_bytes();
    let straight = go_on(&mut first);
    let mut other = model.session().unwrap();
    other.restore(&SessionSnapshot::from_bytes(&snapshot).unwrap()).unwrap();
    assert_eq!(go_on(&mut other), straight);
}

/// Linear models see the stiffness of contacts whatever the scheme of the motion is.
#[test]
fn modes_of_a_ball_on_a_plane_are_those_of_its_contact() {
    let text = on_plane([0.0, -G], &ball("b", 0.1, [0.0, 0.0, 0.0999], ""), "tip = \"b\"", [1e-3, 1.0]).replace(
        "[contacts.all]",
        "[joints.guide]\nkind = \"prismatic\"\nbase = \"ground\"\ntip = \"b\"\naxis = \"z\"\n[contacts.all]",
    );
    let request =
        ModeRequest { count: Some(1), about: Some(OperatingPoint::Static), ..ModeRequest::default() };
    let found = modes(&Model::from_text("model.toml", &text), &request).unwrap();
    let wanted = 1e6_f64.sqrt() / std::f64::consts::TAU;
    assert!((found.modes[0].frequency / wanted - 1.0).abs() < 1e-6, "{}", found.modes[0].frequency);
}

/// What the scheme does not have is rejected with a remedy.
#[test]
fn rolling_friction_is_refused() {
    let text = on_plane(
        [0.0, -G],
        &ball("b", 0.1, [0.0, 0.0, 0.1], ""),
        "tip = \"b\"\nrolling_friction = 0.01",
        [1e-3, 1.0],
    );
    assert!(refused(&text).contains("as a set"), "{}", refused(&text));
}

/// Contacts that are solved with the steps do not hold parts in a static equilibrium.
#[test]
fn a_start_from_equilibrium_is_rejected() {
    let text = on_plane([0.0, -G], &ball("b", 0.1, [0.0, 0.0, 0.1], ""), "tip = \"b\"", [1e-3, 1.0])
        + "[initial]\nequilibrium = true\n";
    assert!(refused(&text).contains("equilibrium"), "{}", refused(&text));
}

/// Parts that overlap at the start are reported, as with other schemes.
#[test]
fn overlapping_parts_are_reported() {
    let text = on_plane(
        [0.0, -G],
        &ball("b", 0.1, [0.0, 0.0, 0.08], ""),
        "tip = \"b\"\ndissipation = 0.3",
        [1e-3, 0.01],
    );
    let session = session(&text, &[]);
    let warnings: Vec<String> = session.warnings().map(ToString::to_string).collect();
    assert!(warnings.iter().any(|own| own.contains("push the parts apart")), "{warnings:?}");
}

/// Balls, boxes and capsules with random sizes, speeds, spins and laws, in a box: no step gains energy, none fails, and what is left of the
/// motion dies away. `LISSOM_SCENES=2000` examines more of them.
#[test]
fn random_scenes_gain_no_energy() {
    let count = std::env::var("LISSOM_SCENES").ok().and_then(|text| text.parse().ok()).unwrap_or(24);
    for seed in 0..count {
        let seed: u32 = seed;
        let mut count = 0_u32;
        let mut share = move || {
            count += 1;
            let number = (f64::from(seed) + 1.0) * 0.618_033_988_7 + f64::from(count) * 0.754_877_666_2;
            (number * 37.0).fract()
        };
        let mut text = String::new();
        let mut names = Vec::new();
        for k in 0..10 {
            let size = 0.03 + 0.02 * share();
            let place = [
                -0.06 + 0.12 * f64::from(k % 2),
                -0.06 + 0.12 * f64::from(k / 2 % 2),
                0.08 + 0.13 * f64::from(k / 4),
            ];
            let shape = match k % 3 {
                0 => format!("{{ sphere = {size} }}"),
                1 => format!("{{ kind = \"capsule\", radius = {}, length = {size} }}", 0.6 * size),
                _ if seed.is_multiple_of(2) => {
                    format!("{{ box = [{size}, {}, {}] }}", 1.2 * size, 0.8 * size)
                }
                _ => format!("{{ sphere = {size} }}"),
            };
            let vector =
                |scale: f64, share: &mut dyn FnMut() -> f64| [0, 1, 2].map(|_| scale * (share() - 0.5));
            let (velocity, spin) = (vector(2.0, &mut share), vector(30.0, &mut share));
            write!(
                text,
                "[bodies.p{k}]\nmass = {}\ninertia = {{ sphere = {size} }}\nshape = {shape}\nposition = {place:?}\nvelocity = {velocity:?}\nangular_velocity = {spin:?}\n",
                0.2 + share()
            )
            .unwrap();
            names.push(format!("\"p{k}\""));
        }
        let law = if seed.is_multiple_of(3) {
            format!("restitution = {}", 0.1 + 0.8 * share())
        } else {
            format!("dissipation = {}", share())
        };
        let contact =
            format!("tip = \"p0\"\nothers = [{}]\n{law}\nfriction = {}", names[1..].join(", "), share());
        let step = if seed.is_multiple_of(4) { 2e-3 } else { 1e-3 };
        let wall = |normal: [i32; 3]| {
            let place = normal.map(|n| -0.15 * f64::from(n));
            format!("{{ kind = \"plane\", normal = {normal:?}, position = {place:?} }}")
        };
        let walls = [[1, 0, 0], [-1, 0, 0], [0, 1, 0], [0, -1, 0]].map(wall).join(", ");
        let text = on_plane([0.0, -G], &text, &contact, [step, 1.0]).replace(
            "shape = { kind = \"plane\" }\n",
            &format!("shape = [{{ kind = \"plane\" }}, {walls}]\n"),
        );
        let record = run(&text, &[]);
        let energy = series(&record, "energy.total");
        let kinetic = series(&record, "energy.kinetic");
        assert!(largest_rise(energy) < 1e-5 * energy[0].abs(), "{seed}: {:e}", largest_rise(energy));
        assert!(last(&record, "energy.kinetic") < 0.3 * kinetic[0], "{seed}");
    }
}

/// How contacts are solved is a setting beside the scheme, and contacts of other kinds stand beside a set.
#[test]
fn contacts_are_a_set_or_elements_beside_a_rigid_one() {
    let bodies = ball("lower", 0.1, [0.0, 0.0, 0.1], "")
        + &ball("upper", 0.1, [0.0, 0.0, 0.3], "")
        + &ball("rigid", 0.1, [1.0, 0.0, 0.11], "");
    let rigid = "[contacts.rigid]\nbase = \"ground\"\ntip = \"rigid\"\nrigid = true\n[outputs.rigid_force]\nkind = \"contact_force\"\n\
                 of = \"rigid\"\n";
    let contact = format!("tip = \"lower\"\nothers = [\"upper\"]\ndissipation = 1\n{rigid}");
    let set = on_plane([0.0, -G], &bodies, &contact, [1e-3, 1.0]);
    let elements = set.replace("kind = \"dynamics\"", "kind = \"dynamics\"\ncontacts = \"elements\"");
    for (text, is_set) in [(&set, true), (&elements, false)] {
        assert_eq!(session(text, &[]).simulation().system().contacts().is_empty(), !is_set);
        let record = run(text, &[]);
        let lower = last(&record, "lower.z");
        assert!((lower - (0.1 - 2.0 * G / 1e6)).abs() < 1e-9, "{lower}");
        assert!((last(&record, "upper.z") - (0.3 - 3.0 * G / 1e6)).abs() < 1e-9);
        assert!((last(&record, "rigid_force.normal") - G).abs() < 1e-9);
    }
    let other = set.replace("backward-euler\"", "hht\"\ncontacts = \"set\"");
    let found = refused(&other);
    assert!(found.contains("choose `scheme = \"backward-euler\"`, or remove `contacts`"), "{found}");
}

/// A model that names no scheme says that one for many contacts exists.
#[test]
fn many_parts_without_a_scheme_are_told_of_the_one_for_them() {
    let warned = |text: &str| {
        let found = Model::from_text("model.toml", text).document().expect("valid").warnings.render(false);
        found.contains("all touches of a step are solved at once")
    };
    let named = poured(2, "", [1e-3, 0.01]);
    let unnamed = named.replace("scheme = \"backward-euler\"\n", "");
    assert!(warned(&unnamed) && !warned(&named));
    assert!(!warned(&poured(1, "", [1e-3, 0.01]).replace("scheme = \"backward-euler\"\n", "")));
}

/// Impacts of a rigid contact leave the energy of the touches beside it.
#[test]
fn impacts_beside_a_loaded_set_supply_no_energy() {
    let bodies = ball("heavy", 0.5, [0.0, 0.0, 0.501], "").replace("mass = 1\n", "mass = 100\n")
        + &ball("light", 0.1, [2.0, 0.0, 1.6], "").replace("mass = 1\n", "mass = 0.01\n");
    let rigid = "[contacts.rigid]\nbase = \"ground\"\ntip = \"light\"\nrigid = true\nrestitution = 0.5";
    let contact = format!("tip = \"heavy\"\ndissipation = 1\n{rigid}");
    let text =
        on_plane([0.0, -G], &bodies, &contact, [1e-3, 1.5]).replace("stiffness = 1e6", "stiffness = 1e5");
    let record = run_without_warnings(&text, &[]);
    let (light, normal) = (last(&record, "light.z"), last(&record, "all.normal"));
    assert!(light < 0.3 && normal > 90.0 * G, "{light} {normal}");
    // It falls between its impacts, however little its weight is beside that of the other one.
    let velocity = series(&record, "v_light.v3");
    let floats = velocity.windows(2).filter(|pair| pair[0] != 0.0 && pair[0] == pair[1]).count();
    assert_eq!(floats, 0);
}

/// Parts of a list of `except` pass through each other and touch all others, however contacts are solved.
#[test]
fn excepted_parts_do_not_touch_each_other() {
    let balls = ball("a", 0.1, [0.0, 0.0, 0.2], "")
        + &ball("b", 0.1, [0.05, 0.0, 0.35], "")
        + &ball("c", 0.1, [0.0, 0.0, 0.55], "");
    let contact = "tip = \"a\"\nothers = [\"b\", \"c\"]\nexcept = [[\"a\", \"b\"]]\ndissipation = 20";
    let text = on_plane([0.0, -G], &balls, contact, [1e-3, 1.5]);
    for solution in ["set", "elements"] {
        let record = run(&text, &[("analysis.contacts", solution)]);
        let heights = ["a.z", "b.z", "c.z"].map(|name| last(&record, name));
        assert!(
            (heights[0] - 0.1).abs() < 2e-3 && (heights[1] - 0.1).abs() < 2e-3,
            "{solution}: {heights:?}"
        );
        assert!(heights[2] > 0.25, "{solution}: the third lies on the others: {heights:?}");
    }
}
