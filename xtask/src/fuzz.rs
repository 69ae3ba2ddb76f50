//! `cargo xtask fuzz`: texts that are damaged by chance, one after the other, through the readers: model files, and expressions. Each
//! is read or rejected with its position; none makes it panic. A seed and a number determine a case on every machine.

use std::collections::BTreeMap;
use std::fmt::{self, Display};
use std::panic::catch_unwind;
use std::path::PathBuf;
use std::sync::Mutex;
use std::sync::atomic::{AtomicU64, Ordering};
use std::time::{Duration, Instant};

use lissom_model::expression::Formula;
use lissom_model::lower::registry::registry;
use lissom_model::registry::Registry;

#[path = "../../crates/lissom-model/tests/support/answers.rs"]
mod answers;
#[path = "../../crates/lissom-model/tests/support/damage.rs"]
mod damage;
#[path = "../../crates/lissom-model/tests/support/damaged_expressions.rs"]
mod damaged_expressions;

use crate::random::draw::Draw;
use crate::verify::root;
use answers::Answer;
use damage::{Damage, STRANGERS, tokens};
use damaged_expressions::{damaged_expression, expression_words};

/// Cases per batch of a thread.
const BLOCK: u64 = 64;
/// Texts answered badly that are kept.
const MAX_KEPT: usize = 20;
/// Words that expressions of time and of names share with those of the examples.
const SIGNS: [char; 8] = ['+', '-', '*', '/', '^', '(', '<', '>'];

/// Options of the trials.
#[derive(clap::Args)]
pub(crate) struct FuzzArguments {
    /// Texts to read, as in `1e6`
    #[arg(long, default_value = "1e5")]
    cases: String,
    /// Expressions that are read for each model file; none if it is 0
    #[arg(long, default_value_t = 0)]
    expressions: u64,
    /// Seed of all
    #[arg(long, default_value_t = 1)]
    seed: u64,
    /// Number of the first text
    #[arg(long, default_value_t = 0)]
    first: u64,
    /// Texts that are read at the same time
    #[arg(long, default_value_t = 2)]
    threads: usize,
    /// Print the first text, and read none
    #[arg(long)]
    text: bool,
    /// Folder for the texts that are answered badly
    #[arg(long, default_value = "out/fuzz")]
    keep: PathBuf,
}

/// Kind of a text.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Kind {
    Model,
    Expression,
}

impl Kind {
    /// That of a case, with so many expressions for each model file.
    fn of(index: u64, expressions: u64) -> Self {
        if index.is_multiple_of(expressions + 1) { Self::Model } else { Self::Expression }
    }
}

/// Source of the damaged texts.
struct Originals {
    /// Tokens of the model files: examples, and models of the reader's tests.
    models: Vec<Vec<String>>,
    /// Words of the expressions in them.
    expressions: Vec<Vec<String>>,
}

impl Originals {
    /// # Errors
    /// If the files cannot be read.
    fn read() -> std::io::Result<Self> {
        let mut paths = Vec::new();
        for folder in ["examples", "crates/lissom-model/tests/good"] {
            for entry in std::fs::read_dir(root().join(folder))? {
                let path = entry?.path();
                if path.extension().is_some_and(|end| end == "toml") {
                    paths.push(path);
                }
            }
        }
        paths.sort();
        let texts = paths.iter().map(std::fs::read_to_string).collect::<std::io::Result<Vec<_>>>()?;
        let quoted =
            texts.iter().flat_map(|text| text.lines()).flat_map(|line| line.split('"').skip(1).step_by(2));
        let mut expressions: Vec<&str> = quoted
            .filter(|text| text.contains(SIGNS) && Formula::parse(text, &BTreeMap::new()).is_ok())
            .collect();
        expressions.sort_unstable();
        expressions.dedup();
        Ok(Self {
            models: texts.iter().map(|text| tokens(text)).collect(),
            expressions: expressions.into_iter().map(expression_words).collect(),
        })
    }

    /// The text of a case.
    fn damaged(&self, kind: Kind, seed: u64, index: u64) -> String {
        let mut draw = Draw::new(seed, index);
        match kind {
            Kind::Model => damaged_model(&self.models, &mut draw),
            Kind::Expression => damaged_expression(&self.expressions, &mut |count| draw.below(count)),
        }
    }
}

