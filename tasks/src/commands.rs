//! What a body is told to do, moment by moment.

use ne_core::{Purpose, Seed, SettingError};
use rand::RngExt;
use serde::{Deserialize, Serialize};
use std::sync::Arc;

const TRIAL_COMMANDS: Purpose = Purpose::new("trial commands");

/// Drawn schedules are so long, s; then they begin anew.
const DRAWN_SECONDS: f32 = 128.0;
/// A press comes no sooner after a change of speed, s: the body is on its way to the new one.
const BEFORE_PRESS: f32 = 0.5;
/// A change of speed comes no sooner after a press, s: the body is in the air.
const AFTER_PRESS: f32 = 1.5;
/// Between the jumps of a lesson of jumps, s, beside what is around every press.
const JUMPS_APART: [f32; 2] = [1.0, 2.0];
/// When a lesson of jumps begins, s.
const FIRST_JUMP: f32 = 0.5;
/// The most changes of a given schedule.
const MOST_CHANGES: usize = 10_000;

/// Trials that are lessons are of so many kinds, by turns.
pub(crate) const LESSONS: usize = 2;

/// What a body is told to do at a moment.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Command {
    /// How fast it is to move, body lengths/s; backwards below 0.
    pub speed: f32,
    /// Whether it is to jump: the button is held.
    pub jump: bool,
    /// Time since the button was last pressed, s; infinity if it never was.
    pub since_press: f32,
    /// When the stride clock began, s: when the body was last told to move after it had been told to stand, or to jump after it had
    /// not; 0 if it never was.
    pub stride_began: f32,
}

impl Default for Command {
    /// To stand.
    fn default() -> Self {
        Self { speed: 0.0, jump: false, since_press: f32::INFINITY, stride_began: 0.0 }
    }
}

impl Command {
    /// The command at this time, s, a time step after this one, which lasts so long, s.
    pub fn then(&self, speed: f32, jump: bool, time: f32, time_step: f32) -> Self {
        let (pressed, sets_off) = (jump && !self.jump, speed != 0.0 && self.speed == 0.0);
        Self {
            speed,
            jump,
            since_press: if pressed { 0.0 } else { self.since_press + time_step },
            stride_began: if pressed || sets_off { time } else { self.stride_began },
        }
    }
}

/// Where the commands of a trial come from. In a file: `{"random": {"standing": 0.5}}`, or `{"given": [{"time": 0, "speed":
/// 1}, {"time": 4, "speed": 1, "jump": true}]}`.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(rename_all = "kebab-case", deny_unknown_fields)]
pub enum Commands {
    /// Drawn from the trial's seed.
    Random(RandomCommands),
    /// Always these, by time; before the first the body is told to stand. At most 10,000.
    Given(#[cfg_attr(feature = "schema", schemars(length(min = 1, max = 10_000)))] Vec<CommandChange>),
}

/// How commands are drawn: speeds held for a while, one after the other, and jumps.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(default, deny_unknown_fields)]
pub struct RandomCommands {
    /// How long the body is told to stand at first, s, from 0 to 60; default 1.
    #[cfg_attr(feature = "schema", schemars(range(min = 0.0, max = 60.0)))]
    pub still: f32,
    /// The shortest and the longest time that a speed is held, s, from 0.2 to 1000; default 2 and 5.
    #[cfg_attr(feature = "schema", schemars(inner(range(min = 0.2, max = 1000.0))))]
    pub hold: [f32; 2],
    /// The slowest and the fastest speed, body lengths/s, from 0 to 20; default 0.5 and 1.5.
    #[cfg_attr(feature = "schema", schemars(inner(range(min = 0.0, max = 20.0))))]
    pub speeds: [f32; 2],
    /// The share of holds in which it is told to stand, from 0 to 1; default 0.25.
    #[cfg_attr(feature = "schema", schemars(range(min = 0.0, max = 1.0)))]
    pub standing: f32,
    /// The share of the other holds in which it is told to go backwards, from 0 to 1; default 0.
    #[cfg_attr(feature = "schema", schemars(range(min = 0.0, max = 1.0)))]
    pub backwards: f32,
    /// The share of holds in which it is told to jump once, from 0 to 1; default 0.3. Those holds are 2 s longer, more if the
    /// button is held for more than 1.5 s.
    #[cfg_attr(feature = "schema", schemars(range(min = 0.0, max = 1.0)))]
    pub jumps: f32,
    /// How long the button is held, s, from 0.02 to 2; default 0.2.
    #[cfg_attr(feature = "schema", schemars(range(min = 0.02, max = 2.0)))]
    pub press: f32,
}

/// A command that holds from a time on.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct CommandChange {
    /// From when on, s from the start of the trial; from 0 to 1,000,000, no earlier than the change before.
    #[cfg_attr(feature = "schema", schemars(range(min = 0.0, max = 1e6)))]
    pub time: f32,
    /// How fast the body is to move, body lengths/s, from −20 to 20; default 0.
    #[serde(default)]
    #[cfg_attr(feature = "schema", schemars(range(min = -20.0, max = 20.0)))]
    pub speed: f32,
    /// Whether it is to jump; default no.
    #[serde(default)]
    pub jump: bool,
}

