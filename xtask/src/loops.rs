//! `cargo xtask loops`: random planar mechanisms driven at constant speed, of revolute joints that are all redundant in space, with default
//! settings, against closed forms at every record, also between the ends of steps. They are from a tenth of a millimetre to 100 m
//! large, up to 5000 km away from the origin, turned in space, with axes out of line by less than the geometric tolerance, and carry point
//! masses. A seed determines every case.

use std::fmt::Write;

use lissom::Model;
use lissom_motion::{Rotation, Vector3};

use crate::cases::{CaseArguments, results};
use crate::random::draw::Draw;

/// Errors of angles [rad] and displacements, relative to the largest one, that are accurate at the default tolerance of 1e-5.
const ALLOWED: f64 = 1e-4;
/// Errors of the driving moment and of a step of statics, relative to the largest one, that are accurate.
const ALLOWED_MOMENT: f64 = 2e-3;
/// Largest angle by which axes are out of line [rad].
const OUT_OF_LINE: f64 = 3e-6;

/// A crank with a coupler to a rocker or to a slider, in lengths of the crank.
#[derive(Clone, Debug)]
struct Case {
    coupler: f64,
    /// Length of the rocker and distance of its pivot; none for a slider on a line through the pivot of the crank.
    rocker: Option<[f64; 2]>,
    /// Angle of the crank at the start [rad], and its rate [rad/s].
    crank: [f64; 2],
    /// Length of the crank [m].
    size: f64,
    /// Masses of crank, coupler, rocker or slider, and of a point on the coupler [kg].
    masses: [f64; 4],
    /// Point mass as a fraction of the coupler, and its joint.
    point: (f64, &'static str),
    origin: Vector3,
    turn: Rotation,
    out_of_line: f64,
    gravity: f64,
    is_static: bool,
}

impl Case {
    fn new(seed: u64, index: u64) -> Self {
        let draw = &mut Draw::new(seed ^ 0x1005, index);
        let coupler = draw.between(2.0, 4.0);
        // Grashof's condition: the crank turns round, not closer than a tenth to a dead centre of the others.
        let rocker = draw.chance(0.6).then(|| {
            let rocker = draw.between(1.5, 3.5);
            let most = (coupler + rocker - 1.1).min(4.5);
            let least = ((coupler - rocker).abs() + 1.1).max(1.2);
            [rocker, draw.between(least.min(most), most)]
        });
        let size = draw.size(1e-4, 100.0);
        // Positions have sixteen digits.
        let far = if size >= 0.05 { draw.of(&[0.0, 1e3, 1e6, 5e6]) } else { draw.of(&[0.0, 100.0 * size]) };
        let [x, y, z] = draw.direction();
        let [u, v, w] = draw.direction();
        let mass = |draw: &mut Draw| draw.size(0.1, 10.0) * size.powi(3);
        let is_static = draw.chance(0.2);
        Self {
            coupler,
            rocker,
            crank: [draw.between(0.0, 6.2), draw.size(1.0, 300.0)],
            size,
            masses: [mass(draw), mass(draw), mass(draw), if draw.chance(0.4) { mass(draw) } else { 0.0 }],
            point: (draw.between(0.1, 0.9), draw.of(&["clamp", "rigid_link", "spherical"])),
            origin: far * Vector3::new(x, y, z).normalize(),
            turn: Rotation::exponential(&(3.0 * Vector3::new(u, v, w))),
            out_of_line: if draw.chance(0.4) { draw.size(1e-9, OUT_OF_LINE) } else { 0.0 },
            // Without weight a position of rest has nothing to compare.
            gravity: if is_static || draw.chance(0.5) { draw.between(1.0, 20.0) } else { 0.0 },
            is_static,
        }
    }

    /// Positions of the pin of the crank and of the far joint in the plane, at an angle of the crank.
    fn joints(&self, angle: f64) -> [[f64; 2]; 2] {
        let pin = [angle.cos(), angle.sin()];
        let Some([rocker, distance]) = self.rocker else {
            return [pin, [pin[0] + (self.coupler.powi(2) - pin[1].powi(2)).sqrt(), 0.0]];
        };
        let (x, y) = (pin[0] - distance, pin[1]);
        let between = x.hypot(y);
        let cosine = (rocker * rocker + between * between - self.coupler.powi(2)) / (2.0 * rocker * between);
        let far = y.atan2(x) - cosine.clamp(-1.0, 1.0).acos();
        [pin, [distance + rocker * far.cos(), rocker * far.sin()]]
    }

    /// Angle of the rocker or position of the slider.
    fn follower(&self, angle: f64) -> f64 {
        let [_, far] = self.joints(angle);
        self.rocker.map_or(far[0], |[_, distance]| far[1].atan2(far[0] - distance))
    }

