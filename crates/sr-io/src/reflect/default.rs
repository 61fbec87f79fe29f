//! A value of a type that is known by its registration only.

use bevy_ecs::entity::Entity;
use bevy_reflect::array::DynamicArray;
use bevy_reflect::list::DynamicList;
use bevy_reflect::map::DynamicMap;
use bevy_reflect::std_traits::ReflectDefault;
use bevy_reflect::structs::DynamicStruct;
use bevy_reflect::tuple::DynamicTuple;
use bevy_reflect::tuple_struct::DynamicTupleStruct;
use bevy_reflect::{PartialReflect, ReflectFromReflect, TypeInfo, TypeRegistry};
use std::any::TypeId;

/// The default of a type; for one without (an entity, or a struct that holds one) a placeholder of
/// the right shape. `None` when the type is not registered or is an enum without default.
pub fn default_value(registry: &TypeRegistry, info: &TypeInfo) -> Option<Box<dyn PartialReflect>> {
    let id = info.type_id();
    if id == TypeId::of::<Entity>() {
        return Some(Box::new(Entity::PLACEHOLDER));
    }
    if let Some(default) = registry.get_type_data::<ReflectDefault>(id) {
        return Some(default.default().into_partial_reflect());
    }
    let shape = placeholder(registry, info)?;
    // Without `FromReflect` the shape itself still takes values and can be applied.
    match registry.get_type_data::<ReflectFromReflect>(id) {
        Some(from) => from
            .from_reflect(shape.as_ref())
            .map(|v| v.into_partial_reflect()),
        None => Some(shape),
    }
}

fn placeholder(registry: &TypeRegistry, info: &TypeInfo) -> Option<Box<dyn PartialReflect>> {
    let field = |info: Option<&'static TypeInfo>| default_value(registry, info?);
    Some(match info {
        TypeInfo::Struct(s) => {
            let mut value = DynamicStruct::default();
            for f in s.iter() {
                value.insert_boxed(f.name(), field(f.type_info())?);
            }
            Box::new(value)
        }
        TypeInfo::TupleStruct(s) => {
            let mut value = DynamicTupleStruct::default();
            for f in s.iter() {
                value.insert_boxed(field(f.type_info())?);
            }
            Box::new(value)
        }
        TypeInfo::Tuple(t) => {
            let mut value = DynamicTuple::default();
            for f in t.iter() {
                value.insert_boxed(field(f.type_info())?);
            }
            Box::new(value)
        }
        TypeInfo::Array(a) => {
            let items: Option<Vec<_>> = (0..a.capacity()).map(|_| field(a.item_info())).collect();
            Box::new(DynamicArray::new(items?.into_boxed_slice()))
        }
        TypeInfo::List(_) => Box::new(DynamicList::default()),
        TypeInfo::Map(_) => Box::new(DynamicMap::default()),
        _ => return None,
    })
}