impl Default for RandomCommands {
    fn default() -> Self {
        Self {
            still: 1.0,
            hold: [2.0, 5.0],
            speeds: [0.5, 1.5],
            standing: 0.25,
            backwards: 0.0,
            jumps: 0.3,
            press: 0.2,
        }
    }
}

impl Default for Commands {
    fn default() -> Self {
        Self::Random(RandomCommands::default())
    }
}

impl Commands {
    /// Checks every number.
    ///
    /// # Errors
    /// Names the field and its range.
    pub fn validate(&self) -> Result<(), SettingError> {
        match self {
            Self::Random(random) => random.validate().map_err(|error| error.within("random")),
            Self::Given(changes) => check_given(changes),
        }
    }

    /// The commands of the trial with this seed. `lessons`: see [`Trials::lessons`](crate::Trials::lessons).
    pub fn draw(&self, seed: Seed, lessons: bool) -> CommandSchedule {
        match self {
            Self::Random(random) => {
                let random = if lessons { random.lesson(seed.trial_index()) } else { *random };
                let changes = random.draw(seed);
                CommandSchedule { changes: changes.into(), repeats: DRAWN_SECONDS }
            }
            Self::Given(changes) => CommandSchedule { changes: changes.as_slice().into(), repeats: f32::INFINITY },
        }
    }
}

impl RandomCommands {
    /// The settings of the trial with this index.
    fn lesson(self, trial: u32) -> Self {
        match trial as usize % LESSONS {
            0 => Self { standing: 1.0, jumps: 1.0, hold: JUMPS_APART, still: self.still.min(FIRST_JUMP), ..self },
            _ => Self { jumps: 1.0, ..self },
        }
    }

    fn validate(&self) -> Result<(), SettingError> {
        let numbers = [
            ("still", self.still, 0.0, 60.0),
            ("standing", self.standing, 0.0, 1.0),
            ("backwards", self.backwards, 0.0, 1.0),
            ("jumps", self.jumps, 0.0, 1.0),
            ("press", self.press, 0.02, 2.0),
        ];
        for (field, value, low, high) in numbers {
            // Compared as f32 so that the ends themselves are in; shown as written.
            if !(low..=high).contains(&value) {
                return Err(SettingError::new(field, value, format!("from {low} to {high}")));
            }
        }
        for (field, [least, most], low, high) in [("hold", self.hold, 0.2, 1000.0), ("speeds", self.speeds, 0.0, 20.0)]
        {
            if !(low <= least && least <= most && most <= high) {
                let allowed = format!("two numbers from {low} to {high}, the smaller first");
                return Err(SettingError::new(field, format!("[{least}, {most}]"), allowed));
            }
        }
        Ok(())
    }

