//! Contacts of shells: at their nodes, or with balls where they are nearest.

use std::sync::Arc;

use lissom_contact::elastic::{Contact, Dissipation};
use lissom_contact::forms::Form;
use lissom_contact::geometry::pairs::PointOnSurface;
use lissom_contact::geometry::surfaces::Rod;
use lissom_contact::of_shells::{ShellContact, contact_patches};
use lissom_mechanics::elements::Contribution;
use lissom_mechanics::kinematics::{CarriedFrame, NodeId};
use lissom_motion::{Motion, Vector3};
use lissom_system::Builder;

use super::flexible::{OfFlexible, point};
use super::pairs::solids;
use crate::document::{Shell, Way};
use crate::outputs::contact_point::ContactPoint;
use crate::outputs::shell_nodes::BuiltShell;
use crate::text::report::Problem;

/// Pairs of balls and elements that may touch.
const MAX_PAIRS: usize = 50_000;

impl OfFlexible<'_> {
    /// Adds a shell.
    pub(super) fn add_shell(
        &self,
        (shell, built): (&Shell, &BuiltShell),
        base: NodeId,
        builder: &mut Builder,
    ) -> Result<Vec<ContactPoint>, Problem> {
        match self.law.way {
            Way::Nodes => self.at_nodes((shell, built), base, builder),
            _ => self.nearest_to_shell((shell, built), base, builder),
        }
    }

    /// Each node with its share of the area, on both faces.
    fn at_nodes(
        &self,
        (shell, built): (&Shell, &BuiltShell),
        base: NodeId,
        builder: &mut Builder,
    ) -> Result<Vec<ContactPoint>, Problem> {
        let thickness = thickness_at_nodes(shell);
        let thinnest = thickness.iter().copied().fold(f64::INFINITY, f64::min);
        let mesh = &shell.mesh;
        let apart = mesh.elements.iter().flat_map(|own| {
            (0..4).map(|i| (mesh.positions[own[i]] - mesh.positions[own[(i + 1) % 4]]).norm())
        });
        let apart = apart.fold(0.0, f64::max);
        let mut all = Vec::new();
        for solid in solids(self.document, &self.entry.between[0].value) {
            let found = (solid.form.spacing(0.5 * thinnest), solid.form.surface(0.0));
            let (Some(most), Ok(Some(surface))) = found else { return Err(self.no_pair(&solid.form)) };
            let help = "use smaller elements; for a ball where it is nearest give `stiffness`";
            self.check_spacing((apart, most), solid.form.kind().words(), help)?;
            for (index, &node) in built.surface.nodes.iter().enumerate() {
                let compliance = self.compliance(built.surface.areas[index]);
                let mut contribution = Contribution::to(builder.model());
                let friction = self.friction(all.len() + 1, &mut contribution);
                let pair =
                    Arc::new(PointOnSurface { rounding: 0.5 * thickness[index], surface: surface.clone() });
                // In the middle of the thickness; the third axis of a node is the normal.
                let middle = Motion::translation(shell.offset * Vector3::z());
                let frames =
                    [(base, solid.frame), (node, middle)].map(|(node, offset)| CarriedFrame { node, offset });
                let law = (compliance, Dissipation::Factor(self.law.dissipation));
                let contact = Contact::new(frames, pair, law, friction).with_name(&self.entry.name.value);
                builder.add(contribution.with(contact.clone()));
                all.push(point(contact));
            }
        }
        Ok(all)
    }

    /// Balls, each with all elements.
    fn nearest_to_shell(
        &self,
        (shell, built): (&Shell, &BuiltShell),
        base: NodeId,
        builder: &mut Builder,
    ) -> Result<Vec<ContactPoint>, Problem> {
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
        let solids = solids(self.document, &self.entry.between[0].value);
        let pairs = solids.len() * thickness.len();
        let help = "use fewer elements or balls, or divide the shell";
        self.check_count((pairs, MAX_PAIRS), "balls and elements", help)?;
        let patches = contact_patches(builder.model(), &built.surface);
        let law = (self.law.compliance, self.law.dissipation);
        let mut all = Vec::new();
        for solid in solids {
            let Some(Rod { half_length: 0.0, radius }) = solid.form.rod() else {
                return Err(self.no_ball(&solid.form));
            };
            let ball = ((base, solid.frame.transform_point(&Vector3::zeros())), radius);
            let mut contribution = Contribution::to(builder.model());
            let friction = self.friction(all.len() / thickness.len() + 1, &mut contribution);
            builder.add(contribution);
            for (index, (patch, thickness)) in patches.iter().zip(&thickness).enumerate() {
                let friction = friction.as_ref().map(|law| (law, index == 0));
                let contact = ShellContact::new(ball, (patch.clone(), *thickness), law, friction);
                builder.add(Contribution::of(builder.model(), contact.clone()));
                all.push(point(contact));
            }
        }
        Ok(all)
    }

    fn no_ball(&self, form: &Form) -> Problem {
        let message = format!("`stiffness` of a shell on {} is not available", form.kind().words());
        self.fault(&message, "give `stiffness_per_area` instead; `stiffness` is for spheres")
    }
}

/// Mean thickness of the elements at each node [m].
fn thickness_at_nodes(shell: &Shell) -> Vec<f64> {
    let mesh = &shell.mesh;
    let mut sums = vec![[0.0; 2]; mesh.positions.len()];
    for (index, element) in mesh.elements.iter().enumerate() {
        let thickness = shell.thickness(index);
        for &node in element {
            sums[node][0] += thickness;
            sums[node][1] += 1.0;
        }
    }
    sums.iter().map(|[sum, count]| sum / count.max(1.0)).collect()
}
