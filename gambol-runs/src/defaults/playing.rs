//! Doing as it is told.

use super::{BodyFacts, MovementDefaults, terms, with};
use crate::config::{GiveUp, StageSettings, Transferred};
use creatures::Sensor;
use ne_core::promotion::PromotionRule;
use serde_json::{Map, Value, json};
use tasks::{Commands, RandomCommands, TermSpec};

/// 40 s, of which training has 10: a champion that falls after half a minute is none.
const STEPS: (Option<u32>, Option<u32>) = (Some(2000), Some(500));

/// The fewest and the most steps of a stage. What is usable after fewer is a lucky one; what is not after so many goes on all the same.
struct StageSteps {
    move_on: [u64; 2],
    follow: [u64; 2],
    jump: [u64; 2],
}

const STAGE_STEPS: StageSteps =
    StageSteps { move_on: [8_000_000, 16_000_000], follow: [8_000_000, 100_000_000], jump: [8_000_000, 30_000_000] };

/// Those of bodies that balance: they find each of it later.
const BALANCED_STAGE_STEPS: StageSteps =
    StageSteps { move_on: [8_000_000, 100_000_000], follow: [20_000_000, 100_000_000], jump: [8_000_000, 80_000_000] };

/// It has most of a run of some minutes: of four tetrapods `harden` made one playable in its time, this two (docs/playing.md).
const POLISH_STEPS: [u64; 2] = [60_000_000, 120_000_000];

/// What earns less than this, in s of about 57, after so many steps of `jump` is given up, and another stride is searched for: five of
/// five tetrapods that did were not playable after 70 million steps, and of ten that earned more six were. Not of bodies that
/// balance: with them another stride takes too long.
const LEAST_OF_JUMP: f64 = 45.0;
const ATTEMPT_OF_JUMP: u64 = 15_000_000;

/// And so is what is not playable after so many steps of `polish`.
const ATTEMPT_OF_POLISH: u64 = 40_000_000;

/// The slowest and the fastest speed that two legs are told, body lengths/s: alone they run at 0.6 to 0.7.
const BIPED_SPEEDS: [f32; 2] = [0.4, 1.2];

/// The share of holds in which it is told to stand, once it can move.
const STANDING: f32 = 0.25;

/// The turns of the jump clocks, s: in the first a body has to crouch and to push off, half a second after the press at the latest;
/// in the second it has to land. The sooner, the more time is left to be on its way again.
const JUMP_CLOCKS: [f32; 2] = [0.4, 0.8];

/// The same for two legs with knees: with the shorter ones biped-2 does not jump, in three of three searches; with these biped-1 and
/// tetrapod-2 miss more presses (docs/playing.md).
const BALANCED_JUMP_CLOCKS: [f32; 2] = [0.6, 1.2];

/// What a jump is worth while there is nothing else to learn, s.
const JUMP_WORTH: f64 = 4.0;

/// Of a few searches for the stride of two legs, or for their jump, the best goes on.
const STARTS: u64 = 3;
const START_GENERATIONS: u64 = 40;

