//! The race without a window.

use hurdle_race::{
    pilot,
    race::{FRAME, HURDLES, LENGTH, Race},
};
use player::{Character, Command};
use std::{fs, path::Path, sync::Arc};

const NAMES: [&str; 7] = ["apod", "biped-1", "biped-2", "tetrapod-1", "tetrapod-2", "decapod-1", "decapod-2"];

fn seven() -> Vec<Arc<Character>> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("characters");
    let character = |name: &str| {
        let bytes = fs::read(folder.join(format!("{name}.player"))).expect("it is there");
        assert!(bytes.len() <= 8_192, "{name}: {} bytes", bytes.len());
        let character = Character::from_bytes(&bytes).expect("a character");
        assert_eq!((character.name.as_str(), character.movement.as_str()), (name, "playing"));
        Arc::new(character)
    };
    NAMES.map(character).into()
}

fn frames(seconds: f32) -> usize {
    (seconds / FRAME) as usize
}

#[test]
fn they_stand_until_they_are_told_to_run() {
    let mut race = Race::new(&seven()).expect("they are valid");
    for _ in 0..frames(3.0) {
        race.frame(|_, _| Command::STAND);
    }
    for (runner, name) in race.runners.iter().zip(NAMES) {
        assert!(runner.distance().abs() < 0.5, "{name} stands at {:.2} m", runner.distance());
        assert_eq!(runner.finished, None);
    }
}

/// The computer's runners race; those on four legs, which have learned it best, get there.
#[test]
fn the_tetrapod_gets_over_the_hurdles() {
    let mut race = Race::new(&seven()).expect("they are valid");
    for _ in 0..frames(60.0) {
        race.frame(|_, runner| pilot::command(1.5, runner.pace, runner.ahead()));
        assert!(
            race.runners.iter().all(|runner| runner.distance().is_finite() && runner.distance().abs() < 2.0 * LENGTH)
        );
    }
    let tetrapod = &race.runners[4];
    let knocked = tetrapod.knocked.iter().filter(|&&knocked| knocked).count();
    let told: Vec<String> = race
        .runners
        .iter()
        .zip(NAMES)
        .map(|(runner, name)| {
            let knocked = runner.knocked.iter().filter(|&&knocked| knocked).count();
            format!(
                "{name}: {:.1} m, {:?}, {knocked} knocked over, {} falls",
                runner.distance(),
                runner.finished,
                runner.falls
            )
        })
        .collect();
    assert!(tetrapod.finished.is_some() && knocked <= HURDLES.len() / 2, "{told:#?}");
    assert_eq!(race.standings().len(), 7);
}

/// The same keys give the same race.
#[test]
fn a_race_is_repeated_to_the_bit() {
    let run = || {
        let mut race = Race::new(&seven()).expect("they are valid");
        for frame in 0..frames(5.0) {
            race.frame(|_, _| Command { speed: 1.0, jump: u32::from(frame % 120 < 12) });
        }
        race.runners.iter().map(|runner| runner.distance().to_bits()).collect::<Vec<_>>()
    };
    assert_eq!(run(), run());
}
