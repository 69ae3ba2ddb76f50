//! All mutants of a sample in one text of the program, of which an environment variable chooses one when it runs
//! [mutant schemata: Untch, Offutt and Harrold 1993].

use std::cmp::Reverse;
use std::collections::BTreeMap;
use std::ops::Range;
use std::path::{Path, PathBuf};

use super::MutantsError;
use super::place::{CHOSEN, Mutant};

/// Environment variable with the number of the mutant.
pub(super) const VARIABLE: &str = "LISSOM_MUTANT";
/// Value of [`VARIABLE`] with which none is chosen, and each that a thread reaches is recorded.
pub(super) const RECORD: &str = "4294967294";
/// Environment variable with the file that it is written to: a number and a thread's name on each line.
pub(super) const REACHED: &str = "LISSOM_MUTANTS_REACHED";

/// The module that each crate with mutants gets.
const MODULE: &str = r#"//! Which mutant is chosen.
use std::cell::RefCell;
use std::io::Write;
use std::sync::atomic::{AtomicU32, Ordering::Relaxed};

const UNREAD: u32 = u32::MAX;
const RECORD: u32 = u32::MAX - 1;
static CHOSEN: AtomicU32 = AtomicU32::new(UNREAD);

#[inline]
pub(crate) fn on(number: u32) -> bool {
    let chosen = CHOSEN.load(Relaxed);
    chosen == number || (chosen >= RECORD && is_first_or_noted(chosen, number))
}

#[cold]
fn is_first_or_noted(mut chosen: u32, number: u32) -> bool {
    if chosen == UNREAD {
        chosen = std::env::var("LISSOM_MUTANT").ok().and_then(|text| text.parse().ok()).unwrap_or(0);
        CHOSEN.store(chosen, Relaxed);
    }
    if chosen == RECORD {
        note(number);
    }
    chosen == number
}

fn note(number: u32) {
    thread_local!(static SEEN: RefCell<Vec<bool>> = const { RefCell::new(Vec::new()) });
    let place = number as usize;
    let is_new = SEEN.try_with(|seen| {
        let mut seen = seen.borrow_mut();
        if seen.len() <= place {
            seen.resize(place + 1, false);
        }
        !std::mem::replace(&mut seen[place], true)
    });
    if let (true, Ok(path)) = (is_new.unwrap_or(true), std::env::var("LISSOM_MUTANTS_REACHED")) {
        let thread = std::thread::current();
        let line = format!("{number} {}\n", thread.name().unwrap_or(""));
        let mut file = std::fs::OpenOptions::new().append(true).create(true).open(path).expect("a file for mutants");
        file.write_all(line.as_bytes()).expect("mutants that are reached are written down");
    }
}
"#;

/// A file with mutants in it.
pub(super) struct Switched {
    pub(super) text: String,
    /// For each mutant where in the text it is, and where the part is that only runs if it is chosen.
    places: Vec<(usize, Range<usize>, Range<usize>)>,
}

/// Puts numbered mutants of one file into its text.
fn switched(text: &str, mutants: &[(usize, &Mutant)]) -> Switched {
    // Ends come before beginnings at the same position; what encloses more begins sooner and ends later.
    let mut insertions = Vec::new();
    for (order, (_, mutant)) in mutants.iter().enumerate() {
        let Range { start, end } = mutant.range;
        insertions.push(((start, 1, Reverse(end), order), order, true));
        if !mutant.after.is_empty() {
            insertions.push(((end, 0, Reverse(start), usize::MAX - order), order, false));
        }
    }
    insertions.sort_unstable();
    let mut places: Vec<_> = mutants.iter().map(|(number, _)| (*number, 0..0, 0..0)).collect();
    let (mut output, mut done) = (String::new(), 0);
    for ((at, ..), order, is_before) in insertions {
        output += &text[done..at];
        done = at;
        let (number, mutant) = mutants[order];
        let (_, all, only) = &mut places[order];
        if is_before {
            let begins = output.len();
            output += &mutant.before.replace(CHOSEN, &format!("crate::mutant_switch::on({number})"));
            *only = begins..output.len();
        } else {
            output += mutant.after;
        }
        *all = only.start..output.len();
    }
    output += &text[done..];
    Switched { text: output, places }
}

