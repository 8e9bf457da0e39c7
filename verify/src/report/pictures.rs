//! The pictures of one scene, already encoded: a run adds each subject's image as soon as it is judged and may
//! then forget it. Images come in; what is kept is PNG bytes for the page and for the files beside it.
//! An image that does not have the truth's size is refused.

use super::Live;
use crate::picture::{PictureError, canvas, join, panels, png, zoom};
use contract::Image;

/// What the picture is called that all are held against but those that promise another.
pub const TRUTH: &str = "Truth";
/// Pixels on a side of the magnified part.
pub(super) const ZOOM_SIDE: u32 = 21;
/// How many times it is magnified.
const ZOOM_SCALE: u32 = 16;

/// Pictures of the truth and of the subjects, in the order of [`SceneReport::subjects`](super::SceneReport), and a live one.
#[derive(Clone, Debug, Default)]
pub struct ScenePictures {
    /// What the page carries so that the scene can be turned; the page shows that of its first scene.
    pub live: Option<Live>,
    pub(super) truth: Option<Vec<u8>>,
    pub(super) subjects: Vec<Option<SubjectPictures>>,
}

/// A subject's triptych as one PNG, and its parts if it shows any difference.
#[derive(Clone, Debug)]
pub(super) struct SubjectPictures {
    pub(super) triptych: Vec<u8>,
    pub(super) differing: Option<Differing>,
}

/// What was promised, subject and difference as PNG each, whole and around the first wrong pixel.
#[derive(Clone, Debug)]
pub(super) struct Differing {
    /// What the first panel is called.
    pub(super) against: &'static str,
    pub(super) panels: [Vec<u8>; 3],
    pub(super) zoom: [Vec<u8>; 3],
}

impl ScenePictures {
    /// Begins with the truth.
    ///
    /// # Errors
    /// [`PictureError`] if its layers do not fit its size.
    pub fn new(truth: &Image) -> Result<Self, PictureError> {
        Ok(Self { truth: Some(png(&canvas(truth)?)?), ..Self::default() })
    }

    /// Adds the next subject's picture, held against the truth or another by its name, and marked where it is wrong first, or differs.
    ///
    /// # Errors
    /// [`PictureError`] if the two differ in size or a layer does not fit its size.
    pub fn add(
        &mut self,
        (against, promised): (&'static str, &Image),
        subject: &Image,
        place: Option<[u32; 2]>,
    ) -> Result<(), PictureError> {
        let panels = panels(promised, subject, place)?;
        let differing = match place {
            Some(place) => Some(Differing {
                against,
                panels: encoded(&panels)?,
                zoom: encoded(&zoom(promised, subject, place, ZOOM_SIDE, ZOOM_SCALE)?)?,
            }),
            None => None,
        };
        self.subjects.push(Some(SubjectPictures { triptych: png(&join(&panels))?, differing }));
        Ok(())
    }

    /// Says that the next subject has no picture.
    pub fn skip(&mut self) {
        self.subjects.push(None);
    }
}

fn encoded(panels: &[image::RgbaImage; 3]) -> Result<[Vec<u8>; 3], PictureError> {
    let [truth, subject, difference] = panels;
    Ok([png(truth)?, png(subject)?, png(difference)?])
}
