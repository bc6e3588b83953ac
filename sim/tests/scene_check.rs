//! Checks of scenes: overlaps by hand and by separating axes, bodies that do not stay, via points and lines among shelf and can.

use kinemark_sim::engine::{Layout, Overlap, WorkBudget};
use kinemark_sim::format::SceneFile;
use kinemark_sim::model::contact::Party;
use kinemark_sim::model::inertia::Solid;
use kinemark_sim::model::prescribed_motion::Motion;
use kinemark_sim::model::robot::Robot;
use kinemark_sim::model::scene::{BodyKind, Scene, SceneBody};
use kinemark_sim::scene_check::{Finding, Kind, LineStopCause, Severity, Unchecked, Work, check};
use kinemark_sim::spatial::{Twist, pose, rotation_from_rpy};
use kinemark_sim::text::Source;
use nalgebra::{Matrix3, Vector3};

use crate::arms::{Numbers, lab_robot, robot, rrbot};
use crate::contact::mesh;
use crate::contact_scenes::{STILL, at, boxed, can, part, reach, scene, shelf, shelf_and_can};

/// Where the tip of the course's arm moves: y in the world.
const PLANE: f64 = 0.05;

fn of(scene: &Scene) -> Vec<Finding> {
    check(scene, None).expect("a scene")
}

fn around_rrbot(scene: &Scene, via: &[[f64; 2]]) -> Vec<Finding> {
    let robot = rrbot();
    let via = via.iter().map(|&[x, z]| Vector3::new(x, PLANE, z));
    let work = Work {
        robot: &robot,
        start_q: vec![0.0; 2],
        via_in_world: via.collect(),
        in_straight_lines: true,
    };
    check(scene, Some(&work)).expect("a scene")
}

fn named(findings: &[Finding]) -> Vec<(Severity, &'static str)> {
    let names = findings.iter().map(|f| (f.severity, f.kind.name()));
    names.collect()
}

fn depth_of(bodies: Vec<SceneBody>) -> Option<Overlap> {
    let layout = Layout::new(&scene(bodies), None).expect("a scene");
    let found = layout.among_bodies(0.0, &mut WorkBudget::new(u64::MAX));
    assert!(found.len() <= 1, "{found:?}");
    found.first().copied()
}

/// How far apart along the best of the axes that can part two boxes; negative where none does.
fn separation([a, b]: [(&Vector3<f64>, &Matrix3<f64>, &Vector3<f64>); 2]) -> f64 {
    let mut axes: Vec<Vector3<f64>> = Vec::new();
    for i in 0..3 {
        axes.push(a.1.column(i).into());
        axes.push(b.1.column(i).into());
        for j in 0..3 {
            axes.push(a.1.column(i).cross(&b.1.column(j)));
        }
    }
    let mut best = f64::NEG_INFINITY;
    for axis in axes.iter().filter(|axis| axis.norm() > 1e-6) {
        let axis = axis.normalize();
        let half =
            |(_, r, h): (_, &Matrix3<f64>, &Vector3<f64>)| (r.transpose() * axis).abs().dot(h);
        let gap = (b.0 - a.0).dot(&axis).abs() - half(a) - half(b);
        best = best.max(gap);
    }
    best
}

#[test]
fn boxes_are_in_each_other_as_deep_as_their_axes_say() {
    let mut numbers = Numbers::new(7);
    let mut deep = 0;
    for _ in 0..500 {
        let mut draw = || {
            let half = Vector3::from_fn(|_, _| numbers.between(0.02, 0.3));
            let place = Vector3::from_fn(|_, _| numbers.between(-0.25, 0.25));
            let turn = rotation_from_rpy([0; 3].map(|_: i32| numbers.between(-3.0, 3.0)));
            (place, turn, half)
        };
        let (a, b) = (draw(), draw());
        let body = |name, (place, turn, half): &(Vector3<f64>, Matrix3<f64>, Vector3<f64>)| {
            let solid = boxed(2.0 * half.x, 2.0 * half.y, 2.0 * half.z);
            part(
                name,
                BodyKind::Free,
                solid,
                1.0,
                pose(*turn, place + Vector3::z() * 5.0),
            )
        };
        let expected = -separation([(&a.0, &a.1, &a.2), (&b.0, &b.1, &b.2)]);
        let found = depth_of(vec![body("a", &a), body("b", &b)]);
        // two searches in double precision; the engine's stops at 1e-8 or so
        match found {
            Some(overlap) => {
                assert!(
                    (overlap.depth_m - expected).abs() < 1e-6,
                    "{overlap:?} {expected}"
                );
                deep += 1;
            }
            None => assert!(expected < 1e-6, "{expected}"),
        }
    }
    assert!((100..400).contains(&deep), "{deep}");
}

