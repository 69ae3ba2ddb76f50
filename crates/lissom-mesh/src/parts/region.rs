//! Regions of space that select nodes.

use lissom_motion::{Motion, Vector3};

use crate::parts::meshed_part::MeshedPart;

/// A region.
#[derive(Clone, Debug)]
pub enum Region {
    /// The node that is nearest to a place [m].
    Near(Vector3),
    /// Nodes within a radius of a centre [m].
    Ball(Vector3, f64),
    /// Nodes between two corners of a box along the axes of a frame [m].
    Box([Vector3; 2], Motion),
}

/// Tolerance of a box relative to its diagonal.
const SLACK: f64 = 1e-6;

impl MeshedPart {
    /// Nodes in a region, ascending.
    pub fn nodes_in(&self, region: &Region) -> Vec<usize> {
        let all = self.positions.iter().enumerate();
        match region {
            Region::Near(place) => {
                let distance = |position: &Vector3| (position - place).norm();
                let found = all.min_by(|a, b| distance(a.1).total_cmp(&distance(b.1)));
                found.map(|(node, _)| node).into_iter().collect()
            }
            Region::Ball(center, radius) => {
                let is_within = |position: &Vector3| (position - center).norm() <= *radius;
                all.filter(|(_, position)| is_within(position)).map(|(node, _)| node).collect()
            }
            Region::Box(corners, frame) => {
                let [from, to] = corners.map(|corner| frame.inverse_transform_point(&corner));
                let (low, high) = (from.inf(&to), from.sup(&to));
                let slack = SLACK * (high - low).norm();
                let is_within = |position: &Vector3| {
                    let position = frame.inverse_transform_point(position);
                    (0..3).all(|k| position[k] >= low[k] - slack && position[k] <= high[k] + slack)
                };
                all.filter(|(_, position)| is_within(position)).map(|(node, _)| node).collect()
            }
        }
    }
}
