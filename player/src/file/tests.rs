use super::*;
use crate::{Character, FileError, example};
use alloc::{string::ToString, vec::Vec};
use proptest::prelude::*;

#[test]
fn what_is_written_is_read_again() {
    let character = example::character();
    let bytes = character.to_bytes().expect("valid");
    assert_eq!(Character::from_bytes(&bytes), Ok(character));
}

#[test]
fn the_mirror_image_is_not_written() {
    let error = example::character().mirrored().to_bytes().expect_err("faces left").to_string();
    assert!(error.contains("facing") && error.contains("right"), "{error}");
}

/// The same file with other content, and the header that fits.
fn with_content(change: impl FnOnce(&mut Vec<u8>)) -> Vec<u8> {
    let bytes = example::example();
    let mut content = bytes[HEADER..].to_vec();
    change(&mut content);
    let mut whole = bytes[..12].to_vec();
    whole.extend(u32::try_from(content.len()).expect("short").to_le_bytes());
    whole.extend(digest(&content).to_le_bytes());
    whole.extend(content);
    whole
}

#[test]
fn each_damage_is_named() {
    let bytes = example::example();
    let error = |bytes: &[u8]| Character::from_bytes(bytes).expect_err("damaged");
    assert_eq!(error(b""), FileError::NotACharacter);
    assert_eq!(error(&[b'x'; 100]), FileError::NotACharacter);
    assert_eq!(
        error(&bytes[..bytes.len() - 1]),
        FileError::Length { expected: bytes.len() - 24, found: bytes.len() - 25 }
    );
    let mut newer = bytes.clone();
    newer[8] = 2;
    assert_eq!(error(&newer), FileError::Version { found: 2 });
    let mut flipped = bytes.clone();
    flipped[60] ^= 4;
    assert_eq!(error(&flipped), FileError::Digest);
    assert_eq!(error(&with_content(|content| content.push(0))), FileError::Cut { field: "neurons" });
    assert_eq!(error(&with_content(|content| content.truncate(3))), FileError::Cut { field: "name" });
    for text in [error(b""), FileError::Version { found: 2 }, FileError::Digest, FileError::Cut { field: "name" }] {
        assert!(!text.to_string().is_empty());
    }
}

#[test]
fn counts_that_promise_too_much_are_not_believed() {
    // The count of parts: behind name, movement and world.
    let parts = 1 + "hopper".len() + 1 + "running".len() + 24 + 2;
    let error = Character::from_bytes(&with_content(|content| content[parts..parts + 2].fill(0xff)));
    assert_eq!(error, Err(FileError::Cut { field: "parts" }));
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(2000))]

    /// Neither panics nor plays what is not valid.
    #[test]
    fn any_damage_is_an_error_or_a_valid_character(
        places in prop::collection::vec((any::<prop::sample::Index>(), any::<u8>()), 1..6),
        cut in prop::option::of(any::<prop::sample::Index>()),
    ) {
        let bytes = with_content(|content| {
            for (place, byte) in &places {
                let index = place.index(content.len());
                content[index] = *byte;
            }
            if let Some(cut) = cut {
                content.truncate(cut.index(content.len()));
            }
        });
        if let Ok(character) = Character::from_bytes(&bytes) {
            prop_assert_eq!(character.validate(), Ok(()));
            let parts: Vec<_> = character.start_pose().collect();
            let outside: Vec<f32> = character.outside().map(|_| 1.0).collect();
            let mut player = crate::Player::new(character.into()).expect("valid");
            for _ in 0..3 {
                let _ = player.tick(&parts, &outside, crate::Command::run(1.0).jumping(), 0.02);
                prop_assert!(player.speeds().iter().all(|speed| speed.is_finite()));
            }
        }
    }
}
