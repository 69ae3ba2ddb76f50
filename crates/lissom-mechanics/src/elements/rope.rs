//! A rope over pulleys: a spring and damper without compression along the polyline through several positions, over which it
//! slides without friction, so that its tension is uniform. Pulleys have no radius. Drums wind it.
//!
//! Legend: x_p positions, Δ_i = x_{i+1} - x_i with length ℓ_i and direction u_i, L free length, L₀(t) as given, q_d coordinates
//! of drums with initial values q_d0, r_d length paid out per unit.
//!
//! ```text
//! e = Σ ℓ_i - L,   ė = Σ u_i·Δ̇_i - L̇,   L = L₀(t) + Σ r_d (q_d - q_d0),   T = max(0, k e + c ė) or another law for e > 0
//! T times ∂e:   at places  g_p = ∂Σℓ/∂x_p = u_{p-1} - u_p,   at drums  ∂e/∂q_d = -r_d
//! ```

use lissom_motion::{Matrix3, Vector3, skew};
use nalgebra::SMatrix;

use super::contribution::Contribution;
use super::force_law::{ForceLaw, Response};
use super::initial_model::InitialModel;
use super::kind::{Attached, ElementKind};
use super::point_spring::Point;
use super::{Capabilities, Element, Energy, ForceLaws, Load, Spring, Tangents, Unknowns, add_block};
use crate::evaluation::switch_states::SwitchStates;
use crate::kinematics::step_stages::{STAGES, StepStages, above_round_off};
use crate::kinematics::{CoordinateId, GROUND, Kinematics, MAX_NODES, NodeId, Switch};
use crate::law::VisitLaw;
use crate::ports::{PortDeclaration, PortType, Ports};
use crate::registry::ParameterType::{NotNegative, Positive};
use crate::registry::{Constant, Function, ParameterError, ParameterType, Parameters, Value, optional};
use crate::signals::measurement::Gradient;

/// Registry entry.
pub const KIND: ElementKind = ElementKind {
    name: "rope",
    summary: "Rope that slides over several points without friction: pulleys, and hoists by its free length.",
    sample: "stiffness = 1e4\ndamping = 10.0\nlength = \"3 - 0.1*t\"",
    parameters: &[
        optional(
            "stiffness",
            NotNegative,
            "N/m",
            "Stiffness of the whole rope.",
        ).or_number(0.0),
        optional(
            "damping",
            NotNegative,
            "N s/m",
            "Damping of the whole rope.",
        ).or_number(0.0),
        optional(
            "force",
            ParameterType::Force(&["elongation", "rate"]),
            "N",
            "Tension over `elongation` and `rate`, in addition to `stiffness`; a table is over `elongation`.",
        ),
        optional(
            "damper_force",
            ParameterType::Force(&["rate", "elongation"]),
            "N",
            "Tension over `rate` and `elongation`, in addition to `damping`; a table is over `rate`.",
        ),
        optional(
            "limits",
            ParameterType::Range,
            "N",
            "Minimum and maximum tension; default: none.",
        ),
        optional(
            "length",
            ParameterType::Function,
            "m",
            "Free length of the whole rope; a function of time for a winch; default: the length at the start.",
        ),
        optional(
            "drum_radii",
            ParameterType::Numbers,
            "m",
            "Length of rope paid out by each of `drums` per rad or m of its coordinate; negative if it winds the rope up.",
        ),
        optional(
            "diameter",
            Positive,
            "m",
            "Diameter with which it is drawn; default: a thin line.",
        ),
    ],
    ports: Ports(&[
        PortDeclaration::required(
            "along",
            PortType::Locations,
            "points over which it passes, from one end to the other",
        )
        .listed("along: the points over which it passes, each with `on` and `at`")
        .sample("along = [{ on = \"ground\", at = [0.0, 0.0, 3.0] }, { on = \"my_body\" }]"),
        PortDeclaration::optional(
            "drums",
            PortType::Coordinates,
            "coordinates of joints that pay it out, such as \"drum.angle\"; the name of a joint stands for all its coordinates",
        )
        .listed("drums: coordinates that pay it out"),
    ]),
    build,
};

