//! Faults that a wrapper of Embree can have. Tests plant them, one at a time, to see that the checks turn red.

/// What is wrong on purpose.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Fault {
    /// Nothing: what everything but a test asks for.
    #[default]
    None,
    /// The first two spheres are handed over in each other's place.
    SwappedIds,
    /// The mask of every ray is 0, so that it sees no geometry.
    MaskDropped,
    /// The structures have no room for the field that Embree 4.3 added.
    Shrunk,
    /// A ray keeps the limit that the ray before it ended with.
    LimitKept,
    /// A ray keeps the hit of the ray before it.
    IdKept,
}
