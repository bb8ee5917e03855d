//! Reading a file whose size somebody else has chosen.

use std::{
    fs::File,
    io::{self, Read},
    path::Path,
};

const MIB: u64 = 1 << 20;

/// The largest file that people write or edit, such as a creature or a configuration: 8 MiB.
pub const LARGEST_TEXT: u64 = 8 * MIB;

/// The largest file that a program writes, such as a checkpoint or a trajectory: 4 GiB.
pub const LARGEST_DATA: u64 = 4096 * MIB;

/// The most that is read from what is no regular file (a pipe, a device), whose end is not known: 64 MiB.
const LONGEST_STREAM: u64 = 64 * MIB;

const BYTE_ORDER_MARK: &[u8] = "\u{feff}".as_bytes();

/// The bytes of a file of at most `limit` bytes. A pipe or a device is read as well, up to 64 MiB.
///
/// # Errors
/// Whatever the operating system says; [`io::ErrorKind::FileTooLarge`] with the limit in its message.
pub fn read(path: &Path, limit: u64) -> io::Result<Vec<u8>> {
    let file = File::open(path)?;
    let known = file.metadata().ok().filter(std::fs::Metadata::is_file).map(|it| it.len());
    let limit = if known.is_some() { limit } else { limit.min(LONGEST_STREAM) };
    let too_large = || {
        let message = format!("it has more than {} MiB, the most such a file may have", limit / MIB);
        io::Error::new(io::ErrorKind::FileTooLarge, message)
    };
    if known.is_some_and(|length| length > limit) {
        return Err(too_large());
    }
    let mut bytes = Vec::new();
    // A file can grow while it is read.
    file.take(limit + 1).read_to_end(&mut bytes)?;
    if bytes.len() as u64 > limit { Err(too_large()) } else { Ok(bytes) }
}

/// As [`read`], for a text; without the byte order mark that some editors begin one with.
///
/// # Errors
/// As [`read`]; [`io::ErrorKind::InvalidData`] if it is not UTF-8.
pub fn read_text(path: &Path, limit: u64) -> io::Result<String> {
    let invalid = |_| io::Error::new(io::ErrorKind::InvalidData, "stream did not contain valid UTF-8");
    let mut bytes = read(path, limit)?;
    if bytes.starts_with(BYTE_ORDER_MARK) {
        bytes.drain(..BYTE_ORDER_MARK.len());
    }
    String::from_utf8(bytes).map_err(invalid)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_byte_order_mark_is_no_part_of_a_text() -> io::Result<()> {
        let file = tempfile::NamedTempFile::new()?;
        for (written, text) in [("\u{feff}{}", "{}"), ("{}\u{feff}", "{}\u{feff}"), ("\u{feff}", "")] {
            std::fs::write(file.path(), written)?;
            assert_eq!(read_text(file.path(), MIB)?, text);
        }
        Ok(())
    }

    #[test]
    fn a_file_is_read_up_to_its_limit() -> io::Result<()> {
        let folder = tempfile::tempdir()?;
        let path = folder.path().join("file");
        std::fs::write(&path, vec![b'a'; MIB as usize])?;
        assert_eq!(read(&path, MIB)?.len(), MIB as usize);
        std::fs::write(&path, vec![b'a'; MIB as usize + 1])?;
        let error = read_text(&path, MIB).expect_err("too large");
        assert_eq!(error.kind(), io::ErrorKind::FileTooLarge);
        assert_eq!(error.to_string(), "it has more than 1 MiB, the most such a file may have");
        Ok(())
    }

    /// A sparse file takes no room on the disk; its length alone refuses it.
    #[test]
    fn a_huge_file_is_refused_without_being_read() -> io::Result<()> {
        let file = tempfile::NamedTempFile::new()?;
        file.as_file().set_len(LARGEST_DATA + 1)?;
        assert_eq!(read(file.path(), LARGEST_DATA).map_err(|error| error.kind()), Err(io::ErrorKind::FileTooLarge));
        Ok(())
    }

    #[cfg(unix)]
    #[test]
    fn a_device_without_an_end_is_read_up_to_a_limit() {
        let read = read(Path::new("/dev/zero"), LARGEST_DATA).map_err(|error| error.to_string());
        assert_eq!(read, Err("it has more than 64 MiB, the most such a file may have".to_owned()));
    }
}