/// Maximum number of positions of a rope.
const MAX_PLACES: usize = 16;

/// A rope over pulleys.
#[derive(Clone, Debug)]
pub struct Rope {
    /// Its nodes, each once, without the ground.
    nodes: Vec<NodeId>,
    /// Positions in their order along the rope: the index of the node, none for the ground, and the point on it.
    places: Vec<(Option<usize>, Vector3)>,
    /// Coordinates of drums, and for each the length paid out per unit and its initial value.
    drums: Vec<CoordinateId>,
    pays_out: Vec<[f64; 2]>,
    law: ForceLaw,
    length: Function,
    switch_states: SwitchStates,
}

/// Lengths that drums pay out per unit of their coordinates, and the initial values of these.
fn drums(
    model: &InitialModel,
    drums: &[CoordinateId],
    parameters: &Parameters,
) -> Result<Vec<[f64; 2]>, ParameterError> {
    let radii = if parameters.has("drum_radii") { parameters.numbers("drum_radii")? } else { &[] };
    let fault = |problem: String| Err(ParameterError::new("drum_radii", problem));
    if radii.len() != drums.len() {
        return fault(format!("must be as many as `drums`: {} for {}", radii.len(), drums.len()));
    }
    if drums.len() > 2 {
        return fault("belong to more than two drums: a rope has two ends".to_owned());
    }
    if radii.contains(&0.0) {
        return fault("must not be zero: such a drum pays out no rope".to_owned());
    }
    Ok(radii.iter().zip(drums).map(|(radius, drum)| [*radius, model.coordinate_value(*drum)]).collect())
}

fn build(
    model: &InitialModel,
    attached: Attached,
    parameters: &Parameters,
) -> Result<Contribution, ParameterError> {
    let Attached { nodes: along, coordinates: winding } = attached;
    let points: Vec<Vector3> =
        along.iter().map(|(node, place)| model.frame(*node).transform_point(place)).collect();
    let fault = |problem: &str| Err(ParameterError::new("along", problem));
    if points.len() < 2 {
        return fault("needs at least two points");
    }
    if points.len() > MAX_PLACES {
        return fault("has more than 16 points: attach two ropes to a part in between");
    }
    let lengths = points.windows(2).map(|pair| (pair[1] - pair[0]).norm());
    if let Some(index) = lengths.clone().position(|length| length == 0.0) {
        let problem = format!(
            "has the points {} and {} at one position: the rope has no direction",
            index + 1,
            index + 2
        );
        return fault(&problem);
    }
    let at_start: f64 = lengths.sum();
    let mut nodes: Vec<NodeId> = Vec::new();
    let mut places = Vec::new();
    for (node, place) in along {
        if node == GROUND {
            places.push((None, model.frame(node).transform_point(&place)));
            continue;
        }
        let known = nodes.iter().position(|known| *known == node).unwrap_or_else(|| {
            nodes.push(node);
            nodes.len() - 1
        });
        places.push((Some(known), place));
    }
    match nodes.len() {
        0 => return fault("is all on the ground, which does not move"),
        1..=MAX_NODES => {}
        _ => {
            return fault(
                "passes over more than four parts in addition to the ground: connect two ropes at an intermediate part",
            );
        }
    }
    let pays_out = drums(model, &winding, parameters)?;
    // It cannot push.
    let pulls = parameters.clone().with("side", Value::Text("tension".to_owned()));
    Ok(Contribution::of(
        model,
        Rope {
            nodes,
            places,
            drums: winding,
            pays_out,
            law: ForceLaw::new(&pulls, ["force", "damper_force"])?,
            length: if parameters.has("length") {
                parameters.function("length")?
            } else {
                std::sync::Arc::new(Constant(at_start))
            },
            switch_states: SwitchStates::default(),
        },
    ))
}

