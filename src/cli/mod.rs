//! The command line: one file a subcommand.

mod analyze;
mod annotate;
mod annotations;
mod bench;
mod evaluate;
mod options;
mod output;
mod peers;
#[cfg(feature = "window")]
mod picture_options;
mod progress;
#[cfg(feature = "window")]
mod render;
mod reproduce;
mod simulate;

use std::io::Write;
use std::process::ExitCode;

use clap::{CommandFactory, Parser, Subcommand};

use output::say;

/// Shows why a fruit's symmetry axis was found, or missed.
///
/// Axiscope implements the pose estimation of Li et al., Sensors 18 (2018) 3083: from a point cloud
/// of a fruit, seen by one depth camera, to its symmetry plane and axis.
#[derive(Debug, Parser)]
#[command(name = "axiscope", version, max_term_width = 100)]
struct Cli {
    /// Point clouds (PLY) or folders to open in the window [default: a bundled sample]
    #[cfg(feature = "window")]
    #[arg(value_name = "FILE|FOLDER")]
    paths: Vec<std::path::PathBuf>,
    /// Open the window in blind mode, in which an annotator sees nothing computed
    #[cfg(feature = "window")]
    #[arg(long)]
    blind: bool,
    /// Number of worker threads, which does not change results [default: all cores]
    #[arg(long, global = true, value_name = "N", value_parser = clap::value_parser!(u16).range(1..=1024))]
    threads: Option<u16>,
    #[command(subcommand)]
    command: Option<Command>,
}

#[derive(Debug, Subcommand)]
enum Command {
    /// Find the symmetry plane and axis of one cloud
    Analyze(Box<analyze::Analyze>),
    /// Draw the 3-D view of one cloud as a PNG, without a window
    #[cfg(feature = "window")]
    Render(Box<render::Render>),
    /// Make clouds whose axis is known
    Simulate(simulate::Simulate),
    /// Compare each cloud of a folder with its reference: a table, figures, and a report with the worst first
    Evaluate(Box<evaluate::Evaluate>),
    /// Set the true axis of one cloud by hand
    Annotate(Box<annotate::Annotate>),
    /// List the axes set by hand in a folder, and the agreement between annotators
    Annotations(annotations::Annotations),
    /// Repeat the paper's experiments and compare the results with the paper's
    Reproduce(reproduce::Reproduce),
    /// Measure the time of each stage, and of other programs if they are installed
    Bench(bench::Bench),
    /// Print a completion script for a shell
    Completions {
        /// The shell that the script is for
        shell: clap_complete::Shell,
    },
    /// Print the manual page (roff), to be read by `man -l -`
    Man,
}

/// Parses the command line and runs its command. Exit status: 0 for success, 1 if the input could not be used, 2 for
/// wrong usage.
pub(crate) fn main() -> ExitCode {
    let cli = Cli::parse();
    match run(cli) {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) if is_broken_pipe(&error) => ExitCode::SUCCESS,
        Err(error) if error.is::<clap::Error>() => {
            output::say_line(format_args!("{}", format!("{error:#}").trim_end()));
            ExitCode::from(2)
        }
        Err(error) => {
            say!("axiscope: {error:#}");
            ExitCode::FAILURE
        }
    }
}

