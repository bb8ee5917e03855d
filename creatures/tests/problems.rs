//! Everything that can be wrong with a creature is told: where, what was found, what is expected.

mod common;

use common::small;
use creatures::{Blueprint, Creature, CreatureError, Problem};
use serde_json::{Value, json};

/// Picks a field of the small creature.
type Field = fn(&mut Value) -> &mut Value;

/// The error of the small creature after spoiling it.
fn error_of(spoil: impl FnOnce(&mut Value)) -> CreatureError {
    let mut file = small();
    spoil(&mut file);
    Blueprint::from_json(&file.to_string()).expect_err("it was spoilt")
}

/// The only problem of the small creature after spoiling it, and its message.
fn problem_of(spoil: impl FnOnce(&mut Value)) -> (Problem, String) {
    let error = error_of(spoil);
    let message = error.to_string();
    match error {
        CreatureError::Invalid(mut problems) if problems.len() == 1 => (problems.remove(0), message),
        other => panic!("expected one problem, found {other}"),
    }
}

macro_rules! problem {
    ($spoil:expr, $variant:pat, $message:expr) => {{
        let (problem, message) = problem_of($spoil);
        assert!(matches!(problem, $variant), "{problem:?}");
        assert_eq!(message, $message);
    }};
}

#[test]
fn the_unspoilt_creature_is_fine() {
    assert!(Blueprint::from_json(&small().to_string()).is_ok());
}

#[test]
fn names() {
    for name in ["", "../up", ".hidden", "-option", "a/b", "a\nb", &"x".repeat(65)] {
        let (problem, message) = problem_of(|file| file["name"] = json!(name));
        assert!(matches!(problem, Problem::BadCreatureName { .. }));
        assert!(message.starts_with("name: expected 1 to 64 letters"), "{message}");
    }
    problem!(
        |file| file["parts"][0]["tag"] = json!(" "),
        Problem::BadName { .. },
        "parts[0].tag: expected 1 to 64 characters without line breaks, found \" \""
    );
    let error = error_of(|file| file["parts"][2]["name"] = json!("left leg"));
    let message = "parts[2].name: `left leg` is already the name of parts[1]; each part needs a name of its own";
    assert!(error.to_string().contains(message), "{error}");
}

#[test]
fn numbers_out_of_range() {
    let cases: [(Field, Value, &str); 12] = [
        (|f| &mut f["parts"][1]["shape"]["box"]["width"], json!(0), "expected 0.005 to 50 m, found 0"),
        (|f| &mut f["parts"][1]["shape"]["box"]["height"], json!(-0.6), "expected 0.005 to 50 m, found -0.6"),
        (|f| &mut f["parts"][1]["shape"]["box"]["width"], json!(300), "expected 0.005 to 50 m, found 300"),
        (|f| &mut f["parts"][0]["density"], json!(0), "expected 0.1 to 10000 kg/m², found 0"),
        (|f| &mut f["parts"][0]["density"], json!(-3), "expected 0.1 to 10000 kg/m², found -3"),
        (
            |f| &mut f["parts"][0]["density"],
            json!(1e30),
            "expected 0.1 to 10000 kg/m², found 1000000000000000000000000000000",
        ),
        (|f| &mut f["parts"][0]["friction"], json!(11), "expected 0 to 10, found 11"),
        (|f| &mut f["parts"][0]["angle"], json!(400), "expected -360 to 360 °, found 400"),
        (|f| &mut f["joints"][0]["motor"]["top_speed"], json!(0), "expected 0.01 to 100 rad/s, found 0"),
        (|f| &mut f["joints"][0]["motor"]["top_torque"], json!(-1), "expected 0.01 to 100000 N·m, found -1"),
        (|f| &mut f["joints"][0]["anchor"][1], json!(-101), "expected -100 to 100 m, found -101"),
        (|f| &mut f["joints"][0]["limits"][1], json!(500), "expected -360 to 360 °, found 500"),
    ];
    for (field, value, expected) in cases {
        let (problem, message) = problem_of(|file| *field(file) = value);
        assert!(matches!(problem, Problem::OutOfRange { .. } | Problem::NotFinite { .. }), "{problem:?}");
        assert!(message.ends_with(expected), "{message}");
    }
    problem!(
        |f| f["parts"][1]["shape"]["box"]["width"] = json!(0),
        Problem::OutOfRange { .. },
        "parts[1].shape.box.width: expected 0.005 to 50 m, found 0"
    );
}

#[test]
fn numbers_too_large_for_single_precision() {
    let error = error_of(|f| f["parts"][0]["density"] = json!(1e300));
    assert!(matches!(&error, CreatureError::Field { path, .. } if path == "parts[0].density"), "{error:?}");
    let message = "expected a number that fits single precision (at most 3.4e38), found a larger one";
    assert!(error.to_string().ends_with(message), "{error}");
}

