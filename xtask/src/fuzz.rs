//! `cargo xtask fuzz`: model files that are damaged by chance, one after the other, through the reader. Each is read or refused with
//! a line; none breaks the program down. A seed and a number tell a case on every machine.

use std::panic::catch_unwind;
use std::path::PathBuf;
use std::sync::Mutex;
use std::sync::atomic::{AtomicU64, Ordering};
use std::time::Instant;

use lissom_model::Document;
use lissom_model::lower::registry::registry;
use lissom_model::registry::Registry;

#[path = "../../crates/lissom-model/tests/support/damage.rs"]
mod damage;

use crate::random::draw::Draw;
use crate::verify::root;
use damage::{Damage, STRANGERS, tokens};

/// What is tried.
#[derive(clap::Args)]
pub(crate) struct FuzzArguments {
    /// Texts to read, as in `1e6`
    #[arg(long, default_value = "1e5")]
    cases: String,
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

/// Tokens of the model files that are damaged: examples, and what the reader is tested with.
///
/// # Errors
/// If they cannot be read.
fn models() -> std::io::Result<Vec<Vec<String>>> {
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
    paths.iter().map(|path| std::fs::read_to_string(path).map(|text| tokens(&text))).collect()
}

/// The text of a case.
fn damaged(models: &[Vec<String>], seed: u64, index: u64) -> String {
    let mut draw = Draw::new(seed, index);
    let mut tokens = models[draw.below(models.len())].clone();
    for _ in 0..=draw.below(4) {
        let place = draw.below(tokens.len());
        match draw.below(6) {
            0 => Damage::Remove.apply(&mut tokens, place),
            1 => Damage::Double.apply(&mut tokens, place),
            2 => Damage::Swap(draw.below(tokens.len())).apply(&mut tokens, place),
            // A token of another model: names and kinds that exist, in the wrong place.
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

/// How a text is answered.
enum Answer {
    Read,
    Refused,
    Badly(String),
}

fn answer(text: &str, registry: &Registry) -> Answer {
    match Document::parse_with(text, "fuzz.toml", registry, &[]) {
        Ok(_) => Answer::Read,
        Err(report) if !report.has_errors() => Answer::Badly("refused without an error".to_owned()),
        Err(report) => {
            let told = report.to_value();
            let lines = text.lines().count().max(1) as u64 + 1;
            let has_line = |problem: &serde_json::Value| {
                problem["line"].as_u64().is_some_and(|line| (1..=lines).contains(&line))
            };
            match told.as_array() {
                Some(problems) if problems.iter().all(has_line) && !report.render(false).is_empty() => {
                    Answer::Refused
                }
                _ => Answer::Badly(format!("an error without a line: {told}")),
            }
        }
    }
}

/// Reads texts; whether all were answered well.
///
/// # Errors
/// If there is no number of cases, if the models cannot be read, or a text cannot be kept.
pub(crate) fn fuzz(arguments: &FuzzArguments) -> std::io::Result<bool> {
    let count: f64 = arguments.cases.parse().map_err(std::io::Error::other)?;
    let count = count.max(0.0) as u64;
    let models = models()?;
    if arguments.text {
        print!("{}", damaged(&models, arguments.seed, arguments.first));
        return Ok(true);
    }
    let began = Instant::now();
    let next = AtomicU64::new(arguments.first);
    let [read, refused] = [AtomicU64::new(0), AtomicU64::new(0)];
    let bad: Mutex<Vec<(u64, String)>> = Mutex::new(Vec::new());
    // A panic is a finding, and told as one.
    std::panic::set_hook(Box::new(|_| {}));
    std::thread::scope(|scope| {
        for _ in 0..arguments.threads.max(1) {
            scope.spawn(|| {
                let registry = registry();
                loop {
                    let index = next.fetch_add(1, Ordering::Relaxed);
                    if index >= arguments.first + count {
                        return;
                    }
                    let text = damaged(&models, arguments.seed, index);
                    let answered = catch_unwind(|| answer(&text, &registry));
                    let words = match answered {
                        Ok(Answer::Read) => {
                            read.fetch_add(1, Ordering::Relaxed);
                            continue;
                        }
                        Ok(Answer::Refused) => {
                            refused.fetch_add(1, Ordering::Relaxed);
                            continue;
                        }
                        Ok(Answer::Badly(words)) => words,
                        Err(_) => "the reader broke down".to_owned(),
                    };
                    if let Ok(mut bad) = bad.lock() {
                        bad.push((index, words));
                    }
                }
            });
        }
    });
    let _ = std::panic::take_hook();
    let mut bad = bad.into_inner().unwrap_or_default();
    bad.sort();
    for (index, words) in bad.iter().take(20) {
        std::fs::create_dir_all(&arguments.keep)?;
        let path = arguments.keep.join(format!("{}-{index}.toml", arguments.seed));
        std::fs::write(&path, damaged(&models, arguments.seed, *index))?;
        println!("{index}: {words}\n    kept as {}", path.display());
    }
    let seconds = began.elapsed().as_secs_f64();
    println!(
        "{count} texts of seed {} in {seconds:.0} s, {:.0} a second: {} read, {} refused with a line, {} answered badly",
        arguments.seed,
        count as f64 / seconds,
        read.into_inner(),
        refused.into_inner(),
        bad.len()
    );
    Ok(bad.is_empty())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_seed_tells_the_text() {
        let models = models().expect("the models are there");
        assert!(models.len() > 20, "{}", models.len());
        assert_eq!(damaged(&models, 2, 5), damaged(&models, 2, 5));
        assert_ne!(damaged(&models, 2, 5), damaged(&models, 2, 6));
    }

    /// For a minute or an hour: `FUZZ_CASES`.
    #[test]
    fn damaged_models_are_read_or_refused_with_a_line() {
        let cases = std::env::var("FUZZ_CASES").unwrap_or_else(|_| "3000".to_owned());
        let keep = std::env::temp_dir().join(format!("lissom-fuzz-{}", std::process::id()));
        let arguments = FuzzArguments { cases, seed: 9, first: 0, threads: 2, text: false, keep };
        assert!(fuzz(&arguments).expect("texts are read"), "see what is printed");
    }

    #[test]
    fn an_error_without_a_line_is_told() {
        let registry = registry();
        assert!(matches!(answer("lissom = ", &registry), Answer::Refused));
        assert!(matches!(answer("", &registry), Answer::Refused));
    }
}
