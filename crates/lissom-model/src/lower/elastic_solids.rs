//! Elastic solids as nodes with mass, elements and pressures.

use std::sync::Arc;

use lissom_flexible::pressure::{FacePressure, face_points};
use lissom_flexible::solid::volume::{SolidVolume, VolumeDescription, solid_volume};
use lissom_mechanics::elements::Contribution;
use lissom_mechanics::kinematics::NodeId;
use lissom_motion::Vector3;
use lissom_system::Builder;

use super::names::Names;
use super::order::by_name;
use super::pressures::pressure;
use super::shells::node_name;
use crate::document::{Document, ElasticSolid};
use crate::outputs::meshes::BuiltSolid;
use crate::reading::mesh_nodes::BuiltNodes;
use crate::text::report::Problem;

/// Adds all solids.
pub(super) fn add(
    document: &Document,
    builder: &mut Builder,
    names: &mut Names,
    problems: &mut Vec<Problem>,
) {
    for solid in by_name(&document.elastic_solids, |solid| &solid.name.value) {
        let name = &solid.name.value;
        let description = VolumeDescription {
            mesh: &solid.mesh,
            names: &|node| node_name(name, &solid.mesh, node),
            material: solid.material,
            free: &|node| solid.free_strains.get(node).copied().unwrap_or(0.0),
        };
        let (contribution, volume) = match solid_volume(builder.model(), &description) {
            Ok(built) => built,
            Err(inverted) => {
                let message = format!("an element of solid `{name}` is inverted: {inverted}");
                problems.push(Problem::error(solid.name.span, message));
                continue;
            }
        };
        builder.add(contribution);
        problems.extend(add_pressures(document, solid, &volume, builder).err());
        let nodes = BuiltNodes { mesh: Arc::clone(&solid.mesh), nodes: volume.nodes };
        names.meshes.solids.insert(name.clone(), BuiltSolid { nodes, elements: volume.elements });
    }
}

fn add_pressures(
    document: &Document,
    solid: &ElasticSolid,
    volume: &SolidVolume,
    builder: &mut Builder,
) -> Result<(), Problem> {
    for load in &solid.pressures {
        let mut contribution = Contribution::to(builder.model());
        let (triangles, quadrilaterals) = (face_points::<6>(), face_points::<8>());
        for face in &load.faces {
            let middle = solid.mesh.positions_of(face).iter().sum::<Vector3>() / face.len() as f64;
            let found = pressure(document, (&load.value, &load.axes), &middle, |_| 0.0);
            let pressure = found.map_err(|time| {
                let name = &solid.name.value;
                let message = format!("a pressure on solid `{name}` is not a finite number at t = {time}");
                Problem::error(load.span, message)
            })?;
            let ids: Vec<NodeId> = face.iter().map(|&node| volume.nodes[node]).collect();
            contribution = match (<[NodeId; 6]>::try_from(&*ids), <[NodeId; 8]>::try_from(&*ids)) {
                (Ok(six), _) => contribution.with(FacePressure::new(six, Arc::clone(&triangles), pressure)),
                (_, Ok(eight)) => {
                    contribution.with(FacePressure::new(eight, Arc::clone(&quadrilaterals), pressure))
                }
                _ => contribution,
            };
        }
        builder.add(contribution);
    }
    Ok(())
}
