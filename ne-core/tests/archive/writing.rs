use crate::{content, read, write};
use ne_core::archive::{ArchiveError, Layout, write_whole};
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
