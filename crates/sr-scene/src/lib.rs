//! The scene as entities: components and the systems that compile them
