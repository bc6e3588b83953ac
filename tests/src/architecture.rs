//! Dependencies point one way: an arrow that is not drawn in docs/architecture.md fails here.

use std::collections::BTreeSet;

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
    let mut arrows = BTreeSet::new();
    for package in &metadata.packages {
        // tests may see everything
        if package.name.starts_with("kinemark-tests") {
            continue;
        }
        for dependency in &package.dependencies {
            if ours.contains(&dependency.name) {
                arrows.insert(format!("{} -> {}", package.name, dependency.name));
            }
        }
    }
    let drawn: BTreeSet<String> = [
        "kinemark -> kinemark-grader",
        "kinemark -> kinemark-report",
        "kinemark -> kinemark-sim",
        "kinemark -> kinemark-toolbox",
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
