//! `steradian list`: what there is, read from the registries, so that a plug-in's things are listed
//! like our own.

mod fields;
mod table;

use crate::Context;
use crate::args::{ListArgs, Listing};
use crate::failure::Failure;
use crate::session::pipeline;
use fields::{Field, docs, fields, first_sentence, variants};
use sr_pipeline::SceneFeatures;
use sr_pipeline::bevy_ecs::prelude::{Entity, World};
use sr_pipeline::bevy_ecs::reflect::{AppTypeRegistry, ReflectComponent};
use sr_pipeline::bevy_reflect::{TypeInfo, TypeRegistry, Typed};
use sr_pipeline::bsdf::metals::METALS;
use sr_pipeline::catalog::IntegratorCatalog;
use sr_pipeline::settings::{
    AdaptiveSettings, Budget, CompileSettings, FilmSettings, PostSettings, SamplerName,
    SamplerSettings,
};
use sr_scene::components::{DirectionalLight, Emission, Environment, PointLight, SpotLight};
use sr_scene::lobes::LobeCatalog;
use table::Table;

/// Prints one of the lists.
pub fn run(args: &ListArgs, context: &Context<'_>) -> Result<(), Failure> {
    let pipeline = pipeline(1, context)?;
    let world = &pipeline.world;
    let registry = world.resource::<AppTypeRegistry>().clone();
    let registry = registry.read();
    let text = match args.what {
        Listing::Integrators => integrators(world, &registry),
        Listing::Materials => materials(world, &registry),
        Listing::Lights => lights(&registry),
        Listing::Samplers => samplers(&registry),
        Listing::Features => features(),
        Listing::Settings => settings(world, &registry),
    };
    context.console.say(text.trim_end());
    Ok(())
}

fn integrators(world: &World, registry: &TypeRegistry) -> String {
    let mut table = Table::default();
    for (name, info) in &world.resource::<IntegratorCatalog>().0 {
        table.head(name, &sentence(info.summary));
        let settings = registry.get_type_info(info.settings);
        table.fields(settings.map_or_else(Vec::new, |i| fields(registry, i, "")));
    }
    table.to_string()
}

fn materials(world: &World, registry: &TypeRegistry) -> String {
    let mut table = Table::default();
    for lobe in &world.resource::<LobeCatalog>().0 {
        if let Some(entry) = registry.get_with_short_type_path(lobe.name) {
            component(&mut table, registry, entry.type_info());
        }
    }
    component(&mut table, registry, Emission::type_info());
    format!("{}\n{}", table.to_string().trim_end(), metals())
}

/// What `Conductor.metal` can be.
fn metals() -> String {
    let mut text = String::from(
        "\nmetals\n    Values of `Conductor.metal`; complex index by channel, linear Rec. 709.\n",
    );
    for m in METALS {
        let ([er, eg, eb], [kr, kg, kb]) = (m.eta.to_array(), m.k.to_array());
        text += &format!(
            "  {:2}  {:9}  eta ({er:.4}, {eg:.4}, {eb:.4})  k ({kr:.4}, {kg:.4}, {kb:.4})  {}\n",
            m.symbol, m.name, m.source
        );
    }
    text
}

fn lights(registry: &TypeRegistry) -> String {
    let mut table = Table::default();
    for light in [
        Emission::type_info(),
        PointLight::type_info(),
        SpotLight::type_info(),
        DirectionalLight::type_info(),
        Environment::type_info(),
    ] {
        component(&mut table, registry, light);
    }
    table.to_string()
}

fn component(table: &mut Table, registry: &TypeRegistry, info: &'static TypeInfo) {
    table.head(
        info.type_path_table().short_path(),
        &first_sentence(docs(info)),
    );
    table.fields(fields(registry, info, ""));
}

fn samplers(registry: &TypeRegistry) -> String {
    let mut table = Table::default();
    let default = format!("{:?}", SamplerName::default());
    for (name, docs) in variants(SamplerName::type_info()) {
        let mark = if name == default { " The default." } else { "" };
        table.head(name, &format!("{}{mark}", first_sentence(docs)));
    }
    table.fields(fields(registry, SamplerSettings::type_info(), "sampler."));
    table.to_string()
}

fn features() -> String {
    let mut text = String::new();
    for (name, _) in SceneFeatures::TABLE {
        text += name;
        text.push('\n');
    }
    text + "\n`steradian plan FILE` says which of them a scene has, and what is left out without."
}

/// Every path, in the order in which a configuration is usually written.
fn settings(world: &World, registry: &TypeRegistry) -> String {
    let mut table = Table::default();
    for (section, info) in [
        ("film", FilmSettings::type_info()),
        ("sampler", SamplerSettings::type_info()),
        ("budget", Budget::type_info()),
        ("adaptive", AdaptiveSettings::type_info()),
        ("post", PostSettings::type_info()),
        ("compile", CompileSettings::type_info()),
    ] {
        table.head(section, "");
        table.fields(fields(registry, info, &format!("{section}.")));
    }
    for (name, info) in &world.resource::<IntegratorCatalog>().0 {
        let settings = registry.get_type_info(info.settings);
        let fields = settings.map_or_else(Vec::new, |i| fields(registry, i, "integrator."));
        if !fields.is_empty() {
            table.head("integrator", &format!("while it is `{name}`"));
            table.fields(fields);
        }
    }
    let mut components: Vec<&'static TypeInfo> = registry
        .iter()
        .filter(|r| r.data::<ReflectComponent>().is_some())
        .map(|r| r.type_info())
        .collect();
    components.sort_by_key(|i| i.type_path_table().short_path());
    table.head(
        "entities.<name>",
        "whatever has a name; also `materials.<model>/<material>` and `camera`",
    );
    for info in components {
        let name = info.type_path_table().short_path();
        let inside = fields(registry, info, &format!("entities.<name>.{name}."));
        let whole = Field {
            path: format!("entities.<name>.{name}"),
            kind: whole_kind(info).into(),
            default: String::new(),
            docs: first_sentence(docs(info)),
        };
        table.fields(if inside.is_empty() {
            vec![whole]
        } else {
            inside
        });
    }
    table.to_string()
}

/// What a component without named fields takes.
fn whole_kind(info: &TypeInfo) -> &'static str {
    match info {
        TypeInfo::TupleStruct(t) if t.field_at(0).is_some_and(|f| f.is::<Entity>()) => {
            "name of an entity"
        }
        TypeInfo::TupleStruct(_) => "value",
        _ => "()",
    }
}

/// A phrase as a sentence, as the others in a list are.
fn sentence(phrase: &str) -> String {
    let mut letters = phrase.chars();
    match letters.next() {
        Some(first) => format!("{}{}.", first.to_uppercase(), letters.as_str()),
        None => String::new(),
    }
}