#[test]
fn overlaps_of_other_shapes_by_hand() {
    let ball = |z| {
        part(
            "ball",
            BodyKind::Free,
            Solid::Sphere { radius_m: 0.1 },
            1.0,
            at(0.0, 0.0, z),
        )
    };
    let sunk = depth_of(vec![ball(0.07)]).expect("in the ground");
    assert_eq!(sunk.parties, [Party::Body(0), Party::Ground]);
    assert!((sunk.depth_m - 0.03).abs() < 1e-12 && sunk.pushes);
    assert_eq!(depth_of(vec![ball(0.1)]), None);
    // centre in centre: no direction is better than another, and the shortest way out is still found
    let cube = |name, size| {
        part(
            name,
            BodyKind::Free,
            boxed(size, size, size),
            1.0,
            at(0.0, 0.0, 1.0),
        )
    };
    let inside = depth_of(vec![cube("a", 0.4), cube("b", 0.2)]).expect("inside");
    assert!((inside.depth_m - 0.3).abs() < 1e-5, "{inside:?}");
    // a can in the shelf by 12 mm
    let sunk = depth_of(vec![shelf(), can(1.0, 1.188)]).expect("in the shelf");
    assert!((sunk.depth_m - 0.012).abs() < 1e-6, "{sunk:?}");
    // a capsule that lies across an edge of the shelf's top
    let capsule = Solid::Capsule {
        radius_m: 0.05,
        length_m: 0.3,
    };
    let lying = pose(
        rotation_from_rpy([0.0, std::f64::consts::FRAC_PI_2, 0.0]),
        Vector3::new(1.1, 0.05, 1.24),
    );
    let lies = depth_of(vec![
        shelf(),
        part("roll", BodyKind::Free, capsule, 1.0, lying),
    ]);
    assert!((lies.expect("in the shelf").depth_m - 0.01).abs() < 1e-6);
    // the triangles of a fixed mesh, seen from outside
    let block = part(
        "block",
        BodyKind::Fixed,
        mesh([0.4, 0.4, 0.4], false),
        1.0,
        at(0.0, 0.0, 0.8),
    );
    let sunk = depth_of(vec![block, can(0.0, 0.98)]).expect("in the mesh");
    assert!((sunk.depth_m - 0.02).abs() < 1e-6, "{sunk:?}");
    // and a convex one that falls
    let stone = part(
        "stone",
        BodyKind::Free,
        mesh([0.2, 0.2, 0.2], true),
        1.0,
        at(1.0, 0.05, 1.29),
    );
    let sunk = depth_of(vec![shelf(), stone]).expect("in the shelf");
    assert!((sunk.depth_m - 0.01).abs() < 1e-6, "{sunk:?}");
}

