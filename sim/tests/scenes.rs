//! Scene files: the scenes of the labs have the numbers they were made for, and each mistake is reported at its position.

#![expect(
    clippy::float_cmp,
    reason = "a number that a file states is kept as it is"
)]

use kinemark_sim::format::{SceneError, SceneFile};
use kinemark_sim::model::inertia::Solid;
use kinemark_sim::model::scene::{BodyKind, Scene, SceneBody};
use kinemark_sim::spatial::Twist;
use kinemark_sim::text::Dimension;
use kinemark_sim::text::{Problem as _, Source};
use miette::Diagnostic as _;
use nalgebra::Vector3;

fn root(path: &str) -> String {
    format!("{}/../{path}", env!("CARGO_MANIFEST_DIR"))
}

/// A cube of 1 m whose triangles face outwards, as OBJ.
const CUBE: &str = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 0 1\nv 1 0 1\nv 1 1 1\nv 0 1 1\n\
    f 4 3 2 1\nf 5 6 7 8\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\n";

fn read(text: &str) -> Result<Scene, SceneError> {
    SceneFile::parse(Source::new("scene.toml", text))?
        .with_meshes(|name| match name {
            "cube.obj" => Ok(CUBE.into()),
            "sheet.obj" => Ok("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n".into()),
            _ => Err("there is no such file".to_owned()),
        })?
        .build(&[])
}

/// A scene of the labs, with some dimensions changed.
fn lab_scene(name: &str, changed: &[(String, Dimension)]) -> Scene {
    let path = root(&format!("labs/scenes/{name}.toml"));
    let text = std::fs::read_to_string(&path).expect(&path);
    let file = SceneFile::parse(Source::new(path, text)).expect("readable");
    file.build(changed).expect("a scene")
}

fn body<'a>(scene: &'a Scene, name: &str) -> &'a SceneBody {
    let found = scene.bodies.iter().find(|body| body.name == name);
    found.expect(name)
}

#[test]
fn the_scenes_of_the_labs_have_the_numbers_of_the_contact_runs() {
    // tests/golden/C_lab34_scene.json: its x is the world's z, its y the world's x, its z the world's y
    let path = root("tests/golden/C_lab34_scene.json");
    let golden = std::fs::read_to_string(&path).expect(&path);
    let golden: serde_json::Value = serde_json::from_str(&golden).expect("JSON");
    for (file, id, across_m) in [
        ("bookshelf-along-the-arm", "S1_", 0.4),
        ("broad-shelf-and-can", "S2_", 0.92),
        ("shelf-and-can", "S5_", 0.9),
    ] {
        let scenes = golden["scenes"].as_array().expect("scenes");
        let wanted = scenes
            .iter()
            .find(|scene| scene["name"].as_str().expect("name").starts_with(id))
            .expect(id);
        let number = |part: &str, key: &str| wanted[part][key].as_f64().expect(key);
        let scene = lab_scene(file, &[]);
        assert_eq!(scene.name, file);
        assert_eq!(
            scene.environment.gravity_m_s2,
            Vector3::new(0.0, 0.0, -9.81)
        );
        let ground = scene.environment.ground.expect("ground");
        assert_eq!((ground.friction, ground.restitution), (0.4, 0.0));

        let shelf = body(&scene, "shelf");
        assert_eq!(shelf.kind, BodyKind::Fixed);
        let Solid::Box { size_m } = shelf.shapes[0].solid else {
            panic!("the shelf is a box");
        };
        let centre = shelf.world_from_body.translation.vector;
        let faces = |axis: usize| {
            [
                centre[axis] - size_m[axis] / 2.0,
                centre[axis] + size_m[axis] / 2.0,
            ]
        };
        let limits = |low, high| [number("shelf", low), number("shelf", high)];
        let near = |a: [f64; 2], b: [f64; 2]| {
            // sums of decimals: a rounding or two
            let apart = (a[0] - b[0]).abs().max((a[1] - b[1]).abs());
            assert!(apart < 1e-15, "{file}: {a:?} against {b:?}");
        };
        near(faces(2), limits("x_min", "x_max"));
        near(faces(0), limits("y_min", "y_max"));
        near(faces(1), [0.05 - across_m / 2.0, 0.05 + across_m / 2.0]);

        let can = body(&scene, "can");
        assert_eq!(can.kind, BodyKind::Free);
        let (radius_m, length_m) = (number("can", "radius"), number("can", "height"));
        assert_eq!(
            can.shapes[0].solid,
            Solid::Cylinder { radius_m, length_m },
            "{file}"
        );
        let p = can.world_from_body.translation.vector;
        near(
            [p.x, p.z],
            [
                number("can", "y_center"),
                number("can", "x_base") + length_m / 2.0,
            ],
        );
        assert_eq!(p.y, 0.05); // the plane in which the tip of the arm moves
        assert_eq!((can.contact.friction, can.contact.restitution), (0.4, 0.0));
        assert_eq!(can.twist, Twist::zero());
        // m (3 r² + h²) / 12 across and m r² / 2 along, by hand: 0.39 (0.003267 + 0.01) / 12 and 0.39 0.001089 / 2
        assert_eq!(can.inertia.mass_kg, 0.39);
        assert_eq!(can.inertia.com_m, Vector3::zeros());
        let tensor = can.inertia.about_com_kg_m2;
        for (moment, by_hand) in [
            (tensor.xx, 4.311_775e-4),
            (tensor.yy, 4.311_775e-4),
            (tensor.zz, 2.123_55e-4),
        ] {
            assert!((moment - by_hand).abs() < 1e-18, "{moment} {by_hand}");
        }
    }
}

