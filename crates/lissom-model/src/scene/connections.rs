//! Joints, drives, springs and loads as they look.

use serde::Serialize;

use super::{Anchor, Places, part_of};
use crate::document::{Attachment, Component, Document};

/// Instants at which the size of a load is told, less one.
const SAMPLES: u32 = 240;

/// A joint, or a drive of one.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Joint {
    /// Name.
    pub name: String,
    /// Kind, as `revolute`.
    pub kind: String,
    /// Names of the parts it connects, base first.
    pub parts: Vec<String>,
    /// Where it is on base and tip; none for a drive.
    pub anchors: Option<[Anchor; 2]>,
    /// Its axes in the frame of the base's node, of length one.
    pub axes: Vec<[f64; 3]>,
    /// The joint that is driven, for a drive.
    pub joint: Option<String>,
}

/// A spring.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Spring {
    /// Name.
    pub name: String,
    /// Kind, as `point`.
    pub kind: String,
    /// Names of the parts it connects, base first.
    pub parts: Vec<String>,
    /// Its ends; none where it acts on the coordinate of a joint.
    pub anchors: Option<[Anchor; 2]>,
    /// The joint it acts on.
    pub joint: Option<String>,
}

/// A force or moment from outside.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Load {
    /// Name.
    pub name: String,
    /// Kind, as `force`.
    pub kind: String,
    /// Name of the part it acts on.
    pub part: String,
    /// Where it acts.
    pub anchor: Anchor,
    /// Force [N] or moment [N m] at scale 1: in global axes, those of a follower in the node's.
    pub vector: Option<[f64; 3]>,
    /// Whether it turns with the node.
    pub follower: bool,
    /// Its factor at equal distances from the start to the end of the analysis; none where it is not known beforehand.
    pub scale: Vec<f64>,
}

pub(super) fn joints(document: &Document, places: &Places<'_>) -> Vec<Joint> {
    let drawn = |component: &Component| {
        let (parts, anchors) = ends(component, places)?;
        let axes = match &component.attachment {
            Attachment::TwoNodes { base, axis, second_axis, .. } => {
                let node = places.node(&base.value)?;
                let given = [axis, second_axis];
                given.into_iter().flatten().map(|axis| places.direction(node, &axis.value)).collect()
            }
            _ => Vec::new(),
        };
        let (name, kind) = (component.name.value.clone(), component.kind.value.clone());
        Some(Joint { name, kind, parts, anchors, axes, joint: joint_of(component) })
    };
    document.joints.iter().filter_map(drawn).collect()
}

pub(super) fn springs(document: &Document, places: &Places<'_>) -> Vec<Spring> {
    let drawn = |component: &Component| {
        let (parts, anchors) = ends(component, places)?;
        let (name, kind) = (component.name.value.clone(), component.kind.value.clone());
        Some(Spring { name, kind, parts, anchors, joint: joint_of(component) })
    };
    document.springs.iter().filter_map(drawn).collect()
}

pub(super) fn loads(document: &Document, places: &Places<'_>) -> Vec<Load> {
    let (start, end) = (document.analysis.start, document.analysis.end);
    let drawn = |component: &Component| {
        let Attachment::OneNode { on, at } = &component.attachment else { return None };
        // How large it is depends on the motion: no arrow rather than a wrong one.
        if component.signal.is_some() {
            return None;
        }
        let anchor = places.anchor(on, at)?;
        let parameters = &component.parameters;
        let follower = parameters.flag_or("follower", false).unwrap_or(false);
        let vector = parameters.vector("vector").ok().map(|vector| {
            let frame = places.frame(anchor.node);
            if follower { frame.rotation.apply_inverse(&vector) } else { vector }.into()
        });
        let at = |k: u32| start + (end - start) * f64::from(k) / f64::from(SAMPLES);
        let scale = parameters
            .function_or("scale", 1.0)
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
    document.loads.iter().filter_map(drawn).collect()
}

fn joint_of(component: &Component) -> Option<String> {
    match &component.attachment {
        Attachment::JointCoordinate { joint } => Some(joint.value.clone()),
        _ => None,
    }
}

/// Names of the parts at both ends, and where on them; nothing where a node is missing.
fn ends(component: &Component, places: &Places<'_>) -> Option<(Vec<String>, Option<[Anchor; 2]>)> {
    let (base, tip, at_base, at_tip) = match &component.attachment {
        Attachment::TwoNodes { base, tip, at, .. } if component.kind.value == "swing_arm" => {
            // The arm leads from the hinge to the tip's own place.
            (base, tip, *at, places.frame(places.node(&tip.value)?).position)
        }
        Attachment::TwoNodes { base, tip, at, .. } => (base, tip, *at, *at),
        Attachment::TwoPlaces { base, tip, at_base, at_tip } => (base, tip, *at_base, *at_tip),
        _ => return Some((Vec::new(), None)),
    };
    let names = [base, tip].map(|end| part_of(&end.value).to_owned());
    Some((names.into(), Some([places.anchor(base, &at_base)?, places.anchor(tip, &at_tip)?])))
}
