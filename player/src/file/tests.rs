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
    newer[8] = 3;
    assert_eq!(error(&newer), FileError::Version { found: 3 });
    let mut flipped = bytes.clone();
    flipped[60] ^= 4;
    assert_eq!(error(&flipped), FileError::Digest);
    assert_eq!(error(&with_content(|content| content.push(0))), FileError::Cut { field: "neurons" });
    assert_eq!(error(&with_content(|content| content.truncate(3))), FileError::Cut { field: "numbers" });
    for text in [error(b""), FileError::Version { found: 3 }, FileError::Digest, FileError::Cut { field: "name" }] {
        assert!(!text.to_string().is_empty());
    }
}

#[test]
fn counts_that_promise_too_much_are_not_believed() {
    let content = example::example()[HEADER..].to_vec();
    let numbers = usize::from(content[0]);
    let count = |place: usize, bytes: &[u8]| {
        let bytes = with_content(|content| {
            content.splice(place..=place, bytes.iter().copied());
        });
        Character::from_bytes(&bytes).expect_err("damaged")
    };
    assert_eq!(count(0, &[0xff, 0xff, 3]), FileError::Cut { field: "numbers" });
    // Behind the numbers, name, movement and world.
    let parts = 1 + 4 * numbers + 1 + "hopper".len() + 1 + "running".len() + 6 + 2;
    assert_eq!(count(parts, &[0xff, 0xff, 3]), FileError::Cut { field: "parts" });
    for beyond in [&[0x80, 0x80, 4][..], &[0xff, 0xff, 0xff, 1]] {
        let error = count(parts, beyond).to_string();
        assert!(error.contains("parts") && error.contains("from 0 to 65535"), "{error}");
    }
    // The world's first number is none of those that are listed.
    let error = count(parts - 8, &[numbers as u8]).to_string();
    assert!(error.contains("world") && error.contains("listed"), "{error}");
}

/// Each number stands in the file once, and those that stand in most places have the shortest indices.
#[test]
fn numbers_are_listed_once() {
    let bytes = example::example();
    let [count, listed @ ..] = &bytes[HEADER..] else { panic!("there is content") };
    let numbers: Vec<&[u8]> = listed.chunks(4).take((*count).into()).collect();
    let mut distinct = numbers.clone();
    distinct.sort_unstable();
    distinct.dedup();
    assert_eq!(distinct.len(), numbers.len());
    assert!(numbers.contains(&&9.81_f32.to_le_bytes()[..]));
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
