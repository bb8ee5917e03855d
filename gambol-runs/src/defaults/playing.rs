//! Doing as it is told.

use super::{BodyFacts, MovementDefaults, terms, with};
use crate::{
    config::{GiveUp, StageSettings, Transferred},
    tiers::DEPENDABLE,
};
use creatures::Sensor;
use ne_core::promotion::PromotionRule::{self, All, Any, Fitness, Not, Steps, Tier, Usable};
use serde_json::{Map, Value, json};
use tasks::{Commands, RandomCommands, TermSpec};

/// 40 s, of which training has 10: a champion that falls after half a minute is none.
const STEPS: (Option<u32>, Option<u32>) = (Some(2000), Some(500));

/// What differs between bodies that balance and others.
struct Plan {
    move_on: StagePlan,
    follow: StagePlan,
    jump: StagePlan,
    polish: StagePlan,
    /// Of all stages, those that were given up included: five minutes to a quarter of an hour on two cores (docs/playing.md).
    most: u64,
    /// What a jump is worth in `polish`, s. A press that fails by a few centimetres costs little of it, and all of a schedule of
    /// commands; where a jump was worth as much as of other bodies, a biped fell more (docs/playing-experiments.md).
    polished_jump: f64,
}

/// The stage in which a stride is searched for.
const STRIDE: &str = "move";

struct StagePlan {
    /// Of each candidate.
    trials: u32,
    /// The fewest and the most: what is usable after fewer is a lucky one; what is not after so many goes on all the same.
    steps: [u64; 2],
    give_up: Option<Anew>,
}

/// What a search has found is given up when this is met, and another stride is searched for; so often.
struct Anew {
    when: PromotionRule,
    times: u32,
}

fn search(trials: u32, steps: [u64; 2], give_up: Option<Anew>) -> StagePlan {
    StagePlan { trials, steps, give_up }
}

fn anew(when: PromotionRule, times: u32) -> Option<Anew> {
    Some(Anew { when, times })
}

/// Met after so many steps where this is not.
fn not_after(steps: u64, rule: PromotionRule) -> PromotionRule {
    All(vec![Steps(steps), Not(Box::new(rule))])
}

/// Of CMA-ES: where worlds and commands differ from trial to trial the search stays about as coarse as it begins. With 0.5 strides are
/// found later and are worse; with 0.1 biped-2 stands still, whatever it is told (docs/playing-experiments.md).
const STEP_SIZE: f64 = 0.2;

/// Of CMA-ES: with 0.1, as other gaits have it, what is polished wanders about where it would settle (docs/playing-experiments.md).
const LEAST_DEVIATION: f64 = 0.03;

/// The least that a stride or a jump has to earn is of what became playable, and what did not (docs/playing-experiments.md): of 40 s in
/// `move`, of about 57 s in `jump`.
fn plan() -> Plan {
    Plan {
        move_on: search(6, [8_000_000, 16_000_000], anew(not_after(12_000_000, Fitness(33.5)), 5)),
        follow: search(6, [8_000_000, 40_000_000], anew(not_after(30_000_000, Usable), 3)),
        // A longer search is worth less than the same steps of `polish` (docs/playing-experiments.md).
        jump: search(6, [8_000_000, 14_000_000], anew(not_after(12_000_000, Fitness(44.0)), 4)),
        polish: search(8, [60_000_000, 120_000_000], anew(not_after(40_000_000, Any(vec![Usable, Fitness(60.0)])), 2)),
        most: 350_000_000,
        polished_jump: 10.0,
    }
}

/// Bodies that balance find each of it later. Fewer trials a candidate teach every body its stride sooner, but tetrapods were not more
/// often playable afterwards. Strides, and searches of one stride, differ more than what `polish` adds to one after 60 million steps: so
/// others are tried until one is playable in nearly every schedule. What falls with the jump that is made by hand after 4 million steps
/// seldom jumps after 12 million (docs/playing-experiments.md).
fn balanced_plan() -> Plan {
    // A fitness of 0: there is a champion.
    let falls = All(vec![Steps(4_000_000), Fitness(0.0), Not(Box::new(Fitness(20.0)))]);
    let jump_is_low = not_after(12_000_000, Fitness(40.0));
    Plan {
        move_on: search(1, [8_000_000, 24_000_000], anew(not_after(8_000_000, Fitness(33.0)), 4)),
        follow: search(3, [10_000_000, 40_000_000], None),
        jump: search(6, [8_000_000, 20_000_000], anew(Any(vec![falls, jump_is_low]), 8)),
        polish: search(8, [200_000_000, 400_000_000], anew(not_after(60_000_000, Tier(DEPENDABLE.into())), 4)),
        most: 650_000_000,
        polished_jump: 4.0,
    }
}

