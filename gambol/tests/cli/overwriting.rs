//! Nothing that is on the disk is overwritten without being asked.

use crate::{
    folder::{assert_same_run, assert_untouched, contents},
    program::{assert_says, fail, gambol, long_run, run, small_run, start_and_read, succeed, text},
};
use std::fs;

type Outcome = Result<(), Box<dyn std::error::Error>>;

#[test]
fn train_refuses_the_folder_of_a_run_and_says_how_to_go_on_with_it() -> Outcome {
    let folder = tempfile::tempdir()?;
    let path = folder.path().join("run");
    succeed(&mut small_run(&path, 1));
    let before = contents(&path);
    let message = fail(&mut small_run(&path, 1));
    assert_says(&message, &[text(&path), "already exists", "--out", &format!("gambol resume {}", text(&path))]);
    assert_untouched(&path, &before);
    Ok(())
}

#[test]
fn train_refuses_a_folder_of_other_things_and_a_file() -> Outcome {
    let folder = tempfile::tempdir()?;
    fs::write(folder.path().join("diary.txt"), "dear diary")?;
    let before = contents(folder.path());
    for path in [folder.path(), &folder.path().join("diary.txt")] {
        let message = fail(&mut small_run(path, 1));
        assert_says(&message, &[text(path), "already exists", "--out"]);
        assert!(!message.contains("gambol resume"), "there is no run to go on with: {message}");
        assert_untouched(folder.path(), &before);
    }
    Ok(())
}

#[test]
fn train_takes_an_empty_folder() -> Outcome {
    let folder = tempfile::tempdir()?;
    succeed(&mut small_run(folder.path(), 1));
    Ok(())
}

#[test]
fn train_says_which_folder_it_cannot_make() -> Outcome {
    let folder = tempfile::tempdir()?;
    let file = folder.path().join("file");
    fs::write(&file, "")?;
    // The superuser may write where others may not, but not below a file, nor make processes by making folders.
    let mut places = vec![file.join("below")];
    places.extend(cfg!(target_os = "linux").then(|| "/proc/self/below/run".into()));
    for path in &places {
        assert_says(&fail(&mut small_run(path, 1)), &["cannot create the folder", text(path)]);
    }
    Ok(())
}

#[test]
fn replay_overwrites_only_by_force() -> Outcome {
    let folder = tempfile::tempdir()?;
    let path = folder.path().join("run");
    succeed(&mut small_run(&path, 1));
    let champion = path.join("champion.json");
    for option in ["--html", "--trajectory"] {
        let file = folder.path().join("mine");
        fs::write(&file, "precious")?;
        let replay = || {
            let mut replay = gambol("replay");
            replay.arg(&champion).arg(option).arg(&file);
            replay
        };
        assert_says(&fail(&mut replay()), &[text(&file), "exists", "--force"]);
        assert_eq!(fs::read_to_string(&file)?, "precious");
        succeed(replay().arg("--force"));
        assert_ne!(fs::read_to_string(&file)?, "precious");
    }
    Ok(())
}

#[test]
fn replay_to_one_file_twice_is_refused() -> Outcome {
    let folder = tempfile::tempdir()?;
    let path = folder.path().join("run");
    succeed(&mut small_run(&path, 1));
    let file = folder.path().join("both");
    let ended =
        run(gambol("replay").arg(path.join("champion.json")).arg("--html").arg(&file).arg("--trajectory").arg(&file));
    assert_eq!(ended.code, Some(1), "{}", ended.stdout);
    assert_says(&ended.stderr, &[text(&file)]);
    assert!(!file.exists());
    Ok(())
}

