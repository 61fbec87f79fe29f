//! The leaves: numbers, texts, names of entities.

use super::{Context, FieldPath};
use crate::ron::{Node, Number, Value};
use bevy_ecs::entity::Entity;
use bevy_reflect::PartialReflect;
use std::path::PathBuf;

impl Context<'_> {
    /// Sets a leaf. `false` when the type is none that RON can hold.
    pub(super) fn apply_scalar(
        &mut self,
        target: &mut dyn PartialReflect,
        node: &Node,
        path: &FieldPath<'_>,
    ) -> bool {
        macro_rules! integers {
            ($($t:ty)*) => {$(
                if let Some(target) = target.try_downcast_mut::<$t>() {
                    let limits = format!("{} to {}", <$t>::MIN, <$t>::MAX);
                    if let Some(x) = self.integer(node, path, &limits) {
                        *target = x;
                    }
                    return true;
                }
            )*};
        }
        macro_rules! floats {
            ($($t:ty, $to:ident;)*) => {$(
                if let Some(target) = target.try_downcast_mut::<$t>() {
                    let overflows = |n: &Number| n.$to().is_infinite();
                    if let Some(n) = self.float(node, path, overflows) {
                        *target = n.$to();
                    }
                    return true;
                }
            )*};
        }
        floats! { f32, to_f32; f64, to_f64; }
        integers! { u8 u16 u32 u64 usize i8 i16 i32 i64 isize }
        if let Some(target) = target.try_downcast_mut::<bool>() {
            match node.value {
                Value::Bool(b) => *target = b,
                _ => self.expected("`true` or `false`", node, path),
            }
        } else if let Some(target) = target.try_downcast_mut::<char>() {
            match node.value {
                Value::Char(c) => *target = c,
                _ => self.expected("a character", node, path),
            }
        } else if let Some(target) = target.try_downcast_mut::<String>() {
            if let Some(text) = self.text("a text", node, path) {
                *target = text;
            }
        } else if let Some(target) = target.try_downcast_mut::<PathBuf>() {
            if let Some(text) = self.text("a path as a text", node, path) {
                *target = self.origin.folder.join(text);
            }
        } else if let Some(target) = target.try_downcast_mut::<Entity>() {
            if let Some(entity) = self.entity_by_name(node, path) {
                *target = entity;
            }
        } else {
            return false;
        }
        true
    }

    fn float<'n>(
        &mut self,
        node: &'n Node,
        path: &FieldPath<'_>,
        overflows: impl Fn(&Number) -> bool,
    ) -> Option<&'n Number> {
        let Value::Number(n) = &node.value else {
            self.expected("a number", node, path);
            return None;
        };
        if n.to_f64().is_nan() {
            self.error(node.pos, path, "NaN is no number");
            return None;
        }
        if overflows(n) && !n.is_infinite() {
            self.error(node.pos, path, format!("{n} is too large"));
            return None;
        }
        Some(n)
    }

    fn integer<T: TryFrom<i128>>(
        &mut self,
        node: &Node,
        path: &FieldPath<'_>,
        limits: &str,
    ) -> Option<T> {
        let Value::Number(n) = &node.value else {
            self.expected("a whole number", node, path);
            return None;
        };
        if !n.is_integer() {
            self.error(
                node.pos,
                path,
                format!("expected a whole number, found {n}"),
            );
            return None;
        }
        let x = n.to_integer();
        if x.is_none() {
            self.error(node.pos, path, format!("{n} is out of range: {limits}"));
        }
        x
    }

    fn text(&mut self, what: &str, node: &Node, path: &FieldPath<'_>) -> Option<String> {
        match &node.value {
            Value::String(text) => Some(text.clone()),
            Value::Name(word) if !self.origin.is_file => Some(word.clone()),
            Value::Name(word) => {
                let message = format!("expected {what}, found the name `{word}`");
                self.error_with_hint(node.pos, path, message, format!("write \"{word}\""));
                None
            }
            _ => {
                self.expected(what, node, path);
                None
            }
        }
    }

    fn entity_by_name(&mut self, node: &Node, path: &FieldPath<'_>) -> Option<Entity> {
        let Some(name) = self.text("the name of an entity as a text", node, path) else {
            self.unresolved = true;
            return None;
        };
        match (self.entity)(&name) {
            Ok(entity) => return Some(entity),
            Err(Some(hint)) => {
                let message = format!("there is no entity `{name}`");
                self.error_with_hint(node.pos, path, message, hint);
            }
            Err(None) => {}
        }
        self.unresolved = true;
        None
    }
}
