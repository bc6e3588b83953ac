//! Links in the order of a drawn tree, each with the lines that lead to it.

use kinemark_sim::model::robot::Robot;

/// One line of the tree.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) struct Branch {
    /// Index of the link.
    pub(super) link: usize,
    /// Index of the joint that moves it; none for the root.
    pub(super) joint: Option<usize>,
    /// What is drawn before its name.
    pub(super) lines: String,
}

/// A link that waits to be drawn.
struct Waiting {
    branch: Branch,
    /// What is drawn before the lines of its children.
    below: String,
}

/// All links, parents before children, children in file order. Without `stairs`, an only child stands right below its parent, so
/// that a long arm does not leave the page.
pub(super) fn branches(robot: &Robot, stairs: bool) -> Vec<Branch> {
    let mut children: Vec<Vec<usize>> = vec![Vec::new(); robot.links().len()];
    for (j, joint) in robot.joints().iter().enumerate() {
        children[joint.parent].push(j);
    }
    let root = Branch {
        link: 0,
        joint: None,
        lines: String::new(),
    };
    let mut waiting = vec![Waiting {
        branch: root,
        below: String::new(),
    }];
    let mut drawn = Vec::with_capacity(robot.links().len());
    while let Some(Waiting { branch, below }) = waiting.pop() {
        let joints = &children[branch.link];
        // the last goes onto the stack first, so that the first is drawn first
        for (k, &j) in joints.iter().enumerate().rev() {
            let (corner, beside) = match k + 1 == joints.len() {
                _ if joints.len() == 1 && !stairs => ("", ""),
                true => ("└─ ", "   "),
                false => ("├─ ", "│  "),
            };
            waiting.push(Waiting {
                branch: Branch {
                    link: robot.joints()[j].child,
                    joint: Some(j),
                    lines: format!("{below}{corner}"),
                },
                below: format!("{below}{beside}"),
            });
        }
        drawn.push(branch);
    }
    drawn
}