    fn draw(&self, seed: Seed) -> Vec<CommandChange> {
        let mut stream = seed.stream(TRIAL_COMMANDS);
        let mut draw = || stream.random::<f32>();
        let between = |[least, most]: [f32; 2], place: f32| least + (most - least) * place;
        let mut changes = vec![CommandChange::default()];
        let mut time = self.still;
        while time < DRAWN_SECONDS {
            // The same draws in every hold, whatever comes of them.
            let [stands, turns, jumps, speed, hold, press] = [draw(), draw(), draw(), draw(), draw(), draw()];
            let speed = match stands < self.standing {
                true => 0.0,
                false => between(self.speeds, speed) * if turns < self.backwards { -1.0 } else { 1.0 },
            };
            changes.push(CommandChange { time, speed, jump: false });
            let mut seconds = between(self.hold, hold);
            if jumps < self.jumps {
                let pressed = time + BEFORE_PRESS + seconds * press;
                seconds += BEFORE_PRESS + AFTER_PRESS.max(self.press);
                changes.push(CommandChange { time: pressed, speed, jump: true });
                changes.push(CommandChange { time: pressed + self.press, speed, jump: false });
            }
            time += seconds;
        }
        changes
    }
}

fn check_given(changes: &[CommandChange]) -> Result<(), SettingError> {
    if changes.is_empty() || changes.len() > MOST_CHANGES {
        return Err(SettingError::new(
            "given",
            format!("{} changes", changes.len()),
            format!("from 1 to {MOST_CHANGES}"),
        ));
    }
    let mut earliest = 0.0;
    for (index, change) in changes.iter().enumerate() {
        if !(change.time >= earliest && change.time <= 1e6) {
            let allowed = format!("from {earliest}, no earlier than the change before, to 1000000");
            return Err(SettingError::new(format!("given[{index}].time"), change.time, allowed));
        }
        earliest = change.time;
        SettingError::check_range(&format!("given[{index}].speed"), change.speed, -20.0, 20.0)?;
    }
    Ok(())
}

/// The commands of a trial. Asked at times that grow.
#[derive(Clone, Debug)]
pub struct CommandSchedule {
    /// By time, s.
    changes: Arc<[CommandChange]>,
    /// After so long it begins anew, s.
    repeats: f32,
}

impl Default for CommandSchedule {
    /// To stand, for ever.
    fn default() -> Self {
        Self { changes: Arc::default(), repeats: f32::INFINITY }
    }
}

impl CommandSchedule {
    /// Whether it tells anything at all.
    pub fn is_empty(&self) -> bool {
        self.changes.is_empty()
    }

    /// The command at a time, s; `before` is the command at the time step before, so long ago, s.
    pub fn at(&self, time: f32, before: &Command, time_step: f32) -> Command {
        let place = if time < self.repeats { time } else { time % self.repeats };
        let next = self.changes.partition_point(|change| change.time <= place);
        let CommandChange { speed, jump, .. } =
            next.checked_sub(1).and_then(|last| self.changes.get(last)).copied().unwrap_or_default();
        before.then(speed, jump, time, time_step)
    }