/// First it learns to move as fast as it is told, and nothing else: a body that has to balance, and may also stand, stands. Then it
/// learns to stop and to stand, by a clock that swings with the speed; and then to jump, by a clock that a press starts. What
/// learns both at once learns one: what can jump stays where it is, and what runs does not dare to jump. And what learns to jump
/// may forget to run: so the stride is held meanwhile. Then all of it is searched, since a stride that is held has never
/// landed. All this is found in worlds that hardly vary; in the end it is hardened in those that do.
pub(super) fn playing(body: &BodyFacts) -> MovementDefaults {
    let unknown = MovementDefaults::unknown(body);
    let is_biped = (1..=2).contains(&body.legs);
    let mut wanted = vec![with(TermSpec::new("no-exploits", 0.0), "ends", true)];
    wanted.extend(terms(match body.legs {
        0 => &[("vibration", -0.1)],
        _ => &[("posture", -0.1), ("vibration", -0.1)],
    }));
    let random = RandomCommands { jumps: 0.0, ..RandomCommands::default() };
    let random = if is_biped { RandomCommands { speeds: BIPED_SPEEDS, ..random } } else { random };
    let (steps, starts) = if is_biped { (&BALANCED_STAGE_STEPS, STARTS) } else { (&STAGE_STEPS, 1) };
    let clocks = if is_biped && body.joints > 1 { BALANCED_JUMP_CLOCKS } else { JUMP_CLOCKS };
    let give_up_jump = give_up(ATTEMPT_OF_JUMP, PromotionRule::Fitness(LEAST_OF_JUMP), 3);
    let give_up_polish = give_up(ATTEMPT_OF_POLISH, PromotionRule::Usable, 2);
    let [give_up_jump, give_up_polish] = [give_up_jump, give_up_polish].map(|rule| (!is_biped).then_some(rule));
    let strategy: [(&str, Value); 3] =
        [("restart", "anew".into()), ("starts", starts.into()), ("start_generations", START_GENERATIONS.into())];
    MovementDefaults {
        steps: STEPS.0,
        training_steps: STEPS.1,
        terms: wanted,
        commands: Some(Commands::Random(random)),
        // Softer legs do not jump.
        gain: unknown.gain.max(15.0),
        trials: Some(6),
        stages: vec![
            move_on(steps),
            follow(steps),
            jump(steps, clocks, give_up_jump),
            polish(give_up_polish),
            harden(),
        ],
        strategy: strategy.into_iter().map(|(name, value)| (name.to_owned(), value)).collect(),
        ..unknown
    }
}

fn move_on(steps: &StageSteps) -> StageSettings {
    let changes = json!({ "commands": { "random": { "standing": 0.0 } } });
    StageSettings { near: true, promotion: usable_within(steps.move_on), ..stage("move", changes) }
}

fn follow(steps: &StageSteps) -> StageSettings {
    let changes = json!({ "commands": { "random": { "standing": STANDING } } });
    StageSettings { near: true, promotion: usable_within(steps.follow), ..stage("follow", changes) }
}

/// With the stride held, jumps are all there is to learn: out of every hold.
fn jump(steps: &StageSteps, clocks: [f32; 2], give_up: Option<GiveUp>) -> StageSettings {
    let changes =
        json!({ "commands": { "random": { "jumps": 1.0 } }, "movement": { "settings": { "jump": JUMP_WORTH } } });
    let add_sensors = clocks.map(|period| Sensor::JumpClock { period }).into();
    let (promotion, transfer) = (usable_within(steps.jump), Some(Transferred::Held));
    StageSettings { near: true, add_sensors, promotion, give_up, transfer, ..stage("jump", changes) }
}

/// All of it together: a stride that has never landed learns to go on from there. A jump counts no more than its time.
fn polish(give_up: Option<GiveUp>) -> StageSettings {
    let worth = tasks::PlayingSettings::default().jump;
    let changes = json!({
        "commands": { "random": { "jumps": 0.4 } },
        "movement": { "settings": { "jump": worth } },
        "trials": { "count": 8 },
    });
    let (promotion, transfer) = (usable_within(POLISH_STEPS), Some(Transferred::Champion));
    StageSettings { near: true, promotion, give_up, transfer, ..stage("polish", changes) }
}

/// And in worlds that vary as the configuration has it.
fn harden() -> StageSettings {
    stage("harden", json!({}))
}

/// Once the champion is usable, but not before the fewest of these steps; at the latest after the most.
fn usable_within([fewest, most]: [u64; 2]) -> Option<PromotionRule> {
    let usable = PromotionRule::All(vec![PromotionRule::Usable, PromotionRule::Steps(fewest)]);
    Some(PromotionRule::Any(vec![usable, PromotionRule::Steps(most)]))
}

/// To another stride, so often, if this is not met after so many steps.
fn give_up(steps: u64, unless: PromotionRule, times: u32) -> GiveUp {
    let when = PromotionRule::All(vec![PromotionRule::Steps(steps), PromotionRule::Not(Box::new(unless))]);
    GiveUp { when, back_to: "move".into(), times }
}

fn stage(name: &str, changes: Value) -> StageSettings {
    StageSettings {
        name: name.into(),
        changes: if let Value::Object(changes) = changes { changes } else { Map::new() },
        add_sensors: Vec::new(),
        near: false,
        promotion: None,
        demotion: None,
        give_up: None,
        transfer: None,
        allow_loss: false,
    }
}
