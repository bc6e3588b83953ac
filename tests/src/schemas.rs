//! The published schemas: they are those of the code, every file that is shipped is valid, and a slip is refused where it stands.
//!
//! With KINEMARK_TAPLO, the path of a `taplo`, the same files go through that editor's own check.

use std::path::Path;
use std::process::Command;
use std::sync::OnceLock;

use jsonschema::Validator;
use kinemark_course::course_file::CourseFile;
use kinemark_grader::audit::Accepted;
use kinemark_grader::lab::schema::{hidden_schema, lab_schema, mutants_schema, variant_schema};
use kinemark_sim::format::{RobotFile, SceneFile};
use serde_json::Value;

use crate::golden::are_current;
use crate::testbed::{TestBed, root};

/// Makes the schema of a kind.
type MakeSchema = fn() -> Value;

/// The kinds of files, by the words of `kinemark lab schema`.
const KINDS: [(&str, MakeSchema); 8] = [
    ("lab", || lab_schema().to_value()),
    ("hidden", || hidden_schema().to_value()),
    ("mutants", || mutants_schema().to_value()),
    ("accepted", || Accepted::schema().to_value()),
    ("robot", || RobotFile::schema().to_value()),
    ("scene", || SceneFile::schema().to_value()),
    ("variant", || variant_schema().to_value()),
    ("course", || CourseFile::schema().to_value()),
];

fn published(kind: &str) -> String {
    format!("docs/schema/{kind}.schema.json")
}

/// The schema of a kind, ready to look at files.
fn validator(kind: &str) -> &'static Validator {
    static ALL: OnceLock<Vec<(&str, Validator)>> = OnceLock::new();
    let all = ALL.get_or_init(|| {
        let made = KINDS.iter().map(|(kind, schema)| {
            let schema = jsonschema::draft7::new(&schema());
            (*kind, schema.expect("a schema of draft 7"))
        });
        made.collect()
    });
    let found = all.iter().find(|(known, _)| *known == kind);
    &found.unwrap_or_else(|| panic!("no kind `{kind}`")).1
}

/// A file in TOML as editors hand it to a schema: times are texts.
fn instance(text: &str) -> Value {
    fn as_json(value: &toml::Value) -> Value {
        match value {
            toml::Value::Datetime(time) => time.to_string().into(),
            toml::Value::Array(items) => items.iter().map(as_json).collect(),
            toml::Value::Table(table) => {
                let pairs = table
                    .iter()
                    .map(|(key, value)| (key.clone(), as_json(value)));
                Value::Object(pairs.collect())
            }
            plain => serde_json::to_value(plain).expect("a plain value"),
        }
    }
    as_json(&toml::Value::Table(text.parse().expect("TOML")))
}

/// What a schema refuses in a file: each with its place.
fn refusals(kind: &str, text: &str) -> Vec<(String, String)> {
    let instance = instance(text);
    let errors = validator(kind).iter_errors(&instance);
    errors
        .map(|error| (error.instance_path().to_string(), error.to_string()))
        .collect()
}

/// A file that Kinemark reads is valid for an editor.
#[track_caller]
pub(crate) fn is_valid(kind: &str, name: &str, text: &str) {
    let refused = refusals(kind, text);
    assert!(refused.is_empty(), "{name}: {refused:#?}");
}

