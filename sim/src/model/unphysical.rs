//! Mass properties that no body can have: what is wrong with them, what a reader makes of them, and the links of a robot that have
//! them. Kinematics needs no mass, so such a robot is read; whatever needs inertias refuses it.

use std::fmt;

use serde::{Deserialize, Serialize};

use super::inertia::{Inertia, principal_moments};
use crate::spatial::Symmetric3;

/// Of so many links each has a line in messages; the rest are counted.
const MOST_LISTED: usize = 20;

/// Why no body can have some mass properties.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
pub enum Unphysical {
    /// Less than no mass.
    #[error("the mass is negative ({mass_kg:?} kg)")]
    NegativeMass {
        /// The mass \[kg\].
        mass_kg: f64,
    },
    /// A tensor that turns some way with less than no inertia.
    #[error("the inertia tensor has a negative principal moment ({moment_kg_m2:.6e} kg m²)")]
    NegativeMoment {
        /// The least principal moment \[kg m²\].
        moment_kg_m2: f64,
    },
    /// The triangle inequality: a body's mass lies farther from any axis than from a plane through it.
    #[error(
        "principal moments {:.6e}, {:.6e}, {:.6e} kg m² break the triangle inequality: the largest exceeds the sum of the others",
        .moments_kg_m2[0], .moments_kg_m2[1], .moments_kg_m2[2]
    )]
    Triangle {
        /// The principal moments, least first \[kg m²\].
        moments_kg_m2: [f64; 3],
    },
}

impl Unphysical {
    /// The reason why no body of this mass can have this tensor about its centre of mass, if there is one: a negative principal
    /// moment, or one larger than the sum of the other two.
    ///
    /// Printed tensors are rounded, so one part in a billion of the largest moment is allowed, and so is the rounding of a point
    /// mass: that of a mass within a micrometre.
    pub fn tensor(tensor: &Symmetric3, mass_kg: f64) -> Option<Self> {
        let moments = principal_moments(tensor);
        let slack = 1e-9 * moments[2].abs() + 1e-12 * mass_kg.abs();
        if moments[0] < -slack {
            return Some(Self::NegativeMoment {
                moment_kg_m2: moments[0],
            });
        }
        (moments[2] > moments[0] + moments[1] + slack).then_some(Self::Triangle {
            moments_kg_m2: moments,
        })
    }

    /// The reason why no body can have these mass properties, if there is one: the mass is looked at first.
    pub fn inertia(inertia: &Inertia) -> Option<Self> {
        let mass_kg = inertia.mass_kg;
        if mass_kg < 0.0 {
            return Some(Self::NegativeMass { mass_kg });
        }
        Self::tensor(&inertia.about_com_kg_m2, mass_kg)
    }

    /// Whether it is the tensor alone, which [`OnUnphysical`] can treat.
    pub fn is_of_tensor(self) -> bool {
        !matches!(self, Self::NegativeMass { .. })
    }
}

/// What a reader makes of a tensor that no body can have. A negative mass always counts as [`OnUnphysical::Refuse`].
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
pub enum OnUnphysical {
    /// The robot is for kinematics only.
    #[default]
    Refuse,
    /// It is taken as it is.
    Accept,
    /// All three principal moments become their mean, so that it is that of a ball.
    ///
    /// Source: `balanceinertia` of MuJoCo (`mjCBody::Compile`), which refuses negative moments before; here a negative moment, which
    /// breaks the triangle inequality, too, is balanced where the mean is not negative.
    Balance,
}

/// The tensor with the mean of its principal moments in every direction; `None` where the mean is negative.
pub(crate) fn balanced(tensor: &Symmetric3) -> Option<Symmetric3> {
    // the trace is the sum of the principal moments in any axes
    let mean = (tensor.xx + tensor.yy + tensor.zz) / 3.0;
    (mean >= 0.0).then(|| Symmetric3 {
        xx: mean,
        yy: mean,
        zz: mean,
        ..Symmetric3::default()
    })
}

/// A link that no body can be.
#[derive(Debug, Clone, PartialEq)]
pub struct UnphysicalLink {
    /// Its name.
    pub name: String,
    /// The line of the description.
    pub line: usize,
    /// What is wrong.
    pub why: Unphysical,
}

/// The links of a robot whose mass properties no body can have: the reason why dynamics refuses it.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[error("the robot is for kinematics only: {}", self.words())]
pub struct UnphysicalLinks {
    pub(crate) links: Vec<UnphysicalLink>,
    /// What to do about tensors, as the format of the description has it.
    pub(crate) remedy: &'static str,
}

