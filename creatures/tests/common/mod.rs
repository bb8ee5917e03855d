//! A small valid creature that tests spoil in one place each.

use serde_json::{Value, json};

/// A torso on two one-segment legs, as JSON.
pub(crate) fn small() -> Value {
    let part = |name: &str, tag: &str, width: f32, height: f32, y: f32| {
        json!({ "name": name, "tag": tag, "shape": { "box": { "width": width, "height": height } }, "density": 30,
                "position": [0, y] })
    };
    let joint = |child: &str| {
        json!({ "parent": "torso", "child": child, "anchor": [0, 0.55], "limits": [-50, 60],
                "motor": { "top_speed": 10, "top_torque": 80 } })
    };
    json!({
        "format": "gambol creature", "version": 1, "name": "small",
        "parts": [part("torso", "torso", 0.3, 0.5, 0.8), part("left leg", "leg", 0.1, 0.6, 0.3),
                  part("right leg", "leg", 0.1, 0.6, 0.3)],
        "joints": [joint("left leg"), joint("right leg")]
    })
}