#[test]
fn other_shapes_are_checked_too() {
    for (shape, path) in [
        (json!({ "circle": { "radius": -1 } }), "circle.radius"),
        (json!({ "capsule": { "length": 0, "radius": 0.3 } }), "capsule.length"),
        (json!({ "capsule": { "length": 0.3, "radius": 99 } }), "capsule.radius"),
    ] {
        let (_, message) = problem_of(|f| f["parts"][0]["shape"] = shape);
        assert!(message.starts_with(&format!("parts[0].shape.{path}: expected 0.005 to 50 m")), "{message}");
    }
}

#[test]
fn not_a_number_is_caught_without_a_file() {
    let mut creature = Creature::from_json(&small().to_string()).expect("valid");
    creature.parts[1].position[0] = f32::NAN;
    let error = Blueprint::new(creature).expect_err("NaN");
    assert_eq!(error.to_string(), "parts[1].position[0]: expected a finite number, found NaN");
}

#[test]
fn parts_in_number() {
    let error = error_of(|f| (f["parts"], f["joints"]) = (json!([]), json!([])));
    assert_eq!(error, CreatureError::Invalid(vec![Problem::NoTorso]));
    assert_eq!(error.to_string(), "parts: a creature needs parts; the first one is its torso");
    problem!(
        |f| f["parts"] = Value::Array(vec![f["parts"][0].clone(); 257]),
        Problem::TooManyParts { count: 257 },
        "parts: at most 256 parts, found 257"
    );
}

#[test]
fn missing_parts_name_the_nearest() {
    problem!(
        |f| f["joints"][1]["child"] = json!("rigth leg"),
        Problem::MissingPart { .. },
        "joints[1].child: there is no part `rigth leg`; did you mean `right leg`?"
    );
    problem!(
        |f| f["joints"][1]["parent"] = json!("xyz"),
        Problem::MissingPart { .. },
        "joints[1].parent: there is no part `xyz`"
    );
}

#[test]
fn the_torso_hangs_on_nothing() {
    let error = error_of(|f| {
        let mut joint = f["joints"][0].clone();
        (joint["parent"], joint["child"]) = (json!("left leg"), json!("torso"));
        if let Some(joints) = f["joints"].as_array_mut() {
            joints.push(joint);
        }
    });
    let message = "joints[2].child: the torso `torso` (the first part) must not hang on another part, but here it hangs \
                   on `left leg`";
    assert!(error.to_string().contains(message), "{error}");
}

#[test]
fn parents_stand_earlier() {
    problem!(
        |f| f["joints"][0]["parent"] = json!("right leg"),
        Problem::LaterParent { .. },
        "joints[0]: the parent `right leg` must stand earlier in `parts` than its child `left leg`; change their order"
    );
}

#[test]
fn circles() {
    problem!(
        |f| f["joints"][1]["parent"] = json!("right leg"),
        Problem::Cycle { .. },
        "joints[1]: parts must not hang on each other in a circle: right leg hangs on right leg"
    );
    problem!(
        |f| {
            f["joints"][0]["parent"] = json!("right leg");
            f["joints"][1]["parent"] = json!("left leg");
        },
        Problem::Cycle { .. },
        "joints[0]: parts must not hang on each other in a circle: left leg hangs on right leg hangs on left leg"
    );
    let error = error_of(|f| (f["joints"][0]["parent"], f["joints"][0]["child"]) = (json!("torso"), json!("torso")));
    assert!(error.to_string().contains("circle: torso hangs on torso"), "{error}");
}

#[test]
fn each_part_hangs_on_one_joint() {
    problem!(
        |f| drop(f["joints"].as_array_mut().map(|joints| joints.pop())),
        Problem::NoJoint { .. },
        "parts[2]: `right leg` hangs on no part; every part but the torso must be the child of one joint"
    );
    let error = error_of(|f| f["joints"][1]["child"] = json!("left leg"));
    let CreatureError::Invalid(problems) = &error else { panic!("{error:?}") };
    assert!(matches!(problems[0], Problem::TwoJoints { first: 0, .. }), "{error}");
    let message = "joints[1].child: `left leg` is already the child of joints[0]; a part hangs on one joint only";
    assert!(error.to_string().contains(message), "{error}");
}

#[test]
fn limits() {
    problem!(
        |f| f["joints"][0]["limits"] = json!([50, -50]),
        Problem::LimitsReversed { .. },
        "joints[0].limits: expected the smaller limit first, found [50, -50]"
    );
    problem!(
        |f| f["joints"][0]["limits"] = json!([10, 50]),
        Problem::LimitsWithoutStart { .. },
        "joints[0].limits: limits are relative to the start pose, so 0 must lie between them, found [10, 50]"
    );
    problem!(
        |f| f["joints"][0]["limits"] = json!([-200, 200]),
        Problem::LimitsTooWide { .. },
        "joints[0].limits: limits must lie between -180 and 180 and be at most 340 degrees apart, found [-200, 200]"
    );
    problem!(
        |f| f["joints"][0]["limits"] = json!([0, 0]),
        Problem::LimitsLocked { .. },
        "joints[0].limits: a joint with a motor needs room to turn, at least 1 degree, found [0, 0]"
    );
}

#[test]
fn anchors_are_near_both_parts() {
    problem!(
        |f| f["joints"][0]["anchor"] = json!([0, -0.6]),
        Problem::AnchorFar { .. },
        "joints[0].anchor: the anchor lies 1.15 m outside `torso`, at most 1 m is allowed; anchors are in world \
         coordinates of the start pose"
    );
}

