//! What the default preset adds to a bare search: what a coach knows of bodies that move.
//!
//! Each piece is a setting of the run like any other, so it can be changed or left out one by one; what each is worth is
//! measured in `docs/ablation.md`.

use super::{EngineChoice, LimbPhases, RunConfig, StrategySettings};
use creatures::{Actuation, Blueprint, Sensor};
use envs_rapier::Variation;
use ne_net::Activation;
use tasks::TermSpec;

/// Equips a configuration for its creature and its movement.
pub(super) fn equip(config: &mut RunConfig) {
    let movement = Movement::of(&config.movement.name);
    let blueprint = Blueprint::new(config.creature.clone()).ok();
    // Who lies on its back has legs all the same.
    let on_legs = |blueprint: &Blueprint| movement == Movement::GettingUp || !blueprint.is_legless();
    let height = blueprint.as_ref().map_or(1.0, Blueprint::start_height);
    let (legs, joints) = blueprint.filter(on_legs).map_or((0, 0), |blueprint| {
        let joints = blueprint.legs().iter().map(Vec::len).min().unwrap_or(0);
        (blueprint.legs().len(), joints)
    });
    // In water legs are limbs like others: there is nothing to stand on.
    let legless = legs == 0 || movement == Movement::Swimming;
    let controller = &mut config.controller;
    controller.hidden = vec![4];
    controller.hidden_activation = Activation::Tanh;
    controller.output_activation = Activation::Tanh;
    controller.hidden_scale = 1.0;
    controller.limbs = movement.phases(legs, joints);
    controller.actuation = Actuation::Angle { gain: movement.gain(legs) };
    config.physics.motor_gain = MOTOR_GAIN;
    let period = movement.period(if legless { 0 } else { legs }, height);
    let sensors = sensors(&config.creature.sensors, period, legless);
    config.movement.terms = movement.terms([legs, joints], legless, clock(&sensors).unwrap_or(period));
    config.sensors = Some(sensors);
    if movement.meets_bumps(legs) {
        config.variation = Variation::bumpy();
    }
    (config.movement.steps, config.rehearsal) = movement.steps().unzip();
    config.trials.count = TRIALS;
    if let StrategySettings::CmaEs(settings) = &mut config.strategy
        && movement == Movement::Jumping
    {
        settings.step_size = STEP_SIZE_OF_JUMPS;
    }
    // What lanes refuse is trained in rapier rather than not at all.
    if config.creature.self_collision {
        config.engine = EngineChoice::Rapier;
    }
}

/// Motors that hold their speed, as those of other engines do: a gait of soft ones falls where they are stiff.
const MOTOR_GAIN: f32 = 200.0;

/// Of one world alone the lucky would be the best: one near world, and two that vary.
const TRIALS: u32 = 3;

/// Where a search begins with steps as wide as it does for a run, legs thrash, and hardly any of the first nets leaves the
/// ground and lands.
const STEP_SIZE_OF_JUMPS: f64 = 0.2;

/// What is known of a movement.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Movement {
    /// Running, and what gets ahead like it.
    Running,
    Backwards,
    /// At a speed that is a setting.
    Walking,
    Jumping,
    LongJump,
    Hopping,
    Standing,
    GettingUp,
    Swimming,
    /// Somebody else's.
    Other,
}

impl Movement {
    fn of(name: &str) -> Self {
        match name {
            "running" | "climbing" | "carrying" | "cruising" => Self::Running,
            "backwards" => Self::Backwards,
            "walking" => Self::Walking,
            "jumping" => Self::Jumping,
            "long-jump" => Self::LongJump,
            "hopping" => Self::Hopping,
            "standing" => Self::Standing,
            "getting-up" => Self::GettingUp,
            "swimming" => Self::Swimming,
            _ => Self::Other,
        }
    }

    /// Whether it is about getting off the ground.
    fn leaps(self) -> bool {
        matches!(self, Self::Jumping | Self::LongJump | Self::Hopping)
    }

    /// Of the motors' angle law, 1/s: strides swing, waves and the leap of a biped must follow closely, and many legs that
    /// snap at once tear at their joints.
    fn gain(self, legs: usize) -> f32 {
        match (self.leaps(), legs) {
            (_, 0) => 20.0,
            (true, 1..=2) => 20.0,
            (true, _) => 15.0,
            (false, _) => 10.0,
        }
    }

    /// Whether it is about getting far, as fast as it goes.
    fn runs(self) -> bool {
        matches!(self, Self::Running | Self::Backwards)
    }

