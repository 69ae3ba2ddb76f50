//! Project tasks, such as `cargo xtask verify`. Independent of mechanics: it runs models and compares numbers.

mod ablate;
mod bench;
mod blade;
mod book;
mod case;
mod cases;
mod collisions;
mod compare;
mod contacts;
mod count;
mod curves;
mod defaults;
mod digits;
mod exact;
mod forces;
mod formula;
mod fuzz;
mod invariants;
mod laws;
mod loops;
mod mutants;
mod outcome;
mod peers;
mod pictures;
mod precision;
mod random;
mod reference;
mod refine;
mod report;
mod runs;
mod scenes;
mod stale;
mod structure;
mod subjects;
mod transform;
mod verify;
mod walls;
mod warnings;

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
    /// Run the verification cases and write docs/verification.md
    Verify(VerifyArguments),
    /// Write the scenes that speed is measured on to benches/scenes/
    Scenes(ScenesArguments),
    /// Count instructions of the inner loops and compare them with those kept
    Count(CountArguments),
    /// Perform the steps that are counted
    #[command(hide = true)]
    Steps {
        /// The scene
        name: String,
    },
    /// Print the memory of a scene in bytes
    #[command(hide = true)]
    Bytes {
        /// The scene
        name: String,
    },
    /// Run scenes without outputs and print where their time goes
    Bench(BenchArguments),
    /// Disable one feature of the nonlinear solver at a time and print the change of cost
    Ablate(AblateArguments),
    /// Run scenes, examples and random mechanisms with every scheme and tolerance, and print errors and costs
    Defaults(defaults::DefaultsArguments),
    /// Print work and error of adaptive steps, by scheme and tolerance
    Precision(precision::PrecisionArguments),
    /// Write the reference of the model file, and the types of its entries for models built in Rust and Python
    Reference {
        /// Write nothing; report whether it is out of date
        #[arg(long)]
        check: bool,
    },
    /// Try random mechanisms with several schemes and steps against each other
    Random(random::RandomArguments),
    /// Try random laws with narrow features, jumps and kinks against references that resolve them
    Laws(laws::LawsArguments),
    /// Try random collisions through springs between points against references that resolve them
    Collisions(cases::CaseArguments),
    /// Try random driven loops of redundant joints against closed forms
    Loops(cases::CaseArguments),
    /// Try random solids in contact, compliant and rigid: none may gain energy or penetrate
    Contacts(contacts::ContactsArguments),
    /// Try random models with exact results: solids at rest, seams, belts, friction of rotors, laws at rest
    Exact(cases::CaseArguments),
    /// Compare reactions and accelerations of random mechanisms with those of a finer solution
    Forces(forces::ForcesArguments),
    /// Read model files and expressions that are damaged by chance: each is read or rejected with its position
    Fuzz(fuzz::FuzzArguments),
    /// Mutation tests: change the code in one position at a time and report the changes that no test notices
    Mutants(mutants::MutantsArguments),
    /// Print the files of a crate that import each other in a cycle
    Structure {
        /// The crate
        #[arg(default_value = "lissom-core")]
        name: String,
    },
    /// Measure the claims of the source of the method and write them to docs/claims.md
    Claims,
    /// Make the pictures of examples in docs/images/ anew
    Pictures {
        /// Pictures to make, by their names without ending; all if none is given
        names: Vec<String>,
    },
    /// Make the tables and figures of the book in docs/ anew
    Figures(FiguresArguments),
}

/// Figures to generate.
#[derive(clap::Args)]
struct FiguresArguments {
    /// Figures to make, by the names in the chapters' markers; all if none is given
    names: Vec<String>,
    /// Also generate those that take minutes
    #[arg(long)]
    long: bool,
    /// Generate nothing; report broken links, markers without a generator, and an outdated copy of the report
    #[arg(long)]
    check: bool,
}

/// Files to write.
#[derive(clap::Args)]
struct ScenesArguments {
    /// Write the large scenes as well
    #[arg(long)]
    large: bool,
    /// Only print the names
    #[arg(long)]
    list: bool,
}

/// Use of the counts.
#[derive(clap::Args)]
struct CountArguments {
    /// Keep these counts
    #[arg(long)]
    update: bool,
}

