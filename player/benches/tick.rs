//! One frame of a character, and of a thousand: `cargo bench -p gambol-player`.
//!
//! The file of another character can be named in `GAMBOL_CHARACTER`.

use criterion::{Criterion, criterion_group, criterion_main};
use player::{Character, Command, PartState, Player};
use std::hint::black_box;

fn tick(criterion: &mut Criterion) {
    let given = std::env::var_os("GAMBOL_CHARACTER").map(|path| std::fs::read(path).expect("a file"));
    let fixture = include_bytes!("../fixtures/playing.player").to_vec();
    let character = Character::from_bytes(&given.unwrap_or(fixture)).expect("a character");
    let parts: Vec<PartState> = character.start_pose().collect();
    let outside: Vec<f32> = character.outside().map(|_| 1.0).collect();
    let nodes = character.net.nodes();
    let mut player = Player::new(character.into()).expect("valid");
    let mut crowd: Vec<Player> = (0..1000).map(|_| player.another()).collect();
    let mut group = criterion.benchmark_group(format!("{}, a net of {nodes} nodes", player.character().name));
    let command = Command::run(1.0);
    group.bench_function("tick", |bencher| {
        bencher.iter(|| player.tick(black_box(&parts), &outside, command, 0.02).map(|speeds| speeds[0]));
    });
    group.bench_function("1000 characters", |bencher| {
        bencher.iter(|| {
            for player in &mut crowd {
                black_box(player.tick(black_box(&parts), &outside, command, 0.02).is_ok());
            }
        });
    });
    group.finish();
}

criterion_group!(benches, tick);
criterion_main!(benches);
