//! Joints, drives, springs and loads as they look.

use lissom_motion::Vector3;
use serde::{Deserialize, Serialize};

use super::places::{Anchor, Places, part_of};
use super::symbols::attached;
use crate::document::{Component, Document, LocalLoadEntry, NodeLocation};

/// Instants at which the size of a load is sampled, less one.
const SAMPLES: u32 = 240;
/// Instants at which a force per length is sampled, less one.
const FEW_SAMPLES: u32 = 60;
/// Most positions along a beam at which a force per length is sampled.
const MAX_PLACES: usize = 13;

/// Kind of a load of the local motion on a node.
pub const LOCAL_LOAD: &str = "local_load";
/// Kind of a load of the local motion along a beam.
pub const DISTRIBUTED_LOCAL_LOAD: &str = "distributed_local_load";

/// A joint, or a drive of one.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Joint {
    /// Name.
    pub name: String,
    /// Kind, such as `revolute`.
    pub kind: String,
    /// Names of the parts it connects, base first.
    pub parts: Vec<String>,
    /// Where it is on base and tip; none for a drive.
    pub anchors: Option<[Anchor; 2]>,
    /// Axes of the joint in the frame of the base's node, of length one.
    pub axes: Vec<[f64; 3]>,
    /// The joint that is driven, for a drive.
    pub joint: Option<String>,
}

/// A spring.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Spring {
    /// Name.
    pub name: String,
    /// Kind, such as `point`.
    pub kind: String,
    /// Names of the parts it connects, base first.
    pub parts: Vec<String>,
    /// Ends of the spring; none where it acts on the coordinate of a joint.
    pub anchors: Option<[Anchor; 2]>,
    /// The joint it acts on.
    pub joint: Option<String>,
    /// Free length [m] of a spring that transmits tension alone: it is drawn as a cable.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub cable: Option<f64>,
}

/// A force or moment from outside.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Load {
    /// Name.
    pub name: String,
    /// Kind, such as `force`.
    pub kind: String,
    /// Name of the part it acts on.
    pub part: String,
    /// Where it acts.
    pub anchor: Anchor,
    /// Force [N] or moment [N m] at scale 1: in global axes, those of a follower in the node's.
    pub vector: Option<[f64; 3]>,
    /// Whether it turns with the node.
    pub follower: bool,
    /// Factor of the load at equal distances from the start to the end of the analysis; none where it is not known beforehand.
    pub scale: Vec<f64>,
}

/// A force per length of a beam.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct BeamLoad {
    /// Name of the beam.
    pub beam: String,
    /// Positions along the beam.
    pub anchors: Vec<Anchor>,
    /// Force per length [N/m] at each position, at equal distances from the start to the end of the analysis; one instant
    /// where it does not change. In global axes, those of a follower in the node's.
    pub vectors: Vec<Vec<[f64; 3]>>,
    /// Whether it turns with the nodes.
    pub follower: bool,
}

pub(super) fn joints(document: &Document, places: &Places<'_>) -> Vec<Joint> {
    let drawn = |component: &Component| {
        let (parts, anchors) = attached(component, places)?;
        let mut axes = Vec::new();
        for axis in &component.attachment.axes {
            axes.push(places.direction(places.node(&component.attachment.nodes[0].node.value)?, &axis.value));
        }
        let (name, kind) = (component.name.value.clone(), component.kind.value.clone());
        Some(Joint { name, kind, parts, anchors, axes, joint: joint_of(component) })
    };
    document.joints.iter().filter_map(drawn).collect()
}

pub(super) fn springs(document: &Document, places: &Places<'_>) -> Vec<Spring> {
    let drawn = |component: &Component| {
        let (parts, anchors) = attached(component, places)?;
        let (name, kind) = (component.name.value.clone(), component.kind.value.clone());
        let cable = cable(component, places, anchors);
        Some(Spring { name, kind, parts, anchors, joint: joint_of(component), cable })
    };
    document.springs.iter().filter_map(drawn).collect()
}

/// Free length of a spring that transmits tension alone.
fn cable(component: &Component, places: &Places<'_>, anchors: Option<[Anchor; 2]>) -> Option<f64> {
    let parameters = &component.parameters;
    if component.kind.value != "point" || parameters.word("side").ok() != Some("tension") {
        return None;
    }
    let [a, b] = anchors?.map(|end| places.frame(end.node).transform_point(&Vector3::from(end.position)));
    parameters.number_or("length", (b - a).norm()).ok()
}

