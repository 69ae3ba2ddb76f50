//! Contact of a ball with an element of a shell where they are nearest, on both sides, with friction that sticks.
//!
//! Legend: c centre of the ball, X and n point and normal of the surface, see `patch`, h half the thickness, g = |c - X| - R gap with R
//! radius of the ball plus h, m = (c - X)/|c - X|, N normal force, χ share of the element, see `touch`; Y = X ± h n point of contact,
//! u velocity of the shell relative to the ball there, s = u - m (m·u), z bristles, f_t friction on the shell as in
//! [`Contact`](crate::elastic::Contact).
//!
//! ```text
//! δg = m·(δc - δX),     ball:  χ N m at X, -χ f_t at Y,      shell:  -χ N m at X, χ f_t at Y
//! energy χ P(-g),       z' = Σ χ (s - yielding(z, s)) over the elements,  in the axes of the shell's node, as in its initial pose
//! ```

mod patch;
mod patches;
mod touch;

pub use patches::{ContactPatch, contact_patches};

use lissom_motion::{Matrix3, Vector3};

use crate::elastic::{ContactFriction, STATES};
use crate::force_over_gap::{Distance, ForceOverGap};
use crate::reading::{ContactElement, ContactReading};
use lissom_flexible::shell::quadrilateral::NODES;
use lissom_mechanics::compliance::Compliance;
use lissom_mechanics::dual::{Dual, Number, Three, cross, dot, sum, times};
use lissom_mechanics::elements::{
    Capabilities, Element, Energy, ForceLaws, Limit, LimitKind, Spring, StrainSlopes, Tangents, Unknowns,
    Validity,
};
use lissom_mechanics::evaluation::switch_states::{SwitchStates, frozen_branch, is_on_upper_branch};
use lissom_mechanics::kinematics::{CoordinateId, GROUND, Kinematics, NodeId, Switch, split};
use lissom_mechanics::law::{Interval, VisitLaw};
use lissom_mechanics::signals::measurement::Gradient;
use patch::{Patch, across, difference, none, plus};
use touch::{Foot, Touch, foot};

/// Unknowns of the nodes of ball and element.
const POSES: usize = 6 * (1 + NODES);

/// A ball and an element of a shell that may touch.
#[derive(Clone, Debug)]
pub struct ShellContact {
    /// Node of the ball, and its centre in its axes [m].
    ball: (NodeId, Vector3),
    patch: ContactPatch,
    /// Radius of the ball plus half the thickness, and half the thickness [m].
    radius: f64,
    half_thickness: f64,
    compliance: Compliance,
    /// Relative increase of the normal force per penetration velocity [s/m].
    dissipation: f64,
    friction: Option<ContactFriction>,
    /// Bristles of all elements of the contact.
    bristles: Vec<CoordinateId>,
    /// Whether the rates of the bristles are in its equations.
    has_rates: bool,
    /// Nodes of the contact without the ground.
    nodes: Vec<NodeId>,
    switch_states: SwitchStates,
}

/// Ball and element in some motion, global axes.
struct Moved<T> {
    centre: Three<T>,
    velocity: Three<T>,
    spin: Three<T>,
    patch: Patch<T>,
    rates: Patch<T>,
    /// z.
    bristle: Three<T>,
}

impl<T: Number> Moved<T> {
    /// ġ.
    fn rate(&self, touch: &Touch<T>) -> T {
        let surface = touch.spot.moved(&self.patch, &self.rates, T::constant(0.0));
        dot(touch.outwards, difference(self.velocity, surface))
    }
}

/// A vector in the axes of a node that rotates by a small angle.
fn turned<T: Number>(rotation: &Matrix3, angle: Three<T>, vector: Three<T>) -> Three<T> {
    let own = sum(vector, cross(angle, vector));
    std::array::from_fn(|i| {
        own[0].scaled(rotation[(i, 0)]) + own[1].scaled(rotation[(i, 1)]) + own[2].scaled(rotation[(i, 2)])
    })
}

/// A global vector in the axes of a node that rotates by a small angle.
fn turned_back<T: Number>(rotation: &Matrix3, angle: Three<T>, vector: Three<T>) -> Three<T> {
    let own = turned(&rotation.transpose(), none(), vector);
    difference(own, cross(angle, own))
}

