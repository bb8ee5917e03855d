//! Terrains laid out for a body.

use crate::puppet::Puppet;
use creatures::{Blueprint, BodySizes, Direction, DrawnObstacle, ObstacleKind, Obstacles, TERRAINS, Terrain};
use envs_core::{CreatureEnvironment, Ground, GroundShape, Landscape, PhysicsSettings, Variation, next_gap};

fn blueprint(name: &str) -> Blueprint {
    Blueprint::new(creatures::find(name).expect("shipped")).expect("valid")
}

fn lay_out(terrain: &Terrain, name: &str) -> Landscape {
    Landscape::new(terrain, terrain.seed, &blueprint(name))
}

/// The height of the ground at x, m: the highest surface there.
fn surface(ground: &Ground, at: f32) -> f32 {
    let height = |shape: &GroundShape| match *shape {
        GroundShape::HalfSpace => Some(0.0),
        GroundShape::Floor { y } => Some(y),
        GroundShape::Box { x, y, width, height } => ((at - x).abs() <= 0.5 * width).then_some(y + 0.5 * height),
        GroundShape::Slab { x, y, width, height, angle } => {
            let (sin, cos) = libm::sincosf(angle);
            let (top_x, top_y) = (x - 0.5 * height * sin, y + 0.5 * height * cos);
            ((at - top_x).abs() <= 0.5 * width * cos).then_some(top_y + (at - top_x) * sin / cos)
        }
        GroundShape::Circle { .. } => None,
    };
    ground.shapes.iter().filter_map(height).fold(f32::NEG_INFINITY, f32::max)
}

fn stairs(direction: Direction) -> Terrain {
    let (rise, tread) = (Some(0.1), Some(0.4));
    Terrain::of(vec![Obstacles::Stairs { rise, tread, direction, spacing: Some(2.0) }])
}

#[test]
fn every_terrain_is_valid_ground_that_begins_level_and_ends_level() {
    for entry in TERRAINS {
        for (name, difficulty) in [("tetrapod-2", 0.1), ("apod", 0.5), ("biped-1", 1.0)] {
            let terrain = entry.terrain().with_difficulty(difficulty);
            let body = BodySizes::of(&blueprint(name));
            let Landscape { ground, obstacles } = lay_out(&terrain, name);
            assert_eq!(ground.validate(), Ok(()), "{}", entry.name);
            if terrain.is_flat() {
                assert_eq!((ground, obstacles), (Ground::flat(), vec![]));
                continue;
            }
            let first = body.front + 2.0 * body.body_length;
            assert_eq!(obstacles[0].from, first, "{}", entry.name);
            for x in [-49.0, body.back, 0.0, body.front, first - 1e-3] {
                assert_eq!(surface(&ground, x), 0.0, "{} at {x} m", entry.name);
            }
            assert!(obstacles.len() > 3, "{}: {} obstacles", entry.name, obstacles.len());
            for pair in obstacles.windows(2) {
                let level = pair[1].from - pair[0].to;
                let spacing = 3.0 * body.body_length;
                assert!((0.69 * spacing..1.31 * spacing).contains(&level), "{}: {level} m between", entry.name);
            }
            let last = obstacles[obstacles.len() - 1];
            assert!(last.from <= 80.0, "{}: the last begins at {} m", entry.name, last.from);
            let level = surface(&ground, last.to + 1.0);
            assert_eq!(surface(&ground, last.to + 400.0), level, "{}", entry.name);
        }
    }
}

#[test]
fn at_difficulty_0_every_terrain_is_flat() {
    for entry in TERRAINS {
        assert_eq!(lay_out(&entry.terrain().with_difficulty(0.0), "tetrapod-2"), Landscape::default());
    }
}

#[test]
fn gaps_are_as_wide_as_asked_and_too_deep_to_climb_out_of() {
    let terrain = Terrain::of(vec![Obstacles::Gaps { width: Some(0.4), spacing: Some(3.0) }]);
    let landscape = lay_out(&terrain, "tetrapod-2");
    let length = blueprint("tetrapod-2").body_length();
    for [from, to] in landscape.gaps() {
        assert!((to - from - 0.4).abs() < 1e-4, "{from} to {to}");
        assert_eq!(surface(&landscape.ground, from - 1e-2), 0.0);
        assert_eq!(surface(&landscape.ground, to + 1e-2), 0.0);
        assert!(surface(&landscape.ground, 0.5 * (from + to)) <= -1.5 * length);
    }
    assert_eq!(landscape.gaps().count(), landscape.obstacles.len());
}

#[test]
fn stairs_go_where_they_should() {
    for (direction, ends) in [(Direction::Up, 0.5), (Direction::Down, -0.5), (Direction::UpAndDown, 0.0)] {
        let landscape = lay_out(&stairs(direction), "tetrapod-2");
        let first = landscape.obstacles[0];
        let height = surface(&landscape.ground, first.to + 0.1);
        assert!((height - ends).abs() < 1e-5, "{direction:?}: {height} m");
        let up = if direction == Direction::Down { -0.1 } else { 0.1 };
        let step = surface(&landscape.ground, first.from + 0.2);
        assert!((step - up).abs() < 1e-5, "{direction:?}: {step} m");
    }
    // To the bit: a step of a rounding error would be a step.
    let landscape = lay_out(&stairs(Direction::UpAndDown), "tetrapod-2");
    assert_eq!(surface(&landscape.ground, landscape.obstacles[0].to + 0.1), 0.0);
}