pub(super) fn loads(document: &Document, places: &Places<'_>) -> Vec<Load> {
    let (start, end) = (document.analysis.start, document.analysis.end);
    let drawn = |component: &Component| {
        let [NodeLocation { node: on, at: Some(at), .. }] = component.attachment.nodes.as_slice() else {
            return None;
        };
        // How large it is depends on the motion: no arrow rather than a wrong one.
        if component.signal.is_some() {
            return None;
        }
        let anchor = places.anchor(on, at)?;
        let parameters = &component.parameters;
        let follower = parameters.flag("follower").unwrap_or(false);
        let vector = parameters.vector("vector").ok().map(|vector| {
            let frame = places.frame(anchor.node);
            if follower { frame.rotation.apply_inverse(&vector) } else { vector }.into()
        });
        let at = |k: u32| start + (end - start) * f64::from(k) / f64::from(SAMPLES);
        let scale = parameters
            .function("scale")
            .map_or_else(|_| Vec::new(), |function| (0..=SAMPLES).map(|k| function.value(at(k))).collect());
        Some(Load {
            name: component.name.value.clone(),
            kind: component.kind.value.clone(),
            part: part_of(&on.value).to_owned(),
            anchor,
            vector,
            follower,
            scale,
        })
    };
    document.loads.iter().filter_map(drawn).chain(local_loads(document, places)).collect()
}

/// Loads of the local motion at their node, or in the middle of their beam; how large they are depends on the motion.
fn local_loads(document: &Document, places: &Places<'_>) -> Vec<Load> {
    let drawn = |load: &LocalLoadEntry| {
        let anchor = match &load.beam {
            Some(beam) => {
                let line = places.of.names.lines.get(beam)?;
                let middle = line.nodes.len() / 2;
                Anchor { node: line.nodes[middle], position: line.offsets[middle].position.into() }
            }
            None => places.observed(&load.node.value, load.at.as_ref())?,
        };
        let kind = if load.beam.is_some() { DISTRIBUTED_LOCAL_LOAD } else { LOCAL_LOAD };
        Some(Load {
            name: load.name.value.clone(),
            kind: kind.to_owned(),
            part: part_of(&load.node.value).to_owned(),
            anchor,
            vector: None,
            follower: !load.is_global,
            scale: Vec::new(),
        })
    };
    document.local_loads.iter().filter_map(drawn).collect()
}

pub(super) fn beam_loads(document: &Document, places: &Places<'_>) -> Vec<BeamLoad> {
    let (start, end) = (document.analysis.start, document.analysis.end);
    let mut found = Vec::new();
    for beam in &document.beams {
        let Some(line) = places.of.names.lines.get(&beam.name.value) else { continue };
        let step = line.nodes.len().div_ceil(MAX_PLACES).max(1);
        let kept: Vec<usize> = (0..line.nodes.len()).step_by(step).collect();
        let anchor = |&k: &usize| Anchor { node: line.nodes[k], position: line.offsets[k].position.into() };
        for force in &beam.distributed {
            let at = |time: f64, k: usize| {
                let components = force.components.each_ref().map(|formula| {
                    let arguments = vec![line.places[k]; formula.arguments().len()];
                    let function = formula.with_arguments(&arguments);
                    let grows = document.analysis.ramp && !formula.depends_on_time();
                    // In statics constant loads are ramped as well.
                    let share = if grows { (time - start) / (end - start) } else { 1.0 };
                    share * function.value(time)
                });
                let given = Vector3::from(components);
                match &force.axes {
                    Some(axes) => axes.apply(&given).into(),
                    None => line.offsets[k].rotation.apply(&given).into(),
                }
            };
            let changes = document.analysis.ramp
                || force.components.iter().any(crate::expression::Formula::depends_on_time);
            let samples = if changes { FEW_SAMPLES } else { 0 };
            let instant = |sample: u32| start + (end - start) * f64::from(sample) / f64::from(samples.max(1));
            let vectors =
                (0..=samples).map(|sample| kept.iter().map(|&k| at(instant(sample), k)).collect()).collect();
            found.push(BeamLoad {
                beam: beam.name.value.clone(),
                anchors: kept.iter().map(anchor).collect(),
                vectors,
                follower: force.axes.is_none(),
            });
        }
    }
    found
}

/// The joint on whose coordinate a drive, spring or load acts.
fn joint_of(component: &Component) -> Option<String> {
    component.ports.quantity()?;
    component.attachment.coordinates.first().map(|(joint, _)| joint.value.clone())
}