/// Every file of the checkout of which there is a schema, with its kind.
fn shipped() -> Vec<(&'static str, String)> {
    let mut found = Vec::new();
    let mut add = |folder: &str, kind_of: &dyn Fn(&str) -> Option<&'static str>| {
        let entries = std::fs::read_dir(root().join(folder)).expect(folder);
        let mut names: Vec<String> = entries
            .map(|entry| {
                entry
                    .expect("an entry")
                    .file_name()
                    .to_string_lossy()
                    .into_owned()
            })
            .collect();
        names.sort();
        for name in names {
            if let Some(kind) = kind_of(&name) {
                found.push((kind, format!("{folder}/{name}")));
            }
        }
    };
    let of_lab = |name: &str| (name == "lab.toml").then_some("lab");
    let of_staff = |name: &str| match name {
        "hidden.toml" => Some("hidden"),
        "mutants.toml" => Some("mutants"),
        "accepted.toml" => Some("accepted"),
        _ => None,
    };
    let toml = |name: &str| Path::new(name).extension().is_some_and(|end| end == "toml");
    add("labs/robots", &|name| toml(name).then_some("robot"));
    add("tests/golden/models", &|name| toml(name).then_some("robot"));
    add("labs/scenes", &|name| toml(name).then_some("scene"));
    add("tests/lab_files/reports/scenes", &|name| {
        toml(name).then_some("scene")
    });
    add("tests/fuzz/seeds/variant", &|name| {
        toml(name).then_some("variant")
    });
    for folder in ["labs", "reference", "tests/lab_files/reports"] {
        for entry in std::fs::read_dir(root().join(folder)).expect(folder) {
            let entry = entry.expect("an entry");
            if entry.file_type().expect("its type").is_dir() {
                let folder = format!("{folder}/{}", entry.file_name().to_string_lossy());
                add(&folder, &of_lab);
                add(&folder, &of_staff);
            }
        }
    }
    found
}

fn text_of(path: &str) -> String {
    std::fs::read_to_string(root().join(path)).unwrap_or_else(|error| panic!("{path}: {error}"))
}

/// A course as docs/ta-guide.md has it.
fn course() -> String {
    let guide = text_of("docs/ta-guide.md");
    let (_, rest) = guide.split_once("```toml\n").expect("a block of TOML");
    let (course, _) = rest.split_once("```").expect("its end");
    course.to_owned()
}

#[test]
fn the_published_schemas_are_those_of_the_code() {
    let files: Vec<_> = KINDS
        .iter()
        .map(|(kind, schema)| {
            let text = format!("{:#}\n", schema());
            (root().join(published(kind)), text)
        })
        .collect();
    are_current(&files);
}

#[test]
fn the_command_prints_and_writes_them() {
    let bed = TestBed::new();
    for (kind, _) in KINDS {
        let published = text_of(&published(kind));
        let printed = bed.run(&["lab", "schema", kind]);
        assert_eq!(printed.code, Some(0), "{}", printed.stderr);
        assert!(printed.stdout == published, "{kind}");
        let out = format!("{kind}.json");
        for _ in 0..2 {
            let written = bed.run(&["lab", "schema", kind, "--out", &out, "--json"]);
            assert_eq!((written.code, &*written.stdout), (Some(0), ""), "{kind}");
        }
        let there = std::fs::read_to_string(bed.path(&out)).expect("written");
        assert!(there == published, "{kind}");
    }
    let unknown = bed.run(&["lab", "schema", "hiden"]);
    assert_eq!(unknown.code, Some(2));
    assert!(unknown.stderr.contains("'hidden'"), "{}", unknown.stderr);
    let beyond = bed.run(&["lab", "schema", "lab", "--out", "lab.json/c.json"]);
    assert_eq!(beyond.code, Some(4), "{}", beyond.stderr);
}

#[test]
fn every_key_is_described() {
    fn look(schema: &Value, at: &str, bare: &mut Vec<String>) {
        if !schema.is_object() {
            return;
        }
        for (key, value) in schema["properties"].as_object().into_iter().flatten() {
            let at = format!("{at}/{key}");
            let text = value["description"].as_str().unwrap_or_default();
            // `true` and `false` stand where another part of the schema describes the key
            if value.is_object() && (!text.ends_with(['.', ')']) || text.contains('\\')) {
                bare.push(at.clone());
            }
            look(value, &at, bare);
        }
        for part in ["items", "additionalProperties"] {
            look(&schema[part], at, bare);
        }
        for option in schema["anyOf"].as_array().into_iter().flatten() {
            look(option, at, bare);
        }
    }
    let mut bare = Vec::new();
    for (kind, schema) in KINDS {
        look(&schema(), kind, &mut bare);
    }
    assert_eq!(bare, [""; 0]);
}

#[test]
fn everything_shipped_is_valid() {
    let shipped = shipped();
    assert!(shipped.len() > 30, "{shipped:?}");
    for (kind, path) in shipped {
        is_valid(kind, &path, &text_of(&path));
    }
    is_valid("course", "docs/ta-guide.md", &course());
}

