//! One case, watched: what it did, which panics there were, what it allocated and how long it took.

use rustix::time::{ClockId, clock_gettime};
use sr_tests::fuzz::{Fate, Target};
use std::cell::RefCell;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::Once;
use std::time::Duration;

/// Most processor time of a case. The median is below a millisecond, a large input of the mutations
/// takes a hundred; what is quadratic in those takes minutes.
pub const LIMIT: Duration = Duration::from_secs(4);

/// What a case came to.
#[derive(Debug)]
pub struct Seen {
    /// What became of it; `None` after a panic.
    pub fate: Option<Fate>,
    /// Messages of all panics, those that the reader itself caught included.
    pub panics: Vec<String>,
    /// Most bytes allocated at a time.
    pub peak: u64,
    /// Processor time.
    pub time: Duration,
}

thread_local! {
    /// Messages of panics, while a case is watched on this thread.
    static PANICS: RefCell<Option<Vec<String>>> = const { RefCell::new(None) };
}

/// Panics on threads that are watched are kept, those on others are printed as ever.
fn keep_panics() {
    static ONCE: Once = Once::new();
    ONCE.call_once(|| {
        let usual = std::panic::take_hook();
        std::panic::set_hook(Box::new(move |info| {
            let kept = PANICS.with_borrow_mut(|panics| match panics {
                Some(panics) => {
                    panics.push(info.to_string());
                    true
                }
                None => false,
            });
            if !kept {
                usual(info);
            }
        }));
    });
}

/// Processor time of this thread.
pub fn processor_time() -> Duration {
    let time = clock_gettime(ClockId::ThreadCPUTime);
    Duration::try_from(time).expect("a clock that began at 0")
}

/// Runs a target on an input.
pub fn watch(target: &Target, input: &[u8]) -> Seen {
    keep_panics();
    PANICS.set(Some(Vec::new()));
    let mut result = None;
    let start = processor_time();
    let allocated = allocation_counter::measure(|| {
        result = Some(catch_unwind(AssertUnwindSafe(|| (target.run)(input))));
    });
    Seen {
        time: processor_time() - start,
        panics: PANICS.take().unwrap_or_default(),
        peak: allocated.bytes_max,
        fate: result.and_then(Result::ok),
    }
}

/// What is wrong with a case, if anything.
pub fn complaint(target: &Target, input: &[u8], seen: &Seen) -> Option<String> {
    if seen.fate.is_none() || !target.contained_panics && !seen.panics.is_empty() {
        return Some(format!("panics: {}", seen.panics.join("; ")));
    }
    if seen.time > LIMIT {
        return Some(format!("takes {:?} of processor time", seen.time));
    }
    let allowed = target.allowance.bytes(input.len());
    (seen.peak > allowed).then(|| {
        let (peak, length) = (seen.peak, input.len());
        format!("allocates {peak} bytes for an input of {length}, {allowed} are allowed")
    })
}
