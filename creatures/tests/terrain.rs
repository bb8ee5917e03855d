//! Terrains: their files, their errors, and their sizes for a body.

use creatures::{Blueprint, BodySizes, Direction, DrawnObstacle, ObstacleKind, Obstacles, TERRAINS, Terrain};
use proptest::prelude::*;

fn sizes(name: &str) -> BodySizes {
    BodySizes::of(&Blueprint::new(creatures::find(name).expect("shipped")).expect("valid"))
}

fn any_size(most: f32) -> impl Strategy<Value = Option<f32>> {
    prop::option::of(0.1..most)
}

fn any_obstacles() -> impl Strategy<Value = Obstacles> {
    let direction = || prop::sample::select(vec![Direction::Up, Direction::Down, Direction::UpAndDown]);
    let spacing = || any_size(100.0);
    prop_oneof![
        (any_size(20.0), spacing()).prop_map(|(width, spacing)| Obstacles::Gaps { width, spacing }),
        (any_size(5.0), spacing()).prop_map(|(height, spacing)| Obstacles::Hurdles { height, spacing }),
        (any_size(2.0), any_size(10.0), direction(), spacing())
            .prop_map(|(rise, tread, direction, spacing)| Obstacles::Stairs { rise, tread, direction, spacing }),
        (any_size(60.0), direction(), spacing()).prop_map(|(degrees, direction, spacing)| Obstacles::Slopes {
            degrees,
            direction,
            spacing
        }),
        (any_size(2.0), spacing()).prop_map(|(height, spacing)| Obstacles::Rough { height, spacing }),
    ]
}

fn any_drawn() -> impl Strategy<Value = Vec<DrawnObstacle>> {
    let one = (0..3, 0.0..2.0_f32, 0.3..2.0_f32, -0.9..0.9_f32);
    prop::collection::vec(one, 0..6).prop_map(|all| {
        let mut end = 0.0;
        let place = |(kind, before, width, size): (i32, f32, f32, f32)| {
            let from = end + before;
            end = from + width;
            match kind {
                0 => DrawnObstacle::Box { from, width, height: 1.0 + size },
                1 => DrawnObstacle::Gap { from, width },
                _ => DrawnObstacle::Slope { from, width, rise: width * size },
            }
        };
        all.into_iter().map(place).collect()
    })
}

fn any_terrain() -> impl Strategy<Value = Terrain> {
    let drawn = any_drawn().prop_map(|drawn| Terrain { drawn, ..Terrain::default() });
    prop_oneof![of_obstacles(), drawn]
}

fn of_obstacles() -> impl Strategy<Value = Terrain> {
    let run_up = prop::option::of(0.0..100.0_f32);
    let obstacles = prop::collection::vec(any_obstacles(), 0..6);
    (obstacles, 0.0..=1.0_f32, any::<u64>(), 1.0..1000.0_f32, run_up, 0.0..0.9_f32).prop_map(
        |(obstacles, difficulty, seed, length, run_up, jitter)| Terrain {
            obstacles,
            difficulty,
            seed,
            length,
            run_up,
            jitter,
            drawn: Vec::new(),
        },
    )
}

proptest! {
    #[test]
    fn what_is_written_is_read_again(terrain in any_terrain()) {
        prop_assert_eq!(terrain.validate(), Ok(()));
        let json = serde_json::to_string(&terrain).expect("plain data");
        prop_assert_eq!(serde_json::from_str::<Terrain>(&json).expect("its own file"), terrain);
    }

    /// The harder, the larger; nothing at 0.
    #[test]
    fn sizes_grow_with_the_difficulty(easy in 0.0..0.5_f32, harder in 0.5..1.0_f32) {
        let body = sizes("tetrapod-2");
        for entry in &TERRAINS[1..] {
            for obstacles in entry.terrain().obstacles {
                let main = |difficulty| obstacles.sizes(difficulty, &body).main;
                prop_assert!(main(0.0) == 0.0 && main(easy) < main(harder), "{:?}", obstacles);
            }
        }
    }
}

