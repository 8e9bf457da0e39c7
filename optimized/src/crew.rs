//! The workers of a tracer: threads that stay from frame to frame. A frame of an animation takes about a millisecond; a thread begun for it
//! may not have found a core of its own before the frame is done (measured: with a thread a frame two workers took as long as one, where
//! schedulers pack what sleeps often onto few cores).

use crate::event::RenderError;
use rayon::{ThreadPool, ThreadPoolBuilder};
use std::sync::{Arc, Mutex};

/// Workers, of whom the thread that calls is one.
#[derive(Clone, Debug)]
pub struct Crew {
    others: Option<Arc<ThreadPool>>,
}

impl Crew {
    /// So many workers; none is as good as one. Rayon gives no more than its `max_num_threads` beside the caller, as
    /// [`Crew::size`] says.
    ///
    /// # Errors
    /// [`RenderError::Workers`] if the system gives no thread.
    pub fn new(workers: usize) -> Result<Self, RenderError> {
        if workers <= 1 {
            return Ok(Self::alone());
        }
        let others = ThreadPoolBuilder::new().num_threads(workers - 1).build();
        let others = others.map_err(|error| RenderError::Workers { workers, cause: error.to_string() })?;
        Ok(Self { others: Some(Arc::new(others)) })
    }

    /// The calling thread alone.
    #[must_use]
    pub fn alone() -> Self {
        Self { others: None }
    }

    /// Workers, the calling thread included.
    #[must_use]
    pub fn size(&self) -> usize {
        1 + self.others.as_ref().map_or(0, |others| others.current_num_threads())
    }

    /// What each worker makes of its share of tasks: it takes the next one, for as long as there is one. Asked by a worker of some other
    /// pool, it takes a thread more, to wait in; if the system gives none, the caller does all tasks alone.
    ///
    /// # Panics
    /// If `work` does.
    pub fn share<T, R: Send>(
        &self,
        tasks: impl Iterator<Item = T> + Send,
        work: impl Fn(&mut dyn FnMut() -> Option<T>) -> R + Sync,
    ) -> Vec<R> {
        let tasks = Mutex::new(tasks);
        let next = || tasks.lock().expect("nothing panics while it holds the tasks").next();
        self.each(|| work(&mut &next))
    }

    /// What each worker makes of the same work, in no certain order.
    ///
    /// # Panics
    /// If `work` does.
    fn each<R: Send>(&self, work: impl Fn() -> R + Sync) -> Vec<R> {
        let Some(others) = &self.others else { return vec![work()] };
        let done = Mutex::new(Vec::with_capacity(self.size()));
        let one = || {
            let result = work();
            done.lock().expect("nothing panics while it holds the list").push(result);
        };
        let all = || {
            others.in_place_scope(|scope| {
                for _ in 0..others.current_num_threads() {
                    scope.spawn(|_| one());
                }
                one();
            });
        };
        if rayon::current_thread_index().is_some() {
            // A worker of some other pool would take up that pool's tasks while it waits, frame within frame until its stack is full.
            // A thread of no pool just waits.
            let waiting = std::thread::scope(|scope| {
                let thread = std::thread::Builder::new().spawn_scoped(scope, all);
                thread.map(std::thread::ScopedJoinHandle::join)
            });
            match waiting {
                Ok(joined) => joined.unwrap_or_else(|panic| std::panic::resume_unwind(panic)),
                Err(_) => one(),
            }
        } else {
            all();
        }
        done.into_inner().expect("as above")
    }
}
