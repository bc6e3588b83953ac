//! `kinemark view`: a report over HTTP, for this machine alone.

use crate::testbed::{Serving, TestBed};

/// A bed with the starter of lab 1, graded into `folder`.
fn graded(folder: &str) -> TestBed {
    let bed = TestBed::new();
    assert_eq!(bed.run(&["new", "00-step-response", "mine"]).code, Some(0));
    let ran = bed.run(&[
        "grade",
        "00-step-response",
        "mine/submission.rhai",
        "--out",
        folder,
    ]);
    assert_eq!(ran.code, Some(1), "{ran:?}");
    bed
}

#[test]
fn a_report_is_served_read_only_and_nothing_beside_it() {
    let bed = graded("out");
    bed.write("secret.txt", "secret");
    bed.write("out/.hidden", "secret");
    #[cfg(unix)]
    std::os::unix::fs::symlink("../secret.txt", bed.path("out/link.txt")).expect("a link");
    let (serving, _) = Serving::start(&bed, &["view", "out", "--no-open"]);

    let start = serving.get("/");
    assert_eq!(start.code, 307, "{start:?}");
    assert!(start.head.contains("location: report.html"), "{start:?}");
    let page = serving.get("/report.html");
    assert_eq!(page.code, 200);
    for line in [
        "content-type: text/html; charset=utf-8",
        "cache-control: no-store",
        "x-content-type-options: nosniff",
        // of its own origin, which is nobody's: it can read nothing beside it, and ask nobody
        "content-security-policy: sandbox allow-scripts; default-src 'none'",
    ] {
        assert!(page.head.contains(line), "{line}: {}", page.head);
    }
    assert!(!page.head.contains("connect-src") && !page.head.contains("allow-same-origin"));
    let on_disk = std::fs::read_to_string(bed.path("out/report.html")).expect("a report");
    assert!(page.body == on_disk, "the page is served as it is");
    for (path, kind) in [
        ("/grade.json", "application/json"),
        ("/submission.rhai", "text/plain; charset=utf-8"),
        ("/warm-up/run.mcap", "application/octet-stream"),
        ("/plots/warm-up-joints.svg", "image/svg+xml"),
    ] {
        let answer = serving.get(path);
        assert_eq!(answer.code, 200, "{path}");
        assert!(
            answer.head.contains(&format!("content-type: {kind}")),
            "{answer:?}"
        );
    }
    for path in [
        "/nothing",
        "/.hidden",
        "/link.txt",
        "/plots",
        "/plots/",
        "/../secret.txt",
        "/%2e%2e/secret.txt",
        "/..%2fsecret.txt",
        "/plots/%2e%2e/%2e%2e/secret.txt",
        "//etc/passwd",
        "/%2fetc%2fpasswd",
        "/..%5csecret.txt",
        "/report.html%00",
        "/kinemark/changes",
    ] {
        let answer = serving.get(path);
        assert_eq!(answer.code, 404, "{path} {answer:?}");
        assert!(!answer.body.contains("secret"), "{path}");
    }

    // nothing is written, and no other site is answered
    let (host, root) = (&serving.host, &serving.root);
    for method in ["POST", "PUT", "DELETE", "OPTIONS"] {
        let answer = serving.ask(&format!(
            "{method} {root}/report.html HTTP/1.1\r\nHost: {host}\r\n"
        ));
        assert_eq!(answer.code, 405, "{answer:?}");
    }
    let head = serving.ask(&format!(
        "HEAD {root}/report.html HTTP/1.1\r\nHost: {host}\r\n"
    ));
    assert_eq!((head.code, head.body.as_str()), (200, ""));
    let length = format!("content-length: {}", on_disk.len());
    assert!(head.head.contains(&length), "{head:?}");
    for name in ["evil.example", "127.0.0.1:1", "localhost.evil.example"] {
        let answer = serving.ask(&format!(
            "GET {root}/report.html HTTP/1.1\r\nHost: {name}\r\n"
        ));
        assert_eq!(answer.code, 421, "{answer:?}");
        assert!(answer.head.contains("nosniff"), "{answer:?}");
    }
    let port = host.rsplit(':').next().expect("a port");
    let answer = serving.ask(&format!(
        "GET {root}/grade.json HTTP/1.1\r\nHost: localhost:{port}\r\n"
    ));
    assert_eq!(answer.code, 200);
    // who was not given the address reads nothing
    for root in [
        "",
        "/",
        &root[..root.len() - 1],
        &format!("{root}0"),
        &root.to_uppercase(),
    ] {
        for path in ["/", "/report.html", "/grade.json", "/nothing"] {
            let answer = serving.get_from(root, path);
            assert_eq!(answer.code, 403, "{root}{path} {answer:?}");
            assert!(answer.body.contains("Open the whole address"), "{answer:?}");
            assert!(answer.head.contains("nosniff"), "{answer:?}");
        }
    }
    // a port that is in use is reported
    let ran = bed.run(&["view", "out", "--no-open", "--port", port]);
    assert_eq!(ran.code, Some(2), "{ran:?}");
    assert!(ran.stderr.contains("is taken"), "{ran:?}");
    #[cfg(unix)]
    assert_eq!(serving.stop(), Some(0));
}

