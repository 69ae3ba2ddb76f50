//! What came of the mutants, in the book: figures, and the survivors with the reasons that were written beside them.

use std::collections::BTreeMap;
use std::fs;
use std::path::Path;

use super::MutantsError;
use super::place::Mutant;
use super::trial::Outcome;

/// Where the part that is written begins.
const HEAD: &str = "## Survivors\n";
/// Where a reason stands that nobody has written.
const NO_REASON: &str = "";

/// Counts.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Figures {
    seed: u64,
    sample: usize,
    tried: usize,
    /// Those that are no program.
    not_built: usize,
    pub(super) survived: usize,
}

impl Figures {
    pub(super) fn of(tried: &[(&Mutant, &Outcome)], sample: usize, seed: u64) -> Self {
        let count = |is: &dyn Fn(&Outcome) -> bool| tried.iter().filter(|(_, outcome)| is(outcome)).count();
        Self {
            seed,
            sample,
            tried: tried.len(),
            not_built: count(&|outcome| *outcome == Outcome::NotBuilt),
            survived: count(&Outcome::is_survivor),
        }
    }

    pub(super) fn words(&self) -> String {
        let Self { seed, sample, tried, not_built, survived } = *self;
        let built = tried - not_built;
        let share = 100.0 * survived as f64 / built.max(1) as f64;
        let tried =
            format!("Seed {seed}: {tried} of {sample} mutants tried so far; {not_built} do not compile");
        if built == 0 {
            return format!("{tried}, and nothing can be said of the others.");
        }
        format!("{tried}; of the {built} that do, {survived} survive all tests ({share:.0} %).")
    }
}

/// Reasons by file and what was done, as they stand in the table.
fn reasons(text: &str) -> BTreeMap<(String, String), String> {
    let rows = text.lines().filter_map(|line| line.strip_prefix('|')?.strip_suffix('|'));
    let rows = rows.filter_map(|row| {
        let [file, _, what, reason] = row.splitn(4, " | ").collect::<Vec<_>>().try_into().ok()?;
        let what = what.trim().trim_matches('`');
        Some(((file.trim().to_owned(), what.to_owned()), reason.trim().to_owned()))
    });
    rows.collect()
}

/// What follows the head.
fn written(before: &str, figures: &Figures, tried: &[(&Mutant, &Outcome)]) -> String {
    let reasons = reasons(before);
    let mut survivors: Vec<&Mutant> =
        tried.iter().filter(|(_, outcome)| outcome.is_survivor()).map(|(mutant, _)| *mutant).collect();
    survivors.sort_by(|a, b| (&a.file, a.line).cmp(&(&b.file, b.line)));
    let mut text = format!("\n{}\n", figures.words());
    if survivors.is_empty() {
        return text;
    }
    text += "\n| file | line | what | reason |\n|---|---|---|---|\n";
    for mutant in survivors {
        // A sign of a table within a table.
        let what = mutant.what.replace('|', "\\|");
        let key = (mutant.file.clone(), what.clone());
        let reason = reasons.get(&key).map_or(NO_REASON, String::as_str);
        let (line, what) = (mutant.line.to_string(), format!("`{what}`"));
        text += &["| ", &[mutant.file.as_str(), &line, &what, reason].join(" | "), " |\n"].concat();
    }
    text
}

/// Writes figures and survivors into the book.
///
/// # Errors
/// If the chapter cannot be read or written.
pub(super) fn write(
    chapter: &Path,
    figures: &Figures,
    tried: &[(&Mutant, &Outcome)],
) -> Result<(), MutantsError> {
    let text = fs::read_to_string(chapter).map_err(MutantsError::about(chapter.display()))?;
    let (before, after) = text.split_once(HEAD).unwrap_or((&text, ""));
    let text = format!("{before}{HEAD}{}", written(after, figures, tried));
    fs::write(chapter, text).map_err(MutantsError::about(chapter.display()))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn reasons_stay_with_their_mutants_and_those_that_are_noticed_go() {
        let a = Mutant::named("file.rs", 1, "replace | with & in f");
        let b = Mutant::named("file.rs", 1, "replace + with - in g");
        let figures = Figures::of(&[(&a, &Outcome::Survived), (&b, &Outcome::NotBuilt)], 10, 1);
        assert!(figures.words().contains("2 of 10 mutants tried so far; 1 do not compile; of the 1"));
        assert!(!Figures::of(&[(&b, &Outcome::NotBuilt)], 10, 1).words().contains('%'));
        let both = [(&a, &Outcome::Survived), (&b, &Outcome::Survived)];
        let first = written("", &figures, &both);
        assert!(first.contains("| file.rs | 1 | `replace \\| with & in f` |  |"), "{first}");
        let explained = first.replace("with - in g` |  |", "with - in g` | it is only a guess |");
        let again = written(&explained, &figures, &both);
        assert_eq!(again, explained);
        let caught = written(&explained, &figures, &[(&a, &Outcome::Survived), (&b, &Outcome::Hung)]);
        assert!(!caught.contains("guess") && caught.contains("in f`"));
    }
}