/// A slip in a file: what is typed instead of what, where a schema refuses it, and what it says.
struct Slip {
    kind: &'static str,
    from: &'static str,
    to: &'static str,
    /// The path of the value that is refused.
    at: &'static str,
    says: &'static str,
}

const fn slip(
    kind: &'static str,
    from: &'static str,
    to: &'static str,
    at: &'static str,
    says: &'static str,
) -> Slip {
    Slip {
        kind,
        from,
        to,
        at,
        says,
    }
}

/// What people type, each in a shipped file of its kind.
const SLIPS: &[Slip] = &[
    slip(
        "lab",
        "format = 1",
        "format = 2",
        "/format",
        "1 was expected",
    ),
    slip(
        "lab",
        "format = 1\n",
        "",
        "",
        "\"format\" is a required property",
    ),
    slip(
        "lab",
        "summary =",
        "sumary =",
        "",
        "'sumary' was unexpected",
    ),
    slip(
        "lab",
        "robot = \"rrbot\"",
        "robot = 3",
        "/robot",
        "not of type \"string\"",
    ),
    slip(
        "lab",
        "right = [2.0, 1.4] ",
        "right = [2.0, \"1.4\"] ",
        "/parameters/right/1",
        "not of type \"number\"",
    ),
    slip(
        "lab",
        "step = 0.05 }, {",
        "stepp = 0.05 }, {",
        "/variants/right",
        "not valid under any",
    ),
    slip(
        "lab",
        "[tasks.function]\ncall = \"f",
        "[tasks.funktion]\ncall = \"f",
        "/tasks/0",
        "'funktion' was unexpected",
    ),
    slip(
        "lab",
        "[tasks.motion]",
        "[tasks.motion]\nmodus = 1",
        "/tasks/2/motion",
        "'modus' was unexpected",
    ),
    slip(
        "lab",
        "mode = \"position\"",
        "mode = \"positions\"",
        "/tasks/2/motion/mode",
        "is not one of",
    ),
    slip(
        "lab",
        "duration_s = 8.0",
        "duration_s = \"8.0\"",
        "/tasks/2/motion/duration_s",
        "does not match \"^=\"",
    ),
    slip(
        "lab",
        "duration_s = 8.0\n",
        "",
        "/tasks/2/motion",
        "\"duration_s\" is a required property",
    ),
    slip(
        "lab",
        "dwell_s = 0.5 },\n    {",
        "dwell = 0.5 },\n    {",
        "/tasks/2/motion/goals/0",
        "'dwell' was unexpected",
    ),
    slip(
        "lab",
        "kp = 100.0",
        "kq = 100.0",
        "/tasks/2/motion/servo",
        "'kq' was unexpected",
    ),
    slip(
        "lab",
        "q_rad = [0.7, -1.1]",
        "q_deg = [0.7, -1.1]",
        "/tasks/0/function/cases/4",
        "'q_deg' was unexpected",
    ),
    slip(
        "lab",
        "position_m = [6.0, 1.0, 0.05]",
        "position_m = [6.0, 1.0]",
        "/tasks/1/function/cases/13/position_m",
        "less than 3 items",
    ),
    slip(
        "lab",
        "points = 6.0",
        "points = \"six\"",
        "/tasks/0/checks/0/points",
        "does not match \"^=\"",
    ),
    slip(
        "lab",
        "points = 6.0\n",
        "",
        "/tasks/0/checks/0",
        "\"points\" is a required property",
    ),
    slip(
        "lab",
        "fk-error = { full_m",
        "fk-error = { full",
        "/tasks/0/checks/0/fk-error",
        "'full' was unexpected",
    ),
    slip(
        "lab",
        "fk-error = {",
        "fk-eror = {",
        "/tasks/0/checks/0",
        "'fk-eror' was unexpected",
    ),
    slip(
        "lab",
        "fk-error = { full_m = 1e-4, zero_m = 5e-3 }\n",
        "",
        "/tasks/0/checks/0",
        "not valid under any",
    ),
    slip(
        "lab",
        "ik-unreachable = {}",
        "ik-unreachable = {}\nik-reach = { full_m = 1e-3, zero_m = 1e-2 }",
        "/tasks/1/checks/2",
        "more than one of the schemas",
    ),
    slip(
        "lab",
        "ik-unreachable = {}",
        "pose-reached = { full_m = 1e-3, zero_m = 1e-2 }",
        "/tasks/1/checks/2/pose-reached",
        "False schema",
    ),
    slip(
        "lab",
        "ik-unreachable = {}",
        "fk-error = { full_m = 1e-3, zero_m = 1e-2 }",
        "/tasks/1/checks/2/fk-error",
        "False schema",
    ),
    slip(
        "lab",
        "joint-limits = { full_rad",
        "ik-reach = { full_rad",
        "/tasks/2/checks/4/ik-reach",
        "False schema",
    ),
    slip(
        "lab",
        "over = \"dwells\"",
        "over = \"dwell\"",
        "/tasks/2/checks/5/trajectory-match/over",
        "not one of",
    ),
    slip(
        "hidden",
        "count = 8",
        "count = -8",
        "/draws/0/count",
        "less than the minimum",
    ),
    slip(
        "hidden",
        "class = \"the arm",
        "klass = \"the arm",
        "/draws/0",
        "'klass' was unexpected",
    ),
    slip("hidden", "[[runs]]", "[[run]]", "", "'run' was unexpected"),
    slip(
        "mutants",
        "tasks = [\"fk\", \"ik\"]",
        "tasks = \"fk\"",
        "/mutants/0/tasks",
        "not of type \"array\"",
    ),
    slip(
        "accepted",
        "because =",
        "why =",
        "/accepted/0",
        "'why' was unexpected",
    ),
    slip(
        "robot",
        "type = \"revolute\"",
        "type = \"hinge\"",
        "/joints/0/type",
        "not one of",
    ),
    slip(
        "robot",
        "box = {",
        "cube = {",
        "/links/0/shapes/0",
        "'cube' was unexpected",
    ),
    slip(
        "robot",
        "{ mass_kg = 0.5 }",
        "{ mass = 0.5 }",
        "/links/1/inertia",
        "'mass' was unexpected",
    ),
    slip(
        "robot",
        "axis = [0.0, 1.0, 0.0]",
        "axis = [0.0, 1.0]",
        "/joints/0/axis",
        "less than 3 items",
    ),
    slip(
        "robot",
        "[[frames]]",
        "[[sensors]]\nname = \"eye\"\ntype = \"range-finder\"\nframe = \"tcp\"\n[[frames]]",
        "/sensors/0",
        "\"range_m\" is a required property",
    ),
    slip(
        "robot",
        "[[frames]]",
        "[[sensors]]\nname = \"end\"\ntype = \"joint-position\"\njoint = \"elbow\"\nlatch = true\n[[frames]]",
        "/sensors/0",
        "'latch' was unexpected",
    ),
    slip(
        "scene",
        "type = \"free\"",
        "type = \"loose\"",
        "/bodies/1/type",
        "is not one of",
    ),
    slip(
        "scene",
        "contact = { friction",
        "contact = { frition",
        "/bodies/0/contact",
        "'frition' was unexpected",
    ),
    slip("variant", "lab =", "labs =", "", "'labs' was unexpected"),
    slip(
        "variant",
        "l2 = 0.99",
        "l2 = \"= l1\"",
        "/parameters/l2",
        "does not match",
    ),
    slip(
        "course",
        "attempts = \"last\"",
        "attempts = \"latest\"",
        "/labs/0/attempts",
        "is not one of",
    ),
    slip("course", "[[labs]]", "[[lab]]", "", "'lab' was unexpected"),
];

