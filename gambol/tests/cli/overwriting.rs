//! Nothing that is on the disk is overwritten without being asked.

use crate::{
    folder::{assert_untouched, contents},
    program::{assert_says, fail, gambol, run, small_run, succeed, text},
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
