//! Worlds that are not quite the one a champion learned in.

use crate::judge::Judge;
use envs_core::{Conditions, Ground, Landscape, Variation, bumps};
use ne_core::{Purpose, Seed};
use rand::RngExt;
use serde::Serialize;
use tasks::Environment;

const PERTURBATION: Purpose = Purpose::new("perturbation");

/// The friction of the ground is changed by up to this share, either way.
pub const FRICTION: f32 = 0.3;
/// The total mass is changed by up to this share, either way.
pub const MASS: f32 = 0.1;
/// The top torque of all motors is changed by up to this share, either way.
pub const TORQUE: f32 = 0.1;
/// The lowest and the highest bump, m.
pub const BUMP_HEIGHTS: [f32; 2] = [0.002, 0.02];

/// No bumps beyond this, m: nothing gets there.
const FARTHEST: f32 = 500.0;

/// What is changed in a perturbed world.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Cause {
    /// Mounds on the ground. A terrain that is not flat has none, and is laid out anew, as in the worlds of all causes. In water
    /// there is no such world.
    Bumps,
    /// [Pushes](Variation::pushed) against the torso.
    Pushes,
    /// Friction ([`FRICTION`]), mass ([`MASS`]), motor torque ([`TORQUE`]), and the start pose by up to 3°.
    Friction,
    /// What [physics engines differ in](Variation::physics).
    Physics,
    /// All of it.
    Together,
    /// What a given variation draws, in place of the others.
    Variation,
}

impl Cause {
    /// The causes that take turns, in this order.
    pub const ALL: [Self; 5] = [Self::Bumps, Self::Pushes, Self::Friction, Self::Physics, Self::Together];

    /// Those that take turns in water, where there is no ground, and on a terrain that is the same whatever its seed.
    pub const WITHOUT_BUMPS: [Self; 4] = [Self::Pushes, Self::Friction, Self::Physics, Self::Together];

    /// Those that take turns where a judge has its creature.
    pub(crate) fn all_of(judge: &Judge) -> &'static [Self] {
        let (environment, terrain) = (judge.environment(), judge.environment().terrain());
        let is_the_same = !terrain.is_flat() && !terrain.has_chance();
        if environment.settings().water.is_some() || is_the_same { &Self::WITHOUT_BUMPS } else { &Self::ALL }
    }

    /// Its name, as in files.
    pub fn name(self) -> &'static str {
        match self {
            Self::Bumps => "bumps",
            Self::Pushes => "pushes",
            Self::Friction => "friction",
            Self::Physics => "physics",
            Self::Together => "together",
            Self::Variation => "variation",
        }
    }

    fn has_bumps(self) -> bool {
        matches!(self, Self::Bumps | Self::Together)
    }

    /// How its worlds vary, but for bumps; a given variation is no cause's.
    fn variation(self) -> Variation {
        let body =
            Variation { friction: FRICTION, mass: MASS, torque: TORQUE, start_pose: 0.05, ..Variation::default() };
        match self {
            Self::Bumps | Self::Variation => Variation::default(),
            Self::Pushes => Variation::pushed(),
            Self::Friction => body,
            Self::Physics => Variation::physics(),
            Self::Together => {
                let Variation { friction, mass, torque, start_pose, .. } = body;
                let pushes = Variation::pushed().pushes;
                Variation { friction, mass, torque, start_pose, pushes, ..Variation::physics() }
            }
        }
    }
}

/// A perturbed world.
pub(crate) struct World {
    pub(crate) cause: Cause,
    pub(crate) conditions: Conditions,
    pub(crate) landscape: Landscape,
    /// How many bumps are on its ground.
    pub(crate) bumps: usize,
    /// s.
    pub(crate) time_step: f32,
}

impl World {
    /// The world of this index: causes take turns. Bumps reach `reach` m from the start, at most 500, to where the movement leads.
    pub(crate) fn draw(seed: Seed, index: u32, judge: &Judge, reach: f32) -> Self {
        Self::draw_with(seed, index, judge, reach, |variation| variation)
    }

    /// The same, of a cause whose variation is changed.
    pub(crate) fn draw_with(
        seed: Seed,
        index: u32,
        judge: &Judge,
        reach: f32,
        change: impl Fn(Variation) -> Variation,
    ) -> Self {
        let environment = judge.environment();
        let seed = seed.trial(index);
        let causes = Cause::all_of(judge);
        let cause = causes[index as usize % causes.len()];
        let (terrain, blueprint) = (environment.terrain(), environment.blueprint());
        let mut stream = seed.stream(PERTURBATION);
        let landscape = if environment.settings().water.is_some() {
            environment.landscape().clone()
        } else if !terrain.is_flat() {
            Landscape::new(terrain, stream.random(), blueprint)
        } else if cause.has_bumps() {
            let [left, _, right, _] = blueprint.bounding_box();
            let mut ground = Ground::flat();
            let (reach, backwards) = (reach.min(FARTHEST), environment.goes_backwards());
            ground.shapes.extend(bumps(&mut stream, BUMP_HEIGHTS, [left, right], reach, backwards));
            ground.into()
        } else {
            environment.landscape().clone()
        };
        Self::new(cause, change(cause.variation()), seed, landscape, judge)
    }