/// A straight part of the rope.
#[derive(Clone, Copy, Default)]
struct Segment {
    direction: Vector3,
    length: f64,
    speed: Vector3,
}

/// The rope at one instant.
struct Shape {
    points: [Point; MAX_PLACES],
    segments: [Segment; MAX_PLACES],
    /// Number of positions.
    count: usize,
    /// Total elongation and its rate [m, m/s].
    elongation: f64,
    rate: f64,
}

impl Shape {
    fn segments(&self) -> &[Segment] {
        &self.segments[..self.count - 1]
    }

    /// Difference of a quantity of the segments before and after the position `index`.
    fn difference(&self, index: usize, of: impl Fn(&Segment) -> Vector3) -> Vector3 {
        let before = index.checked_sub(1).map_or_else(Vector3::zeros, |before| of(&self.segments[before]));
        before - self.segments().get(index).map_or_else(Vector3::zeros, of)
    }

    /// Derivative of the total length with respect to the position `index`.
    fn pull(&self, index: usize) -> Vector3 {
        self.difference(index, |segment| segment.direction)
    }
}

impl Rope {
    fn shape(&self, at: &Kinematics) -> Shape {
        let count = self.places.len();
        let points = std::array::from_fn(|index| match self.places.get(index) {
            Some((Some(node), place)) => Point::new(&at.nodes[self.nodes[*node]], place),
            Some((None, place)) => Point::fixed(place),
            None => Point::fixed(&Vector3::zeros()),
        });
        let mut segments = [Segment::default(); MAX_PLACES];
        for (segment, pair) in segments.iter_mut().zip(points[..count].windows(2)) {
            let pair: &[Point] = pair;
            let span = pair[1].position - pair[0].position;
            let length = span.norm();
            *segment =
                Segment { direction: span / length, length, speed: pair[1].velocity - pair[0].velocity };
        }
        let length: f64 = segments[..count - 1].iter().map(|own| own.length).sum();
        let rate: f64 = segments[..count - 1].iter().map(|own| own.direction.dot(&own.speed)).sum();
        Shape {
            points,
            segments,
            count,
            elongation: length - self.free(at)[0],
            rate: rate - self.free(at)[1],
        }
    }

    /// Free length and its rate [m, m/s].
    fn free(&self, at: &Kinematics) -> [f64; 2] {
        let mut free = [self.length.value(at.time), self.length.first_derivative(at.time)];
        for (&drum, [radius, start]) in self.drums.iter().zip(&self.pays_out) {
            free[0] += radius * (at.coordinates[drum].value - start);
            free[1] += radius * at.coordinates[drum].rate;
        }
        free
    }

    /// Adds the forces of a tension on drums.
    fn add_winding(&self, tension: f64, out: &mut [f64]) {
        for (k, [radius, _]) in self.pays_out.iter().enumerate() {
            out[6 * self.nodes.len() + k] -= radius * tension;
        }
    }

    /// Gradients of the elongation and its rate.
    fn gradients(&self, shape: &Shape) -> [Gradient; 2] {
        let (mut elongation, mut rate) = (Gradient::zero(), Gradient::zero());
        let add = |sum: &mut [f64], node: usize, row: &SMatrix<f64, 1, 6>| {
            sum[6 * node..].iter_mut().zip(row.iter()).for_each(|(sum, value)| *sum += value);
        };
        for (index, (node, _)) in self.places.iter().enumerate() {
            let Some(node) = *node else { continue };
            let (point, pull) = (&shape.points[index], shape.pull(index));
            add(&mut elongation.by_place, node, &(pull.transpose() * point.gradient()));
            add(&mut rate.by_place, node, &point.turning(&pull));
        }
        for (index, Segment { direction, length, speed }) in shape.segments().iter().enumerate() {
            let turned = ((speed - direction.dot(speed) * direction) / *length).transpose();
            for (end, sign) in [(index, -1.0), (index + 1, 1.0)] {
                let Some(node) = self.places[end].0 else { continue };
                add(&mut rate.by_place, node, &(sign * turned * shape.points[end].gradient()));
            }
        }
        for (k, [radius, _]) in self.pays_out.iter().enumerate() {
            elongation.by_place[6 * self.nodes.len() + k] = -radius;
        }
        rate.by_rate = elongation.by_place;
        [elongation, rate]
    }

