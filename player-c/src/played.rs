//! One body that is played.

use crate::{GambolCharacter, GambolStatus};
use alloc::boxed::Box;
use core::{ptr, slice};
use player::{Command, Facing, PartState, Player};

/// One body that is played.
#[derive(Debug)]
pub struct GambolPlayer(Player);

/// A body that stands in its start pose; null for null.
///
/// # Safety
/// `character` is null or was loaded and not given back.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn gambol_player_new(character: *const GambolCharacter) -> *mut GambolPlayer {
    // SAFETY: the caller promises it.
    let character = unsafe { character.as_ref() };
    let player = character.and_then(|GambolCharacter(character)| Player::new(character.clone()).ok());
    player.map_or(ptr::null_mut(), |player| Box::into_raw(Box::new(GambolPlayer(player))))
}

/// Gives a player back. Null is allowed.
///
/// # Safety
/// `player` is null or is new and not given back.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn gambol_player_free(player: *mut GambolPlayer) {
    if !player.is_null() {
        // SAFETY: it was made by `Box::into_raw` and not given back.
        drop(unsafe { Box::from_raw(player) });
    }
}

/// Begins anew: call it when the body was put back into its start pose.
///
/// # Safety
/// `player` is null or is new and not given back.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn gambol_player_reset(player: *mut GambolPlayer) -> GambolStatus {
    // SAFETY: the caller promises it.
    let Some(GambolPlayer(player)) = (unsafe { player.as_mut() }) else { return GambolStatus::NullPointer };
    player.reset();
    GambolStatus::Ok
}

/// Turns round, from the next frame on: `left` is 1 to face smaller x, 0 to face greater x. A body that stands turns best. Rays that the
/// character wants measured look along π less their angle when it does not face as it was built. A body that does not look the
/// same from both sides is `GAMBOL_STATUS_ASYMMETRIC`, and goes on as it was.
///
/// # Safety
/// `player` is null or is new and not given back.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn gambol_player_face(player: *mut GambolPlayer, left: u32) -> GambolStatus {
    // SAFETY: the caller promises it.
    let Some(GambolPlayer(player)) = (unsafe { player.as_mut() }) else { return GambolStatus::NullPointer };
    match player.face(if left == 0 { Facing::Right } else { Facing::Left }) {
        Ok(()) => GambolStatus::Ok,
        Err(_) => GambolStatus::Asymmetric,
    }
}

/// How high the ground is where the body stands, m; 0 until it is said. What is not finite is `GAMBOL_STATUS_NOT_FINITE`, and changes
/// nothing. Only a character that senses the height of its torso goes by it. One that was trained on a terrain that rises or falls
/// heard its height above the ground it started on: tell it the height of that.
///
/// # Safety
/// `player` is null or is new and not given back.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn gambol_player_set_ground(player: *mut GambolPlayer, height: f32) -> GambolStatus {
    // SAFETY: the caller promises it.
    let Some(GambolPlayer(player)) = (unsafe { player.as_mut() }) else { return GambolStatus::NullPointer };
    if !height.is_finite() {
        return GambolStatus::NotFinite;
    }
    player.set_ground(height);
    GambolStatus::Ok
}

/// A frame: from where the parts are, what the game measures and what the character is told, to the speeds that its motors are
/// asked for until the next, rad/s, in the order of the outputs.
///
/// - `commanded_speed`: how fast to go, body lengths/s, backwards below 0; `jump`: 1 as long as the button is held, else 0;
/// - `seconds`: how long this frame lasts, from 0 to 1.
///
/// Allocates nothing. If it fails, all speeds are 0.
///
/// # Safety
/// `player` is null or is new and not given back; the arrays are as long as is said, and null only where that is 0.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn gambol_player_tick(
    player: *mut GambolPlayer,
    parts: *const PartState,
    part_count: usize,
    outside: *const f32,
    outside_count: usize,
    commanded_speed: f32,
    jump: u32,
    seconds: f32,
    speeds: *mut f32,
    speed_count: usize,
) -> GambolStatus {
    // SAFETY: the caller promises all of these.
    let (player, parts, outside, speeds) =
        unsafe { (player.as_mut(), read(parts, part_count), read(outside, outside_count), write(speeds, speed_count)) };
    let Some(GambolPlayer(player)) = player else {
        speeds.into_iter().flatten().for_each(|speed| *speed = 0.0);
        return GambolStatus::NullPointer;
    };
    player.hold_still();
    let Some(speeds) = speeds else { return GambolStatus::NullPointer };
    speeds.fill(0.0);
    let (Some(parts), Some(outside)) = (parts, outside) else { return GambolStatus::NullPointer };
    let command = Command { speed: commanded_speed, jump };
    if speeds.len() != player.speeds().len() {
        return GambolStatus::Count;
    }
    match player.tick(parts, outside, command, seconds) {
        Ok(asked) => {
            speeds.copy_from_slice(asked);
            GambolStatus::Ok
        }
        Err(error) => error.into(),
    }
}

