//! Giving inputs to a reader, and looking at what it does.

use crate::{corpus, damage::damaged, readers::Reader};
use gambol::Registry;
use ne_core::{Purpose, Seed};
use rand::RngExt;
use std::{
    env, fs,
    panic::{AssertUnwindSafe, catch_unwind},
    path::PathBuf,
    process,
    sync::{
        Arc, Mutex,
        atomic::{AtomicBool, Ordering},
    },
    thread,
    time::{Duration, Instant},
};

/// No input may take longer.
const LONGEST: Duration = Duration::from_secs(5);
/// Nor may the process need more memory, kB.
const MOST_MEMORY: u64 = 500_000;

const CHANCE: Purpose = Purpose::new("fuzz");

/// How long a reader is fuzzed.
#[derive(Clone, Copy)]
pub(crate) struct Limits {
    seconds: f64,
    inputs: u64,
    seed: u64,
}

impl Limits {
    pub(crate) fn from_environment() -> Self {
        let number = |name: &str| env::var(name).ok()?.parse::<u64>().ok();
        let inputs = number("GAMBOL_FUZZ_INPUTS");
        let seconds = number("GAMBOL_FUZZ_SECONDS").map(|seconds| seconds as f64);
        let seconds = seconds.unwrap_or(if inputs.is_some() { f64::INFINITY } else { 2.0 });
        let seed = number("GAMBOL_FUZZ_SEED").unwrap_or(1);
        Self { seconds, inputs: inputs.unwrap_or(u64::MAX), seed }
    }
}

/// The files of the corpus are no errors: one that is does not lead deep into its reader.
pub(crate) fn read_corpus(reader: &Reader) -> Result<(), String> {
    let (folder, registry) = (tempfile::tempdir().map_err(|error| error.to_string())?, Registry::default());
    let files = corpus::files(reader.name)?;
    for (name, bytes) in &files {
        let path = folder.path().join("input");
        fs::write(&path, bytes).map_err(|error| error.to_string())?;
        let read = (reader.read)(&path, name, &registry);
        read.map_err(|error| format!("{name}: {error}; GAMBOL_WRITE_CORPUS=1 writes the corpus anew"))?;
    }
    if files.is_empty() { Err(format!("there are no {} in the corpus", reader.name)) } else { Ok(()) }
}

/// An input, and when its reader was given it.
type UnderWay = Arc<Mutex<Option<(Instant, Vec<u8>)>>>;

/// Gives damaged files to a reader until a limit is met.
///
/// # Errors
/// If it panics or needs too much memory. One that hangs ends the process.
#[expect(clippy::print_stdout, reason = "how many inputs there were is a figure to know")]
pub(crate) fn fuzz(reader: &'static Reader, limits: Limits) -> Result<(), String> {
    let files = corpus::files(reader.name)?;
    let (folder, registry) = (tempfile::tempdir().map_err(|error| error.to_string())?, Registry::default());
    let (under_way, done) = (UnderWay::default(), Arc::new(AtomicBool::new(false)));
    let watch = watch(reader.name, under_way.clone(), done.clone());
    let began = Instant::now();
    let (mut inputs, mut accepted, mut slowest, mut outcome) = (0, 0_u64, Duration::ZERO, Ok(()));
    while inputs < limits.inputs && began.elapsed().as_secs_f64() < limits.seconds && outcome.is_ok() {
        let mut chance = Seed::of_run(limits.seed).generation(inputs + 1).stream(CHANCE);
        let [one, other] = [0, 1].map(|_| &files[chance.random_range(0..files.len())]);
        let bytes = damaged(&one.1, &other.1, reader.has_lines, &mut chance);
        let path = folder.path().join("input");
        fs::write(&path, &bytes).map_err(|error| error.to_string())?;
        let start = Instant::now();
        if let Ok(mut under_way) = under_way.lock() {
            *under_way = Some((start, bytes));
        }
        let read = catch_unwind(AssertUnwindSafe(|| (reader.read)(&path, &one.0, &registry).is_ok()));
        slowest = slowest.max(start.elapsed());
        let bytes = under_way.lock().ok().and_then(|mut under_way| under_way.take());
        match read {
            Ok(read) => accepted += u64::from(read),
            Err(_) => outcome = Err(format!("a panic; the input is in {}", save(reader.name, &bytes).display())),
        }
        inputs += 1;
        if inputs % 256 == 0 && most_memory().is_some_and(|kilobytes| kilobytes > MOST_MEMORY) {
            let place = save(reader.name, &bytes);
            outcome = Err(format!("more than {MOST_MEMORY} kB of memory, by now with {}", place.display()));
        }
    }
    done.store(true, Ordering::Relaxed);
    let _ = watch.join();
    let (seconds, slowest) = (began.elapsed().as_secs_f64(), slowest.as_secs_f64());
    let memory = most_memory().unwrap_or(0) / 1000;
    let name = reader.name;
    println!(
        "{name}: {inputs} inputs in {seconds:.1} s, {accepted} accepted, slowest {slowest:.3} s, {memory} MB at most"
    );
    outcome
}

/// Ends the process if an input takes too long: a thread that hangs cannot be ended otherwise.
#[expect(clippy::print_stderr, reason = "the process ends here, and no other code can say it")]
fn watch(name: &'static str, under_way: UnderWay, done: Arc<AtomicBool>) -> thread::JoinHandle<()> {
    thread::spawn(move || {
        while !done.load(Ordering::Relaxed) {
            thread::sleep(Duration::from_millis(100));
            let hangs = |(start, _): &(Instant, Vec<u8>)| start.elapsed() > LONGEST;
            let stuck = under_way.lock().ok().and_then(|input| input.clone().filter(hangs));
            if stuck.is_some() {
                eprintln!("{name}: more than {LONGEST:?}; the input is in {}", save(name, &stuck).display());
                process::exit(1);
            }
        }
    })
}

fn save(name: &str, input: &Option<(Instant, Vec<u8>)>) -> PathBuf {
    let path = env::temp_dir().join(format!("gambol-fuzz-{name}-{}", process::id()));
    let _ = fs::write(&path, input.as_ref().map_or(&[][..], |(_, bytes)| bytes));
    path
}

/// The most memory this process has needed, kB, where the system tells.
fn most_memory() -> Option<u64> {
    let status = fs::read_to_string("/proc/self/status").ok()?;
    let line = status.lines().find_map(|line| line.strip_prefix("VmHWM:"))?;
    line.split_whitespace().next()?.parse().ok()
}
