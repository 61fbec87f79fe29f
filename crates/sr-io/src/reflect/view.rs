//! One face for the several kinds of reflected values that have fields.

use bevy_reflect::PartialReflect;
use bevy_reflect::array::Array;
use bevy_reflect::enums::Enum;
use bevy_reflect::list::List;
use bevy_reflect::structs::Struct;
use bevy_reflect::tuple::Tuple;
use bevy_reflect::tuple_struct::TupleStruct;

/// What has named fields.
pub(super) enum Named<'a> {
    Struct(&'a mut dyn Struct),
    Variant(&'a mut dyn Enum),
}

impl<'a> Named<'a> {
    pub fn names(&self) -> Vec<String> {
        let name = |i| match self {
            Self::Struct(s) => s.name_at(i),
            Self::Variant(e) => e.name_at(i),
        };
        (0..).map_while(name).map(str::to_owned).collect()
    }

    pub fn get(&mut self, name: &str) -> Option<&mut dyn PartialReflect> {
        match self {
            Self::Struct(s) => s.field_mut(name),
            Self::Variant(e) => e.field_mut(name),
        }
    }

    /// As [`get`](Self::get), for as long as the value itself.
    pub fn into_field(self, name: &str) -> Option<&'a mut dyn PartialReflect> {
        match self {
            Self::Struct(s) => s.field_mut(name),
            Self::Variant(e) => e.field_mut(name),
        }
    }
}

/// What has fields by number.
pub(super) enum Indexed<'a> {
    Array(&'a mut dyn Array),
    Tuple(&'a mut dyn Tuple),
    TupleStruct(&'a mut dyn TupleStruct),
    Variant(&'a mut dyn Enum),
    List(&'a mut dyn List),
}

impl<'a> Indexed<'a> {
    pub fn len(&self) -> usize {
        match self {
            Self::Array(a) => a.len(),
            Self::Tuple(t) => t.field_len(),
            Self::TupleStruct(t) => t.field_len(),
            Self::Variant(e) => e.field_len(),
            Self::List(l) => l.len(),
        }
    }

    /// The field at a place, for as long as the value itself.
    pub fn into_place(self, index: usize) -> Option<&'a mut dyn PartialReflect> {
        match self {
            Self::Array(a) => a.get_mut(index),
            Self::Tuple(t) => t.field_mut(index),
            Self::TupleStruct(t) => t.field_mut(index),
            Self::Variant(e) => e.field_at_mut(index),
            Self::List(l) => l.get_mut(index),
        }
    }

    pub fn get(&mut self, index: usize) -> Option<&mut dyn PartialReflect> {
        match self {
            Self::Array(a) => a.get_mut(index),
            Self::Tuple(t) => t.field_mut(index),
            Self::TupleStruct(t) => t.field_mut(index),
            Self::Variant(e) => e.field_at_mut(index),
            Self::List(l) => l.get_mut(index),
        }
    }
}