/// The file into which a slip is typed.
fn right(kind: &str) -> String {
    match kind {
        "lab" => text_of("labs/01-kinematics/lab.toml"),
        "robot" => text_of("labs/robots/rrbot.toml"),
        "scene" => text_of("labs/scenes/shelf-and-can.toml"),
        "variant" => text_of("tests/fuzz/seeds/variant/04-knock-with-velocity.toml"),
        "course" => course(),
        _ => text_of(&format!("reference/01-kinematics/{kind}.toml")),
    }
}

impl Slip {
    /// The file with the slip, and the number of its line.
    fn typed(&self) -> (String, usize) {
        let right = right(self.kind);
        let at = right.find(self.from);
        let at = at.unwrap_or_else(|| panic!("{} has no {:?}", self.kind, self.from));
        let line = right[..at].matches('\n').count() + 1;
        (right.replacen(self.from, self.to, 1), line)
    }
}

#[test]
fn slips_are_refused_where_they_stand() {
    let mut wrong = Vec::new();
    for slip in SLIPS {
        let (text, _) = slip.typed();
        let refused = refusals(slip.kind, &text);
        let is_meant = |(at, says): &(String, String)| at == slip.at && says.contains(slip.says);
        // nothing else is underlined, but for what stands in the same place
        let is_alone = refused.iter().all(|(at, _)| at == slip.at);
        if !refused.iter().any(is_meant) || !is_alone {
            let refused: Vec<String> = refused
                .iter()
                .map(|(at, says)| format!("{at}: {}", says.chars().take(300).collect::<String>()))
                .collect();
            wrong.push(format!("{:?} -> {:?}: {refused:#?}", slip.from, slip.to));
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

/// A number may be an expression wherever Kinemark reads one, and nowhere else.
#[test]
fn expressions_are_numbers() {
    let lab = right("lab");
    for (from, to) in [
        ("q_rad = [0.7, -1.1]", "q_rad = \"= right\""),
        ("q_rad = [0.7, -1.1]", "q_rad = [\"= right[0]\", -1.1]"),
        ("points = 6.0", "points = \"= right[0]\""),
        (
            "branches = 0 },\n    { name = \"far",
            "branches = \"= left[0] - 2\" },\n    { name = \"far",
        ),
        ("kp = 100.0", "kp = \"= right\""),
        ("duration_s = 8.0", "duration_s = \"= 4 * right[0]\""),
    ] {
        assert!(lab.contains(from), "{from}");
        is_valid("lab", to, &lab.replacen(from, to, 1));
    }
    let robot = right("robot").replacen("damping = 0.7", "damping = \"link_offset * 2\"", 1);
    is_valid("robot", "damping", &robot);
    let hidden = right("hidden").replacen("count = 8", "count = \"= 8\"", 1);
    assert_eq!(refusals("hidden", &hidden)[0].0, "/draws/0/count");
}

/// What taplo says of a text as a file of a kind; its exit code first.
fn taplo(taplo: &Path, bed: &TestBed, kind: &str, text: &str) -> (bool, String) {
    let name = format!("{kind}.toml");
    bed.write(&name, text);
    let schema = root()
        .join(published(kind))
        .canonicalize()
        .expect("a schema");
    let said = Command::new(taplo)
        .args(["check", "--no-auto-config", "--colors", "never", "--schema"])
        .arg(format!("file://{}", schema.display()))
        .arg(bed.path(&name))
        .output()
        .expect("taplo runs");
    let text = String::from_utf8_lossy(&said.stderr).into_owned();
    (
        said.status.success(),
        text + String::from_utf8_lossy(&said.stdout).as_ref(),
    )
}

#[test]
fn taplo_agrees() {
    let Some(path) = std::env::var_os("KINEMARK_TAPLO") else {
        return;
    };
    let path = Path::new(&path);
    let bed = TestBed::new();
    let course = ("course", course());
    let files = shipped()
        .into_iter()
        .map(|(kind, path)| (kind, text_of(&path)));
    for (kind, text) in files.chain([course]) {
        let (passes, said) = taplo(path, &bed, kind, &text);
        assert!(passes, "{kind}: {said}");
    }
    for slip in SLIPS {
        let (text, line) = slip.typed();
        let (passes, said) = taplo(path, &bed, slip.kind, &text);
        assert!(!passes, "{:?}: {said}", slip.to);
        // what is missing is missed in the table, whose lines are listed one by one
        let lines = slip.to.matches('\n').count() + 1;
        let places = (line..line + lines).map(|line| format!("{}.toml:{line}:", slip.kind));
        let is_there = places.into_iter().any(|place| said.contains(&place));
        assert!(
            is_there || slip.to.is_empty(),
            "{:?}, line {line}: {said}",
            slip.to
        );
    }
}
