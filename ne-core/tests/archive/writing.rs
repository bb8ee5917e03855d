use crate::{content, read, write};
use ne_core::archive::{ArchiveError, Layout, write_whole, write_whole_together};
use std::{fs, path::Path};

type Outcome = Result<(), Box<dyn std::error::Error>>;

#[test]
fn what_is_written_is_read() -> Outcome {
    let folder = tempfile::tempdir()?;
    for layout in [Layout::Compact, Layout::Pretty] {
        let path = folder.path().join("file");
        write(&path, layout)?;
        assert_eq!(read(&path)?, content());
        assert!(fs::read_to_string(&path)?.ends_with("}\n"));
    }
    Ok(())
}

#[test]
fn an_unwritable_place_is_an_error_that_names_it() -> Outcome {
    let folder = tempfile::tempdir()?;
    let file = folder.path().join("file");
    fs::write(&file, "not a folder")?;
    let occupied = folder.path().join("occupied");
    fs::create_dir(&occupied)?;
    for path in [folder.path().join("missing").join("x"), file.join("x"), occupied] {
        let error = write(&path, Layout::Compact).expect_err("nothing can be written there");
        assert!(matches!(error, ArchiveError::Write { .. }), "{error}");
        assert!(error.to_string().starts_with(&format!("cannot write {}: ", path.display())), "{error}");
    }
    assert_eq!(fs::read_to_string(&file)?, "not a folder");
    Ok(())
}

#[cfg(unix)]
#[test]
fn a_folder_without_permission_keeps_its_old_file() -> Outcome {
    use std::os::unix::fs::PermissionsExt;
    let folder = tempfile::tempdir()?;
    let path = folder.path().join("file");
    fs::write(&path, "old")?;
    fs::set_permissions(folder.path(), fs::Permissions::from_mode(0o555))?;
    // The superuser may write everywhere; then there is nothing to see.
    let superuser = fs::write(folder.path().join("probe"), "").is_ok();
    let result = write(&path, Layout::Compact);
    fs::set_permissions(folder.path(), fs::Permissions::from_mode(0o755))?;
    if !superuser {
        assert!(matches!(result, Err(ArchiveError::Write { .. })), "{result:?}");
        assert_eq!(fs::read_to_string(&path)?, "old");
    }
    Ok(())
}

#[test]
fn a_missing_file_is_an_error_that_names_it() {
    let error = read(Path::new("no/such/file")).expect_err("there is none");
    assert!(matches!(error, ArchiveError::Read { .. }), "{error}");
    assert!(error.to_string().starts_with("cannot read no/such/file: "), "{error}");
}

/// What cannot be written as JSON leaves the old file in its place.
#[test]
fn a_failed_write_leaves_the_old_file_and_no_other() -> Outcome {
    let folder = tempfile::tempdir()?;
    let path = folder.path().join("file");
    write(&path, Layout::Compact)?;
    let keyed_by_pairs = std::collections::BTreeMap::from([((1, 2), 3)]);
    let result = ne_core::archive::write(&path, "x", 1, &keyed_by_pairs, Layout::Compact);
    assert!(matches!(result, Err(ArchiveError::Write { .. })), "{result:?}");
    assert_eq!(read(&path)?, content());
    fs::create_dir(folder.path().join("occupied"))?;
    assert!(write_whole(&folder.path().join("occupied"), b"new").is_err());
    assert_eq!(fs::read_dir(folder.path())?.count(), 2, "a temporary file is left");
    Ok(())
}

#[test]
fn a_write_replaces_the_old_file() -> Outcome {
    let folder = tempfile::tempdir()?;
    let path = folder.path().join("file");
    write_whole(&path, b"a long old text")?;
    write_whole(&path, b"new")?;
    assert_eq!(fs::read(&path)?, b"new");
    Ok(())
}

#[test]
fn files_that_belong_together_are_all_written_or_none() -> Outcome {
    let folder = tempfile::tempdir()?;
    let path = |name: &str| folder.path().join(name);
    fs::write(path("one"), "old")?;
    let (one, two, nowhere) = (path("one"), path("two"), path("no/where"));
    let error = write_whole_together(&[(&one, b"new"), (&two, b"new"), (&nowhere, b"new")]);
    let error = error.expect_err("there is no such folder").to_string();
    assert!(error.starts_with(&format!("{}: ", nowhere.display())), "{error}");
    assert_eq!(fs::read_to_string(&one)?, "old");
    assert_eq!(fs::read_dir(folder.path())?.count(), 1, "no other file, and nothing temporary");
    write_whole_together(&[(&one, b"new"), (&two, b"too")])?;
    assert_eq!((fs::read_to_string(&one)?, fs::read_to_string(&two)?), ("new".into(), "too".into()));
    assert_eq!(fs::read_dir(folder.path())?.count(), 2);
    Ok(())
}

