//! Contacts of shells: at their nodes, or with balls where they are nearest.

use std::sync::Arc;

use lissom_contact::elastic::{Contact, Dissipation};
use lissom_contact::forms::Form;
use lissom_contact::geometry::pairs::PointOnSurface;
use lissom_contact::geometry::surfaces::Rod;
use lissom_contact::of_shells::{ShellContact, contact_patches};
use lissom_mechanics::compliance::Compliance;
use lissom_mechanics::elements::Contribution;
use lissom_mechanics::kinematics::{CarriedFrame, NodeId};
use lissom_mechanics::number::written;
use lissom_motion::{Motion, Vector3};
use lissom_system::Builder;

use super::contacts::solids;
use super::names::Names;
use crate::document::{ContactEntry, Document, Shell, ShellContactEntry, TouchingShell};
use crate::outputs::contact_point::ContactPoint;
use crate::outputs::shell_nodes::BuiltShell;
use crate::text::report::Problem;

/// Pairs of balls and elements that may touch.
const MAX_PAIRS: usize = 50_000;

/// A contact of a shell with another part.
struct OfShell<'a> {
    document: &'a Document,
    entry: &'a ContactEntry,
    law: &'a ShellContactEntry,
    shell: &'a Shell,
    built: &'a BuiltShell,
    base: NodeId,
}

/// Adds a contact of a shell.
pub(super) fn add(
    document: &Document,
    (entry, law): (&ContactEntry, &ShellContactEntry),
    names: &Names,
    builder: &mut Builder,
) -> Result<Vec<ContactPoint>, Problem> {
    let name = &law.shell.value;
    let found = document.shell(name).zip(names.meshes.shells.get(name));
    let (shell, built) = found.ok_or_else(|| {
        let message = format!("contact `{}`: there is no shell `{name}`", entry.name.value);
        Problem::error(law.shell.span, message)
    })?;
    let of_shell = OfShell { document, entry, law, shell, built, base: names.node(&entry.between[0])? };
    match law.touching {
        TouchingShell::Nodes(stiffness) => of_shell.at_nodes(stiffness, builder),
        TouchingShell::Nearest(stiffness) => of_shell.nearest(stiffness, builder),
    }
}