#[test]
fn a_variant_moves_all_that_hangs_on_a_dimension() {
    let changed = [("shelf_height".to_owned(), Dimension::Number(0.8))];
    let scene = lab_scene("shelf-and-can", &changed);
    let z = |name| body(&scene, name).world_from_body.translation.z;
    assert_eq!((z("shelf"), z("can")), (0.4, 0.8 + 0.1 / 2.0));
    let file = SceneFile::parse(Source::new("s", HEAD)).expect("readable");
    let unknown = file.build(&changed).expect_err("no such dimension");
    assert_eq!(unknown.problem.code(), "scene::unknown_dimension");
    assert_eq!(
        unknown.to_string(),
        "no dimension `shelf_height` in this scene"
    );
}

#[test]
fn every_example_of_the_page_loads() {
    let page = std::fs::read_to_string(root("docs/scenes.md")).expect("page");
    let mut examples = 0;
    for example in page.split("```toml\n").skip(1) {
        let example = example.split("```").next().expect("an end");
        let text = if example.starts_with("format") {
            example.to_owned()
        } else {
            format!("{HEAD}\n{example}")
        };
        if let Err(error) = read(&text) {
            panic!("{error}: {:?}\n{text}", error.line_and_column());
        }
        examples += 1;
    }
    assert!(examples >= 6, "{examples} examples");
    // and the page names every code there is
    let problems = std::fs::read_to_string(root("sim/src/format/scene_toml/scene_problem.rs"))
        .expect("source");
    for code in problems.split("\"scene::").skip(1) {
        let code = code.split('"').next().expect("an end");
        assert!(page.contains(&format!("`scene::{code}`")), "{code}");
    }
}

#[test]
fn wind_velocity_and_drag_are_read() {
    let scene = read(
        "format = 1\nname = \"s\"\n[environment]\ngravity_m_s2 = [0, 0, -1.62]\n\
         [environment.wind]\nvelocity_m_s = [0, 3, 0]\n\
         gust = { speed_m_s = 1, correlation_s = 0.5, seed = 7 }\n\
         [[bodies]]\nname = \"ball\"\ntype = \"free\"\nshapes = [{ sphere = { radius_m = 0.1 } }]\n\
         inertia = { density_kg_m3 = 100 }\ncontact = { friction = 0.5, restitution = 0.8 }\n\
         velocity = { linear_m_s = [1, 0, 0], angular_rad_s = [0, 0, 2] }\n\
         drag = { area_m2 = 0.03, coefficient = 0.47 }\n",
    )
    .expect("a scene");
    assert_eq!(scene.environment.gravity_m_s2.z, -1.62);
    assert_eq!(scene.environment.ground, None);
    let wind = scene.environment.wind.as_ref().expect("wind");
    assert_eq!(wind.air_density_kg_m3, 1.225);
    assert_eq!(wind.gust.expect("gust").seed, 7);
    let ball = &scene.bodies[0];
    assert_eq!(ball.twist.linear, Vector3::x());
    assert_eq!(ball.twist.angular, Vector3::z() * 2.0);
    assert_eq!(ball.contact.restitution, 0.8);
    assert_eq!(ball.drag.expect("drag").coefficient, 0.47);
    // 100 4/3 pi 0.001 kg
    assert!((ball.inertia.mass_kg - 0.418_879_020_478_639_1).abs() < 1e-15);
}