#[test]
fn several_reports_are_listed_with_what_they_earned() {
    let bed = graded("all/s1 <b>");
    bed.write("all/broken/report.html", "<p>");
    let record = std::fs::read(bed.path("all/s1 <b>/grade.json")).expect("a record");
    let mut record: serde_json::Value = serde_json::from_slice(&record).expect("JSON");
    for (folder, points) in [("most", 1e308), ("more", 30.0)] {
        record["points"] = points.into();
        bed.write(&format!("all/{folder}/report.html"), "<p>");
        bed.write(&format!("all/{folder}/grade.json"), record.to_string());
    }
    bed.write("all/empty/file", "");
    let (serving, _) = Serving::start(&bed, &["view", "all", "--no-open"]);
    let list = serving.get("/");
    assert_eq!(list.code, 200, "{list:?}");
    assert!(
        list.body.contains("script-src 'sha256-"),
        "a list runs the script that sorts it, and nothing else"
    );
    let shown = list.body.split("<body>").nth(1).expect("a body");
    assert!(list.body.contains("1 of 30"), "{list:?}");
    // points that cannot be those of a grade are not shown as earned
    let changed = list
        .body
        .matches("changed: its points contradict each other");
    assert_eq!(changed.count(), 2, "{list:?}");
    assert!(list.body.contains("<td>practice</td>"), "{list:?}");
    assert!(!shown.contains(">inf") && !shown.contains("30 of 30"));
    assert!(
        !shown.contains("<b>") && !shown.contains("/empty/"),
        "{list:?}"
    );
    assert!(list.body.contains("its record cannot be read"), "{list:?}");
    let folder = "/s1%20%3Cb%3E";
    let page = format!("{folder}/report.html");
    assert_eq!(serving.get(&page).code, 200);
    // its picture has the report's own address, too
    let pictures = list.body.split("<img src=\"").skip(1);
    let pictures: Vec<&str> = pictures.filter_map(|rest| rest.split('"').next()).collect();
    let [picture] = pictures.as_slice() else {
        panic!("one report of five has a picture: {pictures:?}")
    };
    let (own, file) = picture.split_at(picture.find("/s1").expect("the report"));
    // of the motion tasks the one that lost most
    let lost = |task: &&serde_json::Value| {
        let number = |key: &str| task[key].as_f64().expect(key);
        (100.0 * (number("max_points") - number("points"))).round() as i64
    };
    let tasks = record["tasks"].as_array().expect("tasks").iter();
    let motions = tasks.filter(|task| task["kind"] == "motion");
    let most = motions.max_by_key(lost).expect("a motion");
    let name = most["name"].as_str().expect("a name");
    assert_eq!(file, format!("/s1%20%3Cb%3E/plots/{name}-path.svg"));
    let got = serving.get_from(own, file);
    assert!(got.code == 200 && got.body.starts_with("<svg"), "{got:?}");
    // a page that somebody sent knows its own address: it opens nothing else
    let links = list.body.split("href=\"").skip(1);
    let mut links = links.filter_map(|link| link.split('"').next());
    let own = links.find_map(|link| link.strip_suffix(&page));
    let own = own.expect("a link to it");
    assert_ne!(own, serving.root);
    assert_eq!(serving.get_from(own, &page).code, 200);
    assert_eq!(
        serving.get_from(own, &format!("{folder}/grade.json")).code,
        200
    );
    for path in ["/", "/broken/report.html", "/most/grade.json"] {
        assert_eq!(serving.get_from(own, path).code, 403, "{path}");
    }
}

