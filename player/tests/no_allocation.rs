//! `tick` and `torques` allocate nothing. In a binary of its own, since it counts the allocations of the whole program.

use player::{Character, Command, PartState, Player};
use std::{
    alloc::{GlobalAlloc, Layout, System},
    sync::atomic::{AtomicUsize, Ordering},
};

struct Counting;

static ALLOCATIONS: AtomicUsize = AtomicUsize::new(0);

// The trait is unsafe to implement; each method hands its call on to the system's allocator as it came.
#[allow(unsafe_code)]
unsafe impl GlobalAlloc for Counting {
    unsafe fn alloc(&self, layout: Layout) -> *mut u8 {
        ALLOCATIONS.fetch_add(1, Ordering::Relaxed);
        unsafe { System.alloc(layout) }
    }
    unsafe fn dealloc(&self, pointer: *mut u8, layout: Layout) {
        unsafe { System.dealloc(pointer, layout) }
    }
    unsafe fn realloc(&self, pointer: *mut u8, layout: Layout, size: usize) -> *mut u8 {
        ALLOCATIONS.fetch_add(1, Ordering::Relaxed);
        unsafe { System.realloc(pointer, layout, size) }
    }
}

#[global_allocator]
static ALLOCATOR: Counting = Counting;

#[test]
fn a_frame_allocates_nothing() {
    for file in [&include_bytes!("../fixtures/all-senses.player")[..], include_bytes!("../fixtures/playing.player")] {
        let character = Character::from_bytes(file).expect("a character");
        let mut parts: Vec<PartState> = character.start_pose().collect();
        let outside: Vec<f32> = character.outside().map(|_| 1.0).collect();
        let mut torques = vec![0.0; character.outputs.len()];
        for character in [character.mirrored(), character] {
            let mut player = Player::new(character.into()).expect("valid");
            let before = ALLOCATIONS.load(Ordering::Relaxed);
            for frame in 0..200 {
                parts[0].spin = frame as f32 * 0.01;
                let command = if frame % 60 < 5 { Command::run(1.0).jumping() } else { Command::run(1.0) };
                assert!(player.tick(&parts, &outside, command, 0.02).is_ok());
                player.torques(&parts, &mut torques);
                assert!(player.tick(&parts[1..], &outside, command, 0.02).is_err());
                player.reset();
            }
            assert_eq!(ALLOCATIONS.load(Ordering::Relaxed), before);
        }
    }
}
