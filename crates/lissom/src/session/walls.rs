//! Whether walls of a shell without a contact with itself pass through each other.

use std::collections::BTreeSet;
use std::sync::Arc;

use lissom_core::elements::Element;
use lissom_core::errors::Warning;
use lissom_core::kinematics::{Kinematics, NodeId};
use lissom_core::system::System;
use lissom_model::lower::Names;
use lissom_motion::Vector3;

/// Distance of the ends of an edge from the face that it pierces, over the size of the face: elements along a seam touch each other.
const MIN_DEPTH: f64 = 0.01;

/// Corners of an element.
type Corners = [Vector3; 4];

/// Warnings of a model beside those of its simulation, and what is checked at its end.
#[derive(Clone)]
pub(super) struct ModelWarnings {
    pub(super) all: Vec<Warning>,
    walls: Arc<[Walls]>,
}

impl ModelWarnings {
    /// Warnings of a model, and its walls in the configuration at the start.
    pub(super) fn of(all: Vec<Warning>, names: &Names, (system, start): (&System, &Kinematics)) -> Self {
        Self { all, walls: Walls::of(names, system, start).into() }
    }

    /// Warns of walls that pass through each other at the end.
    pub(super) fn check_end(&mut self, at: &Kinematics) {
        let crossed = self.walls.iter().find_map(|walls| {
            let [x, y, z]: [f64; 3] = walls.crossing(at)?.into();
            let position = format!("{x:.4}, {y:.4}, {z:.4}");
            Some(Warning::ShellCrossesItself { time: at.time, shell: walls.shell.clone(), position })
        });
        self.all.extend(crossed);
    }
}

/// The elements of a shell.
struct Walls {
    shell: String,
    elements: Vec<[NodeId; 4]>,
    /// Corners at the start.
    start: Vec<Corners>,
}

impl Walls {
    /// The shells of a model that have no contact with themselves, in its configuration at the start.
    fn of(names: &Names, system: &System, start: &Kinematics) -> Vec<Self> {
        // A node and the element that it touches.
        let touches_itself = |nodes: &BTreeSet<NodeId>| {
            system.elements_with(|element| element.spring).any(|spring| {
                let touching = spring.unknowns().nodes;
                touching.len() > 4 && touching.iter().all(|node| nodes.contains(node))
            })
        };
        let shells = names.meshes.shells.iter().filter_map(|(name, shell)| {
            let nodes = |element: &dyn Element| std::array::from_fn(|k| element.unknowns().nodes[k]);
            let elements: Vec<[NodeId; 4]> = shell.elements.iter().map(|element| nodes(&**element)).collect();
            if touches_itself(&elements.iter().flatten().copied().collect()) {
                return None;
            }
            Some(Self { shell: name.clone(), start: corners(&elements, start), elements })
        });
        shells.collect()
    }

    /// A position at which elements without common nodes cross that do not cross at the start.
    fn crossing(&self, at: &Kinematics) -> Option<Vector3> {
        let now = corners(&self.elements, at);
        let bounds: Vec<[Vector3; 2]> = now.iter().map(|corners| bounds(corners)).collect();
        let all = bounds.iter().copied().reduce(|a, b| [a[0].inf(&b[0]), a[1].sup(&b[1])])?;
        let axis = (all[1] - all[0]).imax();
        let mut order: Vec<usize> = (0..now.len()).collect();
        order.sort_by(|&a, &b| bounds[a][0][axis].total_cmp(&bounds[b][0][axis]));
        order.iter().enumerate().find_map(|(position, &one)| {
            let candidates = order[position + 1..].iter();
            candidates.take_while(|&&other| bounds[other][0][axis] <= bounds[one][1][axis]).find_map(
                |&other| {
                    let [a, b] = [&bounds[one], &bounds[other]];
                    let is_near = (0..3).all(|k| a[0][k] <= b[1][k] && b[0][k] <= a[1][k]);
                    let shares_node =
                        || self.elements[one].iter().any(|node| self.elements[other].contains(node));
                    if !is_near || shares_node() || crossing(&self.start[one], &self.start[other]).is_some() {
                        return None;
                    }
                    crossing(&now[one], &now[other])
                },
            )
        })
    }
}

fn corners(elements: &[[NodeId; 4]], at: &Kinematics) -> Vec<Corners> {
    elements.iter().map(|nodes| nodes.map(|node| at.nodes[node].frame.position)).collect()
}

/// The smallest and the largest coordinates.
fn bounds(corners: &[Vector3]) -> [Vector3; 2] {
    corners.iter().fold([corners[0]; 2], |[low, high], corner| [low.inf(corner), high.sup(corner)])
}

/// A position at which an edge of one element pierces the other one.
fn crossing(one: &Corners, other: &Corners) -> Option<Vector3> {
    [(one, other), (other, one)].into_iter().find_map(|(edges, face)| {
        (0..4).find_map(|k| {
            let edge = [edges[k], edges[(k + 1) % 4]];
            [[0, 1, 2], [0, 2, 3]].into_iter().find_map(|corners| pierced(edge, corners.map(|k| face[k])))
        })
    })
}

fn pierced([from, to]: [Vector3; 2], triangle: [Vector3; 3]) -> Option<Vector3> {
    let [a, b, c] = triangle;
    let normal = (b - a).cross(&(c - a));
    let least = MIN_DEPTH * normal.norm().powf(1.5);
    let [before, after] = [from, to].map(|end| normal.dot(&(end - a)));
    if before * after >= 0.0 || before.abs().min(after.abs()) < least {
        return None;
    }
    let place = from + (to - from) * (before / (before - after));
    let is_inside = [[a, b], [b, c], [c, a]].iter().all(|[one, other]| {
        normal.dot(&(other - one).cross(&(place - one))) >= -1e-9 * normal.norm_squared()
    });
    is_inside.then_some(place)
}
