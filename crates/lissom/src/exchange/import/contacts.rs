//! Which bodies touch each other, and by which law: from masks of their shapes, and the contacts of the model file that state it.
//!
//! MuJoCo prescribes how a penetration r decays, r'' + d (b r' + k r) = (1 - d) a with the acceleration a without contact. For a mass m
//! the force is that of a spring and a damper,
//!
//! ```text
//! K = m/((1 - d) T² ζ²),      B = 2 m/((1 - d) T)      for a time constant T and a damping ratio ζ
//! K = m s/(1 - d),            B = m c/(1 - d)          for the negative numbers -s and -c
//! ```
//!
//! with the largest impedance d; at rest it yields the same penetration. The dissipation a = B/(m g) has the same damping at this
//! penetration. m is the mass of all bodies that joints connect, the largest one of a contact.

use std::collections::{BTreeMap, BTreeSet};
use std::fmt::Write;

use super::{Link, Robot, VisualShape};

/// How a shape touches others.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Touch {
    /// Bits of the shape, and bits of others that it touches: two shapes touch if the first of one and the second of the other share
    /// a bit.
    pub masks: [u32; 2],
    /// Priority: that of two shapes with the higher one decides the law.
    pub priority: f64,
    /// Weight of its softness in the average of two shapes.
    pub mixing: f64,
    /// Whether two such shapes touch without friction.
    pub is_frictionless: bool,
    /// Group of shapes that do not touch each other.
    pub group: Option<usize>,
    /// Law of its touches.
    pub law: TouchLaw,
}

/// Friction and softness of a touch.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TouchLaw {
    /// Coefficient of sliding friction.
    pub friction: f64,
    /// Time constant [s] and damping ratio, both positive; or stiffness and damping per mass [1/s², 1/s] with negative sign.
    pub softness: [f64; 2],
    /// Impedance, below 1.
    pub impedance: f64,
}

/// Two links with a law of their own.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ContactPair {
    /// Indices of the links.
    pub links: [usize; 2],
    /// Law of their touches.
    pub law: TouchLaw,
}

/// How links touch each other, besides masks and laws of their shapes.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct ContactRules {
    /// Pairs of links that do not touch.
    pub excluded: Vec<[usize; 2]>,
    /// Pairs of links that touch, whatever their masks are.
    pub pairs: Vec<ContactPair>,
    /// Whether bodies that a joint connects do not touch, except to the ground.
    pub filters_parents: bool,
    /// Whether nothing touches.
    pub is_disabled: bool,
    /// Whether the friction of two shapes is the lower of both, instead of the higher.
    pub takes_lower_friction: bool,
    /// Step of the description's own solver [s].
    pub step: Option<f64>,
}

/// Reference acceleration of dissipation without gravity [m/s²].
const GRAVITY: f64 = 9.81;
/// Greatest step of the analysis [s].
const MAX_STEP: f64 = 5e-3;
/// Step of descriptions that have none [s].
const STEP: f64 = 2e-3;

impl TouchLaw {
    /// The law of shapes whose description states no softness, with a coefficient of friction.
    pub(super) fn with_friction(friction: f64) -> Self {
        Self { friction, softness: [0.02, 1.0], impedance: 0.95 }
    }

    /// The law of two shapes that touch.
    fn between(one: &Touch, other: &Touch, takes_lower_friction: bool) -> Self {
        if one.priority != other.priority {
            let own = if one.priority > other.priority { one } else { other };
            let friction = if own.is_frictionless { 0.0 } else { own.law.friction };
            return Self { friction, ..own.law };
        }
        let is_frictionless = one.is_frictionless && other.is_frictionless;
        let friction = match (one.law.friction, other.law.friction) {
            _ if is_frictionless => 0.0,
            (one, other) if takes_lower_friction => one.min(other),
            (one, other) => one.max(other),
        };
        let sum = one.mixing + other.mixing;
        let share = if sum > 0.0 { one.mixing / sum } else { 0.5 };
        let average = |a: f64, b: f64| if a == b { a } else { share * a + (1.0 - share) * b };
        let [first, second] = [one.law.softness, other.law.softness];
        let softness = if first[0] > 0.0 && second[0] > 0.0 {
            [average(first[0], second[0]), average(first[1], second[1])]
        } else {
            [first[0].min(second[0]), first[1].min(second[1])]
        };
        Self { friction, softness, impedance: average(one.law.impedance, other.law.impedance) }
    }

    /// Stiffness and damping per mass [1/s², 1/s].
    fn per_mass(&self) -> [f64; 2] {
        let rest = 1.0 - self.impedance;
        let [first, second] = self.softness;
        if first > 0.0 {
            [1.0 / (rest * (first * second).powi(2)), 2.0 / (rest * first)]
        } else {
            [-first / rest, -second / rest]
        }
    }

