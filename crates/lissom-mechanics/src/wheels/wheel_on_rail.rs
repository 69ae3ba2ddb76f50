//! Point of contact between a wheel and a rail: the position at which both surfaces have a common normal.
//!
//! Legend: base's axes e₁ outwards across the track, e₂ up, e₃ along the rail; x tip's origin, a axis of the wheel, ξ position
//! along it from the nominal circle, b distance of that from the tip's origin; r(ξ) radius; p, q directions perpendicular to the
//! axis, down and along; ψ shift angle from p to q; u position on the rail's head with point Q, normal N and tangent t.
//!
//! ```text
//! p = a × e₃/C,   q = (e₃ - a₃ a)/C,   C² = 1 - a₃²,      d = cos ψ p + sin ψ q,   sin ψ = r' a₃/C
//! P = x + (b + ξ) a + r d,      n = d - r' a,      n·t = 0,   (P - Q)·t = 0,      gap g = (P - Q)·N
//! ```
//!
//! A rail is a prism, so that the common normal has no component along e₃. This gives ψ directly, and the rest is a plane
//! problem for ξ and u. For a cone on a circle P moves along a straight line, and ξ and u follow directly from the
//! projection of the circle's centre onto it. For other profiles Newton's method starts from the sample of smallest
//! clearance: the result depends only on the configuration. The gap does not change with ξ, ψ and u to first order, so
//! that its gradient is N at the wheel's point of contact. Derivatives of ξ and u follow from the implicit function
//! theorem.

use lissom_motion::{Matrix3, Vector3};

use super::profile::{RailProfile, WheelProfile};
use crate::dual::{Dual, Number, Three, arc_tangent_of_ratio, cross, dot, sum, times};
use crate::round_off;

/// Samples of a given profile.
const SAMPLES: usize = 64;
/// Maximum number of iterations for the position of contact.
const MAX_ITERATIONS: usize = 40;
/// Cosine of the largest angle from the top of the head at which a position of contact is on its tread.
const STEEPEST: f64 = 0.5;

/// A wheel and a rail.
#[derive(Clone, Debug)]
pub struct RailContact {
    /// Axis of the wheel in the tip's joint frame, outwards.
    pub axis: Vector3,
    /// 1 if the second axis of the base's joint frame points to the wheel, otherwise -1.
    pub side: f64,
    /// Distance of the nominal circle from the tip's origin along the axis [m].
    pub offset: f64,
    /// Nominal radius [m].
    pub radius: f64,
    /// Profile of the wheel.
    pub wheel: WheelProfile,
    /// Profile of the rail.
    pub rail: RailProfile,
    /// Range of positions along the axis at which the wheel's profile is that of the tread [m].
    pub tread: [f64; 2],
}

/// Position and forces of the contact between a wheel and its rail.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct RailContactValues {
    /// Position along the wheel's axis, outwards from the nominal circle [m].
    pub on_wheel: f64,
    /// Position on the rail from its nominal position of contact: length of the arc of a circle, lateral position of other profiles [m].
    pub on_rail: f64,
    /// Angle from the lowest spoke to that of the contact [rad].
    pub shift_angle: f64,
    /// Normal force; negative if the rail pulls [N].
    pub normal_force: f64,
    /// Creep forces on the wheel along and across the direction of rolling [N].
    pub forces: [f64; 2],
    /// Longitudinal and lateral creepage [-], and spin [1/m].
    pub creepages: [f64; 3],
}

/// Pose of the tip's joint frame relative to the base's.
#[derive(Clone, Copy, Debug)]
pub struct Pose<T> {
    /// Rows of the rotation matrix.
    pub rows: [Three<T>; 3],
    /// Position of the wheel in the frame of the rail [m].
    pub position: Three<T>,
}

impl Pose<f64> {
    /// From a rotation matrix and a position [m].
    pub fn new(rotation: &Matrix3, position: &Vector3) -> Self {
        let rows = std::array::from_fn(|i| std::array::from_fn(|j| rotation[(i, j)]));
        Self { rows, position: (*position).into() }
    }

