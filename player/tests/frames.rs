//! Frames that fail: what was told is not heard, and the motors hold still.

use player::{Activation, Character, Command, Net, Neuron, PartState, Player, TickError};

fn character() -> Character {
    Character::from_bytes(include_bytes!("../fixtures/all-senses.player")).expect("a character")
}

/// What is told in a frame of this character at rest.
fn at_rest(character: &Character) -> (Vec<PartState>, Vec<f32>) {
    (character.start_pose().collect(), character.outside().map(|_| 1.0).collect())
}

#[test]
fn a_frame_that_is_refused_is_none() {
    let character = character();
    let (parts, outside) = at_rest(&character);
    let new = || Player::new(character.clone().into()).expect("valid");
    let (mut one, mut other) = (new(), new());
    let frame =
        |player: &mut Player, speed| player.tick(&parts, &outside, Command::run(speed), 0.02).map(<[f32]>::to_vec);
    // Both stand; one is told in between what is no number, and a press that is not heard.
    for player in [&mut one, &mut other] {
        frame(player, 0.0).expect("a frame");
        player.reset();
    }
    assert_eq!(frame(&mut one, f32::NAN), Err(TickError::NotFinite));
    assert_eq!(one.tick(&parts[1..], &outside, Command::STAND.jumping(), 0.02).err().map(|_| ()), Some(()));
    assert!(one.speeds().iter().all(|&speed| speed == 0.0));
    assert_eq!(one.seconds(), 0.0);
    for speed in [0.0, 1.0, 1.0] {
        assert_eq!(frame(&mut one, speed), frame(&mut other, speed));
        assert_eq!(one.inputs(), other.inputs());
    }
}

#[test]
fn a_frame_in_which_the_net_fails_has_passed() {
    let mut character = character();
    let outputs = character.outputs.len();
    let first = character.net.inputs() as u16;
    // Beyond all bounds, less beyond all bounds.
    let neuron = |scale, bias, sources| Neuron { activation: Activation::Linear, scale, bias, sources };
    let mut neurons = vec![neuron(2.0, f32::MAX, Vec::new())];
    neurons.extend((0..outputs).map(|_| neuron(1.0, 0.0, vec![(first, 1.0), (first, -1.0)])));
    let nodes = (1..=outputs as u16).map(|output| first + output).collect();
    character.net = Net::new(character.net.inputs(), &neurons, nodes).expect("nodes");
    let (parts, outside) = at_rest(&character);
    let mut player = Player::new(character.into()).expect("valid");
    assert_eq!(player.tick(&parts, &outside, Command::STAND, 0.5).err(), Some(TickError::NotFinite));
    assert_eq!(player.seconds(), 0.5);
    assert!(player.speeds().iter().all(|&speed| speed == 0.0));
}

#[test]
fn what_is_not_finite_changes_no_ground_and_turns_no_motor() {
    let character = character();
    let (mut parts, outside) = at_rest(&character);
    let mut player = Player::new(character.into()).expect("valid");
    let inputs = |player: &mut Player, parts: &[PartState]| {
        player.reset();
        player.tick(parts, &outside, Command::run(1.0), 0.02).expect("a frame");
        player.inputs().to_vec()
    };
    player.set_ground(0.1);
    let raised = inputs(&mut player, &parts);
    player.set_ground(f32::NAN);
    player.set_ground(f32::INFINITY);
    assert_eq!(inputs(&mut player, &parts), raised);
    player.set_ground(0.0);
    assert_ne!(inputs(&mut player, &parts), raised, "it senses its height");

    let mut torques = vec![1.0; player.speeds().len()];
    parts.iter_mut().for_each(|part| part.spin = f32::NAN);
    player.torques(&parts, &mut torques);
    assert!(torques.iter().all(|&torque| torque == 0.0), "{torques:?}");
}
