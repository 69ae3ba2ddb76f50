//! Overrides inside parts, such as `leg2.rod.mass`.

use super::Expanded;
use crate::format::suggest;
use crate::format::top_level;
use crate::format::top_level::singular;
use crate::text::Patch;
use crate::text::report::Problem;

/// Puts the value of an override in its place among the parts.
pub(super) fn apply(mut patch: Patch, into: &mut Expanded) -> Result<(), Box<Problem>> {
    let names: Vec<&str> = patch.path.iter().map(|(name, _)| name.as_str()).collect();
    let place = patch.path.first().map(|(_, span)| *span).unwrap_or_default();
    if names.first().is_some_and(|first| top_level::tops().any(|top| top.name == *first)) {
        return patch.apply(&mut into.root);
    }
    let words: Vec<&str> = top_level::tops()
        .map(|top| top.name)
        .filter(|word| top_level::has_named_entries(word) && !matches!(*word, "parts" | "parameters"))
        .collect();
    let has = |word: &str, name: &str| {
        into.root.get(word).and_then(|entry| entry.node.table()).is_some_and(|table| table.contains_key(name))
    };
    // The longest name that is there: parts may contain parts.
    let found = (2..=names.len()).rev().find_map(|length| {
        let name = names[..length].join(".");
        let owners: Vec<&str> = words.iter().copied().filter(|word| has(word, &name)).collect();
        (!owners.is_empty()).then_some((length, name, owners))
    });
    let Some((length, name, owners)) = found else {
        let whole = names.join(".");
        let known: Vec<&str> = words
            .iter()
            .filter_map(|word| into.root.get(*word).and_then(|entry| entry.node.table()))
            .flat_map(|table| table.keys().map(String::as_str))
            .collect();
        let asked = names[..names.len().saturating_sub(1)].join(".");
        let near = suggest::nearest(&asked, known).map(|near| format!("did you mean `{near}`?"));
        let problem = Problem::error(place, format!("nothing in the model is called as `{whole}` begins"));
        let help = "write for example leg2.rod.mass=1, parts.leg2.parameters.length=2 or analysis.step=1e-4";
        return Err(Box::new(problem.label("not in the model").help(help).maybe_help(near)));
    };
    // Entries of several tables may share a name: the next word decides which is meant.
    let next = names.get(length).copied().unwrap_or_default();
    let holds = |word: &str| {
        let table = into.root.get(word).and_then(|entry| entry.node.table());
        let entry = table.and_then(|table| table.get(&name)).and_then(|entry| entry.node.table());
        entry.is_some_and(|entry| entry.contains_key(next))
    };
    let holding: Vec<&str> = owners.iter().copied().filter(|word| holds(word)).collect();
    let owners = if holding.len() == 1 { holding } else { owners };
    if let [first, second, ..] = owners.as_slice() {
        let message = format!("`{name}` is a {} and a {}", singular(first), singular(second));
        let help = format!("say which: {first}.\"{name}\".… or {second}.\"{name}\".…");
        return Err(Box::new(Problem::error(place, message).help(help)));
    }
    let owner = owners.first().copied().unwrap_or_default().to_owned();
    let rest = patch.path.split_off(length);
    patch.path = [(owner, place), (name, place)].into_iter().chain(rest).collect();
    patch.apply(&mut into.root)
}