    /// With derivatives by the tip's body variation, along the first six directions.
    pub fn varied<const N: usize>(&self) -> Pose<Dual<N>> {
        let constant = |value: &f64| Dual::constant(*value);
        let mut out = Pose {
            rows: self.rows.map(|row| row.each_ref().map(constant)),
            position: self.position.each_ref().map(constant),
        };
        for (i, row) in self.rows.iter().enumerate() {
            for k in 0..3 {
                out.position[i].by[k] = row[k];
                // δR = R η̃: column k + 2 times η_k is added to column k + 1, and column k + 1 times η_k subtracted
                // from column k + 2.
                let (a, b) = ((k + 1) % 3, (k + 2) % 3);
                out.rows[i][b].by[3 + k] = -row[a];
                out.rows[i][a].by[3 + k] = row[b];
            }
        }
        out
    }
}

impl<T: Number> Pose<T> {
    /// Transforms a vector from the tip's axes to the base's.
    pub fn apply(&self, v: Three<T>) -> Three<T> {
        self.rows.map(|row| dot(row, v))
    }

    /// Transforms a vector from the base's axes to the tip's.
    pub fn apply_inverse(&self, v: Three<T>) -> Three<T> {
        std::array::from_fn(|k| self.rows[0][k] * v[0] + self.rows[1][k] * v[1] + self.rows[2][k] * v[2])
    }
}

/// A position on the wheel at which its normal is perpendicular to the rail.
#[derive(Clone, Copy, Debug)]
pub(crate) struct WheelPoint<T> {
    /// a, in the base's axes.
    pub axis: Three<T>,
    /// P - x, in the base's axes [m].
    pub arm: Three<T>,
    /// Radius r [m], r' and r''.
    pub radius: [T; 3],
    /// d, in the base's axes.
    spoke: Three<T>,
    /// P, outwards and up [m].
    point: [T; 2],
    /// n, likewise.
    normal: [T; 2],
}

/// Position of contact on wheel and rail.
#[derive(Clone, Copy, Debug)]
pub struct ContactPosition<T> {
    /// ξ [m].
    pub along: T,
    /// u [m].
    pub on_rail: T,
}

/// A position of contact, and whether it converged.
#[derive(Clone, Copy, Debug)]
pub struct Found {
    /// The point of contact.
    pub place: ContactPosition<f64>,
    pub(crate) is_common_normal: bool,
}

impl RailContact {
    /// The wheel's point at a position along its axis.
    pub(crate) fn wheel_point<T: Number>(&self, pose: &Pose<T>, along: T) -> WheelPoint<T> {
        let axis = pose.apply([self.axis.x, self.axis.y, self.axis.z].map(T::constant));
        let [first, second, third] = axis;
        let size = (T::constant(1.0 + round_off::SQUARE) - third * third).square_root();
        let zero = T::constant(0.0);
        let down = [second / size, -first / size, zero].map(|value| value.scaled(self.side));
        let forward =
            [-third * first / size, -third * second / size, (T::constant(1.0) - third * third) / size];
        let [profile, slope, bend] = self.wheel.at(along);
        let radius = profile.plus(self.radius);
        let shift = slope * third / size;
        // Beyond this there is no common normal; values remain finite, so that the search fails regularly.
        let square = T::constant(1.0) - shift * shift;
        let cosine = if square.value() > 0.0 { square.square_root() } else { T::constant(0.0) };
        let spoke = sum(times(down, cosine), times(forward, shift));
        let arm = sum(times(axis, along.plus(self.offset)), times(spoke, radius));
        let normal = sum(spoke, times(axis, -slope));
        WheelPoint {
            axis,
            arm,
            radius: [radius, slope, bend],
            spoke,
            point: [pose.position[0] + arm[0], (pose.position[1] + arm[1]).scaled(self.side)],
            normal: [normal[0], normal[1].scaled(self.side)],
        }
    }