#[test]
fn files_may_say_little() {
    let terrain: Terrain = serde_json::from_str(r#"{"obstacles": [{"gaps": {"width": 0.4}}]}"#).expect("valid");
    let gaps = Obstacles::Gaps { width: Some(0.4), spacing: None };
    assert_eq!(terrain, Terrain { obstacles: vec![gaps], ..Terrain::default() });
    assert_eq!(serde_json::from_str::<Terrain>("{}").expect("valid"), Terrain::default());
    let stairs = r#"{"obstacles": [{"stairs": {"rise": 0.1, "direction": "up"}}], "difficulty": 0.2}"#;
    let terrain: Terrain = serde_json::from_str(stairs).expect("valid");
    assert!(matches!(terrain.obstacles[..], [Obstacles::Stairs { direction: Direction::Up, .. }]));
}

#[test]
fn every_slip_in_a_file_is_named() {
    for (json, says) in [
        (r#"{"obstacles": [{"gasp": {}}]}"#, "unknown variant `gasp`"),
        (r#"{"obstacles": [{"gaps": {"with": 1}}]}"#, "unknown field `with`"),
        (r#"{"obstacles": [{"stairs": {"direction": "sideways"}}]}"#, "unknown variant `sideways`"),
        (r#"{"difficulties": 1}"#, "unknown field `difficulties`"),
    ] {
        let error = serde_json::from_str::<Terrain>(json).expect_err("not valid").to_string();
        assert!(error.contains(says), "{error}");
    }
}

#[test]
fn every_range_is_checked() {
    let gaps = |width, spacing| Terrain::of(vec![Obstacles::Gaps { width, spacing }]);
    let stairs = |rise, tread| {
        let direction = Direction::Up;
        Terrain::of(vec![Obstacles::Stairs { rise, tread, direction, spacing: None }])
    };
    let slopes = Obstacles::Slopes { degrees: Some(61.0), direction: Direction::Up, spacing: None };
    let flat = Terrain::default;
    let rows = [
        (gaps(Some(21.0), None), "obstacles[0].gaps.width = 21: must be from 0 to 20 m"),
        (gaps(None, Some(0.0)), "obstacles[0].gaps.spacing = 0: must be from 0.1 to 100 m"),
        (
            Terrain::of(vec![Obstacles::Hurdles { height: Some(-1.0), spacing: None }]),
            "obstacles[0].hurdles.height = -1: must be from 0 to 5 m",
        ),
        (stairs(Some(f32::NAN), None), "obstacles[0].stairs.rise = NaN: must be from 0 to 2 m"),
        (stairs(None, Some(0.01)), "obstacles[0].stairs.tread = 0.01: must be from 0.05 to 10 m"),
        (Terrain::of(vec![slopes]), "obstacles[0].slopes.degrees = 61: must be from 0 to 60 °"),
        (
            Terrain::of(vec![Obstacles::Rough { height: Some(3.0), spacing: None }]),
            "obstacles[0].rough.height = 3: must be from 0 to 2 m",
        ),
        (flat().with_difficulty(1.5), "difficulty = 1.5: must be from 0 to 1"),
        (Terrain { length: 0.0, ..flat() }, "length = 0: must be from 1 to 1000 m"),
        (Terrain { run_up: Some(-1.0), ..flat() }, "run_up = -1: must be from 0 to 100 m"),
        (Terrain { jitter: 1.0, ..flat() }, "jitter = 1: must be from 0 to 0.9"),
        (Terrain::of(vec![slopes; 17]), "obstacles = 17 kinds: must be at most 16 kinds"),
    ];
    for (terrain, says) in rows {
        assert_eq!(terrain.validate().expect_err(says).to_string(), says);
    }
}

#[test]
fn every_slip_of_drawn_obstacles_is_named() {
    let drawn = |json: &str| -> Vec<String> {
        let terrain: Terrain = serde_json::from_str(&format!(r#"{{"drawn": [{json}]}}"#)).expect("it can be read");
        terrain.drawn_problems().iter().map(ToString::to_string).collect()
    };
    let fine = r#"{"box": {"from": 2, "width": 1, "height": 0.1}}, {"gap": {"from": 3, "width": 0.5}},
        {"slope": {"from": 4, "width": 1, "rise": -1.7}}"#;
    assert_eq!(drawn(fine), [""; 0]);
    let rows = [
        (r#"{"box": {"from": -1, "width": 1, "height": 1}}"#, "drawn[0].box.from = -1: must be from 0 to 1000 m"),
        (
            r#"{"box": {"from": 1, "width": 0.01, "height": 1}}"#,
            "drawn[0].box.width = 0.01: must be from 0.05 to 100 m",
        ),
        (r#"{"box": {"from": 1, "width": 1, "height": 6}}"#, "drawn[0].box.height = 6: must be from 0.01 to 5 m"),
        (r#"{"gap": {"from": 1, "width": 21}}"#, "drawn[0].gap.width = 21: must be from 0.01 to 20 m"),
        (r#"{"slope": {"from": 1, "width": 50, "rise": 21}}"#, "drawn[0].slope.rise = 21: must be from -20 to 20 m"),
        (
            r#"{"slope": {"from": 1, "width": 1, "rise": 2}}"#,
            "drawn[0].slope.rise = 2: must be at most 1.73 m up or down: 60 ° is the steepest",
        ),
        (
            r#"{"gap": {"from": 1, "width": 2}}, {"gap": {"from": 2.5, "width": 1}}"#,
            "drawn[1].gap.from = 2.5: must be at least 3, where drawn[0] ends",
        ),
    ];
    for (json, says) in rows {
        assert!(drawn(json).iter().any(|problem| problem == says), "{says}: {:?}", drawn(json));
    }
    let gap = |index| DrawnObstacle::Gap { from: index as f32, width: 0.5 };
    let many = Terrain { drawn: (0..201).map(gap).collect(), ..Terrain::default() };
    let error = many.validate().expect_err("too many").to_string();
    assert_eq!(error, "drawn = 201 obstacles: must be at most 200 obstacles");
    let both = Terrain { drawn: vec![gap(1)], ..TERRAINS[1].terrain() };
    let error = both.validate().expect_err("one or the other").to_string();
    assert_eq!(error, "drawn = 1 obstacles: must be empty where there are `obstacles`");
}

#[test]
fn what_is_drawn_is_written_only_if_there_is_any() {
    let json = serde_json::to_string(&Terrain::default()).expect("JSON");
    assert!(!json.contains("drawn"), "{json}");
    let gap = DrawnObstacle::Gap { from: 2.0, width: 0.5 };
    let terrain = Terrain { drawn: vec![gap], ..Terrain::default() };
    assert!(!terrain.is_flat() && !terrain.has_chance());
    let json = serde_json::to_string(&terrain).expect("JSON");
    assert!(json.ends_with(r#""drawn":[{"gap":{"from":2.0,"width":0.5}}]}"#), "{json}");
    assert_eq!(serde_json::from_str::<Terrain>(&json).expect("valid"), terrain);
}

#[test]
fn terrains_with_names_are_valid() {
    for entry in TERRAINS {
        assert_eq!(entry.terrain().validate(), Ok(()), "{}", entry.name);
    }
    let mixture = TERRAINS.iter().find(|entry| entry.name == "mixture").expect("there is one").terrain();
    let kinds: Vec<_> = mixture.obstacles.iter().map(|obstacles| obstacles.kind().name()).collect();
    assert_eq!(kinds, ["gaps", "hurdles", "stairs", "slopes", "rough"]);
}

#[test]
fn sizes_are_those_of_the_body_unless_they_are_given() {
    let body = BodySizes { body_length: 2.0, leg_length: 0.8, front: 1.0, back: -1.0 };
    let at_half = |obstacles: Obstacles| {
        let sizes = obstacles.sizes(0.5, &body);
        (sizes.main, sizes.spacing)
    };
    let direction = Direction::UpAndDown;
    assert_eq!(at_half(Obstacles::Gaps { width: None, spacing: None }), (1.0, 6.0));
    assert_eq!(at_half(Obstacles::Gaps { width: Some(0.3), spacing: Some(2.0) }), (0.3, 2.0));
    assert_eq!(at_half(Obstacles::Hurdles { height: None, spacing: None }), (0.2, 6.0));
    // A quarter of the leg.
    assert_eq!(at_half(Obstacles::Stairs { rise: None, tread: None, direction, spacing: None }), (0.2, 6.0));
    assert_eq!(at_half(Obstacles::Slopes { degrees: None, direction, spacing: None }), (15.0, 6.0));
    let (height, _) = at_half(Obstacles::Rough { height: None, spacing: None });
    assert!((height - 0.12).abs() < 1e-6, "{height}");
    assert_eq!(Obstacles::Gaps { width: None, spacing: None }.kind(), ObstacleKind::Gaps);
    assert_eq!(Terrain::default().run_up_of(&body), 4.0);
}

#[test]
fn legs_are_as_long_as_from_the_hip_to_the_ground() {
    for file in creatures::shipped() {
        let blueprint = Blueprint::from_json(file.json).expect("valid");
        let (leg, start) = (blueprint.leg_length(), blueprint.start_height());
        match blueprint.is_legless() {
            true => assert_eq!(leg, start, "{}", file.name),
            false => assert!(leg > 0.3 * start && leg <= 1.01 * start, "{}: {leg} of {start} m", file.name),
        }
    }
}
