//! Turning round: what a symmetric body does one way it does the other way.

use player::{Asymmetry, Character, Command, Facing, Outside, PartState, Player};
use std::sync::Arc;

fn tetrapod() -> Character {
    Character::from_bytes(include_bytes!("../fixtures/playing.player")).expect("a character")
}

/// Legs of the near side and the far side, in front and behind, each a thigh and a shin.
const TWINS: [usize; 9] = [0, 3, 4, 1, 2, 7, 8, 5, 6];

fn mirrored(part: PartState) -> PartState {
    PartState { x: -part.x, sin: -part.sin, vx: -part.vx, spin: -part.spin, ..part }
}

/// The body at a frame, as it would be if it moved somehow.
fn moved(start: &[PartState], frame: u32) -> Vec<PartState> {
    let wave = |part: usize, of: f32| (frame as f32 * 0.13 + part as f32 * 1.7 + of).sin();
    let moved = |(index, part): (usize, &PartState)| PartState {
        vx: wave(index, 0.0),
        vy: wave(index, 1.0),
        spin: 3.0 * wave(index, 2.0),
        touching: u32::from(wave(index, 3.0) > 0.3),
        ..PartState::at(part.x + 0.1 * wave(index, 4.0), part.y, 0.4 * wave(index, 5.0))
    };
    start.iter().enumerate().map(moved).collect()
}

#[test]
fn a_symmetric_body_does_the_same_the_other_way() {
    let character = Arc::new(tetrapod());
    assert_eq!(character.symmetry(), Ok(()));
    let names = |part: usize| character.parts[part].name.replace("front", "back");
    assert!((0..9).all(|part| names(part) == names(TWINS[part])), "the twins are of the same side");
    let start: Vec<PartState> = character.start_pose().collect();
    let mut right = Player::new(Arc::clone(&character)).expect("valid");
    let mut left = Player::new(Arc::clone(&character)).expect("valid");
    left.face(Facing::Left).expect("it is symmetric");
    assert_eq!((right.facing(), left.facing()), (Facing::Right, Facing::Left));
    let torso = start[0].x;
    for frame in 0..200 {
        let command = Command { speed: 1.2, jump: u32::from(frame % 50 < 10) };
        let parts = moved(&start, frame);
        let around = |part: PartState| PartState { x: 2.0 * torso + part.x, ..part };
        let other: Vec<PartState> = TWINS.iter().map(|&twin| around(mirrored(parts[twin]))).collect();
        let expected = right.tick(&parts, &[], command, 0.02).expect("a frame").to_vec();
        let found = left.tick(&other, &[], command, 0.02).expect("a frame").to_vec();
        for (output, &hinge) in character.outputs.iter().enumerate() {
            let twin = TWINS[usize::from(character.hinges[usize::from(hinge)].child)];
            let twin_output = |&hinge: &u16| usize::from(character.hinges[usize::from(hinge)].child) == twin;
            let place = character.outputs.iter().position(twin_output).expect("both have motors");
            assert!((expected[output] + found[place]).abs() < 1e-3, "frame {frame}, output {output}");
        }
    }
}

#[test]
fn turning_back_is_as_if_it_had_not_turned() {
    let character = Arc::new(tetrapod());
    let start: Vec<PartState> = character.start_pose().collect();
    let mut players = [0, 1].map(|_| Player::new(Arc::clone(&character)).expect("valid"));
    for facing in [Facing::Left, Facing::Right] {
        players[1].face(facing).expect("it is symmetric");
    }
    let [one, other] =
        players.map(|mut player| player.tick(&start, &[], Command::run(1.0), 0.02).expect("ok").to_vec());
    assert_eq!(one, other);
}

#[test]
fn one_that_is_built_to_face_left_turns_right() {
    let character = tetrapod().mirrored();
    let start: Vec<PartState> = character.start_pose().collect();
    let mut turned = Player::new(character.into()).expect("valid");
    turned.face(Facing::Right).expect("it is symmetric");
    let mut built = Player::new(tetrapod().into()).expect("valid");
    let from: Vec<PartState> = tetrapod().start_pose().collect();
    let expected = built.tick(&from, &[], Command::run(1.0), 0.02).expect("a frame").to_vec();
    let found = turned.tick(&start, &[], Command::run(1.0), 0.02).expect("a frame").to_vec();
    // In the start pose a symmetric body is its own mirror image; which motor is whose is what differs.
    let sorted = |mut speeds: Vec<f32>| {
        speeds.sort_by(f32::total_cmp);
        speeds
    };
    let close = sorted(expected).iter().zip(sorted(found)).all(|(one, other)| (one - other).abs() < 1e-3);
    assert!(close);
}

#[test]
fn what_is_not_symmetric_stays_as_it_is() {
    let mut character = tetrapod();
    character.parts[3].density *= 2.0;
    let mut player = Player::new(character.into()).expect("valid");
    let error = player.face(Facing::Left).expect_err("one leg is heavier");
    assert_eq!(error, Asymmetry::Part(3));
    assert_eq!(error.to_string(), "part 3 has no mirror image on the other side");
    assert_eq!(player.facing(), Facing::Right);
    assert!(player.face(Facing::Right).is_ok());
}

#[test]
fn a_turned_body_looks_the_other_way() {
    let character = Character::from_bytes(include_bytes!("../fixtures/all-senses.player")).expect("a character");
    let rays = |player: &Player| -> Vec<f32> {
        let angle = |outside| if let Outside::Ray { angle, .. } = outside { Some(angle) } else { None };
        player.outside().filter_map(angle).collect()
    };
    let mut player = Player::new(character.into()).expect("valid");
    let before = rays(&player);
    assert!(!before.is_empty(), "it looks ahead");
    player.face(Facing::Left).expect("it is symmetric");
    let turned: Vec<f32> = before.iter().map(|angle| std::f32::consts::PI - angle).collect();
    assert_eq!(rays(&player), turned);
}

/// The net senses the height of the torso above the ground.
#[test]
fn another_body_stands_on_ground_of_its_own() {
    let character = Character::from_bytes(include_bytes!("../fixtures/all-senses.player")).expect("a character");
    let parts: Vec<PartState> = character.start_pose().collect();
    let outside: Vec<f32> = character.outside().map(|_| 1.0).collect();
    let mut first = Player::new(character.into()).expect("valid");
    let speeds = |player: &mut Player| player.tick(&parts, &outside, Command::STAND, 0.02).expect("its parts").to_vec();
    let flat = speeds(&mut first);
    first.reset();
    first.set_ground(0.5);
    let mut other = first.another();
    assert_eq!(speeds(&mut other), flat);
    assert_ne!(speeds(&mut first), flat);
}
