//! The sealed scene: flat tables and scene-level queries, without ECS
