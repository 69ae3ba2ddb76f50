//! The tables of docs/mutants.md: figures of fresh seeds, and their survivors with remarks. The figures of a seed whose sample was
//! tried completely do not change any more, because tests may be written for its survivors.

use std::fs;
use std::path::Path;

use super::MutantsError;
use super::place::Mutant;
use super::trial::Outcome;

/// Heading of the section that the command writes.
const HEAD: &str = "## Results\n";
const FIGURES: &str = "| seed | mutants | compiled | survived | share |\n|---|---|---|---|---|\n";
const SURVIVORS: &str = "| seed | file | line | mutant | remark |\n|---|---|---|---|---|\n";

/// Counts of a sample.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Figures {
    seed: u64,
    sample: usize,
    tried: usize,
    compiled: usize,
    survived: usize,
}

impl Figures {
    pub(super) fn of(tried: &[(&Mutant, &Outcome)], sample: usize, seed: u64) -> Self {
        let count = |is: &dyn Fn(&Outcome) -> bool| tried.iter().filter(|(_, outcome)| is(outcome)).count();
        Self {
            seed,
            sample,
            tried: tried.len(),
            compiled: count(&|outcome| *outcome != Outcome::NotBuilt),
            survived: count(&Outcome::is_survivor),
        }
    }

    /// Survivors relative to the mutants that compile.
    pub(super) fn share(&self) -> f64 {
        self.survived as f64 / self.compiled.max(1) as f64
    }

    pub(super) fn words(&self) -> String {
        let Self { seed, sample, tried, compiled, survived } = *self;
        let share = 100.0 * self.share();
        format!(
            "Seed {seed}: {tried} of {sample} mutants tried, {compiled} compile, {survived} survive ({share:.1} %)."
        )
    }

    fn row(&self) -> Row {
        let Self { seed, sample, tried, compiled, survived } = *self;
        let mutants = if tried == sample { tried.to_string() } else { format!("{tried} of {sample}") };
        let share = format!("{:.1} %", 100.0 * self.share());
        [seed.to_string(), mutants, compiled.to_string(), survived.to_string(), share]
    }
}

type Row = [String; 5];

/// The two tables.
#[derive(Debug, Default)]
struct Tables {
    figures: Vec<Row>,
    survivors: Vec<Row>,
}

impl Tables {
    fn read(text: &str) -> Self {
        let rows = |text: &str| -> Vec<Row> {
            let inner = text.lines().filter_map(|line| line.strip_prefix('|')?.strip_suffix('|'));
            let cells = |row: &str| -> Option<Row> {
                let cells: Vec<String> = row.splitn(5, " | ").map(|cell| cell.trim().to_owned()).collect();
                cells.try_into().ok()
            };
            inner.filter_map(cells).filter(|row| row[0].parse::<u64>().is_ok()).collect()
        };
        let (figures, survivors) = text.split_once(SURVIVORS).unwrap_or((text, ""));
        Self { figures: rows(figures), survivors: rows(survivors) }
    }

    fn text(&self) -> String {
        let rows = |rows: &[Row]| rows.iter().map(line).collect::<Vec<_>>().concat();
        let mut text = ["\n", FIGURES, &rows(&self.figures)].concat();
        if !self.survivors.is_empty() {
            text += &["\n", SURVIVORS, &rows(&self.survivors)].concat();
        }
        text
    }

    /// Enters the outcomes of a sample.
    fn enter(&mut self, figures: &Figures, tried: &[(&Mutant, &Outcome)]) {
        let row = figures.row();
        let earlier = self.figures.iter().position(|other| other[0] == row[0]);
        let is_complete = |row: &Row| row[1].parse::<usize>().is_ok();
        match earlier {
            Some(index) if is_complete(&self.figures[index]) => {
                self.remark(&row[0], tried);
                return;
            }
            Some(index) => self.figures[index].clone_from(&row),
            None => self.figures.push(row.clone()),
        }
        let (earlier, others): (Vec<Row>, Vec<Row>) =
            std::mem::take(&mut self.survivors).into_iter().partition(|other| other[0] == row[0]);
        self.survivors = others;
        let mut survivors: Vec<&Mutant> =
            tried.iter().filter(|(_, outcome)| outcome.is_survivor()).map(|(mutant, _)| *mutant).collect();
        survivors.sort_by(|a, b| (&a.file, a.line).cmp(&(&b.file, b.line)));
        for mutant in survivors {
            let [file, what] = cells(mutant);
            let remark = earlier.iter().find(|other| other[1] == file && other[3] == what);
            let remark = remark.map_or(String::new(), |other| other[4].clone());
            self.survivors.push([row[0].clone(), file, mutant.line.to_string(), what, remark]);
        }
    }