    /// n·t and (P - Q)·t, in that order, and the gap.
    fn equations<T: Number>(&self, pose: &Pose<T>, place: &ContactPosition<T>) -> ([T; 2], T) {
        let of_wheel = self.wheel_point(pose, place.along);
        let point = self.rail.point(place.on_rail);
        let normal = self.rail.normal(place.on_rail);
        let tangent = [normal[1], -normal[0]];
        let across = |v: [T; 2], w: [T; 2]| v[0] * w[0] + v[1] * w[1];
        let apart = [of_wheel.point[0] - point[0], of_wheel.point[1] - point[1]];
        ([across(of_wheel.normal, tangent), across(apart, tangent)], across(apart, normal))
    }

    /// Values of the equations and their derivatives with respect to ξ and u.
    fn linearized(&self, pose: &Pose<f64>, place: &ContactPosition<f64>) -> [Dual<2>; 2] {
        let constant = |value: &f64| Dual::constant(*value);
        let fixed = Pose {
            rows: pose.rows.each_ref().map(|row| row.each_ref().map(constant)),
            position: pose.position.each_ref().map(constant),
        };
        let varied = ContactPosition {
            along: Dual::variable(place.along, 0),
            on_rail: Dual::variable(place.on_rail, 1),
        };
        self.equations(&fixed, &varied).0
    }

    /// The point of contact, or of smallest distance.
    pub fn place(&self, pose: &Pose<f64>) -> Found {
        let mut place = self.first_place(pose);
        let size = |rows: &[f64; 2]| rows[0].hypot(rows[1] / self.radius);
        let mut rows = self.linearized(pose, &place);
        let mut before = size(&rows.map(Number::value));
        for _ in 0..MAX_ITERATIONS {
            let [along, on_rail] = solved(&rows, &rows.map(Number::value));
            let mut share = 1.0;
            let (next, next_rows, after) = loop {
                let next = ContactPosition {
                    along: place.along - share * along,
                    on_rail: place.on_rail - share * on_rail,
                };
                let next_rows = self.linearized(pose, &next);
                let after = size(&next_rows.map(Number::value));
                if after <= before || share < 1e-3 || before <= round_off::CURVATURE_CENTRE {
                    break (next, next_rows, after);
                }
                share *= 0.5;
            };
            let is_round_off =
                share * along.hypot(on_rail) <= 4.0 * round_off::CURVATURE_CENTRE * self.radius;
            if is_round_off || (before < 1e-13 && after >= before) {
                return Found { place, is_common_normal: true };
            }
            (place, rows, before) = (next, next_rows, after);
        }
        Found { place, is_common_normal: before < 1e-9 }
    }

    /// Initial guess of the iteration.
    fn first_place(&self, pose: &Pose<f64>) -> ContactPosition<f64> {
        if let (WheelProfile::Cone(_), RailProfile::Circle { .. }) = (&self.wheel, &self.rail) {
            return self.foot(pose);
        }
        let [low, high] = self.tread;
        let samples = (0..=SAMPLES).map(|k| low + (high - low) * k as f64 / SAMPLES as f64);
        let cleared = samples.map(|along| {
            let (clearance, on_rail) = self.rail.clearance(self.wheel_point(pose, along).point);
            (clearance, ContactPosition { along, on_rail })
        });
        let least = cleared.reduce(|least, own| if own.0 < least.0 { own } else { least });
        least.map_or_else(|| self.foot(pose), |(_, place)| place)
    }

    /// Projection of the centre of the rail's circle onto the line of a cone, for those that fit at the nominal
    /// circle.
    fn foot(&self, pose: &Pose<f64>) -> ContactPosition<f64> {
        let [from, to] = [0.0, self.radius].map(|along| self.wheel_point(pose, along).point);
        let (radius, cant) = self.rail.osculating();
        let line = [(to[0] - from[0]) / self.radius, (to[1] - from[1]) / self.radius];
        let centre = [radius * cant.sin(), -radius * cant.cos()];
        let square = line[0] * line[0] + line[1] * line[1];
        let along = ((centre[0] - from[0]) * line[0] + (centre[1] - from[1]) * line[1]) / square;
        let point = [from[0] + along * line[0], from[1] + along * line[1]];
        let angle = (point[0] - centre[0]).atan2(point[1] - centre[1]);
        let on_rail = match self.rail {
            RailProfile::Circle { .. } => radius * (angle + cant),
            RailProfile::Given(..) => point[0],
        };
        ContactPosition { along, on_rail }
    }