impl UnphysicalLinks {
    /// The links, in file order.
    pub fn links(&self) -> &[UnphysicalLink] {
        &self.links
    }

    /// All links with what is wrong and where, a line each, and what to do.
    pub(crate) fn words(&self) -> String {
        let mut text = match self.links.len() {
            1 => "no body can have the mass properties of 1 link".to_owned(),
            n => format!("no body can have the mass properties of {n} links"),
        };
        text += &listed(self.links.iter());
        if self.links.iter().any(|link| link.why.is_of_tensor()) {
            text.push('\n');
            text += self.remedy;
        }
        if self.links.iter().any(|link| !link.why.is_of_tensor()) {
            text += "\na negative mass has to be mended in the file";
        }
        text
    }
}

/// Links with what is wrong, each on a line of its own.
pub(crate) fn listed<'l>(links: impl ExactSizeIterator<Item = &'l UnphysicalLink>) -> String {
    let more = links.len().saturating_sub(MOST_LISTED);
    let mut text: String = links
        .take(MOST_LISTED)
        .map(|link| format!("\n  {link}"))
        .collect();
    if more > 0 {
        text += &format!("\n  and {more} more");
    }
    text
}

impl fmt::Display for UnphysicalLink {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        // a name of a size that only a broken file has
        let name: String = self.name.chars().take(60).collect();
        write!(f, "`{name}` (line {}): {}", self.line, self.why)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn diagonal(xx: f64, yy: f64, zz: f64) -> Symmetric3 {
        Symmetric3 {
            xx,
            yy,
            zz,
            ..Symmetric3::default()
        }
    }

    #[test]
    fn a_tensor_that_breaks_the_triangle_inequality_is_named() {
        let why = |zz| Unphysical::tensor(&diagonal(1.0, 1.0, zz), 1.0);
        let moments_kg_m2 = [1.0, 1.0, 2.5];
        assert_eq!(why(2.5), Some(Unphysical::Triangle { moments_kg_m2 }));
        assert_eq!(why(2.0), None);
    }

    #[test]
    fn what_a_point_mass_rounds_to_is_physical_and_a_micrometre_more_is_not() {
        // 2.4e-35 kg m² of 1 µg is the square of 2.4e-13 m
        assert_eq!(
            Unphysical::tensor(&diagonal(-2.4e-35, 0.0, 2.4e-35), 1e-9),
            None
        );
        let just_beyond = diagonal(-1.1e-12, 0.0, 1.1e-12);
        assert!(matches!(
            Unphysical::tensor(&just_beyond, 1.0),
            Some(Unphysical::NegativeMoment { .. })
        ));
        assert_eq!(Unphysical::tensor(&just_beyond, 3.0), None);
    }

    #[test]
    fn a_balanced_tensor_is_a_balls_with_the_same_trace() {
        // `body_inertia` of MuJoCo 4.0.0 with balanceinertia, fullinertia="0.001 0.002 0.01 0.0005 0 0": three times 0.00433333
        let published = Symmetric3 {
            xy: 0.0005,
            ..diagonal(0.001, 0.002, 0.01)
        };
        let mean = balanced(&published).expect("a positive mean");
        assert!((mean.xx - 0.004_333_33).abs() < 1e-8, "{mean:?}");
        assert_eq!(mean, diagonal(mean.xx, mean.xx, mean.xx));
        let tensor = Symmetric3 {
            xy: 0.3,
            yz: -0.2,
            ..diagonal(1.0, 1.0, 4.0)
        };
        assert_eq!(balanced(&tensor), Some(diagonal(2.0, 2.0, 2.0)));
        assert_eq!(balanced(&diagonal(1.0, 1.0, -3.0)), None);
    }

    #[test]
    fn many_links_are_counted_and_each_of_the_first_has_a_line() {
        let link = |i: usize| UnphysicalLink {
            name: format!("l{i}"),
            line: i,
            why: Unphysical::NegativeMass { mass_kg: -1.0 },
        };
        let links = UnphysicalLinks {
            links: (0..25).map(link).collect(),
            remedy: "REMEDY",
        };
        let text = links.to_string();
        assert!(text.contains("\n  `l19` (line 19): the mass is negative (-1.0 kg)\n  and 5 more"));
        assert!(!text.contains("REMEDY"), "{text}");
    }
}
