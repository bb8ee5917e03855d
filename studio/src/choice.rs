//! From what was chosen on a page to a configuration, and to the command line that does the same.

use crate::protocol::{Choice, Described, Mistake};
use creatures::{Blueprint, Creature, CreatureError, Terrain};
use envs_core::check_start;
use gambol_runs::{
    Registry,
    config::RunConfig,
    program_name,
    request::{Request, RequestError},
    setup::Setup,
    shaping::{self, Stages},
    suggest,
    texts::shell_word,
};
use ne_core::StopConditions;
use serde::Deserialize;
use serde_json::Value;
use std::path::{Path, PathBuf};

/// The creatures and terrains that were drawn and kept, and where the runs are.
#[derive(Clone, Debug, Default)]
pub struct Kept {
    /// Where the creatures are.
    pub creature_folder: PathBuf,
    /// The names of the creatures.
    pub creatures: Vec<String>,
    /// Where the terrains are.
    pub terrain_folder: PathBuf,
    /// The names of the terrains.
    pub terrains: Vec<String>,
    /// Where the runs are.
    pub runs: PathBuf,
}

/// Why a choice cannot be trained: in the words of the library, which name field and range.
#[derive(Debug, thiserror::Error)]
#[error("{0}")]
pub struct ChoiceError(String);

impl From<RequestError> for ChoiceError {
    fn from(error: RequestError) -> Self {
        Self(error.to_string())
    }
}

impl Choice {
    /// What is trained before anything was chosen: a biped that learns to run.
    pub(crate) fn first() -> Self {
        Self { creature: Some("biped-1".into()), movement: "running".into(), ..Self::default() }
    }

    /// The configuration, checked as the program checks it before it trains. A choice names things of the registry alone: no path from a
    /// page is ever opened. `from`: the folder of the run that is gone on from.
    ///
    /// # Errors
    /// Says what is wrong, and where.
    pub fn resolve(&self, registry: &Registry, from: Option<&Path>) -> Result<RunConfig, ChoiceError> {
        let config = self.configure(registry, from, &self.set)?;
        let wrong = |error: &dyn std::fmt::Display| ChoiceError(error.to_string());
        if let Some(from) = from {
            shaping::configured_from(&config, from, registry).map_err(|error| wrong(&error))?;
            return Ok(config);
        }
        Setup::new(&config, registry).map_err(|error| wrong(&error))?;
        if !config.stages.is_empty() {
            Stages::new(&config, registry).map_err(|error| wrong(&error))?;
        }
        Ok(config)
    }

    /// What the choice comes to, or what is wrong with it. `from`: see [`resolve`](Self::resolve), `kept`: see [`command`](Self::command).
    pub fn describe(&self, registry: &Registry, from: Option<&Path>, kept: &Kept) -> Described {
        let (config, problem) = match self.resolve(registry, from) {
            Ok(config) => (Some(config), None),
            Err(ChoiceError(problem)) => (None, Some(problem)),
        };
        let preset = self.configure(registry, from, &[]).ok();
        Described { config, preset, problem, command: self.command(kept) }
    }

    /// The creature that was drawn, if one was.
    ///
    /// # Errors
    /// If it is not valid.
    pub fn drawn_creature(&self) -> Result<Option<Creature>, ChoiceError> {
        let Some(drawn) = &self.drawn else { return Ok(None) };
        let blueprint = Blueprint::from_json(&drawn.to_string()).map_err(|error| ChoiceError(error.to_string()))?;
        Ok(Some(blueprint.creature().clone()))
    }

    fn configure(&self, registry: &Registry, from: Option<&Path>, set: &[String]) -> Result<RunConfig, ChoiceError> {
        let mut registry = registry.clone();
        let name = match (self.drawn_creature()?, &self.creature) {
            (Some(drawn), _) => {
                let name = drawn.name.clone();
                let json = serde_json::to_string(&drawn).map_err(|error| ChoiceError(error.to_string()))?;
                registry.creatures.add_file(&json).map_err(|error| ChoiceError(error.to_string()))?;
                name
            }
            (None, Some(name)) => name.clone(),
            (None, None) => return Err(ChoiceError("creature: choose one, or draw one".into())),
        };
        // What is no name would be taken for a path.
        registry.creatures.find(&name).map_err(|error| ChoiceError(error.to_string()))?;
        if name.contains(['/', '\\']) || name.ends_with(".json") {
            return Err(ChoiceError(suggest::unknown("creature", &name, &registry.creatures.names())));
        }
        let request = Request {
            creature: Some(name),
            movement: Some(self.movement.clone()),
            preset: self.preset.clone(),
            strategy: self.strategy.clone(),
            terrain: self.terrain.clone(),
            variation: self.variation.clone(),
            from: from.map(Path::to_owned),
            set: set.to_vec(),
            seed: self.seed,
            limits: StopConditions { generations: self.generations, ..StopConditions::default() },
            ..Request::default()
        };
        Ok(request.resolve(&registry)?)
    }

