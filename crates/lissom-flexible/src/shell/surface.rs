//! A surface of shell elements: nodes, elements and mass, from a mesh of quadrilaterals.

use std::sync::Arc;

use lissom_mesh::MeshedPart;
use lissom_motion::{Matrix3, Motion, Rotation, Vector3};

use super::condensed::areas;
use super::damping::ShellDamping;
use super::reference::Reference;
use super::section::{DRILLING_SHARE, Ply, ShellLaw};
use super::{Shell, mass};
use lissom_mechanics::elements::contribution::Contribution;
use lissom_mechanics::elements::inertia::Inertia;
use lissom_mechanics::elements::initial_model::InitialModel;
use lissom_mechanics::elements::mass_distribution::MassDistribution;
use lissom_mechanics::kinematics::{Freedoms, NodeId};

/// Law and mass of an element.
#[derive(Clone, Debug)]
pub struct ShellSection {
    /// Elastic law.
    pub law: ShellLaw,
    /// Mass per area [kg/m²].
    pub mass: f64,
    /// Place of the mass along the normal [m].
    pub center: f64,
    /// Moment of inertia per area of a line across the surface about its centre of mass [kg].
    pub inertia: f64,
    /// Tension before any strain, the mean of both directions [N/m].
    pub tension: f64,
}

impl ShellSection {
    /// A laminate of layers from the bottom to the top, with the middle of its thickness at `offset` [m] along the normal; one layer for
    /// a homogeneous shell.
    pub fn laminate(plies: &[Ply], offset: f64) -> Self {
        let whole: f64 = plies.iter().map(|ply| ply.thickness).sum();
        let (mut moments, mut below) = ([0.0; 3], offset - 0.5 * whole);
        for ply in plies {
            let above = below + ply.thickness;
            moments[0] += ply.density * ply.thickness;
            moments[1] += ply.density * (above * above - below * below) / 2.0;
            moments[2] += ply.density * (above.powi(3) - below.powi(3)) / 3.0;
            below = above;
        }
        let [mass, first, second] = moments;
        let center = if mass > 0.0 { first / mass } else { 0.0 };
        Self {
            law: ShellLaw::laminate(plies, offset),
            mass,
            center,
            inertia: second - center * first,
            tension: 0.0,
        }
    }
}

/// Description of a surface of shell elements.
pub struct SurfaceDescription<'a> {
    /// Nodes and quadrilaterals; normals that are not known are means of those of the elements.
    pub mesh: &'a MeshedPart,
    /// Name of each node.
    pub names: &'a dyn Fn(usize) -> String,
    /// Largest angle between normals of elements at a node that count as one smooth surface [rad].
    pub fold_angle: f64,
    /// Direction that is projected on each element to be its first local axis.
    pub direction: Option<Vector3>,
    /// Damping in proportion to the stiffness [s].
    pub damping: f64,
    /// Section of each element.
    pub section: &'a dyn Fn(usize) -> ShellSection,
}

/// A surface of shell elements as built.
#[derive(Clone, Debug)]
pub struct ShellSurface {
    /// Nodes of the surface.
    pub nodes: Vec<NodeId>,
    /// Area that belongs to each node [m²].
    pub areas: Vec<f64>,
    /// Elements of the surface, for outputs.
    pub elements: Vec<Arc<Shell>>,
}

/// A surface of shell elements.
pub fn shell_surface(model: &InitialModel, surface: &SurfaceDescription<'_>) -> (Contribution, ShellSurface) {
    let mut contribution = Contribution::to(model);
    let references: Vec<Reference> = surface
        .mesh
        .quadrilaterals()
        .map(|own| Reference::new(own.map(|node| surface.mesh.positions[node]), surface.direction))
        .collect();
    let directors = directors(surface, &references);
    let frames = frames(surface, &references, &directors);
    let nodes: Vec<NodeId> = frames
        .iter()
        .enumerate()
        .map(|(node, frame)| contribution.add_node(&(surface.names)(node), *frame, Freedoms::Full))
        .collect();
    let mut own_areas = vec![0.0; nodes.len()];
    let mut elements = Vec::with_capacity(references.len());
    for (index, own) in surface.mesh.quadrilaterals().enumerate() {
        let section = (surface.section)(index);
        let element_nodes = own.map(|node| nodes[node]);
        let centers = directors[index].map(|director| section.center * director);
        let shares = areas(&references[index]);
        for (i, (&node, area)) in own.iter().zip(shares.iter()).enumerate() {
            own_areas[node] += area;
            let [center, director] =
                [centers[i], directors[index][i]].map(|own| frames[node].rotation.apply_inverse(&own));
            // Rotation about the normal has a share that makes its vibrations as fast as those of transverse shear.
            let across = Matrix3::identity() - (1.0 - DRILLING_SHARE) * director * director.transpose();
            let inertia = section.inertia * *area * across;
            let mass = Inertia::of_rigid_body(section.mass * area, &center, &inertia);
            contribution.add_inertia(nodes[node], mass);
        }
        let (carriers, carried) = (mass::nodes(), mass::points(&references[index].positions, &centers));
        let points = std::array::from_fn(|k| {
            let node = carriers[k];
            (node, frames[own[node]].rotation.apply_inverse(&carried[k]))
        });
        let mut matrix = mass::area_matrix(
            &references[index],
            mass::share_of_parabolas(&references[index], &section.law, section.tension),
        );
        matrix.as_flattened_mut().iter_mut().for_each(|entry| *entry *= section.mass);
        let lumped = std::array::from_fn(|i| section.mass * shares[i]);
        let gravity = model.gravity.clone();
        contribution =
            contribution.with(MassDistribution::new(element_nodes, points, matrix, &lumped, gravity));
        let shell = Shell::new(
            element_nodes,
            &own.map(|node| frames[node]),
            &directors[index],
            surface.direction,
            section.law,
        );
        let element = Arc::new(shell.clone());
        contribution = contribution.with(shell);
        if surface.damping > 0.0 {
            contribution = contribution.with(ShellDamping::new(Arc::clone(&element), surface.damping));
        }
        elements.push(element);
    }
    (contribution, ShellSurface { nodes, areas: own_areas, elements })
}