#[test]
fn a_kinematic_body_starts_where_its_motion_does() {
    let text = |motion: &str| {
        format!(
            "{HEAD}[[bodies]]\nname = \"gate\"\ntype = \"kinematic\"\n\
             shapes = [{{ box = {{ size_m = [1, 1, 1] }} }}]\ncontact = {{ friction = 0.5 }}\n{motion}\n"
        )
    };
    let scene = read(&text(
        "motion = { waypoints = [{ t_s = 0, xyz_m = [1, 0, 0] }, { t_s = 2, xyz_m = [1, 4, 0] }, { t_s = 4, xyz_m = [1, 0, 0] }], repeat = true }",
    ))
    .expect("a scene");
    let gate = &scene.bodies[0];
    let BodyKind::Kinematic(motion) = &gate.kind else {
        panic!("kinematic");
    };
    assert_eq!(gate.world_from_body.translation.vector, Vector3::x());
    assert_eq!(gate.twist.linear, Vector3::y() * 2.0);
    assert_eq!(motion.at(11.0).0.translation.y, 2.0);
    let scene = read(&text(
        "origin = { xyz_m = [0, 0, 2] }\nmotion = { angular_rad_s = [0, 0, 1] }",
    ))
    .expect("a scene");
    let (pose, twist) = (scene.bodies[0].world_from_body, scene.bodies[0].twist);
    assert_eq!(pose.translation.z, 2.0);
    assert_eq!(twist.angular, Vector3::z());
}

#[test]
fn only_fixed_bodies_keep_a_mesh_as_it_is() {
    let text = |kind: &str, mesh: &str, more: &str| {
        format!(
            "{HEAD}[[bodies]]\nname = \"b\"\ntype = \"{kind}\"\nshapes = [{{ mesh = {{ {mesh} }} }}]\n\
             contact = {{ friction = 0.5 }}\n{more}\n"
        )
    };
    let convex = |scene: &Scene| match &scene.bodies[0].shapes[0].solid {
        Solid::Mesh(mesh) => mesh.convex,
        _ => panic!("a mesh"),
    };
    let mass = "inertia = { mass_kg = 1 }";
    let fixed = read(&text("fixed", "file = \"sheet.obj\"", "")).expect("fixed");
    assert!(!convex(&fixed));
    let cube = "file = \"cube.obj\", convex = true";
    assert!(convex(&read(&text("fixed", cube, "")).expect("fixed")));
    let free = read(&text("free", cube, mass)).expect("free");
    assert!(convex(&free));
    assert_eq!(free.bodies[0].inertia.com_m, Vector3::repeat(0.5));
    for (kind, mesh, more, code) in [
        ("free", "file = \"cube.obj\"", mass, "scene::open_mesh"),
        (
            "kinematic",
            "file = \"cube.obj\", convex = false",
            "motion = { linear_m_s = [1, 0, 0] }",
            "scene::open_mesh",
        ),
        (
            "fixed",
            "file = \"sheet.obj\", convex = true",
            "",
            "scene::mesh",
        ),
        ("fixed", "file = \"none.obj\"", "", "scene::mesh"),
    ] {
        let error = read(&text(kind, mesh, more)).expect_err(mesh);
        assert_eq!(error.problem.code(), code, "{error}");
        assert!(error.problem.help().is_some(), "{error}");
        assert_eq!(error.line_and_column().0, 6, "{error}");
    }
}

const HEAD: &str = "format = 1\nname = \"s\"\n";