    /// What to type for the same run: a creature that was drawn is a file, and so is a terrain.
    pub fn command(&self, kept: &Kept) -> String {
        let drawn = self.drawn.as_ref().and_then(|drawn| drawn.get("name")?.as_str());
        let named = self.creature.as_deref().unwrap_or("CREATURE");
        let creature = match drawn.or(Some(named).filter(|name| kept.creatures.iter().any(|kept| kept == name))) {
            Some(name) => kept.creature_folder.join(format!("{name}.json")),
            None => named.into(),
        };
        let word = |text: &str| shell_word(Path::new(text));
        let mut command = format!("{} train {} {}", program_name(), shell_word(&creature), word(&self.movement));
        let mut add = |flag: &str, value: Option<String>| {
            if let Some(value) = value {
                command.push_str(&format!(" --{flag} {}", word(&value)));
            }
        };
        add("preset", self.preset.clone());
        add("strategy", self.strategy.clone());
        match self.terrain.as_ref().filter(|&name| kept.terrains.contains(name)) {
            Some(name) => {
                let file = kept.terrain_folder.join(format!("{name}.json"));
                add("config", Some(file.to_string_lossy().into_owned()));
            }
            None => add("terrain", self.terrain.clone()),
        }
        add("variation", self.variation.clone());
        add("from", self.from.as_ref().map(|run| kept.runs.join(run).to_string_lossy().into_owned()));
        add("seed", self.seed.map(|seed| seed.to_string()));
        add("generations", self.generations.map(|generations| generations.to_string()));
        self.set.iter().for_each(|set| add("set", Some(set.clone())));
        command
    }
}

/// What is wrong with a terrain that was drawn, as in a configuration.
pub fn check_terrain(terrain: &Value) -> Vec<Mistake> {
    let whole = |error: &dyn std::fmt::Display| vec![Mistake { place: String::new(), message: error.to_string() }];
    match Terrain::deserialize(terrain) {
        Err(error) => whole(&error),
        Ok(terrain) => {
            let mistakes: Vec<Mistake> = terrain.drawn_problems().iter().map(Mistake::from).collect();
            let other = terrain.validate().err().filter(|_| mistakes.is_empty());
            other.as_ref().map_or(mistakes, |error| vec![Mistake::from(error)])
        }
    }
}

/// What is wrong with a creature, as in a file.
pub fn check(creature: &Value) -> Vec<Mistake> {
    match Blueprint::from_json(&creature.to_string()) {
        Ok(blueprint) => start_of(&blueprint),
        Err(CreatureError::Invalid(problems)) => problems.iter().map(Mistake::from).collect(),
        Err(error) => vec![Mistake { place: String::new(), message: error.to_string() }],
    }
}