fn constant<T: Number>(vector: &Vector3) -> Three<T> {
    [vector.x, vector.y, vector.z].map(T::constant)
}

/// A vector with its derivatives by other vectors.
fn composed<T: Number>(value: &Vector3, by: [(&Matrix3, Three<T>); 2]) -> Three<T> {
    std::array::from_fn(|i| {
        let slope = |(matrix, of): (&Matrix3, Three<T>)| {
            let part = |j: usize| of[j].composed(0.0, matrix[(i, j)]);
            part(0) + part(1) + part(2)
        };
        (slope(by[0]) + slope(by[1])).plus(value[i])
    })
}

fn values<T: Number>(vector: Three<T>) -> Vector3 {
    Vector3::from(vector.map(T::value))
}

impl ShellContact {
    /// Between a ball of a radius [m] about a point of a node, and an element of a shell of a thickness [m]. All elements of a contact
    /// have the same bristles, and one of them their rates.
    pub fn new(
        (ball, radius): ((NodeId, Vector3), f64),
        (patch, thickness): (ContactPatch, f64),
        (compliance, dissipation): (Compliance, f64),
        friction: Option<(&ContactFriction, bool)>,
    ) -> Self {
        let nodes = [ball.0].into_iter().chain(patch.nodes).filter(|node| *node != GROUND).collect();
        let half_thickness = 0.5 * thickness;
        Self {
            ball,
            patch,
            radius: radius + half_thickness,
            half_thickness,
            compliance,
            dissipation,
            friction: friction.map(|(law, _)| law.clone()),
            bristles: friction.map(|(law, _)| law.bristles.clone()).unwrap_or_default(),
            has_rates: friction.is_some_and(|(_, has_rates)| has_rates),
            nodes,
            switch_states: SwitchStates::default(),
        }
    }

    fn bodies(&self) -> impl Iterator<Item = NodeId> {
        [self.ball.0].into_iter().chain(self.patch.nodes)
    }

    fn centre(&self, at: &Kinematics) -> Vector3 {
        at.nodes[self.ball.0].frame.transform_point(&self.ball.1)
    }

    fn patch_at(&self, at: &Kinematics) -> Patch<f64> {
        let frames = self.patch.nodes.map(|node| &at.nodes[node].frame);
        Patch {
            positions: frames.map(|frame| frame.position.into()),
            directors: std::array::from_fn(|a| frames[a].rotation.apply(&self.patch.directors[a]).into()),
        }
    }

    fn foot(&self, at: &Kinematics) -> Foot {
        foot(&self.patch_at(at), self.centre(at).into(), &self.patch.overlaps)
    }

    /// Distance of the centre from a sphere around the element, if it is out of reach of it [m].
    fn far(&self, at: &Kinematics) -> Option<f64> {
        let positions = self.patch.nodes.map(|node| at.nodes[node].frame.position);
        out_of_reach(&positions, &self.centre(at), self.radius)
    }

    /// The motion, with small changes of poses, twists and bristles by the directions of these numbers.
    fn moved<T: Number>(&self, at: &Kinematics, change: impl Fn(usize) -> T) -> Moved<T> {
        let three = |first: usize| std::array::from_fn(|k| change(first + k));
        let own = |slot: usize, node: NodeId| {
            let motion = &at.nodes[node];
            let (v, w) = split(&motion.twist);
            let twist = [(v, POSES + 6 * slot), (w, POSES + 6 * slot + 3)]
                .map(|(value, first)| sum(constant(&value), three(first)));
            (motion, motion.frame.rotation.matrix(), [three(6 * slot), three(6 * slot + 3)], twist)
        };
        let (motion, rotation, [shift, turn], [v, w]) = own(0, self.ball.0);
        let point = constant(&self.ball.1);
        let at_point = |position: &Vector3, shift, turn, point| {
            let moved = sum(turned(&rotation, none(), shift), turned(&rotation, turn, point));
            sum(constant(position), moved)
        };
        let centre = at_point(&motion.frame.position, shift, turn, point);
        let velocity = turned(&rotation, turn, sum(v, cross(w, point)));
        let spin = turned(&rotation, turn, w);
        let mut patch = Patch { positions: [none(); NODES], directors: [none(); NODES] };
        let mut rates = patch;
        let mut bristle = none();
        for (a, &node) in self.patch.nodes.iter().enumerate() {
            let (motion, rotation, [shift, turn], [v, w]) = own(1 + a, node);
            let director = constant(&self.patch.directors[a]);
            let position = constant(&motion.frame.position);
            patch.positions[a] = sum(position, turned(&rotation, none(), shift));
            patch.directors[a] = turned(&rotation, turn, director);
            rates.positions[a] = turned(&rotation, turn, v);
            rates.directors[a] = turned(&rotation, turn, cross(w, director));
            if a == 0 && !self.bristles.is_empty() {
                let value = Vector3::from_fn(|k, _| at.coordinates[self.bristles[k]].value);
                let initial = turned_back(
                    &self.patch.rotation.matrix(),
                    none(),
                    sum(constant(&value), three(2 * POSES)),
                );
                bristle = turned(&rotation, turn, initial);
            }
        }
        Moved { centre, velocity, spin, patch, rates, bristle }
    }