fn run(cli: Cli) -> anyhow::Result<()> {
    match cli.threads {
        Some(threads) => use_threads(threads.into())?,
        None => start_threads(),
    }
    #[cfg(feature = "window")]
    if let (Some(_), Some(path)) = (&cli.command, cli.paths.first()) {
        return Err(usage_error(&format!(
            "“{}” stands before the command: name clouds after it",
            path.display()
        )));
    }
    #[cfg(feature = "window")]
    if cli.command.is_some() && cli.blind {
        return Err(usage_error("“--blind” before a command is of the window alone"));
    }
    let Some(command) = cli.command else {
        #[cfg(feature = "window")]
        return open_window(cli.paths, cli.blind);
        #[cfg(not(feature = "window"))]
        return Err(usage_error(
            "this build has no window; `axiscope --help` lists the commands",
        ));
    };
    match command {
        Command::Analyze(analyze) => analyze::run(&analyze),
        #[cfg(feature = "window")]
        Command::Render(render) => render::run(&render, std::env::args_os(), parse_render),
        Command::Simulate(simulate) => simulate::run(&simulate),
        Command::Evaluate(evaluate) => evaluate::run(&evaluate),
        Command::Annotate(annotate) => annotate::run(&annotate),
        Command::Annotations(annotations) => annotations::run(&annotations),
        Command::Reproduce(reproduce) => reproduce::run(&reproduce),
        Command::Bench(bench) => bench::run(&bench),
        Command::Completions { shell } => {
            let mut script = Vec::new();
            clap_complete::generate(shell, &mut Cli::command(), "axiscope", &mut script);
            Ok(std::io::stdout().write_all(&script)?)
        }
        Command::Man => {
            let mut page = Vec::new();
            manual(&mut page)?;
            Ok(std::io::stdout().write_all(&page)?)
        }
    }
}

/// Opens the window with the files and folders at `paths`.
///
/// A path that does not exist is an error in the terminal instead of a message in the window, since it may be a
/// mistyped command.
#[cfg(feature = "window")]
fn open_window(paths: Vec<std::path::PathBuf>, is_blind: bool) -> anyhow::Result<()> {
    if let Some(missing) = paths.iter().find(|path| !path.exists()) {
        // A single word without an extension was most likely meant as a command.
        if missing.extension().is_none() && missing.components().count() == 1 {
            return Err(usage_error(&format!(
                "there is no command “{}”, nor a file or folder of that name; `axiscope --help` lists the commands",
                missing.display()
            )));
        }
        anyhow::bail!("{}: there is no such file or folder", missing.display());
    }
    Ok(axiscope::ui::open_window(paths, is_blind)?)
}

/// Parses a command line that a picture carries; `None` if it is not one of `render`'s.
#[cfg(feature = "window")]
fn parse_render(arguments: &[String]) -> Option<render::Render> {
    match Cli::try_parse_from(arguments).ok()?.command? {
        Command::Render(render) => Some(*render),
        _ => None,
    }
}

/// Writes the program's manual page, followed by those of its subcommands, as one document.
fn manual(page: &mut Vec<u8>) -> std::io::Result<()> {
    let mut command = Cli::command();
    command.build();
    clap_mangen::Man::new(command.clone()).render(page)?;
    for sub in command.get_subcommands().filter(|s| s.get_name() != "help") {
        let name = format!("axiscope {}", sub.get_name());
        let sub = sub.clone().name(name);
        let man = clap_mangen::Man::new(sub);
        man.render_name_section(page)?;
        man.render_synopsis_section(page)?;
        man.render_description_section(page)?;
        man.render_options_section(page)?;
    }
    Ok(())
}

/// Starts the worker threads, so that they are running by the time the file has been read.
fn start_threads() {
    // The first parallel stage reports a failure to start them.
    #[cfg(feature = "parallel")]
    let _ = rayon::ThreadPoolBuilder::new().build_global();
}

/// Limits the worker threads.
#[cfg(feature = "parallel")]
fn use_threads(threads: usize) -> anyhow::Result<()> {
    Ok(rayon::ThreadPoolBuilder::new()
        .num_threads(threads)
        .build_global()?)
}

#[cfg(not(feature = "parallel"))]
fn use_threads(threads: usize) -> anyhow::Result<()> {
    anyhow::ensure!(
        threads == 1,
        "this build runs on one thread: it lacks the feature `parallel`"
    );
    Ok(())
}

/// Returns an error in the use of the command line that shows only after parsing; it ends the program with status 2.
fn usage_error(message: &str) -> anyhow::Error {
    clap::Error::raw(clap::error::ErrorKind::ValueValidation, format!("{message}\n")).into()
}

/// Whether the reader of standard output has closed it, as `head` does, which is no failure.
fn is_broken_pipe(error: &anyhow::Error) -> bool {
    let io = error.downcast_ref::<std::io::Error>();
    io.is_some_and(|e| e.kind() == std::io::ErrorKind::BrokenPipe)
}
