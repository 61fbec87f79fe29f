//! A tree of RON onto a reflected value, in place.
//!
//! What the tree does not name keeps its value. Every problem becomes a
//! [`Diagnostic`](sr_scene::diagnostics::Diagnostic) with its place, the path of its field and the nearest valid name, and the rest
//! of the tree is still applied: one run tells everything that is wrong.
//!
//! | type | in RON |
//! |---|---|
//! | struct | `(field: value, …)`, the type's name before it if wanted; `()` changes nothing |
//! | struct of one unnamed field | the field's value |
//! | enum | `Variant`, `Variant(field: value)`, `Variant(value)` |
//! | `Option` | `None`, `Some(value)` or the bare value |
//! | array, tuple | `(a, b, c)` or `[a, b, c]`; a single number fills all places |
//! | `Vec` | `[a, b, …]`, which takes the place of what was there |
//! | map | `{key: value, …}`, likewise |
//! | number | range and kind are checked: no 300 in a `u8`, no 1.5 in an integer, no NaN |
//! | `Entity` | its name as a text |
//! | `PathBuf` | a text, relative to the file it stands in |

mod apply;
mod context;
mod default;
mod path;
mod places;
mod scalar;
mod view;
mod write;

pub use context::{Context, FieldPath, Origin, Resolved};
pub use default::default_value;
pub use path::{Step, parse_steps};
pub use places::Places;
pub use write::to_ron;

#[cfg(test)]
mod tests;
