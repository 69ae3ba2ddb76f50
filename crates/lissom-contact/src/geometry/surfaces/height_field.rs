//! The ground below smooth heights over a rectangular grid.
//!
//! Legend: f(u, v) height, a bicubic polynomial in each cell with continuous slopes (by Catmull and Rom); foot (u, v, f) of y where
//! y - foot is along the normal N = (-f_u, -f_v, 1); d = |N|.
//!
//! ```text
//! φ = N·(y - foot)/d,      n = N/d,      II = ∇∇f/d,   I = 1 + ∇f ∇fᵀ  (second and first fundamental form)
//! ∂(u, v)/∂y = (I - φ II)⁻¹ [r_u, r_v]ᵀ,      H = -[r_u, r_v] I⁻¹ II (I - φ II)⁻¹ [r_u, r_v]ᵀ
//! ```

use lissom_motion::Vector3;
use nalgebra::{Matrix2, Matrix3x2, Vector2};

use super::{Distance, Surface};
use lissom_mechanics::round_off;

/// Newton's corrections of the foot.
const MAX_CORRECTIONS: usize = 50;

/// Heights over a grid, extended beyond its borders by those at the border.
#[derive(Clone, Debug, PartialEq)]
pub struct HeightField {
    /// Heights by row along the second axis, then by column along the first [m].
    heights: Vec<Vec<f64>>,
    /// The first corner of the grid [m].
    corner: Vector2<f64>,
    /// Distances of columns and rows [m].
    spacing: Vector2<f64>,
}

impl HeightField {
    /// Field of heights in rows of equal length, over a rectangle of these sides about the origin [m]; none with fewer than two rows or
    /// columns.
    pub fn new(heights: Vec<Vec<f64>>, sides: [f64; 2]) -> Option<Self> {
        let (rows, columns) = (heights.len(), heights.first().map_or(0, Vec::len));
        let is_valid = rows > 1 && columns > 1 && heights.iter().all(|row| row.len() == columns);
        let spacing =
            Vector2::new(sides[0] / (columns.max(2) - 1) as f64, sides[1] / (rows.max(2) - 1) as f64);
        is_valid.then(|| Self { heights, corner: -0.5 * Vector2::from(sides), spacing })
    }

    /// The points of the grid [m].
    pub fn points(&self) -> impl Iterator<Item = Vector3> {
        self.heights.iter().enumerate().flat_map(move |(row, heights)| {
            heights.iter().enumerate().map(move |(column, height)| {
                let at = self.corner + self.spacing.component_mul(&Vector2::new(column as f64, row as f64));
                Vector3::new(at.x, at.y, *height)
            })
        })
    }

    /// Number of columns.
    pub fn columns(&self) -> usize {
        self.heights[0].len()
    }

    /// f, ∇f and ∇∇f.
    fn height(&self, place: &Vector2<f64>) -> (f64, Vector2<f64>, Matrix2<f64>) {
        let own = (place - self.corner).component_div(&self.spacing);
        let (columns, rows) = (self.heights[0].len(), self.heights.len());
        let (column, u) = cell(own.x, columns);
        let (row, v) = cell(own.y, rows);
        let [along, across] = [weights(u), weights(v)];
        let at = |index: isize, count: usize| index.clamp(0, count.cast_signed() - 1).cast_unsigned();
        let mut sums = [[0.0; 3]; 3];
        for j in 0..4_usize {
            let heights = &self.heights[at(row + j.cast_signed() - 1, rows)];
            for i in 0..4_usize {
                let height = heights[at(column + i.cast_signed() - 1, columns)];
                for (a, by) in sums.iter_mut().enumerate() {
                    for (b, sum) in by.iter_mut().enumerate() {
                        *sum += along[a][i] * across[b][j] * height;
                    }
                }
            }
        }
        let [width, depth] = [self.spacing.x, self.spacing.y];
        let mixed = sums[1][1] / (width * depth);
        (
            sums[0][0],
            Vector2::new(sums[1][0] / width, sums[0][1] / depth),
            Matrix2::new(sums[2][0] / (width * width), mixed, mixed, sums[0][2] / (depth * depth)),
        )
    }