/// The normal of each element at each of its nodes: that of the smooth surface around the node to which the element belongs.
fn directors(surface: &SurfaceDescription<'_>, references: &[Reference]) -> Vec<[Vector3; 4]> {
    let own: Vec<[Vector3; 4]> = references.iter().map(Reference::nodal_normals).collect();
    if let Some(normals) = &surface.mesh.normals {
        let of = |(element, own): ([usize; 4], &[Vector3; 4])| {
            std::array::from_fn(|i| {
                let normal = normals[element[i]];
                normal * normal.dot(&own[i]).signum()
            })
        };
        return surface.mesh.quadrilaterals().zip(&own).map(of).collect();
    }
    let mut corners: Vec<Vec<(usize, usize)>> = vec![Vec::new(); surface.mesh.positions.len()];
    for (index, element) in surface.mesh.quadrilaterals().enumerate() {
        element.iter().enumerate().for_each(|(i, &node)| corners[node].push((index, i)));
    }
    let area: Vec<f64> = references.iter().map(|reference| reference.axes(0.0, 0.0).area).collect();
    let least = surface.fold_angle.cos();
    let mut directors = own.clone();
    for corners in &corners {
        let mut waiting = corners.clone();
        while let Some(first) = waiting.pop() {
            let mut smooth = vec![first];
            let mut next = 0;
            while let Some(&(element, i)) = smooth.get(next) {
                let normal = own[element][i];
                let (near, far) = waiting.iter().partition(|&&(other, k)| own[other][k].dot(&normal) > least);
                (waiting, next) = (far, next + 1);
                smooth.extend::<Vec<_>>(near);
            }
            let sum: Vector3 = smooth.iter().map(|&(element, i)| area[element] * own[element][i]).sum();
            for &(element, i) in &smooth {
                directors[element][i] = sum.normalize();
            }
        }
    }
    directors
}

/// Frames of the nodes: third axis along the mean normal, first along the first local axis of an element.
fn frames(
    surface: &SurfaceDescription<'_>,
    references: &[Reference],
    directors: &[[Vector3; 4]],
) -> Vec<Motion> {
    let mut normals = vec![Vector3::zeros(); surface.mesh.positions.len()];
    let mut firsts = vec![Vector3::zeros(); surface.mesh.positions.len()];
    for ((element, reference), directors) in surface.mesh.quadrilaterals().zip(references).zip(directors) {
        for (node, director) in element.into_iter().zip(directors) {
            normals[node] += director;
            if firsts[node] == Vector3::zeros() {
                firsts[node] = reference.first;
            }
        }
    }
    let frame = |((position, normal), first): ((&Vector3, &Vector3), &Vector3)| {
        // Normals of opposite sides cancel out, and a fold may have its normal along the first axis.
        let third = normal.try_normalize(1e-6).unwrap_or_else(Vector3::z);
        let first = first - third * first.dot(&third);
        let first = first.try_normalize(1e-6).unwrap_or_else(|| across(&third));
        let axes = Matrix3::from_columns(&[first, third.cross(&first), third]);
        Motion::new(Rotation::from_matrix(&axes), *position)
    };
    surface.mesh.positions.iter().zip(&normals).zip(&firsts).map(frame).collect()
}

/// A unit vector perpendicular to another.
fn across(vector: &Vector3) -> Vector3 {
    vector.cross(&Vector3::ith(vector.iamin(), 1.0)).normalize()
}