impl OfShell<'_> {
    /// Each node with its share of the area, on both faces.
    fn at_nodes(&self, stiffness: f64, builder: &mut Builder) -> Result<Vec<ContactPoint>, Problem> {
        let thickness = self.thickness_at_nodes();
        let thinnest = thickness.iter().copied().fold(f64::INFINITY, f64::min);
        let mesh = &self.shell.mesh;
        let apart = mesh.elements.iter().flat_map(|own| {
            (0..4).map(|i| (mesh.positions[own[i]] - mesh.positions[own[(i + 1) % 4]]).norm())
        });
        let apart = apart.fold(0.0, f64::max);
        let mut all = Vec::new();
        for solid in solids(self.document, &self.entry.between[0].value) {
            let found = (solid.form.spacing(0.5 * thinnest), solid.form.surface(0.0));
            let (Some(most), Ok(Some(surface))) = found else { return Err(self.no_pair(&solid.form)) };
            if apart > most {
                let message = format!(
                    "nodes of the shell are {} m apart, more than {} m for {} of this size, which could pass between them",
                    written(apart, 3),
                    written(most, 3),
                    solid.form.kind().words()
                );
                return Err(self.fault(
                    &message,
                    "use smaller elements; for a ball where it is nearest give `stiffness`",
                ));
            }
            for (index, &node) in self.built.surface.nodes.iter().enumerate() {
                let area = self.built.surface.areas[index];
                let compliance = Compliance { stiffness: stiffness * area, exponent: self.law.exponent };
                let mut contribution = Contribution::to(builder.model());
                let name = format!("{}, friction {}", self.entry.name.value, all.len() + 1);
                let friction = self.law.friction.as_ref();
                let friction = friction.map(|law| law.with_bristles(&name, &mut contribution));
                let pair =
                    Arc::new(PointOnSurface { rounding: 0.5 * thickness[index], surface: surface.clone() });
                // In the middle of the thickness; the third axis of a node is the normal.
                let middle = Motion::translation(self.shell.offset * Vector3::z());
                let frames = [(self.base, solid.frame), (node, middle)]
                    .map(|(node, offset)| CarriedFrame { node, offset });
                let law = (compliance, Dissipation::Factor(self.law.dissipation));
                let contact = Contact::new(frames, pair, law, friction).with_name(&self.entry.name.value);
                builder.add(contribution.with(contact.clone()));
                all.push(ContactPoint { contact: Arc::new(contact), sign: 1.0, velocity: None });
            }
        }
        Ok(all)
    }

    /// Balls, each with all elements.
    fn nearest(&self, stiffness: f64, builder: &mut Builder) -> Result<Vec<ContactPoint>, Problem> {
        if self.shell.offset != 0.0 {
            let message = format!("shell `{}` has an `offset`", self.law.shell.value);
            return Err(self.fault(
                &message,
                "give `stiffness_per_area` instead of `stiffness`, or describe the middle of the thickness without `offset`",
            ));
        }
        let thickness: Vec<f64> =
            (0..self.shell.mesh.elements.len()).map(|element| self.shell.thickness(element)).collect();
        if thickness.iter().any(|own| (own - thickness[0]).abs() > 1e-9 * thickness[0]) {
            let message =
                format!("the thickness of shell `{}` is not the same everywhere", self.law.shell.value);
            return Err(
                self.fault(&message, "give `stiffness_per_area` instead of `stiffness`, or one thickness")
            );
        }
        let solids = solids(self.document, &self.entry.between[0].value);
        let pairs = solids.len() * thickness.len();
        if pairs > MAX_PAIRS {
            let message = format!("{pairs} pairs of balls and elements may touch, more than {MAX_PAIRS}");
            return Err(self.fault(&message, "use fewer elements or balls, or divide the shell"));
        }
        let patches = contact_patches(builder.model(), &self.built.surface);
        let law = (Compliance { stiffness, exponent: self.law.exponent }, self.law.dissipation);
        let mut all = Vec::new();
        for solid in solids {
            let Some(Rod { half_length: 0.0, radius }) = solid.form.rod() else {
                return Err(self.no_ball(&solid.form));
            };
            let ball = ((self.base, solid.frame.transform_point(&Vector3::zeros())), radius);
            let mut contribution = Contribution::to(builder.model());
            let name = format!("{}, friction {}", self.entry.name.value, all.len() / thickness.len() + 1);
            let friction = self.law.friction.as_ref();
            let friction = friction.map(|law| law.with_bristles(&name, &mut contribution));
            builder.add(contribution);
            for (index, (patch, thickness)) in patches.iter().zip(&thickness).enumerate() {
                let friction = friction.as_ref().map(|law| (law, index == 0));
                let contact = ShellContact::new(ball, (patch.clone(), *thickness), law, friction);
                builder.add(Contribution::of(builder.model(), contact.clone()));
                all.push(ContactPoint { contact: Arc::new(contact), sign: 1.0, velocity: None });
            }
        }
        Ok(all)
    }

    /// Mean thickness of the elements at each node [m].
    fn thickness_at_nodes(&self) -> Vec<f64> {
        let mesh = &self.shell.mesh;
        let mut sums = vec![[0.0; 2]; mesh.positions.len()];
        for (index, element) in mesh.elements.iter().enumerate() {
            let thickness = self.shell.thickness(index);
            for &node in element {
                sums[node][0] += thickness;
                sums[node][1] += 1.0;
            }
        }
        sums.iter().map(|[sum, count]| sum / count.max(1.0)).collect()
    }

    fn fault(&self, message: &str, help: &str) -> Problem {
        let name = &self.entry.name.value;
        Problem::error(self.entry.name.span, format!("contact `{name}`: {message}")).help(help)
    }

    fn no_pair(&self, form: &Form) -> Problem {
        let message = format!("a shell on {} is not available", form.kind().words());
        self.fault(&message, "use planes, boxes, cylinders, tubes, spheres and capsules that have its shape")
    }

    fn no_ball(&self, form: &Form) -> Problem {
        let message = format!("`stiffness` of a shell on {} is not available", form.kind().words());
        self.fault(&message, "give `stiffness_per_area` instead; `stiffness` is for spheres")
    }
}
