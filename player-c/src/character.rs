//! What a file holds.

use crate::{GambolHinge, GambolOutside, GambolPart, GambolStatus, GambolWorld};
use alloc::{boxed::Box, sync::Arc};
use core::{ffi::c_char, ptr, slice};
use player::Character;

/// A body and the controller that moves it.
#[derive(Debug)]
pub struct GambolCharacter(pub(crate) Arc<Character>);

/// Reads a character from `length` bytes of a file; they are not needed any more afterwards.
///
/// # Safety
/// `bytes` points to `length` bytes, and `character` to a pointer, which is null afterwards if this fails.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn gambol_character_load(
    bytes: *const u8,
    length: usize,
    character: *mut *mut GambolCharacter,
) -> GambolStatus {
    if character.is_null() {
        return GambolStatus::NullPointer;
    }
    if bytes.is_null() {
        // SAFETY: the caller promises it.
        unsafe { character.write(ptr::null_mut()) };
        return GambolStatus::NullPointer;
    }
    // SAFETY: the caller promises both.
    let bytes = unsafe { slice::from_raw_parts(bytes, length) };
    let (status, loaded) = match Character::from_bytes(bytes) {
        Ok(loaded) => (GambolStatus::Ok, Box::into_raw(Box::new(GambolCharacter(loaded.into())))),
        Err(error) => (error.into(), ptr::null_mut()),
    };
    unsafe { character.write(loaded) };
    status
}

/// The same character facing the other way, with the body to build for it; null for null. It is given back by itself.
///
/// # Safety
/// `character` is null or was loaded and not given back.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn gambol_character_mirrored(character: *const GambolCharacter) -> *mut GambolCharacter {
    // SAFETY: the caller promises it.
    let Some(GambolCharacter(character)) = (unsafe { character.as_ref() }) else { return ptr::null_mut() };
    Box::into_raw(Box::new(GambolCharacter(character.mirrored().into())))
}

/// Gives a character back. Null is allowed.
///
/// # Safety
/// `character` is null or was loaded and not given back.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn gambol_character_free(character: *mut GambolCharacter) {
    if !character.is_null() {
        // SAFETY: it was made by `Box::into_raw` and not given back.
        drop(unsafe { Box::from_raw(character) });
    }
}

/// The name of the creature, as UTF-8 that ends with a 0, cut to `size` bytes with it; returns how many bytes the whole takes
/// without the 0. 0 for null.
///
/// # Safety
/// `character` is null or was loaded and not given back; `name` is null or points to `size` bytes.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn gambol_character_name(
    character: *const GambolCharacter,
    name: *mut c_char,
    size: usize,
) -> usize {
    // SAFETY: the caller promises it.
    let Some(GambolCharacter(character)) = (unsafe { character.as_ref() }) else { return 0 };
    unsafe { copy_text(&character.name, name, size) }
}

/// The name of a part, in the same way.
///
/// # Safety
/// As [`gambol_character_name`].
#[unsafe(no_mangle)]
pub unsafe extern "C" fn gambol_character_part_name(
    character: *const GambolCharacter,
    index: usize,
    name: *mut c_char,
    size: usize,
) -> usize {
    // SAFETY: the caller promises it.
    let part = unsafe { character.as_ref() }.and_then(|GambolCharacter(character)| character.parts.get(index));
    part.map_or(0, |part| unsafe { copy_text(&part.name, name, size) })
}

/// # Safety
/// `to` is null or points to `size` bytes.
unsafe fn copy_text(text: &str, to: *mut c_char, size: usize) -> usize {
    if let (false, Some(room)) = (to.is_null(), size.checked_sub(1)) {
        // Not within a character: what is left is text.
        let mut count = text.len().min(room);
        while !text.is_char_boundary(count) {
            count -= 1;
        }
        // SAFETY: `count` + 1 bytes are there.
        unsafe {
            ptr::copy_nonoverlapping(text.as_ptr().cast(), to, count);
            to.add(count).write(0);
        }
    }
    text.len()
}