    /// Fills empty remarks on survivors of a seed that tests notice now.
    fn remark(&mut self, seed: &str, tried: &[(&Mutant, &Outcome)]) {
        for row in self.survivors.iter_mut().filter(|row| row[0] == seed && row[4].is_empty()) {
            let outcome = tried.iter().find(|(mutant, _)| cells(mutant) == [row[1].clone(), row[3].clone()]);
            if let Some((_, outcome)) = outcome.filter(|(_, outcome)| !outcome.is_survivor()) {
                row[4] = format!("Now {}.", outcome.words());
            }
        }
    }
}

/// A line of a table.
fn line(row: &Row) -> String {
    format!("| {} |\n", row.join(" | "))
}

/// File and change of a mutant, as cells of a table.
fn cells(mutant: &Mutant) -> [String; 2] {
    // `|` separates cells.
    [mutant.file.clone(), format!("`{}`", mutant.what.replace('|', "\\|"))]
}

/// Writes the outcomes of a sample into the chapter.
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
    let mut tables = Tables::read(after);
    tables.enter(figures, tried);
    fs::write(chapter, format!("{before}{HEAD}{}", tables.text()))
        .map_err(MutantsError::about(chapter.display()))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn mutants() -> [Mutant; 2] {
        ["replace | with & in f", "replace + with - in g"].map(|what| Mutant::named("file.rs", 1, what))
    }

    fn entered(before: &str, sample: usize, tried: &[(&Mutant, &Outcome)]) -> String {
        let mut tables = Tables::read(before);
        tables.enter(&Figures::of(tried, sample, 31), tried);
        tables.text()
    }

    #[test]
    fn mutants_that_do_not_compile_are_not_counted() {
        let [a, b] = mutants();
        let figures = Figures::of(&[(&a, &Outcome::Survived), (&b, &Outcome::NotBuilt)], 10, 31);
        assert_eq!(figures.words(), "Seed 31: 2 of 10 mutants tried, 1 compile, 1 survive (100.0 %).");
        assert_eq!(Figures::of(&[(&b, &Outcome::NotBuilt)], 10, 31).share(), 0.0);
    }

    #[test]
    fn an_incomplete_sample_is_updated_and_remarks_are_kept() {
        let [a, b] = mutants();
        let first = entered("", 10, &[(&a, &Outcome::Survived), (&b, &Outcome::Unreached)]);
        assert!(first.contains("| 31 | 2 of 10 | 2 | 2 | 100.0 % |"), "{first}");
        assert!(first.contains("| 31 | file.rs | 1 | `replace \\| with & in f` |  |"), "{first}");
        let remarked = first.replace("with & in f` |  |", "with & in f` | equivalent | really |");
        assert_eq!(entered(&remarked, 10, &[(&a, &Outcome::Survived), (&b, &Outcome::Unreached)]), remarked);
        let later = entered(&remarked, 10, &[(&a, &Outcome::Survived), (&b, &Outcome::Hung)]);
        assert!(later.contains("equivalent | really") && !later.contains("in g"), "{later}");
    }

    #[test]
    fn figures_of_a_complete_sample_are_kept_and_survivors_noticed_later_are_remarked() {
        let [a, b] = mutants();
        let first = entered("", 2, &[(&a, &Outcome::Survived), (&b, &Outcome::Hung)]);
        assert!(first.contains("| 31 | 2 | 2 | 1 | 50.0 % |"), "{first}");
        let caught = Outcome::Caught("`t`".to_owned());
        let later = entered(&first, 2, &[(&a, &caught), (&b, &Outcome::Survived)]);
        assert_eq!(later, first.replace("with & in f` |  |", "with & in f` | Now noticed by `t`. |"));
    }

    #[test]
    fn seeds_are_listed_in_the_order_of_their_trials() {
        let [a, _] = mutants();
        let mut tables = Tables::default();
        for seed in [33, 7] {
            tables.enter(&Figures::of(&[(&a, &Outcome::Survived)], 1, seed), &[(&a, &Outcome::Survived)]);
        }
        let read = Tables::read(&tables.text());
        assert_eq!((&read.figures, &read.survivors), (&tables.figures, &tables.survivors));
        assert_eq!([&read.figures[0][0], &read.figures[1][0]], ["33", "7"]);
        assert_eq!(read.survivors.len(), 2);
    }
}
