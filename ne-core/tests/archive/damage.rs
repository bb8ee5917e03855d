use crate::{Content, FORMAT, VERSION, content, read, write};
use ne_core::archive::{self, ArchiveError, Layout};
use std::fs;

type Outcome = Result<(), Box<dyn std::error::Error>>;

#[test]
fn no_flipped_bit_goes_unnoticed() -> Outcome {
    let folder = tempfile::tempdir()?;
    let path = folder.path().join("file");
    for layout in [Layout::Compact, Layout::Pretty] {
        write(&path, layout)?;
        let bytes = fs::read(&path)?;
        // Of the pretty layout only what it has more: white space.
        let at_risk = |place: &usize| layout == Layout::Compact || bytes[place / 8].is_ascii_whitespace();
        let mut unnoticed = 0;
        for place in (0..8 * bytes.len()).filter(at_risk) {
            let mut damaged = bytes.clone();
            damaged[place / 8] ^= 1 << (place % 8);
            fs::write(&path, &damaged)?;
            match read(&path) {
                // A space that became another, the e of an exponent: what it says is still the same.
                Ok(found) => {
                    unnoticed += 1;
                    assert_eq!(found, content(), "bit {} of byte {}", place % 8, place / 8);
                }
                Err(error) => {
                    assert!(error.to_string().contains(&path.display().to_string()), "{error} does not name the file");
                    assert!(!matches!(error, ArchiveError::Read { .. } | ArchiveError::Write { .. }), "{error}");
                }
            }
        }
        assert!(unnoticed < bytes.len(), "{unnoticed} of {} bits", 8 * bytes.len());
    }
    Ok(())
}

#[test]
fn every_truncated_file_is_an_error() -> Outcome {
    let folder = tempfile::tempdir()?;
    let path = folder.path().join("file");
    write(&path, Layout::Compact)?;
    let bytes = fs::read(&path)?;
    // The last byte is a line break: the file is whole without it.
    for length in 0..bytes.len() - 1 {
        fs::write(&path, &bytes[..length])?;
        let error = read(&path).expect_err("it is truncated");
        assert!(matches!(error, ArchiveError::Malformed { line: 0 | 1, .. }), "{length} bytes: {error}");
    }
    Ok(())
}

/// What the error says of a file with this text.
fn message(text: impl AsRef<[u8]>) -> String {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let path = folder.path().join("file");
    fs::write(&path, text).expect("a writable folder");
    let message = read(&path).expect_err("it is no such file").to_string();
    message.replace(&path.display().to_string(), "FILE")
}

#[test]
fn errors_say_what_is_wrong_where() {
    assert_eq!(
        message("{\n  \"format\": oops"),
        "FILE is damaged or not a file of Gambol: line 2, column 13: expected value"
    );
    assert_eq!(message("[1, 2]"), "FILE is a \"unknown\" file, expected a \"test file\" file");
    assert_eq!(message(r#"{"format": "champion"}"#), "FILE is a \"champion\" file, expected a \"test file\" file");
    assert_eq!(
        message(r#"{"format": "test file", "version": 4, "what": "ever"}"#),
        "FILE has version 4, this Gambol reads version 3; use a newer Gambol"
    );
    assert_eq!(
        message(r#"{"format": "test file", "version": 2}"#),
        "FILE has version 2, this Gambol reads version 3; use the Gambol that wrote it"
    );
    assert_eq!(
        message(r#"{"format": "test file", "version": -1}"#),
        "FILE: field version: invalid value: integer `-1`, expected u32"
    );
    let no_digest = message(r#"{"format": "test file", "version": 3, "content": {}}"#);
    assert!(no_digest.contains("missing field `digest`"), "{no_digest}");
    assert!(
        message(b"{\"format\": \"\xff\xfe\"}").contains("line 1, column 13"),
        "{}",
        message(b"{\"format\": \"\xff\xfe\"}")
    );
}

#[test]
fn an_edited_file_is_told_from_a_damaged_one() -> Outcome {
    let folder = tempfile::tempdir()?;
    let path = folder.path().join("file");
    write(&path, Layout::Pretty)?;
    fs::write(&path, fs::read_to_string(&path)?.replace("-12.75", "99"))?;
    let error = read(&path).expect_err("it was edited");
    assert!(matches!(error, ArchiveError::Damaged { .. }), "{error}");
    // It can be read all the same, without verification.
    let (value, digests) = archive::read_unverified(&path, FORMAT, VERSION)?;
    assert_ne!(digests.expected, digests.found);
    assert_eq!(archive::content::<Content>(&path, value)?.fitness, Some(99.0));
    Ok(())
}

#[test]
fn a_wrong_field_is_named_by_its_path() -> Outcome {
    let folder = tempfile::tempdir()?;
    let path = folder.path().join("file");
    let mut value = serde_json::to_value(content())?;
    value["nested"][1]["x"] = "fast".into();
    archive::write(&path, FORMAT, VERSION, &value, Layout::Compact)?;
    let error = read(&path).expect_err("a text is no number").to_string();
    assert!(error.ends_with("field nested[1].x: invalid type: string \"fast\", expected f32"), "{error}");
    Ok(())
}

#[test]
fn the_digest_sees_values_and_no_white_space() -> Outcome {
    let folder = tempfile::tempdir()?;
    let (compact, pretty) = (folder.path().join("compact"), folder.path().join("pretty"));
    write(&compact, Layout::Compact)?;
    write(&pretty, Layout::Pretty)?;
    let digests = |path| archive::read_unverified(path, FORMAT, VERSION).map(|(_, digests)| digests);
    assert_eq!(digests(&compact)?, digests(&pretty)?);
    assert!(fs::read(&pretty)?.len() > fs::read(&compact)?.len());
    // Another layout by another program, with the keys in another order.
    let text = fs::read_to_string(&compact)?.replace(r#"{"x":-1.0,"on":false}"#, "{\r\n\t\"on\": false, \"x\":-1.0 }");
    assert!(text.contains('\t'), "{text}");
    fs::write(&compact, text)?;
    assert_eq!(read(&compact)?, content());
    Ok(())
}
