//! The road under a tyre: a plane, or the plane that fits the heights at points of the contact best.
//!
//! Legend: c centre of the wheel, u = (e - a (a·e))/|…| upwards in the wheel's plane, e normal of the road's plane, x and y directions along and across
//! the wheel in it, R free radius; l_i and w_j distances of five points along the contact and three across it.
//!
//! ```text
//! p = c - R u,    z_ij = z(p + l_i x + w_j y),    s_x = Σ l z/Σ l²,    s_y = Σ w z/Σ w²
//! n = (e - s_x x - s_y y)/|…|,    h = n·(c - m),    m below p at the mean of z
//! b² = (Σ z² - s_x² Σ l² - s_y² Σ w²)/15 with z from their mean
//! ```

use crate::dual::{Number, Three, cross, dot, sum, times};
use crate::registry::{Force, ParameterError, Parameters};
use crate::wheels::wheel_on_rail::Pose;

/// A road under a wheel.
#[derive(Clone, Debug)]
pub(super) struct Ground {
    /// On which side of the road's plane the wheel is, along its normal.
    pub(super) side: f64,
    uneven: Option<Uneven>,
}

/// The plane under a wheel.
pub(super) struct Footing<T> {
    /// n.
    pub(super) normal: Three<T>,
    /// h.
    pub(super) height: T,
    /// b, the standard deviation of the road from the plane [m].
    pub(super) bumps: f64,
}

#[derive(Clone, Debug)]
struct Uneven {
    height: Force,
    radius: f64,
    /// Half of the length and width of the contact.
    reach: [f64; 2],
}

impl Ground {
    pub(super) fn new(side: f64, radius: f64, parameters: &Parameters) -> Result<Self, ParameterError> {
        let Some(height) = parameters.force("road")? else { return Ok(Self { side, uneven: None }) };
        let reach = [
            0.5 * parameters.number_or("contact_length", 0.4 * radius)?,
            0.5 * parameters.number_or("width", 0.6 * radius)?,
        ];
        Ok(Self { side, uneven: Some(Uneven { height, radius, reach }) })
    }

    /// The plane for a wheel with the axis a.
    pub(super) fn under<T: Number>(&self, pose: &Pose<T>, axis: Three<T>) -> Footing<T> {
        let upright = [0.0, 0.0, self.side].map(T::constant);
        let Some(Uneven { height, radius, reach }) = &self.uneven else {
            return Footing { normal: upright, height: pose.position[2].scaled(self.side), bumps: 0.0 };
        };
        let lean = dot(axis, upright);
        let narrowing = T::constant(1.0) / (T::constant(1.0) - lean * lean).square_root();
        let x = times(cross(axis, upright), narrowing);
        let y = cross(upright, x);
        let upwards = times(sum(upright, times(axis, -lean)), narrowing);
        let below = sum(pose.position, times(upwards, T::constant(-radius)));
        let (mut mean, mut slopes) = (T::constant(0.0), [T::constant(0.0); 2]);
        let mut squares = 0.0;
        for i in [-1.0, -0.5, 0.0, 0.5, 1.0] {
            for j in [-1.0, 0.0, 1.0] {
                let [along, across] = [i * reach[0], j * reach[1]];
                let [px, py] = [0, 1].map(|k| below[k] + x[k].scaled(along) + y[k].scaled(across));
                let [value, by_x, by_y] = height.evaluate(px.value(), py.value());
                let level = px.composed(value, by_x) + py.composed(0.0, by_y);
                mean = mean + level.scaled(1.0 / 15.0);
                squares += value * value / 15.0;
                // Σ l² is 7.5 times the square of the half length, Σ w² 10 times that of the half width.
                slopes[0] = slopes[0] + level.scaled(i / (7.5 * reach[0]));
                slopes[1] = slopes[1] + level.scaled(j / (10.0 * reach[1]));
            }
        }
        let steep = sum(times(x, -slopes[0]), times(y, -slopes[1]));
        let normal = sum(upright, steep);
        let normal = times(normal, T::constant(1.0) / dot(normal, normal).square_root());
        let above = [
            pose.position[0] - below[0],
            pose.position[1] - below[1],
            pose.position[2] - mean.scaled(self.side),
        ];
        let bumps = squares
            - mean.value().powi(2)
            - 0.5 * (slopes[0].value() * reach[0]).powi(2)
            - 2.0 / 3.0 * (slopes[1].value() * reach[1]).powi(2);
        Footing { normal, height: dot(normal, above), bumps: bumps.max(0.0).sqrt() }
    }
}
