//! Chores of the project, as `cargo xtask verify`. Knows no mechanics: it runs models and compares numbers.

mod blade;
mod case;
mod compare;
mod curves;
mod formula;
mod invariants;
mod outcome;
mod readme;
mod refine;
mod report;
mod runs;
mod transform;
mod verify;

use std::path::PathBuf;
use std::process::ExitCode;

use clap::{Parser, Subcommand};

#[derive(Parser)]
#[command(name = "cargo xtask", about = "Chores of the project")]
struct Arguments {
    #[command(subcommand)]
    chore: Chore,
}

#[derive(Subcommand)]
enum Chore {
    /// Run the verification cases and write verification/REPORT.md
    Verify(VerifyArguments),
}

/// What is verified.
#[derive(clap::Args)]
struct VerifyArguments {
    /// Cases to run, by folder name; all if none is given
    names: Vec<String>,
    /// Run only the cases that call themselves quick
    #[arg(long)]
    quick: bool,
    /// Folder with data of third parties; cases that need it are skipped without it
    #[arg(long, env = "LISSOM_REFERENCES")]
    references: Option<PathBuf>,
    /// Rewrite the table between the markers in README.md
    #[arg(long)]
    readme: bool,
    /// Cases that run at the same time
    #[arg(long, default_value_t = 2)]
    threads: usize,
    /// Print every row
    #[arg(long, short)]
    verbose: bool,
}

fn main() -> ExitCode {
    let Chore::Verify(arguments) = Arguments::parse().chore;
    match verify::verify(&arguments) {
        Ok(true) => ExitCode::SUCCESS,
        Ok(false) => ExitCode::FAILURE,
        Err(error) => {
            eprintln!("error: {error}");
            ExitCode::FAILURE
        }
    }
}
