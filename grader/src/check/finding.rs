//! What a check found: the share of points, what was measured, the evidence where points are lost, and the curve it judged.

use super::facts::MotionFacts;
use super::signal::Statistic;
use crate::record::grade::{Evidence, Measure};
use crate::record::graded::Curve;
use crate::record::quantity::OF_VISIBLE_CASES;
use crate::task::model::Band;

/// What a check found.
#[derive(Debug, Clone)]
pub struct Finding {
    /// The share of points earned, in `[0, 1]`.
    pub score: f64,
    /// What was measured.
    pub measure: Option<Measure>,
    /// Why points were lost, worst first.
    pub evidence: Vec<Evidence>,
    /// The next step where points were lost; the lab's own question comes before it, unless this one `insists`.
    pub next_step: String,
    /// Whether what was seen makes the lab's question beside the point, such as a joint that never comes to rest.
    pub insists: bool,
    /// Whether points were lost because the TCP did not stay at a goal, which another check judges.
    pub waits_for_goals: bool,
    /// The curve it judged.
    pub curve: Option<Curve>,
    /// What of the curve counts. Without it there is no curve, or moments beyond the band may cost nothing, as on the way to a goal:
    /// then the evidence says where points were first lost.
    pub statistic: Option<Statistic>,
}

impl Finding {
    /// A value held against a band.
    pub fn against(band: Band, value: f64, unit: &str, quantity: impl Into<String>) -> Self {
        Self::scored(
            band.score(value),
            measure(quantity, value, unit, [band.full, band.zero]),
        )
    }

    /// A statistic of a curve, held against the band.
    pub(super) fn of_curve(
        band: Band,
        statistic: Statistic,
        unit: &str,
        quantity: impl Into<String>,
        curve: Curve,
    ) -> Self {
        let value = statistic.of(&curve.values);
        Self {
            statistic: Some(statistic),
            ..Self::against(band, value, unit, quantity).drawn(curve)
        }
    }

    /// A score that is itself what was measured: the mean of other scores, or a fixed one.
    pub fn share(score: f64, quantity: impl Into<String>) -> Self {
        Self::scored(
            score,
            Measure {
                value: Some(score),
                ..measure(quantity, score, "", [1.0, 0.0])
            },
        )
    }

    /// A score of its own beside what was measured.
    pub fn scored(score: f64, measure: Measure) -> Self {
        Self {
            score,
            measure: Some(measure),
            evidence: Vec::new(),
            next_step: String::new(),
            insists: false,
            waits_for_goals: false,
            curve: None,
            statistic: None,
        }
    }

    /// With the value of the visible cases in place of that of all cases, which decides the score and may reveal hidden numbers.
    pub(super) fn shown_as(mut self, of_visible: Option<f64>) -> Self {
        if let (Some(measure), Some(value)) = (&mut self.measure, of_visible) {
            measure.value = value.is_finite().then_some(value);
            measure.quantity += OF_VISIBLE_CASES;
        }
        self
    }

    /// Whether points are lost.
    pub fn is_lost(&self) -> bool {
        self.score < 1.0
    }

    /// With a piece of evidence.
    pub fn with(mut self, evidence: Evidence) -> Self {
        self.evidence.push(evidence);
        self
    }

    /// With evidence that shows the measured value beyond the band's `full`, where points are lost: message, signal and tick.
    pub fn shown_at(
        self,
        facts: &MotionFacts<'_>,
        evidence: impl FnOnce() -> (String, String, usize),
    ) -> Self {
        let (true, Some(measure)) = (self.is_lost(), &self.measure) else {
            return self;
        };
        let (message, signal, tick) = evidence();
        let evidence = Evidence {
            value: measure.value,
            limit: Some(measure.full),
            unit: measure.unit.clone(),
            ..facts.evidence(message, signal, tick)
        };
        self.with(evidence)
    }

    /// With all the evidence.
    pub fn because(mut self, evidence: Vec<Evidence>) -> Self {
        self.evidence = evidence;
        self
    }

    /// With one thing to do next.
    pub fn advise(mut self, next_step: impl Into<String>) -> Self {
        self.next_step = next_step.into();
        self
    }

    /// With a next step that comes before the lab's own question.
    pub fn insisting(self) -> Self {
        Self {
            insists: true,
            ..self
        }
    }

    /// With the value that the linear loop would have reached, if there is one to compare with.
    pub fn beside_prediction(mut self, predicted: Option<f64>) -> Self {
        if let Some(measure) = &mut self.measure {
            measure.prediction = predicted.filter(|value| value.is_finite());
        }
        self
    }

    /// With the curve it judged.
    pub fn drawn(mut self, curve: Curve) -> Self {
        self.curve = Some(curve);
        self
    }
}

/// What was measured, without a value where it is not finite; `[full, zero]` is the band.
pub(super) fn measure(
    quantity: impl Into<String>,
    value: f64,
    unit: &str,
    [full, zero]: [f64; 2],
) -> Measure {
    Measure {
        quantity: quantity.into(),
        value: value.is_finite().then_some(value),
        unit: unit.to_owned(),
        full,
        zero,
        reference: None,
        prediction: None,
    }
}

/// A curve against the two lines of its band; without lines where there is none.
pub(super) fn curve(
    title: impl Into<String>,
    unit: &str,
    t_s: Vec<f64>,
    values: Vec<f64>,
    band: Option<Band>,
) -> Curve {
    Curve {
        // whoever judges the check fills it in
        check: String::new(),
        title: title.into(),
        unit: unit.to_owned(),
        t_s,
        values,
        full: band.map(|band| band.full),
        zero: band.map(|band| band.zero),
        marks: Vec::new(),
        reference: None,
        step: None,
    }
}