#[test]
fn overlaps_that_push_are_errors_and_the_others_warnings_or_nothing() {
    let block = |name, kind, x| part(name, kind, boxed(0.2, 0.2, 0.2), 1.0, at(x, 0.0, 0.1));
    let turns = || Motion::steady(at(0.1, 0.0, 0.1), STILL);
    let post = || block("post", BodyKind::Fixed, 0.0);
    assert_eq!(
        of(&scene(vec![post(), block("wall", BodyKind::Fixed, 0.1)])),
        []
    );
    let found = of(&scene(vec![
        post(),
        block("gate", BodyKind::Kinematic(turns()), 0.1),
    ]));
    assert_eq!(named(&found), [(Severity::Warning, "overlap")]);
    let found = of(&scene(vec![post(), block("box", BodyKind::Free, 0.18)]));
    assert_eq!(named(&found)[0], (Severity::Error, "overlap"));
    let Kind::Overlap(overlap) = &found[0].kind else {
        panic!("{found:?}")
    };
    assert_eq!(overlap.parties, [Party::Body(0), Party::Body(1)]);
    assert!((overlap.depth_m - 0.02).abs() < 1e-6);
    // side by side, and a tenth of a millimetre in each other: people round
    assert_eq!(
        of(&scene(vec![post(), block("box", BodyKind::Free, 0.2)])),
        []
    );
    assert_eq!(
        of(&scene(vec![post(), block("box", BodyKind::Free, 0.19995)])),
        []
    );
}

#[test]
fn the_scenes_of_the_labs_have_no_findings() {
    for name in [
        "shelf-and-can",
        "broad-shelf-and-can",
        "bookshelf-along-the-arm",
    ] {
        let path = format!("{}/../labs/scenes/{name}.toml", env!("CARGO_MANIFEST_DIR"));
        let text = std::fs::read_to_string(&path).expect(&path);
        let file = SceneFile::parse(Source::new(name, text)).expect(name);
        let scene = file.build(&[]).expect(name);
        assert_eq!(of(&scene), [], "{name}");
        assert_eq!(around_rrbot(&scene, &[]), [], "{name}");
    }
}

#[test]
fn a_can_above_the_shelf_is_said_to_move() {
    let found = of(&scene(vec![shelf(), can(1.0, 1.22)]));
    assert_eq!(named(&found), [(Severity::Warning, "moves")]);
    let Kind::Moves {
        body: 1,
        distance_m,
        tilt_rad,
    } = found[0].kind
    else {
        panic!("{found:?}")
    };
    // it falls the gap and stays upright
    assert!(
        (distance_m - 0.02).abs() < 1e-4 && tilt_rad < 1e-3,
        "{found:?}"
    );
    // 4 mm are not worth a word
    assert_eq!(of(&scene(vec![shelf(), can(1.0, 1.204)])), []);
}

#[test]
fn a_body_without_anything_beneath_falls_forever() {
    let mut nothing = scene(vec![can(1.0, 1.2)]);
    nothing.environment.ground = None;
    assert_eq!(named(&of(&nothing)), [(Severity::Error, "falls-forever")]);
    // over the edge of a shelf: onto the ground, or on and on
    let mut edge = scene(vec![shelf(), can(1.12, 1.2)]);
    let found = of(&edge);
    assert_eq!(named(&found), [(Severity::Error, "falls-off")]);
    edge.environment.ground = None;
    assert_eq!(named(&of(&edge)), [(Severity::Error, "falls-forever")]);
    // where nothing falls, nothing falls on
    nothing.environment.gravity_m_s2 = Vector3::zeros();
    assert_eq!(of(&nothing), []);
}

#[test]
fn a_body_that_slides_off_its_support_falls_off_unless_it_is_sent() {
    let mut slide = shelf();
    // 40 degrees: steeper than friction holds
    slide.world_from_body = pose(
        rotation_from_rpy([0.0, 0.7, 0.0]),
        Vector3::new(0.0, 0.0, 2.0),
    );
    let turned = rotation_from_rpy([0.0, 0.7, 0.0]);
    let brick = |z| {
        part(
            "brick",
            BodyKind::Free,
            boxed(0.05, 0.05, 0.05),
            1.0,
            pose(
                turned,
                Vector3::new(0.0, 0.0, 2.0) + turned * Vector3::z() * z,
            ),
        )
    };
    let found = of(&scene(vec![slide, brick(0.626)]));
    assert_eq!(named(&found), [(Severity::Error, "falls-off")]);
    let Kind::FallsOff {
        body: 1,
        support: Party::Body(0),
        below_m,
    } = found[0].kind
    else {
        panic!("{found:?}")
    };
    assert!((1.5..3.0).contains(&below_m), "{below_m}");

    // a can that a pusher shoves off the shelf does what it is meant to
    let motion = Motion::steady(
        at(0.8, 0.05, 1.26),
        Twist {
            linear: Vector3::new(0.1, 0.0, 0.0),
            ..STILL
        },
    );
    let pusher = part(
        "pusher",
        BodyKind::Kinematic(motion),
        boxed(0.1, 0.1, 0.1),
        1.0,
        at(0.8, 0.05, 1.26),
    );
    let found = of(&scene(vec![shelf(), can(1.0, 1.2), pusher]));
    assert_eq!(named(&found), [(Severity::Note, "falls-off")]);
}

