//! How parts move at the start: a rigid motion of all, and others of some.

use std::collections::BTreeMap;

use lissom_motion::Vector3;

use super::InitialMotion;
use super::connections::unread;
use crate::format::part_tables;
use crate::format::suggest;
use crate::parts::context::Context;
use crate::reading::reader::Reader;
use crate::text::report::{Problem, Span};
use crate::text::{Node, Value, in_order};

/// Tables whose entries move.
const MOVING: [&str; 6] = ["bodies", "point_masses", "beams", "shells", "solids", "superelements"];

/// The motion of all parts, and the motions of those that have another, by their names.
pub(super) fn initial(context: &Context<'_>) -> (Option<InitialMotion>, BTreeMap<String, InitialMotion>) {
    let nothing = (None, BTreeMap::new());
    let Some((node, name)) = context.top("initial") else { return nothing };
    let Some(table) = node.table() else { return nothing };
    let (own, others): (Vec<_>, Vec<_>) = in_order(table).into_iter().partition(|(key, _, node)| {
        part_tables::initial().iter().any(|known| known.name == *key) || node.table().is_none()
    });
    let own =
        own.iter().filter_map(|(key, ..)| table.get(*key).map(|entry| ((*key).to_owned(), entry.clone())));
    let own = Node { value: Value::Table(own.collect()), ..node.clone() };
    let all = Reader::open(context, &own, ("[initial]".to_owned(), name), part_tables::initial())
        .and_then(|reader| motion_of_model(&reader));
    if all.is_none() {
        unread(context, "[initial]", name);
    }
    let mut of_parts = BTreeMap::new();
    let mut owners: BTreeMap<String, (Span, &str)> = BTreeMap::new();
    for (motion_name, key, node) in others {
        let what = format!("motion `{motion_name}` of [initial]");
        let reader = Reader::open(context, node, (what.clone(), key), part_tables::part_motion());
        let motion = reader.as_ref().and_then(motion);
        let (Some(reader), Some(motion)) = (reader, motion) else {
            unread(context, &what, key);
            continue;
        };
        for (part, span) in parts(&reader, "parts") {
            if let Some((first, other)) = owners.insert(part.clone(), (span, motion_name)) {
                let message = format!("`{part}` moves at the start as `{other}` and as `{motion_name}`");
                let problem = Problem::error(span, message).label("again").also(first, "first here");
                context.report(problem.help("name each part in one motion"));
            }
            of_parts.insert(part, motion);
        }
    }
    (all, of_parts)
}

fn motion(reader: &Reader<'_, '_>) -> Option<InitialMotion> {
    let vector = |key: &str| match reader.node(key) {
        None => Some(Vector3::zeros()),
        Some(_) => reader.vector(key).map(|vector| vector.value),
    };
    let about = match reader.node("about") {
        None => Vector3::zeros(),
        Some(node) => reader.context.place(node, &reader.words("about"))?.value,
    };
    let (velocity, angular_velocity) = (vector("velocity")?, vector("angular_velocity")?);
    let (equilibrium, steady_rotation, follow_drives) = (false, false, true);
    Some(InitialMotion { velocity, angular_velocity, about, equilibrium, steady_rotation, follow_drives })
}

/// That of the whole model, which may follow from its loads or drives.
fn motion_of_model(reader: &Reader<'_, '_>) -> Option<InitialMotion> {
    let flag = |key: &str| reader.flag(key).map(|flag| flag.value);
    let (equilibrium, steady_rotation) = (flag("equilibrium")?, flag("steady_rotation")?);
    if equilibrium && steady_rotation {
        return reader.context.fail(
            reader.node("steady_rotation")?.span,
            "a start is in equilibrium at rest or in steady rotation, not both".to_owned(),
            "remove one of them",
        );
    }
    let follow_drives = flag("follow_drives")?;
    Some(InitialMotion { equilibrium, steady_rotation, follow_drives, ..motion(reader)? })
}

/// The names of bodies, point masses and beams that the list under `key` means, each with its position.
pub(super) fn parts(reader: &Reader<'_, '_>, key: &str) -> Vec<(String, Span)> {
    let (context, what) = (reader.context, reader.words(key));
    let Some(node) = reader.node(key) else { return Vec::new() };
    let Value::List(list) = &node.value else {
        context.wrong_type::<()>(node, &what, "a list of names");
        return Vec::new();
    };
    if list.is_empty() {
        context.fail::<()>(node.span, format!("{what} is empty"), "list parts, or remove it");
    }
    let mut found = Vec::new();
    for entry in list {
        let Value::Text(name) = &entry.value else {
            context.wrong_type::<()>(entry, &format!("each entry of {what}"), "a name");
            continue;
        };
        let known = MOVING.iter().flat_map(|table| context.names(table)).map(|(known, _)| known);
        let inside = format!("{name}.");
        let is_part = context.instances.contains_key(name);
        let meant: Vec<&str> =
            known.clone().filter(|known| known == name || (is_part && known.starts_with(&inside))).collect();
        if meant.is_empty() {
            let problem =
                Problem::error(entry.span, format!("{what} names `{name}`, which is not a moving part"));
            let known = known.chain(context.instances.keys().map(String::as_str));
            let help = suggest::help(name, known);
            let first =
                "name bodies, point masses, beams, shells, solids, superelements or entries of [parts]";
            context.report(problem.label("no such part").help(first).maybe_help(help));
        }
        found.extend(meant.into_iter().map(|known| (known.to_owned(), entry.span)));
    }
    found
}