    /// What distinguishes laws, in an order by stiffness.
    fn key(&self) -> [u64; 3] {
        let [stiffness, damping] = self.per_mass();
        [stiffness.to_bits(), damping.to_bits(), self.friction.to_bits()]
    }
}

/// A body of the model that may touch others.
pub(super) struct TouchingBody {
    /// Name in the model.
    pub(super) name: String,
    pub(super) is_ground: bool,
    /// Links that are one body.
    pub(super) links: Vec<usize>,
    /// The body to which a joint connects it, with solids or without.
    pub(super) parent: Option<usize>,
}

/// The contacts of a model, and which shapes take part.
pub(super) struct Contacts {
    /// Entries of the model file.
    pub(super) text: String,
    /// Names of the entries.
    pub(super) names: Vec<String>,
    /// For each link and each of its visuals, whether it touches.
    pub(super) touches: Vec<Vec<bool>>,
    /// What is omitted of contacts, one sentence each.
    pub(super) notes: Vec<String>,
}

/// Laws of a robot's touches with the pairs of bodies of each, and what was found besides.
#[derive(Default)]
struct Pairs {
    laws: BTreeMap<[u64; 3], (TouchLaw, Vec<[usize; 2]>)>,
    /// Masks of shapes that touch any other.
    masks: Vec<[u32; 2]>,
    /// Number of pairs of which only some shapes may touch, and of those with ellipsoids on both sides.
    mixed: usize,
    ellipsoids: usize,
    takes_lower_friction: bool,
}

impl Pairs {
    fn of(robot: &Robot, bodies: &[TouchingBody]) -> Self {
        let shapes: Vec<Vec<Shape>> = bodies.iter().map(|body| shapes_of(robot, body)).collect();
        let number = |link: usize| bodies.iter().position(|body| body.links.contains(&link));
        let ordered = |[one, other]: [usize; 2]| [one.min(other), one.max(other)];
        let pair_of = |links: [usize; 2]| Some(ordered([number(links[0])?, number(links[1])?]));
        let excluded: BTreeSet<[usize; 2]> =
            robot.contacts.excluded.iter().filter_map(|links| pair_of(*links)).collect();
        let mut own_laws = BTreeMap::new();
        for pair in &robot.contacts.pairs {
            own_laws.extend(pair_of(pair.links).map(|bodies| (bodies, pair.law)));
        }
        let is_joined =
            |one: usize, other: usize| bodies[other].parent == Some(one) && !bodies[one].is_ground;
        let takes_lower_friction = robot.contacts.takes_lower_friction;
        let mut found = Self { takes_lower_friction, ..Self::default() };
        for tip in (0..bodies.len()).filter(|&tip| !shapes[tip].is_empty()) {
            for base in (0..tip).filter(|&base| !shapes[base].is_empty()) {
                let own = own_laws.get(&[base, tip]).copied();
                let are_excluded = excluded.contains(&[base, tip])
                    || robot.contacts.filters_parents && (is_joined(base, tip) || is_joined(tip, base))
                    || bodies[base].is_ground && bodies[tip].is_ground;
                if own.is_some() || !are_excluded {
                    found.add([base, tip], [&shapes[base], &shapes[tip]], own);
                }
            }
        }
        found
    }

    /// Adds two bodies by their shapes, if any of these touch; or by a law of their own.
    fn add(&mut self, pair: [usize; 2], [base, tip]: [&[Shape]; 2], own: Option<TouchLaw>) {
        let (mut law, mut count) = (own, 0);
        for (one, other) in base.iter().flat_map(|one| tip.iter().map(move |other| (one.touch, other.touch)))
        {
            let may_touch = own.is_some()
                || (one.group.is_none() || one.group != other.group)
                    && (one.masks[0] & other.masks[1] != 0 || other.masks[0] & one.masks[1] != 0);
            if !may_touch {
                continue;
            }
            count += 1;
            for masks in [one.masks, other.masks] {
                if !self.masks.contains(&masks) {
                    self.masks.push(masks);
                }
            }
            if own.is_none() {
                let next = TouchLaw::between(&one, &other, self.takes_lower_friction);
                law = Some(law.map_or(next, |law| stronger(law, next)));
            }
        }
        let Some(law) = law else { return };
        if [base, tip].iter().all(|shapes| shapes.iter().any(|own| own.is_ellipsoid)) {
            self.ellipsoids += 1;
            return;
        }
        self.mixed += usize::from(count < base.len() * tip.len());
        self.laws.entry(law.key()).or_insert_with(|| (law, Vec::new())).1.push(pair);
    }