#[test]
fn a_fast_ball_goes_through_a_thin_sheet_and_a_slow_one_does_not() {
    let sheet = || {
        part(
            "sheet",
            BodyKind::Fixed,
            boxed(1.0, 1.0, 0.001),
            1.0,
            at(0.0, 0.0, 1.0),
        )
    };
    let ball = |speed: f64| {
        let solid = Solid::Sphere { radius_m: 0.002 };
        let mut ball = part("ball", BodyKind::Free, solid, 0.01, at(0.0, 0.0, 2.12));
        ball.twist.linear.z = -speed;
        scene(vec![sheet(), ball])
    };
    let found = of(&ball(200.0));
    assert_eq!(named(&found), [(Severity::Error, "falls-through")]);
    let Kind::FallsThrough {
        body: 1,
        through: Party::Body(0),
        time_s,
    } = found[0].kind
    else {
        panic!("{found:?}")
    };
    assert!((time_s - 1.12 / 200.0).abs() < 2e-3, "{time_s}");
    assert!(of(&ball(1.0)).iter().all(|f| f.severity == Severity::Note));
}

#[test]
fn links_at_the_start_are_looked_at_too() {
    let robot = rrbot();
    let mut work = Work {
        robot: &robot,
        // the tip 0.1 m below the top of the shelf
        start_q: reach(1.1, 1.0).to_vec(),
        via_in_world: Vec::new(),
        in_straight_lines: true,
    };
    let found = check(&shelf_and_can(), Some(&work)).expect("a scene");
    let parties: Vec<_> = found
        .iter()
        .map(|f| match &f.kind {
            Kind::Overlap(overlap) => overlap.parties,
            other => panic!("{other:?}"),
        })
        .collect();
    // bodies before links only where the robot is not asked for
    assert_eq!(
        parties,
        [
            [Party::Link(2), Party::Body(0)],
            [Party::Link(2), Party::Body(1)]
        ]
    );
    work.start_q = vec![7.0, 0.0];
    let found = check(&scene(vec![]), Some(&work)).expect("a scene");
    assert_eq!(named(&found), [(Severity::Error, "start-beyond-limit")]);
    work.start_q = vec![0.0];
    assert!(check(&scene(vec![]), Some(&work)).is_err());
    work.start_q = vec![0.0, f64::NAN];
    assert!(check(&scene(vec![]), Some(&work)).is_err());
}

#[test]
fn via_points_beyond_reach_in_the_shelf_and_reached_in_one_branch_only() {
    let scene = shelf_and_can();
    // half a metre farther than the arm is long
    let found = around_rrbot(&scene, &[[2.5, 2.0]]);
    let [
        Finding {
            severity: Severity::Error,
            kind:
                Kind::ViaUnreachable {
                    point: 0,
                    residual_m,
                },
        },
    ] = found[..]
    else {
        panic!("{found:?}")
    };
    assert!((residual_m - 0.5).abs() < 1e-4, "{residual_m}");

    let found = around_rrbot(&scene, &[[0.0, 3.0], [1.0, 1.1]]);
    let [
        Finding {
            severity: Severity::Error,
            kind:
                Kind::ViaCollides {
                    point: 1,
                    branches: 2,
                    colliding: 2,
                    overlap,
                },
        },
    ] = found[..]
    else {
        panic!("{found:?}")
    };
    assert_eq!(overlap.parties, [Party::Link(2), Party::Body(0)]);

    // beyond the shelf and below its top: over it with the elbow high, through it with the elbow low
    let found = around_rrbot(&scene, &[[1.2, 1.0]]);
    let [
        Finding {
            severity: Severity::Note,
            kind:
                Kind::ViaCollides {
                    point: 0,
                    branches: 2,
                    colliding: 1,
                    ..
                },
        },
    ] = found[..]
    else {
        panic!("{found:?}")
    };

    // straight up there is one branch and no finding
    assert_eq!(around_rrbot(&scene, &[[0.0, 4.0]]), []);
    // at the middle of the can, which gives way
    let found = around_rrbot(&scene, &[[1.0, 1.25]]);
    let touches = found
        .iter()
        .any(|f| matches!(&f.kind, Kind::ViaTouches { bodies, .. } if *bodies == [1]));
    assert!(
        touches && found.iter().all(|f| f.severity == Severity::Note),
        "{found:?}"
    );
}