    fn tension(&self, shape: &Shape, at: &Kinematics) -> Response {
        self.law.evaluate(shape.elongation, shape.rate, self.switch_states.of(at))
    }

    /// Adds the forces of pulls on all positions [N, inertial axes].
    fn add_pulls(&self, shape: &Shape, pull: impl Fn(usize) -> Vector3, out: &mut [f64]) {
        for (index, (node, _)) in self.places.iter().enumerate() {
            let Some(node) = node else { continue };
            let point = &shape.points[index];
            let local = point.rotation.tr_mul(&pull(index));
            let moment = point.offset.cross(&local);
            for k in 0..3 {
                out[6 * node + k] += local[k];
                out[6 * node + 3 + k] += moment[k];
            }
        }
    }
}

impl Element for Rope {
    fn unknowns(&self) -> Unknowns<'_> {
        Unknowns { nodes: &self.nodes, coordinates: &self.drums, multipliers: &[] }
    }

    fn forces(&self, at: &Kinematics, out: &mut [f64]) {
        let shape = self.shape(at);
        let tension = self.tension(&shape, at).force;
        self.add_pulls(&shape, |index| tension * shape.pull(index), out);
        self.add_winding(tension, out);
    }

    /// The length is integrated; the remaining error is corrected along the relative velocities of the positions.
    fn stage_forces(&self, step: &StepStages<'_>, out: &mut [&mut [f64]; STAGES]) {
        let start = self.shape(step.start);
        let mut moves = [Vector3::zeros(); MAX_PLACES];
        for ((moved, point), (node, _)) in moves.iter_mut().zip(&start.points).zip(&self.places) {
            let Some(node) = node else { continue };
            let change = &step.changes[self.nodes[*node]];
            *moved = point.rotation * (change.shift + change.turn * point.offset);
        }
        let longer: f64 = (start.segments().iter().zip(moves.windows(2)))
            .map(|(segment, moves)| {
                let (before, change) = (segment.length * segment.direction, moves[1] - moves[0]);
                change.dot(&(2.0 * before + change)) / (segment.length + (before + change).norm())
            })
            .sum();
        let shapes = step.stages.map(|at| self.shape(at));
        // Only for the positions: the length paid out by a winch is known exactly, as are coordinates.
        let frees = step.stages.map(|at| self.free(at));
        let places = [0, 1].map(|j| shapes[j].rate + frees[j][1]);
        let square = |shape: &Shape| shape.segments().iter().map(|own| own.speed.norm_squared()).sum::<f64>();
        let (inverse, shares) = step.shares([square(&shapes[0]), square(&shapes[1])]);
        let missed = longer - step.whole(places);
        let round_off = 16.0 * f64::EPSILON * moves.iter().map(Vector3::norm).sum::<f64>();
        let missed = missed * above_round_off(missed.abs(), round_off);
        let rates = [0, 1].map(|j| places[j] + shares[j] * missed);
        let lengths = step.at_stages(start.elongation + self.free(step.start)[0], rates);
        for j in 0..STAGES {
            let (elongation, rate) = (lengths[j] - frees[j][0], rates[j] - frees[j][1]);
            let tension = self.law.evaluate(elongation, rate, self.switch_states.of(step.stages[j])).force;
            let shape = &shapes[j];
            let along = |segment: &Segment| segment.direction + missed * inverse * segment.speed;
            self.add_pulls(shape, |index| tension * shape.difference(index, along), out[j]);
            self.add_winding(tension, out[j]);
        }
    }

    /// With the gradients G of the length and R of its rate with respect to positions: δ(T G) = G (k G + c R)ᵀ δq + c G
    /// Gᵀ δv + T δG.
    fn linearize(&self, at: &Kinematics, out: &mut Tangents) {
        let shape = self.shape(at);
        let response = self.tension(&shape, at);
        let first_drum = 6 * self.nodes.len();
        let size = first_drum + self.drums.len();
        let gradients = shape.points.each_ref().map(Point::gradient);
        let [Gradient { by_place: by_length, .. }, Gradient { by_place: by_rate, .. }] =
            self.gradients(&shape);
        for (index, (node, _)) in self.places.iter().enumerate() {
            let Some(node) = *node else { continue };
            let (point, pull) = (&shape.points[index], shape.pull(index));
            // The force in the axes of the rotating node: δ(Rᵀ f) = (Rᵀ f)~ δθ.
            let local = skew(&point.rotation.tr_mul(&(response.force * pull)));
            add_block(&mut out.stiffness, size, (6 * node, 6 * node + 3), &local);
            add_block(&mut out.stiffness, size, (6 * node + 3, 6 * node + 3), &(skew(&point.offset) * local));
        }
        for (index, segment) in shape.segments().iter().enumerate() {
            let u = segment.direction;
            let across = (Matrix3::identity() - u * u.transpose()) / segment.length;
            let ends = [(index, -1.0), (index + 1, 1.0)];
            for (a, sign) in ends {
                let Some(row) = self.places[a].0 else { continue };
                for (b, other) in ends {
                    let Some(column) = self.places[b].0 else { continue };
                    let block =
                        gradients[a].transpose() * (response.force * sign * other * across) * gradients[b];
                    add_block(&mut out.stiffness, size, (6 * row, 6 * column), &block);
                }
            }
        }
        for i in 0..size {
            for j in 0..size {
                let along = response.stiffness * by_length[j] + response.damping * by_rate[j];
                out.stiffness[i * size + j] += by_length[i] * along;
                out.damping[i * size + j] += response.damping * by_length[i] * by_length[j];
            }
        }
    }

    fn energy(&self, at: &Kinematics) -> Energy {
        if self.is_active() {
            return Energy::default();
        }
        Energy { strain: self.law.energy(self.shape(at).elongation), ..Energy::default() }
    }

    fn switch_states(&mut self) -> Option<&mut SwitchStates> {
        Some(&mut self.switch_states)
    }

    fn capabilities(&self) -> Capabilities<'_> {
        Capabilities { load: Some(self), spring: Some(self), laws: Some(self), ..Capabilities::default() }
    }
}

