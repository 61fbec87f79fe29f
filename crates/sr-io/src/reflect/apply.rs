//! The walk over tree and value.

use super::view::{Indexed, Named};
use super::{Context, FieldPath, default_value};
use crate::ron::{Field, Node, Pos, Value};
use bevy_reflect::enums::{
    DynamicEnum, DynamicVariant, EnumInfo, StructVariantInfo, TupleVariantInfo, VariantInfo,
};
use bevy_reflect::structs::DynamicStruct;
use bevy_reflect::tuple::DynamicTuple;
use bevy_reflect::{PartialReflect, ReflectMut, TypeInfo};
use sr_scene::diagnostics::suggest;
use std::collections::HashSet;

impl Context<'_> {
    /// Applies a tree to a value; see the [module](super) for what is written how.
    pub fn apply(&mut self, target: &mut dyn PartialReflect, node: &Node, path: &FieldPath<'_>) {
        let info = target.get_represented_type_info();
        if is_option(info) {
            return self.apply_option(target, node, path);
        }
        if let Some(TypeInfo::Enum(info)) = info {
            return self.apply_enum(target, info, node, path);
        }
        let name = info.and_then(|i| i.type_path_table().ident());
        let name = name.unwrap_or("a struct");
        match target.reflect_mut() {
            ReflectMut::Struct(s) => self.apply_struct(Named::Struct(s), name, node, path),
            ReflectMut::TupleStruct(t) if t.field_len() == 1 => {
                if let Some(inner) = t.field_mut(0) {
                    self.apply(inner, unwrap_newtype(node, name), path);
                }
            }
            ReflectMut::TupleStruct(t) => {
                self.apply_indexed(Indexed::TupleStruct(t), Some(name), node, path);
            }
            ReflectMut::Tuple(t) => self.apply_indexed(Indexed::Tuple(t), None, node, path),
            ReflectMut::Array(a) => self.apply_indexed(Indexed::Array(a), None, node, path),
            ReflectMut::List(_) => self.apply_list(target, node, path),
            ReflectMut::Map(_) => self.apply_map(target, node, path),
            _ => {
                if !self.apply_scalar(target, node, path) {
                    let name = target.reflect_short_type_path();
                    self.error(node.pos, path, format!("a {name} cannot be written in RON"));
                }
            }
        }
    }

    fn apply_struct(&mut self, target: Named<'_>, name: &str, node: &Node, path: &FieldPath<'_>) {
        match &node.value {
            Value::Unit => {}
            Value::Name(n) if n == name => {}
            Value::Tuple {
                name: Some(n),
                items,
            } if n == name && items.is_empty() => {}
            Value::Struct { name: n, fields } if n.as_ref().is_none_or(|n| n == name) => {
                self.apply_fields(target, name, fields, path);
            }
            _ => self.expected(&format!("{name} as `(field: value, …)`"), node, path),
        }
    }

    /// Sets fields by name and returns which.
    fn apply_fields<'n>(
        &mut self,
        mut target: Named<'_>,
        type_name: &str,
        fields: &'n [Field],
        path: &FieldPath<'_>,
    ) -> HashSet<&'n str> {
        let mut seen = HashSet::new();
        for field in fields {
            let path = FieldPath::Field(path, &field.key);
            if !seen.insert(field.key.as_str()) {
                self.error(field.key_pos, &path, "the field is set twice");
                continue;
            }
            let Some(value) = target.get(&field.key) else {
                let names = target.names();
                let hint = match names.as_slice() {
                    [] => format!("{type_name} has no fields"),
                    names => suggest(&field.key, names.iter().map(String::as_str)),
                };
                let message = format!("unknown field of {type_name}");
                self.error_with_hint(field.key_pos, &path, message, hint);
                continue;
            };
            let span = self.origin.span(field.value.pos);
            self.places.record(path.to_string(), span);
            self.apply(value, &field.value, &path);
        }
        seen
    }

    fn apply_indexed(
        &mut self,
        mut target: Indexed<'_>,
        name: Option<&str>,
        node: &Node,
        path: &FieldPath<'_>,
    ) {
        let len = target.len();
        let items: Vec<&Node> = match &node.value {
            Value::Tuple { name: n, items } if n.is_none() || n.as_deref() == name => {
                items.iter().collect()
            }
            Value::List(items) => items.iter().collect(),
            // One number for all places, as in `scale: 2`.
            Value::Number(_) => vec![node; len],
            _ => {
                return self.expected(&format!("{len} values as `(…, …)`"), node, path);
            }
        };
        if items.len() != len {
            let message = format!("expected {len} values, found {}", items.len());
            return self.error(node.pos, path, message);
        }
        for (i, item) in items.into_iter().enumerate() {
            if let Some(value) = target.get(i) {
                self.apply(value, item, &FieldPath::Index(path, i));
            }
        }
    }

    fn apply_list(&mut self, target: &mut dyn PartialReflect, node: &Node, path: &FieldPath<'_>) {
        let item = match target.get_represented_type_info() {
            Some(TypeInfo::List(info)) => info.item_info(),
            _ => None,
        };
        let Value::List(nodes) = &node.value else {
            return self.expected("a list as `[…, …]`", node, path);
        };
        let mut items = Vec::with_capacity(nodes.len());
        for (i, node) in nodes.iter().enumerate() {
            let path = FieldPath::Index(path, i);
            let Some(mut value) = self.fresh(item, node, &path) else {
                return;
            };
            self.apply(value.as_mut(), node, &path);
            items.push(value);
        }
        if let ReflectMut::List(list) = target.reflect_mut() {
            list.drain();
            items.into_iter().for_each(|item| list.push(item));
        }
    }

    fn apply_map(&mut self, target: &mut dyn PartialReflect, node: &Node, path: &FieldPath<'_>) {
        let (key, value) = match target.get_represented_type_info() {
            Some(TypeInfo::Map(info)) => (info.key_info(), info.value_info()),
            _ => (None, None),
        };
        let Value::Map(nodes) = &node.value else {
            return self.expected("a map as `{key: value, …}`", node, path);
        };
        let mut entries = Vec::with_capacity(nodes.len());
        let mut seen = HashSet::new();
        for (key_node, value_node) in nodes {
            let key_text = match &key_node.value {
                Value::String(text) => text.clone(),
                other => other.to_string(),
            };
            let path = FieldPath::Field(path, &key_text);
            if !seen.insert(key_text.clone()) {
                self.error(key_node.pos, &path, "the key is set twice");
                continue;
            }
            let fresh = self
                .fresh(key, key_node, &path)
                .zip(self.fresh(value, value_node, &path));
            let Some((mut k, mut v)) = fresh else { return };
            self.apply(k.as_mut(), key_node, &path);
            self.apply(v.as_mut(), value_node, &path);
            entries.push((k, v));
        }
        if let ReflectMut::Map(map) = target.reflect_mut() {
            map.drain();
            for (key, value) in entries {
                map.insert_boxed(key, value);
            }
        }
    }

    fn apply_option(&mut self, target: &mut dyn PartialReflect, node: &Node, path: &FieldPath<'_>) {
        let node = match &node.value {
            Value::None => {
                let none = DynamicEnum::new("None", DynamicVariant::Unit);
                return self.replace(target, &none, node.pos, path);
            }
            Value::Some(inner) => inner,
            _ => node,
        };
        if let ReflectMut::Enum(e) = target.reflect_mut()
            && let Some(inner) = e.field_at_mut(0)
        {
            return self.apply(inner, node, path);
        }
        let Some(mut inner) = self.fresh(option_item(target), node, path) else {
            return;
        };
        self.apply(inner.as_mut(), node, path);
        self.replace(target, &some(inner), node.pos, path);
    }

    fn apply_enum(
        &mut self,
        target: &mut dyn PartialReflect,
        info: &EnumInfo,
        node: &Node,
        path: &FieldPath<'_>,
    ) {
        let names = info.variant_names();
        let what = || format!("one of {}", names.join(", "));
        let wanted = match &node.value {
            Value::Name(name)
            | Value::Struct {
                name: Some(name), ..
            }
            | Value::Tuple {
                name: Some(name), ..
            } => name,
            Value::String(text) if names.contains(&text.as_str()) => {
                let message = format!("expected {}, found a text", what());
                let hint = format!("write {text} without quotes");
                return self.error_with_hint(node.pos, path, message, hint);
            }
            _ => return self.expected(&what(), node, path),
        };
        let Some(variant) = info.variant(wanted) else {
            let hint = suggest(wanted, names.iter().copied());
            let message = format!("there is no `{wanted}` here");
            return self.error_with_hint(node.pos, path, message, hint);
        };
        if let ReflectMut::Enum(current) = target.reflect_mut()
            && current.variant_name() == wanted
        {
            self.apply_variant(current, variant, node, path);
            return;
        }
        if let Some(new) = self.new_variant(variant, node, path) {
            self.replace(
                target,
                &DynamicEnum::new(wanted.as_str(), new),
                node.pos,
                path,
            );
        }
    }

    /// The variant stays; fields that are not named keep their values.
    fn apply_variant(
        &mut self,
        current: &mut dyn bevy_reflect::enums::Enum,
        variant: &VariantInfo,
        node: &Node,
        path: &FieldPath<'_>,
    ) {
        let name = variant.name();
        match (variant, &node.value) {
            (_, Value::Name(_)) => {}
            (_, Value::Tuple { items, .. }) if items.is_empty() => {}
            (VariantInfo::Struct(_), Value::Struct { fields, .. }) => {
                self.apply_fields(Named::Variant(current), name, fields, path);
            }
            (VariantInfo::Tuple(_), Value::Tuple { .. }) => {
                self.apply_indexed(Indexed::Variant(current), Some(name), node, path);
            }
            _ => self.wrong_variant_shape(variant, node, path),
        }
    }

    /// Another variant comes: its fields have no values yet, so those without default are needed.
    fn new_variant(
        &mut self,
        variant: &VariantInfo,
        node: &Node,
        path: &FieldPath<'_>,
    ) -> Option<DynamicVariant> {
        match (variant, &node.value) {
            (VariantInfo::Unit(_), Value::Name(_)) => Some(DynamicVariant::Unit),
            (VariantInfo::Unit(_), Value::Tuple { items, .. }) if items.is_empty() => {
                Some(DynamicVariant::Unit)
            }
            (VariantInfo::Struct(info), Value::Struct { fields, .. }) => {
                self.new_struct_variant(info, fields, node, path)
            }
            (VariantInfo::Struct(info), Value::Name(_)) => {
                self.new_struct_variant(info, &[], node, path)
            }
            (VariantInfo::Tuple(info), Value::Tuple { .. }) => {
                self.new_tuple_variant(info, node, path)
            }
            _ => {
                self.wrong_variant_shape(variant, node, path);
                None
            }
        }
    }

    fn new_struct_variant(
        &mut self,
        info: &StructVariantInfo,
        fields: &[Field],
        node: &Node,
        path: &FieldPath<'_>,
    ) -> Option<DynamicVariant> {
        let mut value = DynamicStruct::default();
        for field in info.iter() {
            value.insert_boxed(field.name(), self.fresh(field.type_info(), node, path)?);
        }
        let seen = self.apply_fields(Named::Struct(&mut value), info.name(), fields, path);
        for field in info.iter() {
            if !seen.contains(field.name()) && !is_option(field.type_info()) {
                let message = format!("`{}` needs the field `{}`", info.name(), field.name());
                self.error(node.pos, path, message);
            }
        }
        Some(DynamicVariant::Struct(value))
    }

    fn new_tuple_variant(
        &mut self,
        info: &TupleVariantInfo,
        node: &Node,
        path: &FieldPath<'_>,
    ) -> Option<DynamicVariant> {
        let mut value = DynamicTuple::default();
        for field in info.iter() {
            value.insert_boxed(self.fresh(field.type_info(), node, path)?);
        }
        self.apply_indexed(Indexed::Tuple(&mut value), Some(info.name()), node, path);
        Some(DynamicVariant::Tuple(value))
    }

    fn wrong_variant_shape(&mut self, variant: &VariantInfo, node: &Node, path: &FieldPath<'_>) {
        let name = variant.name();
        let shape = match variant {
            VariantInfo::Unit(_) => format!("`{name}` alone"),
            VariantInfo::Tuple(t) => format!("`{name}(…)` with {} values", t.field_len()),
            VariantInfo::Struct(s) => {
                let fields: Vec<String> = s.iter().map(|f| format!("{}: …", f.name())).collect();
                format!("`{name}({})`", fields.join(", "))
            }
        };
        self.error(node.pos, path, format!("expected {shape}"));
    }

    /// A default value to apply a tree to.
    pub(super) fn fresh(
        &mut self,
        info: Option<&'static TypeInfo>,
        node: &Node,
        path: &FieldPath<'_>,
    ) -> Option<Box<dyn PartialReflect>> {
        let value = info.and_then(|info| {
            default_value(self.registry, info).or_else(|| {
                // An enum without default starts as any of its variants that needs nothing.
                let TypeInfo::Enum(e) = info else { return None };
                let unit = e.iter().find(|v| matches!(v, VariantInfo::Unit(_)))?;
                let mut value = DynamicEnum::new(unit.name(), DynamicVariant::Unit);
                value.set_represented_type(Some(info));
                Some(Box::new(value))
            })
        });
        if value.is_none() {
            let name = info.map_or("unknown", |i| i.type_path_table().short_path());
            let message = format!("the type {name} is not registered with a default");
            self.error(node.pos, path, message);
        }
        value
    }

    pub(super) fn replace(
        &mut self,
        target: &mut dyn PartialReflect,
        new: &dyn PartialReflect,
        pos: Pos,
        path: &FieldPath<'_>,
    ) {
        if let Err(error) = target.try_apply(new) {
            self.error(pos, path, format!("cannot be set: {error}"));
        }
    }
}

