//! The commands of the program: each is a file.
#![allow(clippy::print_stdout, clippy::print_stderr)]

#[macro_use]
mod terminal;

mod balance;
mod bench;
mod bench_gaits;
mod bench_training;
mod check;
mod compare;
mod export;
mod film;
mod gait;
mod gait_text;
mod interrupt;
mod list;
mod progress;
mod replay;
mod report;
mod reproduce;
mod resume;
mod robust;
mod studio;
mod train;
mod tune;
mod verify;

use crate::{Registry, program_name, set_program_name};
use clap::{Arg, CommandFactory, FromArgMatches, Parser, Subcommand, builder::RangedU64ValueParser};
use ne_core::{Parallel, archive};
use std::{error::Error, io, path::Path, process::ExitCode};

/// What a command gives back: an exit code, or an error to be shown.
type Outcome = Result<ExitCode, Box<dyn Error>>;

/// The exit code of `verify` when the replay is not what the file says.
const DIVERGED: u8 = 3;
/// The exit code of `gait` when the gait is not usable, and of a run that was to end with a usable one and did not.
const NOT_USABLE: u8 = 3;
/// The exit code of `compare`, `tune` and `reproduce` while other processes are at work on some of the runs.
const NOT_YET: u8 = 4;
/// The exit code of a run that was interrupted and saved, as shells have it for Ctrl-C.
const INTERRUPTED: u8 = 130;

/// A number of threads or of runs at the same time, from `least` on.
fn thread_count(least: u64) -> RangedU64ValueParser<usize> {
    RangedU64ValueParser::new().range(least..=Parallel::MOST_THREADS as u64)
}

/// The `gambol` program, with everything that a registry adds to it: reads the command line, does what it says, and tells how
/// it went on the standard streams. It is `main` for a program with movements of its own; all commands know them.
///
/// Call it once, at the start: it sets up logging.
pub fn program(registry: &Registry) -> ExitCode {
    let log = tracing_subscriber::EnvFilter::try_from_env("GAMBOL_LOG").unwrap_or_else(|_| "warn".into());
    // A program that logs already goes on as it does.
    let closing = tracing_subscriber::fmt::format::FmtSpan::CLOSE;
    let lines = tracing_subscriber::fmt().with_env_filter(log).with_span_events(closing).with_writer(io::stderr);
    // A line that cannot be written is lost; telling so would have to write it.
    let _ = lines.log_internal_errors(false).try_init();
    set_program_name(&name_of_process());
    let command = named(Program::command(), program_name()).name(program_name());
    // clap has checked the command line; what it gives it can read.
    let program = Program::from_arg_matches(&command.get_matches());
    if let Err(error) = registry.check() {
        tell!("error: {error}");
        return ExitCode::FAILURE;
    }
    match program.unwrap_or_else(|error| error.exit()).command.run(registry) {
        Ok(code) => code,
        // What reads our output has seen enough.
        Err(error)
            if error.downcast_ref::<io::Error>().is_some_and(|error| error.kind() == io::ErrorKind::BrokenPipe) =>
        {
            ExitCode::SUCCESS
        }
        Err(error) => {
            tell!("error: {error}");
            ExitCode::FAILURE
        }
    }
}

/// What this program is called: the name of its file.
fn name_of_process() -> String {
    let path = std::env::args_os().next().map(std::path::PathBuf::from);
    let name = path.as_deref().and_then(Path::file_stem).and_then(std::ffi::OsStr::to_str);
    name.unwrap_or("gambol").to_owned()
}

/// A command whose help has the program's name in its examples.
fn named(command: clap::Command, name: &str) -> clap::Command {
    let examples = command.get_after_help().map(|help| help.to_string().replace("gambol ", &format!("{name} ")));
    let command = match examples {
        Some(examples) => command.after_help(examples),
        None => command,
    };
    // Whether a number may be negative its range says, and clap's tip of `--` would not help.
    let number = |arg: Arg| if arg.get_action().takes_values() { arg.allow_negative_numbers(true) } else { arg };
    command.mut_args(number).mut_subcommands(|command| named(command, name))
}

/// ` in 3 bodies`, where there are several.
fn in_bodies(bodies: usize) -> String {
    if bodies > 1 { format!(" in {bodies} bodies") } else { String::new() }
}

/// Gambol evolves controllers for 2D creatures: pick a creature and a movement, watch it learn, keep the gait.
#[derive(Parser)]
#[command(
    version,
    propagate_version = true,
    after_help = "\
Examples:
  gambol studio                            draw, train, watch and play in the browser
  gambol train biped-1 running             train a shipped creature, into runs/biped-1-running
  gambol train my-creature.json jumping    train a creature of your own
  gambol resume runs/biped-1-running --generations 600
  gambol verify runs/biped-1-running/champion.json

Exit codes:
  0    done
  1    something was wrong: the message says which file and which field
  2    the command line was not understood
  3    verify: the replay is not what the champion file says; gait: the gait is not usable;
       train and resume with --until usable: no usable gait was found
  4    compare, tune and reproduce: other processes are still at work on some of the runs
  130  a run was interrupted (Ctrl-C, SIGTERM, SIGHUP); it is saved and can be resumed

Set GAMBOL_LOG=debug to see what the libraries do, and how long each generation, evaluation, re-evaluation, \
checkpoint and report takes."
)]
struct Program {
    #[command(subcommand)]
    command: Command,
}

