use envs_core::{Ground, GroundShape};

fn with_box(x: f32, y: f32, width: f32, height: f32) -> Ground {
    Ground { shapes: vec![GroundShape::HalfSpace, GroundShape::Box { x, y, width, height }] }
}

fn with_circle(x: f32, y: f32, radius: f32) -> Ground {
    Ground { shapes: vec![GroundShape::Circle { x, y, radius }] }
}

#[test]
fn ground_is_flat_unless_told_otherwise() {
    assert_eq!(Ground::default(), Ground { shapes: vec![GroundShape::HalfSpace] });
    assert_eq!(Ground::default().validate(), Ok(()));
    assert_eq!(with_box(-3.0, 0.0, 1.0, 0.2).validate(), Ok(()));
    assert_eq!(with_circle(-3.0, -1.0, 1.02).validate(), Ok(()));
}

#[test]
fn wrong_ground_names_shape_and_field() {
    let refusals = [
        (Ground { shapes: vec![] }, "shapes = []: must be at least one shape"),
        (with_box(f32::NAN, 0.0, 1.0, 1.0), "shapes[1].x = NaN: must be finite"),
        (with_box(0.0, f32::INFINITY, 1.0, 1.0), "shapes[1].y = inf: must be finite"),
        (with_box(0.0, 0.0, 0.0, 1.0), "shapes[1].width = 0: must be finite and above 0"),
        (with_box(0.0, 0.0, 1.0, f32::INFINITY), "shapes[1].height = inf: must be finite and above 0"),
        (with_circle(f32::NAN, 0.0, 1.0), "shapes[0].x = NaN: must be finite"),
        (with_circle(0.0, f32::INFINITY, 1.0), "shapes[0].y = inf: must be finite"),
        (with_circle(0.0, 0.0, -1.0), "shapes[0].radius = -1: must be finite and above 0"),
    ];
    for (ground, refusal) in refusals {
        assert_eq!(ground.validate().expect_err("must be refused").to_string(), refusal);
    }
}

#[test]
fn ground_is_written_as_it_is_read() {
    let ground = with_box(3.0, 0.5, 2.0, 1.0);
    let text = r#"{"shapes":["half_space",{"box":{"x":3.0,"y":0.5,"width":2.0,"height":1.0}}]}"#;
    assert_eq!(serde_json::to_string(&ground).expect("plain data"), text);
    assert_eq!(serde_json::from_str::<Ground>(text).expect("valid"), ground);
    let text = r#"{"shapes":[{"circle":{"x":3.0,"y":-1.0,"radius":1.5}}]}"#;
    assert_eq!(serde_json::to_string(&with_circle(3.0, -1.0, 1.5)).expect("plain data"), text);
    assert_eq!(serde_json::from_str::<Ground>(text).expect("valid"), with_circle(3.0, -1.0, 1.5));
}
