//! The figures of a scene as one HTML page that needs nothing but itself.

use super::Figure;
use crate::report::Environment;
use crate::report::chapter::Chapter;
use askama::Template;

/// What stands on the page beside the figures.
#[derive(Clone, Debug)]
pub struct About {
    /// The scene's name.
    pub scene: String,
    /// Spheres, pixels and plan in a sentence.
    pub facts: String,
    /// Where, when and how it was made.
    pub environment: Environment,
}

#[derive(Template)]
#[template(path = "figures-part.html")]
struct Part<'a> {
    figures: &'a [Figure],
}

/// The figures as a part of a page that has their style.
///
/// # Errors
/// If the template fails, which its types give no cause for.
pub fn part(figures: &[Figure]) -> Result<String, askama::Error> {
    Part { figures }.render()
}

/// The page.
///
/// # Errors
/// If the template fails, which its types give no cause for.
pub fn page(about: &About, figures: &[Figure]) -> Result<String, askama::Error> {
    let files: Vec<String> = figures.iter().map(|figure| format!("{}.svg", figure.name)).collect();
    Chapter {
        over: "The paper's figures, drawn by the running code",
        sign: "",
        heading: &about.scene,
        class: "",
        lead: &about.facts,
        body: &part(figures)?,
        environment: &about.environment,
        beside: format!("Each is a file of its own in the same folder: {}.", files.join(", ")),
    }
    .render()
}
