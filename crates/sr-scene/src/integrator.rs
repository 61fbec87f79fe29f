//! Which integrators there are, as far as a reader must know: a name and a type of settings.

use bevy_ecs::prelude::*;
use bevy_reflect::Reflect;
use std::any::TypeId;
use std::collections::BTreeMap;

/// What readers and `steradian list` know of an integrator.
#[derive(Clone, Debug)]
pub struct IntegratorInfo {
    /// Its settings' type, which is registered.
    pub settings: TypeId,
    /// One line on what it is.
    pub summary: &'static str,
}

/// Every registered integrator by its name in RON.
#[derive(Resource, Default, Debug)]
pub struct IntegratorCatalog(pub BTreeMap<&'static str, IntegratorInfo>);

/// The integrator that the configuration names, and its settings.
#[derive(Resource, Debug)]
pub struct SelectedIntegrator {
    /// Name in the catalogue.
    pub name: String,
    /// A value of the settings' type.
    pub settings: Box<dyn Reflect>,
}

impl SelectedIntegrator {
    /// The settings as what they are, or `None` when they are another integrator's.
    pub fn settings<S: Reflect>(&self) -> Option<&S> {
        self.settings.as_partial_reflect().try_downcast_ref::<S>()
    }
}