/// What keeps a valid creature from beginning an episode.
fn start_of(blueprint: &Blueprint) -> Vec<Mistake> {
    let start = check_start(blueprint).err().map(|error| Mistake { place: String::new(), message: error.to_string() });
    start.into_iter().collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use serde_json::json;

    fn choice(creature: &str, movement: &str) -> Choice {
        Choice { creature: Some(creature.into()), movement: movement.into(), ..Choice::default() }
    }

    fn kept() -> Kept {
        let (creatures, terrains) = (vec!["mine".into()], vec!["my hills".into()]);
        Kept {
            creature_folder: "runs/creatures".into(),
            creatures,
            terrain_folder: "runs/terrains".into(),
            terrains,
            runs: "runs".into(),
        }
    }

    fn problem(choice: &Choice) -> String {
        choice.describe(&Registry::default(), None, &kept()).problem.expect("something is wrong")
    }

    /// As flags of the command line, a number of generations takes the place of the preset's steps.
    #[test]
    fn generations_are_those_of_the_command_line() {
        let registry = Registry::default();
        let of = |generations| Choice { generations, ..choice("biped-1", "playing") };
        let stop = |choice: &Choice| choice.resolve(&registry, None).expect("it can be trained").stop;
        assert!(stop(&of(None)).steps.is_some());
        let chosen = stop(&of(Some(30)));
        assert_eq!((chosen.generations, chosen.steps), (Some(30), None));
    }

    #[test]
    fn a_choice_is_what_the_command_line_makes_of_it() {
        let registry = Registry::default();
        let choice =
            Choice { seed: Some(7), set: vec!["controller.hidden=[5]".into()], ..choice("biped-1", "running") };
        let described = choice.describe(&registry, None, &kept());
        assert_eq!(described.problem, None);
        assert_eq!(described.command, "gambol train biped-1 running --seed 7 --set 'controller.hidden=[5]'");
        let request = Request {
            creature: Some("biped-1".into()),
            movement: Some("running".into()),
            set: choice.set.clone(),
            ..Request::default()
        };
        let mut expected = request.resolve(&registry).expect("a configuration");
        expected.seed = 7;
        assert!(described.config == Some(expected.clone()));
        assert!(described.preset != Some(expected));
    }

    #[test]
    fn what_is_wrong_is_said_in_the_words_of_the_library() {
        assert!(problem(&choice("bipet-1", "running")).contains("did you mean \"biped-1\"?"));
        assert!(problem(&choice("biped-1", "runing")).contains("did you mean \"running\"?"));
        let set = |set: &str| Choice { set: vec![set.into()], ..choice("biped-1", "running") };
        assert!(problem(&set("controller.input_range=-1")).contains("controller.input_range"));
        assert!(problem(&Choice::default()).contains("creature"));
    }

    #[test]
    fn a_drawn_terrain_is_a_configuration() {
        let command =
            |terrain: &str| Choice { terrain: Some(terrain.into()), ..choice("biped-1", "running") }.command(&kept());
        assert_eq!(command("my hills"), "gambol train biped-1 running --config 'runs/terrains/my hills.json'");
        assert_eq!(command("gaps:0.3"), "gambol train biped-1 running --terrain gaps:0.3");
        let gap = |from: f32| json!({ "gap": { "from": from, "width": 1 } });
        assert_eq!(check_terrain(&json!({ "drawn": [gap(1.0), gap(2.5)] })), []);
        let mistakes = check_terrain(&json!({ "drawn": [gap(1.0), gap(1.5)] }));
        assert_eq!(mistakes.iter().map(|mistake| &*mistake.place).collect::<Vec<_>>(), ["drawn[1].gap.from"]);
        let mistakes = check_terrain(&json!({ "drawn": [{ "gape": {} }] }));
        assert!(mistakes[0].message.contains("unknown variant `gape`"), "{mistakes:?}");
        assert_eq!(check_terrain(&json!({ "difficulty": 2 }))[0].place, "difficulty");
    }

    #[test]
    fn no_path_is_opened() {
        for path in ["../../etc/passwd", "/etc/passwd", "./biped.json", "creatures/shipped/biped-1.json", "x.json"] {
            let problem = problem(&choice(path, "running"));
            assert!(problem.contains("creature") && !problem.contains("cannot read"), "{problem}");
        }
    }

    #[test]
    fn a_drawn_creature_is_trained_under_its_name() {
        let mut drawn = serde_json::to_value(creatures::find("tetrapod-1").expect("it is shipped")).expect("JSON");
        drawn["name"] = json!("mine");
        let choice = Choice { drawn: Some(drawn.clone()), ..choice("ignored", "running") };
        let described = choice.describe(&Registry::default(), None, &kept());
        assert_eq!(described.config.map(|config| config.creature.name), Some("mine".into()));
        assert_eq!(described.command, "gambol train runs/creatures/mine.json running");
        assert_eq!(super::tests::choice("mine", "running").command(&kept()), described.command, "by its name, too");
        assert_eq!(check(&drawn), []);
        drawn["parts"][1]["shape"] = json!({"circle": {"radius": -1}});
        let mistakes = check(&drawn);
        assert!(mistakes.iter().any(|mistake| mistake.place.starts_with("parts[1].shape")), "{mistakes:?}");
        assert!(problem(&Choice { drawn: Some(drawn), ..choice }).contains("parts[1].shape"));
        assert_eq!(check(&json!({"name": "<b>"})).len(), 1);
    }
}