    /// How limbs share a net. Many legs leap together. Two legs leap and run best if one net moves them both: they skip, the
    /// same leg always first, and a skip bears a stumble that an even stride does not. With knees they walk best so, too.
    fn phases(self, legs: usize, joints: usize) -> Option<LimbPhases> {
        match (self.leaps(), legs) {
            (true, 3..) => Some(LimbPhases::Together),
            (true, 1..=2) => None,
            (false, 1..=2) if self.runs() || (self == Self::Walking && joints > 1) => None,
            _ => Some(LimbPhases::Alternating),
        }
    }

    /// Whether training has bumps. Many legs bridge them by themselves, and jumps are over before.
    fn meets_bumps(self, legs: usize) -> bool {
        self.runs() && (1..=4).contains(&legs)
    }

    /// A stride or a hop, a leap with its run-up, and a stroke, s. Legs swing like pendulums: the time of a stride goes with
    /// the root of the height, m, at which they carry the torso. Two legs that skip are quicker. `legs`: 0 where none carry it.
    fn period(self, legs: usize, height: f32) -> f32 {
        let pendulum = |seconds: f32| {
            let period = seconds * libm::sqrtf(height / 0.8).clamp(0.7, 1.4);
            // A round number: it stands in files.
            libm::roundf(100.0 * period) / 100.0
        };
        match self {
            Self::Swimming => 0.35,
            Self::Jumping | Self::LongJump if legs == 0 => 1.0,
            Self::Jumping | Self::LongJump => pendulum(1.0),
            _ if legs == 0 => 0.5,
            _ if self.runs() && legs <= 2 => pendulum(0.39),
            _ => pendulum(0.5),
        }
    }

    /// How long the champion's episode is, and how long one of training: 20 s and 10 s for a run, 5 s for a jump and
    /// its landing, 2 s for a long jump; 10 s and 4 to 6 s for what is to last.
    fn steps(self) -> Option<(u32, u32)> {
        match self {
            Self::Running | Self::Backwards | Self::Walking => Some((1000, 500)),
            Self::Swimming => Some((1000, 250)),
            Self::Jumping => Some((250, 250)),
            Self::LongJump => Some((250, 100)),
            Self::Hopping => Some((500, 200)),
            Self::Standing | Self::GettingUp => Some((500, 300)),
            Self::Other => None,
        }
    }

    fn terms(self, [legs, joints]: [usize; 2], legless: bool, period: f32) -> Vec<TermSpec> {
        let terms: &[(&str, f64)] = match self {
            // What ends an episode is charged for by the distance it then cannot cover.
            Self::Running | Self::Backwards if legless => {
                &[("honest", 0.0), ("upright", 0.0), ("headway", 0.0), ("vibration", -0.2), ("idleness", -5.0)]
            }
            Self::Running | Self::Backwards => &[
                ("honest", 0.0),
                ("posture", -1.0),
                ("headway", 0.0),
                ("footfalls", -1.0),
                ("vibration", -0.2),
                ("slip", -1.0),
                ("haste", -0.95),
                ("rhythm", -1.0),
            ],
            // Headway would ask for a speed of its own.
            Self::Walking if legless => &[("honest", 0.0), ("upright", 0.0), ("vibration", -0.2), ("idleness", -5.0)],
            Self::Walking => &[("honest", 0.0), ("upright", 0.0), ("footfalls", -1.0), ("vibration", -0.2)],
            Self::Jumping => &[("honest", 0.0), ("posture", 0.0), ("leap", 4.0), ("landing", 3.0), ("vibration", -0.2)],
            // A somersault also gets far.
            Self::LongJump => &[("honest", 0.0), ("upright", 0.0), ("leap", 1.0), ("vibration", -0.02)],
            Self::Hopping => &[("honest", 0.0), ("upright", 0.0), ("vibration", -0.02)],
            Self::Standing => &[("honest", 0.0), ("vibration", -0.1)],
            Self::Swimming => &[("honest", 0.0), ("vibration", -0.2)],
            Self::GettingUp => &[("honest", 0.0), ("vibration", -0.01)],
            Self::Other => &[],
        };
        // Many legs keep time by themselves; two legs with knees find a rhythm of their own, and are not helped by another.
        let needed = |&&(term, _): &&(&str, f64)| match term {
            "rhythm" => legs <= 4 && (legs > 2 || joints == 1),
            _ => true,
        };
        let mut terms: Vec<_> =
            terms.iter().filter(needed).map(|&(term, weight)| TermSpec::new(term, weight)).collect();
        let mut set = |name: &str, field: &str, value: serde_json::Value| {
            if let Some(term) = terms.iter_mut().find(|term| term.term == name) {
                term.settings.insert(field.into(), value);
            }
        };
        // Two legs that hurry fall.
        set("haste", "speed", if legs <= 2 { 1.3.into() } else { 2.2.into() });
        // As short in a file as it is meant.
        set("rhythm", "period", (f64::from(libm::roundf(1000.0 * period)) / 1000.0).into());
        if self == Self::Jumping {
            // A jump crouches, and nothing but feet may touch the ground, however shortly.
            set("posture", "tilt", 35.into());
            set("posture", "margin", 5.into());
            set("posture", "height", 0.3.into());
            set("posture", "brush", 0.into());
        }
        if let Some(headway) = terms.iter_mut().find(|term| self == Self::Backwards && term.term == "headway") {
            headway.settings.insert("backwards".into(), true.into());
        }
        terms
    }
}

