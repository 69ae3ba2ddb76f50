//! "Did you mean …": the nearest known word, and lists of words for messages.

use std::cmp::Reverse;

use crate::format::synonyms;

/// The known word nearest to `word`, if one is near enough to be a slip of the pen.
pub(crate) fn nearest<'a>(word: &str, known: impl IntoIterator<Item = &'a str>) -> Option<&'a str> {
    // Long texts are no slips of the pen, and the distance costs their product.
    if word.len() > 64 {
        return None;
    }
    let small = word.to_lowercase();
    // Of equally distant words, the one with the same beginning.
    let score = |candidate: &str| {
        let other = candidate.to_lowercase();
        let alike = small.chars().zip(other.chars()).take_while(|(a, b)| a == b).count();
        (strsim::damerau_levenshtein(&small, &other), Reverse(alike))
    };
    let ((distance, _), best) = known.into_iter().map(|candidate| (score(candidate), candidate)).min()?;
    let length = word.chars().count().min(best.chars().count());
    let allowed = if length < 3 { 0 } else { (length / 3).max(1) };
    (distance <= allowed).then_some(best)
}

/// A help line: the nearest word, otherwise one with this synonym, otherwise all known words if they are few, otherwise none.
pub fn help<'a>(word: &str, known: impl IntoIterator<Item = &'a str>) -> Option<String> {
    let known: Vec<&str> = known.into_iter().collect();
    if let Some(found) = nearest(word, known.iter().copied()) {
        return Some(format!("did you mean `{found}`?"));
    }
    if let Some(remedy) = synonyms::remedy(word, &known) {
        return Some(remedy);
    }
    if let Some(found) = synonyms::known_for(word, &known) {
        return Some(format!("did you mean `{found}`?"));
    }
    let few = !known.is_empty() && known.len() <= 30;
    few.then(|| format!("known here: {}", list(known)))
}

/// `a`, `b` and `c` in backquotes.
pub(crate) fn list<'a>(words: impl IntoIterator<Item = &'a str>) -> String {
    let quoted: Vec<String> = words.into_iter().map(|word| format!("`{word}`")).collect();
    match quoted.split_last() {
        None => String::new(),
        Some((only, [])) => only.clone(),
        Some((last, others)) => format!("{} and {last}", others.join(", ")),
    }
}

#[cfg(test)]
#[path = "../../tests/unit/format/suggest.rs"]
mod tests;
