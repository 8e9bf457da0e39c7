//! A headless Chromium, for tests of what is made for browsers (`CGT_CHROMIUM` or `chromium` on the path).

use std::process::Command;

/// What it says with some arguments; `None` if there is none.
pub(crate) fn chromium(words: &[&str]) -> Option<Vec<u8>> {
    let named = std::env::var("CGT_CHROMIUM");
    let program = named.clone().unwrap_or_else(|_| "chromium".into());
    let home = tempfile::tempdir().expect("a folder");
    let profile = format!("--user-data-dir={}", home.path().display());
    let fixed = ["--headless", "--no-sandbox", "--disable-gpu", "--hide-scrollbars"];
    let output = Command::new(&program).args(fixed).arg(profile).args(words).output();
    // One that is named must be there.
    assert!(output.is_ok() || named.is_err(), "CGT_CHROMIUM is `{program}`, which does not start");
    let output = output.ok()?;
    assert!(output.status.success(), "Chromium: {}", String::from_utf8_lossy(&output.stderr));
    Some(output.stdout)
}
