//! Contacts at the nodes of shells and solids: each is a ball with its share of the area.

use std::sync::Arc;

use lissom_contact::elastic::{Contact, Dissipation};
use lissom_contact::geometry::pairs::PointOnSurface;
use lissom_mechanics::elements::Contribution;
use lissom_mechanics::kinematics::{CarriedFrame, NodeId};
use lissom_mesh::kinds::face::area_shares;
use lissom_motion::{Motion, Vector3};
use lissom_system::Builder;

use super::flexible::{OfFlexible, point};
use super::pairs::solids;
use crate::document::Shell;
use crate::outputs::contact_point::ContactPoint;
use crate::outputs::meshes::BuiltShell;
use crate::reading::mesh_nodes::BuiltNodes;
use crate::text::report::Problem;

/// Largest number of nodes and forms.
const MAX_POINTS: usize = 50_000;

/// The nodes of a part that touch.
pub(super) struct TouchingNodes {
    /// Node, share of the area [m²] and radius [m] of each.
    pub(super) nodes: Vec<(NodeId, f64, f64)>,
    /// Where they touch in the axes of their nodes.
    pub(super) middle: Motion,
    /// Largest distance between neighbours [m].
    pub(super) apart: f64,
}

impl TouchingNodes {
    /// All nodes of a shell, with half of its thickness.
    pub(super) fn of_shell(shell: &Shell, built: &BuiltShell) -> Self {
        let thickness = thickness_at_nodes(shell);
        let each = built.nodes.nodes.iter().zip(&built.areas).zip(&thickness);
        Self {
            nodes: each.map(|((node, area), thickness)| (*node, *area, 0.5 * thickness)).collect(),
            // In the middle of the thickness; the third axis of a node is the normal.
            middle: Motion::translation(shell.offset * Vector3::z()),
            apart: shell.mesh.longest_side(shell.mesh.elements.iter().map(|own| own.nodes.as_slice())),
        }
    }

    /// The nodes of outer faces of a solid. Those of triangles have the integrals of their functions, and corners nothing. Such integrals
    /// are negative at corners of quadrilaterals: there faces are divided at the middles of their sides instead.
    pub(super) fn of_solid(built: &BuiltNodes, faces: &[Vec<usize>]) -> Self {
        let mesh = &built.mesh;
        let mut areas = vec![0.0; mesh.positions.len()];
        for face in faces {
            let mut shares = area_shares(&mesh.positions_of(face));
            if face.len() == 8 {
                let area: f64 = shares.iter().sum();
                // Four triangles at the corners, and a square between the middles.
                shares.fill(area / 4.8);
                shares[..4].fill(area / 24.0);
            }
            face.iter().zip(shares).for_each(|(node, share)| areas[*node] += share);
        }
        let each = built.nodes.iter().zip(&areas).filter(|(_, area)| **area > 0.0);
        Self {
            nodes: each.map(|(node, area)| (*node, *area, 0.0)).collect(),
            middle: Motion::IDENTITY,
            apart: mesh.longest_side(faces.iter().map(|face| &face[..face.len() / 2])),
        }
    }
}

impl OfFlexible<'_> {
    /// Nodes on the forms of a part.
    pub(super) fn add_nodes(
        &self,
        own: &TouchingNodes,
        base: NodeId,
        builder: &mut Builder,
    ) -> Result<Vec<ContactPoint>, Problem> {
        if own.nodes.is_empty() {
            let help = "name a set of a whole face";
            return Err(self.fault("no outer face has all its nodes in the set `faces`", help));
        }
        let solids = solids(self.document, &self.entry.between[0].value);
        let help = "use fewer elements";
        self.check_count((own.nodes.len() * solids.len(), MAX_POINTS), "nodes and shapes", help)?;
        let smallest = own.nodes.iter().map(|(.., radius)| *radius).fold(f64::INFINITY, f64::min);
        let mut all = Vec::new();
        for solid in solids {
            let found = (solid.form.spacing(smallest), solid.form.surface(0.0));
            let (Some(most), Ok(Some(surface))) = found else { return Err(self.no_pair(&solid.form)) };
            let help = "use smaller elements; for a ball where a shell is nearest give `stiffness`";
            self.check_spacing((own.apart, most), solid.form.kind().words(), help)?;
            for &(node, area, rounding) in &own.nodes {
                let mut contribution = Contribution::to(builder.model());
                let friction = self.friction(all.len() + 1, &mut contribution);
                let pair = Arc::new(PointOnSurface { rounding, surface: surface.clone() });
                let frames = [(base, solid.frame), (node, own.middle)]
                    .map(|(node, offset)| CarriedFrame { node, offset });
                let law = (self.compliance(area), Dissipation::Factor(self.law.dissipation));
                let contact = Contact::new(frames, pair, law, friction).with_name(&self.entry.name.value);
                builder.add(contribution.with(contact.clone()));
                all.push(point(contact));
            }
        }
        Ok(all)
    }
}

/// Mean thickness of the elements at each node [m].
fn thickness_at_nodes(shell: &Shell) -> Vec<f64> {
    let mesh = &shell.mesh;
    let mut sums = vec![[0.0; 2]; mesh.positions.len()];
    for (index, element) in mesh.elements.iter().enumerate() {
        let thickness = shell.thickness(index);
        for &node in &element.nodes {
            sums[node][0] += thickness;
            sums[node][1] += 1.0;
        }
    }
    sums.iter().map(|[sum, count]| sum / count.max(1.0)).collect()
}
