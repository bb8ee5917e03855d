//! A file that is there as a whole: the old one or the new one.
//!
//! A writer holds a lock on its temporary file. So the next writer in a folder can tell, and clears away, what a writer that
//! was killed has left there.

use crate::write_points::{WritePoint, reach};
use std::{
    ffi::OsStr,
    fs::{self, File, FileType, TryLockError},
    io::{self, Write},
    path::Path,
};
use tempfile::NamedTempFile;

/// Writes bytes to a temporary file beside `path`, flushes it to the disk, renames it to `path` and flushes the folder.
///
/// # Errors
/// Whatever the operating system says, or if there is something at `path` that is no regular file; it is then as it was.
pub fn write_whole(path: &Path, bytes: &[u8]) -> io::Result<()> {
    write_whole_with(path, |file| file.write_all(bytes))
}

/// As [`write_whole`], with a function that writes the bytes.
///
/// # Errors
/// As [`write_whole`], and those of the function.
pub fn write_whole_with(path: &Path, fill: impl FnOnce(&mut File) -> io::Result<()>) -> io::Result<()> {
    put(path, filled(path, fill)?)
}

/// As [`write_whole`], for files that belong together: none is put in its place before all are written. They are put there in
/// their order.
///
/// # Errors
/// As [`write_whole`]; the error names the file. All are then as they were, unless it is the renaming that failed.
pub fn write_whole_together(files: &[(&Path, &[u8])]) -> io::Result<()> {
    let named = |path: &Path, error: io::Error| io::Error::new(error.kind(), format!("{}: {error}", path.display()));
    let fill = |&(path, bytes): &(&Path, &[u8])| {
        filled(path, |file| file.write_all(bytes)).map_err(|error| named(path, error))
    };
    let written = files.iter().map(fill).collect::<io::Result<Vec<_>>>()?;
    for (&(path, _), file) in files.iter().zip(written) {
        put(path, file).map_err(|error| named(path, error))?;
    }
    Ok(())
}

/// A temporary file beside `path` with what is to stand there, flushed to the disk.
fn filled(path: &Path, fill: impl FnOnce(&mut File) -> io::Result<()>) -> io::Result<NamedTempFile> {
    check_replaceable(path)?;
    let folder = folder_of(path);
    remove_abandoned(folder);
    reach(WritePoint::Begin(path));
    let mut file = temporary(folder)?;
    fill(file.as_file_mut())?;
    file.as_file().sync_all()?;
    Ok(file)
}

fn put(path: &Path, file: NamedTempFile) -> io::Result<()> {
    reach(WritePoint::Rename(path));
    file.persist(path).map_err(|error| error.error)?;
    reach(WritePoint::FlushFolder(path));
    flush_folder(folder_of(path))
}

/// Makes a folder and those above it, and brings it to the disk; one that is there is left as it is.
///
/// # Errors
/// Whatever the operating system says.
pub fn make_folder(path: &Path) -> io::Result<()> {
    reach(WritePoint::Folder(path));
    let is_new = |folder: &&Path| !folder.as_os_str().is_empty() && !folder.exists();
    let new: Vec<&Path> = path.ancestors().take_while(is_new).collect();
    fs::create_dir_all(path)?;
    // Its name stands in the folder above it, which may have been made by another process a moment ago.
    flush_folder(folder_of(path))?;
    new.iter().skip(1).try_for_each(|folder| flush_folder(folder_of(folder)))
}

/// Checks that a file may be put at this path: that there is nothing, or a regular file. Devices, pipes and links are never
/// replaced.
///
/// # Errors
/// Says what is there.
pub fn check_replaceable(path: &Path) -> io::Result<()> {
    match fs::symlink_metadata(path) {
        Ok(there) if !there.is_file() => {
            let message = format!("it is {}, and only a regular file is replaced", name_of(there.file_type()));
            Err(io::Error::new(io::ErrorKind::InvalidInput, message))
        }
        // Should it be there, and not to be looked at, it cannot be written either.
        _ => Ok(()),
    }
}

/// Whether a file of this name is one that is being written, or that a killed writer has left.
pub fn is_temporary(name: &OsStr) -> bool {
    let name = name.as_encoded_bytes();
    name.starts_with(PREFIX.as_bytes()) && name.ends_with(SUFFIX.as_bytes())
}

const PREFIX: &str = ".gambol-";
const SUFFIX: &str = ".tmp";

fn folder_of(path: &Path) -> &Path {
    path.parent().filter(|folder| !folder.as_os_str().is_empty()).unwrap_or(Path::new("."))
}

/// A new temporary file, locked as long as it is open.
fn temporary(folder: &Path) -> io::Result<NamedTempFile> {
    let mut builder = tempfile::Builder::new();
    builder.prefix(PREFIX).suffix(SUFFIX);
    // Temporary files are private by default; a result has the usual permissions (the umask still counts).
    #[cfg(unix)]
    builder.permissions(std::os::unix::fs::PermissionsExt::from_mode(0o666));
    loop {
        let file = builder.tempfile_in(folder)?;
        match file.as_file().try_lock() {
            // Before it was locked, another writer may have taken it for abandoned.
            Ok(()) if !file.path().exists() => {}
            Err(TryLockError::WouldBlock) => {}
            // Where the file system knows no locks, no other process can lock it to clear it away.
            Ok(()) | Err(TryLockError::Error(_)) => return Ok(file),
        }
    }
}

/// Removes the temporary files of writers that are no more. What cannot be removed stays: it does no harm.
fn remove_abandoned(folder: &Path) {
    let Ok(entries) = fs::read_dir(folder) else { return };
    for entry in entries.flatten() {
        if is_temporary(&entry.file_name()) && entry.file_type().is_ok_and(|kind| kind.is_file()) {
            let path = entry.path();
            if File::options().append(true).open(&path).is_ok_and(|file| file.try_lock().is_ok() && remove(&path)) {
                tracing::debug!(path = %path.display(), "the temporary file of a killed writer was removed");
            }
        }
    }
}

/// While it is locked.
fn remove(path: &Path) -> bool {
    fs::remove_file(path).is_ok()
}

/// A rename lasts only once the folder is on the disk.
#[cfg(unix)]
fn flush_folder(folder: &Path) -> io::Result<()> {
    match File::open(folder)?.sync_all() {
        // Some file systems cannot.
        Err(error) if matches!(error.kind(), io::ErrorKind::InvalidInput | io::ErrorKind::Unsupported) => Ok(()),
        flushed => flushed,
    }
}

#[cfg(not(unix))]
fn flush_folder(_: &Path) -> io::Result<()> {
    Ok(())
}

fn name_of(kind: FileType) -> &'static str {
    #[cfg(unix)]
    {
        use std::os::unix::fs::FileTypeExt;
        if kind.is_fifo() {
            return "a named pipe";
        }
        if kind.is_char_device() || kind.is_block_device() {
            return "a device";
        }
        if kind.is_socket() {
            return "a socket";
        }
    }
    match () {
        () if kind.is_dir() => "a folder",
        () if kind.is_symlink() => "a link",
        () => "something else",
    }
}