/// A dynamic ball with a key added or replaced; the key of the name is on line 4.
fn ball(changes: &[(&str, &str)]) -> String {
    let mut keys = vec![
        ("name", "\"ball\""),
        ("type", "\"free\""),
        ("shapes", "[{ sphere = { radius_m = 0.1 } }]"),
        ("inertia", "{ mass_kg = 1 }"),
        ("contact", "{ friction = 0.5 }"),
    ];
    for change in changes {
        match keys.iter_mut().find(|(key, _)| *key == change.0) {
            Some(key) => *key = *change,
            None => keys.push(*change),
        }
    }
    let mut text = format!("{HEAD}[[bodies]]\n");
    for (key, value) in keys {
        if !value.is_empty() {
            text += &format!("{key} = {value}\n");
        }
    }
    text
}

/// The text under the caret.
fn under_caret(error: &SceneError) -> &str {
    let label = error.labels().and_then(|mut labels| labels.next());
    let label = label.expect("a label");
    let text = error.source().text();
    &text[label.offset()..label.offset() + label.len()]
}

#[test]
fn each_mistake_is_reported_at_its_position() {
    assert!(read(&ball(&[])).is_ok());
    let cases = [
        // the file
        (HEAD.replace("= 1", "= 2"), "scene::unknown_format", "2"),
        (format!("{HEAD}bodeis = []"), "scene::toml", "bodeis"),
        (ball(&[("frictoin", "1")]), "scene::toml", "frictoin"),
        (ball(&[("type", "\"fluid\"")]), "scene::toml", "\"fluid\""),
        (ball(&[("name", "\" \"")]), "scene::bad_name", "\" \""),
        (
            ball(&[("name", "\"ground\"")]),
            "scene::bad_name",
            "\"ground\"",
        ),
        (
            ball(&[]) + &ball(&[])[HEAD.len()..],
            "scene::duplicate",
            "\"ball\"",
        ),
        (
            ball(&[("origin", "{ xyz_m = [0, 0, \"2 * height\"] }")]),
            "scene::expression",
            "height",
        ),
        (
            ball(&[("origin", "{ xyz_m = [0, 0, 1e7] }")]),
            "scene::out_of_range",
            "{ xyz_m = [0, 0, 1e7] }",
        ),
        (
            ball(&[("origin", "{ rpy_deg = [0, 0, 0], angle_deg = 3 }")]),
            "scene::origin",
            "3",
        ),
        (
            ball(&[("origin", "{ axis = [0, 0, 0], angle_deg = 3 }")]),
            "scene::axis",
            "[0, 0, 0]",
        ),
        // surroundings
        (
            format!("{HEAD}environment = {{ ground = {{ friction = -0.1 }} }}"),
            "scene::out_of_range",
            "-0.1",
        ),
        (
            format!("{HEAD}environment = {{ gravity_m_s2 = [0, 0, -1e9] }}"),
            "scene::out_of_range",
            "0, 0, -1e9",
        ),
        (
            format!(
                "{HEAD}environment = {{ wind = {{ velocity_m_s = [1, 0, 0], air_density_kg_m3 = 0 }} }}"
            ),
            "scene::out_of_range",
            "0",
        ),
        (
            format!(
                "{HEAD}environment = {{ wind = {{ velocity_m_s = [0, 0, 0], gust = {{ speed_m_s = 1, correlation_s = 1, seed = 1 }} }} }}"
            ),
            "scene::gust_without_wind",
            "{ speed_m_s = 1, correlation_s = 1, seed = 1 }",
        ),
        (
            format!(
                "{HEAD}environment = {{ wind = {{ velocity_m_s = [1, 0, 0], gust = {{ speed_m_s = 1, correlation_s = 0, seed = 1 }} }} }}"
            ),
            "scene::out_of_range",
            "0",
        ),
        (
            format!(
                "{HEAD}environment = {{ wind = {{ velocity_m_s = [1, 0, 0], gust = {{ speed_m_s = 1, correlation_s = 1, seed = -1 }} }} }}"
            ),
            "scene::toml",
            "-1",
        ),
        (
            format!(
                "{HEAD}environment = {{ wind = {{ velocity_m_s = [1, 0, 0], gust = {{ speed_m_s = 1e308, correlation_s = 1, seed = 1 }} }} }}"
            ),
            "scene::out_of_range",
            "1e308",
        ),
        (
            ball(&[("drag", "{ area_m2 = 1, coefficient = 1e300 }")]),
            "scene::out_of_range",
            "1e300",
        ),
        // shapes, surface and mass
        (ball(&[("shapes", "[]")]), "scene::no_shapes", "\"ball\""),
        (
            ball(&[("shapes", "[{ sphere = { radius_m = 0 } }]")]),
            "scene::out_of_range",
            "0",
        ),
        (
            ball(&[("shapes", "[{ sphere = { radius_m = 1e9 } }]")]),
            "scene::out_of_range",
            "{ sphere = { radius_m = 1e9 } }",
        ),
        (
            ball(&[("shapes", "[{ origin = { xyz_m = [0, 0, 0] } }]")]),
            "scene::toml",
            "{ origin = { xyz_m = [0, 0, 0] } }",
        ),
        (
            ball(&[("contact", "{ friction = 0.5, restitution = 1.5 }")]),
            "scene::out_of_range",
            "1.5",
        ),
        (
            ball(&[("contact", "{ friction = 1e300 }")]),
            "scene::out_of_range",
            "1e300",
        ),
        (ball(&[("inertia", "")]), "scene::mass", "\"ball\""),
        (
            ball(&[("inertia", "{ mass_kg = 0 }")]),
            "scene::inertia",
            "{ mass_kg = 0 }",
        ),
        (
            ball(&[
                ("inertia", "{ density_kg_m3 = 1e-320 }"),
                ("shapes", "[{ sphere = { radius_m = 1e-9 } }]"),
            ]),
            "scene::inertia",
            "{ density_kg_m3 = 1e-320 }",
        ),
        (
            ball(&[("inertia", "{ density_kg_m3 = 1, mass_kg = 1 }")]),
            "scene::inertia",
            "{ density_kg_m3 = 1, mass_kg = 1 }",
        ),
        (
            ball(&[(
                "inertia",
                "{ mass_kg = 1, tensor_kg_m2 = [1, 1, 0, 0, 0, 0] }",
            )]),
            "scene::inertia",
            "{ mass_kg = 1, tensor_kg_m2 = [1, 1, 0, 0, 0, 0] }",
        ),
        (
            ball(&[(
                "inertia",
                "{ mass_kg = 1, tensor_kg_m2 = [1, 1, 3, 0, 0, 0] }",
            )]),
            "scene::inertia",
            "[1, 1, 3, 0, 0, 0]",
        ),
        (
            ball(&[(
                "inertia",
                "{ mass_kg = 1, tensor_kg_m2 = [1, 1, 3, 0, 0, 0], accept_unphysical = true }",
            )]),
            "scene::inertia",
            "{ mass_kg = 1, tensor_kg_m2 = [1, 1, 3, 0, 0, 0], accept_unphysical = true }",
        ),
        // motion
        (
            ball(&[("velocity", "{ linear_m_s = [0, 1e7, 0] }")]),
            "scene::out_of_range",
            "0, 1e7, 0",
        ),
        (
            ball(&[
                ("type", "\"fixed\""),
                ("velocity", "{ linear_m_s = [0, 1, 0] }"),
            ]),
            "scene::motion",
            "{ linear_m_s = [0, 1, 0] }",
        ),
        (
            ball(&[
                ("type", "\"fixed\""),
                ("drag", "{ area_m2 = 1, coefficient = 1 }"),
            ]),
            "scene::motion",
            "{ area_m2 = 1, coefficient = 1 }",
        ),
        (
            ball(&[("motion", "{ linear_m_s = [0, 1, 0] }")]),
            "scene::motion",
            "{ linear_m_s = [0, 1, 0] }",
        ),
        (
            ball(&[("type", "\"kinematic\"")]),
            "scene::motion",
            "\"kinematic\"",
        ),
        (kinematic("{}"), "scene::motion", "{}"),
        (
            kinematic("{ linear_m_s = [1, 0, 0], repeat = true }"),
            "scene::motion",
            "{ linear_m_s = [1, 0, 0], repeat = true }",
        ),
        (
            kinematic("{ waypoints = [{ t_s = 0, xyz_m = [0, 0, 0] }] }"),
            "scene::motion",
            "{ waypoints = [{ t_s = 0, xyz_m = [0, 0, 0] }] }",
        ),
        (
            kinematic(
                "{ waypoints = [{ t_s = 1, xyz_m = [0, 0, 0] }, { t_s = 1, xyz_m = [1, 0, 0] }] }",
            ),
            "scene::motion",
            "{ t_s = 1, xyz_m = [1, 0, 0] }",
        ),
        (
            kinematic(
                "{ waypoints = [{ t_s = 0, xyz_m = [0, 0, 0] }, { t_s = 1, xyz_m = [1, 0, 0] }], repeat = true }",
            ),
            "scene::motion",
            "true",
        ),
        (
            kinematic(
                "{ waypoints = [{ t_s = 0, xyz_m = [0, 0, 0] }, { t_s = 1e-9, xyz_m = [1, 0, 0] }] }",
            ),
            "scene::out_of_range",
            "{ t_s = 0, xyz_m = [0, 0, 0] }",
        ),
        (
            kinematic(
                "{ waypoints = [{ t_s = 0, xyz_m = [0, 0, 0] }, { t_s = 1, xyz_m = [1, 0, 0] }] }\norigin = { xyz_m = [1, 0, 0] }",
            ),
            "scene::motion",
            "{ xyz_m = [1, 0, 0] }",
        ),
    ];
    for (text, code, at) in cases {
        let error = read(&text).expect_err(&text);
        assert_eq!(error.problem.code(), code, "{error}\n{text}");
        assert_eq!(under_caret(&error), at, "{error}\n{text}");
        assert!(!error.problem.label().is_empty());
    }
}

