//! Seconds by stage, and of one thread.

use bevy_ecs::prelude::*;
use sr_scene::bevy_ecs;
use std::time::Instant;

/// Wall-clock seconds that each stage took. `integrate` is what comparisons use: the `Render`
/// schedule alone, without measuring and writing.
#[derive(Resource, Clone, Copy, Debug, Default, PartialEq)]
pub struct StageSeconds {
    /// Reading files.
    pub load: f64,
    /// From entities to the sealed scene.
    pub compile: f64,
    /// All passes.
    pub integrate: f64,
    /// Error estimates between passes.
    pub measure: f64,
    /// Developing and writing.
    pub post: f64,
}

/// The processor time of one thread: what others do on the machine meanwhile is not in it. Where the
/// system does not tell, it is the wall clock.
#[derive(Clone, Copy)]
pub(crate) struct ThreadClock {
    #[cfg(any(target_os = "linux", target_os = "macos"))]
    start: rustix::time::Timespec,
    #[cfg(not(any(target_os = "linux", target_os = "macos")))]
    start: Instant,
}

impl ThreadClock {
    /// Starts to measure the calling thread.
    pub fn now() -> Self {
        Self {
            #[cfg(any(target_os = "linux", target_os = "macos"))]
            start: rustix::time::clock_gettime(rustix::time::ClockId::ThreadCPUTime),
            #[cfg(not(any(target_os = "linux", target_os = "macos")))]
            start: Instant::now(),
        }
    }

    /// Seconds since then, on the same thread.
    pub fn elapsed(self) -> f64 {
        #[cfg(any(target_os = "linux", target_os = "macos"))]
        {
            let now = Self::now().start;
            let nanoseconds = (now.tv_nsec - self.start.tv_nsec) as f64;
            (now.tv_sec - self.start.tv_sec) as f64 + 1e-9 * nanoseconds
        }
        #[cfg(not(any(target_os = "linux", target_os = "macos")))]
        self.start.elapsed().as_secs_f64()
    }
}

/// Runs `work` and adds its seconds to `total`.
pub(crate) fn timed<T>(total: &mut f64, work: impl FnOnce() -> T) -> T {
    let start = Instant::now();
    let result = work();
    *total += start.elapsed().as_secs_f64();
    result
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_thread_that_sleeps_takes_no_processor_time() {
        let (cpu, wall) = (ThreadClock::now(), Instant::now());
        std::thread::sleep(std::time::Duration::from_millis(50));
        let slept = cpu.elapsed();
        let tells = cfg!(any(target_os = "linux", target_os = "macos"));
        assert!(slept >= 0.0 && (!tells || slept < 0.04), "{slept}");
        let mut x = 1.0f64;
        while wall.elapsed().as_secs_f64() < 0.1 {
            x = std::hint::black_box(x.sqrt() + 1.0);
        }
        // However busy the machine, some of it was ours.
        let worked = cpu.elapsed();
        assert!(slept < worked && worked <= wall.elapsed().as_secs_f64());
    }
}
