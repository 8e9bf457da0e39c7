//! File names for pictures: the names of scenes and subjects, which may hold anything, become names that every
//! file system takes. Only a to z, 0 to 9 and single hyphens remain, so no name can leave its folder or differ
//! from another by case alone; a name that is taken gets a number.

use std::collections::HashSet;

/// Longest part of a name that comes from a scene or a subject.
const LONGEST: usize = 60;

/// Hands out names, none of them twice.
#[derive(Debug, Default)]
pub(super) struct Names {
    taken: HashSet<String>,
}

impl Names {
    /// The parts cleaned and joined, with a number if that is needed to make the name new.
    pub(super) fn unique(&mut self, parts: &[&str]) -> String {
        let clean = parts.iter().map(|part| sanitized(part)).collect::<Vec<_>>().join("-");
        let numbered = (2_u64..).map(|n| format!("{clean}-{n}"));
        let free = std::iter::once(clean.clone()).chain(numbered).find(|name| !self.taken.contains(name));
        let name = free.unwrap_or(clean);
        self.taken.insert(name.clone());
        name
    }
}

/// The name in lower case, every run of anything but a to z and 0 to 9 as one hyphen; `unnamed` if nothing is left.
#[must_use]
pub fn sanitized(name: &str) -> String {
    let lower = name.to_ascii_lowercase();
    let words = lower.split(|c: char| !c.is_ascii_alphanumeric()).filter(|word| !word.is_empty());
    let mut clean = words.collect::<Vec<_>>().join("-");
    clean.truncate(LONGEST);
    match clean.trim_end_matches('-') {
        "" => "unnamed".to_owned(),
        clean => clean.to_owned(),
    }
}
