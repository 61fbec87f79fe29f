//! How schedules are made and run: one thread, ambiguity is an error, the first failure stops.
//!
//! bevy_ecs by itself goes on with the next system after an `Err`, and a panic inside a system is
//! caught and handed to the same handler. Here the handler records the first failure, every system
//! is added with a condition that no failure is recorded, and [`run`] returns it.

use bevy_ecs::error::{BevyError, ErrorContext, FallbackErrorHandler};
use bevy_ecs::prelude::*;
use bevy_ecs::schedule::{
    LogLevel, ScheduleBuildSettings, ScheduleConfigs, ScheduleLabel, SingleThreadedExecutor,
};
use bevy_ecs::system::ScheduleSystem;
use std::cell::RefCell;
use std::fmt;

/// A system failed, and with it the stage.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct StageError {
    /// The schedule.
    pub stage: String,
    /// The system's path.
    pub system: String,
    /// Why.
    pub cause: String,
}

impl fmt::Display for StageError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(
            f,
            "stage {} failed in {}: {}",
            self.stage, self.system, self.cause
        )
    }
}

impl std::error::Error for StageError {}

thread_local! {
    /// The first failure of the schedule that runs on this thread. The handler is a bare `fn` that
    /// sees no world, hence no resource.
    static FAILURE: RefCell<Option<(String, String)>> = const { RefCell::new(None) };
}

fn record(error: BevyError, context: ErrorContext) {
    FAILURE.with_borrow_mut(|f| {
        if f.is_none() {
            let cause = error.to_string();
            // Some errors bring a backtrace along after their first line.
            let cause = cause.lines().next().unwrap_or("unknown").to_owned();
            *f = Some((context.name().to_string(), cause));
        }
    });
}

fn nothing_failed() -> bool {
    FAILURE.with_borrow(Option::is_none)
}

/// Adds a schedule to a world, ready for [`add_systems`]; `configure` orders its sets.
pub fn add_schedule(
    world: &mut World,
    label: impl ScheduleLabel,
    configure: impl FnOnce(&mut Schedule),
) {
    world.insert_resource(FallbackErrorHandler(record));
    let mut schedule = Schedule::new(label);
    schedule.set_executor(SingleThreadedExecutor::new());
    schedule.set_build_settings(ScheduleBuildSettings {
        ambiguity_detection: LogLevel::Error,
        ..Default::default()
    });
    configure(&mut schedule);
    world.add_schedule(schedule);
}

/// Adds systems to a schedule made by [`add_schedule`]; they are skipped after a failure.
///
/// # Panics
/// When the world has no such schedule.
pub fn add_systems<M>(
    world: &mut World,
    label: impl ScheduleLabel,
    systems: impl IntoScheduleConfigs<ScheduleSystem, M>,
) {
    let guarded: ScheduleConfigs<ScheduleSystem> =
        systems.into_configs().distributive_run_if(nothing_failed);
    world.schedule_scope(label, |_, schedule| {
        schedule.add_systems(guarded);
    });
}

/// Runs a schedule once; the first system that fails or panics ends it.
pub fn run(world: &mut World, label: impl ScheduleLabel + Clone) -> Result<(), StageError> {
    FAILURE.with_borrow_mut(|f| *f = None);
    let stage = format!("{label:?}");
    // Ambiguous systems and cyclic sets show here, before anything has run.
    if let Err(error) = world.schedule_scope(label.clone(), |world, s| s.initialize(world)) {
        return Err(StageError {
            stage,
            system: "the schedule itself".into(),
            cause: format!("{error:?}"),
        });
    }
    world.run_schedule(label);
    match FAILURE.with_borrow_mut(Option::take) {
        None => Ok(()),
        Some((system, cause)) => Err(StageError {
            stage,
            system,
            cause,
        }),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[derive(ScheduleLabel, Clone, Debug, PartialEq, Eq, Hash)]
    struct Work;

    #[derive(Resource, Default)]
    struct Ran(Vec<&'static str>);

    fn first(mut ran: ResMut<Ran>) {
        ran.0.push("first");
    }
    fn fails() -> Result {
        Err("no such tile".into())
    }
    fn panics() {
        panic!("out of tiles");
    }
    fn last(mut ran: ResMut<Ran>) {
        ran.0.push("last");
    }

    fn world() -> World {
        let mut world = World::new();
        world.init_resource::<Ran>();
        add_schedule(&mut world, Work, |_| {});
        world
    }

    #[test]
    fn a_failing_system_stops_the_stage_with_its_name_and_cause() {
        let mut world = world();
        add_systems(&mut world, Work, (first, fails, last).chain());
        let error = run(&mut world, Work).unwrap_err();
        assert_eq!(world.resource::<Ran>().0, ["first"]);
        assert_eq!(error.stage, "Work");
        assert!(error.system.ends_with("fails"), "{error}");
        assert_eq!(error.cause, "no such tile");
    }

    #[test]
    fn a_panic_is_a_failure_like_any_other() {
        let mut world = world();
        add_systems(&mut world, Work, (panics, last).chain());
        let error = run(&mut world, Work).unwrap_err();
        assert!(world.resource::<Ran>().0.is_empty());
        assert!(error.system.ends_with("panics"), "{error}");
    }

    #[test]
    fn a_failure_does_not_outlive_its_run() {
        let mut world = world();
        add_systems(&mut world, Work, fails.run_if(|r: Res<Ran>| r.0.is_empty()));
        assert!(run(&mut world, Work).is_err());
        world.resource_mut::<Ran>().0.push("again");
        assert_eq!(run(&mut world, Work), Ok(()));
    }

    #[test]
    fn ambiguous_systems_are_an_error() {
        let mut world = world();
        add_systems(&mut world, Work, (first, last));
        let error = run(&mut world, Work).unwrap_err();
        assert_eq!(error.system, "the schedule itself");
        assert!(world.resource::<Ran>().0.is_empty());
    }
}
