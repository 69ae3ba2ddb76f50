//! Contacts of schemes that solve for all touches of a step at once: their parts and laws, without elements and events.

use lissom_contact::forms::{FormKind, PlacedSolid};
use lissom_contact::set::{ContactRule, TouchLaw, TouchingPart};
use lissom_mechanics::compliance::Compliance;
use lissom_mechanics::kinematics::NodeId;
use lissom_system::Builder;

use super::super::names::Names;
use super::compliant::compliance;
use super::pairs::{check_clamp, meetings_of, solids};
use crate::document::{CompliantLaw, ContactEntry, Document};
use crate::text::report::Problem;

/// Adds a contact.
pub(super) fn add(
    document: &Document,
    (entry, law): (&ContactEntry, &CompliantLaw),
    names: &Names,
    builder: &mut Builder,
) -> Result<(), Problem> {
    let name = &entry.name.value;
    if let Some(what) = refused(document, law) {
        let message = format!("contact `{name}`: {what} not available with contacts as a set");
        return Err(Problem::error(entry.name.span, message)
            .help("remove it, or write `contacts = \"elements\"` in `[analysis]`"));
    }
    let members: Vec<_> = entry.between.iter().chain(&entry.others).collect();
    let solids: Vec<_> = members.iter().map(|part| solids(document, &part.value)).collect();
    let has_clamps = document.joints.iter().any(|joint| joint.kind.value == "clamp");
    let groups = entry.groups();
    let is_apart = |[base, tip]: [usize; 2]| groups[base].iter().any(|own| groups[tip].contains(own));
    let mut known: Vec<[FormKind; 2]> = Vec::new();
    for tip in 1..members.len() {
        for base in (0..tip).filter(|&base| !is_apart([base, tip])) {
            if has_clamps {
                check_clamp(document, name, [members[base], members[tip]])?;
            }
            let between =
                solids[base].iter().flat_map(|one| solids[tip].iter().map(move |other| [one, other]));
            for pair in between {
                let kinds = pair.map(|solid| solid.form.kind());
                if !known.contains(&kinds) {
                    meetings_of(entry, pair)?;
                    compliance(document, (entry, law), pair)?;
                    known.push(kinds);
                }
            }
        }
    }
    let mut parts = Vec::new();
    for (part, own) in members.into_iter().zip(solids) {
        parts.push(part_of((own, names.node(part)?), builder));
    }
    let materials = law.compliance.as_ref().err();
    let materials = materials.map(|names| {
        names.each_ref().map(|name| {
            let found = document.materials.iter().find(|material| material.name.value == name.value);
            found.map_or([1.0, 0.0], |found| [found.constants.young, found.constants.poisson()])
        })
    });
    let friction = law.friction.as_ref().map(|friction| friction.law);
    let surface = law.surface_velocity.map(|velocity| (0, velocity));
    // The compliance of two materials depends on the curvatures of each pair.
    let own = law.compliance.as_ref().copied().unwrap_or(Compliance { stiffness: 1.0, exponent: 1.5 });
    let law = TouchLaw { compliance: own, impact: law.impact, friction, surface };
    builder.contacts_mut().rules.push(ContactRule { name: name.clone(), parts, groups, law, materials });
    Ok(())
}

/// What a set cannot do of what a contact and its model want.
fn refused(document: &Document, law: &CompliantLaw) -> Option<&'static str> {
    if law.resistance != [0.0; 2] {
        return Some("rolling and torsional friction are");
    }
    document.starts_in_equilibrium().then_some("a start from equilibrium is")
}

/// Index of a part of the set, which is added unless it is known.
fn part_of((solids, node): (&[PlacedSolid], NodeId), builder: &mut Builder) -> usize {
    let parts = &mut builder.contacts_mut().parts;
    parts.iter().position(|known| known.node == node && known.solids == solids).unwrap_or_else(|| {
        parts.push(TouchingPart::new(node, solids.to_vec()));
        parts.len() - 1
    })
}
