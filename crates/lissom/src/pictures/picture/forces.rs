//! Recorded forces as arrows: reactions of joints and forces of contacts on the tip, and forces of springs. As on the page.

use lissom_core::kinematics::NodeId;
use lissom_model::output::Record;
use lissom_model::scene::{Anchor, DISTRIBUTED_LOCAL_LOAD, LOCAL_LOAD, Output, Scene};
use lissom_motion::{Motion as Pose, Vector3};

/// Forces along the surface of contact, relative to their size: the line of action does not meet it.
const ALONG: f64 = 1e-3;

/// Forces that a run has recorded, over its rows.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct RecordedForces {
    times: Vec<f64>,
    forces: Vec<Force>,
    /// The largest force of the run [N].
    most: f64,
}

#[derive(Clone, Debug, PartialEq)]
struct Force {
    effect: Effect,
    /// Columns of the table: components, or the tension of a spring.
    columns: Vec<Vec<f64>>,
}

/// Where and in which direction a force acts.
#[derive(Clone, Debug, PartialEq)]
enum Effect {
    /// At a position, with components in global axes.
    At(Anchor),
    /// At a recorded position in global axes, which follows the components.
    Placed,
    /// Where the line of action meets a plane through a position with this normal; moments follow the components. They are about
    /// the origin of the node.
    Contact { node: NodeId, base: Anchor, normal: Vector3 },
    /// At that of these positions which is nearest to the line of action; moments about the origin follow the components.
    Nearest(Vec<Anchor>),
    /// From the tip to the base.
    Between([Anchor; 2]),
    /// At the tip, against an axis of the base.
    Axis([Anchor; 2], Vector3),
}

impl RecordedForces {
    /// The forces in a table of results.
    pub fn of(scene: &Scene, record: &Record) -> Self {
        let column = |output: &Output, component: &str| {
            let index = record
                .columns
                .iter()
                .position(|column| column.name() == format!("{}.{component}", output.name));
            index.map(|index| record.values[index].clone())
        };
        let columns = |output: &Output, components: &[&str]| {
            components.iter().map(|component| column(output, component)).collect::<Option<Vec<_>>>()
        };
        let reaction = |output: &Output| {
            let joint = scene.joints.iter().find(|joint| Some(&joint.name) == output.of.as_ref())?;
            let [base, tip] = joint.anchors?;
            let normal = match joint.kind.as_str() {
                "rolling" => joint.axes.first(),
                "wheel_on_rail" => joint.axes.get(1),
                _ => None,
            };
            let components = ["f1", "f2", "f3", "m1", "m2", "m3"];
            Some(match normal {
                Some(normal) => Force {
                    effect: Effect::Contact { node: tip.node, base, normal: Vector3::from(*normal) },
                    columns: columns(output, &components)?,
                },
                None => Force { effect: Effect::At(tip), columns: columns(output, &components[..3])? },
            })
        };
        let spring = |output: &Output| {
            let spring = scene.springs.iter().find(|spring| Some(&spring.name) == output.of.as_ref())?;
            let effect = match spring.anchors {
                Some(anchors) if spring.kind == "point" => Effect::Between(anchors),
                _ => {
                    let joint =
                        scene.joints.iter().find(|joint| Some(&joint.name) == spring.joint.as_ref())?;
                    let joint = Some(joint).filter(|joint| joint.kind == "prismatic")?;
                    Effect::Axis(joint.anchors?, Vector3::from(*joint.axes.first()?))
                }
            };
            Some(Force { effect, columns: columns(output, &["force"])? })
        };
        let local_load = |output: &Output| {
            let load = scene
                .loads
                .iter()
                .find(|load| Some(&load.name) == output.of.as_ref() && load.kind.ends_with(LOCAL_LOAD))?;
            let beam = scene.beams.iter().find(|beam| beam.name == load.part);
            let anchors = match beam.filter(|_| load.kind == DISTRIBUTED_LOCAL_LOAD) {
                Some(beam) => beam.nodes.iter().map(|&node| Anchor { node, position: [0.0; 3] }).collect(),
                None => vec![load.anchor],
            };
            let columns = columns(output, &["f1", "f2", "f3", "m1", "m2", "m3"])?;
            Some(Force { effect: Effect::Nearest(anchors), columns })
        };
        let force = |output: &Output| match output.kind.as_str() {
            "reaction" if output.is_global => reaction(output),
            "spring" => spring(output),
            "local_load" => local_load(output),
            "contact_force" => {
                let components = ["f1", "f2", "f3", "x1", "x2", "x3"];
                Some(Force { effect: Effect::Placed, columns: columns(output, &components)? })
            }
            _ => None,
        };
        let forces: Vec<Force> = scene.outputs.iter().filter_map(force).collect();
        let rows = 0..record.times.len();
        let largest = |force: &Force| rows.clone().map(|row| force.size(row)).fold(0.0, f64::max);
        let most = forces.iter().map(largest).fold(0.0, f64::max);
        Self { times: record.times.clone(), forces, most }
    }