/// The world it has learned in.
///
/// # Safety
/// `character` is null or was loaded and not given back; `world` is null or points to one.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn gambol_character_world(
    character: *const GambolCharacter,
    world: *mut GambolWorld,
) -> GambolStatus {
    unsafe { tell(character, world, |character| Some(character.into())) }
}

/// How many parts its body has; 0 for null.
///
/// # Safety
/// `character` is null or was loaded and not given back.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn gambol_character_part_count(character: *const GambolCharacter) -> usize {
    unsafe { count(character, |character| character.parts.len()) }
}

/// A part, from 0; the first is the torso.
///
/// # Safety
/// `character` is null or was loaded and not given back; `part` is null or points to one.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn gambol_character_part(
    character: *const GambolCharacter,
    index: usize,
    part: *mut GambolPart,
) -> GambolStatus {
    unsafe { tell(character, part, |character| character.parts.get(index).map(Into::into)) }
}

/// How many hinges its body has; 0 for null.
///
/// # Safety
/// `character` is null or was loaded and not given back.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn gambol_character_hinge_count(character: *const GambolCharacter) -> usize {
    unsafe { count(character, |character| character.hinges.len()) }
}

/// A hinge, from 0.
///
/// # Safety
/// `character` is null or was loaded and not given back; `hinge` is null or points to one.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn gambol_character_hinge(
    character: *const GambolCharacter,
    index: usize,
    hinge: *mut GambolHinge,
) -> GambolStatus {
    unsafe { tell(character, hinge, |character| character.hinges.get(index).map(Into::into)) }
}

/// How many motors it moves; 0 for null.
///
/// # Safety
/// `character` is null or was loaded and not given back.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn gambol_character_output_count(character: *const GambolCharacter) -> usize {
    unsafe { count(character, |character| character.outputs.len()) }
}

/// The hinge that an output moves, both from 0.
///
/// # Safety
/// `character` is null or was loaded and not given back; `hinge` is null or points to a number.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn gambol_character_output(
    character: *const GambolCharacter,
    index: usize,
    hinge: *mut u32,
) -> GambolStatus {
    unsafe { tell(character, hinge, |character| character.outputs.get(index).map(|&hinge| hinge.into())) }
}

/// How many things the game has to measure for it; 0 for null.
///
/// # Safety
/// `character` is null or was loaded and not given back.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn gambol_character_outside_count(character: *const GambolCharacter) -> usize {
    unsafe { count(character, |character| character.outside().count()) }
}

/// One of these things, from 0.
///
/// # Safety
/// `character` is null or was loaded and not given back; `outside` is null or points to one.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn gambol_character_outside(
    character: *const GambolCharacter,
    index: usize,
    outside: *mut GambolOutside,
) -> GambolStatus {
    unsafe { tell(character, outside, |character| character.outside().nth(index).map(Into::into)) }
}

/// # Safety
/// `character` is null or was loaded and not given back.
unsafe fn count(character: *const GambolCharacter, of: impl FnOnce(&Character) -> usize) -> usize {
    // SAFETY: the caller promises it.
    unsafe { character.as_ref() }.map_or(0, |GambolCharacter(character)| of(character))
}

/// # Safety
/// `character` is null or was loaded and not given back; `to` is null or points to a `T`.
unsafe fn tell<T>(
    character: *const GambolCharacter,
    to: *mut T,
    what: impl FnOnce(&Character) -> Option<T>,
) -> GambolStatus {
    // SAFETY: the caller promises it.
    let (Some(GambolCharacter(character)), false) = (unsafe { character.as_ref() }, to.is_null()) else {
        return GambolStatus::NullPointer;
    };
    let Some(told) = what(character) else { return GambolStatus::Index };
    unsafe { to.write(told) };
    GambolStatus::Ok
}