#[test]
fn something_must_move() {
    let message = "joints: nothing can move: at least one joint whose child has an actuated tag (leg) needs a `motor`; \
                   tags of the parts: leg";
    let no_motors = |f: &mut Value| {
        for joint in 0..2 {
            f["joints"][joint]["motor"] = Value::Null;
        }
    };
    problem!(no_motors, Problem::NoMotors { .. }, message);
    let (problem, message) = problem_of(|f| f["actuated_tags"] = json!(["arm"]));
    assert!(matches!(problem, Problem::NoMotors { .. }));
    assert!(message.contains("(arm)"), "{message}");
}

#[test]
fn colours_and_decorations() {
    let line =
        |points: Value| json!({ "decorations": [{ "form": { "line": { "points": points } }, "stroke": "#000000" }] });
    problem!(
        |f| f["parts"][0]["look"] = json!({ "colour": "red" }),
        Problem::BadColour { .. },
        "parts[0].look.colour: expected a colour as \"#rrggbb\" (hexadecimal red, green, blue), found \"red\""
    );
    problem!(
        |f| f["parts"][0]["look"] = line(json!([[0, 0]])),
        Problem::Count { .. },
        "parts[0].look.decorations[0].form.line.points: expected 2 to 256 points, found 1"
    );
    problem!(
        |f| f["parts"][0]["look"] = line(json!([[0, 0], [0, 900]])),
        Problem::OutOfRange { .. },
        "parts[0].look.decorations[0].form.line.points[1][1]: expected -50 to 50 m, found 900"
    );
    problem!(
        |f| f["parts"][0]["look"] = json!({ "opacity": 2 }),
        Problem::OutOfRange { .. },
        "parts[0].look.opacity: expected 0 to 1, found 2"
    );
    let (_, message) = problem_of(|f| {
        let form = json!({ "ellipse": { "centre": [0, 0], "radii": [1, 0] } });
        f["parts"][0]["look"] = json!({ "decorations": [{ "form": form, "fill": "#000000" }] });
    });
    assert!(message.contains("form.ellipse.radii[1]: expected 0.0001 to 50 m, found 0"), "{message}");
}

#[test]
fn sensors() {
    problem!(|f| f["sensors"] = json!([]), Problem::Count { .. }, "sensors: expected 1 to 64 sensors, found 0");
    problem!(
        |f| f["sensors"] = json!(["torso-height", "torso-height"]),
        Problem::DuplicateSensor { .. },
        "sensors[1]: `torso-height` is already sensors[0]; list each sensor once"
    );
    problem!(
        |f| f["sensors"] = json!([{ "clock": { "period": 0 } }]),
        Problem::OutOfRange { .. },
        "sensors[0].clock.period: expected 0.02 to 100 s, found 0"
    );
    problem!(
        |f| f["sensors"] = json!([{ "rangefinder": { "angles": [0, 200], "length": 3 } }]),
        Problem::OutOfRange { .. },
        "sensors[0].rangefinder.angles[1]: expected -180 to 180 °, found 200"
    );
    problem!(
        |f| f["sensors"] = json!([{ "rangefinder": { "angles": [], "length": 3 } }]),
        Problem::Count { .. },
        "sensors[0].rangefinder.angles: expected 1 to 64 angles, found 0"
    );
    problem!(
        |f| {
            // A shoe without a tag of its own kind: nothing actuated is a last segment any more.
            f["parts"][2]["tag"] = json!("shoe");
            f["joints"][1]["parent"] = json!("left leg");
            f["sensors"] = json!(["foot-contacts"]);
        },
        Problem::NoFeet { .. },
        "sensors[0]: `foot-contacts` needs feet: a part with an actuated tag on which no other part hangs, in a chain \
         whose parts do not say \"leg\": false"
    );
    problem!(
        |f| {
            f["parts"][2]["tag"] = json!("shoe");
            f["joints"][1]["parent"] = json!("left leg");
            f["sensors"] = json!(["foot-slip"]);
        },
        Problem::NoFeet { .. },
        "sensors[0]: `foot-slip` needs feet: a part with an actuated tag on which no other part hangs, in a chain \
         whose parts do not say \"leg\": false"
    );
    problem!(
        |f| f["sensors"] = json!([{ "next-gap": { "length": 0 } }]),
        Problem::OutOfRange { .. },
        "sensors[0].next-gap.length: expected 0.01 to 100 m, found 0"
    );
}

#[test]
fn all_problems_are_told_at_once() {
    let error = error_of(|f| {
        f["parts"][0]["density"] = json!(0);
        f["parts"][1]["shape"]["box"]["width"] = json!(-1);
        f["joints"][0]["limits"] = json!([1, -1]);
        f["joints"][1]["parent"] = json!("torzo");
        f["parts"][2]["look"] = json!({ "colour": "#12" });
    });
    let CreatureError::Invalid(problems) = &error else { panic!("{error:?}") };
    assert_eq!(problems.len(), 5);
    assert_eq!(error.to_string().lines().count(), 5);
}
