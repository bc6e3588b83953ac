//! The order of the joints from the root outwards, or why the links are no tree.

use super::assembler::Assembler;
use crate::format::robot_problem::{RobotError, RobotProblem};
use crate::model::robot::Joint;

impl Assembler<'_> {
    /// The joints from the root outwards, each after the joint that carries its parent; siblings in file order.
    pub(crate) fn order(&self, joints: &[Joint]) -> Result<Vec<usize>, RobotError> {
        let parts = self.parts;
        let link_name = |link: usize| parts.links[link].name.get_ref().clone();
        let mut carrier: Vec<Option<usize>> = vec![None; parts.links.len()];
        for (j, joint) in joints.iter().enumerate() {
            let child_at = parts.joints[j].child.span();
            if joint.child == 0 {
                let link = link_name(0);
                return self.err(child_at, RobotProblem::RootIsChild { link });
            }
            if let Some(first) = carrier[joint.child] {
                return self.err(
                    child_at,
                    RobotProblem::TwoParents {
                        link: link_name(joint.child),
                        first: joints[first].name.clone(),
                        second: joint.name.clone(),
                    },
                );
            }
            carrier[joint.child] = Some(j);
        }
        let mut order = Vec::with_capacity(joints.len());
        let mut reached = vec![false; parts.links.len()];
        let mut waiting = vec![0];
        while let Some(link) = waiting.pop() {
            reached[link] = true;
            if let Some(j) = carrier[link] {
                order.push(j);
            }
            let children = joints.iter().filter(|joint| joint.parent == link);
            waiting.extend(children.map(|joint| joint.child).rev());
        }
        match reached.iter().position(|reached| !reached) {
            None => Ok(order),
            Some(link) => match carrier[link] {
                None => self.err(
                    parts.links[link].name.span(),
                    RobotProblem::Detached {
                        link: link_name(link),
                        root: link_name(0),
                    },
                ),
                Some(start) => self.unreached(joints, &carrier, start),
            },
        }
    }

    /// A link that is carried but not reached: its chain ends in the air or in itself.
    fn unreached(
        &self,
        joints: &[Joint],
        carrier: &[Option<usize>],
        start: usize,
    ) -> Result<Vec<usize>, RobotError> {
        let parts = self.parts;
        let mut joint = start;
        for _ in 0..joints.len() {
            match carrier[joints[joint].parent] {
                Some(up) => joint = up,
                None => {
                    let link = joints[joint].parent;
                    return self.err(
                        parts.links[link].name.span(),
                        RobotProblem::Detached {
                            link: parts.links[link].name.get_ref().clone(),
                            root: parts.links[0].name.get_ref().clone(),
                        },
                    );
                }
            }
        }
        self.err(
            parts.joints[joint].name.span(),
            RobotProblem::Cycle {
                joint: joints[joint].name.clone(),
                link: parts.joints[joint].child.get_ref().clone(),
            },
        )
    }
}
