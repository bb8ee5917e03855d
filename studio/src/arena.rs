//! Creatures that move on the same ground at once, each with a net of its own.

use crate::{
    protocol::{ArenaData, ArenaError, Told},
    scene::{Entrant, Scene},
};
use creatures::{Channel, Creature};
use envs_core::{Engine, Ground, GroundShape};
use envs_rapier::RapierEnvironment;
use gambol_reports::page::{ground::GroundData, network::NetworkData};
use gambol_runs::{Registry, champion::ChannelRecord};
use ne_core::{Phenotype, Seed};
use ne_net::Network;
use tasks::{CommandChange, Commands, Environment};

/// Creatures of one body in copies of one world: they never meet. Time passes only when it is [asked to](Self::advance).
pub struct Arena {
    creature: Creature,
    actors: Vec<Actor>,
    step: u32,
    time_step: f32,
    gravity: f32,
    friction: f32,
    told: Option<Told>,
    /// What was put in the way of all.
    obstacles: Vec<GroundShape>,
    ground: Ground,
}

struct Actor {
    world: RapierEnvironment,
    network: Network,
    sensed: Vec<f32>,
    wanted: Vec<f32>,
    /// Its body exploded, or its net gave no number: it stays where it is.
    is_over: bool,
}

/// The most steps that pass at once: a second or two.
pub const MOST_STEPS: u32 = 120;

/// The most obstacles that may be put in the way.
const MOST_OBSTACLES: usize = 100;

impl Arena {
    /// The arena of a scene.
    ///
    /// # Errors
    /// If its world cannot be built, or as [`new`](Self::new).
    pub fn of(scene: &Scene, registry: &Registry) -> Result<Self, ArenaError> {
        Self::new(&scene.world.build(registry)?, &scene.entrants, scene.seed)
    }

    /// All of them at the start of the trial with this seed, the best first.
    ///
    /// # Errors
    /// If there is none, a net is not made for this body, or a body does not come to rest.
    pub fn new(world: &RapierEnvironment, entrants: &[Entrant], seed: Seed) -> Result<Self, ArenaError> {
        let mut start = world.clone();
        start.reset(seed)?;
        let (inputs, outputs) = (start.inputs(), start.outputs());
        let actor = |entrant: &Entrant| {
            let mut network = entrant.network.clone();
            if (network.inputs(), network.outputs()) != (inputs, outputs) {
                return Err(ArenaError::Shape { inputs, outputs });
            }
            network.reset();
            let (sensed, wanted) = (vec![0.0; inputs], vec![0.0; outputs]);
            Ok(Actor { world: start.clone(), network, sensed, wanted, is_over: false })
        };
        let actors = entrants.iter().map(actor).collect::<Result<Vec<_>, _>>()?;
        if actors.is_empty() {
            return Err(ArenaError::Empty);
        }
        let ground = world.landscape_of(seed).ground.clone();
        Ok(Self {
            creature: world.blueprint().creature().clone(),
            actors,
            step: 0,
            time_step: start.time_step(),
            gravity: world.settings().gravity,
            friction: world.settings().ground_friction,
            told: None,
            obstacles: Vec::new(),
            ground,
        })
    }

    /// What a page needs to draw it.
    pub fn data(&self) -> ArenaData {
        ArenaData {
            creature: self.creature.clone(),
            actors: self.actors.len(),
            parts: self.creature.parts.len(),
            time_step: self.time_step,
            ground: self.ground_data(),
            follows_commands: self.actors[0].world.commands().is_some(),
            network: self.network(),
        }
    }

    /// The net of the first, with the names of what it hears and moves.
    fn network(&self) -> NetworkData {
        let Actor { world, network, .. } = &self.actors[0];
        let records = |channels: &[Channel]| channels.iter().map(ChannelRecord::from).collect::<Vec<_>>();
        NetworkData::new(network, &records(world.senses().channels()), &records(world.motors().channels()), &[])
    }

    /// The ground with all that was put in the way, for a page.
    pub fn ground_data(&self) -> Option<GroundData> {
        let shapes = self.ground.shapes.iter().chain(&self.obstacles).copied().collect();
        GroundData::new(&Ground { shapes }, [-1000.0, 1000.0])
    }

    /// Lets so many steps pass, at most [`MOST_STEPS`].
    pub fn advance(&mut self, steps: u32) {
        for _ in 0..steps.min(MOST_STEPS) {
            self.actors.iter_mut().for_each(Actor::step);
            self.step += 1;
        }
    }