    /// N from its value and derivatives by penetration and its rate.
    fn normal_force<T: Number>(&self, moved: &Moved<T>, touch: &Touch<T>) -> T {
        let rate = moved.rate(touch);
        let depth = (-touch.distance).plus(self.radius);
        let [force, by_depth, by_rate] =
            self.compliance.force(depth.value(), -rate.value(), self.dissipation);
        depth.composed(force, by_depth) + rate.composed(0.0, -by_rate)
    }

    /// Y relative to the centre, and s.
    fn sliding<T: Number>(&self, moved: &Moved<T>, touch: &Touch<T>) -> [Three<T>; 2] {
        let face = T::constant(touch.side * self.half_thickness);
        let arm = difference(plus(touch.spot.place, touch.spot.normal, face), moved.centre);
        let of_ball = sum(moved.velocity, cross(moved.spin, arm));
        let of_shell = touch.spot.moved(&moved.patch, &moved.rates, face);
        [arm, across(difference(of_shell, of_ball), touch.outwards)]
    }

    /// f_t per normal force.
    fn friction_share<T: Number>(
        friction: &ContactFriction,
        moved: &Moved<T>,
        (sliding, touch): (Three<T>, &Touch<T>),
    ) -> Three<T> {
        let own = friction.share(&values(moved.bristle), &values(sliding), &values(touch.outwards));
        let tangential = across(moved.bristle, touch.outwards);
        let force = composed(&own.force, [(&own.by_sliding, sliding), (&own.by_bristles, tangential)]);
        force.map(|component| -component)
    }

    /// Forces on ball and nodes and equations of the bristles, all in the axes of the nodes.
    fn local<T: Number>(
        &self,
        at: &Kinematics,
        foot: &Foot,
        change: impl Fn(usize) -> T,
    ) -> [T; POSES + STATES] {
        let moved = self.moved(at, &change);
        let touch = foot.touch(&moved.patch, moved.centre, &self.patch.overlaps);
        let normal = self.normal_force(&moved, &touch) * touch.share;
        let zero = T::constant(0.0);
        let on_ball = times(touch.outwards, -normal);
        let mut nodes = touch.spot.spread(&moved.patch, times(touch.outwards, normal), zero);
        let (mut force, mut moment) = (on_ball, none());
        let mut out = [zero; POSES + STATES];
        let frame = |slot: usize, node: NodeId| {
            let turn = std::array::from_fn(|k| change(6 * slot + 3 + k));
            (at.nodes[node].frame.rotation.matrix(), turn)
        };
        if let Some(friction) = &self.friction {
            let [arm, sliding] = self.sliding(&moved, &touch);
            let share = Self::friction_share(friction, &moved, (sliding, &touch));
            // On the left-hand side.
            let on_shell = times(share, -normal);
            let face = T::constant(touch.side * self.half_thickness);
            let spread = touch.spot.spread(&moved.patch, on_shell, face);
            for a in 0..NODES {
                nodes.positions[a] = sum(nodes.positions[a], spread.positions[a]);
                nodes.directors[a] = sum(nodes.directors[a], spread.directors[a]);
            }
            force = difference(force, on_shell);
            moment = difference(moment, cross(arm, on_shell));
            let yielding = friction.yielding(&values(moved.bristle), &values(sliding));
            let by = [(&yielding.by_sliding, sliding), (&yielding.by_bristles, moved.bristle)];
            let rate = times(difference(sliding, composed(&yielding.rate, by)), -touch.share);
            let (rotation, turn) = frame(1, self.patch.nodes[0]);
            let initial = turned_back(&rotation, turn, rate);
            out[POSES..].copy_from_slice(&turned(&self.patch.rotation.matrix(), none(), initial));
        }
        let (rotation, turn) = frame(0, self.ball.0);
        let own = turned_back(&rotation, turn, force);
        out[..3].copy_from_slice(&own);
        let about = sum(cross(constant(&self.ball.1), own), turned_back(&rotation, turn, moment));
        out[3..6].copy_from_slice(&about);
        for (a, &node) in self.patch.nodes.iter().enumerate() {
            let (rotation, turn) = frame(1 + a, node);
            let rows = &mut out[6 + 6 * a..12 + 6 * a];
            rows[..3].copy_from_slice(&turned_back(&rotation, turn, nodes.positions[a]));
            let turning = turned_back(&rotation, turn, nodes.directors[a]);
            rows[3..].copy_from_slice(&cross(constant(&self.patch.directors[a]), turning));
        }
        out
    }

