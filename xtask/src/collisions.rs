//! `cargo xtask collisions`: random collisions through one-sided springs between points, with default settings, against references
//! that resolve them: two free masses, and a pin on a rotor that strikes a spring in every turn. Between collisions the motion is so
//! smooth that steps are long. A seed determines every case.

use lissom::Model;

use crate::cases::{CaseArguments, results};
use crate::random::draw::Draw;

/// Position, and its rate.
type Motion = [[f64; 2]; 2];

/// Errors relative to the initial velocity that are accurate: steps are controlled by the displacement of the whole motion, of which
/// a contact is a small part.
const ALLOWED: f64 = 3e-4;
/// A change of the initial velocity by the default tolerance: motions that amplify it are allowed to err by as much more.
const CHANGE: f64 = 1e-5;
/// Steps of a reference in the period of the spring.
const STEPS_PER_PERIOD: f64 = 4000.0;

/// A random collision.
#[derive(Clone, Copy, Debug)]
enum Case {
    /// Two masses, the second one at rest in the origin; the first starts at `from` with the velocity (v, 0).
    Points { masses: [f64; 2], from: [f64; 2], velocity: f64, length: f64, stiffness: f64, end: f64 },
    /// A pin at unit distance on a rotor of unit inertia, and a spring at the distance `base`.
    Pin { base: f64, angle: f64, velocity: f64, length: f64, stiffness: f64, damping: f64, end: f64 },
}

impl Case {
    fn new(seed: u64, index: u64) -> Self {
        let draw = &mut Draw::new(seed ^ 0xc011, index);
        if draw.chance(0.5) {
            let (length, velocity) = (draw.size(0.02, 0.5), draw.size(0.05, 20.0));
            let distance = draw.between(2.0, 10.0);
            // Head-on collisions are frequent in models that people write.
            let offset = if draw.chance(0.3) { 0.0 } else { length * draw.between(0.0, 0.95) };
            let stiffness = draw.size(1e2, 1e6);
            let masses = [draw.size(0.2, 5.0), draw.size(0.2, 5.0)];
            let end = (distance / velocity) * draw.size(2.0, 100.0);
            Self::Points { masses, from: [-distance, offset], velocity, length, stiffness, end }
        } else {
            let base = draw.between(1.0, 1.3);
            let length = (base - 1.0) + draw.size(0.005, 0.15);
            let (angle, velocity) = (-draw.between(0.8, 3.0), draw.size(1.0, 30.0));
            let (stiffness, damping) = (draw.size(1e2, 1e5), draw.size(1e-3, 0.1));
            Self::Pin { base, angle, velocity, length, stiffness, damping, end: draw.size(2.0, 15.0) }
        }
    }

    /// The model file.
    fn text(self) -> String {
        match self {
            Self::Points { masses, from: [x, y], velocity, length, stiffness, end } => format!(
                "lissom = 1\n[point_masses.a]\nmass = {}\nposition = [{x}, {y}, 0]\nvelocity = [{velocity}, 0, 0]\n[point_masses.b]\n\
                 mass = {}\nposition = [0, 0, 0]\n[springs.c]\nkind = \"point\"\nbase = \"a\"\ntip = \"b\"\nlength = {length}\n\
                 stiffness = {stiffness}\nside = \"compression\"\n[outputs.o]\nkind = \"velocity\"\nof = \"a\"\n[analysis]\n\
                 kind = \"dynamics\"\nend = {end}\n",
                masses[0], masses[1]
            ),
            Self::Pin { base, angle, velocity, length, stiffness, damping, end } => format!(
                "lissom = 1\n[bodies.w]\nmass = 1\ninertia = [1, 1, 1]\nangular_velocity = [0, 0, {velocity}]\n[joints.h]\n\
                 kind = \"revolute\"\nbase = \"ground\"\ntip = \"w\"\naxis = [0, 0, 1]\n[springs.c]\nkind = \"point\"\n\
                 base = \"ground\"\ntip = \"w\"\nat_base = [{base}, 0, 0]\nat_tip = [\"cos({angle})\", \"sin({angle})\", 0]\n\
                 length = {length}\nstiffness = {stiffness}\nside = \"compression\"\n[springs.d]\nkind = \"torsional\"\n\
                 joint = \"h\"\ndamping = {damping}\n[outputs.o]\nkind = \"angular_velocity\"\nof = \"w\"\n[analysis]\n\
                 kind = \"dynamics\"\nend = {end}\n"
            ),
        }
    }

