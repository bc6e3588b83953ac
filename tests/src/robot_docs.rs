//! docs/robots.md, docs/robot-response.md and docs/robot-eval.md do what they say: their files are written, their commands run, their output is theirs.

use std::io::Write as _;
use std::process::Stdio;

use crate::golden::are_current;
use crate::testbed::{CommandResult, TestBed, root};

/// Runs `kinemark ARGS` or `echo 'TEXT' | kinemark ARGS`, as a shell would.
fn shell(bed: &TestBed, line: &str) -> CommandResult {
    let (input, command) = match line.split_once(" | ") {
        Some((echo, command)) => (
            echo.trim_start_matches("echo '").trim_end_matches('\''),
            command,
        ),
        None => ("", line),
    };
    let command = command
        .strip_prefix("kinemark ")
        .expect("a kinemark command");
    let mut args: Vec<&str> = Vec::new();
    for (i, part) in command.split('"').enumerate() {
        // every other part stood in quotes
        if i % 2 == 1 {
            args.push(part);
        } else {
            args.extend(part.split_whitespace());
        }
    }
    let mut child = bed
        .command(&args)
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .expect("runs");
    let mut stdin = child.stdin.take().expect("stdin");
    // a command that reads nothing has closed its end
    let _ = writeln!(stdin, "{input}");
    drop(stdin);
    child.wait_with_output().expect("ends").into()
}

#[test]
fn the_examples_of_the_robots_page_are_real() {
    assert!(examples_are_real("docs/robots.md") >= 10);
}

#[test]
fn the_examples_of_the_response_page_are_real() {
    assert!(examples_are_real("docs/robot-response.md") >= 5);
}

/// Runs the examples of a page and compares what they print; returns how many there are.
fn examples_are_real(page: &str) -> usize {
    let path = root().join(page);
    let page = std::fs::read_to_string(&path).expect("page");
    let bed = TestBed::new();
    let mut fresh = String::new();
    let mut examples = 0;
    for (i, part) in page.split("```").enumerate() {
        if i > 0 {
            fresh.push_str("```");
        }
        let (head, body) = part.split_once('\n').unwrap_or((part, ""));
        // every other part is the inside of a fence
        if i % 2 == 0 || head != "console" {
            if i % 2 == 1
                && let Some((_, file)) = head.split_once(' ')
            {
                bed.write(file, body);
            }
            fresh.push_str(part);
            continue;
        }
        let line = body
            .lines()
            .next()
            .and_then(|line| line.strip_prefix("$ "))
            .expect("a command");
        let ran = shell(&bed, line);
        assert_eq!(ran.code, Some(0), "{line}: {ran:?}");
        let said = format!("{}{}", ran.stderr, ran.stdout);
        fresh += &format!("console\n$ {line}\n{}\n", said.trim_end());
        examples += 1;
    }
    are_current(&[(path, fresh)]);
    examples
}

#[test]
fn the_answers_of_the_eval_page_are_real() {
    let path = root().join("docs/robot-eval.md");
    let page = std::fs::read_to_string(&path).expect("page");
    let mut fresh = String::new();
    let mut examples = 0;
    for (i, part) in page.split("```").enumerate() {
        if i > 0 {
            fresh.push_str("```");
        }
        // every other part is the inside of a fence
        let pair = part.strip_prefix("json\n").filter(|_| i % 2 == 1);
        let Some(request) = pair.and_then(|pair| pair.lines().next()) else {
            fresh.push_str(part);
            continue;
        };
        let robot = if request.contains("inverse_dynamics") {
            "uarm"
        } else {
            "rrbot"
        };
        let line = format!("echo '{request}' | kinemark robot eval {robot}");
        let ran = shell(&TestBed::new(), &line);
        fresh += &format!("json\n{request}\n{}\n", ran.stdout.trim_end());
        examples += 1;
    }
    assert!(examples >= 14, "{examples} examples");
    are_current(&[(path, fresh)]);
}
