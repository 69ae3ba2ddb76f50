//! Contacts of shells with balls where they are nearest.

use std::sync::Arc;

use lissom_contact::forms::Form;
use lissom_contact::geometry::surfaces::Rod;
use lissom_contact::of_shells::{ShellContact, contact_patches};
use lissom_flexible::shell::Shell as ShellElement;
use lissom_mechanics::elements::Contribution;
use lissom_mechanics::kinematics::NodeId;
use lissom_motion::Vector3;
use lissom_system::Builder;

use super::at_nodes::TouchingNodes;
use super::flexible::{OfFlexible, point};
use super::pairs::solids;
use crate::document::Shell;
use crate::outputs::contact_point::ContactPoint;
use crate::outputs::meshes::BuiltShell;
use crate::text::report::Problem;

/// Pairs of balls and elements that may touch.
const MAX_PAIRS: usize = 50_000;

impl OfFlexible<'_> {
    /// Balls, each with all elements.
    pub(super) fn nearest_to_shell(
        &self,
        (shell, built): (&Shell, &BuiltShell),
        base: NodeId,
        builder: &mut Builder,
    ) -> Result<Vec<ContactPoint>, Problem> {
        let thickness = self.even_thickness(shell)?;
        let solids = solids(self.document, &self.entry.between[0].value);
        let pairs = solids.len() * built.elements.len();
        let help = "use fewer elements or balls, or divide the shell";
        self.check_count((pairs, MAX_PAIRS), "balls and elements", help)?;
        let patches = contact_patches(builder.model(), &built.elements);
        let law = (self.law.compliance, self.law.dissipation);
        let mut all = Vec::new();
        for solid in solids {
            let Some(Rod { half_length: 0.0, radius }) = solid.form.rod() else {
                return Err(self.no_ball(&solid.form));
            };
            let ball = ((base, solid.frame.transform_point(&Vector3::zeros())), radius);
            let mut contribution = Contribution::to(builder.model());
            let friction = self.friction(all.len() / patches.len() + 1, &mut contribution);
            builder.add(contribution);
            for (index, patch) in patches.iter().enumerate() {
                let friction = friction.as_ref().map(|law| (law, index == 0));
                let contact = ShellContact::new(ball, (patch.clone(), thickness), law, friction);
                builder.add(Contribution::of(builder.model(), contact.clone()));
                all.push(point(contact));
            }
        }
        Ok(all)
    }

    /// Nodes of another part or of the same one, each with all elements that are not next to it.
    pub(super) fn nodes_on_shell(
        &self,
        own: &TouchingNodes,
        (shell, built): (&Shell, &BuiltShell),
        builder: &mut Builder,
    ) -> Result<Vec<ContactPoint>, Problem> {
        let thickness = self.even_thickness(shell)?;
        let elements = &built.elements;
        let help = "use fewer elements, or divide the shells";
        self.check_count((own.nodes.len() * elements.len(), MAX_PAIRS), "nodes and elements", help)?;
        let patches = contact_patches(builder.model(), &built.elements);
        let mut all = Vec::new();
        for (number, &(node, area, radius)) in own.nodes.iter().enumerate() {
            // Elements around the node, and those around these.
            let around = elements.iter().filter(|element| element.nodes().contains(&node));
            let near: Vec<NodeId> = around.flat_map(|element| *element.nodes()).collect();
            let is_apart =
                |element: &Arc<ShellElement>| !element.nodes().iter().any(|own| near.contains(own));
            let apart: Vec<_> =
                elements.iter().zip(&patches).filter(|(element, _)| is_apart(element)).collect();
            if apart.is_empty() {
                continue;
            }
            let mut contribution = Contribution::to(builder.model());
            let friction = self.friction(number + 1, &mut contribution);
            builder.add(contribution);
            let ball = ((node, own.middle.position), radius);
            let law = (self.compliance(area), self.law.dissipation);
            for (index, (_, patch)) in apart.into_iter().enumerate() {
                let friction = friction.as_ref().map(|law| (law, index == 0));
                let contact = ShellContact::new(ball, (patch.clone(), thickness), law, friction);
                builder.add(Contribution::of(builder.model(), contact.clone()));
                // The ball is of the tip.
                all.push(ContactPoint { sign: -1.0, ..point(contact) });
            }
        }
        Ok(all)
    }

    /// The thickness of a shell without offset that has one [m].
    fn even_thickness(&self, shell: &Shell) -> Result<f64, Problem> {
        if shell.offset != 0.0 {
            let message = format!("shell `{}` has an `offset`", shell.name.value);
            return Err(self.fault(
                &message,
                "give `stiffness_per_area` instead of `stiffness`, or describe the middle of the thickness without `offset`",
            ));
        }
        let thickness: Vec<f64> =
            (0..shell.mesh.elements.len()).map(|element| shell.thickness(element)).collect();
        if thickness.iter().any(|own| (own - thickness[0]).abs() > 1e-9 * thickness[0]) {
            let message = format!("the thickness of shell `{}` is not the same everywhere", shell.name.value);
            return Err(
                self.fault(&message, "give `stiffness_per_area` instead of `stiffness`, or one thickness")
            );
        }
        Ok(thickness[0])
    }

    fn no_ball(&self, form: &Form) -> Problem {
        let message = format!("`stiffness` of a shell on {} is not available", form.kind().words());
        self.fault(&message, "give `stiffness_per_area` instead; `stiffness` is for spheres")
    }
}