#[test]
fn slopes_are_as_steep_as_asked_and_meet_the_level_ground() {
    let slopes = |direction| Terrain::of(vec![Obstacles::Slopes { degrees: Some(20.0), direction, spacing: None }]);
    for direction in [Direction::Up, Direction::Down, Direction::UpAndDown] {
        let landscape = lay_out(&slopes(direction), "tetrapod-2");
        let [first, ..] = landscape.obstacles[..] else { panic!("no slope") };
        let at = |x: f32| surface(&landscape.ground, first.from + x);
        let sign = if direction == Direction::Down { -1.0 } else { 1.0 };
        let steepness = (at(1.5) - at(0.5)) * sign;
        assert!((steepness - libm::tanf(20_f32.to_radians())).abs() < 1e-3, "{direction:?}: {steepness}");
        // Nowhere does it jump.
        let end = first.to - first.from + 0.5;
        let mut before = at(-0.5);
        for step in 0..2000 {
            let now = at(-0.5 + (end + 0.5) * step as f32 / 2000.0);
            assert!((now - before).abs() < 0.01, "{direction:?}: from {before} to {now} m");
            before = now;
        }
    }
}

#[test]
fn what_is_drawn_stands_where_it_was_drawn() {
    let drawn = vec![
        DrawnObstacle::Box { from: 1.0, width: 0.5, height: 0.2 },
        DrawnObstacle::Box { from: 1.5, width: 0.5, height: 0.4 },
        DrawnObstacle::Slope { from: 3.0, width: 2.0, rise: 1.0 },
        DrawnObstacle::Gap { from: 6.0, width: 0.6 },
        DrawnObstacle::Slope { from: 6.6, width: 1.0, rise: -1.5 },
        DrawnObstacle::Box { from: 9.0, width: 1.0, height: 0.1 },
    ];
    let terrain = Terrain { drawn, ..Terrain::default() };
    for name in ["tetrapod-2", "apod"] {
        let front = BodySizes::of(&blueprint(name)).front;
        let Landscape { ground, obstacles } = lay_out(&terrain, name);
        assert_eq!(ground.validate(), Ok(()));
        let heights = [
            (0.5, 0.0),
            (1.25, 0.2),
            (1.75, 0.4),
            (2.5, 0.0),
            (4.0, 0.5),
            (5.5, 1.0),
            (7.1, 0.25),
            (8.5, -0.5),
            (9.5, -0.4),
            (400.0, -0.5),
        ];
        for (at, height) in heights {
            let found = surface(&ground, front + at);
            assert!((found - height).abs() < 1e-4, "{name}: {found} m at {at} m");
        }
        assert!(surface(&ground, front + 6.3) <= -1.5, "a pit is deep, wherever it is");
        let kinds: Vec<_> = obstacles.iter().map(|obstacle| obstacle.kind.name()).collect();
        assert_eq!(kinds, ["hurdles", "hurdles", "slopes", "gaps", "slopes", "hurdles"]);
        assert_eq!((obstacles[3].from, obstacles[3].to), (front + 6.0, front + 6.6));
    }
    let [one, other] = [0, 1].map(|seed| Landscape::new(&terrain, seed, &blueprint("apod")));
    assert_eq!(one, other, "nothing of it is chance");
}

#[test]
fn a_mixture_takes_turns() {
    let landscape = lay_out(&TERRAINS[TERRAINS.len() - 1].terrain(), "biped-1");
    let kinds: Vec<ObstacleKind> = landscape.obstacles.iter().map(|obstacle| obstacle.kind).collect();
    use ObstacleKind::{Gaps, Hurdles, Rough, Slopes, Stairs};
    assert_eq!(kinds[..7], [Gaps, Hurdles, Stairs, Slopes, Rough, Gaps, Hurdles]);
}

#[test]
fn the_seed_moves_the_obstacles_and_nothing_else_does() {
    let terrain = TERRAINS[1].terrain();
    let [one, again, other] = [0, 0, 1].map(|seed| Landscape::new(&terrain, seed, &blueprint("apod")));
    assert_eq!(one, again);
    assert_ne!(one.obstacles, other.obstacles);
    let even = Terrain { jitter: 0.0, ..terrain };
    assert!(!even.has_chance() && TERRAINS[1].terrain().has_chance());
    let [one, other] = [0, 1].map(|seed| Landscape::new(&even, seed, &blueprint("apod")));
    assert_eq!(one, other);
}

#[test]
fn the_next_gap_is_the_one_that_ends_ahead() {
    let gaps = [[2.0, 2.5], [6.0, 7.0]];
    for (x, told) in [
        (0.0, [2.0, 0.5]),
        (1.5, [0.5, 0.5]),
        // Above it.
        (2.25, [0.0, 0.5]),
        (2.5, [3.5, 1.0]),
        (6.5, [0.0, 1.0]),
        (7.0, [4.0, 0.0]),
    ] {
        assert_eq!(next_gap(&gaps, x, 4.0), told, "at {x} m");
    }
    // Too far ahead, and none at all.
    assert_eq!(next_gap(&gaps, 0.0, 2.0), [2.0, 0.0]);
    assert_eq!(next_gap(&[], 0.0, 3.0), [3.0, 0.0]);
}

fn refusal(terrain: Terrain, variation: Variation) -> String {
    let blueprint = blueprint("tetrapod-2");
    let sensors = blueprint.creature().sensors.clone();
    let settings = PhysicsSettings::default();
    let built = CreatureEnvironment::<Puppet>::on_terrain(blueprint, &sensors, 3.0, settings, variation, terrain);
    built.err().expect("must be refused").to_string()
}

#[test]
fn terrains_that_cannot_be_are_refused() {
    let gaps = TERRAINS[1].terrain();
    let hard = gaps.clone().with_difficulty(1.5);
    assert_eq!(refusal(hard, Variation::default()), "terrain.difficulty = 1.5: must be from 0 to 1");
    // The toy engine knows flat ground alone.
    assert!(refusal(gaps, Variation::default()).contains("the ground is not flat"));
}
