//! The command line of Axiscope.

mod cli;

fn main() -> std::process::ExitCode {
    cli::main()
}
