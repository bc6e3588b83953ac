//! The instructor's guide, followed word by word in an empty folder: its files are written, its mutants made, its commands run, and what
//! the page says they print is compared.

use crate::testbed::{TestBed, root};

/// What the page asks its reader to do, in order.
#[derive(Debug)]
enum Step {
    /// To write a file.
    Write { path: String, text: String },
    /// To copy the solution under this name, with one place changed.
    Mutate {
        name: String,
        from: String,
        to: String,
    },
    /// To run a command, which prints these lines in this order; `...` stands for any.
    Run {
        command: String,
        printed: Vec<String>,
    },
}

/// The text between two backticks that begins after so many of them.
fn quoted(line: &str, which: usize) -> String {
    line.split('`')
        .nth(2 * which + 1)
        .unwrap_or_else(|| panic!("no quotes in {line}"))
        .to_owned()
}

fn steps(page: &str) -> Vec<Step> {
    let mut steps = Vec::new();
    let mut lines = page.lines();
    let mut path = None;
    while let Some(line) = lines.next() {
        if line.starts_with("Write `") {
            path = Some(quoted(line, 0));
        } else if let Some(language) = line.strip_prefix("```") {
            let block: Vec<&str> = lines.by_ref().take_while(|line| *line != "```").collect();
            if language == "console" {
                let mut block = block.into_iter();
                let command = block
                    .next()
                    .and_then(|line| line.strip_prefix("$ kinemark "));
                steps.push(Step::Run {
                    command: command.expect("a command").to_owned(),
                    printed: block.map(str::to_owned).collect(),
                });
            } else {
                let path = path
                    .take()
                    .unwrap_or_else(|| panic!("nobody says where {block:?} goes"));
                let text = block.join("\n") + "\n";
                steps.push(Step::Write { path, text });
            }
        } else if line.starts_with("| `") {
            let [name, from, to] = [0, 1, 2].map(|which| quoted(line, which));
            steps.push(Step::Mutate { name, from, to });
        }
    }
    steps
}

/// Whether `printed` are the lines of `output`, where `...` stands for any lines.
fn is_printed(output: &[&str], printed: &[String]) -> bool {
    match printed.split_first() {
        None => output.is_empty(),
        Some((first, rest)) if first == "..." => {
            (0..=output.len()).any(|skipped| is_printed(&output[skipped..], rest))
        }
        Some((first, rest)) => {
            output.first() == Some(&first.as_str()) && is_printed(&output[1..], rest)
        }
    }
}

#[test]
fn the_guide_leads_to_a_lab_that_can_be_handed_out() {
    let page = std::fs::read_to_string(root().join("docs/instructor-guide.md")).expect("the guide");
    let steps = steps(&page);
    let bed = TestBed::new();
    let (mut written, mut mutated, mut ran) = (0, 0, 0);
    for step in &steps {
        match step {
            Step::Write { path, text } => {
                bed.write(path, text);
                written += 1;
            }
            Step::Mutate { name, from, to } => {
                let solution =
                    std::fs::read_to_string(bed.path("reference/20-holding/solution.rhai"));
                let solution = solution.expect("a solution");
                assert_eq!(solution.matches(from).count(), 1, "{name}: {from}");
                let mutant = solution.replace(from, to);
                bed.write(
                    &format!("reference/20-holding/mutants/{name}.rhai"),
                    &mutant,
                );
                mutated += 1;
            }
            Step::Run { command, printed } => {
                let arguments: Vec<&str> = command.split_whitespace().collect();
                let result = bed.run(&arguments);
                assert_eq!(result.code, Some(0), "{command}: {result:?}");
                let output: Vec<&str> = result.stdout.lines().collect();
                assert!(
                    is_printed(&output, printed),
                    "{command} prints\n{}",
                    result.stdout
                );
                ran += 1;
            }
        }
    }
    // a page that is read otherwise than it is meant would have nothing to follow
    assert_eq!((written, mutated, ran), (6, 6, 5), "{steps:?}");
    let archive = bed.path("20-holding-students.zip");
    assert!(archive.exists());
}
