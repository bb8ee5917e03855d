//! The creatures and terrains that were drawn here: a file for each.

use super::{Library, LibraryError, cannot_remove};
use crate::choice::Kept;
use creatures::{Blueprint, Creature, Terrain, is_file_name};
use gambol_runs::Registry;
use ne_core::{
    archive,
    bounded_read::{LARGEST_TEXT, read_text},
    field_path,
};
use std::{
    fs, io,
    path::{Path, PathBuf},
};

/// Drawn creatures are kept in this folder among the runs.
const CREATURES: &str = "creatures";

/// Drawn terrains are kept in this folder among the runs, each as a configuration that has nothing but it.
const TERRAINS: &str = "terrains";

impl Library {
    /// The creatures and terrains that were drawn and kept.
    pub fn kept(&self) -> Kept {
        let creatures = self.drawn_creatures().into_iter().map(|creature| creature.name).collect();
        let terrains = self.drawn_terrains().into_iter().map(|(name, _)| name).collect();
        let (creature_folder, terrain_folder) = (self.creatures(), self.runs.join(TERRAINS));
        Kept { creatures, terrains, creature_folder, terrain_folder, runs: self.runs.clone() }
    }

    /// The registry with the creatures and terrains that were drawn here.
    pub fn registry_with_drawn(&self) -> Registry {
        let mut registry = self.registry.clone();
        for creature in self.drawn_creatures() {
            // Each was checked as it was read.
            let _ = serde_json::to_string(&creature).map(|json| registry.creatures.add_file(&json).map(drop));
        }
        for (name, terrain) in self.drawn_terrains() {
            registry.terrains.add(&name, "drawn here", terrain);
        }
        registry
    }

    /// Keeps a drawn creature under its name, in place of what was drawn under it before.
    ///
    /// # Errors
    /// If it is not valid, has the name of one that is shipped, or cannot be written.
    pub fn keep(&self, creature: &Creature) -> Result<PathBuf, LibraryError> {
        let failed = |error: &dyn std::fmt::Display| LibraryError::Keep(error.to_string());
        // A valid name is one of a file, and of none elsewhere.
        let blueprint = Blueprint::new(creature.clone()).map_err(|error| failed(&error))?;
        if self.registry.creatures.find(blueprint.name()).is_ok() {
            return Err(failed(&format!("\"{}\" is the name of another; give it one of its own", blueprint.name())));
        }
        let path = self.creatures().join(format!("{}.json", blueprint.name()));
        archive::make_folder(&self.creatures()).map_err(|error| failed(&error))?;
        let json = serde_json::to_string_pretty(creature).map_err(|error| failed(&error))?;
        archive::write_whole_together(&[(&*path, format!("{json}\n").as_bytes())]).map_err(|error| failed(&error))?;
        Ok(path)
    }

    /// Keeps a drawn terrain under a name, in place of what was drawn under it before.
    ///
    /// # Errors
    /// If it is not valid, its name is that of one that is shipped or cannot be that of a file, or it cannot be written.
    pub fn keep_terrain(&self, name: &str, terrain: &Terrain) -> Result<PathBuf, LibraryError> {
        let failed = |error: &dyn std::fmt::Display| LibraryError::KeepTerrain(error.to_string());
        terrain.validate().map_err(|error| failed(&error))?;
        if terrain.drawn.is_empty() {
            return Err(failed(&"nothing is drawn yet"));
        }
        if !is_file_name(name) {
            return Err(failed(&"its name must begin with a letter or digit, and have only these, spaces, - _ and ."));
        }
        if self.registry.terrains.find(name).is_ok() {
            return Err(failed(&format!("\"{name}\" is the name of another; give it one of its own")));
        }
        let folder = self.runs.join(TERRAINS);
        let path = folder.join(format!("{name}.json"));
        archive::make_folder(&folder).map_err(|error| failed(&error))?;
        let json = serde_json::to_string_pretty(&serde_json::json!({ "terrain": terrain }));
        let json = json.map_err(|error| failed(&error))?;
        archive::write_whole_together(&[(&*path, format!("{json}\n").as_bytes())]).map_err(|error| failed(&error))?;
        Ok(path)
    }

    /// Removes a creature that was drawn here. Each run of it has its body in its own folder.
    ///
    /// # Errors
    /// If none of this name was drawn here, or its file cannot be removed.
    pub fn remove_creature(&self, name: &str) -> Result<(), LibraryError> {
        let has_name = |text: &str| Blueprint::from_json(text).is_ok_and(|blueprint| blueprint.name() == name);
        let texts = texts_in(&self.creatures()).into_iter();
        let files = texts.filter(|(_, text)| has_name(text)).map(|(file, _)| file);
        remove_texts(&self.creatures(), files.collect()).map_err(|error| cannot_remove("creature", name, &error))
    }

    /// Removes a terrain that was drawn here. Each run on it has its obstacles in its own folder.
    ///
    /// # Errors
    /// If none of this name was drawn here, or its file cannot be removed.
    pub fn remove_terrain(&self, name: &str) -> Result<(), LibraryError> {
        let files = self.drawn_terrains().into_iter().map(|(file, _)| file).filter(|file| file == name);
        let folder = self.runs.join(TERRAINS);
        remove_texts(&folder, files.collect()).map_err(|error| cannot_remove("terrain", name, &error))
    }

    /// The folder of drawn creatures.
    fn creatures(&self) -> PathBuf {
        self.runs.join(CREATURES)
    }

    pub(super) fn drawn_creatures(&self) -> Vec<Creature> {
        let read = |(_, text): (String, String)| Some(Blueprint::from_json(&text).ok()?.creature().clone());
        texts_in(&self.creatures()).into_iter().filter_map(read).collect()
    }

    pub(super) fn drawn_terrains(&self) -> Vec<(String, Terrain)> {
        let read = |(name, text): (String, String)| {
            let config: serde_json::Value = serde_json::from_str(&text).ok()?;
            let terrain: Terrain = field_path::from_value(config.get("terrain")?).ok()?;
            let is_new = self.registry.terrains.find(&name).is_err();
            (is_new && terrain.validate().is_ok()).then_some((name, terrain))
        };
        texts_in(&self.runs.join(TERRAINS)).into_iter().filter_map(read).collect()
    }
}

/// The JSON files in a folder, each with its name.
fn texts_in(folder: &Path) -> Vec<(String, String)> {
    let Ok(entries) = fs::read_dir(folder) else { return Vec::new() };
    let mut files: Vec<PathBuf> = entries.flatten().map(|entry| entry.path()).collect();
    files.sort();
    let read = |path: &PathBuf| {
        path.extension().filter(|extension| *extension == "json")?;
        let name = path.file_stem()?.to_str()?.to_owned();
        Some((name, read_text(path, LARGEST_TEXT).ok()?))
    };
    files.iter().filter_map(read).collect()
}

/// Removes files that [`texts_in`] has named; there must be one.
fn remove_texts(folder: &Path, names: Vec<String>) -> io::Result<()> {
    if names.is_empty() {
        return Err(io::Error::new(io::ErrorKind::NotFound, "none of this name was drawn here"));
    }
    names.iter().try_for_each(|name| fs::remove_file(folder.join(format!("{name}.json"))))
}
