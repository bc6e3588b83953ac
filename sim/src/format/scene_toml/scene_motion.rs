//! How a body of a scene file starts and moves: a velocity, or the law of a kinematic body.

use std::ops::Range;

use nalgebra::Vector3;

use super::scene_problem::{SceneError, SceneProblem};
use super::scene_reader::Resolver;
use super::scene_tables::{BodyTable, MotionTable, WaypointTable};
use crate::model::prescribed_motion::{Motion, Waypoint};
use crate::part::part_tables::NumberAt;
use crate::part::values::Allowed;
use crate::spatial::{Pose, Twist, pose, rotation_from_rpy_deg};
use crate::text::Spanned;

impl Resolver<'_> {
    pub(crate) fn velocity(&self, table: &BodyTable) -> Result<Twist, SceneError> {
        match &table.velocity {
            None => Ok(Twist::zero()),
            Some(velocity) => {
                let velocity = velocity.get_ref();
                self.twist(&velocity.linear_m_s, &velocity.angular_rad_s)
            }
        }
    }

    fn twist(
        &self,
        linear: &Option<[NumberAt; 3]>,
        angular: &Option<[NumberAt; 3]>,
    ) -> Result<Twist, SceneError> {
        let read = |numbers: &Option<[NumberAt; 3]>, what| match numbers {
            Some(numbers) => self.values.vector(numbers, what),
            None => Ok(Vector3::zeros()),
        };
        Ok(Twist {
            linear: read(linear, "linear_m_s")?,
            angular: read(angular, "angular_rad_s")?,
        })
    }

    pub(crate) fn motion(
        &self,
        body: &str,
        table: &Spanned<MotionTable>,
        origin_at: Option<Range<usize>>,
        start: Pose,
    ) -> Result<Motion, SceneError> {
        let MotionTable {
            linear_m_s,
            angular_rad_s,
            waypoints,
            repeat,
        } = table.get_ref();
        let steady = linear_m_s.is_some() || angular_rad_s.is_some();
        let waypoints = match (waypoints, repeat) {
            (Some(waypoints), _) if !steady => waypoints,
            (None, None) if steady => {
                return Ok(Motion::steady(
                    start,
                    self.twist(linear_m_s, angular_rad_s)?,
                ));
            }
            _ => {
                return self.refuse_motion(
                    table.span(),
                    format!("the motion of body `{body}` is half said, or said twice"),
                    "say either `linear_m_s` and `angular_rad_s`, or `waypoints` and `repeat`",
                );
            }
        };
        if let Some(at) = origin_at {
            return self.refuse_motion(
                at,
                format!("body `{body}` has an origin and waypoints"),
                "leave `origin` out: the first waypoint says where it starts",
            );
        }
        let points = self.points(waypoints)?;
        let repeat = repeat.as_ref();
        self.check_return(body, &points, repeat)?;
        let repeat = repeat.is_some_and(|repeat| *repeat.get_ref());
        let times_s: Vec<f64> = points.iter().map(|point| point.time_s).collect();
        let Some(motion) = Motion::through(points, repeat) else {
            return self.refuse_motion(
                table.span(),
                format!("the motion of body `{body}` needs at least two waypoints"),
                "add a waypoint, or make the body `fixed`",
            );
        };
        for (time_s, table) in times_s.into_iter().zip(waypoints) {
            let (_, twist) = motion.at(time_s);
            self.values
                .within(table.span(), "speed from here on", twist.linear.as_slice())?;
            self.values.within(
                table.span(),
                "speed of turning from here on",
                twist.angular.as_slice(),
            )?;
        }
        Ok(motion)
    }

    fn refuse_motion<T>(
        &self,
        at: Range<usize>,
        message: String,
        help: &str,
    ) -> Result<T, SceneError> {
        let help = help.to_owned();
        self.err(at, SceneProblem::Motion { message, help })
    }

    /// Waypoints in the world, each later than the one before it: between two at the same time the speed would have no bound.
    fn points(&self, waypoints: &[Spanned<WaypointTable>]) -> Result<Vec<Waypoint>, SceneError> {
        let points = waypoints
            .iter()
            .map(|point| self.waypoint(point))
            .collect::<Result<Vec<_>, _>>()?;
        for (pair, table) in points.windows(2).zip(waypoints.iter().skip(1)) {
            let (before, after) = (pair[0].time_s, pair[1].time_s);
            if before >= after {
                return self.refuse_motion(
                    table.span(),
                    format!("waypoint at {after} s does not come after the one at {before} s"),
                    "put the waypoints in the order of their times",
                );
            }
        }
        Ok(points)
    }

    /// A motion that repeats ends where it began, to the last bit: what it presses on would feel any jump as an endless speed.
    fn check_return(
        &self,
        body: &str,
        points: &[Waypoint],
        repeat: Option<&Spanned<bool>>,
    ) -> Result<(), SceneError> {
        if let (Some(repeat), Some(first), Some(last)) = (repeat, points.first(), points.last())
            && *repeat.get_ref()
            && first.world_from_body != last.world_from_body
        {
            return self.refuse_motion(
                repeat.span(),
                format!("body `{body}` would jump from its last waypoint to its first"),
                "end with a waypoint at the place and rotation of the first",
            );
        }
        Ok(())
    }

    fn waypoint(&self, table: &Spanned<WaypointTable>) -> Result<Waypoint, SceneError> {
        let WaypointTable {
            t_s,
            xyz_m,
            rpy_deg,
        } = table.get_ref();
        let rpy_deg = match rpy_deg {
            Some(rpy) => self.values.triple(rpy, "rpy_deg")?,
            None => Vector3::zeros(),
        };
        Ok(Waypoint {
            time_s: self.values.number(t_s, "t_s", Allowed::NotNegative)?,
            world_from_body: pose(
                rotation_from_rpy_deg(rpy_deg.into()),
                self.values.vector(xyz_m, "xyz_m")?,
            ),
        })
    }
}

#[cfg(test)]
mod tests {
    use crate::format::SceneFile;
    use crate::text::Source;

    #[test]
    fn a_motion_without_waypoints_is_refused_at_its_place() {
        let text = "format = 1\nname = 's'\n[[bodies]]\nname = 'belt'\ntype = 'kinematic'\n\
            shapes = [{ sphere = { radius_m = 1 } }]\ncontact = { friction = 1 }\n\
            motion = { waypoints = [] }\n";
        let file = SceneFile::parse(Source::new("scene.toml", text)).unwrap();
        let error = file.build(&[]).unwrap_err();
        assert_eq!(
            error.to_string(),
            "the motion of body `belt` needs at least two waypoints"
        );
        // the table of the motion
        assert_eq!(error.line_and_column(), (8, 10));
    }
}
