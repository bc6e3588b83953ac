//! Dependencies point one way: an arrow that is not drawn in docs/architecture.md fails here.

use std::collections::BTreeSet;

use cargo_metadata::DependencyKind;

#[test]
fn crates_depend_on_each_other_as_drawn() {
    let manifest = crate::testbed::root().join("Cargo.toml");
    let metadata = cargo_metadata::MetadataCommand::new()
        .manifest_path(manifest)
        .no_deps()
        .other_options(vec!["--offline".to_owned()])
        .exec()
        .expect("cargo metadata");
    let ours: BTreeSet<String> = metadata
        .packages
        .iter()
        .map(|p| p.name.to_string())
        .collect();
    let (mut arrows, mut of_tests) = (BTreeSet::new(), BTreeSet::new());
    for package in &metadata.packages {
        // tests may see everything
        if package.name.starts_with("kinemark-tests") {
            continue;
        }
        for dependency in &package.dependencies {
            if ours.contains(&dependency.name) {
                let arrow = format!("{} -> {}", package.name, dependency.name);
                if dependency.kind == DependencyKind::Development {
                    of_tests.insert(arrow);
                } else {
                    arrows.insert(arrow);
                }
            }
        }
    }
    // tests may use a dependency of their crate with more features
    let more = of_tests.difference(&arrows).cloned();
    assert_eq!(
        more.collect::<Vec<_>>(),
        ["kinemark-sim -> kinemark-reference"]
    );
    let drawn: BTreeSet<String> = [
        "kinemark -> kinemark-course",
        "kinemark -> kinemark-grader",
        "kinemark -> kinemark-report",
        "kinemark -> kinemark-sim",
        "kinemark -> kinemark-toolbox",
        "kinemark-course -> kinemark-grader",
        "kinemark-course -> kinemark-report",
        "kinemark-course -> kinemark-sim",
        "kinemark-grader -> kinemark-python-wire",
        "kinemark-grader -> kinemark-sim",
        "kinemark-toolbox -> kinemark-sim",
        "kinemark-report -> kinemark-grader",
        "kinemark-report -> kinemark-sim",
    ]
    .into_iter()
    .map(str::to_owned)
    .collect();
    assert_eq!(arrows, drawn);
}

/// Reports are made from records and traces: of the grader they know nothing else, and no lab.
#[test]
fn reports_are_made_from_the_record() {
    let folder = crate::testbed::root().join("grader/report/src");
    let mut uses = 0;
    for (name, source) in crate::testbed::files_below(&folder) {
        let source = String::from_utf8_lossy(&source);
        let mut parts = source.split("kinemark_grader");
        parts.next();
        for part in parts {
            assert!(
                part.starts_with("::record::"),
                "grader/report/src/{name} reaches for `kinemark_grader{}`",
                part.lines().next().unwrap_or_default()
            );
            uses += 1;
        }
    }
    assert!(uses > 20, "{uses} uses: the sources are elsewhere");
}
