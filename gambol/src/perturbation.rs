//! Worlds that are not quite the one a champion learned in.

use crate::gait::Stage;
use envs_core::{Conditions, Ground, Landscape, bumps};
use ne_core::{Purpose, RandomStream, Seed};
use rand::RngExt;
use tasks::Environment;

const PERTURBATION: Purpose = Purpose::new("perturbation");

/// The friction of the ground is changed by up to this share, either way.
pub const FRICTION: f32 = 0.3;
/// The mass of all parts together is.
pub const MASS: f32 = 0.1;
/// The top torque of all motors together is.
pub const TORQUE: f32 = 0.1;
/// The shortest and the longest time step, s; drawn log-uniformly.
pub const TIME_STEPS: [f32; 2] = [1.0 / 120.0, 1.0 / 40.0];
/// The lowest and the highest bump, m.
pub const BUMP_HEIGHTS: [f32; 2] = [0.002, 0.02];

/// No bumps beyond this, m: nobody gets there.
const FARTHEST: f32 = 500.0;

/// A perturbed world.
pub(crate) struct World {
    pub(crate) conditions: Conditions,
    pub(crate) landscape: Landscape,
    /// How many bumps are on its ground.
    pub(crate) bumps: usize,
    /// s.
    pub(crate) time_step: f32,
}

impl World {
    /// The world of a seed. Bumps reach `reach` m from the start, at most 500. A terrain has none, but is laid out anew; in
    /// water there are none either.
    pub(crate) fn draw(seed: Seed, stage: &Stage, reach: f32) -> Self {
        let environment = stage.environment();
        let mut stream = seed.stream(PERTURBATION);
        let mut factor = |share: f32| uniform(&mut stream, [1.0 - share, 1.0 + share]);
        let (friction, mass, torque) = (factor(FRICTION), factor(MASS), factor(TORQUE));
        let time_step = libm::expf(uniform(&mut stream, TIME_STEPS.map(libm::logf)));
        let nominal = environment.settings().time_step;
        let conditions = Conditions {
            friction,
            mass,
            torque,
            time_step: time_step / nominal,
            ..Conditions::nominal(environment.outputs())
        };
        let (terrain, blueprint) = (environment.terrain(), environment.blueprint());
        if !terrain.is_flat() {
            let landscape = Landscape::new(terrain, stream.random(), blueprint);
            return Self { conditions, landscape, bumps: 0, time_step };
        }
        if environment.settings().water.is_some() {
            return Self { conditions, landscape: Landscape::default(), bumps: 0, time_step };
        }
        let [left, _, right, _] = blueprint.bounding_box();
        let bumps = bumps(&mut stream, BUMP_HEIGHTS, [left, right], reach.min(FARTHEST));
        let count = bumps.len();
        let mut ground = Ground::flat();
        ground.shapes.extend(bumps);
        Self { conditions, landscape: ground.into(), bumps: count, time_step }
    }
}

fn uniform(stream: &mut RandomStream, [low, high]: [f32; 2]) -> f32 {
    low + (high - low) * stream.random::<f32>()
}

#[cfg(test)]
pub(crate) mod tests {
    use super::*;
    use crate::setup::EpisodeParts;
    use creatures::{Actuation, DEFAULT_INPUT_RANGE, Terrain};
    use envs_core::GroundShape;
    use envs_rapier::{PhysicsSettings, Variation};
    use tasks::{MovementCatalogue, MovementSpec, Trials};

    pub(crate) fn stage(creature: &str, movement: &str) -> Stage {
        let parts = EpisodeParts {
            creature: &creatures::find(creature).expect("shipped"),
            sensors: None,
            input_range: DEFAULT_INPUT_RANGE,
            movement: &MovementSpec::new(movement),
            trials: Trials::default(),
            variation: Variation::default(),
            physics: PhysicsSettings::default(),
            terrain: &Terrain::default(),
            actuation: Actuation::default(),
        };
        Stage::new(parts, &MovementCatalogue::default()).expect("builds")
    }

    #[test]
    fn worlds_are_in_range_and_leave_the_start_pose_clear() {
        for name in ["apod", "biped-1", "decapod-2"] {
            let stage = stage(name, "running");
            let [left, _, right, _] = stage.environment().blueprint().bounding_box();
            for index in 0..200 {
                let seed = Seed::of_run(3).trial(index);
                let World { conditions, landscape, bumps, time_step } = World::draw(seed, &stage, 10.0);
                let ground = landscape.ground;
                assert_eq!(bumps, ground.shapes.len() - 1);
                assert!((conditions.friction - 1.0).abs() <= FRICTION + 1e-6);
                assert!((conditions.mass - 1.0).abs() <= MASS + 1e-6);
                assert!((conditions.torque - 1.0).abs() <= TORQUE + 1e-6);
                assert!((TIME_STEPS[0] - 1e-6..=TIME_STEPS[1] + 1e-6).contains(&time_step), "{time_step}");
                assert_eq!(ground.validate(), Ok(()));
                assert!(ground.shapes.len() > 8);
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

    #[test]
    fn bumps_reach_as_far_as_they_are_asked_to() {
        let farthest = |reach: f32| {
            let world = World::draw(Seed::of_run(1), &stage("biped-1", "running"), reach);
            let x = |shape: &GroundShape| if let GroundShape::Circle { x, .. } = *shape { x } else { 0.0 };
            world.landscape.ground.shapes.iter().map(x).fold(0.0, f32::max)
        };
        assert!((6.0..8.0).contains(&farthest(8.0)), "{}", farthest(8.0));
        assert!((42.0..48.0).contains(&farthest(45.0)), "{}", farthest(45.0));
        assert!(farthest(1e9) <= FARTHEST);
    }
}