    /// Local rows with their rows in the equations of the element.
    fn rows(&self) -> impl Iterator<Item = (usize, usize)> {
        let first = 6 * usize::from(self.ball.0 == GROUND);
        let count = POSES - first;
        (0..count)
            .map(move |k| (first + k, k))
            .chain((0..self.bristles.len()).map(move |k| (POSES + k, count + k)))
    }

    /// The penetration [m], negative where a neighbour has the whole contact: a ball that passes by begins no contact. It is then small,
    /// so that it is no impact.
    fn depth(&self, touch: &Touch<f64>) -> f64 {
        let depth = self.radius - touch.distance;
        if touch.within < 0.0 { depth.min(1e-3 * self.radius * touch.within) } else { depth }
    }

    /// Ball and element with the touch of a foot.
    fn touch(&self, at: &Kinematics, foot: &Foot) -> (Moved<f64>, Touch<f64>) {
        let moved = self.moved(at, |_| 0.0);
        let touch = foot.touch(&moved.patch, moved.centre, &self.patch.overlaps);
        (moved, touch)
    }

    fn is_touching(&self, at: &Kinematics, touch: &Touch<f64>) -> bool {
        is_on_upper_branch(self.switch_states.of(at).first(), self.depth(touch))
    }

    /// The foot of a ball that touches.
    fn touching(&self, at: &Kinematics) -> Option<Foot> {
        let frozen = frozen_branch(self.switch_states.of(at).first());
        if frozen == Some(false) {
            return None;
        }
        let foot = self.foot(at);
        let is_touching = frozen.unwrap_or_else(|| self.depth(&self.touch(at, &foot).1) > 0.0);
        is_touching.then_some(foot)
    }

    /// Energy of the bristles per normal force, and its derivative by them [m, -].
    fn deflected(&self, bristle: &Vector3) -> (f64, Vector3) {
        self.friction.as_ref().map_or((0.0, Vector3::zeros()), |friction| {
            let stiffness = friction.law.at_rest / friction.deflection;
            (0.5 * stiffness * bristle.norm_squared(), stiffness * bristle)
        })
    }
}

