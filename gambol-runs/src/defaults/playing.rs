//! Doing as it is told.

use super::{BodyFacts, MovementDefaults, terms, with};
use crate::config::{GiveUp, StageSettings, Transferred};
use creatures::Sensor;
use ne_core::promotion::PromotionRule;
use serde_json::{Map, Value, json};
use tasks::{Commands, RandomCommands, TermSpec};

/// 40 s, of which training has 10: a champion that falls after half a minute is none.
const STEPS: (Option<u32>, Option<u32>) = (Some(2000), Some(500));

/// What differs between bodies that balance and others. Of a stage the fewest and the most steps: what is usable after fewer is a lucky
/// one; what is not after so many goes on all the same.
struct Plan {
    move_on: [u64; 2],
    follow: [u64; 2],
    jump: [u64; 2],
    polish: [u64; 2],
    /// Of all stages, those that were given up included: some five minutes on one core.
    most: u64,
    /// Another stride is searched for if `move` earns less than this, in s of 40, after so many steps; so often.
    give_up_move: Option<(f64, u64, u32)>,
    /// Or if `follow` has nothing usable after so many steps; so often.
    give_up_follow: Option<(u64, u32)>,
    /// Or if `jump` earns less than this, in s of about 57, after so many steps; so often.
    give_up_jump: (f64, u64, u32),
    /// And if `polish` has nothing playable after so many steps; so often.
    give_up_polish: Option<(u64, u32)>,
    /// Of a few searches for the stride, or for the jump, the best goes on.
    starts: u64,
    /// What a jump is worth in `polish`, s. A press that fails by a few centimetres costs little of it, and all of a schedule of
    /// commands; where a jump was worth as much as of other bodies, a biped fell more (docs/playing-experiments.md).
    polished_jump: f64,
}

/// Five of five tetrapods that earned less than 45 s after 15 million steps of `jump` were not playable after 70 million, and of ten that
/// earned more six were (docs/playing-experiments.md).
const PLAN: Plan = Plan {
    move_on: [8_000_000, 16_000_000],
    follow: [8_000_000, 40_000_000],
    jump: [8_000_000, 30_000_000],
    polish: [60_000_000, 120_000_000],
    most: 350_000_000,
    give_up_move: None,
    give_up_follow: Some((30_000_000, 3)),
    give_up_jump: (45.0, 15_000_000, 3),
    give_up_polish: Some((40_000_000, 2)),
    starts: 1,
    polished_jump: 10.0,
};

/// Bodies that balance find each of it later. Of nine searches for their jump three earned less than 36 s after 25 million steps, and 32,
/// 36 and 48 in the end; the others 47 to 52 (docs/playing-experiments.md).
const BALANCED_PLAN: Plan = Plan {
    move_on: [8_000_000, 60_000_000],
    follow: [20_000_000, 40_000_000],
    jump: [8_000_000, 60_000_000],
    polish: [200_000_000, 400_000_000],
    most: 650_000_000,
    give_up_move: Some((31.0, 40_000_000, 4)),
    give_up_follow: None,
    give_up_jump: (36.0, 25_000_000, 2),
    give_up_polish: None,
    starts: 3,
    polished_jump: 4.0,
};

/// The slowest and the fastest speed that two legs are told, body lengths/s: alone they run at 0.6 to 0.7.
const BIPED_SPEEDS: [f32; 2] = [0.4, 1.2];

/// The share of holds in which it is told to stand, once it can move.
const STANDING: f32 = 0.25;

/// The turns of the jump clocks, s: in the first a body has to crouch and to push off, half a second after the press at the latest;
/// in the second it has to land. The sooner, the more time is left to be on its way again.
const JUMP_CLOCKS: [f32; 2] = [0.4, 0.8];

/// The same for two legs with knees: with the shorter ones biped-2 does not jump, in three of three searches; with these biped-1 and
/// tetrapod-2 miss more presses (docs/playing-experiments.md).
const BALANCED_JUMP_CLOCKS: [f32; 2] = [0.6, 1.2];

/// What a jump is worth while there is nothing else to learn, s.
const JUMP_WORTH: f64 = 4.0;

/// How long each of several searches lasts.
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
    let plan = if is_biped { &BALANCED_PLAN } else { &PLAN };
    let clocks = if is_biped && body.joints > 1 { BALANCED_JUMP_CLOCKS } else { JUMP_CLOCKS };
    let strategy: [(&str, Value); 3] =
        [("restart", "anew".into()), ("starts", plan.starts.into()), ("start_generations", START_GENERATIONS.into())];
    MovementDefaults {
        steps: STEPS.0,
        training_steps: STEPS.1,
        terms: wanted,
        commands: Some(Commands::Random(random)),
        // Softer legs do not jump.
        gain: unknown.gain.max(15.0),
        trials: Some(6),
        most_steps: Some(plan.most),
        stages: vec![move_on(plan), follow(plan), jump(plan, clocks), polish(plan), harden()],
        strategy: strategy.into_iter().map(|(name, value)| (name.to_owned(), value)).collect(),
        ..unknown
    }
}

fn move_on(plan: &Plan) -> StageSettings {
    let changes = json!({ "commands": { "random": { "standing": 0.0 } } });
    let give_up = plan.give_up_move.map(|(least, steps, times)| give_up(steps, PromotionRule::Fitness(least), times));
    StageSettings { near: true, promotion: usable_within(plan.move_on), give_up, ..stage("move", changes) }
}

fn follow(plan: &Plan) -> StageSettings {
    let changes = json!({ "commands": { "random": { "standing": STANDING } } });
    let give_up = plan.give_up_follow.map(|(steps, times)| give_up(steps, PromotionRule::Usable, times));
    StageSettings { near: true, promotion: usable_within(plan.follow), give_up, ..stage("follow", changes) }
}

/// With the stride held, jumps are all there is to learn: out of every hold.
fn jump(plan: &Plan, clocks: [f32; 2]) -> StageSettings {
    let changes =
        json!({ "commands": { "random": { "jumps": 1.0 } }, "movement": { "settings": { "jump": JUMP_WORTH } } });
    let add_sensors = clocks.map(|period| Sensor::JumpClock { period }).into();
    let (promotion, transfer) = (usable_within(plan.jump), Some(Transferred::Held));
    let (least, steps, times) = plan.give_up_jump;
    let give_up = Some(give_up(steps, PromotionRule::Fitness(least), times));
    StageSettings { near: true, add_sensors, promotion, give_up, transfer, ..stage("jump", changes) }
}

/// All of it together: a stride that has never landed learns to go on from there.
fn polish(plan: &Plan) -> StageSettings {
    let changes = json!({
        "commands": { "random": { "jumps": 0.4 } },
        "movement": { "settings": { "jump": plan.polished_jump } },
        "trials": { "count": 8 },
    });
    let (promotion, transfer) = (usable_within(plan.polish), Some(Transferred::Champion));
    let give_up = plan.give_up_polish.map(|(steps, times)| give_up(steps, PromotionRule::Usable, times));
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