/// What the creature's file asks for, if it asks for anything of its own, or else what a body feels; and a clock.
fn sensors(own: &[Sensor], period: f32, legless: bool) -> Vec<Sensor> {
    let mut sensors = own.to_vec();
    if sensors == Sensor::defaults() {
        sensors.insert(1, Sensor::TorsoSpin);
        if !legless {
            sensors.extend([Sensor::FootContacts, Sensor::TorsoVelocity, Sensor::TorsoHeight]);
        }
    }
    if clock(&sensors).is_none() {
        sensors.push(Sensor::Clock { period });
    }
    sensors
}

/// The period of the first clock, s.
fn clock(sensors: &[Sensor]) -> Option<f32> {
    sensors.iter().find_map(|sensor| match *sensor {
        Sensor::Clock { period } => Some(period),
        _ => None,
    })
}

#[cfg(test)]
mod tests {
    use crate::config::{LimbPhases, RunConfig, StrategySettings, preset};
    use creatures::{Actuation, Sensor};

    fn config(creature: &str, movement: &str) -> RunConfig {
        let creature = creatures::find(creature).expect("shipped");
        preset("default").expect("there").config(creature, movement)
    }

    #[test]
    fn limbs_leap_together_or_alternate_and_bipeds_leap_and_run_with_one_net() {
        let (alternating, together) = (Some(LimbPhases::Alternating), Some(LimbPhases::Together));
        for (creature, movement, limbs) in [
            ("biped-1", "running", None),
            ("biped-2", "running", None),
            ("biped-2", "walking", None),
            ("biped-1", "jumping", None),
            ("biped-2", "jumping", None),
            ("biped-2", "swimming", alternating),
            ("tetrapod-2", "running", alternating),
            ("tetrapod-2", "jumping", together),
            ("apod", "jumping", alternating),
        ] {
            assert_eq!(config(creature, movement).controller.limbs, limbs, "{creature} {movement}");
        }
    }

    /// What docs/gaits.md says of them.
    #[test]
    fn clock_angle_law_step_size_and_bumps_are_those_of_the_movement() {
        for (creature, movement, period, gain, step_size, bumps) in [
            ("biped-1", "running", 0.39, 10.0, 0.5, true),
            ("biped-2", "backwards", 0.39, 10.0, 0.5, true),
            ("biped-1", "walking", 0.5, 10.0, 0.5, false),
            ("tetrapod-1", "running", 0.5, 10.0, 0.5, true),
            ("decapod-1", "running", 0.42, 10.0, 0.5, false),
            ("apod", "running", 0.5, 20.0, 0.5, false),
            ("biped-1", "jumping", 1.0, 20.0, 0.2, false),
            ("decapod-1", "jumping", 0.84, 15.0, 0.2, false),
            ("apod", "jumping", 1.0, 20.0, 0.2, false),
        ] {
            let config = config(creature, movement);
            let name = format!("{creature} {movement}");
            let StrategySettings::CmaEs(settings) = &config.strategy else { panic!("{name}: another strategy") };
            assert_eq!((settings.step_size, settings.starts), (step_size, 4), "{name}");
            assert_eq!((config.physics.motor_gain, config.trials.count), (200.0, 3), "{name}");
            assert!(matches!(config.controller.actuation, Actuation::Angle { gain: found } if found == gain), "{name}");
            assert_eq!(config.variation.bumps > 0.0, bumps, "{name}");
            let clock = |sensor: &Sensor| match *sensor {
                Sensor::Clock { period } => Some(period),
                _ => None,
            };
            let found = config.sensors.iter().flatten().find_map(clock).expect("a clock");
            assert!((found - period).abs() < 0.1, "{name}: a clock of {found} s");
        }
    }
}
