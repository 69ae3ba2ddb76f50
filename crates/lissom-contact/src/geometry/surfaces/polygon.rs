//! A prism with an outline of straight lines, without ends.
//!
//! ```text
//! nearest on a line:     n its normal outwards, H = 0
//! nearest at a corner:   n = ±(y - p)/|y - p|,   H = (I - n nᵀ - e₃ e₃ᵀ)/φ
//! ```

use lissom_motion::{Matrix3, Vector3};
use nalgebra::Vector2;

use super::{Distance, Surface};
use crate::geometry::curves::area;

/// A prism along the third axis.
#[derive(Clone, Debug, PartialEq)]
pub struct Polygon {
    corners: Vec<Vector2<f64>>,
    depth: f64,
}

impl Polygon {
    /// With at least three corners, each apart from the next [m]; none otherwise.
    pub fn new(corners: &[[f64; 2]]) -> Option<Self> {
        let mut corners: Vec<Vector2<f64>> = corners.iter().copied().map(Vector2::from).collect();
        if area(&corners) < 0.0 {
            corners.reverse();
        }
        let next = corners.iter().cycle().skip(1);
        let is_valid = corners.iter().zip(next).all(|(p, q)| (q - p).norm().is_normal());
        if corners.len() < 3 || !is_valid || area(&corners) <= 0.0 {
            return None;
        }
        let depth = inner_radius(&corners);
        Some(Self { corners, depth })
    }

    /// Corners of the polygon, counterclockwise.
    pub fn corners(&self) -> &[Vector2<f64>] {
        &self.corners
    }

    /// Middles of circles about the corners that protrude, those with which it touches others, and their radii: circles of `radius` [m]
    /// touch both sides from inside, smaller ones in acute corners.
    pub fn round_corners(&self, radius: f64) -> impl Iterator<Item = (Vector2<f64>, f64)> {
        let count = self.corners.len();
        (0..count).filter_map(move |k| {
            let [before, own, after] = [k + count - 1, k, k + 1].map(|index| self.corners[index % count]);
            let inwards = [own - before, after - own].map(|side| Vector2::new(-side.y, side.x).normalize());
            let [one, other] = inwards;
            let width = 1.0 + one.dot(&other);
            let share = radius * (1.0 / width).min(1.0);
            (one.perp(&other) > 0.0).then(|| (own + share * (one + other), share * width))
        })
    }

    /// Length of its shortest side [m].
    pub fn shortest_side(&self) -> f64 {
        let next = self.corners.iter().cycle().skip(1);
        self.corners.iter().zip(next).map(|(p, q)| (q - p).norm()).fold(f64::INFINITY, f64::min)
    }
}

/// The smallest distance of the middle of a line from the rest of the outline, inwards: half of it is the radius of a circle within.
fn inner_radius(corners: &[Vector2<f64>]) -> f64 {
    let count = corners.len();
    let mut least = f64::INFINITY;
    for k in 0..count {
        let (start, end) = (corners[k], corners[(k + 1) % count]);
        let along = end - start;
        let inwards = Vector2::new(-along.y, along.x).normalize();
        let middle = 0.5 * (start + end);
        for j in 0..count {
            let (from, side) = (corners[j] - middle, corners[(j + 1) % count] - corners[j]);
            let across = inwards.perp(&side);
            if j == k || across == 0.0 {
                continue;
            }
            let (height, share) = (from.perp(&side) / across, from.perp(&inwards) / across);
            if height > 0.0 && (0.0..=1.0).contains(&share) {
                least = least.min(0.5 * height);
            }
        }
    }
    least
}

fn flat(normal: Vector2<f64>, value: f64) -> Distance {
    Distance { value, normal: Vector3::new(normal.x, normal.y, 0.0), curvature: Matrix3::zeros() }
}

/// The normal of a line to its right.
fn outwards(along: Vector2<f64>) -> Vector2<f64> {
    Vector2::new(along.y, -along.x).normalize()
}

impl Surface for Polygon {
    fn depth(&self) -> f64 {
        self.depth
    }

    fn distance(&self, y: &Vector3) -> Distance {
        let own = y.xy();
        let count = self.corners.len();
        let (mut nearest, mut found) = (f64::INFINITY, (0, 0.0));
        for k in 0..count {
            let (start, along) = (self.corners[k], self.corners[(k + 1) % count] - self.corners[k]);
            let share = ((own - start).dot(&along) / along.norm_squared()).clamp(0.0, 1.0);
            let distance = (own - start - share * along).norm();
            if distance < nearest {
                (nearest, found) = (distance, (k, share));
            }
        }
        let (k, share) = found;
        let line = |k: usize| self.corners[(k + 1) % count] - self.corners[k % count];
        let (start, along) = (self.corners[k], line(k));
        let is_corner = share == 0.0 || share == 1.0;
        if !is_corner || nearest == 0.0 {
            let normal = outwards(along);
            return flat(normal, normal.dot(&(own - start)));
        }
        // Outside of a corner that protrudes, or inside one that recedes.
        let corner = if share == 0.0 { k } else { (k + 1) % count };
        let [before, after] = [line(corner + count - 1), line(corner)];
        let sign = if before.perp(&after) > 0.0 { 1.0 } else { -1.0 };
        let value = sign * nearest;
        let normal = (own - self.corners[corner]) / value;
        let tangent = Vector3::new(-normal.y, normal.x, 0.0);
        Distance { curvature: tangent * tangent.transpose() / value, ..flat(normal, value) }
    }

    fn has_hollows(&self) -> bool {
        self.round_corners(0.0).count() < self.corners.len()
    }

    fn sides(&self, y: &Vector3, within: f64, visit: &mut dyn FnMut(&Distance)) {
        let own = y.xy();
        let count = self.corners.len();
        for k in 0..count {
            let [before, start, end] = [k + count - 1, k, k + 1].map(|index| self.corners[index % count]);
            let (along, from) = (end - start, own - start);
            let share = from.dot(&along) / along.norm_squared();
            let (value, normal) = if share > 0.0 && share < 1.0 {
                let normal = outwards(along);
                (normal.dot(&from), normal)
            } else if share <= 0.0 && from.dot(&(start - before)) >= 0.0 {
                let value = from.norm();
                (value, from / value)
            } else {
                continue;
            };
            if value > 0.0 && value < within {
                visit(&flat(normal, value));
            }
        }
    }
}