fn kinematic(motion: &str) -> String {
    ball(&[("type", "\"kinematic\""), ("motion", motion)])
}

#[test]
fn messages_say_what_was_given_and_what_to_do() {
    let problem = |text: &str| {
        let error = read(text).expect_err(text);
        (error.to_string(), error.problem.help().unwrap_or_default())
    };
    assert_eq!(
        problem(&ball(&[("inertia", "{ mass_kg = 0 }")])),
        (
            "dynamic body `ball` needs a positive mass, got 0.0 kg".to_owned(),
            "a body without mass cannot be moved by forces; make it `fixed` or `kinematic`"
                .to_owned()
        )
    );
    assert_eq!(
        problem(&ball(&[("inertia", "{ mass_kg = 1, com_m = [0, 0, 0] }")])),
        (
            "body `ball` has `com_m` but no `tensor_kg_m2`".to_owned(),
            "leave `com_m` out to take both from the shapes, or give the tensor too".to_owned()
        )
    );
    assert_eq!(
        problem(&ball(&[("velocty", "{}")])),
        (
            "unknown key `velocty`".to_owned(),
            "did you mean `velocity`?".to_owned()
        )
    );
    assert_eq!(
        problem(&ball(&[("type", "\"fre\"")])),
        (
            "unknown value `fre`".to_owned(),
            "did you mean `free`?".to_owned()
        )
    );
    let many = format!(
        "{HEAD}{}",
        "[[bodies]]\nname = \"b\"\ntype = \"fixed\"\ncontact = { friction = 1 }\n".repeat(1001)
    );
    assert_eq!(
        problem(&many),
        (
            "1001 bodies are more than a scene may have (1000)".to_owned(),
            "leave out bodies that nothing needs".to_owned()
        )
    );
}

