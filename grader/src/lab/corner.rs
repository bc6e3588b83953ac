//! Corners: variants at the ends of what students draw. Somebody gets nearly each of them, and few drawn students do.

use kinemark_sim::text::Dimension;

use super::model::Lab;
use super::variant::Variant;
use super::variant_rule::{DrawnFrom, VariantRule};
use crate::task::problem::LabError;

/// A variant at an end of what is drawn.
#[derive(Debug, Clone)]
pub struct Corner {
    /// Which one, in words.
    pub words: String,
    /// Its numbers.
    pub variant: Variant,
}

/// Numbers of parameters, by name.
type Numbers = Vec<(String, Dimension)>;

impl Lab {
    /// The corners of `[variants]`: every number at the first of its range, every number at the last, each choice alone, and each number
    /// alone at both ends of its range; what is not named is as in lab.toml. None has the numbers of one before it, or those of lab.toml.
    ///
    /// # Errors
    /// A number that is not finite.
    pub fn corners(&self) -> Result<Vec<Corner>, LabError> {
        let own: Numbers = self
            .variants
            .iter()
            .filter_map(|rule| {
                let own = self.parameters.get(&rule.name)?.clone();
                Some((rule.name.clone(), own))
            })
            .collect();
        let mut known = vec![own.clone()];
        let mut corners = Vec::new();
        let all = [("first", 0), ("last", 1)].map(|(word, end)| {
            let words = format!("every number at the {word} of its range");
            (words, all_at(&own, &self.variants, end))
        });
        let choices = self.variants.iter().flat_map(|rule| choices(&own, rule));
        let alone = self.variants.iter().flat_map(|rule| alone(&own, rule));
        for (words, numbers) in all.into_iter().chain(choices).chain(alone) {
            if !known.contains(&numbers) {
                let variant = Variant::new(&self.name, None, &numbers)?;
                corners.push(Corner { words, variant });
                known.push(numbers);
            }
        }
        Ok(corners)
    }
}

/// Every number that has a range at one end of it.
fn all_at(own: &Numbers, rules: &[VariantRule], end: usize) -> Numbers {
    let value = |(name, own): &(String, Dimension)| {
        let rule = rules.iter().find(|rule| rule.name == *name);
        let value = match rule.map(|rule| &rule.from) {
            Some(DrawnFrom::Steps(steps)) => Dimension::Number(steps.ends()[end]),
            Some(DrawnFrom::Each(each)) => {
                Dimension::List(each.iter().map(|steps| steps.ends()[end]).collect())
            }
            Some(DrawnFrom::Choices(_)) | None => own.clone(),
        };
        (name.clone(), value)
    };
    own.iter().map(value).collect()
}

/// The numbers of lab.toml with another value for one parameter.
fn with(own: &Numbers, name: &str, value: &Dimension) -> Numbers {
    let mut numbers = own.clone();
    for (known, number) in &mut numbers {
        if known == name {
            *number = value.clone();
        }
    }
    numbers
}

/// Each choice of one parameter.
fn choices(own: &Numbers, rule: &VariantRule) -> Vec<(String, Numbers)> {
    let DrawnFrom::Choices(choices) = &rule.from else {
        return Vec::new();
    };
    let each = choices.iter().map(|choice| {
        let words = format!("`{}` = {}", rule.name, rule.in_toml(choice));
        (words, with(own, &rule.name, choice))
    });
    each.collect()
}

/// One parameter, or one number of a list, at both ends of its range.
fn alone(own: &Numbers, rule: &VariantRule) -> Vec<(String, Numbers)> {
    let name = &rule.name;
    match &rule.from {
        DrawnFrom::Choices(_) => Vec::new(),
        DrawnFrom::Steps(steps) => {
            let at = |end: f64| {
                let numbers = with(own, name, &Dimension::Number(end));
                (format!("`{name}` = {end}"), numbers)
            };
            steps.ends().map(at).to_vec()
        }
        DrawnFrom::Each(each) => {
            let base = own.iter().find(|(known, _)| known == name);
            let Some((_, Dimension::List(base))) = base else {
                return Vec::new();
            };
            let entries = each.iter().enumerate().flat_map(|(i, steps)| {
                steps.ends().map(|end| {
                    let mut list = base.clone();
                    list[i] = end;
                    let numbers = with(own, name, &Dimension::List(list));
                    (format!("`{name}[{i}]` = {end}"), numbers)
                })
            });
            entries.collect()
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::lab::variant_rule::Steps;

    fn rule(name: &str, from: DrawnFrom) -> VariantRule {
        let name = name.to_owned();
        VariantRule { name, from }
    }

    fn steps(from: f64, step: f64, count: u64) -> Steps {
        Steps { from, step, count }
    }

    #[test]
    fn every_end_and_every_choice_is_a_corner_once() {
        let own: Numbers = vec![
            ("far".to_owned(), Dimension::Number(2.0)),
            ("row".to_owned(), Dimension::Text("RzTx".to_owned())),
            ("at".to_owned(), Dimension::List(vec![0.5, -1.0])),
        ];
        let texts = ["RzTx", "TzRx"].map(|text| Dimension::Text(text.to_owned()));
        let rules = [
            rule("far", DrawnFrom::Steps(steps(1.9, 0.1, 3))),
            rule("row", DrawnFrom::Choices(texts.to_vec())),
            rule(
                "at",
                DrawnFrom::Each(vec![steps(0.5, 0.25, 3), steps(-1.5, 0.5, 3)]),
            ),
        ];
        let [_, last] = [0, 1].map(|end| all_at(&own, &rules, end));
        assert_eq!(last[0].1, Dimension::Number(2.1));
        assert_eq!(last[1].1, own[1].1, "no choice has an end");
        assert_eq!(last[2].1, Dimension::List(vec![1.0, -0.5]));
        let words: Vec<String> = rules
            .iter()
            .flat_map(|rule| [choices(&own, rule), alone(&own, rule)].concat())
            .map(|(words, _)| words)
            .collect();
        let expected = [
            "`far` = 1.9",
            "`far` = 2.1",
            "`row` = \"RzTx\"",
            "`row` = \"TzRx\"",
            "`at[0]` = 0.5",
            "`at[0]` = 1",
            "`at[1]` = -1.5",
            "`at[1]` = -0.5",
        ];
        assert_eq!(words, expected);
        let (_, second) = &alone(&own, &rules[2])[3];
        assert_eq!(second[2].1, Dimension::List(vec![0.5, -0.5]));
        assert_eq!(second[..2], own[..2], "alone");
    }
}
