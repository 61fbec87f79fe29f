//! How much a file may make the reader allocate.
//!
//! A glTF file can name much more data than it holds: many primitives share one accessor, many
//! nodes one mesh, and a sparse accessor without a view is zeros of any number. Sharing is useful
//! up to a point, so what comes out is bounded by a multiple of what went in.

/// Bytes that any file may ask for.
const FREE: u64 = 64 << 20;

/// Bytes that come out for one that went in: a few hundred instances of a mesh that makes up the
/// whole file, whose packed form may be a tenth of ours.
const PER_INPUT_BYTE: u64 = 512;

/// What is left of the allowance.
#[derive(Debug)]
pub(super) struct Budget {
    left: u64,
    allowed: u64,
}

impl Budget {
    /// The allowance of a file that holds, with its buffers, so many bytes.
    pub(super) fn for_input(bytes: usize) -> Self {
        let allowed = FREE.saturating_add(PER_INPUT_BYTE.saturating_mul(bytes as u64));
        Self {
            left: allowed,
            allowed,
        }
    }

    /// Pays for `count` elements of so many bytes, before they are allocated.
    ///
    /// # Errors
    /// A message, when the allowance does not reach; nothing is paid then.
    pub(super) fn pay(&mut self, count: u64, bytes_each: u64) -> Result<(), String> {
        let cost = count.checked_mul(bytes_each).filter(|c| *c <= self.left);
        let Some(cost) = cost else {
            return Err(format!(
                "{count} elements here bring the meshes of this file above {} MiB, {PER_INPUT_BYTE} \
                 times the data that it holds; its accessors or meshes are shared too often",
                self.allowed >> 20
            ));
        };
        self.left -= cost;
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_comes_out_is_bounded_by_what_goes_in() {
        let mut budget = Budget::for_input(200);
        assert!(budget.pay(1 << 32, 12).is_err());
        assert!(budget.pay(u64::MAX, 12).is_err());
        assert!(budget.pay(1 << 20, 60).is_ok());
        assert!(budget.pay(1 << 20, 60).is_err());
    }
}