/// Checks that a file may be written to a path of the user's: nothing is overwritten unasked, and what is no regular file
/// (a device, a pipe, a link) never is.
fn check_output(path: &Path, force: bool) -> Result<(), String> {
    let shown = path.display();
    if path.as_os_str().as_encoded_bytes().ends_with(b"/") {
        return Err(format!("cannot write {shown}: that is the name of a folder; name a file"));
    }
    archive::check_replaceable(path).map_err(|error| format!("cannot write {shown}: {error}; name another file"))?;
    if path.exists() && !force {
        return Err(format!("{shown} exists; say --force to overwrite it"));
    }
    match path.parent().filter(|folder| !folder.as_os_str().is_empty() && !folder.is_dir()) {
        Some(folder) => Err(format!("cannot write {shown}: there is no folder {}", folder.display())),
        None => Ok(()),
    }
}

/// Checks that what is read more than once is no pipe.
#[cfg(unix)]
fn check_input(path: &Path) -> Result<(), String> {
    use std::os::unix::fs::FileTypeExt;
    let is_pipe = path.metadata().is_ok_and(|metadata| metadata.file_type().is_fifo());
    if is_pipe { Err(format!("{} is a pipe, and is read more than once: give a file", path.display())) } else { Ok(()) }
}

/// Checks that what is read more than once is no pipe.
#[cfg(not(unix))]
fn check_input(_: &Path) -> Result<(), String> {
    Ok(())
}

/// Checks that an image is not called what it is not.
fn check_ending(path: &Path) -> Result<(), String> {
    match path.extension().is_some_and(|ending| ending.eq_ignore_ascii_case("png")) {
        true => Ok(()),
        false => Err(format!("{} must end in .png: the image is one", path.display())),
    }
}

/// Writes a file to a path that was checked before it was known what to write: whatever has come there since is not overwritten
/// unasked either.
fn write_output(path: &Path, bytes: &[u8], force: bool) -> Result<(), String> {
    check_output(path, force)?;
    archive::write_whole(path, bytes).map_err(|error| format!("cannot write {}: {error}", path.display()))
}

#[derive(Subcommand)]
enum Command {
    /// Evolves a controller for a creature and a movement
    Train(Box<train::Train>),
    /// Goes on with a run from its last checkpoint
    Resume(resume::Resume),
    /// Makes the HTML report of a run anew
    Report(report::Report),
    /// Replays a champion and proves that it does what its file says, to the bit
    Verify(verify::Verify),
    /// Replays a champion: as a page, as a trajectory
    Replay(replay::Replay),
    /// Writes a champion as a file for games and other programs
    Export(export::Export),
    /// Films gaits side by side, as an animated image
    Film(film::Film),
    /// Measures a gait, says whether it is usable, and why not
    Gait(gait::Gait),
    /// Replays a champion in perturbed worlds: how often it stays usable, how much of its fitness it keeps
    Robust(robust::Robust),
    /// Checks a creature, configuration or champion file and says what is wrong where
    Check(check::Check),
    /// Compares strategies on creatures and movements: same seeds, same budget, statistics
    Compare(compare::Compare),
    /// Looks for better settings of a strategy, by random search on seeds of its own
    Tune(tune::Tune),
    /// Puts the parts of a comparison together
    Merge(compare::Merge),
    /// Does the experiments of the thesis again, and shows them beside what it reports
    Reproduce(reproduce::Reproduce),
    /// Measures strategies, the time of training, and how many gaits become usable
    Bench(bench::Bench),
    /// Opens the studio: draw, train, watch, play, in the browser
    Studio(studio::Studio),
    /// Lists the creatures that have a name
    Creatures(list::Creatures),
    /// Lists the movements and the terms that can be added to them
    Movements(list::Movements),
    /// Lists the terrains that can be asked for by name
    Terrains(list::Terrains),
    /// Lists the variations of the world that can be asked for by name
    Variations(list::Variations),
    /// Lists the strategies: ways to search
    Strategies(list::Strategies),
    /// Lists the presets: named starting points of a configuration
    Presets(list::Presets),
    /// Lists the sensors: what a net can be told
    Sensors(list::Sensors),
}

impl Command {
    fn run(self, registry: &Registry) -> Outcome {
        match self {
            Self::Train(train) => train.run(registry),
            Self::Resume(resume) => resume.run(registry),
            Self::Report(report) => report.run(registry),
            Self::Verify(verify) => verify.run(registry),
            Self::Replay(replay) => replay.run(registry),
            Self::Export(export) => export.run(registry),
            Self::Film(film) => film.run(registry),
            Self::Gait(gait) => gait.run(registry),
            Self::Robust(robust) => robust.run(registry),
            Self::Check(check) => check.run(registry),
            Self::Compare(compare) => compare.run(registry),
            Self::Tune(tune) => tune.run(registry),
            Self::Merge(merge) => merge.run(),
            Self::Reproduce(reproduce) => reproduce.run(registry),
            Self::Bench(bench) => bench.run(registry),
            Self::Studio(studio) => studio.run(registry),
            Self::Creatures(creatures) => creatures.run(registry),
            Self::Movements(movements) => movements.run(registry),
            Self::Terrains(terrains) => terrains.run(registry),
            Self::Variations(variations) => variations.run(registry),
            Self::Strategies(strategies) => strategies.run(registry),
            Self::Presets(presets) => presets.run(registry),
            Self::Sensors(sensors) => sensors.run(registry),
        }
    }
}

/// A first seed: so that neither it nor the seeds after it leave the range of numbers.
fn first_seed() -> clap::builder::RangedU64ValueParser<u64> {
    clap::value_parser!(u64).range(..=1_000_000_000_000)
}