    /// Tells every body what to do from now on.
    pub fn tell(&mut self, told: Told) {
        let speed = if told.speed.is_finite() { told.speed.clamp(-20.0, 20.0) } else { 0.0 };
        let told = Told { speed, jump: told.jump };
        if self.told == Some(told) {
            return;
        }
        self.told = Some(told);
        let change = CommandChange { time: 0.0, speed: told.speed, jump: told.jump };
        let schedule = Commands::Given(vec![change]).draw(Seed::of_run(0), false);
        for actor in self.actors.iter_mut().filter(|actor| actor.world.commands().is_some()) {
            actor.world.tell(schedule.clone());
        }
    }

    /// Adds to the velocity of a part of the first body, m/s.
    ///
    /// # Errors
    /// If it has no such part, or the velocity is more than 50 m/s.
    pub fn push(&mut self, part: usize, velocity: [f32; 2]) -> Result<(), ArenaError> {
        if part >= self.creature.parts.len() || !velocity.iter().all(|speed| speed.abs() <= 50.0) {
            return Err(ArenaError::Push);
        }
        self.actors[0].world.engine_mut().nudge(part, velocity, 0.0);
        Ok(())
    }

    /// Turns gravity by an angle, rad: above 0 it pulls to the right. And makes it so many times as strong.
    ///
    /// # Errors
    /// If the angle is more than half a turn, or the factor not from 0 to 5.
    pub fn tilt(&mut self, angle: f32, factor: f32) -> Result<(), ArenaError> {
        if !(angle.abs() <= std::f32::consts::PI && (0.0..=5.0).contains(&factor)) {
            return Err(ArenaError::Gravity);
        }
        let pull = self.gravity * factor;
        for actor in &mut self.actors {
            actor.world.engine_mut().set_gravity([pull * angle.sin(), -pull * angle.cos()]);
        }
        Ok(())
    }

    /// Puts a box on the ground in the way of all.
    ///
    /// # Errors
    /// If a size is not positive, or there are 100 already.
    pub fn put_box(&mut self, x: f32, width: f32, height: f32) -> Result<(), ArenaError> {
        let sizes_fit = [width, height].iter().all(|size| (0.01..=10.0).contains(size));
        if !(sizes_fit && x.abs() <= 1e5) || self.obstacles.len() >= MOST_OBSTACLES {
            return Err(ArenaError::Obstacle);
        }
        let shape = GroundShape::Box { x, y: height * 0.5, width, height };
        for actor in &mut self.actors {
            let added = actor.world.engine_mut().add_obstacle(&shape, self.friction);
            added.map_err(|_| ArenaError::Obstacle)?;
        }
        self.obstacles.push(shape);
        Ok(())
    }

    /// How many steps have passed.
    pub fn step(&self) -> u32 {
        self.step
    }

    /// What there is to see now, as little-endian numbers of 32 bits: the number that the arena goes by, steps passed, actors, parts and nodes
    /// of the first one's net as integers; then place (m) and angle (rad) of each part of each actor; the activation of each node; what the
    /// first one is told (body lengths/s, jump); and for each of its parts 1 if it presses on the ground, else 0.
    pub fn frame(&self, number: u32) -> Vec<u8> {
        let first = &self.actors[0];
        let activations = first.network.activations();
        let parts = self.creature.parts.len();
        let counts = [number, self.step, self.actors.len() as u32, parts as u32, activations.len() as u32];
        let mut bytes =
            Vec::with_capacity(4 * (counts.len() + self.actors.len() * parts * 3 + activations.len() + 2 + parts));
        bytes.extend(counts.iter().flat_map(|count| count.to_le_bytes()));
        let mut add = |number: f32| bytes.extend(number.to_le_bytes());
        for part in self.actors.iter().flat_map(|actor| &actor.world.snapshot().parts) {
            [part.x, part.y, part.angle()].into_iter().for_each(&mut add);
        }
        activations.into_iter().for_each(&mut add);
        let snapshot = first.world.snapshot();
        add(snapshot.command.speed);
        add(f32::from(u8::from(snapshot.command.jump)));
        snapshot.parts.iter().for_each(|part| add(f32::from(u8::from(part.touching))));
        bytes
    }
}

impl Actor {
    fn step(&mut self) {
        if self.is_over {
            return;
        }
        self.world.sense(&mut self.sensed);
        self.network.activate(&self.sensed, &mut self.wanted);
        self.is_over = !self.wanted.iter().all(|wanted| wanted.is_finite());
        if !self.is_over {
            self.world.act(&self.wanted);
            self.is_over = self.world.step().is_err();
        }
    }
}
