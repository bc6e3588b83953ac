//! JSON schemas of the messages. Those called `foxglove.*` follow the schemas of that name (foxglove-sdk, `schemas/jsonschema`),
//! with the fields this log writes; viewers go by the name.

use serde_json::{Value, json};

fn object(title: &str, properties: Value) -> Value {
    let mut required: Vec<String> = properties
        .as_object()
        .into_iter()
        .flatten()
        .map(|(name, _)| name.clone())
        .collect();
    required.sort_unstable();
    json!({ "title": title, "type": "object", "properties": properties, "required": required })
}

fn list(items: Value) -> Value {
    json!({ "type": "array", "items": items })
}

fn number() -> Value {
    json!({ "type": "number" })
}

fn text() -> Value {
    json!({ "type": "string" })
}

fn time() -> Value {
    json!({
        "title": "time",
        "type": "object",
        "properties": {
            "sec": { "type": "integer", "minimum": 0 },
            "nsec": { "type": "integer", "minimum": 0, "maximum": 999_999_999 },
        },
    })
}

fn duration() -> Value {
    json!({
        "title": "duration",
        "type": "object",
        "properties": {
            "sec": { "type": "integer" },
            "nsec": { "type": "integer", "minimum": 0, "maximum": 999_999_999 },
        },
    })
}

fn vector() -> Value {
    object(
        "foxglove.Vector3",
        json!({ "x": number(), "y": number(), "z": number() }),
    )
}

fn point() -> Value {
    object(
        "foxglove.Point3",
        json!({ "x": number(), "y": number(), "z": number() }),
    )
}

fn quaternion() -> Value {
    object(
        "foxglove.Quaternion",
        json!({ "x": number(), "y": number(), "z": number(), "w": number() }),
    )
}

fn pose() -> Value {
    object(
        "foxglove.Pose",
        json!({ "position": vector(), "orientation": quaternion() }),
    )
}

fn colour() -> Value {
    object(
        "foxglove.Color",
        json!({ "r": number(), "g": number(), "b": number(), "a": number() }),
    )
}

/// `foxglove.FrameTransforms`.
pub(super) fn frame_transforms() -> Value {
    let transform = object(
        "foxglove.FrameTransform",
        json!({
            "timestamp": time(),
            "parent_frame_id": text(),
            "child_frame_id": text(),
            "translation": vector(),
            "rotation": quaternion(),
        }),
    );
    object(
        "foxglove.FrameTransforms",
        json!({ "transforms": list(transform) }),
    )
}

/// `foxglove.SceneUpdate`, with the primitives this log draws.
pub(super) fn scene_update() -> Value {
    let deletion = object(
        "foxglove.SceneEntityDeletion",
        json!({ "timestamp": time(), "type": { "enum": [0, 1] }, "id": text() }),
    );
    let cube = object(
        "foxglove.CubePrimitive",
        json!({ "pose": pose(), "size": vector(), "color": colour() }),
    );
    let sphere = object(
        "foxglove.SpherePrimitive",
        json!({ "pose": pose(), "size": vector(), "color": colour() }),
    );
    let cylinder = object(
        "foxglove.CylinderPrimitive",
        json!({
            "pose": pose(),
            "size": vector(),
            "bottom_scale": number(),
            "top_scale": number(),
            "color": colour(),
        }),
    );
    let line = object(
        "foxglove.LinePrimitive",
        json!({
            "type": { "enum": [0, 1, 2] },
            "pose": pose(),
            "thickness": number(),
            "scale_invariant": { "type": "boolean" },
            "points": list(point()),
            "color": colour(),
            "colors": list(colour()),
            "indices": list(json!({ "type": "integer", "minimum": 0 })),
        }),
    );
    let triangles = object(
        "foxglove.TriangleListPrimitive",
        json!({
            "pose": pose(),
            "points": list(point()),
            "color": colour(),
            "colors": list(colour()),
            "indices": list(json!({ "type": "integer", "minimum": 0 })),
        }),
    );
    let pair = object(
        "foxglove.KeyValuePair",
        json!({ "key": text(), "value": text() }),
    );
    let none = || list(json!({ "type": "object" }));
    let entity = object(
        "foxglove.SceneEntity",
        json!({
            "timestamp": time(),
            "frame_id": text(),
            "id": text(),
            "lifetime": duration(),
            "frame_locked": { "type": "boolean" },
            "metadata": list(pair),
            "arrows": none(),
            "cubes": list(cube),
            "spheres": list(sphere),
            "cylinders": list(cylinder),
            "lines": list(line),
            "triangles": list(triangles),
            "texts": none(),
            "models": none(),
        }),
    );
    object(
        "foxglove.SceneUpdate",
        json!({ "deletions": list(deletion), "entities": list(entity) }),
    )
}

/// `foxglove.JointStates`.
pub(super) fn joint_states() -> Value {
    let joint = json!({
        "title": "foxglove.JointState",
        "type": "object",
        "properties": {
            "name": text(),
            "position": { "type": "number", "description": "rad or m" },
            "velocity": { "type": "number", "description": "rad/s or m/s" },
            "effort": { "type": "number", "description": "N m or N" },
        },
        "required": ["name"],
    });
    object(
        "foxglove.JointStates",
        json!({ "timestamp": time(), "joints": list(joint) }),
    )
}

/// `foxglove.PoseInFrame`.
pub(super) fn pose_in_frame() -> Value {
    object(
        "foxglove.PoseInFrame",
        json!({ "timestamp": time(), "frame_id": text(), "pose": pose() }),
    )
}

/// `foxglove.Log`.
pub(super) fn log() -> Value {
    object(
        "foxglove.Log",
        json!({
            "timestamp": time(),
            "level": { "enum": [0, 1, 2, 3, 4, 5] },
            "message": text(),
            "name": text(),
            "file": text(),
            "line": { "type": "integer", "minimum": 0 },
        }),
    )
}

/// Flat numbers with what each is; one that is not finite is left out of its message.
pub(super) fn flat(title: &str, fields: &[(String, String)]) -> Value {
    let properties: serde_json::Map<String, Value> = fields
        .iter()
        .map(|(name, what)| {
            (
                name.clone(),
                json!({ "type": "number", "description": what }),
            )
        })
        .collect();
    json!({ "title": title, "type": "object", "properties": properties })
}
