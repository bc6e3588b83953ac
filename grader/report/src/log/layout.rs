//! A layout for Foxglove and Lichtblick: the moving arm, the plots a student asks for first, and the log.

use kinemark_sim::control::Mode;
use serde_json::{Map, Value, json};

use super::names::{WORLD, fields};
use kinemark_grader::record::graded::TaskRun;

/// The layout of a run's log as a JSON file, to be imported beside it; viewers read none from inside a log.
pub fn layout(run: &TaskRun) -> String {
    let joints = fields(run.robot.moving_joints().map(|joint| joint.name.as_str()));
    let of = |signals: &[&str]| -> Vec<String> {
        let field = |joint: &String| {
            signals
                .iter()
                .map(|signal| format!("/signals.{signal}_{joint}"))
                .collect::<Vec<_>>()
        };
        joints.iter().flat_map(field).collect()
    };
    let commanded = match run.mode {
        Mode::Position => ["q", "command"],
        Mode::Velocity => ["qd", "command"],
        Mode::Effort | Mode::Prescribed => ["q", "qd"],
    };
    let efforts: &[&str] = match run.mode {
        Mode::Prescribed => &["effort", "command"],
        Mode::Position | Mode::Velocity | Mode::Effort => &["effort"],
    };
    let error = ["distance_m", "full_m", "zero_m"].map(|field| format!("/errors.{field}"));
    let mut panels = Map::new();
    panels.insert("3D!arm".to_owned(), view());
    panels.insert("Plot!joints".to_owned(), plot("Joints", &of(&commanded)));
    panels.insert("Plot!effort".to_owned(), plot("Effort", &of(efforts)));
    panels.insert(
        "Plot!error".to_owned(),
        plot("Distance to the goal [m]", &error),
    );
    let log = json!({ "searchTerms": [], "minLogLevel": 1, "topicToRender": "/log" });
    panels.insert("RosOut!log".to_owned(), log);
    let mut layout = json!({
        "configById": panels,
        "globalVariables": {},
        "userNodes": {},
        "playbackConfig": { "speed": 1 },
        "layout": {
            "direction": "row",
            "splitPercentage": 55,
            "first": { "direction": "column", "splitPercentage": 75, "first": "3D!arm", "second": "RosOut!log" },
            "second": {
                "direction": "column",
                "splitPercentage": 34,
                "first": "Plot!joints",
                "second": { "direction": "column", "splitPercentage": 50, "first": "Plot!effort", "second": "Plot!error" },
            },
        },
    });
    // whether a JSON map is sorted depends on how its crate was built; the bytes must not
    layout.sort_all_objects();
    format!("{layout:#}\n")
}

fn plot(title: &str, paths: &[String]) -> Value {
    let path = |value: &String| json!({ "value": value, "enabled": true, "timestampMethod": "receiveTime" });
    json!({
        "title": title,
        "foxglovePanelTitle": title,
        "paths": paths.iter().map(path).collect::<Vec<_>>(),
        "showXAxisLabels": true,
        "showYAxisLabels": true,
        "showLegend": true,
        "legendDisplay": "floating",
        "showPlotValuesInLegend": true,
        "isSynced": true,
        "xAxisVal": "timestamp",
        "sidebarDimension": 240,
    })
}

fn view() -> Value {
    let seen = json!({ "visible": true });
    json!({
        "cameraState": {
            "perspective": true,
            "distance": 7,
            "phi": 75,
            "thetaOffset": 20,
            "targetOffset": [0, 0, 2],
            "target": [0, 0, 0],
            "targetOrientation": [0, 0, 0, 1],
            "fovy": 45,
            "near": 0.05,
            "far": 500,
        },
        "followMode": "follow-none",
        "followTf": WORLD,
        "scene": {},
        "transforms": {},
        "topics": { "/scene": seen, "/reference/scene": seen, "/tcp": seen },
        "layers": {
            "grid": {
                "visible": true,
                "frameLocked": true,
                "label": "Ground",
                "instanceId": "grid",
                "layerId": "foxglove.Grid",
                "frameId": WORLD,
                "size": 10,
                "divisions": 10,
                "lineWidth": 1,
                "color": "#8090a0ff",
                "position": [0, 0, 0],
                "rotation": [0, 0, 0],
                "order": 1,
            },
        },
        "publish": {},
        "imageMode": {},
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use kinemark_grader::record::sample;

    #[test]
    fn every_panel_is_placed_once() {
        let layout: Value = serde_json::from_str(&layout(&sample::task_run())).unwrap();
        let mut placed = Vec::new();
        let mut open = vec![&layout["layout"]];
        while let Some(node) = open.pop() {
            match node.as_str() {
                Some(panel) => placed.push(panel),
                None => open.extend([&node["first"], &node["second"]]),
            }
        }
        placed.sort_unstable();
        let configured: Vec<&str> = layout["configById"]
            .as_object()
            .unwrap()
            .keys()
            .map(String::as_str)
            .collect();
        assert_eq!(placed, configured);
    }
}
