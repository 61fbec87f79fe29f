//! Bits that must not change.
