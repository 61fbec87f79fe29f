//! What reflection knows of a type: its fields with type, default and documentation.

use sr_io::reflect::{default_value, to_ron};
use sr_pipeline::bevy_reflect::enums::VariantInfo;
use sr_pipeline::bevy_reflect::{PartialReflect, ReflectRef, TypeInfo, TypeRegistry};

/// A field that a path reaches.
pub struct Field {
    /// Its path.
    pub path: String,
    /// What it takes, as written in RON.
    pub kind: String,
    /// Its default in RON.
    pub default: String,
    /// One sentence.
    pub docs: String,
}

/// The fields of a type, those of nested structs in place of the struct.
pub fn fields(registry: &TypeRegistry, info: &'static TypeInfo, prefix: &str) -> Vec<Field> {
    let default = default_value(registry, info);
    let mut list = Vec::new();
    collect(info, default.as_deref(), prefix, &mut list);
    list
}

fn collect(
    info: &'static TypeInfo,
    default: Option<&dyn PartialReflect>,
    prefix: &str,
    list: &mut Vec<Field>,
) {
    let TypeInfo::Struct(info) = info else {
        return;
    };
    for field in info.iter() {
        let path = format!("{prefix}{}", field.name());
        let value = default.and_then(|d| match d.reflect_ref() {
            ReflectRef::Struct(s) => s.field(field.name()),
            _ => None,
        });
        let nested = field.type_info();
        if let Some(nested @ TypeInfo::Struct(_)) = nested {
            collect(nested, value, &format!("{path}."), list);
            continue;
        }
        list.push(Field {
            path,
            kind: nested.map_or_else(|| field.type_path_table().short_path().into(), kind),
            default: value.map_or_else(String::new, to_ron),
            docs: first_sentence(field.docs()),
        });
    }
}

/// A type as its values are written: the names of an enum's variants, `f32` for a newtype of it.
fn kind(info: &'static TypeInfo) -> String {
    match info {
        TypeInfo::Enum(e) if info.type_path_table().short_path().starts_with("Option<") => {
            let inner = e.variant("Some").and_then(|some| match some {
                VariantInfo::Tuple(t) => t.field_at(0)?.type_info(),
                _ => None,
            });
            format!("{} | None", inner.map_or_else(|| "value".into(), kind))
        }
        TypeInfo::Enum(e) => {
            let variants: Vec<String> = e.iter().map(variant).collect();
            variants.join(" | ")
        }
        TypeInfo::List(list) => {
            let item = list.item_info().map_or_else(|| "value".into(), kind);
            format!("[{item}, …]")
        }
        _ => info.type_path_table().short_path().to_owned(),
    }
}

fn variant(info: &'static VariantInfo) -> String {
    let fields: Vec<&str> = match info {
        VariantInfo::Struct(s) => s.iter().map(|f| f.name()).collect(),
        VariantInfo::Tuple(t) => t.iter().map(|f| f.type_path_table().short_path()).collect(),
        VariantInfo::Unit(_) => return info.name().to_owned(),
    };
    format!("{}({})", info.name(), fields.join(", "))
}

/// The variants of an enum with their documentation.
pub fn variants(
    info: &'static TypeInfo,
) -> impl Iterator<Item = (&'static str, Option<&'static str>)> {
    let variants = match info {
        TypeInfo::Enum(e) => Some(e.iter().map(|v| (v.name(), v.docs()))),
        _ => None,
    };
    variants.into_iter().flatten()
}

/// The documentation of a type.
pub fn docs(info: &'static TypeInfo) -> Option<&'static str> {
    match info {
        TypeInfo::Struct(s) => s.docs(),
        TypeInfo::TupleStruct(s) => s.docs(),
        TypeInfo::Enum(e) => e.docs(),
        _ => None,
    }
}

/// The first sentence of a doc comment, on one line and without the marks of links.
pub fn first_sentence(docs: Option<&str>) -> String {
    let docs = docs.unwrap_or_default();
    let paragraph: Vec<&str> = docs
        .lines()
        .map(str::trim)
        .skip_while(|l| l.is_empty())
        .take_while(|l| !l.is_empty())
        .collect();
    let paragraph = paragraph.join(" ").replace("[`", "`").replace("`]", "`");
    match paragraph.split_once(". ") {
        Some((first, _)) => format!("{first}."),
        None => paragraph,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_sentence_ends_at_its_full_stop() {
        let docs = Some(" Real part of the [`Index`], 0.5 say.\n Second.\n\n More.");
        assert_eq!(first_sentence(docs), "Real part of the `Index`, 0.5 say.");
        assert_eq!(first_sentence(Some(" One\n line")), "One line");
        assert_eq!(first_sentence(None), "");
    }
}
