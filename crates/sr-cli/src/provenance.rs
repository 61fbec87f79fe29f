//! What a picture's file says about how it was made.

use sr_pipeline::Provenance;
use sr_pipeline::bevy_ecs::prelude::World;
use sr_pipeline::catalog::SelectedIntegrator;
use sr_pipeline::settings::SamplerSettings;

/// Of a world that is loaded, and the command line as it was typed.
pub fn of(world: &World, command_line: &str) -> Provenance {
    let seed = world.resource::<SamplerSettings>().seed;
    let integrator = world
        .get_resource::<SelectedIntegrator>()
        .map_or_else(String::new, |s| s.name.clone());
    let config = sr_io::resolved_config(world);
    let provenance = [
        ("version", env!("CARGO_PKG_VERSION").to_owned()),
        ("command", command_line.to_owned()),
        ("config_hash", sr_io::config_hash(&config)),
        ("config", config),
        ("integrator", integrator),
        ("seed", seed.to_string()),
    ];
    Provenance(provenance.map(|(name, value)| (name.into(), value)).into())
}
