//! Doing as it is told.

use super::{BodyFacts, MovementDefaults, terms, with};
use crate::config::{StageSettings, Transferred};
use creatures::Sensor;
use ne_core::promotion::PromotionRule;
use serde_json::{Map, Value, json};
use tasks::{Commands, RandomCommands, TermSpec};

/// 20 s, of which training has 10.
const STEPS: (Option<u32>, Option<u32>) = (Some(1000), Some(500));

/// What follows soundly after fewer steps of training is a lucky one.
const LEAST_STEPS: u64 = 80_000_000;
/// What does not follow after so many goes on all the same.
const MOST_STEPS: u64 = 200_000_000;

/// The turn of the jump clock, s: within half a second of the press a body has to crouch and to push off. With 1 s one search in
/// four finds a jump in 12 million steps, with 0.5 or 0.65 s all do (tetrapod-2, four seeds each).
const JUMP_CLOCK: f32 = 0.6;

/// The fewest and the most steps in which it learns to jump.
const JUMP_STEPS: [u64; 2] = [60_000_000, 150_000_000];

/// How long the jump has the body, s: until it has landed.
const JUMP_TURN: f32 = 1.2;

/// First it learns to move as fast as it is told and to stand, by a clock that swings with the speed; and then to jump, by a
/// clock that a press starts. What learns both at once learns one: what can jump stays where it is, and what runs does
/// not dare to jump. And what learns to jump may forget to run: so the stride is held meanwhile. In the end all of it is searched,
/// since a stride that is held has never landed.
pub(super) fn playing(body: &BodyFacts) -> MovementDefaults {
    let unknown = MovementDefaults::unknown(body);
    let mut wanted = vec![with(TermSpec::new("no-exploits", 0.0), "ends", true)];
    wanted.extend(terms(match body.legs {
        0 => &[("vibration", -0.1)],
        _ => &[("posture", -0.1), ("vibration", -0.1)],
    }));
    MovementDefaults {
        steps: STEPS.0,
        training_steps: STEPS.1,
        terms: wanted,
        commands: Some(Commands::Random(RandomCommands { jumps: 0.0, ..RandomCommands::default() })),
        // Softer legs do not jump.
        gain: unknown.gain.max(15.0),
        trials: Some(6),
        stages: vec![follow(), jump(), polish()],
        ..unknown
    }
}

fn follow() -> StageSettings {
    let either = vec![
        PromotionRule::All(vec![PromotionRule::Usable, PromotionRule::Steps(LEAST_STEPS)]),
        PromotionRule::Steps(MOST_STEPS),
    ];
    StageSettings { promotion: Some(PromotionRule::Any(either)), ..stage("follow", json!({})) }
}

/// With the stride held, jumps are all there is to learn.
fn jump() -> StageSettings {
    let changes = json!({
        "commands": { "random": { "jumps": 0.4 } },
        "movement": { "settings": { "jump": 4.0 } },
        "trials": { "count": 8, "lessons": true }
    });
    let add_sensors = [JUMP_CLOCK, JUMP_TURN].map(|period| Sensor::JumpClock { period }).into();
    let either = vec![
        PromotionRule::All(vec![PromotionRule::Usable, PromotionRule::Steps(JUMP_STEPS[0])]),
        PromotionRule::Steps(JUMP_STEPS[1]),
    ];
    let promotion = Some(PromotionRule::Any(either));
    StageSettings { add_sensors, promotion, transfer: Some(Transferred::Held), ..stage("jump", changes) }
}

/// All of it together: a stride that has never landed learns to go on from there.
fn polish() -> StageSettings {
    let changes = json!({ "trials": { "count": 8, "lessons": false } });
    StageSettings { transfer: Some(Transferred::Champion), ..stage("polish", changes) }
}

fn stage(name: &str, changes: Value) -> StageSettings {
    StageSettings {
        name: name.into(),
        changes: if let Value::Object(changes) = changes { changes } else { Map::new() },
        add_sensors: Vec::new(),
        promotion: None,
        demotion: None,
        transfer: None,
        allow_loss: false,
    }
}
