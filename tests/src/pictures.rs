//! `--png` and `--storyboard`: the files are there, the same again, whole, and known to `verify`.

use crate::testbed::{OWN_LABS, TestBed, files_below, root};

/// Grades the known submission `case` of a lab with `args`, into `out`.
fn graded(bed: &TestBed, lab: &str, case: &str, args: &[&str], out: &str) -> String {
    let submission = root().join(format!("tests/submissions/{lab}/{case}/submission.rhai"));
    std::fs::copy(submission, bed.path("mine.rhai")).expect("copied");
    let ran = bed.run(&[&["grade", lab, "mine.rhai", "--out", out], args].concat());
    assert!(matches!(ran.code, Some(0 | 1)), "{ran:?}");
    assert_eq!(ran.stderr, OWN_LABS);
    ran.stdout
}

/// Width and height in the header of a PNG.
fn size(png: &[u8]) -> (u32, u32) {
    assert_eq!(&png[..8], b"\x89PNG\r\n\x1a\n");
    assert_eq!(&png[png.len() - 8..png.len() - 4], b"IEND", "it is whole");
    let number = |at: usize| u32::from_be_bytes([png[at], png[at + 1], png[at + 2], png[at + 3]]);
    (number(16), number(20))
}

#[test]
fn every_plot_has_a_png_beside_it_and_every_run_a_storyboard() {
    let bed = TestBed::new();
    bed.copy_labs();
    let both = ["--png", "--storyboard"];
    let output = graded(&bed, "02-jacobian-velocity", "twitches", &both, "out");
    assert!(
        output.ends_with(
            "\nstoryboard: out/line/storyboard.png\nstoryboard: out/through-the-shoulder/storyboard.png\n"
        ),
        "{output}"
    );
    let files = files_below(&bed.path("out"));
    let of = |wanted: &str| {
        let found = files.iter().find(|(name, _)| name == wanted);
        &found.unwrap_or_else(|| panic!("no {wanted}")).1
    };
    let mut pictures = 0;
    for (name, svg) in files.iter().filter(|(name, _)| name.ends_with(".svg")) {
        if name.starts_with("lab/") {
            continue;
        }
        let (width, height) = size(of(&name.replace(".svg", ".png")));
        // twice the size given in the SVG
        let head = String::from_utf8_lossy(&svg[..400]).into_owned();
        assert!(head.contains(&format!("width=\"{}\"", width / 2)), "{name}");
        let drawn = head
            .split("height=\"")
            .nth(1)
            .and_then(|rest| rest.split('"').next());
        let drawn: f64 = drawn
            .and_then(|number| number.parse().ok())
            .expect("a height");
        assert!((2.0 * drawn - f64::from(height)).abs() < 1.0, "{name}");
        pictures += 1;
    }
    assert!(pictures > 6, "{pictures}");
    // the same again, over the earlier report
    graded(&bed, "02-jacobian-velocity", "twitches", &both, "out");
    assert!(files_below(&bed.path("out")) == files, "other bytes");
    let ran = bed.run(&["verify", "out"]);
    assert_eq!(ran.code, Some(0), "{ran:?}");
    // another picture is found, whatever its report lists
    let path = "plots/line-path.png";
    let other = "line/storyboard.png";
    let list: serde_json::Value =
        serde_json::from_slice(of("report.json")).expect("the list of files");
    let digest = |path: &str| list["pixels"][path].as_str().expect("a digest");
    bed.write(&format!("out/{path}"), of(other));
    bed.edit("out/report.json", digest(path), digest(other));
    let ran = bed.run(&["verify", "out"]);
    assert_eq!(ran.code, Some(1), "{ran:?}");
    assert!(
        ran.stdout.contains(&format!("differs: file `{path}`")),
        "{ran:?}"
    );
    assert_eq!(ran.stdout.matches("differs: ").count(), 1, "{ran:?}");
    // other bytes of the same pixels are the same picture: another machine may write and round otherwise
    let text = b"\0\0\0\x05tEXtk\0abc\x8e5|u";
    let png = of(path);
    let (head, rest) = png.split_at(33);
    let same = [head, text, rest].concat();
    let others = [digest(other), &kinemark_report::output::digest(&same)];
    bed.write(&format!("out/{path}"), same);
    let ran = bed.run(&["verify", "out"]);
    assert_eq!(ran.code, Some(1), "{ran:?}");
    let list = format!("differs: digest of `{path}` in `report.json`");
    assert!(ran.stdout.contains(&list), "{ran:?}");
    let [of_other, of_same] = others;
    bed.edit(
        "out/report.json",
        &format!("\"{path}\": \"{of_other}\""),
        &format!("\"{path}\": \"{of_same}\""),
    );
    let ran = bed.run(&["verify", "out"]);
    assert_eq!(ran.code, Some(0), "{ran:?}");
    // one that was exchanged is found
    std::fs::copy(
        bed.path("out/line/storyboard.png"),
        bed.path("out/through-the-shoulder/storyboard.png"),
    )
    .expect("copied");
    std::fs::remove_file(bed.path("out/plots/line-path.png")).expect("removed");
    let ran = bed.run(&["verify", "out"]);
    assert_eq!(ran.code, Some(1), "{ran:?}");
    for file in ["through-the-shoulder/storyboard.png", "plots/line-path.png"] {
        assert!(ran.stdout.contains(&format!("file `{file}`")), "{ran:?}");
    }
    // without the options they are gone, and the rest is the same
    graded(&bed, "02-jacobian-velocity", "twitches", &[], "out");
    let plain = files_below(&bed.path("out"));
    assert!(!plain.iter().any(|(name, _)| name.ends_with(".png")));
    // but for the list of the files, and the page, which has the storyboard as chapters
    let rest = plain
        .iter()
        .filter(|(name, _)| name != "report.json" && name != "report.html");
    assert!(rest.into_iter().all(|file| files.contains(file)));
}

#[test]
fn a_storyboard_shows_where_points_were_lost_and_what_was_touched() {
    let bed = TestBed::new();
    bed.copy_labs();
    let lab = "03-knock-with-position";
    graded(&bed, lab, "wrong-side", &["--storyboard"], "out");
    let svg = std::fs::read_to_string(bed.path("out/knock/storyboard.svg")).expect("there");
    assert_eq!(svg.matches("<clipPath").count(), 6);
    assert!(svg.contains("href=\"../report.html#task=knock&amp;t="));
    assert!(svg.contains("touches"), "the storyboard shows contacts");
}

#[test]
fn a_run_that_stops_at_once_has_no_storyboard_of_an_arm_that_never_moved() {
    let bed = TestBed::new();
    bed.copy_labs();
    bed.write("mine.rhai", "fn control(o) { throw \"no\" }\n");
    let args = [
        "grade",
        "01-kinematics",
        "mine.rhai",
        "--storyboard",
        "--png",
    ];
    let ran = bed.run(&args);
    assert_eq!(ran.code, Some(1), "{ran:?}");
    for file in ["out/move/storyboard.svg", "out/move/storyboard.png"] {
        assert!(!bed.path(file).exists(), "{file}");
    }
    let none = "storyboard: none, because the arm moves in no task";
    assert!(ran.stdout.contains(none), "{}", ran.stdout);
}
