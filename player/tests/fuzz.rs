//! Hostile files: whatever the bytes, reading them gives an error or a character that can be played.
//!
//! `GAMBOL_FUZZ_INPUTS` says how many; by default few. The long check has ten million:
//!
//! ```text
//! GAMBOL_FUZZ_INPUTS=10000000 cargo test --release -p gambol-player --test fuzz
//! ```

use player::{Character, Command, FileError, PartState, Player};
use std::collections::BTreeMap;

const FILES: [&[u8]; 2] =
    [include_bytes!("../fixtures/all-senses.player"), include_bytes!("../fixtures/playing.player")];

/// Bytes of the header: magic, version, length, digest.
const HEADER: usize = 24;

/// xorshift64* (Vigna 2016): as random as damage needs to be, and the same on every machine.
struct Chance(u64);

impl Chance {
    fn next(&mut self) -> u64 {
        self.0 ^= self.0 >> 12;
        self.0 ^= self.0 << 25;
        self.0 ^= self.0 >> 27;
        self.0.wrapping_mul(0x2545_f491_4f6c_dd1d)
    }

    fn below(&mut self, end: usize) -> usize {
        (self.next() >> 16) as usize % end.max(1)
    }
}

/// Numbers that break what has not been thought of, as the bytes of a file.
const NUMBERS: [u32; 12] = [
    0,
    1,
    0xffff,
    0xffff_ffff,
    0x7f80_0000, // infinity
    0xff80_0000,
    0x7fc0_0000, // NaN
    0x0000_0001, // the smallest f32
    0x7f7f_ffff, // the largest
    0xff7f_ffff,
    0x8000_0000,
    0x4b00_0000,
];

fn damaged(chance: &mut Chance, bytes: &mut Vec<u8>) {
    let file = FILES[chance.below(FILES.len())];
    bytes.clear();
    bytes.extend_from_slice(file);
    for _ in 0..=chance.below(4) {
        let place = HEADER + chance.below(bytes.len().saturating_sub(HEADER));
        match chance.below(6) {
            0 => bytes[place] ^= 1 << chance.below(8),
            1 => bytes[place] = chance.next() as u8,
            2 => {
                let number = NUMBERS[chance.below(NUMBERS.len())].to_le_bytes();
                let end = bytes.len().min(place + 4);
                bytes[place..end].copy_from_slice(&number[..end - place]);
            }
            3 => bytes.truncate(place),
            4 => bytes.insert(place, chance.next() as u8),
            _ => {
                bytes.remove(place);
            }
        }
        if bytes.len() <= HEADER {
            break;
        }
    }
    // Accidents have a digest that does not fit, attacks one that does.
    if chance.below(16) > 0 {
        let digest = bytes[HEADER..].iter().fold(0xcbf2_9ce4_8422_2325_u64, |digest, &byte| {
            (digest ^ u64::from(byte)).wrapping_mul(0x0000_0100_0000_01b3)
        });
        let length = (bytes.len() - HEADER) as u32;
        bytes[12..16].copy_from_slice(&length.to_le_bytes());
        bytes[16..24].copy_from_slice(&digest.to_le_bytes());
    }
}

fn name(error: FileError) -> &'static str {
    match error {
        FileError::NotACharacter => "not a character",
        FileError::Version { .. } => "version",
        FileError::Length { .. } => "length",
        FileError::Digest => "digest",
        FileError::Cut { .. } => "cut",
        FileError::Field { .. } => "field",
        _ => "other",
    }
}

/// Plays a few frames, and asserts that the motors are asked for numbers.
fn play(character: Character, chance: &mut Chance) {
    assert_eq!(character.validate(), Ok(()));
    let character = if chance.below(4) == 0 { character.mirrored() } else { character };
    let mut parts: Vec<PartState> = character.start_pose().collect();
    let outside: Vec<f32> = character.outside().map(|_| 1.0).collect();
    let mut player = Player::new(character.into()).expect("it is valid");
    for frame in 0..2 {
        parts[0].spin = chance.below(1000) as f32;
        parts[0].touching = frame;
        let _ = player.tick(&parts, &outside, Command::run(chance.below(5) as f32).jumping(), 0.02);
        assert!(player.speeds().iter().all(|speed| speed.is_finite()));
    }
}

#[test]
fn hostile_files_are_refused_or_played() {
    let inputs = std::env::var("GAMBOL_FUZZ_INPUTS").ok().and_then(|inputs| inputs.parse().ok()).unwrap_or(20_000);
    let mut chance = Chance(0x9e37_79b9_7f4a_7c15);
    let mut outcomes: BTreeMap<&str, u64> = BTreeMap::new();
    let mut bytes = Vec::new();
    for _ in 0..inputs {
        damaged(&mut chance, &mut bytes);
        let outcome = match Character::from_bytes(&bytes) {
            Ok(character) => {
                let again = character.to_bytes().and_then(|bytes| Character::from_bytes(&bytes));
                assert_eq!(again.as_ref(), Ok(&character));
                play(character, &mut chance);
                "played"
            }
            Err(error) => name(error),
        };
        *outcomes.entry(outcome).or_default() += 1;
    }
    // A fuzzer that reaches nothing proves nothing.
    for outcome in ["played", "digest", "cut", "field"] {
        assert!(outcomes.get(outcome).is_some_and(|&count| count > inputs / 1000), "{outcomes:?}");
    }
}
