//! The paper's cell: a queue of sixteen ids of 2 bytes in 32 bytes. To push, the whole is shifted by 2 bytes and the id
//! written to the end that came free; the oldest falls out at the other.
//!
//! A lane holds one queue, so up to sixteen queues are pushed to at once: [`Queues`] is the eight words of each,
//! word 0 with the two newest. The eight corners of a sphere's box take eight lanes. All are read, then all
//! pushed to, then all written: corners that share a cell read the same queue and write the same result, so the
//! id is in it once.
//!
//! Empty slots hold [`EMPTY`], which is no id. The paper leaves them 0, which cannot be told from sphere 0; and "write to
//! the first two bytes" after "shift left" overwrites a stored id on a big-endian machine. Here it is the low half of
//! word 0 that is free after the shift, by arithmetic and not by the order of bytes.

use crate::machine::{Chore, LANES, Machine};

/// Slots of a queue.
pub const SLOTS: usize = 16;
/// What an empty slot holds.
pub const EMPTY: u16 = u16::MAX;
/// The most spheres whose ids differ from [`EMPTY`].
pub const MAX_IDS: usize = EMPTY as usize;
/// 32-bit words of a queue.
pub const WORDS: usize = SLOTS / 2;

/// A queue as it lies in memory: 32 bytes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Queue([u32; WORDS]);

/// A queue in each lane: its words, the two newest ids in the first, the newer in its low half.
#[derive(Clone, Copy)]
pub struct Queues<M: Machine>(pub [M::I; WORDS]);

/// Pushes an id onto the queues at these places. Of sixteen places all are read before any is written, so that equal ones get the id once;
/// where there are more, those of different sixteens must differ.
///
/// # Panics
/// If a place is not one of the queues'.
pub fn push_all<M: Machine>(m: M, queues: &mut [Queue], places: &[usize], id: u32) {
    for places in places.chunks(LANES) {
        let mut read = [Queue::EMPTY; LANES];
        for (queue, &place) in read.iter_mut().zip(places) {
            *queue = queues[place];
        }
        let pushed = m.within(
            #[inline(always)]
            || {
                m.beside(
                    Chore::Push(places.len()),
                    #[inline(always)]
                    || Queues::read(m, &read).push(m, m.splat_i(id.cast_signed())).to_array(m),
                )
            },
        );
        for (queue, &place) in pushed.iter().zip(places) {
            queues[place] = *queue;
        }
    }
}

impl Queue {
    /// No ids.
    pub const EMPTY: Self = Self([u32::MAX; WORDS]);

    /// The ids, newest first.
    #[inline]
    pub fn ids(&self) -> impl Iterator<Item = u32> + use<'_> {
        (0..SLOTS).map(|slot| self.slot(slot)).take_while(|&id| id != u32::from(EMPTY))
    }

    /// The id that the next push drops, if the queue is full.
    #[must_use]
    pub fn oldest(&self) -> Option<u32> {
        Some(self.slot(SLOTS - 1)).filter(|&id| id != u32::from(EMPTY))
    }

    /// Slot 0 is the newest.
    fn slot(&self, slot: usize) -> u32 {
        (self.0[slot / 2] >> (16 * (slot % 2))) & 0xffff
    }
}

impl<M: Machine> Queues<M> {
    /// Rim: reads up to sixteen queues; further lanes repeat the first.
    #[inline(always)]
    pub fn read(m: M, queues: &[Queue]) -> Self {
        let mut words = [[0; LANES]; WORDS];
        for lane in 0..LANES {
            let queue = queues.get(lane).unwrap_or(&queues[0]);
            for (word, value) in words.iter_mut().zip(queue.0) {
                word[lane] = value.cast_signed();
            }
        }
        let mut queues = [m.splat_i(0); WORDS];
        for (queue, word) in queues.iter_mut().zip(words) {
            *queue = m.lanes_i(word);
        }
        Self(queues)
    }

    /// Rim: the queue of each lane.
    #[inline(always)]
    pub fn to_array(self, m: M) -> [Queue; LANES] {
        let mut queues = [Queue::EMPTY; LANES];
        for (i, word) in self.0.into_iter().enumerate() {
            for (queue, value) in queues.iter_mut().zip(m.to_array_i(word)) {
                queue.0[i] = value.cast_unsigned();
            }
        }
        queues
    }

    /// Kernel: pushes an id of at most 16 bits onto every lane's queue.
    #[inline(always)]
    pub fn push(self, m: M, id: M::I) -> Self {
        let mut words = self.0;
        let mut carried = id;
        for word in &mut words {
            let falls_out = m.shr_16(*word);
            *word = m.or_i(m.shl_16(*word), carried);
            carried = falls_out;
        }
        Self(words)
    }
}
