//! What the module exports. Numbers go in and out, and addresses in its memory, which whoever loaded the module reads and writes; 1 is yes,
//! 0 is no, and after a no the [`message`] says why. There is one [`View`].
//!
//! An address holds until the next call of a function that is not only asked for an address or a length.

#![allow(
    unsafe_code,
    reason = "a name that is exported as it stands is an unsafe attribute; there is no unsafe block"
)]

use crate::View;
use optimized::Level;
use std::fmt::Display;
use std::ptr::null;
use std::sync::{Mutex, MutexGuard, PoisonError};

static VIEW: Mutex<View> = Mutex::new(View::new());
/// Text that was last asked for or is the reason of the last no.
static MESSAGE: Mutex<String> = Mutex::new(String::new());
/// Numbers that were last asked for.
static NUMBERS: Mutex<[u64; 8]> = Mutex::new([0; 8]);
static HASH: Mutex<[u8; 32]> = Mutex::new([0; 32]);

fn lock<T>(mutex: &Mutex<T>) -> MutexGuard<'_, T> {
    mutex.lock().unwrap_or_else(PoisonError::into_inner)
}

fn say(text: &impl Display) {
    *lock(&MESSAGE) = text.to_string();
}

fn done<T>(outcome: Result<T, impl Display>) -> u32 {
    match outcome {
        Ok(_) => 1,
        Err(error) => {
            say(&error);
            0
        }
    }
}

/// Where so many bytes can be written, from which the next scene or camera is taken; 0 if there is no room for them.
#[unsafe(no_mangle)]
pub extern "C" fn inbox(bytes: usize) -> *mut u8 {
    match lock(&VIEW).inbox(bytes) {
        Ok(room) => room.as_mut_ptr(),
        Err(error) => {
            say(&error);
            std::ptr::null_mut()
        }
    }
}

/// Takes the scene in the inbox, laid out as [`crate::wire`] says.
#[unsafe(no_mangle)]
pub extern "C" fn set_scene() -> u32 {
    done(lock(&VIEW).set_scene())
}

/// Takes the camera in the inbox, laid out as [`crate::wire`] says.
#[unsafe(no_mangle)]
pub extern "C" fn set_camera() -> u32 {
    done(lock(&VIEW).set_camera())
}

/// Traces a frame at a level, counted from 0.
#[unsafe(no_mangle)]
pub extern "C" fn render(level: usize) -> u32 {
    done(lock(&VIEW).render(level))
}

/// The last frame's ids, a u32 for each pixel; 0 if there is no frame, as in the next two.
#[unsafe(no_mangle)]
pub extern "C" fn ids() -> *const u32 {
    lock(&VIEW).frame().map_or(null(), |frame| frame.image.ids.as_ptr())
}

/// Its t, an f32 for each pixel.
#[unsafe(no_mangle)]
pub extern "C" fn t() -> *const f32 {
    lock(&VIEW).frame().map_or(null(), |frame| frame.image.t.as_ptr())
}

/// Its colours: red, green, blue, 255.
#[unsafe(no_mangle)]
pub extern "C" fn rgba() -> *const [u8; 4] {
    lock(&VIEW).frame().map_or(null(), |frame| frame.image.rgba.as_ptr())
}

/// Its pixels; 0 if there is no frame.
#[unsafe(no_mangle)]
pub extern "C" fn pixels() -> usize {
    lock(&VIEW).frame().map_or(0, |frame| frame.image.ids.len())
}

/// What tracing it cost: eight u64 in the order of [`optimized::seen::Counts`]; 0 if there is no frame.
#[unsafe(no_mangle)]
pub extern "C" fn counts() -> *const u64 {
    let view = lock(&VIEW);
    let Some(frame) = view.frame() else { return null() };
    let c = frame.counts;
    let mut numbers = lock(&NUMBERS);
    *numbers = [
        c.cells,
        c.candidates,
        c.culled,
        c.split_blocks,
        c.lanes,
        c.asked_f64,
        c.asked_integers,
        c.rounded_by_integers,
    ];
    numbers.as_ptr()
}

/// Its [`crate::hash()`], 32 bytes; 0 if there is no frame.
#[unsafe(no_mangle)]
pub extern "C" fn hash() -> *const u8 {
    let Some(found) = lock(&VIEW).hash() else { return null() };
    let mut hash = lock(&HASH);
    *hash = found;
    hash.as_ptr()
}

/// How many levels there are.
#[unsafe(no_mangle)]
pub extern "C" fn levels() -> usize {
    Level::available().len()
}

/// Makes the name of a level the message.
#[unsafe(no_mangle)]
pub extern "C" fn name_level(level: usize) -> u32 {
    let levels = Level::available();
    let Some(level) = levels.get(level) else { return 0 };
    say(level);
    1
}

/// The text of the message, in UTF-8.
#[unsafe(no_mangle)]
pub extern "C" fn message() -> *const u8 {
    lock(&MESSAGE).as_ptr()
}

/// Its bytes.
#[unsafe(no_mangle)]
pub extern "C" fn message_bytes() -> usize {
    lock(&MESSAGE).len()
}
