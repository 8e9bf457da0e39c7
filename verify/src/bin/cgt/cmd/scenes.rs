//! `cgt scenes`: what can be named.

use crate::{Failure, say};
use std::process::ExitCode;
use verify::scenes::catalogue::{FETCH, list};

pub(crate) fn scenes() -> Result<ExitCode, Failure> {
    let mut text = String::new();
    for scene in list() {
        let absent = if scene.present { "" } else { "  (absent)" };
        let count = format!("{} x {}", scene.spheres, scene.frames);
        text += &format!(
            "{:<18} {count:>11}  {}{absent}\n{:33}{}\n",
            scene.name, scene.what, "", scene.provenance
        );
    }
    text += &format!(
        "\nspheres x frames. What is absent is brought by {FETCH}.\n\
         Generators: sphereflake:LEVELS  uniform:COUNT:SEED  clump:COUNT:SEED  lattice:SIDE\n\
         Files: .pdb .xyz .dcd .xtc .nff .lammpstrj .json .inc, each also as .gz; \
         trajectory,atoms for .dcd and .xtc\n"
    );
    say(&text)?;
    Ok(ExitCode::SUCCESS)
}