    /// The world of this index of a variation. It has no near trials, and a terrain that is not flat is laid out anew in each.
    pub(crate) fn draw_of(variation: Variation, seed: Seed, index: u32, judge: &Judge) -> Self {
        let seed = seed.trial(index);
        let variation = Variation { near_first: false, terrain: true, ..variation };
        let landscape = judge.environment().landscape_under(&variation, seed).into_owned();
        Self::new(Cause::Variation, variation, seed, landscape, judge)
    }

    fn new(cause: Cause, variation: Variation, seed: Seed, landscape: Landscape, judge: &Judge) -> Self {
        let environment = judge.environment();
        let conditions = variation.draw(seed, environment.outputs());
        let time_step = environment.settings().time_step * conditions.time_step;
        let flat = environment.terrain().is_flat();
        let bumps = if flat { landscape.ground.shapes.len() - environment.landscape().ground.shapes.len() } else { 0 };
        Self { cause, conditions, landscape, bumps, time_step }
    }
}

#[cfg(test)]
pub(crate) mod tests {
    use super::*;
    use crate::Registry;
    use crate::episode_parts::EpisodeParts;
    use creatures::{Actuation, DEFAULT_INPUT_RANGE, Obstacles, Terrain};
    use envs_core::{GroundShape, Water};
    use envs_rapier::{PhysicsSettings, Variation};
    use tasks::{MovementSpec, Trials};

    pub(crate) fn judge(creature: &str, movement: &str) -> Judge {
        judge_on(creature, movement, &Terrain::default())
    }

    /// As [`judge`], in water.
    pub(crate) fn judge_in_water(creature: &str, movement: &str) -> Judge {
        let physics = PhysicsSettings { water: Some(Water::default()), ..PhysicsSettings::default() };
        judge_with(creature, movement, &Terrain::default(), physics)
    }

    fn judge_on(creature: &str, movement: &str, terrain: &Terrain) -> Judge {
        judge_with(creature, movement, terrain, PhysicsSettings::default())
    }

    pub(crate) fn judge_with(creature: &str, movement: &str, terrain: &Terrain, physics: PhysicsSettings) -> Judge {
        let parts = EpisodeParts {
            creature: &creatures::find(creature).expect("shipped"),
            sensors: None,
            input_range: DEFAULT_INPUT_RANGE,
            movement: &MovementSpec::new(movement),
            trials: Trials::default(),
            variation: Variation::default(),
            physics,
            terrain,
            actuation: Actuation::default(),
            commands: None,
        };
        Judge::new(parts, &Registry::default()).expect("builds")
    }

    #[test]
    fn worlds_are_in_range_and_leave_the_start_pose_clear() {
        for name in ["apod", "biped-1", "decapod-2"] {
            let judge = judge(name, "running");
            let [left, _, right, _] = judge.environment().blueprint().bounding_box();
            for index in 0..200 {
                let World { cause, conditions, landscape, bumps, time_step } =
                    World::draw(Seed::of_run(3), index, &judge, 10.0);
                assert_eq!(cause, Cause::ALL[index as usize % 5]);
                let ground = landscape.ground;
                assert_eq!(bumps, ground.shapes.len() - 1);
                assert!((conditions.friction - 1.0).abs() <= FRICTION + 1e-6);
                assert!((conditions.mass - 1.0).abs() <= MASS + 1e-6);
                assert!((conditions.torque - 1.0).abs() <= TORQUE + 1e-6);
                assert!((1.0 / 241.0..=1.0 / 39.9).contains(&time_step), "{time_step}");
                let pushed = matches!(cause, Cause::Pushes | Cause::Together);
                assert_eq!(!conditions.pushes.is_empty(), pushed);
                let physics = matches!(cause, Cause::Physics | Cause::Together);
                assert_eq!(conditions.solver_iterations.is_some(), physics);
                assert_eq!(ground.validate(), Ok(()));
                assert_eq!(ground.shapes.len() > 8, cause.has_bumps());
                for shape in &ground.shapes[1..] {
                    let GroundShape::Circle { x, y, radius } = *shape else { panic!("not a mound") };
                    let (top, half) = (y + radius, libm::sqrtf(radius * radius - y * y));
                    assert!((BUMP_HEIGHTS[0] - 1e-4..=BUMP_HEIGHTS[1] + 1e-4).contains(&top), "{top}");
                    let clear = x - half > right || x + half < left;
                    assert!(clear && x < right + 10.0 && x > left - 5.0, "{x}");
                }
            }
        }
    }

