//! Do readers read real files whole, name what is wrong with broken ones, and survive anything?
//!
//! Real files that are fetched and absent are said to be "not judged"; broken ones are small and stand here.

#[path = "readers/anything.rs"]
mod anything;
#[path = "readers/broken.rs"]
mod broken;
#[path = "readers/real.rs"]
mod real;
#[path = "readers/samples.rs"]
mod samples;
#[path = "readers/untidy.rs"]
mod untidy;
#[path = "readers/whole.rs"]
mod whole;
#[path = "readers/words.rs"]
mod words;