    /// Centres of the masses in the plane, and orientations [rad], in lengths of the crank.
    fn places(&self, angle: f64) -> [([f64; 2], f64); 4] {
        let [pin, far] = self.joints(angle);
        let along = |share: f64| [0, 1].map(|k| pin[k] + share * (far[k] - pin[k]));
        let direction = (far[1] - pin[1]).atan2(far[0] - pin[0]);
        let last = match self.rocker {
            Some([_, distance]) => ([0.5 * (far[0] + distance), 0.5 * far[1]], self.follower(angle)),
            None => (far, 0.0),
        };
        [(pin.map(|x| 0.5 * x), angle), (along(0.5), direction), last, (along(self.point.0), direction)]
    }

    /// Kinetic and potential energy at an angle of the crank [J].
    fn energy(&self, angle: f64) -> f64 {
        let (rate, step) = (if self.is_static { 0.0 } else { self.crank[1] }, 1e-5);
        let [before, at, after] = [angle - step, angle, angle + step].map(|angle| self.places(angle));
        (0..4)
            .map(|k| {
                let moved = [0, 1].map(|axis| (after[k].0[axis] - before[k].0[axis]) / (2.0 * step) * rate);
                let turned = ((after[k].1 - before[k].1 + 3.0).rem_euclid(std::f64::consts::TAU) - 3.0)
                    / (2.0 * step)
                    * rate;
                // Bodies have the same inertia about all axes, a point has none.
                let inertia = if k < 3 { INERTIA } else { 0.0 };
                let square = moved[0].powi(2) + moved[1].powi(2) + inertia * turned.powi(2);
                self.masses[k] * (0.5 * self.size.powi(2) * square + self.gravity * self.size * at[k].0[1])
            })
            .sum()
    }

    /// Driving moment [N m].
    fn moment(&self, angle: f64) -> f64 {
        // The second difference of positions in it: a compromise between round-off and truncation.
        let step = 1e-3;
        let difference = |step: f64| (self.energy(angle + step) - self.energy(angle - step)) / (2.0 * step);
        (4.0 * difference(step) - difference(2.0 * step)) / 3.0
    }

    fn end(&self) -> f64 {
        if self.is_static { 1.0 } else { 2.3 * std::f64::consts::TAU / self.crank[1] }
    }

    /// Angle of the crank at a time.
    fn angle(&self, time: f64) -> f64 {
        self.crank[0] + if self.is_static { time } else { self.crank[1] * time }
    }

