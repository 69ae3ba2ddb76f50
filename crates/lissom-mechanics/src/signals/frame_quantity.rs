//! Quantities of a frame that a node carries, relative to the global frame or to an observer's: the formulas of the outputs
//! `position`, `displacement`, `rotation`, `quaternion`, `cardan_angles`, `velocity`, `angular_velocity`, `acceleration`,
//! `line`, `relative_motion` and `distance`.
//!
//! Legend: R, x, v, w of the frame, R_F, x_F, v_F, w_F of the observer's frame, twists in their own axes; r = R_Fᵀ (x - x_F).
//!
//! ```text
//! position          r                                   rotation          log (R_Fᵀ R R₀ᵀ)
//! velocity          R_Fᵀ R v - (v_F + w_F × r)          angular velocity  R_Fᵀ R w - w_F
//! distance          |r|, r·velocity/|r|
//! acceleration      R_Fᵀ R (v' + w × v) - (v_F' + w_F' × r + w_F × (v_F + w_F × r)) - 2 w_F × velocity
//! ```

use lissom_motion::Motion;

use super::measurement::{Gradient, MAX_COMPONENTS, Measurement};
use super::moving_frame::{
    DIRECTIONS, MovingFrame, Quaternion, conjugate, constant, difference, product, rotated, rotated_back,
};
use crate::dual::{Dual, Number, Three, arc_tangent_of_ratio, cross, dot, sum};
use crate::kinematics::{CarriedFrame, Kinematics, NodeId};

/// A quantity of a frame.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Of {
    /// Position of its origin [m].
    Position,
    /// Position of its origin minus that at the start [m].
    Displacement,
    /// Rotation vector since the start [rad].
    Rotation,
    /// Unit quaternion of its axes, scalar first and not negative.
    Quaternion,
    /// Cardan angles of its axes [rad]: R = Rx(α) Ry(β) Rz(γ).
    CardanAngles,
    /// Velocity of its origin [m/s].
    Velocity,
    /// Angular velocity [rad/s].
    AngularVelocity,
    /// Acceleration of its origin [m/s²].
    Acceleration,
    /// Position of its origin [m] and rotation vector [rad].
    Pose,
    /// Distance of its origin from the observer's [m], and its rate [m/s].
    Distance,
}

impl Of {
    /// Number of components.
    pub fn component_count(self) -> usize {
        match self {
            Self::Quaternion => 4,
            Self::Pose => 6,
            Self::Distance => 2,
            _ => 3,
        }
    }
}

/// A quantity of a frame, with those who observe it.
#[derive(Clone, Copy, Debug)]
pub struct Formula {
    /// The quantity.
    pub of: Of,
    /// The frame at the start, in the observer's.
    pub start: Motion,
    /// Whether its vectors are expressed in the axes of a third frame, instead of the observer's.
    pub has_axes: bool,
}

impl Formula {
    /// Components of the quantity, of a frame seen by an observer, in the observer's axes or in those of a third frame.
    pub fn values<T: Number>(
        &self,
        own: &MovingFrame<T>,
        observer: &MovingFrame<T>,
        axes: &MovingFrame<T>,
    ) -> [T; MAX_COMPONENTS] {
        let zero = T::constant(0.0);
        let position = rotated_back(observer.rotation, difference(own.position, observer.position));
        let rotation = product(conjugate(observer.rotation), own.rotation);
        let since_start = || product(rotation, conjugate(self.start.rotation.quaternion().map(T::constant)));
        let carried = sum(observer.velocity, cross(observer.spin, position));
        let velocity = || difference(rotated(rotation, own.velocity), carried);
        let vector = match self.of {
            Of::Position => position,
            Of::Displacement => difference(position, constant(self.start.position)),
            Of::Rotation => logarithm(since_start()),
            Of::Quaternion => {
                let sign = if rotation[0].value() < 0.0 { -1.0 } else { 1.0 };
                let [a, b, c, d] = rotation.map(|part| part.scaled(sign));
                return [a, b, c, d, zero, zero];
            }
            Of::CardanAngles => cardan_angles(rotation),
            Of::Velocity => velocity(),
            Of::AngularVelocity => difference(rotated(rotation, own.spin), observer.spin),
            Of::Acceleration => {
                let absolute = rotated(rotation, sum(own.acceleration, cross(own.spin, own.velocity)));
                let transport = sum(
                    sum(observer.acceleration, cross(observer.spin_rate, position)),
                    cross(observer.spin, carried),
                );
                let coriolis = cross(observer.spin, velocity()).map(|part| part.scaled(2.0));
                difference(difference(absolute, transport), coriolis)
            }
            Of::Distance => {
                let distance = dot(position, position).square_root();
                let is_apart = distance.value() > 0.0;
                let rate = if is_apart { dot(position, velocity()) / distance } else { zero };
                return [distance, rate, zero, zero, zero, zero];
            }
            Of::Pose => {
                let ([x, y, z], [a, b, c]) = (position, logarithm(rotation));
                return [x, y, z, a, b, c];
            }
        };
        let [x, y, z] = if self.has_axes {
            rotated_back(axes.rotation, rotated(observer.rotation, vector))
        } else {
            vector
        };
        [x, y, z, zero, zero, zero]
    }
}

/// A quantity of a frame that a node carries.
#[derive(Clone, Debug)]
pub struct FrameQuantity {
    formula: Formula,
    /// The node of the frame, then those of the observer and of the axes, where there are any.
    nodes: Vec<NodeId>,
    offset: Motion,
    observer: Option<CarriedFrame>,
    axes: Option<CarriedFrame>,
}

