//! Pieces of work on every core, with results in their own order.
//!
//! The pieces depend on the data alone, never on how many threads there are, so sums over them
//! come out the same to the bit wherever they run.

use std::ops::Range;
use std::sync::atomic::{AtomicUsize, Ordering};

#[cfg(feature = "parallel")]
use rayon::prelude::*;

mod watch;

pub(crate) use watch::PartOf;
pub use watch::{Cancelled, Watch};

/// Cuts `0..len` into ranges of `piece` (the last may be shorter), runs `work` on each, and returns
/// the results in the order of the ranges.
///
/// # Errors
/// Returns [`Cancelled`] if the watch cancels the work.
///
/// # Panics
/// Panics if `piece` is zero.
pub fn map_pieces<T: Send>(
    len: usize,
    piece: usize,
    watch: &dyn Watch,
    work: impl Fn(Range<usize>) -> T + Sync + Send,
) -> Result<Vec<T>, Cancelled> {
    let pieces = len.div_ceil(piece);
    let done = AtomicUsize::new(0);
    let one = |i: usize| {
        watch.go_on()?;
        let result = work(i * piece..((i + 1) * piece).min(len));
        watch.advanced(done.fetch_add(1, Ordering::Relaxed) + 1, pieces);
        Ok(result)
    };
    // Each piece may go to another core, so that all cores end at about the same time.
    #[cfg(feature = "parallel")]
    return (0..pieces).into_par_iter().with_max_len(1).map(one).collect();
    #[cfg(not(feature = "parallel"))]
    (0..pieces).map(one).collect()
}

/// A pool of threads apart from the one that all other work shares: a job on it may wait without delaying
/// that work.
#[derive(Debug)]
pub struct BackgroundPool {
    #[cfg(feature = "parallel")]
    pool: Option<rayon::ThreadPool>,
}

impl BackgroundPool {
    /// Creates a pool with one thread less than there are cores, but at least one.
    pub fn new() -> Self {
        #[cfg(feature = "parallel")]
        {
            let cores = std::thread::available_parallelism().map_or(1, std::num::NonZeroUsize::get);
            let threads = cores.saturating_sub(1).max(1);
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build();
            Self { pool: pool.ok() }
        }
        #[cfg(not(feature = "parallel"))]
        Self {}
    }

    /// Runs `work` once on each thread and waits for all; on the caller's thread if there are none. Parallel
    /// work within it stays in the pool.
    pub fn broadcast(&self, work: impl Fn() + Sync) {
        #[cfg(feature = "parallel")]
        if let Some(pool) = &self.pool {
            pool.broadcast(|_| work());
            return;
        }
        work();
    }

    /// Runs `work` on one thread, and parallel work within it on all of them; on the caller's thread if there
    /// are none.
    pub fn install<T: Send>(&self, work: impl FnOnce() -> T + Send) -> T {
        #[cfg(feature = "parallel")]
        if let Some(pool) = &self.pool {
            return pool.install(work);
        }
        work()
    }
}

impl Default for BackgroundPool {
    fn default() -> Self {
        Self::new()
    }
}

/// Runs both functions, at the same time if there are cores for it.
pub(crate) fn join(a: impl FnOnce() + Send, b: impl FnOnce() + Send) {
    #[cfg(feature = "parallel")]
    rayon::join(a, b);
    #[cfg(not(feature = "parallel"))]
    {
        a();
        b();
    }
}

/// Sorts on all cores. The watch is asked between pieces that take some hundredths of a second.
pub(crate) fn sort_unstable<T: Ord + Send>(values: &mut [T], watch: &dyn Watch) -> Result<(), Cancelled> {
    /// The most values that are sorted without a question.
    const PIECE: usize = 1 << 20;
    watch.go_on()?;
    if values.len() > PIECE {
        // Halves can be sorted one after the other, and the work called off in between.
        let middle = values.len() / 2;
        let (low, _, _) = values.select_nth_unstable(middle);
        let middle = low.len();
        let (low, high) = values.split_at_mut(middle);
        let (mut of_low, mut of_high) = (Ok(()), Ok(()));
        join(
            || of_low = sort_unstable(low, watch),
            || of_high = sort_unstable(high, watch),
        );
        return of_low.and(of_high);
    }
    #[cfg(feature = "parallel")]
    values.par_sort_unstable();
    #[cfg(not(feature = "parallel"))]
    values.sort_unstable();
    Ok(())
}
