//! The players in other languages play the fixtures as this crate does, turn round as it does, and refuse what is damaged:
//! `ports/tests` has a program for each. What a machine does not have is skipped.
#![allow(clippy::print_stderr)]

use player::{Character, Facing, Net, PartState, Player, Shape};
use std::{
    env,
    f32::consts::PI,
    fmt::Write,
    fs,
    path::{Path, PathBuf},
    process::{Command, Output},
};

/// Each with the twins of its parts.
const FIXTURES: [(&str, &[usize]); 2] = [("all-senses", &[0, 1, 2, 3, 4]), ("playing", &[0, 3, 4, 1, 2, 7, 8, 5, 6])];

fn folder(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join(name)
}

/// Whether the machine has a program, and says so if it does not.
fn has(program: &str) -> bool {
    let paths = env::var_os("PATH").unwrap_or_default();
    let is_there =
        env::split_paths(&paths).any(|path| path.join(program).with_extension(env::consts::EXE_EXTENSION).is_file());
    if !is_there {
        eprintln!("skipped: no {program} on this machine");
    }
    is_there
}

/// Runs a program and asserts that it succeeds; what it printed.
fn run(command: &mut Command) -> String {
    let Output { status, stdout, stderr } = command.output().expect("the program starts");
    let (stdout, stderr) = (String::from_utf8_lossy(&stdout), String::from_utf8_lossy(&stderr));
    assert!(status.success(), "{command:?}: {status}\n{stdout}\n{stderr}");
    format!("{stdout}\n{stderr}")
}

/// Replays traces, of bodies that turn round too, with a program that is given the paths of a character and of its trace.
fn assert_plays(language: &str, program: impl Fn() -> Command) {
    let (fixtures, made) = (folder("fixtures"), Path::new(env!("CARGO_TARGET_TMPDIR")).join(language));
    fs::create_dir_all(&made).expect("a folder");
    for (name, twins) in FIXTURES {
        let (file, trace) = (fixtures.join(format!("{name}.player")), fixtures.join(format!("{name}.trace.csv")));
        assert_replays(program().args([&file, &trace]));
        let (mut character, trace) = (character(&file), fs::read_to_string(trace).expect("a trace"));
        for way in ["turning", "turning-rotated"] {
            let (file, turning) = (made.join(format!("{name}-{way}.player")), made.join(format!("{name}-{way}.csv")));
            fs::write(&file, character.to_bytes().expect("valid")).expect("a file");
            fs::write(&turning, turning_trace(&character, twins, &trace)).expect("a file");
            assert_replays(program().args([file, turning]));
            // Then no output is at the place of its hinge.
            character.outputs.rotate_left(1);
        }
    }
    assert_knows_symmetry(&made, program());
}

fn assert_replays(program: &mut Command) {
    let printed = run(program);
    // Some interpreters succeed where a program has failed to begin.
    assert!(printed.lines().any(|line| line == "checked"), "{program:?}: {printed}");
    let line = printed.lines().find(|line| line.starts_with("greatest difference"));
    eprintln!("{program:?}: {}", line.unwrap_or_default());
}

fn character(path: &Path) -> Character {
    Character::from_bytes(&fs::read(path).expect("a file")).expect("a character")
}

/// A trace that a body makes that turns round every 20 frames, to the left first: its net senses what it senses in a trace that
/// faces right. A last column says whether it faces left.
fn turning_trace(character: &Character, twins: &[usize], trace: &str) -> String {
    let mut player = Player::new(character.clone().into()).expect("valid");
    let (header, lines) = trace.split_once('\n').expect("lines");
    let mut rows = format!("{header},faces_left\n");
    for (step, line) in lines.lines().enumerate() {
        let numbers: Vec<f32> = line.split(',').map(|number| number.parse().expect("a number")).collect();
        let (states, rest) = numbers[4..].split_at(8 * twins.len());
        let (outside, expected) = rest.split_at(character.outside().count());
        let is_left = step / 20 % 2 == 0;
        player.face(if is_left { Facing::Left } else { Facing::Right }).expect("it is symmetric");
        let part = |(index, &twin): (usize, &usize)| {
            let part = state(&states[8 * if is_left { twin } else { index }..]);
            if is_left { mirrored(part) } else { part }
        };
        let parts: Vec<PartState> = twins.iter().enumerate().map(part).collect();
        let seconds = player.seconds() as f32;
        let command = player::Command { speed: numbers[2], jump: numbers[3] as u32 };
        let speeds = player.tick(&parts, outside, command, character.world.time_step).expect("a frame").to_vec();
        assert_eq!(player.inputs(), &expected[..player.inputs().len()], "step {step}");
        let told = [step as f32, seconds, command.speed, command.jump as f32];
        let states = parts
            .iter()
            .flat_map(|part| [part.x, part.y, part.cos, part.sin, part.vx, part.vy, part.spin, part.touching as f32]);
        let told = told.into_iter().chain(states).chain(outside.iter().copied());
        let made = player.inputs().iter().copied().chain(player.outputs()).chain(speeds);
        told.chain(made).for_each(|number| write!(rows, "{number},").expect("a text"));
        writeln!(rows, "{}", u32::from(is_left)).expect("a text");
    }
    rows
}

fn state(numbers: &[f32]) -> PartState {
    let [x, y, cos, sin, vx, vy, spin, touching] = *numbers.first_chunk().expect("eight numbers");
    PartState { x, y, cos, sin, vx, vy, spin, touching: touching as u32 }
}

fn mirrored(part: PartState) -> PartState {
    PartState { x: -part.x, sin: -part.sin, vx: -part.vx, spin: -part.spin, ..part }
}

