//! Names that can stand in a parameter path, each used once.

use std::collections::HashSet;

/// Hands out names of entities and materials.
#[derive(Default)]
pub(crate) struct Names {
    used: HashSet<String>,
}

impl Names {
    /// A name like `wanted` that nobody has got yet.
    pub fn claim(&mut self, wanted: &str) -> String {
        let base = plain(wanted);
        let mut name = base.clone();
        let mut n = 2;
        while !self.used.insert(name.clone()) {
            name = format!("{base}_{n}");
            n += 1;
        }
        name
    }
}

/// Letters, digits, `_` and `-`; all else becomes `_`. Paths such as
/// `materials.model/name.Lambert` separate their parts by dots and slashes.
pub(crate) fn plain(name: &str) -> String {
    let keep = |c: char| {
        if c.is_alphanumeric() || c == '-' {
            c
        } else {
            '_'
        }
    };
    let name: String = name.trim().chars().map(keep).collect();
    if name.is_empty() {
        "unnamed".to_owned()
    } else {
        name
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_are_unique_and_fit_in_a_path() {
        let mut names = Names::default();
        assert_eq!(names.claim("Icosphere.003"), "Icosphere_003");
        assert_eq!(names.claim("Icosphere_003"), "Icosphere_003_2");
        assert_eq!(names.claim("a/b c"), "a_b_c");
        assert_eq!(names.claim(""), "unnamed");
    }
}