impl Load for Rope {
    /// A winch supplies energy: then its total work is computed.
    fn is_active(&self) -> bool {
        self.law.is_active() || !self.length.is_constant()
    }

    fn breakpoints(&self) -> Vec<f64> {
        self.length.breakpoints()
    }
}

impl Spring for Rope {
    fn dissipates(&self) -> bool {
        self.law.depends_on_rate()
    }

    fn spring_motion(&self, at: &Kinematics) -> [f64; 3] {
        let shape = self.shape(at);
        [shape.elongation, shape.rate, self.tension(&shape, at).force]
    }

    fn slack(&self, at: &Kinematics) -> Option<[f64; 2]> {
        Some([-self.shape(at).elongation, self.length.value(at.time)])
    }

    fn spring_gradients(&self, at: &Kinematics) -> [Gradient; 3] {
        let shape = self.shape(at);
        self.tension(&shape, at).gradients(self.gradients(&shape))
    }
}

impl ForceLaws for Rope {
    fn switch_count(&self) -> usize {
        self.law.switch_count()
    }

    fn switches(&self, at: &Kinematics, out: &mut Vec<Switch>) {
        let shape = self.shape(at);
        self.law.switches(shape.elongation, shape.rate, self.switch_states.of(at), out);
    }

    fn laws(&self, at: &Kinematics, visit: &mut VisitLaw<'_>) {
        let shape = self.shape(at);
        visit(&self.law, &[shape.elongation, shape.rate]);
    }
}
