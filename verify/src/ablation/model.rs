//! The model of the paper's machine with one feature left out at a time: how many frames a second it then says, and which of the paper's
//! claims come out otherwise. What changes no claim is there for its figures alone.

use crate::paper::{Looked, PaperClaim, Standing, claims, look};
use crate::spu::feature::{Feature, without};
use crate::spu::predict::Policy;
use crate::spu::survey::{Input, Survey, SurveyError, survey};
use serde::Serialize;

/// What is said without a feature.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Without {
    /// What is left out; nothing in the first row.
    pub feature: Option<Feature>,
    /// Frames a second on each scene, least and most, hinted.
    pub frames_per_second: Vec<(String, [f64; 2])>,
    /// Claims that come out otherwise: each, as the whole model has it, and so.
    pub changed: Vec<(String, Standing, Standing)>,
}

/// Steps that [`model`] ticks for so many scenes.
#[must_use]
pub fn steps(scenes: usize) -> u32 {
    u32::try_from(scenes + Feature::ALL.len() * scenes).unwrap_or(u32::MAX)
}

/// The whole model first, then without each feature.
///
/// # Errors
/// [`SurveyError`] if a scene cannot be surveyed.
pub fn model(inputs: &[Input<'_>], seed: u64, tick: &dyn Fn()) -> Result<Vec<Without>, SurveyError> {
    let quiet = || ();
    let mut whole = Vec::new();
    for input in inputs {
        whole.push(look(input, &quiet)?);
        tick();
    }
    let expected = claims(&whole, &[], seed);
    let mut rows = vec![Without { feature: None, frames_per_second: rates(&whole), changed: Vec::new() }];
    for feature in Feature::ALL {
        let mut looked = Vec::new();
        for (input, whole) in inputs.iter().zip(&whole) {
            let survey = without(feature, || survey(input, &quiet))?;
            looked.push(Looked { survey, ..whole.clone() });
            tick();
        }
        let found = without(feature, || claims(&looked, &[], seed));
        let changed = changed(&expected, &found);
        rows.push(Without { feature: Some(feature), frames_per_second: rates(&looked), changed });
    }
    Ok(rows)
}

fn rates(looked: &[Looked]) -> Vec<(String, [f64; 2])> {
    let rate = |survey: &Survey| survey.rates[Policy::Hinted as usize].frames_per_second;
    looked.iter().map(|looked| (looked.survey.scene.clone(), rate(&looked.survey))).collect()
}

fn changed(expected: &[PaperClaim], found: &[PaperClaim]) -> Vec<(String, Standing, Standing)> {
    let both = expected.iter().zip(found).filter(|(expected, found)| expected.verdict != found.verdict);
    both.map(|(expected, found)| (expected.statement.clone(), expected.verdict, found.verdict)).collect()
}