/// Quantity to measure.
#[derive(clap::Args)]
struct BenchArguments {
    /// Scenes by name, such as `chain-s-1000`; those that are kept as files if none is given
    names: Vec<String>,
    /// Runs of each scene, of which the fastest counts
    #[arg(long, default_value_t = 3)]
    repeat: usize,
    /// Values to change, as in `--set analysis.scheme=radau-iia`
    #[arg(long)]
    set: Vec<String>,
    /// Compare the positions at the end with those of finer runs instead
    #[arg(long)]
    errors: bool,
    /// Measure chains and beams of all sizes instead, and draw `scale.svg` into this folder
    #[arg(long, value_name = "DIR")]
    scale: Option<PathBuf>,
    /// File for the table
    #[arg(long)]
    out: Option<PathBuf>,
}

impl BenchArguments {
    fn overrides(&self) -> Vec<lissom::Override> {
        let pair = |text: &String| {
            text.split_once('=').map(|(path, value)| (path.trim().to_owned(), value.trim().to_owned()))
        };
        self.set.iter().filter_map(pair).collect()
    }
}

/// Features to disable, and runs.
#[derive(clap::Args)]
struct AblateArguments {
    /// Parts of the names of models to run; all if none is given
    names: Vec<String>,
    /// Runs of each model, of which the fastest counts
    #[arg(long, default_value_t = 1)]
    repeat: usize,
    /// Random mechanisms to run beside
    #[arg(long, default_value_t = 0)]
    random: u64,
    /// Instead of switching off features halve and double each of their parameters
    #[arg(long)]
    numbers: bool,
}

/// Cases to verify.
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
    /// Cases that run at the same time
    #[arg(long, default_value_t = 2)]
    threads: usize,
    /// Print every row
    #[arg(long, short)]
    verbose: bool,
    /// Fail if the digits in `docs/verification.md` differ from those of these runs
    #[arg(long)]
    fresh: bool,
}

fn main() -> ExitCode {
    let outcome = match Arguments::parse().chore {
        Chore::Verify(arguments) => verify::verify(&arguments).map_err(|error| error.to_string()),
        Chore::Scenes(arguments) if arguments.list => {
            scenes::KEPT.iter().chain(scenes::LARGE).for_each(|name| println!("{name}"));
            Ok(true)
        }
        Chore::Scenes(arguments) => {
            bench::write(&verify::root(), arguments.large).map(|()| true).map_err(|error| error.to_string())
        }
        Chore::Count(arguments) => {
            count::count(&verify::root(), arguments.update).map_err(|error| error.to_string())
        }
        Chore::Structure { name } => {
            let sources = verify::root().join("crates").join(name).join("src");
            structure::run(&sources).map(|()| true).map_err(|error| error.to_string())
        }
        Chore::Bytes { name } => bench::print_bytes(&name).map(|()| true).map_err(|error| error.to_string()),
        Chore::Steps { name } => count::steps(&name).map(|()| true).map_err(|error| error.to_string()),
        Chore::Bench(arguments) => bench::bench(&arguments).map(|()| true).map_err(|error| error.to_string()),
        Chore::Ablate(arguments) => ablate::ablate(&arguments).map_err(|error| error.to_string()),
        Chore::Precision(arguments) => Ok(precision::precision(&arguments)),
        Chore::Defaults(arguments) => defaults::defaults(&arguments).map_err(|error| error.to_string()),
        Chore::Reference { check } => reference::reference(check).map_err(|error| error.to_string()),
        Chore::Random(arguments) => random::random(&arguments).map_err(|error| error.to_string()),
        Chore::Forces(arguments) => Ok(forces::forces(&arguments)),
        Chore::Contacts(arguments) => Ok(contacts::contacts(&arguments)),
        Chore::Exact(arguments) => Ok(exact::exact(&arguments)),
        Chore::Collisions(arguments) => Ok(collisions::collisions(&arguments)),
        Chore::Loops(arguments) => Ok(loops::loops(&arguments)),
        Chore::Laws(arguments) => laws::laws(&arguments).map_err(|error| error.to_string()),
        Chore::Fuzz(arguments) => fuzz::fuzz(&arguments).map_err(|error| error.to_string()),
        Chore::Mutants(arguments) => mutants::mutants(&arguments).map_err(|error| error.to_string()),
        Chore::Claims => book::claims().map_err(|error| error.to_string()),
        Chore::Pictures { names } => {
            pictures::pictures(&names).map(|()| true).map_err(|error| error.to_string())
        }
        Chore::Figures(arguments) => book::figures(&arguments).map_err(|error| error.to_string()),
    };
    match outcome {
        Ok(true) => ExitCode::SUCCESS,
        Ok(false) => ExitCode::FAILURE,
        Err(error) => {
            eprintln!("error: {error}");
            ExitCode::FAILURE
        }
    }
}
