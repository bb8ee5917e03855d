//! `tick` and `torques` allocate nothing. In a binary of its own, since the allocator that counts is the program's.

use player::{Character, Command, PartState, Player};

#[test]
fn a_frame_allocates_nothing() {
    for file in [&include_bytes!("../fixtures/all-senses.player")[..], include_bytes!("../fixtures/playing.player")] {
        let character = Character::from_bytes(file).expect("a character");
        let mut parts: Vec<PartState> = character.start_pose().collect();
        let outside: Vec<f32> = character.outside().map(|_| 1.0).collect();
        let mut torques = vec![0.0; character.outputs.len()];
        for character in [character.mirrored(), character] {
            let mut player = Player::new(character.into()).expect("valid");
            let counted = allocation_counter::measure(|| {
                for frame in 0..200 {
                    parts[0].spin = frame as f32 * 0.01;
                    let command = if frame % 60 < 5 { Command::run(1.0).jumping() } else { Command::run(1.0) };
                    assert!(player.tick(&parts, &outside, command, 0.02).is_ok());
                    player.torques(&parts, &mut torques);
                    assert!(player.tick(&parts[1..], &outside, command, 0.02).is_err());
                    player.reset();
                }
            });
            assert_eq!(counted.count_total, 0);
        }
    }
}

#[test]
fn the_counter_counts() {
    let file = include_bytes!("../fixtures/playing.player");
    let counted = allocation_counter::measure(|| assert!(Character::from_bytes(file).is_ok()));
    assert!(counted.count_total > 0);
}
