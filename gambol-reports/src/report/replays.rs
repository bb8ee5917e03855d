//! Replays of champions and populations for the page, played anew: a run keeps the nets, not the films.

use super::data::{PopulationEntry, PopulationMember, Replay, StripEntry};
use crate::page::ground::GroundData;
use envs_rapier::RapierEnvironment;
use gambol_runs::{
    run_folder::{GalleryEntry, GalleryMember},
    setup::Setup,
    trajectory::Recording,
};
use ne_core::{Evaluation, Fitness, Seed, Task};
use ne_net::Network;
use rayon::prelude::*;
use tasks::Episode;

/// Seconds a small replay shows.
const STILL_SECONDS: f32 = 8.0;
/// Frames a second of a small replay.
const STILL_RATE: f32 = 12.5;
/// From where to where the ground under a population is drawn, m.
const DRAWN_WITH_POPULATIONS: [f32; 2] = [-20.0, 60.0];
/// Members of a population that are drawn.
const MEMBERS: usize = 16;

/// Plays a controller's first trial for at most `steps` steps.
pub(super) fn play(episode: &Episode<RapierEnvironment>, mut network: Network, seed: Seed, steps: u32) -> Recording {
    let mut recording = Recording::default();
    episode.shortened(steps).play(&mut network, seed.trial(0), &mut recording);
    recording
}

/// The first seconds of a controller's first trial, small.
pub(super) fn film(episode: &Episode<RapierEnvironment>, network: Network, seed: Seed) -> Replay {
    let (steps, stride) = pace(episode);
    let recording = play(episode, network, seed, steps);
    Replay::new(&recording.snapshots, episode.environment().settings().time_step, stride)
}

/// The steps of a small replay, and how many of them make a frame.
fn pace(episode: &Episode<RapierEnvironment>) -> (u32, usize) {
    let time_step = episode.environment().settings().time_step;
    let steps = episode.steps().min((STILL_SECONDS / time_step) as u32);
    (steps, ((1.0 / STILL_RATE / time_step).round() as usize).max(1))
}

/// Makes the small replays of a run.
pub(super) struct Stills<'a> {
    setup: &'a Setup,
    /// Of the run.
    seed: Seed,
    steps: u32,
    stride: usize,
}

impl<'a> Stills<'a> {
    pub(super) fn new(setup: &'a Setup, seed: u64) -> Self {
        let (steps, stride) = pace(&setup.episode);
        Self { setup, seed: Seed::of_run(seed), steps, stride }
    }

    pub(super) fn champions(&self, entries: &[&GalleryEntry]) -> Vec<StripEntry> {
        let still = |entry: &&GalleryEntry| {
            let champion = entry.members.first()?;
            let replay = self.found(&champion.network, entry.generation);
            Some(StripEntry { generation: entry.generation, fitness: champion.fitness.map(Fitness::get), replay })
        };
        entries.par_iter().filter_map(still).collect()
    }

    /// One that was found in this generation; where there is a champion selection, in the champion selection's world.
    pub(super) fn found(&self, network: &Network, generation: u64) -> Replay {
        match &self.setup.reference {
            Some(reference) => self.replay(&reference.episode, reference.seed, network),
            None => self.replay(&self.setup.episode, self.seed.generation(generation), network),
        }
    }

    /// What a controller comes to where champions are judged, if training is elsewhere.
    pub(super) fn judged(&self, network: &Network) -> Option<Evaluation> {
        let reference = self.setup.reference.as_ref()?;
        Some(reference.task.evaluate(&mut network.clone(), reference.seed))
    }

    pub(super) fn populations(&self, entries: &[&GalleryEntry]) -> Vec<PopulationEntry> {
        let population = |entry: &&GalleryEntry| {
            let mut members: Vec<&GalleryMember> = entry.members.iter().collect();
            members.sort_by_key(|member| std::cmp::Reverse(member.fitness));
            // From the best to the worst, evenly.
            let members = super::spread(&members, MEMBERS);
            let member = |member: &&GalleryMember| PopulationMember {
                fitness: member.fitness.map(Fitness::get),
                replay: self.replay(&self.setup.episode, self.seed.generation(entry.generation), &member.network),
            };
            let landscape =
                self.setup.episode.environment().landscape_of(self.seed.generation(entry.generation).trial(0));
            PopulationEntry {
                generation: entry.generation,
                members: members.par_iter().map(member).collect(),
                ground: GroundData::new(&landscape.ground, DRAWN_WITH_POPULATIONS),
            }
        };
        entries.iter().map(population).collect()
    }

    fn replay(&self, episode: &Episode<RapierEnvironment>, seed: Seed, network: &Network) -> Replay {
        let recording = play(episode, network.clone(), seed, self.steps);
        // That of the world it was in, which may vary.
        let time_step = match recording.snapshots[..] {
            [ref first, ref second, ..] => second.time - first.time,
            _ => episode.environment().settings().time_step,
        };
        Replay::new(&recording.snapshots, time_step, self.stride)
    }
}
