//! The other end of the pipe: any [`Subject`] as a program that answers questions.

use super::wire::{DONE, MOST_TEXT, READ, REFUSED, asked, told};
use crate::subject::Subject;
use std::io::{self, Read, Write};

/// Answers the questions of `input` on `output` by a subject's own pictures, until they end. Its promise and its colours are not asked for.
///
/// # Errors
/// What a stream, the protocol or the contract refuses; that a subject gives no picture is told the judge instead.
pub fn serve(
    subject: &dyn Subject,
    threads: usize,
    input: &mut impl Read,
    output: &mut impl Write,
) -> io::Result<()> {
    while let Some((camera, spheres)) = asked(input)? {
        output.write_all(&[READ])?;
        output.flush()?;
        let scene = told(input, spheres)?;
        match subject.render(&scene, &camera, threads, &|| ()) {
            Ok(rendered) => {
                output.write_all(&[DONE])?;
                output.flush()?;
                let ids = rendered.image.ids.into_iter().flat_map(u32::to_le_bytes);
                let t = rendered.image.t.into_iter().flat_map(f32::to_le_bytes);
                output.write_all(&ids.chain(t).collect::<Vec<u8>>())?;
            }
            Err(error) => {
                let said = error.to_string();
                let said = &said.as_bytes()[..said.len().min(MOST_TEXT as usize)];
                let length = u32::try_from(said.len()).unwrap_or(MOST_TEXT);
                output.write_all(&[REFUSED])?;
                output.write_all(&length.to_le_bytes())?;
                output.write_all(said)?;
            }
        }
        output.flush()?;
    }
    Ok(())
}