fn damaged_model(models: &[Vec<String>], draw: &mut Draw) -> String {
    let mut tokens = models[draw.below(models.len())].clone();
    for _ in 0..=draw.below(4) {
        let place = draw.below(tokens.len());
        match draw.below(6) {
            0 => Damage::Remove.apply(&mut tokens, place),
            1 => Damage::Double.apply(&mut tokens, place),
            2 => Damage::Swap(draw.below(tokens.len())).apply(&mut tokens, place),
            // A token of another model: names and kinds that exist, in the wrong position.
            3 => {
                let other = &models[draw.below(models.len())];
                Damage::Replace(&other[draw.below(other.len())]).apply(&mut tokens, place);
            }
            _ => Damage::Replace(draw.of(&STRANGERS)).apply(&mut tokens, place),
        }
        if tokens.is_empty() {
            break;
        }
    }
    tokens.concat()
}

/// How the texts of one kind were answered.
#[derive(Clone, Copy, Debug, Default)]
struct Tally {
    read: u64,
    refused: u64,
    badly: u64,
    panicked: u64,
    /// The text that took longest.
    slowest: (Duration, u64),
}

impl Tally {
    fn count(&self) -> u64 {
        self.read + self.refused + self.badly + self.panicked
    }

    fn add(&mut self, other: &Self) {
        self.read += other.read;
        self.refused += other.refused;
        self.badly += other.badly;
        self.panicked += other.panicked;
        self.slowest = self.slowest.max(other.slowest);
    }

    /// Records an answer, and returns the message for a bad one.
    fn note(&mut self, answer: std::thread::Result<Answer>) -> Option<String> {
        match answer {
            Ok(Answer::Read) => self.read += 1,
            Ok(Answer::Refused) => self.refused += 1,
            Ok(Answer::Badly(words)) => {
                self.badly += 1;
                return Some(words);
            }
            Err(_) => {
                self.panicked += 1;
                return Some("the reader broke down".to_owned());
            }
        }
        None
    }
}

impl Display for Tally {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { read, refused, badly, panicked, slowest: (longest, slowest) } = self;
        write!(
            f,
            "{read} read, {refused} rejected with their position, {badly} answered badly, {panicked} panics"
        )?;
        write!(f, "; the slowest, number {slowest}, took {:.1} ms", 1e3 * longest.as_secs_f64())
    }
}

/// Results of all threads: tallies of models and expressions, and numbers of texts with bad answers and their messages.
#[derive(Default)]
struct Found {
    tallies: [Tally; 2],
    bad: Vec<(u64, String)>,
}

/// Reads the texts of a block of numbers.
fn read_block(
    originals: &Originals,
    (registry, parameters): (&Registry, &BTreeMap<String, f64>),
    (arguments, block): (&FuzzArguments, std::ops::Range<u64>),
) -> Found {
    let mut found = Found::default();
    for index in block {
        let kind = Kind::of(index, arguments.expressions);
        let text = originals.damaged(kind, arguments.seed, index);
        let began = Instant::now();
        let answer = catch_unwind(|| match kind {
            Kind::Model => answers::of_model(&text, registry),
            Kind::Expression => answers::of_expression(&text, parameters),
        });
        let tally = &mut found.tallies[kind as usize];
        tally.slowest = tally.slowest.max((began.elapsed(), index));
        found.bad.extend(tally.note(answer).map(|words| (index, words)));
    }
    found
}

