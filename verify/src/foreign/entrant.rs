//! A foreign tracer in charts and maps. Its time is from the judge's word to go until the last of its answers has come, by the judge's clock:
//! rays before are not counted, taking the spheres, building, and the answers' way are.

use super::{Answers, Foreign};
use crate::bench::contestant::{Contestant, Frame, Kind, Layers, Oath};
use crate::methods::{Family, Method};
use crate::subject::{Promise, Subject, SubjectError};
use contract::{Camera, Scene};
use std::sync::Arc;
use std::time::Duration;

/// The method of a foreign tracer.
#[must_use]
pub fn method(foreign: &Arc<Foreign>, threads: usize) -> Method {
    let own = foreign.clone();
    let mut method = Method::made(foreign.name(), Family::Foreign, move |_, _| {
        Ok(Box::new(Entrant { foreign: own.clone(), threads, answers: None }))
    });
    method.exact = foreign.promise() == Promise::Exact;
    method
}

struct Entrant {
    foreign: Arc<Foreign>,
    threads: usize,
    answers: Option<Answers>,
}

impl Contestant for Entrant {
    fn name(&self) -> &str {
        self.foreign.name()
    }

    fn description(&self) -> String {
        format!("`{}`: spheres, ids and t over a pipe, which is timed with it", self.foreign.description())
    }

    fn kind(&self) -> Kind {
        Kind::Peer
    }

    fn oath(&self) -> Oath {
        self.foreign.promise().into()
    }

    fn frame(&mut self, scene: &Scene, camera: &Camera) -> Result<Frame<'_>, SubjectError> {
        let Answers { ids, t, took } = self.answers.insert(self.foreign.ask(scene, camera, self.threads)?);
        Ok(Frame { build: Duration::ZERO, took: Some(*took), layers: Layers { ids, t, rgba: None } })
    }
}
