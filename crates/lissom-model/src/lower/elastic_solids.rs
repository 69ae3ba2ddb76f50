//! Elastic solids as nodes with mass, elements and pressures.

use std::sync::Arc;

use lissom_flexible::solid::pressure::FacePressure;
use lissom_flexible::solid::volume::{SolidVolume, VolumeDescription, solid_volume};
use lissom_mechanics::elements::Contribution;
use lissom_system::Builder;

use super::names::Names;
use super::order::by_name;
use super::shells::of_load;
use crate::document::{Document, ElasticSolid};
use crate::outputs::solid_nodes::BuiltSolid;
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
        let name_of = |node: usize| match &solid.mesh.places {
            Some(places) => {
                let [u, v, w] = places[node];
                format!("{name}@{u:.4},{v:.4},{w:.4}")
            }
            None => format!("{name}.{}", node + 1),
        };
        let description = VolumeDescription {
            positions: &solid.mesh.positions,
            names: &name_of,
            tetrahedra: &solid.mesh.tetrahedra,
            hexahedra: &solid.mesh.hexahedra,
            law: solid.law,
            density: solid.density,
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
        names.meshes.solids.insert(name.clone(), BuiltSolid { mesh: Arc::clone(&solid.mesh), volume });
    }
}

fn add_pressures(
    document: &Document,
    solid: &ElasticSolid,
    volume: &SolidVolume,
    builder: &mut Builder,
) -> Result<(), Problem> {
    for load in &solid.pressures {
        let function = of_load(document, load.value.with_arguments(&[])).map_err(|time| {
            let message =
                format!("a pressure on solid `{}` is not a finite number at t = {time}", solid.name.value);
            Problem::error(load.span, message)
        })?;
        let mut contribution = Contribution::to(builder.model());
        for face in &load.triangles {
            let nodes = face.map(|node| volume.nodes[node]);
            contribution = contribution.with(FacePressure::on_triangle(nodes, Arc::clone(&function)));
        }
        for face in &load.quadrilaterals {
            let nodes = face.map(|node| volume.nodes[node]);
            contribution = contribution.with(FacePressure::on_quadrilateral(nodes, Arc::clone(&function)));
        }
        builder.add(contribution);
    }
    Ok(())
}
