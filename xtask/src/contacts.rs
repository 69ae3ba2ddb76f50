//! `cargo xtask contacts`: random solids that fall on the ground and on each other, with compliant and with rigid contacts and default
//! settings. None may gain energy, none may penetrate deeper than its energy allows. A seed determines every case.

use lissom::Model;

use crate::cases::{CaseArguments, results};
use crate::random::draw::Draw;

/// Gains of energy that are errors, relative to the largest energy of the motion.
const ALLOWED_GAIN: f64 = 1e-4;
/// Penetrations of rigid contacts that are errors [m].
const RIGID_PENETRATION: f64 = 1e-5;
/// Compliant contacts may be deeper by this factor than by the energy of one part: others strike it at the same time.
const DEPTH_FACTOR: f64 = 2.0;
/// Weight of a mass of 1 kg [N].
const GRAVITY: f64 = 9.81;

/// What is tried.
#[derive(clap::Args)]
pub(crate) struct ContactsArguments {
    #[command(flatten)]
    cases: CaseArguments,
    /// Share of scenes that may end with an error or a warning
    #[arg(long, default_value_t = 0.05)]
    reported: f64,
}

/// A random scene.
struct Scene {
    text: String,
    contacts: Vec<String>,
    /// Largest potential and kinetic energy at the start, as if all parts fell to the lowest point of a ground that is not inclined [J].
    energy: f64,
    /// Stiffness and exponent; none if contacts are rigid.
    law: Option<[f64; 2]>,
}

/// Solids that touch each other and every ground. With boxes that touch each other a scene would take ten seconds.
const FREE: [&str; 4] = ["sphere", "sphere", "sphere", "box"];
/// Solids that touch a plane.
const ON_PLANE: [&str; 6] = ["sphere", "box", "capsule", "cylinder", "ellipsoid", "hull"];

impl Scene {
    fn new(seed: u64, index: u64) -> Self {
        let draw = &mut Draw::new(seed ^ 0x5ce7e, index);
        let tilt = if draw.chance(0.3) { draw.between(0.0, 0.4) } else { 0.0 };
        let is_plane = draw.chance(0.7);
        let ground = if is_plane {
            format!("{{ kind = \"plane\", normal = [{tilt}, 0, 1] }}")
        } else {
            "{ box = [8, 8, 0.2], position = [0, 0, -0.1] }".to_owned()
        };
        let is_rigid = draw.chance(0.5);
        let law = (!is_rigid).then(|| [draw.size(1e4, 1e6), draw.of(&[1.0, 1.5])]);
        let surface = match law {
            Some([stiffness, exponent]) => format!("stiffness = {stiffness}\nexponent = {exponent}\n"),
            None => "rigid = true\n".to_owned(),
        };
        let restitution = draw.between(if is_rigid { 0.0 } else { 0.1 }, 1.0);
        let friction = if draw.chance(0.2) { 0.0 } else { draw.between(0.05, 1.0) };
        let law_text = format!("{surface}restitution = {restitution}\nfriction = {friction}\n");
        let is_alone = draw.chance(0.4);
        let count = if is_alone { 1 } else { 2 };
        let known: &[&str] = if is_alone && is_plane { &ON_PLANE } else { &FREE };
        let mut text = format!("lissom = 1\ngravity = [0, 0, {}]\n[ground]\nshape = {ground}\n", -GRAVITY);
        let (mut contacts, mut energy) = (Vec::new(), 0.0);
        let mut contact = |text: &mut String, base: &str, tip: &str| {
            let name = format!("{base}_{tip}");
            text.extend([format!(
                "[contacts.{name}]\nbase = \"{base}\"\ntip = \"{tip}\"\n{law_text}[outputs.{name}]\nkind = \"contact_force\"\nof = \"{name}\"\n"
            )]);
            contacts.push(name);
        };
        for number in 0..count {
            let (name, kind) = (format!("p{number}"), draw.of(known));
            let size = draw.between(0.05, 0.2);
            let mass = draw.size(0.2, 5.0);
            let shape = match kind {
                "sphere" => format!("{{ sphere = {size} }}"),
                "box" => format!("{{ box = [{}, {size}, {}] }}", 2.0 * size, 1.5 * size),
                "capsule" => format!("{{ kind = \"capsule\", radius = {}, length = {size} }}", 0.4 * size),
                "cylinder" => format!("{{ cylinder = [{size}, {}] }}", 0.8 * size),
                "ellipsoid" => {
                    format!(
                        "{{ kind = \"ellipsoid\", semi_axes = [{size}, {}, {}] }}",
                        0.7 * size,
                        0.5 * size
                    )
                }
                _ => format!(
                    "{{ kind = \"hull\", points = [[{size}, 0, -{size}], [-{size}, {size}, -{size}], [-{size}, -{size}, -{size}], [0, 0, {size}]] }}"
                ),
            };
            let moment = 0.4 * mass * size * size;
            // One above the other, so that none overlap at the start.
            let height = 0.6 + 0.7 * f64::from(number) + draw.between(0.0, 0.1);
            let aside = draw.between(-0.3, 0.3) * size;
            let velocity = [draw.between(-1.0, 1.0), draw.between(-1.0, 1.0), draw.between(-1.0, 1.0)];
            let turn = [draw.between(-2.0, 2.0), draw.between(-2.0, 2.0), draw.between(-2.0, 2.0)];
            let spin = [draw.between(-5.0, 5.0), draw.between(-5.0, 5.0), draw.between(-5.0, 5.0)];
            text.extend([format!(
                "[bodies.{name}]\nmass = {mass}\ninertia = [{moment}, {}, {}]\nshape = {shape}\nposition = [{aside}, 0, {height}]\n\
                 velocity = {velocity:?}\nrotation = {turn:?}\nangular_velocity = {spin:?}\n",
                1.1 * moment,
                0.9 * moment,
            )]);
            energy += mass * GRAVITY * height
                + 0.5 * mass * velocity.iter().map(|v| v * v).sum::<f64>()
                + 0.55 * moment * spin.iter().map(|w| w * w).sum::<f64>();
            contact(&mut text, "ground", &name);
            for other in 0..number {
                contact(&mut text, &format!("p{other}"), &name);
            }
        }
        text.push_str("[outputs.energy]\nkind = \"energy\"\n[analysis]\nkind = \"dynamics\"\nend = 1.5\n");
        Self { text, contacts, energy, law }
    }
}