impl Switched {
    /// The mutant that a complaint of the compiler about some bytes is about: the one in whose own text they are, else the
    /// innermost one around them, else the next.
    pub(super) fn blamed(&self, bytes: &Range<usize>) -> Option<usize> {
        let overlaps =
            |range: &Range<usize>| bytes.start < range.end && range.start < bytes.end.max(bytes.start + 1);
        let size = |range: &Range<usize>| range.end - range.start;
        let distance =
            |range: &Range<usize>| range.start.abs_diff(bytes.start).min(range.end.abs_diff(bytes.start));
        let own =
            self.places.iter().filter(|(_, _, only)| overlaps(only)).min_by_key(|(_, _, only)| size(only));
        let around =
            || self.places.iter().filter(|(_, all, _)| overlaps(all)).min_by_key(|(_, all, _)| size(all));
        let next = || self.places.iter().min_by_key(|(_, all, _)| distance(all));
        own.or_else(around).or_else(next).map(|(number, ..)| *number)
    }
}

/// Files by their paths from the project's folder on.
#[derive(Default)]
pub(super) struct Files {
    /// Files with mutants in them.
    pub(super) parts: BTreeMap<PathBuf, Switched>,
    /// Texts of these and of the crates' files that change with them.
    pub(super) texts: BTreeMap<PathBuf, String>,
}

/// Puts numbered mutants into the project's files.
///
/// # Errors
/// If a file cannot be read.
pub(super) fn files(root: &Path, mutants: &[(usize, &Mutant)]) -> Result<Files, MutantsError> {
    let read = |path: &Path| {
        let path = root.join(path);
        std::fs::read_to_string(&path).map_err(MutantsError::about(path.display()))
    };
    let mut by_file: BTreeMap<PathBuf, Vec<(usize, &Mutant)>> = BTreeMap::new();
    for (number, mutant) in mutants {
        by_file.entry(PathBuf::from(&mutant.file)).or_default().push((*number, mutant));
    }
    let Files { mut parts, mut texts } = Files::default();
    for (path, mutants) in by_file {
        let part = switched(&read(&path)?, &mutants);
        texts.insert(path.clone(), part.text.clone());
        let folder: PathBuf = path.components().take_while(|part| part.as_os_str() != "src").collect();
        let (top, module) = (folder.join("src/lib.rs"), folder.join("src/mutant_switch.rs"));
        if !texts.contains_key(&module) {
            texts.insert(top.clone(), format!("{}\nmod mutant_switch;\n", read(&top)?));
            texts.insert(module, MODULE.to_owned());
        }
        parts.insert(path, part);
    }
    Ok(Files { parts, texts })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn expression(range: Range<usize>, instead: &str) -> Mutant {
        let before = format!("(if {CHOSEN} {{ {instead} }} else {{ ");
        Mutant { range, before, after: " })", ..Mutant::named("file.rs", 1, "something") }
    }

    #[test]
    fn mutants_within_and_beside_each_other_keep_their_places() {
        let text = "a + b * c";
        let (sum, other, product) = (
            expression(0..9, "(a) - (b * c)"),
            expression(0..9, "(a) * (b * c)"),
            expression(4..9, "(b) / (c)"),
        );
        let part = switched(text, &[(1, &sum), (2, &other), (3, &product)]);
        let on = |number: usize| format!("(if crate::mutant_switch::on({number}) {{ ");
        let (one, two, three) = (on(1), on(2), on(3));
        assert_eq!(
            part.text,
            format!(
                "{one}(a) - (b * c) }} else {{ {two}(a) * (b * c) }} else {{ a + {three}(b) / (c) }} else {{ b * c }}) }}) }})"
            )
        );
        let at = |what: &str| part.text.find(what).expect("it is there");
        assert_eq!(part.blamed(&(at("(a) * ")..at("(a) * ") + 3)), Some(2));
        assert_eq!(part.blamed(&(at("a + ")..at("a + ") + 1)), Some(2));
        assert_eq!(part.blamed(&(at("b * c }")..at("b * c }") + 1)), Some(3));
    }

    #[test]
    fn the_module_reads_the_variables_that_the_trials_set() {
        for name in [VARIABLE, REACHED] {
            assert!(MODULE.contains(&format!("\"{name}\"")));
        }
        assert_eq!(RECORD, (u32::MAX - 1).to_string());
    }
}