    /// The command at the start of a trial.
    pub fn first(&self) -> Command {
        self.at(0.0, &Command::default(), 0.0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn played(commands: &Commands, seed: u64, seconds: f32) -> Vec<Command> {
        let schedule = commands.draw(Seed::of_run(seed), false);
        let mut command = schedule.first();
        let mut all = vec![command];
        for step in 1..=(seconds / 0.02) as u32 {
            command = schedule.at(step as f32 * 0.02, &command, 0.02);
            all.push(command);
        }
        all
    }

    /// However long the button is held.
    #[test]
    fn drawn_changes_come_one_after_the_other() {
        let random = RandomCommands { press: 2.0, hold: [0.2, 0.2], jumps: 1.0, ..RandomCommands::default() };
        for seed in 0..20 {
            let changes = random.draw(Seed::of_run(seed));
            assert!(changes.is_sorted_by(|one, next| one.time <= next.time), "{seed}");
        }
    }

    #[test]
    fn drawn_commands_keep_to_their_ranges() {
        let random = RandomCommands { backwards: 0.5, ..RandomCommands::default() };
        let mut shares = [0; 3];
        let mut presses = 0;
        for seed in 0..20 {
            let commands = played(&Commands::Random(random), seed, 300.0);
            assert!(commands[..50].iter().all(|command| command.speed == 0.0 && !command.jump));
            for pair in commands.windows(2) {
                let [before, now] = [pair[0], pair[1]];
                let pressed = now.jump && !before.jump;
                presses += usize::from(pressed);
                assert_eq!(pressed, now.since_press == 0.0);
                assert!(now.speed == 0.0 || (0.5..=1.5).contains(&now.speed.abs()), "{now:?}");
                assert!(!pressed || now.speed == before.speed, "a press comes with a change of speed");
                shares[if now.speed == 0.0 { 0 } else { 1 + usize::from(now.speed < 0.0) }] += 1;
            }
        }
        let total: usize = shares.iter().sum();
        let share = |count: usize| count as f64 / total as f64;
        assert!((0.2..0.3).contains(&share(shares[0])), "{shares:?}");
        assert!((0.3..0.45).contains(&share(shares[2])), "{shares:?}");
        // A hold takes 4.1 s in the mean, and 0.3 of them have a press.
        assert!((300..600).contains(&presses), "{presses}");
    }

    #[test]
    fn schedules_are_of_their_seed_alone() {
        let commands = Commands::default();
        assert_eq!(played(&commands, 1, 20.0), played(&commands, 1, 20.0));
        assert_ne!(played(&commands, 1, 20.0), played(&commands, 2, 20.0));
    }

    #[test]
    fn given_commands_come_when_they_are_due() {
        let change = |time, speed, jump| CommandChange { time, speed, jump };
        let given = Commands::Given(vec![change(0.5, 1.0, false), change(1.0, 1.0, true), change(1.2, -1.0, false)]);
        given.validate().expect("valid");
        let commands = played(&given, 0, 2.0);
        assert_eq!(commands[0], Command::default());
        assert_eq!((commands[26].speed, commands[26].jump), (1.0, false));
        assert!(commands[51].jump && commands[51].since_press <= 0.021, "{:?}", commands[51]);
        assert_eq!((commands[100].speed, commands[100].jump), (-1.0, false));
        assert!((commands[100].since_press - 1.0).abs() < 0.03, "{:?}", commands[100]);
    }

    #[test]
    fn a_stride_clock_begins_where_the_body_sets_off_and_at_a_press() {
        let change = |time, speed, jump| CommandChange { time, speed, jump };
        let given = Commands::Given(vec![
            change(0.5, 1.0, false),
            change(1.0, 2.0, false),
            change(1.5, 0.0, false),
            change(2.0, -1.0, false),
            change(2.5, -1.0, true),
            change(2.7, -1.0, false),
        ]);
        let commands = played(&given, 0, 3.0);
        let began = |time: f32| commands[(time / 0.02) as usize].stride_began;
        let times = [0.4, 0.6, 1.2, 1.8, 2.2, 2.6, 3.0];
        for (time, expected) in times.into_iter().zip([0.0, 0.5, 0.5, 0.5, 2.0, 2.5, 2.5]) {
            assert!((began(time) - expected).abs() < 0.021, "{} at {time} s", began(time));
        }
        let moving = Commands::Given(vec![change(0.0, 1.0, false)]).draw(Seed::of_run(0), false);
        assert_eq!(moving.first().stride_began, 0.0);
    }

    #[test]
    fn what_is_out_of_range_is_named() {
        let random = |change: fn(&mut RandomCommands)| {
            let mut random = RandomCommands::default();
            change(&mut random);
            Commands::Random(random)
        };
        let cases = [
            (random(|it| it.still = -1.0), "random.still"),
            (random(|it| it.hold = [5.0, 2.0]), "random.hold"),
            (random(|it| it.hold = [0.0, 2.0]), "random.hold"),
            (random(|it| it.speeds = [0.0, 21.0]), "random.speeds"),
            (random(|it| it.standing = f32::NAN), "random.standing"),
            (random(|it| it.backwards = 1.1), "random.backwards"),
            (random(|it| it.jumps = -0.1), "random.jumps"),
            (random(|it| it.press = 0.0), "random.press"),
            (Commands::Given(Vec::new()), "given"),
            (Commands::Given(vec![CommandChange { time: -1.0, ..CommandChange::default() }]), "given[0].time"),
            (Commands::Given(vec![CommandChange { speed: 30.0, ..CommandChange::default() }]), "given[0].speed"),
        ];
        for (commands, field) in cases {
            let error = commands.validate().expect_err(field).to_string();
            assert!(error.contains(field), "{error}");
        }
        assert_eq!(random(|it| it.press = 0.02).validate(), Ok(()), "the least there may be, in single precision");
    }
}
