//! Signals that end a run: Ctrl-C, and what a system or a closing terminal sends.
//!
//! A signal sets the switch of the run and does nothing else, so nothing in its handler can fail. Telling is left to a
//! thread: where it cannot write (`2>&1 | tee log`, and the signal has ended `tee`), the run is saved all the same.

use super::INTERRUPTED;
use ne_core::StopSignal;
use signal_hook::{consts, flag};
use std::{ffi::c_int, io, thread, time::Duration};

/// How often the thread that tells looks at the switch.
const LOOK_EVERY: Duration = Duration::from_millis(20);

/// Makes a signal end the work after the generations under way; a second one, at once.
///
/// # Errors
/// If the system does not let a handler be set.
pub(super) fn stop_on_interrupt(signal: &StopSignal) -> io::Result<()> {
    for number in signals() {
        // In this order: the first signal finds the switch off.
        flag::register_conditional_shutdown(number, i32::from(INTERRUPTED), signal.switch())?;
        flag::register(number, signal.switch())?;
    }
    // A file that may not become larger is then told as an error of writing, as a full disk is.
    #[cfg(unix)]
    flag::register(consts::SIGXFSZ, std::sync::Arc::default())?;
    let signal = signal.clone();
    thread::Builder::new().name("interrupt".into()).spawn(move || {
        while !signal.is_set() {
            thread::sleep(LOOK_EVERY);
        }
        tell!("\nfinishing this generation, then saving; Ctrl-C once more to stop at once");
    })?;
    Ok(())
}

/// What ends a run.
#[cfg(not(unix))]
fn signals() -> Vec<c_int> {
    vec![consts::SIGINT, consts::SIGTERM]
}

/// What ends a run: a hang-up only where it would end the program, and `nohup` has not asked that it does not.
#[cfg(unix)]
fn signals() -> Vec<c_int> {
    let mut signals = vec![consts::SIGINT, consts::SIGTERM];
    if std::fs::read_to_string("/proc/self/status").is_ok_and(|status| !is_ignored(consts::SIGHUP, &status)) {
        signals.push(consts::SIGHUP);
    }
    signals
}

/// Whether the status that Linux gives of a process says that it ignores a signal.
#[cfg(unix)]
fn is_ignored(signal: c_int, status: &str) -> bool {
    let mask = status.lines().find_map(|line| line.strip_prefix("SigIgn:"));
    let mask = mask.and_then(|mask| u64::from_str_radix(mask.trim(), 16).ok());
    mask.is_some_and(|mask| mask >> (signal - 1) & 1 == 1)
}

#[cfg(all(test, unix))]
mod tests {
    use super::*;

    #[test]
    fn the_status_of_a_process_says_what_it_ignores() {
        let status = "Name:\tgambol\nSigBlk:\t0000000000000001\nSigIgn:\t0000000000001001\n";
        assert!(is_ignored(consts::SIGHUP, status));
        assert!(!is_ignored(consts::SIGTERM, status));
        assert!(!is_ignored(consts::SIGHUP, ""));
    }
}
