//! Progress on standard error: a bar where there is a terminal, nothing else.

use indicatif::{ProgressBar, ProgressStyle};

/// A bar for one rendering; what it gives is called once a row.
pub(crate) fn bar(scene: &str, what: &str, rows: u32) -> Box<dyn Fn() + Sync> {
    let style = ProgressStyle::with_template("{prefix:>20} {msg:26} {bar:30} {percent:>3} % {elapsed}");
    let bar = ProgressBar::new(u64::from(rows)).with_prefix(scene.to_owned()).with_message(what.to_owned());
    if let Ok(style) = style {
        bar.set_style(style);
    }
    Box::new(move || {
        bar.inc(1);
        if bar.position() == bar.length().unwrap_or(0) {
            bar.finish();
        }
    })
}
