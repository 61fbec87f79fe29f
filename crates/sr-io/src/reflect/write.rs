//! A reflected value as RON that reads back as the same value.

use crate::ron::{is_identifier, quote};
use bevy_reflect::enums::VariantType;
use bevy_reflect::{PartialReflect, ReflectRef};
use std::path::PathBuf;

/// The value on one line. Values that RON cannot hold are written as text.
pub fn to_ron(value: &dyn PartialReflect) -> String {
    match value.reflect_ref() {
        ReflectRef::Struct(s) => {
            let fields = (0..s.field_len()).map(|i| (s.name_at(i), s.field_at(i)));
            parenthesised("", fields)
        }
        ReflectRef::TupleStruct(t) if t.field_len() == 1 => {
            t.field(0).map_or_else(String::new, to_ron)
        }
        ReflectRef::TupleStruct(t) => parenthesised("", t.iter_fields().map(|v| (None, Some(v)))),
        ReflectRef::Tuple(t) => parenthesised("", t.iter_fields().map(|v| (None, Some(v)))),
        ReflectRef::Array(a) => parenthesised("", a.iter().map(|v| (None, Some(v)))),
        ReflectRef::List(l) => {
            let items: Vec<String> = l.iter().map(to_ron).collect();
            format!("[{}]", items.join(", "))
        }
        ReflectRef::Map(m) => {
            let mut entries: Vec<String> = m
                .iter()
                .map(|(k, v)| format!("{}: {}", to_ron(k), to_ron(v)))
                .collect();
            // Hash maps have no order of their own.
            entries.sort();
            format!("{{{}}}", entries.join(", "))
        }
        ReflectRef::Enum(e) => match e.variant_type() {
            VariantType::Unit => e.variant_name().to_owned(),
            _ => {
                let fields = (0..e.field_len()).map(|i| (e.name_at(i), e.field_at(i)));
                parenthesised(e.variant_name(), fields)
            }
        },
        _ => scalar(value),
    }
}

fn parenthesised<'a>(
    name: &str,
    fields: impl Iterator<Item = (Option<&'a str>, Option<&'a dyn PartialReflect>)>,
) -> String {
    let fields: Vec<String> = fields
        .filter_map(|(name, value)| {
            let value = to_ron(value?);
            Some(match name {
                Some(name) if is_identifier(name) => format!("{name}: {value}"),
                Some(name) => format!("r#{name}: {value}"),
                None => value,
            })
        })
        .collect();
    format!("{name}({})", fields.join(", "))
}

fn scalar(value: &dyn PartialReflect) -> String {
    if let Some(text) = value.try_downcast_ref::<String>() {
        quote(text)
    } else if let Some(path) = value.try_downcast_ref::<PathBuf>() {
        quote(&path.display().to_string())
    } else if let Some(c) = value.try_downcast_ref::<char>() {
        crate::ron::Value::Char(*c).to_string()
    } else {
        // Rust writes numbers and booleans as RON does, floats with the digits that they need.
        format!("{value:?}")
    }
}