#[test]
fn what_holds_no_report_is_refused() {
    let bed = TestBed::new();
    assert_eq!(bed.run(&["view", "nowhere", "--no-open"]).code, Some(2));
    bed.write("folder/file", "");
    let ran = bed.run(&["view", "folder", "--no-open"]);
    assert_eq!(ran.code, Some(3), "{ran:?}");
    assert!(ran.stderr.contains("contains no report"), "{ran:?}");
}

/// Pipes and devices in place of a report's files: a page that is none, and a record that never ends.
#[cfg(target_os = "linux")]
#[test]
fn what_never_ends_is_not_waited_for() {
    let bed = graded("all/good");
    for folder in ["all/pipe", "all/endless", "out"] {
        std::fs::create_dir_all(bed.path(folder)).expect("a folder");
    }
    let pipe = |name: &str| {
        let made = std::process::Command::new("mkfifo")
            .arg(bed.path(name))
            .status();
        assert!(made.expect("mkfifo runs").success());
    };
    pipe("all/pipe/report.html");
    bed.write("all/endless/report.html", "");
    std::os::unix::fs::symlink("/dev/zero", bed.path("all/endless/grade.json")).expect("a link");
    pipe("out/grade.json");
    let (serving, _) = Serving::start(&bed, &["view", "all", "--no-open"]);
    let list = serving.get("/");
    assert!(list.body.contains("1 of 30"), "{list:?}");
    assert!(list.body.contains("/endless/report.html"), "{list:?}");
    assert!(!list.body.contains("/pipe/"), "{list:?}");
    assert_eq!(serving.get("/pipe/report.html").code, 404);
    assert_eq!(serving.get("/endless/grade.json").code, 404);
    assert_eq!(serving.stop(), Some(0));
    // the same files where other commands read reports
    let mine = "mine/submission.rhai";
    let ran = bed.run(&["grade", "01-kinematics", mine, "--out", "out"]);
    assert_eq!(ran.code, Some(2), "{ran:?}");
    for args in [&["verify", "out"][..], &["compare", "all/good", "out"]] {
        let ran = bed.run(args);
        assert_eq!(ran.code, Some(3), "{args:?} {ran:?}");
    }
    std::fs::remove_file(bed.path("all/good/report.html")).expect("removed");
    pipe("all/good/report.html");
    let ran = bed.run(&["verify", "all/good", "--practice"]);
    assert_eq!(ran.code, Some(1), "{ran:?}");
    assert!(ran.stdout.contains("file `report.html`"), "{ran:?}");
}

#[test]
fn a_program_gets_folder_and_address_as_json() {
    let bed = graded("out");
    let (serving, lines) = Serving::start(&bed, &["view", "out", "--no-open", "--json"]);
    let line: serde_json::Value = serde_json::from_str(&lines[0]).expect("JSON");
    let address = format!("http://{}{}/", serving.host, serving.root);
    assert!(serving.root.len() > 16, "{address}");
    assert_eq!(
        line,
        serde_json::json!({ "format": 1, "folder": "out", "address": address })
    );
    assert_eq!(serving.get("/report.html").code, 200);
}