#[test]
fn lines_are_followed_until_they_meet_something() {
    let scene = shelf_and_can();
    // free: in front of the shelf, above it
    assert_eq!(
        around_rrbot(&scene, &[[0.7, 1.4], [0.8, 2.0], [1.2, 2.5]]),
        []
    );
    // through the shelf, from a place in front of it to one behind it
    let found = around_rrbot(&scene, &[[0.6, 1.1], [1.3, 1.1]]);
    let line = found
        .iter()
        .find(|f| f.kind.name() == "line-blocked")
        .expect("a line");
    let Kind::LineBlocked {
        from: 0,
        branches: 2,
        blocked: 2,
        stop,
    } = &line.kind
    else {
        panic!("{found:?}")
    };
    assert_eq!(line.severity, Severity::Error);
    let LineStopCause::Collides(overlap) = stop.cause else {
        panic!("{stop:?}")
    };
    assert_eq!(overlap.parties[1], Party::Body(0));
    // the tip is 0.3 m away from the front, the forearm's corners come first
    assert!((0.2..=0.31).contains(&stop.along_m), "{stop:?}");
    assert!((stop.p_in_world - Vector3::new(0.6 + stop.along_m, PLANE, 1.1)).norm() < 1e-9);
    // just above the shelf, through the can
    let found = around_rrbot(&scene, &[[0.75, 1.25], [1.3, 1.25]]);
    assert!(
        found.iter().any(
            |f| matches!(&f.kind, Kind::LineTouches { from: 0, bodies, .. } if *bodies == [1])
        ),
        "{found:?}"
    );
    assert!(
        found.iter().all(|f| f.severity == Severity::Note),
        "{found:?}"
    );
}

#[test]
fn lines_past_the_shoulder_end_where_the_arm_cannot_fold_or_turn() {
    let lab = |from: &str, to: &str| {
        let path = format!("{}/../labs/robots/rrbot.toml", env!("CARGO_MANIFEST_DIR"));
        let text = std::fs::read_to_string(&path).expect(&path);
        assert!(text.contains(from));
        robot(&text.replacen(from, to, 1))
    };
    let past = |robot: &Robot, up: f64| {
        let work = Work {
            robot,
            start_q: vec![0.0; 2],
            via_in_world: vec![
                Vector3::new(1.5, PLANE, 2.0 + up),
                Vector3::new(-1.5, PLANE, 2.0 + up),
            ],
            in_straight_lines: false,
        };
        check(&scene(Vec::new()), Some(&work)).expect("a scene")
    };
    // equal links fold onto each other, and on; past the shoulder the upper arm turns fast, but it turns
    assert_eq!(past(&rrbot(), 0.0), []);
    assert_eq!(past(&rrbot(), 0.005), []);
    // unequal ones leave a hole of 0.4 m around the shoulder
    let found = past(&lab("[1.0, 1.0]", "[1.0, 0.6]"), 0.0);
    let [
        Finding {
            severity: Severity::Warning,
            kind:
                Kind::LineBlocked {
                    from: 0,
                    branches: 2,
                    blocked: 2,
                    stop,
                },
        },
    ] = found[..]
    else {
        panic!("{found:?}")
    };
    assert!((stop.along_m - 1.11).abs() < 1e-9, "{stop:?}");
    let LineStopCause::OutOfReach { residual_m } = stop.cause else {
        panic!("{stop:?}")
    };
    assert!((residual_m - 0.01).abs() < 1e-4, "{residual_m}");
    // a shoulder that turns to one side only: over to the other the elbow would have to go round
    let found = past(
        &lab("lower = -6.3, upper = 6.3", "lower = -0.7, upper = 0.7"),
        0.5,
    );
    assert_eq!(named(&found), [(Severity::Warning, "line-blocked")]);
    let Kind::LineBlocked { stop, .. } = &found[0].kind else {
        panic!("{found:?}")
    };
    assert!(
        !matches!(stop.cause, LineStopCause::Collides(_)),
        "{stop:?}"
    );
}