    /// Angle between the spoke at a position and the lowest one, along the rail [rad].
    pub fn shift_angle<T: Number>(&self, pose: &Pose<T>, along: T) -> T {
        let WheelPoint { axis: [first, second, third], spoke, .. } = self.wheel_point(pose, along);
        let up = second.scaled(self.side);
        let size = (T::constant(1.0) - up * up).square_root();
        let down = [up * first, (up * second).plus(-self.side), up * third].map(|value| value / size);
        let level = (first * first + third * third).square_root();
        let level = level.composed(first.value().hypot(third.value()), 1.0);
        let forward = [-third, T::constant(0.0), first].map(|value| value / level);
        arc_tangent_of_ratio(dot(spoke, forward), dot(spoke, down))
    }

    /// Gap [m], positive if the surfaces are separated.
    pub fn gap(&self, pose: &Pose<f64>) -> f64 {
        self.equations(pose, &self.place(pose).place).1
    }

    /// Position of contact with its derivatives, by the implicit function theorem.
    pub(crate) fn varied_place<const N: usize>(
        &self,
        pose: &Pose<f64>,
        varied: &Pose<Dual<N>>,
    ) -> ContactPosition<Dual<N>> {
        let place = self.place(pose).place;
        let rows = self.linearized(pose, &place);
        let constant =
            ContactPosition { along: Dual::constant(place.along), on_rail: Dual::constant(place.on_rail) };
        let (changes, _) = self.equations(varied, &constant);
        let mut out = constant;
        for k in 0..N {
            let [along, on_rail] = solved(&rows, &[changes[0].by[k], changes[1].by[k]]);
            out.along.by[k] = -along;
            out.on_rail.by[k] = -on_rail;
        }
        out
    }

    /// E and g of Hertz's ellipse for the curvatures at a pose.
    pub(crate) fn hertz_ellipse(&self, pose: &Pose<f64>) -> [f64; 2] {
        let place = self.place(pose).place;
        let [along, across] = self.curvatures(&place, self.wheel_point(pose, place.along).radius);
        hertz_ellipse(along, across)
    }

    /// Half the sums of curvatures of both surfaces along and across the rail [1/m].
    pub fn curvatures<T: Number>(&self, place: &ContactPosition<T>, [radius, slope, bend]: [T; 3]) -> [T; 2] {
        let steep = (slope * slope).plus(1.0);
        let of_wheel = bend * steep.power(-1.5);
        let across = (self.rail.curvature(place.on_rail) - of_wheel).scaled(0.5);
        [T::constant(0.5) / (radius * steep.square_root()), across]
    }

    /// The rail's normal, from the rail to the wheel, in the base's axes.
    pub fn normal<T: Number>(&self, place: &ContactPosition<T>) -> Three<T> {
        let [outwards, upwards] = self.rail.normal(place.on_rail);
        [outwards, upwards.scaled(self.side), T::constant(0.0)]
    }

    /// Derivative of the gap with respect to the body variation of the tip's joint frame.
    pub fn row<T: Number>(&self, pose: &Pose<T>, place: &ContactPosition<T>) -> [T; 6] {
        let normal = pose.apply_inverse(self.normal(place));
        let arm = pose.apply_inverse(self.wheel_point(pose, place.along).arm);
        let moment = cross(arm, normal);
        [normal[0], normal[1], normal[2], moment[0], moment[1], moment[2]]
    }
}