    /// One of bumps would be the unperturbed world, in which every champion is usable.
    #[test]
    fn every_world_in_water_is_perturbed() {
        let judge = judge_in_water("apod", "swimming");
        for index in 0..20 {
            let World { cause, conditions, .. } = World::draw(Seed::of_run(3), index, &judge, 10.0);
            assert_eq!(cause, Cause::WITHOUT_BUMPS[index as usize % 4]);
            assert_ne!(conditions, Conditions::reference(judge.environment().outputs()), "{cause:?}");
        }
    }

    /// The same of another layout of a terrain that has only one.
    #[test]
    fn every_world_on_drawn_ground_is_perturbed() {
        let flat = judge("tetrapod-1", "running");
        let drawn = |obstacles: &str| {
            let terrain: creatures::Terrain = serde_json::from_str(obstacles).expect("a terrain");
            judge_on("tetrapod-1", "running", &terrain)
        };
        let causes = |judge: &Judge| {
            let world = |index| World::draw(Seed::of_run(3), index, judge, 10.0);
            (0..10).map(|index| world(index).cause).collect::<Vec<_>>()
        };
        let same = drawn(r#"{"obstacles": [{"gaps": {}}], "jitter": 0}"#);
        for index in 0..20 {
            let World { cause, conditions, .. } = World::draw(Seed::of_run(3), index, &same, 10.0);
            assert_ne!(conditions, Conditions::reference(same.environment().outputs()), "{cause:?}");
        }
        assert!(!causes(&same).contains(&Cause::Bumps));
        let other = drawn(r#"{"obstacles": [{"gaps": {}}], "jitter": 0.3}"#);
        assert!(causes(&flat).contains(&Cause::Bumps) && causes(&other).contains(&Cause::Bumps));
    }

    #[test]
    fn bumps_reach_as_far_as_they_are_asked_to() {
        let farthest = |reach: f32| {
            let world = World::draw(Seed::of_run(1), 0, &judge("biped-1", "running"), reach);
            let x = |shape: &GroundShape| if let GroundShape::Circle { x, .. } = *shape { x } else { 0.0 };
            world.landscape.ground.shapes.iter().map(x).fold(0.0, f32::max)
        };
        assert!((6.0..8.0).contains(&farthest(8.0)), "{}", farthest(8.0));
        assert!((42.0..48.0).contains(&farthest(45.0)), "{}", farthest(45.0));
        assert!(farthest(1e9) <= FARTHEST);
    }

    /// In the trials of training as well.
    #[test]
    fn bumps_are_where_the_movement_leads() {
        let ends = |movement: &str| {
            let world = World::draw(Seed::of_run(1), 0, &judge("tetrapod-1", movement), 30.0);
            let x = |shape: &GroundShape| if let GroundShape::Circle { x, .. } = *shape { x } else { 0.0 };
            let places: Vec<f32> = world.landscape.ground.shapes.iter().map(x).collect();
            [f32::min, f32::max].map(|which| places.iter().copied().fold(0.0, which))
        };
        let ([left, right], [back, front]) = (ends("running"), ends("backwards"));
        assert!(left > -8.0 && right > 25.0, "{left} {right}");
        assert!(back < -25.0 && front < 8.0, "{back} {front}");
        let middle = |movement: &str| {
            let judge = judge("tetrapod-1", movement);
            let landscape = judge.environment().landscape_under(&Variation::bumpy(), Seed::of_run(1).trial(1));
            let x = |shape: &GroundShape| if let GroundShape::Circle { x, .. } = *shape { x } else { 0.0 };
            landscape.ground.shapes.iter().map(x).sum::<f32>()
        };
        assert!(middle("running") > 0.0 && middle("backwards") < 0.0);
    }

    #[test]
    fn a_terrain_is_laid_out_anew_in_every_world() {
        let terrain = Terrain::of(vec![Obstacles::Gaps { width: None, spacing: None }]);
        let judge = judge_on("tetrapod-2", "running", &terrain);
        let mut layouts: Vec<Landscape> = (0..10)
            .map(|index| World::draw(Seed::of_run(3), index, &judge, 10.0))
            .chain((0..10).map(|index| World::draw_of(Variation::light(), Seed::of_run(4), index, &judge)))
            .inspect(|world| assert_eq!(world.bumps, 0))
            .map(|world| world.landscape)
            .collect();
        layouts.push(judge.environment().landscape().clone());
        for (index, layout) in layouts.iter().enumerate() {
            assert!(!layouts[..index].contains(layout), "{index}");
        }
    }

    #[test]
    fn the_worlds_of_a_variation_are_as_it_draws_them() {
        let judge = judge("biped-1", "running");
        for index in 0..20 {
            let world = World::draw_of(Variation::bumpy(), Seed::of_run(3), index, &judge);
            assert_eq!((world.cause, world.bumps > 0), (Cause::Variation, true));
            assert!(world.conditions.solver_iterations.is_some() && !world.conditions.pushes.is_empty());
            let bare = World::draw_of(Variation::default(), Seed::of_run(3), index, &judge);
            assert_eq!((bare.bumps, bare.conditions.friction, bare.landscape.ground.shapes.len()), (0, 1.0, 1));
        }
    }
}