/// `Name(x)` and `(x)` around the value of a newtype are allowed.
fn unwrap_newtype<'n>(node: &'n Node, name: &str) -> &'n Node {
    match &node.value {
        Value::Tuple { name: n, items } if n.as_ref().is_none_or(|n| n == name) => {
            match items.as_slice() {
                [inner] => inner,
                _ => node,
            }
        }
        _ => node,
    }
}

pub(super) fn is_option(info: Option<&TypeInfo>) -> bool {
    info.is_some_and(|i| {
        let path = i.type_path_table();
        path.ident() == Some("Option") && path.crate_name() == Some("core")
    })
}

/// The type inside an `Option`.
pub(super) fn option_item(target: &dyn PartialReflect) -> Option<&'static TypeInfo> {
    match target.get_represented_type_info() {
        Some(TypeInfo::Enum(info)) => match info.variant("Some") {
            Some(VariantInfo::Tuple(some)) => some.field_at(0)?.type_info(),
            _ => None,
        },
        _ => None,
    }
}

/// `Some(inner)`.
pub(super) fn some(inner: Box<dyn PartialReflect>) -> DynamicEnum {
    let mut tuple = DynamicTuple::default();
    tuple.insert_boxed(inner);
    DynamicEnum::new("Some", DynamicVariant::Tuple(tuple))
}