impl Element for ShellContact {
    fn unknowns(&self) -> Unknowns<'_> {
        Unknowns { nodes: &self.nodes, coordinates: &self.bristles, multipliers: &[] }
    }

    fn forces(&self, at: &Kinematics, out: &mut [f64]) {
        if self.has_rates {
            let states = &mut out[6 * self.nodes.len()..];
            states.iter_mut().zip(&self.bristles).for_each(|(sum, own)| *sum += at.coordinates[*own].rate);
        }
        let Some(foot) = self.touching(at) else { return };
        let own = self.local(at, &foot, |_| 0.0);
        self.rows().for_each(|(k, row)| out[row] += own[k]);
    }

    fn linearize(&self, at: &Kinematics, out: &mut Tangents) {
        let size = out.size();
        if self.has_rates {
            (size - STATES..size).for_each(|k| out.damping[k * size + k] += 1.0);
        }
        let Some(foot) = self.touching(at) else { return };
        // By poses, twists and bristles.
        let own = self.local(at, &foot, |k| Dual::<{ 2 * POSES + STATES }>::variable(0.0, k));
        for (k, row) in self.rows() {
            for (direction, column) in self.rows() {
                let (by_place, by_rate) = if direction < POSES {
                    (own[k].by[direction], own[k].by[POSES + direction])
                } else {
                    (own[k].by[POSES + direction], 0.0)
                };
                out.stiffness[row * size + column] += by_place;
                out.damping[row * size + column] += by_rate;
            }
        }
    }

    fn energy(&self, at: &Kinematics) -> Energy {
        let Some(foot) = self.touching(at) else { return Energy::default() };
        let (moved, touch) = self.touch(at, &foot);
        let depth = self.radius - foot.distance;
        let [force, ..] = self.compliance.force(depth, 0.0, 0.0);
        let of_bristles = force * self.deflected(&moved.bristle.into()).0;
        Energy { strain: touch.share * (self.compliance.energy(depth) + of_bristles), ..Energy::default() }
    }

    fn switch_states(&mut self) -> Option<&mut SwitchStates> {
        Some(&mut self.switch_states)
    }

    fn capabilities(&self) -> Capabilities<'_> {
        Capabilities {
            spring: Some(self),
            validity: Some(self),
            laws: Some(self),
            strain: Some(self),
            ..Capabilities::default()
        }
    }
}

impl ContactElement for ShellContact {
    fn reading(&self, at: &Kinematics) -> ContactReading {
        let foot = self.foot(at);
        let (moved, touch) = self.touch(at, &foot);
        let is_touching = self.is_touching(at, &touch);
        let normal = if is_touching { touch.share * self.normal_force(&moved, &touch) } else { 0.0 };
        let [arm, sliding] = self.sliding(&moved, &touch);
        let friction = self.friction.as_ref().map_or_else(Vector3::zeros, |friction| {
            normal * Vector3::from(Self::friction_share(friction, &moved, (sliding, &touch)))
        });
        let is_own = is_touching && touch.is_own;
        ContactReading {
            gap: -self.depth(&touch),
            normal,
            force: friction - normal * Vector3::from(touch.outwards),
            friction,
            slip: Vector3::from(sliding).norm(),
            point: Vector3::from(sum(moved.centre, arm)),
            is_touching: is_own,
            is_sliding: is_own && self.friction.as_ref().is_none_or(|own| own.slips(&moved.bristle.into())),
        }
    }
}

impl Spring for ShellContact {
    fn dissipates(&self) -> bool {
        self.dissipation > 0.0 || self.friction.is_some()
    }

    fn spring_motion(&self, at: &Kinematics) -> [f64; 3] {
        let foot = self.foot(at);
        let (moved, touch) = self.touch(at, &foot);
        let is_touching = self.is_touching(at, &touch);
        let normal = if is_touching { touch.share * self.normal_force(&moved, &touch) } else { 0.0 };
        [-self.depth(&touch), moved.rate(&touch), normal]
    }

    fn spring_gradients(&self, _: &Kinematics) -> Option<[Gradient; 3]> {
        None
    }
}

impl Validity for ShellContact {
    fn limits(&self) -> &'static [LimitKind] {
        &[LimitKind::Depth]
    }

    /// Beyond the surface the force would be in the opposite direction.
    fn limit(&self, kind: LimitKind, [_, at]: [&Kinematics; 2]) -> Option<Limit<'_>> {
        if kind != LimitKind::Depth || self.is_idle(at) {
            return None;
        }
        let depth = self.depth(&self.touch(at, &self.foot(at)).1);
        Some(Limit::of_element(depth, 0.5 * self.radius))
    }
}

impl ForceLaws for ShellContact {
    fn switch_count(&self) -> usize {
        1
    }

    /// Bristles belong to all elements of a contact: their equation must not be added by each that is idle.
    fn is_idle(&self, at: &Kinematics) -> bool {
        self.bristles.is_empty() && frozen_branch(self.switch_states.of(at).first()) == Some(false)
    }

    fn switches(&self, at: &Kinematics, out: &mut Vec<Switch>) {
        let near = || self.depth(&self.touch(at, &self.foot(at)).1);
        out.push(self.far(at).map_or_else(near, |distance| self.radius - distance).into());
    }

