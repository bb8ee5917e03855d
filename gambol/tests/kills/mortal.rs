//! The program, which dies at a given write.

use ne_core::write_points::{WritePoint, observe};
use std::{
    env,
    io::Write,
    path::Path,
    process::{self, Command, ExitCode, Stdio},
    sync::atomic::{AtomicUsize, Ordering},
};

/// The variable that says at which write, from 1; 0: at none.
const FATE: &str = "GAMBOL_DIES_AT";

/// The exit code of one that has died.
pub(crate) const DEAD: i32 = 86;

/// At which write this process is to die, if it is the program.
pub(crate) fn fate() -> Option<usize> {
    env::var(FATE).ok()?.parse().ok()
}

/// Is the program, until that write; one that is to die at none tells how many it had.
#[expect(clippy::print_stdout, reason = "it tells the test")]
pub(crate) fn live(fate: usize) -> ExitCode {
    static WRITES: AtomicUsize = AtomicUsize::new(0);
    observe(move |point| {
        if WRITES.fetch_add(1, Ordering::SeqCst) + 1 == fate {
            if let WritePoint::Append { mut file, line, .. } = point {
                let _ = file.write_all(&line[..line.len() / 2]);
            }
            // Nothing is tidied up: no destructor runs.
            process::exit(DEAD);
        }
    });
    let code = gambol::program(&gambol::Registry::default());
    if fate == 0 {
        println!("{}", WRITES.load(Ordering::SeqCst));
    }
    code
}

/// The program in this folder, to die at this write; 0: at none.
pub(crate) fn program(fate: usize, folder: &Path, arguments: &[&str]) -> Command {
    let mut program = Command::new(env::current_exe().expect("a path"));
    program.args(arguments).env(FATE, fate.to_string()).env_remove("GAMBOL_LOG").current_dir(folder);
    program.stdin(Stdio::null());
    program
}