impl FrameQuantity {
    /// A quantity of a frame relative to an `observer`, or to the global frame, expressed in `axes`, or in those of the
    /// observer; `start` is the frame at the start in the observer's.
    pub fn new(
        of: Of,
        own: CarriedFrame,
        observer: Option<CarriedFrame>,
        axes: Option<CarriedFrame>,
        start: Motion,
    ) -> Self {
        let nodes = [Some(own), observer, axes].into_iter().flatten().map(|frame| frame.node).collect();
        let formula = Formula { of, start, has_axes: axes.is_some() };
        Self { formula, nodes, offset: own.offset, observer, axes }
    }

    /// Components of the quantity, where node number `k` of [`nodes`](Measurement::nodes) moves as `node(k)`.
    fn evaluate<T: Number>(&self, node: impl Fn(usize) -> MovingFrame<T>) -> [T; MAX_COMPONENTS] {
        let mut next = 0;
        let mut carried = |frame: Option<Motion>| {
            frame.map_or_else(MovingFrame::global, |offset| {
                next += 1;
                node(next - 1).carried(&offset)
            })
        };
        let own = carried(Some(self.offset));
        let observer = carried(self.observer.map(|frame| frame.offset));
        let axes = carried(self.axes.map(|frame| frame.offset));
        self.formula.values(&own, &observer, &axes)
    }
}

impl Measurement for FrameQuantity {
    fn nodes(&self) -> &[NodeId] {
        &self.nodes
    }

    fn component_count(&self) -> usize {
        self.formula.of.component_count()
    }

    fn values(&self, at: &Kinematics) -> [f64; MAX_COMPONENTS] {
        self.evaluate(|k| MovingFrame::of_node(&at.nodes[self.nodes[k]]))
    }

    fn gradient(&self, component: usize, at: &Kinematics) -> Gradient {
        let mut gradient = Gradient::zero();
        for varied in 0..self.nodes.len() {
            let node = |k: usize| -> MovingFrame<Dual<DIRECTIONS>> {
                let node = &at.nodes[self.nodes[k]];
                if k == varied { MovingFrame::variable(node) } else { MovingFrame::of_node(node) }
            };
            let Dual { by, .. } = self.evaluate(node)[component];
            let own = 6 * varied..6 * varied + 6;
            gradient.by_place[own.clone()].copy_from_slice(&by[..6]);
            gradient.by_rate[own.clone()].copy_from_slice(&by[6..12]);
            gradient.by_acceleration[own].copy_from_slice(&by[12..]);
        }
        gradient
    }
}

/// Below this square of the tangent of half the angle the series of the logarithm has the precision of doubles.
const SERIES_LIMIT: f64 = 1e-4;

/// Rotation vector θ with |θ| ≤ π of a unit quaternion (c, s): θ = g s, and with n = |s|
///
/// ```text
/// g = 2 atan2(n, c)/n = (2/c) (1 - x/3 + x²/5 - …),   x = (n/c)²
/// ∂g/∂c = -2/(c² + n²),   ∂g/∂(n²) = (c/(c² + n²) - g/2)/n² = -(2/c³) (1/3 - 2x/5 + 3x²/7 - …)
/// ```
fn logarithm<T: Number>(rotation: Quaternion<T>) -> Three<T> {
    // Both signs mean the same rotation.
    let sign = if rotation[0].value() < 0.0 { -1.0 } else { 1.0 };
    let [scalar, vector @ ..] = rotation.map(|part| part.scaled(sign));
    let square = dot(vector, vector);
    let (c, n2) = (scalar.value(), square.value());
    let x = n2 / (c * c);
    let (factor, by_square) = if x < SERIES_LIMIT {
        let (mut series, mut slope) = (0.0, 0.0);
        for k in (0..5).rev() {
            let term = 1.0 / f64::from(2 * k + 1);
            series = term - x * series;
            let term = f64::from(k + 1) / f64::from(2 * k + 3);
            slope = term - x * slope;
        }
        (2.0 / c * series, -2.0 / (c * c * c) * slope)
    } else {
        let factor = 2.0 * n2.sqrt().atan2(c) / n2.sqrt();
        (factor, (c / (c * c + n2) - 0.5 * factor) / n2)
    };
    let by_scalar = -2.0 / (c * c + n2);
    let factor = (scalar.plus(-c).scaled(by_scalar) + square.plus(-n2).scaled(by_square)).plus(factor);
    vector.map(|part| part * factor)
}

/// Angles of R = Rx(α) Ry(β) Rz(γ). Where cos β vanishes α and γ turn about the same axis; then γ is 0.
fn cardan_angles<T: Number>(rotation: Quaternion<T>) -> Three<T> {
    let one = T::constant(1.0);
    let zero = T::constant(0.0);
    let column =
        [[one, zero, zero], [zero, one, zero], [zero, zero, one]].map(|axis| rotated(rotation, axis));
    let cosine = column[0][0].value().hypot(column[1][0].value());
    if cosine < 1e-12 {
        let beta = T::constant(column[2][0].value().atan2(cosine));
        return [arc_tangent_of_ratio(column[1][2], column[1][1]), beta, zero];
    }
    let level = (column[0][0] * column[0][0] + column[1][0] * column[1][0]).square_root();
    [
        arc_tangent_of_ratio(-column[2][1], column[2][2]),
        arc_tangent_of_ratio(column[2][0], level),
        arc_tangent_of_ratio(-column[1][0], column[0][0]),
    ]
}

#[cfg(test)]
#[path = "../../tests/unit/signals/frame_quantity.rs"]
mod tests;