/// A thousand bodies of so many balls, or of so many meshes of 600 triangles.
fn crowd(shape: &str, each: usize) -> String {
    let shapes = vec![shape; each].join(", ");
    let bodies = (0..1000).map(|i| {
        format!(
            "[[bodies]]\nname = \"b{i}\"\ntype = \"fixed\"\nshapes = [{shapes}]\ncontact = {{ friction = 1 }}\n"
        )
    });
    format!("{HEAD}{}", bodies.collect::<String>())
}

#[test]
fn more_shapes_or_triangles_than_anybody_needs_are_refused_at_the_first_one_too_many() {
    let parse = |text: &str| SceneFile::parse(Source::new("scene.toml", text));
    let ball = "{ sphere = { radius_m = 1 } }";
    parse(&crowd(ball, 2)).expect("two thousand");
    let error = parse(&crowd(ball, 5)).expect_err("five thousand");
    let words = "5000 shapes are more than a scene may have (2000)";
    assert_eq!(error.to_string(), words);
    // the first shape of the body in the middle
    let text = crowd(ball, 5);
    let mut lines = text.lines();
    let name = lines.position(|line| line == "name = \"b400\"");
    // its shapes are two lines below its name
    assert_eq!(error.line_and_column().0, name.expect("a body") + 1 + 2);
    let mesh = "{ mesh = { file = \"strip.obj\" } }";
    let mut strip = String::new();
    for i in 0..302 {
        strip += &format!("v {i} 0 0\nv {i} 1 0\n");
    }
    for i in 0..300 {
        let at = 2 * i + 1;
        strip += &format!(
            "f {at} {} {}\nf {} {} {}\n",
            at + 2,
            at + 1,
            at + 1,
            at + 2,
            at + 3
        );
    }
    let with = |each: usize| {
        let file = parse(&crowd(mesh, each)).expect("few shapes");
        file.with_meshes(|_| Ok(strip.clone().into_bytes()))
    };
    with(1).expect("few triangles");
    let error = with(2).expect_err("too many triangles");
    let words = "1000200 triangles are more than a scene may have (1000000)";
    assert_eq!(error.to_string(), words);
}

