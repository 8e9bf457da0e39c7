//! One chapter as a page by itself: what a command found, in the frame that all such pages have.

use super::Environment;
use askama::Template;

/// The page; all texts but `body` are escaped.
#[derive(Template)]
#[template(path = "chapter.html")]
pub(crate) struct Chapter<'a> {
    /// Over the heading: what the page is of.
    pub(crate) over: &'a str,
    /// A sign before the heading, for those who do not see colours; may be empty.
    pub(crate) sign: &'a str,
    /// The heading.
    pub(crate) heading: &'a str,
    /// The class of the heading, which is its colour.
    pub(crate) class: &'a str,
    /// A sentence below it; may be empty.
    pub(crate) lead: &'a str,
    /// The chapter, as HTML.
    pub(crate) body: &'a str,
    /// Where, when and how it was made.
    pub(crate) environment: &'a Environment,
    /// What lies in the same folder.
    pub(crate) beside: String,
}

impl<'a> Chapter<'a> {
    /// With a heading alone, and NAME.json and NAME.csv beside it.
    pub(crate) fn plain(
        heading: &'a str,
        (name, schema): (&str, u32),
        body: &'a str,
        environment: &'a Environment,
    ) -> Self {
        let beside = format!(
            "The same data, to be read by programs: {name}.json (schema {schema}) and {name}.csv in the same folder."
        );
        let over = environment.simd.as_str();
        Self { over, sign: "", heading, class: "equal", lead: "", body, environment, beside }
    }
}