/// A program that is given paths of characters prints of each what this crate says, in the same words.
fn assert_knows_symmetry(made: &Path, mut program: Command) {
    let mut expected = Vec::new();
    for (index, character) in bodies().into_iter().enumerate() {
        let file = made.join(format!("body-{index:02}.player"));
        fs::write(&file, character.to_bytes().expect("valid")).expect("a file");
        program.arg(file);
        expected.push(character.symmetry().map_or_else(|why| why.to_string(), |()| "symmetric".to_owned()));
    }
    let said = ["symmetric", "part ", "the hinge of part "];
    assert!(said.iter().all(|said| expected.iter().any(|line| line.starts_with(said))), "{expected:?}");
    let printed = run(&mut program);
    let found: Vec<&str> = printed.lines().filter(|line| said.iter().any(|said| line.starts_with(said))).collect();
    assert_eq!(found, expected);
}

/// Bodies that look the same from both sides, and one for each way in which a body may not, by as much as is just allowed too.
fn bodies() -> Vec<Character> {
    let shipped = folder("../examples/hurdle-race/characters");
    let names = ["apod", "biped-1", "biped-2", "tetrapod-1", "tetrapod-2", "decapod-1", "decapod-2"];
    let mut bodies: Vec<Character> =
        names.iter().map(|name| character(&shipped.join(name).with_extension("player"))).collect();
    let tetrapod = character(&folder("fixtures/playing.player"));
    let mut add = |change: &dyn Fn(&mut Character)| {
        let mut character = tetrapod.clone();
        change(&mut character);
        bodies.push(character);
    };
    // The least and the most that count as near are a few bits apart.
    for by in [1e-2, 1.01e-4, 1.0002e-4, 1.0001e-4, 1e-4, 0.9999e-4, 0.9998e-4, 0.99e-4, -1e-4] {
        add(&|body| body.parts[3].x += by);
        add(&|body| body.parts[4].y += by);
        add(&|body| body.parts[5].angle += by);
        add(&|body| body.parts[6].angle += by + PI);
        add(&|body| body.parts[7].density *= 1.0 + by);
        add(&|body| body.parts[8].friction += by);
        add(&|body| body.hinges[0].parent_anchor[0] += by);
        add(&|body| body.hinges[1].parent_anchor[1] += by);
        add(&|body| body.hinges[2].child_anchor[0] += by);
        add(&|body| body.hinges[3].child_anchor[1] += by);
        add(&|body| body.hinges[4].limits[0] -= by.abs());
        add(&|body| body.hinges[5].limits[1] += by.abs());
        add(&|body| body.hinges[6].motor.iter_mut().for_each(|motor| motor.top_speed *= 1.0 + by));
        add(&|body| body.hinges[7].motor.iter_mut().for_each(|motor| motor.top_torque *= 1.0 + by));
        add(&|body| body.parts.iter_mut().for_each(|part| part.x += 10.0 * by));
    }
    add(&|body| body.parts[2].shape = Shape::Circle { radius: 0.1 });
    add(&|body| body.parts[2].shape = Shape::Box { width: 0.1, height: 0.45 });
    // Legs whose twin is not the first that looks like it.
    add(&|body| (body.hinges[0].limits, body.hinges[6].limits) = ([-0.3, 0.6], [-0.6, 0.3]));
    // Three legs in front.
    add(&|body| {
        [3, 4].into_iter().for_each(|part| body.parts[part].x *= -1.0);
        body.hinges[2].parent_anchor[0] *= -1.0;
    });
    // The last hinge without its output, and without its motor.
    let shorter = |body: &mut Character| {
        let (neurons, outputs): (Vec<_>, _) = (body.net.neurons().collect(), &body.net.outputs()[1..]);
        body.net = Net::new(body.net.inputs(), &neurons, outputs.to_vec()).expect("a net");
        body.outputs.pop();
    };
    add(&shorter);
    add(&|body| {
        shorter(body);
        body.hinges[7].motor = None;
    });
    bodies
}

#[test]
fn javascript() {
    if !has("node") {
        return;
    }
    assert_plays("javascript", || {
        let mut node = Command::new("node");
        node.arg(folder("ports").join("tests").join("check.mjs"));
        node
    });
}

#[test]
fn c_sharp() {
    if !has("mcs") || !has("mono") {
        return;
    }
    let program = Path::new(env!("CARGO_TARGET_TMPDIR")).join("check.exe");
    let sources = [folder("ports").join("GambolPlayer.cs"), folder("ports").join("tests").join("Check.cs")];
    run(Command::new("mcs")
        .args(["-langversion:7", "-warnaserror"])
        .arg(format!("-out:{}", program.display()))
        .args(sources));
    assert_plays("c-sharp", || {
        let mut mono = Command::new("mono");
        mono.arg(&program);
        mono
    });
}

#[test]
fn gdscript() {
    // Of version 3, for `check.gd` opens files as that does; and a server, for machines without a screen.
    if !has("godot3-server") {
        return;
    }
    // Godot writes into the folder of a project.
    let project = Path::new(env!("CARGO_TARGET_TMPDIR")).join("godot");
    fs::create_dir_all(&project).expect("a folder");
    for file in ["gambol_player.gd", "tests/check.gd"].map(|file| folder("ports").join(file)) {
        fs::copy(&file, project.join(file.file_name().expect("a file"))).expect("a copy");
    }
    assert_plays("gdscript", || {
        let mut godot = Command::new("godot3-server");
        godot.arg("--path").arg(&project).args(["--script", "check.gd"]).env("HOME", &project);
        godot
    });
}
