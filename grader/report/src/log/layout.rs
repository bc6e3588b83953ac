//! A layout for Foxglove and Lichtblick: the moving arm, what was judged, the plots a student asks for first, and the log.

use kinemark_sim::control::Mode;
use kinemark_sim::kinematics::FramePoses;
use nalgebra::Vector3;
use serde_json::{Map, Value, json};

use super::names::{WORLD, fields};
use crate::visible::visible;
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
    let mut panels = Map::new();
    panels.insert("3D!arm".to_owned(), view(&Extent::of(run)));
    panels.insert("Plot!joints".to_owned(), plot("Joints", &of(&commanded)));
    panels.insert("Plot!effort".to_owned(), plot("Effort", &of(efforts)));
    let judged = judged(run);
    let tabs = judged.iter().enumerate().map(|(i, (title, paths))| {
        let panel = format!("Plot!judged{}", i + 1);
        panels.insert(panel.clone(), plot(title, paths));
        json!({ "title": title, "layout": panel })
    });
    let tabs: Vec<Value> = tabs.collect();
    let has_tabs = !tabs.is_empty();
    if has_tabs {
        let tabs = json!({ "activeTabIdx": 0, "tabs": tabs });
        panels.insert("Tab!judged".to_owned(), tabs);
    }
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
                "first": "Tab!judged",
                "second": { "direction": "column", "splitPercentage": 50, "first": "Plot!joints", "second": "Plot!effort" },
            },
        },
    });
    if !has_tabs {
        layout["layout"]["second"] = layout["layout"]["second"]["second"].take();
    }
    // whether a JSON map is sorted depends on how its crate was built; the bytes must not
    layout.sort_all_objects();
    format!("{layout:#}\n")
}

/// What was judged over time, each under a title with its paths: the checks, and the distance to the goals.
fn judged(run: &TaskRun) -> Vec<(String, Vec<String>)> {
    let names = fields(run.curves.iter().map(|curve| curve.check.as_str()));
    let of_check = |(curve, name): (&kinemark_grader::record::graded::Curve, &String)| {
        let bands = [("full", curve.full), ("zero", curve.zero)];
        let bands = bands.into_iter().filter(|(_, bound)| bound.is_some());
        let fields = std::iter::once("value").chain(bands.map(|(field, _)| field));
        let paths = fields.map(|field| format!("/checks/{name}.{field}"));
        let title = format!("{} [{}]", curve.title, curve.unit);
        (visible(&title).into_owned(), paths.collect())
    };
    let mut judged: Vec<_> = run.curves.iter().zip(&names).map(of_check).collect();
    if !run.goals.is_empty() {
        let fields = ["distance_m", "full_m", "zero_m"];
        let paths = fields.map(|field| format!("/errors.{field}"));
        judged.push(("distance to the goal [m]".to_owned(), paths.to_vec()));
    }
    judged
}

/// Where a run takes place, in the world.
struct Extent {
    centre: [f64; 3],
    /// Half of its diagonal \[m\].
    radius_m: f64,
}

impl Extent {
    /// Of all frames of the robot, and of the scene's bodies, over the run.
    fn of(run: &TaskRun) -> Self {
        let infinite = Vector3::repeat(f64::INFINITY);
        let (mut least, mut most) = (infinite, -infinite);
        let mut add = |at: &Vector3<f64>| {
            if at.iter().all(|x| x.is_finite()) {
                least = least.inf(at);
                most = most.sup(at);
            }
        };
        let mut poses = FramePoses::new(&run.robot);
        let ticks = run.trace.len();
        // fifty moments are enough to see where an arm goes
        for tick in (0..ticks).step_by((ticks / 50).max(1)) {
            let q = run.trace.q.at(tick);
            if q.iter().all(|q| q.is_finite()) {
                poses.update(&run.robot, q);
                for frame in run.robot.frames() {
                    add(&poses.world_from(frame).translation.vector);
                }
            }
        }
        for body in run.scene.iter().flat_map(|scene| &scene.scene.bodies) {
            add(&body.world_from_body.translation.vector);
        }
        if least.x > most.x {
            return Self {
                centre: [0.0; 3],
                radius_m: 1.0,
            };
        }
        Self {
            centre: ((least + most) / 2.0).into(),
            // shapes are wider than their frames
            radius_m: ((most - least).norm() / 2.0).max(0.05),
        }
    }
}

fn plot(title: &str, paths: &[String]) -> Value {
    let path = |value: &String| json!({ "value": value, "enabled": true, "timestampMethod": "receiveTime" });
    json!({
        "title": title,
        "foxglovePanelTitle": title,
        "lichtblickPanelTitle": title,
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

fn view(extent: &Extent) -> Value {
    let round = |value: f64| (value * 1e3).round() / 1e3 + 0.0;
    let grid_m = (4.0 * extent.radius_m).ceil();
    let seen = json!({ "visible": true });
    json!({
        "cameraState": {
            "perspective": true,
            // with a field of view of 45 degrees a sphere of this size fills it
            "distance": round(2.8 * extent.radius_m),
            "phi": 75,
            "thetaOffset": 20,
            "targetOffset": extent.centre.map(round),
            "target": [0, 0, 0],
            "targetOrientation": [0, 0, 0, 1],
            "fovy": 45,
            "near": round(0.01 * extent.radius_m).max(0.001),
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
                "size": grid_m,
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
                Some(panel) => {
                    placed.push(panel);
                    let tabs = layout["configById"][panel]["tabs"].as_array();
                    open.extend(tabs.into_iter().flatten().map(|tab| &tab["layout"]));
                }
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
    #[test]
    fn the_camera_sees_the_whole_arm_whatever_its_size() {
        let camera = |run: &TaskRun| {
            let layout: Value = serde_json::from_str(&layout(run)).unwrap();
            layout["configById"]["3D!arm"]["cameraState"].clone()
        };
        // the course's arm stands 2 m above the ground and is 2 m long
        let arm = camera(&sample::task_run());
        let distance = arm["distance"].as_f64().unwrap();
        assert!((3.0..12.0).contains(&distance), "{arm}");
        let height = arm["targetOffset"][2].as_f64().unwrap();
        assert!((0.5..3.5).contains(&height), "{arm}");
        // a run without a row has a camera, too
        let empty = camera(&sample::chain(2, 0, |_, _| 0.0));
        assert!(empty["distance"].as_f64().unwrap() > 0.0, "{empty}");
    }

    #[test]
    fn what_was_judged_is_shown_and_nothing_that_is_not_in_the_log() {
        let mut run = sample::task_run();
        let titles = |run: &TaskRun| -> Vec<String> {
            judged(run).into_iter().map(|(title, _)| title).collect()
        };
        let all = titles(&run);
        assert_eq!(all.len(), run.curves.len() + 1);
        run.goals.clear();
        run.curves.clear();
        assert!(titles(&run).is_empty());
        let layout: Value = serde_json::from_str(&layout(&run)).unwrap();
        assert!(!layout.to_string().contains("judged"), "{layout}");
    }
}