    /// Names of the columns that are compared, and the initial velocity.
    fn compared(self) -> ([&'static str; 2], f64) {
        match self {
            Self::Points { velocity, .. } => (["o.v1", "o.v2"], velocity),
            Self::Pin { velocity, .. } => (["o.w3", "o.w1"], velocity),
        }
    }

    /// The compared values at the end, with an initial velocity that is changed by a factor.
    fn reference(self, factor: f64) -> [f64; 2] {
        match self {
            Self::Points { masses: [m, n], from, velocity, length, stiffness, end } => {
                let reduced = m * n / (m + n);
                let acceleration = |r: [f64; 2], _: [f64; 2]| {
                    let distance = r[0].hypot(r[1]);
                    r.map(|x| stiffness / reduced * (length - distance).max(0.0) * x / distance.max(1e-300))
                };
                // To the place where the spring begins to act, and on after it has ceased to act.
                let speed = factor * velocity;
                let entry = -(length * length - from[1] * from[1]).sqrt();
                let size = std::f64::consts::TAU * (reduced / stiffness).sqrt() / STEPS_PER_PERIOD;
                let mut time = (entry - from[0]) / speed;
                let mut motion = [[entry, from[1]], [speed, 0.0]];
                while time < end {
                    motion = advance(motion, size.min(end - time), &acceleration);
                    time += size;
                    if motion[0][0].hypot(motion[0][1]) > length {
                        break;
                    }
                }
                let [x, y] = motion[1];
                [speed + reduced / m * (x - speed), reduced / m * y]
            }
            Self::Pin { base, angle, velocity, length, stiffness, damping, end } => {
                let acceleration = |[angle, _]: [f64; 2], [rate, _]: [f64; 2]| {
                    let distance = (base * base + 1.0 - 2.0 * base * angle.cos()).sqrt();
                    let slope = base * angle.sin() / distance.max(1e-300);
                    [stiffness * (length - distance).max(0.0) * slope - damping * rate, 0.0]
                };
                let size = (stiffness.sqrt() * STEPS_PER_PERIOD / std::f64::consts::TAU).recip();
                let steps = (end / size).ceil();
                let mut motion = [[angle, 0.0], [factor * velocity, 0.0]];
                for _ in 0..steps as u64 {
                    motion = advance(motion, end / steps, &acceleration);
                }
                [motion[1][0], 0.0]
            }
        }
    }
}

/// One step of the classical Runge-Kutta method.
fn advance(
    [place, rate]: Motion,
    size: f64,
    acceleration: &dyn Fn([f64; 2], [f64; 2]) -> [f64; 2],
) -> Motion {
    let add = |a: [f64; 2], b: [f64; 2], factor: f64| [a[0] + factor * b[0], a[1] + factor * b[1]];
    let mut sums = [[0.0; 2]; 2];
    let mut slope = [[0.0; 2]; 2];
    for (fraction, weight) in [(0.0, 1.0), (0.5, 2.0), (0.5, 2.0), (1.0, 1.0)] {
        let at = add(place, slope[0], fraction * size);
        let speed = add(rate, slope[1], fraction * size);
        slope = [speed, acceleration(at, speed)];
        sums = [add(sums[0], slope[0], weight / 6.0), add(sums[1], slope[1], weight / 6.0)];
    }
    [add(place, sums[0], size), add(rate, sums[1], size)]
}

/// Result of a case.
enum Outcome {
    Accurate(f64),
    /// A warning, or no result.
    Reported(String),
    /// The error, and that of a reference with a changed start.
    Wrong([f64; 2]),
}

/// Tries collisions; whether none ended well with a wrong result.
pub(crate) fn collisions(arguments: &CaseArguments) -> bool {
    let case = |index| Case::new(arguments.seed, index);
    if arguments.text {
        print!("{}", case(arguments.first).text());
        return true;
    }
    let range = arguments.range();
    let found = results(range, arguments.threads, None, |index| trial(case(index)));
    let (mut errors, mut reported, mut wrong) = (Vec::new(), 0, 0);
    for (index, outcome) in &found {
        match outcome {
            Outcome::Accurate(error) => errors.push(*error),
            Outcome::Reported(words) => {
                reported += 1;
                println!("{index}: reported: {words}");
            }
            Outcome::Wrong([error, growth]) => {
                wrong += 1;
                println!(
                    "{index}: errs by {error:.1e} without a warning; a change of the start grows by {growth:.1}: {:?}",
                    case(*index)
                );
            }
        }
    }
    errors.sort_by(f64::total_cmp);
    let median = errors.get(errors.len() / 2).copied().unwrap_or_default();
    println!(
        "{} collisions of seed {}: {} accurate (median {median:.1e}), {reported} reported, {wrong} wrong",
        found.len(),
        arguments.seed,
        errors.len()
    );
    wrong == 0
}

/// Runs a case, and compares its end with the reference.
fn trial(case: Case) -> Outcome {
    let (columns, velocity) = case.compared();
    let mut session = match Model::from_text("model.toml", &case.text()).session() {
        Ok(session) => session,
        Err(error) => return Outcome::Reported(error.to_string()),
    };
    let (_, report) = session.run().unwrap_or_else(lissom::Results::from).into_parts();
    if !report.is_complete() {
        return Outcome::Reported(format!("{:?}", report.stopped));
    }
    if let Some(warning) = session.warnings().next() {
        return Outcome::Reported(warning.code().to_owned());
    }
    let difference = |one: [f64; 2], other: [f64; 2]| {
        one.iter().zip(other).map(|(one, other)| (one - other).abs()).fold(0.0, f64::max) / velocity
    };
    let exact = case.reference(1.0);
    let error = difference(columns.map(|name| session.value(name).unwrap_or(f64::NAN)), exact);
    let growth = difference(case.reference(1.0 + CHANGE), exact) / CHANGE;
    if error <= ALLOWED.max(10.0 * CHANGE * growth) {
        Outcome::Accurate(error)
    } else {
        Outcome::Wrong([error, growth])
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Masses that collide head-on exchange the velocities that energy and momentum determine.
    #[test]
    fn the_reference_of_a_central_collision_is_the_elastic_one() {
        let case = Case::Points {
            masses: [2.0, 1.0],
            from: [-3.0, 0.0],
            velocity: 3.0,
            length: 0.1,
            stiffness: 1e4,
            end: 10.0,
        };
        assert!((case.reference(1.0)[0] - 1.0).abs() < 1e-8, "{:?}", case.reference(1.0));
    }
}
