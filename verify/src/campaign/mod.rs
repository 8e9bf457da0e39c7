//! Campaigns: more scenes than one run, or one machine, has time for. A plan ([`plan`]) says what is drawn and which films are judged; it falls
//! into units ([`unit`](mod@unit)), each a pure function of the plan and its number; a shard ([`shard`]) does every N-th of them and keeps what they found, a
//! line each; [`merge`] puts shards together, refuses a unit that is missing or was done twice, and tells the same whoever did which.
//!
//! In: a plan's text, a shard's number, a folder. Out: files of lines, then one [`merge::Merged`]. Nothing here schedules: that is for whoever starts
//! shards.

pub mod merge;
pub mod page;
pub mod plan;
pub mod shard;
pub mod text;
pub mod unit;