/// What is no regular file is not replaced, whichever command asks for it: a pipe stays a pipe, and a link leads where it led.
#[cfg(unix)]
#[test]
fn force_replaces_neither_pipes_nor_links() -> Outcome {
    let folder = tempfile::tempdir()?;
    let run = folder.path().join("run");
    succeed(&mut small_run(&run, 1));
    let champion = text(&run.join("champion.json")).to_owned();
    let (target, link, pipe) = (folder.path().join("target"), folder.path().join("link"), folder.path().join("pipe"));
    fs::write(&target, "precious")?;
    std::os::unix::fs::symlink(&target, &link)?;
    assert!(std::process::Command::new("mkfifo").arg(&pipe).status()?.success());
    let commands: [(&str, &[&str], &str); 6] = [
        ("replay", &[&champion, "--force"], "--html"),
        ("replay", &[&champion, "--force"], "--trajectory"),
        ("replay", &[&champion, "--force"], "--dot"),
        ("replay", &[&champion, "--force", "--point", "1"], "--save"),
        ("gait", &[&champion, "--force"], "--sheet"),
        ("film", &[&champion, "--force", "--seconds", "0.1"], "--out"),
    ];
    for (path, what) in [(&link, "a link"), (&pipe, "a named pipe")] {
        for (command, arguments, option) in commands {
            let message = fail(gambol(command).args(arguments).arg(option).arg(path));
            assert_says(&message, &["cannot write ", text(path), what, "only a regular file is replaced"]);
        }
    }
    assert_eq!((fs::read_to_string(&target)?, fs::read_link(&link)?), ("precious".into(), target));
    assert!(!fs::symlink_metadata(&pipe)?.is_file());
    // The files of a run are no exception.
    fs::remove_file(run.join("champion.json"))?;
    std::os::unix::fs::symlink(folder.path().join("target"), run.join("champion.json"))?;
    let message = fail(gambol("resume").arg(&run).args(["--generations", "2", "--no-report"]));
    assert_says(&message, &["cannot write ", "champion.json", "a link"]);
    assert_eq!(fs::read_to_string(folder.path().join("target"))?, "precious");
    Ok(())
}

/// Runs that begin at the same moment, without a folder of their own, have one each.
#[test]
fn runs_that_start_at_once_take_the_next_number() -> Outcome {
    let folder = tempfile::tempdir()?;
    let start = || {
        let mut train = gambol("train");
        train.args(["biped-1", "running", "--population", "4", "--set", "movement.steps=20", "--generations", "2"]);
        train.args(["--quiet", "--no-report"]).current_dir(folder.path());
        train.spawn()
    };
    let started = (0..6).map(|_| start()).collect::<Result<Vec<_>, _>>()?;
    for mut child in started {
        assert_eq!(child.wait()?.code(), Some(0));
    }
    let mut names: Vec<_> =
        fs::read_dir(folder.path().join("runs"))?.flatten().map(|entry| entry.file_name()).collect();
    names.sort();
    let expected = ["", "-2", "-3", "-4", "-5", "-6"].map(|number| format!("biped-1-running{number}"));
    assert_eq!(names, expected.map(std::ffi::OsString::from));
    Ok(())
}

/// A run that does not begin leaves no folder.
#[test]
fn a_run_that_is_refused_makes_no_folder() -> Outcome {
    let folder = tempfile::tempdir()?;
    fail(gambol("train").args(["biped-1", "running", "--population", "0"]).current_dir(folder.path()));
    fail(gambol("train").args(["biped-1", "running", "--from", "nowhere"]).current_dir(folder.path()));
    let runs = folder.path().join("runs");
    assert!(!runs.exists() || fs::read_dir(&runs)?.next().is_none());
    Ok(())
}

/// With the lock's file gone, the folder itself still says that somebody is at work.
#[cfg(unix)]
#[test]
fn a_deleted_lock_lets_nobody_in() -> Outcome {
    let folder = tempfile::tempdir()?;
    let (whole, path) = (folder.path().join("whole"), folder.path().join("run"));
    succeed(long_run(&whole).args(["--quiet", "--threads", "1"]));
    let (mut child, mut output) = start_and_read(long_run(&path).args(["--threads", "1"]), 3);
    fs::remove_file(path.join(".lock"))?;
    let message = fail(gambol("resume").arg(&path).arg("--no-report"));
    assert_says(&message, &["another gambol is at work in", text(&path)]);
    std::io::copy(&mut output, &mut std::io::sink())?;
    assert_eq!(child.wait()?.code(), Some(0));
    assert_same_run(&whole, &path);
    Ok(())
}

/// That no more files can be opened is no reason to say that there is a run.
#[cfg(unix)]
#[test]
fn too_many_open_files_are_not_told_as_a_run() -> Outcome {
    let folder = tempfile::tempdir()?;
    let mut seen = 0;
    for files in 3..12 {
        let path = folder.path().join(files.to_string());
        let mut command = std::process::Command::new("sh");
        let train = small_run(&path, 1);
        command.args(["-c", &format!("ulimit -n {files}; exec \"$@\""), "sh"]).arg(train.get_program());
        let ended = run(command.args(train.get_args()));
        assert!(!ended.stderr.contains("already exists"), "{files} files: {}", ended.stderr);
        seen += usize::from(ended.stderr.contains("Too many open files"));
    }
    assert!(seen > 0, "it never had too few");
    Ok(())
}
