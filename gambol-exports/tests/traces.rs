//! What `player` does with a champion's file is what the champion did in training, to the bit; and what cannot be exported is refused before
//! anything is played.
//!
//! `player/fixtures` holds two characters with their traces, which the players in other languages are tested with. Where
//! something of them is to change, write them anew:
//!
//! ```text
//! GAMBOL_FIXTURES=write cargo test -p gambol-exports --test traces
//! ```

mod common;

use common::{Outcome, all_sensors, champion, dense, recurrent};
use creatures::{Actuation, Sensor};
use envs_rapier::PhysicsSettings;
use gambol_exports::{ExportError, Format, Options, Picture, export};
use gambol_runs::{Registry, champion::Champion};
use ne_net::{DenseNet, DenseShape, Network};
use player::{Character, Command, Outside, PartState, Player, TickError};
use std::{env, error::Error, fs, path::Path, sync::Arc};

fn files(champion: &Champion, steps: u32) -> Result<(Vec<u8>, String), Box<dyn Error>> {
    let registry = Registry::default();
    let options = Options { name: "it".into(), steps: Some(steps), picture: Picture::default() };
    let one = |format| Ok::<_, Box<dyn Error>>(export(champion, &registry, format, &options)?.swap_remove(0).bytes);
    Ok((one(Format::Player)?, String::from_utf8(one(Format::Trace)?)?))
}

/// Plays a trace, and asserts that it comes out to the bit.
fn assert_plays(what: &str, file: &[u8], trace: &str) -> Outcome {
    let character = Arc::new(Character::from_bytes(file)?);
    let (parts, outside) = (character.parts.len(), character.outside().count());
    let time_step = character.world.time_step;
    let mut player = Player::new(character)?;
    for line in trace.lines().skip(1) {
        let numbers = line.split(',').map(str::parse).collect::<Result<Vec<f32>, _>>()?;
        let (told, numbers) = numbers.split_at(4);
        let (states, numbers) = numbers.split_at(8 * parts);
        let (outside, expected) = numbers.split_at(outside);
        let state = |part: &[f32]| PartState {
            x: part[0],
            y: part[1],
            cos: part[2],
            sin: part[3],
            vx: part[4],
            vy: part[5],
            spin: part[6],
            touching: u32::from(part[7] != 0.0),
        };
        let states: Vec<PartState> = states.chunks(8).map(state).collect();
        assert_eq!(player.seconds() as f32, told[1], "{what}");
        player.tick(&states, outside, Command { speed: told[2], jump: told[3] as u32 }, time_step)?;
        let found: Vec<u32> = player
            .inputs()
            .iter()
            .copied()
            .chain(player.outputs())
            .chain(player.speeds().iter().copied())
            .map(bits)
            .collect();
        let expected: Vec<u32> = expected.iter().copied().map(bits).collect();
        let differs = found.iter().zip(&expected).position(|(found, expected)| found != expected);
        assert_eq!((found.len(), differs), (expected.len(), None), "{what}, step {}", told[0]);
    }
    Ok(())
}

/// With one zero.
fn bits(number: f32) -> u32 {
    (number + 0.0).to_bits()
}

#[test]
fn every_creature_is_played_to_the_bit() -> Outcome {
    for shipped in creatures::shipped() {
        let name = shipped.name;
        for (terrain, actuation, net) in [
            ("flat", Actuation::Speed, dense as fn(usize, usize) -> Network),
            ("gaps", Actuation::Angle { gain: 12.0 }, recurrent),
        ] {
            let champion = champion(name, terrain, actuation, all_sensors(), net)?;
            let (file, trace) = files(&champion, 150)?;
            assert_plays(&format!("{name} on {terrain}"), &file, &trace)?;
            assert!(file.len() <= 20_000, "{name}: {} bytes", file.len());
        }
    }
    Ok(())
}

#[test]
fn the_fixtures_are_what_is_exported_today_and_are_played_to_the_bit() -> Outcome {
    let playing = vec![
        Sensor::TorsoRotation,
        Sensor::JointAngles,
        Sensor::FootContacts,
        Sensor::CommandedSpeed { top: 1.5 },
        Sensor::StrideClock { period: 0.5, top: 1.5 },
        Sensor::JumpClock { period: 0.6 },
    ];
    for (name, champion, steps) in [
        ("all-senses", champion("biped-2", "gaps", Actuation::Speed, all_sensors(), recurrent)?, 100),
        ("playing", champion("tetrapod-2", "flat", Actuation::Angle { gain: 15.0 }, playing, dense)?, 100),
    ] {
        let (file, trace) = files(&champion, steps)?;
        let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../player/fixtures");
        let (file_path, trace_path) = (folder.join(format!("{name}.player")), folder.join(format!("{name}.trace.csv")));
        if env::var("GAMBOL_FIXTURES").is_ok_and(|what| what == "write") {
            fs::write(&file_path, &file)?;
            fs::write(&trace_path, &trace)?;
        }
        assert!(fs::read(&file_path)? == file, "{} is not what is exported", file_path.display());
        assert!(fs::read_to_string(&trace_path)? == trace, "{} is not what is exported", trace_path.display());
        assert_plays(name, &file, &trace)?;
    }
    Ok(())
}