/// The slowest and the fastest speed that two legs are told, body lengths/s: alone they run at 0.6 to 0.7.
const BIPED_SPEEDS: [f32; 2] = [0.4, 1.2];

/// The share of holds in which it is told to stand, once it can move.
const STANDING: f32 = 0.25;

/// With 4 bipeds are playable in fewer schedules (docs/playing-experiments.md).
const BALANCED_HIDDEN: usize = 8;

/// Periods of the jump clocks, s. The body crouches in the first half of the first period and pushes off in the second half, since it must
/// be in the air half a second after the press. It lands before the second period is over; a short one leaves more time for the next
/// stride. A body that runs needs 0.3 s to come down (docs/playing-experiments.md).
const JUMP_CLOCKS: [f32; 2] = [0.6, 0.9];

/// The same for two legs with knees: with a first period of 0.6 s, or a second of 1 s, biped-2 is playable in fewer schedules.
const BALANCED_JUMP_CLOCKS: [f32; 2] = [0.7, 1.2];

/// What a jump is worth while there is nothing else to learn, s.
const JUMP_WORTH: f64 = 4.0;

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
        // With -0.5 biped-2 did not learn its stride (docs/playing-experiments.md).
        2 => &[("posture", -0.1), ("vibration", -0.1), ("alternation", -0.1)],
        _ => &[("posture", -0.1), ("vibration", -0.1)],
    }));
    let random = RandomCommands { jumps: 0.0, ..RandomCommands::default() };
    let random = if is_biped { RandomCommands { speeds: BIPED_SPEEDS, ..random } } else { random };
    let plan = if is_biped { balanced_plan() } else { plan() };
    let clocks = if is_biped && body.joints > 1 { BALANCED_JUMP_CLOCKS } else { JUMP_CLOCKS };
    // By one search, and not by several as gaits are: a stride that comes to nothing is given up instead.
    let strategy: [(&str, Value); 4] = [
        ("restart", "none".into()),
        ("starts", 1.into()),
        ("step_size", STEP_SIZE.into()),
        ("least_deviation", LEAST_DEVIATION.into()),
    ];
    MovementDefaults {
        steps: STEPS.0,
        training_steps: STEPS.1,
        terms: wanted,
        commands: Some(Commands::Random(random)),
        hidden: if is_biped { BALANCED_HIDDEN } else { unknown.hidden },
        // Softer legs do not jump.
        gain: unknown.gain.max(15.0),
        trials: Some(6),
        most_steps: Some(plan.most),
        stages: vec![
            move_on(plan.move_on),
            follow(plan.follow),
            jump(plan.jump, clocks),
            polish(plan.polish, plan.polished_jump),
            harden(),
        ],
        strategy: strategy.into_iter().map(|(name, value)| (name.to_owned(), value)).collect(),
        ..unknown
    }
}

fn move_on(plan: StagePlan) -> StageSettings {
    plan.stage(STRIDE, json!({ "commands": { "random": { "standing": 0.0 } } }))
}

fn follow(plan: StagePlan) -> StageSettings {
    plan.stage("follow", json!({ "commands": { "random": { "standing": STANDING } } }))
}

/// With the stride held, jumps are all there is to learn: out of every hold.
fn jump(plan: StagePlan, clocks: [f32; 2]) -> StageSettings {
    let changes =
        json!({ "commands": { "random": { "jumps": 1.0 } }, "movement": { "settings": { "jump": JUMP_WORTH } } });
    let add_sensors = clocks.map(|period| Sensor::JumpClock { period }).into();
    StageSettings { add_sensors, transfer: Some(Transferred::Held), ..plan.stage("jump", changes) }
}

/// All of it together: a stride that has never landed learns to go on from there.
fn polish(plan: StagePlan, jump: f64) -> StageSettings {
    let changes = json!({
        "commands": { "random": { "jumps": 0.4 } },
        "movement": { "settings": { "jump": jump } },
    });
    StageSettings { transfer: Some(Transferred::Champion), ..plan.stage("polish", changes) }
}

/// And in worlds that vary as the configuration has it.
fn harden() -> StageSettings {
    stage("harden", json!({}))
}

impl StagePlan {
    /// In worlds that hardly vary.
    fn stage(self, name: &str, changes: Value) -> StageSettings {
        let [fewest, most] = self.steps;
        let promotion = Some(Any(vec![All(vec![Usable, Steps(fewest)]), Steps(most)]));
        let give_up = self.give_up.map(|Anew { when, times }| GiveUp { when, back_to: STRIDE.into(), times });
        let mut stage = StageSettings { near: true, promotion, give_up, ..stage(name, changes) };
        stage.changes.insert("trials".into(), json!({ "count": self.trials }));
        stage
    }
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
