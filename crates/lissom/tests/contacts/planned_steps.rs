//! Friction of contacts with steps of a given size: a bristle that a step carries beyond its limit returns to it.

use crate::support::runs::run;
use crate::support::series::{last, series};

/// Gravity [m/s²].
const G: f64 = 9.81;
/// Coefficient of friction.
const MU: f64 = 0.25;

const SCHEMES: [&str; 6] =
    ["generalized-alpha", "hht", "radau-iia", "radau-iia-5", "radau-iia-9", "energy-decaying"];

fn on_plane(body: &str, contact: &str, end: f64) -> String {
    format!(
        "lissom = 1\ngravity = [0, 0, -{G}]\nground.shape = {{ kind = \"plane\" }}\n{body}\n[contacts.floor]\nbase = \"ground\"\n\
         tip = \"b\"\nstiffness = 1e5\ndissipation = 5\nfriction = {MU}\n{contact}\n[outputs.p]\nkind = \"position\"\nof = \"b\"\n\
         [outputs.c]\nkind = \"contact_force\"\nof = \"floor\"\n[analysis]\nkind = \"dynamics\"\nend = {end}\n"
    )
}

/// A block of 1 kg in its position of rest with a velocity, and a load along x.
fn block(velocity: f64, load: f64) -> String {
    let z = 0.05 - G / (4.0 * 1e5);
    let body = format!(
        "bodies.b = {{ mass = 1, inertia = {{ box = [0.3, 0.3, 0.1] }}, shape = {{ box = [0.3, 0.3, 0.1] }}, position = [0, 0, {z}], \
         velocity = [{velocity}, 0, 0] }}\n[loads.push]\nkind = \"force\"\non = \"b\"\nvector = [{load}, 0, 0]\n"
    );
    on_plane(&body, "", 0.6)
}

fn ball() -> String {
    let z = 0.1 - G / 1e5;
    let body = format!(
        "bodies.b = {{ mass = 1, inertia = {{ sphere = 0.1 }}, shape = {{ sphere = 0.1 }}, position = [0, 0, {z}], velocity = [1.5, 0, 0] }}"
    );
    on_plane(&body, "", 0.6)
}

/// No record has more friction than the normal forces allow.
fn friction_is_limited(record: &lissom::Record, what: &str) {
    for (friction, normal) in series(record, "c.friction").iter().zip(series(record, "c.normal")) {
        assert!(*friction <= 1.02 * MU * normal + 1e-9, "{what}: {friction} of {normal}");
    }
}

/// A block stops after v²/(2 μ g), a pushed one accelerates by F/m - μ g, and a ball rolls at 5/7 of its velocity, with every scheme and
/// step.
#[test]
fn blocks_stop_and_balls_roll_with_every_scheme_and_step() {
    for scheme in SCHEMES {
        for step in [2e-3, 1e-4] {
            let name = format!("\"{scheme}\"");
            let set = [("analysis.scheme", name.as_str()), ("analysis.step", &step.to_string())];
            let what = format!("{scheme} {step}");
            // A force that begins with the motion acts from the second half of a step on.
            let allowed = 1e-3 + 2.0 * step;
            let record = run(&block(1.0, 0.0), &set);
            let way = 1.0 / (2.0 * MU * G);
            assert!((last(&record, "p.x") / way - 1.0).abs() < allowed, "{what}: {}", last(&record, "p.x"));
            friction_is_limited(&record, &what);
            let record = run(&block(0.0, 2.0 * MU * G), &set);
            // It gains some mm/s before its bristles slip.
            let way = 0.5 * MU * G * 0.36;
            assert!((last(&record, "p.x") / way - 1.0).abs() < 5e-3, "{what}: {}", last(&record, "p.x"));
            friction_is_limited(&record, &what);
            let record = run(&ball(), &set);
            let until = 1.5 * 2.0 / (7.0 * MU * G);
            let way = 1.5 * until - 0.5 * MU * G * until * until + 1.5 * 5.0 / 7.0 * (0.6 - until);
            assert!(
                (last(&record, "p.x") / way - 1.0).abs() < allowed,
                "{what}: {} {way}",
                last(&record, "p.x")
            );
            friction_is_limited(&record, &what);
        }
    }
}