    fn laws(&self, at: &Kinematics, visit: &mut VisitLaw<'_>) {
        let centre = self.centre(at);
        // Positions of the nodes relative to the centre.
        let mut arguments = [0.0; 3 * NODES];
        for (own, node) in arguments.chunks_exact_mut(3).zip(self.patch.nodes) {
            own.copy_from_slice((at.nodes[node].frame.position - centre).as_slice());
        }
        let gap = FlatDistance { radius: self.radius };
        visit(&ForceOverGap { gap, compliance: self.compliance }, &arguments);
    }
}

impl StrainSlopes for ShellContact {
    /// Friction is not the derivative of the energy of the bristles.
    fn strain_slopes(&self, fall: &Kinematics, out: &mut [f64]) {
        let Some(foot) = self.touching(fall) else { return };
        let (moved, touch) = self.touch(fall, &foot);
        let [force, by_depth, _] = self.compliance.force(self.radius - foot.distance, 0.0, 0.0);
        let (deflected, by_bristle) = self.deflected(&moved.bristle.into());
        let along = Vector3::from(touch.outwards);
        let slope = touch.share * (force + by_depth * deflected) * along;
        let nodes = touch.spot.spread(&moved.patch, slope.into(), 0.0);
        let bristles = fall.nodes[self.patch.nodes[0]].frame.rotation.apply_inverse(&by_bristle);
        let bristles = touch.share * force * self.patch.rotation.apply(&bristles);
        let mut own = [0.0; POSES + STATES];
        own[POSES..].copy_from_slice(bristles.as_slice());
        for (slot, node) in self.bodies().enumerate() {
            let rotation = &fall.nodes[node].frame.rotation;
            let (force, arm) = if slot == 0 {
                (-rotation.apply_inverse(&slope), self.ball.1)
            } else {
                (rotation.apply_inverse(&nodes.positions[slot - 1].into()), Vector3::zeros())
            };
            let moment = if slot == 0 {
                arm.cross(&force)
            } else {
                self.patch.directors[slot - 1]
                    .cross(&rotation.apply_inverse(&nodes.directors[slot - 1].into()))
            };
            own[6 * slot..6 * slot + 3].copy_from_slice(force.as_slice());
            own[6 * slot + 3..6 * slot + 6].copy_from_slice(moment.as_slice());
        }
        self.rows().for_each(|(k, row)| out[row] += own[k]);
    }
}

/// Distance of a point from a sphere around an element and its surroundings, if it exceeds a radius by half [m].
fn out_of_reach(positions: &[Vector3; NODES], centre: &Vector3, radius: f64) -> Option<f64> {
    let middle = positions.iter().sum::<Vector3>() / NODES as f64;
    let extent = positions.iter().map(|own| (own - middle).norm()).fold(0.0, f64::max);
    let distance = (centre - middle).norm() - 2.0 * extent;
    (distance > 1.5 * radius).then_some(distance)
}

/// The distance of the origin from the quadrilateral between four points: it changes by no more than they move.
struct FlatDistance {
    radius: f64,
}

impl Distance for FlatDistance {
    fn at(&self, arguments: &[f64]) -> f64 {
        let positions: [Vector3; NODES] =
            std::array::from_fn(|a| Vector3::from_column_slice(&arguments[3 * a..3 * a + 3]));
        let far = out_of_reach(&positions, &Vector3::zeros(), self.radius);
        let distance = far.unwrap_or_else(|| {
            let patch = Patch { positions: positions.map(Into::into), directors: [[0.0; 3]; NODES] };
            foot(&patch, [0.0; 3], &[[None; 2]; 2]).distance
        });
        distance - self.radius
    }

    fn range(&self, arguments: &[Interval]) -> Interval {
        let middle: [f64; 3 * NODES] = std::array::from_fn(|k| 0.5 * (arguments[k][0] + arguments[k][1]));
        let half =
            |own: &[Interval]| own.iter().map(|[low, high]| 0.25 * (high - low).powi(2)).sum::<f64>().sqrt();
        let change = arguments.chunks_exact(3).map(half).fold(0.0, f64::max);
        let gap = self.at(&middle);
        [gap - change, gap + change]
    }
}
