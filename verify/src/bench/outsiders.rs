//! What a user could pick instead: which of it is asked, whether it is there, and its contestants.
//!
//! In: names. Out: [`Field`], which makes contestants for a camera, or why one that was asked for is missing.

use super::contestant::Contestant;
use contract::Camera;
use optimized::Level;

/// A tracer of other people.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Outsider {
    /// Embree 4, in all its ways.
    Embree,
    /// The crate `bvh`.
    Bvh,
    /// The crate `parry3d`.
    Parry3d,
}

impl Outsider {
    /// All of them.
    pub const ALL: [Self; 3] = [Self::Embree, Self::Bvh, Self::Parry3d];

    /// Its name.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Embree => "embree",
            Self::Bvh => "bvh",
            Self::Parry3d => "parry3d",
        }
    }

    /// Whether this program was built with it.
    #[must_use]
    pub fn built_in(self) -> bool {
        match self {
            Self::Embree => cfg!(feature = "embree"),
            Self::Bvh | Self::Parry3d => cfg!(feature = "peers"),
        }
    }
}

/// Those that were asked for and are there.
#[derive(Debug)]
pub struct Field {
    #[cfg_attr(
        not(any(feature = "embree", feature = "peers")),
        allow(dead_code, reason = "nobody is there")
    )]
    threads: usize,
    #[cfg(feature = "embree")]
    embree: Option<crate::embree::Device>,
    /// Its ways that are asked.
    #[cfg(feature = "embree")]
    modes: Vec<crate::embree::Mode>,
    #[cfg(feature = "peers")]
    peers: Vec<Outsider>,
}

impl Field {
    /// None of them yet.
    #[must_use]
    pub fn new(threads: usize) -> Self {
        Self {
            threads,
            #[cfg(feature = "embree")]
            embree: None,
            #[cfg(feature = "embree")]
            modes: Vec::new(),
            #[cfg(feature = "peers")]
            peers: Vec::new(),
        }
    }

    /// Adds one. Embree is held to the instruction set of a level.
    ///
    /// # Errors
    /// Why it is missing, as a sentence.
    pub fn add(&mut self, outsider: Outsider, level: Level) -> Result<(), String> {
        match outsider {
            Outsider::Embree => self.add_embree(level),
            Outsider::Bvh | Outsider::Parry3d => self.add_peer(outsider),
        }
    }

    #[cfg(feature = "embree")]
    fn add_embree(&mut self, level: Level) -> Result<(), String> {
        use crate::embree::{Device, Isa};
        // Embree has no code without SSE2, and this processor has it.
        let name = if level.name() == "scalar" { "sse2" } else { level.name() };
        let isa = Isa::ALL.into_iter().find(|isa| isa.name() == name);
        let isa = isa.ok_or_else(|| format!("It has no code for {level}."))?;
        let device = Device::new(isa, self.threads);
        self.modes = crate::embree::Mode::all();
        self.embree = Some(device.map_err(|error| format!("It is there and cannot be used: {error}."))?);
        Ok(())
    }

    #[cfg(not(feature = "embree"))]
    #[allow(clippy::unused_self, reason = "with the feature it is used")]
    fn add_embree(&mut self, _: Level) -> Result<(), String> {
        Err("This program was built without it; tests/with-embree builds it with.".into())
    }

    #[cfg(feature = "peers")]
    fn add_peer(&mut self, outsider: Outsider) -> Result<(), String> {
        self.peers.push(outsider);
        Ok(())
    }

    #[cfg(not(feature = "peers"))]
    #[allow(clippy::unused_self, reason = "with the feature it is used")]
    fn add_peer(&mut self, _: Outsider) -> Result<(), String> {
        Err("This program was built without it; the feature `peers` builds it in.".into())
    }

    /// Asks no more than these of Embree's ways, given by the names of their contestants. Of none of them all stay.
    pub fn narrow(&mut self, names: &[&str]) {
        #[cfg(feature = "embree")]
        {
            let kept = |mode: &&crate::embree::Mode| names.contains(&super::embree::name(**mode).as_str());
            let modes: Vec<_> = self.modes.iter().filter(kept).copied().collect();
            if !modes.is_empty() {
                self.modes = modes;
            }
        }
        _ = names;
    }

    /// Names and versions, for the report.
    #[must_use]
    pub fn names(&self) -> Vec<String> {
        #[allow(unused_mut, reason = "with a feature it is used")]
        let mut names = Vec::new();
        #[cfg(feature = "embree")]
        names.extend(self.embree.iter().map(|d| format!("Embree {} at {}", d.version(), d.isa())));
        #[cfg(feature = "peers")]
        names.extend(self.peers.iter().map(|peer| format!("the crate {}", peer.name())));
        names
    }

    /// The contestants for a camera.
    #[must_use]
    pub fn contestants(&self, camera: &Camera) -> Vec<Box<dyn Contestant>> {
        #[allow(unused_mut, reason = "with a feature it is used")]
        let mut contestants: Vec<Box<dyn Contestant>> = Vec::new();
        #[cfg(feature = "embree")]
        if let Some(device) = &self.embree {
            for mode in &self.modes {
                let entrant = super::embree::Entrant::new(device, *mode, camera, self.threads);
                contestants.push(Box::new(entrant));
            }
        }
        #[cfg(feature = "peers")]
        for peer in &self.peers {
            contestants.push(super::peers::entrant(*peer, camera, self.threads));
        }
        _ = camera;
        contestants
    }
}