#[test]
fn a_mirrored_character_does_the_same_the_other_way() -> Outcome {
    let champion = champion("biped-2", "flat", Actuation::Angle { gain: 12.0 }, all_sensors(), recurrent)?;
    let (file, trace) = files(&champion, 50)?;
    let right = Character::from_bytes(&file)?;
    let left = right.mirrored();
    assert_eq!(left.mirrored(), right);
    for (ours, theirs) in right.outside().zip(left.outside()) {
        if let (Outside::Ray { angle, .. }, Outside::Ray { angle: other, .. }) = (ours, theirs) {
            assert!((libm::cosf(angle) + libm::cosf(other)).abs() < 1e-6);
        }
    }
    let (mut right, mut left) = (Player::new(right.into())?, Player::new(left.into())?);
    let outside: Vec<f32> = right.character().outside().map(|_| 0.7).collect();
    for line in trace.lines().skip(1) {
        let numbers = line.split(',').map(str::parse).collect::<Result<Vec<f32>, _>>()?;
        let state = |part: &[f32]| PartState {
            x: part[0],
            y: part[1],
            cos: part[2],
            sin: part[3],
            vx: part[4],
            vy: part[5],
            spin: part[6],
            touching: u32::from(part[7] != 0.0),
        };
        let states: Vec<PartState> = numbers[4..4 + 8 * right.character().parts.len()].chunks(8).map(state).collect();
        let mirror =
            |part: &PartState| PartState { x: -part.x, sin: -part.sin, vx: -part.vx, spin: -part.spin, ..*part };
        let mirrored: Vec<PartState> = states.iter().map(mirror).collect();
        let command = Command::run(1.0);
        let speeds = right.tick(&states, &outside, command, 0.02)?.to_vec();
        let other = left.tick(&mirrored, &outside, command, 0.02)?;
        assert_eq!(speeds, other.iter().map(|speed| -speed).collect::<Vec<_>>());
        let (mut torques, mut others) = (vec![0.0; speeds.len()], vec![0.0; speeds.len()]);
        right.torques(&states, &mut torques);
        left.torques(&mirrored, &mut others);
        assert_eq!(torques, others.iter().map(|torque| -torque).collect::<Vec<_>>());
    }
    Ok(())
}

#[test]
fn what_a_game_tells_wrongly_leaves_the_motors_still() -> Outcome {
    let champion = champion("biped-2", "flat", Actuation::Speed, all_sensors(), dense)?;
    let character = Character::from_bytes(&files(&champion, 1)?.0)?;
    let parts: Vec<PartState> = character.start_pose().collect();
    let outside: Vec<f32> = character.outside().map(|_| 1.0).collect();
    let (part_count, outside_count) = (parts.len(), outside.len());
    let mut player = Player::new(character.into())?;
    let run = Command::run(1.0);
    let mut fallen = parts.clone();
    fallen[1].vx = f32::NAN;
    let wrong = [
        (&parts[1..], &outside[..], 0.02, TickError::Parts { expected: part_count, found: part_count - 1 }),
        (&parts[..], &outside[1..], 0.02, TickError::Outside { expected: outside_count, found: outside_count - 1 }),
        (&parts[..], &outside[..], -0.1, TickError::Seconds),
        (&parts[..], &outside[..], f32::NAN, TickError::Seconds),
        (&fallen[..], &outside[..], 0.02, TickError::NotFinite),
    ];
    for (parts_, outside_, seconds, expected) in wrong {
        assert!(player.tick(&parts, &outside, run, 0.02)?.iter().any(|&speed| speed != 0.0));
        assert_eq!(player.tick(parts_, outside_, run, seconds), Err(expected));
        assert!(player.speeds().iter().all(|&speed| speed == 0.0));
        assert!(expected.to_string().len() > 20);
    }
    // It goes on as if it had just begun.
    let mut fresh = player.another();
    player.reset();
    assert_eq!(player.tick(&parts, &outside, run, 0.02)?, fresh.tick(&parts, &outside, run, 0.02)?);
    Ok(())
}

/// Of more weights that differ than a player's file lists numbers.
fn wide(inputs: usize, outputs: usize) -> Network {
    let shape = DenseShape::new(inputs, vec![260, 260], outputs);
    let weights: Vec<f32> = (0..shape.weight_count()).map(|index| index as f32 * 1e-6).collect();
    DenseNet::new(shape, &weights).expect("as many weights as there are").into()
}

#[test]
fn a_swimmer_has_no_ground_to_paint() -> Outcome {
    let mut swimmer = champion("apod", "flat", Actuation::Speed, vec![Sensor::JointAngles], dense)?;
    swimmer.physics = PhysicsSettings { water: Some(Default::default()), ..swimmer.physics };
    let picture = Picture { ground: true, ..Picture::default() };
    let options = Options { name: "it".into(), steps: None, picture };
    let refused = export(&swimmer, &Registry::default(), Format::Gif, &options).err();
    assert!(matches!(refused, Some(ExportError::NoGround)), "{refused:?}");
    Ok(())
}

#[test]
fn what_no_file_of_a_player_can_hold_has_no_trace() -> Outcome {
    let champion = champion("biped-1", "flat", Actuation::Speed, vec![Sensor::JointAngles], wide)?;
    let options = Options { name: "it".into(), steps: Some(1), picture: Picture::default() };
    for format in [Format::Player, Format::Trace] {
        let refused = export(&champion, &Registry::default(), format, &options).err();
        let says = refused.as_ref().map(ToString::to_string).unwrap_or_default();
        assert!(says.contains("at most 65535 that differ"), "{says:?}");
    }
    Ok(())
}
