//! Ray queries: BVH build, 8-wide watertight traversal