impl RailContact {
    /// Limits exceeded by the position of contact, in words that follow the wheel's name.
    pub fn doubt(&self, pose: &Pose<f64>) -> Option<String> {
        let Found { place, is_common_normal } = self.place(pose);
        if !is_common_normal {
            return Some(
                "touches its rail nowhere with a common normal: it is turned too far across the track"
                    .to_owned(),
            );
        }
        let [low, high] = self.tread;
        if place.along < low || place.along > high {
            let at = place.along;
            return Some(format!(
                "touches {at:.5} m from its nominal circle, beyond its tread, which ends at {low:.5} and {high:.5} m: its flange, \
                 or nothing, would carry it there"
            ));
        }
        let angle = self.rail.normal(place.on_rail);
        if angle[1] < STEEPEST {
            let angle = angle[0].abs().atan2(angle[1]).to_degrees();
            return Some(format!("touches its rail on the flank, at {angle:.0} degrees from the top"));
        }
        self.second_place(pose, place.along).map(|second| {
            format!(
                "touches its rail at two positions at once, {:.5} and {second:.5} m from its nominal circle: one constraint holds one",
                place.along
            )
        })
    }

    /// Another position along the axis with a local minimum of the clearance near zero, for given profiles.
    fn second_place(&self, pose: &Pose<f64>, first: f64) -> Option<f64> {
        if let (WheelProfile::Cone(_), RailProfile::Circle { .. }) = (&self.wheel, &self.rail) {
            return None;
        }
        let [low, high] = self.tread;
        let apart = (high - low) / SAMPLES as f64;
        let clearance = |along: f64| self.rail.clearance(self.wheel_point(pose, along).point).0;
        let samples: Vec<f64> = (0..=SAMPLES).map(|k| clearance(low + apart * k as f64)).collect();
        let is_least = |k: &usize| {
            let neighbours = [k.checked_sub(1), Some(k + 1)];
            neighbours.iter().flatten().filter_map(|&at| samples.get(at)).all(|other| samples[*k] <= *other)
        };
        (0..=SAMPLES)
            .filter(is_least)
            .filter(|&k| samples[k] < round_off::GIVEN * self.radius)
            .map(|k| low + apart * k as f64)
            .find(|along| (along - first).abs() > 2.0 * apart)
    }
}

/// The solution of two linear equations with these derivatives.
fn solved(rows: &[Dual<2>; 2], right: &[f64; 2]) -> [f64; 2] {
    let [[a, b], [c, d]] = [rows[0].by, rows[1].by];
    let determinant = a * d - b * c;
    [(d * right[0] - b * right[1]) / determinant, (a * right[1] - c * right[0]) / determinant]
}

/// Elliptic integral E and ratio g = b/a of the half axes for half sums of curvatures A and B [Hertz 1882; Johnson 1985]:
///
/// ```text
/// max(A, B)/min(A, B) = (E/g² - K)/(K - E),      K and E of the modulus (1 - g²)^½
/// ```
fn hertz_ellipse(along: f64, across: f64) -> [f64; 2] {
    let wanted = (along / across).max(across / along);
    if !wanted.is_finite() || wanted <= 1.0 + 1e-9 {
        return [std::f64::consts::FRAC_PI_2, 1.0];
    }
    let (mut low, mut high) = (1e-6_f64, 1.0_f64);
    for _ in 0..200 {
        let ratio = 0.5 * (low + high);
        let [first, second] = elliptic_integrals(ratio);
        if (second / (ratio * ratio) - first) / (first - second) > wanted {
            low = ratio;
        } else {
            high = ratio;
        }
    }
    let ratio = 0.5 * (low + high);
    [elliptic_integrals(ratio)[1], ratio]
}

/// K and E of the complementary modulus `ratio`, by the arithmetic-geometric mean.
fn elliptic_integrals(ratio: f64) -> [f64; 2] {
    let (mut mean, mut root) = (1.0_f64, ratio);
    let mut sum = 0.5 * (1.0 - ratio * ratio);
    let mut weight = 0.5;
    while (mean - root).abs() > 1e-15 * mean {
        let difference = 0.5 * (mean - root);
        (mean, root) = (0.5 * (mean + root), (mean * root).sqrt());
        weight *= 2.0;
        sum += weight * difference * difference;
    }
    let first = std::f64::consts::FRAC_PI_2 / mean;
    [first, first * (1.0 - sum)]
}

#[cfg(test)]
#[path = "../../tests/unit/wheels/wheel_on_rail.rs"]
mod tests;