#[test]
fn a_scene_without_bodies_is_an_empty_world() {
    let scene = read(HEAD).expect("a scene");
    assert!(scene.bodies.is_empty());
    assert_eq!(
        scene.environment,
        kinemark_sim::model::scene::Environment::default()
    );
}

#[test]
fn no_number_breaks_the_reader_or_what_it_returns() {
    let text = ball(&[
        (
            "origin",
            "{ xyz_m = [0.11, 0.11, 0.11], rpy_deg = [0.11, 0.11, 0.11] }",
        ),
        (
            "shapes",
            "[{ capsule = { radius_m = 0.11, length_m = 0.11 }, origin = { xyz_m = [0.11, 0, 0] } }]",
        ),
        ("inertia", "{ density_kg_m3 = 0.11 }"),
        ("velocity", "{ angular_rad_s = [0.11, 0, 0] }"),
    ]) + "[[bodies]]\nname = \"gate\"\ntype = \"kinematic\"\nshapes = [{ sphere = { radius_m = 0.11 } }]\n\
          contact = { friction = 0.11 }\n[bodies.motion]\nwaypoints = [{ t_s = 0, xyz_m = [0, 0, 0] },\n\
          { t_s = 0.11, xyz_m = [0.11, 0, 0], rpy_deg = [0.11, 0, 0] }, { t_s = 1, xyz_m = [0, 0, 0] }]\nrepeat = true\n";
    read(&text).expect("a scene as it is");
    let hostile = [
        "nan",
        "-inf",
        "1e308",
        "-1e308",
        "5e-324",
        "-0.0",
        "1e6",
        "9223372036854775807",
        "\"1 / 0\"",
        "\"((((\"",
        "[]",
        "{}",
        "\"\"",
    ];
    let places: Vec<usize> = text.match_indices("0.11").map(|(at, _)| at).collect();
    for at in places {
        for value in hostile {
            let changed = format!("{}{value}{}", &text[..at], &text[at + 4..]);
            let Ok(scene) = read(&changed) else { continue };
            for body in &scene.bodies {
                let inertia = &body.inertia;
                let mut numbers = vec![inertia.mass_kg, body.contact.friction];
                numbers.extend(inertia.about_com_kg_m2.to_matrix().iter());
                for time_s in [0.0, 0.5, 1e6] {
                    let (pose, twist) = match &body.kind {
                        BodyKind::Kinematic(motion) => motion.at(time_s),
                        _ => (body.world_from_body, body.twist),
                    };
                    numbers.extend(pose.to_homogeneous().iter());
                    numbers.extend(twist.to_vector().iter());
                }
                assert!(numbers.iter().all(|x| x.is_finite()), "{changed}");
            }
        }
    }
}
