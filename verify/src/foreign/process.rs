//! A tracer as a running program: what it is asked goes to its standard input, what it answers comes from its standard output; what it
//! says on standard error is for people and goes where this program's goes.
//!
//! A thread writes and a thread reads, so that neither side can keep the other from speaking, and so that a silent tracer can be given up.

use super::ForeignError;
use super::wire::{DONE, MOST_TEXT, READ, REFUSED};
use std::collections::VecDeque;
use std::io::{Read, Write};
use std::process::{Child, Command, Stdio};
use std::sync::mpsc::{Receiver, RecvTimeoutError, Sender, TryRecvError, channel, sync_channel};
use std::time::{Duration, Instant};

/// Bytes read at once, and such pieces that wait to be taken.
const PIECE: usize = 1 << 16;
const PIECES: usize = 64;
/// How long a tracer has for ending after its last frame; then it is stopped.
const FAREWELL: Duration = Duration::from_secs(2);

/// A tracer that runs.
#[derive(Debug)]
pub(super) struct Process {
    child: Child,
    questions: Option<Sender<Vec<u8>>>,
    answers: Receiver<Vec<u8>>,
    /// Read and not yet taken.
    pending: VecDeque<u8>,
    /// The longest that it may say nothing while something is due.
    patience: Duration,
}

/// What a tracer answered, as bytes: ids, then t; and how long it took.
pub(super) struct Answer {
    pub(super) bytes: Vec<u8>,
    pub(super) took: Duration,
}

impl Process {
    /// Starts it. `threads` is told in the environment variable `CGT_THREADS`.
    pub(super) fn start(words: &[String], threads: usize, patience: Duration) -> Result<Self, ForeignError> {
        let [program, arguments @ ..] = words else { return Err(ForeignError::Empty) };
        let mut command = Command::new(program);
        command.args(arguments).env("CGT_THREADS", threads.to_string());
        let started = command.stdin(Stdio::piped()).stdout(Stdio::piped()).spawn();
        let mut child = started
            .map_err(|cause| ForeignError::Start { program: program.clone(), cause: cause.to_string() })?;
        let (questions, to_write) = channel::<Vec<u8>>();
        let (read, answers) = sync_channel(PIECES);
        if let Some(mut stdin) = child.stdin.take() {
            // Of a tracer that has gone away its end tells more than that nothing could be written to it.
            std::thread::spawn(move || {
                while let Ok(bytes) = to_write.recv() {
                    if stdin.write_all(&bytes).and_then(|()| stdin.flush()).is_err() {
                        break;
                    }
                }
            });
        }
        if let Some(mut stdout) = child.stdout.take() {
            std::thread::spawn(move || {
                let mut piece = vec![0; PIECE];
                while let Ok(length @ 1..) = stdout.read(&mut piece) {
                    if read.send(piece[..length].to_vec()).is_err() {
                        break;
                    }
                }
            });
        }
        Ok(Self { child, questions: Some(questions), answers, pending: VecDeque::new(), patience })
    }

    /// Asks a question, whose answer has so many bytes.
    pub(super) fn ask(&mut self, [first, last]: [Vec<u8>; 2], length: usize) -> Result<Answer, ForeignError> {
        self.nothing_more()?;
        self.send(first);
        // Whoever says that it is done before it is told to go would stop a clock that has not begun.
        self.said(READ, "once it had read its rays").and_then(|()| self.nothing_more())?;
        let start = Instant::now();
        self.send(last);
        self.said(DONE, "once it had traced them")?;
        // Whoever says that it is done has its answers: until the last of them is here, the clock runs.
        self.wait(length, "as its answers")?;
        let took = start.elapsed();
        let bytes = self.take(length, "as its answers")?;
        // What comes later is found at the next question.
        self.nothing_more().map(|()| Answer { bytes, took })
    }

    fn send(&self, bytes: Vec<u8>) {
        // Who does not listen is found when an answer is due.
        _ = self.questions.as_ref().map(|questions| questions.send(bytes));
    }

    /// Nothing may have come that nobody asked for.
    fn nothing_more(&mut self) -> Result<(), ForeignError> {
        match self.answers.try_recv() {
            Ok(bytes) => self.pending.extend(bytes),
            Err(TryRecvError::Empty | TryRecvError::Disconnected) => {}
        }
        if self.pending.is_empty() {
            Ok(())
        } else {
            Err(ForeignError::Surplus { bytes: self.pending.len() })
        }
    }

    /// The byte that is due.
    fn said(&mut self, due: u8, when: &'static str) -> Result<(), ForeignError> {
        let byte = self.take(1, when)?[0];
        if byte == due {
            return Ok(());
        }
        if byte == REFUSED {
            let why = "as why it refuses";
            let length = self.take(4, why)?.try_into().map_or(MOST_TEXT, u32::from_le_bytes).min(MOST_TEXT);
            let said = self.take(length as usize, why)?;
            return Err(ForeignError::Refused { said: String::from_utf8_lossy(&said).trim().to_owned() });
        }
        // What a program says that does not know the protocol.
        let mut said = vec![byte];
        said.extend(self.pending.iter().take(39));
        Err(ForeignError::Unexpected { said: said.escape_ascii().to_string(), due: due.into(), when })
    }

    /// So many bytes.
    fn take(&mut self, length: usize, when: &'static str) -> Result<Vec<u8>, ForeignError> {
        self.wait(length, when)?;
        Ok(self.pending.drain(..length).collect())
    }

    /// Until so many bytes have come.
    fn wait(&mut self, length: usize, when: &'static str) -> Result<(), ForeignError> {
        while self.pending.len() < length {
            match self.answers.recv_timeout(self.patience) {
                Ok(bytes) => self.pending.extend(bytes),
                Err(RecvTimeoutError::Timeout) => {
                    let (got, seconds) = (self.pending.len(), self.patience.as_secs_f64());
                    return Err(ForeignError::Silent { seconds, when, got, due: length });
                }
                Err(RecvTimeoutError::Disconnected) => {
                    let got = self.pending.len();
                    return Err(ForeignError::Ended { how: self.end(FAREWELL), when, got, due: length });
                }
            }
        }
        Ok(())
    }

    /// Waits for its end, then brings it about; how it ended, in words.
    fn end(&mut self, patience: Duration) -> String {
        self.questions = None;
        let start = Instant::now();
        while start.elapsed() < patience {
            match self.child.try_wait() {
                Ok(Some(status)) => return status.to_string(),
                Ok(None) => std::thread::sleep(Duration::from_millis(2)),
                Err(error) => return error.to_string(),
            }
        }
        _ = self.child.kill();
        self.child.wait().map_or_else(|error| error.to_string(), |status| format!("stopped, {status}"))
    }
}

impl Drop for Process {
    fn drop(&mut self) {
        // Its reader must not wait for room.
        self.answers = channel().1;
        self.end(FAREWELL);
    }
}
