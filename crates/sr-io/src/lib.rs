//! Readers: RON, glTF and OBJ into entities, with source spans in every error