    /// The model file.
    fn text(&self) -> String {
        let point = |[x, y]: [f64; 2]| self.origin + self.turn.apply(&(self.size * Vector3::new(x, y, 0.0)));
        let list = |value: Vector3| format!("[{}, {}, {}]", value.x, value.y, value.z);
        let [pin, far] = self.joints(self.crank[0]);
        let places = self.places(self.crank[0]);
        let axis = list(self.turn.apply(&Vector3::z()));
        let tilted = list(self.turn.apply(&Vector3::new(self.out_of_line, 0.5 * self.out_of_line, 1.0)));
        // Writing to a string cannot fail.
        let mut text = format!(
            "lissom = 1\ngravity = {}\n",
            list(self.turn.apply(&Vector3::new(0.0, -self.gravity, 0.0)))
        );
        for (k, name) in ["crank", "coupler", "last"].into_iter().enumerate() {
            let inertia = INERTIA * self.masses[k] * self.size.powi(2);
            let _ = writeln!(
                text,
                "bodies.{name} = {{ mass = {}, inertia = [{inertia}, {inertia}, {inertia}], position = {} }}",
                self.masses[k],
                list(point(places[k].0))
            );
        }
        let mut join = |name: &str, kind: &str, base: &str, tip: &str, at: [f64; 2], axis: &str| {
            let axis = if axis.is_empty() { String::new() } else { format!(", axis = {axis}") };
            let _ = writeln!(
                text,
                "joints.{name} = {{ kind = \"{kind}\", base = \"{base}\", tip = \"{tip}\", at = {}{axis} }}",
                list(point(at))
            );
        };
        join("a", "revolute", "ground", "crank", [0.0, 0.0], &axis);
        join("b", "revolute", "crank", "coupler", pin, &tilted);
        join("c", "revolute", "coupler", "last", far, &axis);
        match self.rocker {
            Some([_, distance]) => join("d", "revolute", "ground", "last", [distance, 0.0], &tilted),
            None => join("d", "prismatic", "ground", "last", far, &list(self.turn.apply(&Vector3::x()))),
        }
        if self.masses[3] > 0.0 {
            join("p", self.point.1, "coupler", "point", places[3].0, "");
            let _ = writeln!(
                text,
                "point_masses.point = {{ mass = {}, position = {} }}",
                self.masses[3],
                list(point(places[3].0))
            );
        }
        let (rate, kind) = if self.is_static { (1.0, "statics") } else { (self.crank[1], "dynamics") };
        let steps = if self.is_static { ", steps = 7, ramp = false" } else { "" };
        text + &format!(
            "joints.drive = {{ kind = \"prescribed_rotation\", joint = \"a\", rotation = \"{rate}*t\" }}\n\
             outputs.m = {{ kind = \"reaction\", of = \"drive\" }}\noutputs.d = {{ kind = \"relative\", of = \"d\" }}\n\
             analysis = {{ kind = \"{kind}\", end = {}{steps} }}\n",
            self.end()
        )
    }
}

/// Inertia of a body about its centre, relative to its mass and the square of the crank.
const INERTIA: f64 = 0.1;

/// Result of a case.
enum Outcome {
    /// Errors of the motion and of the moment.
    Accurate([f64; 2]),
    /// A warning, or no result.
    Reported(String),
    Wrong([f64; 2]),
}

/// Tries mechanisms; whether none ended well with a wrong result.
pub(crate) fn loops(arguments: &CaseArguments) -> bool {
    let case = |index| Case::new(arguments.seed, index);
    if arguments.text {
        print!("{}", case(arguments.first).text());
        return true;
    }
    let range = arguments.range();
    let found = results(range, arguments.threads, None, |index| trial(&case(index)));
    let (mut errors, mut reported, mut wrong) = ([Vec::new(), Vec::new()], 0, 0);
    for (index, outcome) in &found {
        match outcome {
            Outcome::Accurate(own) => errors.iter_mut().zip(own).for_each(|(all, own)| all.push(*own)),
            Outcome::Reported(words) => {
                reported += 1;
                println!("{index}: reported: {words}");
            }
            Outcome::Wrong([motion, moment]) => {
                wrong += 1;
                println!(
                    "{index}: errs by {motion:.1e}, the moment by {moment:.1e}, without a warning: {:?}",
                    case(*index)
                );
            }
        }
    }
    for all in &mut errors {
        all.sort_by(f64::total_cmp);
    }
    let [motion, moment] = errors.each_ref().map(|all| all.get(all.len() / 2).copied().unwrap_or_default());
    println!(
        "{} loops of seed {}: {} accurate (median {motion:.1e}, of moments {moment:.1e}), {reported} reported, {wrong} wrong",
        found.len(),
        arguments.seed,
        errors[0].len()
    );
    // A mechanism out of line by less than the tolerance runs, and few say that their geometry does not fit.
    wrong == 0 && 20 * reported <= found.len()
}

/// Runs a case, and compares its records with the closed form.
fn trial(case: &Case) -> Outcome {
    let mut session = match Model::from_text("model.toml", &case.text()).session() {
        Ok(session) => session,
        Err(error) => return Outcome::Reported(error.to_string()),
    };
    let (record, report) = session.run().unwrap_or_else(lissom::Results::from).into_parts();
    if !report.is_complete() {
        return Outcome::Reported(format!("{:?}", report.stopped));
    }
    // Forces of redundant joints are not asked for; a misfit is small.
    let codes = session.warnings().map(|warning| warning.code().to_owned());
    if let Some(code) = codes.into_iter().find(|code| code != "redundant-misfit") {
        return Outcome::Reported(code);
    }
    let column = |output: &str, component: &str| record.column(output, component).unwrap_or_default();
    let is_turn = case.rocker.is_some();
    let found = column("d", if is_turn { "angle" } else { "displacement" });
    let (mut error, mut largest) = ([0.0_f64; 2], [f64::from(u8::from(is_turn)), 0.0_f64]);
    let start = case.follower(case.crank[0]);
    for ((time, found), moment) in record.times.iter().zip(found).zip(column("m", "moment")) {
        let angle = case.angle(*time);
        let expected = case.follower(angle) - start;
        let difference = if is_turn { (found - expected).sin() } else { found / case.size - expected };
        error[0] = error[0].max(difference.abs());
        largest[0] = largest[0].max(expected.abs());
        let expected = case.moment(angle);
        error[1] = error[1].max((moment.abs() - expected.abs()).abs());
        largest[1] = largest[1].max(expected.abs());
    }
    let errors = [error[0] / largest[0], if largest[1] > 0.0 { error[1] / largest[1] } else { 0.0 }];
    let is_accurate = errors[0] <= ALLOWED && errors[1] <= ALLOWED_MOMENT && record.times.len() > 5;
    if is_accurate { Outcome::Accurate(errors) } else { Outcome::Wrong(errors) }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The moment against the static one of a slider crank under its weight, by virtual work of the crank alone.
    #[test]
    fn the_moment_of_a_crank_balances_its_weight() {
        let mut case = Case::new(1, 0);
        (case.rocker, case.is_static, case.gravity, case.size) = (None, true, 10.0, 2.0);
        case.masses = [3.0, 0.0, 0.0, 0.0];
        assert!((case.moment(0.7) - 30.0 * 0.7_f64.cos()).abs() < 1e-6);
    }
}
