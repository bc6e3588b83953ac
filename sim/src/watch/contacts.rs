//! The contacts of a run: their parties, first and last ticks, forces and impulses.

use nalgebra::Vector3;

use super::event::EventKind;
use crate::model::contact::{ContactFact, Party};
use crate::step::hybrid::StepReport;

/// One contact of two parties, from its first to its last tick; pauses under 20 ms do not end it.
///
/// The values of a tick are those of the step that ended at it.
#[derive(Debug, Clone, PartialEq)]
pub struct ContactSpan {
    /// Both parties, the lesser first.
    pub parties: [Party; 2],
    /// The first tick at which they pressed.
    pub first_tick: u64,
    /// The last one.
    pub last_tick: u64,
    /// The greatest mean normal force over a step \[N\].
    pub peak_force_n: f64,
    /// The tick of the peak force.
    pub peak_tick: u64,
    /// Direction of the normal force on the second party at that tick, in the world: a unit vector, zero where the force has none. It is for
    /// pictures, and in no digest.
    pub peak_normal_in_world: Vector3<f64>,
    /// Sum of the normal impulses, never negative \[N s\].
    pub impulse_n_s: f64,
    /// Greatest penetration depth \[m\].
    pub depth_m: f64,
    /// Where they first pressed, in the world \[m\].
    pub p_first_in_world: Vector3<f64>,
}

impl ContactSpan {
    /// Feeds all fields to a digest.
    pub(crate) fn digest_into(&self, hasher: &mut blake3::Hasher) {
        for party in self.parties {
            let (kind, index) = party.numbers();
            hasher.update(&kind.to_le_bytes());
            hasher.update(&index.to_le_bytes());
        }
        for tick in [self.first_tick, self.last_tick, self.peak_tick] {
            hasher.update(&tick.to_le_bytes());
        }
        let p = &self.p_first_in_world;
        for value in [
            self.peak_force_n,
            self.impulse_n_s,
            self.depth_m,
            p.x,
            p.y,
            p.z,
        ] {
            hasher.update(&value.to_le_bytes());
        }
    }
}

#[derive(Debug, Clone)]
pub(super) struct ContactWatch {
    apart_ticks: u64,
    /// Indices into `spans` of the last contact of each pair that ever touched, in the order of the pairs.
    last: Vec<([Party; 2], usize)>,
    spans: Vec<ContactSpan>,
}

impl ContactWatch {
    pub(super) fn new(apart_ticks: u64) -> Self {
        Self {
            apart_ticks,
            last: Vec::new(),
            spans: Vec::new(),
        }
    }

    pub(super) fn observe(
        &mut self,
        tick: u64,
        report: &StepReport,
        emit: &mut impl FnMut(u64, EventKind),
    ) {
        for fact in &report.contacts {
            let parties = fact.parties;
            let begin = ContactSpan {
                parties,
                first_tick: tick,
                last_tick: tick,
                peak_force_n: fact.force_n,
                peak_tick: tick,
                peak_normal_in_world: normal(fact),
                impulse_n_s: 0.0,
                depth_m: 0.0,
                p_first_in_world: fact.p_centre_in_world,
            };
            let index = match self.last.binary_search_by_key(&parties, |(pair, _)| *pair) {
                Ok(at) => {
                    let index = &mut self.last[at].1;
                    if tick - self.spans[*index].last_tick > self.apart_ticks {
                        *index = self.spans.len();
                        self.spans.push(begin);
                    }
                    *index
                }
                Err(at) => {
                    emit(tick, EventKind::Touched { parties });
                    self.last.insert(at, (parties, self.spans.len()));
                    self.spans.push(begin);
                    self.spans.len() - 1
                }
            };
            let span = &mut self.spans[index];
            span.last_tick = tick;
            span.impulse_n_s += fact.impulse_n_s;
            span.depth_m = span.depth_m.max(fact.depth_m);
            if fact.force_n > span.peak_force_n {
                span.peak_force_n = fact.force_n;
                span.peak_tick = tick;
                span.peak_normal_in_world = normal(fact);
            }
        }
    }

    pub(super) fn finish(self) -> Vec<ContactSpan> {
        self.spans
    }
}

/// The direction of the normal force of a contact on its second party.
fn normal(fact: &ContactFact) -> Vector3<f64> {
    let size = fact.normal_impulse_n_s.norm();
    match size > 0.0 {
        true => fact.normal_impulse_n_s / size,
        false => Vector3::zeros(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::step::hybrid::StateFrom;

    fn report(forces_n: &[(usize, f64)]) -> StepReport {
        let fact = |&(body, force_n): &(usize, f64)| ContactFact {
            parties: [Party::Link(1), Party::Body(body)],
            impulse_n_s: force_n * 1e-3,
            normal_impulse_n_s: Vector3::x() * force_n * 1e-3,
            force_n,
            depth_m: force_n * 1e-6,
            points: 1,
            friction_impulse_n_s: Vector3::zeros(),
            moment_impulse_n_m_s: Vector3::zeros(),
            p_centre_in_world: Vector3::new(force_n, 0.0, 0.0),
        };
        StepReport {
            state_from: StateFrom::Contact,
            engine_stepped: true,
            contacts: forces_n.iter().map(fact).collect(),
            stops: Vec::new(),
            at_limit: Vec::new(),
        }
    }

    #[test]
    fn a_pause_parts_contacts_and_a_rattle_does_not() {
        let mut watch = ContactWatch::new(20);
        let mut touched = Vec::new();
        let mut observe = |watch: &mut ContactWatch, tick, forces: &[(usize, f64)]| {
            watch.observe(tick, &report(forces), &mut |tick, kind| {
                touched.push((tick, kind.name()));
            });
        };
        observe(&mut watch, 5, &[(3, 10.0)]);
        observe(&mut watch, 6, &[]);
        observe(&mut watch, 7, &[(0, 2.0), (3, 30.0)]);
        observe(&mut watch, 8, &[(3, 20.0)]);
        // 20 ticks apart is still the same contact, 21 are not
        observe(&mut watch, 28, &[(0, 1.0), (3, 1.0)]);
        let spans = watch.finish();
        assert_eq!(touched, [(5, "touched"), (7, "touched")]);
        let recorded: Vec<_> = spans
            .iter()
            .map(|span| (span.parties[1], span.first_tick, span.last_tick))
            .collect();
        assert_eq!(
            recorded,
            [
                (Party::Body(3), 5, 28),
                (Party::Body(0), 7, 7),
                (Party::Body(0), 28, 28)
            ]
        );
        assert_eq!((spans[0].peak_force_n, spans[0].peak_tick), (30.0, 7));
        assert!((spans[0].impulse_n_s - 0.061).abs() < 1e-15);
        assert_eq!(spans[0].depth_m, 30.0 * 1e-6);
        assert_eq!(spans[0].p_first_in_world.x, 10.0);
    }
}