#[test]
fn robots_with_spare_joints_and_with_loops_are_checked_alike() {
    let nothing = scene(Vec::new());
    for name in ["puma560", "rppr", "uarm"] {
        let robot = lab_robot(name);
        let mut poses = kinemark_sim::kinematics::FramePoses::new(&robot);
        poses.update(&robot, robot.home());
        let tcp = poses.world_from(robot.tcp()).translation.vector;
        let work = Work {
            robot: &robot,
            start_q: robot.home().to_vec(),
            via_in_world: vec![tcp, tcp + Vector3::new(100.0, 0.0, 0.0)],
            in_straight_lines: true,
        };
        let found = check(&nothing, Some(&work)).expect(name);
        let last = found.last().expect("a finding");
        let Kind::ViaUnreachable {
            point: 1,
            residual_m,
        } = last.kind
        else {
            panic!("{name} {found:?}")
        };
        assert!(residual_m > 90.0, "{name}");
        let points = found.iter().filter(|f| f.kind.name() == "via-unreachable");
        assert_eq!(points.count(), 1, "{name} {found:?}");
        // the same question has the same answer
        assert_eq!(check(&nothing, Some(&work)).expect(name), found);
    }
}

/// So fine a carpet below so many boxes that the engine could not keep all its triangles.
#[test]
fn a_surface_with_too_many_triangles_below_everything_is_not_simulated() {
    let mut carpet = String::new();
    for x in 0..=100 {
        for y in 0..=100 {
            carpet += &format!("v {x}e-3 {y}e-3 0\n");
        }
    }
    for x in 0..100 {
        for y in 0..100 {
            let at = 101 * x + y + 1;
            carpet += &format!(
                "f {at} {} {}\nf {} {} {}\n",
                at + 101,
                at + 1,
                at + 1,
                at + 101,
                at + 102
            );
        }
    }
    let scene_of = |body: &str, boxes: usize| {
        let mut text = format!("format = 1\nname = 's'\n{body}");
        for i in 0..boxes {
            text += &format!(
                "[[bodies]]\nname = 'b{i}'\ntype = 'free'\norigin = {{ xyz_m = [0.05, 0.05, 0.1005] }}\ninertia = {{ mass_kg = 1 }}\n\
                 shapes = [{{ box = {{ size_m = [0.2, 0.2, 0.2] }} }}]\ncontact = {{ friction = 0.4 }}\n"
            );
        }
        let file = SceneFile::parse(Source::new("s", text)).expect("a scene");
        let file = file.with_meshes(|_| Ok(carpet.clone().into_bytes()));
        file.and_then(|file| file.build(&[])).expect("a scene")
    };
    let below = "[[bodies]]\nname = 'carpet'\ntype = 'fixed'\nshapes = [{ mesh = { file = 'carpet.obj' } }]\n\
        contact = { friction = 0.4 }\n";
    let last = of(&scene_of(below, 26)).pop().expect("a finding");
    assert_eq!(last.kind, Kind::NotChecked(Unchecked::StayFrom(0.0)));
    // more overlaps than are worth a simulation
    let last = of(&scene_of("", 46)).pop().expect("a finding");
    assert_eq!(last.kind, Kind::NotChecked(Unchecked::Stay));
}
