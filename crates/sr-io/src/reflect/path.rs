//! Paths such as `alpha`, `eta[2]`, `filter.radius` inside a value.

use super::apply::{is_option, option_item, some};
use super::view::{Indexed, Named};
use super::{Context, FieldPath};
use crate::ron::{Node, Pos};
use bevy_reflect::{PartialReflect, ReflectMut};
use sr_scene::diagnostics::suggest;

/// One step of a path.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Step<'a> {
    /// `.name`
    Field(&'a str),
    /// `[2]`
    Index(usize),
}

/// Reads `a.b[2].c`; the first name may go without its dot. The error says what is wrong.
pub fn parse_steps(text: &str) -> Result<Vec<Step<'_>>, String> {
    let mut steps = Vec::new();
    let mut rest = text;
    while !rest.is_empty() {
        if let Some(bracket) = rest.strip_prefix('[') {
            let (index, after) = bracket
                .split_once(']')
                .ok_or_else(|| format!("`{rest}` lacks its `]`"))?;
            let index = index
                .trim()
                .parse()
                .map_err(|_| format!("`[{index}]` is not an index"))?;
            steps.push(Step::Index(index));
            rest = after;
            continue;
        }
        let name = match rest.strip_prefix('.') {
            Some(name) => name,
            None if steps.is_empty() => rest,
            None => return Err(format!("expected `.` or `[` before `{rest}`")),
        };
        let end = name.find(['.', '[']).unwrap_or(name.len());
        if end == 0 {
            return Err("a name is missing after a `.`".into());
        }
        steps.push(match name[..end].parse() {
            Ok(index) => Step::Index(index),
            Err(_) => Step::Field(&name[..end]),
        });
        rest = &name[end..];
    }
    Ok(steps)
}

impl Context<'_> {
    /// Applies a tree to what `steps` lead to inside a value. An unset `Option` on the way is set
    /// to its default first; newtypes count for nothing. `at` is where the steps were written.
    pub fn apply_at(
        &mut self,
        target: &mut dyn PartialReflect,
        steps: &[Step<'_>],
        at: Pos,
        node: &Node,
        path: &FieldPath<'_>,
    ) {
        let Some((step, rest)) = steps.split_first() else {
            return self.apply(target, node, path);
        };
        if is_option(target.get_represented_type_info()) {
            return self.apply_at_option(target, steps, at, node, path);
        }
        let owner = target.reflect_short_type_path().to_owned();
        if let ReflectMut::TupleStruct(newtype) = target.reflect_mut()
            && newtype.field_len() == 1
            && let Some(inner) = newtype.field_mut(0)
        {
            return self.apply_at(inner, steps, at, node, path);
        }
        let found = match (view(target), *step) {
            (View::Named(named), Step::Field(name)) => {
                let path = FieldPath::Field(path, name);
                self.field(named, name, &owner, at, &path)
                    .map(|value| (value, path))
            }
            (View::Indexed(indexed), Step::Index(index)) => {
                let path = FieldPath::Index(path, index);
                self.place(indexed, index, at, &path)
                    .map(|value| (value, path))
            }
            (View::Named(named), Step::Index(index)) => {
                let names = named.names();
                let hint = suggest("", names.iter().map(String::as_str));
                let message = format!("{owner} has fields by name, not `[{index}]`");
                self.error_with_hint(at, path, message, hint);
                None
            }
            (View::Indexed(_), Step::Field(name)) => {
                let message = format!("{owner} has no field `{name}`");
                self.error_with_hint(at, path, message, "write an index such as `[0]`");
                None
            }
            (View::Leaf, _) => {
                self.error(at, path, format!("there is nothing inside a {owner}"));
                None
            }
        };
        if let Some((value, path)) = found {
            self.apply_at(value, rest, at, node, &path);
        }
    }

    fn field<'v>(
        &mut self,
        named: Named<'v>,
        name: &str,
        owner: &str,
        at: Pos,
        path: &FieldPath<'_>,
    ) -> Option<&'v mut dyn PartialReflect> {
        let names = named.names();
        let value = named.into_field(name);
        if value.is_none() {
            let hint = suggest(name, names.iter().map(String::as_str));
            self.error_with_hint(at, path, format!("unknown field of {owner}"), hint);
        }
        value
    }

    fn place<'v>(
        &mut self,
        indexed: Indexed<'v>,
        index: usize,
        at: Pos,
        path: &FieldPath<'_>,
    ) -> Option<&'v mut dyn PartialReflect> {
        let len = indexed.len();
        let value = indexed.into_place(index);
        if value.is_none() {
            let message = match len.checked_sub(1) {
                Some(last) => format!("the last index is {last}"),
                None => "nothing is in it".into(),
            };
            self.error(at, path, message);
        }
        value
    }

    fn apply_at_option(
        &mut self,
        target: &mut dyn PartialReflect,
        steps: &[Step<'_>],
        at: Pos,
        node: &Node,
        path: &FieldPath<'_>,
    ) {
        if let ReflectMut::Enum(e) = target.reflect_mut()
            && let Some(inner) = e.field_at_mut(0)
        {
            return self.apply_at(inner, steps, at, node, path);
        }
        let Some(mut inner) = self.fresh(option_item(target), node, path) else {
            return;
        };
        self.apply_at(inner.as_mut(), steps, at, node, path);
        self.replace(target, &some(inner), node.pos, path);
    }
}

/// What a step can go into.
enum View<'a> {
    Named(Named<'a>),
    Indexed(Indexed<'a>),
    Leaf,
}

fn view(target: &mut dyn PartialReflect) -> View<'_> {
    match target.reflect_mut() {
        ReflectMut::Struct(s) => View::Named(Named::Struct(s)),
        ReflectMut::Enum(e) if e.name_at(0).is_some() => View::Named(Named::Variant(e)),
        ReflectMut::Enum(e) => View::Indexed(Indexed::Variant(e)),
        ReflectMut::Array(a) => View::Indexed(Indexed::Array(a)),
        ReflectMut::Tuple(t) => View::Indexed(Indexed::Tuple(t)),
        ReflectMut::TupleStruct(t) => View::Indexed(Indexed::TupleStruct(t)),
        ReflectMut::List(l) => View::Indexed(Indexed::List(l)),
        _ => View::Leaf,
    }
}