    fn notes(&self) -> Vec<String> {
        let mut notes = Vec::new();
        if self.mixed > 0 {
            notes.push(format!(
                "masks of single geoms of {} pairs of bodies: all touching geoms of two bodies touch each other if any of them do",
                self.mixed
            ));
        }
        if self.ellipsoids > 0 {
            notes.push(format!(
                "contacts of {} pairs of bodies that both have ellipsoids, which do not touch each other",
                self.ellipsoids
            ));
        }
        notes
    }
}

impl Contacts {
    /// Nothing touches.
    pub(super) fn none(robot: &Robot) -> Self {
        let touches = robot.links.iter().map(|link| vec![true; link.visuals.len()]).collect();
        Self { text: String::new(), names: Vec::new(), touches, notes: Vec::new() }
    }

    /// The contacts of `robot` with its `bodies`.
    pub(super) fn of(robot: &Robot, bodies: &[TouchingBody]) -> Self {
        let mut shapes = robot.links.iter().flat_map(|link| &link.visuals);
        if robot.contacts.is_disabled || shapes.all(|own| own.touch.is_none()) {
            return Self::none(robot);
        }
        let pairs = Pairs::of(robot, bodies);
        let touches_any = |touch: Option<Touch>| touch.is_some_and(|own| pairs.masks.contains(&own.masks));
        let of_link = |link: &Link| link.visuals.iter().map(|own| touches_any(own.touch)).collect();
        let touches = robot.links.iter().map(of_link).collect();
        let masses = tree_masses(robot, bodies);
        let gravity = if robot.gravity.norm() > 0.0 { robot.gravity.norm() } else { GRAVITY };
        let entries: Vec<(&TouchLaw, Vec<[usize; 2]>)> = pairs
            .laws
            .values()
            .flat_map(|(law, all)| clusters(all).into_iter().map(move |own| (law, own)))
            .collect();
        let (mut text, mut names) = (String::new(), Vec::new());
        for (index, (law, own)) in entries.iter().enumerate() {
            let name =
                if entries.len() == 1 { "touching".to_owned() } else { format!("touching{}", index + 1) };
            write_entry(&mut text, &name, law, own, bodies, (&masses, gravity));
            names.push(name);
        }
        Self { text, names, touches, notes: pairs.notes() }
    }

    /// Whether anything touches.
    pub(super) fn are_there(&self) -> bool {
        !self.text.is_empty()
    }
}

/// The touching shapes of a body, as far as they differ.
fn shapes_of(robot: &Robot, body: &TouchingBody) -> Vec<Shape> {
    let mut distinct: Vec<Shape> = Vec::new();
    for visual in body.links.iter().flat_map(|&link| &robot.links[link].visuals) {
        if let Some(own) = visual.touch.and_then(|touch| Shape::of(touch, &visual.shape))
            && !distinct.contains(&own)
        {
            distinct.push(own);
        }
    }
    distinct
}

impl Robot {
    /// Step of an analysis with contacts [s].
    pub(super) fn contact_step(&self) -> f64 {
        self.contacts.step.filter(|step| *step > 0.0).unwrap_or(STEP).min(MAX_STEP)
    }
}

/// A touching shape, as far as it matters for the law.
#[derive(Clone, Copy, PartialEq)]
struct Shape {
    touch: Touch,
    is_ellipsoid: bool,
}

impl Shape {
    /// None for shapes that contacts do not support.
    fn of(touch: Touch, shape: &VisualShape) -> Option<Self> {
        let is_ellipsoid = matches!(shape, VisualShape::Ellipsoid(_));
        (!matches!(shape, VisualShape::Mesh { .. })).then_some(Self { touch, is_ellipsoid })
    }
}

/// Law with the greater friction and the stiffer touch of two geoms of the same bodies.
fn stronger(one: TouchLaw, other: TouchLaw) -> TouchLaw {
    let stiffer = if other.per_mass()[0] > one.per_mass()[0] { other } else { one };
    TouchLaw { friction: one.friction.max(other.friction), ..stiffer }
}

/// For each body the mass of all that joints connect to it, except by the ground.
fn tree_masses(robot: &Robot, bodies: &[TouchingBody]) -> Vec<f64> {
    let own = |body: &TouchingBody| -> f64 {
        body.links.iter().filter_map(|&link| robot.links[link].inertia).map(|inertia| inertia.mass).sum()
    };
    // Parents are before their children.
    let mut roots: Vec<usize> = (0..bodies.len()).collect();
    let mut masses = vec![0.0; bodies.len()];
    for (index, body) in bodies.iter().enumerate() {
        if let Some(parent) = body.parent.filter(|parent| !bodies[*parent].is_ground) {
            roots[index] = roots[parent];
        }
        if !body.is_ground {
            masses[roots[index]] += own(body);
        }
    }
    roots.iter().map(|root| masses[*root]).collect()
}

