//! Branches by their sites, under three policies of hinting.
//!
//! The SPU predicts nothing by itself: a branch is taken to fall through unless a hint says otherwise, and a hinted one is taken to
//! be taken. A mispredict costs 18 cycles (18 to 19 are published). One hint is in force at a time; one that was set before a loop
//! stays in force through it until another is set. Setting one is an instruction of the odd pipe.
//!
//! One run serves all policies, since they differ only in what is booked.

use optimized::machine::Site;

/// Cycles of a mispredict.
pub const MISPREDICT: u64 = 18;
/// GCC puts a hint at least so many instructions before its branch…
pub const HINT_AHEAD: u64 = 8;
/// … and at most so many bytes.
pub const HINT_BYTES: u64 = 600;
/// Bytes of an instruction.
pub const INSTRUCTION: u64 = 4;

/// Which branches are hinted.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Policy {
    /// None.
    Unhinted,
    /// All whose likely way is taken, wherever they stand (the paper: "always predict taken").
    Hinted,
    /// Of these the ones that GCC could hint: after a straight line of [`HINT_AHEAD`] instructions at least, or again in a loop of at
    /// most [`HINT_BYTES`] with the hint still in force.
    Gcc,
}

impl Policy {
    /// All of them.
    pub const ALL: [Self; 3] = [Self::Unhinted, Self::Hinted, Self::Gcc];

    /// What it is called.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Unhinted => "unhinted",
            Self::Hinted => "hinted",
            Self::Gcc => "GCC's rule",
        }
    }
}

/// All sites.
pub const SITES: [Site; 14] = [
    Site::Incoherent,
    Site::Sphere,
    Site::Ahead,
    Site::Unfinished,
    Site::Culled,
    Site::NextCell,
    Site::EmptySlice,
    Site::NextK,
    Site::NextJ,
    Site::NextSlice,
    Site::EmptyCell,
    Site::NextId,
    Site::NextOwner,
    Site::NextSphere,
];

/// Those that steer the loops over cells, of either kind.
pub const LOOP_SITES: [Site; 6] =
    [Site::NextCell, Site::EmptySlice, Site::NextK, Site::NextJ, Site::NextSlice, Site::Unfinished];

/// Whether the likely way at a site is to branch.
#[must_use]
pub fn is_likely(site: Site) -> bool {
    match site {
        Site::Unfinished
        | Site::NextCell
        | Site::NextK
        | Site::NextJ
        | Site::NextSlice
        | Site::NextId
        | Site::NextOwner
        | Site::NextSphere => true,
        Site::Incoherent | Site::Sphere | Site::Ahead | Site::Culled | Site::EmptySlice | Site::EmptyCell => {
            false
        }
    }
}

/// What happened at a site.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Branches {
    /// How often it was come to.
    pub executed: u64,
    /// How often it was taken.
    pub taken: u64,
    /// Mispredicts under each policy.
    pub mispredicts: [u64; 3],
}

/// What one branch costs under each policy.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Cost {
    /// Whether it was mispredicted.
    pub mispredicted: [bool; 3],
    /// Whether a hint had to be set.
    pub hinted: [bool; 3],
}

/// The branches of a run.
#[derive(Clone, Copy, Debug, Default)]
pub struct Predictor {
    /// By site, in the order of [`SITES`].
    pub sites: [Branches; SITES.len()],
    in_force: [Option<Site>; 3],
    last_branch: u64,
    last_here: [u64; SITES.len()],
}

impl Predictor {
    /// A branch after so many instructions since the beginning.
    pub fn decide(&mut self, site: Site, taken: bool, instructions: u64) -> Cost {
        let index = site as usize;
        let line = instructions - self.last_branch;
        let body = instructions - self.last_here[index];
        (self.last_branch, self.last_here[index]) = (instructions, instructions);
        let branches = &mut self.sites[index];
        branches.executed += 1;
        branches.taken += u64::from(taken);
        let mut cost = Cost { mispredicted: [false; 3], hinted: [false; 3] };
        for (i, policy) in Policy::ALL.into_iter().enumerate() {
            let still = self.in_force[i] == Some(site);
            let (hinted, anew) = match policy {
                Policy::Unhinted => (false, false),
                Policy::Hinted => (is_likely(site), !still),
                Policy::Gcc => {
                    let kept = still && body * INSTRUCTION <= HINT_BYTES;
                    (is_likely(site) && (kept || line >= HINT_AHEAD), !kept)
                }
            };
            if hinted {
                self.in_force[i] = Some(site);
            }
            cost.hinted[i] = hinted && anew;
            cost.mispredicted[i] = taken != hinted;
            branches.mispredicts[i] += u64::from(cost.mispredicted[i]);
        }
        cost
    }
}