/// The torque of each motor, N·m, counter-clockwise on the child and as much the other way on the parent, for engines whose hinges
/// have no motors. May be asked for at every step of the engine, several times a frame: a light part shakes where steps are long, as
/// `motor_gain` × step ÷ inertia grows beyond 2. Motors of the engine do better. Numbers that are not finite are
/// `GAMBOL_STATUS_NOT_FINITE`, and all torques 0. A motor that is no output gets none here: the game holds it still by the same law,
/// asked for speed 0.
///
/// # Safety
/// As [`gambol_player_tick`].
#[unsafe(no_mangle)]
pub unsafe extern "C" fn gambol_player_torques(
    player: *const GambolPlayer,
    parts: *const PartState,
    part_count: usize,
    torques: *mut f32,
    torque_count: usize,
) -> GambolStatus {
    // SAFETY: the caller promises all of these.
    let (player, parts, torques) = unsafe { (player.as_ref(), read(parts, part_count), write(torques, torque_count)) };
    let (Some(GambolPlayer(player)), Some(parts), Some(torques)) = (player, parts, torques) else {
        return GambolStatus::NullPointer;
    };
    if parts.len() != player.character().parts.len() || torques.len() != player.speeds().len() {
        return GambolStatus::Count;
    }
    if !parts.iter().all(PartState::is_finite) {
        torques.fill(0.0);
        return GambolStatus::NotFinite;
    }
    player.torques(parts, torques);
    GambolStatus::Ok
}

/// The inputs of the net in the last frame, as many as `count` says or there are, for those who look into it; returns how many
/// there are, 0 for null.
///
/// # Safety
/// `player` is null or is new and not given back; `inputs` is null or points to `count` numbers.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn gambol_player_inputs(player: *const GambolPlayer, inputs: *mut f32, count: usize) -> usize {
    // SAFETY: the caller promises both.
    let (Some(GambolPlayer(player)), inputs) = (unsafe { (player.as_ref(), write(inputs, count)) }) else { return 0 };
    inputs.into_iter().flatten().zip(player.inputs()).for_each(|(to, &from)| *to = from);
    player.inputs().len()
}

/// What the net put out in the last frame, in the same way.
///
/// # Safety
/// As [`gambol_player_inputs`].
#[unsafe(no_mangle)]
pub unsafe extern "C" fn gambol_player_outputs(player: *const GambolPlayer, outputs: *mut f32, count: usize) -> usize {
    // SAFETY: the caller promises both.
    let (Some(GambolPlayer(player)), outputs) = (unsafe { (player.as_ref(), write(outputs, count)) }) else { return 0 };
    outputs.into_iter().flatten().zip(player.outputs()).for_each(|(to, from)| *to = from);
    player.speeds().len()
}

/// An array, or `None` if it is null and not empty.
///
/// # Safety
/// It is null or as long as is said, and nothing writes to it.
unsafe fn read<'a, T>(from: *const T, count: usize) -> Option<&'a [T]> {
    match (from.is_null(), count) {
        (_, 0) => Some(&[]),
        (true, _) => None,
        // SAFETY: the caller promises it.
        (false, _) => Some(unsafe { slice::from_raw_parts(from, count) }),
    }
}

/// An array to be written, or `None` if it is null and not empty.
///
/// # Safety
/// It is null or as long as is said, holds numbers, and nothing else reads or writes it.
unsafe fn write<'a>(to: *mut f32, count: usize) -> Option<&'a mut [f32]> {
    match (to.is_null(), count) {
        (_, 0) => Some(&mut []),
        (true, _) => None,
        // SAFETY: the caller promises it.
        (false, _) => Some(unsafe { slice::from_raw_parts_mut(to, count) }),
    }
}
