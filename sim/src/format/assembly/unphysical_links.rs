//! Which links have an inertia that no body can have, and what comes of each: it is refused to dynamics, taken as it is, or balanced.

use super::description::{Description, LinkPart};
use crate::model::robot::Link;
use crate::model::unphysical::{
    OnUnphysical, Unphysical, UnphysicalLink, UnphysicalLinks, balanced, listed,
};

/// What was found in the links of a robot.
#[derive(Debug, Default)]
pub(super) struct Settled {
    /// What dynamics refuses.
    pub(super) refused: Option<UnphysicalLinks>,
    pub(super) warnings: Vec<String>,
}

/// Looks at the inertia of every link, which already has its attachment, and balances those that should be.
///
/// A tensor that no joint moves changes no motion and is left alone.
pub(super) fn settle(parts: &Description, links: &mut [Link]) -> Settled {
    let (mut refused, mut accepted, mut balanced_links) = (Vec::new(), Vec::new(), Vec::new());
    for (part, link) in parts.links.iter().zip(links) {
        let Some(given) = &part.given_inertia else {
            continue;
        };
        let Some(why) = Unphysical::inertia(&link.inertia) else {
            continue;
        };
        if why.is_of_tensor() && link.attachment.body.is_none() {
            continue;
        }
        let found = found(parts, part, given.at.start, why);
        match (given.on_unphysical, balanced(&link.inertia.about_com_kg_m2)) {
            (OnUnphysical::Accept, _) if why.is_of_tensor() => accepted.push(found),
            (OnUnphysical::Balance, Some(tensor)) if why.is_of_tensor() => {
                link.inertia.about_com_kg_m2 = tensor;
                balanced_links.push(found);
            }
            _ => refused.push(found),
        }
    }
    let mut settled = Settled::default();
    if parts.unphysical.lists_treated {
        for (links, what) in [
            (
                &accepted,
                "tensors that no body can have are taken as they are:",
            ),
            (
                &balanced_links,
                "tensors that no body can have are balanced, all three principal moments become their mean:",
            ),
        ] {
            if !links.is_empty() {
                settled
                    .warnings
                    .push(format!("{what}{}", listed(links.iter())));
            }
        }
    }
    if !refused.is_empty() {
        let refused = UnphysicalLinks {
            links: refused,
            remedy: parts.unphysical.remedy,
        };
        settled.warnings.push(format!(
            "{}\nuntil then this robot is for kinematics only: dynamics and simulation refuse it",
            refused.words()
        ));
        settled.refused = Some(refused);
    }
    settled
}

fn found(parts: &Description, part: &LinkPart, at: usize, why: Unphysical) -> UnphysicalLink {
    UnphysicalLink {
        name: part.name.get_ref().clone(),
        line: parts.source.line_and_column(at).0,
        why,
    }
}