    /// The foot of a point that is found from `start` on.
    fn foot(&self, y: &Vector3, start: Vector2<f64>) -> Vector2<f64> {
        let mut place = start;
        let (mut height, mut slope, mut bend) = self.height(&place);
        let squared = |place: &Vector2<f64>, height: f64| {
            (y.xy() - place).norm_squared() + (y.z - height) * (y.z - height)
        };
        for _ in 0..MAX_CORRECTIONS {
            // Half the squared distance over (u, v): gradient, and a positive Hessian.
            let above = y.z - height;
            let gradient = place - y.xy() - above * slope;
            let mut hessian = Matrix2::identity() + slope * slope.transpose();
            let bent = hessian - above * bend;
            if bent.determinant() > 0.0 && bent.trace() > 0.0 {
                hessian = bent;
            }
            let Some(inverse) = hessian.try_inverse() else { break };
            let (mut step, before) = (-(inverse * gradient), squared(&place, height));
            for _ in 0..MAX_CORRECTIONS {
                let trial = place + step;
                (height, slope, bend) = self.height(&trial);
                if squared(&trial, height) <= before * (1.0 + round_off::SQUARED_DISTANCE) {
                    break;
                }
                step *= 0.5;
            }
            place += step;
            if step.norm() <= round_off::CURVE_PARAMETER * (self.spacing.norm() + place.norm()) {
                break;
            }
        }
        place
    }

    /// Distance of a point from the tangent plane at its foot.
    fn distance_at(&self, place: &Vector2<f64>, y: &Vector3) -> Distance {
        let (height, slope, bend) = self.height(place);
        let length = (1.0 + slope.norm_squared()).sqrt();
        let normal = Vector3::new(-slope.x, -slope.y, 1.0) / length;
        let value = normal.dot(&(y - Vector3::new(place.x, place.y, height)));
        let along = Matrix3x2::new(1.0, 0.0, 0.0, 1.0, slope.x, slope.y);
        let (first, second) = (Matrix2::identity() + slope * slope.transpose(), bend / length);
        let curvature = match ((first - value * second).try_inverse(), first.try_inverse()) {
            (Some(by_place), Some(inverse)) => -along * inverse * second * by_place * along.transpose(),
            _ => nalgebra::Matrix3::zeros(),
        };
        Distance { value, normal, curvature }
    }
}

/// The cell of a position in units of cells, and the position in it; beyond the border the height is constant.
fn cell(position: f64, count: usize) -> (isize, f64) {
    let index = position.floor().clamp(-2.0, count as f64);
    (index as isize, (position - index).clamp(0.0, 1.0))
}

/// Weights of four neighbours by Catmull and Rom, with first and second derivatives.
fn weights(u: f64) -> [[f64; 4]; 3] {
    let (u2, u3) = (u * u, u * u * u);
    [
        [
            0.5 * (-u + 2.0 * u2 - u3),
            0.5 * (2.0 - 5.0 * u2 + 3.0 * u3),
            0.5 * (u + 4.0 * u2 - 3.0 * u3),
            0.5 * (u3 - u2),
        ],
        [
            0.5 * (-1.0 + 4.0 * u - 3.0 * u2),
            0.5 * (-10.0 * u + 9.0 * u2),
            0.5 * (1.0 + 8.0 * u - 9.0 * u2),
            0.5 * (3.0 * u2 - 2.0 * u),
        ],
        [2.0 - 3.0 * u, 9.0 * u - 5.0, 4.0 - 9.0 * u, 3.0 * u - 1.0],
    ]
}

impl Surface for HeightField {
    /// It is solid below.
    fn depth(&self) -> f64 {
        f64::INFINITY
    }

    fn distance(&self, y: &Vector3) -> Distance {
        self.distance_at(&self.foot(y, y.xy()), y)
    }

    fn has_hollows(&self) -> bool {
        true
    }

    /// From those points of the grid on that are nearer than the eight around them.
    fn sides(&self, y: &Vector3, within: f64, visit: &mut dyn FnMut(&Distance)) {
        let index = |place: Vector2<f64>| (place - self.corner).component_div(&self.spacing);
        let reach = Vector2::repeat(within);
        let (low, high) = (index(y.xy() - reach), index(y.xy() + reach));
        let last = [self.columns() - 1, self.heights.len() - 1];
        // One line beyond the ball on both sides, within the grid.
        let [first, end] = [low.map(f64::floor), high.map(f64::ceil)];
        let range = |k: usize| first[k].max(0.0) as usize..=(end[k].max(0.0) as usize).min(last[k]);
        let squared = |i: usize, j: usize| {
            let place = self.corner + self.spacing.component_mul(&Vector2::new(i as f64, j as f64));
            ((y.xy() - place).norm_squared() + (y.z - self.heights[j][i]).powi(2), place)
        };
        for j in range(1) {
            for i in range(0) {
                let (own, place) = squared(i, j);
                let beside = |k: usize, most: usize| k.saturating_sub(1)..=(k + 1).min(most);
                let is_least = beside(j, last[1])
                    .all(|row| beside(i, last[0]).all(|column| own <= squared(column, row).0));
                if is_least {
                    let side = self.distance_at(&self.foot(y, place), y);
                    if side.value > 0.0 && side.value < within {
                        visit(&side);
                    }
                }
            }
        }
    }
}