/// Reads texts; whether all were answered well.
///
/// # Errors
/// If there is no number of cases, if the models cannot be read, or a text cannot be kept.
pub(crate) fn fuzz(arguments: &FuzzArguments) -> std::io::Result<bool> {
    let count: f64 = arguments.cases.parse().map_err(std::io::Error::other)?;
    let end = arguments.first + count.max(0.0) as u64;
    let originals = Originals::read()?;
    let text_of =
        |index: u64| originals.damaged(Kind::of(index, arguments.expressions), arguments.seed, index);
    if arguments.text {
        print!("{}", text_of(arguments.first));
        return Ok(true);
    }
    let began = Instant::now();
    let next = AtomicU64::new(arguments.first);
    let all: Mutex<Found> = Mutex::new(Found::default());
    // A panic is a finding, and reported as one.
    std::panic::set_hook(Box::new(|_| {}));
    std::thread::scope(|scope| {
        for _ in 0..arguments.threads.max(1) {
            scope.spawn(|| {
                let registry = registry();
                let parameters = BTreeMap::from([("T".to_owned(), 1.6), ("k".to_owned(), -2.0)]);
                loop {
                    let first = next.fetch_add(BLOCK, Ordering::Relaxed);
                    if first >= end {
                        return;
                    }
                    let block = first..end.min(first + BLOCK);
                    let found = read_block(&originals, (&registry, &parameters), (arguments, block));
                    let mut all = all.lock().unwrap_or_else(std::sync::PoisonError::into_inner);
                    all.tallies.iter_mut().zip(&found.tallies).for_each(|(all, own)| all.add(own));
                    all.bad.extend(found.bad);
                    all.bad.sort();
                    all.bad.truncate(MAX_KEPT);
                }
            });
        }
    });
    let _ = std::panic::take_hook();
    let Found { tallies, bad } = all.into_inner().unwrap_or_else(std::sync::PoisonError::into_inner);
    for (index, words) in &bad {
        std::fs::create_dir_all(&arguments.keep)?;
        let end = if Kind::of(*index, arguments.expressions) == Kind::Model { "toml" } else { "txt" };
        let path = arguments.keep.join(format!("{}-{index}.{end}", arguments.seed));
        std::fs::write(&path, text_of(*index))?;
        println!("{index}: {words}\n    kept as {}", path.display());
    }
    let seconds = began.elapsed().as_secs_f64();
    let total: u64 = tallies.iter().map(Tally::count).sum();
    println!(
        "{total} texts of seed {} in {seconds:.0} s, {:.0} a second{}",
        arguments.seed,
        total as f64 / seconds,
        most_memory().map_or(String::new(), |memory| format!(", in at most {memory} of memory"))
    );
    for (name, tally) in ["model files", "expressions"].iter().zip(&tallies) {
        if tally.count() > 0 {
            println!("{} {name}: {tally}", tally.count());
        }
    }
    Ok(bad.is_empty() && total == end - arguments.first)
}

/// Peak memory of the program, where the system reports it.
fn most_memory() -> Option<String> {
    let status = std::fs::read_to_string("/proc/self/status").ok()?;
    let most = status.lines().find_map(|line| line.strip_prefix("VmHWM:"))?;
    Some(most.split_whitespace().collect::<Vec<_>>().join(" "))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_seed_determines_the_text() {
        let originals = Originals::read().expect("the models are there");
        assert!(originals.models.len() > 20, "{}", originals.models.len());
        assert!(originals.expressions.len() > 20, "{}", originals.expressions.len());
        for kind in [Kind::Model, Kind::Expression] {
            assert_eq!(originals.damaged(kind, 2, 5), originals.damaged(kind, 2, 5));
            assert_ne!(originals.damaged(kind, 2, 5), originals.damaged(kind, 2, 6));
        }
        let kinds: Vec<Kind> = (0..4).map(|index| Kind::of(index, 2)).collect();
        assert_eq!(kinds, [Kind::Model, Kind::Expression, Kind::Expression, Kind::Model]);
        assert_eq!(Kind::of(1, 0), Kind::Model);
    }

    /// For a minute or an hour: `FUZZ_CASES`.
    #[test]
    fn damaged_texts_are_read_or_refused_with_their_place() {
        let cases = std::env::var("FUZZ_CASES").unwrap_or_else(|_| "3000".to_owned());
        let keep = std::env::temp_dir().join(format!("lissom-fuzz-{}", std::process::id()));
        for (expressions, seed) in [(0, 9), (100, 10)] {
            let (cases, keep) = (cases.clone(), keep.clone());
            let arguments =
                FuzzArguments { cases, expressions, seed, first: 0, threads: 2, text: false, keep };
            assert!(fuzz(&arguments).expect("texts are read"), "see what is printed");
        }
    }

    #[test]
    fn some_damaged_expressions_are_read_and_some_refused() {
        let originals = Originals::read().expect("the models are there");
        let mut tally = Tally::default();
        for index in 0..2000 {
            let text = originals.damaged(Kind::Expression, 3, index);
            assert_eq!(tally.note(Ok(answers::of_expression(&text, &BTreeMap::new()))), None, "{text}");
        }
        assert!(tally.read > 200 && tally.refused > 200, "{tally}");
    }

    #[test]
    fn panics_and_bad_answers_are_reported() {
        let mut tally = Tally::default();
        assert_eq!(tally.note(Ok(Answer::Badly("so".to_owned()))), Some("so".to_owned()));
        assert!(tally.note(Err(Box::new(()))).is_some());
        assert_eq!((tally.badly, tally.panicked, tally.count()), (1, 1, 2));
    }

    #[test]
    fn an_error_without_a_line_is_reported() {
        let registry = registry();
        assert_eq!(answers::of_model("lissom = ", &registry), Answer::Refused);
        assert_eq!(answers::of_model("", &registry), Answer::Refused);
    }
}
