//! The runner of tests that attack the program for a while.
//!
//! `AXISCOPE_CAMPAIGN_SECONDS` says for how long, two seconds by default, and `AXISCOPE_CAMPAIGN_SEED` from which seed.

use std::panic::{AssertUnwindSafe, catch_unwind, resume_unwind};
use std::time::{Duration, Instant};

use rand::SeedableRng;
use rand_chacha::ChaCha8Rng;

/// Runs `case` with one generator after another until the time is over, and prints the number of cases and the program's
/// memory.
pub fn campaign(name: &str, mut case: impl FnMut(&mut ChaCha8Rng)) {
    let number = |name: &str| {
        std::env::var(name)
            .ok()
            .and_then(|value| value.parse::<u64>().ok())
    };
    let lasts = Duration::from_secs(number("AXISCOPE_CAMPAIGN_SECONDS").unwrap_or(2));
    let first = number("AXISCOPE_CAMPAIGN_SEED").unwrap_or(0);
    let (started, mut cases) = (Instant::now(), 0);
    let mut said = started;
    while started.elapsed() < lasts || cases == 0 {
        let seed = first + cases;
        let ran = catch_unwind(AssertUnwindSafe(|| case(&mut ChaCha8Rng::seed_from_u64(seed))));
        if let Err(panic) = ran {
            eprintln!("{name}: AXISCOPE_CAMPAIGN_SEED={seed} repeats this");
            resume_unwind(panic);
        }
        cases += 1;
        if said.elapsed() > Duration::from_mins(1) {
            println!(
                "{name}: {cases} cases, {} MB now",
                memory_mb("VmRSS:").unwrap_or(0)
            );
            said = Instant::now();
        }
    }
    println!(
        "{name}: {cases} cases, {} MB at most",
        memory_mb("VmHWM:").unwrap_or(0)
    );
}

/// The memory that the program has (`VmRSS:`), or has had at most (`VmHWM:`), where Linux tells it.
fn memory_mb(kind: &str) -> Option<u64> {
    let status = std::fs::read_to_string("/proc/self/status").ok()?;
    let line = status.lines().find_map(|line| line.strip_prefix(kind))?;
    line.trim()
        .trim_end_matches(" kB")
        .parse::<u64>()
        .ok()
        .map(|kb| kb >> 10)
}