    /// The largest force of the run [N]; zero if none is recorded.
    pub fn most(&self) -> f64 {
        self.most
    }

    /// Positions [m] and forces [N] at poses of the nodes, of the row nearest to a time [s].
    pub fn at(&self, poses: &[Pose], time: f64) -> Vec<(Vector3, Vector3)> {
        let Some(last) = self.times.len().checked_sub(1) else { return Vec::new() };
        let after = self.times.partition_point(|row| *row <= time).min(last);
        let before = after.saturating_sub(1);
        let row = if time - self.times[before] < self.times[after] - time { before } else { after };
        self.forces.iter().filter_map(|force| force.at(poses, row)).collect()
    }
}

impl Force {
    fn vector(&self, first: usize, row: usize) -> Vector3 {
        Vector3::from_fn(|k, _| self.columns[first + k][row])
    }

    fn size(&self, row: usize) -> f64 {
        if self.columns.len() == 1 { self.columns[0][row].abs() } else { self.vector(0, row).norm() }
    }

    /// None for a force of zero.
    fn at(&self, poses: &[Pose], row: usize) -> Option<(Vector3, Vector3)> {
        let place = |anchor: &Anchor| poses[anchor.node].transform_point(&Vector3::from(anchor.position));
        if self.size(row) == 0.0 {
            return None;
        }
        Some(match &self.effect {
            Effect::At(tip) => (place(tip), self.vector(0, row)),
            Effect::Placed => (self.vector(3, row), self.vector(0, row)),
            Effect::Contact { node, base, normal } => {
                let (force, moment) = (self.vector(0, row), self.vector(3, row));
                let centre = poses[*node].position;
                let normal = poses[base.node].rotation.apply(normal);
                let slope = force.dot(&normal);
                if slope.abs() < ALONG * force.norm() {
                    return Some((centre, force));
                }
                let on_line = centre + force.cross(&moment) / force.norm_squared();
                (on_line + force * ((place(base) - on_line).dot(&normal) / slope), force)
            }
            Effect::Nearest(anchors) => {
                let (force, moment) = (self.vector(0, row), self.vector(3, row));
                // The part of the moment along the force is the same about all positions.
                let apart = |at: &Vector3| (moment - at.cross(&force)).norm();
                let nearest = anchors.iter().map(place).min_by(|a, b| apart(a).total_cmp(&apart(b)));
                (nearest?, force)
            }
            Effect::Between([base, tip]) => {
                let (base, tip) = (place(base), place(tip));
                (tip, (base - tip).try_normalize(0.0)? * self.columns[0][row])
            }
            Effect::Axis([base, tip], axis) => {
                (place(tip), poses[base.node].rotation.apply(axis) * -self.columns[0][row])
            }
        })
    }
}