/// Pairs as one contact with exceptions; or each as a contact of its own if that is shorter.
fn clusters(pairs: &[[usize; 2]]) -> Vec<Vec<[usize; 2]>> {
    let whole = vec![pairs.to_vec()];
    let count = exceptions(&members(pairs), pairs).len();
    if count > 2 * pairs.len() { pairs.iter().map(|pair| vec![*pair]).collect() } else { whole }
}

/// The bodies of pairs, ascending.
fn members(pairs: &[[usize; 2]]) -> Vec<usize> {
    let mut all: Vec<usize> = pairs.iter().flatten().copied().collect();
    all.sort_unstable();
    all.dedup();
    all
}

/// Groups of bodies of which no two are a pair, so that all others are.
fn exceptions(members: &[usize], pairs: &[[usize; 2]]) -> Vec<Vec<usize>> {
    let count = members.len();
    let place: BTreeMap<usize, usize> =
        members.iter().enumerate().map(|(place, body)| (*body, place)).collect();
    let mut touches = vec![false; count * count];
    for pair in pairs {
        let [a, b] = pair.map(|body| place[&body]);
        touches[a * count + b] = true;
        touches[b * count + a] = true;
    }
    let mut is_covered = touches.clone();
    let mut groups = Vec::new();
    for first in 0..count {
        for second in first + 1..count {
            if is_covered[first * count + second] {
                continue;
            }
            let mut group = vec![first, second];
            for next in first + 1..count {
                if next != second && group.iter().all(|own| !touches[own * count + next]) {
                    group.push(next);
                }
            }
            for (index, &one) in group.iter().enumerate() {
                for &other in &group[..index] {
                    is_covered[one * count + other] = true;
                    is_covered[other * count + one] = true;
                }
            }
            group.sort_unstable();
            groups.push(group.into_iter().map(|place| members[place]).collect());
        }
    }
    groups
}

/// A contact of the model file.
fn write_entry(
    text: &mut String,
    name: &str,
    law: &TouchLaw,
    pairs: &[[usize; 2]],
    bodies: &[TouchingBody],
    (masses, gravity): (&[f64], f64),
) {
    let members = members(pairs);
    let mass = pairs.iter().map(|&[base, tip]| match (bodies[base].is_ground, bodies[tip].is_ground) {
        (true, _) => masses[tip],
        (_, true) => masses[base],
        _ => masses[base] * masses[tip] / (masses[base] + masses[tip]),
    });
    let mass = mass.filter(|mass| *mass > 0.0).fold(0.0, f64::max);
    let mass = if mass > 0.0 { mass } else { 1.0 };
    let [stiffness, damping] = law.per_mass();
    let words = |all: &[usize]| -> Vec<String> {
        all.iter().map(|body| format!("\"{}\"", bodies[*body].name)).collect()
    };
    let names = words(&members);
    // Writing to a string cannot fail.
    let _ = write!(text, "\n[contacts.{name}]\nbase = {}\ntip = {}\n", names[0], names[1]);
    if names.len() > 2 {
        let _ = writeln!(text, "others = {}", wrapped(&names[2..]));
    }
    let groups: Vec<String> =
        exceptions(&members, pairs).iter().map(|group| format!("[{}]", words(group).join(", "))).collect();
    if !groups.is_empty() {
        let _ = writeln!(text, "except = {}", wrapped(&groups));
    }
    let _ = writeln!(text, "stiffness = {}", rounded(stiffness * mass));
    if damping > 0.0 {
        let _ = writeln!(text, "dissipation = {}", rounded(damping / gravity));
    }
    if law.friction > 0.0 {
        let _ = writeln!(text, "friction = {:?}", law.friction);
    }
}

/// A list on one line, or on several if it is long.
fn wrapped(entries: &[String]) -> String {
    const WIDTH: usize = 120;
    let line = entries.join(", ");
    if line.len() < WIDTH - 12 {
        return format!("[{line}]");
    }
    let mut lines = vec![String::new()];
    for entry in entries {
        if lines.last().is_some_and(|last| !last.is_empty() && last.len() + entry.len() > WIDTH - 6) {
            lines.push(String::new());
        }
        if let Some(last) = lines.last_mut() {
            let gap = if last.is_empty() { "" } else { " " };
            let _ = write!(last, "{gap}{entry},");
        }
    }
    format!("[\n    {},\n]", lines.join("\n    ").trim_end_matches(','))
}

/// A number with three digits.
fn rounded(value: f64) -> String {
    let text = format!("{value:.2e}");
    text.parse::<f64>().map_or(text, |value| format!("{value:?}"))
}