/// Temporary files are private, results are not: others may read them if the user's umask lets them.
#[cfg(unix)]
#[test]
fn a_file_has_the_permissions_of_any_other_file() -> Outcome {
    use std::os::unix::fs::PermissionsExt;
    let folder = tempfile::tempdir()?;
    let (plain, whole) = (folder.path().join("plain"), folder.path().join("whole"));
    fs::write(&plain, "")?;
    write_whole(&whole, b"")?;
    assert_eq!(fs::metadata(&whole)?.permissions().mode(), fs::metadata(&plain)?.permissions().mode());
    Ok(())
}

/// A device, a pipe or a link has its own purpose: what it leads to is not ours to replace.
#[cfg(unix)]
#[test]
fn only_a_regular_file_is_replaced() -> Outcome {
    let folder = tempfile::tempdir()?;
    let path = |name: &str| folder.path().join(name);
    fs::write(path("file"), "old")?;
    std::os::unix::fs::symlink(path("file"), path("link"))?;
    std::os::unix::fs::symlink(path("nowhere"), path("dangling link"))?;
    fs::create_dir(path("folder"))?;
    assert!(std::process::Command::new("mkfifo").arg(path("pipe")).status()?.success());
    for (name, what) in
        [("link", "a link"), ("dangling link", "a link"), ("folder", "a folder"), ("pipe", "a named pipe")]
    {
        let before = fs::symlink_metadata(path(name))?.file_type();
        let error = write_whole(&path(name), b"new").expect_err("it is no regular file").to_string();
        assert_eq!(error, format!("it is {what}, and only a regular file is replaced"));
        assert_eq!(fs::symlink_metadata(path(name))?.file_type(), before);
    }
    assert_eq!(fs::read_to_string(path("file"))?, "old");
    assert!(!path("nowhere").exists());
    Ok(())
}

#[test]
fn what_a_killed_writer_left_is_cleared_away_by_the_next_and_that_of_a_living_one_stays() -> Outcome {
    let folder = tempfile::tempdir()?;
    let path = |name: &str| folder.path().join(name);
    for name in [".gambol-dead.tmp", ".gambol-alive.tmp", "other.tmp", ".gambol-notes"] {
        fs::write(path(name), "half a file")?;
    }
    let alive = fs::File::options().append(true).open(path(".gambol-alive.tmp"))?;
    alive.lock()?;
    write_whole(&path("file"), b"whole")?;
    let mut names: Vec<_> =
        fs::read_dir(folder.path())?.map(|entry| Ok(entry?.file_name())).collect::<Result<_, std::io::Error>>()?;
    names.sort();
    assert_eq!(names, [".gambol-alive.tmp", ".gambol-notes", "file", "other.tmp"]);
    drop(alive);
    write_whole(&path("file"), b"whole")?;
    assert!(!path(".gambol-alive.tmp").exists());
    Ok(())
}

/// Two that write at once do not take each other's temporary file for abandoned.
#[test]
fn many_writers_in_one_folder_do_not_disturb_each_other() -> Outcome {
    let folder = tempfile::tempdir()?;
    std::thread::scope(|scope| {
        let write = |writer: usize| {
            let path = folder.path().join(writer.to_string());
            move || (0..50).try_for_each(|round| write_whole(&path, format!("{writer} {round}").as_bytes()))
        };
        let writers: Vec<_> = (0..4).map(|writer| scope.spawn(write(writer))).collect();
        writers.into_iter().try_for_each(|writer| writer.join().expect("no writer panics"))
    })?;
    for writer in 0..4 {
        assert_eq!(fs::read_to_string(folder.path().join(writer.to_string()))?, format!("{writer} 49"));
    }
    assert_eq!(fs::read_dir(folder.path())?.count(), 4, "temporary files are left");
    Ok(())
}

/// A rename lasts once the folder is flushed.
#[test]
fn a_file_is_renamed_once_it_is_whole_and_its_folder_is_flushed_last() -> Outcome {
    use ne_core::write_points::{WritePoint, observe};
    use std::sync::{Arc, Mutex};
    let folder = tempfile::tempdir()?;
    let path = folder.path().join("watched");
    fs::write(&path, "old")?;
    let seen = Arc::new(Mutex::new(Vec::new()));
    let (watched, notes) = (path.clone(), seen.clone());
    observe(move |point| {
        let (WritePoint::Begin(path) | WritePoint::Rename(path) | WritePoint::FlushFolder(path)) = point else {
            return;
        };
        if path == watched {
            let name = format!("{point:?}").split('(').next().unwrap_or_default().to_owned();
            notes.lock().expect("no test panics here").push((name, fs::read_to_string(path).unwrap_or_default()));
        }
    });
    write_whole(&path, b"new")?;
    let seen = seen.lock().expect("no test panics here").clone();
    let expected = [("Begin", "old"), ("Rename", "old"), ("FlushFolder", "new")];
    assert_eq!(seen, expected.map(|(point, found)| (point.to_owned(), found.to_owned())));
    Ok(())
}
