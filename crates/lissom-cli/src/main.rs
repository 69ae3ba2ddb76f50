//! The program `lissom`. All is in the library, whose compilation need not wait for the libraries below it to be linked.

fn main() -> std::process::ExitCode {
    lissom_cli::main()
}