/// Result of a scene.
enum Outcome {
    Good,
    /// A warning, or no result.
    Reported(String),
    Wrong(String),
}

/// Tries scenes; whether none ended well with a wrong result, and few were reported.
pub(crate) fn contacts(arguments: &ContactsArguments) -> bool {
    let scene = |index| Scene::new(arguments.cases.seed, index);
    if arguments.cases.text {
        print!("{}", scene(arguments.cases.first).text);
        return true;
    }
    let range = arguments.cases.range();
    let found = results(range, arguments.cases.threads, None, |index| trial(&scene(index)));
    let (mut good, mut reported, mut wrong) = (0, 0, 0);
    for (index, outcome) in &found {
        match outcome {
            Outcome::Good => good += 1,
            Outcome::Reported(words) => {
                reported += 1;
                println!("{index}: reported: {words}");
            }
            Outcome::Wrong(words) => {
                wrong += 1;
                println!("{index}: {words}");
            }
        }
    }
    println!(
        "{} scenes of seed {}: {good} good, {reported} reported, {wrong} wrong",
        found.len(),
        arguments.cases.seed
    );
    wrong == 0 && f64::from(reported) <= arguments.reported * found.len() as f64
}

fn trial(scene: &Scene) -> Outcome {
    let mut session = match Model::from_text("scene.toml", &scene.text).session() {
        Ok(session) => session,
        Err(error) => return Outcome::Reported(error.to_string()),
    };
    let (record, report) = session.run().unwrap_or_else(lissom::Results::from).into_parts();
    if let Some(error) = report.error() {
        return Outcome::Reported(error.to_string());
    }
    if let Some(warning) = session.warnings().next() {
        return Outcome::Reported(warning.code().to_owned());
    }
    let energies = record.column("energy", "total").unwrap_or_default();
    let least = energies.iter().copied().fold(f64::INFINITY, f64::min);
    let scale = scene.energy.max(energies.first().map_or(0.0, |start| start - least));
    let mut before = f64::INFINITY;
    for (time, &energy) in record.times.iter().zip(energies) {
        if energy > before + ALLOWED_GAIN * scale {
            return Outcome::Wrong(format!(
                "gains {:.2e} of its energy by {time} s",
                (energy - before) / scale
            ));
        }
        before = before.min(energy);
    }
    let depth = match scene.law {
        None => RIGID_PENETRATION,
        Some([stiffness, exponent]) => {
            DEPTH_FACTOR * (scale * (exponent + 1.0) / stiffness).powf(1.0 / (exponent + 1.0))
        }
    };
    for name in &scene.contacts {
        let gaps = record.column(name, "gap").unwrap_or_default();
        let deepest = gaps.iter().copied().fold(f64::INFINITY, f64::min);
        if deepest < -depth || gaps.is_empty() {
            return Outcome::Wrong(format!(
                "contact `{name}` penetrates by {:.2e} m of {depth:.2e} m",
                -deepest
            ));
        }
    }
    Outcome::Good
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn scenes_are_models() {
        for index in 0..30 {
            let scene = Scene::new(7, index);
            let session = Model::from_text("scene.toml", &scene.text).session();
            assert!(
                session.is_ok(),
                "{index}: {}\n{}",
                session.err().map_or(String::new(), |e| e.to_string()),
                scene.text
            );
        }
    }
}
